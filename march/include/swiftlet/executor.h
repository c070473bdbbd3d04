// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where work that can be cut into tasks runs: batches of queries, and the making of models.
#pragma once

#include <cstddef>
#include <functional>

namespace swiftlet {

/// Calls task(0) to task(count - 1), each once, in any order, on any threads, and returns when all are done. An empty
/// `Executor` stands for the calling thread, one task after the other.
using Executor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Returns an executor that runs tasks on the calling thread and on `count` - 1 threads of its own. These threads wait for
/// batches as long as the executor or a copy of it lives, so keep it. `count` is clamped to 1 to 1 024; fewer threads start
/// where the system gives no more. Batches that share an executor take turns; a task must not use the executor that runs it. An
/// exception that leaves a task is thrown again on the calling thread after the tasks that had begun have ended; no further
/// task begins. Threads pay off for batches of some 100 microseconds of work or more.
Executor on_threads(unsigned count);

}  // namespace swiftlet
