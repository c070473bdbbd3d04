// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Four and eight floats at a time: registers of SSE2, NEON or AVX. Every lane is rounded as the same operation on floats is, so
// all widths give the same bits. Functions are static, as those of vec.h.
#pragma once

#include <cmath>

#include "numeric/vec4.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace swiftlet {

/// A vector's x, y, z and a lane without meaning, or four numbers of one kind.
using Float4 = float __attribute__((vector_size(16)));

static inline Float4 float4(float x, float y, float z) { return Float4{x, y, z, 0}; }
static inline Float4 float4(const Vec4& v) {
#if defined(__AVX__)
  return _mm256_cvtpd_ps(v.v);
#elif defined(__SSE2__)
  return _mm_movelh_ps(_mm_cvtpd_ps(v.lo), _mm_cvtpd_ps(v.hi));
#else
  return Float4{float(v[0]), float(v[1]), float(v[2]), float(v[3])};
#endif
}
/// Three numbers, and a fourth one that follows them in memory.
static inline Float4 load4(const float* p) {
  Float4 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <int i>
static inline Float4 lane(Float4 a) {
  return __builtin_shufflevector(a, a, i, i, i, i);
}
static inline Float4 max(Float4 a, Float4 b) {
#if defined(__SSE2__)
  return _mm_max_ps(b, a);
#else
  return a < b ? b : a;
#endif
}
static inline Float4 min(Float4 a, Float4 b) {
#if defined(__SSE2__)
  return _mm_min_ps(b, a);
#else
  return b < a ? b : a;
#endif
}
/// The least of all four.
static inline float least(Float4 a) {
  const Float4 two = min(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return min(two, lane<1>(two))[0];
}
/// The greatest of all four.
static inline float greatest(Float4 a) {
  const Float4 two = max(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return max(two, lane<1>(two))[0];
}
static inline Float4 abs(Float4 a) {
#if defined(__SSE2__)
  return _mm_andnot_ps(Float4{-0.0f, -0.0f, -0.0f, -0.0f}, a);
#else
  return Float4{std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2]), std::fabs(a[3])};
#endif
}
static inline Float4 sqrt(Float4 a) {
#if defined(__SSE2__)
  return _mm_sqrt_ps(a);
#else
  return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}
/// `size`, which is not below 0, with the sign of `of`.
static inline Float4 with_sign(Float4 size, Float4 of) {
#if defined(__SSE2__)
  return _mm_or_ps(size, _mm_and_ps(Float4{-0.0f, -0.0f, -0.0f, -0.0f}, of));
#else
  return Float4{std::copysign(size[0], of[0]), std::copysign(size[1], of[1]), std::copysign(size[2], of[2]),
                std::copysign(size[3], of[3])};
#endif
}
/// In each lane `a` where p is at least q, else `b`.
static inline Float4 where_at_least(Float4 p, Float4 q, Float4 a, Float4 b) {
#if defined(__SSE2__)
  const Float4 chosen = _mm_cmpge_ps(p, q);
  return _mm_or_ps(_mm_and_ps(chosen, a), _mm_andnot_ps(chosen, b));
#else
  return p >= q ? a : b;
#endif
}
static inline Float4 cross(Float4 a, Float4 b) {
  const auto yzx = [](Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  const auto zxy = [](Float4 v) { return __builtin_shufflevector(v, v, 2, 0, 1, 3); };
  return yzx(a) * zxy(b) - zxy(a) * yzx(b);
}

/// A matrix by its columns, which times a vector is a sum of columns.
struct Columns {
  Float4 x, y, z;
  /// The matrix of these rows.
  static Columns of_rows(Float4 a, Float4 b, Float4 c) {
    const Float4 xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // ax bx ay by
    return {__builtin_shufflevector(xy, c, 0, 1, 4, 4), __builtin_shufflevector(xy, c, 2, 3, 5, 5),
            __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 6, 2, 6), c, 0, 1, 6, 6)};
  }
  Float4 operator*(Float4 v) const { return x * lane<0>(v) + y * lane<1>(v) + z * lane<2>(v); }
};

/// The sums of three vectors' x, y and z; the last one twice.
static inline Float4 sums(Float4 a, Float4 b, Float4 c) {
  const Columns of = Columns::of_rows(a, b, c);
  return of.x + of.y + of.z;
}

