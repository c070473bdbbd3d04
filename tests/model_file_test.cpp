// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models on disk: what is saved comes back bit for bit, and what is damaged, cut short, foreign or hostile is refused or
// harmless.
#include <swiftlet/model_file.h>

#if defined(__linux__)
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#endif

#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <swiftlet/check.h>
#include <swiftlet/query.h>

#include "bodies.h"
#include "folder.h"

namespace swiftlet {
namespace {

using namespace bodies;

using ModelFile = FolderTest;

Model small() { return nested(2, {false, {lut::Resolution::Degrees22, 2}}); }

ErrorCode code_of(const Result<Model>& m) {
  EXPECT_FALSE(m) << "accepted";
  if (m) return ErrorCode::Cancelled;
  EXPECT_FALSE(m.error().message.empty());
  return m.error().code;
}

TEST_F(ModelFile, ReadingAValueThatIsAbsentTellsWhy) {
  EXPECT_DEATH_IF_SUPPORTED((void)load("nowhere.swl").value(), "swiftlet: nowhere.swl: ");
  EXPECT_DEATH_IF_SUPPORTED((void)Result<int>(1).error(), "there is no error");
}

TEST_F(ModelFile, ComesBackBitForBit) {
  const Model all[] = {small(),
                       nested(3),
                       model(cube(), {false, {lut::Resolution::None, 2}}),
                       model(point({1, 2, 3})),
                       model(segment({0, 0, 0}, {1, 0, 0})),
                       model(two_sided({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}))};
  for (const Model& m : all) {
    const auto file = path("m.swl");
    EXPECT_EQ(must(save(m, file)), m.bytes().size());
    EXPECT_EQ(std::filesystem::file_size(file), m.bytes().size());
    const Model back = must(load(file));
    EXPECT_EQ(bytes_of(back), bytes_of(m));
    EXPECT_EQ(back.hash(), m.hash());
    EXPECT_EQ(back.level_count(), m.level_count());
    EXPECT_EQ(back.centre(), m.centre());
    EXPECT_TRUE(verify(back));
    EXPECT_EQ(bytes_of(must(load(m.bytes()))), bytes_of(m));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(back.bytes().data()) % 64, 0u);
  }
}

TEST_F(ModelFile, CoarseLevelsComeFirst) {
  const Bytes block = bytes_of(nested(3));
  std::uint64_t offset[3];
  for (std::size_t i = 0; i < 3; ++i) offset[i] = read<LevelHeader>(block, level_header_at(i)).section.offset;
  EXPECT_LT(offset[2], offset[1]);
  EXPECT_LT(offset[1], offset[0]);
  for (const std::uint64_t o : offset) EXPECT_EQ(o % 64, 0u);
}

TEST_F(ModelFile, SaveReplacesAndLeavesNothingBeside) {
  const auto file = path("m.swl");
  ASSERT_TRUE(save(nested(3), file));
  ASSERT_TRUE(save(small(), file));
  EXPECT_EQ(must(load(file)).hash(), small().hash());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1);
}

TEST_F(ModelFile, SaveWritesWhereALinkLeads) {
  std::filesystem::create_directory(path("there"));
  std::error_code no_links_here;
  std::filesystem::create_symlink("there/m.swl", path("second"), no_links_here);
  std::filesystem::create_symlink("second", path("first"), no_links_here);
  if (no_links_here) GTEST_SKIP() << "no symbolic links here";
  for (const Model& model : {small(), nested(3)}) {  // where nothing was, and where a file was
    ASSERT_TRUE(save(model, path("first")));
    EXPECT_EQ(must(load(path("there/m.swl"))).hash(), model.hash());
    EXPECT_TRUE(std::filesystem::is_symlink(path("first")) && std::filesystem::is_symlink(path("second")));
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("there")), {}), 1);
  std::filesystem::create_symlink("other", path("one"));
  std::filesystem::create_symlink("one", path("other"));
  EXPECT_EQ(save(small(), path("one")).error().code, ErrorCode::CannotWrite);
  EXPECT_TRUE(std::filesystem::is_symlink(path("one")));
}

