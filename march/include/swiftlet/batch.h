// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries over many pairs, or over one pair in many poses, on the caller's threads or on the library's. The answers
// equal those of the same queries asked one after the other, bit for bit, however many threads there are.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <swiftlet/depth.h>
#include <swiftlet/executor.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// One pair of a batch.
struct PairQuery {
  Body a, b;                 ///< pairs may share models
  Pose b_in_a;               ///< maps B's frame into A's
  PairSeed* seed = nullptr;  ///< no two pairs of a batch may share a seed; null: the query starts cold
};

/// How a batch runs.
struct Run {
  Executor executor{};  ///< runs the tasks of the batch; empty: the calling thread does
  /// Asked before each task, on the thread that is about to run it; empty: never. Once it is true it is asked no more, and no
  /// further task begins; the answers of tasks that did not run stay unchanged.
  std::function<bool()> stop{};
};

// Each query over pairs writes the answer of pairs[i] to answers[i]; `answers` must be at least as long as `pairs`. The
// options' `trace` and `proof` are ignored: one of each cannot serve all pairs. A task is 32 pairs. Cost: that of the queries,
// but a task asks memory for what its next pairs will read. Pairs of bodies that no cache holds take half to three quarters of
// the time that they take one by one; distances without a seed, of bodies that a cache holds, a third more.

/// Asks `distance` for each pair.
void distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options = {}, const Run& run = {});
/// Asks `signed_distance` for each pair.
void signed_distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options = {},
                     const Run& run = {});
/// Asks `intersects` for each pair.
void intersects(std::span<const PairQuery> pairs, std::span<Answer> answers, const Effort& effort = {}, const Run& run = {});
/// Asks `within` for each pair.
void within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
            const Run& run = {});
/// Asks `signed_within` for each pair.
void signed_within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort = {},
                   const Run& run = {});
/// Asks `closest_features` for each pair.
void closest_features(std::span<const PairQuery> pairs, std::span<ClosestFeatures> answers, const ClosestOptions& options = {},
                      const Run& run = {});

/// Poses are cut into chunks of this many. Within a chunk each query warm-starts from the seed of the one before, the first
/// starts cold; consecutive poses should therefore be near. Chunks, hence answers, do not depend on the number of threads.
inline constexpr std::size_t kPosesPerChunk = 1024;

// Each query of one pair over poses writes the answer in pose b_in_a[i] to answers[i]; `answers` must be at least as long as
// `b_in_a`. The options' `trace` and `proof` are ignored. A task is a chunk of `kPosesPerChunk` poses.

/// Asks `distance` in each pose.
void distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
              const Options& options = {}, const Run& run = {});
/// Asks `signed_distance` in each pose.
void signed_distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                     const Options& options = {}, const Run& run = {});
/// Asks `intersects` in each pose.
void intersects(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                const Effort& effort = {}, const Run& run = {});
/// Asks `within` in each pose.
void within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
            const Effort& effort = {}, const Run& run = {});
/// Asks `signed_within` in each pose.
void signed_within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
                   const Effort& effort = {}, const Run& run = {});
/// Asks `closest_features` in each pose.
void closest_features(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options = {}, const Run& run = {});

}  // namespace swiftlet
