// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Parts of checks: supports, gaps and containment by brute force over all vertices, in 106 bits or exactly; failure messages.
#pragma once

#include <cstdio>

#include <swiftlet/check.h>

#include "body/half_edge.h"
#include "body/shape.h"
#include "body/support_map.h"
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

/// Returns the largest dot product of `direction` and a vertex, where `place` maps vertices to the common frame.
template <class Placing>
static inline DoubleDouble reach(std::span<const Vertex> vertices, const Wide& direction, Placing place, const Vec& = {}) {
  DoubleDouble most = dot(direction, place(vec(vertices[0])));
  for (const Vertex& v : vertices) {
    if (const DoubleDouble h = dot(direction, place(vec(v))); h > most) most = h;
  }
  return most;
}
/// Returns how far the exact hull reaches along `direction`, which is `own` in the body's frame; if level 0 is absent, an upper
/// bound, the least reach of the levels present and of the ball and the ellipsoid around the body, each of which encloses it.
template <class Placing>
static inline DoubleDouble reach(const Shape& body, const Wide& direction, Placing place, const Vec& own) {
  const bool is_cut = body.finest_level() > 0;
  DoubleDouble least = reach(body.level(body.finest_level()).view.vertices, direction, place);
  const auto encloses = [&](const DoubleDouble& h) { least = least > h ? h : least; };
  for (int i = body.finest_level() + 1; is_cut && i < body.level_count(); ++i)
    encloses(reach(body.level(i).view.vertices, direction, place));
  if (is_cut) {
    const Level& exact = body.level(0);
    const DoubleDouble centre = dot(direction, place(vec(exact.view.centre)));
    encloses(centre + body.radius() * norm(own));
    if (exact.scale_around < kInfinity) encloses(centre + exact.scale_around * norm(into_map(exact, own)));
  }
  return least;
}

/// Returns the gap between A and B along `n`, which may have any length. A and B are both shapes, or both spans of vertices.
template <class Vertices>
static inline double gap_along(const Vertices& a, const Vertices& b, const Motion& b_in_a, const Vec& n) {
  const Wide direction = wide(n);
  const auto placed = [&](const Vec& p) { return wide(b_in_a, p); };
  const DoubleDouble most_a = reach(
                         a, direction, [](const Vec&p) { return wide(p); }, n),
                     least_b = -reach(b, -direction, placed, rotate_back(b_in_a, -n));
  return double(least_b - most_a) / norm(n);
}

/// Returns R (w - v), where R is the rotation of `m`.
static inline Wide rotated(const Motion& m, const Vertex& w, const Vertex& v) {
  const Wide d = wide(vec(w)) - wide(vec(v));
  return {dot(wide(m.row_x), d), dot(wide(m.row_y), d), dot(wide(m.row_z), d)};
}

/// Returns R (b - a) x R (c - a), off by at most kNormalError of its largest coordinate. For slivers, whose products cancel, it
/// is computed exactly and rounded.
static inline Wide facet_normal(const Motion& m, const Vertex& a, const Vertex& b, const Vertex& c) {
  const Wide u = rotated(m, b, a), v = rotated(m, c, a), n = cross(u, v);
  if (max_abs(rounded(n)) >= kCancelled * max_abs(rounded(u)) * max_abs(rounded(v))) return n;
  return exact::turned_normal(m, &a.x, &b.x, &c.x);
}

/// Returns the distance of `p` from the segment that leads from `q` along `way`.
static inline double from_segment(const Wide& p, const Wide& q, const Wide& way) {
  const Wide d = p - q;
  const DoubleDouble square = dot(way, way), share = square.high > 0 ? dot(d, way) / square : 0;
  return norm(rounded(share > 1 ? d - way : share > 0 ? d - way * share : d));
}

/// Returns the distance of `p` from the exact facet left of the half-edge `first`, moved by `m`: from its edges or, over its
/// inside, from its plane.
static inline double from_facet(const ConvexView& view, const Motion& m, std::uint32_t first, const Wide& p) {
  const auto head = [&](std::uint32_t h) { return view.vertices[view.half_edges[h].head]; };
  const auto tail = [&](std::uint32_t h) { return view.vertices[origin(view, h)]; };
  const Wide normal = facet_normal(m, tail(first), head(first), head(next_in_facet(view, first)));
  double least = kInfinity;
  bool inside = true;
  std::uint32_t h = first;
  do {
    const Wide way = rotated(m, head(h), tail(h)), from = wide(m, vec(tail(h)));
    least = min(least, from_segment(p, from, way));
    inside = inside && !(dot(cross(normal, way), p - from) < 0);
    h = next_in_facet(view, h);
  } while (h != first);
  if (!inside) return least;
  return min(least, std::fabs(double(dot(normal, p - wide(m, vec(tail(first)))))) / norm(rounded(normal)));
}

/// Returns the distance of `p` from a body without volume, moved by `m`: a point, a segment or a polygon. The arithmetic is off
/// by less than `kDoubleDoubleError` of all lengths, far less than law 2's bound.
static inline double from_flat(const ConvexView& view, const Motion& m, const Vec& p) {
  const Vertex& first = view.vertices[0];
  if (view.half_edges.empty()) return norm(rounded(wide(p) - wide(m, vec(first))));
  if (view.face_first.empty()) return from_segment(wide(p), wide(m, vec(first)), rotated(m, view.vertices[1], first));
  double least = kInfinity;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    if (is_first_in_facet(view, h)) least = min(least, from_facet(view, m, h, wide(p)));
  }
  return least;
}

