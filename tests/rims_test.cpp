// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rims: which faces are some, and that manifolds are the same, or as good, of models that know of none.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/model_file.h>

#include "bodies.h"
#include "numeric/tolerance.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using namespace bodies;
using shapes::Random;

/// The hull of regular polygons around the z axis, or sectors of them, each with a height and a radius.
Model turned(std::uint32_t sides, const std::vector<std::pair<double, double>>& profile, const Mat3& turn = Mat3::Identity(),
             double whole = 2 * std::numbers::pi) {
  std::vector<Vec3> points;
  for (const auto& [z, radius] : profile) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = whole * i / sides;
      points.push_back(turn * Vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  return must(build(points)).model;
}
Model coin(std::uint32_t sides) { return turned(sides, {{-0.25, 1}, {0.25, 1}}); }

Bytes with_rims(const Model& model, std::uint32_t rims) {
  Bytes block = bytes_of(model);
  write(block, level_header_at(0) + offsetof(LevelHeader, rims), rims);
  rehash(block);
  return block;
}

void expect_rims(const ConvexView& view, std::uint32_t count) {
  ASSERT_EQ(view.rims, count);
  for (std::uint32_t f = 0; f < count; ++f) {
    const std::uint32_t begin = view.half_edges[view.half_edges[view.face_first[f]].twin].head;
    std::uint32_t next = begin + 1;
    for (const std::uint32_t v : FaceLoop(view, f)) {
      if (v == begin) continue;
      EXPECT_EQ(v, next++);
    }
    EXPECT_GE(next - begin, 16u);
  }
}

TEST(Rims, AreLargeFaces) {
  expect_rims(coin(15).level(0).view, 0);
  expect_rims(coin(16).level(0).view, 2);
  expect_rims(coin(300).level(0).view, 2);
  expect_rims(turned(40, {{0, 1}, {1, 0}}).level(0).view, 1);                                      // a cone
  expect_rims(turned(40, {{-0.3, 0.9}, {-0.2, 1}, {0.2, 1}, {0.3, 0.9}}).level(0).view, 2);        // a wheel with chamfers
  expect_rims(turned(40, {{-0.3, 0.9}, {-0.2995, 1}, {0.2995, 1}, {0.3, 0.9}}).level(0).view, 0);  // which a manifold may merge
  expect_rims(coin(40).level(0).view, 2);
  Random random(1);
  for (int i = 0; i < 10; ++i) expect_rims(turned(60, {{-0.25, 1}, {0.25, 1}}, random.rotation()).level(0).view, 2);
}

TEST(Rims, OfTwoThatShareCornersIsTheLarger) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) {
    const double angle = std::numbers::pi * i / 40, x = std::cos(angle), y = i < 40 ? std::sin(angle) : 0;
    points.emplace_back(x, y, 0);
    if (i % 2 == 0 && y > 0) points.emplace_back(x, y * 0.5, y);
  }
  const Model tent = must(build(points)).model;
  expect_rims(tent.level(0).view, 1);
  std::size_t corners = 0;
  for ([[maybe_unused]] const std::uint32_t v : FaceLoop(tent.level(0).view, 0)) ++corners;
  EXPECT_EQ(corners, 41u);
}

TEST(Rims, ThatAreNoneAreRefusedInFiles) {
  const Model model = coin(40);
  EXPECT_TRUE(load(with_rims(model, 0)));
  EXPECT_TRUE(load(with_rims(model, 1)));
  EXPECT_TRUE(load(with_rims(model, 2)));
  for (const std::uint32_t wrong : {3u, 42u, 43u, ~0u}) {
    const auto read = load(with_rims(model, wrong));
    ASSERT_FALSE(read) << wrong;
    EXPECT_EQ(read.error().code, ErrorCode::BadFormat);
  }
  // Of bodies with a chamfer the numbers count up, but the face beyond does not go down.
  const Model flat = turned(40, {{-0.3, 0.9}, {-0.2995, 1}, {0.2995, 1}, {0.3, 0.9}});
  EXPECT_FALSE(load(with_rims(flat, 1)));
}

