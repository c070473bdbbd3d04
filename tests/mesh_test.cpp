// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes: what is made of triangles, their files, and the laws that their queries keep. Truth is brute force over all pairs of
// triangles in long doubles (soups.h); mesh_exact_test.cpp has exact truth.
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_front.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/mesh_visit.h>

#if defined(__linux__)
#include <sys/stat.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <swiftlet/model_file.h>

#include "counted_allocations.h"
#include "folder.h"
#include "forgeries.h"
#include "mesh_blocks.h"
#include "numeric/width.h"
#include "soups.h"
#include "upper_halves.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

// ---- Making a mesh ---------------------------------------------------------------------------------------------------------

Soup reversed(Soup soup) {
  for (Corners& c : soup.triangles) std::swap(c[1], c[2]);
  return soup;
}
/// Each triangle with points of its own.
Soup unjoined(const Soup& soup) {
  Soup apart;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) apart.add(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2));
  return apart;
}
Soup together(std::initializer_list<Soup> soups) {
  Soup all;
  for (const Soup& soup : soups) all.add(soup);
  return all;
}
Soup unit_box(double x = 0, double y = 0, double z = 0) { return box({x, y, z}, {x + 1, y + 1, z + 1}); }

TEST(Mesh, OfClosedSurfacesKnowsTheirVolume) {
  for (const Soup& soup : {unit_box(), unjoined(unit_box()), ball(2), torus(8, 5), tetrahedron()}) {
    const MeshTopology t = soup.mesh().topology();
    EXPECT_TRUE(t.closed());
    EXPECT_EQ(t.components, 1u);
    EXPECT_EQ(t.open_edges + t.non_manifold_edges + t.flipped_edges + t.flat_triangles + t.duplicates, 0u);
    EXPECT_GT(t.volume, 0);
    const MeshTopology inside_out = reversed(soup).mesh().topology();
    EXPECT_TRUE(inside_out.closed());
    EXPECT_NEAR(inside_out.volume, -t.volume, 1e-15);
  }
  EXPECT_NEAR(unit_box(5, 6, 7).mesh().topology().volume, 1, 1e-13);
  EXPECT_NEAR(tetrahedron().mesh().topology().volume, 8.0 / 3, 1e-15);
  EXPECT_EQ(together({unit_box(), unit_box(3)}).mesh().topology().components, 2u);
  EXPECT_NEAR(together({unit_box(), unit_box(3)}).mesh().topology().volume, 2, 1e-14);
}

/// Far from the origin, too, as made and as refitted: held against long doubles, summed from the middle of the vertices.
TEST(Mesh, OfClosedSurfacesKnowsTheirVolumeFarAway) {
  for (const double away : {0.0, 1e3, 1e5, 1e6, 1e8}) {
    for (const Soup& shape : {scaled(ball(3), 0.1), reversed(scaled(torus(12, 8), 0.5)), box({0, 0, 0}, {1, 2, 0.5})}) {
      const Soup soup = moved(shape, Mat3::Identity(), away * Vec3(1, -1, 0.75));
      Eigen::Matrix<long double, 3, 1> middle = Eigen::Matrix<long double, 3, 1>::Zero();
      for (const Vec3& p : soup.points) middle += p.cast<long double>() / soup.points.size();
      long double truth = 0;
      for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const auto at = [&](std::size_t k) { return (soup.corner(t, k).cast<long double>() - middle).eval(); };
        truth += at(0).dot(at(1).cross(at(2))) / 6;
      }
      const MeshModel mesh = soup.mesh();
      EXPECT_NEAR(mesh.topology().volume, double(truth), 1e-13) << away;
      EXPECT_NEAR(refit(shape.mesh(), soup.points).value().topology().volume, double(truth), 1e-13) << away;
    }
  }
}

TEST(Mesh, CountsWhatIsNotClosed) {
  Soup open = unit_box();
  open.triangles.pop_back();
  EXPECT_EQ(open.mesh().topology().open_edges, 3u);
  EXPECT_FALSE(open.mesh().topology().closed());
  EXPECT_EQ(open.mesh().topology().volume, 0);
  EXPECT_EQ(patch(4, [](double, double) { return 0.0; }).mesh().topology().open_edges, 16u);

  Soup flipped = unit_box();
  std::swap(flipped.triangles[4][0], flipped.triangles[4][1]);
  EXPECT_EQ(flipped.mesh().topology().flipped_edges, 3u);
  EXPECT_FALSE(flipped.mesh().topology().closed());

  const Soup fan{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  EXPECT_EQ(fan.mesh().topology().non_manifold_edges, 1u);
  EXPECT_EQ(fan.mesh().topology().open_edges, 6u);
  EXPECT_EQ(fan.mesh().topology().components, 1u);

  // Boxes that share an edge have four triangles there; a shared vertex joins nothing.
  EXPECT_EQ(together({unit_box(), unit_box(1, 1)}).mesh().topology().non_manifold_edges, 1u);
  EXPECT_EQ(together({unit_box(), unit_box(1, 1)}).mesh().topology().components, 1u);
  EXPECT_EQ(together({unit_box(), unit_box(1, 1, 1)}).mesh().topology().components, 2u);
  EXPECT_TRUE(together({unit_box(), unit_box(1, 1, 1)}).mesh().topology().closed());

  const Soup twice{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}}};
  EXPECT_EQ(twice.mesh().topology().duplicates, 2u);

  const Soup flat{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {2, 2, std::nextafter(2, 3)}, {3, 3, 3}},
                  {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {1, 1, 1}, {4, 0, 1}}};
  EXPECT_EQ(flat.mesh().topology().flat_triangles, 4u) << "all but the one that is off its line by an ulp";
}

TEST(Mesh, WeldsEqualPointsAndKeepsTheUsersIds) {
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    Soup soup = i % 2 ? unjoined(any(random)) : any(random);
    soup.points.emplace_back(77, 78, 79);  // of no triangle
    for (Vec3& p : soup.points)
      for (double& x : p) x = x == 0 && random.bits() % 2 ? -0.0 : x;
    const MeshModel mesh = soup.mesh();
    ASSERT_EQ(mesh.triangle_count(), soup.triangles.size());
    std::map<std::array<double, 3>, std::uint32_t> first;  // the user's first point at each place
    std::set<std::uint32_t> used;
    for (const Corners& c : soup.triangles) used.insert(c.begin(), c.end());
    std::vector<std::uint32_t> in_order;  // as triangles name them
    for (const Corners& c : soup.triangles)
      for (const std::uint32_t v : c)
        first.emplace(std::array{soup.points[v].x() + 0.0, soup.points[v].y() + 0.0, soup.points[v].z() + 0.0}, v);
    ASSERT_EQ(mesh.vertex_count(), first.size());
    ASSERT_EQ(mesh.source_vertex().size(), mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 p = mesh.vertex(v);
      const auto found = first.find({p.x(), p.y(), p.z()});
      ASSERT_NE(found, first.end());
      ASSERT_EQ(mesh.source_vertex()[v], found->second);
      for (const double x : p) ASSERT_FALSE(x == 0 && std::signbit(x));
    }
    std::vector<std::uint32_t> source(mesh.source_triangle().begin(), mesh.source_triangle().end());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(mesh.vertex(mesh.triangle(t)[k]), soup.corner(source[t], k));
    }
    std::sort(source.begin(), source.end());
    for (std::uint32_t t = 0; t < source.size(); ++t) ASSERT_EQ(source[t], t);
    Vec3 least = soup.corner(0, 0), most = least;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) least = least.cwiseMin(soup.corner(t, k)), most = most.cwiseMax(soup.corner(t, k));
    EXPECT_EQ(mesh.box_min(), least);
    EXPECT_EQ(mesh.box_max(), most);
    EXPECT_EQ(mesh.extent(), std::max(least.cwiseAbs().maxCoeff(), most.cwiseAbs().maxCoeff()));
    const Check verified = verify(mesh);
    EXPECT_TRUE(verified) << verified.message;
  }
}

TEST(Mesh, OfAnySizeIsATreeThatHoldsAll) {
  Random random(2);
  for (const int count : {1, 2, 7, 8, 9, 63, 64, 65, 511, 512, 513, 5000}) {
    for (const int kind : {0, 1, 2, 3}) {
      Soup soup = scattered(random, count, 0.1);
      if (kind == 1) soup = scaled(std::move(soup), 1e44);
      if (kind == 2) soup = moved(std::move(soup), Mat3::Identity(), {1e9, -1e9, 1e8});
      if (kind == 3)
        for (Vec3& p : soup.points) p = Vec3(0.5, 0.25, 0.125);  // all at one point
      const MeshModel mesh = soup.mesh();
      const Check verified = verify(mesh);
      EXPECT_TRUE(verified) << count << ", " << kind << ": " << verified.message;
      EXPECT_GE(mesh.node_count(), std::size_t(count + 7) / 8);
    }
  }
}

TEST(Mesh, RefusesWhatIsNoMeshAndNamesIt) {
  const Soup good = unit_box();
  const auto refused = [](const Soup& soup, ErrorCode code, std::initializer_list<const char*> words) {
    const Result<MeshModel> made = MeshModel::from_triangles(soup.points, soup.triangles);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, code);
    for (const char* word : words) EXPECT_NE(made.error().message.find(word), std::string::npos) << made.error().message;
  };
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e-60, -1e-60, 1e46, -1e46, 5e-324, 9e-46}) {
    Soup soup = good;
    soup.points[3].y() = bad;
    refused(soup, ErrorCode::BadValue, {"point 3"});
    soup.triangles = {{0, 1, 2}};  // the point is of no triangle
    EXPECT_TRUE(MeshModel::from_triangles(soup.points, soup.triangles));
  }
  for (const double legal : {1e45, -1e45, 1e-45, 0.0, -0.0}) {
    Soup soup = good;
    soup.points[3].y() = legal;
    EXPECT_TRUE(MeshModel::from_triangles(soup.points, soup.triangles)) << legal;
  }
  for (const std::uint32_t bad : {8u, 1000u, kNone}) {
    Soup soup = good;
    soup.triangles[5][1] = bad;
    refused(soup, ErrorCode::BadValue, {"triangle 5", "8 points"});
  }
  refused({good.points, {}}, ErrorCode::Empty, {"triangles"});
  refused({}, ErrorCode::Empty, {"triangles"});
  refused({{}, {{0, 0, 0}}}, ErrorCode::BadValue, {"triangle 0"});
}

TEST(Mesh, TellsItsProgressAndIsCancelled) {
  Random random(3);
  const Soup soup = scattered(random, 20000, 0.1);
  std::vector<double> told;
  const Result<MeshModel> made = MeshModel::from_triangles(soup.points, soup.triangles, {.progress = [&](double fraction) {
                                                             told.push_back(fraction);
                                                             return true;
                                                           }});
  ASSERT_TRUE(made);
  ASSERT_GE(told.size(), 8u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
  for (std::size_t stop = 0; stop + 1 < told.size(); ++stop) {
    std::size_t calls = 0;
    const Result<MeshModel> cut =
        MeshModel::from_triangles(soup.points, soup.triangles, {.progress = [&](double) { return calls++ < stop; }});
    ASSERT_FALSE(cut) << stop;
    EXPECT_EQ(cut.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(calls, stop + 1) << "calls after a cancellation";
  }
}

TEST(Mesh, OfTheSameInputHasTheSameBytes) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Soup soup = i < 19 ? any(random) : scattered(random, 3000, 0.1);
    const MeshModel one = soup.mesh(), other = soup.mesh();
    ASSERT_TRUE(std::equal(one.bytes().begin(), one.bytes().end(), other.bytes().begin(), other.bytes().end()));
    ASSERT_EQ(one.hash(), other.hash());
    const MeshModel copy = one;
    ASSERT_EQ(copy.bytes().data(), one.bytes().data()) << "copies share the block";
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(one.bytes().data()) % 64, 0u);
  }
}