/// Returns true if `p` is at most `slack` away from a body without volume, moved by `m`, or at most `slack` above the plane of
/// every face of another.
static inline bool holds(const ConvexView& view, const Motion& m, const Vec& p, double slack) {
  // A polygon of n sides has 2 n half-edges, a polyhedron three or more for each vertex.
  if (view.half_edges.size() <= 2 * view.vertices.size()) return from_flat(view, m, p) <= slack;
  const double outward = dot(m.row_x, cross(m.row_y, m.row_z)) < 0 ? -1 : 1;  // a reflection turns normals inwards
  const double reach = norm(p) + view.extent + norm(m.t);
  bool inside = true;
  each_facet(view, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vertex &va = view.vertices[a], &vb = view.vertices[b], &vc = view.vertices[c];
    const Vec u = rotate(m, vec(vb) - vec(va)), v = rotate(m, vec(vc) - vec(va)), d = p - apply(m, vec(va));
    if (outward * dot(cross(u, v), d) < -kRoughFacetError * norm(u) * norm(v) * reach) return;  // far below the plane
    const Wide n = facet_normal(m, va, vb, vc);
    const double height = outward * double(dot(n, wide(p) - wide(m, vec(va))));
    inside = inside && height <= slack * norm(rounded(n));
  });
  return inside;
}

/// Checks that `proof` names vertices of `a` and `b`, views of level 0, whose differences have the origin in their hull.
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

/// An answer, the bodies and pose it is about, and quantities that every check of an answer needs.
struct Checked {
  Checked(const Body& of_a, const Body& of_b, const Pose& b_in_a, const Answer& of, Question asked);

  /// Checks that the answer refuses the pose, a radius or a body if and only if that is illegal. Of other answers, checks that
  /// radii and levels are those of the bodies, that the interval is one, and that the gap along the normal proves a `lower`
  /// above 0.
  Check interval_holds() const;
  DoubleDouble of_hulls(double bound) const { return DoubleDouble(bound) + at.radii.a() + at.radii.b(); }
  /// Checks that the normal is unit or unknown, that both points are finite or both unknown, and that both features exist or
  /// none is named. A `lower` above 0 with a finite `upper` needs points.
  Check members_hold() const;
  /// Returns true if the answer has both points.
  bool knows_points() const { return !answer.point_a.hasNaN() && !answer.point_b.hasNaN(); }
  Check points_lie_in_their_levels() const;
  /// Checks that the interval of an exact answer is within law 2's bound.
  Check is_narrow() const;
  /// Checks points of an interval that is within law 2's bound for the hulls: they must differ by the signed distance along the
  /// normal. Where no exact distance was asked for the normal may lean by as much as the bounds allow.
  Check points_are_nearest() const;
  /// Checks that the hulls overlap: by the vertices of `proof`, or because no plane separates them.
  Check hulls_overlap(const OverlapProof* proof) const;
  /// Returns the depth of the exact hulls, negative where they are apart. Where a level 0 is absent, a lower bound on it: the
  /// greatest depth of levels that overlap less their deviations, which is how much shallower the exact hulls may be; without
  /// such levels -infinity. Infinite where all differences lie on a line.
  DoubleDouble least_depth() const;
  /// Returns the least height of the planes that can bound the Minkowski difference of two levels: their depth, or a number
  /// below 0 where they are apart.
  DoubleDouble depth_of(int level_a, int level_b) const;
  /// Returns true if the points of a march on level 0 or, where one is absent, on any levels prove that the distance is at most
  /// `upper`.
  bool is_near(double upper) const;
  /// Returns true if the gap along the normal or the depth proves that the bodies overlap by no more than touching ones do, or
  /// if they share a plane, where nothing tells.
  bool is_shallow() const;
  /// Calls `visit` with the finest levels and, where these are not exact, with all others and the deviation of both: a coarser
  /// level may be nearer to the exact hull than a finer one, since neither holds the other.
  template <class Visit>
  void each_level_pair(Visit visit) const {
    for (int i = a.finest_level(); i < a.level_count(); ++i) {
      for (int k = b.finest_level(); k < b.level_count(); ++k) {
        const double error = a.level(i).deviation + stretch * b.level(k).deviation;
        visit(i, k, error);
        if (error == 0) return;
      }
    }
  }

  const Pose& pose;  ///< the pose of B in A's frame
  const Setting at;
  const Shape &a, &b;
  const Answer& answer;
  const bool is_exact;  ///< an exact distance was asked for
  bool is_certain() const { return is_exact && answer.status == Status::Converged; }
  double stretch = 1, radii = 0;
  Vec normal{0, 0, 0}, point_a{0, 0, 0}, point_b{0, 0, 0};  ///< of the hulls; the normal is 0 if unknown
  double touching = 0, narrow = 0;  ///< law 2's bound for the bodies, and without their radii, but with what these round
  double slack = 0;                 ///< the larger of `touching` and law 2's bound for the answer's levels
  double magnitude = 0;             ///< PairView::magnitude of the finest levels
  double deviation = 0;             ///< of the answer's levels: A's plus `stretch` times B's
};

/// Checks an answer about a distance.
Check check_distance(const Checked& of, const OverlapProof* proof);
/// Checks an answer about a signed distance.
Check check_signed(const Checked& of, const OverlapProof* proof);

}  // namespace swiftlet
