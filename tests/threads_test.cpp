// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Law 8 under many threads: shared models, seeds of one's own, any order, the bits of one thread. Run by ./run threads under
// the thread sanitizer.
#include <swiftlet/batch.h>

#include <gtest/gtest.h>

#if defined(__unix__) && GTEST_HAS_DEATH_TEST
#include <sys/resource.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <random>
#include <span>
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
  const Tuning tuning{.start = StartPolicy(i % 5), .refinement = Refinement(i % 3), .plane_rule = PlaneRule(i / 5 % 2)};
  const Pose& pose = motion.poses[i];
  answers::append(distance(*motion.a, *motion.b, pose, seed, {.tuning = tuning}), fields);
  if (i % 4 == 0) answers::append(intersects(*motion.a, *motion.b, pose, seed, {.tuning = tuning}), fields);
  if (i % 4 == 1) answers::append(within(*motion.a, *motion.b, pose, 0.25, seed, {.tuning = tuning}).answer, fields);
  if (i % 4 == 2) answers::append(closest_features(*motion.a, *motion.b, pose, seed, {.tuning = tuning}).answer, fields);
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

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#define SWIFTLET_NEEDS_THREADS() GTEST_SKIP() << "there are no threads here"
#else
#define SWIFTLET_NEEDS_THREADS() static_assert(true)
#endif

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
  SWIFTLET_NEEDS_THREADS();
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
  SWIFTLET_NEEDS_THREADS();
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
  SWIFTLET_NEEDS_THREADS();
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

// ---- Batches ---------------------------------------------------------------------------------------------------------------

Fields fields_of(const Answer& answer) {
  Fields fields;
  answers::append(answer, fields);
  return fields;
}
Fields fields_of(const Within& within) {
  Fields fields = fields_of(within.answer);
  fields.push_back(std::uint64_t(within.decision));
  return fields;
}
Fields fields_of(const ClosestFeatures& closest) {
  Fields fields = fields_of(closest.answer);
  for (const SourceFeature& source : {closest.source_a, closest.source_b}) {
    fields.insert(fields.end(), {std::uint64_t(source.kind), source.vertices[0], source.vertices[1]});
    fields.insert(fields.end(), source.triangles.begin(), source.triangles.end());
  }
  return fields;
}

/// A query in its three forms.
struct Query {
  const char* name;
  std::function<Fields(const Body&, const Body&, const Pose&, PairSeed&)> one;
  std::function<std::vector<Fields>(std::span<const PairQuery>, const Run&)> over_pairs;
  std::function<std::vector<Fields>(const Body&, const Body&, std::span<const Pose>, const Run&)> over_poses;
  Fields untouched;  ///< an answer that was not asked for
};

template <class AnyAnswer, class AnyOptions, class Ask, class... Threshold>
Query query(const char* name, const AnyOptions& options, Ask ask, Threshold... threshold) {
  const auto fields_of_all = [](const std::vector<AnyAnswer>& answers) {
    std::vector<Fields> all;
    for (const AnyAnswer& answer : answers) all.push_back(fields_of(answer));
    return all;
  };
  return {name,
          [=](const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
            return fields_of(ask(a, b, b_in_a, threshold..., seed, options));
          },
          [=](std::span<const PairQuery> pairs, const Run& run) {
            std::vector<AnyAnswer> answers(pairs.size());
            ask(pairs, threshold..., std::span(answers), options, run);
            return fields_of_all(answers);
          },
          [=](const Body& a, const Body& b, std::span<const Pose> poses, const Run& run) {
            std::vector<AnyAnswer> answers(poses.size());
            ask(a, b, poses, threshold..., std::span(answers), options, run);
            return fields_of_all(answers);
          },
          fields_of(AnyAnswer{})};
}

