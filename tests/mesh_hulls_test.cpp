// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hulls of nodes: how they are built, what a block with them must be, and that queries with them answer as those without.
#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh_front.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "mesh_blocks.h"
#include "painted_stack.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

Mesh mesh_of(const Soup& soup) { return {soup.points, soup.triangles}; }
MeshModel made(const Result<MeshModel>& result) {
  if (!result) throw std::runtime_error(result.error().message);
  return result.value();
}
HullOptions everywhere() {
  HullOptions options;
  options.levels = 16, options.least_triangles = 1, options.bytes_per_triangle = 1e6;
  return options;
}
MeshModel hulled(const Soup& soup) { return made(build_mesh(mesh_of(soup), everywhere())); }
Pose any_pose(Random& random, double distance) { return {random.rotation(), distance * random.on_sphere()}; }

TEST(BuildMesh, GivesTheLargestNodesHullsAsLongAsTheyFit) {
  const Soup soup = torus(60, 24);
  const MeshModel plain = soup.mesh(), usual = made(build_mesh(mesh_of(soup))), all = hulled(soup);
  EXPECT_EQ(plain.hull_count(), 0u);
  EXPECT_GE(usual.hull_count(), 1u);
  EXPECT_EQ(all.hull_count(), all.node_count());
  EXPECT_LE(double(usual.bytes().size()), 120 * double(usual.triangle_count()));
  EXPECT_TRUE(verify(usual));
  EXPECT_TRUE(verify(all));
  HullOptions none;
  none.bytes_per_triangle = 0;
  EXPECT_EQ(made(build_mesh(mesh_of(soup), none)).hash(), plain.hash());
  EXPECT_EQ(made(rebuild_hulls(all, none)).hash(), plain.hash());
  EXPECT_EQ(made(rebuild_hulls(usual)).hash(), usual.hash());
}

TEST(BuildMesh, SavesAndLoads) {
  const MeshModel mesh = hulled(ball(3));
  const MeshModel copy = made(load_mesh(mesh.bytes()));
  EXPECT_EQ(copy.hash(), mesh.hash());
  EXPECT_EQ(copy.hull_count(), mesh.hull_count());
  EXPECT_TRUE(verify(copy));
}

TEST(BuildMesh, MakesTheSameBytesOnAnyThreads) {
  const Soup soup = torus(50, 20);
  const Executor threads = on_threads(3);
  HullOptions options = everywhere();
  options.executor = threads;
  EXPECT_EQ(made(build_mesh(mesh_of(soup), options)).hash(), hulled(soup).hash());
}

TEST(BuildMesh, ReportsProgressAndStopsWhereTold) {
  const Mesh mesh = mesh_of(torus(80, 40));
  HullOptions options = everywhere();
  std::vector<double> fractions;
  options.progress = [&](double done, std::string_view) { return fractions.push_back(done), true; };
  ASSERT_TRUE(build_mesh(mesh, options));
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.size(), 20u);
  EXPECT_EQ(fractions.back(), 1);
  for (const double until : {0.0, 0.3, 0.7}) {
    options.progress = [until](double done, std::string_view) { return done < until; };
    const Result<MeshModel> stopped = build_mesh(mesh, options);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::Cancelled);
  }
}

TEST(BuildMesh, RefusesWhatNoMeshIs) {
  EXPECT_EQ(build_mesh({}).error().code, ErrorCode::Empty);
  EXPECT_EQ(build_mesh({{Vec3(0, 0, 0)}, {{0, 0, 1}}}).error().code, ErrorCode::BadValue);
  HullOptions options;
  options.levels = 0;
  EXPECT_EQ(build_mesh(mesh_of(ball(1)), options).error().code, ErrorCode::BadValue);
  options = {};
  options.bytes_per_triangle = std::nan("");
  for (const std::uint32_t least_patch : {0u, 2u}) {
    options.least_patch = least_patch;
    EXPECT_EQ(build_mesh(mesh_of(ball(1)), options).error().code, ErrorCode::BadValue);
  }
}

