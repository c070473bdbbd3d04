// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries, cut into tasks for an executor, and an executor on a pool of threads. Knows no algorithm of a query.
#include <swiftlet/batch.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "query/prefetch.h"
#include "query/run.h"

namespace swiftlet {
namespace {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
constexpr unsigned kMostThreads = 1;  // to start one would end the program
#else
constexpr unsigned kMostThreads = 1024;
#endif

/// `kBegin` says what the queries read first.
template <Begin kBegin, class AnyAnswer, class Ask>
void over_pairs(std::span<const PairQuery> pairs, std::span<AnyAnswer> answers, const Run& run, Ask ask) {
  assert(answers.size() >= pairs.size());
  const auto ask_some = [&](std::size_t task) {
    const std::size_t first = task * kPairsPerTask, count = std::min(kPairsPerTask, pairs.size() - first);
    // In each turn every pair that is on its way goes a step, and the one that has gone all is asked.
    std::array<Prefetch<kBegin>, kPairsPerTask> ahead;
    constexpr std::size_t kSteps = Prefetch<kBegin>::kSteps;
    for (std::size_t turn = 0; turn < count + kSteps; ++turn) {
      const auto go = [&]<std::size_t kStep>() {
        const std::size_t i = turn - kStep;  // wraps where no pair has come so far
        if (i < count) ahead[i].template step<kStep>(pairs[first + i]);
      };
      [&]<std::size_t... kStep>(std::index_sequence<kStep...>) { (go.template operator()<kStep>(), ...); }
      (std::make_index_sequence<kSteps>());
      if (turn < kSteps) continue;
      PairSeed cold;
      const PairQuery& q = pairs[first + turn - kSteps];
      answers[first + turn - kSteps] = ask(q.a, q.b, q.b_in_a, q.seed ? *q.seed : cold);
    }
  };
  run_all((pairs.size() + kPairsPerTask - 1) / kPairsPerTask, run, ask_some);
}

/// A gate that opens when all have come to it, again and again. (Of std::barrier there are libraries in which it hangs:
/// libstdc++ 12 on Windows.)
class Gate {
 public:
  explicit Gate(std::size_t count) : count_(count), missing_(count) {}
  /// Waits for the others.
  void pass() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (--missing_ == 0) return open(std::move(lock));
    opened_.wait(lock, [this, before = rounds_] { return rounds_ != before; });
  }
  /// From now on there is one less to wait for.
  void leave() {
    std::unique_lock<std::mutex> lock(mutex_);
    --count_;
    if (--missing_ == 0) open(std::move(lock));
  }

