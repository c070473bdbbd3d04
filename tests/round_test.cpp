// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models of cylinders and cones against the closed forms of their distances from points and spheres.
#include <swiftlet/round.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <swiftlet/depth.h>

namespace swiftlet {
namespace {

/// Below 0 inside. Both are bodies of revolution: a polygon's distance in the half-plane of radius and z.
double gap_of_cylinder(const Vec3& p, double r, double h) {
  const double x = std::hypot(p[0], p[1]) - r, z = std::abs(p[2]) - h;
  return std::min(std::max(x, z), 0.) + std::hypot(std::max(x, 0.), std::max(z, 0.));
}

double gap_of_cone(const Vec3& p, double r, double h) {
  const double x = std::hypot(p[0], p[1]), z = p[2];
  const auto segment = [&](double ax, double az, double bx, double bz) {
    const double dx = bx - ax, dz = bz - az, t = std::clamp(((x - ax) * dx + (z - az) * dz) / (dx * dx + dz * dz), 0., 1.);
    return std::hypot(x - ax - t * dx, z - az - t * dz);
  };
  const double least = std::min(segment(0, -h, r, -h), segment(r, -h, 0, h));
  return z >= -h && x <= r * (h - z) / (2 * h) ? -least : least;
}

void expect_true_and_narrow(const Model& model, double deviation, double (*gap)(const Vec3&, double, double), double r,
                            double h) {
  EXPECT_EQ(model.finest_level(), 1);
  EXPECT_LE(model.level(1).deviation, deviation);
  EXPECT_GT(model.level(1).deviation, deviation / 8);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-2, 2);
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    const double radius = i % 3 * 0.1, truth = gap(p, r, h) - radius;
    const Answer answer = signed_distance(model, Body::point(p, radius), {});
    EXPECT_LE(answer.lower, truth + 1e-15);
    EXPECT_GE(answer.upper, truth - 1e-15);
    if (truth < 2 * deviation) continue;  // of an overlap levels around the body know only how deep it is at most
    ++apart;
    EXPECT_LE(answer.upper - answer.lower, deviation + 1e-12);
    EXPECT_EQ(answer.status, Status::LevelLimit) << truth;
    const Answer rough = signed_distance(model, Body::point(p, radius), {}, {.absolute = 1.01 * deviation});
    EXPECT_EQ(rough.status, Status::Converged);
  }
  EXPECT_GT(apart, 1000);
}

TEST(Round, CylindersAreHeldByTrueIntervals) {
  for (const double deviation : {0.1, 1e-2, 1e-4}) {
    const auto model = cylinder(0.8, 0.5, deviation);
    ASSERT_TRUE(model) << model.error().message;
    expect_true_and_narrow(model.value(), deviation, gap_of_cylinder, 0.8, 0.5);
  }
}

TEST(Round, ConesAreHeldByTrueIntervals) {
  for (const double deviation : {0.1, 1e-2, 1e-4}) {
    const auto model = cone(0.8, 0.5, deviation);
    ASSERT_TRUE(model) << model.error().message;
    expect_true_and_narrow(model.value(), deviation, gap_of_cone, 0.8, 0.5);
  }
}

TEST(Round, RefusesLengthsThatAreNone) {
  EXPECT_EQ(cylinder(0, 1, 0.1).error().code, ErrorCode::BadValue);
  EXPECT_EQ(cone(1, -1, 0.1).error().code, ErrorCode::BadValue);
  EXPECT_EQ(cylinder(1, std::numeric_limits<double>::infinity(), 0.1).error().code, ErrorCode::BadValue);
  EXPECT_EQ(cylinder(1, 1, 1e-9).error().code, ErrorCode::BadValue);
  EXPECT_TRUE(cylinder(1, 1, 2e-6));
}

}  // namespace
}  // namespace swiftlet