TEST_F(ModelFile, SaveLeavesAloneWhatLiesBeside) {
  const std::byte kept[] = {std::byte{7}};
  const auto other = write_file("m.swl.part", kept), target = write_file("target", kept);
  std::error_code no_links_here;
  std::filesystem::create_symlink("target", path("n.swl.part"), no_links_here);
  for (const char* name : {"m.swl", "n.swl"}) {
    ASSERT_TRUE(save(small(), path(name)));
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(path(name)))) << name;
    EXPECT_EQ(must(load(path(name))).hash(), small().hash());
  }
  for (const auto& file : {other, target}) EXPECT_TRUE(std::filesystem::exists(file) && std::filesystem::file_size(file) == 1);
  EXPECT_EQ(std::filesystem::is_symlink(path("n.swl.part")), !no_links_here);
}

TEST_F(ModelFile, OfSavesAtOnceOneWinsWhole) {
  const Model models[] = {small(), nested(3)};
  const auto file = path("m.swl");
  std::vector<std::thread> threads;
  std::atomic<int> saved = 0;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) saved += bool(save(models[t % 2], file));
    });
  for (std::thread& thread : threads) thread.join();
#if defined(_WIN32)  // a file that another rename is about to replace is refused
  EXPECT_GT(saved, 0);
#else
  EXPECT_EQ(saved, 8 * 50);
#endif
  const std::uint64_t hash = must(load(file)).hash();
  EXPECT_TRUE(hash == models[0].hash() || hash == models[1].hash());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1);
}

TEST_F(ModelFile, UnwritableAndMissingPathsAreErrors) {
  const Result<std::size_t> saved = save(small(), path("no/such/folder.swl"));
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
  EXPECT_NE(saved.error().message.find("folder.swl"), std::string::npos);
  std::filesystem::create_directory(path("taken.swl"));
  write_file("taken.swl/inside", {});
  EXPECT_FALSE(save(small(), path("taken.swl")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1) << "nothing is left beside it";
  EXPECT_EQ(code_of(load(path("missing.swl"))), ErrorCode::CannotRead);
  EXPECT_EQ(code_of(load(path("taken.swl"))), ErrorCode::CannotRead);  // a directory
}

TEST_F(ModelFile, PathsMayHoldBlanksAndLettersOfAnyScript) {
  const std::string name = "Körper & Maße 小さい.swl";
  const auto file = path_of(utf8(path("")) + name);
  ASSERT_TRUE(save(small(), file));
  EXPECT_EQ(must(load(file)).hash(), small().hash());
  EXPECT_EQ(must(map(file)).hash(), small().hash());
  EXPECT_EQ(must(salvage(file)).model.hash(), small().hash());
  EXPECT_EQ(utf8(std::filesystem::directory_iterator(path(""))->path().filename()), name);
  const auto missing = path_of(utf8(path("")) + "größer.swl");
  const Error error = load(missing).error();
  EXPECT_EQ(error.file, utf8(missing));
  EXPECT_NE(error.message.find("größer.swl: "), std::string::npos);
}

#if defined(__linux__)
TEST_F(ModelFile, NamesMayBeAsLongAsFileSystemsTake) {
  for (const std::size_t bytes : {246, 255}) {
    std::string name = "小さい.swl";
    name.insert(0, bytes - name.size(), 'x');
    const auto file = path(name.c_str());
    ASSERT_TRUE(save(small(), file)) << bytes;
    EXPECT_EQ(must(load(file)).hash(), small().hash());
    std::filesystem::remove(file);
    EXPECT_TRUE(std::filesystem::is_empty(path(""))) << bytes;
  }
}

TEST_F(ModelFile, SaveKeepsTheModeOfTheFileThatItReplaces) {
  using std::filesystem::perms;
  const auto file = path("m.swl");
  ASSERT_TRUE(save(small(), file));
  for (const perms mode : {perms::owner_read | perms::owner_write, perms::owner_read | perms::group_read}) {
    std::filesystem::permissions(file, mode);
    ASSERT_TRUE(save(nested(3), file));
    EXPECT_EQ(std::filesystem::status(file).permissions(), mode);
  }
}

TEST_F(ModelFile, WhereNothingMayBeWrittenNothingIs) {  // also for root, whom a folder's own flags do not stop
  const Result<std::size_t> saved = save(small(), "/proc/m.swl");
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
}

/// A pipe would wait for who writes into it.
TEST_F(ModelFile, WhatIsNoRegularFileIsToldSo) {
  ASSERT_EQ(mkfifo(path("pipe.swl").c_str(), 0600), 0);
  std::filesystem::create_directory(path("folder.swl"));
  const auto cannot_read = [](const auto& result, const std::string& why) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::CannotRead);
    EXPECT_TRUE(result.error().message.ends_with(why)) << result.error().message;
  };
  for (const auto& [name, why] :
       {std::pair("pipe.swl", "pipe.swl: is no regular file"), std::pair("folder.swl", "folder.swl: Is a directory")}) {
    cannot_read(load(path(name)), why);
    cannot_read(map(path(name)), why);
    cannot_read(salvage(path(name)), why);
  }
}

