// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Manifolds of generated contacts beside the exact intersection of their faces, and what they keep while bodies move.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>

#include "bodies.h"
#include "manifold_oracle.h"
#include "numeric/tolerance.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two bodies that lie on each other, or nearly.
struct Contacting {
  Model a, b;
  Pose b_in_a;
  Answer answer;

  double bound() const { return tolerance(a, b, b_in_a); }
};

Answer nearest(const Body& a, const Body& b, const Pose& b_in_a) { return closest_features(a, b, b_in_a).answer; }

Model hull_of(const Mesh& mesh) { return std::move(build(mesh.points)).value().model; }

/// B over A, whose top is at height `top`: turned about z, tilted, at x and y, its lowest point so far above the top; then
/// everything turned, so that no face is flat but up to rounding.
Contacting stacked(const bodies::Polyhedron& a, double top, const bodies::Polyhedron& b, const Pose& on_top, double gap,
                   const Mat3& turn) {
  double lowest = kInfinity;
  for (const Vec3& p : b.points) lowest = std::min(lowest, (on_top.rotation * p)[2]);
  Contacting c{bodies::model(bodies::moved(a, turn)), bodies::model(b), {}, {}};
  c.b_in_a.rotation = turn * on_top.rotation;
  c.b_in_a.translation = turn * Vec3(on_top.translation[0], on_top.translation[1], top + gap - lowest);
  c.answer = nearest(c.a, c.b, c.b_in_a);
  return c;
}

template <class T, std::size_t N>
T any(const std::array<T, N>& values, Random& random) {
  return values[random.bits() % N];
}

constexpr std::array kAngles{0., 0., 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.3, std::numbers::pi / 4};
constexpr std::array kTilts{0., 0., 1e-15, 1e-12, 1e-9, 1e-6, 1e-3};
constexpr std::array kGaps{1e-14, 1e-12, 1e-9, 1e-6, 1e-3};

Pose random_top(Random& random, double x, double y) {
  Pose pose;
  pose.rotation = shapes::rotation(Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0).normalized(), any(kTilts, random)) *
                  shapes::rotation(Vec3::UnitZ(), any(kAngles, random));
  pose.translation = {x, y, 0};
  return pose;
}

/// Two boxes, in one of three ways: centred, with sides flush, anyhow.
Contacting stacked_boxes(Random& random) {
  const auto size = [&] { return any(std::array{1., 1., 0.5, 2., 1e-3, random.uniform(0.1, 3)}, random); };
  const Vec3 a(size(), size(), size()), b(size(), size(), size());
  const Vec3 flush(a[0] - b[0], a[1] - b[1], 0), anyhow(random.uniform(-1, 1) * a[0], random.uniform(-1, 1) * a[1], 0);
  const Vec3 at = any(std::array{Vec3(0, 0, 0), flush, anyhow}, random);
  const Mat3 turn = random.bits() % 2 ? random.rotation() : Mat3::Identity();
  return stacked(bodies::box(a[0], a[1], a[2]), a[2], bodies::box(b[0], b[1], b[2]), random_top(random, at[0], at[1]),
                 any(kGaps, random), turn);
}

/// Over a convex polygon whose corners are these, counter-clockwise.
bodies::Polyhedron prism(const std::vector<Eigen::Vector2d>& base, double height) {
  const auto sides = std::uint32_t(base.size());
  bodies::Polyhedron b;
  for (const double z : {-height / 2, height / 2}) {
    for (const Eigen::Vector2d& p : base) b.points.emplace_back(p.x(), p.y(), z);
  }
  for (std::uint32_t i = 0; i < sides; ++i) b.corners.push_back(sides - 1 - i);
  for (std::uint32_t i = 0; i < sides; ++i) b.corners.push_back(sides + i);
  b.sizes = {sides, sides};
  for (std::uint32_t i = 0; i < sides; ++i) b.add({i, (i + 1) % sides, sides + (i + 1) % sides, sides + i});
  return b;
}
bodies::Polyhedron prism(std::uint32_t sides, double radius, double height) {
  std::vector<Eigen::Vector2d> base;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    base.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return prism(base, height);
}

/// A prism over a polygon whose corners lie on an ellipse, evenly, at random, or crowded together here and there, all around or
/// along a part of it.
bodies::Polyhedron uneven_prism(Random& random, std::uint32_t sides, double radius) {
  const double whole = random.bits() % 2 ? 2 * std::numbers::pi : random.uniform(0.3, 6), begin = random.uniform(0, 6),
               stretch = random.bits() % 2 ? 1 : std::pow(10, random.uniform(-1, 0));
  std::vector<double> angles;
  const auto way = random.bits() % 3;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double even = (i + 0.5) / sides, any = random.uniform(0, 1),
                 crowd = std::floor(3 * any) / 3 + 0.1 * random.uniform(0, 1);
    angles.push_back(begin + whole * (way == 0 ? even : way == 1 || i % 8 == 0 ? any : crowd));
  }
  std::sort(angles.begin(), angles.end());
  std::vector<Eigen::Vector2d> base;
  double before = angles.back() - 2 * std::numbers::pi;
  for (const double angle : angles) {
    if (angle - before < 1e-5) continue;
    base.emplace_back(radius * std::cos(angle), radius * stretch * std::sin(angle)), before = angle;
  }
  return prism(base, 1);
}

Contacting stacked_prisms(Random& random, std::uint32_t sides_a, std::uint32_t sides_b) {
  const double radius = random.uniform(0.3, 2);
  return stacked(prism(sides_a, 1, 1), 0.5, prism(sides_b, radius, 1),
                 random_top(random, random.uniform(-1, 1), random.uniform(-1, 1)), any(kGaps, random),
                 random.bits() % 2 ? random.rotation() : Mat3::Identity());
}

/// Hulls of random points, B at a random place beside A.
Contacting random_hulls(Random& random) {
  const auto body = [&] { return hull_of(shapes::random_polytope(8 + random.bits() % 40, random.bits())); };
  Contacting c{body(), body(), {}, {}};
  c.b_in_a.rotation = random.rotation();
  c.b_in_a.translation = 3 * random.on_sphere();
  c.answer = nearest(c.a, c.b, c.b_in_a);
  c.b_in_a.translation -= (c.answer.lower - any(kGaps, random)) * c.answer.normal;
  c.answer = nearest(c.a, c.b, c.b_in_a);
  return c;
}

bool is_apart(const Contacting& c) {
  return (c.answer.verdict == Verdict::Disjoint || c.answer.verdict == Verdict::Touching) && !c.answer.normal.hasNaN();
}

double least(const Manifold& p) {
  double least = kInfinity;
  for (std::uint32_t i = 0; i < p.count; ++i) least = std::min(least, p.points[i].separation);
  return least;
}

double shown_area(const Manifold& p) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < p.count; ++i) points.push_back(p.points[i].point_a);
  return oracle::area(points, p.normal);
}

/// What holds of every manifold.
void expect_sound(const Contacting& c, const Manifold& p, double separation, double margin) {
  const double bound = c.bound();
  EXPECT_EQ(p.normal, c.answer.normal);
  for (std::uint32_t i = 0; i < p.count; ++i) {
    const ManifoldPoint& q = p.points[i];
    EXPECT_LE(oracle::height_over(c.a.level(0).view, Pose{}, q.point_a), bound) << i;
    EXPECT_LE(oracle::height_over(c.b.level(0).view, c.b_in_a, q.point_b), bound) << i;
    EXPECT_LE((q.point_b - q.point_a - q.separation * p.normal).norm(), 2 * bound) << i;
    EXPECT_LE(q.separation, margin + bound);
    const auto well_named = [](const ConvexView& view, FeatureId feature) {
      return feature.kind() != FeatureKind::Edge || feature.index() < view.half_edges[feature.index()].twin;
    };
    EXPECT_TRUE(well_named(c.a.level(0).view, q.feature_a) && well_named(c.b.level(0).view, q.feature_b)) << i;
    for (std::uint32_t j = 0; j < i; ++j) {
      EXPECT_FALSE(q.feature_a == p.points[j].feature_a && q.feature_b == p.points[j].feature_b) << i << " and " << j;
    }
  }
  if (p.count > 0) {
    EXPECT_NEAR(least(p), separation, 2 * bound);
  } else {
    EXPECT_GT(separation, margin);
  }
}

Manifold touching(const Model& a, const Model& b, const Pose& b_in_a) {
  const Contacting c{a, b, b_in_a, nearest(a, b, b_in_a)};
  const Manifold p = manifold(a, b, b_in_a, c.answer);
  expect_sound(c, p, 0, 0);
  return p;
}

Pose at(double x, double y, double z, const Mat3& rotation = Mat3::Identity()) {
  Pose pose;
  pose.rotation = rotation;
  pose.translation = {x, y, z};
  return pose;
}

/// True if each point of `p` has one in `q` between the same features, and there are as many.
bool same_names(const Manifold& p, const Manifold& q) {
  if (p.count != q.count) return false;
  for (std::uint32_t i = 0; i < p.count; ++i) {
    bool found = false;
    for (std::uint32_t k = 0; k < q.count; ++k)
      found |= p.points[i].feature_a == q.points[k].feature_a && p.points[i].feature_b == q.points[k].feature_b;
    if (!found) return false;
  }
  return true;
}

/// What a manifold is beside the truth. `shares` gathers how much of the area four and eight points keep.
struct Shares {
  double four = 1, eight = 1;
  int counted = 0;
};
void expect_true(const Contacting& c, Shares& shares) {
  ManifoldOptions options{.margin = kInfinity, .most_points = kMostManifoldPoints};
  const Manifold eight = manifold(c.a, c.b, c.b_in_a, c.answer, options);
  options.most_points = 4;
  const Manifold four = manifold(c.a, c.b, c.b_in_a, c.answer, options);
  const double separation = (c.answer.point_b - c.answer.point_a).dot(c.answer.normal);
  for (const Manifold* p : {&eight, &four}) expect_sound(c, *p, separation, kInfinity);
  ASSERT_EQ(eight.face_a, four.face_a);

  const ConvexView &a = c.a.level(0).view, &b = c.b.level(0).view;
  const oracle::Overlay truth = oracle::overlay(a, oracle::flat_faces(a, eight.face_a, 0x1p-21), b,
                                                oracle::flat_faces(b, eight.face_b, 0x1p-21), c.b_in_a, c.answer.normal);
  const double size = c.a.extent() + c.b.extent(), blur = 16 * c.bound() * size;
  if (truth.corners <= 8) {
    EXPECT_NEAR(shown_area(eight), truth.area, blur);
  } else {
    EXPECT_LE(shown_area(eight), truth.area + blur);
  }
  if (truth.area < 1e4 * blur) return;
  ++shares.counted;
  shares.four = std::min(shares.four, shown_area(four) / truth.area);
  shares.eight = std::min(shares.eight, shown_area(eight) / truth.area);
}

/// Of a round face no four corners keep more than 2 / pi = 0.637, no eight more than 0.901; of the 13 corners that eight are
/// chosen from some are twice as far apart as others.
void expect_much_kept(const Shares& shares) {
  EXPECT_GE(shares.counted, 50);
  EXPECT_GE(shares.four, 0.59);
  EXPECT_GE(shares.eight, 0.87);
  std::printf("%d areas: four points keep at least %.3f, eight %.3f\n", shares.counted, shares.four, shares.eight);
}

