// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Law 8 under many threads: shared models, seeds of one's own, any order, the bits of one thread. Run by ./run threads under
// the thread sanitizer.
#include <swiftlet/batch.h>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "answers.h"

namespace swiftlet {
namespace {

constexpr std::size_t kThreads = 8;
constexpr int kPoses = 200;

using Fields = std::vector<std::uint64_t>;

const std::vector<Model>& models() {
  static const std::vector<Model> all = answers::models(SWIFTLET_TEST_DIR "/data/models");
  return all;
}

/// What one seed lives through: a pair of models and its poses.
struct Motion {
  const Model* a;
  const Model* b;
  std::vector<Pose> poses;
};

/// Every ordered pair, a model with itself included, so that each model is in many.
const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = [] {
    std::vector<Motion> made;
    answers::Poses poses(5);
    for (const Model& a : models()) {
      for (const Model& b : models()) {
        made.push_back({&a, &b, {}});
        for (int i = 0; i < kPoses; ++i) made.back().poses.push_back(poses.next());
      }
    }
    return made;
  }();
  return all;
}

/// The i-th question of a motion.
Fields ask(const Motion& motion, std::size_t i, PairSeed& seed) {
  Fields fields;
  QueryOptions options;
  options.start = StartPolicy(i % 5);
  options.refinement = Refinement(i % 3);
  options.plane_rule = PlaneRule(i / 5 % 2);
  const Pose& pose = motion.poses[i];
  answers::append(distance(*motion.a, *motion.b, pose, seed, options), fields);
  if (i % 4 == 0) answers::append(intersects(*motion.a, *motion.b, pose, seed, options), fields);
  if (i % 4 == 1) answers::append(within(*motion.a, *motion.b, pose, 0.25, seed, options).answer, fields);
  if (i % 4 == 2) answers::append(contact(*motion.a, *motion.b, pose, seed, options).answer, fields);
  if (i % 4 == 3) fields.push_back(motion.a->support(pose.translation));
  return fields;
}

/// All answers of all motions, motion by motion.
std::vector<std::vector<Fields>> alone() {
  std::vector<std::vector<Fields>> answers;
  for (const Motion& motion : motions()) {
    PairSeed seed;
    answers.emplace_back();
    for (std::size_t i = 0; i < motion.poses.size(); ++i) answers.back().push_back(ask(motion, i, seed));
  }
  return answers;
}

template <class Work>
void in_threads(Work work) {
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) threads.emplace_back(work, t);
  for (std::thread& thread : threads) thread.join();
}

class Threads : public testing::Test {
 protected:
  Threads() {
    for (const Model& model : models()) {
      hashes_.push_back(model.hash());
      bytes_.emplace_back(model.bytes().begin(), model.bytes().end());
    }
  }
  ~Threads() override {  // trap G23: a query that writes into shared geometry
    for (std::size_t i = 0; i < models().size(); ++i) {
      EXPECT_EQ(models()[i].hash(), hashes_[i]);
      EXPECT_TRUE(std::equal(bytes_[i].begin(), bytes_[i].end(), models()[i].bytes().begin(), models()[i].bytes().end()));
    }
  }
  std::vector<std::uint64_t> hashes_;
  std::vector<std::vector<std::byte>> bytes_;
};

TEST_F(Threads, WarmQueriesOfInterleavedMotionsAnswerAsOneThread) {
  const auto expected = alone();
  std::atomic<int> different{0}, asked{0};
  in_threads([&](std::size_t t) {
    std::mt19937 engine{std::uint32_t(t)};
    std::vector<PairSeed> seeds(motions().size());
    std::vector<std::size_t> next(motions().size(), 0), open(motions().size());
    for (std::size_t m = 0; m < open.size(); ++m) open[m] = m;
    while (!open.empty()) {  // any motion's next question
      const std::size_t at = engine() % open.size(), m = open[at], i = next[m]++;
      different += ask(motions()[m], i, seeds[m]) != expected[m][i];
      ++asked;
      if (next[m] == motions()[m].poses.size()) open.erase(open.begin() + std::ptrdiff_t(at));
    }
  });
  EXPECT_EQ(different, 0);
  EXPECT_EQ(asked, int(kThreads * motions().size()) * kPoses);
  EXPECT_GE(motions().size(), 25u);
}