/// Points, segments and flat pieces have hulls too.
TEST(BuildMesh, TakesFlatAndTinyMeshes) {
  for (const Soup& soup : {patch(3, [](double, double) { return 0.0; }), Soup{{Vec3(1, 2, 3)}, {{0, 0, 0}}},
                           Soup{{Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(2, 2, 0)}, {{0, 1, 2}, {0, 2, 2}}},
                           scaled(ball(1), 0x1p-140), scaled(ball(1), 0x1p140)}) {
    const MeshModel mesh = hulled(soup), plain = soup.mesh();
    EXPECT_TRUE(verify(mesh));
    const double size = std::max(mesh.extent(), 0x1p-149);
    const Pose pose{Mat3::Identity(), Vec3(5 * size, 0, 0)};
    const Answer with = distance(mesh, mesh, pose), without = distance(plain, plain, pose);
    EXPECT_LE(std::fabs(with.lower - without.lower), tolerance(mesh, mesh, pose));
    EXPECT_EQ(with.verdict, without.verdict);
  }
}

/// Whatever the question, with hulls or without.
TEST(Hulls, AnswerAsBoxesDo) {
  Random random(31);
  int disjoint = 0, overlapping = 0;
  for (int i = 0; i < 400; ++i) {
    const Soup a = any(random), b = any(random);
    const MeshModel boxes_a = a.mesh(), boxes_b = b.mesh(), hulls_a = hulled(a), hulls_b = hulled(b);
    const Body convex = i % 4 ? Body::point(random.in_ball(), 0.1) : Body::box(Vec3(-0.3, -0.2, -0.1), Vec3(0.1, 0.2, 0.3));
    const Pose pose = any_pose(random, random.uniform(0.2, 4));
    const double radius = i % 3 == 0 ? 0.05 : 0;
    const auto compare = [&](const MeshBody& plain, const MeshBody& with, const MeshBody& plain_b, const MeshBody& with_b) {
      const double law_two = tolerance(plain, plain_b, pose);
      const Answer expected = distance(plain, plain_b, pose);
      MeshSeed seed;
      for (int pass = 0; pass < 2; ++pass) {
        const Answer answer = distance(with, with_b, pose, seed);
        ASSERT_EQ(answer.status, Status::Converged);
        EXPECT_LE(answer.upper - answer.lower, law_two);
        EXPECT_LE(std::fabs(answer.upper - expected.upper), law_two);
        EXPECT_EQ(answer.verdict, expected.verdict);
        EXPECT_EQ(intersects(with, with_b, pose, seed).verdict, expected.verdict);
        const double threshold = expected.upper * random.uniform(0.5, 1.5);
        if (std::fabs(threshold - expected.upper) > 2 * law_two) {
          EXPECT_EQ(within(with, with_b, pose, threshold, seed).decision,
                    threshold > expected.upper ? Decision::Yes : Decision::No);
        }
        EXPECT_LE(distance(with, with_b, pose, seed, {.relative = 0.1}).lower, expected.upper + law_two);
      }
      ++(expected.verdict == Verdict::Disjoint ? disjoint : overlapping);
      EXPECT_TRUE(check(with, with_b, pose, distance(with, with_b, pose)));
    };
    compare({boxes_a, radius}, {hulls_a, radius}, {boxes_b, radius}, {hulls_b, radius});
    compare({boxes_a, radius}, {hulls_a, radius}, {boxes_b, radius}, {boxes_b, radius});
    compare({boxes_a, radius}, {hulls_a, radius}, convex, convex);
    if (HasFatalFailure()) FAIL() << "pair " << i;
  }
  EXPECT_GE(disjoint, 300);
  EXPECT_GE(overlapping, 100);
}

/// Apart, the hulls of nearly convex bodies answer, and their nearest points lie on the surfaces: one pair of nodes is opened.
TEST(Hulls, OfConvexBodiesAnswerAtTheRoot) {
  Random random(32);
  const MeshModel boxes = ball(4).mesh(), hulls = hulled(ball(4));
  MeshSeed seed_of_boxes, seed_of_hulls;
  std::uint64_t opened_by_boxes = 0, opened_by_hulls = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose pose = any_pose(random, random.uniform(3.5, 6));
    opened_by_boxes += distance(boxes, boxes, pose, seed_of_boxes).steps;
    opened_by_hulls += distance(hulls, hulls, pose, seed_of_hulls).steps;
  }
  EXPECT_LE(opened_by_hulls, 220u);
  EXPECT_GE(opened_by_boxes, 1000u);
}

