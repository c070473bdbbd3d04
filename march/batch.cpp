// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/batch.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cassert>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

constexpr unsigned kMostThreads = 1024;
constexpr std::size_t kPairsPerTask = 32;  // so few that threads end together, so many that taking one costs nothing

template <class Ask>
void each(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options, const Executor& executor,
          Ask ask) {
  assert(answers.size() >= pairs.size());
  const std::size_t tasks = (pairs.size() + kPairsPerTask - 1) / kPairsPerTask;
  const auto work = [&](std::size_t task) {
    const std::size_t first = task * kPairsPerTask, end = std::min(first + kPairsPerTask, pairs.size());
    for (std::size_t i = first; i < end; ++i) {
      PairSeed cold;
      const PairQuery& q = pairs[i];
      QueryOptions own = q.options ? *q.options : options;
      own.trace = {};
      answers[i] = ask(*q.a, *q.b, q.b_in_a, q.seed ? *q.seed : cold, own);
    }
  };
  if (executor) return executor(tasks, work);
  for (std::size_t task = 0; task < tasks; ++task) work(task);
}

/// Threads that wait for tasks: one that starts with each batch may get a core milliseconds late. Each has a range of tasks of
/// its own, the same in every batch, so that what it touches stays in its core's cache; then it takes what the others have
/// left. Where the system gives no more threads, those it gave take the rest.
class Workers {
 public:
  explicit Workers(std::size_t count) : next_(count), gate_(std::ptrdiff_t(count)) {
    threads_.reserve(count);
    for (std::size_t worker = 1; worker < count; ++worker) {
      try {
        threads_.emplace_back([this, worker] { wait_and_work(worker); });
      } catch (const std::exception&) {
        gate_.arrive_and_drop();
      }
    }
  }
  ~Workers() { gate_.arrive_and_wait(); }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void run(std::size_t tasks, const std::function<void(std::size_t)>& task) {
    const std::lock_guard<std::mutex> turn(turn_);
    tasks_ = tasks;
    task_ = &task;
    for (std::size_t range = 0; range < next_.size(); ++range) next_[range] = begin(range);
    failed_ = false;
    gate_.arrive_and_wait();
    work(0);
    gate_.arrive_and_wait();
    task_ = nullptr;
    if (failed_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  std::size_t begin(std::size_t range) const { return tasks_ * range / next_.size(); }
  void wait_and_work(std::size_t worker) {
    for (gate_.arrive_and_wait(); task_; gate_.arrive_and_wait()) {
      work(worker);
      gate_.arrive_and_wait();
    }
  }
  /// Takes tasks until there is none, or one failed on any thread.
  void work(std::size_t own) try {
    for (std::size_t k = 0; k < next_.size(); ++k) {
      const std::size_t range = (own + k) % next_.size();
      for (std::size_t i; !failed_ && (i = next_[range].fetch_add(1, std::memory_order_relaxed)) < begin(range + 1);)
        (*task_)(i);
    }
  } catch (...) {
    if (!failed_.exchange(true)) failure_ = std::current_exception();
  }

  std::vector<std::atomic<std::size_t>> next_;  ///< task of each range
  std::size_t tasks_ = 0;
  const std::function<void(std::size_t)>* task_ = nullptr;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;  ///< the first task's that failed
  std::mutex turn_;
  std::barrier<> gate_;  ///< opens when a batch is there, and when it is done
  std::vector<std::jthread> threads_;
};

}  // namespace

Executor on_threads(unsigned count) {
  return [workers = std::make_shared<Workers>(std::clamp(count, 1u, kMostThreads))](
             std::size_t tasks, const std::function<void(std::size_t)>& task) { workers->run(tasks, task); };
}

void distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options,
              const Executor& executor) {
  each(pairs, answers, options, executor, [](auto&&... q) { return distance(q...); });
}

void intersects(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options,
                const Executor& executor) {
  each(pairs, answers, options, executor, [](auto&&... q) { return intersects(q...); });
}

}  // namespace swiftlet
