// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Patches of generated contacts beside the exact intersection of their faces, and what they keep while bodies move.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/patch.h>

#include "bodies.h"
#include "patch_oracle.h"
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

  double bound() const { return bodies::law_two(a.level(0).view, b.level(0).view, b_in_a); }
};

Answer nearest(const Model& a, const Model& b, const Pose& b_in_a) {
  PairSeed cold;
  return contact(a, b, b_in_a, cold).answer;
}

/// The answer where B has been moved by so much along the normal: what a query for depth says of shallow overlaps.
Contacting moved_apart(Contacting c, double distance) {
  const Vec3 shift = distance * c.answer.normal;
  c.b_in_a.translation += shift;
  c.answer.point_b += shift;
  return c;
}

Model hull_of(const Mesh& mesh) { return std::move(build(mesh.points)).value().model; }

/// B over A, whose top is at height `top`: turned about z, tilted, at x and y, its lowest point so far above the top; then
/// everything turned, so that no face is flat but up to rounding.
Contacting stacked(const bodies::Body& a, double top, const bodies::Body& b, const Pose& on_top, double gap, const Mat3& turn) {
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

bodies::Body prism(std::uint32_t sides, double radius, double height) {
  bodies::Body b;
  for (const double z : {-height / 2, height / 2}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      b.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) b.corners.push_back(sides - 1 - i);
  for (std::uint32_t i = 0; i < sides; ++i) b.corners.push_back(sides + i);
  b.sizes = {sides, sides};
  for (std::uint32_t i = 0; i < sides; ++i) b.add({i, (i + 1) % sides, sides + (i + 1) % sides, sides + i});
  return b;
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
  return (c.answer.verdict == Verdict::Disjoint || c.answer.verdict == Verdict::Touching) && !c.answer.normal.isZero();
}

double least(const Patch& p) {
  double least = kInfinity;
  for (std::uint32_t i = 0; i < p.count; ++i) least = std::min(least, p.points[i].separation);
  return least;
}

double shown_area(const Patch& p) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < p.count; ++i) points.push_back(p.points[i].point_a);
  return oracle::area(points, p.normal);
}