/// A box each of whose sides is cut into cells times cells squares.
Soup fine_box(std::uint32_t cells, const Vec3& middle, const Vec3& half) {
  Soup soup;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double way : {-1., 1.}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = std::uint32_t(soup.points.size());
      for (std::uint32_t i = 0; i <= cells; ++i) {
        for (std::uint32_t j = 0; j <= cells; ++j) {
          Vec3 p;
          p[axis] = way, p[u] = 2. * i / cells - 1, p[v] = 2. * j / cells - 1;
          soup.points.push_back(middle + p.cwiseProduct(half));
          if (i == cells || j == cells) continue;
          const std::uint32_t at = first + i * (cells + 1) + j, beside = at + cells + 1;
          if (way > 0) {
            soup.triangles.push_back({at, beside, beside + 1}), soup.triangles.push_back({at, beside + 1, at + 1});
          } else {
            soup.triangles.push_back({at, beside + 1, beside}), soup.triangles.push_back({at, at + 1, beside + 1});
          }
        }
      }
    }
  }
  return soup;
}

/// Of the many triangles of a face the one at the hull's nearest point is found, whatever the pose of the query before.
TEST(Hulls, OfFacesOfManyTrianglesAnswerAtTheRoot) {
  Random random(35);
  const MeshModel mesh = hulled(fine_box(8, Vec3::Zero(), Vec3(1, 1, 1)));
  MeshSeed seed;
  distance(mesh, mesh, {random.rotation(), 4 * random.on_sphere()}, seed);
  std::uint64_t opened = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random.rotation(), 4 * random.on_sphere()};
    const Answer answer = distance(mesh, mesh, pose, seed);
    EXPECT_NEAR(answer.upper,
                distance(Body::box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), Body::box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), pose).upper,
                1e-13);
    opened += answer.steps;
  }
  EXPECT_LE(opened, 200u);
}

HullOptions along_patches(std::uint32_t least) {
  HullOptions options;
  options.least_patch = options.least_triangles = least, options.bytes_per_triangle = 1e6;
  return options;
}

/// Boxes that touch no other, in a row: each is a patch.
Soup boxes_in_a_row(int count, std::uint32_t cells) {
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Soup one = fine_box(cells, Vec3(0.5 * i, 0, 0), Vec3(0.125, 1, 0.125));
    for (auto t : one.triangles) {
      for (std::uint32_t& v : t) v += std::uint32_t(soup.points.size());
      soup.triangles.push_back(t);
    }
    soup.points.insert(soup.points.end(), one.points.begin(), one.points.end());
  }
  return soup;
}

TEST(Patches, HaveNodesAndHullsOfTheirOwnWhereTheyAreLarge) {
  const Soup row = boxes_in_a_row(11, 3);
  const MeshModel along = made(build_mesh(mesh_of(row), along_patches(40)));
  EXPECT_EQ(along.hull_count(), 12u);  // and the root's
  EXPECT_TRUE(verify(along));
  EXPECT_EQ(made(load_mesh(along.bytes())).hash(), along.hash());
  EXPECT_EQ(made(rebuild_hulls(along, along_patches(40))).hash(), along.hash());
  HullOptions threaded = along_patches(40);
  threaded.executor = on_threads(3);
  EXPECT_EQ(made(build_mesh(mesh_of(row), threaded)).hash(), along.hash());
  // Too small, or too large for the block.
  EXPECT_EQ(made(build_mesh(mesh_of(row), along_patches(200))).node_count(), row.mesh().node_count());
  HullOptions tight = along_patches(40), plain = tight;
  tight.bytes_per_triangle = plain.bytes_per_triangle = 95, plain.least_patch = 0;
  EXPECT_EQ(made(build_mesh(mesh_of(row), tight)).hash(), made(build_mesh(mesh_of(row), plain)).hash());
  HullOptions endless = along_patches(40);
  for (const double bytes : {1e17, 1e300, std::numeric_limits<double>::infinity()}) {
    endless.bytes_per_triangle = bytes;
    EXPECT_EQ(made(build_mesh(mesh_of(row), endless)).hash(), along.hash()) << bytes;
  }
  // Given twice, a surface has each of its patches once.
  Soup twice = row;
  twice.triangles.insert(twice.triangles.end(), row.triangles.begin(), row.triangles.end());
  EXPECT_EQ(made(build_mesh(mesh_of(twice), along_patches(40))).hull_count(), 12u);
}

