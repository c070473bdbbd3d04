// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From a point x inside both bodies the rays to vertices that stick out of the other body leave through facets; between one
// that leaves A last and one that leaves B last the surfaces change places:
//
//            w        The ray to v, a vertex of A, leaves B in y, which is inside A. From there over B's facets towards w,
//       B ___/\       a vertex of B outside A, until one has a corner q outside A: its way there leaves A
//        /  /  \      through a facet that crosses it.
//   A __/__/____\__
//     \ \ x      y----v      Doubles find the two facets; exact signs say whether an edge of one pierces the other, and where
//      \_\______/___/        they deny it the facets beside are asked, then all.
//         \____/
#include "crossing.h"

#include <array>
#include <limits>
#include <optional>

#include "certify.h"
#include "exact.h"
#include "overlap.h"
#include "ring.h"
#include "wide.h"

namespace swiftlet {
namespace {

using Quad = std::array<std::uint32_t, 4>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool bounds_solid(const ConvexView& view) { return view.face_first.size() > 2; }

/// The smallest feature that holds given vertices exactly: none where no facet does.
Handle feature_holding(const ConvexView& view, const Quad& vertices) {
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
    if (count == 2 && view.head[h] == distinct[1] && !is_diagonal(view, h)) return {FeatureKind::Edge, h};
  }
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (view.face[h] == kNone) continue;
    int held = 0;
    std::uint32_t side = h;
    do {
      for (int i = 0; i < count; ++i) held += view.head[side] == distinct[std::size_t(i)];
      side = next_in_facet(view, side);
    } while (side != h);
    if (held == count) return {FeatureKind::Face, view.face[h]};
  }
  return {};
}

/// Facets are named by one of their half-edges, bodies by 0 and 1; points are in the common frame.
class Search {
 public:
  Search(const Scene& scene, std::uint32_t& tests) : scene_(scene), tests_(tests) {}

  Crossing run(const OverlapProof& proof) {
    const Vec x = common_point<DoubleDouble>(scene_, proof);
    const Handle a = feature_holding(scene_.a, proof.vertex_a), b = feature_holding(scene_.b, proof.vertex_b);
    if (a != Handle{} && b != Handle{}) return {a, b, x};
    std::optional<Crossing> found;
    if (bounds_solid(scene_.a) && bounds_solid(scene_.b)) {
      hint_ = {scene_.a.vertices[proof.vertex_a[0]].ring_begin, scene_.b.vertices[proof.vertex_b[0]].ring_begin};
      found = between_outsiders(inner_point(x));
      if (!found) found = around(proof.vertex_a, proof.vertex_b);
    }
    if (!found) found = among_all();
    return found ? *found : nested(x);
  }

