// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The checker, attacked both ways: answers made of the rational truth pass, and forged ones do not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>

#include "bodies.h"
#include "forgeries.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

using Points = std::vector<Vec3>;

struct Polyhedron {
  Points points;
  Model model;
  operator Body() const { return model; }
};
Polyhedron body(const Points& points) {
  Result<Built> built = build(points, {});
  if (!built) throw std::runtime_error(built.error().message);
  return {points, built.value().model};
}
Polyhedron body(const Mesh& mesh) { return body(mesh.points); }
Polyhedron box(double x, double y, double z) { return body(shapes::box({x, y, z})); }
/// (cos k pi/2, sin k pi/2, +-1), as libm rounds them.
Polyhedron square_prism() {
  Points points;
  for (int k = 0; k < 4; ++k) {
    for (const double z : {-1.0, 1.0})
      points.emplace_back(std::cos(k * std::acos(-1.0) / 2), std::sin(k * std::acos(-1.0) / 2), z);
  }
  return body(points);
}

/// A pair, what is true of it, and an exact answer made of that: the deepest points are where B touches A, moved free.
struct Problem {
  Problem(const Polyhedron& first, const Polyhedron& second, const Pose& b_in_a)
      : a(first),
        b(second),
        pose(b_in_a),
        bound(tolerance(a, b, pose)),
        truth(oracle::signed_distance(a.points, {}, b.points, pose)) {
    answer.status = Status::Converged;
    answer.is_signed = true;
    answer.verdict = truth.sign > 0 ? Verdict::Disjoint : truth.sign < 0 ? Verdict::Overlapping : Verdict::Touching;
    answer.normal = truth.normal.normalized();
    answer.lower = oracle::gap(a.points, b.points, pose, answer.normal).lower;
    answer.upper = truth.bounds.upper;
    Pose free = pose;
    if (truth.sign < 0) free.translation += answer.normal * (bound / 8 - truth.distance);
    const oracle::Truth near = oracle::distance(a.points, b.points, free);
    answer.point_a = near.witness_a;
    answer.point_b = near.witness_b - (free.translation - pose.translation);
  }

  std::string refusal(const Answer& s) const { return check(a, b, pose, s, Question::Exact).message; }

  const Polyhedron &a, &b;
  Pose pose;
  double bound;
  oracle::SignedTruth truth;
  Answer answer;
};

/// Random hulls, boxes, slabs and prisms, overlapping.
void for_each_overlap(int count, std::uint64_t seed, const std::function<void(const Problem&)>& visit) {
  shapes::Random random(seed);
  const std::vector<Polyhedron> solids{body(shapes::cube()),
                                       box(2, 2, 0.2),
                                       box(2, 0.2, 0.2),
                                       square_prism(),
                                       body(shapes::prism(5, 1, 2)),
                                       body(shapes::prism(8, 1, 0.1)),
                                       body(shapes::octahedron())};
  for (int i = 0; i < count; ++i) {
    Points p, q;
    const int n = 4 + int(random.bits() % 12);
    for (int k = 0; k < n; ++k) p.push_back(random.in_ball()), q.push_back(random.in_ball());
    const Polyhedron first = body(p), second = body(q);
    const Polyhedron &a = i % 3 == 0 ? first : solids[random.bits() % solids.size()],
                     &b = i % 3 == 2 ? solids[random.bits() % solids.size()] : second;
    const Problem problem(a, b, {random.rotation(), random.in_ball() * 0.5});
    if (problem.truth.sign < 0) visit(problem);
  }
}

/// One of the 24 rotations of the lattice, shaken as a whole or entry by entry.
Mat3 shaken_lattice(shapes::Random& random, double by) {
  Mat3 r = Mat3::Zero();
  const int first = int(random.bits() % 3), turn = 1 + int(random.bits() % 2);
  for (int k = 0; k < 3; ++k) r(k, (first + k * turn) % 3) = random.bits() % 2 ? 1 : -1;
  if (r.determinant() < 0) r.row(0) *= -1;
  if (random.bits() % 2) return shapes::rotation(random.on_sphere(), by) * r;
  for (int k = 0; k < 9; ++k) r(k / 3, k % 3) += by * random.uniform(-1, 1);
  return r;
}

/// (Nearly) coinciding solids, all of whose edges are nearly parallel to one another.
void for_each_coincidence(int count, std::uint64_t seed, const std::function<void(const Problem&)>& visit) {
  shapes::Random random(seed);
  const std::vector<Polyhedron> solids{body(shapes::cube()), box(2, 2, 0.2), box(2, 0.2, 0.2), square_prism(),
                                       body(shapes::prism(6, 1, 2))};
  for (int i = 0; i < count; ++i) {
    const double by = std::ldexp(1.0, -30 - int(random.bits() % 23));
    const Polyhedron &a = solids[random.bits() % solids.size()], &b = i % 4 == 0 ? solids[random.bits() % solids.size()] : a;
    Pose pose{shaken_lattice(random, by), Vec3::Zero()};
    if (random.bits() % 2) pose.translation = random.in_ball() * by;
    visit(Problem(a, b, pose));
  }
}

