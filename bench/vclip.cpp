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
// Deviations: the paper compares heights at both ends of an edge to leave a vertex over a face; we take the slope at the vertex.
// Parallel edges take the middle of their overlap. Penetration has no depth here. The cap grows with the bodies and is reported.
#include "vclip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "ring.h"
#include "vec.h"

namespace swiftlet::bench {
namespace {

Vec normal(const VclipPlane& p) { return {p.x, p.y, p.z}; }
Vec axis(const VclipEdge& e) { return {e.axis_x, e.axis_y, e.axis_z}; }
Vec point(const VclipVertex& v) { return {v.x, v.y, v.z}; }
Vec point(const VclipBody& body, std::uint32_t v) { return point(body.vertices[v]); }
double beyond(const VclipPlane& plane, const Vec& p) { return dot(normal(plane), p) - plane.offset; }

Handle vertex(std::uint32_t index) { return {FeatureKind::Vertex, index}; }
Handle edge(std::uint32_t index) { return {FeatureKind::Edge, index}; }
Handle face(std::uint32_t index) { return {FeatureKind::Face, index}; }

// ---- A body ----------------------------------------------------------------------------------------------------------------

VclipPlane plane_through(const Vec& n, const Vec& p) { return {n.x, n.y, n.z, dot(n, p)}; }

VclipPlane face_plane(const ConvexView& view, std::uint32_t f) {
  const std::uint32_t h = view.face_first[f];
  const Vec p = vec(view.vertices[origin(view, h)]);
  if (f < view.planes.size()) return plane_through({view.planes[f].x, view.planes[f].y, view.planes[f].z}, p);
  const Vec q = vec(view.vertices[view.head[h]]), r = vec(view.vertices[view.head[next_in_facet(view, h)]]);
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
  const std::uint32_t tail = origin(view, h), head = view.head[h], left = view.face[h], right = right_face(view, h);
  const Vec p = vec(view.vertices[tail]), q = vec(view.vertices[head]), d = q - p;
  const double length = norm(d);
  const Vec u = d * (1 / length);
  return {u.x, u.y, u.z, dot(u, p), dot(u, q), length, tail, head, {left, right},
          {left == kNone ? kOpen : side_plane(u, faces[left], p), right == kNone ? kOpen : side_plane(-u, faces[right], p)}};
}

/// Every second place, then the others. In the order around the vertex, the first plane violated would mostly be the one at the
/// end of those violated, which leads away sideways: a tenth more steps. The paper's lists have no order.
std::uint32_t scattered(std::uint32_t k, std::uint32_t count) {
  const std::uint32_t evens = (count + 1) / 2;
  return k < evens ? 2 * k : 2 * (k - evens) + 1;
}

}  // namespace

VclipBody::VclipBody(const ConvexView& view) {
  assert(view.vertices.size() > 1);
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) faces.push_back(face_plane(view, f));

  std::vector<std::uint32_t> half_edge(view.head.size(), kNone);  // ours for the view's
  for (std::uint32_t h = 0; h < view.head.size(); ++h) {
    if (view.twin[h] < h || is_diagonal(view, h)) continue;
    half_edge[h] = std::uint32_t(2 * edges.size());
    half_edge[view.twin[h]] = half_edge[h] + 1;
    edges.push_back(make_edge(view, h, faces));
  }
  for (const Vertex& v : view.vertices) {
    const auto begin = std::uint32_t(ring.size());
    for (std::uint32_t k = 0; k < v.ring_count; ++k) {
      const std::uint32_t h = v.ring_begin + scattered(k, v.ring_count);
      if (half_edge[h] == kNone) continue;
      const VclipEdge& e = edges[half_edge[h] / 2];
      const Vec u = axis(e);
      ring.push_back(half_edge[h]);
      ring_planes.push_back(half_edge[h] % 2 == 0 ? VclipPlane{u.x, u.y, u.z, e.tail_at} : VclipPlane{-u.x, -u.y, -u.z, -e.head_at});
    }
    vertices.push_back({v.x, v.y, v.z, begin, std::uint32_t(ring.size()) - begin});
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
  return of(vertices) + of(ring_planes) + of(ring) + of(edges) + of(faces) + of(loop_begin) + of(loop);
}

// ---- A query ---------------------------------------------------------------------------------------------------------------

namespace {

/// One body of a query: its feature, and its last vertex as the other body sees it.
struct Side {
  const VclipBody& body;
  Motion out;  ///< into the other's frame
  Handle feature;
  std::uint32_t carried = kNone;
  Vec carried_at{0, 0, 0};
};

Vec carry(Side& side, std::uint32_t v) {
  if (side.carried != v) {
    side.carried = v;
    side.carried_at = apply(side.out, point(side.body, v));
  }
  return side.carried_at;
}

/// An edge in the other's frame, and the point of it that is tested.
struct Segment {
  Vec tail, along;  ///< along is a unit vector
  double length, at;
};

enum class Outcome : std::uint8_t { Moved, Disjoint, Penetrating };

class Clip {
 public:
  std::uint32_t plane_tests = 0;
  double distance = 0;
  Vec first{0, 0, 0}, second{0, 0, 0};  ///< nearest points, of the first argument's body and the second's, both in the second's frame

