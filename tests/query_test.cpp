// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The queries on the paper's ellipsoids of 2 000 triangles: many random pairs, and the steps that hierarchies save on the
// orbit. The laws have a file of their own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include "answers.h"
#include "oracle.h"
#include "shapes.h"
#include "upper_halves.h"

namespace swiftlet {
namespace {

struct Bodies {
  shapes::Pair meshes;
  Model a, b;
};

const Bodies& bodies(shapes::Family family) {
  static std::array<std::optional<Bodies>, 3> all;  // made when they are asked for: a test wants one of them
  std::optional<Bodies>& made = all[std::size_t(family)];
  if (!made) {
    shapes::Pair meshes = shapes::pair(family, 2000);
    Model a = std::move(build(meshes.a)).value().model, b = std::move(build(meshes.b)).value().model;
    made = Bodies{std::move(meshes), std::move(a), std::move(b)};
  }
  return *made;
}

class RandomPairs : public testing::TestWithParam<shapes::Family> {};

/// The answer of each pair is recomputed, that of every tenth compared with the oracle. The soak asks millions.
TEST_P(RandomPairs, AgreeWithinLawTwo) {
  const Bodies& pair = bodies(GetParam());
  shapes::Random random(2000 + std::uint64_t(GetParam()));
  constexpr int kPairs = 3'000;
  int disjoint = 0;
  double widest = 0;
  for (int i = 0; disjoint < kPairs; ++i) {
    ASSERT_LT(i, 3 * kPairs) << "the poses overlap too often";
    Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.2, 3)};
    const Answer answer = distance(pair.a, pair.b, pose);
    ASSERT_EQ(answer.status, Status::Converged) << "pair " << i;
    if (answer.verdict == Verdict::Overlapping) continue;
    ++disjoint;
    ASSERT_LE(answer.upper - answer.lower, tolerance(pair.a, pair.b, pose)) << "pair " << i;
    widest = std::max(widest, (answer.upper - answer.lower) / tolerance(pair.a, pair.b, pose));
    if (i % 10 == 0) {
      const oracle::Truth truth = oracle::distance(pair.meshes.a.points, pair.meshes.b.points, pose);
      ASSERT_TRUE(oracle::holds(truth, answer.lower, answer.upper)) << "pair " << i << ": " << truth.distance;
    }
    const Check checked = check(pair.a, pair.b, pose, answer);
    ASSERT_TRUE(checked) << "pair " << i << ": " << checked.message;
  }
  std::printf("%s: %d disjoint pairs, widest interval %.2f of law 2's bound\n", shapes::name(GetParam()), disjoint, widest);
}

/// Mean steps per query over 20 orbits.
double mean_steps(const Bodies& pair, StartPolicy start, double degrees) {
  Options options;
  options.tuning.start = start;
  std::uint64_t steps = 0, queries = 0;
  for (std::uint64_t orbit = 0; orbit < 20; ++orbit) {
    const shapes::Orbit motion(100 + orbit, 2 * pair.a.radius(), degrees);
    PairSeed seed;
    for (int i = 1; i <= 100; ++i) {
      const Answer answer = distance(pair.a, pair.b, motion.pose(std::uint64_t(i)), seed, options);
      EXPECT_EQ(answer.status, Status::Converged);
      steps += answer.steps;
      ++queries;
    }
  }
  return double(steps) / double(queries);
}

TEST_P(RandomPairs, TakeAtMostSixTenthsOfThePlainWalksStepsWhenFarApart) {
  const Bodies& pair = bodies(GetParam());
  for (const double degrees : {120.377, 160.377}) {
    const double plain = mean_steps(pair, StartPolicy::Finest, degrees),
                 levels = mean_steps(pair, StartPolicy::Automatic, degrees);
    std::printf("%s at %.0f degrees: plain %.1f steps, levels %.1f\n", shapes::name(GetParam()), degrees, plain, levels);
    EXPECT_LE(levels, 0.6 * plain) << degrees;
  }
}

TEST_P(RandomPairs, CostAtMostHalfAsManyMoreStepsWhenCoherent) {
  const Bodies& pair = bodies(GetParam());
  for (const double degrees : {0.377, 0.777, 0.977}) {
    const double plain = mean_steps(pair, StartPolicy::Finest, degrees),
                 levels = mean_steps(pair, StartPolicy::Automatic, degrees);
    std::printf("%s at %.2f degrees: plain %.2f steps, levels %.2f\n", shapes::name(GetParam()), degrees, plain, levels);
    EXPECT_LE(levels, 1.5 * plain) << degrees;
  }
}

