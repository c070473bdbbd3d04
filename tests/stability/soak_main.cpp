// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs the generators on every core for so many minutes, tells what they saw, stores the pairs that failed, and names the batch
// that crashed.
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "case.h"
#include "generators.h"

namespace swiftlet::stability {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  double minutes = 0;
  std::uint64_t seed = 1;
  std::string family;  ///< only this one
  std::uint64_t first_batch = 0;
  std::uint64_t most_batches = ~std::uint64_t{0};
  std::uint64_t judge_every = 1;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::filesystem::path found = "tests/data/found";
};

/// A walk without end is a failure too: a batch may take this long after time is up.
constexpr auto kGrace = std::chrono::minutes(2);

/// How to run this thread's batch again, for where it crashes.
thread_local char running_batch[256];

/// Names the batch of the thread that crashed, with nothing but what a signal handler may call; then the default action.
void on_crash(int signal) {
  constexpr char kCrashed[] = "FAILED a batch crashes; again: ";
  const bool written = write(STDOUT_FILENO, kCrashed, sizeof kCrashed - 1) > 0 &&
                       write(STDOUT_FILENO, running_batch, strlen(running_batch)) > 0 && write(STDOUT_FILENO, "\n", 1) > 0;
  static_cast<void>(written);
  raise(signal);  // after the handler: SA_RESETHAND
}
void name_crashes() {
  struct sigaction action = {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_RESETHAND;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
}

/// A thread whose stack ends before memory that nothing may touch: a query that reads beyond its storage, which is on the
/// stack, crashes there instead of finding the stack of another thread.
class Thread {
 public:
  explicit Thread(std::function<void()> work) : work_(std::move(work)) {
    void* const memory = mmap(nullptr, kStack + kGuard, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    pthread_attr_t attributes;
    const auto run = [](void* self) -> void* { return static_cast<Thread*>(self)->work_(), nullptr; };
    if (memory == MAP_FAILED || mprotect(memory, kStack, PROT_READ | PROT_WRITE) != 0 || pthread_attr_init(&attributes) != 0 ||
        pthread_attr_setstack(&attributes, memory, kStack) != 0 || pthread_create(&thread_, &attributes, run, this) != 0)
      throw std::runtime_error("no thread");
  }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  void join() { pthread_join(thread_, nullptr); }

 private:
  /// As much as a main thread has; and farther than an index of 16 bits reaches in an array of records of 256 bytes.
  static constexpr std::size_t kStack = std::size_t{8} << 20, kGuard = std::size_t{16} << 20;
  std::function<void()> work_;
  pthread_t thread_;
};

class Soak {
 public:
  explicit Soak(Options options) : options_(std::move(options)), running_(options_.threads, -1) {
    for (const Family& family : families())
      if (options_.family.empty() || options_.family == family.name) chosen_.push_back(&family);
    tallies_.resize(chosen_.size());
  }

  int run() {
    if (chosen_.empty()) {
      std::fprintf(stderr, "no family is called '%s'; there are:\n", options_.family.c_str());
      for (const Family& family : families()) std::fprintf(stderr, "  %s\n", family.name);
      return 2;
    }
    const auto end = begin_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(60 * options_.minutes));
    std::deque<Thread> threads;
    for (unsigned t = 0; t < options_.threads; ++t) threads.emplace_back([this, t, end] { work(t, end); });
    for (auto next = begin_ + std::chrono::seconds(10); working_ > 0;
         std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      if (Clock::now() < next) continue;
      next += std::chrono::seconds(10);
      progress();
      if (Clock::now() > end + kGrace) stuck();
    }
    for (Thread& thread : threads) thread.join();
    return report();
  }

 private:
  void work(unsigned thread, Clock::time_point end) {
    while (options_.minutes <= 0 || Clock::now() < end) {
      const std::uint64_t job = next_++;
      const std::size_t family = job % chosen_.size();
      const std::uint64_t batch = job / chosen_.size();
      if (batch >= options_.most_batches) break;
      {
        const std::lock_guard lock(mutex_);
        running_[thread] = std::int64_t(job);
      }
      std::snprintf(running_batch, sizeof running_batch, "%s", rerun(*chosen_[family], options_.first_batch + batch).c_str());
      const Examiner seen = run_batch(*chosen_[family], options_.seed, options_.first_batch + batch, options_.judge_every);
      const std::lock_guard lock(mutex_);
      running_[thread] = -1;
      tallies_[family] += seen.tally;
      for (const Case& c : seen.failures) store(c, *chosen_[family], options_.first_batch + batch);
      for (const std::string& fault : seen.faults)
        std::printf("FAILED %s  again: %s\n", fault.c_str(), rerun(*chosen_[family], options_.first_batch + batch).c_str());
    }
    --working_;
  }

  std::string rerun(const Family& family, std::uint64_t batch) const {
    return "./run soak 0 --seed " + std::to_string(options_.seed) + " --family '" + family.name + "' --batch " +
           std::to_string(batch) + (options_.judge_every > 1 ? " --judge-every " + std::to_string(options_.judge_every) : "");
  }

  void store(const Case& c, const Family& family, std::uint64_t batch) {
    if (++stored_ > kMostStored) return;
    std::filesystem::create_directories(options_.found);
    const std::filesystem::path path = options_.found / (c.name + ".json");
    write_cases(path, {&c, 1});
    std::printf("FAILED %s\n  stored as %s; again: %s\n", c.symptom.c_str(), path.c_str(), rerun(family, batch).c_str());
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  Tally total() const {
    Tally sum;
    for (const Tally& tally : tallies_) sum += tally;
    return sum;
  }

  void progress() {
    const std::lock_guard lock(mutex_);
    const Tally sum = total();
    std::printf("%5.0f s: %llu pairs, %llu judged, %llu answers, %llu solved exactly, %llu failed; %.0f pairs a minute\n",
                seconds(), count(sum.pairs), count(sum.judged), count(sum.answers), count(sum.solved), count(sum.failed),
                60 * double(sum.pairs) / seconds());
    std::fflush(stdout);
  }

  [[noreturn]] void stuck() {
    for (const std::int64_t job : running_) {
      if (job < 0) continue;
      const Family& family = *chosen_[std::size_t(job) % chosen_.size()];
      std::printf("FAILED a batch does not end; again: %s\n",
                  rerun(family, options_.first_batch + std::uint64_t(job) / chosen_.size()).c_str());
    }
    std::fflush(stdout);
    std::_Exit(1);
  }

  int report() const {
    std::printf("\n%-26s %9s %9s %9s %8s %8s %7s  %8s %8s %8s %6s %7s %7s\n", "family", "pairs", "judged", "answers",
                "manifolds", "solved", "hits", "disjoint", "touching", "overlap", "steps", "widest", "failed");
    bool missed = false;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const Family& family = *chosen_[i];
      const Tally& tally = tallies_[i];
      row(family.name, tally);
      // A fair sample lies in the range.
      const bool fair = tally.trials >= 1000;
      if (!fair || (tally.hit_rate() >= family.least && tally.hit_rate() <= family.most)) continue;
      missed = true;
      std::printf("FAILED '%s' hits (%s) %.4f of the time, not %g to %g\n", family.name, family.hit, tally.hit_rate(),
                  family.least, family.most);
    }
    const Tally sum = total();
    row("all", sum);
    std::printf("\n%-26s %9s %8s  %9s %9s %9s %9s %11s\n", "proved the careful way", "distances", "of these", "neighbour",
                "width", "lean", "threshold", "no minimum");
    for (std::size_t i = 0; i < chosen_.size(); ++i) doubt_row(chosen_[i]->name, tallies_[i]);
    doubt_row("all", sum);
    std::printf("\n%llu depths, of at most %u supports\n", count(sum.depths), sum.supports);
    std::printf("%.0f s on %u threads, %.0f pairs a minute; widest is in units of law 2's bound; answer hash %016llx\n",
                seconds(), options_.threads, 60 * double(sum.pairs) / seconds(), count(sum.hash));
    return sum.failed > 0 || missed ? 1 : 0;
  }

  static void row(const char* name, const Tally& t) {
    std::printf("%-26s %9llu %9llu %9llu %8llu %8llu %6.1f%%  %8llu %8llu %8llu %6u %7.3f %7llu\n", name, count(t.pairs),
                count(t.judged), count(t.answers), count(t.manifolds), count(t.solved), 100 * t.hit_rate(),
                count(t.verdicts[1]), count(t.verdicts[2]), count(t.verdicts[3]), t.steps, t.widest, count(t.failed));
  }
  /// Of exact distances of bodies that do not overlap, how many the last walk's own tests did not prove, and why.
  static void doubt_row(const char* name, const Tally& t) {
    const std::uint64_t all = std::accumulate(t.doubts.begin(), t.doubts.end(), std::uint64_t{0});
    const auto share = [&](std::uint64_t n) { return all ? 100 * double(n) / double(all) : 0; };
    const auto of = [&](Doubt doubt) { return share(t.doubts[std::size_t(doubt)]); };
    std::printf("%-26s %9llu %7.2f%%  %8.2f%% %8.2f%% %8.2f%% %8.2f%% %10.2f%%\n", name, count(all),
                share(all - t.doubts[std::size_t(Doubt::None)]), of(Doubt::Neighbour), of(Doubt::Width), of(Doubt::Lean),
                of(Doubt::Threshold), of(Doubt::NoMinimum));
  }
  static unsigned long long count(std::uint64_t n) { return n; }

  static constexpr int kMostStored = 100;

  const Options options_;
  const Clock::time_point begin_ = Clock::now();
  std::vector<const Family*> chosen_;
  std::atomic<std::uint64_t> next_{0};
  std::atomic<unsigned> working_{options_.threads};
  std::mutex mutex_;  // of all below
  std::vector<Tally> tallies_;
  std::vector<std::int64_t> running_;
  int stored_ = 0;
};

}  // namespace
}  // namespace swiftlet::stability

int main(int argc, char** argv) try {
  using namespace swiftlet::stability;
  Options options;
  std::uint64_t batch = 0;
  CLI::App app("Asks generated hard pairs for so many minutes and has every answer judged by exact arithmetic");
  app.add_option("minutes", options.minutes, "how long; 0 with --batch")->required();
  app.add_option("--seed", options.seed, "what the pairs are generated from")->capture_default_str();
  app.add_option("--family", options.family, "one family only");
  CLI::Option* const one = app.add_option("--batch", batch, "one batch only, as a failure names it");
  app.add_option("--threads", options.threads, "all cores by default")->capture_default_str();
  app.add_option("--found", options.found, "where failing pairs are stored")->capture_default_str();
  app.add_option("--judge-every", options.judge_every, "judge one pair in so many; the others' answers are compared")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (one->count() > 0) {
    options.minutes = 0;
    options.first_batch = batch;
    options.most_batches = 1;
  } else if (options.minutes <= 0) {
    std::fputs("minutes must be above 0\n", stderr);
    return 2;
  }
  name_crashes();
  return Soak(options).run();
} catch (const std::exception& failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 2;
}
