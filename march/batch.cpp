// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/batch.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <thread>
#include <vector>

namespace swiftlet {
namespace {

constexpr std::size_t kPairsPerTask = 32;  // so few that threads end together, so many that taking one costs nothing

template <class Ask>
void each(std::span<const PairQuery> pairs, std::span<Answer> answers, const QueryOptions& options, const Executor& executor,
          Ask ask) {
  assert(answers.size() >= pairs.size());
  executor((pairs.size() + kPairsPerTask - 1) / kPairsPerTask, [&](std::size_t task) {
    const std::size_t first = task * kPairsPerTask, end = std::min(first + kPairsPerTask, pairs.size());
    for (std::size_t i = first; i < end; ++i) {
      PairSeed cold;
      const PairQuery& q = pairs[i];
      QueryOptions own = q.options ? *q.options : options;
      own.trace = {};
      answers[i] = ask(*q.a, *q.b, q.b_in_a, q.seed ? *q.seed : cold, own);
    }
  });
}

}  // namespace

Executor on_threads(unsigned count) {
  return [count](std::size_t tasks, const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < tasks;) task(i);
    };
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min<std::size_t>(count, tasks); ++i) others.emplace_back(work);
    work();
  };
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
