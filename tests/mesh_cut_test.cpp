// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes that were cut: what is left of them, of their files, and what queries still say.
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "folder.h"
#include "mesh_blocks.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MeshModel cut_after(const MeshModel& mesh, int levels) {
  const MeshModel cut = levels < mesh.depth() ? mesh.cut({std::nextafter(mesh.deviation(levels), kInfinity)}) : mesh;
  EXPECT_LE(cut.level_count(), levels);
  return cut;
}
/// The least distance over all pairs of triangles, in long doubles.
double distance_by_all_pairs(const Soup& a, const Soup& b, const Pose& pose) {
  const auto of_a = triangles<long double>(a), of_b = triangles<long double>(b, pose);
  double least = kInfinity;
  for (const auto& s : of_a) {
    for (const auto& t : of_b) least = std::min(least, double(nearest(s, t).squared));
  }
  return std::sqrt(least);
}

TEST(Cut, LeavesLevelsOfBoxes) {
  const MeshModel mesh = torus(40, 20).mesh();
  ASSERT_GE(mesh.depth(), 3);
  EXPECT_TRUE(mesh.is_whole());
  EXPECT_EQ(mesh.deviation(), 0);
  EXPECT_EQ(mesh.cut({}).hash(), mesh.hash());
  std::size_t bytes = 0;
  for (int levels = 1; levels < mesh.depth(); ++levels) {
    EXPECT_LT(mesh.deviation(levels), levels > 1 ? mesh.deviation(levels - 1) : kInfinity);
    const MeshModel cut = cut_after(mesh, levels);
    EXPECT_FALSE(cut.is_whole());
    EXPECT_EQ(cut.level_count(), levels);
    EXPECT_EQ(cut.depth(), mesh.depth());
    EXPECT_EQ(cut.deviation(), mesh.deviation(levels));
    EXPECT_EQ(cut.triangle_count(), 0u);
    EXPECT_EQ(cut.extent(), mesh.extent());
    EXPECT_EQ(cut.topology(), mesh.topology());
    EXPECT_GT(cut.bytes().size(), bytes);
    bytes = cut.bytes().size();
    EXPECT_EQ(mesh.cut({0, bytes}).level_count(), levels);
    EXPECT_EQ(cut_after(cut, 1).hash(), cut_after(mesh, 1).hash());
    EXPECT_FALSE(verify(cut));
  }
  EXPECT_LT(bytes, mesh.bytes().size());
  EXPECT_EQ(tetrahedron().mesh().cut({1e9}).level_count(), 1);
  EXPECT_TRUE(tetrahedron().mesh().cut({1e9}).is_whole());
}

