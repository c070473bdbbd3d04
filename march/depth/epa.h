// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The expanding polytope algorithm [van den Bergen 2001]: bounds a depth by a supporting plane of the Minkowski difference and
// a polytope inside it. Knows one level pair and where to begin; nothing of seeds, verdicts or other levels.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// Bounds the depth of `pair` from `start` until `goal` is met. `a` and `b` are the levels of the pair's views. Allocates
/// nothing. Law 7: at most 4 * kDepthCones * kDepthPoints supports: of each polytope all turns but two add a point, and a turn
/// asks for three at most.
Depth epa(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
          std::uint32_t& plane_tests);

}  // namespace swiftlet
