// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The direction comes from the features, not from the difference of two close points: from the difference, a cube's corner 1e-8
// above a face certifies only to 2e-8, from the face normal to 6e-16.
#include "certify.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "double_double.h"
#include "exact.h"
#include "ring.h"

namespace swiftlet {
namespace {

double clamped(double x) { return x > 0 ? x < 1 ? x : 1.0 : 0.0; }

/// A convex combination of vertices of one body, those with weights first.
struct Combination {
  std::array<std::uint32_t, 3> vertex;
  std::array<double, 3> weight;
};
Combination only(std::uint32_t v) { return {{v, v, v}, {1, 0, 0}}; }
Combination between(std::uint32_t tail, std::uint32_t head, double t) {
  if (t == 0) return only(tail);
  if (t == 1) return only(head);
  return {{tail, head, head}, {1 - t, t, 0}};
}

template <class P>
Vec point(const P& body, const Combination& c) {
  Vec p = body.own(c.vertex[0]) * c.weight[0];
  if (c.weight[1] != 0) p = p + body.own(c.vertex[1]) * c.weight[1];
  if (c.weight[2] != 0) p = p + body.own(c.vertex[2]) * c.weight[2];
  return body.common(p);
}

/// A direction and the points it comes from, with the roles of `certify`'s states already sorted out.
struct Witness {
  Vec normal;  ///< from the first body to the second, common frame, any length
  Combination first, second;
};
Witness swapped(const Witness& w) { return {-w.normal, w.second, w.first}; }

template <class P, class Q>
Witness vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
  return {b.point(vb) - a.point(va), only(va), only(vb)};
}

template <class P, class Q>
Witness vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
  const std::uint32_t tail = origin(b.view, h), head = b.view.head[h];
  const Vec q = b.point(tail), u = b.turned(b.own(head) - b.own(tail)), r = q - a.point(va);
  const double uu = dot(u, u), t = clamped(-dot(r, u) / uu);
  const Vec d = r + u * t;
  return {t > 0 && t < 1 ? d - u * (dot(d, u) / uu) : d, only(va), between(tail, head, t)};
}

template <class P, class Q>
Witness edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
  const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.head[ha], b0 = origin(b.view, hb), b1 = b.view.head[hb];
  const Vec u = a.turned(a.own(a1) - a.own(a0)), v = b.turned(b.own(b1) - b.own(b0)), r = a.point(a0) - b.point(b0);
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const Vec n = cross(u, v);
  const double area2 = dot(n, n);
  double s = area2 > 0 ? clamped((uv * vr - ur * vv) / area2) : 0.0;
  const double t = clamped((uv * s + vr) / vv);
  s = clamped((uv * t - ur) / uu);
  const Vec d = v * t - (r + u * s);
  // Edges within the rounding of parallel have no cross product worth the name.
  const Vec normal = !(area2 > kU * uu * vv) ? d - u * (dot(d, u) / uu) : dot(n, d) < 0 ? -n : n;
  return {normal, between(a0, a1, s), between(b0, b1, t)};
}

template <class P, class Q>
Witness vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
  const std::uint32_t first = b.view.face_first[f], root = origin(b.view, first);
  const Vec q0 = b.own(root), r = b.local(a.point(va)) - q0;
  // The triangle of the fan about the root that holds the projection of the vertex; failing that, the last one.
  for (std::uint32_t v1 = b.view.head[first], h = next_in_face(b.view, first);;
       v1 = b.view.head[h], h = next_in_face(b.view, h)) {
    const std::uint32_t v2 = b.view.head[h];
    const Vec u = b.own(v1) - q0, v = b.own(v2) - q0, area = cross(u, v);
    const Vec n = f < b.view.planes.size() ? Vec{b.view.planes[f].x, b.view.planes[f].y, b.view.planes[f].z} : area;
    const double w1 = dot(n, cross(r, v)), w2 = dot(n, cross(u, r)), w0 = dot(n, area) - w1 - w2;
    if ((w2 >= 0 && w1 >= 0) || b.view.head[next_in_face(b.view, h)] == root) {
      const double c0 = larger(w0, 0), c1 = larger(w1, 0), c2 = larger(w2, 0), sum = c0 + c1 + c2;
      if (!(sum > 0)) return {-b.turned(n), only(va), only(root)};
      return {-b.turned(n), only(va), {{root, v1, v2}, {c0 / sum, c1 / sum, c2 / sum}}};
    }
  }
}

