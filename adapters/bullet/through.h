// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// On which side of an open surface a point is: whether its way led through. Knows one mesh, and no body.
#pragma once

#include <swiftlet/mesh.h>

namespace swiftlet::bullet {

/// Whether the straight way between two points leads through a surface: through triangles in an odd number of planes, so that a
/// sheet with triangles for either side is one surface. Exact. Both ends count as moved by one infinitesimal vector, the same
/// for every way: so no end lies in the surface, no way meets an edge, each edge is passed on the same side by both of its
/// triangles, and where ways follow one another no crossing is lost or counted twice, wherever one ends. Cost: the triangles
/// whose boxes meet that of the way, once more for each that is crossed. Allocates nothing.
bool leads_through(const MeshModel& mesh, const Vec3& from, const Vec3& to);

}  // namespace swiftlet::bullet
