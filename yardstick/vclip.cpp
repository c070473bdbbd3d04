// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The states and the order of their tests are the paper's: the first plane violated for a vertex and for an edge, the most
// violated one for a face. A step goes to the same feature as there, in exact arithmetic. What we do otherwise, to be faster:
//
// An edge x is clipped to a Voronoi region, and the derivative of the distance at the two clips tells which way to leave. That
// distance is convex along x, so its derivative at `low` is positive exactly when the nearest point of x's line lies before
// `low`. Hence one point, clamped to x, is tested against each plane, and clips are computed only for the planes it violates:
//
//        region  |//////////|           nearest
//     -----------|==========|--------------+------ x      beyond the plane at `high`: leave through it
//               low       high
//
// Deviations: the paper compares heights at both ends of an edge to leave a vertex over a face; we take the slope at the
// vertex. Parallel edges take the middle of their overlap. Penetration has no depth here. The cap grows with the bodies and is
// reported.
#include "vclip.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "geometry.h"

namespace swiftlet::yardstick {
namespace {

Vec normal(const VclipPlane& p) { return {p.x, p.y, p.z}; }
Vec axis(const VclipEdge& e) { return {e.axis_x, e.axis_y, e.axis_z}; }
Vec point(const VclipBody& body, FeatureId v) {
  const VclipVertex& record = body.vertices[v.index()];
  return {record.x, record.y, record.z};
}
double beyond(const VclipPlane& plane, const Vec& p) { return dot(normal(plane), p) - plane.offset; }

FeatureId vertex(std::uint32_t index) { return {FeatureKind::Vertex, index}; }
FeatureId edge(std::uint32_t index) { return {FeatureKind::Edge, index}; }
FeatureId face(std::uint32_t index) { return {FeatureKind::Face, index}; }

// ---- A body ----------------------------------------------------------------------------------------------------------------

VclipPlane plane_through(const Vec& n, const Vec& p) { return {n.x, n.y, n.z, dot(n, p)}; }

VclipPlane face_plane(const ConvexView& view, std::uint32_t f) {
  const std::uint32_t h = view.face_first[f];
  const Vec p = vec(view.vertices[origin(view, h)]);
  if (f < view.planes.size()) return plane_through({view.planes[f].x, view.planes[f].y, view.planes[f].z}, p);
  const Vec q = vec(view.vertices[view.half_edges[h].head]),
            r = vec(view.vertices[view.half_edges[next_in_facet(view, h)].head]);
  const Vec n = cross(q - p, r - p);
  return plane_through(n * (1 / norm(n)), p);
}

/// Of an edge beside no face: nothing violates it.
constexpr VclipPlane kOpen{0, 0, 0, -1};

VclipPlane side_plane(const Vec& along, const VclipPlane& face, const Vec& p) {
  const Vec m = cross(along, normal(face));
  return plane_through(m * (1 / norm(m)), p);
}

VclipEdge make_edge(const ConvexView& view, std::uint32_t h, const std::vector<VclipPlane>& faces) {
  const std::uint32_t tail = origin(view, h), head = view.half_edges[h].head, left = view.half_edges[h].face,
                      right = right_face(view, h);
  const Vec p = vec(view.vertices[tail]), q = vec(view.vertices[head]), d = q - p;
  const double length = norm(d);
  const Vec u = d * (1 / length);
  const auto neighbour = [](std::uint32_t f) { return f == kNone ? FeatureId{} : face(f); };
  const auto side = [&](std::uint32_t f, const Vec& along) { return f == kNone ? kOpen : side_plane(along, faces[f], p); };
  return {u.x,
          u.y,
          u.z,
          dot(u, p),
          dot(u, q),
          length,
          vertex(tail),
          vertex(head),
          neighbour(left),
          neighbour(right),
          {side(left, u), side(right, -u)}};
}

/// Every second place, then the others. In the order around the vertex, the first plane violated would mostly be the one at the
/// end of those violated, which leads away sideways: a tenth more steps. The paper's lists have no order.
std::uint32_t scattered(std::uint32_t k, std::uint32_t count) {
  const std::uint32_t evens = (count + 1) / 2;
  return k < evens ? 2 * k : 2 * (k - evens) + 1;
}

VclipVertex empty_vertex(const Vec& p) {
  VclipVertex v{p.x, p.y, p.z, kNone, 0, {}, {}, {}, {}, {}, {}, {}};
  std::fill(std::begin(v.offset), std::end(v.offset), 1);
  std::fill(std::begin(v.far_offset), std::end(v.far_offset), 1);
  return v;
}

void set_plane(VclipVertex& v, std::uint32_t place, std::uint32_t half_edge, const VclipEdge& e) {
  const double sign = half_edge % 2 == 0 ? 1 : -1;
  v.edge[place] = edge(half_edge / 2);
  v.neighbour[place] = half_edge % 2 == 0 ? e.head : e.tail;
  v.plane_x[place] = sign * e.axis_x;
  v.plane_y[place] = sign * e.axis_y;
  v.plane_z[place] = sign * e.axis_z;
  v.offset[place] = half_edge % 2 == 0 ? e.tail_at : -e.head_at;
  v.far_offset[place] = half_edge % 2 == 0 ? e.head_at : -e.tail_at;
}

}  // namespace

VclipBody::VclipBody(const ConvexView& view) {
  assert(view.vertices.size() > 1);
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) faces.push_back(face_plane(view, f));