 private:
  const ConvexView& view(int k) const { return k == 0 ? scene_.a : scene_.b; }
  Vec point(int k, std::uint32_t v) const { return k == 0 ? body_a(scene_).point(v) : body_b(scene_).point(v); }
  Vec centre(int k) const { return k == 0 ? vec(scene_.a.centre) : body_b(scene_).common(vec(scene_.b.centre)); }
  std::uint32_t extreme(int k, const Vec& n, std::uint32_t start) const {
    return k == 0 ? support_a(scene_, n, start, tests_) : support_b(scene_, -n, start, tests_);
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

  /// The sign of the determinant of three differences between points of body k and of the other.
  int side(int k, const std::array<std::uint32_t, 3>& own, const std::array<std::uint32_t, 3>& other) const {
    std::array<const double*, 3> p, q;
    for (std::size_t i = 0; i < 3; ++i) p[i] = &view(k).vertices[own[i]].x, q[i] = &view(1 - k).vertices[other[i]].x;
    ++tests_;
    return k == 0 ? exact::triple_product(p, q, scene_.b_in_a) : exact::triple_product(q, p, scene_.b_in_a);
  }

  /// Whether an edge of body k meets a facet of the other in whose plane it does not lie. Of surfaces that meet some edge does:
  /// where one that lies in the plane ends or leaves the facet, another edge or facet begins.
  bool pierces(int k, std::uint32_t edge, std::uint32_t facet) const {
    const ConvexView &own = view(k), &other = view(1 - k);
    const std::uint32_t tail = origin(own, edge), head = own.head[edge], q = origin(other, facet), r = other.head[facet],
                        s = other.head[next_in_facet(other, facet)];
    const int at_tail = side(k, {tail, tail, tail}, {q, r, s});
    const int at_head = side(k, {head, head, head}, {q, r, s});
    if (at_tail == at_head) return false;
    int turn = 0;
    std::uint32_t h = facet;
    do {
      const std::uint32_t q0 = origin(other, h), q1 = other.head[h];
      const int sign = side(k, {head, tail, tail}, {q0, q0, q1});
      if (sign * turn < 0) return false;
      turn = sign != 0 ? sign : turn;
      h = next_in_facet(other, h);
    } while (h != facet);
    return true;
  }

  Crossing named(int k, std::uint32_t edge, std::uint32_t facet) const {
    const ConvexView &own = view(k), &other = view(1 - k);
    const Handle pierced{FeatureKind::Face, other.face[facet]};
    const Handle piercing =
        is_diagonal(own, edge) ? Handle{FeatureKind::Face, own.face[edge]} : Handle{FeatureKind::Edge, edge};
    const Vec p = point(k, origin(own, edge)), e = point(k, own.head[edge]) - p, n = normal(1 - k, facet),
              q = point(1 - k, origin(other, facet));
    const double at_tail = dot(n, p - q), at_head = at_tail + dot(n, e), t = at_tail / (at_tail - at_head);
    const Vec at = p + e * (t > 0 ? smaller(t, 1) : 0.0);
    return k == 0 ? Crossing{piercing, pierced, at} : Crossing{pierced, piercing, at};
  }

  std::optional<Crossing> between(std::uint32_t facet_a, std::uint32_t facet_b) const {
    std::optional<Crossing> found;
    each_edge_of_facet(0, facet_a, [&](std::uint32_t h) {
      if (!found && pierces(0, h, facet_b)) found = named(0, h, facet_b);
    });
    each_edge_of_facet(1, facet_b, [&](std::uint32_t h) {
      if (!found && pierces(1, h, facet_a)) found = named(1, h, facet_a);
    });
    return found;
  }

  /// Among the edges and facets at some vertices of each body.
  template <class VerticesA, class VerticesB>
  std::optional<Crossing> around(const VerticesA& vertices_a, const VerticesB& vertices_b) const {
    for (const std::uint32_t va : vertices_a) {
      const Vertex& ring_a = scene_.a.vertices[va];
      for (const std::uint32_t vb : vertices_b) {
        const Vertex& ring_b = scene_.b.vertices[vb];
        for (std::uint32_t g = ring_a.ring_begin; g < ring_a.ring_begin + ring_a.ring_count; ++g) {
          for (std::uint32_t h = ring_b.ring_begin; h < ring_b.ring_begin + ring_b.ring_count; ++h) {
            if (pierces(0, g, h)) return named(0, g, h);
            if (pierces(1, h, g)) return named(1, h, g);
          }
        }
      }
    }
    return std::nullopt;
  }

  std::optional<Crossing> among_all() const {
    for (const int k : {0, 1}) {
      const ConvexView &own = view(k), &other = view(1 - k);
      for (std::uint32_t facet = 0; facet < other.head.size(); ++facet) {
        if (other.face[facet] == kNone || !is_first(other, facet)) continue;
        const Vec q = point(1 - k, origin(other, facet)), u = point(1 - k, other.head[facet]) - q,
                  v = point(1 - k, other.head[next_in_facet(other, facet)]) - q, n = cross(u, v);
        const double doubt = kFacetSideError * scene_.point_error * scene_.magnitude * (norm(u) + norm(v));
        for (std::uint32_t h = 0; h < own.head.size(); ++h) {
          if (h > own.twin[h]) continue;
          tests_ += 2;
          const double at_tail = dot(n, point(k, origin(own, h)) - q), at_head = dot(n, point(k, own.head[h]) - q);
          if (smaller(at_tail, at_head) > doubt || larger(at_tail, at_head) < -doubt) continue;
          if (pierces(k, h, facet)) return named(k, h, facet);
        }
      }
    }
    return std::nullopt;
  }
  static bool is_first(const ConvexView& view, std::uint32_t facet) {
    for (std::uint32_t h = next_in_facet(view, facet); h != facet; h = next_in_facet(view, h)) {
      if (h < facet) return false;
    }
    return true;
  }

  // ---- In doubles ----

  /// Where the ray from a point inside leaves a body: after 1 / rate of its length; never, if the rate is not positive.
  struct Exit {
    std::uint32_t facet;
    double rate, error;
    bool ends_outside() const { return rate > 1 + error; }
    bool ends_inside() const { return rate < 1 - error; }
  };

  /// Of any length; outward but where the pose reflects.
  Vec normal(int k, std::uint32_t facet) const {
    const ConvexView& own = view(k);
    const Vec q = point(k, origin(own, facet));
    return cross(point(k, own.head[facet]) - q, point(k, own.head[next_in_facet(own, facet)]) - q);
  }

  Exit through(int k, std::uint32_t facet, const Vec& p, const Vec& d) const {
    const Vec n = normal(k, facet);
    const double height = dot(n, point(k, origin(view(k), facet)) - p), along = dot(n, d);
    ++tests_;
    // In the plane of a facet, as a corner is: out at once, or never through it.
    const double thin = scene_.point_error * norm(n);
    if (std::fabs(height) <= thin) return {facet, std::fabs(along) <= thin ? 0 : kInfinity, 1};
    return {facet, along / height, kExitError * thin / std::fabs(height)};
  }

  /// Facets seen from `p` are the vertices of the polar body, and the rate is linear over these: a climb ends at the greatest.
  Exit leave(int k, const Vec& p, const Vec& d) {
    Exit best = through(k, hint_[std::size_t(k)], p, d);
    for (bool rises = true; rises;) {
      rises = false;
      each_edge_of_facet(k, best.facet, [&](std::uint32_t h) {
        const Exit next = through(k, view(k).twin[h], p, d);
        if (next.rate > best.rate) best = next, rises = true;
      });
    }
    hint_[std::size_t(k)] = best.facet;
    return best;
  }
  Exit towards(int k, const Vec& x, const Vec& p) { return leave(k, x, p - x); }

  /// From a point of both bodies halfway to where the way to each one's centre leaves the other.
  Vec inner_point(Vec x) {
    for (int k : {0, 1, 0, 1}) {
      const Vec d = centre(k) - x;
      const double rate = leave(1 - k, x, d).rate;
      x = x + d * (0.5 / larger(1, rate));
    }
    return x;
  }

  /// A vertex of body k outside the other; kNone where all are inside, and `doubtful` where some are only perhaps.
  std::uint32_t outsider(int k, const Vec& x, bool& doubtful) {
    const Vec apart = centre(k) - centre(1 - k);
    std::uint32_t v = origin(view(k), hint_[std::size_t(k)]);
    for (Vec n : {apart, Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{0, -1, 0}, Vec{0, 0, 1}, Vec{0, 0, -1}}) {
      for (int step = 0; step < kAimSteps; ++step) {  // rounding may turn in a circle
        const std::uint32_t farthest = extreme(k, rescaled(n), v);
        if (step > 0 && farthest == v) break;
        v = farthest;
        const Exit exit = towards(1 - k, x, point(k, v));
        if (exit.ends_outside()) return v;
        const Vec facing = normal(1 - k, exit.facet);  // on from here, over the facet that the ray leaves through
        n = dot(facing, point(k, v) - x) < 0 ? -facing : facing;
      }
    }
    for (v = 0; v < view(k).vertices.size(); ++v) {
      const Exit exit = towards(1 - k, x, point(k, v));
      if (exit.ends_outside()) return v;
      doubtful = doubtful || !exit.ends_inside();
    }
    return kNone;
  }

  /// A corner of a facet of B outside A.
  std::uint32_t corner_outside(std::uint32_t facet, const Vec& x) {
    std::uint32_t found = kNone;
    each_edge_of_facet(1, facet, [&](std::uint32_t h) {
      if (found == kNone && towards(0, x, point(1, scene_.b.head[h])).ends_outside()) found = scene_.b.head[h];
    });
    return found;
  }

  std::optional<Crossing> between_outsiders(const Vec& x) {
    bool doubtful = false;
    const auto inside = [&](int k) -> std::optional<Crossing> {
      if (doubtful) return std::nullopt;
      return inner(k, x);
    };
    const std::uint32_t v = outsider(0, x, doubtful);
    if (v == kNone) return inside(0);
    const Exit first = towards(1, x, point(0, v));
    std::uint32_t facet = first.facet, q = corner_outside(facet, x);
    Vec p = x + (point(0, v) - x) * (1 / first.rate);
    if (q == kNone) {
      const std::uint32_t w = outsider(1, x, doubtful);
      if (w == kNone) return inside(1);
      const Vec d = point(1, w) - x;
      for (Exit at = through(1, facet, x, d); q == kNone;) {
        Exit best = at;
        std::uint32_t shared = kNone;
        each_edge_of_facet(1, at.facet, [&](std::uint32_t h) {
          const Exit next = through(1, scene_.b.twin[h], x, d);
          if (next.rate > best.rate) best = next, shared = scene_.b.head[h];
        });
        if (shared == kNone) return std::nullopt;
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
    return {origin(own, facet), own.head[facet], own.head[next_in_facet(own, facet)]};
  }

  /// Body k lies inside the other.
  Crossing inner(int k, const Vec& x) const {
    const Handle any{FeatureKind::Vertex, 0};
    return k == 0 ? Crossing{any, {}, x} : Crossing{{}, any, x};
  }
  /// Surfaces that share nothing: the body that is inside is the one with a vertex there.
  Crossing nested(const Vec& x) {
    if (!bounds_solid(scene_.a)) return inner(0, x);
    if (!bounds_solid(scene_.b)) return inner(1, x);
    return inner(towards(1, x, point(0, 0)).rate <= 1 ? 0 : 1, x);
  }

  const Scene& scene_;
  std::uint32_t& tests_;
  std::array<std::uint32_t, 2> hint_{};  ///< the facet last seen of each
};

/// The distance from p to the segment from q0 to q1.
double off_segment(const Vec& p, const Vec& q0, const Vec& q1) {
  const Vec u = q1 - q0, r = p - q0;
  const double t = dot(r, u) / dot(u, u);
  return norm(r - u * (t > 0 ? smaller(t, 1) : 0.0));
}

template <class Body>
Handle feature_at(const Body& body, Handle known, const Vec& p, double bound, std::uint32_t& tests) {
  const ConvexView& view = body.view;
  if (known.kind() != FeatureKind::Vertex || norm(p - body.point(known.index())) <= bound) return known;
  double least = 2 * bound;
  std::uint32_t nearest = kNone;
  for (std::uint32_t facet = 0; facet < view.head.size(); ++facet) {
    // Planes of slivers are uncertain, their sides are not.
    const Vec q = body.point(origin(view, facet)), tip = body.point(view.head[facet]),
              n = cross(tip - q, body.point(view.head[next_in_facet(view, facet)]) - q);
    const double height = std::fabs(dot(n, p - q)), length = norm(n);
    ++tests;
    double off = off_segment(p, q, tip);
    bool above = length > 0 && height <= least * length;
    for (std::uint32_t h = facet; above;) {
      const Vec q0 = body.point(origin(view, h)), q1 = body.point(view.head[h]);
      above = dot(cross(q1 - q0, p - q0), n) >= 0;
      h = next_in_facet(view, h);
      if (h == facet) break;
    }
    if (above) off = smaller(off, height / length);
    if (off < least) least = off, nearest = facet;
  }
  if (nearest == kNone) return known;
  Handle smallest{view.face[nearest] == kNone ? FeatureKind::Edge : FeatureKind::Face,
                  view.face[nearest] == kNone ? nearest : view.face[nearest]};
  std::uint32_t h = nearest;
  do {
    const std::uint32_t v0 = origin(view, h), v1 = view.head[h];
    if (norm(p - body.point(v0)) <= bound) return {FeatureKind::Vertex, v0};
    if (!is_diagonal(view, h) && off_segment(p, body.point(v0), body.point(v1)) <= bound) smallest = {FeatureKind::Edge, h};
    h = next_in_facet(view, h);
  } while (h != nearest);
  return smallest;
}

}  // namespace

Handle feature_at_a(const Scene& scene, Handle known, const Vec& p, std::uint32_t& plane_tests) {
  return feature_at(body_a(scene), known, p, scene.law_two, plane_tests);
}
Handle feature_at_b(const Scene& scene, Handle known, const Vec& p, std::uint32_t& plane_tests) {
  return feature_at(body_b(scene), known, p, scene.law_two, plane_tests);
}

Crossing crossing(const Scene& scene, const OverlapProof& proof, std::uint32_t& plane_tests) {
  return Search(scene, plane_tests).run(proof);
}

}  // namespace swiftlet