// ---- Files -----------------------------------------------------------------------------------------------------------------

class MeshFile : public FolderTest {};

TEST_F(MeshFile, IsReadAndMappedAsItWasWritten) {
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    const Soup soup = any(random);
    const MeshModel mesh = soup.mesh(), other = any(random).mesh();
    const Result<std::size_t> saved = save(mesh, path("a.swm"));
    ASSERT_TRUE(saved);
    EXPECT_EQ(saved.value(), mesh.bytes().size());
    EXPECT_EQ(std::filesystem::file_size(path("a.swm")), mesh.bytes().size());
    EXPECT_TRUE(is_mesh_file(path("a.swm")));
    const Pose pose = any_pose(random, 2);
    const Answer answer = distance(mesh, other, pose);
    for (const Result<MeshModel>& read : {load_mesh(path("a.swm")), map_mesh(path("a.swm")), load_mesh(mesh.bytes())}) {
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read.value().hash(), mesh.hash());
      EXPECT_TRUE(read.value().topology() == mesh.topology());
      EXPECT_EQ(read.value().extent(), mesh.extent());
      const Answer again = distance(read.value(), other, pose);
      EXPECT_EQ(std::memcmp(&answer, &again, sizeof answer), 0);
    }
  }
}

TEST_F(MeshFile, ThatIsMissingOrAnotherIsRefusedByName) {
  for (const Result<MeshModel>& read : {load_mesh(path("none.swm")), map_mesh(path("none.swm"))}) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::CannotRead);
    EXPECT_NE(read.error().message.find("none.swm"), std::string::npos) << read.error().message;
  }
  const std::filesystem::path empty = write_file("empty.swm", {});
  for (const Result<MeshModel>& read : {load_mesh(empty), map_mesh(empty), load_mesh(std::span<const std::byte>())}) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
  }
  const std::filesystem::path model = std::string(SWIFTLET_TEST_DIR) + "/data/models/fat_a.swl";
  EXPECT_FALSE(is_mesh_file(model));
  EXPECT_FALSE(is_mesh_file(path("none.swm")));
  const Result<MeshModel> read = load_mesh(model);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
  ASSERT_TRUE(save(unit_box().mesh(), path("box.swm")));
  const Result<Model> hull = load(path("box.swm"));
  ASSERT_FALSE(hull);
  EXPECT_EQ(hull.error().code, ErrorCode::BadFormat);
  const Result<std::size_t> saved = save(unit_box().mesh(), path("no_folder") / "box.swm");
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::CannotWrite);
}

#if defined(__linux__)
/// A pipe would wait for who writes into it.
TEST_F(MeshFile, ThatIsNoRegularOneIsToldSo) {
  ASSERT_EQ(mkfifo(path("pipe.swm").c_str(), 0600), 0);
  std::filesystem::create_directory(path("folder.swm"));
  const auto cannot_read = [](const auto& result, const std::string& why) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::CannotRead);
    EXPECT_TRUE(result.error().message.ends_with(why)) << result.error().message;
  };
  for (const auto& [name, why] :
       {std::pair("pipe.swm", "pipe.swm: is no regular file"), std::pair("folder.swm", "folder.swm: Is a directory")}) {
    cannot_read(load_mesh(path(name)), why);
    cannot_read(map_mesh(path(name)), why);
    cannot_read(salvage_mesh(path(name)), why);
    EXPECT_FALSE(is_mesh_file(path(name)));
  }
}
#endif

TEST_F(MeshFile, DamagedOrCutOffIsRefused) {
  Random random(6);
  for (const Soup& soup : {unit_box(), scattered(random, 100, 0.3)}) {
    const MeshModel mesh = soup.mesh();
    const soups::Block good = bytes_of(mesh);
    MeshHeader header = header_of(good);
    const auto covered = [&](std::size_t at) {
      if (at < sizeof header) return true;
      for (const Section* s : sections_of(header))
        if (at >= s->offset && at < s->offset + s->bytes) return true;
      return false;
    };
    std::size_t tried = 0;
    for (std::size_t at = 0; at < good.size(); at += at < sizeof header || good.size() < 3000 ? 1 : 7) {
      if (!covered(at)) continue;
      for (const unsigned flip : {1u << random.bits() % 8, 255u}) {
        soups::Block bad = good;
        bad[at] ^= std::byte(flip);
        const Result<MeshModel> read = load_mesh(bad);
        ASSERT_FALSE(read) << "byte " << at;
        ASSERT_TRUE(read.error().code == ErrorCode::BadFormat || read.error().code == ErrorCode::BadVersion);
        ASSERT_FALSE(read.error().message.empty());
        ++tried;
      }
    }
    EXPECT_GT(tried, 1000u);
    for (std::size_t size = 0; size < good.size(); size += 1 + size / 300) {
      ASSERT_FALSE(load_mesh(std::span(good).first(size))) << size;
      if (size % 40 == 0) {
        const std::filesystem::path cut = write_file("cut.swm", std::span(good).first(size));
        ASSERT_FALSE(load_mesh(cut)) << size;
        ASSERT_FALSE(map_mesh(cut)) << size;
      }
    }
    soups::Block longer = good;
    longer.resize(good.size() + 64);
    EXPECT_FALSE(load_mesh(longer));
  }
}

TEST_F(MeshFile, OfAnotherVersionSaysSo) {
  soups::Block block = bytes_of(unit_box().mesh());
  for (const std::uint32_t version : {0u, kMeshFileVersion + 1, ~0u}) {
    std::memcpy(block.data() + offsetof(MeshHeader, version), &version, sizeof version);
    rehash(block);
    const Result<MeshModel> read = load_mesh(write_file("old.swm", block));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::BadVersion);
    EXPECT_NE(read.error().message.find(std::to_string(version)), std::string::npos) << read.error().message;
    EXPECT_NE(read.error().message.find("swiftlet build --mesh"), std::string::npos) << read.error().message;
  }
}

/// Adapters and refits index by them.
TEST_F(MeshFile, ThatNamesATriangleTwiceOrNoneIsRefused) {
  const MeshModel mesh = ball(1).mesh();
  const soups::Block good = bytes_of(mesh);
  const Section sources = header_of(good).source_triangle;
  for (const std::uint32_t lie : {mesh.source_triangle()[1], std::uint32_t(mesh.triangle_count()), kNone}) {
    soups::Block block = good;
    std::memcpy(block.data() + sources.offset, &lie, sizeof lie);
    rehash(block);
    const Result<MeshModel> read = load_mesh(block);
    ASSERT_FALSE(read) << lie;
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
    EXPECT_NE(read.error().message.find("sources"), std::string::npos) << read.error().message;
  }
}

/// Whoever asks for the triangles below a node gets those from its first to its last.
TEST_F(MeshFile, WithTrianglesBelowNodesOutOfOrderIsRefused) {
  const MeshModel mesh = ball(3).mesh();
  const soups::Block good = bytes_of(mesh);
  const MeshHeader header = header_of(good);
  ASSERT_GE(header.levels, 3u);
  const std::uint32_t last = header.levels - 1;
  const std::size_t count = header.level[last].bytes / sizeof(Node);
  int refused = 0;
  for (std::size_t i = 1; i < count; ++i) {
    soups::Block block = good;
    Node nodes[2];
    const std::size_t at[2] = {header.level[last].offset, header.level[last].offset + i * sizeof(Node)};
    for (int k = 0; k < 2; ++k) std::memcpy(nodes + k, block.data() + at[k], sizeof(Node));
    if (!nodes[0].lowest() || !nodes[1].lowest()) continue;
    for (int k = 0; k < 2; ++k) std::memcpy(block.data() + at[k], nodes + 1 - k, sizeof(Node));
    rehash(block);
    const Result<MeshModel> read = load_mesh(block);
    ASSERT_FALSE(read) << i;
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
    EXPECT_NE(read.error().message.find("triangles"), std::string::npos) << read.error().message;
    ++refused;
  }
  EXPECT_GE(refused, 20);
}

/// The block with these bytes as its hulls and their models.
soups::Block with_hulls(const soups::Block& block, std::span<const HullRecord> hulls, const soups::Block& models) {
  MeshHeader header = header_of(block);
  header.hull_count = std::uint32_t(hulls.size()), header.hull_units = std::uint32_t(models.size() / 64);
  soups::Block made(sizeof header);
  const auto put = [&](Section& s, std::span<const std::byte> bytes) {
    made.resize((made.size() + 63) / 64 * 64);
    s = {made.size(), bytes.size(), 0};
    made.insert(made.end(), bytes.begin(), bytes.end());
  };
  const auto copy = [&](Section& s) { put(s, std::span<const std::byte>(block).subspan(s.offset, s.bytes)); };
  for (std::uint32_t k = 0; k < header.levels; ++k) copy(header.level[k]);
  put(header.hulls, std::as_bytes(hulls)), put(header.hull_models, models);
  for (Section* s : {&header.shells, &header.triangles, &header.vertices, &header.source_triangle, &header.source_vertex})
    copy(*s);
  header.total_bytes = made.size();
  std::memcpy(made.data(), &header, sizeof header);
  rehash(made);
  return made;
}

/// Coordinates that `from_triangles` refuses are refused of a file, too, whatever unit it names.
TEST_F(MeshFile, WithCoordinatesBeyondTheLargestIsRefused) {
  const auto larger = [](int shift) {
    soups::Block block = bytes_of(scaled(tetrahedron(), 0x1p149).mesh());
    MeshHeader header = header_of(block);
    header.unit += shift;
    for (double* x : {header.box_min, header.box_max})
      for (int k = 0; k < 3; ++k) x[k] = std::ldexp(x[k], shift);
    std::memcpy(block.data(), &header, sizeof header);
    for (std::size_t at = header.vertices.offset; at < header.vertices.offset + header.vertices.bytes; at += sizeof(double)) {
      double x;
      std::memcpy(&x, block.data() + at, sizeof x);
      x = std::ldexp(x, shift);
      std::memcpy(block.data() + at, &x, sizeof x);
    }
    rehash(block);
    return block;
  };
  EXPECT_TRUE(load_mesh(larger(0)));
  for (const int shift : {1, 4, 10}) {
    const Result<MeshModel> read = load_mesh(larger(shift));
    ASSERT_FALSE(read) << shift;
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
  }
}

