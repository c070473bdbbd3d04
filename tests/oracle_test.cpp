// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Who checks the checker: the oracle against closed forms and against brute force over all features, and the shapes against
// what they claim. Knows nothing of march.
#include "oracle.h"
#include "shapes.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using oracle::Truth;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUlp = std::numeric_limits<double>::epsilon();

Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

Truth distance(const Mesh& a, const Mesh& b, const Pose& b_in_a) { return oracle::distance(a.points, b.points, b_in_a); }

void expect_exactly(const Truth& truth, double d) {
  EXPECT_EQ(truth.bounds.lower, d);
  EXPECT_EQ(truth.bounds.upper, d);
  EXPECT_EQ(truth.distance, d);
  EXPECT_EQ(truth.overlapping, d == 0);
  EXPECT_TRUE(oracle::holds(truth, d, d));
  EXPECT_FALSE(oracle::holds(truth, std::nextafter(d, kInfinity), kInfinity));
  EXPECT_FALSE(oracle::holds(truth, 0, std::nextafter(d, -1)));
}

TEST(Oracle, BoxesAreApartByTheirGaps) {
  const Mesh a = shapes::cube(), b = shapes::box({1, 2, 4});
  expect_exactly(distance(a, b, at(4, 0, 0)), 2.5);
  expect_exactly(distance(a, b, at(4.5, 6, 0)), 5);  // edges: gaps 3 and 4
  expect_exactly(distance(a, b, at(2.5, 4, 5)), 3);  // corners: gaps 1, 2 and 2
  expect_exactly(distance(a, b, at(-1.5 - 0x1p-40, 0.3, 0.1)), 0x1p-40);
  const Truth corner = distance(a, b, at(2.5, 4, 5));
  EXPECT_EQ(corner.witness_a, Vec3(1, 1, 1));
  EXPECT_EQ(corner.witness_b, Vec3(2, 3, 3));
  EXPECT_TRUE(corner.normal.isApprox(Vec3(1, 2, 2) / 3, 4 * kUlp));
}

TEST(Oracle, TouchingIsExactlyZeroAndOverlapping) {
  const Mesh cube = shapes::cube();
  for (const Pose& pose : {at(2, 0, 0), at(2, 2, 0), at(-2, 2, 2), at(2, 0.7, 0.1), at(0, 0, 0), at(0.5, 0.25, 0)})
    expect_exactly(distance(cube, cube, pose), 0);
  expect_exactly(distance(cube, cube, at(2 + 2 * kUlp, 0.7, 0.1)), 2 * kUlp);
  EXPECT_EQ(distance(cube, cube, at(2, 0, 0)).normal, Vec3(0, 0, 0));
}

