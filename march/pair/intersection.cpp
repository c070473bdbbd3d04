// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds where the surfaces of overlapping bodies cross. Rays lead from a point x inside both bodies to vertices outside the
// other body, and leave bodies through facets; between a ray that leaves A last and one that leaves B last the surfaces cross:
//
//            w        The ray to v, a vertex of A, leaves B at y, which is inside A. From y a walk over B's facets leads
//       B ___/\       towards w, a vertex of B outside A, until a facet has a corner q outside A. The way to q leaves A
//        /  /  \      through a facet of A that crosses this facet of B.
//   A __/__/____\__
//     \ \ x      y----v      Doubles find the two facets; exact signs decide whether an edge of one pierces the other. If none
//      \_\______/___/        does, the facets around them are tried. Where doubles cannot tell, as for a body in one 1e16
//         \____/             times larger, exact signs alone follow every edge that begins outside the other body.
//
// The exact search walks from facet to facet. Seen from a point, the facets of a convex surface divide the directions into the
// cells of a regular subdivision. A walk across cell sides towards a direction never cycles [Edelsbrunner 1990], so that it
// ends in the cell that holds the direction.
#include "pair/intersection.h"

#include <array>
#include <optional>

#include "body/half_edge.h"
#include "numeric/exact.h"
#include "numeric/wide.h"
#include "pair/certify.h"
#include "pair/overlap.h"

namespace swiftlet {
namespace {

using Quad = std::array<std::uint32_t, 4>;

/// True for a solid: three edges or more meet in each of its vertices, but only two in a vertex of a flat polygon.
bool bounds_solid(const ConvexView& view) { return view.vertices[0].ring_count > 2; }

/// The smallest feature that holds all of `vertices` exactly; `FeatureId{}` if no facet has them all as corners. `feature_of`
/// accepts the corners of a merged face too, which holds them only up to its thickness.
FeatureId feature_holding(const ConvexView& view, const Quad& vertices) {
  Quad distinct{};
  int count = 0;
  for (const std::uint32_t v : vertices) {
    bool seen = false;
    for (int i = 0; i < count; ++i) seen = seen || distinct[std::size_t(i)] == v;
    if (!seen) distinct[std::size_t(count++)] = v;
  }
  if (count == 1) return {FeatureKind::Vertex, distinct[0]};
  const Vertex& ring = view.vertices[distinct[0]];
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (count == 2 && view.half_edges[h].head == distinct[1] && !is_diagonal(view, h)) return {FeatureKind::Edge, h};
  }
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (view.half_edges[h].face == kNone) continue;
    int held = 0;
    std::uint32_t side = h;
    do {
      for (int i = 0; i < count; ++i) held += view.half_edges[side].head == distinct[std::size_t(i)];
      side = next_in_facet(view, side);
    } while (side != h);
    if (held == count) return {FeatureKind::Face, view.half_edges[h].face};
  }
  return {};
}

/// Finds two features that share a point. A facet is named by one of its half-edges, A is body 0 and B body 1; points are in
/// the common frame.
class IntersectionSearch {
 public:
  IntersectionSearch(const PairView& pair, std::uint32_t& tests)
      : pair_(pair), tests_(tests), most_tests_(tests + pair.a.half_edges.size() + pair.b.half_edges.size()) {}

  Intersection run(const OverlapProof& proof) {
    const Vec x = common_point<DoubleDouble>(pair_, proof).point;
    const FeatureId a = feature_holding(pair_.a, proof.vertex_a), b = feature_holding(pair_.b, proof.vertex_b);
    if (a != FeatureId{} && b != FeatureId{}) return {a, b, x};
    std::optional<Intersection> found;
    if (bounds_solid(pair_.a) && bounds_solid(pair_.b)) {
      hint_ = {pair_.a.vertices[proof.vertex_a[0]].ring_begin, pair_.b.vertices[proof.vertex_b[0]].ring_begin};
      found = between_outsiders(inner_point(x));
      if (!found) found = around(proof.vertex_a, proof.vertex_b);
    }
    return found ? *found : exactly(x);
  }

