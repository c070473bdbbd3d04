// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// No more than a scene needs: levels cut away, not read, not touched, lost with a file's end, and added later. What is left
// answers truly, and as a whole model that is forbidden the same levels.
#if defined(__unix__) && !defined(__EMSCRIPTEN__)
#define SWIFTLET_TEST_PROCESSES 1  // the system has them, and protects pages
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <swiftlet/check.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "answers.h"
#include "bodies.h"
#include "folder.h"

namespace swiftlet {
namespace {

using namespace bodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class DetailTest : public FolderTest {
 protected:
  std::filesystem::path saved(const Model& m, const char* name = "m.swl") const {
    must(save(m, path(name)));
    return path(name);
  }
};

std::vector<Model> all_models() { return answers::models(SWIFTLET_TEST_DIR "/data/models"); }

/// What asks for `level` of a model and no finer one.
Detail down_to(const Model& m, int level) { return {std::nextafter(m.level(level).deviation, kInfinity)}; }
Model cut_at(const Model& m, int level) { return m.cut(down_to(m, level)); }

std::uint64_t end_of_level(const Model& m, std::size_t level) {
  const auto section = read<LevelHeader>(bytes_of(m), level_header_at(level)).section;
  return section.offset + section.bytes;
}

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

std::uint64_t print_of(const Model& a, const Model& b, const Options& options = {}, int rounds = 40) {
  answers::Fingerprint print;
  const Effort effort{options.budget, options.tuning};
  answers::Poses poses(7);
  PairSeed warm, tested, near;
  for (int i = 0; i < rounds; ++i) {
    const Pose pose = poses.next();
    PairSeed cold, garbage = poses.seed();
    for (PairSeed* seed : {&warm, &cold, &garbage}) print.add(distance(a, b, pose, *seed, options));
    print.add(intersects(a, b, pose, tested, effort));
    print.add(within(a, b, pose, 0.5, near, effort).answer);
  }
  return print.hash;
}

TEST_F(DetailTest, ACutModelHoldsTheLevelsAskedFor) {
  int cuts = 0;
  for (const Model& m : all_models()) {
    EXPECT_EQ(m.cut({}).bytes().data(), m.bytes().data()) << "a whole model is not copied";
    for (int k = 1; k < m.level_count(); ++k, ++cuts) {
      const Model cut = cut_at(m, k);
      ASSERT_EQ(cut.finest_level(), k);
      ASSERT_EQ(cut.level_count(), m.level_count());
      EXPECT_LT(cut.bytes().size(), m.bytes().size());
      EXPECT_NE(cut.hash(), m.hash());
      EXPECT_EQ(cut.centre(), m.centre());
      EXPECT_EQ(cut.radius(), m.radius());
      EXPECT_EQ(cut.volume(), m.volume());
      EXPECT_EQ(cut.extent(), m.extent());
      EXPECT_TRUE(cut.source().vertex.empty() && cut.table().empty());
      EXPECT_GE(cut.map_level(), k);
      EXPECT_LT(cut.support(Vec3(1, 2, 3)), m.level(k).view.vertices.size());
      for (int i = 0; i < m.level_count(); ++i) {
        const Level &of_cut = cut.level(i), &whole = m.level(i);
        EXPECT_EQ(of_cut.deviation, whole.deviation);
        EXPECT_EQ(of_cut.triangle_count, whole.triangle_count);
        EXPECT_EQ(of_cut.bytes, whole.bytes);
        EXPECT_EQ(of_cut.view.reach, whole.view.reach);
        if (i < k) {
          EXPECT_TRUE(of_cut.view.vertices.empty() && of_cut.support_map.empty());
          continue;
        }
        EXPECT_TRUE(same(of_cut.view.vertices, whole.view.vertices));
        EXPECT_TRUE(same(of_cut.view.planes, whole.view.planes));
        EXPECT_TRUE(same_elements(of_cut.view.half_edges, whole.view.half_edges));
        EXPECT_TRUE(same(of_cut.child_vertex, whole.child_vertex));
        EXPECT_TRUE(same(of_cut.parent_face, whole.parent_face));
        EXPECT_TRUE(same(of_cut.support_map, whole.support_map));
      }
      EXPECT_EQ(cut.cut({}).hash(), cut.hash());
      EXPECT_EQ(cut.with_table(m.table_spec()).value().finest_level(), k);
      EXPECT_FALSE(verify(cut)) << "nothing proves that the others enclose level 0";
    }
  }
  EXPECT_GE(cuts, 6);
}

TEST_F(DetailTest, CutAtBuildLoadMapAndSaveIsTheSameModel) {
  for (const Model& m : all_models()) {
    const auto file = saved(m);
    for (int k = 0; k < m.level_count(); ++k) {
      const Model cut = cut_at(m, k);
      const Detail by_deviation = down_to(m, k), by_bytes{0, k == 0 ? m.bytes().size() : end_of_level(m, std::size_t(k))};
      for (const Detail& detail : {by_deviation, by_bytes}) {
        EXPECT_EQ(m.cut(detail).hash(), cut.hash());
        EXPECT_EQ(must(load(file, detail)).hash(), cut.hash());
        EXPECT_EQ(must(load(m.bytes(), detail)).hash(), cut.hash());
        const Model mapped = must(map(file, detail));
        EXPECT_EQ(mapped.finest_level(), k);
        EXPECT_EQ(mapped.cut(detail).hash(), cut.hash());
      }
      EXPECT_EQ(must(load(saved(cut, "cut.swl"))).hash(), cut.hash());
      EXPECT_EQ(must(map(path("cut.swl"))).finest_level(), k);
      EXPECT_EQ(m.level(k).prefix, by_bytes.bytes) << "of level 0 the table and the source map count too";
      EXPECT_EQ(cut.level(k).prefix, cut.bytes().size());
      EXPECT_EQ(m.cut({0, by_bytes.bytes - 1}).finest_level(), std::min(k + 1, m.level_count() - 1));
    }
    EXPECT_EQ(m.cut({0, 0}).finest_level(), m.level_count() - 1) << "the coarsest always comes along";
    EXPECT_EQ(m.cut({kInfinity}).finest_level(), m.level_count() - 1);
    EXPECT_EQ(m.cut({std::nan("")}).finest_level(), 0);
  }
}

TEST_F(DetailTest, AnAbsentLevelIsAsOneForbidden) {
  const std::vector<Model> models = all_models();
  int compared = 0;
  for (const Model& a : models) {
    for (const Model& b : models) {
      for (int k = 1; k < std::min(a.level_count(), b.level_count()); ++k) {
        const Model cut_a = cut_at(a, k), cut_b = cut_at(b, k);
        for (const StartPolicy start :
             {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest, StartPolicy::Table}) {
          for (const Refinement refinement : {Refinement::Single, Refinement::SingleSingle, Refinement::DoubleDouble}) {
            Options options{.tuning = {.start = start, .refinement = refinement}};
            const std::uint64_t found = print_of(cut_a, cut_b, options, 10);
            options.budget.finest_level = k;
            ASSERT_EQ(found, print_of(a, b, options, 10)) << k << ' ' << int(start) << ' ' << int(refinement);
            ++compared;
          }
        }
      }
    }
  }
  EXPECT_GE(compared, 300);
}

TEST_F(DetailTest, WhateverIsAbsentTheIntervalIsTrueAndTheStatusSaysWhatLacked) {
  const std::vector<Model> models = all_models();
  answers::Poses poses(3);
  int limited = 0, converged = 0, disjoint = 0;
  for (const Model& a : models) {
    for (const Model& b : models) {
      for (int i = 0; i < 60; ++i) {
        const Pose pose = poses.next();
        const Model cut_a = cut_at(a, i % a.level_count()), cut_b = cut_at(b, i / 3 % b.level_count());
        PairSeed exact, cold;
        const Answer truth = distance(a, b, pose, exact);
        const Options options{.relative = i % 4 == 0 ? 0 : std::pow(10, -(i % 4))};
        const Answer answer = distance(cut_a, cut_b, pose, i % 2 == 0 ? cold : exact, options);
        ASSERT_LE(answer.lower, truth.upper);
        ASSERT_GE(answer.upper, truth.lower);
        ASSERT_GE(answer.level_a, cut_a.finest_level());
        ASSERT_GE(answer.level_b, cut_b.finest_level());
        const Check whole = check(a, b, pose, answer), itself = check(cut_a, cut_b, pose, answer);
        ASSERT_TRUE(whole) << whole.message;
        ASSERT_TRUE(itself) << itself.message;
        const bool levels = cut_a.finest_level() > 0 || cut_b.finest_level() > 0;
        const bool narrow = answer.upper - answer.lower <= options.relative * answer.lower;
        if (answer.status == Status::LevelLimit) {
          ASSERT_TRUE(levels && !narrow);
        }
        if (levels && answer.status == Status::Converged) {
          ASSERT_TRUE(narrow);
        }
        (answer.status == Status::LevelLimit ? limited : converged) += 1;
        const Answer meeting = intersects(cut_a, cut_b, pose);
        if (levels) {
          ASSERT_NE(meeting.verdict, Verdict::Overlapping) << "enclosing levels prove no overlap";
        }
        if (meeting.verdict == Verdict::Disjoint) {
          ASSERT_EQ(truth.verdict, Verdict::Disjoint);
        }
        disjoint += meeting.verdict == Verdict::Disjoint && levels;
        Answer bold = answer;
        bold.lower = truth.upper + 1e-9 * (1 + truth.upper), bold.upper = std::max(bold.upper, bold.lower);
        if (answer.lower > 0) {
          ASSERT_FALSE(check(cut_a, cut_b, pose, bold)) << "a bound above the truth passed the check";
        }
      }
    }
  }
  EXPECT_GE(limited, 300);
  EXPECT_GE(converged, 200);
  EXPECT_GE(disjoint, 300);
}

TEST_F(DetailTest, LevelsAddedLaterAnswerAsIfTheyHadBeenThereAndSeedsFit) {
  const std::vector<Model> models = all_models();
  for (const Model& m : models) {
    const auto file = saved(m);
    const int coarsest = m.level_count() - 1;
    Model grown = must(map(file, down_to(m, coarsest)));
    const Model before = grown;
    answers::Poses poses(5);
    PairSeed seed, whole_seed;
    for (int k = coarsest; k >= 0; --k) {
      ASSERT_EQ(must(grown.ensure(k)), k);
      ASSERT_EQ(must(grown.ensure(coarsest)), k) << "levels stay";
      const Options options{.budget = {.finest_level = k}};
      for (int i = 0; i < 30; ++i) {
        const Pose pose = poses.next();
        answers::Fingerprint ours, whole;
        ours.add(distance(grown, grown, pose, seed));
        whole.add(distance(m, m, pose, whole_seed, options));
        ASSERT_EQ(ours.hash, whole.hash);
      }
    }
    EXPECT_EQ(before.finest_level(), coarsest) << "copies stay as they were";
    EXPECT_EQ(before.bytes().data(), grown.bytes().data()) << "and share the pages";
    EXPECT_EQ(grown.hash(), m.hash());
    EXPECT_TRUE(same(grown.source().face, m.source().face));
    EXPECT_TRUE(verify(grown));
    Model cut = cut_at(m, coarsest);
    const Result<int> lacking = cut.ensure(0);
    if (coarsest == 0) continue;
    ASSERT_FALSE(lacking);
    EXPECT_EQ(lacking.error().code, ErrorCode::BadValue);
    EXPECT_EQ(cut.finest_level(), coarsest);
    for (const int level : {-1, m.level_count()}) EXPECT_EQ(grown.ensure(level).error().code, ErrorCode::BadValue) << level;
  }
}

TEST_F(DetailTest, ADamagedLevelIsFoundWhenItIsWantedAndNotBefore) {
  const Model m = nested(3);
  for (std::size_t level = 0; level < 2; ++level) {
    Bytes block = bytes_of(m);
    block[end_of_level(m, level) - 1] ^= std::byte{1};
    const auto file = write_file("damaged.swl", block);
    EXPECT_EQ(load(file).error().code, ErrorCode::BadFormat);
    EXPECT_EQ(map(file).error().code, ErrorCode::BadFormat);
    const int sound = int(level) + 1;
    EXPECT_EQ(must(load(file, down_to(m, sound))).hash(), cut_at(m, sound).hash());
    Model mapped = must(map(file, down_to(m, sound)));
    const std::uint64_t print = print_of(mapped, mapped);
    const Result<int> wanted = mapped.ensure(int(level));
    ASSERT_FALSE(wanted);
    EXPECT_EQ(wanted.error().code, ErrorCode::BadFormat);
    EXPECT_NE(wanted.error().message.find("level " + std::to_string(level)), std::string::npos) << wanted.error().message;
    EXPECT_EQ(mapped.finest_level(), sound);
    EXPECT_EQ(print_of(mapped, mapped), print);
  }
}

#ifdef SWIFTLET_TEST_PROCESSES
/// A block in pages of its own, those that hold nothing but levels finer than `finest` out of bounds: whoever reads there dies.
class GuardedBlock {
 public:
  GuardedBlock(const Model& m, int finest) : size_(m.bytes().size()) {
    const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
    void* const pages = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<std::byte*>(pages);
    std::memcpy(data_, m.bytes().data(), size_);
    const std::uint64_t first = (end_of_level(m, std::size_t(finest)) + page - 1) / page * page;
    guarded = first < size_ ? (size_ - first + page - 1) / page : 0;
    if (guarded > 0 && mprotect(data_ + first, size_ - first, PROT_NONE) != 0) throw std::bad_alloc();
  }
  Block block() {
    return {{data_, [size = size_](const std::byte* p) { munmap(const_cast<std::byte*>(p), size); }}, {data_, size_}};
  }
  std::uint64_t guarded = 0;

