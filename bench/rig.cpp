// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rig.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>

#include <benchmark/benchmark.h>

namespace swiftlet::bench {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr std::size_t kWarmUp = 5'000, kSlowWarmUp = 500;  // queries
constexpr double kSlow = 1e-5;                             // seconds per query
constexpr int kSlowRounds = 2;
constexpr std::size_t kFloorPoses = 20;
constexpr double kFloorMove = 1e-9;  // radii
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::string format(const char* pattern, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(line, sizeof line, pattern, arguments);
  va_end(arguments);
  return line;
}

namespace {

/// A method in a cell: its session, and what it answered last.
class Runner {
 public:
  Runner(const Entrant& entrant, Question question, std::span<const BodyPair> pairs, std::span<const Query> queries,
         double allowed)
      : session_(entrant.method->open(entrant.bodies, pairs)), question_(question), queries_(queries), allowed_(allowed) {
    const bool certified = entrant.method->capabilities().certified;
    relative_ = certified ? 0 : entrant.allowed;  // some peers know only that; what they make of it is measured
    outcomes.resize(queries.size());
  }

  /// Seconds for the scene's last `count` queries.
  double last(std::size_t count) {
    const std::size_t first = queries_.size() - std::min(queries_.size(), count);
    const auto queries = queries_.subspan(first);
    const auto answers = std::span(outcomes).subspan(first);
    const auto begin = Clock::now();
    if (question_ == Question::Intersects) {
      session_->intersections(queries, answers);
    } else if (question_ == Question::Depth) {
      session_->depths(queries, answers);
    } else if (allowed_ > 0) {
      session_->approximations(queries, allowed_, relative_, answers);
    } else {
      session_->distances(queries, answers);
    }
    return seconds_since(begin);
  }
  /// Asks some, to see.
  bool is_slow() {
    last(kSlowWarmUp / 2);
    slow_ = last(kSlowWarmUp) > kSlow * double(std::min(kSlowWarmUp, queries_.size()));
    return slow_;
  }
  /// Seconds for all.
  double timed_pass() {
    last(slow_ ? kSlowWarmUp : kWarmUp);
    return last(queries_.size());
  }
  Preparation preparation() const { return session_->preparation(); }

  std::vector<Outcome> outcomes;

 private:
  std::unique_ptr<Session> session_;
  Question question_;
  std::span<const Query> queries_;
  double allowed_, relative_;
  bool slow_ = false;
};

/// Keeps the times of each benchmark's repetitions.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration) {
        seconds[run.run_name.function_name].push_back(run.real_accumulated_time / double(run.iterations));
      }
    }
  }
  std::map<std::string, std::vector<double>> seconds;
};

double quantile(std::vector<double> values, double at) {
  std::sort(values.begin(), values.end());
  const double place = at * double(values.size() - 1);
  const std::size_t below = std::size_t(place);
  const double next = values[std::min(below + 1, values.size() - 1)];
  return values[below] + (place - double(below)) * (next - values[below]);
}

/// The times of all passes, by the names they are given.
class Rounds {
 public:
  Rounds() {
    static const bool initialized = [] {
      std::string program = "swiftlet_bench", shuffle = "--benchmark_enable_random_interleaving=true";
      char* arguments[] = {program.data(), shuffle.data(), nullptr};
      int count = 2;
      benchmark::Initialize(&count, arguments);
      return true;
    }();
    (void)initialized;
    benchmark::ClearRegisteredBenchmarks();
  }
  void add(const std::string& name, Runner& runner, int rounds) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&runner](benchmark::State& state) {
                                   for (auto _ : state) state.SetIterationTime(runner.timed_pass());
                                 })
        ->UseManualTime()
        ->Iterations(1)
        ->Repetitions(rounds);
  }
  std::map<std::string, std::vector<double>> run() {
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);
    benchmark::ClearRegisteredBenchmarks();
    return std::move(collector.seconds);
  }
};

/// The pose alternates, so that nothing can be memoised; the features stay.
std::vector<Query> floor_of(const Scene& scene, double radius) {
  std::vector<Query> result;
  const std::size_t block = std::max<std::size_t>(1, scene.queries.size() / kFloorPoses);
  for (std::size_t i = 0; i < scene.queries.size(); ++i) {
    Query query = scene.queries[i / block * block];
    if (i % 2) query.b_in_a.translation.x() += kFloorMove * radius;
    result.push_back(query);
  }
  return result;
}

/// Depths compare as distances do; none is a failure.
std::vector<Outcome> depths_of(std::vector<Outcome> outcomes) {
  for (Outcome& o : outcomes) o.failed = o.failed || !o.overlapping, o.overlapping = false;
  return outcomes;
}

void judge(Row& row, const Asked& asked, const Entrant& entrant, const Runner& runner) {
  const bool booleans = row.question == Question::Intersects;
  const std::vector<Outcome> outcomes = row.question == Question::Depth ? depths_of(runner.outcomes) : runner.outcomes;
  const Comparison c =
      booleans ? compare_verdicts(outcomes, asked.truth.queries) : compare(outcomes, asked.truth.queries, asked.radius);
  row.error = booleans ? kNoValue : c.max_error / asked.radius;
  row.mean_error = booleans ? kNoValue : c.mean_error / asked.radius;
  row.wrong = c.wrong();
  row.failed = c.failures;
  row.flagged = !c.right(std::max(entrant.allowed, entrant.method->capabilities().stated_error) * asked.radius);
  row.hash = c.hash;
  row.hash_true = c.hash == c.true_hash;
  for (const Outcome& o : outcomes) {
    row.steps += double(o.steps) / double(row.queries);
    row.plane_tests += double(o.plane_tests) / double(row.queries);
  }
}

}  // namespace

