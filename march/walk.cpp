// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Each state finds the nearest points of its two closed features. A point on a feature's boundary drops to the boundary; else
// the feature rises to the neighbour in whose direction the distance falls fastest. Mirrored states run with the roles swapped.
//
//     VV  --ring-->  VE  --ring-->  EE  --face-->  EF  (passing: the edge is clipped to the face's prism)
//     VV <--clamp--  VE <--clamp--  EE              |
//                    VE --face-->   VF <------------+-- or EE with a side of the face, or Inside
//                    VE <--side---  VF --ring--> VF, EE with a side, or Inside
//
// Where we leave the paper: nearest points on closed features instead of clipped intervals with derivatives, so that no state
// carries values from the one before (its stale values looped); vertex to vertex in one step where the whole edge falls.
//
// A state is computed in the frame of its second body, and a ring in its own body's, so that of all points read only the
// first body's feature is carried over.
#include "walk.h"

#include <limits>

namespace swiftlet {
namespace {

constexpr Handle vertex(std::uint32_t index) { return {FeatureKind::Vertex, index}; }
constexpr Handle edge(std::uint32_t half_edge) { return {FeatureKind::Edge, half_edge}; }
constexpr Handle face(std::uint32_t index) { return {FeatureKind::Face, index}; }

/// Where a state leads: the next features, in the order of its arguments, or the end.
struct Move {
  Handle first, second;
  double distance2;  ///< between the features left, for the stall guard
  bool minimum = false, inside = false;
};

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// The way out of a feature along which the distance falls fastest.
struct Descent {
  std::uint32_t to = kNone;    ///< half-edge of a ring, or face
  double rate2 = 0;            ///< squared rate of fall, times the squared distance
  double reach = 0;            ///< for a ring: where on the edge the fall ends, 1 at its head
  double highest = -kUnknown;  ///< of what stands beside, along the direction; where nothing falls
};

class Marcher {
 public:
  /// `seen` becomes what a state that is a minimum sees.
  Marcher(PlaneRule rule, std::uint32_t& plane_tests, Witness& seen)
      : first_only_(rule == PlaneRule::FirstViolated), tests_(plane_tests), seen_(seen) {}

  template <class P, class Q>
  Move vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
    const Vec d = b.point(vb) - a.point(va);
    const Descent from_a = ring(a, va, a.into(d)), from_b = ring(b, vb, b.into(-d));
    const double distance2 = dot(d, d);
    if (from_a.to == kNone && from_b.to == kNone) {
      seen_ = {d, only(va), only(vb), from_a.highest, from_b.highest};
      return {vertex(va), vertex(vb), distance2, true};
    }
    if (from_b.to == kNone) return {along(a, from_a), vertex(vb), distance2};
    if (from_a.to == kNone) return {vertex(va), along(b, from_b), distance2};
    return {edge(from_a.to), edge(from_b.to), distance2};
  }

  template <class P, class Q>
  Move vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
    const std::uint32_t v0 = origin(b.view, h), v1 = b.view.head[h];
    const Vec q0 = b.own(v0), u = b.own(v1) - q0, r = b.local(a.point(va)) - q0;
    const double length2 = dot(u, u), s = dot(r, u) / length2;
    tests_ += 2;
    if (!(s > 0)) return {vertex(va), vertex(v0), dot(r, r)};
    if (s >= 1) return {vertex(va), vertex(v1), dot(r - u, r - u)};
    const Vec up = across(r - u * s, u, length2), down = b.turned(-up);
    const double distance2 = dot(up, up);
    const Descent rise = sides(b, v0, h, q0, u, length2, up);
    const Descent from_a = first_only_ && rise.to != kNone ? Descent{} : ring(a, va, a.into(down));
    if (rise.to == kNone && from_a.to == kNone) {
      seen_ = {down, only(va), between(v0, v1, s), from_a.highest, rise.highest};
      return {vertex(va), edge(h), distance2, true};
    }
    if (rise.rate2 > from_a.rate2) return {vertex(va), face(rise.to), distance2};
    return {along(a, from_a), edge(h), distance2};
  }

