// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A batch beside the same queries in a loop: of pairs over so many models that no cache holds them, and of pairs over so few
// that one does. Each frame is asked by the loop, by a batch on one thread and by a batch on two, in turns, from the same
// seeds; and by a loop that asks each query twice.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <swiftlet/batch.h>
#include <swiftlet/check.h>

#include "median.h"
#include "random.h"
#include "scenes.h"

namespace swiftlet::bench {
using namespace yardstick;
namespace {

constexpr std::uint32_t kTriangles140 = 276;  ///< of a hull with 140 vertices
constexpr std::size_t kModels = 20'000, kPairs = 100'000, kFewModels = 40, kFewPairs = 2'000;
constexpr int kRounds = 9;
constexpr double kTurn = 1.04 * 3.14159265358979 / 180;  ///< between two frames
constexpr double kNearest = 1.7, kFarthest = 2.7;        ///< centres, in bounding radii
constexpr std::size_t kCheckEvery = 50;

/// Fat, plate and long bodies in turn, each in a block of its own.
std::vector<Model> hulls(const std::filesystem::path& cache, std::size_t count) {
  const Shelf shelf(cache / "hulls");
  std::vector<std::optional<Model>> made(count);
  on_threads(2)(count, [&](std::size_t i) {
    made[i] = shelf.ellipsoid(shapes::kFamilies[i % shapes::kFamilies.size()], kTriangles140, 1 + i).model;
  });
  std::vector<Model> models;
  for (std::optional<Model>& model : made) models.push_back(*std::move(model));
  return models;
}

struct Frame {
  std::vector<PairQuery> queries;
  std::vector<PairSeed> seeds;  ///< from which the queries begin
};

struct Timed {
  double seconds = 0;
  std::uint64_t hash = 0;
};

/// Pairs of any two of the models: in random poses without a start, and, a little turned, from the seeds that these leave.
class Load {
 public:
  Load(std::span<const Model> models, std::size_t count) : seeds_(count), answers_(count) {
    shapes::Random random(7);
    const auto any = [&]() -> const Model& { return models[random.bits() % models.size()]; };
    for (std::size_t i = 0; i < count; ++i) {
      const Model &a = any(), &b = any();
      const Mat3 rotation = random.rotation(), turn = shapes::rotation(random.on_sphere(), kTurn);
      const Vec3 apart = random.uniform(kNearest, kFarthest) * random.on_sphere();
      const auto add = [&](Frame& frame, const Mat3& r, const Vec3& t) {
        frame.queries.push_back({a, b, {r, a.centre() + t - r * b.centre()}, &seeds_[i]});
      };
      add(cold, rotation, apart);
      add(warm, turn * rotation, turn * apart);
    }
    cold.seeds.resize(count);
    distance(cold.queries, answers_);
    warm.seeds = seeds_;
  }

  /// Asks all queries of a frame `passes` times.
  template <class Ask>
  Timed run(const Frame& frame, int passes, Ask ask) {
    Timed t;
    for (int pass = 0; pass < passes; ++pass) {
      seeds_ = frame.seeds;
      const auto begin = std::chrono::steady_clock::now();
      ask(std::span(frame.queries), std::span(answers_));
      t.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    t.hash = 0xcbf29ce484222325u;
    for (const Answer& answer : answers_) {
      const auto bytes = std::as_bytes(std::span(&answer.lower, 2));
      for (const std::byte b : bytes) t.hash = (t.hash ^ std::uint64_t(b)) * 0x100000001b3u;
    }
    return t;
  }
  /// How many of the last answers `check` refuses, of those that it looks at.
  std::size_t wrong(const Frame& frame) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < answers_.size(); i += kCheckEvery) {
      const PairQuery& q = frame.queries[i];
      count += !check(q.a, q.b, q.b_in_a, answers_[i]);
    }
    return count;
  }

  Frame cold, warm;