  std::vector<std::uint32_t> half_edge(view.half_edges.size(), kNone);  // ours for the view's
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    if (view.half_edges[h].twin < h || is_diagonal(view, h)) continue;
    half_edge[h] = std::uint32_t(2 * edges.size());
    half_edge[view.half_edges[h].twin] = half_edge[h] + 1;
    edges.push_back(make_edge(view, h, faces));
  }
  vertex_count = view.vertices.size();
  for (const Vertex& v : view.vertices) vertices.push_back(empty_vertex(vec(v)));
  for (std::uint32_t i = 0; i < vertex_count; ++i) {
    const Vertex& v = view.vertices[i];
    std::uint32_t record = i, place = 0;
    for (std::uint32_t k = 0; k < v.ring_count; ++k) {
      const std::uint32_t h = half_edge[v.ring_begin + scattered(k, v.ring_count)];
      if (h == kNone) continue;
      if (place == 8) {
        record = vertices[record].next = std::uint32_t(vertices.size());
        vertices.push_back(empty_vertex(vec(v)));
        place = 0;
      }
      set_plane(vertices[record], place++, h, edges[h / 2]);
    }
  }
  loop_begin.push_back(0);
  for (const std::uint32_t first : view.face_first) {
    std::uint32_t h = first;
    do loop.push_back(half_edge[h]);
    while ((h = next_in_face(view, h)) != first);
    loop_begin.push_back(std::uint32_t(loop.size()));
  }
}

std::size_t VclipBody::bytes() const {
  const auto of = [](const auto& v) { return v.size() * sizeof v[0]; };
  return of(vertices) + of(edges) + of(faces) + of(loop_begin) + of(loop);
}

// ---- A query ---------------------------------------------------------------------------------------------------------------

namespace {

/// The pose, from B's frame into A's.
struct IntoA {
  const double* r;  ///< columns
  Vec t;
  Vec turn(const Vec& n) const {
    return {r[0] * n.x + r[3] * n.y + r[6] * n.z, r[1] * n.x + r[4] * n.y + r[7] * n.z, r[2] * n.x + r[5] * n.y + r[8] * n.z};
  }
  Vec apply(const Vec& p) const { return turn(p) + t; }
};
/// Its inverse, where the rotation is one.
struct IntoB {
  const double* r;
  Vec t;
  Vec turn(const Vec& n) const {
    return {r[0] * n.x + r[1] * n.y + r[2] * n.z, r[3] * n.x + r[4] * n.y + r[5] * n.z, r[6] * n.x + r[7] * n.y + r[8] * n.z};
  }
  Vec apply(const Vec& p) const { return turn(p) + t; }
};

/// One body of a query: its feature, and its last vertex as the other body sees it.
template <class IntoOther>
struct Side {
  const VclipBody& body;
  IntoOther out;
  FeatureId feature;
  FeatureId carried{};
  Vec carried_at{0, 0, 0};

