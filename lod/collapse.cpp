// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Garland & Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997, pass by pass instead of edge by
// edge: a pass prices all edges, which many threads can do, and collapses of the cheapest those no end of which has moved
// since. A plane counts by the square of its triangle's area. Knows nothing of hulls.
#include "collapse.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "numeric/chunks.h"

namespace swiftlet::lod {
namespace {

constexpr std::size_t kTrianglesPerTask = 4096;
/// A pass looks at one edge in so many: few enough to take them nearly in the order of their errors. From 4 to 32, levels
/// deviate alike.
constexpr std::size_t kCheapest = 8;
/// Of the pull to an edge's middle, over the quadric's trace: it decides where planes do not.
constexpr double kStiffness = 0x1p-30;
constexpr double kPassedWork = 0.2, kCollapsedWork = 0.5;  ///< per edge priced, per vertex that goes, about microseconds

/// The sum of the squared distances from planes.
struct Quadric {
  Mat3 second = Mat3::Zero();
  Vec3 first = Vec3::Zero();
  double constant = 0;

  void add(const Vec3& normal, const Vec3& point) {
    const double offset = -normal.dot(point);
    second += normal * normal.transpose();
    first += offset * normal;
    constant += offset * offset;
  }
  Quadric& operator+=(const Quadric& other) {
    second += other.second, first += other.first, constant += other.constant;
    return *this;
  }
  double operator()(const Vec3& p) const { return p.dot(second * p) + 2 * first.dot(p) + constant; }
};

/// Where an edge's vertex would be, and its error there.
struct Placement {
  Vec3 point;
  double error;
};

/// A closed surface under collapses.
class Surface {
 public:
  /// In the order of a curve: neighbours in space are neighbours in memory, which a hull's are not.
  Surface(const Polytope& body, const Executor& executor) : executor_(executor) {
    const std::vector<std::uint32_t> order = along_curve(body.points);
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i, body_.points.push_back(body.points[order[i]]);
    std::vector<std::uint32_t> begin(order.size() + 1);
    const auto lowest = [&](const Triangle& t) { return std::min({place[t[0]], place[t[1]], place[t[2]]}); };
    for (const Triangle& t : body.triangles) ++begin[lowest(t) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    body_.triangles.resize(body.triangles.size());
    for (const Triangle& t : body.triangles) body_.triangles[begin[lowest(t)]++] = {place[t[0]], place[t[1]], place[t[2]]};
    edges_ = half_edges(body_);
    quadrics_.resize(order.size());
    for (const Triangle& t : body_.triangles) {
      const Vec3 normal = area_normal(body_.points[t[0]], body_.points[t[1]], body_.points[t[2]]);
      for (const std::uint32_t corner : t) quadrics_[corner].add(normal, body_.points[corner]);
    }
    left_ = body_.triangles.size();
    seen_.resize(order.size());
    moved_.resize(order.size());
  }

  std::size_t triangles() const { return left_; }
  const std::vector<Vec3>& points() const { return body_.points; }

  /// Collapses edges out of the cheapest, one in `cheapest`, until so many triangles are left; returns how many it collapsed.
  std::size_t pass(std::size_t triangle_count, std::size_t cheapest) {
    const std::vector<std::pair<double, std::uint32_t>> order = cheapest_edges(cheapest);
    std::fill(moved_.begin(), moved_.end(), false);
    std::size_t collapsed = 0;
    for (const auto& [error, h] : order) {
      if (left_ <= triangle_count) break;
      collapsed += collapse(h);
    }
    pack();
    return collapsed;
  }

 private:
  std::uint32_t tail(std::uint32_t h) const { return origin(body_, h); }
  std::uint32_t head(std::uint32_t h) const { return origin(body_, HalfEdges::next(h)); }

  template <class Visit>
  void each_outgoing(std::uint32_t vertex, Visit visit) const {
    const std::uint32_t first = edges_.outgoing[vertex];
    std::uint32_t h = first;
    do {
      visit(h);
      h = edges_.rotate(h);
    } while (h != first);
  }

  Placement placement(std::uint32_t h) const {
    Quadric sum = quadrics_[tail(h)];
    sum += quadrics_[head(h)];
    const Vec3 middle = (body_.points[tail(h)] + body_.points[head(h)]) / 2;
    const Mat3 stiff = sum.second + kStiffness * sum.second.trace() * Mat3::Identity();
    const Vec3 point = middle - stiff.llt().solve(sum.second * middle + sum.first);
    return {point, sum(point)};
  }

  /// Cheapest first. An edge without a finite error is none.
  std::vector<std::pair<double, std::uint32_t>> cheapest_edges(std::size_t one_in) const {
    const std::size_t chunks = (left_ + kTrianglesPerTask - 1) / kTrianglesPerTask;
    std::vector<std::vector<std::pair<double, std::uint32_t>>> priced(chunks);
    over_chunks(executor_, left_, kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
      auto& of_chunk = priced[begin / kTrianglesPerTask];
      of_chunk.reserve(3 * (end - begin) / 2 + 64);
      for (auto h = std::uint32_t(3 * begin); h < 3 * end; ++h) {
        if (h > edges_.twin[h]) continue;
        if (const Placement at = placement(h); at.point.allFinite() && std::isfinite(at.error))
          of_chunk.emplace_back(std::max(at.error, 0.0), h);
      }
    });
    std::vector<std::pair<double, std::uint32_t>> order;
    order.reserve(3 * left_ / 2);
    for (const auto& of_chunk : priced) order.insert(order.end(), of_chunk.begin(), of_chunk.end());
    const std::size_t count = (order.size() + one_in - 1) / one_in;
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(count), order.end());
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
  }

