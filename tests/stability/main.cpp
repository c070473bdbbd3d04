// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The program behind `./run stability`: reads files of cases, asks every contender each of them, and prints who was wrong.
// Exit code 0: swiftlet failed none; 1: it did; 2: bad options or files.
#include <CLI/CLI.hpp>
#include <algorithm>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "contender.h"
#include "isolated.h"
#include "report.h"
#include "suite.h"

namespace swiftlet::stability {
namespace {

struct Options {
  std::vector<std::string> files, depths;
  bool all_methods = false, as_json = false;
  std::string csv;
  double tolerance = 1e-9;
  int limit = 60;
};

std::vector<Contender> contenders(const Options& options) {
  std::vector<Contender> all{{"swiftlet", "every start, refinement and plane rule, cold and warm, swapped; judged by the laws",
                              true, true, [](const Case& c, const Problems& problems) { return ask_swiftlet(c, problems); }}};
  if (!options.all_methods) return all;
#ifdef SWIFTLET_STABILITY_OTHERS
  for (Contender& other : other_contenders(options.tolerance)) all.push_back(std::move(other));
#else
  throw std::runtime_error("--all-methods: built without the benchmark's methods (SWIFTLET_BENCH)");
#endif
  return all;
}

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> all;
  const std::vector<std::filesystem::path> paths =
      options.files.empty() ? suite_files() : std::vector<std::filesystem::path>(options.files.begin(), options.files.end());
  for (const auto& path : paths) {
    for (Case& c : read_cases(path)) {
      const bool wanted = options.depths.empty() || std::count(options.depths.begin(), options.depths.end(), c.name) > 0;
      if (wanted) all.push_back(std::move(c));
    }
  }
  return all;
}

int run(const Options& options) {
  const std::vector<Contender> asked = contenders(options);
  const std::vector<Case> cases = cases_of(options);
  std::ofstream table;
  if (!options.csv.empty()) {
    table.open(options.csv);
    if (!table) throw std::runtime_error(options.csv + ": cannot be written");
  }
  std::vector<MethodReport> reports;
  for (const Contender& c : asked) reports.push_back({c.name, c.settings, c.gives_distance, c.gives_depth, {}, {}, {}, {}});
  for (const Case& c : cases) {
    const Problems problems = problems_of(c);
    for (std::size_t i = 0; i < asked.size(); ++i)
      reports[i].add(c, isolated(options.limit, [&] { return asked[i].ask(c, problems); }));
  }
  if (table.is_open()) {
    table << csv(reports);
    if (!table.flush()) throw std::runtime_error(options.csv + ": cannot be written");
  }
  if (!options.depths.empty()) {
    std::fputs(depths(cases, reports).c_str(), stdout);
  } else if (options.as_json) {
    std::fputs(json(reports).c_str(), stdout);
  } else {
    for (const MethodReport& report : reports) std::fputs(text(report).c_str(), stdout);
    std::printf("%zu cases. A case counts once per column, if any answer to it does; worst error is over size.\n",
                cases.size());
    std::printf("swiftlet: wrong is what breaks a law, 64 * 2^-53 of size. Others: what is off by more than %g of size.\n\n",
                options.tolerance);
    std::fputs(totals_text(reports).c_str(), stdout);
    if (reports.size() > 1) {
      std::printf("\nFailed / cases:\n\n%s", matrix(reports).c_str());
      std::printf("\nWrong depths, worst error over size:\n\n%s", depth_matrix(reports).c_str());
    }
  }
  return reports.front().total.failed == 0 ? 0 : 1;
}

int fail(const std::exception& error) {
  std::fprintf(stderr, "swiftlet_stability: %s\n", error.what());
  return 2;
}

}  // namespace
}  // namespace swiftlet::stability

int main(int argc, char** argv) try {
  swiftlet::stability::Options options;
  CLI::App app("Asks hard pairs of convex bodies, whose exact answers are computed beside, and counts what is wrong.");
  app.add_option("FILE", options.files, "cases as in tests/data/cases.json; by default that and tests/data/found/*.json");
  app.add_flag("--all-methods", options.all_methods, "also the baselines and the peers that the build found");
  app.add_option("--depths", options.depths, "of these cases only, and print the depths that each method returns")
      ->delimiter(',');
  app.add_flag("--json", options.as_json, "print JSON");
  app.add_option("--csv", options.csv, "also write methods by families to this file");
  app.add_option("--tolerance", options.tolerance, "what others may be off by, over size")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--limit", options.limit, "seconds for one case and method")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return swiftlet::stability::run(options);
} catch (const std::exception& error) {
  return swiftlet::stability::fail(error);
}