/// Hulls that all name the same bytes as their models are not copied before they are refused.
TEST_F(MeshFile, WithHullsThatShareTheirModelsTakesNoMoreMemoryThanItIsLarge) {
  const MeshModel mesh = ball(4).mesh();
  ASSERT_GE(mesh.depth(), 2);
  constexpr std::size_t kModels = 1 << 16;
  for (const std::uint32_t step : {0u, 1u}) {  // all of one node, or each of one of its own
    std::vector<HullRecord> hulls;
    for (std::uint32_t i = 0; i < 1000; ++i) hulls.push_back({i * step, 0, 0, kModels});
    const soups::Block block = with_hulls(bytes_of(mesh), hulls, soups::Block(kModels));
    const std::filesystem::path shared = write_file("shared.swm", block),
                                cut_short = write_file("short.swm", std::span(block).first(block.size() - 1));
    const std::size_t before = allocated_bytes;
    const auto expect_refused = [&](const auto& read) {
      ASSERT_FALSE(read);
      EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
      EXPECT_NE(read.error().message.find("hull"), std::string::npos) << read.error().message;
    };
    expect_refused(load_mesh(shared, {.deviation = mesh.deviation(mesh.depth() - 1) * 1.5}));
    expect_refused(salvage_mesh(cut_short));
    expect_refused(load_mesh(shared));
    EXPECT_LE(allocated_bytes - before, 16 * block.size());
  }
}
/// Nor are levels of nodes that do.
TEST_F(MeshFile, WithLevelsInOnePlaceIsRefused) {
  const MeshModel mesh = ball(4).mesh();
  ASSERT_GE(mesh.depth(), 3);
  soups::Block block = bytes_of(mesh);
  MeshHeader header = header_of(block);
  header.level[1].offset = header.level[0].offset;
  std::memcpy(block.data(), &header, sizeof header);
  rehash(block);
  write_file("one.swm", block);
  for (const Detail& detail : {Detail{}, Detail{.deviation = mesh.deviation(2) * 1.5}}) {
    const Result<MeshModel> read = load_mesh(path("one.swm"), detail);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("begin"), std::string::npos) << read.error().message;
  }
}

template <class T>
T some(Random& random) {
  if constexpr (std::is_floating_point_v<T>) {
    constexpr T kHard[] = {0,
                           T(-0.0),
                           1,
                           -1,
                           T(0.5),
                           8,
                           T(-7.9),
                           std::numeric_limits<T>::max(),
                           std::numeric_limits<T>::min(),
                           std::numeric_limits<T>::denorm_min(),
                           std::numeric_limits<T>::infinity(),
                           std::numeric_limits<T>::quiet_NaN()};
    return random.bits() % 3 ? T(random.uniform(-8, 8)) : kHard[random.bits() % std::size(kHard)];
  } else {
    constexpr T kHard[] = {0, 1, T(~T{0}), T(T{1} << (8 * sizeof(T) - 1)), T((T{1} << (8 * sizeof(T) - 1)) - 1)};
    return random.bits() % 2 ? T(random.bits()) : kHard[random.bits() % std::size(kHard)];
  }
}
/// One value of a block replaced.
void mutate(soups::Block& block, Random& random) {
  MeshHeader header = header_of(block);
  Section whole{0, sizeof header, 0};
  std::vector<Section*> sections = sections_of(header);
  sections.push_back(&whole);
  const Section& s = *sections[random.bits() % sections.size()];
  const auto write = [&](auto value) {
    if (s.bytes < sizeof value || s.offset > block.size() || s.bytes > block.size() - s.offset) return;
    std::memcpy(block.data() + s.offset + random.bits() % (s.bytes / sizeof value) * sizeof value, &value, sizeof value);
  };
  switch (random.bits() % 6) {
    case 0: write(some<std::uint32_t>(random)); break;
    case 1: write(some<std::uint64_t>(random)); break;
    case 2: write(some<float>(random)); break;
    case 3: write(some<double>(random)); break;
    case 4: write(some<std::uint8_t>(random)); break;
    default: write(std::uint32_t(random.bits() % 16));
  }
}

/// Whether a feature is one of the mesh's triangles, their edges or vertices, or none.
bool exists(FeatureId id, const MeshModel& mesh) {
  switch (id.kind()) {
    case FeatureKind::None: return true;
    case FeatureKind::Vertex: return id.index() < mesh.vertex_count();
    case FeatureKind::Edge: return id.index() < 3 * mesh.triangle_count();
    default: return id.index() < mesh.triangle_count();
  }
}
/// An answer about a file that lies: any interval, and names of what exists.
void expect_harmless(const MeshModel& a, const MeshModel& b, const Answer& answer) {
  if (answer.status >= Status::InvalidPose) return;
  ASSERT_TRUE(exists(answer.feature_a, a));
  ASSERT_TRUE(exists(answer.feature_b, b));
  ASSERT_LE(answer.lower, answer.upper);
  ASSERT_GE(answer.lower, 0);
  ASSERT_LE(std::uint64_t(answer.steps), 2 * std::uint64_t(a.node_count()) * b.node_count() * 18);
  ASSERT_LE(std::uint64_t(answer.plane_tests), std::uint64_t(a.triangle_count()) * b.triangle_count() + 1);
}

TEST_F(MeshFile, ThatLiesUnderGoodHashesIsHarmless) {
  Random random(7);
  const MeshModel honest = any(random).mesh();
  std::vector<soups::Block> originals;
  for (const int count : {1, 5, 12, 70}) originals.push_back(bytes_of(scattered(random, count, 0.4).mesh()));
  originals.push_back(bytes_of(ball(2).mesh()));
  int loaded = 0, refused = 0, unverified = 0;
  for (int i = 0; i < 20000; ++i) {
    soups::Block block = originals[random.bits() % originals.size()];
    for (std::uint64_t times = 1 + random.bits() % 3; times > 0; --times) mutate(block, random);
    rehash(block);
    const Result<MeshModel> read = load_mesh(block);
    if (!read) {
      ASSERT_FALSE(read.error().message.empty());
      ++refused;
      continue;
    }
    ++loaded;
    const MeshModel& liar = read.value();
    unverified += !verify(liar);
    for (const auto& [a, b] : {std::pair{&liar, &honest}, {&honest, &liar}, {&liar, &liar}}) {
      const Pose pose = any_pose(random, 2 * std::max(a->extent(), b->extent()));
      MeshSeed seed;
      expect_harmless(*a, *b, distance(*a, *b, pose, seed));
      expect_harmless(*a, *b, intersects(*a, *b, pose, seed));
      expect_harmless(*a, *b, within(*a, *b, pose, 0.1, seed).answer);
      const ClosestFeatures closest = closest_features(*a, *b, pose, seed);
      expect_harmless(*a, *b, closest.answer);
      for (const std::uint32_t id : closest.source_a.triangles) ASSERT_LT(id, a->triangle_count());
      for (const std::uint32_t id : closest.source_b.triangles) ASSERT_LT(id, b->triangle_count());
      if (HasFatalFailure()) FAIL() << "mutation " << i;
    }
  }
  EXPECT_GE(loaded, 4000);
  EXPECT_GE(refused, 4000);
  EXPECT_GE(unverified, 1000);
}

/// What a query rests on and no hash proves: `verify` finds it out.
TEST_F(MeshFile, ThatLiesIsFoundOutByVerify) {
  const soups::Block good = bytes_of(ball(2).mesh());
  const MeshHeader header = header_of(good);
  const auto expect_found = [&](const char* what, const auto& change) {
    soups::Block block = good;
    change(block);
    rehash(block);
    const Result<MeshModel> read = load_mesh(block);
    EXPECT_TRUE(!read || !verify(read.value())) << what;
  };
  const auto put = [](soups::Block& block, std::size_t at, auto value) {
    std::memcpy(block.data() + at, &value, sizeof value);
  };
  const std::size_t node = header.level[0].offset;
  expect_found("a smaller box of a child", [&](soups::Block& b) { put(b, node + offsetof(Node, half), 0.01f); });
  expect_found("a child elsewhere", [&](soups::Block& b) { put(b, node + offsetof(Node, centre), 0.9f); });
  expect_found("a smaller box of a node", [&](soups::Block& b) { put(b, node + offsetof(Node, extent), 0.01f); });
  expect_found("a box of negative size", [&](soups::Block& b) { put(b, node + offsetof(Node, extent), -0.5f); });
  expect_found("another origin", [&](soups::Block& b) { put(b, node + offsetof(Node, origin), 0.5); });
  expect_found("an axis that is no unit", [&](soups::Block& b) { put(b, node + offsetof(Node, axis), 1.5f); });
  expect_found("another vertex", [&](soups::Block& b) { put(b, header.vertices.offset, 1.9); });
  expect_found("a smaller box of the mesh", [&](soups::Block& b) { put(b, offsetof(MeshHeader, box_max), 0.5); });
  expect_found("a larger box of the mesh", [&](soups::Block& b) { put(b, offsetof(MeshHeader, box_max), 1.5); });
  expect_found("another unit", [&](soups::Block& b) { put(b, offsetof(MeshHeader, unit), std::int32_t(header.unit + 1)); });
  expect_found("a unit that has no magnitude",
               [&](soups::Block& b) { put(b, offsetof(MeshHeader, unit), std::numeric_limits<std::int32_t>::min()); });
  expect_found("an edge that is open", [&](soups::Block& b) { put(b, offsetof(MeshHeader, open_edges), 1u); });
  expect_found("a flat triangle", [&](soups::Block& b) { put(b, offsetof(MeshHeader, flat_triangles), 1u); });
  EXPECT_TRUE(verify(load_mesh(good).value()));

  soups::Block two = bytes_of(together({unit_box(), unit_box(3)}).mesh());
  const std::size_t shells = header_of(two).shells.offset;
  std::memcpy(two.data() + shells, two.data() + shells + 4, 4);  // one of them twice
  rehash(two);
  const Result<MeshModel> read = load_mesh(two);
  EXPECT_TRUE(!read || !verify(read.value()));
}

// ---- The cases of the laws -------------------------------------------------------------------------------------------------

struct Case {
  Soup a, b;
  MeshModel mesh_a, mesh_b;
  Pose pose;
  double truth;

  Case(Soup of_a, Soup of_b, const Pose& b_in_a)
      : a(std::move(of_a)),
        b(std::move(of_b)),
        mesh_a(a.mesh()),
        mesh_b(b.mesh()),
        pose(b_in_a),
        truth(brute_force(a, b, pose)) {}
  double law_two() const { return tolerance(mesh_a, mesh_b, pose); }
  /// What long doubles may be off by.
  double slack() const { return law_two() / 64; }
};

/// Anywhere, near contact, and on a lattice, where bodies touch.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    Random random(10);
    for (int i = 0; i < 240; ++i) {
      Soup a = any(random), b = any(random);
      Pose pose = any_pose(random, 3.5);
      if (i % 4 == 1) {
        const Soup brick = unit_box();
        a = together({brick, unit_box(2)}), b = brick;
        pose = {lattice_rotation(random),
                Vec3(double(random.bits() % 5), double(random.bits() % 3), double(random.bits() % 3))};
      }
      Case c(a, b, pose);
      if (i % 4 == 2 && c.truth > 0) {
        const Answer answer = distance(c.mesh_a, c.mesh_b, pose);
        pose.translation -=
            (answer.point_b - answer.point_a) * (1 + random.uniform(-1, 1) * std::pow(10, -double(random.bits() % 17)));
        c = Case(a, b, pose);
      }
      made.push_back(std::move(c));
    }
    return made;
  }();
  return all;
}

