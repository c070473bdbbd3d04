// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A plant of 38 000 triangles and a robot arm, for RECIPES.md: a floor that is not flat, racks with boxes on them, pipes.
#pragma once

#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/build.h>

namespace plant {

using swiftlet::Mesh;
using swiftlet::Pose;
using swiftlet::Vec3;

inline Pose at(double x, double y, double z, double turn = 0, const Vec3& axis = Vec3::UnitZ()) {
  return {Eigen::AngleAxisd(turn, axis).toRotationMatrix(), {x, y, z}};
}
inline Pose after(const Pose& first, const Pose& then) {
  return {first.rotation * then.rotation, first.rotation * then.translation + first.translation};
}

/// Adds a closed surface of revolution about z: rings of so many sides at (radius, height), each end a fan.
inline void turn(Mesh& mesh, std::initializer_list<std::array<double, 2>> profile, int sides, const Pose& pose) {
  const auto first = std::uint32_t(mesh.points.size()), n = std::uint32_t(sides), rings = std::uint32_t(profile.size());
  for (const auto& [radius, height] : profile)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * EIGEN_PI * (i + 0.5) / n;
      mesh.points.push_back(pose.rotation * Vec3(radius * std::cos(angle), radius * std::sin(angle), height) +
                            pose.translation);
    }
  for (std::uint32_t k = 0; k + 1 < rings; ++k)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = first + k * n + i, q = first + k * n + (i + 1) % n;
      mesh.triangles.insert(mesh.triangles.end(), {{p, q, q + n}, {p, q + n, p + n}});
    }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    const std::uint32_t top = first + (rings - 1) * n;
    mesh.triangles.insert(mesh.triangles.end(), {{first, first + i + 1, first + i}, {top, top + i, top + i + 1}});
  }
}

inline Mesh environment() {
  Mesh mesh;
  constexpr std::uint32_t kSide = 100;  // the floor: 20 000 triangles
  for (std::uint32_t i = 0; i <= kSide; ++i)
    for (std::uint32_t k = 0; k <= kSide; ++k) {
      const double x = 0.06 * i - 3, y = 0.06 * k - 3;
      mesh.points.push_back({x, y, 0.03 * std::sin(5 * x) * std::cos(4 * y)});
      if (i == kSide || k == kSide) continue;
      const std::uint32_t p = i * (kSide + 1) + k, right = p + kSide + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{p, right, right + 1}, {p, right + 1, p + 1}});
    }
  for (int rack = 0; rack < 10; ++rack)  // 100 boxes a rack, one missing here and there
    for (int box = 0; box < 100; ++box) {
      const double angle = 0.6283 * rack, size = 0.05 + 0.01 * ((7 * box + rack) % 5);
      const Pose stand = after(at(0, 0, 0, angle), at(1.7, 0.16 * (box % 10) - 0.72, 0.2 + 0.22 * (box / 10)));
      turn(mesh, {{size, 0}, {size, 2 * size}}, 4, after(stand, at(0, 0, 0, 0.1 * box)));
    }
  for (int pipe = 0; pipe < 25; ++pipe) {  // 248 triangles each, under the ceiling
    const Pose along = at(-3, 0.24 * pipe - 3, 1.9 + 0.05 * (pipe % 3), EIGEN_PI / 2, Vec3::UnitY());
    turn(mesh, {{0.05, 0}, {0.05, 2}, {0.07, 2}, {0.07, 2.1}, {0.05, 2.1}, {0.05, 6}}, 21, along);
  }
  return mesh;
}

/// Its three links, each along z from its joint.
inline std::vector<Mesh> links() {
  std::vector<Mesh> all(3);
  turn(all[0], {{0.09, -0.1}, {0.1, 0}, {0.06, 0.12}, {0.06, 0.6}, {0.09, 0.7}, {0.08, 0.78}}, 32, {});
  turn(all[1], {{0.07, -0.08}, {0.08, 0}, {0.05, 0.1}, {0.045, 0.5}, {0.06, 0.57}, {0.05, 0.63}}, 32, {});
  turn(all[2], {{0.05, -0.05}, {0.05, 0.1}, {0.03, 0.11}, {0.03, 0.2}, {0.01, 0.25}}, 32, {});
  return all;
}

/// The poses of the links at a time in [0, 1].
inline std::array<Pose, 3> arm_at(double time) {
  const Pose base = at(0, 0, 0.7, 6.2 * time);
  const Pose shoulder = after(base, at(0, 0, 0, 0.9 + 0.5 * std::sin(9 * time), Vec3::UnitY()));
  const Pose elbow = after(shoulder, at(0, 0, 0.7, 0.8 + 0.5 * std::cos(7 * time), Vec3::UnitY()));
  return {shoulder, elbow, after(elbow, at(0, 0, 0.57, 0.6 * std::sin(11 * time), Vec3::UnitX()))};
}

}  // namespace plant
