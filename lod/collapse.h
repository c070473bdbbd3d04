// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Simplification by edge collapse [Ehmann & Lin 2000, sec. 4.5]. Knows nothing of enclosing.
#pragma once

#include <cstddef>
#include <vector>

#include <swiftlet/executor.h>

#include "polytope.h"
#include "watch.h"

namespace swiftlet::lod {

/// Points whose hull approximates `body`, left by collapsing edges about in the order of Garland & Heckbert's quadric errors,
/// each placed where its error is least, until `triangle_count` triangles remain or no edge may collapse. The same points on
/// any executor.
std::vector<Vec3> collapse(const Polytope& body, std::size_t triangle_count, const Executor& executor, Watch& watch);
/// What that tells the watch, from so many triangles to so many, about microseconds.
double collapse_work(double before, double after);

}  // namespace swiftlet::lod
