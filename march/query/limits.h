// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How far and how a query may go. Plain data, no algorithm.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <double_bits.h>
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
/// The four choices of a tuning in one word.
static inline std::uint32_t choices(const Tuning& tuning) {
  static_assert(offsetof(Tuning, careful) == offsetof(Tuning, start) + 3 && sizeof(Tuning::careful) == 1);
  std::uint32_t word;
  std::memcpy(&word, reinterpret_cast<const char*>(&tuning) + offsetof(Tuning, start), sizeof word);
  return word;
}
/// 0 if budget and tuning are, word by word, those of NoLimits. Words are joined, so that one branch tells.
static inline std::uint64_t limits_in(const Budget& budget, const Tuning& tuning) {
  return (bit_cast<std::uint64_t>(budget) ^ bit_cast<std::uint64_t>(NoLimits::budget)) |
         (choices(tuning) ^ choices(NoLimits::tuning)) | tuning.trace.size() | std::uintptr_t(tuning.proof);
}

/// What is left of a budget of `most` steps.
static inline std::uint32_t steps_left(std::uint32_t most, std::uint32_t taken) { return most - std::min(taken, most); }

/// Writes `record` at `index` of `trace`, or over its last entry if the trace is too short; an empty trace takes nothing.
static inline void note(std::span<LevelRecord> trace, std::size_t index, const LevelRecord& record) {
  if (!trace.empty()) trace[index < trace.size() ? index : trace.size() - 1] = record;
}

}  // namespace swiftlet
