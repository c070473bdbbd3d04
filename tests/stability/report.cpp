// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <nlohmann/json.hpp>

namespace swiftlet::stability {
namespace {

const std::map<std::string, std::string>& groups() {
  static const std::map<std::string, std::string> map{
      {"kissing", "kissing and touching"},
      {"touching", "kissing and touching"},
      {"near-touching", "kissing and touching"},
      {"edge-face", "kissing and touching"},
      {"face-vertex", "kissing and touching"},
      {"vertex-vertex", "kissing and touching"},
      {"near-parallel", "parallel faces"},
      {"parallel-faces", "parallel faces"},
      {"near-parallel-faces", "parallel faces"},
      {"coplanar-caps", "parallel faces"},
      {"near-parallel-edges", "near-parallel edges"},
      {"needle", "needles and slivers"},
      {"needle-triangle", "needles and slivers"},
      {"near-collinear", "needles and slivers"},
      {"near-zero-volume", "needles and slivers"},
      {"flat", "flat bodies and points"},
      {"point-query", "flat bodies and points"},
      {"degenerate-hull", "coplanar and duplicate points"},
      {"general", "coplanar and duplicate points"},
      {"coplanar", "coplanar and duplicate points"},
      {"many-coplanar", "coplanar and duplicate points"},
      {"duplicates", "coplanar and duplicate points"},
      {"scale", "scale"},
      {"scale-invariance", "scale"},
      {"tiny", "scale"},
      {"huge-vs-tiny", "huge against tiny"},
      {"far-from-origin", "far from the origin"},
      {"overlap", "deep and nested"},
      {"containment", "deep and nested"},
      {"coincident", "deep and nested"},
      {"exact", "integer lattices"},
      {"asymmetric", "order of the bodies"},
      {"fuzz-found", "found by fuzzing"},
      {"peer-suite", "suites of peers"},
  };
  return map;
}

template <class... Values>
std::string line(const char* format, Values... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

constexpr const char* kHeader = "%-28s %5s %8s %8s %8s %8s %8s %8s %8s %8s %8s %9s %9s\n";

std::string header(const char* first) {
  std::string words = line(kHeader, first, "cases", "wrong", "wrong", "wrong", "NaN or", "not ter-", "no", "un-", "touching",
                           "not", "worst", "worst");
  return words + line(kHeader, "", "", "verdict", "distance", "depth", "thrown", "minated", "answer", "decided", "", "taken",
                      "distance", "depth");
}

std::string row(const std::string& name, const Sum& s, const MethodReport& method) {
  const auto count = [](bool given, int n) { return given ? std::to_string(n) : std::string("n/a"); };
  const auto error = [&](bool given, double e) { return given && s.cases ? line("%.1e", e) : std::string("n/a"); };
  return line("%-28s %5d %8d %8s %8s %8d %8d %8d %8d %8d %8d %9s %9s\n", name.c_str(), s.cases, s.wrong_verdict,
              count(method.gives_distance, s.wrong_distance).c_str(), count(method.gives_depth, s.wrong_depth).c_str(),
              s.no_number, s.not_terminated, s.not_converged, s.undecided, s.touching, s.not_applicable,
              error(method.gives_distance, s.worst_error).c_str(), error(method.gives_depth, s.worst_depth_error).c_str());
}

nlohmann::ordered_json json_of(const Sum& s) {
  return {{"cases", s.cases},
          {"not_taken", s.not_applicable},
          {"failed", s.failed},
          {"wrong_verdict", s.wrong_verdict},
          {"wrong_distance", s.wrong_distance},
          {"wrong_depth", s.wrong_depth},
          {"nan_or_thrown", s.no_number},
          {"not_terminated", s.not_terminated},
          {"no_answer", s.not_converged},
          {"undecided", s.undecided},
          {"touching", s.touching},
          {"answers", s.answers},
          {"most_steps", s.most_steps},
          {"worst_error", s.worst_error},
          {"worst_depth_error", s.worst_depth_error}};
}

}  // namespace

std::string group_of(const std::string& family) {
  const auto it = groups().find(family);
  return it == groups().end() ? family : it->second;
}

void Sum::add(const Findings& f) {
  if (!f.applicable) {
    ++not_applicable;
    return;
  }
  ++cases;
  failed += f.failed();
  wrong_verdict += f.wrong_verdict;
  wrong_distance += f.wrong_distance;
  wrong_depth += f.wrong_depth;
  no_number += f.no_number;
  not_terminated += f.not_terminated;
  not_converged += f.not_converged;
  undecided += f.undecided;
  touching += f.touching;
  answers += f.answers;
  most_steps = std::max(most_steps, f.most_steps);
  worst_error = std::max(worst_error, f.worst_error);
  worst_depth_error = std::max(worst_depth_error, f.worst_depth_error);
}

void MethodReport::add(const Case& c, const Findings& findings) {
  const std::string group = group_of(c.family());
  const auto same = [&](const auto& entry) { return entry.first == group; };
  auto it = std::find_if(groups.begin(), groups.end(), same);
  if (it == groups.end()) it = groups.insert(groups.end(), {group, Sum{}});
  it->second.add(findings);
  total.add(findings);
  depths.push_back(findings.depth);
  if (findings.failed()) failures.push_back({c.name, findings.first_fault});
}

std::string text(const MethodReport& report) {
  std::string all = report.name + ": " + report.settings + "\n" + header("family");
  for (const auto& [name, sum] : report.groups) all += row(name, sum, report);
  all += row("all", report.total, report);
  all += line("%llu answers, most steps %u\n", static_cast<unsigned long long>(report.total.answers), report.total.most_steps);
  for (const Failure& f : report.failures) all += "  " + f.name + ": " + f.text + "\n";
  return all + "\n";
}

std::string totals_text(const std::vector<MethodReport>& reports) {
  std::string all = header("method");
  for (const MethodReport& r : reports) all += row(r.name, r.total, r);
  return all;
}

namespace {

/// A row per family, a column per method that `shown` says is.
template <class Shown, class Cell>
std::string table(const std::vector<MethodReport>& reports, Shown shown, Cell cell) {
  std::string head = "| family |", rule = "|---|", total = "| **all** |";
  for (const MethodReport& r : reports) {
    if (!shown(r)) continue;
    head += " " + r.name + " |";
    rule += "---|";
    total += " **" + cell(r.total) + "** |";
  }
  std::string all = head + "\n" + rule + "\n";
  for (std::size_t i = 0; i < reports.front().groups.size(); ++i) {  // all methods were asked the same cases
    all += "| " + reports.front().groups[i].first + " |";
    for (const MethodReport& r : reports) all += shown(r) ? " " + cell(r.groups[i].second) + " |" : "";
    all += "\n";
  }
  return all + total + "\n";
}

}  // namespace

std::string matrix(const std::vector<MethodReport>& reports) {
  return table(
      reports, [](const MethodReport&) { return true; },
      [](const Sum& s) { return s.cases ? line("%d / %d", s.failed, s.cases) : std::string("-"); });
}

std::string depth_matrix(const std::vector<MethodReport>& reports) {
  return table(
      reports, [](const MethodReport& r) { return r.gives_depth; },
      [](const Sum& s) { return s.cases ? line("%d, %.0e", s.wrong_depth, s.worst_depth_error) : std::string("-"); });
}

std::string depths(const std::vector<Case>& cases, const std::vector<MethodReport>& reports) {
  std::string head = "| case | depth |", rule = "|---|---|", all;
  for (const MethodReport& r : reports) {
    if (r.gives_depth) head += " " + r.name + " |", rule += "---|";
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    all += "| " + cases[i].name + " | " + (cases[i].expected ? line("%.6g", -cases[i].expected->distance) : "-") + " |";
    for (const MethodReport& r : reports) {
      if (r.gives_depth) all += std::isnan(r.depths[i]) ? " none |" : line(" %.6g |", r.depths[i]);
    }
    all += "\n";
  }
  return head + "\n" + rule + "\n" + all;
}

std::string csv(const std::vector<MethodReport>& reports) {
  std::string all =
      "method,group,cases,not_taken,failed,wrong_verdict,wrong_distance,nan_or_thrown,not_terminated,no_answer,undecided,"
      "touching,worst_error,wrong_depth,worst_depth_error\n";
  for (const MethodReport& r : reports) {
    for (const auto& [name, s] : r.groups) {
      all += line("%s,%s,%d,%d,%d,%d,%d,%d,%d,%d,%d,%d,%.2g,%d,%.2g\n", r.name.c_str(), name.c_str(), s.cases, s.not_applicable,
                  s.failed, s.wrong_verdict, s.wrong_distance, s.no_number, s.not_terminated, s.not_converged, s.undecided,
                  s.touching, s.worst_error, s.wrong_depth, s.worst_depth_error);
    }
  }
  return all;
}

std::string json(const std::vector<MethodReport>& reports) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const MethodReport& r : reports) {
    nlohmann::ordered_json one{{"method", r.name}, {"settings", r.settings}, {"total", json_of(r.total)}};
    for (const auto& [name, sum] : r.groups) one["groups"][name] = json_of(sum);
    one["failures"] = nlohmann::ordered_json::array();
    for (const Failure& f : r.failures) one["failures"].push_back({{"case", f.name}, {"first", f.text}});
    all.push_back(std::move(one));
  }
  return all.dump(1) + "\n";
}

}  // namespace swiftlet::stability