TEST(Oracle, FlatSegmentAndPointBodiesAreBodies) {
  const Mesh point = shapes::point(), segment = shapes::segment(2), square = shapes::box({2, 2, 0});
  const Mat3 upright = (Mat3() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished();
  expect_exactly(distance(point, point, at(0, 0, 0)), 0);
  expect_exactly(distance(point, point, at(3, 4, 0)), 5);
  expect_exactly(distance(point, segment, at(0.3, 0, 2)), 2);
  expect_exactly(distance(segment, segment, at(2, 0, 0)), 0);
  expect_exactly(distance(segment, segment, at(0, 0, 0)), 0);
  expect_exactly(distance(segment, {{{0, -1, 0}, {0, 1, 0}}, {}}, at(0.5, 0, 1)), 1);
  expect_exactly(distance(segment, segment, {upright, Vec3(0.25, 0, 0)}), 0);  // crossing
  expect_exactly(distance(square, square, at(0.5, 0.5, 0)), 0);
  expect_exactly(distance(square, square, at(0.5, 0.5, 3)), 3);
  expect_exactly(distance(square, square, {upright, Vec3(0, 0, 1.5)}), 0.5);
  expect_exactly(distance(square, point, at(0.1, -0.2, 0)), 0);
}

TEST(Oracle, TetrahedraMatchTheirClosedForms) {
  const Mesh tetrahedron = shapes::tetrahedron();
  expect_exactly(distance(tetrahedron, shapes::point(), at(4, 5, 1)), 5);               // corner (1, 1, 1)
  const Truth origin_to_face = distance(tetrahedron, shapes::point(), at(-1, -1, -1));  // plane x + y + z = -1
  EXPECT_TRUE(oracle::holds(origin_to_face, 2 / std::numbers::sqrt3 - kUlp, 2 / std::numbers::sqrt3 + kUlp));
  EXPECT_LT(origin_to_face.bounds.lower, origin_to_face.bounds.upper);
  expect_exactly(distance(tetrahedron, tetrahedron, at(2, 0, 0)), 0);  // edges cross at (1, 0, 0)
  expect_exactly(distance(tetrahedron, tetrahedron, at(3, 0, 0)), 1);
}

TEST(Oracle, NonOrthonormalPosesAreTakenAsGiven) {
  const Pose twice{2 * Mat3::Identity(), Vec3(5, 0, 0)};
  expect_exactly(distance(shapes::cube(), shapes::cube(), twice), 2);
  const Pose flattened{Mat3::Zero(), Vec3(1, 1, 4)};
  expect_exactly(distance(shapes::cube(), shapes::cube(), flattened), 3);
}

TEST(Oracle, ScaleDoesNotMatter) {
  const Mesh a = shapes::random_polytope(30, 1), b = shapes::random_polytope(30, 2);
  const Pose pose{shapes::Random(3).rotation(), Vec3(1, 2, 0.5)};
  const Truth one = distance(a, b, pose);
  for (int exponent : {-900, -300, -20, 20, 300, 900}) {
    const auto scaled = [&](Mesh mesh) {
      for (Vec3& p : mesh.points) p *= std::ldexp(1, exponent);
      return mesh;
    };
    const Truth truth = distance(scaled(a), scaled(b), {pose.rotation, pose.translation * std::ldexp(1, exponent)});
    EXPECT_EQ(truth.bounds.lower, std::ldexp(one.bounds.lower, exponent));
    EXPECT_EQ(truth.bounds.upper, std::ldexp(one.bounds.upper, exponent));
    EXPECT_EQ(truth.normal, one.normal);
  }
}

TEST(Oracle, HoldsIsFalseOutsideAndForEmptyIntervals) {
  const Truth truth = distance(shapes::cube(), shapes::cube(), at(3, 4, 0));  // sqrt(1 + 4)
  EXPECT_TRUE(oracle::holds(truth, truth.bounds.lower, truth.bounds.upper));
  EXPECT_TRUE(oracle::holds(truth, 0, kInfinity));
  EXPECT_TRUE(oracle::holds(truth, -1, 3));
  EXPECT_FALSE(oracle::holds(truth, truth.bounds.upper, kInfinity));
  EXPECT_FALSE(oracle::holds(truth, 0, truth.bounds.lower));
  EXPECT_FALSE(oracle::holds(truth, kInfinity, kInfinity));
  EXPECT_FALSE(oracle::holds(truth, 0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(oracle::holds(truth, std::numeric_limits<double>::quiet_NaN(), kInfinity));
}

/// Bounds some ulps to both sides of the truth, near enough for doubles of more bits to tell nothing and far enough to tell.
TEST(Oracle, WhatIsShownQuicklyIsTrue) {
  shapes::Random random(7);
  const auto cloud = [&](int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(random.in_ball());
    return points;
  };
  int overlapping = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Vec3> a = cloud(1 + i % 5), b = cloud(1 + i % 7);
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0, 2) * std::pow(10., i % 4)};
    const Vec3 n = random.on_sphere();
    const Truth truth = oracle::distance(a, b, pose);
    overlapping += truth.overlapping;
    const oracle::Interval gap = oracle::gap(a, b, pose, n);
    double far = truth.bounds.upper, near = std::nextafter(far, -1), less = gap.lower, more = std::nextafter(less, kInfinity);
    for (int ulps = 0; ulps < 8; ++ulps) {
      ASSERT_TRUE(oracle::is_within(a, b, pose, far)) << i;
      ASSERT_FALSE(oracle::is_within(a, b, pose, near)) << i;
      ASSERT_TRUE(oracle::is_apart_along(a, b, pose, n, less)) << i;
      ASSERT_FALSE(oracle::is_apart_along(a, b, pose, n, more)) << i;
      far = std::nextafter(far, kInfinity), near = std::nextafter(near, -1);
      less = std::nextafter(less, -kInfinity), more = std::nextafter(more, kInfinity);
    }
  }
  EXPECT_GE(overlapping, 20);
}