TEST(Manifold, OfTwoCubesIsTheirCommonSquare) {
  const Model cube = bodies::model(bodies::cube());
  Pose b_in_a;
  b_in_a.translation = {0.5, 0.25, 2};
  const Manifold p = manifold(cube, cube, b_in_a, nearest(cube, cube, b_in_a));
  ASSERT_EQ(p.count, 4u);
  EXPECT_EQ(p.normal, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(shown_area(p), 1.5 * 1.75);
  int corners_a = 0, corners_b = 0, crossings = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(p.points[i].separation, 0, 1e-15);
    corners_a += p.points[i].feature_a.kind() == FeatureKind::Vertex && p.points[i].feature_b == p.face_b;
    corners_b += p.points[i].feature_b.kind() == FeatureKind::Vertex && p.points[i].feature_a == p.face_a;
    crossings += p.points[i].feature_a.kind() == FeatureKind::Edge && p.points[i].feature_b.kind() == FeatureKind::Edge;
  }
  EXPECT_EQ(corners_a, 1);
  EXPECT_EQ(corners_b, 1);
  EXPECT_EQ(crossings, 2);
}

TEST(Manifold, OfEqualFlushCubesIsTheirFace) {
  const Model cube = bodies::model(bodies::cube());
  for (const double shift : {0., 1e-17, 1e-15, 1e-12, 1e-9}) {
    Pose b_in_a;
    b_in_a.translation = {shift, -shift, 2};
    const Manifold p = manifold(cube, cube, b_in_a, nearest(cube, cube, b_in_a));
    ASSERT_EQ(p.count, 4u) << shift;
    EXPECT_NEAR(shown_area(p), 4, 4 * shift + 1e-14);
    for (std::uint32_t i = 0; i < 4 && shift < 1e-14; ++i) {  // no crossings of sides that lie on one another
      EXPECT_NE(p.points[i].feature_a.kind(), FeatureKind::Edge) << shift;
    }
  }
}

TEST(Manifold, OfStackedBoxesIsTheIntersectionOfTheirFaces) {
  Random random(1);
  Shares shares;
  int overlapping = 0;
  for (int i = 0; i < 1000; ++i) {
    const Contacting c = stacked_boxes(random);
    SCOPED_TRACE(i);
    if (!is_apart(c)) {
      ++overlapping;
      continue;
    }
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_LT(overlapping, 10);
  expect_much_kept(shares);
}

TEST(Manifold, OfPrismsIsTheIntersectionOfTheirFaces) {
  Random random(2);
  Shares shares;
  for (int i = 0; i < 60; ++i) {
    const std::array<std::uint32_t, 4> sides{3, 5, 12, 60};
    const Contacting c = stacked_prisms(random, any(sides, random), any(sides, random));
    SCOPED_TRACE(i);
    if (!is_apart(c)) continue;
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  expect_much_kept(shares);
}

/// Bodies exactly in contact: the feature that holds the common point is often a side of one of them, at its edge.
TEST(Manifold, OfBodiesInContactIsOfTheFacesThatFaceEachOther) {
  Random random(29);
  int touching = 0, beside = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto body = [&] {
      return random.bits() % 2 ? bodies::box(1 + double(random.bits() % 3), 1, 0.5)
                               : prism(3 + std::uint32_t(random.bits() % 6), 1, 1);
    };
    const double gap = any(std::array{0., -0x1p-50, 0x1p-50}, random);
    const Mat3 turn = random.bits() % 2 ? random.rotation() : Mat3::Identity();
    const Pose top = random_top(random, random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
    Contacting c = stacked(body(), 0.5, body(), top, gap, turn);
    c.answer = signed_distance(c.a, c.b, c.b_in_a);
    ASSERT_EQ(c.answer.status, Status::Converged);
    const auto cosine = [&](const Model& model, FeatureId face, const Vec3& n) {
      std::vector<Vec3> corners;
      for (const std::uint32_t v : FaceLoop(model.level(0).view, face.index())) {
        const Vertex& at = model.level(0).view.vertices[v];
        corners.emplace_back(at.x, at.y, at.z);
      }
      return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized().dot(n);
    };
    const Vec3 n = c.answer.normal, n_b = -(c.b_in_a.rotation.transpose() * n);
    const Manifold p = manifold(c.a, c.b, c.b_in_a, c.answer, {.margin = 1e-2});
    ASSERT_GT(cosine(c.a, p.face_a, n), 0.99) << i;
    ASSERT_GT(cosine(c.b, p.face_b, n_b), 0.99) << i;
    ASSERT_GE(p.count, 3u) << i;
    // No corner is nearer for counting as inside of a face.
    const double seen = (c.answer.point_b - c.answer.point_a).dot(n);
    EXPECT_GE(least(p), std::clamp(seen, c.answer.lower, c.answer.upper) - 0.51 * c.bound()) << i;
    const auto is_beside = [&](const Model& model, FeatureId feature, const Vec3& along) {
      return feature.kind() == FeatureKind::Face && cosine(model, feature, along) < 0.5;
    };
    touching += c.answer.verdict == Verdict::Touching;
    beside += is_beside(c.a, c.answer.feature_a, n) || is_beside(c.b, c.answer.feature_b, n_b);
  }
  EXPECT_GE(touching, 1000);
  EXPECT_GE(beside, 10);
}

/// Faces of many corners on one another and on faces of few, whose sides are found by halving.
TEST(Manifold, OfManyUnevenSidesIsTheIntersectionOfTheirFaces) {
  Random random(27);
  Shares shares;
  for (int i = 0; i < 60; ++i) {
    const auto sides = [&](bool few) {
      return few ? 3 + std::uint32_t(random.bits() % 13) : kManyCorners * 5 / 4 + std::uint32_t(random.bits() % 40);
    };
    const auto body = [&](bool few) {
      return few ? prism(sides(true), random.uniform(0.3, 2), 1) : uneven_prism(random, sides(false), random.uniform(0.3, 2));
    };
    const bodies::Polyhedron a = body(i % 4 == 1), b = body(i % 4 == 2);
    ASSERT_GE(std::max(a.sizes[0], b.sizes[0]), kManyCorners) << "a sweep finds these";
    const Contacting c = stacked(a, 0.5, b, random_top(random, random.uniform(-1, 1), random.uniform(-1, 1)),
                                 any(kGaps, random), random.bits() % 2 ? random.rotation() : Mat3::Identity());
    if (is_apart(c)) expect_true(c, shares);
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
  EXPECT_GE(shares.counted, 40);
  std::printf("%d areas: four points keep at least %.3f, eight %.3f\n", shares.counted, shares.four, shares.eight);
  EXPECT_GE(shares.four, 0.5);
  EXPECT_GE(shares.eight, 0.78);
}

TEST(Manifold, OfRandomHullsIsTheIntersectionOfTheirFaces) {
  Random random(3);
  Shares shares;
  for (int i = 0; i < 300; ++i) {
    const Contacting c = random_hulls(random);
    SCOPED_TRACE(i);
    if (!is_apart(c)) continue;
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  expect_much_kept(shares);
}

// ---- Faces that are hard ----------------------------------------------------------------------------------------------------

/// A square's two triangles make an angle; the manifold is still the square.
TEST(Manifold, OfNearlyCoplanarFacetsIsOneFace) {
  for (const auto& [height, thickness] : {std::pair{1e-15, 2.}, std::pair{1e-14, 2.}, std::pair{1e-12, 2.},
                                          std::pair{1e-10, 2.}, std::pair{1e-8, 2.}, std::pair{1e-10, 1e-7}}) {
    bodies::Polyhedron bent = bodies::triangulated(bodies::cube());
    for (int i = 0; i < 4; ++i) bent.points[i][2] = 1 - thickness;
    bent.points[4][2] -= height, bent.points[6][2] -= height;  // the ends of the diagonal that the top does not have
    bodies::Polyhedron roof{bent.points, {}, {}};
    for (std::size_t i = 0; i < bent.corners.size(); i += 3) {
      if (i == 6 || i == 9) continue;
      roof.add({bent.corners[i], bent.corners[i + 1], bent.corners[i + 2]});
    }
    roof.add({4, 5, 7}), roof.add({5, 6, 7});
    const Model a = bodies::model(roof), b = bodies::model(bodies::cube());
    Pose b_in_a;
    b_in_a.translation = {0, 0, 2 + 1e-9};
    const Contacting c{a, b, b_in_a, nearest(a, b, b_in_a)};
    ManifoldOptions options{.margin = 1e-6};
    const Manifold p = manifold(a, b, b_in_a, c.answer, options);
    EXPECT_EQ(p.count, 4u) << height;
    EXPECT_NEAR(shown_area(p), 4, 1e-6) << height;
    expect_sound(c, p, 1e-9, 1e-6);
    options.flatness = 0;
    if (height > 1e-13) {
      EXPECT_NEAR(shown_area(manifold(a, b, b_in_a, c.answer, options)), 2, 1e-6) << height;
    }
  }
}

/// A face dented by about the flatness falls into pieces, which may touch at a corner: the border was that of another piece
/// than the contact face's, and 0.02 of its area was left.
TEST(Manifold, OfAFaceInPiecesIsThePieceAtTheFeatures) {
  Random random(31);
  const Model plate = bodies::model(bodies::box(3, 3, 1));
  Shares shares;
  int in_pieces = 0;
  for (int i = 0; i < 120; ++i) {
    const double dent = std::pow(10, random.uniform(-7, -5));
    bodies::Polyhedron dented = prism(5 + random.bits() % 60, 1, 1);
    for (Vec3& p : dented.points) p.z() += p.z() > 0 ? dent * random.uniform() : 0;
    Contacting c{hull_of({dented.points, {}}), plate, at(0.1, 0.2, 2.01), {}};
    c.b_in_a.rotation = shapes::rotation(random.on_sphere(), std::pow(10, random.uniform(-7, -4)));
    c.answer = nearest(c.a, c.b, c.b_in_a);
    SCOPED_TRACE(i);
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
    const ConvexView& view = c.a.level(0).view;
    std::size_t above = 0;
    for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
      bool is_above = true;
      for (const std::uint32_t v : FaceLoop(view, f)) is_above &= view.vertices[v].z > 0;
      above += is_above;
    }
    const FeatureId at = manifold(c.a, c.b, c.b_in_a, c.answer).face_a;
    in_pieces += oracle::flat_faces(view, at, 0x1p-21).size() < above;
  }
  EXPECT_GE(in_pieces, 60);
  expect_much_kept(shares);
}

/// Corners inside of faces, which nothing but diagonals leave, beside faces merged with these: a way to the border that entered
/// one went on for ever.
TEST(Regress, AWayToTheBorderEnteredACornerInsideOfAFace) {
  Random random(32);
  const Model plate = bodies::model(bodies::box(3, 3, 1));
  int inner = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<Vec3> roof{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    for (int k = 0; k < 12; ++k) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      const double bulge = 1e-16 * (2 - x * x - y * y);  // what rounding leaves of that
      roof.emplace_back(x, y, 1 - 1e-8 * std::fabs(x) + bulge);
    }
    for (const double x : {-1, 1})
      for (const double y : {-1, 1}) roof.emplace_back(x, y, 1 - 1e-8);
    const Model a = hull_of({roof, {}});
    const ConvexView& view = a.level(0).view;
    for (const Vertex& v : view.vertices) {
      const auto ring = view.half_edges.subspan(v.ring_begin, v.ring_count);
      inner += std::all_of(ring.begin(), ring.end(), [&](const HalfEdge& h) { return h.face == ring[0].face; });
    }
    const Pose pose = at(0, 0, 2 + 1e-6, shapes::rotation(random.on_sphere(), 1e-8));
    const Contacting c{a, plate, pose, nearest(a, plate, pose)};
    const Manifold p = manifold(a, plate, pose, c.answer, {.margin = 1e-3});
    expect_sound(c, p, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal), 1e-3);
  }
  EXPECT_GE(inner, 100);
}

/// Corners that rounding leaves beside a side, inside of a face or outside of it. A way to the border at right angles to that
/// side ended at one inside, since none beside it was farther out, and a single facet stood for the face. A corner inside of
/// the face across was taken for all that touches there.
TEST(Regress, ACornerBesideASideHidesTheFace) {
  Random random(33);
  const Model plate = bodies::model(bodies::box(3, 3, 1));
  for (const double noise : {2e-16, 1e-12, 1e-9}) {
    int missed = 0;
    for (int i = 0; i < 2000; ++i) {
      std::vector<Vec3> roof;
      for (const double x : {-1, 1})
        for (const double y : {-1, 1})
          for (const double z : {0, 1}) roof.emplace_back(x, y, z);
      for (int k = 0; k < 12; ++k) {
        const double x = k < 4 ? random.uniform(-1, 1) : (k % 2 ? 1 : -1) * (1 - noise * random.uniform());
        roof.emplace_back(x, random.uniform(-1, 1), 1 + noise * random.uniform());
      }
      const Mat3 turn = random.rotation();
      const Model a = hull_of({bodies::moved({roof, {}, {}}, turn).points, {}});
      Pose b_in_a;
      b_in_a.rotation = turn * shapes::rotation(random.on_sphere(), noise);
      b_in_a.translation = turn * Vec3(0, 0, 2 + 1e-6);
      const Manifold p = manifold(a, plate, b_in_a, nearest(a, plate, b_in_a), {.margin = 1e-3, .most_points = 8});
      missed += shown_area(p) < 3.9;
    }
    EXPECT_EQ(missed, 0) << noise;
  }
}

/// Faces of single precision are planes with a thickness; no point leaves its body for that.
TEST(Manifold, OfRoundedFacesLiesInBothBodies) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Mat3 turn = random.rotation();
    const bodies::Polyhedron a = bodies::float_rounded(bodies::moved(prism(5 + i % 8, 1, 1), turn)),
                             b = bodies::float_rounded(bodies::moved(prism(3 + i % 5, 1, 1), turn));
    Contacting c{hull_of({a.points, {}}), hull_of({b.points, {}}), {}, {}};
    c.b_in_a.translation = turn * Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 1 + 1e-6);
    c.answer = nearest(c.a, c.b, c.b_in_a);
    ASSERT_TRUE(is_apart(c)) << i;
    const Manifold p = manifold(c.a, c.b, c.b_in_a, c.answer, {.margin = 1e-5});
    expect_sound(c, p, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal), 1e-5);
    EXPECT_GE(p.count, 3u) << i;
  }
}

