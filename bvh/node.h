// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A node of the tree over a mesh's triangles: up to eight boxes along axes of the node's own, each around a node or, of the
// lowest nodes, around a triangle.
#pragma once

#include <cstdint>

#include "mesh_tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {

inline constexpr int kFanOut = 8;
/// No way from the root to a triangle passes more nodes.
inline constexpr int kMostDepth = 16;

/// Lengths are over the mesh's unit, a power of two that is above its extent and at most twice it. Of lanes that have no child
/// all numbers are 0.
struct alignas(64) Node {
  double origin[3];          ///< body frame; the middle of the box around all children
  std::uint32_t link;        ///< the first child; bit 27: see `of_patch`; bit 28: children are triangles; above it their number
                             ///< less one
  float axis[2][3];          ///< body frame: two of the axes; their cross product is the third
  float extent[3];           ///< half the sides of the box around all children, rounded up
  float centre[3][kFanOut];  ///< centres of the children's boxes, along each axis, from the origin
  float half[3][kFanOut];    ///< half their sides, rounded up

  static std::uint32_t link_of(std::uint32_t first, std::uint32_t count, bool lowest) {
    return first | std::uint32_t(lowest) << 28 | (count - 1) << 29;
  }
  std::uint32_t first() const { return link & ((1u << 27) - 1); }
  int count() const { return int(link >> 29) + 1; }
  bool lowest() const { return (link >> 28 & 1) != 0; }
  /// True if the builder found that its triangles lie on the boundary of their hull: then it is worth asking the node's hull
  /// also where boxes meet. Nothing rests on that being so.
  bool of_patch() const { return (link >> 27 & 1) != 0; }
  void mark_patch() { link |= 1u << 27; }
};
static_assert(sizeof(Node) == 256);

/// The third axis, rounded as every reader of a node rounds it.
static inline void third_axis(const float (&axis)[2][3], float (&third)[3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    third[i] = axis[0][j] * axis[1][k] - axis[0][k] * axis[1][j];
  }
}

/// The rows of a matrix: three axes.
struct Axes {
  Vec row[3];
  Vec along(const Vec& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
};
/// The axes of a node as its readers see them.
static inline Axes axes_of(const Node& n) {
  float third[3];
  third_axis(n.axis, third);
  const auto row = [](const float(&f)[3]) { return Vec{f[0], f[1], f[2]}; };
  return {{row(n.axis[0]), row(n.axis[1]), row(third)}};
}

/// The exponent of the unit of a body of this extent. A body that is one point at its origin has the smallest unit there is.
static inline int unit_of(double extent) { return exponent_of(max(extent, kLeastExtent)) + 1; }

/// The middle of the box around all children, and how far its corners are from there, over a unit of 2^-unit.
static inline Vec middle_of(const Node& node, int unit) {
  return scaled({node.origin[0], node.origin[1], node.origin[2]}, unit);
}
static inline double reach_of(const Node& node, int unit) {
  return times_power_of_two(norm(Vec{node.extent[0], node.extent[1], node.extent[2]}), unit);
}

/// The box around a body, that of its tree's root, as a pair of bodies is looked at first. Lengths are in the body's unit.
struct Root {
  int unit;                       ///< the exponent of what nodes are measured in
  double extent;                  ///< the greatest magnitude of a coordinate
  Vec middle, centre;             ///< of the box, and of a ball around the body
  double reach;                   ///< the ball's radius, but for rounding
  double inside;                  ///< how far the ball's centre is from the box's sides; below 0 outside
  Padded axes_x, axes_y, axes_z;  ///< x of the three axes, y and z
  Padded half;                    ///< half the sides along them
  Padded aside;                   ///< from the ball's centre to the box's middle along them
  /// The sum of the products of each half side with itself: x of them, y and z. In floats, over the square of 2^unit.
  alignas(16) float spread[3][4];
};
/// The ball is that around the box.
static inline Root root_of(const Node& node, int unit, double extent) {
  const auto& [x, y] = node.axis;
  float z[3];
  third_axis(node.axis, z);
  const Vec half = scaled({node.extent[0], node.extent[1], node.extent[2]}, unit);
  Root root{unit,
            extent,
            middle_of(node, unit),
            middle_of(node, unit),
            reach_of(node, unit),
            min(min(half.x, half.y), half.z),
            {x[0], y[0], z[0]},
            {x[1], y[1], z[1]},
            {x[2], y[2], z[2]},
            half,
            {0, 0, 0},
            {}};
  const float* const axis[3] = {x, y, z};
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) root.spread[i][j] += node.extent[k] * node.extent[k] * axis[k][i] * axis[k][j];
  }
  return root;
}

}  // namespace swiftlet