TEST(CheckOfDepth, AcceptsAPrismInItself) {
  const Polyhedron prism = square_prism();
  EXPECT_EQ(check(prism, prism, {}, signed_distance(prism, prism, {}), Question::Exact).message, "");
  EXPECT_EQ(Problem(prism, prism, {}).refusal(Problem(prism, prism, {}).answer), "");
}

/// Opposite sides are parallel but for the last place, and what is left of their cross products was noise.
TEST(CheckOfDepth, AcceptsPrismsTurnedAndMovedInThemselves) {
  shapes::Random random(1);
  const Polyhedron prism = square_prism();
  int refused = 0;
  const auto judge = [&](const Polyhedron& a, const Pose& pose) {
    const Problem p(a, a, pose);
    refused += p.refusal(p.answer) != "";
  };
  for (int i = 0; i < 100; ++i) {
    const Mat3 turn = shapes::rotation({1, 0, 0}, random.uniform(0, 6));
    judge(body(shapes::moved({prism.points, {}}, {turn, Vec3::Zero()})), {});
    judge(prism, {shaken_lattice(random, 0), Vec3::Zero()});
    judge(prism, {Mat3::Identity(), random.in_ball()});
  }
  EXPECT_EQ(refused, 0) << "of 300";
}

TEST(CheckOfDepth, AcceptsRandomOverlaps) {
  int all = 0, refused = 0;
  for_each_overlap(300, 2, [&](const Problem& p) { ++all, refused += p.refusal(p.answer) != ""; });
  EXPECT_EQ(refused, 0) << "of " << all;
  EXPECT_GE(all, 200);
}

TEST(CheckOfDepth, AcceptsShakenLattices) {
  int refused = 0;
  for_each_coincidence(400, 3, [&](const Problem& p) { refused += p.refusal(p.answer) != ""; });
  EXPECT_EQ(refused, 0) << "of 400";
}

/// The least height itself: the last double that is true passes, and the next one does not.
TEST(CheckOfDepth, KnowsTheDepthToTheLastPlace) {
  int all = 0;
  const auto judge = [&](const Problem& p) {
    Answer s = p.answer;
    ASSERT_EQ(p.refusal(s), "");
    s.upper = std::nextafter(p.truth.bounds.lower, -1e9);
    s.lower = std::min(s.lower, s.upper);
    ASSERT_GT(oracle::compare(p.truth, s.upper), 0);
    EXPECT_NE(p.refusal(s).find("but the depth is"), std::string::npos) << p.truth.distance;
    ++all;
  };
  for_each_overlap(200, 4, judge);
  for_each_coincidence(200, 5, judge);
  EXPECT_GE(all, 330);
}

/// Every claim of an answer, false by 2 to 100 times law 2's bound.
void expect_forgeries_refused(const Problem& p) {
  ASSERT_EQ(p.refusal(p.answer), "");
  const auto refused = [&](const char* what, double factor, auto change) {
    Answer wrong = p.answer;
    change(wrong);
    EXPECT_NE(p.refusal(wrong), "") << what << " " << factor << " of " << p.truth.distance;
  };
  const Vec3 n = p.answer.normal, across = n.unitOrthogonal();
  const double truth = p.truth.distance;
  for (const double factor : {2.0, 3.0, 10.0, 100.0}) {
    const double off = factor * p.bound;
    refused("lower", factor, [&](Answer& s) { s.lower = truth + off, s.upper = std::max(s.upper, s.lower); });
    refused("upper", factor, [&](Answer& s) { s.upper = truth - off, s.lower = std::min(s.lower, s.upper); });
    refused("a long normal", factor, [&](Answer& s) { s.normal *= 1 + off; });
    for (const Vec3& aside : {Vec3(across), Vec3(-across), Vec3(n.cross(across))}) {
      refused("a leaning normal", factor, [&](Answer& s) {
        for (double by = off; oracle::gap(p.a.points, p.b.points, p.pose, s.normal).upper > s.lower - off; by *= 2)
          s.normal = (n + by * aside).normalized();
      });
      refused("point_a", factor, [&](Answer& s) { s.point_a += off * aside; });
      refused("point_b", factor, [&](Answer& s) { s.point_b += off * aside; });
    }
    for (const double sign : {1.0, -1.0}) {
      refused("point_a along the normal", factor, [&](Answer& s) { s.point_a += sign * off * n; });
      refused("point_b along the normal", factor, [&](Answer& s) { s.point_b += sign * off * n; });
      if (truth < 0) {
        refused("both", factor, [&](Answer& s) { s.point_a += sign * off * n, s.point_b += sign * off * n; });
      }
    }
  }
  for (const Verdict verdict : {Verdict::Disjoint, Verdict::Touching, Verdict::Overlapping}) {
    if (verdict == p.answer.verdict) continue;
    refused("verdict", 0, [&](Answer& s) { s.verdict = verdict; });
  }
  if (truth < 0) {
    refused("touching in the middle", 0, [&](Answer& s) {
      s.verdict = Verdict::Touching, s.upper = 0;
      s.point_a = s.point_b = (s.point_a + s.point_b) / 2;
    });
  }
  refused("the other way", 0, [](Answer& s) { s.normal = -s.normal; });
  refused("no normal", 0, [](Answer& s) { s.normal.setZero(); });
  refused("an unknown normal", 0, [](Answer& s) { s.normal.setConstant(kNaN); });
  refused("no interval", 0, [](Answer& s) { std::swap(s.lower, s.upper), s.lower += 1; });
  refused("no number", 0, [](Answer& s) { s.upper = kNaN; });
  refused("no depth at all", 0, [](Answer& s) { s.lower = s.upper = -kInfinity; });
  refused("a level that is not there", 0, [](Answer& s) { s.level_a = 99; });
}

