// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What two contact faces have in common, seen along one normal: its corners and the points of both bodies there. Knows nothing
// of which of them a manifold keeps.
#pragma once

#include <span>

#include "manifold/contact_face.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// A corner of the common area: points of both bodies, one above the other, what they lie on, and where they are seen.
struct Candidate {
  double x, y, separation;  ///< across the normal and along it
  Vec point_a, point_b;
  FeatureId feature_a, feature_b;
};

/// The most corners that two contact faces have in common.
inline constexpr std::size_t kMostCandidates = 2 * kMostCorners;

/// Two points as they are seen.
Candidate candidate(const Projection& projection, const Vec& point_a, const Vec& point_b, FeatureId feature_a,
                    FeatureId feature_b);

/// Fills `candidates` in order around the area and returns how many there are. What stands out by less than `bound`, at least
/// the rounding of the pair's points, is not cut off; the points lie one above the other within twice that. Cost: the product
/// of the corners.
int clip(const PairView& pair, const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
         std::span<Candidate, kMostCandidates> candidates);

}  // namespace swiftlet
