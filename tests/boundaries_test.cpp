// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What callers may pass, and what a query may go on from: refused poses, errors that are no numbers, answers of other queries.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include <soups.h>
#include <swiftlet/depth.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/model_file.h>

#include "bodies.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

Pose shift(double x, double y, double z) {
  Pose pose;
  pose.translation = {x, y, z};
  return pose;
}

const Model& round_model() {
  static const Model model = load(SWIFTLET_TEST_DIR "/data/models/fat_a.swl").value();
  return model;
}

void expect_same(const Answer& x, const Answer& y) {
  EXPECT_EQ(x.status, y.status);
  EXPECT_EQ(x.verdict, y.verdict);
  EXPECT_EQ(x.lower, y.lower);
  EXPECT_EQ(x.upper, y.upper);
}

TEST(Boundaries, ARefusedPoseDecidesNoThreshold) {
  Pose twice;
  twice.rotation *= 2;
  const Body box = Body::box({-1, -1, -1}, {1, 1, 1});
  const MeshModel mesh = soups::ball(1).mesh();
  for (const double threshold : {-1.0, 0.0, 1.0, kInfinity}) {
    for (const Within& within :
         {swiftlet::within(box, box, twice, threshold), swiftlet::within(mesh, mesh, twice, threshold)}) {
      EXPECT_EQ(within.answer.status, Status::InvalidPose);
      EXPECT_EQ(within.decision, Decision::Undecided);
    }
  }
}

TEST(Boundaries, AnErrorThatIsNaNOrNegativeAsksForTheExactDistance) {
  const MeshModel mesh = soups::ball(3).mesh();
  const Body ball(round_model(), 0.25);
  const Pose mesh_pose = shift(2.5, 0.4, 0.1), ball_pose = shift(2.5, 0.3, 0.2);
  for (const StartPolicy start : {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Coarsest}) {
    Options exact;
    exact.tuning.start = start;
    const Answer of_mesh = distance(mesh, mesh, mesh_pose, exact), of_ball = distance(ball, ball, ball_pose, exact),
                 deep = signed_distance(ball, ball, shift(1, 0.1, 0), exact);
    ASSERT_EQ(of_mesh.status, Status::Converged);
    for (const double absolute : {0.0, -1.0, kNaN, -kInfinity}) {
      for (const double relative : {0.0, -0.5, -2.0, kNaN}) {
        Options asked = exact;
        asked.absolute = absolute, asked.relative = relative;
        expect_same(distance(mesh, mesh, mesh_pose, asked), of_mesh);
        expect_same(distance(ball, ball, ball_pose, asked), of_ball);
        expect_same(signed_distance(ball, ball, shift(1, 0.1, 0), asked), deep);
      }
    }
  }
}

TEST(Boundaries, CheckAcceptsLooseAnswersOfAMeshAndAConvexBody) {
  soups::Soup triangle;
  triangle.add({-0.5, -0.4, 0}, {0.6, -0.3, 0.1}, {0, 0.7, -0.1});
  const MeshModel mesh = triangle.mesh();
  const Body body = round_model();
  int coarse = 0, without = 0;
  for (int k = 0; k < 40; ++k) {
    const Pose pose = shift(0.1 * (k % 5), 0.2 - 0.1 * (k % 3), 1.2 + 0.1 * k);
    for (const double absolute : {0.0, 0.001, 0.03, 0.1, 0.15, 0.2, 0.3, 1.0}) {
      const Answer answer = distance(body, mesh, pose, {.absolute = absolute}),
                   turned = distance(mesh, body, pose, {.absolute = absolute});
      coarse += answer.level_a > 0 || turned.level_b > 0, without += answer.feature_a.kind() == FeatureKind::None;
      EXPECT_EQ(check(body, mesh, pose, answer).message, "") << k << ", " << absolute;
      EXPECT_EQ(check(mesh, body, pose, turned).message, "") << k << ", " << absolute;
      Answer forged = answer;
      forged.point_a += 0.5 * Vec3(1, 1, 1);
      EXPECT_FALSE(check(body, mesh, pose, forged).ok);
    }
  }
  EXPECT_GE(coarse, 4);
  EXPECT_GT(without, 5);
}

TEST(Boundaries, AnOverlapIsBeyondNothingThatItsDepthIsNot) {
  const Model cube = bodies::model(bodies::cube()), nested = bodies::nested(3);
  int overlaps = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose{bodies::rotation(1 + i % 7, i % 5, i % 11, i % 13 - 6), Vec3(i % 17 - 8, i % 23 - 11, i % 29 - 14) * 0.1};
    for (const Body& body : {Body(cube), Body(nested), Body::box({-1, -1, -1}, {1, 1, 1}), Body(cube, 0.25)}) {
      for (const double beyond : {-0.3, -2.0}) {
        const Answer answer = signed_distance(body, cube, pose, {.beyond = beyond});
        EXPECT_TRUE(answer.status != Status::Beyond || answer.lower > beyond) << i << ", " << answer.lower;
        overlaps += answer.upper < beyond;
      }
    }
  }
  EXPECT_GE(overlaps, 100);
}