TEST(CheckOfDepth, RefusesForgeries) {
  for_each_overlap(60, 6, expect_forgeries_refused);
  for_each_coincidence(60, 7, expect_forgeries_refused);
  shapes::Random random(8);
  for (int i = 0; i < 20; ++i) {  // apart
    Points p, q;
    for (int k = 0; k < 8; ++k) p.push_back(random.in_ball()), q.push_back(random.in_ball());
    const Polyhedron a = body(p), b = body(q);
    expect_forgeries_refused(Problem(a, b, {random.rotation(), random.on_sphere() * 3}));
  }
}

/// Opposite edges of a body that mirrors itself are parallel; turned by less than 106 bits see, they span slivers.
TEST(CheckOfDepth, SeesAnglesBelowEveryRounding) {
  shapes::Random random(9);
  int refused = 0;
  for (int i = 0; i < 120; ++i) {
    Points points;
    for (int k = 0; k < 4 + i % 4; ++k) points.push_back(random.in_ball()), points.push_back(-points.back());
    const Polyhedron mirrored = body(points);
    Pose pose;
    const double by = std::pow(10.0, -(i % 6 == 0 ? random.uniform(40, 300) : random.uniform(18, 36)));
    for (int k = 0; k < 9; ++k) pose.rotation(k / 3, k % 3) += by * random.uniform(-1, 1);
    const Problem p(mirrored, mirrored, pose);
    refused += p.refusal(p.answer) != "";
  }
  EXPECT_EQ(refused, 0) << "of 120";
}

TEST(CheckOfDepth, TakesOffRadii) {
  int deep = 0, shallow = 0;
  shapes::Random random(10);
  const auto judge = [&](const Problem& p) {
    const Body a(p.a.model, random.uniform(0, 0.5)), b(p.b.model, random.uniform(0, 0.5));
    const double bound = tolerance(a, b, p.pose), sum = a.radius() + b.radius(), ulp = 0x1p-50;
    Answer s = p.answer;
    s.radius_a = a.radius(), s.radius_b = b.radius();
    s.lower -= sum + ulp, s.upper -= sum - ulp;
    s.verdict = s.upper < 0 ? Verdict::Overlapping : Verdict::Disjoint;
    s.point_a += a.radius() * s.normal, s.point_b -= b.radius() * s.normal;
    const auto refusal = [&](const Answer& answer) { return check(a, b, p.pose, answer, Question::Exact).message; };
    ASSERT_EQ(refusal(s), "") << p.truth.distance << " " << sum;
    ASSERT_NE(p.refusal(s), "");
    for (const double factor : {2.0, 10.0, 100.0}) {
      Answer high = s, low = s, off = s;
      high.lower += factor * bound, high.upper = std::max(high.upper, high.lower);
      low.upper -= factor * bound, low.lower = std::min(low.upper, low.lower);
      off.point_b += factor * bound * s.normal.unitOrthogonal();
      for (const Answer& wrong : {high, low, off}) EXPECT_NE(refusal(wrong), "") << factor << " " << p.truth.distance;
    }
    (p.truth.sign < 0 ? deep : shallow)++;
  };
  for_each_overlap(60, 11, judge);
  for (int i = 0; i < 60; ++i) {
    Points p, q;
    for (int k = 0; k < 8; ++k) p.push_back(random.in_ball()), q.push_back(random.in_ball());
    const Polyhedron a = body(p), b = body(q);
    judge({a, b, {random.rotation(), random.on_sphere() * random.uniform(2, 2.5)}});
  }
  EXPECT_GE(std::min(deep, shallow), 30);
}

/// Their points may be those of an overlap, which prove no upper bound above 0.
TEST(CheckOfDepth, AcceptsWideIntervalsAroundZero) {
  const shapes::Pair pair = shapes::pair(shapes::Family::Fat, 200);
  const Polyhedron a = body(pair.a), b = body(pair.b), cube = body(shapes::cube());
  shapes::Random random(12);
  int open = 0, refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const Polyhedron &first = i % 2 ? a : cube, &second = i % 2 ? b : cube;
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(1.7, 2.6)};
    const Answer s = signed_distance(first, second, pose, {.absolute = 1, .budget = {.finest_level = 1}});
    if (!(s.lower < 0 && s.upper > 0)) continue;
    ++open, refused += check(first, second, pose, s).message != "";
  }
  EXPECT_EQ(refused, 0) << "of " << open;
  EXPECT_GE(open, 50);
}