void expect_same(const Manifold& a, const Manifold& b) {
  ASSERT_EQ(a.count, b.count);
  EXPECT_EQ(a.face_a, b.face_a);
  EXPECT_EQ(a.face_b, b.face_b);
  EXPECT_EQ(a.normal, b.normal);
  for (std::uint32_t i = 0; i < a.count; ++i) {
    EXPECT_EQ(a.points[i].point_a, b.points[i].point_a);
    EXPECT_EQ(a.points[i].point_b, b.points[i].point_b);
    EXPECT_EQ(a.points[i].separation, b.points[i].separation);
    EXPECT_EQ(a.points[i].feature_a, b.points[i].feature_a);
    EXPECT_EQ(a.points[i].feature_b, b.points[i].feature_b);
  }
}

/// A half disc: its border rises by twenty sides on one side of it and by one on the other.
TEST(Rims, OfAHalfDiscAreReadAsItsFaceIs) {
  std::vector<Vec3> points, small;
  for (const double z : {0., 0.5}) {
    for (int i = 0; i <= 20; ++i)
      points.emplace_back(std::cos(std::numbers::pi * i / 20), std::sin(std::numbers::pi * i / 20), z);
  }
  for (int i = 0; i < 8; ++i) small.emplace_back(i & 1 ? 0.1 : -0.1, i & 2 ? 0.1 : -0.1, i & 4 ? 0 : -0.5);
  const Model half = must(build(points)).model, box = must(build(small)).model, plain = must(load(with_rims(half, 0)));
  ASSERT_EQ(half.level(0).view.rims, 2u);
  for (int turn = 0; turn < 360; turn += 3) {
    for (double x = -0.7; x < 0.75; x += 0.2) {
      Pose pose;
      pose.rotation = shapes::rotation(Vec3::UnitZ(), turn * std::numbers::pi / 180);
      pose.translation = Vec3(0, 0, 1e-4) - pose.rotation * Vec3(x, 0.15, 0);
      const Answer answer = signed_distance(box, half, pose);
      const Manifold manifold = swiftlet::manifold(box, half, pose, answer, {.margin = 0.01});
      ASSERT_EQ(manifold.count, 4u) << turn << ' ' << x;
      expect_same(manifold, swiftlet::manifold(box, plain, pose, answer, {.margin = 0.01}));
      const Answer swapped = signed_distance(half, box, inverse(pose));
      expect_same(swiftlet::manifold(half, box, inverse(pose), swapped, {.margin = 0.01}),
                  swiftlet::manifold(plain, box, inverse(pose), swapped, {.margin = 0.01}));
    }
  }
}

/// The area of the points of a manifold, across its normal.
double area(const Manifold& m) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 2; i < m.count; ++i)
    sum += (m.points[i - 1].point_a - m.points[0].point_a).cross(m.points[i].point_a - m.points[0].point_a);
  return m.count > 0 ? std::fabs(sum.dot(m.normal)) / 2 : 0;
}
double least(const Manifold& m) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < m.count; ++i) least = std::min(least, m.points[i].separation);
  return least;
}
/// The corners of a rim; none of another face.
std::uint32_t rim_corners(const Model& model, FeatureId face) {
  const ConvexView& view = model.level(0).view;
  std::uint32_t count = 0;
  if (face.kind() == FeatureKind::Face && face.index() < view.rims) {
    for ([[maybe_unused]] const std::uint32_t v : FaceLoop(view, face.index())) ++count;
  }
  return count;
}