TEST(Patches, AnswerAsTrianglesDo) {
  Random random(36);
  int apart = 0;
  for (int i = 0; i < 120; ++i) {
    const Soup a = i % 3 == 0 ? boxes_in_a_row(4, 1) : any(random), b = i % 2 == 0 ? boxes_in_a_row(3, 2) : any(random);
    const MeshModel along_a = made(build_mesh(mesh_of(a), along_patches(1))),
                    along_b = made(build_mesh(mesh_of(b), along_patches(1)));
    EXPECT_TRUE(verify(along_a));
    MeshSeed seed;
    Pose pose = any_pose(random, random.uniform(0.2, 3));
    for (int step = 0; step < 4; ++step) {
      const double truth = brute_force(a, b, pose), law_two = tolerance(along_a, along_b, pose);
      const Answer answer = distance(along_a, along_b, pose, seed);
      EXPECT_LE(answer.lower, truth + law_two);
      EXPECT_GE(answer.upper, truth - law_two);
      EXPECT_LE(answer.upper - answer.lower, law_two);
      EXPECT_EQ(intersects(along_a, along_b, pose, seed).verdict == Verdict::Disjoint, answer.verdict == Verdict::Disjoint);
      const Answer loose = distance(along_a, along_b, pose, seed, {.relative = 0.1});
      EXPECT_LE(loose.lower, truth + law_two);
      EXPECT_GE(loose.upper, truth - law_two);
      apart += truth > 0;
      pose.translation += 0.05 * random.in_ball();
    }
  }
  EXPECT_GE(apart, 200);
}

// To readers that know no patches the mark of a node is a part of the index of its first child or triangle.
TEST(Patches, AreRefusedByReadersThatDoNotKnowThem) {
  const soups::Block block = bytes_of(made(build_mesh(mesh_of(boxes_in_a_row(11, 3)), along_patches(40))));
  const MeshHeader header = header_of(block);
  int marked = 0;
  for (std::uint32_t i = 0; i < header.node_count; ++i) {
    Node node;
    const std::size_t at = std::size_t(header.level[0].offset) + i * sizeof node;
    std::memcpy(&node, block.data() + at, sizeof node);
    if (!node.of_patch()) continue;
    ++marked;
    const std::uint32_t index = node.link & ((1u << 28) - 1);
    EXPECT_GE(index, std::max(header.node_count, header.triangle_count));
    // What today's reader says of such an index: the highest bit that it counts as one.
    node.link ^= 1u << 27 | 1u << 26;
    soups::Block other = block;
    std::memcpy(other.data() + at, &node, sizeof node);
    rehash(other);
    const Result<MeshModel> read = load_mesh(other);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
  }
  EXPECT_EQ(marked, 11);
}

TEST(Hulls, ScaleBitForBit) {
  Random random(33);
  for (int i = 0; i < 60; ++i) {
    const Soup a = any(random), b = any(random);
    const Pose pose = any_pose(random, random.uniform(1, 4));
    const MeshModel hulled_a = hulled(a), hulled_b = hulled(b);
    const Answer one = distance(hulled_a, hulled_b, pose);
    for (const double factor : {0x1p-40, 0x1p70}) {
      const MeshModel other_a = hulled(scaled(a, factor)), other_b = hulled(scaled(b, factor));
      const Answer other = distance(other_a, other_b, {pose.rotation, factor * pose.translation});
      EXPECT_EQ(other.lower, factor * one.lower);
      EXPECT_EQ(other.upper, factor * one.upper);
      EXPECT_EQ(other.feature_a, one.feature_a);
    }
  }
}

TEST(Hulls, FillNoMoreStackThanExactArithmeticDoes) {
  Random random(34);
  PaintedStack stack;
  std::size_t most = 0;
  for (int i = -1; i < 100; ++i) {
    const MeshModel a = hulled(any(random)), b = hulled(any(random));
    const Pose pose = any_pose(random, i % 2 ? 1 : 4);
    MeshSeed seed;
    const std::size_t used =
        std::max(stack.use([&] { distance(a, b, pose, seed); }), stack.use([&] { intersects(a, b, pose); }));
    if (i >= 0) most = std::max(most, used);
  }
  EXPECT_GE(most, 10000u) << "nothing was measured";
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(most, 32u << 10);
}