  template <class P, class Q>
  Move vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
    const Vec p = b.local(a.point(va)), n = face_normal(b, f), towards = b.turned(-n);
    if (const Descent out = leave(b, f, p, n); out.to != kNone) return {vertex(va), edge(out.to), kUnknown};
    const double height = dot(n, p - b.own(origin(b.view, b.view.face_first[f]))), distance2 = height * height / dot(n, n);
    if (!(height > 0)) return {vertex(va), face(f), distance2, false, true};
    const Descent down = ring(a, va, a.into(towards));
    if (down.to == kNone) {
      seen_ = {towards, only(va), below(b, f, p), down.highest, kUnknown};
      return {vertex(va), face(f), distance2, true};
    }
    const Vec e = b.local(a.point(a.view.head[down.to])) - p;
    const Exit exit = leave_along(b, f, p, e, n);
    if (!(height + exit.at * dot(n, e) > 0)) return {edge(down.to), face(f), distance2, false, true};
    if (exit.side == kNone) return {vertex(a.view.head[down.to]), face(f), distance2};
    return {edge(down.to), edge(exit.side), distance2};
  }

  template <class P, class Q>
  Move edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
    const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.head[ha], b0 = origin(b.view, hb), b1 = b.view.head[hb];
    const Vec own_a = a.own(a0), along_a = a.own(a1) - own_a;
    const Vec p0 = b.local(a.point(a0)), u = b.into(a.turned(along_a)), q0 = b.own(b0), v = b.own(b1) - q0;
    const double uu = dot(u, u), vv = dot(v, v);
    const Parameters at = nearest_on_segments(p0, u, uu, q0, v, vv);
    const Vec d = q0 + v * at.t - (p0 + u * at.s);
    const double distance2 = dot(d, d);
    tests_ += 4;
    const bool end_a = at.s == 0 || at.s == 1, end_b = at.t == 0 || at.t == 1;
    if (end_a || end_b) {
      return {end_a ? vertex(at.s == 0 ? a0 : a1) : edge(ha), end_b ? vertex(at.t == 0 ? b0 : b1) : edge(hb), distance2};
    }
    const Vec n = between_edges(u, uu, v, vv, d), normal = b.turned(n);
    const Descent rise_a = sides(a, a0, ha, own_a, along_a, dot(along_a, along_a), a.into(normal));
    const Descent rise_b = first_only_ && rise_a.to != kNone ? Descent{} : sides(b, b0, hb, q0, v, vv, -n);
    if (rise_a.to == kNone && rise_b.to == kNone) {
      seen_ = {normal, between(a0, a1, at.s), between(b0, b1, at.t), rise_a.highest, rise_b.highest};
      return {edge(ha), edge(hb), distance2, true};
    }
    if (rise_a.rate2 >= rise_b.rate2) return {face(rise_a.to), edge(hb), distance2};
    return {edge(ha), face(rise_b.to), distance2};
  }

  template <class P, class Q>
  Move edge_face(const P& a, std::uint32_t h, const Q& b, std::uint32_t f) {
    const Vec p = b.local(a.point(origin(a.view, h))), e = b.local(a.point(a.view.head[h])) - p, n = face_normal(b, f);
    double low = 0, high = 1, farthest2 = 0;
    std::uint32_t low_side = kNone, high_side = kNone, outside = kNone;
    each_side(b, f, [&](std::uint32_t side, const Vec& q, const Vec& u) {
      const Vec m = cross(u, n);
      const double at_tail = dot(p - q, m), at_head = at_tail + dot(e, m), crossing = at_tail / (at_tail - at_head);
      if (at_tail > 0 && at_head > 0) {
        const double nearer = smaller(at_tail, at_head), violation2 = nearer * nearer / dot(u, u);
        if (violation2 > farthest2) farthest2 = violation2, outside = side;
      } else if (at_tail > 0) {
        if (crossing > low) low = crossing, low_side = side;
      } else if (at_head > 0) {
        if (crossing < high) high = crossing, high_side = side;
      }
    });
    if (outside != kNone) return {edge(h), edge(outside), kUnknown};
    if (low > high) return {edge(h), edge(low_side != kNone ? low_side : high_side), kUnknown};
    const double height = dot(n, p - b.own(origin(b.view, b.view.face_first[f]))), slope = dot(n, e);
    const double height_low = height + low * slope, height_high = height + high * slope;
    if (!(height_low > 0 && height_high > 0)) return {edge(h), face(f), kUnknown, false, true};
    const bool take_low = height_low <= height_high;
    const std::uint32_t side = take_low ? low_side : high_side;
    if (side != kNone) return {edge(h), edge(side), kUnknown};
    return {vertex(take_low ? origin(a.view, h) : a.view.head[h]), face(f), kUnknown};
  }

  /// A state computed with the roles swapped.
  Move swapped(const Move& m) {
    if (m.minimum) seen_ = swiftlet::swapped(seen_);
    return {m.second, m.first, m.distance2, m.minimum, m.inside};
  }

 private:
  struct Exit {
    double at = 1;
    std::uint32_t side = kNone;
  };

  // From here on all is in the body's own frame.

  /// Among the edges of a vertex, the one that leads most steeply along `d`.
  template <class P>
  Descent ring(const P& body, std::uint32_t v, const Vec& d) {
    const Vertex& record = body.view.vertices[v];
    const Vec p = vec(record);
    std::uint32_t best = kNone;
    double best_along = 0, best_length2 = 1, highest = -kUnknown;
    const std::uint32_t end = record.ring_begin + record.ring_count;
    std::uint32_t h = record.ring_begin;
    for (; h < end; ++h) {
      const Vec e = body.own(body.view.head[h]) - p;
      const double along_d = dot(d, e);
      highest = larger(highest, along_d);
      if (!(along_d > 0)) continue;
      const double length2 = dot(e, e);
      if (along_d * along_d * best_length2 > best_along * best_along * length2)
        best = h, best_along = along_d, best_length2 = length2;
      if (first_only_) break;
    }
    tests_ += h - record.ring_begin + (h < end);
    if (best == kNone) return {.highest = highest};
    return {best, best_along * best_along / best_length2, best_along / best_length2};
  }

  template <class P>
  static Handle along(const P& body, const Descent& ring) {
    return ring.reach >= 1 ? vertex(body.view.head[ring.to]) : edge(ring.to);
  }

  /// Of the two faces beside an edge q0 + s u from vertex `v0`, the one that rises most steeply along `d`, which is
  /// perpendicular to u. A face is told by its other edge at that vertex.
  template <class Q>
  Descent sides(const Q& body, std::uint32_t v0, std::uint32_t h, const Vec& q0, const Vec& u, double length2, const Vec& d) {
    const Vertex& record = body.view.vertices[v0];
    const std::uint32_t left = counter_clockwise(record, h), right = clockwise(record, h);
    Descent best;
    if (left == h) return best;  // a segment
    for (const bool is_left : {true, false}) {
      const Vec r = body.own(body.view.head[is_left ? left : right]) - q0;
      const double along_d = dot(d, r);
      ++tests_;
      best.highest = larger(best.highest, along_d);
      if (!(along_d > 0)) continue;
      const double along_u = dot(r, u), rate2 = along_d * along_d / (dot(r, r) - along_u * along_u / length2);
      if (rate2 > best.rate2) best.to = body.view.face[is_left ? h : right], best.rate2 = rate2;
      if (first_only_) break;
    }
    return best;
  }

  /// Calls visit(half_edge, tail, direction) for each side of a face.
  template <class Q, class Visit>
  void each_side(const Q& body, std::uint32_t f, Visit visit) {
    const std::uint32_t first = body.view.face_first[f];
    std::uint32_t h = first;
    Vec tail = body.own(origin(body.view, first));
    do {
      const Vec head = body.own(body.view.head[h]);
      ++tests_;
      visit(h, tail, head - tail);
      tail = head;
      h = next_in_face(body.view, h);
    } while (h != first);
  }

  /// The side of the face's prism that `p` is farthest beyond.
  template <class Q>
  Descent leave(const Q& body, std::uint32_t f, const Vec& p, const Vec& n) {
    Descent best;
    each_side(body, f, [&](std::uint32_t side, const Vec& tail, const Vec& u) {
      const double beyond = dot(p - tail, cross(u, n));
      if (!(beyond > 0) || (first_only_ && best.to != kNone)) return;
      const double violation2 = beyond * beyond / dot(u, u);
      if (violation2 > best.rate2) best = {side, violation2};
    });
    return best;
  }

  /// Where the segment p + s e, which starts in the face's prism, leaves it.
  template <class Q>
  Exit leave_along(const Q& body, std::uint32_t f, const Vec& p, const Vec& e, const Vec& n) {
    Exit exit;
    each_side(body, f, [&](std::uint32_t side, const Vec& tail, const Vec& u) {
      const Vec m = cross(u, n);
      const double at_tail = smaller(dot(p - tail, m), 0.0), slope = dot(e, m);
      if (at_tail + slope > 0 && -at_tail < exit.at * slope) exit = {-at_tail / slope, side};
    });
    return exit;
  }

  const bool first_only_;
  std::uint32_t& tests_;
  Witness& seen_;
};

