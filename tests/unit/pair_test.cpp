// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The files of march/pair and march/query that answer apart, one by one, on cubes whose answers can be read off the drawing.
//
//          z
//          |  3-----2      A: [-1, 1]^3, corners numbered as bodies::box does (drawn: its top 4 5 6 7, its bottom 0 1 2 3).
//        7-|--6   B |      B: the same cube at a pose.
//        | +- | - - | x
//        4----5-----1
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "bodies.h"
#include "body/half_edge.h"
#include "pair/gjk.h"
#include "pair/intersection.h"
#include "pair/pair_view.h"
#include "pair/pair_view4.h"
#include "pair/prism.h"
#include "pair/simplex.h"
#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "pair/walk.h"
#include "pair/witness.h"
#include "query/model_pair.h"
#include "query/separating_axis.h"
#include "query/spheres.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Model kCube = bodies::model(bodies::cube());
const Level& kLevel = kCube.level(0);

/// Two cubes, B's centre at `t`; kept together, as views only refer.
struct Cubes {
  explicit Cubes(const Vec3& t) : b_in_a(motion({Mat3::Identity(), t})), pair(pair_view(kLevel.view, kLevel.view, b_in_a, 0)) {}
  Motion b_in_a;
  PairView pair;
};

/// A corner by its number in the drawing: a model numbers its own.
std::uint32_t index(std::uint32_t corner) {
  const std::span<const std::uint32_t> corners = kCube.source().vertex;
  return std::uint32_t(std::find(corners.begin(), corners.end(), corner) - corners.begin());
}
FeatureId vertex(std::uint32_t corner) { return {FeatureKind::Vertex, index(corner)}; }
/// From one corner to another.
FeatureId edge(std::uint32_t tail, std::uint32_t head) {
  const ConvexView& view = kLevel.view;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    if (origin(view, h) == index(tail) && view.half_edges[h].head == index(head)) return {FeatureKind::Edge, h};
  }
  throw std::logic_error("no such edge");
}
/// The face that looks along +-x, y or z.
FeatureId face(int axis, double side) {
  const ConvexView& view = kLevel.view;
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    const FacePlane& n = view.planes[f];
    const double along[] = {n.x, n.y, n.z};
    if (along[axis] * side > 0) return {FeatureKind::Face, f};
  }
  throw std::logic_error("no such face");
}

// ---- Walk -----------------------------------------------------------------------------------------------------------------

TEST(UnitWalk, GoesRoundTheCubeToTheNearestFeatures) {
  const Cubes at({3, 3, 3});  // corner 6 of A, corner 0 of B, sqrt(3) apart
  for (std::uint32_t a = 0; a < 8; ++a) {
    for (std::uint32_t b = 0; b < 8; ++b) {
      const Walk w = walk(at.pair, vertex(a), vertex(b), PlaneRule::MostViolated, ~0u);
      EXPECT_EQ(w.end, WalkEnd::Minimum);
      EXPECT_EQ(w.a, vertex(6));
      EXPECT_EQ(w.b, vertex(0));
      EXPECT_NEAR(norm(w.nearest.point_b - w.nearest.point_a), std::sqrt(3), 1e-15);
    }
  }
}

TEST(UnitWalk, EndsOnAnEdgeAndAVertex) {
  const Motion m = motion({Mat3::Identity(), {3, 0.25, 3}});  // a point off A's edge from 5 to 6
  const Model dot = bodies::model(bodies::point({0, 0, 0}));
  const PairView pair = pair_view(kLevel.view, dot.level(0).view, m, 0);
  const Walk w = walk(pair, vertex(0), {FeatureKind::Vertex, 0}, PlaneRule::MostViolated, ~0u);
  EXPECT_EQ(w.end, WalkEnd::Minimum);
  EXPECT_TRUE(w.a == edge(5, 6) || w.a == edge(6, 5));
  EXPECT_NEAR(norm(w.nearest.point_b - w.nearest.point_a), std::sqrt(8), 1e-15);
}

