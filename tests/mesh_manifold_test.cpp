// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Manifolds of mesh regions: scenes whose points anyone can name, and random ones whose points, separations and ways are judged
// by long doubles over all triangles.
#include <swiftlet/mesh_contacts.h>

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "pair_axes.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;
using Real = long double;

struct Region {
  MeshContact contact;
  Manifold manifold;
};
std::vector<Region> regions(const MeshBody& a, const MeshBody& b, const Pose& pose, double reach,
                            const ManifoldOptions& options = {}) {
  std::vector<MeshContact> found(64);
  found.resize(contacts(a, b, pose, reach, found).stored);
  std::vector<Region> all;
  for (const MeshContact& contact : found) all.push_back({contact, manifold(a, b, pose, contact, options)});
  return all;
}

Soup floor_of(std::uint32_t side, double size) {
  Soup soup = patch(side, [](double, double) { return 0.0; });
  for (Vec3& p : soup.points) p.head<2>() *= size;
  return soup;
}

/// The points, by their corners' signs about a middle: each of the four once.
void expect_corners(const Manifold& m, const Vec3& middle, double half, double separation, double error) {
  ASSERT_EQ(m.count, 4u);
  SCOPED_TRACE(testing::Message() << separation << " " << m.points[0].point_a.transpose() << " " << m.points[0].separation
                                  << " " << int(m.points[0].feature_a.kind()) << int(m.points[0].feature_b.kind()));
  EXPECT_NEAR(m.normal.z(), 1, 1e-9);
  int seen = 0;
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const Vec3 at = m.points[i].point_b - middle;
    EXPECT_NEAR(std::fabs(at.x()), half, error);
    EXPECT_NEAR(std::fabs(at.y()), half, error);
    EXPECT_NEAR(m.points[i].separation, separation, error);
    EXPECT_NEAR(m.points[i].point_a.z(), 0, error);
    seen |= 1 << (2 * (at.x() > 0) + (at.y() > 0));
  }
  EXPECT_EQ(seen, 15);
}

TEST(MeshManifold, OfABoxOnAFloorIsItsFourCorners) {
  const MeshModel body = box({-1, -1, 0}, {1, 1, 2}).mesh();
  const Body solid = Body::box({-1, -1, 0}, {1, 1, 2}), slab = Body::box({-9, -9, -1}, {9, 9, 0});
  for (const double height : {0.01, 0.0, -0.01}) {
    const Vec3 at(0.1037, 0.2041, height);
    for (const std::uint32_t side : {1u, 2u, 31u}) {
      const MeshModel ground = floor_of(side, 5).mesh();
      for (const MeshBody& b : {MeshBody(body), MeshBody(solid)}) {
        const auto found = regions(ground, b, {Mat3::Identity(), at}, 0.02, {.margin = 0.02});
        ASSERT_EQ(found.size(), 1u);
        expect_corners(found[0].manifold, at, 1, height, 1e-12);
      }
    }
    const auto on_slab = regions(slab, body, {Mat3::Identity(), at}, 0.02, {.margin = 0.02});
    ASSERT_EQ(on_slab.size(), 1u);
    expect_corners(on_slab[0].manifold, at, 1, height, 1e-12);
  }
}

TEST(MeshManifold, OfABallIsOnePoint) {
  const MeshModel ground = floor_of(9, 5).mesh(), round = ball(3).mesh();
  const auto on_mesh = regions(ground, round, shift(0.1, 0.2, 1.001), 0.01, {.margin = 0.002});
  ASSERT_EQ(on_mesh.size(), 1u);
  ASSERT_EQ(on_mesh[0].manifold.count, 1u);
  EXPECT_NEAR(on_mesh[0].manifold.points[0].separation, 0.001, 1e-13);
  const auto smooth = regions(ground, Body::point({0, 0, 0}, 1), shift(0.1, 0.2, 0.99), 0.01, {.margin = 0.002});
  ASSERT_EQ(smooth.size(), 1u);
  ASSERT_EQ(smooth[0].manifold.count, 1u);
  EXPECT_NEAR(smooth[0].manifold.points[0].separation, -0.01, 1e-13);
  EXPECT_NEAR(smooth[0].manifold.points[0].point_b.z(), -0.01, 1e-13);
  EXPECT_NEAR((smooth[0].manifold.points[0].point_b.head<2>() - Eigen::Vector2d(0.1, 0.2)).norm(), 0, 1e-12);
}

