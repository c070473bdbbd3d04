// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certified GJK [Gilbert, Johnson & Keerthi 1988], for walks that stall, certificates too wide, and bodies that meet. Each step
// adds the support vertices' difference to at most three others and finds their hull's nearest point. Knows one level pair.
// Two more loops of the algorithm stand beside it: on support maps (support_gjk.h), and on the few vertices of two features
// (overlap.h).
#pragma once

#include "pair/certify.h"
#include "pair/pair_view.h"
#include "pair/stop_rule.h"

#include <swiftlet/march.h>

namespace swiftlet {

struct GjkResult {
  MarchStatus status = MarchStatus::NotConverged;  ///< Disjoint (`stop` is met), Touching, Overlapping or NotConverged
  Certificate certificate;
  OverlapProof proof;
  double depth = 0;  ///< if Overlapping: a lower bound on the least translation that separates the bodies; 0: none is known
};

/// Continues from the active set of `start`, first in doubles and, if these do not decide, in about 106 bits. The returned
/// bounds are true whatever the status.
GjkResult gjk(const PairView& pair, const Certificate& start, const StopRule& stop, std::uint32_t& plane_tests);

/// Replaces plane and points of a certificate that leans by those of a single iterate of certified GJK in 106 bits. Returns
/// false, and changes nothing, if GJK does not reach law 2's width.
bool straighten(const PairView& pair, Certificate& certificate, std::uint32_t& plane_tests);

/// Narrows a certificate's bounds by certified GJK in 106 bits as far as that arithmetic goes: to less than law 2's width.
void sharpen(const PairView& pair, Certificate& certificate, std::uint32_t& plane_tests);

/// The smallest feature that holds `vertices`, one body's side of the pairs of `active`; else the vertex of greatest weight.
FeatureId feature_of(const ConvexView& view, const ActiveSet& active, const std::array<std::uint32_t, 4>& vertices);

}  // namespace swiftlet