/// G14: the steps of a far motion are spent on coarse levels.
TEST_P(RandomPairs, SpendFarStepsOnCoarseLevels) {
  const Bodies& pair = bodies(GetParam());
  const shapes::Orbit motion(7, 2 * pair.a.radius(), 160.377);
  PairSeed seed;
  std::uint64_t coarse = 0, fine = 0;
  for (std::uint64_t i = 1; i <= 200; ++i) {
    std::array<LevelRecord, 8> trace;
    Options options;
    options.tuning.start = StartPolicy::Paper;
    options.tuning.trace = trace;
    const Answer answer = distance(pair.a, pair.b, motion.pose(i), seed, options);
    ASSERT_LE(std::size_t(answer.levels_visited), trace.size());
    for (int k = 0; k < answer.levels_visited; ++k)
      (trace[std::size_t(k)].level_a > 0 ? coarse : fine) += trace[std::size_t(k)].steps;
  }
  EXPECT_GT(coarse, fine);
  EXPECT_GT(fine, 0u);
}

/// Bodies that reach into each other, and sometimes do not: four vertex pairs prove an overlap, and follow the origin when the
/// bodies turn. Every verdict is checked, every tenth compared with the oracle.
TEST_P(RandomPairs, ProveOverlapsByVerticesThatFollow) {
  const Bodies& pair = bodies(GetParam());
  int overlapping = 0, disjoint = 0, followed = 0;
  for (const double apart : {0.15, 0.3, 0.5, 0.8, 1.8})
    for (const double degrees : {1.04, 10.4, 45.4, 400.0}) {
      const shapes::Orbit motion(11, apart * pair.a.radius(), degrees);
      PairSeed seed;
      for (std::uint64_t i = 1; i <= 200; ++i) {
        const Pose pose = motion.pose(i);
        const auto before = seed.inside_a;
        OverlapProof proof;
        Effort effort;
        if (i % 2 == 0) effort.tuning.proof = &proof;
        const Answer answer = intersects(pair.a, pair.b, pose, seed, effort);
        ASSERT_NE(answer.verdict, Verdict::Undecided);
        const bool meet = answer.verdict == Verdict::Overlapping;
        meet ? ++overlapping : ++disjoint;
        // Of all ways only this one names a vertex of the proof, and only what follows changes.
        followed += meet && answer.feature_a == FeatureId(FeatureKind::Vertex, seed.inside_a[0]) && seed.inside_a != before;
        if (i % 10 == 0) {
          ASSERT_EQ(oracle::distance(pair.meshes.a.points, pair.meshes.b.points, pose).overlapping, meet) << i;
        }
        const Check checked = check(pair.a, pair.b, pose, answer, effort.tuning.proof);
        ASSERT_TRUE(checked) << checked.message;
      }
    }
  std::printf("%s: %d overlapping, %d disjoint, %d by vertices that followed\n", shapes::name(GetParam()), overlapping,
              disjoint, followed);
  EXPECT_GT(followed, overlapping / 20);
  EXPECT_GT(disjoint, 100);
}

INSTANTIATE_TEST_SUITE_P(Families, RandomPairs, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& family) { return std::string(shapes::name(family.param)); });

Model cube() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return std::move(build(corners)).value().model;
}

TEST(ClosestFeatures, NamesTheUsersFeatures) {
  const Mesh mesh = shapes::cube();
  const Model body = std::move(build(mesh)).value().model;
  Pose above;
  above.translation = {0.25, 0.125, 2.5};
  above.rotation = shapes::rotation(Vec3(1, 2, 0).normalized(), 0.4);
  PairSeed seed;
  const ClosestFeatures met = closest_features(body, body, above, seed);
  ASSERT_EQ(met.answer.verdict, Verdict::Disjoint);
  ASSERT_EQ(met.source_a.kind, FeatureKind::Face);
  ASSERT_EQ(met.source_a.triangles.size(), 2u) << "a square of two triangles";
  for (const std::uint32_t t : met.source_a.triangles) {
    for (const std::uint32_t v : mesh.triangles[t]) EXPECT_EQ(mesh.points[v][2], 1) << "the top";
  }
  ASSERT_EQ(met.source_b.kind, FeatureKind::Vertex);
  const Vec3 corner = above.rotation * mesh.points[met.source_b.vertices[0]] + above.translation;
  EXPECT_LT((corner - met.answer.point_b).norm(), 1e-14);
  EXPECT_LT((met.answer.normal - Vec3(0, 0, 1)).norm(), 1e-15);
}

