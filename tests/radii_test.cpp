// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies with radii under the laws: random, touching, nested and flat pairs with levels, radii from none to a thousand bodies,
// and such that the bodies touch. Truth is the oracle's distance of the hulls less both radii, compared in rationals.
#include <swiftlet/batch.h>
#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <sstream>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "answers.h"
#include "bodies.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using Rational = CGAL::Exact_rational;

struct Subject {
  Mesh mesh;
  Model model;
};

struct Case {
  const Subject* a;
  const Subject* b;
  Pose pose;
  double radius_a, radius_b;
  oracle::Truth hulls;
  Rational distance2;  ///< of the hulls; 0 where they overlap

  Body body_a() const { return {a->model, radius_a}; }
  Body body_b() const { return {b->model, radius_b}; }
  /// The sign of the bodies' signed distance less `x`, where the hulls are apart.
  int compare(double x) const {
    const Rational claim = Rational(x) + Rational(radius_a) + Rational(radius_b);
    return claim < 0 || claim * claim < distance2 ? 1 : claim * claim == distance2 ? 0 : -1;
  }
  bool overlapping() const { return hulls.overlapping || compare(0) < 0; }
  double law_two() const { return tolerance(body_a(), body_b(), pose); }
};

Rational squared_distance(const Subject& a, const Subject& b, const Pose& pose) {
  Rational result;
  std::istringstream(oracle::squared_text(oracle::signed_distance(a.mesh.points, {}, b.mesh.points, pose))) >> result;
  return result;
}

class Cases {
 public:
  Cases() {
    using namespace shapes;
    const auto keep = [this](const Mesh& mesh) {
      return &subjects_.emplace_back(Subject{mesh, bodies::must(build(mesh)).model});
    };
    const Subject *fat = keep(ellipsoid({1, 1, 1}, 500, 1)), *plate = keep(ellipsoid({1, 1, .1}, 400, 2)),
                  *rod = keep(ellipsoid({1, .1, .1}, 400, 3)), *box_ = keep(cube()), *octa = keep(octahedron()),
                  *small = keep(box({0.1, 0.2, 0.3})), *square = keep(polygon(4)), *line = keep(segment(2)),
                  *dot = keep(point());
    shapes::Random random(1);
    for (int i = 0; i < 12; ++i) {
      for (const auto& [p, q] : {std::pair{fat, plate},
                                 {rod, fat},
                                 {box_, octa},
                                 {line, line},
                                 {dot, dot},
                                 {line, box_},
                                 {square, plate},
                                 {dot, fat},
                                 {small, fat}})
        add(p, q, {random.rotation(), random.on_sphere() * random.uniform(0, 4)}, random);
    }
    for (const auto& [p, q] : {std::pair{box_, box_}, {octa, box_}, {line, line}, {square, square}}) {
      for (const Vec3& t : {Vec3(2, 0, 0), Vec3(0, 0, 2.5), Vec3(3, 3, 0.25), Vec3(2.5, 0, 0)})
        add(p, q, {Mat3::Identity(), t}, random);
    }
  }
  auto begin() const { return cases_.begin(); }
  auto end() const { return cases_.end(); }
  const std::deque<Subject>& subjects() const { return subjects_; }

 private:
  void add(const Subject* a, const Subject* b, const Pose& pose, shapes::Random& random) {
    const oracle::Truth truth = oracle::distance(a->mesh.points, b->mesh.points, pose);
    const Rational distance2 = truth.overlapping ? Rational(0) : squared_distance(*a, *b, pose);
    const double d = truth.distance, share = random.uniform(), ulp = 0x1p-52 * d;
    const auto keep = [&](double radius_a, double radius_b) {
      cases_.push_back({a, b, pose, radius_a, radius_b, truth, distance2});
    };
    keep(0.04, 0.04), keep(0, 0.3), keep(1e-17, 1e-300), keep(1000, 1.0 / 3);
    for (const double sum : {d, d - ulp, d + ulp, d * (1 - 1e-12), d * (1 + 1e-12), 0.9 * d, 1.1 * d})
      keep(sum * share, sum - sum * share);
  }
  std::deque<Subject> subjects_;
  std::vector<Case> cases_;
};
const Cases& cases() {
  static const Cases all;
  return all;
}