/// 2 s of one core for two bodies of 2 000 triangles, also where all edges of one are nearly parallel to many of the other.
TEST(CheckOfDepth, TakesTwoSecondsForNineMillionEdgePairs) {
  const auto seconds_of = [](const Polyhedron& a, const Polyhedron& b, const Pose& pose) {
    Answer s;
    s.status = Status::Budget;
    s.verdict = Verdict::Overlapping;
    s.is_signed = true;
    s.lower = -kInfinity;
    s.upper = -1e-6;  // proved by the least height alone
    const std::clock_t start = std::clock();
    EXPECT_EQ(check(a, b, pose, s).message, "");
    return double(std::clock() - start) / CLOCKS_PER_SEC;
  };
#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
  const double allowed = 60;
#else
  const double allowed = 2;
#endif
  const Pose tilted{shapes::rotation(Vec3(1, 2, 3).normalized(), 0x1p-48), {0, 0, 0}},
      across{shapes::rotation({1, 0, 0}, std::acos(-1.0) / 2), {0, 0, 0}};
  for (const shapes::Family family : shapes::kFamilies) {
    const shapes::Pair pair = shapes::pair(family, 2000);
    const Polyhedron a = body(pair.a), b = body(pair.b);
    for (const Pose& pose : {Pose{}, Pose{shapes::rotation(Vec3(1, 2, 3).normalized(), 1), {0.01, 0.02, 0.01}}}) {
      EXPECT_LT(seconds_of(a, b, pose), allowed) << shapes::name(family);
      EXPECT_LT(seconds_of(a, a, pose), allowed) << shapes::name(family);
    }
    EXPECT_LT(seconds_of(a, a, tilted), allowed) << shapes::name(family);
  }
  const Polyhedron prism = body(shapes::prism(500, 1, 2));
  for (const Pose& pose : {Pose{}, tilted, across}) EXPECT_LT(seconds_of(prism, prism, pose), allowed);
}

// ---- Overlaps whose depth nobody asked for ---------------------------------------------------------------------------------

/// B moved along the normal of the signed distance until that is `distance`.
Pose at_distance(const Polyhedron& a, const Polyhedron& b, Pose pose, double distance) {
  const Answer s = signed_distance(a, b, pose);
  pose.translation += (distance - s.value()) * s.normal;
  return pose;
}

/// Boxes, slabs and hulls of few and of hundreds of points.
void for_each_pair(const std::function<void(const Polyhedron& a, const Polyhedron& b, const Pose& pose)>& visit) {
  shapes::Random random(13);
  const shapes::Pair fat = shapes::pair(shapes::Family::Fat, 300), plate = shapes::pair(shapes::Family::Plate, 300);
  const std::vector<Polyhedron> solids{body(shapes::cube()), box(2, 2, 0.2), body(fat.a), body(plate.a),
                                       body(shapes::random_polytope(20, 1))};
  for (const Polyhedron& a : solids)
    for (const Polyhedron& b : solids) visit(a, b, {random.rotation(), 0.3 * random.in_ball()});
}

TEST(CheckOfOverlap, NeedsNoProof) {
  int shallow = 0;
  for_each_pair([&](const Polyhedron& a, const Polyhedron& b, const Pose& anyhow) {
    for (const double depth : {kInfinity, 0.1, 1e-3, 1e-6, 1e-9, 1e-13}) {
      const Pose pose = depth < kInfinity ? at_distance(a, b, anyhow, -depth) : anyhow;
      for (const bool exact : {false, true}) {
        OverlapProof proof;
        const Tuning tuning{.proof = &proof};
        const Answer s = exact ? distance(a, b, pose, {.tuning = tuning}) : intersects(a, b, pose, {.tuning = tuning});
        if (depth < 1e-12 && s.verdict != Verdict::Overlapping) continue;
        ASSERT_EQ(s.verdict, Verdict::Overlapping) << depth;
        EXPECT_EQ(check(a, b, pose, s).message, "") << depth;
        EXPECT_EQ(check(a, b, pose, s, &proof).message, "") << depth;
        shallow += depth < 1e-12;
        OverlapProof other = proof;
        other.vertex_a.fill(proof.vertex_a[0]), other.vertex_b.fill(proof.vertex_b[0]);
        EXPECT_NE(check(a, b, pose, s, &other).message, "");
        other = proof;
        other.vertex_b[3] = std::uint32_t(b.points.size());
        EXPECT_NE(check(a, b, pose, s, &other).message, "");
        other = proof;
        other.count = 3;
        EXPECT_NE(check(a, b, pose, s, &other).message, "");
      }
    }
  });
  EXPECT_GE(shallow, 10);
}

TEST(CheckOfOverlap, RefusesOneOfHullsThatAreApart) {
  const auto expect_refused = [](const Polyhedron& a, const Polyhedron& b, const Pose& apart, const Answer& claim,
                                 const OverlapProof& proof) {
    ASSERT_EQ(oracle::distance(a.points, b.points, apart).overlapping, false);
    EXPECT_NE(check(a, b, apart, claim).message, "") << apart.translation;
    EXPECT_NE(check(a, b, apart, claim, &proof).message, "") << apart.translation;
  };
  for_each_pair([&](const Polyhedron& a, const Polyhedron& b, const Pose& pose) {
    OverlapProof proof;
    Answer claim = distance(a, b, pose, {.tuning = {.proof = &proof}});
    ASSERT_EQ(claim.verdict, Verdict::Overlapping);
    for (const double gap : {1., 1e-3, 1e-6, 1e-9, 1e-13}) {
      expect_refused(a, b, at_distance(a, b, pose, gap), claim, proof);
      Answer without_points = claim;
      without_points.point_a.setConstant(kNaN), without_points.point_b.setConstant(kNaN);
      expect_refused(a, b, at_distance(a, b, pose, gap), without_points, proof);
    }
  });
  const Polyhedron cube = body(shapes::cube());
  OverlapProof proof;
  const Pose touching{Mat3::Identity(), {2, 0, 0}}, next_to_it{Mat3::Identity(), {2 + 0x1p-51, 0, 0}};
  const Answer claim = intersects(cube, cube, {Mat3::Identity(), {2 - 0x1p-40, 0, 0}}, {.tuning = {.proof = &proof}});
  EXPECT_EQ(check(cube, cube, touching, claim).message, "") << "closed sets share what they touch in";
  expect_refused(cube, cube, next_to_it, claim, proof);
}

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