 private:
  const ConvexView& view(int k) const { return k == 0 ? pair_.a : pair_.b; }
  Vec point(int k, std::uint32_t v) const { return k == 0 ? body_a(pair_).point(v) : body_b(pair_).point(v); }
  Wide wide_point(int k, std::uint32_t v) const {
    const Vec own = vec(view(k).vertices[v]);
    return k == 0 ? wide(own) : wide(pair_.b_in_a, own);
  }
  Vec centre(int k) const { return k == 0 ? vec(pair_.a.centre) : body_b(pair_).common(vec(pair_.b.centre)); }
  std::uint32_t extreme(int k, const Vec& n, std::uint32_t start) const {
    return k == 0 ? support_a(pair_, n, start, tests_) : support_b(pair_, -n, start, tests_);
  }
  template <class Visit>
  void each_edge_of_facet(int k, std::uint32_t facet, Visit visit) const {
    std::uint32_t h = facet;
    do {
      visit(h);
      h = next_in_facet(view(k), h);
    } while (h != facet);
  }

  // ---- Exactly ----

  /// The sign of the determinant of three differences, each a vertex of A less one of B; `own` are vertices of body k.
  int side(int k, const std::array<std::uint32_t, 3>& own, const std::array<std::uint32_t, 3>& other) const {
    std::array<const double*, 3> p, q;
    for (std::size_t i = 0; i < 3; ++i) p[i] = &view(k).vertices[own[i]].x, q[i] = &view(1 - k).vertices[other[i]].x;
    ++tests_;
    return k == 0 ? exact::triple_product(p, q, pair_.b_in_a) : exact::triple_product(q, p, pair_.b_in_a);
  }

  /// True if an edge of body k meets a facet of the other body in whose plane the edge does not lie. If surfaces meet, some
  /// edge does: where an edge in the facet's plane ends or leaves the facet, another edge or facet begins.
  bool pierces(int k, std::uint32_t edge, std::uint32_t facet) const {
    const ConvexView &own = view(k), &other = view(1 - k);
    const std::uint32_t tail = origin(own, edge), head = own.half_edges[edge].head, q = origin(other, facet),
                        r = other.half_edges[facet].head, s = other.half_edges[next_in_facet(other, facet)].head;
    const int at_tail = side(k, {tail, tail, tail}, {q, r, s});
    const int at_head = side(k, {head, head, head}, {q, r, s});
    if (at_tail == at_head) return false;
    int turn = 0;
    std::uint32_t h = facet;
    do {
      const std::uint32_t q0 = origin(other, h), q1 = other.half_edges[h].head;
      const int sign = side(k, {head, tail, tail}, {q0, q0, q1});
      if (sign * turn < 0) return false;
      turn = sign != 0 ? sign : turn;
      h = next_in_facet(other, h);
    } while (h != facet);
    return true;
  }

  Intersection named(int k, std::uint32_t edge, std::uint32_t facet) const {
    const ConvexView &own = view(k), &other = view(1 - k);
    const FeatureId pierced{FeatureKind::Face, other.half_edges[facet].face};
    const FeatureId piercing =
        is_diagonal(own, edge) ? FeatureId{FeatureKind::Face, own.half_edges[edge].face} : FeatureId{FeatureKind::Edge, edge};
    // An edge may lie nearly in the facet's plane: the error of the common point grows as the inverse of the angle between
    // them.
    const Wide p = wide_point(k, origin(own, edge)), e = wide_point(k, own.half_edges[edge].head) - p;
    const Wide q = wide_point(1 - k, origin(other, facet)), r = wide_point(1 - k, other.half_edges[facet].head),
               s = wide_point(1 - k, other.half_edges[next_in_facet(other, facet)].head), n = cross(r - q, s - q);
    const DoubleDouble at_tail = dot(n, p - q), fall = -dot(n, e);
    DoubleDouble t = fall.high != 0 ? at_tail / fall : DoubleDouble(0);
    if (!(t.high > 0)) t = 0;
    if (t.high > 1) t = 1;
    const Vec at = rounded(p + e * t);
    return k == 0 ? Intersection{piercing, pierced, at} : Intersection{pierced, piercing, at};
  }

