// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certified GJK: the way on where a walk stalls, a certificate fails, or bodies meet. Each step adds the vertex pair that
// the certificate exposed and takes the nearest point of at most four. Knows one level pair.
#pragma once

#include "pair/certify.h"
#include "pair/pair_view.h"

#include <swiftlet/march.h>

namespace swiftlet {

/// When bounds are narrow enough: see MarchRule.
struct GjkGoal {
  double absolute, relative;
  double beyond;  ///< law 2's bound above the caller's
  bool narrow(double lower, double upper) const { return upper - lower <= std::fmax(absolute, relative * lower); }
  bool met(double lower, double upper) const { return narrow(lower, upper) || lower > beyond; }
};

struct GjkResult {
  MarchStatus status = MarchStatus::NotConverged;  ///< Disjoint (the goal is met), Touching, Overlapping or NotConverged
  Certificate certificate;
  OverlapProof proof;
  double depth = 0;  ///< of Overlapping: a lower bound on the least translation that separates, 0 where none was needed
};

/// Continues from `start`, first in doubles, then with about 106 bits. The bounds it returns are true in any case.
GjkResult gjk(const PairView& pair, const Certificate& start, const GjkGoal& goal, std::uint32_t& plane_tests);

/// Whether four vertex pairs prove that the bodies overlap, by clearly more than law 2's bound.
bool proves_deep_overlap(const PairView& pair, const OverlapProof& proof);

/// Takes plane and points of a certificate that leans from one iterate of certified GJK in 106 bits, which does not; true
/// if so.
bool straighten(const PairView& pair, Certificate& certificate, std::uint32_t& plane_tests);

/// Improves a certificate's bounds by certified GJK in 106 bits, as far as these go: beyond law 2's.
void sharpen(const PairView& pair, Certificate& certificate, std::uint32_t& plane_tests);

/// The smallest feature that holds the active vertices of one body.
FeatureId feature_of(const ConvexView& view, const ActiveSet& active, const std::array<std::uint32_t, 4>& vertices);

}  // namespace swiftlet
