// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The end of a march. If the walk's own tests prove bounds that settle the question, that is all. On any doubt follow a
// certificate by support vertices of the features that the walk found and, if it is too wide, certified GJK. Knows one level
// pair.
#pragma once

#include <swiftlet/march.h>

#include "pair/certify.h"
#include "pair/pair_view.h"
#include "pair/walk.h"

namespace swiftlet {

/// How far certified GJK goes. It runs if the features alone do not prove enough.
enum class Until {
  Narrow,  ///< the rule's width; the points bound the distance from above, but may lie inside the bodies
  Exact,   ///< law 2's width, with points on the surfaces, or `lower` beyond the rule's threshold
};

/// True if a threshold is within rounding of bounds.
static inline bool is_near(const PairView& pair, double lower, double upper, double threshold) {
  return lower - pair.law_two <= threshold && threshold <= upper + pair.law_two;
}

/// Certifies what a walk's last state knows once more if a closer look tells more. Else returns `doubt`, why not at first.
Doubt certify_closely(const PairView& pair, Nearest& seen, Doubt doubt, std::uint32_t& plane_tests, Proof& proof);
/// Returns None if the tests of a walk's last state prove the distance within law 2's bound, and neither `zero` nor `beyond`,
/// where verdicts change, is within rounding of it; `proof` then holds the bounds. Else returns why not.
static inline Doubt settle(const PairView& pair, Walk& walk, double zero, double beyond, std::uint32_t& plane_tests,
                           Proof& proof) {
  if (walk.end != WalkEnd::Minimum) return Doubt::NoMinimum;
  Doubt doubt = certify(pair, walk.nearest, proof);
  if (doubt == Doubt::Width || doubt == Doubt::Neighbour)
    doubt = certify_closely(pair, walk.nearest, doubt, plane_tests, proof);
  if (doubt != Doubt::None) return doubt;
  const bool near = is_near(pair, proof.lower, proof.upper, zero) || is_near(pair, proof.lower, proof.upper, beyond);
  return near ? Doubt::Threshold : Doubt::None;
}

/// Proves bounds from the end of a walk by climbs and certified GJK. Verdicts change at the distances 0, `zero` and the rule's
/// `beyond`: within rounding of these, the result is that of a cold start if the budget allows one.
template <Until until = Until::Narrow>
MarchResult conclude(const PairView& pair, const Walk& walk, const MarchRule& rule, double zero = 0);

}  // namespace swiftlet
