// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Features where bodies meet: of those that overlap two that share a point, proved exactly; of one the feature at a point. What
// reads tags wants these; the queries do not. Knows one level pair.
#pragma once

#include <swiftlet/march.h>

#include "pair/pair_view.h"

namespace swiftlet {

/// Features of both bodies and a point that they share, rounded. Where one body lies inside the other and the surfaces share
/// nothing: a vertex of the inner one, no feature of the outer, and a point of both bodies.
struct Intersection {
  FeatureId a, b;
  Vec point;
};

/// `proof` proves that the bodies overlap. Cost: walks over facets, about as many as a cold march. Where one body lies inside
/// the other one exact walk for each of its vertices; where doubles cannot tell, one for each edge that begins outside the
/// other too. Each walk begins where the last one ended, mostly a facet or two away, so that the count is linear in the
/// features: 1 to 5 tests for each, whatever the ratio of sizes. At worst, where each goes around the whole other body, it is
/// the product of features, or what a hostile file costs: all known bounds below that take working memory [Chazelle 1992].
Intersection intersection(const PairView& pair, const OverlapProof& proof, std::uint32_t& plane_tests);

/// What holds a point of the common frame that lies on the surface but for law 2's bound: `known`, but where that is a vertex
/// and the point is elsewhere, the smallest feature within the bound; `known` again where no facet comes near. Certified
/// progress and the depth may end on vertices that no feature holds, near 0 or near the surface, and name one of them. Cost: of
/// the search all facets.
FeatureId feature_at_a(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests);
FeatureId feature_at_b(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests);

}  // namespace swiftlet
