// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How batches are cut into tasks. Knows no query.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <span>

#include <swiftlet/batch.h>

#include "numeric/chunks.h"

namespace swiftlet {

inline constexpr std::size_t kPairsPerTask = 32;  // so few that threads end together, so many that taking a task costs nothing

/// Runs task(0) to task(count - 1). Once `stop` has returned true, no further task begins.
template <class Task>
void run_all(std::size_t count, const Run& run, const Task& task) {
  std::atomic<bool> stopped = false;
  const auto unless_stopped = [&](std::size_t i) {
    if (run.stop && (stopped.load(std::memory_order_relaxed) || run.stop()))
      stopped.store(true, std::memory_order_relaxed);
    else
      task(i);
  };
  run_tasks(run.executor, count, unless_stopped);
}

/// Asks in each pose; within a chunk each query starts from the `Seed` of the one before.
template <class Seed, class AnyAnswer, class Ask>
void over_poses(std::span<const Pose> poses, std::span<AnyAnswer> answers, const Run& run, Ask ask) {
  assert(answers.size() >= poses.size());
  const auto ask_chunk = [&](std::size_t chunk) {
    const std::size_t first = chunk * kPosesPerChunk, end = std::min(first + kPosesPerChunk, poses.size());
    Seed seed;
    for (std::size_t i = first; i < end; ++i) answers[i] = ask(poses[i], seed);
  };
  run_all((poses.size() + kPosesPerChunk - 1) / kPosesPerChunk, run, ask_chunk);
}

/// The options without trace and proof, which all queries of a batch would share.
template <class AnyOptions>
static inline AnyOptions alone(AnyOptions options) {
  options.tuning.trace = {};
  options.tuning.proof = nullptr;
  return options;
}

}  // namespace swiftlet