TEST_F(ModelFile, WhatTheUserMayNotReadCannotBeRead) {
  const auto file = path("m.swl");
  ASSERT_TRUE(save(small(), file));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const uid_t user = geteuid();
  if (user == 0 && seteuid(65534) != 0) GTEST_SKIP() << "root may read all, and may be nobody else here";
  const Result<Model> loaded = load(file), mapped = map(file);
  const Result<Salvaged> salvaged = salvage(file);
  ASSERT_EQ(seteuid(user), 0);
  const auto cannot_read = [](const auto& result) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::CannotRead);
    EXPECT_NE(result.error().message.find("m.swl: Permission denied"), std::string::npos) << result.error().message;
  };
  cannot_read(loaded);
  cannot_read(mapped);
  cannot_read(salvaged);
}

TEST_F(ModelFile, AFullDiskLeavesTheOldFile) {  // or rather one that takes no larger files
  const auto file = path("m.swl");
  ASSERT_TRUE(save(small(), file));
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit limit{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const Result<std::size_t> saved = save(nested(3), file);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
  EXPECT_EQ(must(load(file)).hash(), small().hash());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1);
}
#endif

/// A file of more than 3 GB, the finest level a hole without a block on the disk.
TEST_F(ModelFile, WhatALooseToleranceNeedsOfAFileIsReadWhateverItsSize) {
  const Model m = nested(2, {false, {lut::Resolution::None, 2}});
  Bytes block = bytes_of(m);
  auto header = read<BlockHeader>(block, 0);
  auto finest = read<LevelHeader>(block, level_header_at(0));
  constexpr std::uint32_t kMore = 100'000'000;
  finest.vertex_count += kMore;
  finest.section.bytes += 32 * std::uint64_t{kMore};
  const auto after = [](const Section& s) { return (s.offset + s.bytes + 63) / 64 * 64; };
  header.table.offset = after(finest.section);
  header.source.offset = after(header.table);
  header.source.bytes += 4 * std::uint64_t{kMore};
  header.total_bytes = header.source.offset + header.source.bytes;
  block.resize(finest.section.offset);
  write(block, 0, header);
  write(block, level_header_at(0), finest);
  rehash(block);
  const auto file = write_file("large.swl", block);
  std::error_code failure;
  std::filesystem::resize_file(file, header.total_bytes, failure);
  if (failure || std::filesystem::file_size(file, failure) != header.total_bytes)
    GTEST_SKIP() << "no such files here: " << failure.message();

  const Detail coarse{.deviation = m.level(1).deviation * 2};
  EXPECT_EQ(must(load(file, coarse)).level_count(), 2);
  EXPECT_EQ(must(load(file, coarse)).finest_level(), 1);
  const Result<Model> mapped = map(file, coarse);
  if (sizeof(void*) > 4) {
    EXPECT_EQ(must(mapped).finest_level(), 1);
  } else {
    EXPECT_EQ(code_of(mapped), ErrorCode::CannotRead);
    EXPECT_EQ(code_of(load(file)), ErrorCode::TooLarge);
  }
}

