// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Many queries at once, on the caller's threads or on some of our own: many pairs, or one pair in many poses. The answers are
// those of one query after the other, bit for bit, however many threads there are.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stop_token>

#include <swiftlet/depth.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// One pair of a batch.
struct PairQuery {
  Body a, b;                 ///< pairs may share models
  Pose b_in_a;               ///< maps B's frame into A's
  PairSeed* seed = nullptr;  ///< no two pairs of a batch share one; null: a cold query
};

/// Calls task(0) to task(count - 1), each once, in any order, on any threads, and returns when all are done. Empty: they run on
/// the calling thread, one after the other.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Runs on the calling thread and `count` - 1 more, which wait for batches as long as the executor or a copy of it lives: keep
/// it. 0 is 1, more than 1 024 are 1 024, and fewer start where the system has no more. Batches that share one take turns; a
/// task must not use the executor that runs it. An exception that leaves a task is thrown again on the calling thread, after
/// the tasks that had begun have ended; the rest is not begun. Worth it from some 100 microseconds of work on.
Executor on_threads(unsigned count);

/// How a batch runs.
struct Run {
  Executor executor{};     ///< on which threads
  std::stop_token stop{};  ///< once it is requested no task begins: what is done is done, other answers stay as they were
};

// Every query over pairs: each into the answer of the same index; `answers` has room for all. One of the options' `trace` and
// `proof` cannot serve all: they are not used. A task of the executor is 32 pairs. Cost: that of the queries.

/// `distance` of each pair.
void distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options = {}, const Run& run = {});
/// `signed_distance` of each pair.
void signed_distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options = {},
                     const Run& run = {});
/// `intersects` of each pair.
void intersects(std::span<const PairQuery> pairs, std::span<Answer> answers, const Effort& effort = {}, const Run& run = {});
/// `within` of each pair.
void within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
            const Run& run = {});
/// `signed_within` of each pair.
void signed_within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
                   const Run& run = {});
/// `closest_features` of each pair.
void closest_features(std::span<const PairQuery> pairs, std::span<ClosestFeatures> answers, const ClosestOptions& options = {},
                      const Run& run = {});

/// So many poses after one another share a seed, from a cold one on: neighbours should be near. Threads never move the border,
/// so that answers do not depend on how many work.
inline constexpr std::size_t kPosesPerChunk = 1024;

// Every query of one pair over poses `b_in_a`: each into the answer of the same index. A task of the executor is a chunk.

/// `distance` in each pose.
void distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
              const Options& options = {}, const Run& run = {});
/// `signed_distance` in each pose.
void signed_distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                     const Options& options = {}, const Run& run = {});
/// `intersects` in each pose.
void intersects(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                const Effort& effort = {}, const Run& run = {});
/// `within` in each pose.
void within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
            const Effort& effort = {}, const Run& run = {});
/// `signed_within` in each pose.
void signed_within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
                   const Effort& effort = {}, const Run& run = {});
/// `closest_features` in each pose.
void closest_features(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options = {}, const Run& run = {});

}  // namespace swiftlet
