// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of the Minkowski difference {p - q} of the bodies of a pair, in doubles or in 106 bits.
#pragma once

#include <type_traits>

#include "numeric/wide.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// The difference of a vertex pair: p = a - (R b + t).
template <class Real>
struct Difference {
  V3<Real> p;
  std::uint32_t a, b;
};

template <class Real>
static inline Difference<Real> difference(const PairView& s, std::uint32_t a, std::uint32_t b) {
  return {widened<Real>(vec(s.a.vertices[a])) - moved<Real>(s.b_in_a, vec(s.b.vertices[b])), a, b};
}

template <class Real>
static inline bool same(const Difference<Real>& p, const Difference<Real>& q) {
  return p.a == q.a && p.b == q.b;
}

/// Climbs the rings to a vertex that looks the highest along a direction of the body's own. Every vertex has one height,
/// rounded: none comes twice.
static inline std::uint32_t ascend(const ConvexView& view, const Vec& own, std::uint32_t v, std::uint32_t& plane_tests) {
  for (double most = dot(own, vec(view.vertices[v]));;) {
    const Vertex& ring = view.vertices[v];
    const std::uint32_t from = v;
    for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
      const double height = dot(own, vec(view.vertices[view.half_edges[h].head]));
      if (height > most) most = height, v = view.half_edges[h].head;
    }
    plane_tests += ring.ring_count;
    if (v == from) return v;
  }
}

/// What rounding may do to a difference and to convex combinations of differences.
template <class Real>
static inline double rounding(const PairView& s) {
  return std::is_same_v<Real, double> ? s.point_error : kDoubleDoubleError * s.magnitude;
}

}  // namespace swiftlet
