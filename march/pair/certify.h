// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From a feature pair to bounds that are true whatever brought it: a direction, the supports of both bodies in it, two points.
// Knows nothing of how the march came here.
#pragma once

#include <array>
#include <cstdint>

#include "body/support.h"
#include "pair/pair_view.h"
#include "pair/witness.h"

namespace swiftlet {

/// Vertex pairs and convex weights: a point of each body. What certified GJK starts from.
struct ActiveSet {
  int count = 0;
  std::array<std::uint32_t, 4> a{}, b{};
  std::array<double, 4> weight{};
};

struct Certificate {
  double lower = 0, upper = 0;  ///< proved bounds on the distance of the two polytopes; upper >= lower >= 0
  Vec normal{0, 0, 0};          ///< unit, from A to B; what lower is proved along
  Vec point_a{0, 0, 0}, point_b{0, 0, 0};
  ActiveSet active;                            ///< whose weights make the points; empty of features that prove all there is to
                                               ///< prove
  std::uint32_t support_a = 0, support_b = 0;  ///< vertices extreme along normal and -normal
};

/// Bounds from what features of `a` and `b`, any kinds but two faces, say of each other. Nothing more is read than the features
/// where what stands beside them is known to be below, else a climb.
Certificate certify(const PairView& pair, FeatureId a, FeatureId b, const Witness& seen, std::uint32_t& plane_tests);

/// Bounds within law 2's of each other leave a plane room to lean by the root of that: nearly parallel faces 1e-8, say. Whether
/// the points of a certificate do not differ by their distance times the normal within law 2's bound.
static inline bool leans(const PairView& pair, const Certificate& c) {
  const Vec apart = c.point_b - c.point_a, aside = apart - c.normal * norm(apart);
  return c.upper - c.lower <= pair.law_two && norm(aside) > pair.law_two;
}

/// The vertex of A farthest along n, climbed from `start` by exact comparisons: no vertex is farther.
static inline std::uint32_t support_a(const PairView& pair, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return support(pair.a, n, start, plane_tests);
}
/// The vertex of B least far along n.
static inline std::uint32_t support_b(const PairView& pair, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return support(pair.b, pair.b_in_a, -n, start, plane_tests);
}

/// Vertices extreme along a unit direction, as far as doubles can tell, and the gap that they prove, which may be negative.
struct Supports {
  std::uint32_t a, b;
  double lower;
};
Supports supports(const PairView& pair, const Vec& n, std::uint32_t start_a, std::uint32_t start_b, std::uint32_t& plane_tests);

/// A lower bound on n . c for unit n, less `slack`, where c is the rounded difference of a vertex of each body; may be
/// negative.
static inline double gap(const PairView& pair, const Vec& n, const Vec& c, double slack) {
  const double products = std::fabs(n.x * c.x) + std::fabs(n.y * c.y) + std::fabs(n.z * c.z);
  return dot(n, c) - (kGapError * products + pair.motion_error + slack);
}
double gap(const PairView& pair, const Vec& n, std::uint32_t va, std::uint32_t vb, double slack = 0);

/// An upper bound on the distance from one vertex pair.
double apart(const PairView& pair, std::uint32_t va, std::uint32_t vb);

}  // namespace swiftlet