std::vector<Query> queries() {
  return {query<Answer>("distance", Options{.relative = 0.01}, [](auto&&... x) { return distance(x...); }),
          query<Answer>("signed_distance", Options{}, [](auto&&... x) { return signed_distance(x...); }),
          query<Answer>("intersects", Effort{}, [](auto&&... x) { return intersects(x...); }),
          query<Within>(
              "within", Effort{}, [](auto&&... x) { return within(x...); }, 0.25),
          query<Within>(
              "signed_within", Effort{}, [](auto&&... x) { return signed_within(x...); }, -0.125),
          query<ClosestFeatures>("closest_features", ClosestOptions{}, [](auto&&... x) { return closest_features(x...); })};
}

void backwards(std::size_t count, const std::function<void(std::size_t)>& task) {
  while (count > 0) task(--count);
}
std::vector<Executor> executors() {
  return {Executor{}, on_threads(1), on_threads(3), on_threads(unsigned(kThreads)), backwards};
}

/// Pairs of all motions at their i-th pose: warm ones, and cold ones of rounded bodies and of a primitive.
std::vector<PairQuery> pairs_at(std::size_t i, std::vector<PairSeed>& seeds) {
  std::vector<PairQuery> pairs;
  for (std::size_t m = 0; m < motions().size(); ++m) {
    const auto& [a, b, poses] = motions()[m];
    pairs.push_back({*a, *b, poses[i], &seeds[m]});
    pairs.push_back({{*a, 0.125}, {*b, 0.0625}, poses[i], nullptr});
    pairs.push_back({*a, Body::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), poses[i], nullptr});
  }
  return pairs;
}

TEST_F(Threads, BatchesOverPairsAnswerAsOneAfterTheOther) {
  constexpr std::size_t kFrames = 30;
  for (const Query& query : queries()) {
    SCOPED_TRACE(query.name);
    std::vector<std::vector<Fields>> expected;
    std::vector<PairSeed> own(motions().size());
    for (std::size_t i = 0; i < kFrames; ++i) {
      expected.emplace_back();
      for (const PairQuery& q : pairs_at(i, own)) {
        PairSeed cold;
        expected.back().push_back(query.one(q.a, q.b, q.b_in_a, q.seed ? *q.seed : cold));
      }
    }
    for (const Executor& executor : executors()) {
      std::vector<PairSeed> seeds(motions().size());  // they carry from batch to batch
      for (std::size_t i = 0; i < kFrames; ++i)
        ASSERT_EQ(query.over_pairs(pairs_at(i, seeds), {executor}), expected[i]) << "pose " << i;
    }
    EXPECT_TRUE(query.over_pairs({}, {on_threads(4)}).empty());
  }
}

/// Bodies of every kind: whole models, models without their fine levels or without maps, a model of a point and one of a
/// segment, and primitives, one of them illegal.
std::vector<Body> bodies_of_all_kinds() {
  static const std::vector<Model> made = [] {
    std::vector<Model> some;
    for (const Model& model : models()) {
      const int last = model.level_count() - 1;
      for (const int level : {last, last / 2}) some.push_back(model.cut({.bytes = model.level(level).prefix}));
      some.push_back(model.with_table({.map_cells = 0}).value());
    }
    const std::vector<Vec3> ends{{0.5, 0, 0}, {0.25, 1, 0.5}};
    LevelArrays arrays;
    for (const std::size_t count : {1, 2}) {
      arrays.vertices = std::span(ends).first(count);
      some.push_back(Model::from_level(arrays).value());
    }
    return some;
  }();
  std::vector<Body> bodies{Body::point({0.5, 0.25, 0}), Body::segment({0, 0, 0}, {1, 0.5, 0}, 0.125),
                           Body::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), Body::box({-1, -0.5, -0.25}, {1, 0.5, 0.25}),
                           Body{}};
  for (const std::vector<Model>* all : {&models(), &made}) bodies.insert(bodies.end(), all->begin(), all->end());
  return bodies;
}

