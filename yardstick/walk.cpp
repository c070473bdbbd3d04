// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Each state finds the nearest points of its two closed features. A point on a feature's boundary drops to the boundary; else
// the feature rises to the neighbour that is highest along the direction between them; where both features have one, on the way
// to which the distance falls faster. Mirrored states run with the roles swapped.
//
//     VV  --ring-->  VE  --ring-->  EE  --face--> over the face
//     VV <--clamp--  VE <--clamp--  EE
//                    VE --face-->   VF  --ring--> over the face: to VF, EE with a side of it, or Inside
//                    VE <--side---  VF
//
// Where we leave the paper: nearest points on closed features instead of clipped intervals with derivatives, so that no state
// carries values from the one before (its stale values looped); vertex to vertex in one step where the whole edge falls; an
// edge is taken over a face and down to where it ends in one step, so that the two are no state.
//
// A state is computed in the frame of its second body, and a ring in its own body's, so that of all points read only the
// first body's feature is carried over. Of a state's choices the likely ones are taken without branches, which processors
// would guess wrong every other time.
#include "walk.h"

#include <cmath>
#include <limits>

namespace swiftlet::yardstick {
namespace {

constexpr double kU = 0x1p-53;
/// States in a row that do not shorten the distance before a walk is given up. In exact arithmetic at most three (face, edge,
/// vertex) go by; twelve lets rounding waver on a flat spot.
constexpr std::uint32_t kStallLimit = 12;

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

/// The body at rest in the common frame, which is its own.
struct Resting {
  const ConvexView& view;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec common(const Vec& p) const { return p; }  ///< a point of its own frame in the common one
  Vec point(std::uint32_t v) const { return own(v); }
  Vec turned(const Vec& n) const { return n; }  ///< a direction of its own frame in the common one
  Vec local(const Vec& p) const { return p; }   ///< a point of the common frame in its own
  Vec into(const Vec& n) const { return n; }    ///< orders its own points as `n` orders their images
};
/// The body that the pose moves into it. `local` takes the pose for a rigid motion.
struct Moved {
  const ConvexView& view;
  const Motion& motion;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec common(const Vec& p) const { return apply(motion, p); }
  Vec point(std::uint32_t v) const { return common(own(v)); }
  Vec turned(const Vec& n) const { return turn(motion, n); }
  Vec local(const Vec& p) const { return turn_back(motion, p - motion.t); }
  Vec into(const Vec& n) const { return turn_back(motion, n); }
};

/// Above the plane of a face, between planes through its sides; all in the body's own frame.
template <class Body>
class Prism {
 public:
  Prism(Body body, std::uint32_t f)
      : body_(body),
        is_triangle_(f >= body.view.planes.size()),
        first_(body.view.face_first[f]),
        corner_(body.own(origin(body.view, first_))) {
    if (!is_triangle_) {
      normal_ = {body.view.planes[f].x, body.view.planes[f].y, body.view.planes[f].z};
      return;
    }
    second_ = next_in_facet(body.view, first_);
    u_ = body.own(body.view.half_edges[first_].head) - corner_;
    v_ = body.own(body.view.half_edges[second_].head) - corner_;
    normal_ = cross(u_, v_);
  }

  /// Outward, of any length.
  const Vec& normal() const { return normal_; }
  /// Of `p` above the face, times the normal's length.
  double height(const Vec& p) const { return dot(normal_, p - corner_); }

  /// Calls visit(half_edge, u, beyond, slope) for each side, u along it either way: how far p is beyond the prism's plane there
  /// and how much farther p + e, times the lengths of u and the normal. Returns how many there are.
  template <class Visit>
  std::uint32_t each_side(const Vec& p, const Vec& e, Visit visit) const {
    return is_triangle_ ? each_of_three(p, e, visit) : each_of_many(p, e, visit);
  }

 private:
  template <class Visit>
  std::uint32_t each_of_many(const Vec& p, const Vec& e, Visit visit) const {
    std::uint32_t h = first_, count = 0;
    Vec tail = corner_;
    do {
      const Vec head = body_.own(body_.view.half_edges[h].head), u = head - tail, out = cross(u, normal_);
      visit(h, u, dot(p - tail, out), dot(e, out));
      tail = head;
      h = next_in_face(body_.view, h);
      ++count;
    } while (h != first_);
    return count;
  }