void for_each_case(const auto& test) {
  for (std::size_t i = 0; i < cases().size(); ++i) {
    test(cases()[i]);
    if (testing::Test::HasFatalFailure()) FAIL() << "case " << i << ", distance " << cases()[i].truth;
  }
}
Answer exact(const Case& c, const Options& options = {}) { return distance(c.mesh_a, c.mesh_b, c.pose, options); }

void expect_true(const Case& c, const Answer& answer) {
  ASSERT_LE(answer.lower, c.truth + c.slack());
  ASSERT_GE(answer.upper, c.truth - c.slack());
  ASSERT_LE(answer.lower, answer.upper);
  if (answer.verdict == Verdict::Disjoint) {
    ASSERT_GT(answer.lower, 0);
  }
  if (answer.verdict == Verdict::Overlapping) {
    ASSERT_LE(c.truth, c.slack());
  }
  if (answer.verdict == Verdict::Touching) {
    ASSERT_LE(c.truth, c.law_two());
  }
}
void expect_law_two(const Case& c, const Answer& answer) {
  expect_true(c, answer);
  ASSERT_EQ(answer.status, Status::Converged);
  ASSERT_NE(answer.verdict, Verdict::Undecided);
  ASSERT_LE(answer.upper - answer.lower, c.law_two());
}
bool same_bits(const Answer& x, const Answer& y) { return std::memcmp(&x, &y, sizeof x) == 0; }
Soup point_soup(const Vec3& p) { return {{p}, {{0, 0, 0}}}; }

TEST(MeshCases, AreApartAndMeet) {
  int apart = 0, near = 0, meet = 0;
  for (const Case& c : cases()) ++(c.truth > 1e-3 ? apart : c.truth > c.slack() ? near : meet);
  EXPECT_GE(apart, 60);
  EXPECT_GE(near, 15);
  EXPECT_GE(meet, 60);
}

// ---- Law 1 -----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw1, IntervalsHoldTheTruth) {
  for_each_case([](const Case& c) {
    expect_true(c, exact(c));
    for (const double relative : {1e-6, 1e-2, 0.5}) expect_true(c, exact(c, {.relative = relative}));
    for (const double absolute : {1e-9, 1e-3, 0.5, 100.0}) expect_true(c, exact(c, {.absolute = absolute}));
    for (const double beyond : {0.0, c.truth * 0.5, c.truth, 1.0}) {
      const Answer answer = exact(c, {.beyond = beyond});
      expect_true(c, answer);
      ASSERT_EQ(answer.status == Status::Beyond, answer.lower > beyond && answer.upper - answer.lower > c.law_two());
      ASSERT_TRUE(answer.status == Status::Beyond || answer.status == Status::Converged);
    }
  });
}

TEST(MeshLaw1, IntervalsHoldTheTruthWhenABudgetEndedTheSearch) {
  int ended = 0;
  for_each_case([&](const Case& c) {
    for (const std::uint32_t steps : {0u, 1u, 2u, 3u, 5u, 10u, 30u, 100u, 100000u}) {
      MeshSeed seed;
      for (int k = 0; k < 2; ++k) {  // cold, and with what it left
        const Answer answer = distance(c.mesh_a, c.mesh_b, c.pose, seed, {.budget = {.steps = steps}});
        expect_true(c, answer);
        ASSERT_TRUE(answer.status == Status::Budget || answer.status == Status::Converged);
        ended += answer.status == Status::Budget;
        ASSERT_LE(answer.steps + answer.plane_tests, steps + 2);  // the seed's pair, and the one that the last step opens
        if (answer.upper == kInfinity) {
          ASSERT_TRUE(answer.point_a.hasNaN() && answer.point_b.hasNaN());
        }
      }
    }
  });
  EXPECT_GE(ended, 500);
}

TEST(MeshLaw1, HoldsForTreesOfSeveralLevels) {
  Random random(11);
  const Soup round = ball(3), ring = torus(24, 12), waves = patch(14, [](double x, double y) { return 0.2 * x * y * (x - y); });
  for (int i = 0; i < 12; ++i) {
    const Soup &a = i % 2 ? round : ring, &b = i % 3 ? waves : ring;
    const MeshModel mesh_a = a.mesh(), mesh_b = b.mesh();
    Pose pose = any_pose(random, 3);
    if (i % 4 == 0) {  // near contact
      const Answer apart = distance(mesh_a, mesh_b, pose);
      if (apart.lower > 0) pose.translation -= (1 - 1e-9) * (apart.point_b - apart.point_a);
    }
    const Case c(a, b, pose);
    expect_law_two(c, exact(c));
    for (const Options& options : {Options{.relative = 0.1}, Options{.absolute = 0.01}, Options{.budget = {.steps = 40}}})
      expect_true(c, exact(c, options));
    const Check checked = check(c.mesh_a, c.mesh_b, c.pose, exact(c));
    ASSERT_TRUE(checked) << checked.message;
    if (HasFatalFailure()) FAIL() << i;
  }
}

// ---- Law 2 -----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw2, ExactIntervalsAreNarrowAndPointsLieOnBothBodies) {
  for_each_case([](const Case& c) {
    const Answer answer = exact(c);
    expect_law_two(c, answer);
    if (answer.verdict == Verdict::Overlapping) return;
    const Vec3 p = answer.point_a, q = answer.point_b;
    ASSERT_LE(brute_force(point_soup(p), c.a, {}), c.law_two());
    ASSERT_LE(brute_force(point_soup(q), c.b, c.pose), c.law_two());
    ASSERT_NEAR((q - p).norm(), c.truth, 2 * c.law_two());
    if (answer.verdict == Verdict::Touching && answer.normal.hasNaN()) return;
    ASSERT_NEAR(answer.normal.norm(), 1, 1e-15);
    if (c.truth > 1e-9) {
      ASSERT_LE(((q - p) - (q - p).norm() * answer.normal).norm(), 2 * c.law_two() * (1 + 1 / c.truth));
    }
  });
}

TEST(MeshLaw2, CheckAgreesAndFindsOutWhatIsFalse) {
  for_each_case([](const Case& c) {
    const Answer answer = exact(c);
    const Check checked = check(c.mesh_a, c.mesh_b, c.pose, answer);
    ASSERT_TRUE(checked) << checked.message;
    const auto found_out = [&](const auto& change) {
      Answer wrong = answer;
      change(wrong);
      return !check(c.mesh_a, c.mesh_b, c.pose, wrong);
    };
    ASSERT_TRUE(found_out([&](Answer& w) { w.lower = w.upper = answer.upper + 4 * c.law_two(); }));
    ASSERT_TRUE(found_out([](Answer& w) { w.status = Status::NotAsked; }));
    if (answer.verdict == Verdict::Overlapping) {
      ASSERT_TRUE(found_out([](Answer& w) { w.verdict = Verdict::Disjoint; }));
      ASSERT_TRUE(found_out([&](Answer& w) { w.point_a = w.point_b = Vec3::Constant(64 * (1 + c.mesh_a.extent())); }));
      ASSERT_TRUE(found_out([](Answer& w) { w.feature_b = FeatureId(FeatureKind::Face, 1 << 29); }));
      ASSERT_TRUE(found_out([](Answer& w) { w.level_a = 1; }));
    }
    if (c.truth < 0.01) return;
    ASSERT_TRUE(found_out([&](Answer& w) { w.upper = w.lower = answer.lower - 4 * c.law_two(); }));
    ASSERT_TRUE(found_out([](Answer& w) { w.verdict = Verdict::Overlapping; }));
    ASSERT_TRUE(found_out([](Answer& w) { w.verdict = Verdict::Touching; }));
    ASSERT_TRUE(found_out([](Answer& w) { w.point_a += 1e-3 * w.normal; }));
    ASSERT_TRUE(found_out([](Answer& w) { w.point_b += 1e-3 * w.normal; }));
    ASSERT_TRUE(found_out([](Answer& w) { w.feature_a = FeatureId(FeatureKind::Face, 1 << 29); }));
  });
}

/// What is deep in each other does not touch: of surfaces that cross, and of a solid all around a smaller one.
TEST(MeshLaw2, CheckTellsDeepOverlapsFromTouches) {
  const MeshModel large = ball(2).mesh(), small = scaled(ball(2), 0.25).mesh();
  const Pose inside{Mat3::Identity(), {0.1, 0, 0}}, across{Mat3::Identity(), {1, 0.1, 0.2}};
  const auto expect_refused = [](const MeshBody& a, const MeshBody& b, const Pose& pose, const char* why) {
    Answer answer = intersects(a, b, pose);
    ASSERT_EQ(answer.verdict, Verdict::Overlapping);
    EXPECT_TRUE(check(a, b, pose, answer)) << check(a, b, pose, answer).message;
    answer.verdict = Verdict::Touching;
    const Check checked = check(a, b, pose, answer);
    EXPECT_FALSE(checked);
    EXPECT_NE(checked.message.find(why), std::string::npos) << checked.message;
  };
  expect_refused(large, small, across, "in each other");
  expect_refused(MeshBody::solid(large), small, inside, "inside the other");
  expect_refused(Body::box({-1, -1, -1}, {1, 1, 1}), small, across, "in each other");
}

TEST(MeshLaw2, CheckRefusesAForgeryOfAnyMember) {
  Random random(23);
  int forged = 0;
  for (int i = 0; i < 60; ++i) {
    const auto p = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
    const double radius = i % 2 ? random.uniform(0.1, 0.3) : 0;
    const MeshModel mesh = scattered(random, 6, 0.5).mesh(), other = ball(1).mesh();
    const MeshBody bodies[] = {{mesh, radius},
                               MeshBody::solid(other, radius),
                               Body::point(p(), radius),
                               Body::segment(p(), p(), radius),
                               Body::triangle(p(), p(), p(), radius),
                               Body::box(-Vec3::Ones(), Vec3::Ones(), radius)};
    for (const MeshBody& b : bodies) {
      const MeshBody& a = bodies[i % 4 / 2];
      const Pose pose = any_pose(random, 6);
      for (const Answer& s : {distance(a, b, pose), signed_distance(a, b, pose), closest_features(a, b, pose).answer}) {
        const Check checked = check(a, b, pose, s);
        ASSERT_TRUE(checked) << checked.message;
        if (!(s.lower > 0.01)) continue;
        ++forged;
        for (const auto& [what, forge] : forgeries::kForgeries) {
          Answer wrong = s;
          forge(wrong, 8 * tolerance(a, b, pose));
          EXPECT_FALSE(check(a, b, pose, wrong)) << what << ' ' << i;
        }
      }
    }
  }
  EXPECT_GE(forged, 300);
}

/// Bodies that meet by their radii alone: `within` says so, as of convex bodies, and check agrees.
TEST(MeshLaw2, WithinSaysThatRadiiOverlap) {
  const MeshModel cube = box({0, 0, 0}, {1, 1, 1}).mesh();
  for (const double gap : {0.05, 0.15}) {
    const Body convex = Body::box({0, 0, 0}, {1, 1, 1}, 0.1);
    const MeshBody round(cube, 0.1);
    const Pose pose{Mat3::Identity(), {1 + gap, 0.3, 0.2}};
    for (const double threshold : {0.0, 0.02, 0.05, 0.5}) {
      const Within of_meshes = within(round, round, pose, threshold), of_bodies = within(convex, convex, pose, threshold);
      EXPECT_EQ(of_meshes.decision, of_bodies.decision);
      if (threshold < 0.5) {  // the first pair that is so near proves less
        EXPECT_EQ(of_meshes.answer.verdict, of_bodies.answer.verdict) << gap << ' ' << threshold;
      }
      for (const Answer& s : {of_meshes.answer, signed_within(round, round, pose, threshold).answer}) {
        const Check checked = check(round, round, pose, s);
        EXPECT_TRUE(checked) << gap << ' ' << threshold << ": " << checked.message;
      }
    }
  }
}

