// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The runtime's arithmetic on vectors of three numbers. Functions are static on purpose: every translation unit compiles its
// own copy under its own floating-point flags, and none can be replaced at link time by a consumer's.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <double_bits.h>
#include <swiftlet/pose.h>

#include "numeric/tolerance.h"

namespace swiftlet {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Three numbers. Real is double, or DoubleDouble where doubles are not precise enough.
template <class Real>
struct V3 {
  Real x, y, z;
};
using Vec = V3<double>;
/// A vector with room for a fourth number, so that a register of four stores and loads it whole.
struct alignas(32) Padded : Vec {
  Padded() = default;
  constexpr Padded(double of_x, double of_y, double of_z) : Vec{of_x, of_y, of_z}, fourth(0) {}
  constexpr Padded(const Vec& v) : Padded(v.x, v.y, v.z) {}
  double fourth;  ///< without meaning
};

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

/// The larger of two numbers that are no NaN. `std::fmax` would be a function call.
static inline double max(double x, double y) { return x < y ? y : x; }
static inline double min(double x, double y) { return y < x ? y : x; }

/// The unit vector of the axis along which the coordinate of `v` has the least magnitude: it is far from parallel to `v`.
static inline Vec least_axis(const Vec& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x <= y && x <= z ? Vec{1, 0, 0} : y <= z ? Vec{0, 1, 0} : Vec{0, 0, 1};
}

/// The largest magnitude of a coordinate. A NaN may be overlooked.
static inline double max_abs(const Vec& a) { return max(max(std::fabs(a.x), std::fabs(a.y)), std::fabs(a.z)); }
/// The sum of the coordinates' magnitudes.
static inline double norm_1(const Vec& a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

/// True if a sum of squares has lost nothing to underflow and is finite.
static inline bool has_range(double square) { return square >= kLeastSquare && square < kInfinity; }
/// `v` times 2^exponent.
static inline Vec scaled(const Vec& v, int exponent) {
  return {times_power_of_two(v.x, exponent), times_power_of_two(v.y, exponent), times_power_of_two(v.z, exponent)};
}

// The next functions scale vectors whose squares leave the range of doubles by a power of two. A vector times a power of two
// then has its length times that power and its direction, bit for bit.

/// The length of a vector, right to `kNormError`. A subnormal length is not below the true one.
static inline double norm(const Vec& a) {
  if (const double square = dot(a, a); has_range(square)) return std::sqrt(square);
  const double largest = max_abs(a);
  if (!(largest > 0 && std::isfinite(largest))) return largest;
  const int exponent = exponent_of(largest);
  const Vec w = scaled(a, -exponent);
  const double length = times_power_of_two(std::sqrt(dot(w, w)), exponent);
  return length < std::numeric_limits<double>::min() ? length + std::numeric_limits<double>::denorm_min() : length;
}

/// A vector at length 1 and the factor that scaled it. Both are 0 for a vector too short or too long to name a direction.
struct Unit {
  Vec n;
  double scale;
};
static inline Unit unit_of(const Vec& v) {
  if (const double square = dot(v, v); has_range(square)) {
    const double scale = 1 / std::sqrt(square);
    return {v * scale, scale};
  }
  const double largest = max_abs(v);
  if (!(largest > kLeastDirection && std::isfinite(largest))) return {{0, 0, 0}, 0};
  const int exponent = exponent_of(largest);
  const Vec w = scaled(v, -exponent);
  const double scale = 1 / std::sqrt(dot(w, w));
  return {w * scale, times_power_of_two(scale, -exponent)};
}
static inline Vec normalised(const Vec& v) { return unit_of(v).n; }

/// `v` times a power of two, at a length where no product of its coordinates with a body's over- or underflows. 0 if `v` is 0
/// or not finite.
static inline Vec rescaled(const Vec& v) {
  const double largest = max_abs(v);
  if (!(largest > 0) || !std::isfinite(dot(v, {0, 0, 0}))) return {0, 0, 0};
  return scaled(v, 400 - exponent_of(largest));
}

/// The coordinates of a record that names them x, y and z, as `Vertex` does.
template <class Point>
requires requires(const Point& p) { p.x; }
static inline Vec vec(const Point& p) { return {p.x, p.y, p.z}; }
static inline Vec vec(const Vec3& v) { return {v[0], v[1], v[2]}; }
static inline Vec3 eigen(const Vec& v) { return Vec3(v.x, v.y, v.z); }

/// A pose as vectors: the rows of its rotation R, and its translation t.
struct Motion {
  Padded row_x, row_y, row_z, t;
};
static constexpr Motion kAtRest{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
static inline Vec rotate(const Motion& m, const Vec& p) { return {dot(m.row_x, p), dot(m.row_y, p), dot(m.row_z, p)}; }
static inline Vec apply(const Motion& m, const Vec& p) { return rotate(m, p) + m.t; }
/// R^T n, which orders points of the moved body's own frame as n orders their images: n . (R p) = result . p.
static inline Vec rotate_back(const Motion& m, const Vec& n) { return m.row_x * n.x + m.row_y * n.y + m.row_z * n.z; }

}  // namespace swiftlet
