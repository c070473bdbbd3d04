// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "depth_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <CGAL/Gmpq.h>
#include <Eigen/Geometry>

namespace swiftlet::stability {
namespace {

using Rational = CGAL::Gmpq;
using Exact = std::array<Rational, 3>;

Exact moved(const Pose& pose, const Vec3& p, bool is_point) {
  Exact q;
  for (int i = 0; i < 3; ++i) {
    q[std::size_t(i)] = is_point ? Rational(pose.translation[i]) : Rational(0);
    for (int j = 0; j < 3; ++j) q[std::size_t(i)] += Rational(pose.rotation(i, j)) * Rational(p[j]);
  }
  return q;
}
Exact minus(const Exact& p, const Exact& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Exact cross(const Exact& p, const Exact& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
Rational dot(const Exact& p, const Exact& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// One body in A's frame, rounded and exact, and the edges of its hull.
struct Moved {
  std::vector<Vec3> points;
  std::vector<Exact> exact_points;
  struct Edge {
    std::uint32_t from, to;
    std::array<std::uint32_t, 2> beside{kNone, kNone};  ///< a vertex of the facet to each side
  };
  std::vector<Edge> edges;
  std::vector<std::array<Edge, 2>> faces;  ///< two edges of each
  double extent = 0;
};
Moved moved(const Subject& subject, const Pose& pose) {
  Moved m;
  const ConvexView& view = subject.model.level(0).view;
  for (const Vertex& v : view.vertices) {
    const Vec3 p(v.x, v.y, v.z);
    m.points.push_back(pose.rotation * p + pose.translation);
    m.exact_points.push_back(moved(pose, p, true));
    m.extent = std::max(m.extent, m.points.back().lpNorm<Eigen::Infinity>());
  }
  for (std::uint32_t h = 0; h < view.head.size(); ++h) {
    // The ring is sorted: the half-edges before and after span a facet with this one.
    const std::uint32_t from = view.head[view.twin[h]];
    const Vertex& ring = view.vertices[from];
    const std::uint32_t next = h + 1 < ring.ring_begin + ring.ring_count ? h + 1 : ring.ring_begin,
                        last = h > ring.ring_begin ? h - 1 : ring.ring_begin + ring.ring_count - 1;
    const bool has_facets = view.face[h] != kNone;
    if (h < view.twin[h])
      m.edges.push_back({from, view.head[h], {has_facets ? view.head[next] : kNone, has_facets ? view.head[last] : kNone}});
    if (has_facets) m.faces.push_back({{{from, view.head[h]}, {from, view.head[next]}}});
  }
  return m;
}

class Difference {
 public:
  Difference(const Moved& a, const Moved& b, double depth) : a_(a), b_(b), depth_(depth), exact_depth_(depth) {}

  std::optional<Vec3> shallower() {
    for (const Moved* body : {&a_, &b_}) {
      for (const auto& [e, f] : body->faces) {
        if (const auto n = try_plane(*body, e, *body, f)) return n;
      }
    }
    for (const Moved::Edge& e : a_.edges) {
      for (const Moved::Edge& f : b_.edges) {
        if (const auto n = try_plane(a_, e, b_, f)) return n;
      }
    }
    return found_ ? std::nullopt : std::optional(Vec3(0, 0, 0));
  }

 private:
  std::optional<Vec3> try_plane(const Moved& x, const Moved::Edge& e, const Moved& y, const Moved::Edge& f) {
    const Vec3 u = x.points[e.to] - x.points[e.from], v = y.points[f.to] - y.points[f.from], n = u.cross(v);
    const double size = a_.extent + b_.extent,
                 doubt = 0x1p-44 * size * (u.norm() + size * 0x1p-50) * (v.norm() + size * 0x1p-50);
    // Either may be: no farther than the depth, along n and against it.
    const double enough = depth_ * n.norm() + doubt;
    if (n.norm() * size > 4 * doubt) found_ = true;
    const bool below = !rises(x, e, n, doubt) && !rises(y, f, -n, doubt) && !reaches(n, enough);
    const bool above = !rises(x, e, -n, doubt) && !rises(y, f, n, doubt) && !reaches(-n, enough);
    if (!below && !above) return std::nullopt;
    const Exact normal =
        cross(minus(x.exact_points[e.to], x.exact_points[e.from]), minus(y.exact_points[f.to], y.exact_points[f.from]));
    const Rational square = dot(normal, normal);
    if (square == 0) return std::nullopt;
    found_ = true;
    const Exact opposite = minus({0, 0, 0}, normal);
    if (below && is_lower(normal, square)) return n;
    if (above && is_lower(opposite, square)) return Vec3(-n);
    return std::nullopt;
  }

  /// Whether a vertex beside the edge surely is above it: it then spans no facet with this normal.
  static bool rises(const Moved& body, const Moved::Edge& e, const Vec3& n, double doubt) {
    return std::any_of(e.beside.begin(), e.beside.end(),
                       [&](std::uint32_t v) { return v != kNone && n.dot(body.points[v] - body.points[e.from]) > doubt; });
  }
  /// Whether some difference surely is as far along n.
  bool reaches(const Vec3& n, double enough) const {
    double most = n.dot(a_.points[0]), least = n.dot(b_.points[0]);
    for (const Vec3& p : a_.points) most = std::max(most, n.dot(p));
    for (const Vec3& p : b_.points) least = std::min(least, n.dot(p));
    return most - least > enough;
  }
  bool is_lower(const Exact& n, const Rational& square) const {
    Rational most = dot(n, a_.exact_points[0]), least = dot(n, b_.exact_points[0]);
    for (const Exact& p : a_.exact_points) most = std::max(most, dot(n, p));
    for (const Exact& p : b_.exact_points) least = std::min(least, dot(n, p));
    const Rational height = most - least;
    return height < 0 || height * height < exact_depth_ * exact_depth_ * square;
  }

  const Moved &a_, &b_;
  const double depth_;
  const Rational exact_depth_;
  bool found_ = false;  ///< a plane at all: a difference without one is a segment or a point
};

}  // namespace

std::optional<Vec3> shallower(const Subject& a, const Subject& b, const Pose& b_in_a, double depth) {
  const Moved first = moved(a, Pose{}), second = moved(b, b_in_a);
  return Difference(first, second, depth).shallower();
}

}  // namespace swiftlet::stability
