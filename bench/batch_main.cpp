// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A batch on some threads beside as many processes that ask one by one: what sharing a process costs. Both answer the same
// pairs in the same order of poses, each with its own seeds, in turns.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <swiftlet/batch.h>

#include "median.h"
#include "scenes.h"

namespace swiftlet::bench {
using namespace yardstick;
namespace {

constexpr int kRounds = 9, kMovesPerRound = 20;

/// 100 pairs of 2 000 triangles, each on 50 orbits at once: every move turns all of them by 10.4 degrees.
class Load {
 public:
  explicit Load(const Shelf& shelf) : scene_(crowd(shelf, 2'000, 10.4, 50 * (kMovesPerRound + 1))) {
    const std::size_t per_move = scene_.queries.size() / (kMovesPerRound + 1);
    seeds_.resize(per_move);
    answers_.resize(per_move);
    moves_.resize(kMovesPerRound + 1);
    for (std::size_t move = 0; move < moves_.size(); ++move) {
      for (std::size_t i = 0; i < per_move; ++i) {
        // Orbit i / 100 of a pair begins kMovesPerRound + 1 poses after the one before.
        const std::size_t pair = i % scene_.pairs.size(), orbit = i / scene_.pairs.size();
        const Query& q = scene_.queries[(orbit * moves_.size() + move) * scene_.pairs.size() + pair];
        moves_[move].push_back(
            {scene_.models[scene_.pairs[q.pair].a], scene_.models[scene_.pairs[q.pair].b], q.b_in_a, &seeds_[i]});
      }
    }
  }
  std::size_t pairs() const { return seeds_.size(); }

  /// Asks pairs [begin, end), move after move, from the seeds of the first one; the sum of the answers' hashes.
  template <class Ask>
  std::uint64_t run(std::size_t begin, std::size_t end, Ask ask) {
    std::uint64_t hash = 0;
    for (const auto& move : moves_) {
      ask(std::span(move).subspan(begin, end - begin), std::span(answers_).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) hash += hash_of(std::as_bytes(std::span(&answers_[i].lower, 2))) * (2 * i + 1);
    }
    return hash;
  }

 private:
  static std::uint64_t hash_of(std::span<const std::byte> bytes) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (const std::byte b : bytes) h = (h ^ std::uint64_t(b)) * 0x100000001b3u;
    return h;
  }
  Scene scene_;
  std::vector<PairSeed> seeds_;
  std::vector<Answer> answers_;
  std::vector<std::vector<PairQuery>> moves_;
};

struct Timed {
  double seconds = 0;
  std::uint64_t hash = 0;
};

template <class Work>
Timed timed(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  Timed t;
  t.hash = work();
  t.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return t;
}

Timed in_threads(Load& load, const Executor& threads) {
  return timed(
      [&] { return load.run(0, load.pairs(), [&](auto pairs, auto answers) { distance(pairs, answers, {}, {threads}); }); });
}

/// Each process says when it is ready, waits for all, and sends its hash.
Timed in_processes(Load& load, unsigned count) {
  int ready[2], go[2], done[2];
  if (pipe(ready) != 0 || pipe(go) != 0 || pipe(done) != 0) std::perror("pipe"), std::exit(1);
  for (unsigned k = 0; k < count; ++k) {
    if (fork() != 0) continue;
    char byte = 0;
    if (write(ready[1], &byte, 1) != 1 || read(go[0], &byte, 1) != 1) _exit(1);
    const std::uint64_t hash = load.run(load.pairs() * k / count, load.pairs() * (k + 1) / count, [](auto pairs, auto answers) {
      for (std::size_t i = 0; i < pairs.size(); ++i)
        answers[i] = distance(pairs[i].a, pairs[i].b, pairs[i].b_in_a, *pairs[i].seed);
    });
    _exit(write(done[1], &hash, sizeof hash) == sizeof hash ? 0 : 1);
  }
  std::string bytes(count, 0);
  for (unsigned k = 0; k < count; ++k) {
    if (read(ready[0], bytes.data(), 1) != 1) std::exit(1);
  }
  const Timed t = timed([&] {
    if (write(go[1], bytes.data(), count) != ssize_t(count)) std::exit(1);
    std::uint64_t sum = 0, hash = 0;
    for (unsigned k = 0; k < count; ++k) {
      if (read(done[0], &hash, sizeof hash) != sizeof hash) std::exit(1);
      sum += hash;
    }
    return sum;
  });
  for (unsigned k = 0; k < count; ++k) wait(nullptr);
  for (const int end : {ready[0], ready[1], go[0], go[1], done[0], done[1]}) close(end);
  return t;
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) {
  using namespace swiftlet::bench;
  if (argc != 3 || std::atoi(argv[2]) < 1)
    return std::fputs("swiftlet_batch CACHE COUNT: of threads and of processes\n", stderr), 2;
  const auto count = unsigned(std::atoi(argv[2]));
  const Shelf shelf(argv[1]);
  Load load(shelf);
  const swiftlet::Executor on_all = swiftlet::on_threads(count);
  std::vector<double> ratios, threads, processes, one;
  const double queries = double(load.pairs()) * (kMovesPerRound + 1);
  bool same = true;
  for (int round = 0; round < kRounds; ++round) {
    // The processes leave the seeds here as they were; so the threads begin from those of the round before, and both alike.
    const Timed p = in_processes(load, count), single = in_processes(load, 1), t = in_threads(load, on_all);
    same = same && p.hash == t.hash && p.hash == single.hash;
    ratios.push_back(p.seconds / t.seconds);
    threads.push_back(1e9 * t.seconds / queries);
    processes.push_back(1e9 * p.seconds / queries);
    one.push_back(1e9 * single.seconds / queries);
  }
  std::printf("%u threads, a batch of %zu pairs   %7.0f ns per query\n", count, load.pairs(), median(threads));
  std::printf("%u processes, one by one         %7.0f ns per query\n", count, median(processes));
  std::printf("1 process, one by one           %7.0f ns per query\n", median(one));
  std::printf("the batch reaches %.2f of the processes (median of %d rounds); answers %s\n", median(ratios), kRounds,
              same ? "the same bits" : "DIFFER");
  return same ? 0 : 1;
}
