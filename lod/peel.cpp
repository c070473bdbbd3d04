// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Importances and the greedy independent set. The holes are filled by whoever takes the hull of what is left.
#include "peel.h"

#include <algorithm>
#include <numeric>

namespace swiftlet::lod {
namespace {

constexpr double kImportant = 1;
constexpr std::size_t kEnough = 20;  ///< one in so many vertices makes a level worth having

/// Greedy over `order`, up to an importance above `bound`.
std::vector<std::uint32_t> greedy(const Climber& body, const std::vector<std::uint32_t>& order,
                                  const std::vector<double>& importance, double bound, std::size_t most) {
  std::vector<bool> taken(order.size());
  std::vector<std::uint32_t> set;
  for (std::uint32_t v : order) {
    if (importance[v] > bound || set.size() == most) break;
    if (taken[v]) continue;
    set.push_back(v);
    for (std::uint32_t neighbour : body.neighbours(v)) taken[neighbour] = true;
  }
  return set;
}

}  // namespace

std::vector<double> importances(const Polytope& body) {
  const HalfEdges edges = half_edges(body);
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : body.triangles)
    normals.push_back(area_normal(body.points[a], body.points[b], body.points[c]).normalized());
  std::vector<double> importance(body.points.size());
  for (std::uint32_t h = 0; h < edges.twin.size(); ++h)
    importance[origin(body, h)] += 1 - normals[h / 3].dot(normals[edges.twin[h] / 3]);
  return importance;
}

std::vector<std::uint32_t> independent_set(const Polytope& body, std::size_t most) {
  const Climber around(body);
  const std::vector<double> importance = importances(body);
  std::vector<std::uint32_t> order(body.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t v, std::uint32_t w) { return importance[v] < importance[w]; });
  const std::size_t enough = std::min(most, body.points.size() / kEnough + 1);
  std::vector<std::uint32_t> set;
  for (double bound = kImportant; set.size() < enough; bound *= 2) {
    set = greedy(around, order, importance, bound, most);
    if (bound > importance[order.back()]) break;
  }
  return set;
}

std::vector<std::uint32_t> removed_above(const Polytope& fine, const std::vector<std::uint32_t>& removed,
                                         const std::vector<Triangle>& coarse) {
  const Climber around(fine);
  std::vector<bool> is_removed(fine.points.size());
  for (std::uint32_t v : removed) is_removed[v] = true;
  std::vector<std::uint32_t> above;
  for (const Triangle& triangle : coarse) {
    const Vec3& corner = fine.points[triangle[0]];
    const Vec3 normal = area_normal(corner, fine.points[triangle[1]], fine.points[triangle[2]]);
    std::uint32_t highest = triangle[0];
    for (std::uint32_t v : around.neighbours(triangle[0]))
      if (is_removed[v] && normal.dot(fine.points[v] - corner) > normal.dot(fine.points[highest] - corner)) highest = v;
    above.push_back(highest);
  }
  return above;
}

}  // namespace swiftlet::lod
