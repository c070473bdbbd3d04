// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// An answer refined to 10 %, 1 % and exact in turn: what it costs beside going straight to exact, and that the laws hold on the
// way, whichever query began.
#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/query.h>

#include <array>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "bodies.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

constexpr double kTolerances[] = {0.1, 0.01, 0};

class Refine : public testing::TestWithParam<shapes::Family> {
 protected:
  Refine()
      : meshes_(shapes::pair(GetParam(), 2000)),
        a_(bodies::must(build(meshes_.a)).model),
        b_(bodies::must(build(meshes_.b)).model) {}

  /// That `finer` says no less than `so_far`, and what is true of an exact answer.
  static void expect_finer(const Body& a, const Body& b, const Pose& pose, const Answer& so_far, const Answer& finer,
                           const OverlapProof& proof, double relative = 0) {
    const double law_two = tolerance(a, b, pose);
    ASSERT_GE(finer.lower, so_far.lower - law_two);
    ASSERT_LE(finer.upper, so_far.upper + law_two);
    const Check checked = check(a, b, pose, finer, &proof);
    ASSERT_TRUE(checked) << checked.message;
    const Answer exact = distance(a, b, pose, {.relative = relative});
    ASSERT_LE(finer.lower, exact.upper);
    ASSERT_GE(finer.upper, exact.lower);
    ASSERT_EQ(finer.status, Status::Converged);
    ASSERT_LE(finer.upper - finer.lower, std::max(relative * finer.lower, law_two));
    ASSERT_TRUE(finer.verdict == exact.verdict || relative > 0);
  }

  shapes::Pair meshes_;
  Model a_, b_;
};

/// Steps plus plane tests.
std::uint64_t work(const Answer& answer) { return std::uint64_t(answer.steps) + answer.plane_tests; }

TEST_P(Refine, InTurnCostsAtMostAFifthMoreThanGoingStraight) {
  constexpr int kPoses = 300;
  for (const double closest : {2.0, 4.0}) {
    for (const double step : {0.0, 0.5, 5.0, 10.377, 80.377}) {  // 0: cold
      const shapes::Orbit orbit(50, closest, step == 0 ? 10.377 : step);
      PairSeed one, other;
      std::uint64_t at_once = 0, in_turn[3] = {0, 0, 0};
      for (int i = 0; i < kPoses; ++i) {
        const Pose pose = orbit.pose(std::uint64_t(i));
        if (step == 0) one = other = {};
        at_once += work(distance(a_, b_, pose, one));
        Answer so_far;
        for (std::size_t k = 0; k < 3; ++k) {
          Options options;
          options.relative = kTolerances[k];
          so_far = refine(a_, b_, pose, so_far, other, options);
          in_turn[k] += work(so_far);
        }
      }
      const std::uint64_t sum = in_turn[0] + in_turn[1] + in_turn[2];
      std::printf("%s at %.0f r, %.1f degrees: straight %.1f, in turn %.1f + %.1f + %.1f, %.2f of it\n",
                  shapes::name(GetParam()), closest, step, double(at_once) / kPoses, double(in_turn[0]) / kPoses,
                  double(in_turn[1]) / kPoses, double(in_turn[2]) / kPoses, double(sum) / double(at_once));
      EXPECT_LE(double(sum), 1.2 * double(at_once)) << closest << ", " << step;
    }
  }
}