  std::optional<Intersection> between(std::uint32_t facet_a, std::uint32_t facet_b) const {
    std::optional<Intersection> found;
    each_edge_of_facet(0, facet_a, [&](std::uint32_t h) {
      if (!found && pierces(0, h, facet_b)) found = named(0, h, facet_b);
    });
    each_edge_of_facet(1, facet_b, [&](std::uint32_t h) {
      if (!found && pierces(1, h, facet_a)) found = named(1, h, facet_a);
    });
    return found;
  }

  /// Searches the edges and facets around the given vertices of both bodies for one that pierces another.
  template <class VerticesA, class VerticesB>
  std::optional<Intersection> around(const VerticesA& vertices_a, const VerticesB& vertices_b) const {
    for (const std::uint32_t va : vertices_a) {
      const Vertex& ring_a = pair_.a.vertices[va];
      for (const std::uint32_t vb : vertices_b) {
        const Vertex& ring_b = pair_.b.vertices[vb];
        for (std::uint32_t g = ring_a.ring_begin; g < ring_a.ring_begin + ring_a.ring_count; ++g) {
          for (std::uint32_t h = ring_b.ring_begin; h < ring_b.ring_begin + ring_b.ring_count; ++h) {
            if (spent()) return std::nullopt;
            if (pierces(0, g, h)) return named(0, g, h);
            if (pierces(1, h, g)) return named(1, h, g);
          }
        }
      }
    }
    return std::nullopt;
  }

  // ---- Exactly, over a whole surface ----

  /// A triangle of a facet's fan. The fan spreads from the origin of half-edge `first`; `side` is the side opposite that
  /// origin.
  struct Cell {
    std::uint32_t first, side;
  };
  Cell cell(int k, std::uint32_t facet) const { return {facet, next_in_facet(view(k), facet)}; }

  /// 1 or -1: `side` times this is positive for a point of body k outside a facet of the other body.
  int sense(int k) const {
    const Motion& m = pair_.b_in_a;
    return k == 1 || dot(m.row_x, cross(m.row_y, m.row_z)) < 0 ? -1 : 1;
  }
  /// 1, 0 or -1 if a vertex of body k lies above, in or below the plane of a facet of the other body.
  int height(int k, std::uint32_t v, std::uint32_t facet) const {
    const ConvexView& other = view(1 - k);
    const std::uint32_t q = origin(other, facet), r = other.half_edges[facet].head,
                        s = other.half_edges[next_in_facet(other, facet)].head;
    return sense(k) * side(k, {v, v, v}, {q, r, s});
  }

  /// Moves `at` within its fan to the triangle that holds a direction. Returns the side of the facet beyond which the direction
  /// lies, or kNone. `left` is the sign of the direction's side of the plane through the apex and two corners. Where products
  /// underflow, signs may contradict each other, and only the count ends the way.
  template <class Left>
  std::uint32_t beyond(int k, Cell& at, Left left) const {
    const ConvexView& own = view(k);
    const std::uint32_t root = origin(own, at.first);
    for (std::size_t steps = own.half_edges.size(); steps > 0; --steps) {
      const std::uint32_t tail = origin(own, at.side), head = own.half_edges[at.side].head;
      if (left(root, tail) < 0) {
        if (tail == own.half_edges[at.first].head) return at.first;
        at.side = previous_in_facet(own, at.side);
      } else if (left(head, root) < 0) {
        const std::uint32_t next = next_in_facet(own, at.side);
        if (own.half_edges[next].head == root) return next;
        at.side = next;
      } else {
        return left(tail, head) < 0 ? at.side : kNone;
      }
    }
    return kNone;
  }

