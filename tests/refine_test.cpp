// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// An answer refined to 10 %, 1 % and exact in turn: what it costs beside going straight to exact, and that the laws hold on the
// way, whichever query began.
#include <swiftlet/build.h>
#include <swiftlet/check.h>
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

  double law_two(const Pose& pose, const QueryOptions& options = {}) const {
    return bodies::law_two(a_.level(0).view, b_.level(0).view, pose) +
           64 * 0x1p-53 * std::max(options.radius_a, options.radius_b) + 16 * 0x1p-53 * pose.translation.norm();
  }
  Answer straight(const Pose& pose, const QueryOptions& options = {}) const {
    PairSeed cold;
    return distance(a_, b_, pose, cold, options);
  }
  /// That `finer` says no less than `so_far`, and what is true of an exact answer.
  void expect_finer(const Pose& pose, const Answer& so_far, const Answer& finer, const QueryOptions& options) const {
    ASSERT_GE(finer.lower, so_far.lower - law_two(pose, options));
    ASSERT_LE(finer.upper, so_far.upper + law_two(pose, options));
    const Check checked = check(a_, b_, pose, finer, options.radius_a, options.radius_b);
    ASSERT_TRUE(checked) << checked.message;
    const Answer exact = straight(pose, options);
    ASSERT_LE(finer.lower, exact.upper);
    ASSERT_GE(finer.upper, exact.lower);
    ASSERT_EQ(finer.status, Status::Converged);
    ASSERT_LE(finer.upper - finer.lower, std::max(options.relative_error * finer.lower, law_two(pose, options)));
    ASSERT_TRUE(finer.verdict == exact.verdict || options.relative_error > 0);
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
          QueryOptions options;
          options.relative_error = kTolerances[k];
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
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.2, 4)};
    for (const double radius : {0.0, 0.05, 0.7}) {
      QueryOptions options;
      options.radius_a = radius, options.radius_b = radius / 2;
      QueryOptions budget = options, limited = options;
      budget.step_budget = 2, limited.finest_level = 2;
      PairSeed seeds[6];
      const std::array<Answer, 6> begun{Answer{},
                                        distance(a_, b_, pose, seeds[1], budget),
                                        distance(a_, b_, pose, seeds[2], limited),
                                        intersects(a_, b_, pose, seeds[3], options),
                                        within(a_, b_, pose, 0.5, seeds[4], options).answer,
                                        contact(a_, b_, pose, seeds[5], options).answer};
      for (std::size_t k = 0; k < begun.size(); ++k) {
        Answer so_far = begun[k];
        for (const double tolerance : kTolerances) {
          options.relative_error = tolerance;
          const Answer finer = refine(a_, b_, pose, so_far, seeds[k], options);
          expect_finer(pose, so_far, finer, options);
          if (HasFatalFailure()) FAIL() << "pose " << i << ", radius " << radius << ", begun as " << k << ", to " << tolerance;
          coarse += finer.level_a > 0;
          so_far = finer;
        }
        const Answer again = refine(a_, b_, pose, so_far, seeds[k], options);
        ASSERT_EQ(work(again), 0u) << "exact is exact";
        ASSERT_EQ(again.lower, so_far.lower);
        ASSERT_EQ(again.upper, so_far.upper);
        ASSERT_EQ(again.verdict, so_far.verdict);
        overlapping += so_far.verdict == Verdict::Overlapping;
        spent += begun[k].status == Status::Budget;
      }
    }
  }
  EXPECT_GE(coarse, 200);
  EXPECT_GE(overlapping, 200);
  EXPECT_GE(spent, 100);
}

TEST_P(Refine, EndsFromAnyFeatures) {
  shapes::Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.5, 4)};
    Answer so_far;
    so_far.level_a = int(random.bits() % 9) - 2, so_far.level_b = int(random.bits() % 9) - 2;
    so_far.feature_a = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 4000)};
    so_far.feature_b = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 4000)};
    so_far.normal = random.on_sphere();
    PairSeed seed;
    expect_finer(pose, so_far, refine(a_, b_, pose, so_far, seed), {});
    if (HasFatalFailure()) FAIL() << i;
  }
  Pose invalid;
  invalid.rotation *= 2;
  for (const double radius : {0.0, 0.1}) {
    QueryOptions options;
    options.radius_b = radius;
    PairSeed seed;
    const Answer refused = refine(a_, b_, invalid, straight({Mat3::Identity(), {3, 0, 0}}, options), seed, options);
    EXPECT_EQ(refused.status, Status::InvalidPose);
    EXPECT_EQ(refused.lower, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Refine, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& family) { return std::string(shapes::name(family.param)); });

}  // namespace
}  // namespace swiftlet
