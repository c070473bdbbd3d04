// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The exact convex hull of points of any rank. Knows nothing of files or levels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <swiftlet/executor.h>

#include "polytope.h"

namespace swiftlet::lod {

/// Only strictly extreme points are vertices: none lies inside a face or an edge.
struct Hull {
  int dimension = 0;                    ///< 3 solid, 2 flat, 1 segment, 0 point
  std::vector<std::uint32_t> vertices;  ///< into the points, the first of equal ones; a solid's ascend, a polygon's go around
  std::vector<Triangle> triangles;      ///< of a solid, into `vertices`
  std::size_t duplicates = 0;           ///< points equal to an earlier one
  std::size_t interior = 0;             ///< distinct points that are no vertex
};

/// Decided by exact predicates on the doubles as given; the same points give the same hull. At least one point, all finite.
Hull hull(std::span<const Vec3> points, const Executor& executor = {});

/// The vertices of a solid hull as a body of their own.
Polytope solid(std::span<const Vec3> points, const Hull& hull);

}  // namespace swiftlet::lod