 private:
  std::size_t size_;
  std::byte* data_;
};

TEST_F(DetailTest, PagesOfFinerLevelsAreNeverRead) {
  std::uint64_t guarded = 0;
  for (const Model& m : all_models()) {
    for (int k = 1; k < m.level_count(); ++k) {
      GuardedBlock memory(m, k);
      guarded += memory.guarded;
      const Model opened = must(BlockReader::read(memory.block(), k));
      const Model cut = cut_at(m, k);
      EXPECT_EQ(print_of(opened, opened), print_of(cut, cut));
      EXPECT_EQ(opened.cut({}).hash(), cut.hash());
      EXPECT_EQ(opened.with_table(m.table_spec()).value().hash(), cut.with_table(m.table_spec()).value().hash());
    }
  }
  EXPECT_GE(guarded, 20u);
}

TEST_F(DetailTest, ProcessesThatMapOneFileGiveTheSameAnswers) {
  const Model m = all_models().front();
  const auto file = saved(m);
  const Model mapped = must(map(file)), again = must(map(file));
  const std::uint64_t wanted = print_of(m, m);
  EXPECT_EQ(print_of(mapped, again), wanted);
  EXPECT_EQ(mapped.hash(), m.hash());
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const Result<Model> own = map(file);
    const std::uint64_t found = own ? print_of(own.value(), mapped) : 0;
    _exit(::write(pipe_ends[1], &found, sizeof found) == sizeof found ? 0 : 1);
  }
  std::uint64_t found = 0;
  ASSERT_EQ(::read(pipe_ends[0], &found, sizeof found), ssize_t(sizeof found));
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(found, wanted);
  std::filesystem::remove(file);  // the pages stay as long as the model
  EXPECT_EQ(print_of(mapped, again), wanted);
}

#endif

TEST_F(DetailTest, WhatCannotBeMappedIsAnError) {
  EXPECT_EQ(map(path("missing.swl")).error().code, ErrorCode::CannotRead);
  EXPECT_EQ(map(write_file("empty.swl", {})).error().code, ErrorCode::BadFormat);
  EXPECT_EQ(map(path("")).error().code, ErrorCode::CannotRead);  // a directory
  const Bytes whole = bytes_of(nested(2));
  EXPECT_EQ(map(write_file("cut.swl", std::span(whole).first(whole.size() - 1))).error().code, ErrorCode::BadFormat);
  EXPECT_EQ(map(write_file("text.swl", Bytes(1000, std::byte{'a'}))).error().code, ErrorCode::BadFormat);
}

TEST_F(DetailTest, AFileCutShortAnywhereGivesItsCompleteLevelsOrFails) {
  const Model m = nested(3, {false, {lut::Resolution::Degrees22, 2, 4}});
  const auto file = saved(m);
  const Salvaged whole = must(salvage(file));
  EXPECT_EQ(whole.model.hash(), m.hash());
  EXPECT_EQ(whole.note, "");
  std::uint64_t hashes[3];
  for (int k = 0; k < 3; ++k) hashes[k] = cut_at(m, k).hash();
  int saved_levels[3] = {0, 0, 0}, refused = 0;
  for (std::uint64_t size = m.bytes().size(); size-- > 0;) {
    std::filesystem::resize_file(file, size);
    ASSERT_FALSE(load(file)) << size;
    ASSERT_FALSE(load(file, {kInfinity})) << "not asked to salvage: " << size;
    if (size > 0) {
      ASSERT_EQ(map(file, {kInfinity}).error().code, ErrorCode::BadFormat) << size;
    }
    const Result<Salvaged> left = salvage(file);
    if (size < end_of_level(m, 2)) {
      ASSERT_FALSE(left) << size;
      ASSERT_EQ(left.error().code, ErrorCode::BadFormat);
      ++refused;
      continue;
    }
    ASSERT_TRUE(left) << size << ' ' << left.error().message;
    const int expected = size >= end_of_level(m, 1) ? 1 : 2;  // level 0 is complete only with table and source map
    ASSERT_EQ(left.value().model.finest_level(), expected) << size;
    ASSERT_EQ(left.value().model.hash(), hashes[expected]) << size;
    ASSERT_NE(left.value().note.find("finer than " + std::to_string(expected)), std::string::npos) << left.value().note;
    ++saved_levels[expected];
  }
  EXPECT_GE(saved_levels[1], 500);
  EXPECT_GE(saved_levels[2], 500);
  EXPECT_GE(refused, 500);
  Bytes longer = bytes_of(m);
  longer.resize(longer.size() + 1);
  EXPECT_EQ(salvage(write_file("longer.swl", longer)).error().code, ErrorCode::BadFormat);
}

TEST_F(DetailTest, CorruptCutModelsAreFoundByHashesOrHarmless) {
  const Model honest = nested(2);
  const Bytes whole = bytes_of(cut_at(nested(3, {false, {lut::Resolution::None, 2, 2}}), 1));
  std::mt19937 engine(4);
  int refused = 0, accepted = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int i = 0; i < 10; ++i) {
      Bytes block = whole;
      block[at] = whole[at] ^ (i < 8 ? std::byte(1 << i) : std::byte(1 + engine() % 255));
      ASSERT_FALSE(load(block)) << at;
      rehash(block);
      const Result<Model> m = load(block);
      ++(m ? accepted : refused);
      if (!m) continue;
      PairSeed seed;
      for (const Pose& pose : {Pose{}, Pose{rotation(1, 2, 3, 4), Vec3(2.5, 1, 0.25)}}) {
        const Answer answer = distance(m.value(), honest, pose, seed);
        ASSERT_LE(answer.lower, answer.upper);
        ASSERT_LE(intersects(honest, m.value(), pose, seed).steps, 60u);
      }
      m.value().support(Vec3(1, 2, 3));
      (void)m.value().with_table({lut::Resolution::Degrees22, 2, 4});
    }
  }
  EXPECT_GE(refused, 2000);
  EXPECT_GE(accepted, 2000);
}

/// Maps of level 0 are read without that level: an error smaller than theirs is not asked as an exact distance, which coarser
/// levels do not answer.
TEST_F(DetailTest, ErrorsSmallerThanThoseOfMapsAreMetWithoutLevelZero) {
  const bodies::Polyhedron box = bodies::box(1, 1, 1), around = bodies::box(1.00001, 1.00001, 1.00001);
  const LevelArrays levels[] = {box.level(), around.level()};
  const Model whole = must(Model::from_levels(levels)), mapped = must(map(saved(whole), down_to(whole, 1)));
  ASSERT_EQ(mapped.finest_level(), 1);
  ASSERT_GT(mapped.level(0).map_doubt, 3 * mapped.level(1).deviation);
  answers::Poses poses(9);
  for (int i = 0; i < 100; ++i) {
    const Answer answer = distance(mapped, whole, poses.next(), {.absolute = 3 * mapped.level(1).deviation});
    if (answer.verdict == Verdict::Disjoint) {
      EXPECT_EQ(answer.status, Status::Converged);
    }
  }
}

}  // namespace
}  // namespace swiftlet