void for_each_case(const std::function<void(const Case&)>& test) {
  int number = 0;
  for (const Case& c : cases()) {
    test(c);
    if (testing::Test::HasFatalFailure()) {
      FAIL() << "case " << number << ": hulls " << c.hulls.distance << " apart, radii " << c.radius_a << " and " << c.radius_b;
    }
    ++number;
  }
}

/// `proof`: what an overlap of the hulls rests on; without one all planes are tried.
void expect_true(const Case& c, const Answer& answer, const OverlapProof& proof) {
  ASSERT_NE(answer.status, Status::NotConverged);
  ASSERT_GE(answer.lower, 0);
  ASSERT_GE(answer.upper, answer.lower);
  if (c.overlapping()) {
    ASSERT_EQ(answer.lower, 0);
  } else {
    ASSERT_GE(c.compare(answer.lower), 0) << "lower " << answer.lower;
    ASSERT_TRUE(std::isinf(answer.upper) || c.compare(answer.upper) <= 0) << "upper " << answer.upper;
  }
  ASSERT_TRUE(answer.verdict != Verdict::Overlapping || c.overlapping());
  ASSERT_TRUE(answer.verdict != Verdict::Disjoint || !c.overlapping());
  if (answer.verdict == Verdict::Touching && !c.hulls.overlapping) {
    ASSERT_LE(std::fabs(c.hulls.distance - c.radius_a - c.radius_b), c.law_two());
  }
  const Check checked = check(c.body_a(), c.body_b(), c.pose, answer, &proof);
  ASSERT_TRUE(checked) << checked.message;
}
Answer exact(const Case& c, const Options& options = {}) { return distance(c.body_a(), c.body_b(), c.pose, options); }

using answers::same_bits;

TEST(Radii, CasesAreOfEveryVerdict) {
  int apart = 0, shallow = 0, hulls = 0, barely = 0;
  for (const Case& c : cases()) {
    ++(c.hulls.overlapping ? hulls : c.overlapping() ? shallow : apart);
    barely += !c.hulls.overlapping && std::fabs(c.hulls.distance - c.radius_a - c.radius_b) <= c.law_two();
  }
  EXPECT_GE(apart, 250);
  EXPECT_GE(shallow, 250);
  EXPECT_GE(hulls, 50);
  EXPECT_GE(barely, 200);
}

TEST(Radii, IntervalsHoldTheTruthWhateverEndedTheQuery) {  // law 1
  for_each_case([](const Case& c) {
    for (const std::uint32_t budget : {0u, 1u, 3u, ~0u}) {
      for (const int finest : {0, 1, 3}) {
        for (const auto& [absolute, relative] : {std::pair{0.0, 0.0}, {0.1, 0.0}, {1e-6, 0.0}, {0.0, 0.5}, {0.0, 1e-2}}) {
          Options options;
          options.budget.steps = budget, options.budget.finest_level = finest;
          options.absolute = absolute, options.relative = relative;
          LevelRecord records[16];
          OverlapProof proof;
          options.tuning.trace = records, options.tuning.proof = &proof;
          const Answer answer = exact(c, options);
          expect_true(c, answer, proof);
          ASSERT_TRUE(budget != ~0u || finest != 0 || answer.status == Status::Converged);
          ASSERT_TRUE(answer.status != Status::Converged ||
                      answer.upper - answer.lower <= std::max({absolute, relative * answer.lower, c.law_two()}));
          for (int i = 0; i < std::min<int>(answer.levels_visited, 16) && !c.overlapping(); ++i) {
            ASSERT_GE(c.compare(records[i].lower), 0);
            ASSERT_TRUE(std::isinf(records[i].upper) || c.compare(records[i].upper) <= 0);
          }
        }
      }
    }
    for (const double beyond : {0.0, 0.5 * c.hulls.distance, 1.0}) {
      OverlapProof proof;
      const Answer answer = exact(c, {.beyond = beyond, .tuning = {.proof = &proof}});
      expect_true(c, answer, proof);
      ASSERT_TRUE(answer.status != Status::Beyond || answer.lower > beyond);
      ASSERT_TRUE(answer.status == Status::Beyond || answer.lower <= beyond + 2 * c.law_two());
    }
  });
}