template <class A, class B>
Witness witness(const A& a, Handle fa, const B& b, Handle fb) {
  using enum FeatureKind;
  const std::uint32_t i = fa.index(), j = fb.index();
  if (fa.kind() == Face) return swapped(vertex_face(b, any_vertex(b.view, fb), a, i));
  if (fb.kind() == Face) return vertex_face(a, any_vertex(a.view, fa), b, j);
  if (fa.kind() == Edge && fb.kind() == Edge) return edge_edge(a, i, b, j);
  if (fa.kind() == Edge) return swapped(vertex_edge(b, j, a, i));
  if (fb.kind() == Edge) return vertex_edge(a, i, b, j);
  return vertex_vertex(a, i, b, j);
}

/// Vertex pairs that have both combinations as their own: the transport that fills one from the other in order. At most
/// four, for one of them has at most two vertices.
ActiveSet pairs(const Combination& a, const Combination& b) {
  ActiveSet set;
  std::size_t i = 0, j = 0;
  double rest_a = a.weight[0], rest_b = b.weight[0];
  while (i < 3 && j < 3) {
    const double weight = smaller(rest_a, rest_b);
    if (weight > 0) set.a[set.count] = a.vertex[i], set.b[set.count] = b.vertex[j], set.weight[set.count++] = weight;
    rest_a -= weight, rest_b -= weight;
    if (rest_a <= 0 && ++i < 3) rest_a = a.weight[i];
    if (rest_b <= 0 && ++j < 3) rest_b = b.weight[j];
  }
  return set;
}