// Each width has a name of its own, so that no function of the one is taken for a function of the other.
#if defined(__AVX__)
struct Avx8 {
  using Register = float __attribute__((vector_size(32)));
  Register v;
};
/// Eight numbers of one kind.
using Float8 = Avx8;
static inline Float8 all8(float x) { return {Float8::Register{x, x, x, x, x, x, x, x}}; }
static inline Float8 load8(const float* p) { return {_mm256_load_ps(p)}; }
static inline void store(Float8 a, float* p) { _mm256_store_ps(p, a.v); }
static inline Float8 operator+(Float8 a, Float8 b) { return {a.v + b.v}; }
static inline Float8 operator-(Float8 a, Float8 b) { return {a.v - b.v}; }
static inline Float8 operator*(Float8 a, Float8 b) { return {a.v * b.v}; }
static inline Float8 operator/(Float8 a, Float8 b) { return {a.v / b.v}; }
static inline Float8 sqrt(Float8 a) { return {_mm256_sqrt_ps(a.v)}; }
static inline Float8 max(Float8 a, Float8 b) { return {_mm256_max_ps(b.v, a.v)}; }
static inline Float8 min(Float8 a, Float8 b) { return {_mm256_min_ps(b.v, a.v)}; }
static inline float greatest(Float8 a) {
  return greatest(max(Float4(_mm256_castps256_ps128(a.v)), _mm256_extractf128_ps(a.v, 1)));
}
static inline float least(Float8 a) { return least(min(Float4(_mm256_castps256_ps128(a.v)), _mm256_extractf128_ps(a.v, 1))); }
static inline Float8 abs(Float8 a) { return {_mm256_andnot_ps(all8(-0.0f).v, a.v)}; }
/// `size`, which is not below 0, with the sign of `of`.
static inline Float8 with_sign(Float8 size, Float8 of) { return {_mm256_or_ps(size.v, _mm256_and_ps(all8(-0.0f).v, of.v))}; }
/// In each lane `a` where p is at least q, else `b`.
static inline Float8 where_at_least(Float8 p, Float8 q, Float8 a, Float8 b) {
  return {_mm256_blendv_ps(b.v, a.v, _mm256_cmp_ps(p.v, q.v, _CMP_GE_OQ))};
}
static inline Float8 joined(Float4 low, Float4 high) { return {_mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1)}; }
static inline Float4 low(Float8 a) { return _mm256_castps256_ps128(a.v); }
static inline Float4 high(Float8 a) { return _mm256_extractf128_ps(a.v, 1); }
/// Lane i of each half in all lanes of that half.
template <int i>
static inline Float8 lanes(Float8 a) {
  return {__builtin_shufflevector(a.v, a.v, i, i, i, i, 4 + i, 4 + i, 4 + i, 4 + i)};
}
/// Bit i is set if lane i of `a` is at most that of `b`.
static inline unsigned at_most(Float8 a, Float8 b) { return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ))); }
#else
struct Pair8 {
  Float4 lo, hi;
};
using Float8 = Pair8;
static inline Float8 all8(float x) { return {Float4{x, x, x, x}, Float4{x, x, x, x}}; }
// Half by half: a struct copied as a whole goes through memory once more.
static inline Float8 load8(const float* p) { return {load4(p), load4(p + 4)}; }
static inline void store(Float8 a, float* p) {
  __builtin_memcpy(p, &a.lo, sizeof a.lo);
  __builtin_memcpy(p + 4, &a.hi, sizeof a.hi);
}
static inline Float8 operator+(Float8 a, Float8 b) { return {a.lo + b.lo, a.hi + b.hi}; }
static inline Float8 operator-(Float8 a, Float8 b) { return {a.lo - b.lo, a.hi - b.hi}; }
static inline Float8 operator*(Float8 a, Float8 b) { return {a.lo * b.lo, a.hi * b.hi}; }
static inline Float8 operator/(Float8 a, Float8 b) { return {a.lo / b.lo, a.hi / b.hi}; }
static inline Float8 sqrt(Float8 a) { return {sqrt(a.lo), sqrt(a.hi)}; }
static inline Float8 max(Float8 a, Float8 b) { return {max(a.lo, b.lo), max(a.hi, b.hi)}; }
static inline Float8 min(Float8 a, Float8 b) { return {min(a.lo, b.lo), min(a.hi, b.hi)}; }
static inline float greatest(Float8 a) { return greatest(max(a.lo, a.hi)); }
static inline float least(Float8 a) { return least(min(a.lo, a.hi)); }
static inline Float8 abs(Float8 a) { return {abs(a.lo), abs(a.hi)}; }
static inline Float8 with_sign(Float8 size, Float8 of) { return {with_sign(size.lo, of.lo), with_sign(size.hi, of.hi)}; }
static inline Float8 where_at_least(Float8 p, Float8 q, Float8 a, Float8 b) {
  return {where_at_least(p.lo, q.lo, a.lo, b.lo), where_at_least(p.hi, q.hi, a.hi, b.hi)};
}
static inline Float8 joined(Float4 low, Float4 high) { return {low, high}; }
static inline Float4 low(Float8 a) { return a.lo; }
static inline Float4 high(Float8 a) { return a.hi; }
template <int i>
static inline Float8 lanes(Float8 a) {
  return {lane<i>(a.lo), lane<i>(a.hi)};
}
static inline unsigned at_most(Float4 a, Float4 b) {
#if defined(__SSE2__)
  return unsigned(_mm_movemask_ps(_mm_cmple_ps(a, b)));
#else
  return (a[0] <= b[0]) + 2u * (a[1] <= b[1]) + 4u * (a[2] <= b[2]) + 8u * (a[3] <= b[3]);
#endif
}
static inline unsigned at_most(Float8 a, Float8 b) { return at_most(a.lo, b.lo) + 16u * at_most(a.hi, b.hi); }
#endif

/// The sums of x, y and z in each half, in all of its lanes.
static inline Float8 sums(Float8 a) { return lanes<0>(a) + lanes<1>(a) + lanes<2>(a); }

}  // namespace swiftlet