/// Corners that are two by rounding have sides without a direction; a cut along one of these would take half the face.
TEST(Manifold, OfFacesWithTinySidesIsAsWithout) {
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    bodies::Polyhedron a = prism(4, 1, 1);
    for (int k = 0; k < 8; ++k) a.points.push_back(a.points[k] + 1e-15 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0));
    const Mat3 turn = random.rotation();
    Contacting c{hull_of({bodies::moved(a, turn).points, {}}), bodies::model(bodies::moved(prism(5, 3, 1), turn)), {}, {}};
    c.b_in_a.translation = turn * Vec3(0, 0, 1 + 1e-9);
    c.answer = nearest(c.a, c.b, c.b_in_a);
    EXPECT_NEAR(shown_area(manifold(c.a, c.b, c.b_in_a, c.answer, {.margin = 1e-8})), 2, 1e-8) << i;
  }
}

/// A face merged of facets has a corner that lies 6e-14 inside of the side between its neighbours, and that side is crosswise
/// to the sweep: the neighbour behind it is no higher. A sweep that went by height alone lost half the area.
TEST(Manifold, OfAFaceWithACornerThatTurnsInwardsIsTheWholeFace) {
  const Model a = bodies::model(bodies::box(3, 3, 1));
  std::vector<Vec3> points;
  for (const double z : {0., 1.})
    for (const double y : {-1., 1.})
      for (const double x : {-1., 1.}) points.emplace_back(x, y, z);
  for (const auto& [x, y, z, turn] :
       {std::array{-0.8993439010196298, -1 + 5.9730201712238363e-14, -7.9387296541624455e-09, 2.3847514239454443e-14},
        std::array{0.84780495645623322, -1 + 1.7750549983543353e-10, -3.9206960890676559e-09, -6.8061168783520699e-11}}) {
    std::vector<Vec3> with = points;
    with.emplace_back(x, y, z);
    const Model b = hull_of({with, {}});
    const Pose pose = at(0.3, 0.1, 1.001, shapes::rotation(Vec3::UnitZ(), 1.5 * std::numbers::pi + std::atan2(9, 40) + turn));
    const Manifold p = manifold(a, b, pose, nearest(a, b, pose), {.margin = kInfinity, .most_points = 8});
    EXPECT_NEAR(shown_area(p), 4, 1e-6);
  }
}

/// B's corner lies on a side of A, which B's own side leaves by 1e-3 there: the corner and the crossing are 6e-14 apart, and
/// A's corner is on one line with them.
TEST(Manifold, OfCornersNearlyInOnePlaceKeepsTheThirdOnTheirLine) {
  const Model cube = bodies::model(bodies::cube());
  Pose pose;
  pose.rotation << 0x1.ffffc887ef22bp-1, -0x1.cfe1aa3f86a15p-10, -0x1.b672cf1d099c8p-12,  //
      0x1.cf9734be1c57fp-10, 0x1.ffff56ad11a1dp-1, -0x1.59ea9ec483174p-9,                 //
      0x1.bb57dea1ececp-12, 0x1.59d1a965cb924p-9, 0x1.ffff8836772f8p-1;
  pose.translation = {-0x1.8da149d68b9cp-9, 0x1.47f1f018ae35bp+0, 4};
  const Contacting c{cube, cube, pose, nearest(cube, cube, pose)};
  Shares shares;
  expect_true(c, shares);
  EXPECT_GE(shares.four, 0.9);
}

/// B's corner lies on a side of A within the bound, but no side of B crosses A's within it; and the deepest points are a corner
/// of each body in one place, 4e-16 apart: one of them alone is a point.
TEST(Manifold, OfCornersOnSidesLosesNone) {
  const Model cube = bodies::model(bodies::cube());
  Pose on_side, in_place;
  on_side.rotation << 0x1.ffffffffff2fbp-1, -0x1.781d8697d4f53p-22, 0x1.a5d32edf4985ap-21,  //
      0x1.781d74551f03bp-22, 0x1.ffffffffffbecp-1, 0x1.62a0af198500ep-22,                   //
      -0x1.a5d332f1531f8p-21, -0x1.62a09bbb8ec5p-22, 0x1.ffffffffff338p-1;
  on_side.translation = {-0x1.10c5f89970e4p-6, 0x1.57e23062p-21, 4};
  in_place.rotation << 0x1.fe4e834ee0827p-1, -0x1.278aa72cf2c06p-4, -0x1.323b1bb7bcddfp-5,  //
      0x1.2c15c5610fd24p-4, 0x1.fe67b543979b4p-1, 0x1.de7ab91254bc3p-6,                     //
      0x1.2003d35b5ba4fp-5, -0x1.04e243d7cb78p-5, 0x1.ff6c717d6813dp-1;
  in_place.translation = {-0x1.ee61744339c24p-6, 0x1.b076c98948644p-4, 4};
  for (const Pose& pose : {on_side, in_place}) {
    for (const Answer& answer : {nearest(cube, cube, pose), signed_distance(cube, cube, pose)}) {
      Shares shares;
      expect_true({cube, cube, pose, answer}, shares);
      EXPECT_GE(shares.four, 0.8);
    }
  }
}

/// A triangle or a quadrilateral whose corners lie on a lattice of 4 by 4 places, counter-clockwise.
std::vector<Eigen::Vector2d> on_lattice(Random& random) {
  for (;;) {
    std::vector<Eigen::Vector2d> p;
    const auto corners = 3 + random.bits() % 2;
    for (std::size_t i = 0; i < corners; ++i) p.emplace_back(double(random.bits() % 4), double(random.bits() % 4));
    const auto turns = [&](std::size_t i) {
      const Eigen::Vector2d u = p[(i + 1) % corners] - p[i], v = p[(i + 2) % corners] - p[(i + 1) % corners];
      return u.x() * v.y() - u.y() * v.x() > 0;
    };
    bool is_convex = true;
    for (std::size_t i = 0; i < corners; ++i) is_convex &= turns(i);
    if (is_convex) return p;
  }
}

/// Corners lie on corners and on sides, and sides on sides, up to rounding, as often as lattices make them.
TEST(Manifold, OfFourSidesOnALatticeIsTheIntersectionOfTheirFaces) {
  Random random(41);
  Shares shares;
  int sides[2] = {};
  for (int i = 0; i < 1500; ++i) {
    const auto a = on_lattice(random), b = on_lattice(random);
    const Pose on_top = at(double(random.bits() % 3) - 1, double(random.bits() % 3) - 1, 0);
    const Contacting c = stacked(prism(a, 1), 0.5, prism(b, 1), on_top, any(kGaps, random),
                                 random.bits() % 4 ? random.rotation() : Mat3::Identity());
    ++sides[a.size() == 4], ++sides[b.size() == 4];
    if (is_apart(c)) expect_true(c, shares);
    ASSERT_FALSE(testing::Test::HasFailure()) << i;
  }
  EXPECT_GE(std::min(sides[0], sides[1]), 400);
  EXPECT_GE(shares.counted, 800);
  std::printf("%d areas: four points keep at least %.3f, eight %.3f\n", shares.counted, shares.four, shares.eight);
  EXPECT_GE(shares.four, 0.6);
  EXPECT_GE(shares.eight, 0.9999);
}

