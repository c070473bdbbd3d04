// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One body inside the other: what a search of surfaces cannot see of solids.
#pragma once

#include "search.h"

namespace swiftlet {

/// Looks whether part of one body lies in the volume of the other, where that is a solid, and if so makes `finding`, which a
/// search left, that of an overlap. Surfaces that the search proved apart are decided exactly, by one vertex of each component
/// whose vertex is in the other's box. Of surfaces that may touch an overlap is found where a vertex, a point beside the
/// triangles that touch, or the middle of what both boxes have in common is inside by more than law 2's bound.
void look_inside(const MeshView& a, const MeshView& b, const Pose& b_in_a, const MeshQuestion& question, MeshFinding& finding);

}  // namespace swiftlet
