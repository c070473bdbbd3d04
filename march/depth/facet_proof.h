// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves the depth where the nearest facet of the Minkowski difference is already known, by its plane and a few points of the
// difference below it. Knows one level pair.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "numeric/width.h"
#include "pair/pair_view.h"

namespace swiftlet {

bool prove_facet_by_two(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, double upper,
                        const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth);
bool prove_facet_by_four(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, double upper,
                         const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth);
/// Returns true if the start's three or four vertex pairs are proved to make a facet of the Minkowski difference that holds the
/// point of its surface nearest to the origin; `depth` is filled if so. The start's direction is the facet's unit normal, and
/// no point of the difference is known to be higher along it than `upper`; where that tells too little, supports are climbed
/// to. Otherwise `depth` has its `steps` and, where they do make a facet below the origin, a finite `upper`; its `normal` then
/// is a direction of any length along which the difference is seen to be no higher, or 0. `a` and `b` are the levels of the
/// pair's views.
static inline bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, double upper,
                               const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth) {
  return SWIFTLET_BY_WIDTH(prove_facet)(pair, a, b, start, upper, goal, plane_tests, depth);
}

}  // namespace swiftlet