/// Pairs of any two of these, cold, from seeds of any bits, and from those that the frame before has left.
TEST_F(Threads, BatchesOfBodiesOfAllKindsInAnyOrderAnswerAsOneAfterTheOther) {
  constexpr std::size_t kPairs = 3000, kFrames = 3;
  const std::vector<Body> bodies = bodies_of_all_kinds();
  const auto is_cut = [](const Body& b) { return b.model() && b.model()->finest_level() > 0; };
  EXPECT_GE(std::count_if(bodies.begin(), bodies.end(), is_cut), 3);
  for (const Query& query : queries()) {
    SCOPED_TRACE(query.name);
    answers::Poses poses(9);
    const auto any = [&] { return bodies[poses.bits() % bodies.size()]; };
    std::vector<PairSeed> start(kPairs), seeds, own;
    std::vector<PairQuery> pairs;
    for (PairSeed& seed : start) {
      seed = poses.seed();
      pairs.push_back({any(), any(), {}, nullptr});
    }
    for (const Executor& executor : executors()) {
      seeds = own = start;
      answers::Poses moving(10);
      for (std::size_t frame = 0; frame < kFrames; ++frame) {
        std::vector<Fields> expected;
        for (std::size_t i = 0; i < kPairs; ++i) {
          PairQuery& q = pairs[i];
          q.b_in_a = moving.next();
          const bool cold = i % 4 == 0;
          q.seed = cold ? nullptr : &seeds[i];
          PairSeed none;
          expected.push_back(query.one(q.a, q.b, q.b_in_a, cold ? none : own[i]));
        }
        ASSERT_TRUE(query.over_pairs(pairs, {executor}) == expected) << "frame " << frame;
      }
    }
  }
}

/// Poses that follow one another, some of them in the next chunk and some in the one after that.
std::vector<Pose> many_poses() {
  answers::Poses poses(6);
  std::vector<Pose> made(2 * kPosesPerChunk + 100);
  for (Pose& pose : made) pose = poses.next();
  return made;
}

TEST_F(Threads, BatchesOverPosesShareASeedWithinAChunk) {
  const std::vector<Pose> poses = many_poses();
  const Body a = models()[0], b{models()[1], 0.125};
  for (const Query& query : queries()) {
    SCOPED_TRACE(query.name);
    std::vector<Fields> expected;
    PairSeed seed;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i % kPosesPerChunk == 0) seed = PairSeed{};
      expected.push_back(query.one(a, b, poses[i], seed));
    }
    for (const Executor& executor : executors()) EXPECT_TRUE(query.over_poses(a, b, poses, {executor}) == expected);
    const std::span<const Pose> from_a_border = std::span(poses).subspan(kPosesPerChunk, 50);
    const auto there = expected.begin() + std::ptrdiff_t(kPosesPerChunk);
    EXPECT_EQ(query.over_poses(a, b, from_a_border, {}), std::vector<Fields>(there, there + 50));
    EXPECT_TRUE(query.over_poses(a, b, {}, {on_threads(4)}).empty());
  }
}

/// The tasks that were done, of `size` answers each: these are right, and the others as they were before.
std::size_t tasks_done(const std::vector<Fields>& answers, const std::vector<Fields>& expected, const Fields& untouched,
                       std::size_t size) {
  std::size_t done = 0;
  for (std::size_t first = 0; first < answers.size(); first += size) {
    const std::size_t end = std::min(first + size, answers.size());
    const bool is_done = answers[first] != untouched;
    for (std::size_t i = first; i < end; ++i) EXPECT_EQ(answers[i], is_done ? expected[i] : untouched) << i;
    done += is_done;
  }
  return done;
}