TEST(Check, RefusesAnAnswerOfOtherRadii) {
  const Polyhedron cube = body(shapes::cube());
  const Body thin(cube.model, 0.125), thick(cube.model, 0.25);
  for (const double x : {1.5, 2.25, 4.}) {
    const Pose pose{Mat3::Identity(), {x, 0.25, 0}};
    for (const Answer& s : {distance(thin, thick, pose), signed_distance(thin, thick, pose), intersects(thin, thick, pose)}) {
      EXPECT_EQ(check(thin, thick, pose, s).message, "") << x;
      for (const auto& [a, b] : {std::pair{thick, thin}, std::pair{thin, thin}, std::pair{Body(cube.model), thick}})
        EXPECT_EQ(check(a, b, pose, s).message, "the answer is of other radii") << x;
    }
  }
}

/// Spheres, capsules, triangles, boxes and flat ones, sharp and rounded, with each other and with a hull.
TEST(Check, KnowsPrimitives) {
  shapes::Random random(14);
  const Polyhedron hull = body(shapes::random_polytope(30, 2));
  const auto p = [&] { return random.in_ball(); };
  int overlapping = 0, apart = 0;
  for (int i = 0; i < 60; ++i) {
    const double radius = i % 2 ? random.uniform(0, 0.3) : 0;
    const Vec3 corner = p();
    const std::vector<Body> bodies{Body::point(p(), radius),
                                   Body::segment(p(), p(), radius),
                                   Body::triangle(p(), p(), p(), radius),
                                   Body::box(corner, corner + p().cwiseAbs(), radius),
                                   Body::box(corner, corner + Vec3(1, 0, 1), radius),
                                   {hull.model, radius}};
    for (const Body& a : bodies) {
      for (const Body& b : bodies) {
        const Pose pose{random.rotation(), random.in_ball() * 1.5};
        OverlapProof proof;
        const Answer near = distance(a, b, pose, {.tuning = {.proof = &proof}}), deep = signed_distance(a, b, pose);
        for (const Answer& s : {near, deep}) EXPECT_EQ(check(a, b, pose, s, Question::Exact).message, "");
        EXPECT_EQ(check(a, b, pose, intersects(a, b, pose)).message, "");
        EXPECT_EQ(check(a, b, pose, near, Question::Exact, &proof).message, "");
        (near.verdict == Verdict::Overlapping ? overlapping : apart) += 1;
        const double off = 4 * tolerance(a, b, pose);
        for (Answer wrong : {near, deep}) {
          wrong.lower += off, wrong.upper += off;
          EXPECT_NE(check(a, b, pose, wrong).message, "") << near.lower << ' ' << deep.lower;
        }
        Answer wrong = deep;
        wrong.lower -= off, wrong.upper -= off;
        EXPECT_NE(check(a, b, pose, wrong).message, "") << deep.lower;
      }
    }
  }
  EXPECT_GE(std::min(overlapping, apart), 300);
}

/// Every pair of kinds of bodies, sharp and rounded, apart and, signed, deep in each other.
TEST(Check, RefusesAForgeryOfAnyMember) {
  shapes::Random random(15);
  const Polyhedron hull = body(shapes::random_polytope(30, 2));
  int apart = 0, deep = 0;
  for (int i = 0; i < 8; ++i) {
    const double radius = i % 2 ? random.uniform(0.1, 0.3) : 0;
    const auto p = [&] { return random.in_ball(); };
    const Vec3 corner = p();
    const std::vector<Body> bodies{Body::point(p(), radius),
                                   Body::segment(p(), p(), radius),
                                   Body::triangle(p(), p(), p(), radius),
                                   Body::box(corner, corner + Vec3(1, 0, 1), radius),
                                   Body::box(corner, corner + Vec3(1, 0.5, 1), radius),
                                   {hull.model, radius}};
    for (const Body& a : bodies) {
      for (const Body& b : bodies) {
        for (const double away : {4.0, 0.1}) {
          const Pose pose{random.rotation(), random.on_sphere() * away};
          const double off = 8 * tolerance(a, b, pose);
          for (const Answer& s : {distance(a, b, pose), signed_distance(a, b, pose), closest_features(a, b, pose).answer}) {
            ASSERT_EQ(check(a, b, pose, s, Question::Exact).message, "");
            const bool is_deep = s.is_signed && s.upper < -0.01;
            if (!(s.lower > 0.01) && !is_deep) continue;
            (is_deep ? deep : apart) += 1;
            for (const auto& [what, forge] : forgeries::kForgeries) {
              Answer wrong = s;
              forge(wrong, off);
              EXPECT_NE(check(a, b, pose, wrong, Question::Exact).message, "")
                  << what << " of " << int(a.kind()) << ", " << int(b.kind()) << ", " << s.lower << " apart";
            }
          }
        }
      }
    }
  }
  EXPECT_GE(apart, 800);
  EXPECT_GE(deep, 60);
}