  /// The sum of what a point is beyond the three sides is the same for all.
  template <class Visit>
  std::uint32_t each_of_three(const Vec& p, const Vec& e, Visit visit) const {
    const Vec across_p = cross(normal_, p - corner_), across_e = cross(normal_, e);
    const double beyond_u = dot(u_, across_p), beyond_v = -dot(v_, across_p);
    const double slope_u = dot(u_, across_e), slope_v = -dot(v_, across_e);
    visit(first_, u_, beyond_u, slope_u);
    visit(second_, v_ - u_, -(beyond_u + beyond_v + dot(normal_, normal_)), -(slope_u + slope_v));
    visit(next_in_facet(body_.view, second_), v_, beyond_v, slope_v);
    return 3;
  }

  const Body body_;
  const bool is_triangle_;
  const std::uint32_t first_;
  std::uint32_t second_ = kNone;  ///< of a triangle's sides
  const Vec corner_;
  Vec u_{0, 0, 0}, v_{0, 0, 0};  ///< a triangle's, from the corner to the others
  Vec normal_;
};

// ---- Witnesses -------------------------------------------------------------------------------------------------------------

Combination only(std::uint32_t v) { return {{v, v, v}, {1, 0, 0}}; }
Combination between(std::uint32_t tail, std::uint32_t head, double t) {
  if (t == 0) return only(tail);
  if (t == 1) return only(head);
  return {{tail, head, head}, {1 - t, t, 0}};
}

Witness swapped(const Witness& w) { return {-w.normal, w.second, w.first, w.rise_second, w.rise_first}; }

/// `d` without its part along `u`, of squared length `uu`.
Vec across(const Vec& d, const Vec& u, double uu) { return d - u * (dot(d, u) / uu); }

/// The direction from one edge's line to another's, along `u` and `v`, on the side of `d`, which is between them.
Vec between_edges(const Vec& u, double uu, const Vec& v, double vv, const Vec& d) {
  const Vec n = cross(u, v);
  // Edges within the rounding of parallel have no cross product worth the name.
  return !(dot(n, n) > kU * uu * vv) ? across(d, u, uu) : dot(n, d) < 0 ? -n : n;
}

/// Nearest points p0 + s u and q0 + t v of two segments.
struct Parameters {
  double s, t;  ///< in [0, 1]
};
/// [Ericson 2004, sec. 5.1.9], and s once more from t, so that nearly parallel lines keep their difference perpendicular.
Parameters nearest_on_segments(const Vec& p0, const Vec& u, double uu, const Vec& q0, const Vec& v, double vv) {
  const auto clamp = [](double x) { return smaller(1, larger(0, x)); };
  const Vec r = p0 - q0;
  const double uv = dot(u, v), ur = dot(u, r), vr = dot(v, r), area2 = uu * vv - uv * uv;
  const double s = area2 > 0 ? clamp((uv * vr - ur * vv) / area2) : 0.0, t = clamp((uv * s + vr) / vv);
  return {clamp((uv * t - ur) / uu), t};
}

/// The point of a face below `p`, both in the body's own frame. A point beside the face goes to the last triangle of its fan.
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
      const double c0 = larger(w0, 0), c1 = larger(w1, 0), c2 = larger(w2, 0), sum = c0 + c1 + c2;
      if (!(sum > 0)) return only(root);
      return {{root, v1, v2}, {c0 / sum, c1 / sum, c2 / sum}};
    }
  }
}

// ---- States ----------------------------------------------------------------------------------------------------------------

constexpr FeatureId vertex(std::uint32_t index) { return {FeatureKind::Vertex, index}; }
constexpr FeatureId edge(std::uint32_t half_edge) { return {FeatureKind::Edge, half_edge}; }
constexpr FeatureId face(std::uint32_t index) { return {FeatureKind::Face, index}; }