/// Beyond a corner a place may be within a bound of the lines of both sides, but not of the sides: the sharper the corner, the
/// farther.
TEST(Manifold, AtRestMissesNoFaceByMoreThanTwiceItsFlatness) {
  using Corners = std::vector<Eigen::Vector2d>;
  int beside = 0, beyond = 0;
  for (const Corners& corners : {Corners{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, Corners{{0, 0}, {8, -0.25}, {8, 0.25}},
                                 Corners{{0, 0}, {4, -0.5}, {8, 0}, {4, 0.5}}}) {
    const Model body = bodies::model(prism(corners, 1));
    const double slack = 2 * ManifoldOptions{}.flatness * body.level(0).view.extent;
    const auto miss = [&](const Vec3& own) {  // of the face by a point
      double out = -kInfinity;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d from = corners[i], side = corners[(i + 1) % corners.size()] - from, way = own.head<2>() - from;
        if (side.x() * way.y() - side.y() * way.x() >= 0) continue;
        const double t = std::clamp(way.dot(side) / side.squaredNorm(), 0., 1.), distance = (way - t * side).norm();
        out = out == -kInfinity ? distance : std::min(out, distance);
      }
      return std::max(out, 0.);
    };
    const double height = body.box_max().z() - body.box_min().z() + 1e-3;
    const auto asked_at = [&](double x, double y, const Manifold& before) {
      const Pose pose = at(x, y, height);
      return manifold(body, body, pose, nearest(body, body, pose), {.margin = kInfinity}, before);
    };
    const Manifold flush = asked_at(0, 0, {});
    for (int turn = 0; turn < 64; ++turn) {
      for (const double share : {0.3, 0.7, 0.9, 1.2, 5., 20.}) {
        const double x = share * slack * std::cos(turn * 0.1), y = share * slack * std::sin(turn * 0.1);
        const Manifold now = asked_at(x, y, flush);
        ASSERT_GT(now.count, 0u);
        for (std::uint32_t i = 0; i < now.count; ++i) {
          const double of_a = miss(now.points[i].point_a), of_b = miss(now.points[i].point_b - Vec3(x, y, 0));
          EXPECT_LE(std::max(of_a, of_b), slack * 1.000001) << corners.size() << " corners, " << share << ", turn " << turn;
          beside += std::max(of_a, of_b) > 0.2 * slack;
        }
        beyond += share > 1;
      }
    }
  }
  EXPECT_GE(beside, 200);
  EXPECT_GE(beyond, 500);
}

/// Tips that are farthest apart are not the corners to keep.
TEST(Manifold, OfALongFaceKeepsItsShoulders) {
  bodies::Polyhedron hexagon;
  for (const double z : {-1., 1.}) {
    for (const auto& [x, y] : {std::pair{11., 0.}, std::pair{10., 0.5}, std::pair{-10., 0.5}, std::pair{-11., 0.},
                               std::pair{-10., -0.5}, std::pair{10., -0.5}})
      hexagon.points.emplace_back(x, y, z);
  }
  const Model a = hull_of({hexagon.points, {}}), b = bodies::model(bodies::box(20, 20, 1));
  EXPECT_GE(shown_area(touching(a, b, at(0, 0, 2))), 0.7 * 21);
}

TEST(Manifold, OfFacesOfAThousandSidesKeepsTheirArea) {
  const Model round = bodies::model(prism(1000, 1, 1));
  Pose b_in_a;
  b_in_a.translation = {0.1, 0.2, 1};
  ManifoldOptions options{.most_points = 8};
  const Contacting c{round, round, b_in_a, nearest(round, round, b_in_a)};
  const Manifold p = manifold(round, round, b_in_a, c.answer, options);
  expect_sound(c, p, 0, 0);
  EXPECT_EQ(p.count, 8u);
  const Contacting tilted = stacked(prism(1000, 1, 1), 0.5, prism(1000, 1, 1),
                                    at(0.1, 0.2, 0, shapes::rotation({0.6, 0.8, 0}, 1e-4)), 1e-3, Mat3::Identity());
  options.margin = kInfinity;
  expect_sound(tilted, manifold(tilted.a, tilted.b, tilted.b_in_a, tilted.answer, options), tilted.answer.lower, kInfinity);
  // Two circles of radius 1 whose centres are sqrt(0.05) apart.
  const double d = std::sqrt(0.05), lens = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
  EXPECT_GE(shown_area(p), 0.88 * lens);
}

/// Sides that together turn aside by less than the flatness: each was held against all that follow, 24 ms for 1 600 of them.
TEST(Manifold, OfSidesNearlyOnOneLineCostsTheirSum) {
  const auto cheapest = [](int sides) {
    std::vector<Vec3> points;
    for (const double z : {0., 1.}) {
      for (int i = 0; i < sides / 2; ++i) {
        const double x = -1 + 2. * i / (sides / 2 - 1), y = 1 + 1e-7 * (1 - x * x);
        points.emplace_back(x, y, z), points.emplace_back(x, -y, z);
      }
    }
    const Model model = hull_of({points, {}});
    const Pose pose = at(0.01, 0.02, 1, shapes::rotation(Vec3::UnitZ(), 0.3));
    const Answer answer = nearest(model, model, pose);
    double least = kInfinity;
    for (int round = 0; round < 9; ++round) {
      const auto begin = std::chrono::steady_clock::now();
      const Manifold p = manifold(model, model, pose, answer, {.margin = 1e-3});
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      EXPECT_EQ(p.count, 4u);
    }
    return least;
  };
  EXPECT_LE(cheapest(600), 9 * cheapest(150));  // four times as many sides
}

/// A round face, and beside each of its sides a triangle that falls by too little to lie elsewhere. The contact face is one of
/// these; at each corner of the border the round face is asked whether it belongs to it.
TEST(Manifold, OfSliversAroundAFaceCostsTheirSum) {
  const Model plate = bodies::model(bodies::box(3, 3, 0.5));
  const auto cheapest = [&](std::uint32_t sides) {
    const double turn = std::numbers::pi / sides, bulge = (1 - std::cos(turn)) / 2;
    const auto on_circle = [&](std::uint32_t i, double scale, double z) {
      const double radius = scale * (i % 2 ? 1 - bulge : 1);
      return Vec3(radius * std::cos(i * turn), radius * std::sin(i * turn), z);
    };
    bodies::Polyhedron coin;
    for (std::uint32_t i = 0; i < 2 * sides; ++i) coin.points.push_back(on_circle(i, 1, i % 2 ? -1e-7 * bulge : 0));
    for (std::uint32_t i = 0; i < 2 * sides; ++i) coin.points.push_back(on_circle(i, 0.5, -1));
    for (std::uint32_t i = 0; i < sides; ++i) coin.corners.push_back(2 * i);
    for (std::uint32_t i = 0; i < 2 * sides; ++i) coin.corners.push_back(4 * sides - 1 - i);
    coin.sizes = {sides, 2 * sides};
    for (std::uint32_t i = 0; i < 2 * sides; i += 2) {
      const std::uint32_t tip = i + 1, next = (i + 2) % (2 * sides), low = 2 * sides;
      coin.add({i, tip, next}), coin.add({i, low + i, low + tip}), coin.add({i, low + tip, tip});
      coin.add({tip, low + tip, next}), coin.add({next, low + tip, low + next});
    }
    const Model model = std::move(Model::from_level(coin.level(), {true, {}})).value();
    const Mat3 tilt = shapes::rotation(Vec3(-std::sin(turn), std::cos(turn), 0), 2e-6);
    const Pose pose = at(0, 0, 0.501, tilt);
    const Answer answer = nearest(model, plate, pose);
    double least = kInfinity;
    for (int round = 0; round < 9; ++round) {
      const auto begin = std::chrono::steady_clock::now();
      const Manifold p = manifold(model, plate, pose, answer, {.margin = 1});
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      EXPECT_EQ(p.count, 4u);
    }
    return least;
  };
  EXPECT_LE(cheapest(1024), 9 * cheapest(256));  // four times as many sides
}

/// Of many corners few are candidates: beside all of them by brute force, a few points keep as much as the header says. Round
/// and stretched faces, anywhere on one another, down to lenses of a thousandth of their width.
TEST(Manifold, OfManySidesKeepsTheSharesOfTheHeader) {
  Random random(18);
  constexpr double kLeast[] = {0, 0, 0, 0.28, 0.5, 0, 0, 0, 0.78}, kRound[] = {0, 0, 0, 0, 0.6, 0, 0, 0, 0.87};
  double worst[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  int asked = 0;
  for (int i = 0; i < 60; ++i) {
    const std::uint32_t sides = i == 0 ? 1000 : 60 + std::uint32_t(random.bits() % 60);
    const double stretch = i % 3 ? std::pow(10, random.uniform(-1.5, 0)) : 1, twist = i % 2 ? 0 : random.uniform(-0.1, 0.1);
    const Mat3 scale = Vec3(1, stretch, 1).asDiagonal();
    const Model face = bodies::model(bodies::moved(prism(sides, 1, 1), scale));
    const double away = i % 4 == 0 ? 1e-3 : 2 - std::pow(10, random.uniform(-3, 0)), angle = random.uniform(0, 6);
    const Pose pose = at(away * std::cos(angle), stretch * away * std::sin(angle), 1 + 1e-9,
                         shapes::rotation(Vec3::UnitZ(), std::numbers::pi / 50 * random.uniform() * (stretch == 1) + twist));
    const Contacting c{face, face, pose, nearest(face, face, pose)};
    if (!is_apart(c)) continue;
    ManifoldOptions options{.margin = 1e-6};
    double truth = 0;
    for (const std::uint32_t most : {3u, 4u, 8u}) {
      options.most_points = most;
      const Manifold p = manifold(c.a, c.b, pose, c.answer, options);
      if (p.face_a.kind() != FeatureKind::Face || p.face_b.kind() != FeatureKind::Face) break;
      expect_sound(c, p, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal), 1e-6);
      const ConvexView& view = c.a.level(0).view;
      if (truth == 0) truth = oracle::overlay(view, {p.face_a.index()}, view, {p.face_b.index()}, pose, p.normal).area;
      if (truth < 1e-9) break;
      ++asked;
      const double share = shown_area(p) / truth;
      worst[most] = std::min(worst[most], share);
      EXPECT_GE(share, i % 4 == 0 ? std::max(kLeast[most], kRound[most]) : kLeast[most]) << i << ": " << most << " points";
      EXPECT_LE(share, 1 + 1e-9) << i;
    }
  }
  std::printf("three points keep at least %.3f, four %.3f, eight %.3f\n", worst[3], worst[4], worst[8]);
  EXPECT_GE(asked, 150);
}

/// A roof of merged faces on a wide box.
struct Roof {
  std::vector<Vec3> base;
  Model model;
  Pose pose = at(0, 0, 1 + 1e-6);

  /// `ridge`: above `base`, 1e-8 high.
  Roof(const std::vector<Vec3>& corners, const Vec3& ridge) : base(corners), model(hull_of({ends(corners, ridge), {}})) {}
  static std::vector<Vec3> ends(const std::vector<Vec3>& base, const Vec3& ridge) {
    std::vector<Vec3> points{ridge - 1e-8 * Vec3::UnitZ()};
    for (const Vec3& p : base) points.push_back(p), points.push_back(p + Vec3::UnitZ());
    return points;
  }
  /// The share of the base that so many points keep.
  double share(std::uint32_t most) const {
    static const Model ground = bodies::model(bodies::box(3, 3, 1));
    const Answer answer = nearest(ground, model, pose);
    const Manifold p = manifold(ground, model, pose, answer, {.margin = 1e-3, .most_points = most});
    expect_sound({ground, model, pose, answer}, p, (answer.point_b - answer.point_a).dot(answer.normal), 1e-3);
    EXPECT_EQ(p.count, std::min(most, std::uint32_t(base.size()) + 1));
    return shown_area(p) / oracle::area(base, Vec3::UnitZ());
  }
};