/// Intervals hold the truth and are no wider than both deviations, whatever is cut and of whatever size.
TEST(Cut, AnswersAsPreciselyAsItsBoxesAre) {
  Random random(41);
  int disjoint = 0, undecided = 0;
  for (int i = 0; i < 300; ++i) {
    const double unit = i % 5 == 0 ? 0x1p-80 : i % 5 == 1 ? 0x1p130 : 1;
    // Specks far from each other: boxes that are small beside their place in a node.
    const Soup specks = scattered(random, 12, 1e-8);
    const Soup a = scaled(i % 3 == 0 ? specks
                          : i % 2    ? torus(10, 6)
                                     : any(random),
                          unit),
               b = scaled(any(random), unit * (i % 7 ? 1 : 0x1p-12));
    const Pose pose{random.rotation(), unit * random.uniform(0, 5) * random.on_sphere()};
    const MeshModel whole_a = a.mesh(), whole_b = b.mesh();
    const double truth = distance_by_all_pairs(a, b, pose), law_two = tolerance(whole_a, whole_b, pose);
    for (int levels_a = 1; levels_a <= whole_a.depth(); ++levels_a) {
      for (int levels_b = 1; levels_b <= whole_b.depth(); ++levels_b) {
        const MeshModel cut_a = cut_after(whole_a, levels_a), cut_b = cut_after(whole_b, levels_b);
        const double width = cut_a.deviation() + cut_b.deviation();
        if (width == 0) continue;
        MeshSeed seed;
        for (int pass = 0; pass < 2; ++pass) {
          const Answer answer = distance(cut_a, cut_b, pose, seed);
          ASSERT_LE(answer.lower, truth + law_two);
          ASSERT_GE(answer.upper, truth - law_two);
          ASSERT_LE(answer.upper - answer.lower, width + 2 * law_two);
          ASSERT_TRUE(answer.status == Status::LevelLimit || answer.upper - answer.lower <= law_two) << int(answer.status);
          ASSERT_TRUE(answer.verdict == Verdict::Undecided || (answer.verdict == Verdict::Disjoint && answer.lower > 0));
          ++(answer.verdict == Verdict::Disjoint ? disjoint : undecided);
          EXPECT_EQ(answer.feature_a.kind() == FeatureKind::None || cut_a.is_whole(), true);
          EXPECT_LE(std::fabs((answer.point_b - answer.point_a).norm() - truth), width + 2 * law_two);
        }
        const Answer loose = distance(cut_a, cut_b, pose, seed, {.absolute = width + 3 * law_two});
        EXPECT_EQ(loose.status, Status::Converged);
        EXPECT_LE(loose.lower, truth + law_two);
        for (const double threshold : {0.5 * truth, 1.5 * truth, truth + 1.1 * width}) {
          const Within answer = within(cut_a, cut_b, pose, threshold, seed);
          EXPECT_TRUE(answer.decision != Decision::Yes || threshold >= truth - law_two);
          EXPECT_TRUE(answer.decision != Decision::No || threshold <= truth + law_two);
          if (answer.decision == Decision::Undecided) {
            EXPECT_LE(std::fabs(threshold - truth), width + 2 * law_two);
            EXPECT_EQ(answer.answer.status, Status::LevelLimit);
          }
        }
        const Answer met = intersects(cut_a, cut_b, pose);
        EXPECT_TRUE(met.verdict == Verdict::Disjoint ? truth > 0 : met.verdict == Verdict::Undecided);
      }
    }
  }
  EXPECT_GE(disjoint, 500);
  EXPECT_GE(undecided, 200);
}

TEST(Cut, AgainstConvexBodiesAndWithRadii) {
  Random random(42);
  for (int i = 0; i < 200; ++i) {
    const Soup a = torus(12, 8);
    const MeshModel whole = a.mesh(), cut = cut_after(whole, 1 + int(random.bits() % unsigned(whole.depth() - 1)));
    const Body ball = Body::point(random.in_ball(), 0.25);
    const Pose pose{random.rotation(), random.uniform(0, 4) * random.on_sphere()};
    const Answer exact = distance(MeshBody(whole, 0.1), ball, pose), answer = distance(MeshBody(cut, 0.1), ball, pose);
    EXPECT_LE(answer.lower, exact.upper + 1e-12);
    EXPECT_GE(answer.upper, exact.lower - 1e-12);
    EXPECT_LE(answer.upper - answer.lower, cut.deviation() + 1e-12);
  }
}

TEST(Cut, HasNoFeaturesContactsOrVolume) {
  const MeshModel cut = cut_after(torus(40, 20).mesh(), 1);
  const Pose pose{Mat3::Identity(), Vec3(5, 0, 0)};
  const ClosestFeatures closest = closest_features(cut, cut, pose);
  EXPECT_EQ(closest.answer.status, Status::LevelLimit);
  EXPECT_EQ(closest.source_a.kind, FeatureKind::None);
  EXPECT_EQ(contacts(cut, cut, pose, 10, {}).status, Status::LevelLimit);
  EXPECT_EQ(distance(MeshBody::solid(cut), cut, pose).status, Status::InvalidBody);
  EXPECT_FALSE(check(cut, cut, pose, distance(cut, cut, pose)));
  EXPECT_EQ(signed_distance(cut, cut, pose).lower, distance(cut, cut, pose).lower);
  const Answer met = signed_distance(cut, cut, {});
  EXPECT_EQ(met.lower, -kInfinity);
  EXPECT_GE(met.upper, 0);
  EXPECT_EQ(met.status, Status::LevelLimit);
}