/// Where a state leads: the next features, in the order of its arguments. A minimum leads to itself.
struct Move {
  FeatureId first, second;
  double distance2;  ///< between the features left, for the stall guard
};

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// What rises highest along a direction of all that stands beside a feature: the distance falls on the way there if it is above
/// the feature.
struct Rise {
  std::uint32_t to = kNone;    ///< half-edge of a ring, or face
  double highest = -kUnknown;  ///< what it rises, times the direction's length
  double length2 = 1;          ///< of the way there, squared
  bool falls() const { return highest > 0; }
  /// Of the fall, squared; less than any where there is none. Of slivers rounding leaves a length of 0 or less.
  double rate2() const { return falls() ? highest * highest / larger(std::numeric_limits<double>::denorm_min(), length2) : -1; }
};

class Marcher {
 public:
  /// States read and end `walk`.
  Marcher(PlaneRule rule, Walk& walk) : first_only_(rule == PlaneRule::FirstViolated), walk_(walk) {}

  template <class P, class Q>
  Move vertex_vertex(P a, std::uint32_t va, Q b, std::uint32_t vb) {
    const Vec d = b.point(vb) - a.point(va);
    const Rise from_a = ring(a, va, a.into(d)), from_b = ring(b, vb, b.into(-d));
    const double distance2 = dot(d, d);
    if (from_a.falls() && from_b.falls()) {
      if (from_a.rate2() > from_b.rate2()) return {along(a, from_a), edge(from_b.to), distance2};
      return {edge(from_a.to), along(b, from_b), distance2};
    }
    if (from_a.falls()) return {along(a, from_a), vertex(vb), distance2};
    if (from_b.falls()) return {vertex(va), along(b, from_b), distance2};
    end(a, {d, only(va), only(vb), from_a.highest, from_b.highest});
    return {vertex(va), vertex(vb), distance2};
  }

  template <class P, class Q>
  Move vertex_edge(P a, std::uint32_t va, Q b, std::uint32_t h) {
    const std::uint32_t v0 = origin(b.view, h), v1 = b.view.half_edges[h].head;
    const Vec q0 = b.own(v0), u = b.own(v1) - q0, r = b.local(a.point(va)) - q0;
    const double length2 = dot(u, u), s = dot(r, u) / length2;
    walk_.plane_tests += 2;
    if (!(s > 0)) return {vertex(va), vertex(v0), dot(r, r)};
    if (s >= 1) return {vertex(va), vertex(v1), dot(r - u, r - u)};
    const Vec up = across(r - u * s, u, length2), down = b.turned(-up);
    const double distance2 = dot(up, up);
    const Rise rise = sides(b, v0, h, q0, u, up);
    if (first_only_ && rise.falls()) return {vertex(va), face(rise.to), distance2};
    const Rise from_a = ring(a, va, a.into(down));
    if (!rise.falls() && !from_a.falls()) {
      end(a, {down, only(va), between(v0, v1, s), from_a.highest, rise.highest});
      return {vertex(va), edge(h), distance2};
    }
    if (rise.rate2() > from_a.rate2()) return {vertex(va), face(rise.to), distance2};
    return {along(a, from_a), edge(h), distance2};
  }

  template <class P, class Q>
  Move vertex_face(P a, std::uint32_t va, Q b, std::uint32_t f) {
    const Prism prism(b, f);
    const Vec p = b.local(a.point(va));
    if (const std::uint32_t side = leave(prism, p); side != kNone) return {vertex(va), edge(side), kUnknown};
    const double height = prism.height(p), distance2 = height * height / dot(prism.normal(), prism.normal());
    if (!(height > 0)) return inside(vertex(va), face(f), distance2);
    const Vec towards = b.turned(-prism.normal());
    const Rise down = ring(a, va, a.into(towards));
    if (!down.falls()) {
      end(a, {towards, only(va), below(b, f, p), down.highest, kUnknown});
      return {vertex(va), face(f), distance2};
    }
    const std::uint32_t to = a.view.half_edges[down.to].head;
    return over_face(down.to, to, p, b.local(a.point(to)) - p, prism, f, distance2);
  }

