// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Voronoi marching on one level pair [Ehmann & Lin 2000, sec. 5.1], frozen: from any feature pair to one that looks nearest in
// doubles. Proves nothing.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/march.h>
#include <swiftlet/model.h>

#include "geometry.h"

namespace swiftlet::yardstick {

/// One level pair and one pose. The bounds are what a proof of the answer would need: no walk reads them, each pays for them,
/// as when it was recorded.
struct Pair {
  const ConvexView& a;
  const ConvexView& b;
  const Motion& b_in_a;
  double magnitude;     ///< bounds |p| and |R q + t| over all points, summed
  double motion_error;  ///< of the rounding of a vertex of B carried into A's frame
  double point_error;   ///< of the rounding of two convex combinations of such vertices, one of each body
  double pose_error;    ///< largest entry of |R^T R - I|
  double width;         ///< that an exact answer keeps
};
static inline Pair pair_of(const ConvexView& a, const ConvexView& b, const Motion& m, double pose_error) {
  constexpr double kU = 0x1p-53, kSqrt3 = 1.7320508075688774;
  const double shift = norm(m.t), stretch = kSqrt3 * (1 + pose_error), magnitude = stretch * (a.extent + b.extent) + shift,
               motion_error = 7 * kU * stretch * b.extent + 2 * kU * shift;
  const double width = larger((64 * kU + 2 * larger(0, pose_error - 4 * kU)) * (larger(a.extent, b.extent) + shift), 0x1p-450);
  return {a, b, m, magnitude, motion_error, 7 * kU * magnitude + motion_error, pose_error, width};
}

/// A convex combination of vertices of one body, those with weights first.
struct Combination {
  std::array<std::uint32_t, 3> vertex;
  std::array<double, 3> weight;
};

/// What the last state says of the distance.
struct Witness {
  Vec normal;  ///< from the first body to the second, A's frame, any length
  Combination first, second;
  double rise_first, rise_second;  ///< of what stands beside each feature, along the normal; infinite where nobody looked
};

enum class WalkEnd : std::uint8_t {
  Minimum,  ///< no Voronoi plane of either feature is violated
  Inside,   ///< a vertex below a face, or an edge through one: overlapping, or a start behind the body
  Stalled,  ///< a dozen states did not shorten the distance
  Going,
};

struct Walk {
  WalkEnd end = WalkEnd::Going;
  FeatureId a, b;       ///< kinds VV, VE, EV, EE, VF, FV; with Inside also EF and FE
  double distance = 0;  ///< between the features, rounded; what Minimum found, elsewhere the least seen
  std::uint32_t steps = 0, plane_tests = 0;
  Witness witness;  ///< with Minimum: what the last state saw
};

/// `a` and `b` name features of the pair's views, not both faces.
Walk walk(const Pair& pair, FeatureId a, FeatureId b, PlaneRule rule);

}  // namespace swiftlet::yardstick