TEST(UnitWalk, SaysWhereItGotInside) {
  const Cubes at({0.5, 0.25, 0});
  EXPECT_EQ(walk(at.pair, vertex(6), vertex(0), PlaneRule::MostViolated, ~0u).end, WalkEnd::Inside);
}

TEST(UnitWalk, EndsAtItsBudget) {
  const Walk w = walk(Cubes({3, 3, 3}).pair, vertex(0), vertex(6), PlaneRule::MostViolated, 1);
  EXPECT_EQ(w.end, WalkEnd::Budget);
  EXPECT_EQ(w.steps, 1u);
}

// ---- Certificates ---------------------------------------------------------------------------------------------------------

/// Of the nearest features both bounds are the distance; of others they hold it, and the upper one is no more than the farthest
/// vertices are apart.
TEST(UnitCertify, BoundsHoldTheDistanceWhateverTheFeatures) {
  const Cubes at({3, 0.5, 0.25});  // faces 1 apart
  std::uint32_t tests = 0;
  const auto certified = [&](FeatureId a, FeatureId b) { return certify(at.pair, witness(at.pair, a, b), tests); };
  const Certificate right = certified(face(0, 1), vertex(0));
  EXPECT_NEAR(right.lower, 1, 1e-14);
  EXPECT_GE(right.upper, 1);
  EXPECT_NEAR(right.upper, 1, 1e-14);
  for (std::uint32_t a = 0; a < 8; ++a) {
    for (std::uint32_t b = 0; b < 8; ++b) {
      const Certificate any = certified(vertex(a), vertex(b));
      EXPECT_LE(any.lower, 1);
      EXPECT_GE(any.upper, 1);
      EXPECT_LE(any.upper, std::sqrt(5 * 5 + 2.5 * 2.5 + 2.25 * 2.25) + 1e-14);
    }
  }
}

// ---- GJK ------------------------------------------------------------------------------------------------------------------

GjkResult gjk_from(const PairView& pair, FeatureId a, FeatureId b) {
  std::uint32_t tests = 0;
  const Certificate start = certify(pair, witness(pair, a, b), tests);
  return gjk(pair, start, {pair.law_two, 0, std::numeric_limits<double>::infinity()}, tests);
}

TEST(UnitStopRule, IsMetByNarrowBoundsOrPastAThreshold) {
  const StopRule loose{.absolute = 0.5, .relative = 0.25};
  EXPECT_TRUE(loose.narrow(1, 1.5));
  EXPECT_FALSE(loose.narrow(1, 1.75));
  EXPECT_TRUE(loose.narrow(4, 5));
  EXPECT_FALSE(loose.is_exact());

  const StopRule exact;
  EXPECT_TRUE(exact.is_exact());
  EXPECT_FALSE(exact.met(1, 1)) << "no width is allowed";
  EXPECT_TRUE(exact.at_least(0.125).met(1, 1.125));
  EXPECT_FALSE(exact.met(-kInfinity, kInfinity));

  const StopRule side{.above = 2, .below = 2};
  EXPECT_TRUE(side.is_threshold());
  EXPECT_TRUE(side.met(2.25, kInfinity));
  EXPECT_TRUE(side.met(-kInfinity, 1.75));
  EXPECT_FALSE(side.met(1.75, 2.25));
  EXPECT_FALSE(side.beyond_by(0.5).met(2.25, 3));
  EXPECT_TRUE(side.beyond_by(0.5).met(2.75, 3));

  // Rounded bodies that touch at 1: a quarter of what is above that, less the rounding of their bounds.
  const StopRule rounded{.relative = 0.25, .zero = 1, .rounding = 0.125};
  EXPECT_TRUE(rounded.narrow(2, 2.125));
  EXPECT_FALSE(rounded.narrow(2, 2.25));
}

