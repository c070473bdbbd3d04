// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a query, and how far it may go.
#pragma once

#include <limits>
#include <span>

#include <swiftlet/query.h>

namespace swiftlet {

/// The question: an interval narrow enough, or a threshold passed.
struct Target {
  double absolute, relative;
  double clear_above;   ///< answered when lower > this
  double hit_below;     ///< answered when upper <= this
  double zero = 0;      ///< the hulls' distance that `relative` counts from, where the bodies touch
  double rounding = 0;  ///< by so much narrower than `absolute` and `relative` say
  double exact = 0;     ///< an earlier answer is exact where it is this narrow, or within law 2's bound of the hulls
  bool is_threshold() const { return clear_above < std::numeric_limits<double>::infinity(); }
};

/// How far and how a query goes.
struct Limits {
  Limits(const Budget& of_budget, const Tuning& of_tuning) : budget(of_budget), tuning(of_tuning), trace(of_tuning.trace) {}
  const Budget& budget;
  const Tuning& tuning;
  std::span<LevelRecord> trace;  ///< the rest of the tuning's
};

/// Notes a level pair in a trace that may be too short.
static inline void note(std::span<LevelRecord> trace, std::size_t index, const LevelRecord& record) {
  if (!trace.empty()) trace[index < trace.size() ? index : trace.size() - 1] = record;
}

}  // namespace swiftlet