/// The hulls are apart, and so is their normal known, in every question.
TEST(MeshLaw2, BodiesThatOverlapByRadiiAloneKeepTheirNormal) {
  Random random(24);
  int overlapping = 0;
  for (int i = 0; i < 60; ++i) {
    const MeshModel a = scattered(random, 4, 0.5).mesh(), b = scattered(random, 4, 0.5).mesh();
    const Pose pose = any_pose(random, 4);
    const Answer hulls = distance(a, b, pose);
    if (!(hulls.lower > 0.01)) continue;
    const MeshBody round_a(a, 0.7 * hulls.upper), round_b(b, 0.6 * hulls.upper);
    for (const Answer& answer :
         {distance(round_a, round_b, pose), intersects(round_a, round_b, pose), within(round_a, round_b, pose, 0).answer,
          closest_features(round_a, round_b, pose).answer, signed_distance(round_a, round_b, pose)}) {
      ++overlapping;
      EXPECT_EQ(answer.verdict, Verdict::Overlapping);
      EXPECT_NEAR(answer.normal.norm(), 1, 1e-15);
      const Check checked = check(round_a, round_b, pose, answer);
      EXPECT_TRUE(checked) << checked.message;
    }
    const Answer exact = closest_features(round_a, round_b, pose).answer;
    EXPECT_LE((exact.normal - hulls.normal).norm(), 1e-12);
  }
  EXPECT_GE(overlapping, 200);
}

TEST(MeshLaw2, ARelativeToleranceIsReachedHoweverLargeTheRadii) {
  Random random(22);
  int asked = 0;
  for (int i = 0; i < 50; ++i) {
    const MeshModel a = scattered(random, 3, 0.5).mesh(), b = scattered(random, 3, 0.5).mesh();
    const Pose pose = any_pose(random, 4);
    const double apart = distance(a, b, pose).lower, left = apart * std::pow(10, random.uniform(-9, -1));
    if (!(apart > 0)) continue;
    const MeshBody round(a, apart - left);
    for (const double relative : {1e-5, 1e-3, 0.1}) {
      MeshSeed seed;
      for (int again = 0; again < 2; ++again, ++asked)
        EXPECT_EQ(distance(round, b, pose, seed, {.relative = relative}).status, Status::Converged) << left << ' ' << relative;
    }
  }
  EXPECT_GE(asked, 100);
}

TEST(MeshLaw2, ToleranceIsTheFormula) {
  for_each_case([](const Case& c) {
    const double e = (c.pose.rotation.transpose() * c.pose.rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
    for (const double radius : {0.0, 0.7}) {
      const double size = std::max(c.mesh_a.extent() + radius, c.mesh_b.extent() + 2 * radius) + c.pose.translation.norm();
      const double bound = tolerance({c.mesh_a, radius}, {c.mesh_b, 2 * radius}, c.pose);
      ASSERT_GE(bound, 64 * 0x1p-53 * size);
      ASSERT_NEAR(bound, (64 * 0x1p-53 + 2 * e) * size, 4 * 0x1p-53 * size);
    }
  });
}

// ---- Law 3 -----------------------------------------------------------------------------------------------------------------

MeshSeed garbage(Random& random) {
  MeshSeed seed;
  std::array<std::uint64_t, sizeof seed / 8> bits;
  for (std::uint64_t& word : bits) word = random.bits();
  std::memcpy(static_cast<void*>(&seed), bits.data(), sizeof bits);
  if (random.bits() % 2)
    seed.triangle_a = std::uint32_t(random.bits() % 30), seed.triangle_b = std::uint32_t(random.bits() % 30);
  constexpr float kHard[] = {
      0, 1e-30f, 1e-45f, 1e38f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
  if (random.bits() % 2) seed.direction = {kHard[random.bits() % 6], kHard[random.bits() % 6], kHard[random.bits() % 6]};
  return seed;
}

TEST(MeshLaw3, AnySeedGivesTheSameAnswer) {
  Random random(20);
  MeshSeed stale;
  int verdicts[4] = {0, 0, 0, 0};
  for_each_case([&](const Case& c) {
    const Answer cold = exact(c), cold_met = intersects(c.mesh_a, c.mesh_b, c.pose);
    ++verdicts[int(cold.verdict)];
    if (c.truth > c.law_two()) {  // nearer, Touching is as true as what the other question proves
      ASSERT_EQ(cold_met.verdict, cold.verdict);
    }
    const auto expect_agreement = [&](MeshSeed seed) {
      const Answer other = distance(c.mesh_a, c.mesh_b, c.pose, seed);
      expect_law_two(c, other);
      ASSERT_LE(std::fabs(cold.lower - other.lower), c.law_two());
      ASSERT_LE(std::fabs(cold.upper - other.upper), c.law_two());
      ASSERT_EQ(cold.verdict, other.verdict) << cold.lower << ' ' << other.lower;
      const Answer met = intersects(c.mesh_a, c.mesh_b, c.pose, seed);
      expect_true(c, met);
      ASSERT_EQ(met.verdict, cold_met.verdict) << "of intersects";
      expect_true(c, within(c.mesh_a, c.mesh_b, c.pose, c.truth, seed).answer);
    };
    expect_agreement(stale);
    distance(c.mesh_a, c.mesh_b, c.pose, stale);
    expect_agreement(stale);
    for (int i = 0; i < 8; ++i) expect_agreement(garbage(random));
  });
  for (int v = 1; v < 4; ++v) EXPECT_GE(verdicts[v], 20);
}

/// Two triangles in the plane z = 0, and above each of them one that points down to a height of its own.
struct TwoTips {
  TwoTips(double left, double right) : plane(flat().mesh()), tips(pointing_to(left, right).mesh()) {}
  static Soup flat() {
    Soup soup;
    for (const double x : {-2, 2}) soup.add(Vec3(x - 1, -1, 0), Vec3(x + 1, -1, 0), Vec3(x, 1, 0));
    return soup;
  }
  static Soup pointing_to(double left, double right) {
    Soup soup;
    for (const auto& [x, height] : {std::pair{-2.0, left}, std::pair{2.0, right}})
      soup.add(Vec3(x, 0, height), Vec3(x - 0.5, 0.1, 1), Vec3(x + 0.5, 0.1, 1));
    return soup;
  }

  MeshModel plane, tips;
};

/// Under a pose that is not orthonormal law 2's bound is far above what rounding needs: what crosses by less is in doubt.
TEST(MeshLaw3, ACrossingWithinLawTwoIsNoMoreCertainFromASeed) {
  for (const auto& [left, right] : {std::pair{1e-8, -1e-8}, std::pair{-1e-8, 1e-8}}) {
    const TwoTips at(left, right);
    const Pose pose{(1 + 5e-8) * Mat3::Identity(), Vec3::Zero()};
    ASSERT_GE(tolerance(at.plane, at.tips, pose), 1e-7);
    const Answer cold = distance(at.plane, at.tips, pose);
    for (std::uint32_t i = 0; i < 2; ++i) {
      for (std::uint32_t k = 0; k < 2; ++k) {
        MeshSeed seed{.triangle_a = i, .triangle_b = k};
        EXPECT_EQ(distance(at.plane, at.tips, pose, seed).verdict, cold.verdict);
        seed = {.triangle_a = i, .triangle_b = k};
        EXPECT_EQ(intersects(at.plane, at.tips, pose, seed).verdict, cold.verdict);
        seed = {.triangle_a = i, .triangle_b = k};
        EXPECT_EQ(within(at.plane, at.tips, pose, 0, seed).decision, within(at.plane, at.tips, pose, 0).decision);
      }
    }
  }
}

TEST(MeshLaw3, NoSeedDecidesWhetherBodiesWithRadiiTouch) {
  const Pose pose{(1 + 5e-8) * Mat3::Identity(), Vec3::Zero()};
  constexpr double kRadius = 0x1p-4;
  int touching = 0;
  for (int i = -8; i <= 8; ++i) {
    for (const double apart : {3e-8, -3e-8}) {
      const TwoTips at(2 * kRadius + i * 4e-8 + apart, 2 * kRadius + i * 4e-8 - apart);
      const MeshBody a(at.plane, kRadius), b(at.tips, kRadius);
      const Answer cold = distance(a, b, pose);
      touching += cold.verdict == Verdict::Touching;
      for (std::uint32_t k = 0; k < 2; ++k) {
        MeshSeed seed{.triangle_a = k, .triangle_b = k};
        EXPECT_EQ(distance(a, b, pose, seed).verdict, cold.verdict) << i << ' ' << k;
      }
    }
  }
  EXPECT_GE(touching, 4);
}

TEST(MeshLaw3, SameSeedSameBitsWithRegistersOfAnyWidth) {
  Random random(21);
  if (!set_width(Width::Four)) GTEST_SKIP() << "meshes know one width here";
  for_each_case([&](const Case& c) {
    const MeshSeed seed = garbage(random);
    std::vector<Answer> answers;
    std::vector<MeshSeed> left;
    for (const Width width : {Width::Two, Width::Four, Width::Two}) {
      ASSERT_TRUE(set_width(width));
      left.push_back(seed);
      answers.push_back(distance(c.mesh_a, c.mesh_b, c.pose, left.back()));
      answers.push_back(intersects(c.mesh_a, c.mesh_b, c.pose, left.back()));
      answers.push_back(within(c.mesh_a, c.mesh_b, c.pose, c.truth * 0.9, left.back()).answer);
      answers.push_back(distance(c.mesh_a, c.mesh_b, c.pose, left.back(), {.budget = {.steps = 5}}));
    }
    for (std::size_t i = 4; i < answers.size(); ++i) ASSERT_TRUE(same_bits(answers[i], answers[i % 4])) << i;
    for (const MeshSeed& s : left) {
      ASSERT_EQ(s.triangle_a, left[0].triangle_a);
      ASSERT_EQ(s.triangle_b, left[0].triangle_b);
      ASSERT_EQ(std::memcmp(&s.direction, &left[0].direction, sizeof s.direction), 0);
    }
  });
  set_width(Width::Four);
}

// ---- Law 4 -----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw4, SwappingTheBodiesSwapsTheAnswer) {
  for_each_case([](const Case& c) {
    const Answer there = exact(c), back = distance(c.mesh_b, c.mesh_a, inverse(c.pose));
    const double slack = 2 * c.law_two();  // the inverse is rounded
    ASSERT_NEAR(there.lower, back.lower, slack);
    ASSERT_NEAR(there.upper, back.upper, slack);
    if (c.truth > slack) {
      ASSERT_EQ(there.verdict, back.verdict);
    }
    if (there.verdict != Verdict::Disjoint || back.verdict != Verdict::Disjoint) return;
    const auto in_a = [&](const Vec3& p) { return Vec3(c.pose.rotation * p + c.pose.translation); };
    ASSERT_LE(brute_force(point_soup(in_a(back.point_b)), c.a, {}), slack);
    ASSERT_LE(brute_force(point_soup(in_a(back.point_a)), c.b, c.pose), slack);
    ASSERT_NEAR((back.point_a - back.point_b).norm(), c.truth, 2 * slack);
  });
}

// ---- Law 5 -----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw5, ScalingByAPowerOfTwoScalesTheAnswerBitForBit) {
  Random random(30);
  for (int i = 0; i < 150; ++i) {
    // Coordinates that a power of 2^-140 leaves above 1e-45.
    const auto coarse = [&] {
      Soup soup = any(random);
      for (Vec3& p : soup.points) p = (p * 256).array().round() / 256;
      return soup;
    };
    const Soup a = coarse(), b = i % 5 ? coarse() : a;
    Pose pose = any_pose(random, i % 3 ? 3 : 0.1);
    if (i % 5 == 0) pose = {lattice_rotation(random), (3 * random.in_ball()).array().round()};
    const MeshModel mesh_a = a.mesh(), mesh_b = b.mesh();
    const double radius = i % 2 ? 0 : 0.125;
    const auto ask = [&](const MeshModel& x, const MeshModel& y, double s) {
      const Pose at{pose.rotation, s * pose.translation};
      const MeshBody of_x(x, s * radius), of_y(y, s * radius);
      std::vector<Answer> answers{distance(of_x, of_y, at),
                                  intersects(of_x, of_y, at),
                                  within(of_x, of_y, at, s * 0.5).answer,
                                  distance(of_x, of_y, at, {.relative = 0.1}),
                                  distance(of_x, of_y, at, {.absolute = s * 0.1}),
                                  closest_features(of_x, of_y, at).answer};
      for (Answer& answer : answers) answer.radius_a /= s, answer.radius_b /= s;
      return answers;
    };
    const std::vector<Answer> plain = ask(mesh_a, mesh_b, 1);
    for (const int k : {-140, -61, -1, 1, 50, 140}) {
      const double s = std::ldexp(1, k);
      std::vector<Answer> answers = ask(scaled(a, s).mesh(), scaled(b, s).mesh(), s);
      for (std::size_t q = 0; q < answers.size(); ++q) {
        Answer& answer = answers[q];
        answer.lower /= s, answer.upper /= s, answer.point_a /= s, answer.point_b /= s;
        if (plain[q].lower > 0 && plain[q].lower < 1e-300) answer.lower = plain[q].lower;  // the least double has no half
        ASSERT_TRUE(same_bits(plain[q], answer))
            << "pair " << i << ", question " << q << ", 2^" << k << ": [" << plain[q].lower << ", " << plain[q].upper
            << "] and [" << answer.lower << ", " << answer.upper << "], verdicts " << int(plain[q].verdict) << ' '
            << int(answer.verdict) << ", steps " << plain[q].steps << ' ' << answer.steps << ", " << plain[q].plane_tests << ' '
            << answer.plane_tests;
      }
    }
  }
}

