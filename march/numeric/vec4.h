// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Four doubles at a time: one register of AVX, or two of SSE2 or NEON. Every lane is rounded as the same operation on doubles
// is and sums have the order of vec.h, so both widths give the same bits. Functions are static, as those of vec.h.
#pragma once

#include <array>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "numeric/vec.h"

namespace swiftlet {

using Vec2 = double __attribute__((vector_size(16)));

// Each width has a name of its own, so that no function of the one is taken for a function of the other.
#if defined(__AVX__)
struct Avx4 {
  using Register = double __attribute__((vector_size(32)));
  Register v;
  double operator[](int lane) const { return v[lane]; }
};
using Vec4 = Avx4;
#else
struct Pair4 {
  Vec2 lo, hi;
  double operator[](int lane) const { return lane < 2 ? lo[lane] : hi[lane - 2]; }
};
/// A vector's x, y, z and a lane without meaning, or four numbers of one kind.
using Vec4 = Pair4;
#endif

static inline Vec2 load2(const double* p) {
  Vec2 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

static inline Vec2 max(Vec2 a, Vec2 b) {
#if defined(__SSE2__)
  return _mm_max_pd(b, a);
#else
  return a < b ? b : a;
#endif
}

static inline Vec2 min(Vec2 a, Vec2 b) {
#if defined(__SSE2__)
  return _mm_min_pd(b, a);
#else
  return b < a ? b : a;
#endif
}
static inline Vec2 abs(Vec2 a) {
#if defined(__SSE2__)
  return _mm_andnot_pd(Vec2{-0.0, -0.0}, a);
#else
  return Vec2{std::fabs(a[0]), std::fabs(a[1])};
#endif
}
static inline Vec2 sqrt(Vec2 a) {
#if defined(__SSE2__)
  return _mm_sqrt_pd(a);
#else
  return Vec2{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
/// Bit i is set if lane i of `a` is at least that of `b`.
static inline unsigned at_least(Vec2 a, Vec2 b) {
#if defined(__SSE2__)
  return _mm_movemask_pd(_mm_cmpge_pd(a, b));
#else
  return (a[0] >= b[0]) + 2u * (a[1] >= b[1]);
#endif
}
/// The whole parts of numbers that are no NaN and fit.
static inline std::array<std::int32_t, 2> whole(Vec2 a) {
#if defined(__SSE2__)
  const __m128i whole = _mm_cvttpd_epi32(a);
  return {_mm_cvtsi128_si32(whole), _mm_cvtsi128_si32(_mm_shuffle_epi32(whole, 1))};
#else
  return {std::int32_t(a[0]), std::int32_t(a[1])};
#endif
}

#if defined(__AVX__)
static inline Vec4 vec4(Vec2 lo, Vec2 hi) { return {_mm256_insertf128_pd(_mm256_castpd128_pd256(lo), hi, 1)}; }
static inline Vec2 low(const Vec4& a) { return _mm256_castpd256_pd128(a.v); }
static inline Vec2 high(const Vec4& a) { return _mm256_extractf128_pd(a.v, 1); }
static inline Vec4 all(double x) { return {Vec4::Register{x, x, x, x}}; }
static inline Vec4 operator+(const Vec4& a, const Vec4& b) { return {a.v + b.v}; }
static inline Vec4 operator-(const Vec4& a, const Vec4& b) { return {a.v - b.v}; }
static inline Vec4 operator*(const Vec4& a, const Vec4& b) { return {a.v * b.v}; }
static inline Vec4 operator/(const Vec4& a, const Vec4& b) { return {a.v / b.v}; }
static inline Vec4 operator-(const Vec4& a) { return {-a.v}; }
static inline Vec4 max(const Vec4& a, const Vec4& b) { return {_mm256_max_pd(b.v, a.v)}; }
static inline Vec4 min(const Vec4& a, const Vec4& b) { return {_mm256_min_pd(b.v, a.v)}; }
static inline Vec4 abs(const Vec4& a) { return {_mm256_andnot_pd(all(-0.0).v, a.v)}; }
template <int i>
static inline Vec4 lane(const Vec4& a) {
  return {__builtin_shufflevector(a.v, a.v, i, i, i, i)};
}
static inline Vec4 halves_swapped(const Vec4& a) { return {_mm256_permute2f128_pd(a.v, a.v, 1)}; }
static inline Vec4 zxy(const Vec4& a) { return {__builtin_shufflevector(a.v, a.v, 2, 0, 1, 3)}; }
static inline Vec4 yzx(const Vec4& a) { return {__builtin_shufflevector(a.v, a.v, 1, 2, 0, 3)}; }
/// In each lane what the lane after it, or before it, holds; after the last comes the first.
static inline Vec4 next(const Vec4& a) { return {__builtin_shufflevector(a.v, a.v, 1, 2, 3, 0)}; }
static inline Vec4 previous(const Vec4& a) { return {__builtin_shufflevector(a.v, a.v, 3, 0, 1, 2)}; }
static inline Vec4 sqrt(const Vec4& a) { return {_mm256_sqrt_pd(a.v)}; }
/// a0 b0 a2 b2 and a1 b1 a3 b3.
static inline Vec4 even(const Vec4& a, const Vec4& b) { return {__builtin_shufflevector(a.v, b.v, 0, 4, 2, 6)}; }
static inline Vec4 odd(const Vec4& a, const Vec4& b) { return {__builtin_shufflevector(a.v, b.v, 1, 5, 3, 7)}; }
/// Bit i is set if lane i of `a` is equal to, or greater than, that of `b`.
static inline unsigned equal(const Vec4& a, const Vec4& b) { return _mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)); }
static inline unsigned greater(const Vec4& a, const Vec4& b) { return _mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)); }
static inline unsigned at_most(const Vec4& a, const Vec4& b) { return _mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)); }
#else
static inline Vec4 vec4(Vec2 lo, Vec2 hi) { return {lo, hi}; }
static inline Vec2 low(const Vec4& a) { return a.lo; }
static inline Vec2 high(const Vec4& a) { return a.hi; }
static inline Vec4 all(double x) { return {Vec2{x, x}, Vec2{x, x}}; }
static inline Vec4 operator+(const Vec4& a, const Vec4& b) { return {a.lo + b.lo, a.hi + b.hi}; }
static inline Vec4 operator-(const Vec4& a, const Vec4& b) { return {a.lo - b.lo, a.hi - b.hi}; }
static inline Vec4 operator*(const Vec4& a, const Vec4& b) { return {a.lo * b.lo, a.hi * b.hi}; }
static inline Vec4 operator/(const Vec4& a, const Vec4& b) { return {a.lo / b.lo, a.hi / b.hi}; }
static inline Vec4 operator-(const Vec4& a) { return {-a.lo, -a.hi}; }
template <int i>
static inline Vec4 lane(const Vec4& a) {
  return all(a[i]);
}
static inline Vec4 yzx(const Vec4& a) { return {__builtin_shufflevector(a.lo, a.hi, 1, 2), a.lo}; }
static inline Vec4 next(const Vec4& a) {
  return {__builtin_shufflevector(a.lo, a.hi, 1, 2), __builtin_shufflevector(a.hi, a.lo, 1, 2)};
}
static inline Vec4 previous(const Vec4& a) {
  return {__builtin_shufflevector(a.hi, a.lo, 1, 2), __builtin_shufflevector(a.lo, a.hi, 1, 2)};
}
static inline Vec4 sqrt(const Vec4& a) { return {sqrt(a.lo), sqrt(a.hi)}; }
static inline Vec4 even(const Vec4& a, const Vec4& b) {
  return {__builtin_shufflevector(a.lo, b.lo, 0, 2), __builtin_shufflevector(a.hi, b.hi, 0, 2)};
}
static inline Vec4 odd(const Vec4& a, const Vec4& b) {
  return {__builtin_shufflevector(a.lo, b.lo, 1, 3), __builtin_shufflevector(a.hi, b.hi, 1, 3)};
}
static inline Vec4 max(const Vec4& a, const Vec4& b) { return {max(a.lo, b.lo), max(a.hi, b.hi)}; }
static inline Vec4 min(const Vec4& a, const Vec4& b) { return {min(a.lo, b.lo), min(a.hi, b.hi)}; }
static inline Vec4 abs(const Vec4& a) { return {abs(a.lo), abs(a.hi)}; }
#if defined(__SSE2__)
static inline unsigned equal(const Vec4& a, const Vec4& b) {
  return _mm_movemask_pd(_mm_cmpeq_pd(a.lo, b.lo)) + 4u * _mm_movemask_pd(_mm_cmpeq_pd(a.hi, b.hi));
}
static inline unsigned greater(const Vec4& a, const Vec4& b) {
  return _mm_movemask_pd(_mm_cmpgt_pd(a.lo, b.lo)) + 4u * _mm_movemask_pd(_mm_cmpgt_pd(a.hi, b.hi));
}
static inline unsigned at_most(const Vec4& a, const Vec4& b) {
  return _mm_movemask_pd(_mm_cmple_pd(a.lo, b.lo)) + 4u * _mm_movemask_pd(_mm_cmple_pd(a.hi, b.hi));
}
#else
static inline unsigned equal(const Vec4& a, const Vec4& b) {
  return (a[0] == b[0]) + 2u * (a[1] == b[1]) + 4u * (a[2] == b[2]) + 8u * (a[3] == b[3]);
}
static inline unsigned greater(const Vec4& a, const Vec4& b) {
  return (a[0] > b[0]) + 2u * (a[1] > b[1]) + 4u * (a[2] > b[2]) + 8u * (a[3] > b[3]);
}
static inline unsigned at_most(const Vec4& a, const Vec4& b) {
  return (a[0] <= b[0]) + 2u * (a[1] <= b[1]) + 4u * (a[2] <= b[2]) + 8u * (a[3] <= b[3]);
}
#endif
#endif

