// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cost.h"

#include <algorithm>
#include <cmath>

namespace swiftlet::lod {
namespace {

/// The coarsest level two of which answer to the error.
std::size_t answering(std::span<const LevelSize> levels, double error) {
  std::size_t k = levels.size() - 1;
  while (k > 0 && !(2 * levels[k].deviation < error)) --k;
  return k;
}

std::size_t finest_mapped(const QueryCost& cost, std::span<const LevelSize> levels) {
  std::size_t k = 0;
  while (k + 1 < levels.size() && levels[k].vertices > cost.mapped_vertices) ++k;
  return k;
}

double samples(const QueryCost& cost, double slack) {
  return 1 + cost.samples_per_decade * std::max(0.0, std::log10(cost.first_slack / slack));
}

/// An exact distance on one level, from its map.
double walked(const QueryCost& cost, double vertices) { return cost.walk + cost.walk_per_edge * std::sqrt(vertices); }

double refined(const QueryCost& cost, double ratio) { return cost.refine_per_edge * std::sqrt(ratio); }

}  // namespace

double cold_instructions(const QueryCost& cost, std::span<const LevelSize> levels, double error) {
  const std::size_t needed = answering(levels, error), mapped = finest_mapped(cost, levels);
  if (needed >= mapped && error >= cost.least_seen)
    return cost.legal_pose + cost.sample * samples(cost, error - 2 * levels[needed].deviation);
  const std::size_t last = std::min(needed, mapped > 0 ? mapped - 1 : 0);
  double sum = walked(cost, levels[mapped].vertices);
  for (std::size_t k = mapped; k > last; --k)
    sum += refined(cost, levels[k - 1].vertices / levels[k].vertices) + (k < mapped ? cost.between : 0);
  return sum;
}

double warm_instructions(const QueryCost& cost, std::span<const LevelSize> levels, double error) {
  const double edges = cost.turn * std::sqrt(levels[answering(levels, error)].vertices);
  return cost.proof + cost.transition * cost.steps_per_edge * edges;
}

double prefix_bytes(const QueryCost& cost, std::span<const LevelSize> levels, double error) {
  double vertices = 0;
  for (std::size_t k = answering(levels, error); k < levels.size(); ++k) vertices += levels[k].vertices;
  return cost.bytes_per_vertex * vertices;
}

double expected_cost(const QueryCost& cost, std::span<const LevelSize> levels) {
  double sum = 0;
  for (const auto& [error, weight] : kAsked) {
    const double queries = (cold_instructions(cost, levels, error) + warm_instructions(cost, levels, error)) / 2;
    sum += weight * (queries + cost.instructions_per_kb * prefix_bytes(cost, levels, error) / 1024);
  }
  return sum;
}

std::vector<double> steps_to_map(const QueryCost& cost, double vertices) {
  if (vertices <= cost.mapped_vertices) return {};
  const double ratio = vertices / cost.mapped_vertices;
  const auto price = [&](int n) { return n * (cost.between + refined(cost, std::pow(ratio, 1.0 / n))); };
  int best = 1;
  while (price(best + 1) < price(best)) ++best;
  std::vector<double> steps;
  for (int k = 1; k <= best; ++k) steps.push_back(vertices * std::pow(ratio, -double(k) / best));
  return steps;
}

}  // namespace swiftlet::lod