  /// Where a vertex lies: `side` is 1 outside a body, 0 on its surface, -1 inside; `facet` is the facet it lies beyond or in.
  struct FacetPlace {
    int side;
    std::uint32_t facet;
  };
  /// Locates a vertex of body k in the other body, a solid. Seen from the solid's apex, the facets without the apex as a corner
  /// fill the solid with pyramids; a walk comes to a facet at the apex only on a way that leads outside.
  FacetPlace locate(int k, std::uint32_t v) {
    const ConvexView& other = view(1 - k);
    const std::uint32_t apex = apex_[std::size_t(1 - k)], ring = other.vertices[apex].ring_begin;
    Cell& last = cell_[std::size_t(1 - k)];
    Cell at = last;
    for (std::size_t steps = other.half_edges.size(); steps > 0; --steps) {  // enough steps for any convex body
      const int above = height(k, v, at.first);
      if (above > 0) return {1, at.first};
      bool on_side = false;
      const std::uint32_t edge = beyond(1 - k, at, [&](std::uint32_t p, std::uint32_t q) {
        const int sign = sense(k) * side(k, {v, v, v}, {apex, p, q});
        on_side = on_side || sign == 0;
        return sign;
      });
      last = at;
      if (edge != kNone) {
        at = cell(1 - k, other.half_edges[edge].twin);
        continue;
      }
      if (above == 0) return {0, at.first};
      for (std::uint32_t h = ring; on_side && h < ring + other.vertices[apex].ring_count; ++h) {
        if (height(k, v, h) == 0) return {0, h};
      }
      break;
    }
    return {-1, at.first};
  }

  /// The facet through which the edge of body k from p, outside the other body, to q enters that body; kNone if the edge misses
  /// it. `from` is in a facet whose plane p is above, and becomes the last cell visited.
  std::uint32_t entered(int k, std::uint32_t p, std::uint32_t q, Cell& from) const {
    const ConvexView& other = view(1 - k);
    Cell at = from;
    for (std::size_t steps = other.half_edges.size(); steps > 0 && height(k, p, at.first) > 0; --steps) {
      const std::uint32_t edge = beyond(1 - k, at, [&](std::uint32_t u, std::uint32_t w) {
        return -sense(k) * side(k, {q, p, p}, {u, u, w});
      });
      from = at;
      if (edge == kNone) return height(k, q, at.first) <= 0 ? at.first : kNone;
      at = cell(1 - k, other.half_edges[edge].twin);
    }
    return kNone;
  }