TEST(UnitGjk, NarrowsTheWorstStart) {
  const Cubes at({3, 0.5, 0.25});
  const GjkResult r = gjk_from(at.pair, vertex(0), vertex(6));
  EXPECT_EQ(r.status, MarchStatus::Disjoint);
  EXPECT_NEAR(r.certificate.lower, 1, 1e-14);
  EXPECT_NEAR(r.certificate.upper, 1, 1e-14);
  EXPECT_NEAR(r.certificate.normal.x, 1, 1e-14);
}

TEST(UnitGjk, TellsTouchingFromOverlapping) {
  EXPECT_EQ(gjk_from(Cubes({2, 0.5, 0.25}).pair, vertex(6), vertex(0)).status, MarchStatus::Touching);
  const GjkResult r = gjk_from(Cubes({1.5, 0.5, 0.25}).pair, vertex(6), vertex(0));
  ASSERT_EQ(r.status, MarchStatus::Overlapping);
  EXPECT_GT(r.proof.count, 0);
}

/// Corner by corner of a tetrahedron around the origin: nearest are a corner, a side's middle, a face's middle, the origin.
TEST(UnitSimplex, FindsTheNearestPointOfASegmentATriangleAndATetrahedron) {
  const Vec corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const double distances[] = {std::sqrt(3), 1, std::sqrt(1.0 / 3), 0};
  Simplex simplex;
  for (std::uint32_t k = 0; k < 4; ++k) {
    add(simplex, {corners[k], k, k});
    EXPECT_EQ(simplex.count, int(k + 1));
    if (k < 3) {
      EXPECT_NEAR(norm(simplex.nearest), distances[k], 1e-15);
    }
    EXPECT_TRUE(simplex.has(k, k));
  }
}

/// A corner that the nearest point does not need goes: of a triangle whose third corner is far the side stays.
TEST(UnitSimplex, ForgetsWhatDoesNotHoldTheNearestPoint) {
  Simplex simplex;
  add(simplex, {{5, 5, 0}, 0, 0});
  add(simplex, {{1, 1, 0}, 1, 1});
  EXPECT_FALSE(simplex.has(0, 0));
  add(simplex, {{1, -1, 0}, 2, 2});
  EXPECT_EQ(simplex.count, 2);
  EXPECT_EQ(simplex.nearest.x, 1);
  EXPECT_EQ(simplex.nearest.y, 0);
}

/// GJK with bodies of random points, to its end: what is nearest after each corner is what the other solver finds among that
/// corner and those before.
TEST(UnitSimplex, AgreesWithTheSolverOfAllSubsets) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int of_count[5] = {0, 0, 0, 0, 0};
  for (int body = 0; body < 500; ++body) {
    std::vector<Vec> points;
    const Vec centre = Vec{normal(random), normal(random), normal(random)} * double(body % 3);
    for (int i = 0; i < 12; ++i) points.push_back(centre + Vec{normal(random), normal(random), normal(random)});
    Simplex simplex;
    simplex.nearest = {1, 0, 0};
    for (int steps = 0; steps < 20 && simplex.count < 4; ++steps) {
      std::uint32_t lowest = 0;
      for (std::uint32_t i = 1; i < points.size(); ++i)
        if (dot(points[i], simplex.nearest) < dot(points[lowest], simplex.nearest)) lowest = i;
      if (simplex.has(lowest, lowest)) break;
      std::array<Difference<double>, 4> set;
      for (int k = 0; k < simplex.count; ++k) set[std::size_t(k)].p = simplex.corner[std::size_t(k)].p;
      set[std::size_t(simplex.count)].p = points[lowest];
      const NearestOrigin<double> expected = nearest_to_origin(set, simplex.count + 1);
      add(simplex, {points[lowest], lowest, lowest});
      ++of_count[simplex.count];
      ASSERT_EQ(simplex.count, expected.count) << body;
      if (simplex.count == 4) break;
      ASSERT_NEAR(norm(simplex.nearest - expected.point), 0, 1e-12) << body;
      Vec sum{0, 0, 0};
      for (std::size_t k = 0; k < std::size_t(simplex.count); ++k) sum = sum + simplex.corner[k].p * simplex.weight[k];
      ASSERT_NEAR(norm(simplex.nearest - sum), 0, 1e-12) << body;
    }
  }
  for (int count = 1; count <= 4; ++count) EXPECT_GT(of_count[count], 100) << count;
}

