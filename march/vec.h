// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The runtime's arithmetic on three numbers. Functions are static on purpose: every unit compiles its own copy under its own
// floating-point flags, and none can be replaced at link time by a consumer's.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

#include "tolerance.h"

namespace swiftlet {

/// Three numbers; Real is double, or DoubleDouble where doubles cannot tell.
template <class Real>
struct V3 {
  Real x, y, z;
};
using Vec = V3<double>;

template <class R>
static inline V3<R> operator+(const V3<R>& a, const V3<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
static inline V3<R> operator-(const V3<R>& a, const V3<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
static inline V3<R> operator-(const V3<R>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class R>
static inline V3<R> operator*(const V3<R>& a, const R& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class R>
static inline R dot(const V3<R>& a, const V3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
static inline V3<R> cross(const V3<R>& a, const V3<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Of two numbers that are no NaN. std::fmax is a call.
static inline double larger(double x, double y) { return x < y ? y : x; }
static inline double smaller(double x, double y) { return y < x ? y : x; }

/// The axis that `v` goes least along: one across it is far from it.
static inline Vec least_axis(const Vec& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x <= y && x <= z ? Vec{1, 0, 0} : y <= z ? Vec{0, 1, 0} : Vec{0, 0, 1};
}

/// Numbers only: a NaN may go unseen.
static inline double max_abs(const Vec& a) { return larger(larger(std::fabs(a.x), std::fabs(a.y)), std::fabs(a.z)); }
/// To kNormError; where squares underflow never less than the length.
static inline double norm(const Vec& a) {
  const double square = dot(a, a);
  if (!(square < kLeastSquare)) return std::sqrt(square);
  const double scale = max_abs(a);
  if (scale == 0) return 0;
  const Vec w{a.x / scale, a.y / scale, a.z / scale};
  return scale * std::sqrt(dot(w, w)) * (1 + kNormError) + std::numeric_limits<double>::denorm_min();
}

/// A vector at length 1, and what it was multiplied by; 0 and 0 where it names no direction. Short ones are scaled by their
/// largest coordinate: squares of 1e-200 are 0.
struct Unit {
  Vec n;
  double scale;
};
static inline Unit unit_of(const Vec& v) {
  if (const double square = dot(v, v); square >= kLeastSquare && square < std::numeric_limits<double>::infinity()) {
    const double scale = 1 / std::sqrt(square);
    return {v * scale, scale};
  }
  const double largest = max_abs(v);
  if (!(largest > kLeastDirection)) return {{0, 0, 0}, 0};
  const Vec w = v * (1 / largest);
  const double scale = 1 / norm(w);
  return {w * scale, scale * (1 / largest)};
}
static inline Vec normalised(const Vec& v) { return unit_of(v).n; }

/// The same direction, at a length where no product of its coordinates with a body's over- or underflows; 0 where it names
/// none.
static inline Vec rescaled(const Vec& v) {
  const double largest = max_abs(v);
  if (!(largest > 0) || !std::isfinite(dot(v, {0, 0, 0}))) return {0, 0, 0};
  const int exponent = 400 - std::ilogb(largest);
  return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

static inline Vec vec(const Vertex& v) { return {v.x, v.y, v.z}; }
static inline Vec vec(const Vec3& v) { return {v[0], v[1], v[2]}; }
static inline Vec3 eigen(const Vec& v) { return Vec3(v.x, v.y, v.z); }

/// A pose unpacked: rows of the rotation, translation.
struct Motion {
  Vec row_x, row_y, row_z, t;
};
static constexpr Motion kAtRest{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
static inline Motion motion(const Pose& pose) {
  const Mat3& r = pose.rotation;
  return {{r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}, vec(pose.translation)};
}
static inline Vec turn(const Motion& m, const Vec& p) { return {dot(m.row_x, p), dot(m.row_y, p), dot(m.row_z, p)}; }
static inline Vec apply(const Motion& m, const Vec& p) { return turn(m, p) + m.t; }
/// The transposed rotation: carries a direction n of the common frame to where n . (R p) = result . p.
static inline Vec turn_back(const Motion& m, const Vec& n) { return m.row_x * n.x + m.row_y * n.y + m.row_z * n.z; }

}  // namespace swiftlet