/// Its ridge a point somewhere inside: beside that, the others keep what one fewer does.
TEST(Manifold, OfARoofKeepsTheShareOfOnePointFewer) {
  Random random(20);
  constexpr double kLeast[] = {0, 0, 0, 0, 0.28, 0.5, 0, 0, 0.75};
  double worst[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  for (int i = 0; i < 60; ++i) {
    const int sides = 3 + i % 15;
    const double stretch = std::pow(10, random.uniform(-1, 0));
    std::vector<Vec3> base;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random.uniform(0, 0.9)) / sides;
      base.emplace_back(std::cos(angle), stretch * std::sin(angle), 0);
    }
    Vec3 ridge = Vec3::Zero();
    double sum = 0;
    for (const Vec3& p : base) {
      const double weight = std::pow(random.uniform(), 3);
      ridge += weight * p, sum += weight;
    }
    const Roof roof(base, ridge / sum);
    for (const std::uint32_t most : {4u, 5u, 8u}) {
      worst[most] = std::min(worst[most], roof.share(most));
      EXPECT_GE(worst[most], kLeast[most]) << i;
    }
  }
  std::printf("under a roof four points keep at least %.3f, five %.3f, eight %.3f\n", worst[4], worst[5], worst[8]);
}

/// Its ridge beside a corner of a square, which four points then nearly keep: the ridge stands for the corner.
TEST(Manifold, OfARoofKeepsASquareWhoseCornerTheRidgeIsBeside) {
  const std::vector<Vec3> square{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  for (const double beside : {1e-6, 1e-4, 1e-2, 0.1})
    EXPECT_GE(Roof(square, {1 - beside, 1 - beside / 3, 0}).share(4), 1 - beside) << beside;
}

/// A roof of merged faces whose ridge goes on beyond the other face: the deepest point is where it passes that one's border, on
/// a side of the area. It counted as one inside, and 0.52 of a long area was left.
TEST(Manifold, OfARidgeThatPassesTheBorderKeepsTheShareOfAllPoints) {
  Random random(21);
  double worst = 1;
  for (int i = 0; i < 100; ++i) {
    const double ridge = random.uniform(-0.1, 0.1), stretch = std::pow(10, random.uniform(-1.5, 0));
    std::vector<Vec3> roof;
    for (const double x : {-2, 2}) {
      for (const double y : {-2, 2}) roof.emplace_back(x, y, 0), roof.emplace_back(x, y, 1);
      roof.emplace_back(x, ridge * x, -1e-8);
    }
    bodies::Polyhedron ground = prism(6 + random.bits() % 9, 1, 1);
    for (Vec3& p : ground.points) p.y() *= stretch;
    const double turn = random.uniform(0, 7), lean = random.uniform(0, 7);
    const Mat3 rotation = shapes::rotation({std::cos(lean), std::sin(lean), 0}, 2e-9) * shapes::rotation(Vec3::UnitZ(), turn);
    const Model a = bodies::model(ground), b = hull_of({roof, {}});
    const Pose pose = at(0, 0, 0.5 + 1e-6, rotation);
    const Contacting c{a, b, pose, nearest(a, b, pose)};
    const Manifold four = manifold(a, b, pose, c.answer, {.margin = 1e-3});
    expect_sound(c, four, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal), 1e-3);
    worst = std::min(worst, shown_area(four) / oracle::area(ground.points, Vec3::UnitZ()));
    EXPECT_GE(worst, 0.57) << i;
  }
  std::printf("where a ridge passes the border four points keep at least %.3f\n", worst);
}

TEST(Manifold, OfSliversIsTheIntersectionOfTheirFaces) {
  Random random(5);
  Shares shares;
  for (int i = 0; i < 300; ++i) {
    const double thin = any(std::array{1e-3, 1e-5, 1e-7}, random);
    const bodies::Polyhedron sliver{{{0, 0, 0}, {1, 0, 0}, {random.uniform(), thin, 0}, {0.5, thin / 3, 1}}, {}, {}};
    const Model b = hull_of({sliver.points, {}});
    Contacting c{bodies::model(bodies::box(1, random.uniform() * thin, 1)), b, {}, {}};
    c.b_in_a.rotation = shapes::rotation(Vec3::UnitZ(), any(kAngles, random));
    c.b_in_a.translation = {0, 0, 1 + any(kGaps, random)};
    c.answer = nearest(c.a, c.b, c.b_in_a);
    SCOPED_TRACE(i);
    ASSERT_TRUE(is_apart(c));
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  expect_much_kept(shares);
}

/// A cube of many squares, turned, has triangles along its edges as thin as rounding. Their planes were rounding too, as
/// doubles computed them: such a triangle was the contact face where it seemed to face best, and nearly nothing was left of the
/// area.
TEST(Manifold, GrowsFromTheFaceThatFacesBestBesideSlivers) {
  Random random(33);
  const Model plate = bodies::model(bodies::box(3, 3, 1));
  for (int i = 0; i < 400; ++i) {
    const Model cube =
        hull_of(shapes::moved(shapes::meshed_cube(2 + random.bits() % 4), {random.rotation(), random.in_ball()}));
    const Pose pose = at(5, 0, 0, random.rotation());
    const Answer answer = nearest(cube, plate, pose);
    const Manifold p = manifold(cube, plate, pose, answer, {.margin = kInfinity});
    ASSERT_TRUE(oracle::faces_best(cube.level(0).view, answer.normal, answer.feature_a, p.face_a)) << i;
  }
}

// ---- Edges and corners ------------------------------------------------------------------------------------------------------

const Mat3 kEighthAboutX = shapes::rotation(Vec3::UnitX(), std::numbers::pi / 4),
           kQuarterAboutZ = shapes::rotation(Vec3::UnitZ(), std::numbers::pi / 2);

TEST(Manifold, OfAnyLargerFlatnessIsThatOfTheLargest) {
  const double height = 2 * kMostFlatness;
  std::vector<Vec3> points{{-1, 0, 1}, {1, 0, 1}};
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? -1 : 1 - height);
  const Model roof = hull_of({points, {}}), plate = bodies::model(bodies::box(3, 3, 1));
  const Pose pose = at(0, 0, 2 + 1e-9);
  const Answer answer = nearest(roof, plate, pose);
  const Manifold largest = manifold(roof, plate, pose, answer, {.margin = 1, .flatness = kMostFlatness});
  EXPECT_NEAR(shown_area(largest), 2, 1e-6) << "one side of the roof";
  for (const double flatness : {2 * kMostFlatness, 1.0, kInfinity}) {
    const Manifold larger = manifold(roof, plate, pose, answer, {.margin = 1, .flatness = flatness});
    ASSERT_EQ(larger.count, largest.count) << flatness;
    for (std::uint32_t k = 0; k < larger.count; ++k) EXPECT_EQ(larger.points[k].point_a, largest.points[k].point_a) << flatness;
  }
}

TEST(Manifold, OfAnEdgeOnAFaceIsItsTwoEnds) {
  const Model cube = bodies::model(bodies::cube());
  const Manifold p = touching(cube, cube, at(0.5, 0, 1 + std::sqrt(2), kEighthAboutX));
  ASSERT_EQ(p.count, 2u);
  EXPECT_NEAR((p.points[1].point_a - p.points[0].point_a).norm(), 1.5, 1e-14);
}

TEST(Manifold, OfCrossingEdgesIsTheirCrossing) {
  const bodies::Polyhedron ridge = bodies::moved(bodies::cube(), kEighthAboutX);
  const Model a = bodies::model(ridge), b = bodies::model(bodies::moved(ridge, kQuarterAboutZ));
  const Manifold p = touching(a, b, at(0.25, 0.5, 2 * std::sqrt(2)));
  ASSERT_EQ(p.count, 1u);
  EXPECT_EQ(p.points[0].feature_a.kind(), FeatureKind::Edge);
  EXPECT_EQ(p.points[0].feature_b.kind(), FeatureKind::Edge);
  EXPECT_LE((p.points[0].point_a - Vec3(0.25, 0, std::sqrt(2))).norm(), 1e-14);
}

TEST(Manifold, OfEdgesAlongOneAnotherIsTwoPoints) {
  const Model a = bodies::model(bodies::moved(bodies::cube(), kEighthAboutX));
  const Manifold p = touching(a, a, at(0.5, 0, 2 * std::sqrt(2)));
  ASSERT_EQ(p.count, 2u);
  EXPECT_NEAR((p.points[1].point_a - p.points[0].point_a).norm(), 1.5, 1e-13);
}

TEST(Manifold, OfACornerIsTheCorner) {
  const Model cube = bodies::model(bodies::cube()), octahedron = bodies::model(bodies::octahedron());
  const Manifold on_face = touching(cube, octahedron, at(0.5, 0, 2));
  ASSERT_EQ(on_face.count, 1u);
  EXPECT_EQ(on_face.points[0].feature_b.kind(), FeatureKind::Vertex);
  EXPECT_EQ(on_face.points[0].feature_a, on_face.face_a);
  EXPECT_EQ(touching(octahedron, octahedron, at(0, 0, 2)).count, 1u);  // corner on corner
  EXPECT_EQ(touching(cube, cube, at(2, 2, 2)).count, 1u);
}

/// Bodies of one dimension less than solids, seen flat and from the side.
TEST(Manifold, OfFlatBodiesIsTheirPartOfTheFace) {
  const Model cube = bodies::model(bodies::cube()),
              square = bodies::model(bodies::two_sided({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})),
              segment = bodies::model(bodies::segment({-3, 0, 0}, {3, 0, 0})), point = bodies::model(bodies::point({0, 0, 0}));
  const Mat3 upright = shapes::rotation(Vec3::UnitX(), std::numbers::pi / 2);
  EXPECT_NEAR(shown_area(touching(cube, square, at(0.5, 0, 1))), 3, 1e-14);
  EXPECT_NEAR(shown_area(touching(square, cube, at(0.5, 0, -1))), 3, 1e-14);
  EXPECT_NEAR(shown_area(touching(square, square, at(0.5, 0, 0))), 3, 1e-14);
  for (const auto& [a, b, pose, count] :
       {std::tuple{&cube, &square, at(0.5, 0, 2, upright), 2u}, std::tuple{&cube, &segment, at(0, 0.5, 1), 2u},
        std::tuple{&segment, &cube, at(0, 0.5, 1), 2u}, std::tuple{&cube, &point, at(0, 0.5, 1), 1u},
        std::tuple{&point, &cube, at(0, 0.5, 1), 1u}, std::tuple{&square, &point, at(0, 0.5, 0), 1u}}) {
    EXPECT_EQ(touching(*a, *b, pose).count, count);
  }
  EXPECT_EQ(touching(segment, segment, at(0, 0, 0, kQuarterAboutZ)).count, 1u);
  const Mat3 across = kQuarterAboutZ * upright;
  for (const double x : {-0.5, 0., 0.7}) {  // upright on upright: edges that cross, and edges along one another
    Contacting c{square, square, at(x, 0.3, 2 + 1e-12, upright.transpose() * across), {}};
    c.a = bodies::model(
        bodies::moved({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 1, 2, 3, 3, 2, 1, 0}, {4, 4}}, upright));
    c.b_in_a.rotation = across;
    c.answer = nearest(c.a, c.b, c.b_in_a);
    const ManifoldOptions options{.margin = 1e-9};
    const Manifold p = manifold(c.a, c.b, c.b_in_a, c.answer, options);
    expect_sound(c, p, 1e-12, 1e-9);
    EXPECT_EQ(p.count, 1u);
    c.b_in_a.rotation = upright;
    c.b_in_a.translation = {x, 0, 2 + 1e-12};
    c.answer = nearest(c.a, c.b, c.b_in_a);
    const Manifold along = manifold(c.a, c.b, c.b_in_a, c.answer, options);
    expect_sound(c, along, 1e-12, 1e-9);
    EXPECT_EQ(along.count, 2u);
  }
  EXPECT_EQ(touching(segment, segment, at(1, 0, 0)).count, 2u);
  EXPECT_EQ(touching(point, point, at(0, 0, 0)).count, 1u);
}