TEST(ClosestFeatures, NamesBothEndsOfAnEdge) {
  const Model body = cube();
  Pose beside;
  beside.translation = {4, 4, 0};
  beside.rotation = shapes::rotation(Vec3(1, -1, 0).normalized(), 1);
  PairSeed seed;
  const ClosestFeatures met = closest_features(body, body, beside, seed);
  ASSERT_EQ(met.source_a.kind, FeatureKind::Edge);
  // The builder got bare points: vertex i of the user has the signs of i's bits.
  EXPECT_EQ(met.source_a.vertices[0] & met.source_a.vertices[1], 3u) << "x = y = 1";
  EXPECT_EQ(met.source_a.vertices[0] ^ met.source_a.vertices[1], 4u) << "along z";
}

TEST(Within, DecidesBothWaysAndStaysUndecidedOnlyAtTheThreshold) {
  const Model body = cube();
  Pose beside;
  beside.translation = {3, 0, 0};
  PairSeed seed;
  EXPECT_EQ(within(body, body, beside, 0.999, seed).decision, Decision::No);
  EXPECT_EQ(within(body, body, beside, 1.001, seed).decision, Decision::Yes);
  EXPECT_EQ(within(body, body, beside, 1, seed).decision, Decision::Undecided);
  beside.translation = {1, 0, 0};
  EXPECT_EQ(within(body, body, beside, 0, seed).decision, Decision::Yes);
}

TEST(Distance, StopsBeyondTheCutOff) {
  const Bodies& pair = bodies(shapes::Family::Fat);
  Pose far;
  far.translation = {9, 0, 0};
  PairSeed seed, seed_exact;
  Options options;
  options.beyond = 2;
  const Answer cut = distance(pair.a, pair.b, far, seed, options), exact = distance(pair.a, pair.b, far, seed_exact);
  EXPECT_EQ(cut.status, Status::Beyond);
  EXPECT_GT(cut.lower, 2);
  EXPECT_EQ(cut.levels_visited, 0) << "the balls around the bodies are far enough";
  EXPECT_LE(cut.lower, exact.upper);
  EXPECT_GE(cut.upper, exact.lower);
}

TEST(Distance, SaysWhichPrecisionWasOutOfReach) {
  const Bodies& pair = bodies(shapes::Family::Fat);
  Pose far;
  far.translation = {2.5, 0, 0};
  PairSeed seed, seed_exact;
  Options options;
  options.budget.finest_level = 1;
  const Answer coarse = distance(pair.a, pair.b, far, seed, options), exact = distance(pair.a, pair.b, far, seed_exact);
  EXPECT_EQ(coarse.status, Status::LevelLimit);
  EXPECT_EQ(coarse.level_a, 1);
  EXPECT_LE(coarse.lower, exact.upper);
  EXPECT_GE(coarse.upper, exact.lower);
}

TEST(Distance, EndsWhateverTheOptionsBitsAre) {  // an order of refinement that is none went on for ever
  const Bodies& pair = bodies(shapes::Family::Fat);
  const Pose apart{Mat3::Identity(), {2.5, 0.5, 0.25}};
  PairSeed cold;
  const Answer expected = distance(pair.a, pair.b, apart, cold);
  for (const int value : {3, 4, 100, 255}) {
    for (int field = 0; field < 3; ++field) {
      Options options;
      if (field == 0) options.tuning.refinement = Refinement(value);
      if (field == 1) options.tuning.start = StartPolicy(value);
      if (field == 2) options.tuning.plane_rule = PlaneRule(value);
      PairSeed seed;
      const Answer answer = distance(pair.a, pair.b, apart, seed, options);
      EXPECT_EQ(answer.status, Status::Converged);
      EXPECT_LE(answer.lower, expected.upper);
      EXPECT_GE(answer.upper, expected.lower);
    }
  }
}

TEST(Distance, WithoutOptionsIsThatOfTheDefaultOnes) {
  const Bodies& pair = bodies(shapes::Family::Long);
  const std::array<Body, 6> kinds{pair.a,
                                  pair.b,
                                  Body(pair.a, 0.25),
                                  Body::box({-1, -0.5, -0.25}, {1, 0.5, 0.25}),
                                  Body::segment({0, 0, -1}, {0, 0, 1}, 0.5),
                                  Body()};
  for (const Body& a : kinds) {
    for (const Body& b : kinds) {
      shapes::Random random(11);
      PairSeed plain, with_options, verdict, with_effort;
      for (int i = 0; i < 40; ++i) {
        const Pose pose{random.rotation(), random.uniform(0, 3) * random.on_sphere()};
        for (int again = 0; again < 2; ++again) {  // from another pose's seed, then from this one's
          EXPECT_TRUE(answers::same_bits(distance(a, b, pose, plain), distance(a, b, pose, with_options, {})));
          EXPECT_TRUE(answers::same_bits(intersects(a, b, pose, verdict), intersects(a, b, pose, with_effort, {})));
        }
      }
    }
  }
}