TEST(Radii, ExactAnswersAreNarrowAndTheirPointsLieOnTheRoundings) {  // law 2
  int apart = 0;
  for_each_case([&](const Case& c) {
    OverlapProof proof;
    const Answer answer = exact(c, {.tuning = {.proof = &proof}});
    expect_true(c, answer, proof);
    ASSERT_EQ(answer.status, Status::Converged);
    ASSERT_NE(answer.verdict, Verdict::Undecided);
    ASSERT_LE(answer.upper - answer.lower, c.law_two());
    if (answer.verdict == Verdict::Overlapping) return;
    ++apart;
    const Vec3 p = answer.point_a, q = answer.point_b;
    ASSERT_NEAR(oracle::distance({&p, 1}, c.a->mesh.points, {}).distance, c.radius_a, c.law_two());
    ASSERT_NEAR(oracle::distance({&q, 1}, c.b->mesh.points, c.pose).distance, c.radius_b, c.law_two());
    ASSERT_LE(((q - p) - (q - p).norm() * answer.normal).norm(), 2 * c.law_two());
  });
  EXPECT_GE(apart, 250);
}

TEST(Radii, ContactsOfRoundingsThatOverlapAreAsDeepAsTheyOverlap) {
  int shallow = 0;
  for_each_case([&](const Case& c) {
    OverlapProof proof;
    const Answer answer = closest_features(c.body_a(), c.body_b(), c.pose, {.tuning = {.proof = &proof}}).answer;
    expect_true(c, answer, proof);
    ASSERT_EQ(answer.verdict == Verdict::Overlapping, exact(c).verdict == Verdict::Overlapping);
    if (c.hulls.overlapping || c.hulls.distance < 1e3 * c.law_two()) return;
    shallow += answer.verdict == Verdict::Overlapping;
    ASSERT_NEAR(answer.normal.dot(answer.point_b - answer.point_a), c.hulls.distance - c.radius_a - c.radius_b,
                2 * c.law_two());
    const Vec3 p = answer.point_a - c.radius_a * answer.normal;
    ASSERT_LE(oracle::distance({&p, 1}, c.a->mesh.points, {}).distance, c.law_two());
  });
  EXPECT_GE(shallow, 250);
}

TEST(Radii, SeedsChangeTheWorkNeverTheTruth) {  // law 3
  shapes::Random random(2);
  PairSeed stale;
  for_each_case([&](const Case& c) {
    const Answer cold = exact(c);
    PairSeed warm, garbage;
    distance(c.body_a(), c.body_b(), c.pose, warm);
    for (std::size_t i = 0; i + 8 <= sizeof garbage; i += 8) {
      const std::uint64_t bits = random.bits();
      std::memcpy(reinterpret_cast<char*>(&garbage) + i, &bits, 8);
    }
    garbage.met = false;
    for (const StartPolicy policy : {StartPolicy::Automatic, StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest}) {
      OverlapProof proof;
      const Options options{.tuning = {.start = policy, .proof = &proof}};
      for (PairSeed* seed : {&warm, &stale, &garbage}) {
        const Answer answer = distance(c.body_a(), c.body_b(), c.pose, *seed, options);
        expect_true(c, answer, proof);
        ASSERT_EQ(answer.verdict, cold.verdict);
        ASSERT_NEAR(answer.lower, cold.lower, c.law_two());
        ASSERT_NEAR(answer.upper, cold.upper, c.law_two());
      }
    }
  });
}

TEST(Radii, SwappingTheBodiesSwapsTheAnswer) {  // law 4
  for_each_case([](const Case& c) {
    const Answer there = exact(c);
    const Answer back = distance(c.body_b(), c.body_a(), inverse(c.pose));
    ASSERT_NEAR(there.lower, back.lower, c.law_two());
    ASSERT_NEAR(there.upper, back.upper, c.law_two());
    const double zero = c.hulls.distance - c.radius_a - c.radius_b;
    ASSERT_TRUE(there.verdict == back.verdict || c.hulls.distance <= c.law_two() || std::fabs(zero) <= 2 * c.law_two());
    if (there.verdict != Verdict::Disjoint || there.lower < 1e3 * c.law_two()) return;
    ASSERT_LE((there.normal + c.pose.rotation * back.normal).norm(), 2 * std::sqrt(2 * c.law_two() / there.lower));
  });
}

