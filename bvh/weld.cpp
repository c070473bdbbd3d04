// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Welds equal points by a hash table, and counts what edges say of a surface by sorting them.
#include "weld.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "numeric/decimal.h"
#include "numeric/exact.h"

namespace swiftlet {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Numbers of vertices by their coordinates: open addressing in a table at least twice as large as what it holds.
class VertexTable {
 public:
  explicit VertexTable(std::size_t most) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    slots_.assign(size, kNone);
  }
  /// The vertex at `p`, or `next`, which is then the vertex there.
  std::uint32_t find(const Vec& p, std::uint32_t next, const std::vector<Vec>& vertices) {
    std::uint64_t hash = 0;
    for (const double x : {p.x, p.y, p.z}) {
      hash = (hash ^ bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    std::size_t slot = hash & (slots_.size() - 1);
    for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
      const Vec& q = vertices[slots_[slot]];
      if (p.x == q.x && p.y == q.y && p.z == q.z) return slots_[slot];
    }
    return slots_[slot] = next;
  }

 private:
  std::vector<std::uint32_t> slots_;
};

/// Sets that are joined two by two.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// The least element of the set that holds `i`.
  std::uint32_t root(std::uint32_t i) {
    for (; parent_[i] != i; i = parent_[i]) parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// An edge of a triangle, from its lower vertex to its higher one or the other way.
struct Side {
  std::uint32_t low, high, triangle;
  bool forward;
};

}  // namespace

std::vector<std::uint32_t> survey(Soup& soup) {
  MeshTopology& t = soup.topology;
  std::vector<Side> sides;
  sides.reserve(3 * soup.triangles.size());
  std::vector<Corners> sorted = soup.triangles;
  DisjointSets sets(soup.triangles.size());
  CornerSums sums;
  const auto corner = [&](std::uint32_t v) { return soup.vertices[v]; };
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    const Corners& c = soup.triangles[i];
    sums.add(corner(c[0]), corner(c[1]), corner(c[2]));
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = c[std::size_t(k)], w = c[std::size_t((k + 1) % 3)];
      if (v != w) sides.push_back({std::min(v, w), std::max(v, w), i, v < w});
    }
    std::sort(sorted[i].begin(), sorted[i].end());
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) t.duplicates += sorted[i] == sorted[i - 1];
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::tie(x.low, x.high, x.triangle, x.forward) < std::tie(y.low, y.high, y.triangle, y.forward);
  });
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
      sets.join(sides[i].triangle, sides[end++].triangle);
    t.open_edges += end - i == 1;
    t.non_manifold_edges += end - i > 2;
    t.flipped_edges += end - i == 2 && sides[i].forward == sides[i + 1].forward;
  }
  std::vector<std::uint32_t> first(soup.triangles.size());
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    if ((first[i] = sets.root(i)) == i) soup.shells.push_back(i);
  }
  t.components = std::uint32_t(soup.shells.size());
  sums.put(t);
  return first;
}

Result<Vec> vertex_at(std::span<const Vec3> points, std::uint32_t point) {
  Vec p = vec(points[point]);
  for (double* x : {&p.x, &p.y, &p.z}) {
    if (!(*x == 0 || (std::fabs(*x) >= kLeastExtent && std::fabs(*x) <= kMostCoordinate)))
      return Error{ErrorCode::BadValue, "point " + std::to_string(point) + " has the coordinate " + decimal(*x, 17) +
                                            ", which is neither 0 nor from 1e-45 to 1e45 in magnitude"};
    *x += 0.0;  // -0 becomes 0, which it is equal to
  }
  return p;
}

void CornerSums::add(const Vec& a, const Vec& b, const Vec& c) {
  flat_ += exact::collinear(&a.x, &b.x, &c.x);
  if (!from_) from_ = a;
  volume_ += dot(a - *from_, cross(b - *from_, c - *from_));
}
void CornerSums::put(MeshTopology& topology) const {
  topology.flat_triangles = flat_;
  topology.volume = topology.closed() && std::isfinite(volume_) ? volume_ / 6 : 0;
}

Result<Soup> weld(std::span<const Vec3> points, std::span<const Corners> triangles) {
  if (triangles.empty()) return Error{ErrorCode::Empty, "there are no triangles"};
  if (triangles.size() > kMostTriangles)
    return Error{ErrorCode::TooLarge, std::to_string(triangles.size()) + " triangles are more than " +
                                          std::to_string(kMostTriangles) + ", the most that a mesh can have"};
  Soup soup;
  soup.triangles.reserve(triangles.size());
  VertexTable table(std::min(points.size(), 3 * triangles.size()));
  std::vector<std::uint32_t> vertex_of(points.size(), kNone);
  for (const Corners& corners : triangles) {
    Corners of;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = corners[k];
      if (point >= points.size())
        return Error{ErrorCode::BadValue, "triangle " + std::to_string(&corners - triangles.data()) + " names point " +
                                              std::to_string(point) + " of " + std::to_string(points.size()) + " points"};
      if (vertex_of[point] == kNone) {
        const Result<Vec> p = vertex_at(points, point);
        if (!p) return p.error();
        const std::uint32_t next = std::uint32_t(soup.vertices.size());
        vertex_of[point] = table.find(p.value(), next, soup.vertices);
        if (vertex_of[point] == next) soup.vertices.push_back(p.value()), soup.source.push_back(point);
      }
      of[k] = vertex_of[point];
    }
    soup.triangles.push_back(of);
  }
  survey(soup);
  return soup;
}

}  // namespace swiftlet