TEST(Distance, OfModelsIsThatOfTheirBodies) {
  const Bodies& pair = bodies(shapes::Family::Plate);
  const Model cut = pair.b.cut({.deviation = 0.1});
  ASSERT_GT(cut.finest_level(), 0);
  for (const Model* b : {&pair.a, &pair.b, &cut}) {
    shapes::Random random(13);
    PairSeed of_models, of_bodies, verdict, verdict_of_bodies;
    for (int i = 0; i < 200; ++i) {
      const Pose pose{random.rotation(), random.uniform(0, 3) * random.on_sphere()};
      for (int again = 0; again < 2; ++again) {
        EXPECT_TRUE(
            answers::same_bits(distance(pair.a, *b, pose, of_models), distance(Body(pair.a), Body(*b), pose, of_bodies)));
        EXPECT_TRUE(answers::same_bits(intersects(pair.a, *b, pose, verdict),
                                       intersects(Body(pair.a), Body(*b), pose, verdict_of_bodies)));
      }
    }
  }
}

TEST(Distance, RefusesPosesThatAreNone) {
  const Model body = cube();
  const double nan = std::nan(""), infinity = HUGE_VAL;
  std::vector<Pose> poses(6);
  poses[0].translation = {nan, 0, 0};
  poses[1].translation = {0, infinity, 0};
  poses[2].rotation(1, 1) = nan;
  poses[3].rotation *= 1.001;
  poses[4].rotation.setZero();
  poses[5].rotation(0, 1) = 1e-5;
  for (const Pose& pose : poses) {
    PairSeed seed;
    const Answer answer = distance(body, body, pose, seed);
    EXPECT_EQ(answer.status, Status::InvalidPose);
    EXPECT_EQ(answer.lower, 0);
    EXPECT_EQ(answer.upper, infinity);
    EXPECT_EQ(answer.verdict, Verdict::Undecided);
    EXPECT_TRUE(check(body, body, pose, answer));
  }
}

TEST(Distance, AToleranceThatIsNoneAsksForAnExactAnswer) {
  const Model body = cube();
  const Pose pose{Mat3::Identity(), {3, 0.25, 0.5}};
  const Answer exact = distance(body, body, pose);
  for (const double none : {std::nan(""), -1.0, -HUGE_VAL}) {
    for (const Options& options : {Options{.absolute = none}, Options{.relative = none}}) {
      const Answer answer = distance(body, body, pose, options);
      EXPECT_EQ(answer.status, Status::Converged);
      EXPECT_LE(answer.upper - answer.lower, tolerance(body, body, pose));
      EXPECT_EQ(answer.lower, exact.lower);
    }
  }
  EXPECT_EQ(within(body, body, pose, std::nan("")).decision, Decision::Undecided);
}

TEST(Registers, AreLeftAsTheyWere) {
  if (!upper_halves_can_be_seen()) GTEST_SKIP() << "this processor does not tell";
  use_upper_halves();
  ASSERT_TRUE(upper_halves_are_in_use());
  for (const shapes::Family family : {shapes::Family::Fat, shapes::Family::Plate, shapes::Family::Long}) {
    const Bodies& of = bodies(family);
    shapes::Random random(12);
    PairSeed seeds[4];
    int left = 0;
    for (int i = 0; i < 500; ++i) {
      const Pose pose{random.rotation(), random.uniform(0, i % 2 ? 2 : 6) * random.on_sphere()};
      left += leaves_upper_halves_in_use([&] { distance(of.a, of.b, pose, seeds[0]); });
      left += leaves_upper_halves_in_use([&] { intersects(of.a, of.b, pose, seeds[1]); });
      left += leaves_upper_halves_in_use([&] { within(of.a, of.b, pose, random.uniform(0, 2), seeds[2]); });
      Answer answer;
      left += leaves_upper_halves_in_use([&] { answer = signed_distance(of.a, of.b, pose, seeds[3]); });
      left += leaves_upper_halves_in_use([&] { manifold(of.a, of.b, pose, answer); });
      left += leaves_upper_halves_in_use([&] { closest_features(of.a, of.b, pose); });
    }
    EXPECT_EQ(left, 0);
  }
}

}  // namespace
}  // namespace swiftlet