// ---- What is asked for ------------------------------------------------------------------------------------------------------

TEST(Manifold, HoldsWhatIsNearEnough) {
  const Model cube = bodies::model(bodies::cube());
  const double tilt = 1e-3;  // of 2: the far side is 2e-3 higher
  const Mat3 rotation = shapes::rotation(Vec3::UnitY(), tilt);
  const Contacting c{cube, cube, at(0, 0, 2.01, rotation), nearest(cube, cube, at(0, 0, 2.01, rotation))};
  const auto count = [&](double margin) { return manifold(c.a, c.b, c.b_in_a, c.answer, {.margin = margin}).count; };
  EXPECT_EQ(count(0), 0u);
  EXPECT_EQ(count(c.answer.lower - 1e-12), 0u);
  EXPECT_EQ(count(c.answer.upper), 2u);
  EXPECT_EQ(count(c.answer.upper + 1.9e-3), 2u);
  EXPECT_EQ(count(c.answer.upper + 2.1e-3), 4u);
}

/// Neither of the two beside the deepest can be bettered alone; both together can.
TEST(Manifold, OfThreePointsKeepsAFifth) {
  Random random(15);
  double least = 1;
  int counted = 0;
  Manifold before;
  for (int i = 0; i < 400; ++i) {
    const bodies::Polyhedron a = bodies::box(1, random.uniform(0.1, 1), 0.5), b = prism(3 + std::uint32_t(i % 10), 1, 1);
    const Contacting c =
        stacked(a, 0.5, b, random_top(random, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)), 1e-3, Mat3::Identity());
    if (!is_apart(c)) continue;
    ManifoldOptions options{.margin = kInfinity, .most_points = 3};
    before = manifold(c.a, c.b, c.b_in_a, c.answer, options, before);
    options.most_points = 8;
    const double eight = shown_area(manifold(c.a, c.b, c.b_in_a, c.answer, options));
    if (eight < 1e-3) continue;
    least = std::min(least, shown_area(before) / eight);
    ++counted;
  }
  EXPECT_GE(counted, 100);
  EXPECT_GE(least, 0.197);
  std::printf("%d areas: three points keep at least %.3f of what eight do\n", counted, least);
}

TEST(Manifold, HoldsAsManyPointsAsAskedFor) {
  const Model cube = bodies::model(bodies::cube());
  const Pose b_in_a = at(0, 0, 2, shapes::rotation(Vec3::UnitZ(), std::numbers::pi / 4));
  const Answer answer = nearest(cube, cube, b_in_a);
  double before = -1;
  for (const std::uint32_t most : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 100u}) {
    const Manifold p = manifold(cube, cube, b_in_a, answer, {.most_points = most});
    EXPECT_EQ(p.count, std::min(most, 8u));
    EXPECT_GE(shown_area(p), before);
    before = shown_area(p);
  }
  EXPECT_NEAR(before, 8 * (std::sqrt(2) - 1), 1e-14);  // a regular octagon of inradius 1
}

TEST(Manifold, OfOverlappingBodiesNeedsADirection) {
  const Model cube = bodies::model(bodies::cube());
  EXPECT_EQ(manifold(cube, cube, at(0, 0, 1), nearest(cube, cube, at(0, 0, 1))).count, 0u);
}

// ---- What nobody should ask -------------------------------------------------------------------------------------------------

/// Counts, names and numbers that no manifold has.
Manifold absurd(Random& random) {
  Manifold p;
  p.count = std::uint32_t(random.bits());
  p.face_a = {FeatureKind::Face, 1u << 29}, p.face_b = {FeatureKind::Edge, 3};
  p.normal.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (ManifoldPoint& q : p.points) {
    q.feature_a = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 9)};
    q.feature_b = {FeatureKind(random.bits() % 4), std::uint32_t(random.bits() % 9)};
    q.point_a = q.point_b = p.normal;
  }
  return p;
}

