// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Closed triangle meshes with dents and holes, and random poses. Knows nothing of hulls.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include <swiftlet/build.h>
#include <swiftlet/pose.h>

namespace hull_tree {

using swiftlet::Mat3;
using swiftlet::Mesh;
using swiftlet::Pose;
using swiftlet::Vec3;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

Mesh torus(double major, double minor, std::uint32_t around, std::uint32_t across);
/// A tube along the trefoil that winds three times around a torus of radii 2 and 1 while going around it twice.
Mesh knot(double tube, std::uint32_t along, std::uint32_t across);
/// A ring with teeth, extruded along z: integer coordinates, flat sides.
Mesh gear(std::uint32_t teeth);
/// The union of the unit cubes [x, x + 1] x [y, y + 1] x [z, z + 1] that `filled` names among those of a box, two triangles per
/// unit square. No two cubes meet in an edge or corner alone.
Mesh cubes(int x, int y, int z, const std::function<bool(int, int, int)>& filled);

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform(double low, double high);
  Vec3 direction();
  Mat3 rotation();
  Mat3 quarter_turns();  ///< one of the cube's 24 rotations

 private:
  std::uint64_t state_;
};

/// About a unit axis, by radians.
Mat3 rotation(const Vec3& axis, double angle);

}  // namespace hull_tree
