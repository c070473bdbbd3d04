// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Sets of few things, each of which has a number.
#pragma once

#include <bit>
#include <cstdint>

namespace swiftlet {

/// Numbers from 0 to 31, by a bit each.
using Set = std::uint32_t;
static inline Set bit(int i) { return Set(1) << i; }
/// All numbers below `count`, which is less than 32.
static inline Set below(int count) { return bit(count) - 1; }
static inline bool has(Set set, int i) { return set >> i & 1; }
static inline int lowest(Set set) { return std::countr_zero(set); }

static inline void each(Set set, auto&& visit) {
  for (; set != 0; set &= set - 1) visit(lowest(set));
}

}  // namespace swiftlet