TEST(Oracle, GapAlongTheNormalIsTheDistance) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Mesh a = shapes::random_polytope(20, 2 * seed), b = shapes::random_polytope(20, 2 * seed + 1);
    shapes::Random random(seed);
    const Pose pose{random.rotation(), 2.5 * random.on_sphere()};
    const Truth truth = distance(a, b, pose);
    const oracle::Interval along = oracle::gap(a.points, b.points, pose, truth.normal);
    EXPECT_LE(along.lower, truth.bounds.upper);
    EXPECT_NEAR(along.lower, truth.distance, 1e-14);
    EXPECT_LT(oracle::gap(a.points, b.points, pose, -truth.normal).upper, 0);
    EXPECT_NEAR((truth.witness_b - truth.witness_a).norm(), truth.distance, 1e-14);
  }
}

// --- A second method: the nearest of all pairs of features, and separation by a face normal of the difference body ---

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Points = std::vector<Kernel::Point_3>;

Points exactly(const Mesh& mesh, const Pose& pose) {
  using Q = CGAL::Gmpq;
  Points points;
  for (const Vec3& p : mesh.points) {
    std::array<Q, 3> x;
    for (int i = 0; i < 3; ++i) {
      x[i] = Q(pose.translation[i]);
      for (int j = 0; j < 3; ++j) x[i] += Q(pose.rotation(i, j)) * Q(p[j]);
    }
    points.emplace_back(x[0], x[1], x[2]);
  }
  return points;
}

template <class Visit>
void for_each_edge(const Points& p, Visit visit) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) visit(p[i], p[j]);
}

template <class Visit>
void for_each_edge_pair(const Points& a, const Points& b, Visit visit) {
  for_each_edge(a, [&](auto& p, auto& q) { for_each_edge(b, [&](auto& r, auto& s) { visit(p, q, r, s); }); });
}

template <class Visit>
void for_each_triangle(const Points& p, Visit visit) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
      for (std::size_t k = j + 1; k < p.size(); ++k) visit(p[i], p[j], p[k]);
}

bool separates(const Kernel::Vector_3& n, const Points& a, const Points& b) {
  const auto range = [&](const Points& points) {
    std::optional<std::pair<CGAL::Gmpq, CGAL::Gmpq>> r;
    for (const auto& p : points) {
      const CGAL::Gmpq along = n * (p - CGAL::ORIGIN);
      r = r ? std::pair{std::min(r->first, along), std::max(r->second, along)} : std::pair{along, along};
    }
    return *r;
  };
  const auto [a_min, a_max] = range(a);
  const auto [b_min, b_max] = range(b);
  return a_max < b_min || b_max < a_min;
}

bool disjoint_by_normals(const Points& a, const Points& b) {
  bool disjoint = false;
  const auto consider = [&](const Kernel::Vector_3& n) { disjoint = disjoint || separates(n, a, b); };
  for (const Points* body : {&a, &b})
    for_each_triangle(*body, [&](auto& p, auto& q, auto& r) { consider(CGAL::cross_product(q - p, r - p)); });
  for_each_edge_pair(a, b, [&](auto& p, auto& q, auto& r, auto& s) { consider(CGAL::cross_product(q - p, s - r)); });
  return disjoint;
}