/// A prism over a polygon of uneven sides: on its top face a point is where all of its sides say it is.
TEST(UnitPrism, PlacesAPointOnARimAsAllSidesDo) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform;
  int outside = 0, well_inside = 0, nearly_outside = 0;
  for (const std::uint32_t n : {16u, 17u, 40u, 200u}) {
    std::vector<double> angles(n);
    for (std::uint32_t i = 0; i < n; ++i) angles[i] = 2 * std::numbers::pi * (i + 0.9 * uniform(random)) / n;
    bodies::Polyhedron body;
    for (const double z : {-1., 1.})
      for (const double angle : angles) body.points.emplace_back(std::cos(angle), 0.7 * std::sin(angle), z);
    for (std::uint32_t i = 0; i < n; ++i) body.add({i, (i + 1) % n, n + (i + 1) % n, n + i});
    for (std::uint32_t i = 0; i < n; ++i) body.corners.push_back(n - 1 - i);
    for (std::uint32_t i = 0; i < n; ++i) body.corners.push_back(n + i);
    body.sizes.push_back(n), body.sizes.push_back(n);
    const Model model = bodies::model(body);
    const ConvexView& view = model.level(0).view;
    ASSERT_EQ(view.rims, 2u);
    const std::uint32_t top = view.planes[0].z > 0 ? 0 : 1;
    std::vector<Vec> loop;
    for (const std::uint32_t v : FaceLoop(view, top)) loop.push_back(vec(view.vertices[v]));
    const Motion still = motion({Mat3::Identity(), Vec3::Zero()});
    const PairView pair = pair_view(view, view, still, 0);
    const Resting4 resting(pair);
    const Polygon polygon = Prism<Resting4>(resting, top).polygon(true);
    for (int i = 0; i < 4000; ++i) {
      // On a ray from a corner or the centre, near its other end every other time.
      const double angle = 2 * std::numbers::pi * uniform(random),
                   far = i % 2 ? 1 + 0.02 * (uniform(random) - 0.5) : uniform(random);
      const Vec from = i % 3 == 0 ? loop[i / 3 % n] : Vec{0, 0, 1}, to{std::cos(angle), 0.7 * std::sin(angle), 1};
      const Vec p = Vec{from.x, from.y, 1 + uniform(random)} + Vec{to.x - from.x, to.y - from.y, 0} * far;
      double nearest = kInfinity;  // how far it is inside the side that it is nearest to
      for (std::uint32_t k = 0; k < n; ++k) {
        const Vec tail = loop[k], way = loop[(k + 1) % n] - tail;
        nearest = std::min(nearest, (way.x * (p.y - tail.y) - way.y * (p.x - tail.x)) / std::hypot(way.x, way.y));
      }
      constexpr double kMargin = 0.003;
      if (std::fabs(nearest) < 1e-12 || std::fabs(nearest - kMargin) < 1e-12) continue;
      const Polygon::OnRim at = polygon.on_rim(p, kMargin);
      ASSERT_EQ(at.inside, nearest > 0) << n << " sides, " << i;
      ASSERT_EQ(at.well_inside, nearest > kMargin) << n << " sides, " << i;
      const Vec tail = vec(view.vertices[origin(view, at.side)]),
                way = vec(view.vertices[view.half_edges[at.side].head]) - tail;
      ASSERT_EQ(way.x * (p.y - tail.y) - way.y * (p.x - tail.x) > 0, at.inside) << n << " sides, " << i;
      EXPECT_LT(int(polygon.on_rim(p, 1e-14).tests), 7 + std::bit_width(n)) << n << " sides, " << i;
      outside += nearest < 0;
      well_inside += nearest > kMargin;
      nearly_outside += nearest > 0 && nearest < kMargin;
    }
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(well_inside, 1000);
  EXPECT_GT(nearly_outside, 500);
}