/// The state of a feature pair. Both faces is no state: a face pair has an edge or vertex pair that is as near.
template <class A, class B>
Move state(Marcher& march, const A& a, Handle fa, const B& b, Handle fb) {
  using enum FeatureKind;
  const std::uint32_t i = fa.index(), j = fb.index();
  switch (fa.kind()) {
    case Vertex:
      if (fb.kind() == Vertex) return march.vertex_vertex(a, i, b, j);
      if (fb.kind() == Edge) return march.vertex_edge(a, i, b, j);
      return march.vertex_face(a, i, b, j);
    case Edge:
      if (fb.kind() == Vertex) return march.swapped(march.vertex_edge(b, j, a, i));
      if (fb.kind() == Edge) return march.edge_edge(a, i, b, j);
      return march.edge_face(a, i, b, j);
    default:
      if (fb.kind() == Vertex) return march.swapped(march.vertex_face(b, j, a, i));
      return march.swapped(march.edge_face(b, j, a, i));
  }
}

}  // namespace

Walk walk(const Scene& scene, Handle a, Handle b, PlaneRule rule, std::uint32_t step_budget) {
  Walk result;
  result.a = a;
  result.b = b;
  Marcher march(rule, result.plane_tests, result.witness);
  double least2 = std::numeric_limits<double>::infinity();
  for (std::uint32_t stalled = 0;;) {
    const Move move = state(march, body_a(scene), result.a, body_b(scene), result.b);
    stalled = move.distance2 < least2 ? 0 : stalled + 1;
    least2 = smaller(least2, move.distance2);
    result.steps += !(move.first == result.a && move.second == result.b);
    result.a = move.first;
    result.b = move.second;
    if (move.minimum || move.inside || stalled >= kStallLimit || result.steps >= step_budget) {
      result.end = move.minimum             ? WalkEnd::Minimum
                   : move.inside            ? WalkEnd::Inside
                   : stalled >= kStallLimit ? WalkEnd::Stalled
                                            : WalkEnd::Budget;
      result.distance = std::sqrt(move.minimum ? move.distance2 : least2);
      return result;
    }
  }
}

}  // namespace swiftlet
