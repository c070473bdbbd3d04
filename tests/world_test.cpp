// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Pairs of bodies as engines place them, each in the world.
#include <swiftlet/world.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/depth.h>
#include <swiftlet/round.h>

namespace swiftlet {
namespace {

/// In how many of 58 steps a manifold has points where the one of the step before has none, while the upper of two equal
/// cylinders trembles on the lower one by single precision. `turn` turns the stack in the world. Names are not compared: where
/// a corner of each cylinder is, the point may be either's.
int changes(const Model& model, const Mat3& turn) {
  constexpr double kTremble = 1e-7;  // at most, in each coordinate, and as an angle
  const Placed below{Body(model), {turn, Vec3::Zero()}};
  PairSeed seed;
  Manifold manifold;
  std::vector<Vec3> before;
  int changed = 0;
  for (int step = 1; step < 60; ++step) {
    const double tremble = kTremble * (step * 7 % 5 - 2) / 2;
    const Mat3 lean = Eigen::AngleAxisd(tremble, Vec3(1 + step % 2, step % 3, step % 4).normalized()).toRotationMatrix();
    const Placed above{Body(model), {turn * lean, turn * Vec3(tremble, -tremble, 2 - 1e-6)}};
    EXPECT_EQ(contacts(below, above, 0.01, 4, seed, manifold), Found::Nearest);
    EXPECT_EQ(manifold.count, 4u);
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < manifold.count; ++i) points.push_back(manifold.points[i].point_a);
    changed +=
        step > 1 && !std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
          return std::any_of(before.begin(), before.end(), [&](const Vec3& q) { return (p - q).norm() < 10 * kTremble; });
        });
    before = points;
  }
  return changed;
}

/// The last manifold's normal, in the world's frame, was compared with one in A's: no pair was at rest, and points changed in
/// 58 of 58 steps of a stack that lies aside.
TEST(World, AManifoldStaysWhicheverWayTheBodiesStand) {
  const Result<Model> made = cylinder(1, 1, 0.01);
  ASSERT_TRUE(made);
  for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(1.57, 0, 0), Vec3(0.8, -0.3, 0.5)}) {
    const Mat3 turned = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    EXPECT_LE(changes(made.value(), turned), 1) << turn.transpose();
  }
}

/// Nested cylinders of many sides: as many facets as deep, each proved apart, took 1.6 million steps and 1.5 s.
TEST(World, DepthsOfNestedCylindersTakeFewSteps) {
  const Result<Model> outer = cylinder(1, 0.5, 1e-5), inner = cylinder(0.4, 1, 1e-5);
  ASSERT_TRUE(outer && inner);
  const Answer s = signed_distance(outer.value(), inner.value(), Pose{});
  EXPECT_EQ(s.status, Status::LevelLimit);
  EXPECT_NEAR(s.lower, -1.4, 2e-5);
  EXPECT_LE(s.upper, -1.3998);
  EXPECT_LE(s.steps, 50'000u);
  // Nor more where the levels' deviation leaves an error, or a threshold, out of reach.
  EXPECT_LE(signed_distance(outer.value(), inner.value(), Pose{}, {.absolute = 1e-9}).steps, 50'000u);
  const Within w = signed_within(outer.value(), inner.value(), Pose{}, -1.4);
  EXPECT_EQ(w.decision, Decision::Undecided);
  EXPECT_LE(w.answer.steps, 50'000u);
}

/// Such a model has no level 0: what its finest level says of a half-space holds the body.
TEST(World, AModelWithoutItsLevelZeroStandsOnItsFinest) {
  constexpr double kDeviation = 0.01;
  const Result<Model> made = cylinder(1, 1, kDeviation);
  ASSERT_TRUE(made);
  ASSERT_GT(made.value().finest_level(), 0);
  const HalfSpace ground{Vec3::UnitZ(), 0};
  for (const double turn : {0.0, 0.3, 1.2, 1.5707963267948966}) {
    const double reach = std::cos(turn) + std::sin(turn);  // of the cylinder, below its middle
    for (const double height : {5.0, reach + 2e-2, reach - 2e-2}) {
      const Mat3 lean = Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix();
      const Placed body{Body(made.value()), {lean, {0, 0, height}}};
      const Nearest near = nearest(body, ground, 10);
      ASSERT_EQ(near.found, Found::Nearest);
      EXPECT_LE(near.distance, height - reach + 1e-12);
      EXPECT_GE(near.distance, height - reach - kDeviation - 1e-12);
      EXPECT_EQ(near.verdict, height > reach ? Verdict::Disjoint : Verdict::Overlapping);
      Manifold manifold;
      ASSERT_EQ(contacts(body, ground, 10, 4, manifold), Found::Nearest);
      EXPECT_GE(manifold.count, 1u);
    }
  }
}

}  // namespace
}  // namespace swiftlet
