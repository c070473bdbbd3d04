// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Voronoi marching [Ehmann & Lin 2000, sec. 5.1]. Each state finds the nearest points of its two closed features. If a point is
// on its feature's boundary, the walk drops to that boundary feature. Else it goes to the neighbour that rises highest along
// the direction between the points. If both features have one that rises, two vertices go to the one on the way to which the
// distance falls faster and two edges over the face that rises higher; of an edge and a vertex the faces beside the edge are
// asked first, as they cost less. Mirrored states run with the roles swapped.
//
//     VV  --ring-->  VE  --ring-->  EE  --face--> over the face
//     VV <--clamp--  VE <--clamp--  EE
//                    VE --face-->   VF  --ring--> over the face: to VF, EE with a side of it, or Inside
//                    VE <--side---  VF
//
// Differences from the paper: nearest points on closed features instead of clipped intervals with derivatives, so that no state
// carries values from the one before (the paper's stale values loop); vertex to vertex in one step where the distance falls
// along the whole edge; an edge is followed over a face and down to where it ends in one step, so that edge and face are no
// state; out of a face over the side that is nearest, as the one that is passed by most may end far away.
//
// So each step leads to features that are nearer, or as near and of fewer dimensions, and a walk ends. Not where a walk that
// comes back over a face of more than `kManySides` sides looks at a few of them only, between flat bodies, whose two sides are
// in one place, and where faces are flat up to rounding only.
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
};

constexpr double kUnknown = kInfinity;

/// A vertex compared with its ring along a direction.
struct RingScan {
  double height;  ///< how far the highest neighbour rises above the vertex, times the direction's length
  double error;   ///< the distance falls on the way to a neighbour that rises more than this
  std::uint32_t tests;
  std::uint32_t known;  ///< the half-edge that leads to the highest neighbour; kNone: it is in these lanes
  Vec4 some, others;    ///< the heights of four half-edges from `first` on, and from `further` beyond
  Vec4 highest;         ///< of all, in each lane
  std::uint32_t first, further;
  std::uint32_t to() const {
    if (known != kNone) return known;
    return first + std::uint32_t(std::countr_zero(equal(some, highest) | equal(others, highest) << further));
  }
  bool falls() const { return height > error; }
  /// The body rises no more than this above the vertex along the direction at length 1; infinite if unknown.
  double over() const { return height < -error ? 0 : kUnknown; }
};

/// An edge compared with the faces beside it along a direction.
struct SideScan {
  double left_rise, right_rise;  ///< how far the neighbouring corners rise above the edge, times the direction's length
  std::uint32_t right;           ///< the edge from the half-edge's origin to the right one
  double height() const { return max(left_rise, right_rise); }
  bool falls() const { return height() > 0; }
  /// As RingScan::over, of a direction that misses a right angle to the edge by a sine of at most `tilt` and has `length_1`.
  /// The direction along which the heights were taken misses that right angle by at most `scanned`.
  double over(double tilt, double scanned, double reach, double length_1) const {
    // At a right angle to the edge the corners are below too if they are by more than the tilt and rounding can lift them.
    return height() < -(scanned * reach + kBesideError * reach) * length_1 ? tilt * reach : kUnknown;
  }
  double over(double tilt, double reach, double length_1) const { return over(tilt, tilt, reach, length_1); }
};

/// A neighbour that rises.
struct Rise {
  std::uint32_t to;                                           ///< a half-edge of the vertex's ring
  double height;                                              ///< as that of the scan
  double length2;                                             ///< squared length of the way to the neighbour
  double rate2() const { return height / length2 * height; }  ///< squared rate at which the distance falls
};

using Ending = NearestOf<Vec4>;

/// Whether features that are `apart` are near enough to end a walk: if `early`, from a squared distance on, else never.
template <bool early>
struct Enough {
  explicit Enough(double of) : distance2(of) {}
  bool operator()(const Vec4& apart) const { return dot(apart, apart) <= distance2; }
  const double distance2;
};
template <>
struct Enough<false> {
  explicit Enough(double) {}
  bool operator()(const Vec4&) const { return false; }
};