  Vec carry() {
    if (carried != feature) {
      carried = feature;
      carried_at = out.apply(point(body, feature));
    }
    return carried_at;
  }
};

/// Bit k: n . p - offset > 0 for plane k of a vertex.
unsigned violated(const VclipVertex& v, const Vec& p) {
  unsigned bits = 0;
#ifdef __SSE2__
  const __m128d x = _mm_set1_pd(p.x), y = _mm_set1_pd(p.y), z = _mm_set1_pd(p.z);
  for (int k = 0; k < 8; k += 2) {
    const __m128d xy = _mm_add_pd(_mm_mul_pd(_mm_load_pd(v.plane_x + k), x), _mm_mul_pd(_mm_load_pd(v.plane_y + k), y));
    const __m128d xyz = _mm_add_pd(xy, _mm_mul_pd(_mm_load_pd(v.plane_z + k), z));
    bits |= unsigned(_mm_movemask_pd(_mm_cmpgt_pd(xyz, _mm_load_pd(v.offset + k)))) << k;
  }
#else
  for (int k = 0; k < 8; ++k) bits |= unsigned(v.plane_x[k] * p.x + v.plane_y[k] * p.y + v.plane_z[k] * p.z > v.offset[k]) << k;
#endif
  return bits;
}

/// Bit k: n . d > 0.
unsigned leading(const VclipVertex& v, const Vec& d) {
  unsigned bits = 0;
#ifdef __SSE2__
  const __m128d x = _mm_set1_pd(d.x), y = _mm_set1_pd(d.y), z = _mm_set1_pd(d.z);
  for (int k = 0; k < 8; k += 2) {
    const __m128d xy = _mm_add_pd(_mm_mul_pd(_mm_load_pd(v.plane_x + k), x), _mm_mul_pd(_mm_load_pd(v.plane_y + k), y));
    const __m128d xyz = _mm_add_pd(xy, _mm_mul_pd(_mm_load_pd(v.plane_z + k), z));
    bits |= unsigned(_mm_movemask_pd(_mm_cmpgt_pd(xyz, _mm_setzero_pd()))) << k;
  }
#else
  for (int k = 0; k < 8; ++k) bits |= unsigned(v.plane_x[k] * d.x + v.plane_y[k] * d.y + v.plane_z[k] * d.z > 0) << k;
#endif
  return bits;
}

/// An edge in the other's frame, and the point of it that is tested.
struct Segment {
  Vec tail, along;  ///< along is a unit vector
  double length, at;
};

enum class Found : std::uint8_t { Moved, Disjoint, Penetrating };

class Clip {
 public:
  std::uint32_t plane_tests = 0;
  std::uint32_t hops = 0;  ///< moves that were two steps of the paper's
  double distance = 0;
  Vec first{0, 0, 0},
      second{0, 0, 0};  ///< nearest points, of the first argument's body and the second's, both in the second's frame

  template <class A, class B>
  Found vertex_vertex(A& a, B& b) {
    const Vec q = b.carry();
    if (follow_edge(a, q)) return Found::Moved;
    const Vec p = a.carry();
    if (follow_edge(b, p)) return Found::Moved;
    return settle(p, point(b.body, b.feature));
  }

  template <class A, class B>
  Found vertex_edge(A& a, B& b) {
    const VclipEdge& e = b.body.edges[b.feature.index()];
    const Vec p = a.carry();
    const Violations out(e, p);
    plane_tests += 4;
    if (out.bits != 0) return move(b, out.first(e));
    const double at = out.at - e.tail_at;
    const Vec foot = point(b.body, e.tail) + axis(e) * at;
    if (clip_to_vertex(a, b, e, foot, at)) return Found::Moved;
    return settle(p, foot);
  }

