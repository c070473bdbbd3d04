// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "goals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include <swiftlet/body.h>
#include <swiftlet/query.h>

#include "nearest.h"

namespace swiftlet::bench {
namespace {

std::string motion(const Goal& goal) {
  std::string text = goal.step == kRandomStep ? "random" : goal.step == 0 ? "same pose" : format("%g deg", goal.step);
  if (goal.poses == Goal::Poses::Rounded) text += ", float32";
  if (goal.poses == Goal::Poses::Overlapping) text += ", overlap";
  return format("%u, ", unsigned(goal.triangles)) + text;
}

/// The largest error of a method on a warm pass over the scene, against the distances of some of its queries, in radii.
double largest_error(const Asked& asked, const Entrant& entrant, std::span<const std::optional<long double>> truth) {
  const std::vector<Query>& queries = asked.scene->queries;
  std::vector<Outcome> outcomes(queries.size());
  entrant.method->open(entrant.bodies, asked.scene->pairs)->distances(queries, outcomes);
  long double error = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Outcome& o = outcomes[i];
    if (truth[i] && !o.failed && !o.overlapping) error = std::max(error, std::abs(o.distance - *truth[i]));
  }
  return double(error) / asked.radius;
}

/// Of some queries, evenly spread.
std::vector<std::optional<long double>> truth_of(const Asked& asked) {
  constexpr std::size_t kJudged = 250;  // 0.4 ms each at 2 000 triangles, 30 ms at 200 000
  const std::vector<Query>& queries = asked.scene->queries;
  std::vector<std::optional<long double>> truth(queries.size());
  for (std::size_t i = 0; i < queries.size(); i += std::max<std::size_t>(1, queries.size() / kJudged)) {
    const BodyPair pair = asked.scene->pairs[queries[i].pair];
    truth[i] = nearest(asked.bodies[pair.a].view, asked.bodies[pair.b].view, queries[i].b_in_a);
  }
  return truth;
}

}  // namespace

const Row& GoalTable::Cell::fastest() const {
  return *std::min_element(rows.begin() + 1, rows.end(), [](const Row& x, const Row& y) { return x.ns < y.ns; });
}

double GoalTable::Line::worst() const {
  double worst = 0;
  for (const Cell& cell : cells) worst = std::max(worst, cell.ratio());
  return worst;
}

bool GoalTable::Line::right() const {
  return std::none_of(cells.begin(), cells.end(), [](const Cell& cell) {
    return cell.ours().flagged || cell.of_bound > 1 || (!cell.errors.empty() && cell.errors.front() > cell.width);
  });
}

void GoalTable::add(const Asked& asked, std::span<const Entrant> entrants, std::vector<Row> rows) {
  Cell& cell = lines_.back().cells.emplace_back(Cell{std::move(rows), 0, 0, {}});
  if (lines_.back().goal.question() != Question::Distance) return;
  const BodyPair pair = asked.scene->pairs.front();
  const Body a = *asked.bodies[pair.a].model, b = *asked.bodies[pair.b].model;
  PairSeed seed;
  for (const Query& query : asked.scene->queries) {
    const Answer answer = distance(a, b, query.b_in_a, seed);
    const double width = answer.upper - answer.lower;
    cell.width = std::max(cell.width, width / asked.radius);
    cell.of_bound = std::max(cell.of_bound, width / tolerance(a, b, query.b_in_a));
  }
  const auto truth = truth_of(asked);
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    cell.errors.push_back(std::max(cell.rows[i].error, largest_error(asked, entrants[i], truth)));
  }
}

std::string GoalTable::text(const Line& line) {
  std::string text = format("%-26s", motion(line.goal).c_str());
  if (line.cells.empty()) return text + " not measured\n";
  for (const Cell& cell : line.cells) {
    const std::string beside = cell.fastest().series + (cell.fastest().flagged ? "!" : "");
    text += format(" %6.0f /%5.0f %5.2f %-12s", cell.ours().ns, cell.fastest().ns, cell.ratio(), beside.c_str());
  }
  const char* met = line.met(line.goal.aim) ? "aim met" : line.met(line.goal.must) ? "met" : "MISSED";
  text += format(" %6.2f %5.2f %5.2f  %s\n", line.worst(), line.goal.must, line.goal.aim, line.right() ? met : "MISSED: WRONG");

  const bool distances = line.goal.question() == Question::Distance;
  text += distances ? "    largest error, r:" : "    verdicts:";
  for (std::size_t i = 0; i < kGoalMethods.size(); ++i) {
    double error = 0;
    std::size_t wrong = 0, failed = 0;
    for (const Cell& cell : line.cells) {
      wrong += cell.rows[i].wrong, failed += cell.rows[i].failed;
      if (distances) error = std::max(error, cell.errors[i]);
    }
    text += std::string(" ") + kGoalMethods[i];
    if (distances) text += format(" %.1e", error);
    if (wrong > 0 || !distances) text += format(" %zu wrong", wrong);
    if (failed > 0) text += format(" %zu failed", failed);
    text += ";";
  }
  if (distances) {
    double width = 0, of_bound = 0;
    for (const Cell& cell : line.cells) width = std::max(width, cell.width), of_bound = std::max(of_bound, cell.of_bound);
    text += format(" our width %.1e r, %.2f of law 2's bound;", width, of_bound);
  }
  text += " our hash";
  for (const Cell& cell : line.cells) text += format(" %08llx", static_cast<unsigned long long>(cell.ours().hash >> 32));
  return text + "\n";
}

std::string GoalTable::text() const {
  std::string text = format("\n%-26s %-32s %-32s %-32s %6s %5s %5s\n", "goals: ours / fastest, ns", "fat", "plate", "long",
                            "worst", "must", "aim");
  int measured = 0, musts = 0, aims = 0;
  for (const Line& line : lines_) {
    text += GoalTable::text(line);
    if (line.cells.empty()) continue;
    ++measured, musts += line.met(line.goal.must), aims += line.met(line.goal.aim);
  }
  return text +
         format("%d goals measured: %d met, %d of them to the aim, %d missed\n", measured, musts, aims, measured - musts);
}

}  // namespace swiftlet::bench
