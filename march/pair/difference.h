// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Points of the Minkowski difference {p - q} of the bodies of a pair, in doubles or in 106 bits.
#pragma once

#include <array>
#include <type_traits>

#include "numeric/vec4.h"
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

namespace {
/// The differences of four vertex pairs, in lanes.
struct Differences {
  V3<Vec4> of_a, p;  ///< A's vertices, and the differences
  Differences(const PairView& s, const std::array<std::uint32_t, 4>& a, const std::array<std::uint32_t, 4>& b) {
    const Vertex *v = s.a.vertices.data(), *w = s.b.vertices.data();
    of_a = transposed(v[a[0]], v[a[1]], v[a[2]], v[a[3]]);
    const V3<Vec4> of_b = transposed(w[b[0]], w[b[1]], w[b[2]], w[b[3]]);
    const auto moved = [&of_b](const Vec& row, double t) { return of_b.x * row.x + of_b.y * row.y + of_b.z * row.z + all(t); };
    const Motion& m = s.b_in_a;
    p = of_a - V3<Vec4>{moved(m.row_x, m.t.x), moved(m.row_y, m.t.y), moved(m.row_z, m.t.z)};
  }
};
}  // namespace

/// A bound on the rounding error of a difference, and of a convex combination of differences, in `Real`. A length.
template <class Real>
static inline double rounding(const PairView& s) {
  return std::is_same_v<Real, double> ? s.point_error() : kDoubleDoubleError * s.magnitude;
}

}  // namespace swiftlet
