// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The truth about two faces seen along a direction: their intersection, in rational arithmetic, as the hull of all corners of
// one that lie in the other and of all crossings of their sides. Shares nothing with march but the data structure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::oracle {

/// What two faces have in common as a direction shows them.
struct Overlay {
  std::size_t corners = 0;
  double area = 0;   ///< across the direction; rounded
  double depth = 0;  ///< of a point of A's frame: how far it lies inside of the border, or 0; rounded
};

/// Of the hulls of all corners of some faces of each body.
Overlay overlay(const ConvexView& a, const std::vector<std::uint32_t>& faces_a, const ConvexView& b,
                const std::vector<std::uint32_t>& faces_b, const Pose& b_in_a, const Vec3& n, const Vec3& point = Vec3::Zero());

/// The area of the hull of some points, as `n` shows them.
double area(const std::vector<Vec3>& points, const Vec3& n);

/// How far a point is outside of the facet's plane that it is farthest outside of, rounded at last: below 0 in the body, so
/// deep under its surface. 0 of a body without facets. `in_a`: where the body is.
double height_over(const ConvexView& body, const Pose& in_a, const Vec3& point);

/// Of a face of the body, in its frame: unit, outwards; rounded at last, so that it is that of a sliver too; 0 of corners on
/// one line.
Vec3 face_normal(const ConvexView& body, FeatureId face);

/// Whether a face of the body faces as well along `n`, a unit vector of its frame, as any face at a feature: within 2^-42, as
/// cosines. A face that is no triangle has the normal that the model states.
bool faces_best(const ConvexView& body, const Vec3& n, FeatureId feature, FeatureId face);

/// A face, and after it all others whose corners lie within `flatness` times the extent of its plane and on its side, and that
/// sides join to it.
std::vector<std::uint32_t> flat_faces(const ConvexView& body, FeatureId face, double flatness);

}  // namespace swiftlet::oracle