/// All states are one function, which keeps a marcher and its bodies in registers as long as no other knows their addresses:
/// what is no part of it gets copies, and returns what it found. Vectors here are no constants, which g++ 12 keeps in memory.
/// `Seen` is NearestOf<Vec4> or <Padded>. If `early`, vertices, edges and triangles near enough end the walk, before anything
/// beside them is looked at.
template <class Seen, bool early = false, PlaneRule rule = PlaneRule::MostViolated>
class Marcher {
 public:
  /// The state that ends the walk in a minimum, or near enough, writes `seen`.
  explicit Marcher(const PairView& pair, Seen& seen, double enough2 = -1) : pair_(pair), seen_(seen), is_enough_(enough2) {}

  WalkEnd ended() const { return ended_; }
  std::uint32_t plane_tests() const { return plane_tests_; }

  template <class P, class Q>
  Move vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
    Vec4 p = a.point(va), q = b.point(vb), d = q - p;
    const double length_1 = norm_1(d);
    if (is_enough_(d)) return end_early(a, p, q, 0), Move{vertex(va), vertex(vb)};
    RingScan at_a = ring(a, va, a.into(d), length_1), at_b = ring(b, vb, b.into(-d), length_1);
    if (!at_a.falls() && !at_b.falls()) [[likely]] {
      end(a, {d, d, p, q, 0, at_a.over(), at_b.over(), {va, va, va}, {vb, vb, vb}});
      return {vertex(va), vertex(vb)};
    }
    if (!at_b.falls()) return {along(a, up_ring(a, va, at_a)), vertex(vb)};
    Rise from_b = up_ring(b, vb, at_b);
    if (!at_a.falls()) return {vertex(va), along(b, from_b)};
    Rise from_a = up_ring(a, va, at_a);
    if (from_a.rate2() > from_b.rate2()) return {along(a, from_a), edge(from_b.to)};
    return {edge(from_a.to), along(b, from_b)};
  }

  /// If `is_level`, what rises beside the features does so by rounding only.
  template <bool is_level = false, class P, class Q>
  Move vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
    const std::uint32_t v0 = origin(b.view, h), v1 = b.view.half_edges[h].head;
    Vec4 own = b.own(v0), p = a.point(va), q0 = b.point(v0), u = b.way(b.own(v1) - own), r = p - q0;
    const double length2 = dot(u, u), ru = dot(r, u);
    plane_tests_ += 2;
    if (!(ru > 0)) return {vertex(va), vertex(v0)};
    if (ru >= length2) return {vertex(va), vertex(v1)};
    Vec4 up = across(r, u, length2);
    const double length_1 = norm_1(up);
    if (is_enough_(up)) {
      end_early(a, p, q0 + u * (ru / length2), blur_on<Q>(u));
      return {vertex(va), edge(h)};
    }
    SideScan at_b = sides(b, v0, h, b.into(up), plane_tests_);
    if (!is_level && at_b.falls()) return {vertex(va), face(up_side(b, h, at_b))};
    RingScan at_a = ring(a, va, a.into(-up), length_1);
    if (is_level || !at_a.falls()) [[likely]] {
      const double over_b = at_b.over(kAcrossError + Q::kWay, b.reach, length_1);
      end(a, {-up, -r, p, q0 + u * (ru / length2), blur_on<Q>(u), at_a.over(), over_b, {va, va, va}, {v0, v1, v1}});
      return {vertex(va), edge(h)};
    }
    return {along(a, up_ring(a, va, at_a)), edge(h)};
  }

  template <class P, class Q>
  Move vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
    Prism prism(b, f);
    Vec4 p = a.point(va);
    Look look = leave(b, prism, f, p, false);
    if (look.side != kNone) return {vertex(va), edge(look.side)};
    const Vec4& n = prism.normal();
    const double height = prism.height(p);
    if (!(height > 0)) {
      const std::uint32_t below = height < 0 ? other_side(b.view, f) : kNone;
      return below == kNone ? inside(vertex(va), face(f)) : Move{vertex(va), face(below)};
    }
    if (early && prism.is_triangle() && is_enough_(n * (height / dot(n, n)))) {
      Ending seen{-n, prism.corner() - p, p, p, 0, kUnknown, kUnknown, kNoCorners, kNoCorners};
      foot_on_facet(b, prism, seen);
      end_early(a, p, seen.point_b, seen.blur);
      return {vertex(va), face(f)};
    }
    RingScan below = ring(a, va, a.into(-n), norm_1(n));
    if (!below.falls()) [[likely]] {
      if (!look.at_all) {
        look = leave(b, prism, f, p, true);  // a minimum is to be tested by all
        if (look.side != kNone) return {vertex(va), edge(look.side)};
      }
      Ending seen{-n, prism.corner() - p, p, p, 0, below.over(), kUnknown, {va, va, va}, kNoCorners};
      if (prism.is_triangle())
        foot_on_facet(b, prism, seen);
      else if (foot_on_face(b, prism, f, height, look.well_inside, seen))
        // A facet within a face has a direction of its own.
        seen.over_a = ring(a, va, a.into(seen.normal), norm_1(seen.normal)).over();
      end(a, seen);
      return {vertex(va), face(f)};
    }
    const std::uint32_t h = below.to(), to = a.view.half_edges[h].head;
    return over_face(h, to, p, a.way(a.own(to) - a.own(va)), b, prism, f);
  }

  template <bool is_level = false, class P, class Q>
  Move edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
    const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.half_edges[ha].head, b0 = origin(b.view, hb),
                        b1 = b.view.half_edges[hb].head;
    Vec4 p0 = a.point(a0), u = a.way(a.own(a1) - a.own(a0)), q0 = b.point(b0), v = b.way(b.own(b1) - b.own(b0));
    const double uu = dot(u, u), vv = dot(v, v);
    Parameters at = nearest_on_segments(p0, u, uu, q0, v, vv);
    Vec4 p = p0 + u * at.s, q = q0 + v * at.t, d = q - p;
    plane_tests_ += 4;
    if (is_enough_(d)) {
      end_early(a, p, q, blur_on<P>(u) + blur_on<Q>(v));
      return {edge(ha), edge(hb)};
    }
    const bool end_a = at.ends_first(), end_b = at.ends_second();
    if (end_a || end_b) [[unlikely]] {
      return {end_a ? vertex(at.s == 0 ? a0 : a1) : edge(ha), end_b ? vertex(at.t == 0 ? b0 : b1) : edge(hb)};
    }
    auto [n, tilt_u, tilt_v] = between_edges(u, uu, v, vv, d);
    SideScan at_a = sides(a, a0, ha, a.into(n), plane_tests_), at_b = sides(b, b0, hb, b.into(-n), plane_tests_);
    if (is_level || (!at_a.falls() && !at_b.falls())) [[likely]] {
      const double length_1 = norm_1(n);
      double over_a = at_a.over(tilt_u + P::kWay, a.reach, length_1), over_b = at_b.over(tilt_v + Q::kWay, b.reach, length_1);
      if (tilt_u > kLeastTilt && tilt_u < kMostTilt) {
        const double turned = kRightedTurn * tilt_u,
                     right_a = at_a.over(kAcrossError + P::kWay, turned + P::kWay, a.reach, length_1),
                     right_b = at_b.over(kAcrossError + Q::kWay, turned + Q::kWay, b.reach, length_1);
        if (max(right_a, right_b) < kUnknown) n = righted(n, u, uu, v, vv), over_a = right_a, over_b = right_b;
      }
      end(a, {n, q0 - p0, p, q, blur_on<P>(u) + blur_on<Q>(v), over_a, over_b, {a0, a1, a1}, {b0, b1, b1}});
      return {edge(ha), edge(hb)};
    }
    if (at_a.falls() && (first_only_ || at_a.height() >= at_b.height()))
      return swapped(edge_over_face(hb, b0, b1, q, v, at.t, a, up_side(a, ha, at_a), ha));
    return edge_over_face(ha, a0, a1, p, u, at.s, b, up_side(b, hb, at_b), hb);
  }

  static Move swapped(const Move& m) { return {m.second, m.first}; }

 private:
  /// Ends the walk in a minimum. The first argument is the state's first body; `seen` has the bodies in the state's order.
  void end(const Resting4&, const Ending& seen, WalkEnd as = WalkEnd::Minimum) { end(seen, as); }
  void end(const Moved4&, const Ending& seen, WalkEnd as = WalkEnd::Minimum) {
    end({-seen.normal, -seen.apart, seen.point_b, seen.point_a, seen.blur, seen.over_b, seen.over_a, seen.corners_b,
         seen.corners_a},
        as);
  }
  void end(const Ending& seen, WalkEnd as) {
    store(seen, seen_);
    ended_ = as;
  }
  /// Ends the walk at points of its features.
  template <class P>
  void end_early(const P& first, const Vec4& p, const Vec4& q, double blur) {
    end(first, {q - p, q - p, p, q, blur, kUnknown, kUnknown, kNoCorners, kNoCorners}, WalkEnd::Enough);
  }
  Move inside(FeatureId first, FeatureId second) {
    ended_ = WalkEnd::Inside;
    return {first, second};
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
    RingScan scan = highest_neighbour(body.view, body.view.vertices[v], own, error);
    plane_tests_ += scan.tests;
    return scan;
  }

  /// The highest neighbour of a vertex along `own`: of four to eight by twice four, of which some are the same.
  RingScan highest_neighbour(const ConvexView& view, const Vertex& vertex, const Vec4& own, double error) const {
    const double height = own[0] * vertex.x + own[1] * vertex.y + own[2] * vertex.z;
    const std::uint32_t begin = vertex.ring_begin, further = vertex.ring_count - 4;
    if (first_only_ || further > 4) [[unlikely]] {
      const Neighbour found = one_by_one(view, vertex, vec(own), height, error, first_only_);
      return {found.height, error, found.tests, found.to, all(0), all(0), all(0), 0, 0};
    }
    const Vertex* vertices = view.vertices.data();
    const HalfEdge* h = view.half_edges.data() + begin;
    const auto heights = [&](const HalfEdge* g) {
      return dot(repeated(own), transposed(vertices[g[0].head], vertices[g[1].head], vertices[g[2].head], vertices[g[3].head]));
    };
    Vec4 some = heights(h), others = heights(h + further), highest = all_greatest(max(some, others));
    return {highest[0] - height, error, vertex.ring_count, kNone, some, others, highest, begin, further};
  }

  struct Neighbour {
    double height;     ///< above the vertex
    std::uint32_t to;  ///< the half-edge that leads to it
    std::uint32_t tests;
  };
  /// The same for any ring, and for the first neighbour that is higher than the vertex by more than `error`.
  [[gnu::noinline, gnu::flatten]] static Neighbour one_by_one(const ConvexView& view, const Vertex& vertex, Vec own,
                                                              double height, double error, bool first_only) {
    const std::uint32_t begin = vertex.ring_begin, end = begin + vertex.ring_count;
    double highest = -kUnknown;
    std::uint32_t to = kNone, h = begin;
    for (; h != end; ++h) {
      const double other = dot(own, vec(view.vertices[view.half_edges[h].head]));
      to = other > highest ? h : to;
      highest = max(highest, other);
      if (first_only && highest - height > error) break;
    }
    return {highest - height, to, h - begin + (h != end)};
  }

  /// The way to the neighbour of a vertex that a scan found.
  template <class P>
  static Rise up_ring(const P& body, std::uint32_t v, const RingScan& scan) {
    const std::uint32_t to = scan.to();
    Vec4 e = body.own(body.view.half_edges[to].head) - body.own(v);
    return {to, scan.height, dot(e, e)};
  }

  /// Where the fall along the edge `ring.to` ends: the edge, or the vertex at its head if the distance falls up to there.
  template <class P>
  static FeatureId along(const P& body, const Rise& ring) {
    return ring.height >= ring.length2 ? vertex(body.view.half_edges[ring.to].head) : edge(ring.to);
  }

  /// Compares edge `h`, which begins at vertex `v0`, with the faces beside it along `own`, in the body's own frame: with their
  /// other edges at `v0`.
  template <class Q>
  static SideScan sides(const Q& body, std::uint32_t v0, std::uint32_t h, const Vec4& own, std::uint32_t& tests) {
    const Vertex& record = body.view.vertices[v0];
    const std::uint32_t left = counter_clockwise(record, h), right = clockwise(record, h);
    if (left == h) return {-kUnknown, -kUnknown, kNone};  // a segment
    tests += 2;
    Vec4 q0 = vec4(record), to_left = body.own(body.view.half_edges[left].head) - q0,
         to_right = body.own(body.view.half_edges[right].head) - q0;
    const Vec2 rises = dots(own, to_left, own, to_right);
    return {rises[0], rises[1], right};
  }

  /// The face beside edge `h` that rises, by a scan.
  template <class Q>
  std::uint32_t up_side(const Q& body, std::uint32_t h, const SideScan& scan) const {
    const bool is_left = scan.left_rise > (first_only_ ? 0 : scan.right_rise);
    return body.view.half_edges[is_left ? h : scan.right].face;
  }

  /// A face of many sides that the walk has looked at, and the side that it is near.
  struct Border {
    std::uint32_t face = kNone, side = kNone;
  };
  template <class Q>
  Border& border(const Q&) {
    return borders_[std::is_same_v<Q, Moved4>];
  }
  template <class Q>
  static bool is_rim(const Q& body, std::uint32_t f) {
    return f < body.view.rims && !first_only_;
  }
  /// How far the point below another may be from where own coordinates show it.
  double foot_margin() const { return (kFootError + kFootTurn * pair_.pose_error) * pair_.magnitude; }
  /// Looks where `p` is over face `f`: of many sides, unless it has to at all, only at those that the walk was near before.
  template <class Q>
  Look leave(const Q& body, const Prism<Q>& prism, std::uint32_t f, const Vec4& p, bool all_sides) {
    Border& known = border(body);
    Look look;
    if (prism.is_triangle()) {
      double nearness = 0;
      look.tests = 3;
      prism.each_side(p, all(0), [&](const Sides& sides, const auto& half_edge) {
        go_out<first_only_>(sides, half_edge, nearness, look.side);
      });
    } else {
      look =
          prism.polygon(is_rim(body, f))
              .template look<first_only_>(vec(body.local(p)), foot_margin(), all_sides || known.face != f ? kNone : known.side);
      if (look.nearest != kNone) known = {f, look.nearest};
    }
    plane_tests_ += look.tests;
    return look;
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
      Facet found = search_facets<Q>(body, prism.first(), seen);
      seen = found.seen;
      plane_tests_ += found.tests;
      return true;
    }
    if (!well_inside) seen.over_b = kUnknown;
    return false;
  }

  /// Completes `seen` for the point below its first one in a triangle.
  template <class Q>
  static void foot_on_facet(const Q& body, const Prism<Q>& prism, Ending& seen) {
    const Vec4 &n = prism.normal(), &u = prism.u(), &v = prism.v();
    const double nn = dot(n, n), tilt = (2 * Q::kWay + kFlatError) * std::sqrt(dot(u, u) * dot(v, v) / nn);
    typename Prism<Q>::Beyond at = prism.beyond(seen.point_a - prism.corner());
    seen.point_b = prism.corner() + u * (-at.v / nn) + v * (-at.u / nn);
    seen.blur = (Q::kWay + kWeightError) * (norm_1(u) + norm_1(v));
    seen.over_b = tilt * body.reach;
    seen.corners_b = prism.corners();
  }

  struct Facet {
    Ending seen;
    std::uint32_t tests = 0;
  };
  /// Completes `seen` for the nearest point in a face made of several facets, of which `h` begins one: goes from facet to facet
  /// across the diagonals that the first point is beyond, to the triangle below it, or to the diagonal between two.
  template <class Q>
  [[gnu::noinline, gnu::flatten]] static Facet search_facets(Q body, std::uint32_t h, Ending seen) {
    seen.over_b = kUnknown;
    std::uint32_t from = kNone, tests = 0;
    for (int steps = 0; steps < kFacetSteps; ++steps) {
      Prism<Q> facet = Prism<Q>::over_facet(body, h);
      if (next_in_facet(body.view, next_in_facet(body.view, facet.second())) != h) break;  // no triangle
      std::uint32_t out = kNone;
      bool leaves_face = false;
      tests += 3;
      facet.each_side(seen.point_a, all(0), [&](const Sides& sides, const auto& half_edge) {
        Vec4 beyond = max(sides.beyond, all(0)), violation2 = beyond / sides.uu * beyond;
        const double most = greatest(violation2);
        if (most > 0) out = half_edge(std::countr_zero(equal(violation2, all(most))));
        for (int i = 0; i < 3; ++i) leaves_face |= sides.beyond[i] > 0 && !is_diagonal(body.view, half_edge(i));
      });
      seen.normal = -facet.normal();
      seen.apart = facet.corner() - seen.point_a;
      if (out == kNone) foot_on_facet(body, facet, seen);
      if (out != kNone && !leaves_face && out == from) tests += foot_on_diagonal(body, out, seen);
      if (out == kNone || leaves_face || out == from) break;
      from = h = body.view.half_edges[out].twin;
    }
    return {seen, tests};
  }

  /// Completes `seen` for the point of edge `h` that is nearest to its first one. Returns the number of tests.
  template <class Q>
  static std::uint32_t foot_on_diagonal(const Q& body, std::uint32_t h, Ending& seen) {
    const std::uint32_t tail = origin(body.view, h), head = body.view.half_edges[h].head;
    Vec4 q = body.point(tail), u = body.way(body.own(head) - body.own(tail)), r = seen.point_a - q;
    const double length2 = dot(u, u), s = dot(r, u) / length2;
    std::uint32_t tests = 0;
    if (!(s > 0 && s < 1)) return tests;
    Vec4 up = across(r, u, length2);
    const double over_b = sides(body, tail, h, body.into(up), tests).over(kAcrossError + Q::kWay, body.reach, norm_1(up));
    seen = {-up, -r, seen.point_a, q + u * s, blur_on<Q>(u), seen.over_a, over_b, seen.corners_a, {tail, head, head}};
    return tests;
  }

  /// Follows edge `h`, which leads from `tail` along u to `head`, from its point p at s over face `f`, which rises towards p
  /// beside its edge `from`.
  template <class Q>
  Move edge_over_face(std::uint32_t h, std::uint32_t tail, std::uint32_t head, const Vec4& p, const Vec4& u, double s,
                      const Q& body, std::uint32_t f, std::uint32_t from) {
    Prism prism(body, f);
    const bool forward = dot(prism.normal(), u) < 0;
    Move move = over_face(h, forward ? head : tail, p, u * (forward ? 1 - s : -s), body, prism, f, from);
    const std::uint32_t below = other_side(body.view, f);
    if (below == kNone || ended_ != WalkEnd::Inside || !(prism.height(p) < 0)) [[likely]]
      return move;
    ended_ = WalkEnd::Budget;  // the edge is below face `f` of a flat body, and so above its other face
    return {vertex(forward ? tail : head), face(below)};
  }

  /// Follows the part p + x e of edge `h` that falls towards face `f`, x from 0 to 1 at vertex `to`. Leads to `to` and the
  /// face, or to the edge and the side where it leaves the face's prism. The walk ends Inside if the edge gets below the face
  /// first.
  template <class Q>
  Move over_face(std::uint32_t h, std::uint32_t to, const Vec4& p, const Vec4& e, const Q& body, const Prism<Q>& prism,
                 std::uint32_t f, std::uint32_t from = kNone) {
    Exit exit;
    Border& known = border(body);
    if (prism.is_triangle()) {
      double nearness = 0;
      exit.tests = 3;
      prism.each_side(p, e, [&](const Sides& sides, const auto& half_edge) {
        exit.template pass<first_only_, false>(sides, half_edge, nearness);
      });
    } else {
      exit = prism.polygon(is_rim(body, f))
                 .template exit<first_only_>(
                     vec(body.local(p)), vec(body.into(e)), known.face == f ? known.side : kNone,
                     from == kNone || body.view.half_edges[from].face == f ? from : body.view.half_edges[from].twin);
      if (exit.nearest != kNone) known = {f, exit.nearest};
    }
    plane_tests_ += exit.tests;
    if (exit.at > 0 && !(prism.height(p) + exit.at * dot(prism.normal(), e) > 0)) return inside(edge(h), face(f));
    if (exit.side == kNone) return {vertex(to), face(f)};
    if (exit.at == 0 && from != kNone && (exit.side == from || exit.side == body.view.half_edges[from].twin))
      ended_ = WalkEnd::Stalled;
    return {edge(h), edge(exit.side)};
  }

  const PairView& pair_;
  Seen& seen_;
  [[no_unique_address]] const Enough<early> is_enough_;
  static constexpr bool first_only_ = rule == PlaneRule::FirstViolated;
  WalkEnd ended_ = WalkEnd::Budget;
  std::uint32_t plane_tests_ = 0;
  std::array<Border, 2> borders_;  ///< of A's face and of B's
};

