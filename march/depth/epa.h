// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How deep two polytopes overlap, between a plane that supports their Minkowski difference and a polytope inside it. Knows one
// level pair and where to begin; nothing of seeds, verdicts or other levels.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// The expanding polytope algorithm. Nothing is allocated. The levels are those of the pair's views. Law 7: at most
/// 12 * 4^kDepthCells * kDepthPoints supports.
Depth epa(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
          std::uint32_t& plane_tests);

}  // namespace swiftlet