/// Where a mesh that was cut lies in a solid, nothing tells that it does: the interval begins at 0.
TEST(Cut, InsideOfASolidIsNotApart) {
  const MeshModel outer = scaled(ball(3), 10).mesh(), cut = cut_after(ball(3).mesh(), 1);
  for (const double x : {0.0, 3.0, 9.0, 9.99}) {
    const Pose pose{Mat3::Identity(), Vec3(x, 0.1, 0)};
    for (const Answer& answer : {distance(MeshBody::solid(outer), cut, pose), intersects(MeshBody::solid(outer), cut, pose),
                                 distance(cut, MeshBody::solid(outer), inverse(pose))}) {
      EXPECT_EQ(answer.lower, 0) << x;
      EXPECT_EQ(answer.verdict, Verdict::Undecided) << x;
      EXPECT_EQ(answer.status, Status::LevelLimit) << x;
    }
    EXPECT_NE(within(MeshBody::solid(outer), cut, pose, 0.5).decision, Decision::No);
  }
  EXPECT_EQ(distance(MeshBody::solid(outer), cut, {Mat3::Identity(), Vec3(30, 0, 0)}).verdict, Verdict::Disjoint);
}

/// Where a plane parts it from a solid, the interval is as narrow as beside a surface.
TEST(Cut, BesideASolidIsAsPreciseAsBesideASurface) {
  const Soup cube = box({-1, -1, -1}, {1, 1, 1}), small = scaled(ball(3), 0.5);
  const MeshModel outer = cube.mesh(), whole = small.mesh();
  Random random(47);
  for (int levels = 2; levels < whole.depth(); ++levels) {
    const MeshModel cut = cut_after(whole, levels);
    for (int i = 0; i < 20; ++i) {
      const Pose pose{random.rotation(), Vec3(1.6 + 0.02 * i + cut.deviation(), 0.1, -0.2)};
      const double truth = distance_by_all_pairs(cube, small, pose);
      for (const Answer& answer :
           {distance(MeshBody::solid(outer), cut, pose), distance(cut, MeshBody::solid(outer), inverse(pose))}) {
        EXPECT_LE(answer.lower, truth + 1e-12);
        EXPECT_GE(answer.upper, truth - 1e-12);
        EXPECT_LE(answer.upper - answer.lower, cut.deviation() + 1e-12);
        EXPECT_EQ(answer.verdict, Verdict::Disjoint);
      }
    }
  }
}