  template <class A, class B>
  Found vertex_face(A& a, B& b) {
    const std::uint32_t f = b.feature.index();
    const Vec p = a.carry();
    double most = 0;
    std::uint32_t out = kNone;
    for (std::uint32_t k = b.body.loop_begin[f]; k < b.body.loop_begin[f + 1]; ++k) {
      const std::uint32_t h = b.body.loop[k];
      const double violation = beyond(b.body.edges[h / 2].side[h % 2], p);
      out = violation > most ? h / 2 : out;
      most = violation > most ? violation : most;
    }
    plane_tests += b.body.loop_begin[f + 1] - b.body.loop_begin[f] + 1;
    if (out != kNone) return move(b, edge(out));

    const VclipPlane& plane = b.body.faces[f];
    const double height = beyond(plane, p);
    if (height == 0) return Found::Penetrating;
    const Vec up = b.out.turn(normal(plane)), toward = height > 0 ? -up : up;
    if (leave_vertex(a, [&](const VclipVertex& v) { return leading(v, toward); })) return Found::Moved;
    if (height > 0) return settle(p, p - normal(plane) * height);
    return escape(b, p);
  }

  template <class A, class B>
  Found edge_edge(A& a, B& b) {
    const VclipEdge &ea = a.body.edges[a.feature.index()], &eb = b.body.edges[b.feature.index()];
    Segment sa{a.out.apply(point(a.body, ea.tail)), a.out.turn(axis(ea)), ea.length, 0};
    Segment sb{point(b.body, eb.tail), axis(eb), eb.length, 0};
    nearest(sa, sb);
    const Vec pa = sa.tail + sa.along * sa.at, pb = sb.tail + sb.along * sb.at;
    plane_tests += 4;
    if (const Violations out(eb, pa); out.bits != 0) return move(b, out.single() ? out.first(eb) : leave_edge(eb, pa, sa));
    plane_tests += 4;
    const Vec pb_a = b.out.apply(pb);
    if (const Violations out(ea, pb_a); out.bits != 0) {
      sb.along = b.out.turn(sb.along);
      return move(a, out.single() ? out.first(ea) : leave_edge(ea, pb_a, sb));
    }
    return settle(pa, pb);
  }

  template <class A, class B>
  Found edge_face(A& a, B& b) {
    const VclipEdge& e = a.body.edges[a.feature.index()];
    const std::uint32_t f = b.feature.index(), begin = b.body.loop_begin[f], end = b.body.loop_begin[f + 1];
    const Segment s{a.out.apply(point(a.body, e.tail)), a.out.turn(axis(e)), e.length, 0};
    double low = 0, high = s.length;
    std::uint32_t low_side = kNone, high_side = kNone;
    plane_tests += 2 * (end - begin);
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t h = b.body.loop[k];
      const VclipPlane& plane = b.body.edges[h / 2].side[h % 2];
      const double at_tail = beyond(plane, s.tail), slope = dot(normal(plane), s.along), at_head = at_tail + slope * s.length;
      if (at_tail > 0 && at_head > 0) return move(b, nearest_on_rim(b.body, f, k, s));
      if (at_tail > 0) {
        if (const double at = -at_tail / slope; at > low) low = at, low_side = k;
      } else if (at_head > 0) {
        if (const double at = -at_tail / slope; at < high) high = at, high_side = k;
      }
    }
    if (low > high) {  // between two sides; from the one beyond which more of the edge lies
      return move(b,
                  nearest_on_rim(b.body, f,
                                 high_side == kNone || (low_side != kNone && low + high > s.length) ? low_side : high_side, s));
    }
    const VclipPlane& plane = b.body.faces[f];
    const double at_tail = beyond(plane, s.tail), slope = dot(normal(plane), s.along);
    const double at_low = at_tail + slope * low, at_high = at_tail + slope * high;
    plane_tests += 2;
    if (!(at_low * at_high > 0)) return Found::Penetrating;
    const bool take_low = std::fabs(at_low) <= std::fabs(at_high);
    const std::uint32_t side = take_low ? low_side : high_side;
    if (side != kNone) return move(b, edge(b.body.loop[side] / 2));
    return move(a, take_low ? e.tail : e.head);
  }

 private:
  /// Which planes of an edge's region a point is beyond: tail, head, left, right.
  struct Violations {
    double at;  ///< along the axis
    unsigned bits;
    Violations(const VclipEdge& e, const Vec& p) : at(dot(axis(e), p)) {
      bits = unsigned(at < e.tail_at) | unsigned(at > e.head_at) << 1 | unsigned(beyond(e.side[0], p) < 0) << 2 |
             unsigned(beyond(e.side[1], p) < 0) << 3;
    }
    bool single() const { return std::has_single_bit(bits); }
    FeatureId first(const VclipEdge& e) const { return (&e.tail)[std::countr_zero(bits)]; }
  };

