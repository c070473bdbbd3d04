// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The witness of any two closed features: the direction from one to the other and a nearest point of each, as a combination of
// vertices. Knows one level pair.
#pragma once

#include <array>
#include <cstdint>

#include "body/half_edge.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// A convex combination of at most three vertices of one body; unused places have weight 0.
struct Combination {
  std::array<std::uint32_t, 3> vertex;
  std::array<double, 3> weight;
};
static inline Combination only(std::uint32_t v) { return {{v, v, v}, {1, 0, 0}}; }
static inline Combination between(std::uint32_t tail, std::uint32_t head, double t) {
  if (t == 0) return only(tail);
  if (t == 1) return only(head);
  return {{tail, head, head}, {1 - t, t, 0}};
}

/// The direction between two features and a point of each. It comes from the features, not from the difference of two close
/// points: a cube's corner 1e-8 above a face certifies only to 2e-8 along the difference, to 6e-16 along the face normal.
struct Witness {
  Vec normal;  ///< from the first body to the second, common frame, any length
  Combination first, second;
};
static inline Witness swapped(const Witness& w) { return {-w.normal, w.second, w.first}; }

/// The part of `d` at right angles to `u`, whose squared length is `uu`. As a cross product it is at a right angle however much
/// shorter than `d` it is, where a difference of vectors would have to be taken twice.
template <class V>
static inline V across(const V& d, const V& u, double uu) {
  return cross(u, cross(d, u)) * (1 / uu);
}

/// The direction from one edge's line to another's, and bounds on the sines by which it misses a right angle to either of the
/// vectors from which it was computed.
template <class V>
struct BetweenEdges {
  V normal;
  double tilt_u, tilt_v;
};
/// Of lines along `u` and `v`; `d` leads from a point of the first to one of the second, `uu` and `vv` are squared lengths.
template <class V>
static inline BetweenEdges<V> between_edges(const V& u, double uu, const V& v, double vv, const V& d) {
  const V n = cross(u, v);
  const double nn = dot(n, n), lengths = std::sqrt(uu) * std::sqrt(vv);
  // If the edges are parallel within rounding, the direction of their cross product is noise.
  if (!(nn > kU * uu * vv)) return {across(d, u, uu), kAcrossError, kAcrossError + kFlatError + std::sqrt(nn) / lengths};
  const double tilt = kFlatError * lengths / std::sqrt(nn);
  return {n * std::copysign(1.0, dot(n, d)), tilt, tilt};  // either sense is as likely: no branch
}

/// A normal that such edges gave, at a right angle to both of them but for `kAcrossError`: less what lies in their plane. Their
/// `tilt` must be below `kMostTilt`.
template <class V>
static inline V righted(const V& n, const V& u, double uu, const V& v, double vv) {
  const double scale = 1 / dot(n, n), uv = dot(u, v), un = dot(u, n), vn = dot(v, n);
  return n - u * ((un * vv - vn * uv) * scale) - v * ((vn * uu - un * uv) * scale);
}

/// Nearest points p0 + s u and q0 + t v of two segments.
struct Parameters {
  double s, t;    ///< in [0, 1]
  bool is_inner;  ///< neither is at an end; known before s and t are
  bool ends_first() const { return !is_inner && (s == 0 || s == 1); }
  bool ends_second() const { return !is_inner && (t == 0 || t == 1); }
};
/// Follows [Ericson 2004, sec. 5.1.9], then computes s again from t, so that the difference stays perpendicular if the lines
/// are nearly parallel.
template <class V>
static inline Parameters nearest_on_segments(const V& p0, const V& u, double uu, const V& q0, const V& v, double vv) {
  const auto clamp = [](double x) { return min(1, max(0, x)); };
  const V r = p0 - q0;
  const double uv = dot(u, v), ur = dot(u, r), vr = dot(v, r), area2 = uu * vv - uv * uv;
  const double s_area = uv * vr - ur * vv, t_area = uu * vr - uv * ur;
  if (area2 > kSlimArea * uu * vv && min(s_area, t_area) > 0 && max(s_area, t_area) < area2) {
    const double t = t_area / area2;
    return {clamp((uv * t - ur) / uu), t, true};
  }
  const double s = area2 > 0 ? clamp(s_area / area2) : 0.0, t = clamp((uv * s + vr) / vv);
  return {clamp((uv * t - ur) / uu), t, false};
}

/// The point of face `f` below `p`, which is in the body's own frame. If `p` is beside the face, negative weights become 0, in
/// the triangle of the face's fan whose sector holds `p`, or else in the last triangle.
template <class Q>
Combination below(const Q& body, std::uint32_t f, const Vec& p) {
  const ConvexView& view = body.view;
  const std::uint32_t first = view.face_first[f], root = origin(view, first);
  const Vec q0 = body.own(root), r = p - q0;
  for (std::uint32_t v1 = view.half_edges[first].head, h = next_in_face(view, first);;
       v1 = view.half_edges[h].head, h = next_in_face(view, h)) {
    const std::uint32_t v2 = view.half_edges[h].head;
    const Vec u = body.own(v1) - q0, v = body.own(v2) - q0, area = cross(u, v);
    const Vec n = f < view.planes.size() ? Vec{view.planes[f].x, view.planes[f].y, view.planes[f].z} : area;
    const double w1 = dot(n, cross(r, v)), w2 = dot(n, cross(u, r)), w0 = dot(n, area) - w1 - w2;
    if ((w2 >= 0 && w1 >= 0) || view.half_edges[next_in_face(view, h)].head == root) {
      const double c0 = max(w0, 0), c1 = max(w1, 0), c2 = max(w2, 0), sum = c0 + c1 + c2;
      if (!(sum > 0)) return only(root);
      return {{root, v1, v2}, {c0 / sum, c1 / sum, c2 / sum}};
    }
  }
}

/// An outward normal of a face in the body's own frame, of any length.
template <class Q>
Vec face_normal(const Q& body, std::uint32_t f) {
  if (f < body.view.planes.size()) return {body.view.planes[f].x, body.view.planes[f].y, body.view.planes[f].z};
  const std::uint32_t h = body.view.face_first[f];
  const Vec q0 = body.own(origin(body.view, h)), q1 = body.own(body.view.half_edges[h].head);
  return cross(q1 - q0, body.own(body.view.half_edges[next_in_facet(body.view, h)].head) - q0);
}

/// The witness of features `a` of A and `b` of B, of which at most one is a face; for an edge against a face it is that of one
/// vertex of the edge.
Witness witness(const PairView& pair, FeatureId a, FeatureId b);

/// A vertex of a feature.
static inline std::uint32_t any_vertex(const ConvexView& view, FeatureId feature) {
  const std::uint32_t i = feature.index();
  return feature.kind() == FeatureKind::Vertex ? i : origin(view, feature.kind() == FeatureKind::Face ? view.face_first[i] : i);
}

}  // namespace swiftlet
