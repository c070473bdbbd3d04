// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The direction comes from the features, not from the difference of two close points: from the difference, a cube's corner 1e-8
// above a face certifies only to 2e-8, from the face normal to 6e-16.
#include "certify.h"

#include "double_double.h"
#include "exact.h"
#include "ring.h"

namespace swiftlet {
namespace {

struct Segment {
  std::uint32_t tail, head;
  Vec p, u;
};
template <class P>
Segment segment(const P& body, std::uint32_t h) {
  const std::uint32_t tail = origin(body.view, h), head = body.view.head[h];
  const Vec p = body.point(tail);
  return {tail, head, p, body.point(head) - p};
}

double clamped(double x) { return x > 0 ? x < 1 ? x : 1.0 : 0.0; }

/// A direction and the points it comes from, with the roles of `certify`'s states already sorted out.
struct Witness {
  Vec normal;  ///< from the first body to the second, any length
  ActiveSet active;
};
Witness swapped(Witness w) {
  w.normal = -w.normal;
  std::swap(w.active.a, w.active.b);
  return w;
}

template <class P, class Q>
Witness vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
  return {b.point(vb) - a.point(va), {1, {va}, {vb}, {1}}};
}

template <class P, class Q>
Witness vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
  const Segment e = segment(b, h);
  const Vec p = a.point(va);
  const double uu = dot(e.u, e.u), t = clamped(dot(p - e.p, e.u) / uu);
  const Vec d = e.p + e.u * t - p;
  return {t > 0 && t < 1 ? d - e.u * (dot(d, e.u) / uu) : d, {2, {va, va}, {e.tail, e.head}, {1 - t, t}}};
}

template <class P, class Q>
Witness edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
  const Segment e = segment(a, ha), f = segment(b, hb);
  const Vec r = e.p - f.p;
  const double uu = dot(e.u, e.u), vv = dot(f.u, f.u), uv = dot(e.u, f.u), ur = dot(e.u, r), vr = dot(f.u, r);
  const Vec n = cross(e.u, f.u);
  const double area2 = dot(n, n);
  double s = area2 > 0 ? clamped((uv * vr - ur * vv) / area2) : 0.0;
  const double t = clamped((uv * s + vr) / vv);
  s = clamped((uv * t - ur) / uu);
  const Vec d = f.p + f.u * t - (e.p + e.u * s);
  // Four vertex pairs of a parallelogram; the weights of the transport that fills them in order.
  ActiveSet active;
  const auto add = [&](std::uint32_t va, std::uint32_t vb, double weight) {
    if (weight > 0) active.a[active.count] = va, active.b[active.count] = vb, active.weight[active.count++] = weight;
  };
  add(e.tail, f.tail, std::fmin(1 - s, 1 - t));
  if (s <= t)
    add(e.tail, f.head, t - s);
  else
    add(e.head, f.tail, s - t);
  add(e.head, f.head, std::fmin(s, t));
  // Edges within the rounding of parallel have no cross product worth the name.
  if (!(area2 > kU * uu * vv)) return {d - e.u * (dot(d, e.u) / uu), active};
  return {dot(n, d) < 0 ? -n : n, active};
}

template <class P, class Q>
Witness vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
  const Vec p = a.point(va);
  const std::uint32_t first = b.view.face_first[f], root = origin(b.view, first);
  const Vec q0 = b.point(root);
  Vec n{0, 0, 0};
  if (f < b.view.planes.size()) n = b.turned({b.view.planes[f].x, b.view.planes[f].y, b.view.planes[f].z});
  // The triangle of the fan about the root that holds the projection of p; failing that, the last one.
  std::uint32_t h = next_in_face(b.view, first), v1 = b.view.head[first];
  for (;;) {
    const std::uint32_t v2 = b.view.head[h], next = next_in_face(b.view, h);
    const Vec q1 = b.point(v1), q2 = b.point(v2);
    if (f >= b.view.planes.size()) n = cross(q1 - q0, q2 - q0);
    const double w0 = dot(n, cross(q1 - p, q2 - p)), w1 = dot(n, cross(q2 - p, q0 - p)), w2 = dot(n, cross(q0 - p, q1 - p));
    const bool last = b.view.head[next] == root;
    if ((w2 >= 0 && w1 >= 0) || last) {
      const double c0 = std::fmax(w0, 0), c1 = std::fmax(w1, 0), c2 = std::fmax(w2, 0), sum = c0 + c1 + c2;
      if (!(sum > 0)) return {-n, {1, {va}, {root}, {1}}};
      return {-n, {3, {va, va, va}, {root, v1, v2}, {c0 / sum, c1 / sum, c2 / sum}}};
    }
    v1 = v2;
    h = next;
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

double gap(const Scene& scene, const Vec& n, std::uint32_t va, std::uint32_t vb) {
  const Vec c = body_b(scene).point(vb) - body_a(scene).point(va);
  const double products = std::fabs(n.x * c.x) + std::fabs(n.y * c.y) + std::fabs(n.z * c.z);
  return dot(n, c) - kGapError * products - scene.motion_error;
}

double apart(const Scene& scene, std::uint32_t va, std::uint32_t vb) {
  return norm(body_b(scene).point(vb) - body_a(scene).point(va)) * (1 + kNormError) + scene.point_error;
}

Certificate certify(const Scene& scene, Handle a, Handle b, std::uint32_t& plane_tests) {
  const Resting body = body_a(scene);
  const Moved other = body_b(scene);
  const Witness found = witness(body, a, other, b);
  Certificate c;
  c.active = found.active;
  for (int k = 0; k < c.active.count; ++k) {
    c.point_a = c.point_a + body.point(c.active.a[k]) * c.active.weight[k];
    c.point_b = c.point_b + other.point(c.active.b[k]) * c.active.weight[k];
  }
  c.upper = norm(c.point_b - c.point_a) * (1 + kNormError) + scene.point_error;
  c.normal = normalised(found.normal);
  c.support_a = support_a(scene, c.normal, c.active.a[0], plane_tests);
  c.support_b = support_b(scene, c.normal, c.active.b[0], plane_tests);
  c.lower = std::fmax(0, gap(scene, c.normal, c.support_a, c.support_b));
  return c;
}

bool belong_together(const Scene& scene, const Certificate& c) {
  const Vec d = c.point_b - c.point_a;
  return norm(d - c.normal * norm(d)) <= scene.law_two;
}

}  // namespace swiftlet