 private:
  std::vector<PairSeed> seeds_;
  std::vector<Answer> answers_;
};

using Ask = void (*)(std::span<const PairQuery>, std::span<Answer>, const Run&);
struct Question {
  const char* name;
  Ask one_by_one, batch;
};
constexpr Question kQuestions[] = {
    {"distance",
     [](std::span<const PairQuery> pairs, std::span<Answer> answers, const Run&) {
       for (std::size_t i = 0; i < pairs.size(); ++i)
         answers[i] = distance(pairs[i].a, pairs[i].b, pairs[i].b_in_a, *pairs[i].seed);
     },
     [](std::span<const PairQuery> pairs, std::span<Answer> answers, const Run& run) { distance(pairs, answers, {}, run); }},
    {"intersects",
     [](std::span<const PairQuery> pairs, std::span<Answer> answers, const Run&) {
       for (std::size_t i = 0; i < pairs.size(); ++i)
         answers[i] = intersects(pairs[i].a, pairs[i].b, pairs[i].b_in_a, *pairs[i].seed);
     },
     [](std::span<const PairQuery> pairs, std::span<Answer> answers, const Run& run) { intersects(pairs, answers, {}, run); }},
};

/// Asks each query twice from the same seed: what the second one takes, with its bodies in the cache, is no memory's fault.
void twice(const Question& question, std::span<const PairQuery> pairs, std::span<Answer> answers) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairSeed seed = *pairs[i].seed;
    question.one_by_one(pairs.subspan(i, 1), answers.subspan(i, 1), {});
    *pairs[i].seed = seed;
    question.one_by_one(pairs.subspan(i, 1), answers.subspan(i, 1), {});
  }
}

/// Prints a line for each question and frame. Returns whether all ways gave the same answers, none of them wrong.
bool compare(Load& load, std::size_t pairs, int passes, int rounds) {
  const Executor one = on_threads(1), two = on_threads(2);
  bool good = true;
  for (const Question& question : kQuestions) {
    for (const Frame* frame : {&load.cold, &load.warm}) {
      std::vector<double> loop, batch, both, cached, gain, scaling;
      bool same = true;
      std::uint64_t hash = 0;
      for (int round = 0; round < rounds; ++round) {
        const auto ask = [&](auto way) {
          const Timed t = load.run(*frame, passes, way);
          if (hash == 0) hash = t.hash;
          same = same && t.hash == hash;
          return 1e9 * t.seconds / double(pairs) / passes;
        };
        loop.push_back(ask([&](auto q, auto a) { question.one_by_one(q, a, {}); }));
        batch.push_back(ask([&](auto q, auto a) { question.batch(q, a, {one}); }));
        both.push_back(ask([&](auto q, auto a) { question.batch(q, a, {two}); }));
        cached.push_back(ask([&](auto q, auto a) { twice(question, q, a); }) - loop.back());
        gain.push_back(loop.back() / batch.back());
        scaling.push_back(batch.back() / both.back());
      }
      const std::size_t wrong = load.wrong(*frame);
      std::printf("%-10s %s %7.0f %7.0f %7.0f %5.2f %7.0f %5.2f  %016llx %s, %zu wrong\n", question.name,
                  frame == &load.cold ? "cold" : "warm", median(loop), median(cached), median(batch), median(gain),
                  median(both), median(scaling), static_cast<unsigned long long>(hash), same ? "same" : "DIFFER", wrong);
      std::fflush(stdout);
      good = good && same && wrong == 0;
    }
  }
  return good;
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) {
  using namespace swiftlet::bench;
  if (argc < 2 || argc > 4 || (argc > 2 && std::atoi(argv[2]) < 1) || (argc > 3 && std::atoi(argv[3]) < 1))
    return std::fputs("swiftlet_scattered CACHE [PAIRS [ROUNDS]]\n", stderr), 2;
  const std::size_t pairs = argc > 2 ? std::size_t(std::atoi(argv[2])) : kPairs;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : kRounds;
  const std::vector<swiftlet::Model> models = hulls(argv[1], kModels);
  double bytes = 0;
  for (const swiftlet::Model& model : models) bytes += double(model.bytes().size());
  bool good = true;
  const auto table = [&](std::span<const swiftlet::Model> of, std::size_t count, int passes) {
    std::printf("%zu pairs over %zu models of %.0f kB\n", count, of.size(), bytes / double(models.size()) / 1e3);
    std::puts("ns per query       loop  cached   batch  gain  two threads");
    Load load(of, count);
    good = compare(load, count, passes, rounds) && good;
  };
  table(models, pairs, 1);
  table(std::span(models).first(kFewModels), kFewPairs, std::max(1, int(pairs / kFewPairs)));
  return good ? 0 : 1;
}