  template <class P, class Q>
  Move edge_edge(P a, std::uint32_t ha, Q b, std::uint32_t hb) {
    const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.half_edges[ha].head, b0 = origin(b.view, hb),
                        b1 = b.view.half_edges[hb].head;
    const Vec own_a = a.own(a0), along_a = a.own(a1) - own_a;
    const Vec p0 = b.local(a.point(a0)), u = b.into(a.turned(along_a)), q0 = b.own(b0), v = b.own(b1) - q0;
    const double uu = dot(u, u), vv = dot(v, v);
    const Parameters at = nearest_on_segments(p0, u, uu, q0, v, vv);
    const Vec p = p0 + u * at.s, q = q0 + v * at.t, d = q - p;
    const double distance2 = dot(d, d);
    walk_.plane_tests += 4;
    const bool end_a = at.s == 0 || at.s == 1, end_b = at.t == 0 || at.t == 1;
    if (end_a || end_b) {
      return {end_a ? vertex(at.s == 0 ? a0 : a1) : edge(ha), end_b ? vertex(at.t == 0 ? b0 : b1) : edge(hb), distance2};
    }
    const Vec n = between_edges(u, uu, v, vv, d), normal = b.turned(n);
    const Rise rise_a = sides(a, a0, ha, own_a, along_a, a.into(normal));
    const Rise rise_b = first_only_ && rise_a.falls() ? Rise{} : sides(b, b0, hb, q0, v, -n);
    if (!rise_a.falls() && !rise_b.falls()) {
      end(a, {normal, between(a0, a1, at.s), between(b0, b1, at.t), rise_a.highest, rise_b.highest});
      return {edge(ha), edge(hb), distance2};
    }
    if (rise_a.rate2() >= rise_b.rate2())
      return swapped(edge_over_face(hb, b0, b1, a.local(b.common(q)), a.into(b.turned(v)), at.t, a, rise_a.to, distance2));
    return edge_over_face(ha, a0, a1, p, u, at.s, b, rise_b.to, distance2);
  }

  static Move swapped(const Move& m) { return {m.second, m.first, m.distance2}; }

 private:
  /// `seen` in the order of the state's arguments, of which `a` is the first.
  void end(Resting, const Witness& seen) { walk_.end = WalkEnd::Minimum, walk_.witness = seen; }
  void end(Moved, const Witness& seen) { walk_.end = WalkEnd::Minimum, walk_.witness = yardstick::swapped(seen); }
  Move inside(FeatureId first, FeatureId second, double distance2) {
    walk_.end = WalkEnd::Inside;
    return {first, second, distance2};
  }

  // From here on all is in the body's own frame.

  /// Among the neighbours of a vertex, the highest along `d`. The steepest would take fewer states and more time.
  template <class P>
  Rise ring(P body, std::uint32_t v, const Vec& d) {
    const Vertex& record = body.view.vertices[v];
    const Vec p = vec(record);
    const std::uint32_t begin = record.ring_begin, end = begin + record.ring_count;
    Rise rise;
    std::uint32_t h = begin;
    for (; h < end && !(first_only_ && rise.falls()); ++h) {
      const double along_d = dot(d, body.own(body.view.half_edges[h].head) - p);
      rise.to = along_d > rise.highest ? h : rise.to;
      rise.highest = larger(along_d, rise.highest);
    }
    walk_.plane_tests += h - begin;
    if (!rise.falls()) return rise;
    const Vec e = body.own(body.view.half_edges[rise.to].head) - p;
    rise.length2 = dot(e, e);
    return rise;
  }

  /// To where the fall along an edge ends: on it, or at its head.
  template <class P>
  static FeatureId along(P body, const Rise& ring) {
    return ring.highest >= ring.length2 ? vertex(body.view.half_edges[ring.to].head) : edge(ring.to);
  }

  /// Of the two faces beside an edge q0 + s u from vertex `v0`, the one whose other edge there rises higher along `d`, which is
  /// perpendicular to u.
  template <class Q>
  Rise sides(Q body, std::uint32_t v0, std::uint32_t h, const Vec& q0, const Vec& u, const Vec& d) {
    const Vertex& record = body.view.vertices[v0];
    const std::uint32_t left = counter_clockwise(record, h), right = clockwise(record, h);
    if (left == h) return {};  // a segment
    const Vec to_left = body.own(body.view.half_edges[left].head) - q0,
              to_right = body.own(body.view.half_edges[right].head) - q0;
    const double left_rise = dot(d, to_left), right_rise = dot(d, to_right);
    walk_.plane_tests += 2;
    Rise rise;
    rise.highest = larger(left_rise, right_rise);
    if (!rise.falls()) return rise;
    const bool is_left = first_only_ ? left_rise > 0 : left_rise > right_rise;
    const Vec r = is_left ? to_left : to_right;
    rise.to = body.view.half_edges[is_left ? h : right].face;
    rise.length2 = dot(r, r) - dot(r, u) * dot(r, u) / dot(u, u);
    return rise;
  }