double sum_abs(const Vec& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

using Wide = V3<DoubleDouble>;
Wide wide(const Vec& v) { return {v.x, v.y, v.z}; }

/// Orders the vertices of one body along a direction of the common frame, exactly: in doubles, in 106 bits where these tie (the
/// corners of the very face that the direction is normal to), by expansions where those do.
class Ordering {
 public:
  explicit Ordering(const Vec& n) : n_(n), own_(n), error_(kDotError * sum_abs(n)) {}
  Ordering(const Vec& n, const Motion& motion)
      : n_(n), motion_(&motion), own_(turn_back(motion, n)), error_(kTurnedSupportError * sum_abs(n)) {}

  /// The sign of n . (w - v), w and v carried into the common frame.
  int compare(const Vertex& w, const Vertex& v) {
    const Vec e = vec(w) - vec(v);
    const double value = dot(own_, e), bound = error_ * sum_abs(e);
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return compare_ties(w, v, kWideDotError * sum_abs(n_) * sum_abs(e));
  }

 private:
  int compare_ties(const Vertex& w, const Vertex& v, double bound) {
    if (!has_wide_) {
      has_wide_ = true;
      wide_own_ = wide(n_);
      if (motion_)
        wide_own_ =
            wide(motion_->row_x) * wide_own_.x + wide(motion_->row_y) * wide_own_.y + wide(motion_->row_z) * wide_own_.z;
    }
    const Wide e{two_sum(w.x, -v.x), two_sum(w.y, -v.y), two_sum(w.z, -v.z)};
    const double value = double(dot(wide_own_, e));
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return motion_ ? exact::compare_along_turned(&n_.x, *motion_, &w.x, &v.x) : exact::compare_along(&n_.x, &w.x, &v.x);
  }

  const Vec n_;
  const Motion* const motion_ = nullptr;
  const Vec own_;  ///< n in the body's own frame, rounded
  const double error_;
  bool has_wide_ = false;
  Wide wide_own_;
};

/// Climbs the rings to the vertex that is last in `sign` times the order. On an exactly convex body the end is extreme.
std::uint32_t climb(const ConvexView& view, std::uint32_t v, Ordering order, int sign, std::uint32_t& plane_tests) {
  for (;;) {
    const Vertex& record = view.vertices[v];
    std::uint32_t best = v;
    for (std::uint32_t h = record.ring_begin; h < record.ring_begin + record.ring_count; ++h) {
      const std::uint32_t w = view.head[h];
      if (sign * order.compare(view.vertices[w], view.vertices[best]) > 0) best = w;
    }
    plane_tests += record.ring_count;
    if (best == v) return v;
    v = best;
  }
}

/// A direction of the common frame as one body's vertices see it, for comparisons in doubles that know their error.
struct Slope {
  Vec own;            ///< in the body's frame
  double turn_error;  ///< of own . e, relative to |e|_1
  double along(const Vec& e) const { return dot(own, e); }
  double error(const Vec& e) const {
    const Vec m{std::fabs(e.x), std::fabs(e.y), std::fabs(e.z)};
    return kDotError * (std::fabs(own.x) * m.x + std::fabs(own.y) * m.y + std::fabs(own.z) * m.z) +
           turn_error * (m.x + m.y + m.z);
  }
};

Slope slope_a(const Vec& n) { return {n, 0}; }
Slope slope_b(const Scene& scene, const Vec& n) { return {-body_b(scene).into(n), kTurnedError}; }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A vertex that no other of its body exceeds by more than `slack`.
struct Extreme {
  std::uint32_t vertex = 0;
  double slack = 0;
};

/// The farthest that two points of a body can be apart.
double reach(const ConvexView& view) { return 2 * kSqrt3 * view.extent; }

/// How far the body may stand above a feature along a slope, where the features beside it tell: the body is exactly convex. Its
/// neighbours must be below for certain; what is level with it only up to rounding, an edge or a triangle, leaves a tilt.
/// Infinite where doubles do not tell, or the face has more than three vertices.
double overhang(const ConvexView& view, Handle feature, const Slope& slope, std::uint32_t& plane_tests) {
  const double error = kDotError + kSqrt3 * slope.turn_error, far = reach(view);
  const std::uint32_t i = feature.index();
  switch (feature.kind()) {
    case FeatureKind::Vertex: {
      const Vertex& record = view.vertices[i];
      const Vec p = vec(record);
      plane_tests += record.ring_count;
      double highest = -kInfinity;
      for (std::uint32_t h = record.ring_begin; h < record.ring_begin + record.ring_count; ++h) {
        highest = larger(highest, slope.along(vec(view.vertices[view.head[h]]) - p));
      }
      return highest < -error * far ? 0.0 : kInfinity;
    }
    case FeatureKind::Edge: {
      const Vertex& tail = view.vertices[origin(view, i)];
      const Vec p = vec(tail), u = vec(view.vertices[view.head[i]]) - p;
      if (tail.ring_count < 2) return kInfinity;  // a segment
      const double overhang = (std::fabs(slope.along(u)) / norm(u) + error) * far;
      plane_tests += 2;
      const double left = slope.along(vec(view.vertices[view.head[counter_clockwise(tail, i)]]) - p),
                   right = slope.along(vec(view.vertices[view.head[clockwise(tail, i)]]) - p);
      return larger(left, right) < -(overhang + error * far) ? overhang : kInfinity;
    }
    case FeatureKind::Face: {
      if (i < view.planes.size()) return kInfinity;
      const std::uint32_t h = view.face_first[i];
      const Vec p = vec(view.vertices[origin(view, h)]), e = vec(view.vertices[view.head[h]]) - p,
                f = vec(view.vertices[view.head[next_in_facet(view, h)]]) - p, n = cross(e, f);
      const double area = norm(n);
      const Vec tilt = slope.own - n * (1 / area);
      return (norm(tilt) + kCrossError * std::sqrt(dot(e, e) * dot(f, f)) / area + error) * far;
    }
    default: return kInfinity;
  }
}

/// Climbs in doubles and decides no tie: whatever may be as high as the top is visited too, until every neighbour of every one
/// visited is itself visited or certainly below. On an exactly convex body the highest vertex is then among them. Nothing when
/// more than `kPlateau` are as high.
std::optional<Extreme> top(const ConvexView& view, const Slope& slope, std::uint32_t v, std::uint32_t& plane_tests) {
  std::array<std::uint32_t, kPlateau> plateau;
  std::size_t count = 0;
  const auto add = [&](std::uint32_t w) {
    if (std::find(plateau.begin(), plateau.begin() + count, w) != plateau.begin() + count) return true;
    if (count == kPlateau) return false;
    plateau[count++] = w;
    return true;
  };
  const auto ring = [&](std::uint32_t u, auto visit) {
    const Vertex& record = view.vertices[u];
    const Vec p = vec(record);
    plane_tests += record.ring_count;
    for (std::uint32_t h = record.ring_begin; h < record.ring_begin + record.ring_count; ++h) {
      const std::uint32_t w = view.head[h];
      const Vec e = vec(view.vertices[w]) - p;
      visit(w, slope.along(e), slope.error(e));
    }
  };
  for (bool rises = true, fits = true; rises;) {
    rises = false, fits = true, count = 0;
    add(v);
    double most = 0;
    const std::uint32_t from = v;
    ring(from, [&](std::uint32_t w, double rise, double error) {
      if (rise > error && rise > most) most = rise, v = w, rises = true;
      if (rise >= -error) fits = add(w) && fits;
    });
    if (!rises && !fits) return std::nullopt;
  }
  bool fits = true;
  for (std::size_t i = 1; i < count && fits; ++i) {
    ring(plateau[i], [&](std::uint32_t w, double rise, double error) {
      if (rise >= -error) fits = add(w) && fits;
    });
  }
  if (!fits) return std::nullopt;
  // Heights over the first; the top may be lower than any other by what both are uncertain.
  const Vec p = vec(view.vertices[v]);
  Extreme result{v, 0};
  double height = 0, highest = 0, uncertain = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const Vec e = vec(view.vertices[plateau[i]]) - p;
    const double rise = slope.along(e), error = slope.error(e);
    if (rise > height) result.vertex = plateau[i], height = rise, uncertain = error;
    highest = larger(highest, rise + error);
  }
  result.slack = larger(0, highest - height + uncertain);
  return result;
}

}  // namespace

