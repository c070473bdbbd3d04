// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Voronoi marching [Ehmann & Lin 2000, sec. 5.1]. Each state finds the nearest points of its two closed features. If a point is
// on its feature's boundary, the walk drops to that boundary feature. Else it goes to the neighbour that rises highest along
// the direction between the points; if both features have one that rises, to the one on the way to which the distance falls
// faster. Mirrored states run with the roles swapped.
//
//     VV  --ring-->  VE  --ring-->  EE  --face--> over the face
//     VV <--clamp--  VE <--clamp--  EE
//                    VE --face-->   VF  --ring--> over the face: to VF, EE with a side of it, or Inside
//                    VE <--side---  VF
//
// Differences from the paper: nearest points on closed features instead of clipped intervals with derivatives, so that no state
// carries values from the one before (the paper's stale values loop); vertex to vertex in one step where the distance falls
// along the whole edge; an edge is followed over a face and down to where it ends in one step, so that edge and face are no
// state.
//
// States are computed in the common frame, and directions are turned into a body's own frame to compare its vertices. The
// comparisons that end a walk are a proof too: on an exactly convex body a vertex is extreme along d if all neighbours are
// below it, an edge along a direction at right angles to it if both adjacent corners are below, and a face along its normal.
// Each state knows by how much its direction may miss that right angle or normal: see `over`. A state's likely choices are made
// without branches, which processors would guess wrong every other time.
//
// Each file that includes this compiles it for the registers of its own flags: see walk.cpp. Nothing here is defined for other
// files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "numeric/vec4.h"
#include "pair/prism.h"
#include "pair/walk.h"
#include "pair/witness.h"

namespace swiftlet {
namespace {

constexpr FeatureId vertex(std::uint32_t index) { return {FeatureKind::Vertex, index}; }
constexpr FeatureId edge(std::uint32_t half_edge) { return {FeatureKind::Edge, half_edge}; }
constexpr FeatureId face(std::uint32_t index) { return {FeatureKind::Face, index}; }

/// Where a state leads: the next features, in the order of the state's arguments. A minimum leads to itself.
struct Move {
  FeatureId first, second;
  double distance2;  ///< squared distance of the features that the state leaves, for `kStallLimit`
};

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// A vertex compared with its ring along a direction.
struct RingScan {
  double height;     ///< how far the highest neighbour rises above the vertex, times the direction's length
  double error;      ///< the distance falls on the way to a neighbour that rises more than this
  std::uint32_t to;  ///< the half-edge that leads to the highest neighbour
  bool falls() const { return height > error; }
  /// The body rises no more than this above the vertex along the direction at length 1; infinite if unknown.
  double over() const { return height < -error ? 0 : kUnknown; }
};

/// An edge compared with the faces beside it along a direction.
struct SideScan {
  double height;              ///< how far the higher neighbouring corner rises above the edge, times the direction's length
  bool is_left;               ///< it is the one of the face on the left
  std::uint32_t left, right;  ///< the edges from the half-edge's origin to these corners
  bool falls() const { return height > 0; }
  /// As RingScan::over, of a direction that misses a right angle to the edge by a sine of at most `tilt` and has `length_1`.
  double over(double tilt, double reach, double length_1) const {
    const double over = tilt * reach;
    // At a right angle to the edge the corners are below too if they are by more than the tilt and rounding can lift them.
    return left == kNone || height < -(over + kBesideError * reach) * length_1 ? over : kUnknown;
  }
};

/// A neighbour that rises.
struct Rise {
  std::uint32_t to;  ///< a half-edge of the vertex's ring, or a face beside the edge
  double height;     ///< as that of the scan
  double length2;    ///< squared length of the way to the neighbour
  /// The squared rate at which the distance falls. Rounding may give a sliver a `length2` of 0 or less.
  double rate2() const { return height / max(std::numeric_limits<double>::denorm_min(), length2) * height; }
};

/// As Nearest.
struct Ending {
  Vec4 normal, apart, point_a, point_b;
  double blur, over_a, over_b;
  FeatureCorners corners_a, corners_b;
};

class Marcher {
 public:
  /// The states count their tests in `walk` and write how it ends.
  Marcher(const PairView& pair, PlaneRule rule, Walk& walk)
      : pair_(pair), first_only_(rule == PlaneRule::FirstViolated), walk_(walk) {}

