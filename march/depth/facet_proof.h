// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves the depth where the nearest facet of the Minkowski difference is already known, by its plane and a few points of the
// difference below it. Knows one level pair.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "numeric/width.h"
#include "pair/certify.h"
#include "pair/nearest.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// What a walk tells of the height of the Minkowski difference along the normal where it ended, with B moved aside.
struct Ceiling {
  const PairView& moved;  ///< the pair of the walk
  Nearest& seen;          ///< its last state
  Vec way;                ///< how far B was moved

  /// An upper bound on the height along `n`, the unit normal of `seen`; infinite if the walk does not tell, as where it ended
  /// nearer than law 2's bound.
  double height(const Vec& n) const {
    const Vec4 apart = vec4(seen.point_b) - vec4(seen.point_a), from = vec4(seen.apart), by = vec4(way);
    const double over = seen.over_a + seen.over_b;
    const bool tells = over <= moved.law_two && dot(apart, apart) > moved.law_two * moved.law_two;
    // What rounds the two vectors is not in the gap of their difference.
    const double rounding = kU * sum(abs(from) + abs(by));
    return tells ? -gap(moved, vec4(n), from - by, over + rounding) : kInfinity;
  }
};

SWIFTLET_BOTH_WIDTHS(bool, prove_facet, const PairView& pair, const Level& a, const Level& b, const DepthStart& start,
                     const Ceiling& ceiling, const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth);
/// Returns true if the start's three or four vertex pairs are proved to make a facet of the Minkowski difference that holds the
/// point of its surface nearest to the origin; `depth` is filled if so. The start's direction is the facet's unit normal, that
/// of `ceiling`, which is looked at closely where it tells too little; where that does too, supports are climbed to. Otherwise
/// `depth` has its `steps` and, where they do make a facet below the origin, a finite `upper`; its `normal` then is a direction
/// of any length along which the difference is seen to be no higher, or 0. `a` and `b` are the levels of the pair's views.
static inline bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start,
                               const Ceiling& ceiling, const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth) {
  return SWIFTLET_BY_WIDTH(prove_facet, pair, a, b, start, ceiling, goal, plane_tests, depth);
}

}  // namespace swiftlet