/// One look-up along the line of centres: the supports are corners of the facing sides. The cells beside an axis hold
/// directions on both sides of y = 0, along which other corners are up to 1/8 higher.
TEST(UnitSupportGjk, SamplesAnAxis) {
  ASSERT_GT(kLevel.map_side, 0u);
  const Cubes at({3, 0, 0});
  const AxisSample s = sample_axis(at.pair, kLevel, kLevel, {2, 0, 0});
  EXPECT_EQ(s.normal.x, 1);
  EXPECT_EQ(s.gap, 1);
  EXPECT_LE(s.lower, 1);
  EXPECT_GT(s.lower, 0.749);
}

/// Between a fine plate and a fine needle, supports along the line of centres are mostly not near each other. What follows them
/// comes near, and is a bound on the distance still.
TEST(UnitSupportGjk, FollowsEllipsoidsUntilSupportsAreNear) {
  const Model plate = bodies::model(bodies::moved(bodies::ball(4), Mat3(Vec3(4, 4, 0.5).asDiagonal()))),
              needle = bodies::model(bodies::moved(bodies::ball(4), Mat3(Vec3(4, 0.5, 0.5).asDiagonal())));
  const Level &a = plate.level(0), &b = needle.level(0);
  int far = 0, came_near = 0;
  for (int k = 0; k < 100; ++k) {
    const Mat3 turn = bodies::rotation(1 + k % 3, k % 5 - 2, k % 7 - 3, k % 11 - 5);
    const Pose pose{turn, Vec3(k % 13 - 6, k % 17 - 8, k % 19 - 9).normalized() * 10};
    const Motion m = motion(pose);
    const PairView pair = pair_view(a.view, b.view, m, 0);
    const Moved4 other(pair);
    const AxisSample seen = sample_axis(pair, other, a, b, vec4(vec(pose.translation)));
    if (are_near(seen, a, b, 0)) continue;
    ++far;
    const AxisSample best = best_sample(pair, other, a, b, 0, seen);
    came_near += are_near(best, a, b, 0);
    EXPECT_LE(best.lower, distance(plate, needle, pose).upper);
  }
  EXPECT_GE(far, 90);
  EXPECT_GE(came_near, 0.95 * far);
}

/// Of the octahedron |x| + |y| + |z| <= 1 the face below a point beside a corner is that of the point's octant, and the point
/// is |y| + |z| farther above it than above the corner.
TEST(UnitSupportGjk, FindsTheFaceBelowAPoint) {
  const Model octahedron = bodies::model(bodies::octahedron());
  const ConvexView& view = octahedron.level(0).view;
  const auto at = [&](double x, double y, double z) {
    for (std::uint32_t v = 0; v < view.vertices.size(); ++v)
      if (norm(vec(view.vertices[v]) - Vec{x, y, z}) == 0) return v;
    throw std::logic_error("no such corner");
  };
  const auto corners_of = [&](std::uint32_t f) {
    Vec sum{0, 0, 0};
    for (const std::uint32_t v : FaceLoop(view, f)) sum = sum + vec(view.vertices[v]);
    return sum;
  };
  for (const double x : {-1.0, 1.0}) {
    for (const Vec& aside : {Vec{0, 0.25, 0.5}, Vec{0, -0.5, 0.25}, Vec{0, 0.125, -0.25}, Vec{0, -0.25, -0.125}}) {
      const FaceBelow below = face_below(view, at(x, 0, 0), vec4(x * 0.375, aside.y, aside.z), vec4(x, 0, 0));
      ASSERT_NE(below.face, kNone);
      const Vec corners = corners_of(below.face);
      EXPECT_EQ(corners.x, x);
      EXPECT_EQ(corners.y, std::copysign(1, aside.y));
      EXPECT_EQ(corners.z, std::copysign(1, aside.z));
      EXPECT_EQ(below.gap, 0.375 + norm_1(aside));
    }
  }
  const Model tetrahedron = bodies::model(bodies::tetrahedron());  // rings of three
  EXPECT_EQ(face_below(tetrahedron.level(0).view, 0, vec4(1, 2, 3), vec4(1, 1, 1)).face, kNone);
}