TEST(Boundaries, RefineToCoarserLevelsKeepsWhatIsProved) {
  const Model nested = bodies::nested(3);
  Options finer, coarser;
  finer.budget.finest_level = 1, coarser.budget.finest_level = 2;
  int wide = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose pose{bodies::rotation(1 + i % 7, i % 5, i % 11, i % 13 - 6), Vec3(i % 17 - 8, i % 23 - 11, i % 29 - 14) * 0.3};
    const Answer before = distance(nested, nested, pose, finer), after = refine(nested, nested, pose, before, coarser);
    const double law_two = tolerance(nested, nested, pose);
    EXPECT_LE(after.upper - after.lower, before.upper - before.lower + law_two) << i;
    EXPECT_GE(after.lower, before.lower - law_two) << i;
    EXPECT_EQ(check(nested, nested, pose, after).message, "") << i;
    wide += before.lower > 0 && before.level_a < 2;
  }
  EXPECT_GE(wide, 100);
}

TEST(Boundaries, ARadiusBelowLawTwoMakesNoTouchOfADeepOverlap) {
  const Model cube = bodies::model(bodies::cube());
  int deep = 0;
  for (int i = 0; i < 13 * 13 * 13; ++i) {
    const Pose pose = shift((i % 13 - 6) / 4., (i / 13 % 13 - 6) / 4., (i / 169 - 6) / 4.);
    const Vec3 overlap = Vec3(2, 2, 2) - pose.translation.cwiseAbs();  // of cubes from -1 to 1
    for (const double radius : {1e-15, 1e-18}) {
      const Body rounded(cube, radius);
      Effort spent;
      for (const std::uint32_t steps : {0u, 2u}) {
        spent.budget.steps = steps;
        for (const Answer& answer :
             {distance(cube, rounded, pose, {.absolute = 0.1}), distance(cube, rounded, pose, {.budget = {steps, 0}}),
              intersects(cube, rounded, pose, spent)}) {
          if (overlap.minCoeff() < 0.01) continue;
          ++deep;
          EXPECT_NE(answer.verdict, Verdict::Touching) << pose.translation.transpose() << ", " << radius;
        }
      }
    }
  }
  EXPECT_GE(deep, 1000);
}

TEST(Boundaries, RefineKeepsWhatIsProvedWithoutFeatures) {
  const Body body = round_model();
  const Answer meets = intersects(body, body, shift(0, 0.1, 0.2));
  ASSERT_EQ(meets.verdict, Verdict::Overlapping);
  expect_same(refine(body, body, shift(0, 0.1, 0.2), meets, {.absolute = 0.5}), meets);
  expect_same(refine(body, body, shift(0, 0.1, 0.2), meets), meets);

  const Answer apart = distance(body, body, shift(6, 0, 0), {.absolute = 1});
  ASSERT_EQ(apart.feature_a.kind(), FeatureKind::None);
  ASSERT_GT(apart.upper - apart.lower, 0.01);
  expect_same(refine(body, body, shift(6, 0, 0), apart, {.absolute = 1}), apart);
  const Answer exact = refine(body, body, shift(6, 0, 0), apart);
  EXPECT_LE(exact.upper - exact.lower, 1e-13);
  EXPECT_GE(exact.lower, apart.lower - 1e-13);

  // Found anew, a distance is no wider than the balls said, however little may be spent on it.
  for (const double radius : {0.0, 0.25}) {
    const Body rounded(round_model(), radius);
    const Answer by_balls = distance(rounded, rounded, shift(6, 0, 0), {.absolute = 1});
    ASSERT_EQ(by_balls.feature_a.kind(), FeatureKind::None);
    for (const std::uint32_t steps : {0u, 1u, 2u}) {
      const Answer spent = refine(rounded, rounded, shift(6, 0, 0), by_balls, {.budget = {steps, 0}});
      EXPECT_LE(spent.upper - spent.lower, by_balls.upper - by_balls.lower + tolerance(rounded, rounded, shift(6, 0, 0)));
      EXPECT_EQ(check(rounded, rounded, shift(6, 0, 0), spent).message, "") << steps;
    }
  }
  OverlapProof proof;
  const Model cube = bodies::model(bodies::cube());
  const Answer deep = intersects(cube, cube, shift(0.5, 0.25, 0.125));
  ASSERT_EQ(deep.verdict, Verdict::Overlapping);
  for (const std::uint32_t steps : {0u, 1u, 2u}) {
    Options asked{.budget = {steps, 0}};
    asked.tuning.proof = &proof;
    const Answer again = refine(cube, cube, shift(0.5, 0.25, 0.125), deep, asked);
    EXPECT_EQ(again.verdict, Verdict::Overlapping);
    EXPECT_EQ(check(cube, cube, shift(0.5, 0.25, 0.125), again, &proof).message, "");
  }

  const Body thin(round_model(), 0.1), thick(round_model(), 0.2);
  const Pose poses[] = {shift(0, 0.1, 0.2), shift(6, 0, 0)};
  for (const Pose& pose : poses) {
    const Answer of_thin = distance(thin, thin, pose, {.absolute = 1});
    EXPECT_EQ(refine(thick, thick, pose, of_thin).status, Status::InvalidRadius);
  }
}

}  // namespace
}  // namespace swiftlet