  template <class P, class Q>
  Move vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
    const Vec4 p = a.point(va), q = b.point(vb), d = q - p;
    const double length_1 = norm_1(d), distance2 = dot(d, d);
    const RingScan at_a = ring(a, va, a.into(d), length_1), at_b = ring(b, vb, b.into(-d), length_1);
    if (!at_a.falls() && !at_b.falls()) {
      end(a, {d, d, p, q, 0, at_a.over(), at_b.over(), {va, va, va}, {vb, vb, vb}});
      return {vertex(va), vertex(vb), distance2};
    }
    if (!at_b.falls()) return {along(a, up_ring(a, va, at_a)), vertex(vb), distance2};
    const Rise from_b = up_ring(b, vb, at_b);
    if (!at_a.falls()) return {vertex(va), along(b, from_b), distance2};
    const Rise from_a = up_ring(a, va, at_a);
    if (from_a.rate2() > from_b.rate2()) return {along(a, from_a), edge(from_b.to), distance2};
    return {edge(from_a.to), along(b, from_b), distance2};
  }

  template <class P, class Q>
  Move vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
    const std::uint32_t v0 = origin(b.view, h), v1 = b.view.half_edges[h].head;
    const Vec4 own = b.own(v0), p = a.point(va), q0 = b.point(v0), u = b.way(b.own(v1) - own), r = p - q0;
    const double length2 = dot(u, u), ru = dot(r, u);
    walk_.plane_tests += 2;
    if (!(ru > 0)) return {vertex(va), vertex(v0), dot(r, r)};
    if (ru >= length2) return {vertex(va), vertex(v1), dot(r - u, r - u)};
    const Vec4 up = across(r, u, length2);
    const double distance2 = dot(up, up), length_1 = norm_1(up);
    const SideScan at_b = sides(b, v0, h, b.into(up));
    const RingScan at_a = ring(a, va, a.into(-up), length_1);
    if (!at_b.falls() && !at_a.falls()) {
      const double over_b = at_b.over(kAcrossError + Q::kWay, b.reach, length_1);
      end(a, {-up, -r, p, q0 + u * (ru / length2), blur_on<Q>(u), at_a.over(), over_b, {va, va, va}, {v0, v1, v1}});
      return {vertex(va), edge(h), distance2};
    }
    if (!at_b.falls()) return {along(a, up_ring(a, va, at_a)), edge(h), distance2};
    const Rise from_b = up_side(b, v0, h, at_b);
    if (first_only_ || !at_a.falls()) return {vertex(va), face(from_b.to), distance2};
    const Rise from_a = up_ring(a, va, at_a);
    if (from_b.rate2() > from_a.rate2()) return {vertex(va), face(from_b.to), distance2};
    return {along(a, from_a), edge(h), distance2};
  }

