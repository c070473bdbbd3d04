// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The exact predicates against 128-bit integers, at every scale that doubles name exactly. Knows exact.h.
#include "numeric/exact.h"

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "numeric/vec4.h"

#ifdef __SIZEOF_INT128__  // GCC has none of these on machines of 32 bits

namespace swiftlet::exact {
namespace {

using Wide = __int128;
using Integers = std::array<std::int64_t, 3>;
using Doubles = std::array<double, 3>;

int sign(Wide x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
Wide dot(const Integers& a, const std::array<Wide, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
std::array<Wide, 3> cross(const Integers& a, const Integers& b) {
  return {Wide(a[1]) * b[2] - Wide(a[2]) * b[1], Wide(a[2]) * b[0] - Wide(a[0]) * b[2], Wide(a[0]) * b[1] - Wide(a[1]) * b[0]};
}
Integers operator-(const Integers& a, const Integers& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Integers operator+(const Integers& a, const Integers& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Integers operator*(std::int64_t s, const Integers& a) { return {s * a[0], s * a[1], s * a[2]}; }
Wide determinant(const Integers& a, const Integers& b, const Integers& c) { return dot(c, cross(a, b)); }

Doubles scaled(const Integers& a, int exponent) {
  return {std::ldexp(double(a[0]), exponent), std::ldexp(double(a[1]), exponent), std::ldexp(double(a[2]), exponent)};
}

/// How often each sign came: a generator that never hits zero tests nothing.
struct Census {
  std::array<int, 3> seen{};
  void add(int s) { ++seen[std::size_t(s + 1)]; }
  void expect_each_at_least(int count) const {
    for (const int n : seen) EXPECT_GE(n, count);
  }
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  std::int64_t integer(std::int64_t limit) { return std::uniform_int_distribution<std::int64_t>(-limit, limit)(engine_); }
  Integers vector(std::int64_t limit) { return {integer(limit), integer(limit), integer(limit)}; }
  /// Every third time all zero but one coordinate of one.
  Integers speck() {
    Integers e{};
    if (integer(1) != 0) e[std::size_t(integer(1) + 1)] = integer(1);
    return e;
  }

 private:
  std::mt19937_64 engine_;
};

constexpr int kScales[] = {-200, -60, -1, 0, 7, 60, 160};
constexpr int kTries = 4000;
// Coordinates of 40 bits: products of two are past 53 bits, those of three within 127.
constexpr std::int64_t kSmall = 3, kLarge = std::int64_t{1} << 36;

TEST(Exact, OrientationIsTheDeterminantsSign) {
  Draw draw(1);
  for (const int scale : kScales) {
    Census census;
    for (int i = 0; i < kTries; ++i) {
      const std::int64_t limit = i % 2 ? kSmall : kLarge;
      const Integers a = draw.vector(limit), b = draw.vector(limit), c = draw.vector(limit);
      // In the plane of a, b, c, or beside it by one unit.
      const Integers d =
          i % 4 < 2 ? draw.vector(limit) : a + draw.integer(3) * (b - a) + draw.integer(3) * (c - a) + draw.speck();
      const int expected = sign(determinant(b - a, c - a, d - a));
      ASSERT_EQ(orientation(scaled(a, scale).data(), scaled(b, scale).data(), scaled(c, scale).data(), scaled(d, scale).data()),
                expected)
          << i;
      census.add(expected);
    }
    census.expect_each_at_least(kTries / 8);
  }
}

TEST(Exact, OrientationIsPositiveOnTheCounterClockwiseSide) {
  const Doubles a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, above{0.2, 0.2, 0x1p-200}, below{9, -7, -0x1p-200};
  EXPECT_EQ(orientation(a.data(), b.data(), c.data(), above.data()), 1);
  EXPECT_EQ(orientation(a.data(), b.data(), c.data(), below.data()), -1);
  EXPECT_EQ(orientation(b.data(), a.data(), c.data(), above.data()), -1);
}

TEST(Exact, CollinearIsExact) {
  Draw draw(2);
  for (const int scale : kScales) {
    int on = 0;
    for (int i = 0; i < kTries; ++i) {
      const Integers a = draw.vector(kLarge), b = draw.vector(kLarge), c = a + draw.integer(8) * (b - a) + draw.speck();
      const bool expected = cross(b - a, c - a) == std::array<Wide, 3>{};
      ASSERT_EQ(collinear(scaled(a, scale).data(), scaled(b, scale).data(), scaled(c, scale).data()), expected) << i;
      on += expected;
    }
    EXPECT_GE(on, kTries / 4);
    EXPECT_LE(on, kTries * 3 / 4);
  }
}

TEST(Exact, CompareAlongIsTheDotsSign) {
  Draw draw(3);
  for (const int scale : kScales) {
    Census census;
    for (int i = 0; i < kTries; ++i) {
      const Integers n = draw.vector(1 << 19), q = draw.vector(1 << 19), v = draw.vector(kLarge);
      const auto across = cross(n, q);  // perpendicular to n, below 2^40
      const Integers w = v + Integers{std::int64_t(across[0]), std::int64_t(across[1]), std::int64_t(across[2])} + draw.speck();
      const Integers e = w - v;
      const int expected = sign(dot(n, {e[0], e[1], e[2]}));
      ASSERT_EQ(compare_along(scaled(n, -19).data(), scaled(w, scale).data(), scaled(v, scale).data()), expected) << i;
      census.add(expected);
    }
    census.expect_each_at_least(kTries / 8);
  }
}

TEST(Exact, CompareAlongNormalIsTheDeterminantsSign) {
  Draw draw(4);
  for (const int scale : kScales) {
    Census census;
    for (int i = 0; i < kTries; ++i) {
      const Integers a = draw.vector(kLarge), b = draw.vector(kLarge), c = draw.vector(kLarge), v = draw.vector(kLarge);
      const Integers w = v + draw.integer(3) * (b - a) + draw.integer(3) * (c - a) + draw.speck();
      const int expected = sign(determinant(b - a, c - a, w - v));
      ASSERT_EQ(compare_along_normal(scaled(a, scale).data(), scaled(b, scale).data(), scaled(c, scale).data(),
                                     scaled(w, scale).data(), scaled(v, scale).data()),
                expected)
          << i;
      census.add(expected);
    }
    census.expect_each_at_least(kTries / 8);
  }
}

/// Any matrix of integers over 2^12: the predicates take it as stored.
struct Matrix {
  Integers row[3];
  Motion motion(const Integers& t, int scale) const {
    const auto vec = [](const Doubles& d) { return Vec{d[0], d[1], d[2]}; };
    return {vec(scaled(row[0], -12)), vec(scaled(row[1], -12)), vec(scaled(row[2], -12)), vec(scaled(t, scale))};
  }
  Integers back(const Integers& n) const { return n[0] * row[0] + n[1] * row[1] + n[2] * row[2]; }
  Integers turn(const Integers& p) const {
    const auto along = [&p](const Integers& r) { return r[0] * p[0] + r[1] * p[1] + r[2] * p[2]; };
    return {along(row[0]), along(row[1]), along(row[2])};
  }
};
Matrix matrix(Draw& draw) { return {{draw.vector(1 << 12), draw.vector(1 << 12), draw.vector(1 << 12)}}; }

TEST(Exact, CompareAlongTurnedIsTheDotsSign) {
  Draw draw(5);
  for (const int scale : kScales) {
    Census census;
    for (int i = 0; i < kTries; ++i) {
      const Matrix r = matrix(draw);
      const Integers n = draw.vector(1 << 12), n_b = r.back(n), v = draw.vector(kLarge);
      const auto across = cross(n_b, draw.vector(1 << 12));
      const Integers w = v + Integers{std::int64_t(across[0]), std::int64_t(across[1]), std::int64_t(across[2])} + draw.speck();
      const Integers e = w - v;
      const int expected = sign(dot(n_b, {e[0], e[1], e[2]}));
      ASSERT_EQ(compare_along_turned(scaled(n, 0).data(), r.motion({}, 0), scaled(w, scale).data(), scaled(v, scale).data()),
                expected)
          << i;
      census.add(expected);
    }
    census.expect_each_at_least(kTries / 8);
  }
}

/// Two columns of a determinant that are one point make it nothing, and two that change places turn its sign, however small a
/// translation is beside the bodies: its square underflows.
TEST(Exact, ATripleProductTurnsItsSignWithItsPoints) {
  std::mt19937_64 engine(8);
  const auto draw = [&](int exponent) {
    const auto number = [&] { return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine), exponent); };
    return Doubles{number(), number(), number()};
  };
  int signs = 0;
  for (int exponent = 0; exponent >= -1060; exponent -= 20) {
    for (int i = 0; i < 200; ++i) {
      Motion m = motion(Pose{});
      const Doubles turn = draw(-30), t = draw(exponent);
      m.row_x.y = turn[0], m.row_y.x = -turn[0], m.row_x.z = turn[1], m.row_z.x = -turn[1], m.row_y.z = turn[2],
      m.row_z.y = -turn[2];
      m.t.x = t[0], m.t.y = t[1], m.t.z = t[2];
      const Doubles v = draw(-66), p = i % 2 ? v : draw(-66), q = draw(-66), r = draw(-66);
      const auto product = [&](const Doubles& x, const Doubles& y, const Doubles& z) {
        return triple_product({v.data(), v.data(), v.data()}, {x.data(), y.data(), z.data()}, m);
      };
      for (const auto& [x, y] : {std::pair{p, q}, std::pair{q, p}}) {
        EXPECT_EQ(product(x, x, y), 0) << exponent;
        EXPECT_EQ(product(x, y, x), 0) << exponent;
        EXPECT_EQ(product(y, x, x), 0) << exponent;
      }
      const int sign = product(p, q, r);
      EXPECT_EQ(product(q, p, r), -sign) << exponent;
      EXPECT_EQ(product(q, r, p), sign) << exponent;
      EXPECT_EQ(product(p, r, q), -sign) << exponent;
      signs += sign != 0;
    }
  }
  EXPECT_GE(signs, 10'000);
}

// ---- The origin in a tetrahedron -------------------------------------------------------------------------------------------

using Four = std::array<Integers, 4>;

/// By the definition: on each face's plane, or on the side of the vertex opposite.
bool holds_origin(const Four& p) {
  const Integers origin{};
  const auto side = [&](int i, int j, int k, const Integers& q) {
    return sign(determinant(p[j] - p[i], p[k] - p[i], q - p[i]));
  };
  bool inside = true;
  for (int k = 0; k < 4; ++k) {
    const int i = (k + 1) % 4, j = (k + 2) % 4, l = (k + 3) % 4, own = side(i, j, l, p[k]), of_origin = side(i, j, l, origin);
    if (own == 0) return false;  // flat
    inside = inside && (of_origin == 0 || of_origin == own);
  }
  return inside;
}

/// p = a - (R b + t) with b, R and t drawn and a made to fit, in units of 2^(scale - 12).
bool tetrahedron_of(const Four& p, Draw& draw, int scale) {
  const Matrix r = matrix(draw);
  const Integers t = draw.vector(1 << 20);
  std::array<Doubles, 4> a, b;
  for (std::size_t k = 0; k < 4; ++k) {
    const Integers q = draw.vector(1 << 20);
    b[k] = scaled(q, scale);
    a[k] = scaled(p[k] + r.turn(q) + t, scale - 12);
  }
  return tetrahedron_holds_origin(a, b, r.motion(t, scale - 12));
}

TEST(Exact, TetrahedronHoldsOriginByDefinition) {
  Draw draw(6);
  for (const int scale : kScales) {
    int held = 0, flat = 0, border = 0;
    for (int i = 0; i < kTries; ++i) {
      const std::int64_t limit = i % 2 ? 2 : 1 << 30;
      Four p{draw.vector(limit), draw.vector(limit), draw.vector(limit), draw.vector(limit)};
      if (i % 8 == 0)
        p[3] = p[0] + draw.integer(2) * (p[1] - p[0]) + draw.integer(2) * (p[2] - p[0]) + draw.speck();  // near flat
      if (i % 8 == 2) p[2] = -2 * p[0] + -1 * p[1];     // the origin in the face 0, 1, 2
      if (i % 8 == 4) p[1] = -3 * p[0] + draw.speck();  // on, or one unit off, the edge 0, 1
      if (i % 8 == 6) p[1] = {};                        // at a vertex
      if (i % 4 == 0) std::swap(p[0], p[3]);
      const bool expected = holds_origin(p);
      ASSERT_EQ(tetrahedron_of(p, draw, scale), expected) << i;
      held += expected;
      flat += determinant(p[1] - p[0], p[2] - p[0], p[3] - p[0]) == 0;
      border += expected && (determinant(p[0], p[1], p[2]) == 0 || determinant(p[0], p[1], p[3]) == 0 ||
                             determinant(p[0], p[2], p[3]) == 0 || determinant(p[1], p[2], p[3]) == 0);
    }
    EXPECT_GE(held, kTries / 8);
    EXPECT_LE(held, kTries * 3 / 4);
    EXPECT_GE(flat, kTries / 32);
    EXPECT_GE(border, kTries / 8);
  }
}

TEST(Exact, FlatTetrahedraHoldNothing) {
  Draw draw(7);
  const Four around_origin{{{2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}, {0, 0, 0}}},
      beside{{{2, 0, 1}, {-1, 2, 1}, {-1, -2, 1}, {0, 0, 1}}};
  const Four needle{{{-1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}, nowhere{};
  for (const Four& p : {around_origin, beside, needle, nowhere}) EXPECT_FALSE(tetrahedron_of(p, draw, 0));
}

TEST(Exact, OneUlpDecidesWhetherAFaceHoldsTheOrigin) {
  // The unit tetrahedron about the origin with one face in z = height, moved up and down by the smallest step of its
  // neighbours.
  for (const double height : {0.0, 0x1p-52, -0x1p-52, 0x1p-200, -0x1p-200}) {
    const std::array<Doubles, 4> a{{{1, 0, height}, {-1, 1, height}, {-1, -1, height}, {0, 0, 5}}}, b{};
    EXPECT_EQ(tetrahedron_holds_origin(a, b, motion(Pose{})), height <= 0) << height;
  }
}

}  // namespace
}  // namespace swiftlet::exact

#endif
