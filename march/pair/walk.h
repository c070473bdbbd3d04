// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Voronoi marching on one level pair [Ehmann & Lin 2000, sec. 5.1]: walks from any feature pair to one that is nearest as far
// as doubles can tell. The tests of the last state also prove how far the bodies rise beyond its features; certify.h makes
// bounds of that.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>

#include "numeric/width.h"
#include "pair/nearest.h"
#include "pair/pair_view.h"

namespace swiftlet {

enum class WalkEnd : std::uint8_t {
  Minimum,  ///< no Voronoi plane of either feature is violated
  Inside,   ///< a vertex is below a face, or an edge passes through one: overlap, or a start behind the body
  Stalled,  ///< it came back to features where it had been, or crossed the side that it came from
  Enough,   ///< the features are as near as was asked
  Budget,
};

struct Walk {
  WalkEnd end = WalkEnd::Budget;
  FeatureId a, b;  ///< kinds VV, VE, EV, EE, VF, FV; with Inside also EF and FE
  std::uint32_t steps = 0, plane_tests = 0;
  Nearest nearest;  ///< with Minimum: what the last state knows; with Enough its points and `blur`
};

SWIFTLET_BOTH_WIDTHS(Walk, walk, const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget,
                     double enough2);
/// `a` and `b` name features of the pair's views, not both faces. Ends at features whose squared distance is at most `enough2`,
/// if that is not negative.
static inline Walk walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget,
                        double enough2 = -1) {
  return SWIFTLET_BY_WIDTH(walk, pair, a, b, rule, step_budget, enough2);
}

}  // namespace swiftlet
