// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Points and directions in doubles or, where doubles are not precise enough, in about 106 bits.
#pragma once

#include "numeric/double_double.h"
#include "numeric/vec.h"

namespace swiftlet {

template <class Real>
static inline V3<Real> widened(const Vec& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}
static inline double rounded(double x) { return x; }
static inline double rounded(const DoubleDouble& x) { return double(x); }
template <class Real>
static inline Vec rounded(const V3<Real>& v) {
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

/// R p + t in the arithmetic of `Real`.
template <class Real>
static inline V3<Real> moved(const Motion& m, const Vec& p) {
  const V3<Real> q = widened<Real>(p);
  return V3<Real>{dot(widened<Real>(m.row_x), q), dot(widened<Real>(m.row_y), q), dot(widened<Real>(m.row_z), q)} +
         widened<Real>(m.t);
}

using Wide = V3<DoubleDouble>;
static inline Wide wide(const Vec& v) { return widened<DoubleDouble>(v); }
static inline Wide wide(const Motion& m, const Vec& p) { return moved<DoubleDouble>(m, p); }

}  // namespace swiftlet