// Of disjoint bodies.
CGAL::Gmpq distance2_by_features(const Points& a, const Points& b) {
  CGAL::Gmpq least = CGAL::squared_distance(a[0], b[0]);
  const auto consider = [&](const CGAL::Gmpq& d2) { least = std::min(least, d2); };
  for_each_edge_pair(a, b, [&](auto& p, auto& q, auto& r, auto& s) {
    consider(CGAL::squared_distance(Kernel::Segment_3(p, q), Kernel::Segment_3(r, s)));
  });
  const auto corners_to_triangles = [&](const Points& corners, const Points& triangles) {
    for_each_triangle(triangles, [&](auto& p, auto& q, auto& r) {
      for (const auto& x : corners) consider(CGAL::squared_distance(x, Kernel::Triangle_3(p, q, r)));
    });
  };
  corners_to_triangles(a, b);
  corners_to_triangles(b, a);
  return least;
}

// The truth's squared distance is exactly `d2`: both are rationals, of which only intervals of doubles can be seen here.
void expect_same(const Truth& truth, const CGAL::Gmpq& d2) {
  using Q = CGAL::Gmpq;
  EXPECT_LE(Q(truth.bounds2.lower), d2);
  EXPECT_GE(Q(truth.bounds2.upper), d2);
  EXPECT_LE(truth.bounds2.upper - truth.bounds2.lower, 2 * kUlp * truth.bounds2.upper);
  EXPECT_LE(Q(truth.bounds.lower) * Q(truth.bounds.lower), d2);
  EXPECT_GE(Q(truth.bounds.upper) * Q(truth.bounds.upper), d2);
}

class OracleVersusBruteForce : public testing::TestWithParam<double> {};  // the spread of the bodies' centres

TEST_P(OracleVersusBruteForce, Agrees) {
  int overlapping = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    shapes::Random random(1000 * seed + 7);
    const Mesh a = shapes::random_polytope(5, 2 * seed), b = shapes::random_polytope(5, 2 * seed + 1);
    const Pose pose{random.rotation(), GetParam() * random.in_ball()};
    const Truth truth = distance(a, b, pose);
    const Points points_a = exactly(a, Pose{}), points_b = exactly(b, pose);
    ASSERT_EQ(truth.overlapping, !disjoint_by_normals(points_a, points_b)) << seed;
    overlapping += truth.overlapping;
    if (!truth.overlapping) expect_same(truth, distance2_by_features(points_a, points_b));
  }
  RecordProperty("overlapping", overlapping);
}

TEST_P(OracleVersusBruteForce, AgreesOnLatticesWhereEverythingTies) {
  const std::array<Mesh, 3> bodies{shapes::tetrahedron(), shapes::octahedron(), shapes::cube()};
  shapes::Random random(5);
  for (int i = 0; i < 30; ++i) {
    const Mesh& a = bodies[random.bits() % bodies.size()];
    const Mesh& b = bodies[random.bits() % bodies.size()];
    const Vec3 lattice = (2 * GetParam() * random.in_ball()).array().round() / 2;
    const Truth truth = distance(a, b, {Mat3::Identity(), lattice});
    const Points points_a = exactly(a, Pose{}), points_b = exactly(b, {Mat3::Identity(), lattice});
    ASSERT_EQ(truth.overlapping, !disjoint_by_normals(points_a, points_b)) << lattice.transpose();
    if (!truth.overlapping) expect_same(truth, distance2_by_features(points_a, points_b));
  }
}

INSTANTIATE_TEST_SUITE_P(Spread, OracleVersusBruteForce, testing::Values(0.8, 2.0, 5.0));

TEST(Oracle, NearContactsOfLargeBodiesAreToldApart) {
  const auto [a, b] = shapes::pair(shapes::Family::Plate, 2000);
  shapes::Random random(11);
  for (int i = 0; i < 5; ++i) {
    Pose pose{random.rotation(), 3 * random.on_sphere()};
    const Truth apart = distance(a, b, pose);
    pose.translation -= (1 - 1e-12) * apart.distance * apart.normal;  // to a gap of about 1e-12
    const Truth near = distance(a, b, pose);
    EXPECT_FALSE(near.overlapping);
    EXPECT_NEAR(near.distance, 1e-12 * apart.distance, 1e-14);
    pose.translation -= 2 * near.distance * near.normal;
    EXPECT_TRUE(distance(a, b, pose).overlapping);
  }
}

// --- Convexity and the shapes ----------------------------------------------------------------------------------------------

