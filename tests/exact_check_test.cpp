// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The judge of the generators can fail: true answers pass, and each of their fields, changed by as little as makes it false, is
// flagged.
#include <swiftlet/build.h>
#include <swiftlet/depth.h>
#include <swiftlet/query.h>

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "exact_check.h"
#include "shapes.h"

namespace swiftlet::stability {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Subject hull(std::uint32_t points, std::uint64_t seed) {
  const Mesh mesh = shapes::random_polytope(points, seed);
  return make_subject(mesh.points, bodies::must(build(mesh)).model);
}
Subject cube() { return make_subject(bodies::cube().points, bodies::model(bodies::cube())); }

/// An answer and the proof that it rests on.
struct Proved {
  Answer answer;
  OverlapProof proof;
};
Proved exact(const Subject& a, const Subject& b, const Pose& pose) {
  OverlapProof proof;
  const Answer answer = distance(a.model, b.model, pose, {.tuning = {.proof = &proof}});
  return {answer, proof};
}

/// What the judge, fresh, and then one that knows the truth, say of a changed answer.
void expect_flagged(const Subject& a, const Subject& b, const Pose& pose, const char* what, const Proved& changed) {
  Judge fresh(a, b, pose), knowing(a, b, pose);
  knowing.truth();
  EXPECT_NE(fresh.exact(changed.answer, changed.proof), "") << what;
  EXPECT_NE(knowing.exact(changed.answer, changed.proof), "") << what << ", with the truth known";
}
void expect_flagged(const Subject& a, const Subject& b, const Pose& pose, const char* what,
                    const std::function<void(Answer&)>& change) {
  Proved changed = exact(a, b, pose);
  change(changed.answer);
  expect_flagged(a, b, pose, what, changed);
}

struct Scene {
  Subject a = hull(20, 1), b = hull(30, 2);
  Pose apart{shapes::Random(3).rotation(), {1.5, 1.5, 1}}, inside{shapes::Random(4).rotation(), {0.1, 0.2, 0.3}};
};

TEST(Judge, PassesTrueAnswers) {
  const Scene s;
  shapes::Random random(5);
  int verdicts[4] = {0, 0, 0, 0};
  for (int i = 0; i < 300; ++i) {
    const Pose pose{random.rotation(), random.in_ball() * 2};
    const auto [answer, proof] = exact(s.a, s.b, pose);
    ++verdicts[int(answer.verdict)];
    Judge judge(s.a, s.b, pose);
    EXPECT_EQ(judge.exact(answer, proof), "");
    EXPECT_FALSE(judge.has_truth()) << "the features show the upper bound";
    judge.truth();
    EXPECT_EQ(judge.exact(answer, proof), "");
  }
  EXPECT_GE(verdicts[int(Verdict::Disjoint)], 50);
  EXPECT_GE(verdicts[int(Verdict::Overlapping)], 50);
}

TEST(Judge, FlagsALowerBoundOneUlpAboveTheGap) {
  const Scene s;
  const Answer answer = exact(s.a, s.b, s.apart).answer;
  const double gap = oracle::gap(s.a.points, s.b.points, s.apart, answer.normal).lower;
  ASSERT_GE(gap, answer.lower);
  ASSERT_LE(gap, answer.upper);
  Answer changed = answer;
  changed.lower = gap;
  EXPECT_EQ(Judge(s.a, s.b, s.apart).exact(changed), "");
  changed.lower = std::nextafter(gap, kInfinity);
  EXPECT_NE(Judge(s.a, s.b, s.apart).exact(changed), "");
}

TEST(Judge, FlagsAnUpperBoundOneUlpBelowTheDistance) {
  const Scene s;
  const Answer answer = exact(s.a, s.b, s.apart).answer;
  const oracle::Interval truth = oracle::distance(s.a.points, s.b.points, s.apart).bounds;
  Answer changed = answer;
  changed.lower = std::nextafter(answer.lower, 0);
  changed.upper = truth.upper;
  EXPECT_EQ(Judge(s.a, s.b, s.apart).exact(changed), "");
  changed.upper = std::nextafter(truth.lower, 0);
  EXPECT_NE(Judge(s.a, s.b, s.apart).exact(changed), "");
  changed.lower = 0;
  EXPECT_NE(Judge(s.a, s.b, s.apart).interval(changed), "");
}

TEST(Judge, FlagsEveryFieldOfADisjointAnswer) {
  const Scene s;
  const double bound = Judge(s.a, s.b, s.apart).law_two();
  const auto flagged = [&](const char* what, const auto& change) { expect_flagged(s.a, s.b, s.apart, what, change); };
  flagged("flipped normal", [](Answer& x) { x.normal = -x.normal; });
  flagged("longer normal", [](Answer& x) { x.normal *= 1 + 0x1p-49; });
  flagged("no normal", [](Answer& x) { x.normal.setZero(); });
  flagged("normal turned by 1e-6", [](Answer& x) { x.normal = (x.normal + 1e-6 * x.normal.unitOrthogonal()).normalized(); });
  flagged("wide", [&](Answer& x) { x.lower = x.upper - 1.01 * bound; });
  flagged("infinite", [](Answer& x) { x.upper = kInfinity; });
  flagged("not a number", [](Answer& x) { x.lower = std::nan(""); });
  flagged("touching", [](Answer& x) { x.verdict = Verdict::Touching; });
  flagged("overlapping without a proof", [](Answer& x) { x.verdict = Verdict::Overlapping; });
  flagged("undecided", [](Answer& x) { x.verdict = Verdict::Undecided; });
  flagged("not converged", [](Answer& x) { x.status = Status::NotConverged; });
  flagged("ended by its budget", [](Answer& x) { x.status = Status::Budget; });
  flagged("a level that is not there", [](Answer& x) { x.level_a = 1; });
  flagged("endless", [](Answer& x) { x.steps = ~0u; });
  flagged("point of A off along the normal", [&](Answer& x) { x.point_a += 3 * bound * x.normal; });
  flagged("point of B off along the normal", [&](Answer& x) { x.point_b += 3 * bound * x.normal; });
  flagged("point of A off against the normal", [&](Answer& x) { x.point_a -= 3 * bound * x.normal; });
  flagged("point of B off against the normal", [&](Answer& x) { x.point_b -= 3 * bound * x.normal; });
  flagged("points lean from the normal", [&](Answer& x) { x.point_a += 3 * bound * x.normal.unitOrthogonal(); });
  flagged("points swapped", [](Answer& x) { std::swap(x.point_a, x.point_b); });
  flagged("both points aside", [](Answer& x) {
    const Vec3 aside = x.normal.unitOrthogonal() * 3;
    x.point_a += aside, x.point_b += aside;
  });
}

TEST(Judge, FlagsFalseProofsOfOverlap) {
  const Scene s;
  const Proved there = exact(s.a, s.b, s.inside);
  ASSERT_EQ(there.answer.verdict, Verdict::Overlapping);
  expect_flagged(s.a, s.b, s.apart, "the proof of another pose", there);
  const auto flagged_proof = [&](const char* what, const std::function<void(OverlapProof&)>& change) {
    Proved changed = there;
    change(changed.proof);
    expect_flagged(s.a, s.b, s.inside, what, changed);
  };
  const auto flagged = [&](const char* what, const auto& change) { expect_flagged(s.a, s.b, s.inside, what, change); };
  flagged("disjoint", [](Answer& x) { x.verdict = Verdict::Disjoint; });
  flagged("disjoint with a lower bound", [](Answer& x) {
    x.verdict = Verdict::Disjoint;
    x.lower = x.upper = 1e-300;
    x.normal = Vec3::UnitX();
  });
  flagged("deep, but touching", [](Answer& x) {
    x.verdict = Verdict::Touching;
    x.normal = Vec3::UnitX();
  });
  flagged("apart", [](Answer& x) { x.upper = 1e-300; });
  flagged_proof("three vertices", [](OverlapProof& x) { x.count = 3; });
  flagged_proof("no vertex", [](OverlapProof& x) { x.vertex_b[2] = 1000; });
  flagged_proof("one vertex twice", [](OverlapProof& x) { x.vertex_a[1] = x.vertex_a[0], x.vertex_b[1] = x.vertex_b[0]; });
}

TEST(Judge, FlagsEveryFieldOfADepth) {
  const Scene s;
  const Answer answer = signed_distance(s.a.model, s.b.model, s.inside);
  ASSERT_EQ(answer.verdict, Verdict::Overlapping);
  const double bound = Judge(s.a, s.b, s.inside).law_two();
  EXPECT_EQ(Judge(s.a, s.b, s.inside).exact(answer), "");
  const auto flagged = [&](const char* what, const std::function<void(Answer&)>& change) {
    Answer changed = answer;
    change(changed);
    EXPECT_NE(Judge(s.a, s.b, s.inside).exact(changed), "") << what;
  };
  flagged("not converged", [](Answer& x) { x.status = Status::NotConverged; });
  flagged("ended by its budget", [](Answer& x) { x.status = Status::Budget; });
  flagged("undecided", [](Answer& x) { x.verdict = Verdict::Undecided; });
  flagged("disjoint", [](Answer& x) { x.verdict = Verdict::Disjoint; });
  flagged("touching", [](Answer& x) { x.verdict = Verdict::Touching; });
  flagged("wide", [&](Answer& x) { x.upper = x.lower + 1.01 * bound; });
  flagged("shallower than along the normal", [&](Answer& x) { x.lower += bound, x.upper += bound; });
  flagged("deeper than the truth", [&](Answer& x) { x.lower -= bound, x.upper -= bound; });
  flagged("not a number", [](Answer& x) { x.lower = std::nan(""); });
  flagged("flipped normal", [](Answer& x) { x.normal = -x.normal; });
  flagged("longer normal", [](Answer& x) { x.normal *= 1 + 0x1p-49; });
  flagged("point of A off along the normal", [&](Answer& x) { x.point_a += 3 * bound * x.normal; });
  flagged("both points aside", [](Answer& x) {
    const Vec3 aside = x.normal.unitOrthogonal() * 3;
    x.point_a += aside, x.point_b += aside;
  });
}

TEST(Judge, TellsTouchingFromOverlapByLawTwo) {
  const Subject a = cube(), b = cube();
  const auto pose = [](double x) { return Pose{Mat3::Identity(), {x, 0.25, 0}}; };
  const Answer touching = exact(a, b, pose(2)).answer;
  ASSERT_EQ(touching.verdict, Verdict::Touching);
  EXPECT_EQ(Judge(a, b, pose(2)).exact(touching), "");
  const double bound = Judge(a, b, pose(2)).law_two();
  EXPECT_EQ(Judge(a, b, pose(2 - bound / 2)).interval(touching), "");
  EXPECT_NE(Judge(a, b, pose(2 - 2 * bound)).interval(touching), "") << "deeper than the bound";
  EXPECT_NE(Judge(a, b, pose(2 + 2 * bound)).interval(touching), "") << "farther apart than the bound";
  expect_flagged(a, b, pose(2), "touching without a normal", [](Answer& x) { x.normal.setZero(); });
}

TEST(Judge, FlagsWrongDecisions) {
  const Scene s;
  const double d = oracle::distance(s.a.points, s.b.points, s.apart).distance, bound = Judge(s.a, s.b, s.apart).law_two();
  PairSeed seed;
  for (const double threshold : {d / 2, d - 4 * bound, d + 4 * bound, 2 * d}) {
    const Within right = within(s.a.model, s.b.model, s.apart, threshold, seed);
    EXPECT_EQ(Judge(s.a, s.b, s.apart).decision(right, threshold), "");
    for (const Decision other : {Decision::Yes, Decision::No, Decision::Undecided}) {
      if (other == right.decision) continue;
      Within wrong = right;
      wrong.decision = other;
      EXPECT_NE(Judge(s.a, s.b, s.apart).decision(wrong, threshold), "") << threshold - d;
    }
  }
}

TEST(Judge, FlagsCoarseAnswersThatAreNotTrue) {
  const Mesh mesh = shapes::ellipsoid({1, 1, 1}, 600, 9);
  const Subject a = make_subject(mesh.points, bodies::must(build(mesh)).model);
  ASSERT_GE(a.model.level_count(), 2);
  const Pose pose{Mat3::Identity(), {1.5, 1.5, 0.5}};
  Answer answer = distance(a.model, a.model, pose, {.budget = {.finest_level = 1}});
  ASSERT_EQ(answer.level_a, 1);
  EXPECT_EQ(Judge(a, a, pose).interval(answer), "");
  answer.upper = answer.lower;
  EXPECT_NE(Judge(a, a, pose).interval(answer), "");
}

TEST(Judge, FlagsEveryFieldOfADepthOfACoarseLevel) {
  BuildOptions options;
  options.cutoff = 12;
  const auto leveled = [&options](std::uint64_t seed) {
    const Mesh mesh = shapes::random_polytope(200, seed);
    return make_subject(mesh.points, bodies::must(build(mesh, options)).model);
  };
  const Subject a = leveled(1), b = leveled(2);
  const Pose pose{shapes::Random(4).rotation(), {0.8, 0.7, 0.5}};
  const Answer answer = signed_distance(a.model, b.model, pose, {.budget = {.finest_level = 1}});
  ASSERT_LT(answer.upper, 0);
  ASSERT_GT(answer.level_a + answer.level_b, 0);
  EXPECT_EQ(Judge(a, b, pose).coarse(answer), "");
  const auto flagged = [&](const char* what, const std::function<void(Answer&)>& change) {
    Answer changed = answer;
    change(changed);
    EXPECT_NE(Judge(a, b, pose).coarse(changed), "") << what;
  };
  flagged("a budget ended it", [](Answer& s) { s.status = Status::Budget; });
  flagged("deeper", [](Answer& s) { s.lower /= 2; });
  flagged("shallower", [&](Answer& s) { s.upper = 2 * s.lower; });
  flagged("A's point out of A", [](Answer& s) { s.point_a += 1e-9 * s.normal; });
  flagged("B's point out of B", [](Answer& s) { s.point_b -= 1e-9 * s.normal; });
  flagged("no point", [](Answer& s) { s.point_b.setConstant(std::nan("")); });
  flagged("a corner of A far aside", [&](Answer& s) {
    for (const Vec3& corner : bodies::points_of(a.model.level(s.level_a).view))
      if ((corner - s.point_b).norm() > (s.point_a - s.point_b).norm()) s.point_a = corner;
  });
  flagged("one point of both", [](Answer& s) { s.point_b = s.point_a; });
}

TEST(Judge, RefusesModelsOfOtherPoints) {
  std::vector<Vec3> points = bodies::cube().points;
  points[3].x() = std::nextafter(points[3].x(), 0);
  EXPECT_THROW(make_subject(points, bodies::model(bodies::cube())), std::logic_error);
}

}  // namespace
}  // namespace swiftlet::stability