TEST(MeshLaw5, ExactCommonTranslationsChangeNoBit) {
  Random random(31);
  for_each_case([&](const Case& c) {
    const auto grid = [](const Vec3& t) { return Vec3((t * 0x1p20).array().round() * 0x1p-20); };
    const Pose a{random.rotation(), grid(random.in_ball())}, b{random.rotation(), grid(random.in_ball() + c.pose.translation)};
    const Answer here = distance(c.mesh_a, c.mesh_b, relative(a, b));
    for (const double far : {1.0, 0x1p10, 0x1p30}) {
      const Vec3 shift = grid(random.in_ball()) * far;
      const Pose moved = relative({a.rotation, a.translation + shift}, {b.rotation, b.translation + shift});
      ASSERT_TRUE(same_bits(here, distance(c.mesh_a, c.mesh_b, moved)));
    }
  });
}

// ---- Law 7 -----------------------------------------------------------------------------------------------------------------

/// What is far from its box's corners is not as near as they are: bodies that balls part need no search.
TEST(MeshRoots, OfRoundBodiesAnswerWithoutASearch) {
  const MeshModel mesh = ball(3).mesh();
  Random random(41);
  for (int i = 0; i < 200; ++i) {
    const Answer answer = intersects(mesh, mesh, {random.rotation(), 2.01 * random.on_sphere()});
    EXPECT_EQ(answer.verdict, Verdict::Disjoint);
    EXPECT_EQ(answer.steps, 0u) << i;
    EXPECT_GT(answer.lower, 0.005) << i;
    EXPECT_LE(answer.lower, 0.03) << i;
  }
}

TEST(MeshLaw7, ALatticeOfBoxesEnds) {
  const Soup soup = box({-1, -1, -1}, {1, 1, 1});
  const MeshModel cube = soup.mesh();
  Random random(40);
  MeshSeed warm;
  int verdicts[4] = {0, 0, 0, 0};
  std::uint32_t work = 0;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) {
      for (int z = -6; z <= 6; ++z) {
        const Pose pose{lattice_rotation(random), Vec3(x, y, z) / 2};
        const Vec3 t = pose.translation.cwiseAbs();
        // Surfaces: apart outside, together where they are the same, and where one passes through the other.
        const double truth = (t.array() - 2).max(0).matrix().norm();
        for (MeshSeed seed : {MeshSeed{}, warm, garbage(random)}) {
          const Answer answer = distance(cube, cube, pose, seed);
          ASSERT_EQ(answer.status, Status::Converged);
          ASSERT_LE(answer.lower, truth * (1 + 1e-15)) << pose.translation.transpose();
          ASSERT_GE(answer.upper, truth * (1 - 1e-15)) << pose.translation.transpose();
          ASSERT_EQ(answer.verdict == Verdict::Disjoint, truth > 0);
          // Two boxes of one size cross where they are inside each other's range along every axis, but along all the same.
          if (t.maxCoeff() == 2 || t.maxCoeff() == 0) {
            ASSERT_EQ(answer.verdict, Verdict::Touching) << pose.translation.transpose();
          }
          if (t.maxCoeff() < 2 && t.minCoeff() > 0) {
            ASSERT_EQ(answer.verdict, Verdict::Overlapping) << pose.translation.transpose();
          }
          ++verdicts[int(answer.verdict)];
          work = std::max(work, answer.steps + answer.plane_tests);
          warm = seed;
        }
      }
    }
  }
  EXPECT_LE(work, 2 * (9u + 144u + 1));  // each pair once, the seed's twice; and where the boxes touch, a cold search more
  for (int v = 1; v < 4; ++v) EXPECT_GE(verdicts[v], 500);
}

TEST(MeshLaw7, EveryFiniteTranslationEnds) {
  Random random(41);
  const MeshModel meshes[] = {unit_box().mesh(), any(random).mesh(), ball(1).mesh()};
  int invalid = 0, met = 0;
  for (int exponent = -1074; exponent <= 1023; exponent += 7) {
    for (int i = 0; i < 4; ++i) {
      Vec3 t = i == 0 ? Vec3(1, 1, 0) : random.on_sphere();
      for (double& x : t) x = std::ldexp(x, exponent);
      for (const MeshModel& a : meshes) {
        const Answer answer = distance(a, meshes[2], {i < 2 ? Mat3(Mat3::Identity()) : random.rotation(), t});
        if (answer.status == Status::InvalidPose) {
          ASSERT_EQ(answer.upper, kInfinity);
          ASSERT_GT(t.norm(), 1e44);
          ++invalid;
          continue;
        }
        ASSERT_EQ(answer.status, Status::Converged) << exponent;
        ASSERT_LE(answer.lower, t.norm() + 4);
        ASSERT_GE(answer.upper, t.norm() * (1 - 1e-15) - 4);
        met += answer.verdict == Verdict::Overlapping;
      }
    }
  }
  EXPECT_GE(invalid, 500);
  EXPECT_GE(met, 500);
}

/// A prism whose face is the letter C, which opens along x and stands along `up`; closed, one unit wide.
Soup hook(int up) {
  const double face[8][2] = {{-0.25, -1}, {1, -1}, {1, -0.75}, {0, -0.75}, {0, 0.75}, {1, 0.75}, {1, 1}, {-0.25, 1}};
  Soup soup;
  for (const double side : {-0.5, 0.5}) {
    for (const auto& [x, y] : face) {
      Vec3 p(x, side, side);
      p[up] = y;
      soup.points.push_back(p);
    }
  }
  for (const Corners& c : {Corners{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {4, 5, 6}, {4, 6, 7}}) {
    soup.triangles.push_back({c[0], c[2], c[1]});
    soup.triangles.push_back({c[0] + 8, c[1] + 8, c[2] + 8});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t next = (i + 1) % 8;
    soup.triangles.insert(soup.triangles.end(), {{i, next, next + 8}, {i, next + 8, i + 8}});
  }
  return soup;
}

/// No plane parts two hooks that touch, and no ball is in both: the search for a way out has no length to begin with.
TEST(MeshLaw7, SignedDistancesOfSolidsThatTouchEnd) {
  const Soup a = hook(2), b = hook(1);
  const MeshModel mesh_a = a.mesh(), mesh_b = b.mesh();
  ASSERT_TRUE(mesh_a.topology().closed() && mesh_b.topology().closed());
  for (const Vec3& turn : {Vec3(-1, -1, 1), Vec3(-1, 1, -1)}) {
    for (const Vec3& aside : {Vec3(0, 0, 0), Vec3(0, 0.0625, 0.03125)}) {
      const Pose pose{turn.asDiagonal(), aside};
      ASSERT_EQ(brute_force(a, b, pose), 0);
      for (const std::uint32_t steps : {0u, 100u, Budget().steps}) {
        const Options options{.budget = {.steps = steps}};
        for (const bool swapped : {false, true}) {
          const Answer answer = swapped
                                    ? signed_distance(MeshBody::solid(mesh_b), MeshBody::solid(mesh_a), inverse(pose), options)
                                    : signed_distance(MeshBody::solid(mesh_a), MeshBody::solid(mesh_b), pose, options);
          EXPECT_LE(answer.lower, 0);
          EXPECT_GE(answer.lower, -2.5);
          EXPECT_GE(answer.upper, -tolerance(mesh_a, mesh_b, pose));
        }
      }
    }
  }
}

// ---- Law 8 -----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw8, QueriesAllocateNothing) {
  ASSERT_TRUE(allocations_are_counted());
  const Body sphere = Body::point({0, 0, 0}, 0.5);
  MeshFront front;
  for (const Case& c : cases()) {
    MeshSeed seed;
    const long before = allocations;
    distance(c.mesh_a, c.mesh_b, c.pose, seed, front);
    intersects(c.mesh_a, c.mesh_b, c.pose, seed, front);
    distance(c.mesh_a, c.mesh_b, c.pose, seed);
    intersects(c.mesh_a, c.mesh_b, c.pose, seed);
    within(c.mesh_a, c.mesh_b, c.pose, 0.1, seed);
    closest_features(c.mesh_a, c.mesh_b, c.pose, seed);
    distance(c.mesh_a, sphere, c.pose, seed);
    tolerance(c.mesh_a, c.mesh_b, c.pose);
    MeshContact contact;
    if (contacts(c.mesh_a, c.mesh_b, c.pose, 10, {&contact, 1}).count > 0) manifold(c.mesh_a, c.mesh_b, c.pose, contact);
    if (contacts(c.mesh_a, sphere, c.pose, 10, {&contact, 1}).count > 0) manifold(c.mesh_a, sphere, c.pose, contact);
    signed_distance(c.mesh_a, c.mesh_b, c.pose, seed);
    const auto volume = [](const MeshModel& mesh) { return mesh.topology().closed() ? MeshBody::solid(mesh) : MeshBody(mesh); };
    distance(volume(c.mesh_a), volume(c.mesh_b), c.pose, seed);
    signed_distance(volume(c.mesh_a), volume(c.mesh_b), c.pose, seed);
    signed_distance(volume(c.mesh_a), sphere, c.pose, seed);
    struct All final : MeshVisitor {
      bool enters(const Vec3&, const Vec3&) override { return true; }
      bool visit(std::uint32_t) override { return true; }
    } all;
    visit_triangles(c.mesh_a, all);
    const long after = allocations;
    ASSERT_EQ(after, before);
  }
}

