// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The files of march/depth and march/manifold, one by one, on cubes that overlap by a slab and on a lid:
//
//        +-------+          A: [-1, 1]^3, B: the same, moved by (1.5, 0.5, 0.25). Their Minkowski difference A - B is the cube
//        of |  A +--|----+     half size 2 around (-1.5, -0.5, -0.25); the origin is 0.5 below its side towards +x, the depth.
//        |    |  |  B |
//        +----|--+    |
//             +-------+
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "bodies.h"
#include "depth/epa.h"
#include "depth/exact_hull.h"
#include "depth/facet_proof.h"
#include "manifold/clip.h"
#include "pair/pair_view.h"

namespace swiftlet {
namespace {

const Model kCube = bodies::model(bodies::cube());
const Level& kLevel = kCube.level(0);
const Motion kApart = motion({Mat3::Identity(), {1.5, 0.5, 0.25}});
const PairView kPair = pair_view(kLevel.view, kLevel.view, kApart, 0);

/// A corner by its number in bodies::box: a model numbers its own.
std::uint32_t index(std::uint32_t corner) {
  const std::span<const std::uint32_t> corners = kCube.source().vertex;
  return std::uint32_t(std::find(corners.begin(), corners.end(), corner) - corners.begin());
}

/// The last state of a walk that tells nothing.
Nearest unknown() {
  Nearest seen{};
  seen.over_a = seen.over_b = std::numeric_limits<double>::infinity();
  seen.corners_a = seen.corners_b = kNoCorners;
  return seen;
}

/// The goal of an exact depth.
DepthGoal exactly(const PairView& pair) { return {{}, pair.law_two, 0, true, 0}; }

void expect_depth(const Depth& d) {
  EXPECT_EQ(d.end, DepthEnd::Converged);
  EXPECT_NEAR(d.lower, 0.5, 1e-14);
  EXPECT_NEAR(d.upper, 0.5, 1e-14);
  EXPECT_LE(d.lower, d.upper);
  EXPECT_NEAR(d.normal.x, 1, 1e-14);
  EXPECT_NEAR(norm(d.point_a - d.point_b), 0.5, 1e-14);
}

TEST(UnitEpa, FindsTheSideNearestToTheOriginFromAnyDirection) {
  for (const Vec& direction : {Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{1, -1, 1}, Vec{0, 0, -1}}) {
    DepthStart start;
    start.direction = direction;
    std::uint32_t tests = 0;
    expect_depth(epa(kPair, kLevel, kLevel, start, exactly(kPair), tests));
  }
}

/// Where M is a point there is no plane to begin with: the directions that are tried for one are of length 1 too.
TEST(UnitEpa, OfTwoPointsHasAUnitNormal) {
  const Model a = bodies::model(bodies::point({0, 0, 0})), b = bodies::model(bodies::point({1, 2, 3}));
  for (const Vec3& off : {Vec3(0, 0, 0), Vec3(1e-16, 0, 0), Vec3(0, -1e-16, 3e-16), Vec3(1e-15, 2e-15, -1e-15)}) {
    const Motion m = motion({Mat3::Identity(), off - Vec3(1, 2, 3)});
    const PairView pair = pair_view(a.level(0).view, b.level(0).view, m, 0);
    for (const Vec3& along : {Vec3(1, 1, 1), Vec3(-3, 1, 2), Vec3(1, -1e-3, 0), Vec3(0.2, 0.9, -0.4)}) {
      DepthStart start;
      start.direction = vec(Vec3(along.normalized()));
      std::uint32_t tests = 0;
      const Depth d = epa(pair, a.level(0), b.level(0), start, exactly(pair), tests);
      EXPECT_NEAR(norm(d.normal), 1, 1e-15) << off.transpose() << " along " << along.transpose();
    }
  }
}

/// The hull of points and of three directions in which it goes on without end. All coordinates are whole, so that doubles tell
/// exactly that no point is above a facet's plane. Along directions that lean towards none of the three, the points are at
/// least as high as the lowest facet.
TEST(UnitExactHull, IsUnboundedAlongIdealCornersAlone) {
  std::mt19937 random(5);
  const auto whole = [&](int most) { return double(int(random() % unsigned(2 * most + 1)) - most); };
  int heights = 0;
  for (int round = 0; round < 60; ++round) {
    const int most = round % 2 ? 3 : 1000;  // few values: many points in one plane
    std::array<Vec, 3> direction;
    do
      for (Vec& d : direction) d = {whole(4), whole(4), whole(4)};
    while (dot(cross(direction[0], direction[1]), direction[2]) == 0);
    std::vector<Vec> points(60);
    for (Vec& p : points) p = {whole(most), whole(most), whole(most)};
    ExactHull hull;
    hull.begin(direction, points[0]);
    for (const Vec& p : points) {
      if (const int facet = hull.seen_from(p); facet >= 0) hull.add(p, facet);
      EXPECT_LT(hull.seen_from(p), 0);
    }
    int facets = 0, infinite = 0;
    for (int k = 0; k < hull.facet_count(); ++k) {
      const HullFacet& f = hull.facet(k);
      if (hull.is_gone(k)) {
        infinite += hull.is_ideal(f.corner[0]) && hull.is_ideal(f.corner[1]) && hull.is_ideal(f.corner[2]);
        continue;
      }
      ++facets;
      // The facet's plane: through its points, along its directions.
      Vec foot{0, 0, 0};
      for (const std::uint8_t c : f.corner) foot = hull.is_ideal(c) ? foot : hull.corner(c);
      std::vector<Vec> along;
      for (const std::uint8_t c : f.corner) {
        const Vec v = hull.is_ideal(c) ? hull.corner(c) : hull.corner(c) - foot;
        if (max_abs(v) > 0) along.push_back(v);
      }
      ASSERT_EQ(along.size(), 2u);
      Vec n = cross(along[0], along[1]);
      ASSERT_GT(max_abs(n), 0);
      if (dot(n, f.normal) < 0) n = -n;
      EXPECT_NEAR(norm(f.normal - normalised(n)), 0, 1e-14);
      for (const Vec& p : points) EXPECT_LE(dot(n, p - foot), 0);
      for (const Vec& d : direction) EXPECT_LE(dot(n, d), 0);
    }
    EXPECT_EQ(infinite, 1);
    // Euler's formula for triangles, ideal corners and the plane at infinity counted: each point of the hull is a corner.
    std::set<int> corners;
    for (int k = 0; k < hull.facet_count(); ++k) {
      if (!hull.is_gone(k)) corners.insert(hull.facet(k).corner.begin(), hull.facet(k).corner.end());
    }
    EXPECT_EQ(facets + infinite, 2 * int(corners.size()) - 4);
    const HullFacet& lowest = hull.facet(hull.lowest());
    for (int i = 0; i < 200; ++i) {
      Vec n{whole(50), whole(50), whole(50)};
      if (std::any_of(direction.begin(), direction.end(), [&](const Vec& d) { return dot(n, d) > 0; }) || max_abs(n) == 0)
        continue;
      double height = -kInfinity;
      for (const Vec& p : points) height = max(height, dot(normalised(n), p));
      if (lowest.height > 0) {
        EXPECT_GE(height, lowest.height * (1 - 1e-14));
        ++heights;
      }
    }
  }
  EXPECT_GE(heights, 100);
}

///       3           A flat lid: a triangle 0 1 2 at z = 0 and, beyond its sides, 3 4 5 at z = -0.5. A point 0.01 below the
///      / \          middle of the small triangle is that deep.
///     1---0
///    / \ / \        (seen from above, turned)
///   4---2---5
bodies::Polyhedron lid() {
  bodies::Polyhedron b;
  const double root = std::sqrt(3);
  b.points = {{1, 0, 0},     {-0.5, root / 2, 0},     {-0.5, -root / 2, 0}, {1.5, 1.5 * root, -0.5},
              {-3, 0, -0.5}, {1.5, -1.5 * root, -0.5}};
  b.add({0, 1, 2}), b.add({5, 4, 3});
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    b.add({next, k, 3 + k}), b.add({3 + k, 3 + next, next});
  }
  return b;
}

/// Two cubes of side 2, one on the other and 0.1 deep. Of the facet of 4 x 4 where they meet the start names 2 x 2, A's lid
/// less one corner of B: beyond its sides the facet goes on.
TEST(UnitFacetProof, ProvesAFacetByAPartOfIt) {
  const Motion m = motion({Mat3::Identity(), {0.25, 0.5, 1.9}});
  const PairView pair = pair_view(kLevel.view, kLevel.view, m, 0);
  DepthStart start;
  start.count = 4;
  for (std::uint32_t k = 0; k < 4; ++k) start.a[k] = index(4 + k), start.b[k] = index(0);
  start.direction = {0, 0, 1};
  std::uint32_t tests = 0;
  Depth d;
  Nearest seen = unknown();
  ASSERT_TRUE(prove_facet(pair, kLevel, kLevel, start, {pair, seen, {0, 0, 0}}, exactly(pair), tests, d));
  EXPECT_NEAR(d.lower, 0.1, 1e-14);
  EXPECT_NEAR(d.upper, 0.1, 1e-14);
  EXPECT_EQ(d.normal.z, 1);
}

/// Proves that `at` is as far below the lid as below the face of vertices `first` to `first` + 2.
bool is_proved_at(const Vec3& at, std::uint32_t first, const Vec& direction, Depth& d) {
  const Model body = bodies::model(lid()), dot = bodies::model(bodies::point({0, 0, 0}));
  const Motion m = motion({Mat3::Identity(), at});
  const PairView pair = pair_view(body.level(0).view, dot.level(0).view, m, 0);
  const std::span<const std::uint32_t> corners = body.source().vertex;
  DepthStart start;
  start.count = 3;
  for (std::uint32_t k = 0; k < 3; ++k)
    start.a[k] = std::uint32_t(std::find(corners.begin(), corners.end(), first + k) - corners.begin());
  start.direction = direction;
  std::uint32_t tests = 0;
  Nearest seen = unknown();
  return prove_facet(pair, body.level(0), dot.level(0), start, {pair, seen, {0, 0, 0}}, exactly(pair), tests, d);
}

TEST(UnitFacetProof, ProvesTheNearestFacetAndNoOther) {
  Depth d;
  ASSERT_TRUE(is_proved_at({0, 0, -0.01}, 0, {0, 0, 1}, d));
  EXPECT_EQ(d.end, DepthEnd::Converged);
  EXPECT_NEAR(d.lower, 0.01, 1e-14);
  EXPECT_NEAR(d.upper, 0.01, 1e-14);
  EXPECT_EQ(d.normal.z, 1);
  EXPECT_FALSE(is_proved_at({0, 0, -0.01}, 3, {0, 0, -1}, d)) << "that is 0.49 deep";
}

/// The faces beyond the lid's sides lean by 11.3 degrees: a point is as far below one as below the lid if it is 0.099 of its
/// depth, the tangent of half that angle, from the side. The side of vertices 1 and 2 is at x = -0.5.
TEST(UnitFacetProof, ProvesAFacetUpToWhereTheNextIsAsNear) {
  for (const double side : {1., 0.2, 0.1}) {
    Depth d;
    EXPECT_TRUE(is_proved_at({-0.5 + 0.01 * side, 0, -0.01}, 0, {0, 0, 1}, d)) << side;
    EXPECT_NEAR(d.lower, 0.01, 1e-14);
  }
  Depth d;
  EXPECT_FALSE(is_proved_at({-0.5 + 0.01 * 0.098, 0, -0.01}, 0, {0, 0, 1}, d));
  EXPECT_LT(d.normal.x, 0) << "the difference is lower along the normal of the face beyond";
}

TEST(UnitClip, OfTwoSquaresIsTheirCommonSquare) {
  // Seen along z, where B's square is 1.5 and 0.5 aside: [0.5, 1] x [-0.5, 1].
  const Motion above = motion({Mat3::Identity(), {1.5, 0.5, 2}});
  const PairView pair = pair_view(kLevel.view, kLevel.view, above, 0);
  const FeatureId top{FeatureKind::Vertex, index(6)}, bottom{FeatureKind::Vertex, index(0)};
  const ContactFace a(pair.a, {0, 0, 1}, top, {}, 0, 0), b(pair.b, {0, 0, -1}, bottom, {}, 0, 0);
  const Projection along_z(pair, {0, 0, 1}, {0.75, 0, 1}, any_side(pair, a, b));
  const Manifold none;
  Candidates found(1, none);
  clip(along_z, a, b, pair.law_two, found);
  ASSERT_EQ(found.count(), 4);
  std::array<Vec, 4> corners;
  for (int i = 0; i < 4; ++i) {
    corners[std::size_t(i)] = along_z.point(found[i].on_a) - Vec{0.75, 0.25, 1};
    EXPECT_NEAR(found[i].separation, 0, 1e-15);
  }
  std::sort(corners.begin(), corners.end(),
            [](const Vec& p, const Vec& q) { return std::atan2(p.y, p.x) < std::atan2(q.y, q.x); });
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec &p = corners[i], &q = corners[(i + 1) % 4];
    area += (p.x * q.y - p.y * q.x) / 2;
    EXPECT_NEAR(p.z, 0, 1e-15);
  }
  EXPECT_NEAR(area, 0.75, 1e-14);
}

}  // namespace
}  // namespace swiftlet
