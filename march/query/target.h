// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a query is asked (`Target`), and how far and how it may go (`Limits`). Plain data, no algorithm.
#pragma once

#include <limits>
#include <span>

#include <swiftlet/query.h>

namespace swiftlet {

/// The question of a query. It is answered when the interval is narrow enough or lies on one side of a threshold.
struct Target {
  double absolute, relative;  ///< narrow enough: upper - lower <= max(absolute, relative * (lower - zero)) - rounding
  double clear_above;         ///< answered when `lower` exceeds this by more than law 2's bound
  double hit_below;           ///< answered when `upper` is below this by more than law 2's bound
  double zero = 0;            ///< the hulls' distance at which the bodies touch: the sum of their radii
  double rounding = 0;        ///< the allowed width is reduced by this, because bounds of rounded bodies are rounded again
  double exact = 0;           ///< an earlier answer is exact if its width is at most this or law 2's bound of the hulls
  bool is_threshold() const { return clear_above < std::numeric_limits<double>::infinity(); }
};

/// How far and how a query goes: the caller's budget and tuning.
struct Limits {
  Limits(const Budget& of_budget, const Tuning& of_tuning) : budget(of_budget), tuning(of_tuning), trace(of_tuning.trace) {}
  const Budget& budget;
  const Tuning& tuning;
  std::span<LevelRecord> trace;  ///< the part of `tuning.trace` that is still unused
};

/// Writes `record` at `index` of `trace`, or over its last entry if the trace is too short; an empty trace takes nothing.
static inline void note(std::span<LevelRecord> trace, std::size_t index, const LevelRecord& record) {
  if (!trace.empty()) trace[index < trace.size() ? index : trace.size() - 1] = record;
}

}  // namespace swiftlet
