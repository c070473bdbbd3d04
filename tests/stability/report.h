// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Findings added up by method and group of families, as text, CSV and JSON. Knows Findings; asks and judges nothing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trial.h"

namespace swiftlet::stability {

/// Findings of several cases: how many cases each flag was raised on.
struct Sum {
  int cases = 0, not_applicable = 0;  ///< `cases` are those that the method takes
  int failed = 0, wrong_verdict = 0, wrong_distance = 0, wrong_depth = 0, no_number = 0, not_terminated = 0, not_converged = 0;
  int undecided = 0, touching = 0;
  std::uint64_t answers = 0;
  std::uint32_t most_steps = 0;
  double worst_error = 0, worst_depth_error = 0;  ///< over size
  void add(const Findings& findings);
};

struct Failure {
  std::string name, text;
};

struct MethodReport {
  std::string name, settings;
  bool gives_distance = true, gives_depth = true;
  std::vector<std::pair<std::string, Sum>> groups;  ///< in the order in which they first came
  Sum total;
  std::vector<Failure> failures;
  std::vector<double> depths;  ///< per case
  void add(const Case& c, const Findings& findings);
};

/// The row of the tables that a family counts to, without commas or quotes; families unknown here have their own.
std::string group_of(const std::string& family);

std::string text(const MethodReport& report);                       ///< a line per group
std::string totals_text(const std::vector<MethodReport>& reports);  ///< a line per method
std::string matrix(const std::vector<MethodReport>& reports);       ///< Markdown: groups by methods, failed / cases
/// As a table in Markdown: families by methods that give depths, wrong ones and the worst error over size.
std::string depth_matrix(const std::vector<MethodReport>& reports);
/// Markdown: cases by methods, what each returned as the depth; `cases` are those that were added.
std::string depths(const std::vector<Case>& cases, const std::vector<MethodReport>& reports);
std::string csv(const std::vector<MethodReport>& reports);
std::string json(const std::vector<MethodReport>& reports);

}  // namespace swiftlet::stability