/// Between corners aside of each other a walk begins at a corner and the face below it that is nearer, far from each other at
/// both corners.
TEST(UnitSupportGjk, BeginsAtTheFaceBelowACornerAside) {
  const Model octahedron = bodies::model(bodies::octahedron()),
              flat = bodies::model(bodies::moved(bodies::octahedron(), Mat3(Vec3(1, 4, 4).asDiagonal())));
  const auto begin = [](const Model& a, const Model& b, const Vec3& t) {
    const Motion m = motion({Mat3::Identity(), t});
    const PairView pair = pair_view(a.level(0).view, b.level(0).view, m, 0);
    return start_from(pair, Moved4(pair), sample_axis(pair, a.level(0), b.level(0), {1, 0, 0}));
  };
  const MarchStart far = begin(octahedron, octahedron, {4, 0.25, 0.125});
  EXPECT_EQ(far.a.kind(), FeatureKind::Vertex);
  EXPECT_EQ(far.b.kind(), FeatureKind::Vertex);
  // What is flatter has the face that is nearer: |y| + |z| over 4.
  const MarchStart near_b = begin(octahedron, flat, {2.0625, 0.25, 0.125}),
                   near_a = begin(flat, octahedron, {2.0625, 0.25, 0.125});
  EXPECT_EQ(near_b.a.kind(), FeatureKind::Vertex);
  EXPECT_EQ(near_b.b.kind(), FeatureKind::Face);
  EXPECT_EQ(near_a.a.kind(), FeatureKind::Face);
  EXPECT_EQ(near_a.b.kind(), FeatureKind::Vertex);
}

// ---- Separating axis ------------------------------------------------------------------------------------------------------

/// Two cubes, the second moved by x, as a query has them.
struct CubesAlongX {
  explicit CubesAlongX(double x) : m(motion({Mat3::Identity(), {x, 0, 0}})) {}
  const Motion m;
  const Shape shape{kCube};
  const Budget budget{};
  const Tuning tuning{};
  const Limits limits{budget, tuning};
  const ModelPair pair{shape, shape, m, 0, limits};
};

TEST(UnitSeparatingAxis, AnswersAtOneSampleOrNotAtAll) {
  const auto asked = [](double x, Answer& answer) {
    const CubesAlongX at(x);
    PairSeed seed;
    AxisSample seen;
    Line line = at.pair.line();
    return separating_axis(at.pair, line, {0, 0, 0, 0}, SinceStored(seed, line.in_a).serves(), seed, seen, answer);
  };
  Answer apart, together;
  EXPECT_TRUE(asked(3, apart));
  EXPECT_EQ(apart.verdict, Verdict::Disjoint);
  EXPECT_LE(apart.lower, 1);
  EXPECT_GE(apart.upper, 1);
  EXPECT_FALSE(asked(1.5, together));
}

// ---- Spheres --------------------------------------------------------------------------------------------------------------