 private:
  void open(std::unique_lock<std::mutex> lock) {
    missing_ = count_;
    ++rounds_;
    lock.unlock();  // those who wake need it
    opened_.notify_all();
  }
  std::mutex mutex_;
  std::condition_variable opened_;
  std::size_t count_, missing_, rounds_ = 0;
};

/// A pool of threads that wait for tasks, because a thread started with each batch may get a core milliseconds late. A thread
/// first runs its own range of the tasks, the same in every batch of that size, so that its data stay in its core's cache; then
/// it takes tasks left in other ranges. If the system starts fewer threads than asked for, those run all tasks.
class Workers {
 public:
  explicit Workers(std::size_t count) : next_(count), gate_(count) {
    threads_.reserve(count);
    for (std::size_t worker = 1; worker < count; ++worker) {
      try {
        threads_.emplace_back([this, worker] { wait_and_work(worker); });
      } catch (const std::exception&) {
        gate_.leave();
      }
    }
  }
  ~Workers() {
    gate_.pass();
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void run(std::size_t tasks, const std::function<void(std::size_t)>& task) {
    const std::lock_guard<std::mutex> lock(turn_);
    tasks_ = tasks;
    task_ = &task;
    for (std::size_t range = 0; range < next_.size(); ++range) next_[range] = begin(range);
    failed_ = false;
    gate_.pass();
    work(0);
    gate_.pass();
    task_ = nullptr;
    if (failed_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  std::size_t begin(std::size_t range) const { return tasks_ * range / next_.size(); }
  void wait_and_work(std::size_t worker) {
    for (gate_.pass(); task_; gate_.pass()) {
      work(worker);
      gate_.pass();
    }
  }
  /// Runs tasks, those of range `own` first, until none is left or one has thrown on any thread.
  void work(std::size_t own) try {
    for (std::size_t k = 0; k < next_.size(); ++k) {
      const std::size_t range = (own + k) % next_.size();
      for (std::size_t i; !failed_ && (i = next_[range].fetch_add(1, std::memory_order_relaxed)) < begin(range + 1);)
        (*task_)(i);
    }
  } catch (...) {
    if (!failed_.exchange(true)) failure_ = std::current_exception();
  }

  std::vector<std::atomic<std::size_t>> next_;  ///< the next task of each range
  std::size_t tasks_ = 0;
  const std::function<void(std::size_t)>* task_ = nullptr;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;  ///< thrown by the first task that failed
  std::mutex turn_;
  Gate gate_;  ///< all threads pass it when a batch begins and when it ends
  std::vector<std::thread> threads_;
};

}  // namespace

Executor on_threads(unsigned count) {
  return [workers = std::make_shared<Workers>(std::clamp(count, 1u, kMostThreads))](
             std::size_t tasks, const std::function<void(std::size_t)>& task) { workers->run(tasks, task); };
}

void distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options, const Run& run) {
  over_pairs<Begin::Features>(pairs, answers, run,
                              [&, options = alone(options)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                                return distance(a, b, b_in_a, seed, options);
                              });
}
void signed_distance(std::span<const PairQuery> pairs, std::span<Answer> answers, const Options& options, const Run& run) {
  over_pairs<Begin::Features>(pairs, answers, run,
                              [&, options = alone(options)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                                return signed_distance(a, b, b_in_a, seed, options);
                              });
}
void intersects(std::span<const PairQuery> pairs, std::span<Answer> answers, const Effort& effort, const Run& run) {
  over_pairs<Begin::Verdict>(pairs, answers, run,
                             [&, effort = alone(effort)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                               return intersects(a, b, b_in_a, seed, effort);
                             });
}
void within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort,
            const Run& run) {
  over_pairs<Begin::Verdict>(pairs, answers, run,
                             [&, effort = alone(effort)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                               return within(a, b, b_in_a, threshold, seed, effort);
                             });
}
void signed_within(std::span<const PairQuery> pairs, double threshold, std::span<Within> answers, const Effort& effort,
                   const Run& run) {
  over_pairs<Begin::Verdict>(pairs, answers, run,
                             [&, effort = alone(effort)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                               return signed_within(a, b, b_in_a, threshold, seed, effort);
                             });
}
void closest_features(std::span<const PairQuery> pairs, std::span<ClosestFeatures> answers, const ClosestOptions& options,
                      const Run& run) {
  over_pairs<Begin::Features>(pairs, answers, run,
                              [&, options = alone(options)](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
                                return closest_features(a, b, b_in_a, seed, options);
                              });
}
void distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers, const Options& options,
              const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, options = alone(options)](const Pose& pose, PairSeed& seed) {
    return distance(a, b, pose, seed, options);
  });
}
void signed_distance(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers,
                     const Options& options, const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, options = alone(options)](const Pose& pose, PairSeed& seed) {
    return signed_distance(a, b, pose, seed, options);
  });
}
void intersects(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<Answer> answers, const Effort& effort,
                const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, effort = alone(effort)](const Pose& pose, PairSeed& seed) {
    return intersects(a, b, pose, seed, effort);
  });
}
void within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
            const Effort& effort, const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, effort = alone(effort)](const Pose& pose, PairSeed& seed) {
    return within(a, b, pose, threshold, seed, effort);
  });
}
void signed_within(const Body& a, const Body& b, std::span<const Pose> b_in_a, double threshold, std::span<Within> answers,
                   const Effort& effort, const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, effort = alone(effort)](const Pose& pose, PairSeed& seed) {
    return signed_within(a, b, pose, threshold, seed, effort);
  });
}
void closest_features(const Body& a, const Body& b, std::span<const Pose> b_in_a, std::span<ClosestFeatures> answers,
                      const ClosestOptions& options, const Run& run) {
  over_poses<PairSeed>(b_in_a, answers, run, [&, options = alone(options)](const Pose& pose, PairSeed& seed) {
    return closest_features(a, b, pose, seed, options);
  });
}

}  // namespace swiftlet