TEST(MeshManifold, OfEdgesThatCrossIsOnePoint) {
  Soup roof;
  roof.add({-1, 0, 0}, {1, 0, 0}, {0, 1, -1});
  roof.add({-1, 0, 0}, {1, 0, 0}, {0, -1, -1});
  const MeshModel ridge = roof.mesh();
  Pose pose;
  pose.rotation << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  for (const double height : {0.01, -0.01}) {
    pose.translation = {0.03, 0.04, height};
    const auto found = regions(ridge, ridge, pose, 0.02, {.margin = 0.02});
    ASSERT_EQ(found.size(), 1u);
    const Manifold& m = found[0].manifold;
    ASSERT_EQ(m.count, 1u) << height;
    EXPECT_NEAR(m.normal.z(), 1, 1e-12);
    EXPECT_NEAR(m.points[0].separation, height, 1e-12);
    EXPECT_NEAR((m.points[0].point_a - Vec3(0.03, 0, 0)).norm(), 0, 1e-12);
    EXPECT_EQ(m.points[0].feature_a.kind(), FeatureKind::Edge);
    EXPECT_EQ(m.points[0].feature_b.kind(), FeatureKind::Edge);
  }
}

/// Triangles that are points in one place have no axis that could part them.
TEST(PairAxes, OfPointsInOnePlaceAreNone) {
  const Vec point[3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  Vec axis{7, 7, 7};
  EXPECT_EQ(PairAxes(point, point, motion(Pose{}), 4).least(axis), std::numeric_limits<double>::infinity());
  EXPECT_EQ(dot(axis, axis), 0);
}

TEST(MeshManifold, KeepsThePointsOfAPairAtRest) {
  const MeshModel body = box({-1, -1, 0}, {1, 1, 2}).mesh(), ground = floor_of(17, 5).mesh();
  Random random(7);
  Manifold previous;
  for (int i = 0; i < 50; ++i) {
    Pose pose = shift(0.1037, 0.2041, 0.001);
    pose.rotation = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
    pose.translation += 1e-7 * random.in_ball();
    MeshContact contact;
    ASSERT_EQ(contacts(ground, body, pose, 0.02, {&contact, 1}).count, 1u);
    const Manifold m = manifold(ground, body, pose, contact, {.margin = 0.02}, previous);
    ASSERT_EQ(m.count, 4u);
    for (std::uint32_t k = 0; i > 0 && k < 4; ++k) {
      EXPECT_TRUE(std::any_of(previous.points.begin(), previous.points.begin() + 4, [&](const ManifoldPoint& p) {
        return p.feature_a == m.points[k].feature_a && p.feature_b == m.points[k].feature_b;
      }));
    }
    previous = m;
  }
}

// ---- Judged by long doubles ------------------------------------------------------------------------------------------------

Real distance_of(const Soup& soup, const Pose& pose, const Vec3& p) {
  Real least = HUGE_VALL;
  const Point<Real> at = point<Real>(p);
  for (const Triangle<Real>& t : triangles<Real>(soup, pose)) least = std::min(least, nearest(t, {at, at, at}).squared);
  return std::sqrt(least);
}
/// Whether a motion of B by `way` parts two triangles, up to `slack`: an axis says so.
bool parts(const Triangle<Real>& a, const Triangle<Real>& b, const Point<Real>& way, Real slack) {
  std::vector<Point<Real>> axes;
  const auto side = [](const Triangle<Real>& t, std::size_t k) { return t[(k + 1) % 3] - t[k]; };
  for (const auto* t : {&a, &b}) {
    const Point<Real> normal = cross(side(*t, 0), side(*t, 1));
    axes.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) axes.push_back(cross(normal, side(*t, k)));
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) axes.push_back(cross(side(a, i), side(b, k)));
  Triangle<Real> moved = b;
  for (Point<Real>& p : moved) p = p + way;
  for (const Point<Real>& axis : axes) {
    const Real length = std::sqrt(dot(axis, axis));
    if (!(length > 1e-15L)) continue;
    const Point<Real> n = axis * (1 / length);
    if (std::max(gap(a, moved, n), gap(a, moved, n * Real(-1))) >= -slack) return true;
  }
  return false;
}

