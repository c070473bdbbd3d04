// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Is a depth true? Brute force over every plane that can bound the Minkowski difference, in rational arithmetic where doubles
// cannot tell. Shares no predicate or bound with march.
#pragma once

#include <cstdint>
#include <optional>

#include <swiftlet/pose.h>

#include "exact_check.h"

namespace swiftlet::stability {

/// Nothing where the least translation that separates the hulls is at least `depth` > 0 long, decided exactly; else the normal
/// of a plane beyond which less moves B, any length, 0 where the hulls share a plane. Each facet of the difference is parallel
/// to a face of A, to one of B, or to an edge of each. Cost: the product of the edges, and exact arithmetic
/// for planes about as near.
std::optional<Vec3> shallower(const Subject& a, const Subject& b, const Pose& b_in_a, double depth);

}  // namespace swiftlet::stability
