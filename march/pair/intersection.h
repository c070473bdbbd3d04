// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds features by place: two features of overlapping bodies that share a point, proved exactly, for `march` alone; and the
// feature of one body at a given point. Knows one level pair.
#pragma once

#include <swiftlet/march.h>

#include "pair/pair_view.h"

namespace swiftlet {

/// A feature of each body and a point that both share, rounded. If one body lies inside the other and the surfaces share no
/// point: a vertex of the inner body, `FeatureId{}` for the outer, and a point inside both bodies.
struct Intersection {
  FeatureId a, b;
  Vec point;
};

/// `proof` proves that the bodies overlap. Cost: walks over facets, of about as many tests as a cold march. If one body lies
/// inside the other, one exact walk for each vertex of the inner body; if doubles cannot tell, also one for each edge that
/// begins outside the other body. Each walk begins where the last one ended, mostly a facet or two away, so that the number of
/// tests is linear in the features: 1 to 5 for each, whatever the ratio of sizes. At worst, if every walk goes around the whole
/// other body or the file is hostile, it is the product of the feature counts: all algorithms with a lower known bound take
/// working memory [Chazelle 1992].
Intersection intersection(const PairView& pair, const OverlapProof& proof, std::uint32_t& plane_tests);

/// A feature and a point of the common frame that it holds.
struct HeldPoint {
  FeatureId feature;
  Vec point;
};

/// The feature that holds `p`, a point of the common frame within law 2's bound of the surface. Returns `known` unless that is
/// a vertex farther from `p` than the bound. Then searches all facets and returns the smallest feature within the bound, or
/// `known` if no facet is within twice the bound. The search is needed because certified GJK and the depth, near 0 or near the
/// surface, may end on vertices that no one feature holds, and name one of them. Bodies that touch may overlap by all of the
/// bound, and rounding may leave a point deeper still: it is moved towards the surface then, to the bound.
HeldPoint held_at_a(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests);
HeldPoint held_at_b(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests);

}  // namespace swiftlet
