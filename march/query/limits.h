// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How far and how a query may go. Plain data, no algorithm.
#pragma once

#include <span>

#include <swiftlet/query.h>

namespace swiftlet {

/// The caller's budget and tuning.
struct Limits {
  Limits(const Budget& of_budget, const Tuning& of_tuning) : budget(of_budget), tuning(of_tuning), trace(of_tuning.trace) {}
  const Budget& budget;
  const Tuning& tuning;
  std::span<LevelRecord> trace;  ///< the part of `tuning.trace` that is still unused
};

// Without a namespace of the file's own these constants were symbols that files compiled for other registers share.
namespace {
/// The budget and tuning that a caller gets who names none, as constants.
struct NoLimits {
  static constexpr Budget budget{};
  static constexpr Tuning tuning{};
  static constexpr std::span<LevelRecord> trace{};
};
}  // namespace
/// True if budget and tuning are those of NoLimits.
static inline bool is_unlimited(const Budget& budget, const Tuning& tuning) {
  return budget.steps == NoLimits::budget.steps && budget.finest_level <= 0 && tuning.start == StartPolicy::Automatic &&
         tuning.refinement == NoLimits::tuning.refinement && tuning.plane_rule == PlaneRule::MostViolated && !tuning.careful &&
         tuning.trace.empty() && !tuning.proof;
}

/// Writes `record` at `index` of `trace`, or over its last entry if the trace is too short; an empty trace takes nothing.
static inline void note(std::span<LevelRecord> trace, std::size_t index, const LevelRecord& record) {
  if (!trace.empty()) trace[index < trace.size() ? index : trace.size() - 1] = record;
}

}  // namespace swiftlet
