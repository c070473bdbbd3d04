// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of the Minkowski difference {p - q} of the bodies of a scene, in doubles or in 106 bits.
#pragma once

#include <type_traits>

#include "scene.h"
#include "wide.h"

namespace swiftlet {

static inline double rounded(double x) { return x; }
static inline double rounded(const DoubleDouble& x) { return double(x); }
template <class Real>
static inline Vec rounded(const V3<Real>& v) {
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

/// The difference of a vertex pair: p = a - (R b + t).
template <class Real>
struct Difference {
  V3<Real> p;
  std::uint32_t a, b;
};

template <class Real>
static inline Difference<Real> difference(const Scene& s, std::uint32_t a, std::uint32_t b) {
  return {widened<Real>(vec(s.a.vertices[a])) - moved<Real>(s.b_in_a, vec(s.b.vertices[b])), a, b};
}

/// What rounding may do to a difference and to convex combinations of differences.
template <class Real>
static inline double rounding(const Scene& s) {
  return std::is_same_v<Real, double> ? s.point_error : kDoubleDoubleError * s.magnitude;
}

}  // namespace swiftlet