TEST(Radii, ScalingByAPowerOfTwoScalesTheAnswerBitForBit) {  // law 5
  for (const int k : {-40, 1, 33}) {
    const double s = std::ldexp(1, k);
    std::deque<Model> scaled;
    for (const Subject& subject : cases().subjects()) {
      Mesh mesh = subject.mesh;
      for (Vec3& p : mesh.points) p *= s;
      scaled.push_back(bodies::must(build(mesh)).model);
    }
    const auto model = [&](const Subject* subject) -> const Model& {
      for (std::size_t i = 0;; ++i)
        if (&cases().subjects()[i] == subject) return scaled[i];
    };
    for_each_case([&](const Case& c) {
      Answer plain = exact(c);
      const Answer answer =
          distance({model(c.a), c.radius_a * s}, {model(c.b), c.radius_b * s}, {c.pose.rotation, s * c.pose.translation});
      plain.lower *= s, plain.upper *= s, plain.point_a *= s, plain.point_b *= s;
      plain.radius_a *= s, plain.radius_b *= s;
      ASSERT_TRUE(same_bits(plain, answer)) << k;
    });
  }
}

TEST(Radii, ThresholdsAndVerdictsAreUndecidedOnlyWithinLawTwo) {  // law 9
  int yes = 0, no = 0, overlapping = 0, disjoint = 0;
  for_each_case([&](const Case& c) {
    const double d = c.hulls.distance - c.radius_a - c.radius_b, bound = c.law_two();
    for (const double threshold : {0.0, 0.5 * d, d - 2 * bound, d, d + 2 * bound, 2 * d, 1.0}) {
      if (threshold < 0) continue;
      OverlapProof proof;
      const Within result = within(c.body_a(), c.body_b(), c.pose, threshold, {.tuning = {.proof = &proof}});
      expect_true(c, result.answer, proof);
      ASSERT_EQ(result.answer.status, Status::Converged);
      const bool truth = c.hulls.overlapping || c.compare(threshold) <= 0;
      if (result.decision == Decision::Undecided) {
        ASSERT_LE(std::fabs(threshold - d), bound);
      } else {
        ASSERT_EQ(result.decision == Decision::Yes, truth);
        ++(truth ? yes : no);
      }
    }
    OverlapProof proof;
    const Answer answer = intersects(c.body_a(), c.body_b(), c.pose, {.tuning = {.proof = &proof}});
    expect_true(c, answer, proof);
    ASSERT_EQ(answer.status, Status::Converged);
    ASSERT_NE(answer.verdict, Verdict::Undecided);
    if (std::fabs(d) > bound && !c.hulls.overlapping) {
      ASSERT_EQ(answer.verdict, c.overlapping() ? Verdict::Overlapping : Verdict::Disjoint);
    }
    overlapping += answer.verdict == Verdict::Overlapping, disjoint += answer.verdict == Verdict::Disjoint;
  });
  EXPECT_GE(std::min(yes, no), 500);
  EXPECT_GE(std::min(overlapping, disjoint), 250);
}