TEST_F(ModelFile, EveryTruncationIsRefused) {
  const Bytes whole = bytes_of(small());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Bytes cut(whole.begin(), whole.begin() + std::ptrdiff_t(size));
    ASSERT_EQ(code_of(load(cut)), ErrorCode::BadFormat) << size;
    if (size < sizeof(BlockHeader)) continue;
    auto header = read<BlockHeader>(cut, 0);  // also when it claims to be all there is
    header.total_bytes = size;
    write(cut, 0, header);
    if (size >= level_header_at(2)) rehash(cut);
    ASSERT_EQ(code_of(load(cut)), ErrorCode::BadFormat) << size;
  }
  Bytes longer = whole;
  longer.resize(whole.size() + 64);
  EXPECT_EQ(code_of(load(longer)), ErrorCode::BadFormat);
  EXPECT_EQ(code_of(load(write_file("cut.swl", std::span(whole).first(whole.size() - 1)))), ErrorCode::BadFormat);
  EXPECT_EQ(code_of(load(write_file("empty.swl", {}))), ErrorCode::BadFormat);
  EXPECT_EQ(code_of(map(path("empty.swl"))), ErrorCode::BadFormat);
}

TEST_F(ModelFile, ForeignFilesAreNamedSo) {
  Bytes text(1000, std::byte{'a'});
  const Result<Model> foreign = load(write_file("text.swl", text));
  ASSERT_FALSE(foreign);
  EXPECT_EQ(foreign.error().code, ErrorCode::BadFormat);
  EXPECT_NE(foreign.error().message.find("text.swl"), std::string::npos);
  EXPECT_NE(foreign.error().message.find("not a swiftlet model"), std::string::npos);
  Bytes newer = bytes_of(small());
  write(newer, offsetof(BlockHeader, version), kModelFileVersion + 1);
  rehash(newer);
  EXPECT_EQ(code_of(load(newer)), ErrorCode::BadVersion);
  Bytes older = bytes_of(small());  // refused before anything else of it is read: the layout was another
  write(older, offsetof(BlockHeader, version), 3u);
  const Result<Model> old = load(write_file("old.swl", older));
  EXPECT_EQ(code_of(old), ErrorCode::BadVersion);
  for (const char* part : {"old.swl", "model version 3", "reads version 6", "`swiftlet build MESH -o MODEL`"})
    EXPECT_NE(old.error().message.find(part), std::string::npos) << old.error().message;
  Bytes as_text = bytes_of(small());  // what a transfer that rewrites line ends does
  as_text.erase(as_text.begin() + 4);
  EXPECT_EQ(code_of(load(as_text)), ErrorCode::BadFormat);
}

// ---- Hostile ---------------------------------------------------------------------------------------------------------------