  Outcome vertex_vertex(Side& a, Side& b) {
    const std::uint32_t i = a.feature.index(), j = b.feature.index();
    if (leave_vertex(a, i, carry(b, j)) || leave_vertex(b, j, carry(a, i))) return Outcome::Moved;
    return settle(carry(a, i), point(b.body, j));
  }

  Outcome vertex_edge(Side& a, Side& b) {
    const std::uint32_t i = a.feature.index();
    const VclipEdge& e = b.body.edges[b.feature.index()];
    const Vec p = carry(a, i), u = axis(e);
    const double at = dot(u, p);
    plane_tests += 4;
    if (at < e.tail_at) return move(b, vertex(e.tail));
    if (at > e.head_at) return move(b, vertex(e.head));
    if (beyond(e.side[0], p) < 0) return move(b, face(e.face[0]));
    if (beyond(e.side[1], p) < 0) return move(b, face(e.face[1]));
    const Vec foot = point(b.body, e.tail) + u * (at - e.tail_at);
    if (clip_to_vertex(a, i, b, e, foot, at - e.tail_at)) return Outcome::Moved;
    return settle(p, foot);
  }

  Outcome vertex_face(Side& a, Side& b) {
    const std::uint32_t i = a.feature.index(), f = b.feature.index();
    const Vec p = carry(a, i);
    double most = 0;
    std::uint32_t out = kNone;
    for (std::uint32_t k = b.body.loop_begin[f]; k < b.body.loop_begin[f + 1]; ++k) {
      const std::uint32_t h = b.body.loop[k];
      const double violation = beyond(b.body.edges[h / 2].side[h % 2], p);
      if (violation > most) most = violation, out = h / 2;
    }
    plane_tests += b.body.loop_begin[f + 1] - b.body.loop_begin[f] + 1;
    if (out != kNone) return move(b, edge(out));

    const VclipPlane& plane = b.body.faces[f];
    const double height = beyond(plane, p);
    if (height == 0) return Outcome::Penetrating;
    const Vec up = turn(b.out, normal(plane)), away = height > 0 ? up : -up;
    const VclipVertex& v = a.body.vertices[i];
    for (std::uint32_t k = v.ring_begin; k < v.ring_begin + v.ring_count; ++k) {
      ++plane_tests;
      if (dot(normal(a.body.ring_planes[k]), away) < 0) return move(a, edge(a.body.ring[k] / 2));
    }
    if (height > 0) return settle(p, p - normal(plane) * height);
    return escape(b, p);
  }

  Outcome edge_edge(Side& a, Side& b) {
    const VclipEdge &ea = a.body.edges[a.feature.index()], &eb = b.body.edges[b.feature.index()];
    Segment sa{apply(a.out, point(a.body, ea.tail)), turn(a.out, axis(ea)), ea.length, 0};
    Segment sb{point(b.body, eb.tail), axis(eb), eb.length, 0};
    nearest(sa, sb);
    const Vec pa = sa.tail + sa.along * sa.at, pb = sb.tail + sb.along * sb.at;
    plane_tests += 4;
    if (outside(eb, pa)) return move(b, leave_edge(eb, pa, sa));
    plane_tests += 4;
    const Vec pb_a = apply(b.out, pb);
    if (outside(ea, pb_a)) {
      sb.along = turn(b.out, sb.along);
      return move(a, leave_edge(ea, pb_a, sb));
    }
    return settle(pa, pb);
  }

  Outcome edge_face(Side& a, Side& b) {
    const VclipEdge& e = a.body.edges[a.feature.index()];
    const std::uint32_t f = b.feature.index(), begin = b.body.loop_begin[f], end = b.body.loop_begin[f + 1];
    const Segment s{apply(a.out, point(a.body, e.tail)), turn(a.out, axis(e)), e.length, 0};
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
      return move(b, nearest_on_rim(b.body, f, high_side == kNone || (low_side != kNone && low + high > s.length) ? low_side : high_side, s));
    }
    const VclipPlane& plane = b.body.faces[f];
    const double at_tail = beyond(plane, s.tail), slope = dot(normal(plane), s.along);
    const double at_low = at_tail + slope * low, at_high = at_tail + slope * high;
    plane_tests += 2;
    if (!(at_low * at_high > 0)) return Outcome::Penetrating;
    const bool take_low = std::fabs(at_low) <= std::fabs(at_high);
    const std::uint32_t side = take_low ? low_side : high_side;
    if (side != kNone) return move(b, edge(b.body.loop[side] / 2));
    return move(a, vertex(take_low ? e.tail : e.head));
  }

