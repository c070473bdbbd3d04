// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Many pairs at once, on the caller's threads or on some of our own. The answers are those of one query after the other, bit
// for bit.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <swiftlet/query.h>

namespace swiftlet {

/// One pair of a batch.
struct PairQuery {
  const Model* a = nullptr;               ///< never null; pairs may share models
  const Model* b = nullptr;               ///< likewise
  Pose b_in_a;                            ///< maps B's frame into A's
  PairSeed* seed = nullptr;               ///< no two pairs of a batch share one; null: a cold query
  const QueryOptions* options = nullptr;  ///< the pair's own, its radii for one; its trace is not used; null: the batch's
};

/// Calls task(0) to task(count - 1), each once, in any order, on any threads, and returns when all are done. Empty: they run on
/// the calling thread, one after the other.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Runs on the calling thread and `count` - 1 more, which wait for batches as long as the executor or a copy of it lives: keep
/// it. 0 is 1, more than 1 024 are 1 024, and fewer start where the system has no more. Batches that share one take turns; a
/// task must not use the executor that runs it. An exception that leaves a task is thrown again on the calling thread, after
/// the tasks that had begun have ended; the rest is not begun. Worth it from some 100 microseconds of work on.
Executor on_threads(unsigned count);

/// `distance` for each of `pairs`, into the answer of the same index. `answers` has room for all. The trace of `options` is not
/// used. Cost: that of the queries; a task of the executor is 32 of them.
void distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options = {},
              const Executor& executor = {});

/// Likewise `intersects`.
void intersects(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options = {},
                const Executor& executor = {});

}  // namespace swiftlet
