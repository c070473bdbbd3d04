// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What became of the user's mesh in the hull: which triangles lie on which face, and how far the mesh dents. Knows nothing of
// levels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <swiftlet/build.h>

#include "hull.h"
#include "plane_tree.h"
#include "watch.h"

namespace swiftlet::lod {

/// How far from flat or convex a mesh may be by rounding alone, in its unit: 8 units in the last place of its largest
/// coordinate, as doubles, or as floats where all coordinates are floats.
double rounding_of(std::span<const Vec3> points);

/// Per triangle of the user's, the hull triangle on whose plane its corners lie up to rounding and whose normal agrees, that
/// with its corners where there is one; kNone for none. Tells one unit of work per triangle.
std::vector<std::uint32_t> triangles_on(const Mesh& mesh, const Hull& hull, const Polytope& body, Watch& watch);

/// The volume of a closed surface, summed in 106 bits: that of a thin body may be less than what doubles lose.
double precise_volume(const Polytope& body);

/// The mesh's volume over the hull's; none where an edge of the mesh lacks its opposite.
std::optional<double> volume_ratio(const Mesh& mesh, const Polytope& body);

/// The greatest distance from the hull's surface of a vertex that the mesh's triangles use. Edges and triangles between them
/// may be deeper. `planes` are those of `body`. Tells one unit of work per vertex that is none of the hull's.
double deepest_dent(const Mesh& mesh, const Hull& hull, const Polytope& body, PlaneTree& planes, Watch& watch);

}  // namespace swiftlet::lod
