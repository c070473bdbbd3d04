// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two ellipsoids that tell where a body surely ends, and where it surely is: the points c + s M^T y with |y| <= 1, for a centre
// c, a scale s and the map frame M of the body's level 0. Along n, the farther one reaches s |M n| from c; along a unit vector
// n of a ray from c, the nearer one ends at s / |M^-T n|.
#pragma once

#include <array>

#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// The scale of an ellipsoid that holds the body; infinite for frames of more than `kMostSlender`. Larger by `kEllipsoidSlack`
/// than the least one. Cost: linear in the vertices.
double scale_around(const ConvexView& view, const Vec& centre, const std::array<double, 6>& frame);

/// The scale of an ellipsoid that the body holds; 0 if there is none, and for frames of more than `kMostSlender`. Smaller by
/// `kEllipsoidSlack`, and by the rounding of planes, than the largest one. Cost: n log n in the facets.
double scale_inside(const ConvexView& view, const Vec& centre, const std::array<double, 6>& frame);

}  // namespace swiftlet
