// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What checks are made of: supports and containment by brute force, in 106 bits or exactly, and failures in words.
#pragma once

#include <cstdio>

#include <swiftlet/check.h>

#include "body/shape.h"
#include "make/surface.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"
#include "numeric/wide.h"
#include "pair/pair_view.h"
#include "query/radii.h"

namespace swiftlet {

template <class... Values>
Check failed(const char* format, Values... values) {
  if constexpr (sizeof...(Values) == 0) {
    return {false, format};
  } else {
    char message[256];
    std::snprintf(message, sizeof message, format, values...);
    return {false, message};
  }
}
inline const Check kPassed{true, ""};

/// How far vertices reach along a direction, when `place` has placed them.
template <class Placing>
static inline DoubleDouble reach(std::span<const Vertex> vertices, const Wide& direction, Placing place) {
  DoubleDouble most = dot(direction, place(vec(vertices[0])));
  for (const Vertex& v : vertices) {
    if (const DoubleDouble h = dot(direction, place(vec(v))); h > most) most = h;
  }
  return most;
}
/// Of the exact hull: as far as itself; without it, no farther than any level that encloses it.
template <class Placing>
static inline DoubleDouble reach(const Shape& body, const Wide& direction, Placing place) {
  DoubleDouble least = reach(body.level(body.finest_level()).view.vertices, direction, place);
  for (int i = body.finest_level() + 1; body.finest_level() > 0 && i < body.level_count(); ++i) {
    if (const DoubleDouble h = reach(body.level(i).view.vertices, direction, place); least > h) least = h;
  }
  return least;
}

/// How far B, shapes or spans of vertices, stands from A along `n`, of any length.
template <class Vertices>
static inline double gap_along(const Vertices& a, const Vertices& b, const Motion& b_in_a, const Vec& n) {
  const Wide direction = wide(n);
  const DoubleDouble most_a = reach(a, direction, [](const Vec&p) { return wide(p); }),
                     least_b = -reach(b, -direction, [&](const Vec&p) { return wide(b_in_a, p); });
  return double(least_b - most_a) / norm(n);
}

/// R (w - v) of two vertices.
static inline Wide rotated(const Motion& m, const Vertex& w, const Vertex& v) {
  const Wide d = wide(vec(w)) - wide(vec(v));
  return {dot(wide(m.row_x), d), dot(wide(m.row_y), d), dot(wide(m.row_z), d)};
}

/// R (b - a) x R (c - a), off by kNormalError of its largest coordinate. Of slivers the products cancel: exactly, then.
static inline Wide facet_normal(const Motion& m, const Vertex& a, const Vertex& b, const Vertex& c) {
  const Wide u = rotated(m, b, a), v = rotated(m, c, a), n = cross(u, v);
  if (max_abs(rounded(n)) >= kCancelled * max_abs(rounded(u)) * max_abs(rounded(v))) return n;
  return exact::turned_normal(m, &a.x, &b.x, &c.x);
}

/// Whether a moved body holds a point, up to `slack`: below every face's plane by then.
static inline bool holds(const ConvexView& view, const Motion& m, const Vec& p, double slack) {
  if (view.face_first.empty() || view.vertices.size() < 4)
    return true;  // flat bodies: the distance to them is checked by lower
  const double outward = dot(m.row_x, cross(m.row_y, m.row_z)) < 0 ? -1 : 1;  // a reflection turns normals inside
  bool inside = true;
  each_facet(view, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Wide n = facet_normal(m, view.vertices[a], view.vertices[b], view.vertices[c]);
    const double height = outward * double(dot(n, wide(p) - wide(m, vec(view.vertices[a]))));
    inside = inside && height <= slack * norm(rounded(n));
  });
  return inside;
}

/// Whether the proof names vertices of level 0 whose differences hold the origin.
static inline Check check_proof(const ConvexView& a, const ConvexView& b, const Motion& b_in_a, const OverlapProof& proof) {
  if (proof.count != 4) return failed("overlap without a proof on level 0");
  std::array<std::array<double, 3>, 4> pa, pb;
  for (std::size_t k = 0; k < 4; ++k) {
    if (proof.vertex_a[k] >= a.vertices.size() || proof.vertex_b[k] >= b.vertices.size())
      return failed("the proof names no vertex");
    const Vertex &va = a.vertices[proof.vertex_a[k]], &vb = b.vertices[proof.vertex_b[k]];
    pa[k] = {va.x, va.y, va.z};
    pb[k] = {vb.x, vb.y, vb.z};
  }
  return exact::tetrahedron_holds_origin(pa, pb, b_in_a) ? kPassed : failed("the proof does not hold the origin");
}

/// What every check of an answer knows.
struct Checked {
  Checked(const Body& of_a, const Body& of_b, const Pose& b_in_a, const Answer& of);

  /// Whether what an answer refuses is illegal, and else radii, levels, the interval and its lower bound are right.
  Check interval_holds() const;
  DoubleDouble of_hulls(double bound) const { return DoubleDouble(bound) + at.radii.a() + at.radii.b(); }
  /// The points, on the hulls of their levels.
  bool knows_points() const { return !answer.point_a.hasNaN() && !answer.point_b.hasNaN(); }
  Check points_lie_in_their_levels() const;
  /// Whether the hulls are proved to overlap: by the proof's vertices, or since no plane separates them.
  Check hulls_overlap(const OverlapProof* proof) const;
  /// Of the exact hulls, which are no deeper than any levels around them, and shallower by no more than these deviate: at least
  /// how deep they overlap; negative where they are apart. Infinite where all their differences lie on a line.
  DoubleDouble least_depth() const;
  /// Of the finest levels, whether the kernel's own points prove `upper`; for what has no depth.
  bool is_near(double upper) const;

  const Pose& pose;  ///< of B in A's frame
  const Setting at;
  const Shape &a, &b;
  const Answer& answer;
  double stretch = 1, radii = 0;
  Vec normal{0, 0, 0}, point_a{0, 0, 0}, point_b{0, 0, 0};  ///< 0 where unknown; of the hulls
  double touching = 0;                                      ///< law 2's bound of the bodies
  double slack = 0;                                         ///< likewise, and of the answer's levels
  double magnitude = 0;                                     ///< of the finest levels
  double deviation = 0;                                     ///< of the answer's levels
};

/// Of an answer as a distance.
Check check_distance(const Checked& of, const OverlapProof* proof);
/// Of a signed answer.
Check check_signed(const Checked& of, const OverlapProof* proof);

}  // namespace swiftlet