/// What holds of every patch.
void expect_sound(const Contacting& c, const Patch& p, double separation, double margin) {
  const double bound = c.bound();
  EXPECT_EQ(p.normal, c.answer.normal);
  for (std::uint32_t i = 0; i < p.count; ++i) {
    const PatchPoint& q = p.points[i];
    EXPECT_TRUE(oracle::lies_in(c.a.level(0).view, Pose{}, q.point_a, bound)) << i;
    EXPECT_TRUE(oracle::lies_in(c.b.level(0).view, c.b_in_a, q.point_b, bound)) << i;
    EXPECT_LE((q.point_b - q.point_a - q.separation * p.normal).norm(), 2 * bound) << i;
    EXPECT_LE(q.separation, margin + bound);
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

/// The contact face first, then all others within 2^-21 of its plane and on its side.
std::vector<std::uint32_t> flat_faces(const ConvexView& view, Handle contact) {
  const auto corners = [&](std::uint32_t face) {
    std::vector<Vec3> result;
    for (std::uint32_t h = 0; h < view.head.size(); ++h) {
      if (view.face[h] != face || view.face[view.twin[h]] == face) continue;
      for (const std::uint32_t v : {view.head[view.twin[h]], view.head[h]}) {
        result.emplace_back(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z);
      }
    }
    return result;  // by sides, each from tail to head
  };
  const auto normal = [&](std::uint32_t face) {
    const std::vector<Vec3> sides = corners(face);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < sides.size(); i += 2) sum += (sides[i] - sides[0]).cross(sides[i + 1] - sides[0]);
    return sum.normalized().eval();
  };
  const Vec3 n = normal(contact.index()), p = corners(contact.index())[0];
  std::vector<std::uint32_t> faces{contact.index()};
  for (std::uint32_t face = 0; face < view.face_first.size(); ++face) {
    const std::vector<Vec3> all = corners(face);
    const bool flat =
        std::all_of(all.begin(), all.end(), [&](const Vec3& q) { return n.dot(q - p) >= -0x1p-21 * view.extent; });
    if (face != contact.index() && flat && n.dot(normal(face)) > 0) faces.push_back(face);
  }
  return faces;
}

/// What a patch is beside the truth. `shares` gathers how much of the area four and eight points keep.
struct Shares {
  double four = 1, eight = 1;
  int counted = 0;
};
void expect_true(const Contacting& c, Shares& shares) {
  PatchOptions options;
  options.margin = kInfinity, options.most_points = kMostPatchPoints;
  const Patch eight = patch(c.a, c.b, c.b_in_a, c.answer, options);
  options.most_points = 4;
  const Patch four = patch(c.a, c.b, c.b_in_a, c.answer, options);
  const double separation = (c.answer.point_b - c.answer.point_a).dot(c.answer.normal);
  for (const Patch* p : {&eight, &four}) expect_sound(c, *p, separation, kInfinity);
  ASSERT_EQ(eight.face_a, four.face_a);

  const ConvexView &a = c.a.level(0).view, &b = c.b.level(0).view;
  const oracle::Overlay truth =
      oracle::overlay(a, flat_faces(a, eight.face_a), b, flat_faces(b, eight.face_b), c.b_in_a, c.answer.normal);
  const double size = c.a.extent() + c.b.extent(), blur = 16 * c.bound() * size;
  if (truth.corners.size() <= 8) {
    EXPECT_NEAR(shown_area(eight), truth.area, blur);
  } else {
    EXPECT_LE(shown_area(eight), truth.area + blur);
  }
  if (truth.area < 1e4 * blur) return;
  ++shares.counted;
  shares.four = std::min(shares.four, shown_area(four) / truth.area);
  shares.eight = std::min(shares.eight, shown_area(eight) / truth.area);
}

TEST(Patch, OfTwoCubesIsTheirCommonSquare) {
  const Model cube = bodies::model(bodies::cube());
  Pose b_in_a;
  b_in_a.translation = {0.5, 0.25, 2};
  const Patch p = patch(cube, cube, b_in_a, nearest(cube, cube, b_in_a));
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

TEST(Patch, OfEqualFlushCubesIsTheirFace) {
  const Model cube = bodies::model(bodies::cube());
  for (const double shift : {0., 1e-17, 1e-15, 1e-12, 1e-9}) {
    Pose b_in_a;
    b_in_a.translation = {shift, -shift, 2};
    const Patch p = patch(cube, cube, b_in_a, nearest(cube, cube, b_in_a));
    ASSERT_EQ(p.count, 4u) << shift;
    EXPECT_NEAR(shown_area(p), 4, 4 * shift + 1e-14);
  }
}

TEST(Patch, OfStackedBoxesIsTheIntersectionOfTheirFaces) {
  Random random(1);
  Shares shares;
  int overlapping = 0;
  for (int i = 0; i < 3000; ++i) {
    const Contacting c = stacked_boxes(random);
    SCOPED_TRACE(i);
    if (!is_apart(c)) {
      ++overlapping;
      continue;
    }
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_LT(overlapping, 1000);
  std::printf("%d areas: four points keep at least %.3f, eight %.3f; %d overlapped\n", shares.counted, shares.four, shares.eight, overlapping);
}

TEST(Patch, OfPrismsIsTheIntersectionOfTheirFaces) {
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
  std::printf("%d areas: four points keep at least %.3f, eight %.3f\n", shares.counted, shares.four, shares.eight);
}

TEST(Patch, OfRandomHullsIsTheIntersectionOfTheirFaces) {
  Random random(3);
  Shares shares;
  for (int i = 0; i < 500; ++i) {
    const Contacting c = random_hulls(random);
    SCOPED_TRACE(i);
    if (!is_apart(c)) continue;
    expect_true(c, shares);
    if (testing::Test::HasFailure()) return;
  }
  std::printf("%d areas: four points keep at least %.3f, eight %.3f\n", shares.counted, shares.four, shares.eight);
}

}  // namespace
}  // namespace swiftlet
