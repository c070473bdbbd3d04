// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "arm.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <Eigen/Geometry>

#include <swiftlet/build.h>

namespace planner {
namespace {

using swiftlet::Model;
using swiftlet::Pose;
using swiftlet::Vec3;

/// On a spiral.
Model ellipsoid(const Vec3& centre, const Vec3& semi_axes) {
  constexpr int kCount = 1000;
  std::vector<Vec3> points;
  for (int i = 0; i < kCount; ++i) {
    const double z = 1 - (2 * i + 1.0) / kCount, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    points.push_back(centre + semi_axes.cwiseProduct(Vec3(z, r * std::cos(turn), r * std::sin(turn))));
  }
  const auto built = swiftlet::build(points);
  if (!built) std::puts(built.error().message.c_str()), std::exit(1);
  return built.value().model;
}

}  // namespace

Scene make_scene() {
  const Model link = ellipsoid({0.5, 0, 0}, {0.5, 0.08, 0.08});
  Scene scene{{link, link}, {}};
  for (int i = 0; i < 8; ++i) {
    const double around = i * EIGEN_PI / 4, up = i % 2 ? 0.6 : -0.5, out = i % 3 ? 1.3 : 1;
    Pose in_world;
    in_world.rotation = Eigen::AngleAxisd(i, Vec3(0.6, 0, 0.8)).toRotationMatrix();
    in_world.translation = {out * std::cos(around), out * std::sin(around), up};
    scene.obstacles.push_back({ellipsoid(Vec3::Zero(), {0.4, 0.3, 0.15 + 0.02 * i}), in_world});
  }
  return scene;
}

std::array<Pose, 2> links_in_world(const Angles& angles) {
  const auto pitch = [](double angle) { return Eigen::AngleAxisd(angle, Vec3::UnitY()); };
  Pose upper, fore;
  upper.rotation = (Eigen::AngleAxisd(angles[0], Vec3::UnitZ()) * pitch(angles[1])).toRotationMatrix();
  fore.rotation = upper.rotation * pitch(angles[2]).toRotationMatrix();
  fore.translation = upper.rotation.col(0);
  return {upper, fore};
}

std::array<double, 2> longest_ways(const Angles& from, const Angles& to) {
  const double shoulder = std::fabs(to[0] - from[0]) + std::fabs(to[1] - from[1]), elbow = std::fabs(to[2] - from[2]);
  return {shoulder, 2 * shoulder + elbow};  // no point of a link is farther than 1 from its joint
}

}  // namespace planner
