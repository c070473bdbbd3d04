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

/// A pair at rest, A below B.
struct Resting {
  const char* name;
  MeshBody a, b;
  Vec3 at;  ///< B's place, where both touch
  double angle = 0;
};
Pose resting(const Resting& pair, double gap, double noise, Random& random) {
  const Vec3 turn = noise * random.in_ball();
  const Mat3 rotation =
      (Eigen::AngleAxisd(pair.angle, Vec3::UnitZ()) * Eigen::Quaterniond(1, turn[0], turn[1], turn[2]).normalized())
          .toRotationMatrix();
  return {rotation, pair.at + Vec3(0, 0, gap) + noise * random.in_ball()};
}
struct RestingPairs {
  const MeshModel cube = box({-1, -1, 0}, {1, 1, 2}).mesh(), ground = floor_of(17, 5).mesh(), tile = floor_of(9, 1).mesh(),
                  halves = floor_of(1, 5).mesh();
  const Body convex = Body::box({-1, -1, 0}, {1, 1, 2});
  const Vec3 above{0, 0, 2};
  const std::vector<Resting> all{{"a cube on a floor", ground, cube, {0.1037, 0.2041, 0}, 0.3},
                                 {"on a tile of its size", tile, cube, {0, 0, 0}},
                                 {"on a floor, its corners over a diagonal", halves, cube, {0, 0, 0}},
                                 {"on an equal one", cube, cube, above},
                                 {"on an equal convex one", convex, cube, above},
                                 {"a convex one on an equal mesh", cube, convex, above}};
};

TEST(MeshManifold, KeepsThePointsOfAPairAtRest) {
  const RestingPairs pairs;
  Random random(7);
  for (const Resting& pair : pairs.all) {
    for (const double gap : {1e-3, -1e-3}) {
      Manifold previous;
      int kept = 0;
      for (int i = 0; i < 100; ++i) {
        const Pose pose = resting(pair, gap, 1e-7, random);
        MeshContact contact;
        ASSERT_EQ(contacts(pair.a, pair.b, pose, 0.02, {&contact, 1}).count, 1u);
        const Manifold m = manifold(pair.a, pair.b, pose, contact, {.margin = 0.02}, previous);
        ASSERT_EQ(m.count, 4u) << pair.name;
        const bool all_known = std::all_of(m.points.begin(), m.points.begin() + 4, [&](const ManifoldPoint& now) {
          return std::any_of(previous.points.begin(), previous.points.begin() + 4, [&](const ManifoldPoint& p) {
            return p.feature_a == now.feature_a && p.feature_b == now.feature_b;
          });
        });
        kept += i > 0 && all_known;
        for (std::uint32_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].separation, gap, 1e-6) << pair.name;
        previous = m;
      }
      EXPECT_EQ(kept, 99) << pair.name << ", " << gap;
    }
  }
}

/// What faces that are flush have of sides that cross is noise: they are parted where they face each other.
TEST(MeshManifold, PartsFlushFacesWhereTheyFaceEachOther) {
  const RestingPairs pairs;
  Random random(17);
  for (const Resting& pair : pairs.all) {
    for (const double gap : {-1e-2, -1e-3, -1e-5, -1e-6, 0.0}) {
      for (const double noise : {1e-7, 1e-8, 1e-16}) {
        for (int i = 0; i < 40; ++i) {
          const Pose pose = resting(pair, gap, noise, random);
          MeshContact contact;
          ASSERT_EQ(contacts(pair.a, pair.b, pose, 0.02, {&contact, 1}).count, 1u);
          const Manifold m = manifold(pair.a, pair.b, pose, contact, {.margin = 0.02});
          EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-5) << pair.name << ", " << gap << ", " << noise;
          ASSERT_EQ(m.count, 4u) << pair.name << ", " << gap << ", " << noise;
          EXPECT_NEAR(m.points[0].separation, gap, 4 * noise + 1e-13) << pair.name;
        }
      }
    }
  }
}

/// In exact contact no nearest pair of points has a direction that means anything; any rotation hides which one is right.
TEST(MeshManifold, OfExactContactFacesAlongTheFace) {
  Random random(27);
  for (int i = 0; i < 300; ++i) {
    const Mat3 turn = random.rotation();
    const MeshModel ground = moved(floor_of(i % 2 ? 9 : 1, 5), turn, Vec3::Zero()).mesh(),
                    body = box({-0.5, -0.5, 0}, {0.5, 0.5, 1}).mesh();
    const Mat3 yaw = Eigen::AngleAxisd(random.uniform(-3, 3), Vec3::UnitZ()).toRotationMatrix();
    const Pose pose{turn * yaw, turn * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), (i % 3 - 1) * 1e-15)};
    MeshContact contact;
    ASSERT_EQ(contacts(ground, body, pose, 0.02, {&contact, 1}).count, 1u);
    const Manifold m = manifold(ground, body, pose, contact, {.margin = 0.02});
    EXPECT_LT((m.normal - turn * Vec3::UnitZ()).norm(), 1e-12) << i;
    EXPECT_EQ(m.count, 4u);
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
