// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Measures of a closed triangle surface, its half-edges, and the climb to a support. Plain doubles; no truth rests on them.
#include "polytope.h"

#include <octahedron.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace swiftlet::lod {

Vec3 area_normal(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

double area(const Polytope& body) {
  double twice = 0;
  for (const auto& [a, b, c] : body.triangles) twice += area_normal(body.points[a], body.points[b], body.points[c]).norm();
  return twice / 2;
}

double volume(const Polytope& body) {
  if (body.triangles.empty()) return 0;
  const Vec3 apex = body.points[body.triangles.front()[0]];
  double six_times = 0;
  for (const auto& [a, b, c] : body.triangles)
    six_times += (body.points[a] - apex).dot((body.points[b] - apex).cross(body.points[c] - apex));
  return six_times / 6;
}

Vec3 area_centroid(const Polytope& body) {
  const Vec3 base = body.points.front();
  Vec3 moment = Vec3::Zero();
  double total = 0;
  for (const auto& [a, b, c] : body.triangles) {
    const double weight = area_normal(body.points[a], body.points[b], body.points[c]).norm();
    moment += weight * ((body.points[a] - base) + (body.points[b] - base) + (body.points[c] - base));
    total += weight;
  }
  return base + moment / (3 * total);
}

Mat3 area_covariance(const Polytope& body) {
  const Vec3 centroid = area_centroid(body);
  Mat3 moment = Mat3::Zero();
  double total = 0;
  for (const auto& [ia, ib, ic] : body.triangles) {
    const Vec3 a = body.points[ia] - centroid, b = body.points[ib] - centroid, c = body.points[ic] - centroid, sum = a + b + c;
    const double weight = area_normal(a, b, c).norm();
    moment += weight / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    total += weight;
  }
  return moment / total;
}

// The half-edges are put in order by their origins; the opposite of one is among those that leave its end, and the side before
// one of those that leave its origin: it is looked for where there are fewer.
HalfEdges half_edges(const Polytope& body) {
  const std::uint32_t count = 3 * std::uint32_t(body.triangles.size());
  std::vector<std::uint32_t> begin(body.points.size() + 2), order(count);
  for (const Triangle& triangle : body.triangles)
    for (const std::uint32_t corner : triangle) ++begin[corner + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (std::uint32_t h = 0; h < count; ++h) order[begin[origin(body, h) + 1]++] = h;
  HalfEdges edges{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(body.points.size())};
  for (std::uint32_t v = 0; v < body.points.size(); ++v)
    if (begin[v] < begin[v + 1]) edges.outgoing[v] = order[begin[v + 1] - 1];
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t from = origin(body, h), to = origin(body, HalfEdges::next(h));
    const bool at_end = begin[to + 1] - begin[to] <= begin[from + 1] - begin[from];
    std::uint32_t k = begin[at_end ? to : from];
    if (at_end) {
      while (origin(body, HalfEdges::next(order[k])) != from) ++k;
    } else {
      while (origin(body, HalfEdges::previous(order[k])) != to) ++k;
    }
    edges.twin[h] = at_end ? order[k] : HalfEdges::previous(order[k]);
  }
  return edges;
}

std::vector<std::uint32_t> along_curve(std::span<const Vec3> points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double size = (high - low).maxCoeff();
  const auto code = [&](const Vec3& p) {
    constexpr int kBits = 20;
    std::uint64_t bits = 0;
    const Vec3 cell = size > 0 ? Vec3((p - low) / size * ((1 << kBits) - 1)) : Vec3::Zero();
    for (int bit = kBits; bit-- > 0;)
      for (const double x : cell) bits = bits << 1 | (std::uint64_t(x) >> bit & 1);
    return bits;
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (std::uint32_t v = 0; v < points.size(); ++v) keyed.emplace_back(code(points[v]), v);
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  for (const auto& [key, v] : keyed) order.push_back(v);
  return order;
}

namespace {

constexpr double kVerticesPerCell = 4;  ///< of a climber's cube: a step or two across

}  // namespace

// Every directed edge occurs once, so that the triangles' sides list each neighbour once.
Climber::Graph::Graph(const Polytope& solid)
    : body(solid), begin(body.points.size() + 1), neighbour(3 * body.triangles.size()), node(body.points.size()) {
  for (const Triangle& triangle : body.triangles)
    for (std::uint32_t corner : triangle) ++begin[corner + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> slot(begin.begin(), begin.end() - 1);
  for (const auto& [a, b, c] : body.triangles) {
    neighbour[slot[a]++] = b;
    neighbour[slot[b]++] = c;
    neighbour[slot[c]++] = a;
  }
  nodes.reserve(body.points.size() + 1);
  near.reserve(neighbour.size());
  for (const std::uint32_t v : along_curve(body.points)) {
    node[v] = std::uint32_t(nodes.size());
    nodes.push_back({body.points[v], std::uint32_t(near.size()), v});
    near.insert(near.end(), neighbour.begin() + begin[v], neighbour.begin() + begin[v + 1]);
  }
  nodes.push_back({Vec3::Zero(), std::uint32_t(near.size()), 0});
  for (std::uint32_t& v : near) v = node[v];
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i + 1].begin - nodes[i].begin > kManyNeighbours)
      std::sort(near.begin() + nodes[i].begin, near.begin() + nodes[i + 1].begin);
  }
  boxes.resize((near.size() + kBlock - 1) / kBlock);
  for (std::size_t k = 0; k < near.size(); ++k) boxes[k / kBlock].extend(nodes[near[k]].point);
}

Climber::Climber(const Polytope& body)
    : graph_(std::make_shared<const Graph>(body)),
      side_(std::uint32_t(std::sqrt(double(body.points.size()) / kVerticesPerCell / 2)) + 1),
      found_(lut::octahedron_cell_count(side_)) {}

std::span<const std::uint32_t> Climber::neighbours(std::uint32_t vertex) const {
  return {graph_->neighbour.data() + graph_->begin[vertex], graph_->begin[vertex + 1] - graph_->begin[vertex]};
}

/// Of a vertex with many neighbours, blocks of these are left out that no point of a box around them exceeds: products and sums
/// round so that a box's height along the direction is no less than that of any point in it.
std::uint32_t Climber::climb(const Vec3& direction, std::uint32_t start) const {
  const std::vector<Node>& nodes = graph_->nodes;
  const std::vector<std::uint32_t>& near = graph_->near;
  const auto top = [&](const Eigen::AlignedBox3d& box) {
    return direction.dot(Vec3((direction.array() > 0).select(box.max(), box.min())));
  };
  std::uint32_t best = graph_->node[start];
  std::uint32_t& found = found_[lut::octahedron_cell(side_, direction.x(), direction.y(), direction.z())];
  double height = direction.dot(nodes[best].point);
  if (const double known = direction.dot(nodes[found].point); known > height) height = known, best = found;
  const auto look = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const double to_height = direction.dot(nodes[near[k]].point);
      if (to_height > height) height = to_height, best = near[k];
    }
  };
  while (true) {
    const std::uint32_t from = best, begin = nodes[from].begin, end = nodes[from + 1].begin;
    if (end - begin <= kManyNeighbours) {
      look(begin, end);
    } else {
      for (std::uint32_t block = begin / kBlock; block * kBlock < end; ++block)
        if (top(graph_->boxes[block]) > height) look(std::max(begin, block * kBlock), std::min(end, (block + 1) * kBlock));
    }
    if (best == from) break;
  }
  found = best;
  return nodes[best].vertex;
}

}  // namespace swiftlet::lod