  /// The side of a face's prism that `p` is farthest beyond.
  template <class Q>
  std::uint32_t leave(const Prism<Q>& prism, const Vec& p) {
    std::uint32_t out = kNone;
    double farthest2 = 0;
    walk_.plane_tests += prism.each_side(p, {0, 0, 0}, [&](std::uint32_t side, const Vec& u, double beyond, double) {
      if (!(beyond > 0) || (first_only_ && out != kNone)) return;
      const double violation2 = beyond * beyond / dot(u, u);
      if (violation2 > farthest2) out = side, farthest2 = violation2;
    });
    return out;
  }

  /// Edge `h`, from `tail` along u to `head`, from its point p at s on: over a face that rises towards p.
  template <class Q>
  Move edge_over_face(std::uint32_t h, std::uint32_t tail, std::uint32_t head, const Vec& p, const Vec& u, double s, Q body,
                      std::uint32_t f, double distance2) {
    const Prism prism(body, f);
    const bool forward = dot(prism.normal(), u) < 0;
    return over_face(h, forward ? head : tail, p, u * (forward ? 1 - s : -s), prism, f, distance2);
  }

  /// The part p + x e of edge `h` that falls towards a face, x from 0 to 1 at vertex `to`: there, or to the side where it
  /// leaves the face's prism, if it does not get below the face before.
  template <class Q>
  Move over_face(std::uint32_t h, std::uint32_t to, const Vec& p, const Vec& e, const Prism<Q>& prism, std::uint32_t f,
                 double distance2) {
    double exit = 1;
    std::uint32_t out = kNone;
    walk_.plane_tests += prism.each_side(p, e, [&](std::uint32_t side, const Vec&, double beyond, double slope) {
      if (beyond > 0)
        exit = 0, out = side;
      else if (beyond + slope > 0 && -beyond < exit * slope)
        exit = -beyond / slope, out = side;
    });
    if (exit > 0 && !(prism.height(p) + exit * dot(prism.normal(), e) > 0)) return inside(edge(h), face(f), distance2);
    if (out == kNone) return {vertex(to), face(f), distance2};
    return {edge(h), edge(out), distance2};
  }

  const bool first_only_;
  Walk& walk_;
};

/// The state of a feature pair. A face and an edge or face is none: a vertex or an edge of one is as near.
template <class A, class B>
Move state(Marcher& march, A a, FeatureId fa, B b, FeatureId fb) {
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

}  // namespace

Walk walk(const Pair& pair, FeatureId a, FeatureId b, PlaneRule rule) {
  Walk result;
  result.a = a;
  result.b = b;
  if (a.kind() == FeatureKind::Edge && b.kind() == FeatureKind::Face) result.a = vertex(origin(pair.a, a.index()));
  if (b.kind() == FeatureKind::Edge && a.kind() == FeatureKind::Face) result.b = vertex(origin(pair.b, b.index()));
  Marcher march(rule, result);
  double distance2, least2 = kUnknown;
  std::uint32_t stalled = 0;
  do {
    const Move move = state(march, Resting{pair.a}, result.a, Moved{pair.b, pair.b_in_a}, result.b);
    distance2 = move.distance2;
    stalled = (stalled + 1) * !(distance2 < least2);
    least2 = smaller(least2, distance2);
    result.steps += 1 - (move.first == result.a) * (move.second == result.b);
    result.a = move.first;
    result.b = move.second;
    if (stalled >= kStallLimit && result.end == WalkEnd::Going) result.end = WalkEnd::Stalled;
  } while (result.end == WalkEnd::Going);
  result.distance = std::sqrt(result.end == WalkEnd::Minimum ? distance2 : least2);
  return result;
}

}  // namespace swiftlet::yardstick