TEST(Check, RefusesAVerdictThatItsBoundsDoNotHave) {
  const Model cube = bodies::model(bodies::cube());
  const auto says = [&](const Vec3& t, bool is_signed, Verdict verdict) {
    const Pose pose{Mat3::Identity(), t};
    Answer answer = is_signed ? signed_distance(cube, cube, pose) : distance(cube, cube, pose);
    EXPECT_EQ(check(cube, cube, pose, answer).message, "");
    answer.verdict = verdict;
    return check(cube, cube, pose, answer).message;
  };
  const Vec3 deep(0.5, 0.25, 0.125), apart(3, 0, 0), level(2, 0.25, 0.125);
  EXPECT_NE(says(deep, false, Verdict::Touching), "");
  EXPECT_NE(says(deep, true, Verdict::Touching), "");
  EXPECT_NE(says(deep, true, Verdict::Undecided), "");
  EXPECT_NE(says(apart, false, Verdict::Undecided), "");
  EXPECT_NE(says(apart, true, Verdict::Undecided), "");
  EXPECT_EQ(says(level, false, Verdict::Touching), "");
  EXPECT_EQ(says(level, true, Verdict::Touching), "");
}

/// A question of yes or no ends with whatever points prove enough, and a coarse level with points of its own.
TEST(Check, AcceptsWhateverEndsEarly) {
  shapes::Random random(16);
  const shapes::Pair fat = shapes::pair(shapes::Family::Fat, 300), plate = shapes::pair(shapes::Family::Plate, 300);
  const Polyhedron hull = body(fat.a), other = body(plate.a);
  for (int i = 0; i < 1500; ++i) {
    const auto p = [&] { return random.in_ball(); };
    const double radius = i % 3 == 0 ? std::pow(10, random.uniform(-3, 7)) : i % 3 == 1 ? random.uniform(0, 0.3) : 0;
    const std::vector<Body> bodies{
        {hull.model, radius}, {other.model}, Body::segment(p(), p(), radius), Body::box(-Vec3::Ones(), Vec3::Ones())};
    const Body &a = bodies[random.bits() % 4], &b = bodies[random.bits() % 4];
    Pose pose{random.rotation(),
              random.on_sphere() * (random.uniform(0, 4) + (a.radius() + b.radius()) * random.uniform(0.99, 1.01))};
    if (i % 2) pose.rotation = pose.rotation.cast<float>().cast<double>();
    const double threshold = std::pow(10, random.uniform(-6, 0));
    PairSeed seed;
    distance(a, b, {pose.rotation, 1.01 * pose.translation}, seed);
    const Budget budget{.steps = std::uint32_t(random.bits() % 20), .finest_level = int(random.bits() % 3)};
    const Answer answers[] = {intersects(a, b, pose, seed),
                              within(a, b, pose, threshold, seed).answer,
                              signed_within(a, b, pose, threshold, seed).answer,
                              signed_within(a, b, pose, -threshold, seed).answer,
                              distance(a, b, pose, seed, {.beyond = threshold}),
                              distance(a, b, pose, seed, {.relative = 0.3}),
                              distance(a, b, pose, seed, {.budget = budget}),
                              signed_distance(a, b, pose, seed, {.absolute = threshold}),
                              signed_distance(a, b, pose, seed, {.budget = budget})};
    for (const Answer& s : answers) {
      ASSERT_EQ(check(a, b, pose, s).message, "") << i;
      ASSERT_EQ(check(a, b, pose, refine(a, b, pose, s, seed)).message, "") << i;
    }
  }
}

/// Of a model without its finest levels, balls around the bodies bound the distance, and radii tell of an overlap by levels
/// that overlap less deep than they deviate, whose points are none of bodies so near.
TEST(Check, AcceptsWhatIsToldWithoutLevelZero) {
  shapes::Random random(17);
  std::vector<Model> cut;
  for (const shapes::Family family : shapes::kFamilies) {
    const Model whole = body(shapes::pair(family, 600).a).model;
    ASSERT_EQ(cut.emplace_back(whole.cut({1.01 * whole.level(1).deviation})).finest_level(), 1);
  }
  int overlaps = 0;
  for (int i = 0; i < 4000; ++i) {
    const double radius = random.uniform(0, i % 2 ? 0.3 : 2), threshold = std::pow(10, random.uniform(-6, 0));
    const std::vector<Body> bodies{{cut[random.bits() % cut.size()], radius},
                                   Body::segment(random.in_ball(), random.in_ball(), 0.1 * radius),
                                   Body::box(-Vec3::Ones(), Vec3::Ones())};
    const Body &a = bodies[random.bits() % 3], &b = bodies[0];
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0, 4 + radius)};
    const Budget budget{.steps = std::uint32_t(random.bits() % 20)};
    for (const Answer& s : {closest_features(a, b, pose, {.beyond = threshold}).answer, within(a, b, pose, threshold).answer,
                            signed_distance(a, b, pose), signed_distance(a, b, pose, {.absolute = threshold}),
                            signed_distance(a, b, pose, {.budget = budget})}) {
      ASSERT_EQ(check(a, b, pose, s).message, "") << i;
      overlaps += s.is_signed && s.verdict == Verdict::Overlapping;
      if (!std::isfinite(s.lower) || !std::isfinite(s.upper)) continue;
      Answer high = s, low = s;
      high.lower = high.upper = s.upper + 4, low.lower = low.upper = s.lower - 4;
      for (const Answer& wrong : {high, low}) EXPECT_NE(check(a, b, pose, wrong).message, "") << i;
    }
  }
  EXPECT_GE(overlaps, 1000);
}