TEST_F(Threads, AStoppedBatchKeepsWhatIsDoneAndLeavesTheRest) {
  constexpr std::size_t kPairsPerTask = 32;
  const std::vector<Pose> poses = many_poses();
  const Body a = models()[0], b = models()[1];
  std::vector<PairQuery> pairs;
  for (const Pose& pose : poses) pairs.push_back({a, b, pose, nullptr});
  for (const Query& query : queries()) {
    SCOPED_TRACE(query.name);
    const std::vector<Fields> of_pairs = query.over_pairs(pairs, {}), of_poses = query.over_poses(a, b, poses, {});
    for (const unsigned threads : {1u, unsigned(kThreads)}) {
      const auto stopped = [&](bool at_once, const auto& ask) {
        std::atomic<bool> stop = at_once;
        const Executor stops_after_a_task = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
          on_threads(threads)(count, [&](std::size_t i) { task(i), stop = true; });
        };
        return ask(swiftlet::Run{stops_after_a_task, [&stop] { return stop.load(); }});
      };
      const auto ask_pairs = [&](const auto& run) {
        return tasks_done(query.over_pairs(pairs, run), of_pairs, query.untouched, kPairsPerTask);
      };
      const auto ask_poses = [&](const auto& run) {
        return tasks_done(query.over_poses(a, b, poses, run), of_poses, query.untouched, kPosesPerChunk);
      };
      for (const std::size_t done : {stopped(false, ask_pairs), stopped(false, ask_poses)}) {
        EXPECT_GE(done, 1u);
        EXPECT_LE(done, threads) << "a task began after the stop";
      }
      EXPECT_EQ(stopped(true, ask_pairs), 0u);
      EXPECT_EQ(stopped(true, ask_poses), 0u);
    }
  }
}

/// A thread pool of the user's need not outlive an exception.
TEST_F(Threads, WhatAStopThrowsPassesNoExecutor) {
  const Body a = models()[0], b = models()[1];
  std::vector<PairQuery> pairs;
  for (const Pose& pose : many_poses()) pairs.push_back({a, b, pose, nullptr});
  std::vector<Answer> answers(pairs.size());
  bool passed = false;
  const Executor guarded = [&passed](std::size_t count, const std::function<void(std::size_t)>& task) {
    try {
      for (std::size_t i = 0; i < count; ++i) task(i);
    } catch (...) {
      passed = true;
      throw;
    }
  };
  const swiftlet::Run run{guarded, []() -> bool { throw std::runtime_error("stop"); }};
  EXPECT_THROW(distance(pairs, answers, Options(), run), std::runtime_error);
  EXPECT_FALSE(passed);
}

/// As of a time slice, or a flag that is reset: `stop` is true on its second call alone.
TEST_F(Threads, AStopHoldsForTheRestOfTheBatch) {
  const std::vector<Pose> poses = many_poses();
  const Body a = models()[0], b = models()[1];
  std::vector<PairQuery> pairs;
  for (const Pose& pose : poses) pairs.push_back({a, b, pose, nullptr});
  for (const Query& query : queries()) {
    SCOPED_TRACE(query.name);
    const auto done = [&](const auto& of_all, std::size_t per_task, const auto& ask) {
      int calls = 0;
      const std::vector<Fields> found = ask(swiftlet::Run{{}, [&calls] { return ++calls == 2; }});
      EXPECT_EQ(calls, 2);
      return tasks_done(found, of_all, query.untouched, per_task);
    };
    EXPECT_EQ(done(query.over_pairs(pairs, {}), 32, [&](const auto& run) { return query.over_pairs(pairs, run); }), 1u);
    EXPECT_EQ(done(query.over_poses(a, b, poses, {}), kPosesPerChunk,
                   [&](const auto& run) { return query.over_poses(a, b, poses, run); }),
              1u);
  }
}

TEST_F(Threads, BatchesShareNeitherATraceNorAProof) {
  LevelRecord record{.steps = 77};
  OverlapProof proof{.count = 77};
  const Tuning tuning{.trace = {&record, 1}, .proof = &proof};
  const Body cube = Body::box({-1, -1, -1}, {1, 1, 1});
  const std::vector<Pose> poses(3);
  const std::vector<PairQuery> pairs(3, {cube, cube, Pose{}});
  std::vector<Answer> answers(3);
  distance(pairs, answers, {.tuning = tuning});
  intersects(cube, cube, poses, answers, {.tuning = tuning});
  EXPECT_EQ(record.steps, 77u);
  EXPECT_EQ(proof.count, 77u);
  EXPECT_EQ(answers[2].verdict, Verdict::Overlapping);
}

// ---- Executors -------------------------------------------------------------------------------------------------------------

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

#if defined(__unix__) && GTEST_HAS_DEATH_TEST
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
#endif

}  // namespace
}  // namespace swiftlet