TEST_F(ModelFile, HugeCountsAreRefused) {
  const Bytes whole = bytes_of(small());
  for (std::size_t level = 0; level < 2; ++level) {
    for (const std::size_t field : {offsetof(LevelHeader, vertex_count), offsetof(LevelHeader, half_edge_count),
                                    offsetof(LevelHeader, face_count), offsetof(LevelHeader, plane_count)}) {
      for (const std::uint32_t count : {0u, 1u, 0x3fffffffu, 0x40000000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        Bytes block = whole;
        if (read<std::uint32_t>(block, level_header_at(level) + field) == count) continue;
        write(block, level_header_at(level) + field, count);
        rehash(block);
        EXPECT_EQ(code_of(load(block)), ErrorCode::BadFormat) << level << ' ' << field << ' ' << count;
      }
    }
    for (const std::uint64_t value : {std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{63}, std::uint64_t{1} << 63}) {
      for (const std::size_t field : {offsetof(Section, offset), offsetof(Section, bytes)}) {
        Bytes block = whole;
        write(block, level_header_at(level) + field, value);
        rehash(block);
        EXPECT_EQ(code_of(load(block)), ErrorCode::BadFormat);
      }
    }
  }
  for (const std::uint32_t count : {0u, 33u, 0xffffffffu}) {
    Bytes block = whole;
    write(block, offsetof(BlockHeader, level_count), count);
    if (count == 0) rehash(block);
    EXPECT_EQ(code_of(load(block)), ErrorCode::BadFormat) << count;
  }
  // A header that promises more than there is: refused before it is believed, also from a file.
  Bytes promise = whole;
  write(promise, offsetof(BlockHeader, total_bytes), std::uint64_t{1} << 50);
  EXPECT_EQ(code_of(load(write_file("promise.swl", promise))), ErrorCode::BadFormat);
}

TEST_F(ModelFile, BoundsThatAreNoLengthsAreRefused) {
  const Bytes whole = bytes_of(small());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto refused = [&whole](std::size_t at, auto value) {
    Bytes block = whole;
    write(block, at, value);
    rehash(block);
    return !load(block) && load(block).error().code == ErrorCode::BadFormat;
  };
  const auto section = read<LevelHeader>(whole, level_header_at(1)).section;
  const std::size_t plane = std::size_t(section.offset) + 8 * sizeof(Vertex);  // of the cube's first face
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, -1.0, -0x1p-1074}) {
    for (std::size_t level = 0; level < 2; ++level)
      EXPECT_TRUE(refused(level_header_at(level) + offsetof(LevelHeader, reach), bad)) << bad;
    EXPECT_TRUE(refused(plane + offsetof(FacePlane, over), bad)) << bad;
    EXPECT_TRUE(refused(plane + offsetof(FacePlane, thickness), bad)) << bad;
  }
  for (const double good : {0.0, 0x1p-1074, 1e30}) {
    EXPECT_FALSE(refused(level_header_at(0) + offsetof(LevelHeader, reach), good));
    EXPECT_FALSE(refused(plane + offsetof(FacePlane, over), good));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t at = plane + 8 * axis;
    if (read<double>(whole, at) != 0) continue;
    EXPECT_TRUE(refused(at, 0x1p-501)) << "heights along it would underflow";
    EXPECT_FALSE(refused(at, 0x1p-500));
  }
  for (const float bad : {0.0f, -1.0f, 17.0f, float(kInfinity), std::nanf("")})
    EXPECT_TRUE(refused(level_header_at(1) + offsetof(LevelHeader, map_frame), bad)) << bad;
  EXPECT_TRUE(refused(level_header_at(1) + offsetof(LevelHeader, rims), 1u)) << "small faces are no rims";
}

/// Every query from several poses and seeds, cold and garbage. What a hostile model may cost is bounded, what it answers is an
/// interval.
struct Work {
  std::uint32_t steps = 0, plane_tests = 0;
};
void exercise(const Model& hostile, const Model& honest, Work& most) {
  const Pose poses[] = {{}, {rotation(1, 2, 3, 4), Vec3(2.5, 1, 0.25)}, {Mat3::Identity(), Vec3(2, 0, 0)}};
  const auto expect_harmless = [&most](const Answer& answer) {
    most.steps = std::max(most.steps, answer.steps);
    most.plane_tests = std::max(most.plane_tests, answer.plane_tests);
    ASSERT_LE(answer.lower, answer.upper);
    ASSERT_GE(answer.lower, 0);
  };
  std::uint32_t garbage = 12345;
  const auto feature = [&garbage] {
    garbage = garbage * 1664525 + 1013904223;
    return FeatureId(FeatureKind(garbage >> 30), (garbage >> 8) % 29);
  };
  for (const Pose& pose : poses) {
    PairSeed seed;
    expect_harmless(distance(hostile, honest, pose, seed));
    expect_harmless(distance(honest, hostile, pose, seed));
    seed.a = feature(), seed.b = feature();
    seed.level_a = std::uint8_t(garbage % 3);
    seed.level_b = std::uint8_t(garbage % 5);
    expect_harmless(intersects(hostile, hostile, pose, seed));
    expect_harmless(within(hostile, honest, pose, 0.5, seed, {.tuning = {.start = StartPolicy::Table}}).answer);
    expect_harmless(closest_features(hostile, hostile, pose, seed, {.tuning = {.start = StartPolicy::Paper}}).answer);
  }
  hostile.support(Vec3(1, 2, 3));
  verify(hostile);
  const Model cut = hostile.cut({std::numeric_limits<double>::infinity()});
  expect_harmless(distance(cut, honest, poses[1]));
}

