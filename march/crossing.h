// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the surfaces of bodies that overlap meet: features of both that share a point, proved exactly. What reads tags wants it;
// the queries do not. Knows one level pair.
#pragma once

#include <swiftlet/march.h>

#include "scene.h"

namespace swiftlet {

/// Features of both bodies and a point that they share, rounded. Where one body lies inside the other and the surfaces share
/// nothing: a vertex of the inner one, no feature of the outer, and a point of both bodies.
struct Crossing {
  Handle a, b;
  Vec point;
};

/// `proof` proves that the bodies overlap. Cost: walks over facets, about as many as a cold march; where one body lies inside the
/// other once over its vertices; where doubles cannot tell, over all edges and facets.
Crossing crossing(const Scene& scene, const OverlapProof& proof, std::uint32_t& plane_tests);

}  // namespace swiftlet