TEST(Radii, ALooserToleranceNeverCostsMore) {  // law 10
  for_each_case([](const Case& c) {
    std::uint32_t before = ~0u;
    for (const double relative : {0.0, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
      Options options;
      options.relative = relative;
      const Answer answer = exact(c, options);
      ASSERT_LE(answer.steps + answer.plane_tests, before) << relative;
      before = answer.steps + answer.plane_tests;
    }
  });
}

TEST(Radii, ComeOffTheSignedDistance) {
  int deep = 0, shallow = 0;
  for_each_case([&](const Case& c) {
    const double radii = c.radius_a + c.radius_b, d = c.hulls.distance - radii;
    PairSeed seed;
    OverlapProof proof;
    const Answer answer = signed_distance(c.body_a(), c.body_b(), c.pose, seed, {.tuning = {.proof = &proof}});
    const Answer hulls = signed_distance(c.a->model, c.b->model, c.pose);
    ASSERT_EQ(answer.status, Status::Converged);
    ASSERT_NE(answer.verdict, Verdict::Undecided);
    ASSERT_LE(answer.upper - answer.lower, c.law_two());
    ASSERT_TRUE(answer.lower <= hulls.upper - radii + c.law_two() && answer.upper >= hulls.lower - radii - c.law_two());
    ASSERT_TRUE(c.hulls.overlapping || (c.compare(answer.lower) >= 0 && c.compare(answer.upper) <= 0));
    ASSERT_TRUE(answer.verdict != Verdict::Overlapping || answer.upper < 0 || proof.count == 4);
    ASSERT_NEAR(answer.normal.dot(answer.point_b - answer.point_a), answer.upper, 2 * c.law_two());
    for (const double threshold : {answer.lower - 1e-3, answer.upper + 1e-3, 2 * d, -1.0}) {
      const Within within = signed_within(c.body_a(), c.body_b(), c.pose, threshold, seed);
      const bool near = std::fabs(threshold - answer.lower) <= 2 * c.law_two();
      ASSERT_TRUE(near || within.decision == (answer.upper <= threshold ? Decision::Yes : Decision::No)) << threshold;
    }
    deep += c.hulls.overlapping, shallow += !c.hulls.overlapping && answer.verdict == Verdict::Overlapping;
  });
  EXPECT_GE(deep, 50);
  EXPECT_GE(shallow, 250);
}

TEST(Radii, MakeSpheresAndCapsules) {
  const Body sphere = Body::point({0, 0, 0}, 0.25), capsule = Body::segment({-1, 0, 0}, {1, 0, 0}, 0.5);
  const Answer apart = distance(capsule, sphere, {Mat3::Identity(), {0.5, 2, 0}});
  EXPECT_EQ(apart.verdict, Verdict::Disjoint);
  EXPECT_NEAR(apart.lower, 1.25, 1e-14);
  EXPECT_LE((apart.point_a - Vec3(0.5, 0.5, 0)).norm(), 1e-14);
  EXPECT_LE((apart.point_b - Vec3(0.5, 1.75, 0)).norm(), 1e-14);
  EXPECT_EQ(intersects(capsule, sphere, {Mat3::Identity(), {1.5, 0.5, 0}}).verdict, Verdict::Overlapping);
  EXPECT_EQ(intersects(capsule, sphere, {Mat3::Identity(), {0, 0.75, 0}}).verdict, Verdict::Touching);
  EXPECT_EQ(intersects(capsule, sphere, {Mat3::Identity(), {0, 0, 0}}).verdict, Verdict::Overlapping);
}

TEST(Radii, OfAPairGoThroughABatch) {
  std::vector<PairQuery> pairs;
  for (const Case& c : cases()) pairs.push_back({c.body_a(), c.body_b(), c.pose});
  std::vector<Answer> distances(pairs.size()), verdicts(pairs.size());
  distance(pairs, distances, {}, {.executor = on_threads(2)});
  intersects(pairs, verdicts);
  std::size_t i = 0;
  for (const Case& c : cases()) {
    EXPECT_TRUE(same_bits(distances[i], exact(c)));
    EXPECT_TRUE(same_bits(verdicts[i], intersects(c.body_a(), c.body_b(), c.pose)));
    ++i;
  }
}

TEST(Radii, RefineIntervalsWiderThanLawTwo) {
  int wide = 0;
  for_each_case([&](const Case& c) {
    const Answer exactly = exact(c);
    const double bound = c.law_two();
    if (exactly.lower <= 2 * bound) return;
    for (const double times : {1.01, 1.5, 1.9, 2.5}) {
      for (const double relative : {0.0, 1e-18, 1e-15}) {
        Answer so_far = exactly;
        const double more = 0.5 * (times * bound - (so_far.upper - so_far.lower));
        so_far.lower -= more, so_far.upper += more;
        Options options;
        options.relative = relative;
        const Answer finer = refine(c.body_a(), c.body_b(), c.pose, so_far, options);
        expect_true(c, finer, {});
        ASSERT_EQ(finer.status, Status::Converged);
        ASSERT_LE(finer.upper - finer.lower, std::max(relative * finer.lower, bound)) << times << " times law 2, " << relative;
        ++wide;
      }
    }
  });
  EXPECT_GE(wide, 2000);
}

TEST(Radii, ThatAreNoneAreAStatus) {
  const Model cube = bodies::model(bodies::cube());
  const Pose pose{Mat3::Identity(), {3, 0, 0}};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Answer legal = distance(cube, cube, pose);
  const auto expect_refused = [&](const Answer& answer, double least) {
    EXPECT_EQ(answer.status, Status::InvalidRadius);
    EXPECT_EQ(answer.verdict, Verdict::Undecided);
    EXPECT_EQ(answer.lower, least);
    EXPECT_EQ(answer.upper, kInfinity);
    EXPECT_EQ(answer.steps + answer.plane_tests, 0u);
    EXPECT_TRUE(answer.normal.array().isNaN().all() && answer.point_a.array().isNaN().all() &&
                answer.point_b.array().isNaN().all());
  };
  for (const double radius : {-1.0, -1e-300, std::nan(""), kInfinity, -kInfinity, 1.0000001e45, 1e308}) {
    for (const bool of_a : {false, true}) {
      const Body a(cube, of_a ? radius : 0), b(cube, of_a ? 0 : radius);
      expect_refused(distance(a, b, pose), 0);
      expect_refused(intersects(a, b, pose), 0);
      expect_refused(closest_features(a, b, pose).answer, 0);
      expect_refused(refine(a, b, pose, legal), 0);
      const Within near = within(a, b, pose, 5);
      expect_refused(near.answer, 0);
      EXPECT_EQ(near.decision, Decision::Undecided);
      expect_refused(signed_distance(a, b, pose), -kInfinity);
      for (const double threshold : {-1.0, 5.0}) {
        const Within deep = signed_within(a, b, pose, threshold);
        expect_refused(deep.answer, -kInfinity);
        EXPECT_EQ(deep.decision, Decision::Undecided);
      }
      const PairQuery pair{a, b, pose};
      Answer answer;
      distance({&pair, 1}, {&answer, 1});
      expect_refused(answer, 0);
      intersects({&pair, 1}, {&answer, 1});
      expect_refused(answer, 0);
      EXPECT_TRUE(std::isnan(tolerance(a, b, pose)));
      EXPECT_EQ(manifold(a, b, pose, legal, {.margin = 2}).count, 0u);
      EXPECT_TRUE(check(a, b, pose, answer));
      EXPECT_FALSE(check(cube, cube, pose, answer));
      EXPECT_FALSE(check(a, b, pose, legal));
    }
  }
  EXPECT_EQ(manifold(cube, cube, pose, legal, {.margin = 2}).count, 4u);
  const Answer met = distance({cube, 1e45}, {cube, 1e45}, pose);
  EXPECT_EQ(met.status, Status::Converged);
  EXPECT_EQ(met.verdict, Verdict::Overlapping);
}

TEST(Radii, OfAnAnswerAreThoseOfTheBodies) {
  const Model cube = bodies::model(bodies::cube());
  const Pose pose{Mat3::Identity(), {3, 0, 0}};
  const Body a(cube, 0.25), b(cube, 0.5);
  const Answer answer = distance(a, b, pose);
  EXPECT_EQ(answer.radius_a, 0.25);
  EXPECT_EQ(answer.radius_b, 0.5);
  EXPECT_TRUE(check(a, b, pose, answer));
  EXPECT_EQ(manifold(a, b, pose, answer, {.margin = 1}).count, 4u);
  for (const auto& [p, q] : {std::pair<Body, Body>{cube, cube}, {a, cube}, {b, a}}) {
    EXPECT_FALSE(check(p, q, pose, answer));
    EXPECT_EQ(manifold(p, q, pose, answer, {.margin = 1}).count, 0u);
    EXPECT_EQ(refine(p, q, pose, answer).status, Status::InvalidRadius);
  }
}

TEST(Radii, ChecksFailOnWrongClaims) {
  const Case& c = *std::find_if(cases().begin(), cases().end(), [](const Case& any) { return exact(any).lower > 0.1; });
  const auto holds = [&](const Answer& answer) { return bool(check(c.body_a(), c.body_b(), c.pose, answer)); };
  Answer high = exact(c), low = high, inside = high, overlap = high;
  high.lower = high.upper = high.upper * (1 + 1e-12);
  low.upper = low.lower = low.lower * (1 - 1e-12);
  inside.point_a += 1e-9 * inside.normal;
  overlap.verdict = Verdict::Overlapping;
  for (const Answer& wrong : {high, low, inside, overlap}) EXPECT_FALSE(holds(wrong));
}

}  // namespace
}  // namespace swiftlet
