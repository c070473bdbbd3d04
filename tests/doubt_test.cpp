// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Of everyday bodies in coherent motion nearly every distance is proved by its walk's own tests, and the careful path, which
// proves the others, gives the same answers. Knows queries and marches. Of hard pairs the generators ask the same.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/query.h>

#include "bodies.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using shapes::Random;

Model built(const Mesh& mesh) { return bodies::must(build(mesh)).model; }

/// The second one's faces are flat only up to rounding.
std::vector<Model> cubes() {
  const Pose turned{bodies::rotation(3, 1, 2, 5), {0.3, 0.1, -0.2}};
  return {built(shapes::cube()), built(shapes::moved(shapes::cube(), turned))};
}
std::vector<Model> boxes() { return {built(shapes::box({1, 0.7, 0.4})), built(shapes::box({1, 1, 0.05}))}; }
/// Boxes with gridded faces, turned: rounding leaves rows of corners beside their edges.
std::vector<Model> grids(bool is_single) {
  const Pose turned{bodies::rotation(3, 1, 2, 5), {0.3, 0.1, -0.2}};
  std::vector<Model> all;
  for (const std::uint32_t cells : {3u, 6u, 20u}) {
    const Mesh grid = shapes::moved(shapes::meshed_cube(cells), turned);
    all.push_back(built(is_single ? shapes::float_rounded(grid) : grid));
  }
  return all;
}
std::vector<Model> prisms() {
  std::vector<Model> all;
  for (const std::uint32_t sides : {3u, 4u, 5u, 6u, 8u, 12u, 17u, 30u, 64u, 100u, 200u})
    all.push_back(built(shapes::prism(sides, 0.5, sides % 2 ? 1 : 0.3)));
  return all;
}
std::vector<Model> ellipsoids() {
  std::vector<Model> all;
  for (const shapes::Family family : shapes::kFamilies) {
    const shapes::Pair pair = shapes::pair(family, 1000);
    all.push_back(built(pair.a)), all.push_back(built(pair.b));
  }
  return all;
}
/// Empty where models/fetch has not run.
std::vector<Model> links() {
  std::vector<Model> all;
  for (const char* name : {"fetch_base.stl", "ur10_forearm.obj"}) {
    const std::filesystem::path path = std::filesystem::path(SWIFTLET_MESHES) / name;
    if (std::filesystem::exists(path)) all.push_back(built(bodies::must(read_mesh(path))));
  }
  return all;
}

/// As a file of 32-bit floats would have it. Through memory: see bodies::float_rounded.
Pose float_rounded(Pose pose) {
  const auto round = [](double& x) {
    const volatile float rounded = float(x);
    x = double(rounded);
  };
  for (double& x : pose.rotation.reshaped()) round(x);
  for (double& x : pose.translation) round(x);
  return pose;
}

/// B comes around A by one degree a step, turning by as much about an axis of its own. It begins in any orientation, and stays
/// about as far off A's hull: 0.2 to 2 times the mean of the radii.
std::vector<Pose> passing(const Body& a, const Body& b, double radius, int steps, Random& random) {
  const double degree = std::acos(-1) / 180, gap = random.uniform(0.2, 2) * radius;
  const Vec3 from = random.on_sphere(), around = from.cross(random.on_sphere()).normalized(), axis = random.on_sphere();
  const Mat3 first = random.rotation();
  std::vector<Pose> poses;
  double apart = 4 * radius + gap;
  for (int i = 0; i < steps; ++i) {
    const Vec3 direction = shapes::rotation(around, i * degree) * from;
    Pose pose{shapes::rotation(axis, i * degree) * first, apart * direction};
    for (int k = 0; k < (i == 0 ? 8 : 2); ++k) {
      apart += gap - distance(a, b, pose).lower;
      pose.translation = apart * direction;
    }
    poses.push_back(pose);
  }
  return poses;
}

/// Visits sequences of every body beside every other: visit(a, b, poses).
template <class Visit>
void each_sequence(const std::vector<Model>& models, int sequences, int steps, Visit visit) {
  Random random(61);
  for (const Model& a : models) {
    for (const Model& b : models) {
      for (int i = 0; i < sequences; ++i) {
        std::vector<Pose> poses = passing(a, b, (a.radius() + b.radius()) / 2, steps, random);
        visit(a, b, poses);
        for (Pose& pose : poses) pose = float_rounded(pose);
        visit(a, b, poses);
      }
    }
  }
}

/// The queries after the first of a sequence, by Doubt.
struct Doubts {
  std::array<int, 6> counts{};
  int all = 0;

  double without() const { return double(counts[std::size_t(Doubt::None)]) / all; }
  void print(const char* name) const {
    const auto of = [&](Doubt doubt) { return 100. * counts[std::size_t(doubt)] / all; };
    std::printf("%s: %.2f %% of %d without doubt; neighbour %.2f, width %.2f, lean %.2f, threshold %.2f, no minimum %.2f\n",
                name, 100 * without(), all, of(Doubt::Neighbour), of(Doubt::Width), of(Doubt::Lean), of(Doubt::Threshold),
                of(Doubt::NoMinimum));
  }
};

