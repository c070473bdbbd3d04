// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The truth about two faces seen along a direction: their intersection, in rational arithmetic, as the hull of all corners of
// one that lie in the other and of all crossings of their sides. Shares nothing with march but the data structure.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::oracle {

/// What two faces have in common as a direction shows them; rounded at last.
struct Overlay {
  struct Corner {
    Vec3 point_a;  ///< on the plane of A's face
    double gap;    ///< from there to the plane of B's, along the unit direction
  };
  std::vector<Corner> corners;
  double area = 0;  ///< across the direction
};

/// Of the hulls of all corners of some faces of each body. The planes are those of the first three corners.
Overlay overlay(const ConvexView& a, const std::vector<std::uint32_t>& faces_a, const ConvexView& b,
                const std::vector<std::uint32_t>& faces_b, const Pose& b_in_a, const Vec3& n);

/// The area of the hull of some points, as `n` shows them.
double area(const std::vector<Vec3>& points, const Vec3& n);

/// Whether a point lies within so much of the inner side of every facet's plane. `in_a`: where the body is.
bool lies_in(const ConvexView& body, const Pose& in_a, const Vec3& point, double tolerance);

}  // namespace swiftlet::oracle