  /// Finds where an edge of body k meets the other surface. `inside` becomes false unless all vertices of body k lie inside the
  /// other body.
  std::optional<Intersection> along_edges(int k, bool& inside) {
    const ConvexView &own = view(k), &other = view(1 - k);
    inside = bounds_solid(other);
    if (!inside) {
      for (std::uint32_t h = 0; h < own.half_edges.size() && !other.face_first.empty(); ++h) {
        if (h < own.half_edges[h].twin && pierces(k, h, other.face_first[0])) return named(k, h, other.face_first[0]);
      }
      return std::nullopt;
    }
    for (std::uint32_t v = 0; v < own.vertices.size(); ++v) {
      const FacetPlace place = locate(k, v);
      if (place.side < 0) continue;
      inside = false;
      Cell below = cell(1 - k, place.facet);
      const Vertex& ring = own.vertices[v];
      for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
        const bool on = place.side == 0 && pierces(k, h, place.facet);
        const std::uint32_t facet = on ? place.facet : place.side > 0 ? entered(k, v, own.half_edges[h].head, below) : kNone;
        if (facet != kNone) return named(k, h, facet);
      }
    }
    return std::nullopt;
  }

  /// Searches the edges of both bodies, the smaller body first. If none meets the other surface, one body lies inside the
  /// other.
  Intersection exactly(const Vec& x) {
    for (const int k : {0, 1}) {
      const ConvexView& own = view(k);
      if (!bounds_solid(own)) continue;
      std::uint32_t& apex = apex_[std::size_t(k)];  // some vertex of a convex body has at most five edges
      for (std::uint32_t v = 1; v < own.vertices.size(); ++v) {
        if (own.vertices[v].ring_count < own.vertices[apex].ring_count) apex = v;
      }
      cell_[std::size_t(k)] = cell(k, own.half_edges[next_in_facet(own, own.vertices[apex].ring_begin)].twin);
    }
    const int smaller_one = pair_.a.extent < pair_.b.extent ? 0 : 1;
    for (const int k : {smaller_one, 1 - smaller_one}) {
      bool inside = false;
      if (const auto found = along_edges(k, inside)) return *found;
      if (inside) return inner(k, x);
    }
    return inner(bounds_solid(pair_.a) ? 1 : 0, x);
  }

  // ---- In doubles ----

  /// True if the guesses in doubles took more tests than both bodies have half-edges.
  bool spent() const { return tests_ > most_tests_; }

  /// Where a ray from a point inside a body leaves it: through `facet`, after 1 / `rate` of the ray's length; never if `rate`
  /// is not positive. `error` is the uncertainty of `rate`.
  struct Exit {
    std::uint32_t facet;
    double rate, error;
    bool ends_outside() const { return rate > 1 + error; }
  };

  /// A facet's normal, common frame, of any length; outward unless the pose reflects.
  Vec normal(int k, std::uint32_t facet) const {
    const ConvexView& own = view(k);
    const Vec q = point(k, origin(own, facet));
    return cross(point(k, own.half_edges[facet].head) - q, point(k, own.half_edges[next_in_facet(own, facet)].head) - q);
  }

  Exit through(int k, std::uint32_t facet, const Vec& p, const Vec& d) const {
    const Vec n = normal(k, facet);
    const double height = dot(n, point(k, origin(view(k), facet)) - p), along = dot(n, d);
    ++tests_;
    // p lies in the facet's plane, as a corner does: the ray leaves through the facet at once, or never.
    const double thin = pair_.point_error() * norm(n);
    if (std::fabs(height) <= thin) return {facet, std::fabs(along) <= thin ? 0 : kInfinity, 1};
    return {facet, along / height, kExitError * thin / std::fabs(height)};
  }

  /// The exit of the ray from `p` along `d`. Seen from `p`, facets are the vertices of the polar body, over which the rate is
  /// linear: hill climbing from facet to facet ends at the greatest rate.
  Exit leave(int k, const Vec& p, const Vec& d) {
    Exit best = through(k, hint_[std::size_t(k)], p, d);
    for (bool rises = true; rises && !spent();) {
      rises = false;
      each_edge_of_facet(k, best.facet, [&](std::uint32_t h) {
        const Exit next = through(k, view(k).half_edges[h].twin, p, d);
        if (next.rate > best.rate) best = next, rises = true;
      });
    }
    hint_[std::size_t(k)] = best.facet;
    return best;
  }
  Exit towards(int k, const Vec& x, const Vec& p) { return leave(k, x, p - x); }

  /// Moves a point of both bodies four times: halfway to the centre of A or of B, in turn, or halfway to where that way leaves
  /// the other body.
  Vec inner_point(Vec x) {
    for (int k : {0, 1, 0, 1}) {
      const Vec d = centre(k) - x;
      const double rate = leave(1 - k, x, d).rate;
      x = x + d * (0.5 / max(1, rate));
    }
    return x;
  }

  /// A vertex of body k outside the other body; kNone if a few support vertices show none.
  std::uint32_t outsider(int k, const Vec& x) {
    const Vec apart = centre(k) - centre(1 - k);
    std::uint32_t v = origin(view(k), hint_[std::size_t(k)]);
    for (Vec n : {apart, Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{0, -1, 0}, Vec{0, 0, 1}, Vec{0, 0, -1}}) {
      for (int step = 0; step < kMapGjkSteps && !spent(); ++step) {  // rounding may make the loop cycle
        const std::uint32_t farthest = extreme(k, rescaled(n), v);
        if (step > 0 && farthest == v) break;
        v = farthest;
        const Exit exit = towards(1 - k, x, point(k, v));
        if (exit.ends_outside()) return v;
        const Vec facing = normal(1 - k, exit.facet);  // next, along the normal of the facet that the ray leaves through
        n = dot(facing, point(k, v) - x) < 0 ? -facing : facing;
      }
    }
    return kNone;
  }

  /// A corner of a facet of B that lies outside A; kNone if there is none.
  std::uint32_t corner_outside(std::uint32_t facet, const Vec& x) {
    std::uint32_t found = kNone;
    each_edge_of_facet(1, facet, [&](std::uint32_t h) {
      if (found == kNone && towards(0, x, point(1, pair_.b.half_edges[h].head)).ends_outside())
        found = pair_.b.half_edges[h].head;
    });
    return found;
  }

  std::optional<Intersection> between_outsiders(const Vec& x) {
    const std::uint32_t v = outsider(0, x);
    if (v == kNone) return std::nullopt;
    const Exit first = towards(1, x, point(0, v));
    std::uint32_t facet = first.facet, q = corner_outside(facet, x);
    Vec p = x + (point(0, v) - x) * (1 / first.rate);
    if (q == kNone) {
      const std::uint32_t w = outsider(1, x);
      if (w == kNone) return std::nullopt;
      const Vec d = point(1, w) - x;
      for (Exit at = through(1, facet, x, d); q == kNone;) {
        Exit best = at;
        std::uint32_t shared = kNone;
        each_edge_of_facet(1, at.facet, [&](std::uint32_t h) {
          const Exit next = through(1, pair_.b.half_edges[h].twin, x, d);
          if (next.rate > best.rate) best = next, shared = pair_.b.half_edges[h].head;
        });
        if (shared == kNone || spent()) return std::nullopt;
        p = point(1, shared);  // inside A, as all corners so far
        at = best;
        q = corner_outside(at.facet, x);
        facet = at.facet;
      }
    }
    const std::uint32_t other = towards(0, p, point(1, q)).facet;
    if (const auto found = between(other, facet)) return found;
    return around(corners(0, other), corners(1, facet));
  }

  std::array<std::uint32_t, 3> corners(int k, std::uint32_t facet) const {
    const ConvexView& own = view(k);
    return {origin(own, facet), own.half_edges[facet].head, own.half_edges[next_in_facet(own, facet)].head};
  }

  /// The result if body k lies inside the other body.
  Intersection inner(int k, const Vec& x) const {
    const FeatureId any{FeatureKind::Vertex, 0};
    return k == 0 ? Intersection{any, {}, x} : Intersection{{}, any, x};
  }
  const PairView& pair_;
  std::uint32_t& tests_;
  const std::size_t most_tests_;         ///< guesses end at this count
  std::array<std::uint32_t, 2> hint_{};  ///< per body, the facet that the last ray left through
  std::array<std::uint32_t, 2> apex_{};  ///< per body, the vertex from which `locate` sees its facets
  std::array<Cell, 2> cell_{};           ///< per body, the last cell that `locate` visited
};

