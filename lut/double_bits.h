// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A double's bits, its exponent, its neighbours, its multiples by powers of two: integer arithmetic and exact products instead
// of libm, so the same on every platform. Static, as all arithmetic of the runtime. Knows no geometry.
#pragma once

#include <cstdint>
#include <limits>

namespace swiftlet {

/// std::bit_cast, which some C++20 libraries still lack; the compilers know it.
template <class To, class From>
static constexpr To bit_cast(const From& from) {
  return __builtin_bit_cast(To, from);
}

/// The double 2^exponent, -1022 <= exponent <= 1023.
static constexpr double power_of_two(int exponent) { return bit_cast<double>(std::uint64_t(exponent + 1023) << 52); }

/// The greatest e with 2^e <= abs(x), of a finite x that is not 0.
static inline int exponent_of(double x) {
  const auto stored = [](double y) { return int(bit_cast<std::uint64_t>(y) >> 52 & 0x7ff); };
  const int exponent = stored(x);
  return exponent > 0 ? exponent - 1023 : stored(x * 0x1p54) - 1023 - 54;  // the second of a subnormal number
}

/// x times 2^exponent, rounded once.
static inline double times_power_of_two(double x, int exponent) {
  for (int i = 0; i < 2 && exponent > 1023; ++i) x *= 0x1p1023, exponent -= 1023;
  for (int i = 0; i < 2 && exponent < -1022; ++i) x *= 0x1p-969, exponent += 969;  // 2^53 above what would round it twice
  return x * power_of_two(exponent > 1023 ? 1023 : exponent < -1022 ? -1022 : exponent);
}

/// The next double above x; infinity and NaN are their own.
static inline double next_above(double x) {
  if (!(x < std::numeric_limits<double>::infinity())) return x;
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  const auto bits = bit_cast<std::uint64_t>(x);
  return bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
static inline double next_below(double x) { return -next_above(-x); }

}  // namespace swiftlet