/// A block whose hulls lie: `verify` finds it out.
TEST(HullsOfFiles, ThatLieAreFoundOutByVerify) {
  const MeshModel mesh = hulled(ball(2));
  const MeshModel smaller = hulled(scaled(ball(2), 0.5));
  ASSERT_EQ(mesh.hull_count(), smaller.hull_count());
  MeshParts parts = MeshReader::parts(mesh);
  parts.hulls = MeshReader::parts(smaller).hulls;
  const MeshModel liar = made(MeshReader::read(std::move(compose(parts))));
  const Check check = verify(liar);
  EXPECT_FALSE(check);
  EXPECT_NE(check.message.find("hull"), std::string::npos) << check.message;
}

/// Numbers in records and models of hulls are checked, and whatever passes does no harm.
TEST(HullsOfFiles, WithAnyNumberAreRefusedOrHarmless) {
  Random random(35);
  const soups::Block good = bytes_of(hulled(ball(2)));
  const MeshModel honest = hulled(torus(6, 4));
  MeshHeader header = header_of(good);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    soups::Block block = good;
    const Section& s = i % 2 ? header.hulls : header.hull_models;
    const std::uint32_t values[] = {0, 1, std::uint32_t(random.bits() % 300), ~0u, std::uint32_t(random.bits())};
    const std::size_t at = s.offset + random.bits() % (s.bytes / 4) * 4;
    std::memcpy(block.data() + at, &values[random.bits() % 5], 4);
    rehash(block);
    const Result<MeshModel> read = load_mesh(block);
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      ++refused;
      continue;
    }
    ++loaded;
    MeshSeed seed;
    for (int k = 0; k < 3; ++k) {
      const Answer answer = distance(read.value(), honest, any_pose(random, random.uniform(1, 4)), seed);
      if (answer.status < Status::InvalidPose) {
        ASSERT_LE(answer.lower, answer.upper);
      }
    }
  }
  EXPECT_GE(loaded, 100);
  EXPECT_GE(refused, 1000);
}

// ---- Fronts ----------------------------------------------------------------------------------------------------------------

/// What an adversary's search found: two meshes, a front's capacity, queries with the seeds that they began with, and a pose at
/// which triangles cross. Numbers are hexadecimal.
class Replay {
 public:
  explicit Replay(const std::string& file) : in_(file) {
    if (!in_) throw std::runtime_error(file + ": cannot be read");
  }
  Soup soup() {
    Soup soup;
    soup.points.resize(count()), soup.triangles.resize(count());
    for (Vec3& p : soup.points) p = vector();
    for (Corners& t : soup.triangles) {
      for (std::uint32_t& v : t) v = count();
    }
    return soup;
  }
  std::uint32_t count() { return std::uint32_t(std::stoul(word())); }
  double number() { return std::stod(word()); }
  Pose pose() {
    Pose pose;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) pose.rotation(i, k) = number();
    }
    pose.translation = vector();
    return pose;
  }
  MeshSeed seed() {
    std::array<std::uint32_t, sizeof(MeshSeed) / 4> words;
    for (std::uint32_t& w : words) w = count();
    MeshSeed seed;
    std::memcpy(static_cast<void*>(&seed), words.data(), sizeof seed);
    return seed;
  }

 private:
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  std::string word() {
    std::string word;
    in_ >> word;
    return word;
  }
  std::ifstream in_;
};

TEST(Regress, AFrontKeptAGapAlongADirectionThatHullsHadTurned) {
  Replay replay(SWIFTLET_TEST_DIR "/data/fronts/hulls.txt");
  const MeshModel a = hulled(replay.soup()), b = hulled(replay.soup());
  MeshFront front(replay.count());
  MeshSeed seed;
  for (std::uint32_t rest = replay.count(); rest > 0; --rest) {
    const std::uint32_t question = replay.count();
    const double threshold = replay.number();
    Options options;
    options.absolute = replay.number(), options.relative = replay.number(), options.beyond = replay.number();
    options.budget.steps = replay.count();
    seed = replay.seed();
    const Pose pose = replay.pose();
    if (question == 3)
      within(a, b, pose, threshold, seed, front, {.budget = options.budget});
    else if (question == 4)
      intersects(a, b, pose, seed, front, {.budget = options.budget});
    else
      distance(a, b, pose, seed, front, options);
  }
  const Pose pose = replay.pose();
  ASSERT_GT(front.size(), 0u);
  ASSERT_EQ(intersects(a, b, pose).verdict, Verdict::Overlapping);
  EXPECT_EQ(intersects(a, b, pose, seed, front).verdict, Verdict::Overlapping);
}

}  // namespace
}  // namespace swiftlet