bool is_convex(const Mesh& mesh) { return oracle::is_convex(mesh.points, mesh.triangles); }

TEST(Convexity, SeesOneUlp) {
  Mesh cube = shapes::cube();
  EXPECT_TRUE(is_convex(cube));
  EXPECT_TRUE(oracle::encloses(cube.points, cube.triangles, std::vector<Vec3>{{1, 1, 1}, {1, 0.3, -1}, {0, 0, 0}}));
  EXPECT_FALSE(oracle::encloses(cube.points, cube.triangles, std::vector<Vec3>{{0, 1 + kUlp, 0}}));
  Mesh meshed = shapes::meshed_cube(2);
  EXPECT_TRUE(is_convex(meshed));
  for (Vec3& p : meshed.points)
    if (p == Vec3(1, 0, 0)) p.x() = std::nextafter(1, 0);
  EXPECT_FALSE(is_convex(meshed));
  cube.triangles.pop_back();
  EXPECT_FALSE(is_convex(cube)) << "a hole";
}

TEST(Shapes, SolidsAreConvexWithTheirCounts) {
  const auto expect = [](const Mesh& mesh, std::size_t vertices, std::size_t triangles) {
    EXPECT_TRUE(is_convex(mesh)) << vertices;
    EXPECT_EQ(mesh.points.size(), vertices);
    EXPECT_EQ(mesh.triangles.size(), triangles);
  };
  expect(shapes::box({1, 2, 3}), 8, 12);
  expect(shapes::cube(), 8, 12);
  expect(shapes::meshed_cube(4), 98, 192);
  expect(shapes::tetrahedron(), 4, 4);
  expect(shapes::octahedron(), 6, 8);
  expect(shapes::icosahedron(), 12, 20);
  expect(shapes::dodecahedron(), 20, 36);
  expect(shapes::needle(), 12, 20);
  expect(shapes::sliver(), 4, 4);
  expect(shapes::polygon(9), 9, 14);
  expect(shapes::prism(4, 1, 2), 8, 12);
}

class FamilyOfShapes : public testing::TestWithParam<shapes::Family> {};

TEST_P(FamilyOfShapes, HasTheCountTheRadiusAndTheCentroidItClaims) {
  for (std::uint32_t triangles : {4u, 60u, 500u, 2000u}) {
    const auto [a, b] = shapes::pair(GetParam(), triangles);
    EXPECT_NE(a.points, b.points);
    for (const Mesh& mesh : {a, b}) {
      EXPECT_EQ(mesh.triangles.size(), triangles);
      EXPECT_TRUE(triangles > 500 || is_convex(mesh));
      double radius = 0;
      for (const Vec3& p : mesh.points) radius = std::max(radius, p.norm());
      EXPECT_NEAR(radius, 1, 4 * kUlp);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, FamilyOfShapes, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& family) { return shapes::name(family.param); });

TEST(Shapes, TheFirstBitsAreTheSameEverywhere) {
  shapes::Random random(0);
  EXPECT_EQ(random.bits(), 0xe220a8397b1dcdafu);  // splitmix64's published first number
  EXPECT_EQ(random.bits(), 0x6e789e6aa1b965f4u);
}

TEST(Shapes, RotationsAreOrthonormalUpToRounding) {
  shapes::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Mat3 r = random.rotation();
    EXPECT_LE((r.transpose() * r - Mat3::Identity()).lpNorm<Eigen::Infinity>(), 8 * kUlp);
    EXPECT_NEAR(r.determinant(), 1, 8 * kUlp);
  }
}

TEST(Shapes, OrbitsComeAsNearAsTheySay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const shapes::Orbit orbit(seed, 2, 0.377);
    double nearest = kInfinity, farthest = 0;
    for (int query = 0; query < 1000; ++query) {
      const double d = orbit.pose(query).translation.norm();
      nearest = std::min(nearest, d);
      farthest = std::max(farthest, d);
    }
    EXPECT_NEAR(nearest, 2, 0.002);
    EXPECT_LE(farthest, 2 * std::sqrt(5.5 / 0.5) + 1e-9);
  }
}

}  // namespace
}  // namespace swiftlet