/// Coins, wheels, cones, their sectors and boxes of any size on one another, anywhere, turned, tilted, warm and cold. Of few
/// corners the manifold is the same, bit for bit, as that of models that know of no rims; of many, which are found by halving,
/// it is as deep and keeps about the same area.
TEST(Rims, AreReadAsOtherFacesAre) {
  Random random(2);
  std::uint32_t of_four = 0, of_many = 0, halved = 0, compared = 0;
  double worst = 1, sum = 0;
  for (int round = 0; round < 60; ++round) {
    const auto body = [&] {
      const auto sides = std::uint32_t(3 + random.bits() % (round % 3 == 0 ? 600 : 50));
      const double radius = std::exp(random.uniform(-2, 1));
      const std::pair<double, double> top{0.3, radius}, bottom{-0.3, radius * random.uniform(0.5, 1)};
      if (random.bits() % 3 == 0) return turned(sides, {bottom, {0.2, radius * 1.1}, top}, random.rotation());
      if (random.bits() % 3 == 0) return turned(sides, {bottom, top}, random.rotation(), random.uniform(0.5, 6));
      return turned(sides, {bottom, top}, random.bits() % 2 ? random.rotation() : Mat3::Identity());
    };
    const Model a = body(), b = body();
    const Model plain_a = must(load(with_rims(a, 0))), plain_b = must(load(with_rims(b, 0)));
    PairSeed seed;
    Manifold before, plain_before;
    Pose pose;
    for (int i = 0; i < 40; ++i) {
      if (i % 8 == 0) {  // largest faces on each other
        const auto up = [](const Model& m) {
          return Vec3(m.level(0).view.planes[0].x, m.level(0).view.planes[0].y, m.level(0).view.planes[0].z);
        };
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(up(b), -up(a));
        pose.rotation = shapes::rotation(up(a), random.uniform(0, 6)) * turn.toRotationMatrix();
        const Vec3 aside = Vec3(random.on_sphere()).cross(up(a)) * random.uniform(0, 0.8) * (a.radius() + b.radius()) / 2;
        pose.translation = up(a) * 2 * (a.radius() + b.radius()) + aside;
        const Answer far = distance(a, b, pose);
        pose.translation -= up(a) * (far.lower * std::fabs(far.normal.dot(up(a))) - 1e-4);
        before = plain_before = {};
      } else {
        pose.rotation = shapes::rotation(random.on_sphere(), std::pow(10, random.uniform(-6, -1.5))) * pose.rotation;
        pose.translation += 1e-3 * random.on_sphere();
      }
      const ManifoldOptions options{.margin = std::pow(10, random.uniform(-5, -1))};
      const Answer answer = signed_distance(a, b, pose, seed);
      const Manifold manifold = swiftlet::manifold(a, b, pose, answer, options, before),
                     plain = swiftlet::manifold(plain_a, plain_b, pose, answer, options, plain_before);
      before = manifold, plain_before = plain;
      of_four += manifold.count == 4;
      of_many += a.level(0).view.rims > 0 && b.level(0).view.rims > 0 && manifold.count >= 3;
      if (rim_corners(a, manifold.face_a) + rim_corners(b, manifold.face_b) < kManyCorners) {
        ASSERT_NO_FATAL_FAILURE(expect_same(manifold, plain)) << round << ' ' << i;
        continue;
      }
      ++halved;
      const Manifold cold = swiftlet::manifold(a, b, pose, answer, options),
                     plain_cold = swiftlet::manifold(plain_a, plain_b, pose, answer, options);
      ASSERT_EQ(cold.count > 0, plain_cold.count > 0) << round << ' ' << i;
      if (cold.count > 0) {
        EXPECT_NEAR(least(cold), least(plain_cold), 2 * tolerance(a, b, pose)) << round << ' ' << i;
      }
      for (const auto& [halving, sweep] : {std::pair(&manifold, &plain), std::pair(&cold, &plain_cold)}) {
        if (!(area(*sweep) > 1e-6 * a.radius() * b.radius())) continue;
        const double share = area(*halving) / area(*sweep);
        EXPECT_GE(share, 0.85) << round << ' ' << i;
        worst = std::min(worst, share), sum += share, ++compared;
      }
    }
  }
  EXPECT_GT(of_four, 1000u);
  EXPECT_GT(of_many, 700u);
  EXPECT_GT(halved, 500u);
  EXPECT_GT(compared, 500u);
  EXPECT_GT(sum / compared, 0.99);
  std::printf("%u found by halving: of the sweep's area at least %.3f, in the mean %.3f\n", halved, worst, sum / compared);
}

}  // namespace
}  // namespace swiftlet
