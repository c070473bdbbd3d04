// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The depth where it is already known which facet of the Minkowski difference is nearest: one supporting plane and few points.
// Knows one level pair.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// Whether the start, of three or four vertex pairs, is a facet of the Minkowski difference that holds the point of its surface
/// nearest to the origin, and a ring of points shows that: mostly, where it is. `depth` is filled only if so; of a facet of
/// which only the ring does not show it `upper` is, and of any `steps`. The levels are those of the pair's views.
bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
                 std::uint32_t& plane_tests, Depth& depth);

}  // namespace swiftlet