  template <class A>
  static Found move(A& side, FeatureId to) {
    side.feature = to;
    return Found::Moved;
  }

  Found settle(const Vec& p, const Vec& q) {
    first = p;
    second = q;
    const Vec d = q - p;
    const double distance2 = dot(d, d);
    if (!(distance2 > 0)) return Found::Penetrating;
    distance = std::sqrt(distance2);
    return Found::Disjoint;
  }

  /// Moves to the first edge whose plane `p` is beyond; and on to its other end, as the next state would, if `p` is beyond that
  /// too: planes of tail and head come first there.
  template <class A>
  bool follow_edge(A& side, const Vec& p) {
    for (std::uint32_t record = side.feature.index(); record != kNone;) {
      const VclipVertex& v = side.body.vertices[record];
      const unsigned bits = violated(v, p);
      plane_tests += 8;
      if (bits != 0) {
        const int k = std::countr_zero(bits);
        const bool past = v.plane_x[k] * p.x + v.plane_y[k] * p.y + v.plane_z[k] * p.z > v.far_offset[k];
        side.feature = past ? v.neighbour[k] : v.edge[k];
        hops += past;
        ++plane_tests;
        return true;
      }
      record = v.next;
    }
    return false;
  }

  /// Moves to the first edge of the vertex that `test` names.
  template <class A, class Test>
  bool leave_vertex(A& side, Test test) {
    for (std::uint32_t record = side.feature.index(); record != kNone;) {
      const VclipVertex& v = side.body.vertices[record];
      const unsigned bits = test(v);
      plane_tests += 8;
      if (bits != 0) {
        side.feature = v.edge[std::countr_zero(bits)];
        return true;
      }
      record = v.next;
    }
    return false;
  }

  /// Clips edge `e` of b to the vertex of a; `foot` is its point nearest to that, `at` from its tail.
  template <class A, class B>
  bool clip_to_vertex(A& a, const B& b, const VclipEdge& e, const Vec& foot, double at) {
    const Vec q = b.out.apply(foot);
    FeatureId low_edge, high_edge;
    double low = 0, high = 0;
    for (std::uint32_t record = a.feature.index(); record != kNone;) {
      const VclipVertex& v = a.body.vertices[record];
      plane_tests += 8;
      unsigned bits = violated(v, q);
      record = v.next;
      if (record == kNone && low_edge == FeatureId{} && high_edge == FeatureId{} && std::has_single_bit(bits)) {
        a.feature = v.edge[std::countr_zero(bits)];  // whatever its clip
        return true;
      }
      for (; bits != 0; bits &= bits - 1) {
        const int k = std::countr_zero(bits);
        const Vec n{v.plane_x[k], v.plane_y[k], v.plane_z[k]};
        const double violation = dot(n, q) - v.offset[k], slope = dot(n, b.out.turn(axis(e)));
        ++plane_tests;
        const double at_tail = violation - slope * at, at_head = violation + slope * (e.length - at),
                     crossing = violation / -slope;
        if (at_tail > 0 && at_head > 0) {
          a.feature = v.edge[k];
          return true;
        }
        if (at_tail > 0) {
          if (crossing > low) low = crossing, low_edge = v.edge[k];
        } else if (crossing < high) {
          high = crossing, high_edge = v.edge[k];
        }
      }
    }
    const FeatureId out = low_edge != FeatureId{} ? low_edge : high_edge;
    if (out == FeatureId{}) return false;
    a.feature = out;
    return true;
  }

  /// A vertex below a face and no edge that leads up: if no face has it outside, the bodies overlap.
  template <class B>
  Found escape(B& b, const Vec& p) {
    double most = 0;
    std::uint32_t out = kNone;
    for (std::uint32_t f = 0; f < b.body.faces.size(); ++f) {
      const double height = beyond(b.body.faces[f], p);
      if (height > most) most = height, out = f;
    }
    plane_tests += std::uint32_t(b.body.faces.size());
    return out == kNone ? Found::Penetrating : move(b, face(out));
  }