TEST_F(Threads, ColdQueriesInAnyOrderAnswerAsOneThread) {
  std::vector<Fields> expected;
  for (const Motion& motion : motions()) {
    for (std::size_t i = 0; i < motion.poses.size(); ++i) {
      PairSeed cold;
      expected.push_back(ask(motion, i, cold));
    }
  }
  std::atomic<int> different{0};
  in_threads([&](std::size_t t) {
    std::vector<std::size_t> order(expected.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::shuffle(order.begin(), order.end(), std::mt19937{std::uint32_t(100 + t)});
    for (const std::size_t k : order) {
      PairSeed cold;
      different += ask(motions()[k / kPoses], k % kPoses, cold) != expected[k];
    }
  });
  EXPECT_EQ(different, 0);
}

TEST_F(Threads, ModelsAreCopiedAndDroppedWhileOthersAsk) {
  const auto expected = alone();
  std::atomic<int> different{0};
  in_threads([&](std::size_t t) {
    for (std::size_t m = t; m < motions().size(); m += kThreads / 2) {
      const Model a = *motions()[m].a, b = *motions()[m].b;
      const Motion own{&a, &b, motions()[m].poses};
      PairSeed seed;
      for (std::size_t i = 0; i < own.poses.size(); ++i) different += ask(own, i, seed) != expected[m][i];
      different += a.with_table({lut::Resolution::None, 1}).value().table().size() != 0;
    }
  });
  EXPECT_EQ(different, 0);
}

TEST_F(Threads, BatchesAnswerAsOneAfterTheOther) {
  const Executor backwards = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    while (count > 0) task(--count);
  };
  for (const auto& executor : {on_threads(1), on_threads(unsigned(kThreads)), backwards}) {
    std::vector<PairSeed> seeds(motions().size()), own(motions().size());
    for (std::size_t i = 0; i < std::size_t(kPoses); ++i) {  // seeds carry from batch to batch
      std::vector<PairQuery> pairs;
      for (std::size_t m = 0; m < motions().size(); ++m) {
        pairs.push_back({motions()[m].a, motions()[m].b, motions()[m].poses[i], &seeds[m]});
        pairs.push_back({motions()[m].a, motions()[m].b, motions()[m].poses[i], nullptr});
      }
      std::vector<Answer> answers(pairs.size());
      i % 2 == 0 ? distance(pairs, answers, {}, executor) : intersects(pairs, answers, {}, executor);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        PairSeed cold;
        const PairQuery& q = pairs[k];
        PairSeed& seed = q.seed ? own[k / 2] : cold;
        Fields expected, got;
        answers::append(i % 2 == 0 ? distance(*q.a, *q.b, q.b_in_a, seed) : intersects(*q.a, *q.b, q.b_in_a, seed), expected);
        answers::append(answers[k], got);
        ASSERT_EQ(expected, got) << "pose " << i << ", pair " << k;
      }
    }
  }
  distance({}, {}, {}, on_threads(4));
}

TEST_F(Threads, WithoutAnExecutorABatchRunsOnItsCaller) {
  const Pose apart{Mat3::Identity(), Vec3(9, 0, 0)};
  const std::vector<PairQuery> pairs(100, {&models()[0], &models()[1], apart});
  std::vector<Answer> answers(pairs.size()), verdicts(pairs.size());
  distance(pairs, answers, {}, Executor{});
  intersects(pairs, verdicts, {}, nullptr);
  PairSeed cold;
  EXPECT_EQ(answers[99].lower, distance(models()[0], models()[1], apart, cold).lower);
  EXPECT_EQ(verdicts[99].verdict, Verdict::Disjoint);
}

TEST(Executor, RunsEveryTaskOnceOnAnyNumberOfThreads) {
  for (const unsigned count : {0u, 1u, 2u, 7u, ~0u}) {
    const Executor executor = on_threads(count);
    for (const std::size_t tasks : {0, 1, 5, 1000}) {
      std::vector<std::atomic<int>> times(tasks);
      executor(tasks, [&](std::size_t task) { ++times[task]; });
      for (const auto& t : times) EXPECT_EQ(t, 1);
    }
  }
}

TEST(Executor, ThrowsATasksExceptionOnTheCallerAfterTheBatchHasStopped) {
  for (const unsigned count : {1u, 2u, 8u}) {
    const Executor executor = on_threads(count);
    for (int round = 0; round < 5; ++round) {
      std::atomic<int> running{0}, ended{0};
      const auto task = [&](std::size_t i) {
        ++running;
        if (i % 50 == 49) --running, throw std::runtime_error("task");
        std::this_thread::yield();
        ++ended, --running;
      };
      EXPECT_THROW(executor(100000, task), std::runtime_error);
      EXPECT_EQ(running, 0) << "a task outlived its batch";
      EXPECT_LT(ended, 50000) << "tasks went on after one had failed";
      std::atomic<int> after{0};
      executor(10, [&](std::size_t) { ++after; });
      EXPECT_EQ(after, 10) << "the executor is of no more use";
    }
  }
}

TEST(Executor, DoesWithTheThreadsThatTheSystemGives) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs all the addresses that this test takes away";
#endif
  const auto few_threads = [] {
    const rlimit limit{std::size_t{256} << 20, std::size_t{256} << 20};  // stacks of 8 MB
    setrlimit(RLIMIT_AS, &limit);
    std::atomic<int> done{0};
    on_threads(200)(1000, [&](std::size_t) { ++done; });
    std::_Exit(done == 1000 ? 0 : 1);
  };
  EXPECT_EXIT(few_threads(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace swiftlet