 private:
  static Outcome move(Side& side, Handle to) {
    side.feature = to;
    return Outcome::Moved;
  }

  Outcome settle(const Vec& p, const Vec& q) {
    first = p;
    second = q;
    const Vec d = q - p;
    const double distance2 = dot(d, d);
    if (!(distance2 > 0)) return Outcome::Penetrating;
    distance = std::sqrt(distance2);
    return Outcome::Disjoint;
  }

  /// Moves to the first edge of vertex `i` whose plane `p` is beyond.
  bool leave_vertex(Side& side, std::uint32_t i, const Vec& p) {
    const VclipVertex& v = side.body.vertices[i];
    for (std::uint32_t k = v.ring_begin; k < v.ring_begin + v.ring_count; ++k) {
      ++plane_tests;
      if (beyond(side.body.ring_planes[k], p) > 0) {
        side.feature = edge(side.body.ring[k] / 2);
        return true;
      }
    }
    return false;
  }

  /// Clips edge `e` of b, whose point nearest to vertex `i` of a is `foot`, `at` from its tail.
  bool clip_to_vertex(Side& a, std::uint32_t i, const Side& b, const VclipEdge& e, const Vec& foot, double at) {
    const VclipVertex& v = a.body.vertices[i];
    const Vec q = apply(b.out, foot);
    std::uint32_t low_edge = kNone, high_edge = kNone;
    double low = 0, high = 0;
    for (std::uint32_t k = v.ring_begin; k < v.ring_begin + v.ring_count; ++k) {
      const VclipPlane& plane = a.body.ring_planes[k];
      const double violation = beyond(plane, q);
      ++plane_tests;
      if (!(violation > 0)) continue;
      const double slope = dot(normal(plane), turn(b.out, axis(e)));
      ++plane_tests;
      const double at_tail = violation - slope * at, at_head = violation + slope * (e.length - at), crossing = violation / -slope;
      if (at_tail > 0 && at_head > 0) {
        a.feature = edge(a.body.ring[k] / 2);
        return true;
      }
      if (at_tail > 0) {
        if (crossing > low) low = crossing, low_edge = k;
      } else if (crossing < high) {
        high = crossing, high_edge = k;
      }
    }
    const std::uint32_t out = low_edge != kNone ? low_edge : high_edge;
    if (out == kNone) return false;
    a.feature = edge(a.body.ring[out] / 2);
    return true;
  }

  /// A vertex below a face and no edge that leads up: if no face has it outside, the bodies overlap.
  Outcome escape(Side& b, const Vec& p) {
    double most = 0;
    std::uint32_t out = kNone;
    for (std::uint32_t f = 0; f < b.body.faces.size(); ++f) {
      const double height = beyond(b.body.faces[f], p);
      if (height > most) most = height, out = f;
    }
    plane_tests += std::uint32_t(b.body.faces.size());
    return out == kNone ? Outcome::Penetrating : move(b, face(out));
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

  static double clamp(double x, double high) { return std::fmin(std::fmax(x, 0), high); }

  static bool outside(const VclipEdge& e, const Vec& p) {
    const double at = dot(axis(e), p);
    return at < e.tail_at || at > e.head_at || beyond(e.side[0], p) < 0 || beyond(e.side[1], p) < 0;
  }

  /// Where to go from `e` when the point `p` of the other edge `s` nearest to it is outside of its region.
  Handle leave_edge(const VclipEdge& e, const Vec& p, const Segment& s) {
    const Handle ends[2] = {vertex(e.tail), vertex(e.head)};
    const double at = dot(axis(e), p), along = dot(axis(e), s.along);
    const double inside[4] = {at - e.tail_at, e.head_at - at, beyond(e.side[0], p), beyond(e.side[1], p)};
    const double slopes[4] = {along, -along, dot(normal(e.side[0]), s.along), dot(normal(e.side[1]), s.along)};
    plane_tests += 3;
    double low = 0, high = 0;  // from s.at
    Handle low_to, high_to, end, excluding;
    for (int k = 0; k < 4; ++k) {
      if (!(inside[k] < 0)) continue;
      const Handle to = k < 2 ? ends[k] : face(e.face[k - 2]);
      const double at_tail = inside[k] - slopes[k] * s.at, at_head = inside[k] + slopes[k] * (s.length - s.at);
      if (at_tail < 0 && at_head < 0) {  // all of s
        if (k < 2) return to;
        if (excluding == Handle{}) excluding = to;
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
    const bool nothing_left = low_to != Handle{} && high_to != Handle{};
    if (end != Handle{} && (excluding != Handle{} || nothing_left)) return end;
    if (excluding != Handle{}) return excluding;
    return low_to != Handle{} ? low_to : high_to;
  }

  /// The side or corner of a face nearest to an edge that misses its prism: from side `k` of its loop along the rim.
  Handle nearest_on_rim(const VclipBody& body, std::uint32_t f, std::uint32_t k, Segment s) {
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
      if (heading == (forward ? -1 : 1)) return vertex(past_tail ? e.tail : e.head);
      heading = forward ? 1 : -1;
      k = forward ? (k + 1 == end ? begin : k + 1) : (k == begin ? end : k) - 1;
    }
    return nearest_of_all(body, f, s);
  }

  /// The same by measuring every side.
  Handle nearest_of_all(const VclipBody& body, std::uint32_t f, Segment s) {
    double least2 = std::numeric_limits<double>::infinity();
    Handle best;
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
        best = side.at > 0 ? side.at < side.length ? edge(at) : vertex(e.head) : vertex(e.tail);
      }
    }
    return best;
  }

