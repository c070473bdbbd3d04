// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Work without the interpreter's lock, on threads that live as long as one call, and stopped by a signal. Only the thread that
// called ever touches the interpreter. Threads are started per call because none then outlives it: a process may fork between
// any two calls, and nothing waits when the interpreter ends; starting one takes some 20 microseconds.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <thread>

#include <swiftlet/executor.h>

namespace swiftlet::python {

/// While one lives, its thread does not hold the interpreter's lock. It must hold it when it makes and when it destroys one.
class Unlocked {
 public:
  explicit Unlocked(unsigned threads = 1);
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// True once a signal's handler has raised; on the thread that called, looks for one at most every 10 ms.
  bool stopped();
  /// Runs task(0) to task(count - 1) on the threads; none begins after `stopped`. The thread that called works too; then it
  /// waits for the others and goes on looking for signals.
  void run(std::size_t count, const std::function<void(std::size_t)>& task);
  Executor executor();
  /// Takes the lock back and raises what a handler has raised.
  void finish();

 private:
  void look();
  void take_back();
  using Clock = std::chrono::steady_clock;
  PyThreadState* state_;
  const std::thread::id owner_ = std::this_thread::get_id();
  const unsigned threads_;
  const int process_;
  Clock::time_point looked_ = Clock::now();
  std::atomic<bool> stopped_ = false;
  bool forked_ = false;
};

}  // namespace swiftlet::python