TEST(MeshLaw8, SharedMeshesAnswerAllThreadsAlike) {
  std::vector<Answer> serial;
  for (const Case& c : cases()) serial.push_back(exact(c));
  std::atomic<int> different{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < serial.size(); ++i) {
        const std::size_t k = (i * 7 + t * 31) % serial.size();
        different += !same_bits(serial[k], exact(cases()[k]));
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(different, 0);
}

// ---- Law 9 -----------------------------------------------------------------------------------------------------------------

void expect_nothing_known(const Answer& answer, Status status) {
  EXPECT_EQ(answer.status, status);
  EXPECT_EQ(answer.verdict, Verdict::Undecided);
  EXPECT_EQ(answer.lower, 0);
  EXPECT_EQ(answer.upper, kInfinity);
  EXPECT_TRUE(answer.normal.array().isNaN().all() && answer.point_a.array().isNaN().all() &&
              answer.point_b.array().isNaN().all());
  EXPECT_EQ(answer.feature_a, FeatureId{});
  EXPECT_EQ(answer.feature_b, FeatureId{});
}

TEST(MeshLaw9, ImpossibleDemandsAreSaidSo) {
  const MeshModel a = unit_box().mesh(), b = ball(1).mesh();
  const auto expect_refused = [](const MeshBody& x, const MeshBody& y, const Pose& pose, Status status) {
    MeshSeed seed;
    expect_nothing_known(distance(x, y, pose, seed), status);
    expect_nothing_known(intersects(x, y, pose, seed), status);
    const Within w = within(x, y, pose, 1, seed);
    expect_nothing_known(w.answer, status);
    EXPECT_EQ(w.decision, Decision::Undecided);
    const ClosestFeatures closest = closest_features(x, y, pose, seed);
    expect_nothing_known(closest.answer, status);
    EXPECT_EQ(closest.source_a.kind, FeatureKind::None);
    EXPECT_TRUE(std::isnan(tolerance(x, y, pose)));
    EXPECT_TRUE(check(x, y, pose, distance(x, y, pose)));
    EXPECT_FALSE(check(x, y, pose, Answer{}));
  };
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e46}) {
    Pose pose;
    pose.translation[1] = bad;
    expect_refused(a, b, pose, Status::InvalidPose);
    pose = {};
    pose.rotation(1, 2) = bad;
    expect_refused(a, b, pose, Status::InvalidPose);
  }
  Pose stretched;
  stretched.rotation *= 1 + 1e-6;
  expect_refused(a, b, stretched, Status::InvalidPose);
  for (const double bad : {-1.0, kNaN, kInfinity, 1e46}) {
    expect_refused(MeshBody(a, bad), b, {}, Status::InvalidRadius);
    expect_refused(a, MeshBody(b, bad), {}, Status::InvalidRadius);
    expect_refused(a, Body::point({0, 0, 0}, bad), {}, Status::InvalidRadius);
  }
  for (const Body& bad : {Body(), Body::point({kNaN, 0, 0}), Body::point({1e-60, 0, 0}), Body::box({1, 0, 0}, {0, 1, 1})}) {
    expect_refused(a, bad, {}, Status::InvalidBody);
    expect_refused(bad, a, {}, Status::InvalidBody);
  }
  expect_nothing_known(Answer{}, Status::NotAsked);
}

TEST(MeshLaw9, ThresholdsAreUndecidedOnlyWithinLawTwo) {
  int yes = 0, no = 0;
  for_each_case([&](const Case& c) {
    const double d = c.truth, bound = c.law_two();
    for (const double threshold :
         {0.0, 0.5 * d, d - 2 * bound, d - bound / 8, d, d + bound / 8, d + 2 * bound, 2 * d, 1.0, 1e300, kInfinity}) {
      if (threshold < 0) continue;
      const Within w = within(c.mesh_a, c.mesh_b, c.pose, threshold);
      expect_true(c, w.answer);
      ASSERT_EQ(w.answer.status == Status::Converged || w.answer.status == Status::Beyond, true) << threshold;
      if (w.decision == Decision::Undecided) {
        ASSERT_LE(std::fabs(threshold - d), bound);
      } else if (std::fabs(threshold - d) > c.slack()) {
        ASSERT_EQ(w.decision == Decision::Yes, d <= threshold) << threshold << " against " << d;
        ++(d <= threshold ? yes : no);
      }
    }
  });
  EXPECT_GE(yes, 500);
  EXPECT_GE(no, 300);
}

TEST(MeshLaw9, NonsenseAsAThresholdIsAnsweredAsOfConvexBodies) {
  const Body convex[] = {Body::box({0, 0, 0}, {1, 1, 1}), Body::box({0, 0, 0}, {1, 1, 1})};
  const MeshModel mesh = unit_box().mesh();
  for (const double x : {0.5, 3.0}) {
    for (const double threshold : {kNaN, -1.0, -kInfinity, -0.0}) {
      const Within of_convex = within(convex[0], convex[1], shift(x, 0.1, 0.2), threshold),
                   of_mesh = within(mesh, mesh, shift(x, 0.1, 0.2), threshold);
      EXPECT_EQ(of_convex.decision, of_mesh.decision) << threshold << ", " << x;
    }
    for (const Options& options :
         {Options{.absolute = kNaN}, Options{.relative = kNaN}, Options{.absolute = -1}, Options{.relative = -1},
          Options{.beyond = kNaN}, Options{.beyond = -1}, Options{.absolute = kInfinity}, Options{.relative = kInfinity}}) {
      const Answer answer = distance(mesh, mesh, shift(x, 0.1, 0.2), options);
      const double truth = x > 1 ? x - 1 : 0;
      EXPECT_LE(answer.lower, truth + 1e-15);
      EXPECT_GE(answer.upper, truth - 1e-15);
    }
  }
}

// ---- Law 10 ----------------------------------------------------------------------------------------------------------------

TEST(MeshLaw10, ALooserToleranceCostsNoMoreOnAverage) {
  const MeshModel a = ball(4).mesh(), b = torus(40, 20).mesh();
  Random random(50);
  std::array<std::uint64_t, 5> work{};
  constexpr double kTolerances[] = {0, 1e-4, 1e-2, 1e-1, 1};
  for (int i = 0; i < 60; ++i) {
    const Pose pose{random.rotation(), random.uniform(2, 4) * random.on_sphere()};
    for (std::size_t t = 0; t < std::size(kTolerances); ++t) {
      const Answer answer = distance(a, b, pose, {.relative = kTolerances[t]});
      ASSERT_EQ(answer.status, Status::Converged);
      ASSERT_LE(answer.upper - answer.lower, std::max(kTolerances[t] * answer.lower, tolerance(a, b, pose)));
      work[t] += answer.steps + answer.plane_tests;
    }
  }
  for (std::size_t t = 1; t < work.size(); ++t) EXPECT_LE(work[t], work[t - 1]) << kTolerances[t];
  EXPECT_LT(work[4], work[0] / 2);
}

// ---- Other bodies ----------------------------------------------------------------------------------------------------------

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    std::vector<Model> read;
    for (const char* name : {"fat_a", "plate", "long"})
      read.push_back(load(std::string(SWIFTLET_TEST_DIR "/data/models/") + name + ".swl").value());
    return read;
  }();
  return all;
}
Body any_convex(Random& random, double radius) {
  const auto p = [&] { return Vec3(random.in_ball()); };
  switch (random.bits() % 6) {
    case 0: return Body::point(p(), radius);
    case 1: return Body::segment(p(), p(), radius);
    case 2: return Body::triangle(p(), p(), p(), radius);
    case 3: return Body::box({-0.5, -0.25, 0}, {0.5, 0.25, 0.125}, radius);
    default: return Body(models()[random.bits() % models().size()], radius);
  }
}

/// The kernel asked about every triangle on its own, which knows nothing of trees.
TEST(MeshAndConvex, AgreeWithEveryTriangleAskedOnItsOwn) {
  Random random(60);
  std::map<Verdict, int> verdicts;
  for (int i = 0; i < 400; ++i) {
    const Soup soup = any(random);
    const MeshModel mesh = soup.mesh();
    const double radius = i % 3 ? 0 : random.uniform(0, 0.3), of_mesh = i % 5 ? 0 : random.uniform(0, 0.3);
    const Body body = any_convex(random, radius);
    const Pose pose = any_pose(random, 2);
    double lower = kInfinity, upper = kInfinity;
    bool overlapping = false;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const Answer one = distance(Body::triangle(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2), of_mesh), body, pose);
      lower = std::min(lower, one.lower), upper = std::min(upper, one.upper);
      overlapping |= one.verdict == Verdict::Overlapping;
    }
    const MeshBody a(mesh, of_mesh);
    for (const bool swapped : {false, true}) {
      const Pose at = swapped ? inverse(pose) : pose;
      const MeshBody x = swapped ? MeshBody(body) : a, y = swapped ? a : MeshBody(body);
      const double bound = tolerance(x, y, at), slack = swapped ? bound : 0;
      const Answer answer = distance(x, y, at), met = intersects(x, y, at);
      const ClosestFeatures closest = closest_features(x, y, at);
      for (const Answer* one : {&answer, &met}) {
        ASSERT_LE(one->lower, upper + slack) << i;
        ASSERT_GE(one->upper, lower - slack) << i;
        ASSERT_NE(one->verdict, Verdict::Undecided) << i;
      }
      ASSERT_EQ(answer.status, Status::Converged) << i;
      ASSERT_LE(answer.upper - answer.lower, bound * (1 + 1e-9)) << i;
      if (lower > 2 * bound) {
        ASSERT_EQ(answer.verdict, Verdict::Disjoint);
      }
      if (overlapping && !swapped) {
        ASSERT_NE(answer.verdict, Verdict::Disjoint) << i;
      }
      ASSERT_EQ(answer.verdict == Verdict::Disjoint, met.verdict == Verdict::Disjoint) << i;
      ++verdicts[answer.verdict];
      const Check checked = check(x, y, at, answer);
      ASSERT_TRUE(checked) << i << ": " << checked.message;
      ASSERT_EQ(answer.radius_a, x.radius());
      ASSERT_EQ(answer.radius_b, y.radius());
      if (closest.answer.verdict != Verdict::Disjoint) continue;
      ASSERT_NEAR((closest.answer.point_b - closest.answer.point_a).norm(), closest.answer.upper, 2 * bound) << i;
      for (const double threshold : {0.5 * lower, 1.5 * upper + bound}) {
        const Within w = within(x, y, at, threshold);
        ASSERT_EQ(w.decision, threshold > upper ? Decision::Yes : Decision::No)
            << i << ": [" << lower << ", " << upper << "], " << threshold << ": [" << w.answer.lower << ", " << w.answer.upper
            << "], status " << int(w.answer.status) << ", bound " << bound;
      }
    }
  }
  EXPECT_GE(verdicts[Verdict::Disjoint], 100);
  EXPECT_GE(verdicts[Verdict::Overlapping], 100);
}