/// A hull with one coarse level, both from eight corners: the coarse one twice as large.
Model without_its_exact_level() {
  std::array<std::vector<Vec3>, 2> corners;
  for (const int k : {0, 1}) {
    for (int i = 0; i < 8; ++i)
      corners[std::size_t(k)].push_back((k + 1) * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  }
  constexpr std::array<std::uint32_t, 24> kSides{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  constexpr std::array<std::uint32_t, 6> kSizes{4, 4, 4, 4, 4, 4};
  std::array<LevelArrays, 2> levels;
  for (const std::size_t k : {0u, 1u}) {
    levels[k].vertices = corners[k];
    levels[k].face_vertices = kSides;
    levels[k].face_sizes = kSizes;
  }
  const Result<Model> model = Model::from_levels(levels);
  EXPECT_TRUE(model) << model.error().message;
  Result<Model> cut = model.value().cut({std::numeric_limits<double>::max()});
  EXPECT_EQ(cut.value().finest_level(), 1);
  return std::move(cut).value();
}

/// Of a convex model that was cut only its centre is known to be in it: a solid that may hold it is not said to be apart, and
/// what is said is as wide as its finest level deviates.
TEST(Cut, ConvexModelBesideAMeshIsOfItsFinestLevel) {
  const Model cut = without_its_exact_level();
  const MeshModel outer = scaled(ball(3), 100).mesh();
  for (const MeshBody& mesh : {MeshBody(outer), MeshBody::solid(outer)}) {
    const Pose away{Mat3::Identity(), Vec3(105, 0.1, 0.2)};
    const Answer answer = distance(mesh, Body(cut), away);
    EXPECT_EQ(answer.status, Status::LevelLimit);
    EXPECT_EQ(answer.verdict, Verdict::Disjoint);
    EXPECT_LE(answer.lower, 4);
    EXPECT_GE(answer.upper, 4);
  }
  const Answer inside = distance(MeshBody::solid(outer), Body(cut), Pose{});
  EXPECT_EQ(inside.verdict, Verdict::Overlapping);
  EXPECT_EQ(inside.point_a, inside.point_b);
  EXPECT_LE(inside.point_a.cwiseAbs().maxCoeff(), 1);  // a point of the exact hull
}

/// Corners of a coarser level are no points of the exact hull: an overlap of theirs is none.
TEST(Cut, ConvexModelHasTheDepthOfItsExactHull) {
  const Model cut = without_its_exact_level();
  const MeshModel cube = box({-1, -1, -1}, {1, 1, 1}).mesh();
  Random random(45);
  int apart = 0, overlapping = 0, limited = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose pose{Mat3::Identity(), Vec3(random.uniform(-4, 4), random.uniform(-2, 2), random.uniform(-2, 2))};
    const Vec3 gap = pose.translation.cwiseAbs() - Vec3(2, 2, 2);
    const double depth = gap.maxCoeff(), truth = depth > 0 ? gap.cwiseMax(0).norm() : depth;
    (depth > 0 ? apart : overlapping)++;
    for (const bool swapped : {false, true}) {
      const MeshBody solid = MeshBody::solid(cube), model = Body(cut);
      const MeshBody &a = swapped ? model : solid, &b = swapped ? solid : model;
      const Pose at = swapped ? inverse(pose) : pose;
      const Answer answer = signed_distance(a, b, at);
      EXPECT_LE(answer.lower, truth + 1e-12);
      EXPECT_GE(answer.upper, truth - 1e-12);
      EXPECT_TRUE(answer.status == Status::LevelLimit || answer.upper - answer.lower <= tolerance(a, b, at));
      limited += answer.status == Status::LevelLimit;
      for (const double threshold : {-0.5, -1e-3}) {
        const Decision decision = signed_within(a, b, at, threshold).decision;
        EXPECT_TRUE(decision == Decision::Undecided || (decision == Decision::Yes) == (truth <= threshold)) << truth;
      }
    }
  }
  EXPECT_GE(apart, 50);
  EXPECT_GE(overlapping, 50);
  EXPECT_GE(limited, 200);
}

/// Regions of a coarser level may be none of the body's: they are not counted, and their intervals hold its distance.
TEST(Cut, ConvexModelHasContactsThatAreNotCounted) {
  const Model cut = without_its_exact_level();
  const MeshModel cube = box({-1, -1, -1}, {1, 1, 1}).mesh();
  int stored = 0, none = 0;
  for (const double x : {2.01, 2.1, 2.2, 5.0}) {  // the exact hull is apart by x - 2, and the coarse one by x - 3
    const Pose pose{Mat3::Identity(), Vec3(x, 0.1, 0.2)};
    for (const bool swapped : {false, true}) {
      std::array<MeshContact, 4> found;
      const MeshContacts told =
          swapped ? contacts(Body(cut), cube, inverse(pose), 0.25, found) : contacts(cube, Body(cut), pose, 0.25, found);
      EXPECT_FALSE(told.is_counted);
      EXPECT_EQ(told.status, Status::LevelLimit);
      stored += int(told.stored), none += told.stored == 0;
      for (std::uint32_t i = 0; i < told.stored; ++i) {
        EXPECT_LE(found[i].lower, x - 2);
        EXPECT_GE(found[i].upper, x - 2);
        EXPECT_NE(found[i].verdict, Verdict::Overlapping);
      }
      std::span<MeshContact> no_room;
      EXPECT_EQ(contacts(cube, Body(cut), pose, 0.25, no_room).status, told.stored > 0 ? Status::Budget : Status::LevelLimit);
    }
  }
  EXPECT_EQ(stored, 6);
  EXPECT_EQ(none, 2);
}

TEST(Cut, ScalesBitForBit) {
  Random random(43);
  for (int i = 0; i < 100; ++i) {
    const Soup a = torus(10, 6);
    const Pose pose{random.rotation(), random.uniform(1, 5) * random.on_sphere()};
    const MeshModel one = cut_after(a.mesh(), 1 + i % 2);
    const Answer answer = distance(one, one, pose);
    for (const double factor : {0x1p-80, 0x1p100}) {
      const MeshModel other = cut_after(scaled(a, factor).mesh(), 1 + i % 2);
      const Answer of_other = distance(other, other, {pose.rotation, factor * pose.translation});
      EXPECT_EQ(of_other.lower, factor * answer.lower);
      EXPECT_EQ(of_other.upper, factor * answer.upper);
    }
  }
}

class CutFile : public FolderTest {};

TEST_F(CutFile, IsLoadedAsFarAsItIsWanted) {
  const MeshModel mesh = torus(60, 30).mesh();
  const std::filesystem::path file = this->path("torus.swm");
  ASSERT_TRUE(save(mesh, file));
  for (int levels = 1; levels < mesh.depth(); ++levels) {
    const Detail detail{std::nextafter(mesh.deviation(levels), kInfinity)};
    const Result<MeshModel> part = load_mesh(file, detail);
    ASSERT_TRUE(part) << part.error().message;
    EXPECT_EQ(part.value().hash(), mesh.cut(detail).hash());
    ASSERT_TRUE(save(part.value(), this->path("part.swm")));
    EXPECT_EQ(load_mesh(this->path("part.swm")).value().hash(), part.value().hash());
  }
  EXPECT_EQ(load_mesh(file, {0, mesh.bytes().size()}).value().hash(), mesh.hash());
}

/// However much of a file is missing, its complete levels are read.
TEST_F(CutFile, ThatEndsEarlyIsSalvaged) {
  const MeshModel mesh = torus(60, 30).mesh();
  const soups::Block whole = bytes_of(mesh);
  const MeshHeader header = header_of(whole);
  const std::filesystem::path file = this->path("short.swm");
  const auto write = [&](std::size_t bytes) {
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(whole.data()), std::streamsize(bytes));
  };
  Random random(44);
  std::vector<std::size_t> lengths{0, 7, sizeof header - 1, sizeof header, whole.size() - 1, whole.size()};
  for (const Section* s : {&header.level[0], &header.level[1], &header.level[2], &header.triangles})
    lengths.insert(lengths.end(), {s->offset, s->offset + s->bytes - 1, s->offset + s->bytes});
  for (int i = 0; i < 100; ++i) lengths.push_back(random.bits() % whole.size());
  for (const std::size_t bytes : lengths) {
    write(bytes);
    const Result<SalvagedMesh> salvaged = salvage_mesh(file);
    int complete = 0;
    while (complete < mesh.depth() && header.level[complete].offset + header.level[complete].bytes <= bytes) ++complete;
    if (bytes < sizeof header || complete == 0) {
      EXPECT_FALSE(salvaged) << bytes;
      continue;
    }
    ASSERT_TRUE(salvaged) << bytes << ": " << salvaged.error().message;
    const MeshModel& left = salvaged.value().mesh;
    EXPECT_EQ(salvaged.value().note.empty(), bytes == whole.size());
    EXPECT_EQ(left.is_whole(), bytes == whole.size());
    if (!left.is_whole()) {
      EXPECT_EQ(left.level_count(), std::min(complete, mesh.depth() - 1));
    }
    const Pose pose{Mat3::Identity(), Vec3(4, 0, 0)};
    const Answer answer = distance(left, left, pose), exact = distance(mesh, mesh, pose);
    EXPECT_LE(answer.lower, exact.upper);
    EXPECT_GE(answer.upper, exact.lower);
  }
  EXPECT_FALSE(salvage_mesh(this->path("absent.swm")));
  soups::Block damaged = whole;
  damaged[header.level[1].offset + 5] ^= std::byte{1};
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(damaged.data()), std::streamsize(header.level[2].offset + header.level[2].bytes));
  EXPECT_FALSE(salvage_mesh(file)) << "its nodes are damaged";
}

/// Of one level nothing can be left out: the file is refused as short, and not for what a cut block would lack.
TEST_F(CutFile, OfOneLevelThatEndsEarlyIsRefusedAsShort) {
  const soups::Block whole = bytes_of(tetrahedron().mesh());
  for (std::size_t missing = 1; missing + sizeof(MeshHeader) <= whole.size(); missing += 7) {
    const Result<SalvagedMesh> salvaged = salvage_mesh(write_file("one.swm", std::span(whole).first(whole.size() - missing)));
    ASSERT_FALSE(salvaged);
    EXPECT_EQ(salvaged.error().code, ErrorCode::BadFormat);
    for (const std::string& part :
         {"one.swm: it has " + std::to_string(whole.size() - missing) + " bytes", "header says " + std::to_string(whole.size()),
          std::string("one level"), "last " + std::to_string(missing) + " bytes"})
      EXPECT_NE(salvaged.error().message.find(part), std::string::npos) << salvaged.error().message;
  }
}

}  // namespace
}  // namespace swiftlet
