// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Work on an executor, cut where no number of threads has a say. Knows nothing of what is done.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <utility>

#include <swiftlet/executor.h>

namespace swiftlet {

/// Runs task(0) to task(count - 1) and returns when all have ended. Of exceptions that leave tasks the first is thrown again
/// here; tasks that have not begun by then are left out. An executor of the user's sees none of them.
template <class Task>
void run_tasks(const Executor& executor, std::size_t count, const Task& task) {
  if (!executor || count < 2) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  std::atomic<bool> failed = false;
  std::exception_ptr failure;
  executor(count, [&](std::size_t i) {
    if (failed.load(std::memory_order_relaxed)) return;
    try {
      task(i);
    } catch (...) {
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
}

/// Calls chunk(begin, end) for [0, chunk size), [chunk size, 2 chunk size) and so on up to `count`.
template <class Chunk>
void over_chunks(const Executor& executor, std::size_t count, std::size_t chunk_size, const Chunk& chunk) {
  run_tasks(executor, (count + chunk_size - 1) / chunk_size,
            [&](std::size_t i) { chunk(i * chunk_size, std::min((i + 1) * chunk_size, count)); });
}

}  // namespace swiftlet
