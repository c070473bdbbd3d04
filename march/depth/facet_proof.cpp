// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The proof of depth with registers that every processor of the target has: see width.h.
#include "depth/facet_proof.h"

#include "depth/facet_prover.h"

namespace swiftlet {

bool SWIFTLET_OF_WIDTH(prove_facet)(const PairView& pair, const Level& a, const Level& b, const DepthStart& start,
                                    const Ceiling& ceiling, const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth) {
  return proves_facet(pair, a, b, start, ceiling, goal, plane_tests, depth);
}

}  // namespace swiftlet
