// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What two outlines have in common, seen along one normal: its corners and the points of both bodies there. Knows nothing of
// which of them a manifold keeps.
#pragma once

#include <span>

#include "manifold/contact_face.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// A corner of the common area: points of both bodies, one above the other, what they lie on, and where they are seen.
struct Spot {
  double x, y, separation;  ///< across the normal and along it
  Vec point_a, point_b;
  FeatureId feature_a, feature_b;
};

/// The most corners that two outlines have in common.
inline constexpr std::size_t kMostSpots = 2 * kMostCorners;

/// Two points as they are seen.
Spot spot(const Across& across, const Vec& point_a, const Vec& point_b, FeatureId feature_a, FeatureId feature_b);

/// Fills `spots` in order around the area and returns how many there are. What stands out by less than `bound`, at least the
/// rounding of the scene's points, is not cut off; the points lie one above the other within twice that.
/// Cost: the product of the corners.
int overlay(const Scene& scene, const Across& across, const Outline& a, const Outline& b, double bound,
            std::span<Spot, kMostSpots> spots);

}  // namespace swiftlet