/// A rotation that is not quite orthonormal stretches the ball around B too.
TEST(Check, TakesTheBallOfACutModelAsTheRotationStretchesIt) {
  const bodies::Polyhedron octahedron = bodies::octahedron(), box = bodies::box(1.5, 1.5, 1.5);
  const LevelArrays levels[] = {octahedron.level(), box.level()};
  const Model whole = Model::from_levels(levels).value(), cut = whole.cut({1.01 * whole.level(1).deviation});
  ASSERT_EQ(cut.finest_level(), 1);
  const Body origin = Body::point({0, 0, 0});
  const Pose stretched{(1 + 0x1p-21) * Mat3::Identity(), {3, 0, 0}};
  Answer s = distance(origin, cut, stretched);
  EXPECT_EQ(check(origin, cut, stretched, s).message, "");
  s.lower = 2, s.normal = {1, 0, 0};
  EXPECT_NE(check(origin, cut, stretched, s).message, "") << "the distance is 2 - 2^-21";
}

/// Where the supports of maps prove bounds as narrow as an exact answer's, the points may lie on edges, along which the last
/// direction sampled leans: answers named a corner of each edge, and that direction.
TEST(Check, AcceptsYesOrNoWhereMapsTellTheDistance) {
  const Polyhedron needle = body(shapes::pair(shapes::Family::Long, 300).a), square = body(shapes::polygon(4));
  const Pose pose{Mat3::Identity(), {-1, -1, 0}};
  const Answer exact = distance(needle, square, pose);
  ASSERT_EQ(exact.feature_a.kind(), FeatureKind::Edge);
  const double nearer = 0.99 * exact.lower;
  for (const Answer& s :
       {intersects(needle, square, pose), within(needle, square, pose, nearer).answer,
        distance(needle, square, pose, {.beyond = nearer}), distance(needle, square, pose, {.relative = 0.5})}) {
    EXPECT_EQ(check(needle, square, pose, s).message, "");
    if (s.upper - s.lower > tolerance(needle, square, pose)) continue;
    EXPECT_EQ(s.feature_a.kind(), FeatureKind::Edge);
    EXPECT_EQ(s.feature_b.kind(), exact.feature_b.kind());
  }
}

// ---- Which question was asked ----------------------------------------------------------------------------------------------

/// Crossing edges one apart: points aside along an edge by 1e-8 are farther apart by less than a double tells.
TEST(Check, ExactAnswersHaveTheNearestPoints) {
  const Body a = Body::segment({-1, 0, 0}, {1, 0, 0}), b = Body::segment({0, -1, 1}, {0, 1, 1});
  for (const bool is_signed : {false, true}) {
    Answer s = is_signed ? signed_distance(a, b, {}) : distance(a, b, {});
    EXPECT_EQ(check(a, b, {}, s, Question::Exact).message, "");
    s.point_b[1] += 1e-8;
    EXPECT_EQ(check(a, b, {}, s).message, "") << "a threshold may end with them";
    EXPECT_NE(check(a, b, {}, s, Question::Exact).message, "");
    s.point_b[1] += 1e-5;
    EXPECT_NE(check(a, b, {}, s).message, "");
  }
}

TEST(Check, ExactAnswersOfVerticesHaveTheNormalBetweenThem) {
  const Body a = Body::point({0, 0, 0}), b = Body::point({0, 0, 1});
  Answer s = distance(a, b, {});
  EXPECT_EQ(check(a, b, {}, s, Question::Exact).message, "");
  s.normal[0] = 1e-9;
  EXPECT_EQ(check(a, b, {}, s).message, "");
  EXPECT_NE(check(a, b, {}, s, Question::Exact).message, "");
}

TEST(Check, ExactAnswersAreNarrow) {
  const Model cube = bodies::model(bodies::cube());
  for (const Vec3& t : {Vec3(3, 0, 0), Vec3(0.5, 0.25, 0.125)}) {
    const Pose pose{Mat3::Identity(), t};
    Answer s = signed_distance(cube, cube, pose);
    EXPECT_EQ(check(cube, cube, pose, s, Question::Exact).message, "");
    s.lower -= 0.25;
    EXPECT_EQ(check(cube, cube, pose, s).message, "");
    EXPECT_NE(check(cube, cube, pose, s, Question::Exact).message, "");
    s.status = Status::Budget;
    EXPECT_EQ(check(cube, cube, pose, s, Question::Exact).message, "");
  }
}