static inline Vec4 operator*(const Vec4& a, double s) { return a * all(s); }
/// The lanes of `a` where `x` is above 0, else those of `b`.
static inline Vec4 where_positive(const Vec4& x, const Vec4& a, const Vec4& b) {
#if defined(__AVX__)
  return {x.v > 0 ? a.v : b.v};
#else
  return {x.lo > 0 ? a.lo : b.lo, x.hi > 0 ? a.hi : b.hi};
#endif
}
static inline Vec4 vec4(double x, double y, double z) { return vec4(Vec2{x, y}, Vec2{z, z}); }
// Coordinates of a vector are loaded one by one: they may have been stored so a moment ago, and a wider load would wait until
// that is done, for 10 ns. Records of a model are at rest.
static inline Vec2 xy(const Vec& a) { return Vec2{a.x, a.y}; }
template <class Record>
static inline Vec2 xy(const Record& p) {
  return load2(&p.x);
}
static inline Vec4 vec4(const Vec& a) { return vec4(xy(a), Vec2{a.z, a.z}); }
/// The coordinates of a record that begins with them.
template <class Record>
static inline Vec4 vec4(const Record& p) {
#if defined(__AVX__)
  return {_mm256_maskload_pd(&p.x, _mm256_setr_epi64x(-1, -1, -1, 0))};
#else
  return vec4(load2(&p.x), Vec2{p.z, 0});
#endif
}
static inline Vec4 vec4(const Padded& a) {
#if defined(__AVX__)
  return {_mm256_load_pd(&a.x)};
#else
  return vec4(load2(&a.x), load2(&a.z));
#endif
}
static inline void store(const Vec4& a, Padded& p) {
#if defined(__AVX__)
  _mm256_store_pd(&p.x, a.v);
#else
  __builtin_memcpy(&p.x, &a.lo, sizeof a.lo);
  __builtin_memcpy(&p.z, &a.hi, sizeof a.hi);
#endif
}
/// A pose as vectors. Its numbers are loaded one by one, as those of a vector.
static inline Motion motion(const Pose& pose) {
  const double *r = pose.rotation.data(), *t = pose.translation.data();
  const auto row = [r](int i) { return vec4(Vec2{r[i], r[3 + i]}, Vec2{r[6 + i], 0}); };
  Motion m;
  store(row(0), m.row_x), store(row(1), m.row_y), store(row(2), m.row_z);
  store(vec4(t[0], t[1], t[2]), m.t);
  return m;
}
/// Three integers. What follows them in memory is read too.
static inline Vec4 vec4(const std::int16_t* p) {
#if defined(__AVX__)
  return {_mm256_cvtepi32_pd(_mm_cvtepi16_epi32(_mm_loadu_si64(p)))};
#else
  std::int16_t __attribute__((vector_size(8))) units;
  __builtin_memcpy(&units, p, sizeof units);
#if defined(__SSE2__)
  __m128i wide;
  __builtin_memcpy(&wide, &units, sizeof units);
  const __m128i whole = _mm_srai_epi32(_mm_unpacklo_epi16(wide, wide), 16);
  return {_mm_cvtepi32_pd(whole), _mm_cvtepi32_pd(_mm_unpackhi_epi64(whole, whole))};
#else
  return vec4(Vec2{double(units[0]), double(units[1])}, Vec2{double(units[2]), double(units[3])});
#endif
#endif
}
/// Stores x, y and z, whose magnitudes are below 2^15, without their fractions.
static inline void store_units(const Vec4& a, std::int16_t* p) {
#if defined(__AVX__)
  const __m128i whole = _mm256_cvttpd_epi32(a.v);
#elif defined(__SSE2__)
  const __m128i whole = _mm_unpacklo_epi64(_mm_cvttpd_epi32(a.lo), _mm_cvttpd_epi32(a.hi));
#endif
#if defined(__SSE2__)
  const __m128i units = _mm_packs_epi32(whole, whole);
  const int x_y = _mm_cvtsi128_si32(units);
  __builtin_memcpy(p, &x_y, sizeof x_y);
  p[2] = std::int16_t(_mm_extract_epi16(units, 2));
#else
  for (int i = 0; i < 3; ++i) p[i] = std::int16_t(a[i]);
#endif
}
static inline Vec vec(const Vec4& a) { return {a[0], a[1], a[2]}; }