  /// Sets where the two lines are nearest, each clamped to its segment.
  static void nearest(Segment& a, Segment& b) {
    const Vec r = a.tail - b.tail;
    const double c = dot(a.along, b.along), ra = dot(a.along, r), rb = dot(b.along, r), sine2 = 1 - c * c;
    double at;
    if (sine2 > kParallel) {
      at = (c * rb - ra) / sine2;
    } else {  // the middle of the overlap
      const double from = -ra, to = c * b.length - ra;
      at = (clamp(from, a.length) + clamp(to, a.length)) / 2;
    }
    b.at = clamp(rb + c * at, b.length);
    a.at = clamp(at, a.length);
  }

  static double clamp(double x, double high) {
    const double above = x > 0 ? x : 0.0;
    return above < high ? above : high;
  }

  /// Where to go from `e` when the point `p` of the other edge `s` nearest to it is outside of its region.
  FeatureId leave_edge(const VclipEdge& e, const Vec& p, const Segment& s) {
    const double at = dot(axis(e), p), along = dot(axis(e), s.along);
    const double inside[4] = {at - e.tail_at, e.head_at - at, beyond(e.side[0], p), beyond(e.side[1], p)};
    const double slopes[4] = {along, -along, dot(normal(e.side[0]), s.along), dot(normal(e.side[1]), s.along)};
    plane_tests += 3;
    double low = 0, high = 0;  // from s.at
    FeatureId low_to, high_to, end, excluding;
    for (int k = 0; k < 4; ++k) {
      if (!(inside[k] < 0)) continue;
      const FeatureId to = (&e.tail)[k];
      const double at_tail = inside[k] - slopes[k] * s.at, at_head = inside[k] + slopes[k] * (s.length - s.at);
      if (at_tail < 0 && at_head < 0) {  // all of s
        if (k < 2) return to;
        if (excluding == FeatureId{}) excluding = to;
        continue;
      }
      if (k < 2) end = to;
      const double crossing = -inside[k] / slopes[k];
      if (at_tail < 0) {
        if (crossing > low) low = crossing, low_to = to;
      } else if (crossing < high) {
        high = crossing, high_to = to;
      }
    }
    const bool nothing_left = low_to != FeatureId{} && high_to != FeatureId{};
    if (end != FeatureId{} && (excluding != FeatureId{} || nothing_left)) return end;
    if (excluding != FeatureId{}) return excluding;
    return low_to != FeatureId{} ? low_to : high_to;
  }

  /// The side or corner of a face nearest to an edge that misses its prism: from side `k` of its loop along the rim.
  FeatureId nearest_on_rim(const VclipBody& body, std::uint32_t f, std::uint32_t k, Segment s) {
    const std::uint32_t begin = body.loop_begin[f], end = body.loop_begin[f + 1];
    int heading = 0;
    for (std::uint32_t visited = 0; visited <= end - begin; ++visited) {
      const std::uint32_t h = body.loop[k];
      const VclipEdge& e = body.edges[h / 2];
      Segment side{point(body, e.tail), axis(e), e.length, 0};
      nearest(s, side);
      const double at = dot(axis(e), s.tail + s.along * s.at);
      plane_tests += 2;
      if (at >= e.tail_at && at <= e.head_at) {
        ++plane_tests;
        if (beyond(e.side[h % 2], s.tail + s.along * s.at) > 0) return edge(h / 2);
        break;  // that side would send us back
      }
      const bool past_tail = at < e.tail_at, forward = past_tail == (h % 2 == 1);
      if (heading == (forward ? -1 : 1)) return past_tail ? e.tail : e.head;
      heading = forward ? 1 : -1;
      k = forward ? (k + 1 == end ? begin : k + 1) : (k == begin ? end : k) - 1;
    }
    return nearest_of_all(body, f, s);
  }

