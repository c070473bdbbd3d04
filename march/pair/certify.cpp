// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/certify.h"

#include <array>
#include <optional>

#include "body/half_edge.h"

namespace swiftlet {
namespace {

template <class P>
Vec point(const P& body, const Combination& c) {
  Vec p = body.own(c.vertex[0]) * c.weight[0];
  if (c.weight[1] != 0) p = p + body.own(c.vertex[1]) * c.weight[1];
  if (c.weight[2] != 0) p = p + body.own(c.vertex[2]) * c.weight[2];
  return body.common(p);
}

/// Vertex pairs whose weights add up to those of `a` for the vertices of A and to those of `b` for the vertices of B: the
/// weights of `a` are dealt out to `b` in order. At most four pairs, because `a` or `b` has at most two vertices.
ActiveSet pairs(const Combination& a, const Combination& b) {
  ActiveSet set;
  std::size_t i = 0, j = 0;
  double rest_a = a.weight[0], rest_b = b.weight[0];
  while (i < 3 && j < 3) {
    const double weight = min(rest_a, rest_b);
    if (weight > 0) set.a[set.count] = a.vertex[i], set.b[set.count] = b.vertex[j], set.weight[set.count++] = weight;
    rest_a -= weight, rest_b -= weight;
    if (rest_a <= 0 && ++i < 3) rest_a = a.weight[i];
    if (rest_b <= 0 && ++j < 3) rest_b = b.weight[j];
  }
  return set;
}

/// A direction of the common frame turned into one body's frame, for comparisons of its vertices in doubles with known errors.
struct Slope {
  Vec own;            ///< in the body's frame
  double turn_error;  ///< error of own . e that turning the direction causes, relative to |e|_1
  double along(const Vec& e) const { return dot(own, e); }
  double error(const Vec& e) const {
    const Vec m{std::fabs(e.x), std::fabs(e.y), std::fabs(e.z)};
    return kDotError * (std::fabs(own.x) * m.x + std::fabs(own.y) * m.y + std::fabs(own.z) * m.z) +
           turn_error * (m.x + m.y + m.z);
  }
  /// At least error(e) for every difference e of two points of a body of this extent.
  double most_error(double extent) const { return (kDotError * max_abs(own) + turn_error) * (7 * extent); }
};

Slope slope_a(const Vec& n) { return {n, 0}; }
Slope slope_b(const PairView& pair, const Vec& n) { return {-body_b(pair).into(n), kTurnedError}; }

/// A vertex that no other vertex of its body exceeds by more than `slack` along a direction.
struct Extreme {
  std::uint32_t vertex = 0;
  double slack = 0;
};

/// A few vertices that are level within rounding, each once.
struct Plateau {
  std::array<std::uint32_t, kPlateau> vertices;
  std::size_t count = 0;
  /// Returns false if there is no room for `v`.
  bool add(std::uint32_t v) {
    for (std::size_t i = 0; i < count; ++i)
      if (vertices[i] == v) return true;
    if (count == kPlateau) return false;
    vertices[count++] = v;
    return true;
  }
};

/// Climbs from `v` in doubles and decides no tie: every vertex that may be as high as the top is visited too, until all
/// neighbours of visited vertices are visited themselves or certainly below. On an exactly convex body the highest vertex is
/// then among the visited ones. `std::nullopt` if these are more than `kPlateau`.
std::optional<Extreme> top(const ConvexView& view, const Slope& slope, std::uint32_t v, std::uint32_t& plane_tests) {
  Plateau level;
  const double surely = -slope.most_error(view.extent);
  const auto ring = [&](std::uint32_t u, auto visit) {
    const Vertex& record = view.vertices[u];
    const Vec p = vec(record);
    plane_tests += record.ring_count;
    for (std::uint32_t h = record.ring_begin; h < record.ring_begin + record.ring_count; ++h) {
      const std::uint32_t w = view.half_edges[h].head;
      const Vec e = vec(view.vertices[w]) - p;
      if (const double rise = slope.along(e); rise >= surely) visit(w, rise, slope.error(e));
    }
  };
  for (bool rises = true, fits = true; rises;) {
    rises = false, fits = true, level.count = 0;
    level.add(v);
    double most = 0;
    const std::uint32_t from = v;
    ring(from, [&](std::uint32_t w, double rise, double error) {
      if (rise > error && rise > most) most = rise, v = w, rises = true;
      if (rise >= -error) fits = level.add(w) && fits;
    });
    if (!rises && !fits) return std::nullopt;
  }
  bool fits = true;
  for (std::size_t i = 1; i < level.count && fits; ++i) {
    ring(level.vertices[i], [&](std::uint32_t w, double rise, double error) {
      if (rise >= -error) fits = level.add(w) && fits;
    });
  }
  if (!fits) return std::nullopt;
  // Heights are measured from the first vertex. The slack covers the errors of the result's height and of all others.
  const Vec p = vec(view.vertices[v]);
  Extreme result{v, 0};
  double height = 0, highest = 0, uncertain = 0;
  for (std::size_t i = 1; i < level.count; ++i) {
    const Vec e = vec(view.vertices[level.vertices[i]]) - p;
    const double rise = slope.along(e), error = slope.error(e);
    if (rise > height) result.vertex = level.vertices[i], height = rise, uncertain = error;
    highest = max(highest, rise + error);
  }
  result.slack = max(0, highest - height + uncertain);
  return result;
}

/// An upper bound on how far a body rises along a direction, taken at length 1, above the first vertex of `corners`: gathers
/// the vertices around them that are level within rounding, until all other neighbours of those are below. On an exactly
/// convex body one of the gathered ones is extreme. Infinite if they are more than `kPlateau`. `own` is the direction `d` of
/// the common frame in the body's own.
double above_plateau(const ConvexView& view, const Vec& own, const Vec& d, const FeatureCorners& corners,
                     std::uint32_t& plane_tests) {
  const Vertex* vertices = view.vertices.data();
  const double length_1 = norm_1(d), error = kScanError * view.extent * length_1;
  const Vec p = vec(vertices[corners[0]]);
  Plateau level;
  for (const std::uint32_t v : corners) level.add(v);
  double most = 0;
  for (std::size_t i = 0; i < level.count; ++i) {
    const Vertex& record = vertices[level.vertices[i]];
    if (const Vec e = vec(record) - p; i > 0) most = max(most, dot(own, e) + kBesideError * length_1 * norm(e));
    const double least = dot(own, vec(record)) - error;
    const HalfEdge* ring = view.half_edges.data() + record.ring_begin;
    for (const HalfEdge* h = ring; h != ring + record.ring_count; ++h)
      if (!(dot(own, vec(vertices[h->head])) < least) && !level.add(h->head)) return kInfinity;
    plane_tests += record.ring_count;
  }
  return most / norm(d);
}

}  // namespace

bool tighten(const PairView& pair, Nearest& seen, std::uint32_t& plane_tests) {
  const auto looks = [&](const auto& body, FeatureCorners& corners, const Vec& d, double& over) {
    if (over <= kCloseShare * pair.law_two || corners[0] == kNone) return false;
    const double most = above_plateau(body.view, body.into(d), d, corners, plane_tests);
    corners = kNoCorners;
    if (!(most < over)) return false;
    over = most;
    return true;
  };
  const auto looks_at_a = [&] { return looks(body_a(pair), seen.corners_a, seen.normal, seen.over_a); };
  const auto looks_at_b = [&] { return looks(body_b(pair), seen.corners_b, -seen.normal, seen.over_b); };
  return seen.over_a > seen.over_b ? looks_at_a() || looks_at_b() : looks_at_b() || looks_at_a();
}

double gap(const PairView& pair, const Vec& n, std::uint32_t va, std::uint32_t vb, double slack) {
  return gap(pair, vec4(n), vec4(body_b(pair).point(vb) - body_a(pair).point(va)), slack);
}

double apart(const PairView& pair, std::uint32_t va, std::uint32_t vb) {
  return norm(body_b(pair).point(vb) - body_a(pair).point(va)) * (1 + kNormError) + pair.point_error();
}

Supports supports(const PairView& pair, const Vec& n, std::uint32_t start_a, std::uint32_t start_b,
                  std::uint32_t& plane_tests) {
  const auto a_top = top(pair.a, slope_a(n), start_a, plane_tests);
  const auto b_top = top(pair.b, slope_b(pair, n), start_b, plane_tests);
  const std::uint32_t va = a_top ? a_top->vertex : support_a(pair, n, start_a, plane_tests);
  const std::uint32_t vb = b_top ? b_top->vertex : support_b(pair, n, start_b, plane_tests);
  return {va, vb, gap(pair, n, va, vb, (a_top ? a_top->slack : 0) + (b_top ? b_top->slack : 0))};
}

Certificate certify(const PairView& pair, const Witness& seen, std::uint32_t& plane_tests) {
  Certificate c;
  c.point_a = point(body_a(pair), seen.first);
  c.point_b = point(body_b(pair), seen.second);
  c.upper = norm(c.point_b - c.point_a) * (1 + kNormError) + pair.point_error();
  c.normal = normalised(seen.normal);
  c.active = pairs(seen.first, seen.second);
  const auto proved = [&](std::uint32_t va, std::uint32_t vb, double lower) {
    c.support_a = va;
    c.support_b = vb;
    c.lower = max(0, lower);
    return c.upper - c.lower <= pair.law_two;
  };
  const Supports near = supports(pair, c.normal, seen.first.vertex[0], seen.second.vertex[0], plane_tests);
  if (proved(near.a, near.b, near.lower)) return c;
  const std::uint32_t va = support_a(pair, c.normal, near.a, plane_tests);
  const std::uint32_t vb = support_b(pair, c.normal, near.b, plane_tests);
  proved(va, vb, gap(pair, c.normal, va, vb, 0));
  return c;
}

}  // namespace swiftlet
