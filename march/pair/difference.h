// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of the Minkowski difference {p - q} of the bodies of a pair, in doubles or in 106 bits.
#pragma once

#include <type_traits>

#include "numeric/wide.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// The difference of vertex `a` of A and vertex `b` of B in the common frame: p = v - (R w + t), where v and w are the
/// vertices' coordinates.
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

/// A bound on the rounding error of a difference, and of a convex combination of differences, in `Real`. A length.
template <class Real>
static inline double rounding(const PairView& s) {
  return std::is_same_v<Real, double> ? s.point_error() : kDoubleDoubleError * s.magnitude;
}

}  // namespace swiftlet