  template <class P, class Q>
  Move vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
    const Prism prism(b, f);
    const Vec4 p = a.point(va);
    Look look;
    if (const std::uint32_t side = leave(b, prism, f, p, look); side != kNone) return {vertex(va), edge(side), kUnknown};
    const Vec4& n = prism.normal();
    const double height = prism.height(p), distance2 = height / dot(n, n) * height;
    if (!(height > 0)) return inside(vertex(va), face(f), distance2);
    const RingScan below = ring(a, va, a.into(-n), norm_1(n));
    if (!below.falls()) {
      if (!look.at_all)
        if (const std::uint32_t side = leave_by_any(b, prism, f, vec(p), look); side != kNone)
          return {vertex(va), edge(side), kUnknown};
      Ending seen{-n, prism.corner() - p, p, p, 0, below.over(), kUnknown, {va, va, va}, kNoCorners};
      if (prism.is_triangle())
        foot_on_facet(b, prism, seen);
      else if (foot_on_face(b, prism, f, height, look.well_inside, seen))
        // A facet within a face has a direction of its own.
        seen.over_a = ring(a, va, a.into(seen.normal), norm_1(seen.normal)).over();
      end(a, seen);
      return {vertex(va), face(f), distance2};
    }
    const std::uint32_t to = a.view.half_edges[below.to].head;
    return over_face(below.to, to, p, a.way(a.own(to) - a.own(va)), b, prism, f, distance2);
  }

  template <class P, class Q>
  Move edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
    const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.half_edges[ha].head, b0 = origin(b.view, hb),
                        b1 = b.view.half_edges[hb].head;
    const Vec4 p0 = a.point(a0), u = a.way(a.own(a1) - a.own(a0)), q0 = b.point(b0), v = b.way(b.own(b1) - b.own(b0));
    const double uu = dot(u, u), vv = dot(v, v);
    const Parameters at = nearest_on_segments(p0, u, uu, q0, v, vv);
    const Vec4 p = p0 + u * at.s, q = q0 + v * at.t, d = q - p;
    const double distance2 = dot(d, d);
    walk_.plane_tests += 4;
    const bool end_a = at.ends_first(), end_b = at.ends_second();
    if (end_a || end_b) {
      return {end_a ? vertex(at.s == 0 ? a0 : a1) : edge(ha), end_b ? vertex(at.t == 0 ? b0 : b1) : edge(hb), distance2};
    }
    const auto [n, tilt_u, tilt_v] = between_edges(u, uu, v, vv, d);
    const SideScan at_a = sides(a, a0, ha, a.into(n)), at_b = sides(b, b0, hb, b.into(-n));
    if (!at_a.falls() && !at_b.falls()) {
      const double length_1 = norm_1(n), over_a = at_a.over(tilt_u + P::kWay, a.reach, length_1),
                   over_b = at_b.over(tilt_v + Q::kWay, b.reach, length_1);
      end(a, {n, q0 - p0, p, q, blur_on<P>(u) + blur_on<Q>(v), over_a, over_b, {a0, a1, a1}, {b0, b1, b1}});
      return {edge(ha), edge(hb), distance2};
    }
    const Rise rise_a = at_a.falls() ? up_side(a, a0, ha, at_a) : Rise{kNone, -1, 1},
               rise_b = at_b.falls() ? up_side(b, b0, hb, at_b) : Rise{kNone, -1, 1};
    if (!at_b.falls() || (at_a.falls() && (first_only_ || rise_a.rate2() >= rise_b.rate2())))
      return swapped(edge_over_face(hb, b0, b1, q, v, at.t, a, rise_a.to, distance2));
    return edge_over_face(ha, a0, a1, p, u, at.s, b, rise_b.to, distance2);
  }

  static Move swapped(const Move& m) { return {m.second, m.first, m.distance2}; }

 private:
  /// Ends the walk in a minimum. The first argument is the state's first body; `seen` has the bodies in the state's order.
  void end(const Resting4&, const Ending& seen) { end(seen); }
  void end(const Moved4&, const Ending& seen) {
    end({-seen.normal, -seen.apart, seen.point_b, seen.point_a, seen.blur, seen.over_b, seen.over_a, seen.corners_b,
         seen.corners_a});
  }
  void end(const Ending& seen) {
    Nearest& nearest = walk_.nearest;
    store(seen.normal, nearest.normal), store(seen.apart, nearest.apart);
    store(seen.point_a, nearest.point_a), store(seen.point_b, nearest.point_b);
    nearest.blur = seen.blur, nearest.over_a = seen.over_a, nearest.over_b = seen.over_b;
    nearest.corners_a = seen.corners_a, nearest.corners_b = seen.corners_b;
    walk_.end = WalkEnd::Minimum;
  }
  Move inside(FeatureId first, FeatureId second, double distance2) {
    walk_.end = WalkEnd::Inside;
    return {first, second, distance2};
  }

  /// How far a computed point of an edge along `u` may be beside the edge: by the error of `u`, and of u times a number up
  /// to 1.
  template <class Q>
  static double blur_on(const Vec4& u) {
    return (Q::kWay + kU) * norm_1(u);
  }

  /// Compares a vertex with its ring along `own`, in the body's own frame, whose |d|_1 in the common frame is `length_1`.
  /// Taking the steepest way instead of the highest neighbour's would need fewer states but more time.
  template <class P>
  RingScan ring(const P& body, std::uint32_t v, const Vec4& own, double length_1) {
    const double error = kScanError * body.view.extent * length_1;
    const Neighbour highest = highest_neighbour(body.view, body.view.vertices[v], own, error);
    return {highest.height, error, highest.to};
  }

  struct Neighbour {
    double height;     ///< above the vertex
    std::uint32_t to;  ///< the half-edge that leads to it
  };
  /// The highest neighbour of a vertex along `own`: of four to eight by twice four, of which some are the same.
  Neighbour highest_neighbour(const ConvexView& view, const Vertex& vertex, const Vec4& own, double error) {
    const double height = own[0] * vertex.x + own[1] * vertex.y + own[2] * vertex.z;
    const std::uint32_t begin = vertex.ring_begin, further = vertex.ring_count - 4;
    if (first_only_ || further > 4) return one_by_one(view, vertex, vec(own), height, error);
    const Vertex* vertices = view.vertices.data();
    const HalfEdge* h = view.half_edges.data() + begin;
    const auto heights = [&](const HalfEdge* g) {
      return dot(repeated(own), transposed(vertices[g[0].head], vertices[g[1].head], vertices[g[2].head], vertices[g[3].head]));
    };
    const Vec4 some = heights(h), others = heights(h + further);
    const Vec4 highest = all_greatest(max(some, others));
    walk_.plane_tests += vertex.ring_count;
    const unsigned where = equal(some, highest) | equal(others, highest) << further;
    return {highest[0] - height, begin + std::uint32_t(std::countr_zero(where))};
  }

  /// The same for any ring, and for the first neighbour that is higher than the vertex by more than `error`.
  [[gnu::noinline, gnu::flatten]] Neighbour one_by_one(const ConvexView& view, const Vertex& vertex, Vec own, double height,
                                                       double error) {
    const std::uint32_t begin = vertex.ring_begin, end = begin + vertex.ring_count;
    double highest = -kUnknown;
    std::uint32_t to = kNone, h = begin;
    for (; h != end; ++h) {
      const double other = dot(own, vec(view.vertices[view.half_edges[h].head]));
      to = other > highest ? h : to;
      highest = max(highest, other);
      if (first_only_ && highest - height > error) break;
    }
    walk_.plane_tests += h - begin + (h != end);
    return {highest - height, to};
  }

  /// The way to the neighbour of a vertex that a scan found.
  template <class P>
  static Rise up_ring(const P& body, std::uint32_t v, const RingScan& scan) {
    const Vec4 e = body.own(body.view.half_edges[scan.to].head) - body.own(v);
    return {scan.to, scan.height, dot(e, e)};
  }

  /// Where the fall along the edge `ring.to` ends: the edge, or the vertex at its head if the distance falls up to there.
  template <class P>
  static FeatureId along(const P& body, const Rise& ring) {
    return ring.height >= ring.length2 ? vertex(body.view.half_edges[ring.to].head) : edge(ring.to);
  }

  /// Compares edge `h`, which begins at vertex `v0`, with the faces beside it along `own`, in the body's own frame: with their
  /// other edges at `v0`.
  template <class Q>
  SideScan sides(const Q& body, std::uint32_t v0, std::uint32_t h, const Vec4& own) {
    const Vertex& record = body.view.vertices[v0];
    const std::uint32_t left = counter_clockwise(record, h), right = clockwise(record, h);
    if (left == h) return {-kUnknown, false, kNone, kNone};  // a segment
    walk_.plane_tests += 2;
    const Vec4 q0 = vec4(record), to_left = body.own(body.view.half_edges[left].head) - q0,
               to_right = body.own(body.view.half_edges[right].head) - q0;
    const double left_rise = dot(own, to_left), right_rise = dot(own, to_right);
    return {max(left_rise, right_rise), first_only_ ? left_rise > 0 : left_rise > right_rise, left, right};
  }

  /// The way over the face beside edge `h` that a scan found.
  template <class Q>
  static Rise up_side(const Q& body, std::uint32_t v0, std::uint32_t h, const SideScan& scan) {
    const HalfEdge* edges = body.view.half_edges.data();
    const Vec4 p = body.own(v0), u = body.own(edges[h].head) - p,
               r = body.own(edges[scan.is_left ? scan.left : scan.right].head) - p;
    const double ru = dot(r, u);
    return {edges[scan.is_left ? h : scan.right].face, scan.height, dot(r, r) - ru * ru / dot(u, u)};
  }

  /// What is known of a point in a face's prism.
  struct Look {
    bool at_all = true;       ///< all sides were looked at
    bool well_inside = true;  ///< false if the point below may be outside a face of many corners by rounding
  };
  /// The side of a face's prism that `p` is farthest beyond; kNone if `p` is inside the prism.
  template <class Q>
  std::uint32_t leave(const Q& body, const Prism<Q>& prism, std::uint32_t f, const Vec4& p, Look& look) {
    if (!prism.is_triangle()) {
      look.at_all = border(body).face != f;
      return look.at_all ? leave_by_any(body, prism, f, vec(p), look) : leave_nearby(body, prism, vec(p));
    }
    std::uint32_t out = kNone;
    double farthest2 = 0;
    walk_.plane_tests += prism.each_side(
        body, p, all(0), [&](const auto& sides, const auto& half_edge) { go_out(sides, half_edge, farthest2, out); });
    return out;
  }
  /// Makes `out` the side that is passed by most, squared: by more than `farthest2`.
  template <class Sides>
  void go_out(const Sides& sides, const auto& half_edge, double& farthest2, std::uint32_t& out) const {
    const Vec4 beyond = max(sides.beyond, all(0));
    if (greater(beyond, all(0)) == 0 || (first_only_ && out != kNone)) return;
    const Vec4 violation2 = beyond / sides.uu * beyond;  // in this order, as eighth powers of small lengths underflow
    const double most = greatest(violation2);
    if (!(most > farthest2)) return;
    out = half_edge(std::countr_zero(first_only_ ? greater(violation2, all(0)) : equal(violation2, all(most))));
    farthest2 = most;
  }

  /// A face of more than `kManySides` sides that the walk has looked at around, and the side that it is near.
  struct Border {
    std::uint32_t face = kNone, side = kNone;
  };
  template <class Q>
  Border& border(const Q&) {
    return borders_[std::is_same_v<Q, Moved4>];
  }

  /// As `leave`, of a face of many corners.
  template <class Q>
  [[gnu::noinline, gnu::flatten]] std::uint32_t leave_by_any(const Q& body, const Prism<Q>& prism, std::uint32_t f, Vec p,
                                                             Look& look) {
    std::uint32_t out = kNone, nearest = kNone;
    double farthest2 = 0, least2 = kUnknown;
    const double margin = (kFootError + kFootTurn * pair_.pose_error) * pair_.magnitude;
    const std::uint32_t count = prism.each_side(body, vec4(p), all(0), [&](const auto& sides, const auto& half_edge) {
      const Vec4 distance2 = sides.beyond / sides.uu * sides.beyond;
      look.well_inside &= greater(all(0), sides.beyond) == 15 && greater(distance2, all(margin * margin)) == 15;
      if (const double least = -greatest(-distance2); least < least2)
        least2 = least, nearest = half_edge(std::countr_zero(equal(distance2, all(least))));
      go_out(sides, half_edge, farthest2, out);
    });
    walk_.plane_tests += count;
    if (count > kManySides && !first_only_) border(body) = {f, out != kNone ? out : nearest};
    return out;
  }
  /// As `leave`, of sides near the one that the walk was near before. A minimum is to be tested by all.
  template <class Q>
  [[gnu::noinline, gnu::flatten]] std::uint32_t leave_nearby(const Q& body, const Prism<Q>& prism, Vec p) {
    std::uint32_t &side = border(body).side, out = kNone;
    double farthest2 = 0;
    side = prism.nearest_side(body, side, vec4(p), all(0), [&](const auto& seen, std::uint32_t half_edge) {
      ++walk_.plane_tests;
      if (seen.beyond2() > farthest2) farthest2 = seen.beyond2(), out = half_edge;
    });
    return out;
  }

  /// Completes `seen` for the point at `height` times the normal's length above face `f` of many corners: with the point below
  /// it and what the face's plane proves. Of a face that is flat only up to the input's rounding, the exact facet proves:
  /// returns true if `seen` has its normal, along which the first body is not compared yet.
  template <class Q>
  bool foot_on_face(const Q& body, const Prism<Q>& prism, std::uint32_t f, double height, bool well_inside, Ending& seen) {
    const Vec4& n = prism.normal();
    const FacePlane& plane = body.view.planes[f];
    const double stretch = stretch_of(pair_.pose_error);
    seen.point_b = seen.point_a - n * (height / dot(n, n));
    seen.blur = plane.thickness * stretch + (kDropError + Q::kImage) * norm_1(seen.apart);
    seen.over_b = plane.over * stretch + Q::kImage * body.reach;
    if (body.view.reach == 0 || seen.blur + seen.over_b > pair_.law_two) {
      Ending found = seen;
      search_facets<Q>(prism.first(), found);
      seen = found;
      return true;
    }
    if (!well_inside) seen.over_b = kUnknown;
    return false;
  }

  /// Completes `seen` for the point below its first one in a triangle.
  template <class Q>
  void foot_on_facet(const Q& body, const Prism<Q>& prism, Ending& seen) {
    const Vec4 &n = prism.normal(), &u = prism.u(), &v = prism.v();
    const double nn = dot(n, n), tilt = (2 * Q::kWay + kFlatError) * std::sqrt(dot(u, u) * dot(v, v) / nn);
    const typename Prism<Q>::Beyond at = prism.beyond(seen.point_a - prism.corner());
    seen.point_b = prism.corner() + u * (-at.v / nn) + v * (-at.u / nn);
    seen.blur = (Q::kWay + kWeightError) * (norm_1(u) + norm_1(v));
    seen.over_b = tilt * body.reach;
    seen.corners_b = prism.corners();
  }

  /// Completes `seen` for the nearest point in a face made of several facets, of which `h` begins one: goes from facet to facet
  /// across the diagonals that the first point is beyond, to the triangle below it, or to the diagonal between two.
  template <class Q>
  [[gnu::noinline, gnu::flatten]] void search_facets(std::uint32_t h, Ending& seen) {
    const Q body(pair_);
    seen.over_b = kUnknown;
    std::uint32_t from = kNone;
    for (int steps = 0; steps < kFacetSteps; ++steps) {
      const Prism<Q> facet = Prism<Q>::over_facet(body, h);
      if (next_in_facet(body.view, next_in_facet(body.view, facet.second())) != h) return;  // no triangle
      std::uint32_t out = kNone;
      bool leaves_face = false;
      walk_.plane_tests += facet.each_side(body, seen.point_a, all(0), [&](const auto& sides, const auto& half_edge) {
        const Vec4 beyond = max(sides.beyond, all(0)), violation2 = beyond / sides.uu * beyond;
        const double most = greatest(violation2);
        if (most > 0) out = half_edge(std::countr_zero(equal(violation2, all(most))));
        for (int i = 0; i < 3; ++i) leaves_face |= sides.beyond[i] > 0 && !is_diagonal(body.view, half_edge(i));
      });
      seen.normal = -facet.normal();
      seen.apart = facet.corner() - seen.point_a;
      if (out == kNone) return foot_on_facet(body, facet, seen);
      if (leaves_face) return;
      if (out == from) return foot_on_diagonal(body, out, seen);
      from = h = body.view.half_edges[out].twin;
    }
  }

  /// Completes `seen` for the point of edge `h` that is nearest to its first one.
  template <class Q>
  void foot_on_diagonal(const Q& body, std::uint32_t h, Ending& seen) {
    const std::uint32_t tail = origin(body.view, h), head = body.view.half_edges[h].head;
    const Vec4 q = body.point(tail), u = body.way(body.own(head) - body.own(tail)), r = seen.point_a - q;
    const double length2 = dot(u, u), s = dot(r, u) / length2;
    if (!(s > 0 && s < 1)) return;
    const Vec4 up = across(r, u, length2);
    const double over_b = sides(body, tail, h, body.into(up)).over(kAcrossError + Q::kWay, body.reach, norm_1(up));
    seen = {-up, -r, seen.point_a, q + u * s, blur_on<Q>(u), seen.over_a, over_b, seen.corners_a, {tail, head, head}};
  }

  /// Follows edge `h`, which leads from `tail` along u to `head`, from its point p at s over face `f`, which rises towards p.
  template <class Q>
  Move edge_over_face(std::uint32_t h, std::uint32_t tail, std::uint32_t head, const Vec4& p, const Vec4& u, double s,
                      const Q& body, std::uint32_t f, double distance2) {
    const Prism prism(body, f);
    const bool forward = dot(prism.normal(), u) < 0;
    return over_face(h, forward ? head : tail, p, u * (forward ? 1 - s : -s), body, prism, f, distance2);
  }

  /// Follows the part p + x e of edge `h` that falls towards face `f`, x from 0 to 1 at vertex `to`. Leads to `to` and the
  /// face, or to the edge and the side where it leaves the face's prism. The walk ends Inside if the edge gets below the face
  /// first.
  template <class Q>
  Move over_face(std::uint32_t h, std::uint32_t to, const Vec4& p, const Vec4& e, const Q& body, const Prism<Q>& prism,
                 std::uint32_t f, double distance2) {
    Exit exit;
    if (!prism.is_triangle())
      exit = border(body).face == f ? exit_nearby(body, prism, vec(p), vec(e)) : exit_by_any(body, prism, vec(p), vec(e));
    else
      walk_.plane_tests +=
          prism.each_side(body, p, e, [&](const auto& sides, const auto& half_edge) { exit.pass(sides, half_edge); });
    if (exit.at > 0 && !(prism.height(p) + exit.at * dot(prism.normal(), e) > 0)) return inside(edge(h), face(f), distance2);
    if (exit.side == kNone) return {vertex(to), face(f), distance2};
    return {edge(h), edge(exit.side), distance2};
  }
  /// Where p + x e leaves a prism: at x = `at`, through `side`; not before x = 1 if that is kNone.
  struct Exit {
    double at = 1;
    std::uint32_t side = kNone;
    template <class Sides>
    void pass(const Sides& sides, const auto& half_edge) {
      int lane = -1;
      if (const unsigned outside = greater(sides.beyond, all(0)); outside != 0) {
        at = 0, lane = std::bit_width(outside) - 1;
      } else {
        for (unsigned leaving = greater(sides.beyond + sides.slope, all(0)); leaving != 0; leaving &= leaving - 1) {
          const int i = std::countr_zero(leaving);
          const double beyond = sides.beyond[i], slope = sides.slope[i];
          if (-beyond < at * slope) at = -beyond / slope, lane = i;
        }
      }
      if (lane >= 0) side = half_edge(lane);
    }
  };
  template <class Q>
  [[gnu::noinline, gnu::flatten]] Exit exit_by_any(const Q& body, const Prism<Q>& prism, Vec p, Vec e) {
    Exit exit;
    walk_.plane_tests +=
        prism.each_side(body, vec4(p), vec4(e), [&](const auto& sides, const auto& half_edge) { exit.pass(sides, half_edge); });
    return exit;
  }
  /// The same by sides near the one that the walk was near before.
  template <class Q>
  [[gnu::noinline, gnu::flatten]] Exit exit_nearby(const Q& body, const Prism<Q>& prism, Vec p, Vec e) {
    Exit exit;
    std::uint32_t& side = border(body).side;
    side = prism.nearest_side(body, side, vec4(p), vec4(e), [&](const auto& seen, std::uint32_t half_edge) {
      ++walk_.plane_tests;
      if (seen.beyond > 0)
        exit = {0, half_edge};
      else if (seen.beyond + seen.slope > 0 && -seen.beyond < exit.at * seen.slope)
        exit = {-seen.beyond / seen.slope, half_edge};
    });
    if (exit.side != kNone) side = exit.side;
    return exit;
  }

  const PairView& pair_;
  const bool first_only_;
  Walk& walk_;
  std::array<Border, 2> borders_;  ///< of A's face and of B's
};

