// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From level pair to finer level pair, until the question is answered [Ehmann & Lin 2000, sec. 5.2].
#pragma once

#include <swiftlet/query.h>

#include "shape.h"
#include "vec.h"

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

/// An answer about the hulls of two bodies in a legal pose, from the seed, or on from what `answer` holds; else it is a new
/// one. Its normal is 0 where none is known. `proof` is empty before, and filled where levels of the answer overlap.
void descend(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error, PairSeed& seed, const Limits& limits,
             const Target& target, bool goes_on, Answer& answer, OverlapProof& proof);

}  // namespace swiftlet