/// The point of a segment or a facet nearest to some point p, and its distance from p.
struct Foot {
  double off;
  Vec point;
};

Foot foot_on_segment(const Vec& p, const Vec& q0, const Vec& q1) {
  const Vec u = q1 - q0, r = p - q0;
  const double t = dot(r, u) / dot(u, u);
  const Vec along = u * (t > 0 ? min(t, 1) : 0.0);
  return {norm(r - along), q0 + along};
}

/// The foot of p on the facet on the left of a half-edge if p lies above or below that by less than `most`; else p, `most` off.
/// In 106 bits: of a sliver the plane and the sides are noise in doubles, which tell only that p is outside the facet's box.
template <class Body>
Foot foot_on_facet(const Body& body, std::uint32_t facet, const Vec& p, double most) {
  const ConvexView& view = body.view;
  const auto each_side = [&](auto visit) {
    std::uint32_t h = facet;
    do {
      visit(body.point(origin(view, h)), body.point(view.half_edges[h].head));
      h = next_in_facet(view, h);
    } while (h != facet);
  };
  const Vec first = body.point(origin(view, facet));
  Vec low = first, high = first;
  each_side([&](const Vec& tail, const Vec&) {
    low = {min(low.x, tail.x), min(low.y, tail.y), min(low.z, tail.z)};
    high = {max(high.x, tail.x), max(high.y, tail.y), max(high.z, tail.z)};
  });
  const Vec before = low - p, beyond = p - high;
  if (max(max(max(before.x, beyond.x), max(before.y, beyond.y)), max(before.z, beyond.z)) >= most) return {most, p};
  // Twice the area of the triangle that a side makes with p, along its normal; their sum is that of the facet.
  const auto seen = [&](const Vec& tail, const Vec& tip) { return cross(wide(tail) - wide(p), wide(tip) - wide(p)); };
  Wide n{0, 0, 0};
  each_side([&](const Vec& tail, const Vec& tip) { n = n + seen(tail, tip); });
  bool inside = true;
  each_side([&](const Vec& tail, const Vec& tip) { inside = inside && !(dot(seen(tail, tip), n) < 0); });
  const double depth = rounded(dot(n, wide(first) - wide(p))), length = norm(rounded(n)), off = std::fabs(depth);
  if (!inside || !(off < most * length)) return {most, p};
  return {off / length, p + rounded(n) * (1 / length) * (depth / length)};
}