/// Runs the state of a feature pair. A face with an edge or a face is no state: a vertex or an edge of one is as near.
template <class A, class B>
Move state(Marcher& march, const A& a, FeatureId fa, const B& b, FeatureId fb) {
  using enum FeatureKind;
  const std::uint32_t i = fa.index(), j = fb.index();
  switch (fa.kind()) {
    case Vertex:
      if (fb.kind() == Vertex) return march.vertex_vertex(a, i, b, j);
      if (fb.kind() == Edge) return march.vertex_edge(a, i, b, j);
      return march.vertex_face(a, i, b, j);
    case Edge:
      if (fb.kind() == Vertex) return march.swapped(march.vertex_edge(b, j, a, i));
      return march.edge_edge(a, i, b, j);
    default: return march.swapped(march.vertex_face(b, j, a, i));
  }
}

/// As `walk`.
[[gnu::flatten]] Walk walked(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  Walk result;
  if (a.kind() == FeatureKind::Edge && b.kind() == FeatureKind::Face) a = vertex(origin(pair.a, a.index()));
  if (b.kind() == FeatureKind::Edge && a.kind() == FeatureKind::Face) b = vertex(origin(pair.b, b.index()));
  Marcher march(pair, rule, result);
  const Resting4 resting(pair);
  const Moved4 moved(pair);
  double least2 = kUnknown;
  std::uint32_t stalled = 0;
  for (;;) {
    const Move move = state(march, resting, a, moved, b);
    const bool stays = move.first == a && move.second == b;
    a = move.first, b = move.second;
    result.steps += !stays;
    if (result.end != WalkEnd::Budget || result.steps >= step_budget) break;
    stalled = move.distance2 < least2 ? 0 : stalled + 1;
    least2 = min(least2, move.distance2);
    if (stalled < kStallLimit) continue;
    result.end = WalkEnd::Stalled;
    break;
  }
  result.a = a, result.b = b;
  return result;
}

}  // namespace
}  // namespace swiftlet