TEST(MeshAndConvex, AModelIsSolidAndAMeshIsNot) {
  const MeshModel small = moved(scaled(ball(2), 0.1), Mat3::Identity(), {0.05, 0, 0}).mesh();
  const Soup hull = ball(2);
  EXPECT_EQ(intersects(small, Body(models()[0]), {}).verdict, Verdict::Overlapping);
  EXPECT_EQ(intersects(Body::box({-1, -1, -1}, {1, 1, 1}), small, {}).verdict, Verdict::Overlapping);
  EXPECT_EQ(intersects(small, Body::point({0.05, 0, 0}), {}).verdict, Verdict::Disjoint) << "a point inside a surface";
  const MeshModel large = hull.mesh();
  EXPECT_NEAR(distance(large, small, {}).value(),
              brute_force(hull, moved(scaled(ball(2), 0.1), Mat3::Identity(), {0.05, 0, 0}), {}), 1e-14);
  EXPECT_EQ(distance(large, small, {}).verdict, Verdict::Disjoint) << "one surface inside the other";
}

TEST(MeshAndConvex, TwoConvexBodiesAreAnsweredByTheKernel) {
  Random random(61);
  for (int i = 0; i < 300; ++i) {
    const Body a = any_convex(random, i % 2 * 0.1), b = any_convex(random, i % 3 * 0.1);
    const Pose pose = any_pose(random, 2.5);
    EXPECT_EQ(tolerance(MeshBody(a), MeshBody(b), pose), tolerance(a, b, pose)) << i;
    MeshSeed mesh_seed;
    PairSeed seed;
    for (int k = 0; k < 2; ++k) {
      ASSERT_TRUE(same_bits(distance(MeshBody(a), b, pose, mesh_seed), distance(a, b, pose, seed)));
      ASSERT_TRUE(same_bits(intersects(MeshBody(a), b, pose, mesh_seed), intersects(a, b, pose, seed)));
      const Within of_mesh = within(MeshBody(a), b, pose, 0.3, mesh_seed), plain = within(a, b, pose, 0.3, seed);
      ASSERT_TRUE(same_bits(of_mesh.answer, plain.answer));
      ASSERT_EQ(of_mesh.decision, plain.decision);
      ASSERT_TRUE(
          same_bits(closest_features(MeshBody(a), b, pose, mesh_seed).answer, closest_features(a, b, pose, seed).answer));
    }
  }
}

TEST(MeshRadii, AreSubtractedAndPointsMove) {
  Random random(62);
  int apart = 0, met = 0;
  for_each_case([&](const Case& c) {
    const double ra = random.bits() % 3 ? random.uniform(0, 1) : 0, rb = random.bits() % 3 ? random.uniform(0, 1) : 0.2;
    const MeshBody a(c.mesh_a, ra), b(c.mesh_b, rb);
    const double truth = std::max(0.0, c.truth - ra - rb), bound = tolerance(a, b, c.pose);
    for (const std::uint32_t steps : {~0u, 4u}) {
      const Answer answer = distance(a, b, c.pose, {.budget = {.steps = steps}});
      ASSERT_LE(answer.lower, truth + bound / 32);
      ASSERT_GE(answer.upper, truth - bound / 32);
      if (answer.status == Status::Budget) continue;
      ASSERT_EQ(answer.status, Status::Converged);
      ASSERT_LE(answer.upper - answer.lower, bound * (1 + 1e-9));
      if (answer.verdict == Verdict::Overlapping) {
        ASSERT_LE(c.truth, ra + rb);
      }
      if (answer.verdict == Verdict::Disjoint) {
        ASSERT_GT(answer.lower, 0);
      }
      if (truth > 2 * bound) {
        ASSERT_EQ(answer.verdict, Verdict::Disjoint);
      }
      if (c.truth < ra + rb - 2 * bound) {
        ASSERT_EQ(answer.verdict, Verdict::Overlapping);
      }
      ++(answer.verdict == Verdict::Disjoint ? apart : met);
      if (answer.verdict != Verdict::Disjoint) continue;
      ASSERT_NEAR((answer.point_b - answer.point_a).norm(), truth, 2 * bound);
      ASSERT_NEAR(brute_force(point_soup(answer.point_a), c.a, {}), ra, 2 * bound);
      ASSERT_NEAR(brute_force(point_soup(answer.point_b), c.b, c.pose), rb, 2 * bound);
    }
    const Answer met_answer = intersects(a, b, c.pose);
    if (truth > bound) {
      ASSERT_EQ(met_answer.verdict, Verdict::Disjoint);
    }
    if (c.truth < ra + rb - bound) {
      ASSERT_EQ(met_answer.verdict, Verdict::Overlapping);
    }
    for (const double threshold : {0.5 * truth, truth + 0.1}) {
      const Within w = within(a, b, c.pose, threshold);
      if (std::fabs(threshold - truth) > bound) {
        ASSERT_EQ(w.decision, truth <= threshold ? Decision::Yes : Decision::No);
      }
    }
  });
  EXPECT_GE(apart, 30);
  EXPECT_GE(met, 100);
}

TEST(ClosestMeshFeatures, NameTheUsersPointsAndTriangles) {
  std::map<FeatureKind, int> kinds;
  for_each_case([&](const Case& c) {
    const ClosestFeatures closest = closest_features(c.mesh_a, c.mesh_b, c.pose);
    const Answer& answer = closest.answer;
    expect_law_two(c, answer);
    for (const bool of_a : {true, false}) {
      const Soup& soup = of_a ? c.a : c.b;
      const MeshModel& mesh = of_a ? c.mesh_a : c.mesh_b;
      const SourceFeature& source = of_a ? closest.source_a : closest.source_b;
      const FeatureId feature = of_a ? answer.feature_a : answer.feature_b;
      ASSERT_EQ(source.kind, feature.kind());
      ++kinds[source.kind];
      Soup named;
      if (source.kind == FeatureKind::Vertex) {
        ASSERT_EQ(mesh.source_vertex()[feature.index()], source.vertices[0]);
        ASSERT_EQ(source.vertices[1], kNone);
        named = point_soup(soup.points[source.vertices[0]]);
      } else if (source.kind == FeatureKind::Edge) {
        ASSERT_NE(source.vertices[0], source.vertices[1]);
        named = {{soup.points[source.vertices[0]], soup.points[source.vertices[1]]}, {{0, 1, 0}}};
      } else {
        ASSERT_EQ(source.kind, FeatureKind::Face);
        ASSERT_EQ(source.triangles.size(), 1u);
        named = {soup.points, {soup.triangles[source.triangles[0]]}};
      }
      if (answer.verdict == Verdict::Overlapping) continue;
      const Vec3 p = of_a ? answer.point_a : answer.point_b;
      ASSERT_LE(brute_force(point_soup(p), named, of_a ? Pose{} : c.pose), c.law_two());
    }
  });
  EXPECT_GE(kinds[FeatureKind::Vertex], 20);
  EXPECT_GE(kinds[FeatureKind::Edge], 20);
  EXPECT_GE(kinds[FeatureKind::Face], 20);
}

TEST(ClosestMeshFeatures, StopBeyond) {
  for_each_case([](const Case& c) {
    const ClosestFeatures closest = closest_features(c.mesh_a, c.mesh_b, c.pose, {.beyond = 0.5 * c.truth});
    expect_true(c, closest.answer);
    ASSERT_TRUE(closest.answer.status == Status::Beyond || closest.answer.status == Status::Converged);
    if (closest.answer.upper == kInfinity) {
      ASSERT_EQ(closest.source_a.kind, FeatureKind::None);
    }
  });
}

TEST(MeshBatches, AnswerAsTheQueriesDoOnAnyNumberOfThreads) {
  const Case& c = cases()[1];
  Random random(77);
  std::vector<Pose> poses;
  for (int i = 0; i < 3000; ++i) poses.push_back(any_pose(random, 3.5));
  std::vector<Answer> alone(poses.size());
  MeshSeed seed;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % kPosesPerChunk == 0) seed = {};
    alone[i] = distance(c.mesh_a, c.mesh_b, poses[i], seed);
  }
  for (const unsigned threads : {1u, 3u}) {
    const swiftlet::Run run{on_threads(threads), {}};
    std::vector<Answer> answers(poses.size());
    distance(c.mesh_a, c.mesh_b, poses, answers, {}, run);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      ASSERT_EQ(answers[i].lower, alone[i].lower);
      ASSERT_EQ(answers[i].upper, alone[i].upper);
      ASSERT_EQ(answers[i].steps, alone[i].steps);
    }
    std::vector<MeshPairQuery> pairs;
    for (const Case& of : cases()) pairs.push_back({of.mesh_a, of.mesh_b, of.pose});
    std::vector<Within> within_one(pairs.size());
    within(pairs, 1, within_one, {}, run);
    std::vector<ClosestFeatures> closest(pairs.size());
    closest_features(pairs, closest, {}, run);
    std::vector<Answer> met(pairs.size());
    intersects(pairs, met, {}, run);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const MeshPairQuery& q = pairs[i];
      ASSERT_EQ(within_one[i].decision, within(q.a, q.b, q.b_in_a, 1).decision);
      ASSERT_EQ(closest[i].answer.feature_a, closest_features(q.a, q.b, q.b_in_a).answer.feature_a);
      ASSERT_EQ(met[i].verdict, intersects(q.a, q.b, q.b_in_a).verdict);
    }
  }
}

// ---- Registers -------------------------------------------------------------------------------------------------------------

TEST(MeshRegisters, AreLeftAsTheyWere) {
  if (!upper_halves_can_be_seen()) GTEST_SKIP() << "this processor does not tell";
  use_upper_halves();
  ASSERT_TRUE(upper_halves_are_in_use());
  const MeshModel a = torus(24, 12).mesh(), b = ball(3).mesh();
  Random random(11);
  MeshSeed seeds[4];
  MeshFront front;
  int left = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose pose{random.rotation(), random.uniform(0, i % 2 ? 2 : 8) * random.on_sphere()};
    left += leaves_upper_halves_in_use([&] { distance(a, b, pose, seeds[0]); });
    left += leaves_upper_halves_in_use([&] { intersects(a, b, pose, seeds[1]); });
    left += leaves_upper_halves_in_use([&] { within(a, b, pose, random.uniform(0, 2), seeds[2]); });
    left += leaves_upper_halves_in_use([&] { distance(a, b, pose, seeds[3], front); });
    left += leaves_upper_halves_in_use([&] { closest_features(a, b, pose); });
  }
  EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace swiftlet
