// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "depth_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <CGAL/Gmpzf.h>
#include <Eigen/Geometry>

namespace swiftlet::stability {
namespace {

using Dyadic = CGAL::Gmpzf;  // nothing is divided
using Exact = std::array<Dyadic, 3>;

Exact moved(const Pose& pose, const Vec3& p, bool is_point) {
  Exact q;
  for (int i = 0; i < 3; ++i) {
    q[std::size_t(i)] = is_point ? Dyadic(pose.translation[i]) : Dyadic(0);
    for (int j = 0; j < 3; ++j) q[std::size_t(i)] += Dyadic(pose.rotation(i, j)) * Dyadic(p[j]);
  }
  return q;
}
Exact minus(const Exact& p, const Exact& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Exact cross(const Exact& p, const Exact& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
Dyadic dot(const Exact& p, const Exact& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// One body in A's frame, rounded and exact, and the edges of its hull. Differences of rounded points are as precise as the
/// body is small, however far it is.
struct Moved {
  std::vector<Vec3> points;         ///< rotated only
  Vec3 shift;                       ///< what is still to be added
  std::vector<Exact> exact_points;  ///< where they are
  struct Edge {
    std::uint32_t from, to;
    Vec3 along;                  ///< from the one to the other, rotated
    std::array<Vec3, 2> beside;  ///< to a vertex of the facet to each side; 0 without one
  };
  std::vector<Edge> edges;
  std::vector<std::array<Edge, 2>> faces;  ///< two edges of each
  double extent = 0;                       ///< of `points`
};
Moved moved(const Subject& subject, const Pose& pose) {
  Moved m;
  m.shift = pose.translation;
  const ConvexView& view = subject.model.level(0).view;
  const auto stored = [&](std::uint32_t v) { return Vec3(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z); };
  for (std::uint32_t v = 0; v < view.vertices.size(); ++v) {
    const Vec3 p = stored(v);
    m.points.push_back(pose.rotation * p);
    m.exact_points.push_back(moved(pose, p, true));
    m.extent = std::max(m.extent, m.points.back().lpNorm<Eigen::Infinity>());
  }
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    // The ring is sorted: the half-edges before and after span a facet with this one.
    const std::uint32_t from = view.half_edges[view.half_edges[h].twin].head;
    const Vertex& ring = view.vertices[from];
    const std::uint32_t next = h + 1 < ring.ring_begin + ring.ring_count ? h + 1 : ring.ring_begin,
                        last = h > ring.ring_begin ? h - 1 : ring.ring_begin + ring.ring_count - 1;
    const bool has_facets = view.half_edges[h].face != kNone;
    const auto to = [&](std::uint32_t v) { return Vec3(pose.rotation * (stored(v) - stored(from))); };
    const auto edge = [&](std::uint32_t half_edge) {
      const std::uint32_t v = view.half_edges[half_edge].head;
      return Moved::Edge{from, v, to(v), {Vec3::Zero(), Vec3::Zero()}};
    };
    if (h < view.half_edges[h].twin) {
      m.edges.push_back(edge(h));
      if (has_facets) m.edges.back().beside = {to(view.half_edges[next].head), to(view.half_edges[last].head)};
    }
    if (has_facets) m.faces.push_back({edge(h), edge(next)});
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
    const Vec3 n = e.along.cross(f.along);
    const double doubt = 0x1p-44 * e.along.norm() * f.along.norm();  // of n, and of a height along it per length
    // Either may be: no farther than the depth, along n and against it.
    const double enough = depth_ * n.norm() + doubt * (a_.extent + b_.extent + b_.shift.norm());
    if (n.norm() > 4 * doubt) found_ = true;
    const bool below = !rises(e, n, doubt) && !rises(f, -n, doubt) && !reaches(n, enough);
    const bool above = !rises(e, -n, doubt) && !rises(f, n, doubt) && !reaches(-n, enough);
    if (!below && !above) return std::nullopt;
    const Exact normal =
        cross(minus(x.exact_points[e.to], x.exact_points[e.from]), minus(y.exact_points[f.to], y.exact_points[f.from]));
    const Dyadic square = dot(normal, normal);
    if (square == 0) return std::nullopt;
    found_ = true;
    const Exact opposite = minus({0, 0, 0}, normal);
    if (below && is_lower(normal, square)) return n;
    if (above && is_lower(opposite, square)) return Vec3(-n);
    return std::nullopt;
  }

  /// Whether a vertex beside the edge surely is above it: it then spans no facet with this normal.
  static bool rises(const Moved::Edge& e, const Vec3& n, double doubt) {
    return std::any_of(e.beside.begin(), e.beside.end(), [&](const Vec3& d) { return n.dot(d) > doubt * d.norm(); });
  }
  /// Whether some difference surely is as far along n.
  bool reaches(const Vec3& n, double enough) const {
    double most = n.dot(a_.points[0]), least = n.dot(b_.points[0]);  // A is not shifted
    for (const Vec3& p : a_.points) most = std::max(most, n.dot(p));
    for (const Vec3& p : b_.points) least = std::min(least, n.dot(p));
    return most - least - n.dot(b_.shift) > enough;
  }
  /// Decided exactly, but for vertices that are surely below others, and planes that surely are higher: nearly parallel edges
  /// have a normal that their difference in doubles does not know.
  bool is_lower(const Exact& n, const Dyadic& square) const {
    const Vec3 rounded(CGAL::to_double(n[0]), CGAL::to_double(n[1]), CGAL::to_double(n[2]));
    const double doubt = 0x1p-44 * rounded.norm();
    if (reaches(rounded, depth_ * rounded.norm() + doubt * (a_.extent + b_.extent + b_.shift.norm()))) return false;
    const Dyadic height = farthest(a_, n, rounded, doubt) + farthest(b_, minus({0, 0, 0}, n), -rounded, doubt);
    return height < 0 || height * height < exact_depth_ * exact_depth_ * square;
  }
  /// The greatest height of a body's vertices along n, among those that may have it.
  static Dyadic farthest(const Moved& body, const Exact& n, const Vec3& rounded, double doubt) {
    double enough = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : body.points) enough = std::max(enough, rounded.dot(p));
    enough -= 2 * doubt * body.extent;
    std::optional<Dyadic> most;
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      if (rounded.dot(body.points[i]) < enough) continue;
      const Dyadic height = dot(n, body.exact_points[i]);
      if (!most || height > *most) most = height;
    }
    return *most;
  }

  const Moved &a_, &b_;
  const double depth_;
  const Dyadic exact_depth_;
  bool found_ = false;  ///< a plane at all: a difference without one is a segment or a point
};

}  // namespace

std::optional<Vec3> shallower(const Subject& a, const Subject& b, const Pose& b_in_a, double depth) {
  const Moved first = moved(a, Pose{}), second = moved(b, b_in_a);
  return Difference(first, second, depth).shallower();
}

}  // namespace swiftlet::stability
