// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Error-free sums and products [Dekker 1971; Knuth 1969], and numbers of about 106 bits made of two doubles
// [Hida, Li & Bailey 2001]. Knows nothing of geometry. Valid for magnitudes between 1e-140 and 1e+140.
#pragma once

#include <cmath>

namespace swiftlet {

struct HighLow {
  double high, low;
};

/// a + b exactly.
static inline HighLow two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}
/// a + b exactly, for |a| >= |b|.
static inline HighLow quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
/// a * b exactly, by Veltkamp's split, so that no translation unit depends on a fused multiply-add.
static inline HighLow two_product(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  const double p = a * b, ca = kSplit * a, cb = kSplit * b;
  const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh;
  return {p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
}

struct DoubleDouble {
  double high = 0, low = 0;
  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}
  DoubleDouble(HighLow p) : high(p.high), low(p.low) {}
  explicit operator double() const { return high + low; }
};

static inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const HighLow s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
  const HighLow u = quick_two_sum(s.high, s.low + t.high);
  return quick_two_sum(u.high, u.low + t.low);
}
static inline DoubleDouble operator-(const DoubleDouble& a) { return HighLow{-a.high, -a.low}; }
static inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
static inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const HighLow p = two_product(a.high, b.high);
  return quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
static inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q = a.high / b.high;
  const DoubleDouble r = a - b * DoubleDouble(q);
  const double q2 = r.high / b.high;
  const DoubleDouble r2 = r - b * DoubleDouble(q2);
  return DoubleDouble(quick_two_sum(q, q2)) + DoubleDouble(r2.high / b.high);
}
/// The square root of a number above 0: the root in doubles, improved by one Newton step.
static inline DoubleDouble root(const DoubleDouble& a) {
  const DoubleDouble r = std::sqrt(a.high);
  return r + (a - r * r) / (r + r);
}
static inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}
static inline bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }

}  // namespace swiftlet