const char* name(Question question) {
  switch (question) {
    case Question::Distance: return "distance";
    case Question::Intersects: return "intersects";
    case Question::Depth: return "depth";
    case Question::Manifold: return "manifold";
  }
  return "";
}

Asked::Asked(const Scene& s, Question question) : scene(&s), bodies(bench::bodies(s)) {
  truth = question == Question::Depth ? certify_depths(bodies, s.pairs, s.queries) : certify(bodies, s.pairs, s.queries);
  for (const Model& model : s.models) {
    radius = std::max(radius, model.radius());
    triangles += double(model.level(0).triangle_count);
  }
  floor = floor_of(s, radius);
}

std::vector<Row> measure(const Asked& asked, Question question, std::span<const Entrant> entrants, int rounds) {
  const std::vector<Query>& queries = asked.scene->queries;
  const auto ours = swiftlet_method("floor", "", {});
  const Entrant floor_entrant{"floor", ours.get(), asked.bodies, 0};
  Runner floor(floor_entrant, question, asked.scene->pairs, asked.floor, 0);
  std::vector<std::unique_ptr<Runner>> runners;
  Rounds all;
  all.add("floor", floor, rounds);
  for (const Entrant& e : entrants) {
    runners.push_back(std::make_unique<Runner>(e, question, asked.scene->pairs, queries, e.allowed * asked.radius));
    all.add(e.series, *runners.back(), runners.back()->is_slow() ? std::min(rounds, kSlowRounds) : rounds);
  }
  auto seconds = all.run();

  const double to_ns = 1e9 / double(queries.size()), floor_ns = quantile(seconds.at("floor"), 0.5) * to_ns;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    const Entrant& e = entrants[i];
    const std::vector<double>& times = seconds.at(e.series);
    Row row;
    row.scene = asked.scene->name;
    row.question = question;
    row.series = e.series;
    row.choice = e.choice;
    row.allowed = e.allowed;
    row.queries = queries.size();
    row.rounds = times.size();
    row.ns = quantile(times, 0.5) * to_ns;
    row.spread = (quantile(times, 0.75) - quantile(times, 0.25)) * to_ns / row.ns;
    row.floor_ns = floor_ns;
    judge(row, asked, e, *runners[i]);
    row.bytes = double(runners[i]->preparation().heap_bytes) / asked.triangles;
    row.build_seconds = runners[i]->preparation().seconds;
    row.levels = e.method->capabilities().certified ? e.bodies.front().model->level_count() : 1;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string csv_header() {
  return "group,scene,shape,triangles,step,question,series,choice,levels,allowed,queries,rounds,ns,spread,floor_ns,ratio,error,"
         "mean_error,wrong,failed,flagged,hash,hash_true,steps,plane_tests,bytes,build_seconds\n";
}

std::string csv_line(const Row& r) {
  return format(
      "%s,%s,%s,%u,%g,%s,%s,%s,%d,%g,%zu,%zu,%.5g,%.3g,%.5g,%.4g,%.3g,%.3g,%zu,%zu,%d,%016llx,%d,%.5g,%.5g,%.5g,%.4g\n",
      r.group.c_str(), r.scene.c_str(), r.shape.c_str(), r.triangles, r.step, name(r.question), r.series.c_str(),
      r.choice.c_str(), r.levels, r.allowed, r.queries, r.rounds, r.ns, r.spread, r.floor_ns, r.ratio(), r.error, r.mean_error,
      r.wrong, r.failed, int(r.flagged), static_cast<unsigned long long>(r.hash), int(r.hash_true), r.steps, r.plane_tests,
      r.bytes, r.build_seconds);
}

std::string table(std::span<const Row> rows) {
  if (rows.empty()) return {};
  const Row& first = rows.front();
  std::string result = format("\n%s: %s, %s; %zu queries a round; floor %.1f ns\n", first.group.c_str(), first.scene.c_str(),
                              name(first.question), first.queries, first.floor_ns);
  result += format("  %-26s %9s %6s %7s %8s %6s %6s %8s %8s %7s %8s  %s\n", "", "ns", "spread", "/floor", "error/r", "wrong",
                   "failed", first.question == Question::Manifold ? "points" : "steps", "tests", "B/tri", "build s", "hash");
  for (const Row& r : rows) {
    result += format("  %-26s %9.1f %5.0f%% %7.2f %8.1e %6zu %6zu %8.2f %8.1f %7.1f %8.3g  %08llx%s\n", r.series.c_str(), r.ns,
                     100 * r.spread, r.ratio(), r.error, r.wrong, r.failed, r.steps, r.plane_tests, r.bytes, r.build_seconds,
                     static_cast<unsigned long long>(r.hash >> 32), r.flagged ? "  <-- WRONG" : "");
  }
  return result;
}

}  // namespace swiftlet::bench