/// The sum of x, y and z, and the dot product of such vectors.
static inline double sum(const Vec4& a) { return a[0] + a[1] + a[2]; }
static inline double dot(const Vec4& a, const Vec4& b) { return sum(a * b); }
#if defined(__AVX__)
static inline Vec4 cross(const Vec4& a, const Vec4& b) { return zxy(zxy(a) * b - a * zxy(b)); }
#else
static inline Vec4 cross(const Vec4& a, const Vec4& b) { return yzx(a * yzx(b) - yzx(a) * b); }
#endif
static inline double norm_1(const Vec4& a) { return sum(abs(a)); }
// Of vectors whose squares leave the range of doubles. By value: a vector whose address is known elsewhere has to be in memory.
[[maybe_unused, gnu::noinline, gnu::cold]] static double norm_of_far(Vec4 v) { return norm(vec(v)); }
[[maybe_unused, gnu::noinline, gnu::cold]] static Vec4 normalised_far(const Vec4& v) { return vec4(normalised(vec(v))); }
static inline double norm(const Vec4& v) {
  const double square = dot(v, v);
  return has_range(square) ? std::sqrt(square) : norm_of_far(v);
}
static inline Vec4 normalised(const Vec4& v) {
  const double square = dot(v, v);
  return has_range(square) ? v * (1 / std::sqrt(square)) : normalised_far(v);
}