/// Prints them as they are, and of poses rounded to float32.
std::array<Doubts, 2> doubts(const char* name, const std::vector<Model>& models, int sequences) {
  std::array<Doubts, 2> seen;
  std::size_t rounded = 1;
  each_sequence(models, sequences, 150, [&](const Model& a, const Model& b, const std::vector<Pose>& poses) {
    rounded = 1 - rounded;
    PairSeed seed;
    distance(a, b, poses[0], seed);
    for (std::size_t i = 1; i < poses.size(); ++i) {
      std::array<LevelRecord, 1> last;
      Options options;
      options.tuning.trace = last;
      const Answer answer = distance(a, b, poses[i], seed, options);
      ASSERT_EQ(answer.verdict, Verdict::Disjoint);
      ++seen[rounded].all, ++seen[rounded].counts[std::size_t(last[0].doubt)];
    }
  });
  seen[0].print(name);
  seen[1].print((std::string(name) + ", float32").c_str());
  return seen;
}

void expect_without(const Doubts& seen, double least) {
  EXPECT_GE(seen.all, 5000);
  EXPECT_GE(seen.without(), least);
}
void expect_without(const std::array<Doubts, 2>& seen, double least) {
  for (const Doubts& d : seen) expect_without(d, least);
}

TEST(Doubt, IsRareOfWarmCubes) { expect_without(doubts("cubes", cubes(), 20), 0.97); }
TEST(Doubt, IsRareOfWarmBoxes) { expect_without(doubts("boxes", boxes(), 20), 0.97); }
TEST(Doubt, IsRareOfWarmGrids) {
  expect_without(doubts("grids of single precision", grids(true), 10), 0.97);
  expect_without(doubts("grids", grids(false), 10), 0.94);
}
TEST(Doubt, IsRareOfWarmPrisms) { expect_without(doubts("prisms", prisms(), 2), 0.97); }
TEST(Doubt, IsRareOfWarmEllipsoids) { expect_without(doubts("ellipsoids", ellipsoids(), 3), 0.99); }
TEST(Doubt, IsRareOfWarmRobotLinks) {
  const std::vector<Model> models = links();
  if (models.empty()) GTEST_SKIP() << "models/fetch has not run";
  expect_without(doubts("robot links", models, 20), 0.97);
}

/// A warm sequence asked both ways, each with the seed that the careful query before it left, and marches of the finest levels.
void expect_the_same_carefully(const Model& a, const Model& b, const std::vector<Pose>& poses) {
  PairSeed seed, careful_seed;
  MarchStart start, careful_start;
  Options careful;
  MarchRule careful_rule;
  careful.tuning.careful = careful_rule.careful = true;
  const ConvexView &view_a = a.level(0).view, &view_b = b.level(0).view;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    SCOPED_TRACE(i);
    const Pose& pose = poses[i];
    const double bound = tolerance(a, b, pose);
    const Answer answer = distance(a, b, pose, seed), proved = distance(a, b, pose, careful_seed, careful);
    ASSERT_EQ(answer.status, Status::Converged);
    ASSERT_EQ(proved.status, Status::Converged);
    ASSERT_EQ(answer.verdict, proved.verdict);
    ASSERT_LE(std::fabs(answer.lower - proved.lower), bound);
    ASSERT_LE(std::fabs(answer.upper - proved.upper), bound);
    for (const Answer& one : {answer, proved}) {
      const Check checked = check(a, b, pose, one, Question::Exact);
      ASSERT_TRUE(checked) << checked.message;
    }
    const MarchResult found = march(view_a, view_b, pose, start),
                      careful_one = march(view_a, view_b, pose, careful_start, careful_rule);
    ASSERT_EQ(careful_one.doubt, Doubt::Asked);
    ASSERT_EQ(found.status, careful_one.status);
    ASSERT_LE(std::fabs(found.lower - careful_one.lower), bound);
    ASSERT_LE(std::fabs(found.upper - careful_one.upper), bound);
    start = {found.a, found.b}, careful_start = {careful_one.a, careful_one.b};
  }
}

/// The bodies of a sequence of 40 steps; then the same pushed into contact and through each other in steps of a hundredth.
void expect_the_same_carefully(const std::vector<Model>& models) {
  each_sequence(models, 1, 40, [](const Model& a, const Model& b, std::vector<Pose> poses) {
    expect_the_same_carefully(a, b, poses);
    if (testing::Test::HasFatalFailure()) return;
    const Pose last = poses.back();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i] = last;
      poses[i].translation *= 1 - double(i) / double(poses.size());
    }
    expect_the_same_carefully(a, b, poses);
  });
}

TEST(Careful, GivesTheSameAnswersOfCubesAndBoxes) {
  std::vector<Model> models = cubes();
  for (Model& box : boxes()) models.push_back(std::move(box));
  expect_the_same_carefully(models);
}
TEST(Careful, GivesTheSameAnswersOfPrisms) { expect_the_same_carefully(prisms()); }
TEST(Careful, GivesTheSameAnswersOfEllipsoids) { expect_the_same_carefully(ellipsoids()); }
TEST(Careful, GivesTheSameAnswersOfRobotLinks) {
  const std::vector<Model> models = links();
  if (models.empty()) GTEST_SKIP() << "models/fetch has not run";
  expect_the_same_carefully(models);
}

}  // namespace
}  // namespace swiftlet
