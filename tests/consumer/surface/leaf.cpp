// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "leaf.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <vector>

#include <swiftlet/query.h>

#include "shapes.h"
#include "triangles.h"

namespace surface {
namespace {

using hull_tree::Mesh;
using swiftlet::Answer;
using swiftlet::Body;
using swiftlet::Pose;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Body triangle_of(const Mesh& mesh, std::size_t i) {
  const auto& [p, q, r] = mesh.triangles[i];
  return Body::triangle(mesh.points[p], mesh.points[q], mesh.points[r]);
}

/// Asks every pair, row by row, hands each answer to `take`, which says how far the next need look, and prints what it took.
template <class Take>
void ask(const char* how, const Mesh& a, const Mesh& b, const Pose& b_in_a, Take take) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  double beyond = kInfinity;
  const std::clock_t begin = std::clock();
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      const Answer answer = swiftlet::distance(triangle_of(a, i), triangle_of(b, j), b_in_a, {.beyond = beyond});
      beyond = take(answer);
      hash = (hash ^ std::bit_cast<std::uint64_t>(answer.lower)) * 0x100000001b3u;
    }
  }
  const double ns = 1e9 * double(std::clock() - begin) / CLOCKS_PER_SEC;
  const double queries = double(a.triangles.size()) * double(b.triangles.size());
  std::printf("leaves, %s: %.0f queries, %.0f ns each, hash %016" PRIx64 "\n", how, queries, ns / queries, hash);
}

}  // namespace

int mesh_leaves() {
  const Mesh a = hull_tree::torus(2, 0.75, 25, 20), b = hull_tree::torus(1.5, 0.5, 20, 25);
  const hull_tree::Soup soup_a = hull_tree::soup(a);
  int wrong = 0;

  const Pose crossing{hull_tree::rotation({0.6, 0, 0.8}, 1), {2, 1, 0.5}};
  std::vector<double> lower, upper;
  ask("exact", a, b, crossing, [&](const Answer& answer) {
    lower.push_back(answer.lower), upper.push_back(answer.upper);
    return kInfinity;
  });
  const hull_tree::Soup crossing_b = hull_tree::soup(b, crossing);
  std::size_t pair = 0;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t j = 0; j < b.triangles.size(); ++j, ++pair) {
      const double truth = hull_tree::distance(soup_a.triangles[i], crossing_b.triangles[j]);
      const double slack = tolerance(triangle_of(a, i), triangle_of(b, j), crossing);
      wrong += !(lower[pair] - slack <= truth && truth <= upper[pair] + slack && upper[pair] - lower[pair] <= slack);
    }
  }

  const Pose linked{hull_tree::rotation({1, 0, 0}, 1.5), {2.1, 0.1, 0}};
  double nearest = kInfinity;
  ask("beyond the nearest so far", a, b, linked,
      [&](const Answer& answer) { return nearest = std::min(nearest, answer.upper); });
  const double truth = hull_tree::distance(soup_a, hull_tree::soup(b, linked));
  wrong += !(std::fabs(nearest - truth) <= tolerance(triangle_of(a, 0), triangle_of(b, 0), linked));  // both at the rim
  std::printf("leaves: two links of a chain, %.6f apart\n", nearest);
  return wrong;
}

}  // namespace surface