  /// Squared sine below which edges count as parallel: rounding turns the nearest point by 1e-16 over this.
  static constexpr double kParallel = 1e-14;
};

Outcome visit(Clip& clip, Side& a, Side& b, bool& first_is_a) {
  using enum FeatureKind;
  const FeatureKind ka = a.feature.kind(), kb = b.feature.kind();
  first_is_a = ka < kb || ka == kb;
  if (ka == Vertex && kb == Vertex) return clip.vertex_vertex(a, b);
  if (ka == Vertex && kb == Edge) return clip.vertex_edge(a, b);
  if (ka == Edge && kb == Vertex) return clip.vertex_edge(b, a);
  if (ka == Edge && kb == Edge) return clip.edge_edge(a, b);
  if (ka == Vertex) return clip.vertex_face(a, b);
  if (kb == Vertex) return clip.vertex_face(b, a);
  return ka == Edge ? clip.edge_face(a, b) : clip.edge_face(b, a);
}

Handle valid(const VclipBody& body, Handle h) {
  const std::size_t counts[4] = {0, body.vertices.size(), body.edges.size(), body.faces.size()};
  return h.index() < counts[std::size_t(h.kind())] ? h : vertex(0);
}

/// The inverse for a rotation that is one.
Motion inverse(const Motion& m) {
  const Vec x{m.row_x.x, m.row_y.x, m.row_z.x}, y{m.row_x.y, m.row_y.y, m.row_z.y}, z{m.row_x.z, m.row_y.z, m.row_z.z};
  return {x, y, z, {-dot(x, m.t), -dot(y, m.t), -dot(z, m.t)}};
}

}  // namespace

VclipResult vclip(const VclipBody& body_a, const VclipBody& body_b, const Pose& b_in_a, VclipSeed& seed) {
  const Motion b_to_a = motion(b_in_a);
  Side a{body_a, inverse(b_to_a), valid(body_a, seed.a)}, b{body_b, b_to_a, valid(body_b, seed.b)};
  if (a.feature.kind() == FeatureKind::Face && b.feature.kind() == FeatureKind::Face) b.feature = vertex(0);
  const auto cap = std::uint32_t(5000 + 2 * (body_a.edges.size() + body_b.edges.size()));
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  VclipResult result{VclipEnd::Capped, kUnknown, Vec3::Constant(kUnknown), Vec3::Constant(kUnknown)};
  Clip clip;
  while (result.steps < cap) {
    bool first_is_a;
    const Outcome outcome = visit(clip, a, b, first_is_a);
    if (outcome == Outcome::Moved) {
      ++result.steps;
      continue;
    }
    result.end = outcome == Outcome::Disjoint ? VclipEnd::Disjoint : VclipEnd::Penetrating;
    result.distance = outcome == Outcome::Disjoint ? clip.distance : 0;
    if (outcome == Outcome::Disjoint) {  // the points are in the frame of the second argument
      result.point_a = eigen(first_is_a ? apply(b_to_a, clip.first) : clip.second);
      result.point_b = eigen(first_is_a ? apply(b_to_a, clip.second) : clip.first);
    }
    break;
  }
  result.plane_tests = clip.plane_tests;
  seed = {a.feature, b.feature};
  return result;
}

}  // namespace swiftlet::bench