/// Coarse levels hold points that are on no body: an exact answer was taken whose points these alone hold.
TEST(Check, ExactAnswersHavePointsOfBodies) {
  const Model ball = build(shapes::random_polytope(300, 5)).value().model;
  const int coarse = ball.level_count() - 1;
  ASSERT_GT(ball.level(coarse).deviation, 1e-3);
  for (const double away : {3.0, 1.5}) {
    const Pose pose{Mat3::Identity(), {away, 0.2, 0.1}};
    for (const Answer& s : {distance(ball, ball, pose), signed_distance(ball, ball, pose)}) {
      if (!s.is_signed && !(s.lower > 0)) continue;
      EXPECT_EQ(check(ball, ball, pose, s, Question::Exact).message, "");
      for (const Vec3& way : {s.normal, Vec3(-s.normal), s.normal.unitOrthogonal()}) {
        Answer wrong = s;
        wrong.level_a = wrong.level_b = std::int16_t(coarse);
        wrong.feature_a = wrong.feature_b = {};
        wrong.point_a += 1e-3 * way;
        EXPECT_NE(check(ball, ball, pose, wrong, Question::Exact).message, "") << away;
      }
    }
  }
}

TEST(Check, ExactAnswersAreDecided) {
  const Model cube = bodies::model(bodies::cube());
  const Pose pose{Mat3::Identity(), {0.5, 0.25, 0.125}};
  Answer s = distance(cube, cube, pose);
  ASSERT_EQ(s.verdict, Verdict::Overlapping);
  EXPECT_EQ(check(cube, cube, pose, s, Question::Exact).message, "");
  s.verdict = Verdict::Undecided;
  EXPECT_NE(check(cube, cube, pose, s, Question::Exact).message, "");
}

/// A threshold of depth may end with bounds as near as those of the exact depth before the deepest points are known. They were
/// refused as 6e-10 off the normal.
TEST(Check, AcceptsThresholdsThatEndBesideTheDepth) {
  const Body box = Body::box({0, -2, 0}, {2, 2, 2}), edge = Body::segment({2, 0, -1}, {2, 0, 1});
  Pose pose{Mat3::Identity(), {-1, 1, 2}};
  pose.rotation(1, 0) = 0x1.7728e51ff60bfp-29, pose.rotation(0, 1) = -pose.rotation(1, 0);
  pose.rotation(0, 2) = 0x1.a0e39a7162b7ap-31, pose.rotation(2, 0) = -pose.rotation(0, 2);
  pose.rotation(1, 2) = 0x1.e70483fe586bp-31, pose.rotation(2, 1) = -pose.rotation(1, 2);
  const Answer s = signed_within(box, edge, pose, -1.25).answer;
  ASSERT_LE(s.upper - s.lower, tolerance(box, edge, pose));
  EXPECT_EQ(check(box, edge, pose, s).message, "");
}

// ---- Answers of infinite bounds, and of enumerators that are none ----------------------------------------------------------

TEST(Check, RefusesPointsOutsideOfTheBodiesWhateverTheBounds) {
  const Model cube = bodies::model(bodies::cube());
  const Vec3 outside(1e6, 0, 0);
  for (const Vec3& t : {Vec3(3, 0.25, 0.125), Vec3(0.5, 0.25, 0.125)}) {
    const Pose pose{Mat3::Identity(), t};
    for (Answer s : {distance(cube, cube, pose), signed_distance(cube, cube, pose)}) {
      s.upper = kInfinity;
      if (!(s.lower > 0)) s.verdict = Verdict::Undecided;
      EXPECT_EQ(check(cube, cube, pose, s).message, "");
      Answer of_a = s, of_b = s, unknown = s;
      of_a.point_a = outside, of_b.point_b = -outside;
      for (const Answer& wrong : {of_a, of_b}) EXPECT_NE(check(cube, cube, pose, wrong).message, "") << t[0];
      unknown.point_a.setConstant(kNaN), unknown.point_b.setConstant(kNaN);
      EXPECT_EQ(check(cube, cube, pose, unknown).message, "");
    }
  }
}

TEST(Check, RefusesWhatIsNoStatusOrNoVerdict) {
  const Model cube = bodies::model(bodies::cube());
  Pose illegal;
  illegal.rotation *= 2;
  for (const Pose& pose : {Pose{Mat3::Identity(), {3, 0, 0}}, Pose{Mat3::Identity(), {0.5, 0.25, 0.125}}, illegal}) {
    for (const Answer& s : {distance(cube, cube, pose), signed_distance(cube, cube, pose)}) {
      EXPECT_EQ(check(cube, cube, pose, s).message, "");
      Answer no_status = s, no_verdict = s;
      no_status.status = Status(int(Status::InvalidBody) + 1), no_verdict.verdict = Verdict(int(Verdict::Overlapping) + 1);
      EXPECT_EQ(check(cube, cube, pose, no_status).message, "9 is no status");
      EXPECT_EQ(check(cube, cube, pose, no_verdict).message, "4 is no verdict");
    }
  }
}

}  // namespace
}  // namespace swiftlet