TEST(MeshManifold, PointsLieOnBothSurfacesAndTheWayParts) {
  Random random(20261124);
  int points = 0, crossing = 0, empty = 0;
  for (int i = 0; i < 400; ++i) {
    const Soup a = any(random), b = any(random);
    Pose pose = any_pose(random, 2);
    const MeshModel x = a.mesh(), y = b.mesh();
    if (i % 4 == 1) {  // near contact
      const Answer apart = distance(x, y, pose);
      if (apart.lower > 0) pose.translation -= apart.normal * (apart.upper - 0.001);
    }
    const double reach = i % 2 ? 0.01 : 0.1, margin = reach / 2;
    const double size = 3 + pose.translation.norm(), error = 0x1p-20 * size;
    for (const auto& [contact, m] : regions(x, y, pose, reach, {.margin = margin, .most_points = 8})) {
      const bool crosses = contact.verdict == Verdict::Overlapping;
      crossing += crosses;
      empty += m.count == 0;
      ASSERT_TRUE(!crosses || m.count > 0) << i;
      if (m.count == 0) continue;
      EXPECT_NEAR(m.normal.norm(), 1, 1e-14);
      Real least = HUGE_VALL;
      for (std::uint32_t k = 0; k < m.count; ++k) {
        const ManifoldPoint& p = m.points[k];
        ++points;
        least = std::min<Real>(least, p.separation);
        EXPECT_LE(p.separation, margin + error);
        EXPECT_NEAR((p.point_b - p.point_a - p.separation * m.normal).norm(), 0, 1e-14 * size);
        EXPECT_LE(distance_of(a, {}, p.point_a), error) << i << " " << k;
        EXPECT_LE(distance_of(b, pose, p.point_b), error) << i << " " << k;
      }
      EXPECT_EQ(double(least), m.points[0].separation);
      if (!crosses) {
        EXPECT_NEAR(double(least), contact.upper, error) << i;
        continue;
      }
      // Every pair that crosses within the region is parted by the way.
      const Point<Real> way = point<Real>(-m.points[0].separation * m.normal);
      const Eigen::AlignedBox3d box(contact.box_min, contact.box_max);
      for (const auto& s : triangles<Real>(a)) {
        for (const auto& t : triangles<Real>(b, pose)) {
          if (nearest(s, t).squared > 0) continue;
          Eigen::AlignedBox3d of_s, of_t;
          for (std::size_t k = 0; k < 3; ++k) {
            of_s.extend(Vec3(double(s[k].x), double(s[k].y), double(s[k].z)));
            of_t.extend(Vec3(double(t[k].x), double(t[k].y), double(t[k].z)));
          }
          if (!box.contains(of_s.intersection(of_t))) continue;
          EXPECT_TRUE(parts(s, t, way, 1e-16L * Real(size))) << i;
        }
      }
    }
  }
  EXPECT_GT(points, 500);
  EXPECT_GT(crossing, 50);
  EXPECT_LT(empty, 100);
}

/// A roof of two slopes, and below it two triangles that its slopes cross: upwards, radii cost more than their sum.
TEST(MeshManifold, TheWayAlongALeaningAxisIsLongerForRadii) {
  const MeshModel roof = Soup{{{0, -4, 0}, {0, 4, 0}, {-4, 0, -4}, {4, 0, -4}}, {{0, 1, 2}, {0, 1, 3}}}.mesh(),
                  plates = Soup{{{-0.9, -0.5, -1}, {-0.9, 0.5, -1}, {-3, 0, -1}, {0.9, -0.5, -1}, {0.9, 0.5, -1}, {3, 0, -1}},
                                {{0, 1, 2}, {3, 4, 5}}}
                               .mesh();
  for (const double radius : {0.0, 0.1, 0.25}) {
    std::array<MeshContact, 2> found;
    const MeshBody a(roof, radius), b(plates, radius);
    ASSERT_EQ(contacts(a, b, {}, 1, found).count, 1u);
    const Manifold m = manifold(a, b, {}, found[0]);
    ASSERT_GT(m.count, 0u);
    EXPECT_NEAR(m.normal.z(), 1, 1e-15);
    EXPECT_NEAR(m.points[0].separation, -0.1 - 2 * radius * std::sqrt(2.0), 1e-12);
  }
}

/// Every pair that crosses within the region is as far apart as both radii once B has gone the way.
TEST(MeshManifold, TheWayPartsWhatIsWithinTheRadii) {
  Random random(46);
  int crossing = 0;
  for (int i = 0; i < 300; ++i) {
    const Soup a = any(random), b = any(random);
    const Pose pose = any_pose(random, 2);
    const MeshModel x = a.mesh(), y = b.mesh();
    const double of_a = random.uniform(0, 0.2), of_b = i % 3 ? random.uniform(0, 0.2) : 0;
    std::vector<MeshContact> found(16);
    found.resize(contacts({x, of_a}, {y, of_b}, pose, 0.01, found).stored);
    for (const MeshContact& contact : found) {
      if (!contact.normal.hasNaN()) continue;  // surfaces that are apart
      const Manifold m = manifold({x, of_a}, {y, of_b}, pose, contact, {.margin = 0.01});
      ASSERT_GT(m.count, 0u);
      const Pose moved{pose.rotation, pose.translation - m.points[0].separation * m.normal};
      const auto of_s = triangles<Real>(a), of_t = triangles<Real>(b, pose), after = triangles<Real>(b, moved);
      const Eigen::AlignedBox3d box(contact.box_min, contact.box_max);
      for (const auto& s : of_s) {
        for (std::size_t t = 0; t < of_t.size(); ++t) {
          if (nearest(s, of_t[t]).squared > 0) continue;
          Eigen::AlignedBox3d around_s, around_t;
          for (std::size_t k = 0; k < 3; ++k) {
            around_s.extend(Vec3(double(s[k].x), double(s[k].y), double(s[k].z)));
            around_t.extend(Vec3(double(of_t[t][k].x), double(of_t[t][k].y), double(of_t[t][k].z)));
          }
          if (!box.contains(around_s.intersection(around_t))) continue;
          ++crossing;
          EXPECT_GE(std::sqrt(nearest(s, after[t]).squared), of_a + of_b - 1e-13) << i;
        }
      }
    }
  }
  EXPECT_GT(crossing, 200);
}

}  // namespace
}  // namespace swiftlet