/// Needles, slivers, flat bodies and round ones in themselves and in each other, from the least sizes to the largest.
TEST(Manifold, IsSoundOfAnyBodiesAndAnyManifoldBefore) {
  Random random(13);
  for (const double scale : {1., 1e-40, 1e40}) {
    std::vector<Model> models;
    for (const Mesh& mesh :
         {shapes::cube(), shapes::needle(), shapes::sliver(), shapes::polygon(7), shapes::segment(2), shapes::point(),
          shapes::prism(100, 1, 1), shapes::prism(12, 1e-6, 1), shapes::prism(9, 1, 1e-9)}) {
      Mesh scaled = mesh;
      for (Vec3& p : scaled.points) p *= scale;
      models.push_back(hull_of(scaled));
    }
    for (const Model& a : models) {
      for (const Model& b : models) {
        Pose pose;
        if (random.bits() % 2) pose.rotation = random.rotation(), pose.translation = scale * random.in_ball();
        const Answer deep = signed_distance(a, b, pose);
        ASSERT_EQ(deep.status, Status::Converged);
        Contacting c{a, b, pose, {}};
        c.answer.normal = deep.normal;
        ManifoldOptions options{.margin = kInfinity, .most_points = 1 + std::uint32_t(random.bits() % 12)};
        expect_sound(c, manifold(a, b, pose, deep, options, absurd(random)), deep.lower, kInfinity);
        options.flatness = any(std::array{0., 1e-3, kInfinity, -1., std::numeric_limits<double>::quiet_NaN()}, random);
        expect_sound(c, manifold(a, b, pose, deep, options, absurd(random)), deep.lower, kInfinity);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

/// As faces of many sides are halved: of any size, flush, turned or tilted, after manifolds that name any of their features.
TEST(Manifold, OfManySidesIsSoundAfterAnyManifoldBefore) {
  Random random(29);
  int full = 0;
  for (const double scale : {1., 1e-40, 1e40}) {
    const Mat3 turn = random.rotation();
    const Model round = bodies::model(bodies::moved(prism(260, 1, 1), scale * turn)),
                few = bodies::model(bodies::moved(prism(6, 1.2, 1), scale * turn));
    for (int i = 0; i < 20; ++i) {
      const Model& under = i % 3 == 0 ? few : round;
      Pose pose = random_top(random, random.uniform(-1.5, 1.5), random.uniform(-1, 1));
      pose.rotation = turn * pose.rotation * turn.transpose();
      pose.translation = scale * turn * (pose.translation + Vec3(0, 0, 1.5));
      const Answer far = nearest(under, round, pose);
      if (far.normal.hasNaN()) continue;
      pose.translation -= (far.lower + (i % 2 ? 1e-4 : -1e-6) * scale) * far.normal;
      Contacting c{under, round, pose, signed_distance(under, round, pose)};
      Manifold before = absurd(random);
      before.count = kMostManifoldPoints;
      for (ManifoldPoint& p : before.points) {
        const auto any_of = [&](const Model& m) {
          const ConvexView& view = m.level(0).view;
          const auto kind = 1 + random.bits() % 3;
          const std::size_t count = kind == 1 ? view.vertices.size() : kind == 2 ? view.half_edges.size() : 1;
          return FeatureId(FeatureKind(kind), std::uint32_t(random.bits() % count));
        };
        p.feature_a = any_of(under), p.feature_b = any_of(round);
      }
      const ManifoldOptions options{.margin = scale * std::pow(10, random.uniform(-6, 0)),
                                    .most_points = 1 + std::uint32_t(random.bits() % kMostManifoldPoints)};
      const Manifold p = manifold(under, round, pose, c.answer, options, before);
      expect_sound(c, p, c.answer.lower, options.margin);
      full += p.count > 2;
      ASSERT_FALSE(testing::Test::HasFailure()) << scale << ' ' << i;
    }
  }
  EXPECT_GE(full, 15);
}

TEST(Manifold, OfAnAnswerOfOtherModelsIsNone) {
  const Model whole = hull_of(shapes::ellipsoid({1, 1, 0.5}, 2000, 3)), cut = whole.cut({0.1}),
              cube = bodies::model(bodies::cube());
  ASSERT_GT(cut.finest_level(), 0);
  const Pose pose = at(0.3, 0.2, 0.7);
  const Answer exact = signed_distance(whole, whole, pose);
  ManifoldOptions options{.margin = kInfinity};
  EXPECT_GT(manifold(whole, whole, pose, exact, options).count, 0u);
  EXPECT_EQ(manifold(cut, whole, pose, exact, options).count, 0u);
  EXPECT_EQ(manifold(whole, cut, pose, exact, options).count, 0u);
  EXPECT_GT(manifold(cut, cut, pose, signed_distance(cut, cut, pose), options).count, 0u);
  EXPECT_EQ(manifold({whole, 0.1}, whole, pose, exact, options).count, 0u);
  EXPECT_EQ(manifold(whole, whole, pose, signed_distance({whole, 0.1}, whole, pose), options).count, 0u);
  Answer wrong = exact;
  wrong.level_a = -1;
  EXPECT_EQ(manifold(whole, whole, pose, wrong, options).count, 0u);
  wrong = exact;
  wrong.feature_b = {FeatureKind::Face, 1u << 29};
  EXPECT_EQ(manifold(cube, cube, pose, wrong, options).count, 0u);
  wrong = exact;
  wrong.normal.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(manifold(whole, whole, pose, wrong, options).count, 0u);
  for (const double absurd : {std::numeric_limits<double>::quiet_NaN(), -kInfinity}) {
    options.margin = absurd;
    EXPECT_EQ(manifold(whole, whole, pose, exact, options).count, 0u);
  }
}

/// Points chosen anew beside those of the manifold before move no more.
TEST(Manifold, OfTheSamePoseStays) {
  Random random(14);
  int asked = 0;
  for (int i = 0; i < 100; ++i) {
    const Contacting c = i % 2 ? stacked_prisms(random, 12, 7) : stacked_boxes(random);
    if (!is_apart(c)) continue;
    ++asked;
    const ManifoldOptions options{.margin = kInfinity, .most_points = 3 + std::uint32_t(i % 6)};
    const Manifold first = manifold(c.a, c.b, c.b_in_a, c.answer, options),
                   again = manifold(c.a, c.b, c.b_in_a, c.answer, options, first);
    ASSERT_EQ(first.count, again.count);
    for (std::uint32_t k = 0; k < first.count; ++k) {
      const bool kept = std::any_of(again.points.begin(), again.points.begin() + again.count, [&](const ManifoldPoint& p) {
        return p.feature_a == first.points[k].feature_a && p.feature_b == first.points[k].feature_b;
      });
      EXPECT_TRUE(kept) << i;
    }
  }
  EXPECT_GE(asked, 90);
}

// ---- Laws -------------------------------------------------------------------------------------------------------------------

/// B moved along the normal changes the separations by that and nothing else: bodies that overlap have the same manifold.
TEST(Manifold, IsTheSameAtAnyDepth) {
  Random random(6);
  int asked = 0;
  for (int i = 0; i < 300; ++i) {
    const Contacting c = i % 2 ? stacked_boxes(random) : random_hulls(random);
    if (!is_apart(c)) continue;
    ++asked;
    const ManifoldOptions options{.margin = kInfinity, .most_points = 8};
    const Manifold near = manifold(c.a, c.b, c.b_in_a, c.answer, options);
    const double depth = random.uniform(0, 0.1);
    Contacting overlapping = c;
    overlapping.b_in_a.translation -= depth * c.answer.normal;
    overlapping.answer.point_b -= depth * c.answer.normal;
    overlapping.answer.lower -= depth, overlapping.answer.upper -= depth;
    const Manifold deep = manifold(c.a, c.b, overlapping.b_in_a, overlapping.answer, options);
    expect_sound(overlapping, deep, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal) - depth, kInfinity);
    EXPECT_NEAR(shown_area(deep), shown_area(near), 16 * c.bound() * (c.a.extent() + c.b.extent())) << i;
    EXPECT_TRUE(same_names(deep, near)) << i;
  }
  EXPECT_GE(asked, 290);
}

/// Depth's own answers: deep in one another, the deepest point is the depth.
TEST(Manifold, HoldsTheDepthOfOverlappingBodies) {
  Random random(11);
  int asked = 0;
  for (int i = 0; i < 200; ++i) {
    Contacting c = i % 2 ? stacked_boxes(random) : random_hulls(random);
    if (!is_apart(c)) continue;
    c.b_in_a.translation -= random.uniform(0, 0.2) * c.answer.normal + 0.05 * random.in_ball();
    const Answer deep = signed_distance(c.a, c.b, c.b_in_a);
    if (deep.normal.hasNaN()) continue;
    ++asked;
    c.answer.normal = deep.normal;
    expect_sound(c, manifold(c.a, c.b, c.b_in_a, deep, {.margin = kInfinity}), deep.lower, kInfinity);
  }
  EXPECT_GE(asked, 190);
}

/// Points of a polytope that did not end need not be as far apart as the bounds say; they were taken at their word.
TEST(Manifold, OfADepthThatABudgetEndedIsWithinItsBounds) {
  Random random(12);
  int ended = 0;
  for (int i = 0; i < 400; ++i) {
    Contacting c = i % 2 ? stacked_boxes(random) : random_hulls(random);
    c.b_in_a.translation -= random.uniform(0, 0.4) * c.answer.normal + 0.05 * random.in_ball();
    const Answer s = signed_distance(c.a, c.b, c.b_in_a, {.budget = {.steps = std::uint32_t(i % 12)}});
    const Manifold p = manifold(c.a, c.b, c.b_in_a, s, {.margin = kInfinity});
    if (s.status != Status::Budget || p.count == 0) continue;
    ++ended;
    EXPECT_GE(least(p), s.lower - 2 * c.bound()) << i;
    EXPECT_LE(least(p), s.upper + 2 * c.bound()) << i;
  }
  EXPECT_GE(ended, 50);
}

/// A loose answer is on a coarser level, and so is its manifold: cubes around octahedra.
TEST(Manifold, OfALooseAnswerIsThatOfItsLevels) {
  const Model a = bodies::nested(2);
  const Pose b_in_a = at(0, 0.5, 2.5);
  const Answer answer = distance(a, a, b_in_a, {.budget = {.finest_level = 1}});
  ASSERT_EQ(answer.level_a, 1);
  const Manifold p = manifold(a, a, b_in_a, answer, {.margin = 0.6});
  EXPECT_EQ(p.count, 4u);
  EXPECT_NEAR(shown_area(p), 3, 1e-14);
  EXPECT_NEAR(least(p), 0.5, 1e-14);
}

/// A margin around the hulls moves the points outwards, by that and nothing else.
TEST(Manifold, OfBodiesWithARadiusLiesOnIt) {
  const Model cube = bodies::model(bodies::cube());
  const Pose b_in_a = at(0.5, 0.25, 2.05);
  const Body a(cube, 0.03), b(cube, 0.04);
  const Manifold hulls = manifold(cube, cube, b_in_a, nearest(cube, cube, b_in_a), {.margin = 0.05}),
                 bodies = manifold(a, b, b_in_a, nearest(a, b, b_in_a));
  ASSERT_EQ(hulls.count, 4u);
  ASSERT_EQ(bodies.count, 4u);
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(bodies.points[i].separation, -0.02, 1e-15);
    EXPECT_NEAR((bodies.points[i].point_a - hulls.points[i].point_a - Vec3(0, 0, 0.03)).norm(), 0, 1e-15);
    EXPECT_NEAR((bodies.points[i].point_b - hulls.points[i].point_b + Vec3(0, 0, 0.04)).norm(), 0, 1e-15);
    EXPECT_EQ(bodies.points[i].feature_a, hulls.points[i].feature_a);
  }
}

/// A box is the same whatever it is made of; its corners have other names.
TEST(Manifold, OfPrimitivesIsThatOfTheirModels) {
  const Model cube = bodies::model(bodies::cube()), segment = bodies::model(bodies::segment({-3, 0, 0}, {3, 0, 0})),
              triangle = bodies::model(bodies::two_sided({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  const Pose pose = at(0.5, 0.25, 2.1, shapes::rotation({0, 0, 1}, 0.3));
  for (const auto& [primitive, model] : {std::pair{Body::box({-1, -1, -1}, {1, 1, 1}, 0.1), &cube},
                                         std::pair{Body::segment({-3, 0, 0}, {3, 0, 0}, 0.1), &segment},
                                         std::pair{Body::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.1), &triangle}}) {
    const Body same(*model, 0.1), other(cube, 0.02);
    const ManifoldOptions options{.margin = kInfinity, .most_points = 8};
    const Manifold p = manifold(other, primitive, pose, nearest(other, primitive, pose), options),
                   q = manifold(other, same, pose, nearest(other, same, pose), options);
    EXPECT_GE(p.count, 2u);
    EXPECT_EQ(p.count, q.count);
    EXPECT_NEAR(shown_area(p), shown_area(q), 1e-14);
    EXPECT_NEAR(least(p), least(q), tolerance(other, same, pose));
  }
}

TEST(Manifold, IsMirroredUnderSwap) {
  Random random(7);
  int asked = 0;
  for (int i = 0; i < 300; ++i) {
    const bool is_round = i % 10 == 0;
    const Contacting c = is_round ? stacked_prisms(random, 140, 120) : i % 2 ? stacked_boxes(random) : random_hulls(random);
    if (!is_apart(c)) continue;
    ++asked;
    const ManifoldOptions options{.margin = kInfinity, .most_points = 8};
    const Manifold forth = manifold(c.a, c.b, c.b_in_a, c.answer, options);
    Contacting s{c.b, c.a, inverse(c.b_in_a), c.answer};
    const auto into_b = [&](const Vec3& p) { return Vec3(s.b_in_a.rotation * p + s.b_in_a.translation); };
    s.answer.normal = -(s.b_in_a.rotation * c.answer.normal).normalized();
    s.answer.point_a = into_b(c.answer.point_b), s.answer.point_b = into_b(c.answer.point_a);
    std::swap(s.answer.feature_a, s.answer.feature_b);
    const Manifold back = manifold(s.a, s.b, s.b_in_a, s.answer, options);
    expect_sound(s, back, (c.answer.point_b - c.answer.point_a).dot(c.answer.normal), kInfinity);
    // Of many corners others may be chosen.
    const double part = is_round ? 0.1 * shown_area(forth) : 0;
    EXPECT_NEAR(shown_area(forth), shown_area(back), part + 16 * c.bound() * (c.a.extent() + c.b.extent())) << i;
  }
  EXPECT_GE(asked, 290);
}

TEST(Manifold, ScalesBitForBit) {
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const bool is_round = i % 5 == 0;  // one on the other, tilted
    const bodies::Polyhedron a =
        bodies::moved(is_round ? prism(150, 1, 1) : bodies::box(1, random.uniform(), 1), random.rotation());
    const Vec3 up = is_round ? (a.points[150] - a.points[0]).normalized() : Vec3(0, 0, 0);
    const Mat3 rotation = is_round ? shapes::rotation(random.on_sphere(), 1e-3) : random.rotation();
    const Vec3 translation = is_round ? Vec3(1.01 * up + up.cross(random.on_sphere())) : Vec3(3 * random.on_sphere());
    const auto at_scale = [&](double scale) {
      const bodies::Polyhedron scaled = bodies::moved(a, scale * Mat3::Identity());
      const Model model = bodies::model(scaled);
      Pose pose;
      pose.rotation = rotation, pose.translation = scale * translation;
      const Answer answer = nearest(model, model, pose);
      return answer.normal.hasNaN() ? Manifold{} : manifold(model, model, pose, answer, {.margin = kInfinity});
    };
    const Manifold one = at_scale(1), large = at_scale(0x1p40);
    ASSERT_EQ(one.count, large.count);
    for (std::uint32_t k = 0; k < one.count; ++k) {
      EXPECT_EQ(one.points[k].point_a * 0x1p40, large.points[k].point_a);
      EXPECT_EQ(one.points[k].point_b * 0x1p40, large.points[k].point_b);
      EXPECT_EQ(one.points[k].separation * 0x1p40, large.points[k].separation);
    }
  }
}

// ---- Motion -----------------------------------------------------------------------------------------------------------------

Vec3 direction(const ConvexView& view, FeatureId edge, const Mat3& rotation) {
  const HalfEdge& along = view.half_edges[edge.index()];
  const Vertex &p = view.vertices[view.half_edges[along.twin].head], &q = view.vertices[along.head];
  return (rotation * Vec3(q.x - p.x, q.y - p.y, q.z - p.z)).normalized();
}

/// B slides, turns and tilts by 1e-6 a frame. A point that keeps its name moves by no more than the bodies do there, where
/// edges cross divided by the sine of their angle, with room for a factor of 4.
TEST(Manifold, MovesNoPointFartherThanTheBodies) {
  Random random(9);
  int frames = 0, changes = 0, followed = 0;
  double worst = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const bodies::Polyhedron a = scene % 3 ? bodies::box(1, 0.7, 0.5) : prism(scene % 4 ? 60 : 300, 1, 1),
                             b = scene % 2 ? bodies::box(0.8, 1.1, 0.4) : prism(5, 0.9, 1);
    const Model model_a = bodies::model(a), model_b = bodies::model(b);
    Pose pose =
        stacked(a, 0.5, b, random_top(random, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)), 1e-2, Mat3::Identity())
            .b_in_a;
    constexpr double kStep = 1e-6;
    const Vec3 slide = kStep * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const Mat3 turn = shapes::rotation(random.on_sphere(), kStep);
    Manifold before;
    for (int frame = 0; frame < 200; ++frame, ++frames) {
      const Contacting c{model_a, model_b, pose, nearest(model_a, model_b, pose)};
      const Manifold now = manifold(c.a, c.b, pose, c.answer, {.margin = 0.02}, before);
      const double motion = 2 * kStep + 2 * kStep * 0.02 / std::max(1e-9, c.answer.lower);
      bool same = now.count == before.count;
      for (std::uint32_t i = 0; i < now.count; ++i) {
        const ManifoldPoint& p = now.points[i];
        const ManifoldPoint* old = nullptr;
        for (std::uint32_t k = 0; k < before.count; ++k) {
          const ManifoldPoint& q = before.points[k];
          if (q.feature_a == p.feature_a && q.feature_b == p.feature_b) old = &q;
        }
        same = same && old;
        if (!old) continue;
        double allowed = 4 * motion;
        if (p.feature_a.kind() == FeatureKind::Edge && p.feature_b.kind() == FeatureKind::Edge) {
          const Vec3 u = direction(c.a.level(0).view, p.feature_a, Mat3::Identity()),
                     v = direction(c.b.level(0).view, p.feature_b, pose.rotation);
          allowed /= std::max(1e-9, u.cross(v).norm());
        }
        ++followed;
        const double moved = std::max((p.point_a - old->point_a).norm(), (p.point_b - old->point_b).norm());
        worst = std::max(worst, 4 * moved / allowed);
        EXPECT_LE(moved, allowed) << scene << " " << frame;
      }
      changes += frame > 0 && !same;
      before = now;
      pose.rotation = (turn * pose.rotation).eval();
      pose.translation += slide;
    }
  }
  EXPECT_GT(followed, 20000);
  EXPECT_LT(changes, frames / 50);
  std::printf("%d frames, %d changes of points, greatest motion %.2f\n", frames, changes, worst);
}

/// Two triangles turned against one another have a hexagon in common, of which four corners are as good as other four: those of
/// the frame before stay, whatever a body at rest trembles.
TEST(Manifold, KeepsThePointsOfTheFrameBefore) {
  const Model prism_3 = bodies::model(prism(3, 1, 1));
  Random random(10);
  int with = 0, without = 0;
  Manifold before, alone;
  for (int frame = 0; frame < 200; ++frame) {
    const Pose pose = at(random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3), 1.001,
                         shapes::rotation(Vec3::UnitZ(), std::numbers::pi + random.uniform(-1e-3, 1e-3)));
    const Answer answer = nearest(prism_3, prism_3, pose);
    const ManifoldOptions options{.margin = 0.01};
    const auto differ = [](const Manifold& p, const Manifold& q) {
      int known = 0;
      for (std::uint32_t i = 0; i < p.count; ++i) {
        for (std::uint32_t k = 0; k < q.count; ++k) {
          known += p.points[i].feature_a == q.points[k].feature_a && p.points[i].feature_b == q.points[k].feature_b;
        }
      }
      return known < 4;
    };
    const Manifold now = manifold(prism_3, prism_3, pose, answer, options, before),
                   now_alone = manifold(prism_3, prism_3, pose, answer, options);
    with += frame > 0 && differ(now, before);
    without += frame > 0 && differ(now_alone, alone);
    before = now, alone = now_alone;
  }
  EXPECT_EQ(with, 0);
  EXPECT_GT(without, 20) << "the test is too easy";
}