/// The work that a small honest pair can cost at all, certified GJK through both arithmetics at every level included.
constexpr std::uint32_t kMostSteps = 60, kMostPlaneTests = 2000;

TEST_F(ModelFile, EveryCorruptByteIsFoundByTheHashes) {
  const Bytes whole = bytes_of(small());
  std::mt19937 engine(1);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Bytes block = whole;
    for (int bit = 0; bit < 8; ++bit) {
      block[at] = whole[at] ^ std::byte(1 << bit);
      ASSERT_FALSE(load(block)) << at << ' ' << bit;
    }
    for (int i = 0; i < 8; ++i) {
      block[at] = whole[at] ^ std::byte(1 + engine() % 255);
      ASSERT_FALSE(load(block)) << at;
    }
  }
}

TEST_F(ModelFile, EveryCorruptByteWithRightHashesIsRefusedOrHarmless) {
  const Model honest = small();
  const Bytes whole = bytes_of(honest);
  std::mt19937 engine(2);
  int refused = 0, accepted = 0;
  Work most;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int i = 0; i < 9; ++i) {  // each bit, and another value
      Bytes block = whole;
      block[at] = whole[at] ^ (i < 8 ? std::byte(1 << i) : std::byte(1 + engine() % 255));
      rehash(block);
      const Result<Model> m = load(block);
      ++(m ? accepted : refused);
      if (m) exercise(m.value(), honest, most);
      if (HasFatalFailure()) FAIL() << "byte " << at << " as " << int(block[at]);
    }
  }
  EXPECT_GE(refused, 5000);
  EXPECT_GE(accepted, 4000);
  EXPECT_LE(most.steps, kMostSteps);
  EXPECT_LE(most.plane_tests, kMostPlaneTests);
  RecordProperty("most_steps", int(most.steps));
  RecordProperty("most_plane_tests", int(most.plane_tests));
  std::printf("refused %d, accepted %d, at most %u steps and %u plane tests\n", refused, accepted, most.steps,
              most.plane_tests);
}

TEST_F(ModelFile, RandomWordsWithRightHashesAreRefusedOrHarmless) {
  // Several words at once: indices swapped for others in range, coordinates for other doubles.
  const Model honest = small();
  const Bytes whole = bytes_of(honest);
  std::mt19937 engine(3);
  int accepted = 0;
  Work most;
  for (int i = 0; i < 12000; ++i) {
    Bytes block = whole;
    for (int k = int(engine() % 3); k >= 0; --k) {
      const std::size_t word = level_header_at(0) / 4 + engine() % ((whole.size() - level_header_at(0)) / 4);
      write(block, word * 4, read<std::uint32_t>(whole, 4 * (word - engine() % 8)));
    }
    rehash(block);
    const Result<Model> m = load(block);
    if (!m) continue;
    ++accepted;
    exercise(m.value(), honest, most);
    if (HasFatalFailure()) FAIL() << "round " << i;
  }
  EXPECT_GE(accepted, 1000);
  EXPECT_LE(most.steps, kMostSteps);
  EXPECT_LE(most.plane_tests, kMostPlaneTests);
}

TEST_F(ModelFile, CoordinatesBeyondExactArithmeticAreRefused) {
  // Signs of products of three such coordinates are not exact any more, and a climb on them need not end.
  for (const double scale : {1e50, 1e300, 1e-50, 1e-300}) {
    Bytes block = bytes_of(small());
    for (std::size_t level = 0; level < 2; ++level) {
      auto header = read<LevelHeader>(block, level_header_at(level));
      header.extent *= scale;
      write(block, level_header_at(level), header);
      for (std::size_t v = 0; v < header.vertex_count; ++v) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = std::size_t(header.section.offset) + v * sizeof(Vertex) + c * 8;
          write(block, at, scale * read<double>(block, at));
        }
      }
    }
    rehash(block);
    EXPECT_EQ(code_of(load(block)), ErrorCode::BadFormat) << scale;
  }
}

}  // namespace
}  // namespace swiftlet