/// Cubes of side 2: the balls around them are apart from 2 sqrt(3) on, those inside them meet below 2. Between, none tells.
TEST(UnitSpheres, TellWhatIsFarApartAndWhatIsDeep) {
  const auto asked = [](double x, double threshold, Answer& answer) {
    const CubesAlongX at(x);
    const Vec between = at.pair.line().in_a;
    return spheres_are_apart(at.pair, between, {0, 0, threshold, threshold}, answer) ? 1
           : spheres_meet(at.pair, between, answer)                                  ? -1
                                                                                     : 0;
  };
  Answer apart, deep, other;
  EXPECT_EQ(asked(3.5, 0, apart), 1);
  EXPECT_EQ(apart.verdict, Verdict::Disjoint);
  EXPECT_GT(apart.lower, 3.5 - 2 * std::sqrt(3.0) - 1e-12);
  EXPECT_LE(apart.lower, 3.5 - 2 * std::sqrt(3.0));
  EXPECT_GE(apart.upper, 1.5) << "the distance of the cubes";
  EXPECT_EQ(asked(1.99, 0, deep), -1);
  EXPECT_EQ(deep.verdict, Verdict::Overlapping);
  EXPECT_NEAR(deep.point_a.x() - kLevel.view.centre.x(), 0.995, 1e-12);
  EXPECT_EQ(asked(3.4, 0, other), 0);
  EXPECT_EQ(asked(3.5, 0.1, other), 0) << "farther apart than 0.1 is not proved";
  EXPECT_EQ(asked(2.0, 0, other), 0) << "touching is not overlapping";
}

// ---- Intersection ---------------------------------------------------------------------------------------------------------

/// Cubes that overlap by a corner: the surfaces cross where x, y or z is 1, and both features hold the point.
TEST(UnitIntersection, LiesOnBothSurfaces) {
  const Cubes at({1.5, 1.25, 1});
  const GjkResult r = gjk_from(at.pair, vertex(6), vertex(0));
  ASSERT_EQ(r.status, MarchStatus::Overlapping);
  std::uint32_t tests = 0;
  const Intersection found = intersection(at.pair, r.proof, tests);
  const auto on_surface = [](const Vec& p) { return std::fabs(max_abs(p) - 1) <= 1e-15; };
  EXPECT_TRUE(on_surface(found.point));
  EXPECT_TRUE(on_surface(found.point - Vec{1.5, 1.25, 1}));
  EXPECT_NE(found.a.kind(), FeatureKind::None);
  EXPECT_NE(found.b.kind(), FeatureKind::None);
}

/// Where bodies touch by overlapping as deep as law 2's bound, rounding puts points deeper.
TEST(UnitIntersection, MovesTowardsTheSurfaceWhatNoFeatureHolds) {
  const Cubes at({3, 0, 0});  // the sides at x = 1 and 2 face each other
  const double bound = at.pair.law_two - at.pair.motion_error;
  std::uint32_t tests = 0;
  const auto expect_held = [&](double depth, bool moves, FeatureId side_a, FeatureId side_b) {
    const Vec a{1 - depth, 0.5, 0.25}, b{2 + depth, 0.5, 0.25};
    const HeldPoint of_a = held_at_a(at.pair, vertex(0), a, tests), of_b = held_at_b(at.pair, vertex(0), b, tests);
    EXPECT_EQ(of_a.feature, side_a) << depth;
    EXPECT_EQ(of_b.feature, side_b) << depth;
    EXPECT_NEAR(of_a.point.x, moves ? 1 - bound : a.x, 0x1p-52);
    EXPECT_NEAR(of_b.point.x, moves ? 2 + bound : b.x, 0x1p-51);
    EXPECT_EQ(of_a.point.y, 0.5);
    EXPECT_EQ(of_b.point.z, 0.25);
  };
  expect_held(0.5 * bound, false, face(0, 1), face(0, -1));
  expect_held(1.5 * bound, true, face(0, 1), face(0, -1));
  expect_held(3 * bound, false, vertex(0), vertex(0));
}

}  // namespace
}  // namespace swiftlet