/// True unless one feature is a face and the other an edge or a face, which have no state.
[[maybe_unused]] bool is_state(FeatureId a, FeatureId b) {
  return int(a.kind()) + int(b.kind()) <= int(FeatureKind::Vertex) + int(FeatureKind::Face);
}

/// Runs the state of a feature pair. A face with an edge or a face is no state: a vertex or an edge of one is as near.
template <class March, class A, class B>
Move state(March& march, const A& a, FeatureId fa, const B& b, FeatureId fb) {
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

/// Ends a walk that stalled at an edge and a vertex or an edge there, for a closer look to tell whether nothing rises beside
/// them. Slivers rise or fall by rounding, and lead a walk to and fro between them and their sides.
[[maybe_unused, gnu::noinline, gnu::cold]] void take_as_level(const PairView& pair, Walk& walk) {
  using enum FeatureKind;
  Marcher<Nearest> march(pair, walk.nearest);
  const Resting4 a(pair);
  const Moved4 b(pair);
  FeatureId fa = walk.a, fb = walk.b;
  if (fa.kind() == Face || fb.kind() == Face) {
    const Move side = state(march, a, fa, b, fb);
    fa = side.first, fb = side.second;
  }
  if (march.ended() == WalkEnd::Budget) {
    if (fa.kind() == Edge && fb.kind() == Edge) march.edge_edge<true>(a, fa.index(), b, fb.index());
    if (fa.kind() == Vertex && fb.kind() == Edge) march.vertex_edge<true>(a, fa.index(), b, fb.index());
    if (fa.kind() == Edge && fb.kind() == Vertex) march.vertex_edge<true>(b, fb.index(), a, fa.index());
  }
  walk.plane_tests += march.plane_tests();
  if (march.ended() == WalkEnd::Minimum) walk.end = WalkEnd::Minimum, walk.a = fa, walk.b = fb;
}

/// As `walk`, from features that have a state; only if `early` does `enough2` count.
template <bool early, PlaneRule rule = PlaneRule::MostViolated>
[[gnu::noinline, gnu::flatten]] Walk walked(const PairView& pair, FeatureId a, FeatureId b, std::uint32_t step_budget,
                                            double enough2 = -1) {
  Walk result;
  Marcher<Nearest, early, rule> march(pair, result.nearest, enough2);
  Resting4 resting(pair);
  Moved4 moved(pair);
  std::uint32_t steps = 0;
  FeatureId mark_a, mark_b;  // where the walk was after the last power of two of steps [Brent 1980]
  for (const std::uint32_t unwatched = std::min(step_budget, kUnwatchedSteps);;) {
    Move move = state(march, resting, a, moved, b);
    a = move.first, b = move.second;
    result.end = march.ended();
    if (result.end != WalkEnd::Budget) break;
    if (++steps < unwatched) continue;
    if (steps >= step_budget) break;
    if (a == mark_a && b == mark_b) {
      result.end = WalkEnd::Stalled;
      break;
    }
    if (std::has_single_bit(steps)) mark_a = a, mark_b = b;
  }
  result.a = a, result.b = b;
  result.steps = steps, result.plane_tests = march.plane_tests();
  if (result.end == WalkEnd::Stalled) take_as_level(pair, result);
  return result;
}

/// The same from any features and by any rule. The paper's is for comparison.
[[maybe_unused]] Walk walked_by(PlaneRule rule, const PairView& pair, FeatureId a, FeatureId b, std::uint32_t step_budget,
                                double enough2) {
  if (!is_state(a, b)) [[unlikely]] {
    if (a.kind() == FeatureKind::Edge)
      a = vertex(origin(pair.a, a.index()));
    else
      b = vertex(origin(pair.b, b.index()));
  }
  if (rule == PlaneRule::FirstViolated) [[unlikely]]
    return walked<true, PlaneRule::FirstViolated>(pair, a, b, step_budget, enough2);
  return enough2 >= 0 ? walked<true>(pair, a, b, step_budget, enough2) : walked<false>(pair, a, b, step_budget);
}

/// The same whose first state has led to `move`, after `plane_tests`, and `ended` the walk or not.
[[maybe_unused]] Walk walked_on(const PairView& pair, const Move& move, WalkEnd ended, std::uint32_t plane_tests,
                                std::uint32_t step_budget) {
  const bool goes_on = ended == WalkEnd::Budget || ended == WalkEnd::Stalled;
  Walk walk =
      goes_on ? walked<false>(pair, move.first, move.second, step_budget - 1) : Walk{ended, move.first, move.second, 0, 0, {}};
  walk.steps += goes_on, walk.plane_tests += plane_tests;
  return walk;
}

}  // namespace
}  // namespace swiftlet