  /// Whether the edge could go.
  bool collapse(std::uint32_t h) {
    if (body_.triangles[h / 3][0] == kNone) return false;
    const std::uint32_t stays = tail(h), goes = head(h), g = edges_.twin[h];
    if (moved_[stays] || moved_[goes] || !is_linked(stays, goes)) return false;
    const Vec3 point = placement(h).point;
    if (folds(stays, goes, point) || folds(goes, stays, point)) return false;
    each_outgoing(goes, [&](std::uint32_t out) { body_.triangles[out / 3][out % 3] = stays; });
    for (const std::uint32_t side : {h, g}) {  // the two other sides of a triangle that vanishes become one edge
      const std::uint32_t after = edges_.twin[HalfEdges::next(side)], before = edges_.twin[HalfEdges::previous(side)];
      edges_.twin[after] = before, edges_.twin[before] = after;
      edges_.outgoing[tail(after)] = after, edges_.outgoing[tail(before)] = before;
    }
    for (const std::uint32_t side : {h, g}) body_.triangles[side / 3] = {kNone, kNone, kNone};
    body_.points[stays] = point;
    quadrics_[stays] += quadrics_[goes];
    edges_.outgoing[goes] = kNone;
    moved_[stays] = true;
    left_ -= 2;
    return true;
  }

  /// The ends have two neighbours in common: else the surface would touch itself.
  bool is_linked(std::uint32_t a, std::uint32_t b) {
    ++round_;
    each_outgoing(a, [&](std::uint32_t out) { seen_[head(out)] = round_; });
    int common = 0;
    each_outgoing(b, [&](std::uint32_t out) { common += seen_[head(out)] == round_; });
    return common == 2 && left_ > 4;
  }

  /// Whether a triangle of `vertex` without `other` would turn over if the vertex moved to `point`.
  bool folds(std::uint32_t vertex, std::uint32_t other, const Vec3& point) const {
    bool folded = false;
    each_outgoing(vertex, [&](std::uint32_t out) {
      const std::uint32_t a = head(out), b = tail(HalfEdges::previous(out));
      if (a == other || b == other) return;
      const Vec3 &p = body_.points[a], &q = body_.points[b];
      folded = folded || !(area_normal(body_.points[vertex], p, q).dot(area_normal(point, p, q)) > 0);
    });
    return folded;
  }

  /// Closes the gaps.
  void pack() {
    std::vector<std::uint32_t> vertex(body_.points.size(), kNone), triangle(body_.triangles.size(), kNone);
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < vertex.size(); ++v) {
      if (edges_.outgoing[v] == kNone) continue;
      body_.points[count] = body_.points[v], quadrics_[count] = quadrics_[v], edges_.outgoing[count] = edges_.outgoing[v];
      vertex[v] = count++;
    }
    body_.points.resize(count), quadrics_.resize(count), edges_.outgoing.resize(count), moved_.resize(count);
    count = 0;
    for (std::uint32_t t = 0; t < triangle.size(); ++t)
      if (body_.triangles[t][0] != kNone) triangle[t] = count++;
    const auto place = [&](std::uint32_t h) { return 3 * triangle[h / 3] + h % 3; };
    for (std::uint32_t t = 0; t < triangle.size(); ++t) {
      if (triangle[t] == kNone) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        body_.triangles[triangle[t]][k] = vertex[body_.triangles[t][k]];
        edges_.twin[3 * triangle[t] + k] = place(edges_.twin[3 * t + k]);
      }
    }
    body_.triangles.resize(count), edges_.twin.resize(3 * std::size_t(count));
    for (std::uint32_t& h : edges_.outgoing) h = place(h);
  }

  const Executor& executor_;
  Polytope body_;    ///< of a triangle that is gone the corners are kNone
  HalfEdges edges_;  ///< of a vertex that is gone `outgoing` is kNone
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> seen_;  ///< per vertex, the round in which it was a neighbour
  std::vector<bool> moved_;          ///< in this pass
  std::uint32_t round_ = 0;
  std::size_t left_ = 0;
};

}  // namespace

std::vector<Vec3> collapse(const Polytope& body, std::size_t triangle_count, const Executor& executor, Watch& watch) {
  Surface surface(body, executor);
  for (std::size_t cheapest = kCheapest; surface.triangles() > triangle_count && cheapest > 0;) {
    watch.work(kPassedWork * 1.5 * double(surface.triangles()));
    const std::size_t collapsed = surface.pass(triangle_count, cheapest);
    watch.work(kCollapsedWork * double(collapsed));
    cheapest = collapsed > 0 ? kCheapest : cheapest / 2;  // where the cheapest are all stuck, dearer ones may go
  }
  return surface.points();
}

double collapse_work(double before, double after) {
  constexpr double kPerPass = 0.83;  ///< of the triangles are left
  return kPassedWork * 1.5 * (before - after) / (1 - kPerPass) + kCollapsedWork * 0.5 * (before - after);
}

}  // namespace swiftlet::lod