  /// The same by measuring every side.
  FeatureId nearest_of_all(const VclipBody& body, std::uint32_t f, Segment s) {
    double least2 = std::numeric_limits<double>::infinity();
    FeatureId best;
    for (std::uint32_t k = body.loop_begin[f]; k < body.loop_begin[f + 1]; ++k) {
      const std::uint32_t at = body.loop[k] / 2;
      const VclipEdge& e = body.edges[at];
      const Vec tail = point(body, e.tail), r = s.tail - tail;
      Segment side{tail, axis(e), e.length, 0};
      nearest(s, side);
      side.at = clamp(dot(side.along, r + s.along * s.at), side.length);
      s.at = clamp(dot(s.along, side.along * side.at - r), s.length);
      const Vec d = r + s.along * s.at - side.along * side.at;
      plane_tests += 2;
      if (const double distance2 = dot(d, d); distance2 < least2) {
        least2 = distance2;
        best = side.at > 0 ? side.at < side.length ? edge(at) : e.head : e.tail;
      }
    }
    return best;
  }

  /// Squared sine below which edges count as parallel: rounding turns the nearest point by 1e-16 over this.
  static constexpr double kParallel = 1e-14;
};

Found visit(Clip& clip, Side<IntoB>& a, Side<IntoA>& b) {
  constexpr auto state = [](FeatureKind ka, FeatureKind kb) { return unsigned(ka) * 4 + unsigned(kb); };
  using enum FeatureKind;
  switch (state(a.feature.kind(), b.feature.kind())) {
    case state(Vertex, Vertex): return clip.vertex_vertex(a, b);
    case state(Vertex, Edge): return clip.vertex_edge(a, b);
    case state(Edge, Vertex): return clip.vertex_edge(b, a);
    case state(Vertex, Face): return clip.vertex_face(a, b);
    case state(Face, Vertex): return clip.vertex_face(b, a);
    case state(Edge, Edge): return clip.edge_edge(a, b);
    case state(Edge, Face): return clip.edge_face(a, b);
    case state(Face, Edge): return clip.edge_face(b, a);
    default: __builtin_unreachable();
  }
}

FeatureId valid(const VclipBody& body, FeatureId h) {
  const bool names = h.kind() == FeatureKind::Vertex ? h.index() < body.vertex_count
                     : h.kind() == FeatureKind::Edge ? h.index() < body.edges.size()
                                                     : h.kind() == FeatureKind::Face && h.index() < body.faces.size();
  return names ? h : vertex(0);
}

}  // namespace

VclipResult vclip(const VclipBody& body_a, const VclipBody& body_b, const Pose& b_in_a, VclipSeed& seed) {
  const IntoA into_a{b_in_a.rotation.data(), vec(b_in_a.translation)};
  IntoB into_b{into_a.r, {0, 0, 0}};
  into_b.t = -into_b.turn(into_a.t);
  Side<IntoB> a{body_a, into_b, valid(body_a, seed.a)};
  Side<IntoA> b{body_b, into_a, valid(body_b, seed.b)};
  if (a.feature.kind() == FeatureKind::Face && b.feature.kind() == FeatureKind::Face) b.feature = vertex(0);
  const auto cap = std::uint32_t(5000 + 2 * (body_a.edges.size() + body_b.edges.size()));
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  VclipResult result{VclipEnd::Capped, kUnknown, Vec3::Constant(kUnknown), Vec3::Constant(kUnknown)};
  Clip clip;
  while (result.steps < cap) {
    const Found outcome = visit(clip, a, b);
    if (outcome == Found::Moved) {
      ++result.steps;
      continue;
    }
    result.end = outcome == Found::Disjoint ? VclipEnd::Disjoint : VclipEnd::Penetrating;
    result.distance = outcome == Found::Disjoint ? clip.distance : 0;
    if (outcome == Found::Disjoint) {
      const bool first_is_a = a.feature.kind() <= b.feature.kind();  // the points are in the frame of the second argument
      result.point_a = eigen(first_is_a ? into_a.apply(clip.first) : clip.second);
      result.point_b = eigen(first_is_a ? into_a.apply(clip.second) : clip.first);
    }
    break;
  }
  result.steps += clip.hops;
  result.plane_tests = clip.plane_tests;
  seed = {a.feature, b.feature};
  return result;
}

}  // namespace swiftlet::yardstick