std::uint32_t any_vertex(const ConvexView& view, Handle feature) {
  if (feature.kind() == FeatureKind::Vertex) return feature.index();
  return origin(view, feature.kind() == FeatureKind::Edge ? feature.index() : view.face_first[feature.index()]);
}

std::uint32_t support_a(const Scene& scene, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return climb(scene.a, start, Ordering(n), 1, plane_tests);
}

std::uint32_t support_b(const Scene& scene, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests) {
  return climb(scene.b, start, Ordering(n, scene.b_in_a), -1, plane_tests);
}

double gap(const Scene& scene, const Vec& n, const Vec& c, double slack) {
  const double products = std::fabs(n.x * c.x) + std::fabs(n.y * c.y) + std::fabs(n.z * c.z);
  return dot(n, c) - (kGapError * products + scene.motion_error + slack);
}

double gap(const Scene& scene, const Vec& n, std::uint32_t va, std::uint32_t vb, double slack) {
  return gap(scene, n, body_b(scene).point(vb) - body_a(scene).point(va), slack);
}

double apart(const Scene& scene, std::uint32_t va, std::uint32_t vb) {
  return norm(body_b(scene).point(vb) - body_a(scene).point(va)) * (1 + kNormError) + scene.point_error;
}

Supports supports(const Scene& scene, const Vec& n, std::uint32_t start_a, std::uint32_t start_b, std::uint32_t& plane_tests) {
  const auto a_top = top(scene.a, slope_a(n), start_a, plane_tests);
  const auto b_top = top(scene.b, slope_b(scene, n), start_b, plane_tests);
  const std::uint32_t va = a_top ? a_top->vertex : support_a(scene, n, start_a, plane_tests);
  const std::uint32_t vb = b_top ? b_top->vertex : support_b(scene, n, start_b, plane_tests);
  return {va, vb, gap(scene, n, va, vb, (a_top ? a_top->slack : 0) + (b_top ? b_top->slack : 0))};
}

Certificate certify(const Scene& scene, Handle a, Handle b, std::uint32_t& plane_tests) {
  const Resting body = body_a(scene);
  const Moved other = body_b(scene);
  const Witness found = witness(body, a, other, b);
  Certificate c;
  c.point_a = point(body, found.first);
  c.point_b = point(other, found.second);
  c.upper = norm(c.point_b - c.point_a) * (1 + kNormError) + scene.point_error;
  c.normal = normalised(found.normal);
  c.active = pairs(found.first, found.second);
  const auto proved = [&](std::uint32_t va, std::uint32_t vb, double lower) {
    c.support_a = va;
    c.support_b = vb;
    c.lower = larger(0, lower);
    return c.upper - c.lower <= scene.law_two;
  };
  // Ever dearer: what stands beside the features, what is as high as doubles can tell, exact order.
  const std::uint32_t any_a = found.first.vertex[0], any_b = found.second.vertex[0];
  const double over_a = overhang(scene.a, a, slope_a(c.normal), plane_tests);
  if (over_a < kInfinity) {
    const double over_b = overhang(scene.b, b, slope_b(scene, c.normal), plane_tests);
    if (over_b < kInfinity && proved(any_a, any_b, gap(scene, c.normal, any_a, any_b, over_a + over_b))) return c;
  }
  const Supports near = supports(scene, c.normal, any_a, any_b, plane_tests);
  if (proved(near.a, near.b, near.lower)) return c;
  const std::uint32_t va = support_a(scene, c.normal, near.a, plane_tests);
  const std::uint32_t vb = support_b(scene, c.normal, near.b, plane_tests);
  proved(va, vb, gap(scene, c.normal, va, vb, 0));
  return c;
}

}  // namespace swiftlet