/// The greatest, and the least, of four numbers.
static inline double greatest(const Vec4& a) {
  const Vec2 pairs = max(low(a), high(a));
  return max(pairs[0], pairs[1]);
}
static inline double least(const Vec4& a) {
  const Vec2 pairs = min(low(a), high(a));
  return min(pairs[0], pairs[1]);
}

/// The greatest in every lane.
static inline Vec4 all_greatest(const Vec4& a) {
#if defined(__AVX__)
  const Vec4 pairs = max(a, halves_swapped(a));
  return max(pairs, Vec4{__builtin_shufflevector(pairs.v, pairs.v, 1, 0, 3, 2)});
#else
  const Vec2 pairs = max(a.lo, a.hi), most = max(pairs, __builtin_shufflevector(pairs, pairs, 1, 0));
  return {most, most};
#endif
}

/// The sums of x, y and z of two vectors, and two dot products.
static inline Vec2 sums(const Vec4& p, const Vec4& q) {
  const Vec4 x_z = even(p, q);
  return low(x_z) + low(odd(p, q)) + high(x_z);
}
static inline Vec2 dots(const Vec4& a, const Vec4& b, const Vec4& c, const Vec4& d) { return sums(a * b, c * d); }
/// Four dot products of vectors.
static inline Vec4 dots(const Vec4& a, const Vec4& b, const Vec4& c, const Vec4& d, const Vec4& e, const Vec4& f, const Vec4& g,
                        const Vec4& h) {
  const Vec4 p = a * b, q = c * d, r = e * f, s = g * h;
  const Vec4 pq = even(p, q), rs = even(r, s), xy_pq = pq + odd(p, q), xy_rs = rs + odd(r, s);
  return vec4(low(xy_pq), low(xy_rs)) + vec4(high(pq), high(rs));
}

/// Four points: their x, their y and their z.
template <class Point>
static inline V3<Vec4> transposed(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vec4 ac = vec4(xy(a), xy(c)), bd = vec4(xy(b), xy(d));
  return {even(ac, bd), odd(ac, bd), vec4(Vec2{a.z, b.z}, Vec2{c.z, d.z})};
}
/// A vector four times.
static inline V3<Vec4> repeated(const Vec4& a) { return {lane<0>(a), lane<1>(a), lane<2>(a)}; }
static inline V3<Vec4> repeated(const Vec& a) { return {all(a.x), all(a.y), all(a.z)}; }
/// The point in one lane.
static inline Vec vec(const V3<Vec4>& points, std::size_t lane) {
  return {points.x[int(lane)], points.y[int(lane)], points.z[int(lane)]};
}

}  // namespace swiftlet