template <class Body>
HeldPoint held_at(const Body& body, FeatureId known, const Vec& p, double bound, std::uint32_t& tests) {
  const ConvexView& view = body.view;
  if (known.kind() != FeatureKind::Vertex || norm(p - body.point(known.index())) <= bound) return {known, p};
  Foot least{2 * bound, p};
  std::uint32_t nearest = kNone;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    // The plane of a sliver is uncertain, its sides are not: the distance to the sides counts too.
    const auto take = [&](const Foot& foot) {
      if (foot.off < least.off) least = foot, nearest = h;
    };
    take(foot_on_segment(p, body.point(origin(view, h)), body.point(view.half_edges[h].head)));
    if (is_first_in_facet(view, h)) take(foot_on_facet(body, h, p, least.off));
    ++tests;
  }
  if (nearest == kNone) return {known, p};
  const Vec held = least.off <= bound ? p : least.point + (p - least.point) * (bound / least.off);
  FeatureId smallest{view.half_edges[nearest].face == kNone ? FeatureKind::Edge : FeatureKind::Face,
                     view.half_edges[nearest].face == kNone ? nearest : view.half_edges[nearest].face};
  std::uint32_t h = nearest;
  do {
    const Vec tail = body.point(origin(view, h)), head = body.point(view.half_edges[h].head);
    if (norm(held - tail) <= bound) return {{FeatureKind::Vertex, origin(view, h)}, held};
    if (!is_diagonal(view, h) && foot_on_segment(held, tail, head).off <= bound) smallest = {FeatureKind::Edge, h};
    h = next_in_facet(view, h);
  } while (h != nearest);
  return {smallest, held};
}

}  // namespace

// The points of B are known up to the pair's rounding.
HeldPoint held_at_a(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests) {
  return held_at(body_a(pair), known, p, pair.law_two - pair.motion_error, plane_tests);
}
HeldPoint held_at_b(const PairView& pair, FeatureId known, const Vec& p, std::uint32_t& plane_tests) {
  return held_at(body_b(pair), known, p, pair.law_two - pair.motion_error, plane_tests);
}

Intersection intersection(const PairView& pair, const OverlapProof& proof, std::uint32_t& plane_tests) {
  return IntersectionSearch(pair, plane_tests).run(proof);
}

}  // namespace swiftlet