/// Whatever the manifold before was of, what is chosen after it is chosen again.
TEST(Manifold, KeepsWhatItChose) {
  const Model prism_5 = bodies::model(prism(5, 1, 1)), cube = bodies::model(bodies::cube()),
              prism_140 = bodies::model(prism(140, 1, 1));
  Random random(11);
  int others = 0;
  for (const Model* model : {&cube, &prism_5, &prism_140}) {
    Manifold before;
    for (int i = 0; i < 15'000; ++i) {
      const double tilt = std::pow(10, random.uniform(-16, -1));
      const Mat3 rotation = shapes::rotation(Vec3::UnitX(), tilt * random.uniform(-1, 1)) *
                            shapes::rotation(Vec3::UnitZ(), i % 2 ? tilt * random.uniform(-1, 1) : random.uniform(-1, 1));
      const Pose pose = at(random.uniform(-1, 1), random.uniform(-1, 1), 2.2, rotation);
      const Answer answer = nearest(*model, *model, pose);
      const ManifoldOptions options{.margin = 10, .most_points = 1 + std::uint32_t(random.bits() % kMostManifoldPoints)};
      const Manifold first = manifold(*model, *model, pose, answer, options, before),
                     again = manifold(*model, *model, pose, answer, options, first),
                     alone = manifold(*model, *model, pose, answer, options);
      ASSERT_EQ(first.count, again.count) << i;
      for (std::uint32_t k = 0; k < first.count; ++k) {
        ASSERT_EQ(first.points[k].feature_a, again.points[k].feature_a) << i;
        ASSERT_EQ(first.points[k].feature_b, again.points[k].feature_b) << i;
        ASSERT_EQ(first.points[k].point_a, again.points[k].point_a) << i;
        others += k < alone.count && first.points[k].feature_a != alone.points[k].feature_a;
      }
      before = first;
    }
  }
  EXPECT_GT(others, 1000) << "what was before changes nothing";
}

/// Bodies far from their origins: the bound is as large as a body's sides, and the deepest point is no corner.
TEST(Manifold, OfBodiesFarFromTheirOriginsStays) {
  Random random(16);
  int asked = 0;
  for (int i = 0; i < 400; ++i) {
    const auto body = [&](const Vec3& centre) {
      std::vector<Vec3> points;
      for (int k = 0; k < 24; ++k) points.push_back(centre + (32 * random.on_sphere()).array().round().matrix());
      return hull_of({points, {}});
    };
    const auto far = [&] { return Vec3((0x1p48 * random.on_sphere()).array().round().matrix()); };
    const Vec3 centre_a = far(), centre_b = far();
    const Model a = body(centre_a), b = body(centre_b);
    Pose pose;
    pose.translation = centre_a - centre_b + (random.uniform(20, 70) * random.on_sphere()).array().round().matrix();
    const Answer answer = signed_distance(a, b, pose);
    const ManifoldOptions options{.margin = kInfinity, .most_points = 1 + std::uint32_t(random.bits() % kMostManifoldPoints)};
    const Manifold first = manifold(a, b, pose, answer, options), again = manifold(a, b, pose, answer, options, first);
    asked += first.count > 0;
    ASSERT_TRUE(same_names(first, again)) << i;
  }
  EXPECT_GT(asked, 200);
}

/// Stacks at rest, as a simulation in single precision sees them: each entry of both poses off by up to 4 ulps, anew each step.
TEST(Manifold, OfAPairAtRestKeepsItsPointsUnderNoise) {
  Random random(17);
  for (const std::uint32_t sides : {4u, 12u, 40u, 200u}) {
    const Model upper = bodies::model(prism(sides, 1, 1)), slab = sides == 4 ? bodies::model(bodies::box(3, 2, 0.5)) : upper;
    const Mat3 turn = random.rotation();
    for (const auto& [twist, slide, tilt] :
         {std::tuple{0.4, 0.03, 0.}, std::tuple{1.1, 0.3, 0.}, std::tuple{0.7, 0.2, 1e-6}, std::tuple{0., 0., 0.}}) {
      const bool is_flush = slide == 0;
      const Model& lower = is_flush ? upper : slab;
      const auto noisy = [&](const Mat3& rotation, const Vec3& translation) {
        const auto off = [&](double x) {
          const float f = float(x), ulp = std::nextafter(std::fabs(f), std::numeric_limits<float>::infinity()) - std::fabs(f);
          return double(f) + double(ulp) * (double(random.bits() % 9) - 4);
        };
        Pose pose{rotation, translation};
        pose.rotation = Eigen::Quaterniond(rotation.unaryExpr(off).eval()).normalized().toRotationMatrix();
        pose.translation = translation.unaryExpr(off);
        return pose;
      };
      const Mat3 on_top = shapes::rotation(Vec3::UnitX(), tilt) * shapes::rotation(Vec3::UnitZ(), twist);
      PairSeed seed;
      Manifold before;
      int changes = 0;
      for (int step = 0; step < 10'000; ++step) {
        const Pose a = noisy(turn, turn * Vec3(0.3, 0.2, 0.1)),
                   b = noisy(turn * on_top, turn * Vec3(0.3 + slide, 0.2 + slide / 3, 1.1 - 1e-4)), pose = relative(a, b);
        const Answer answer = signed_distance(lower, upper, pose, seed);
        ASSERT_EQ(answer.status, Status::Converged);
        const Manifold now = manifold(lower, upper, pose, answer, {.margin = 0.01}, before);
        ASSERT_EQ(now.count, 4u);
        changes += step > 0 && !same_names(now, before);
        before = now;
      }
      // Flush faces' corners get their names when the pair is at rest, and many of them then give way to one another.
      EXPECT_LE(changes, is_flush ? 100 : 0) << sides << " sides, turned by " << twist;
    }
  }
}

/// A cube that balances on an edge faces along the normal with two faces alike: the one of the frame before stays.
TEST(Manifold, KeepsTheFaceOfTheFrameBefore) {
  const Model cube = bodies::model(bodies::cube());
  const Pose pose = at(0, 0, 1.1 + std::sqrt(2), kEighthAboutX);
  const Answer answer = nearest(cube, cube, pose);
  int kept = 0;
  for (std::uint32_t face = 0; face < 6; ++face) {
    Manifold before;
    before.face_b = {FeatureKind::Face, face};
    kept += manifold(cube, cube, pose, answer, {}, before).face_b == before.face_b;
  }
  EXPECT_EQ(kept, 2);
}

}  // namespace
/// Twice the area of the largest polygon of `most` corners, of which p[0] is one; p is convex and counter-clockwise.
double largest(const std::vector<Eigen::Vector2d>& p, std::size_t most) {
  std::vector<double> best(p.size(), 0);
  for (std::size_t corner = 2; corner < std::min(most, p.size()); ++corner) {
    for (std::size_t last = p.size() - 1; last > 0; --last) {
      double area = 0;
      for (std::size_t i = 1; i < last; ++i) {
        const Eigen::Vector2d u = p[i] - p[0], v = p[last] - p[0];
        area = std::max(area, best[i] + u.x() * v.y() - u.y() * v.x());
      }
      best[last] = area;
    }
  }
  return *std::max_element(best.begin(), best.end());
}

/// Convex polygons of 13 corners, changed at random as long as the share falls.
TEST(Manifold, LargestPolygonsKeepTheSharesOfTheHeader) {
  for (const auto& [most, share] :
       {std::pair<std::size_t, double>{3, 0.316}, {4, 0.57}, {5, 0.72}, {6, 0.80}, {7, 0.85}, {8, 0.89}}) {
    Random random(most);
    double worst = 1;
    for (int run = 0; run < 8; ++run) {
      std::vector<Eigen::Vector2d> sides(12);
      for (Eigen::Vector2d& side : sides) side = {random.uniform(-1, 1), random.uniform(-1, 1)};
      // Sides that sum to 0, in the order of their angles, make a convex polygon.
      const auto share_of = [&, most = most](std::vector<Eigen::Vector2d> turned) {
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (const Eigen::Vector2d& side : turned) sum += side;
        turned.push_back(-sum);
        std::sort(turned.begin(), turned.end(),
                  [](const auto& a, const auto& b) { return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x()); });
        std::vector<Eigen::Vector2d> p{Eigen::Vector2d::Zero()};
        for (std::size_t i = 0; i + 1 < turned.size(); ++i) p.push_back(p.back() + turned[i]);
        double least = 1;
        for (std::size_t i = 0; i < p.size(); ++i, std::rotate(p.begin(), p.begin() + 1, p.end()))
          least = std::min(least, largest(p, most) / largest(p, p.size()));
        return least;
      };
      double now = share_of(sides);
      for (int i = 0; i < 1500; ++i) {
        auto changed = sides;
        const double step = std::pow(10, random.uniform(-3, 0));
        changed[std::size_t(random.bits() % 12)] += step * Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1));
        if (const double then = share_of(changed); then < now) now = then, sides = changed;
      }
      worst = std::min(worst, now);
    }
    std::printf("%d points: at least %.4f\n", int(most), worst);
    EXPECT_GE(worst, share);
    EXPECT_LE(worst, share + 0.04);  // the search comes near
  }
}

}  // namespace swiftlet