TEST_P(Refine, NarrowsTheIntervalWhicheverQueryBegan) {
  shapes::Random random(3);
  int coarse = 0, overlapping = 0, spent = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.2, 4)};
    for (const double radius : {0.0, 0.05, 0.7}) {
      const Body a(a_, radius), b(b_, radius / 2);
      PairSeed seeds[7];
      OverlapProof proofs[7];
      const std::array<Answer, 7> begun{
          Answer{},
          distance(a, b, pose, seeds[1], {.budget = {.steps = 2}, .tuning = {.proof = &proofs[1]}}),
          distance(a, b, pose, seeds[2], {.budget = {.finest_level = 2}, .tuning = {.proof = &proofs[2]}}),
          intersects(a, b, pose, seeds[3], {.tuning = {.proof = &proofs[3]}}),
          within(a, b, pose, 0.5, seeds[4], {.tuning = {.proof = &proofs[4]}}).answer,
          closest_features(a, b, pose, seeds[5], {.tuning = {.proof = &proofs[5]}}).answer,
          signed_distance(a, b, pose, seeds[6])};
      for (std::size_t k = 0; k < begun.size(); ++k) {
        Answer so_far = begun[k];
        for (const double relative : kTolerances) {
          OverlapProof proof;
          const Answer finer = refine(a, b, pose, so_far, seeds[k], {.relative = relative, .tuning = {.proof = &proof}});
          if (proof.count > 0) proofs[k] = proof;  // what is known is not proved again
          expect_finer(a, b, pose, so_far.is_signed && so_far.lower < 0 ? Answer{} : so_far, finer, proofs[k], relative);
          if (HasFatalFailure()) FAIL() << "pose " << i << ", radius " << radius << ", begun as " << k << ", to " << relative;
          coarse += finer.level_a > 0;
          so_far = finer;
        }
        const Answer again = refine(a, b, pose, so_far, seeds[k]);
        ASSERT_EQ(work(again), 0u) << "exact is exact";
        ASSERT_EQ(again.lower, so_far.lower);
        ASSERT_EQ(again.upper, so_far.upper);
        ASSERT_EQ(again.verdict, so_far.verdict);
        overlapping += so_far.verdict == Verdict::Overlapping;
        spent += begun[k].status == Status::Budget;
      }
    }
  }
  EXPECT_GE(coarse, 60);
  EXPECT_GE(overlapping, 60);
  EXPECT_GE(spent, 30);
}

/// Balls bound a distance and name no features; where a budget ends the query at once some of that is better than what it
/// found.
TEST_P(Refine, KeepsWhatBallsToldWhereTheBudgetIsSpent) {
  shapes::Random random(5);
  int begun = 0, kept = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(2, 6)};
    for (const double radius : {0.0, 0.05}) {
      const Body a(a_, radius), b(b_, radius / 2);
      const double bound = tolerance(a, b, pose);
      const Answer so_far = distance(a, b, pose, {.relative = random.uniform(0.1, 1)});
      if (so_far.feature_a.kind() != FeatureKind::None) continue;
      ++begun;
      for (const int finest : {0, a_.level_count() - 1}) {
        const Answer finer = refine(a, b, pose, so_far, {.budget = {.steps = 0, .finest_level = finest}});
        ASSERT_LE(finer.lower, finer.upper);
        ASSERT_GE(finer.lower, so_far.lower - bound);
        ASSERT_LE(finer.upper, so_far.upper + bound);
        const Check checked = check(a, b, pose, finer);
        ASSERT_TRUE(checked) << checked.message;
        Answer wrong = so_far;  // of bodies that were nearer: so is the result, but it is an interval
        wrong.lower *= 0.1, wrong.upper *= 0.2;
        const Answer of_wrong = refine(a, b, pose, wrong, {.budget = {.steps = 0, .finest_level = finest}});
        ASSERT_LE(of_wrong.lower, of_wrong.upper);
        if (finer.feature_a.kind() != FeatureKind::None) continue;
        ++kept;
        ASSERT_TRUE(finer.level_a == so_far.level_a && finer.level_b == so_far.level_b);
        ASSERT_LE((finer.point_a - so_far.point_a).norm(), 3 * radius + bound);
        ASSERT_LE((finer.point_b - so_far.point_b).norm(), 3 * radius + bound);
      }
    }
  }
  EXPECT_GE(begun, 100);
  if (GetParam() == shapes::Family::Fat) {  // as balls are
    EXPECT_GE(kept, 100);
  }
}

TEST_P(Refine, EndsFromAnyFeatures) {
  shapes::Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.5, 4)};
    Answer so_far;
    so_far.level_a = std::int16_t(random.bits() % 9) - 2, so_far.level_b = std::int16_t(random.bits() % 9) - 2;
    so_far.feature_a = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 4000)};
    so_far.feature_b = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 4000)};
    so_far.normal = random.on_sphere();
    OverlapProof proof;
    const Answer finer = refine(a_, b_, pose, so_far, {.tuning = {.proof = &proof}});
    expect_finer(a_, b_, pose, so_far, finer, proof);
    if (HasFatalFailure()) FAIL() << i;
  }
  Pose invalid;
  invalid.rotation *= 2;
  for (const double radius : {0.0, 0.1}) {
    const Body b(b_, radius);
    const Answer refused = refine(a_, b, invalid, distance(a_, b, {Mat3::Identity(), {3, 0, 0}}));
    EXPECT_EQ(refused.status, Status::InvalidPose);
    EXPECT_EQ(refused.lower, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Refine, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& family) { return std::string(shapes::name(family.param)); });

}  // namespace
}  // namespace swiftlet
