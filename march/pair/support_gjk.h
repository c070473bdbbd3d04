// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A cold start on support maps. The direction is at first about that between ellipsoids, between round bodies the line of
// centres, and turns towards that of the distance: by what ellipsoids make of the supports seen, or by the steps of GJK
// [Gilbert, Johnson & Keerthi 1988]. Each support is one look-up in a table of directions, a support map, without a climb.
// Every look proves bounds. Knows one level pair.
#pragma once

#include <bit>
#include <cstdint>

#include <swiftlet/march.h>

#include "body/support_map.h"
#include "pair/certify.h"
#include "pair/ellipsoids.h"
#include "pair/pair_view.h"
#include "pair/pair_view4.h"
#include "pair/simplex.h"
#include "pair/stop_rule.h"

namespace swiftlet {

/// The supports that the maps have along one direction, and the bound that they prove.
struct AxisSample {
  Vec normal;          ///< the direction at length 1; 0 if it names no direction
  std::uint32_t a, b;  ///< support vertices of A along `normal` and of B against it, as the maps have them
  Vec point, apart;    ///< vertex `a`, and the vector from it to vertex `b`: common frame
  double gap;          ///< between vertices `a` and `b` along `normal`
  double lower;        ///< bound proved along `normal`: the gap less rounding and the maps' uncertainty; may be negative
};
/// Samples the maps along `direction`, of any length: cells do not depend on it, and so need not wait for it, unless it is so
/// short that M n may underflow. `other` is B.
[[gnu::flatten]] static inline AxisSample sample_axis(const PairView& pair, const Moved4& other, const Level& a, const Level& b,
                                                      const Vec4& direction) {
  const double square = dot(direction, direction);
  const bool has_length = has_range(square);
  const Vec4 way = has_length ? direction : normalised_far(direction);
  const auto [top_a, top_b] = look_up(a, way, b, -other.into(way));
  const double inverse = has_length ? 1 / std::sqrt(square) : 1;
  const Vec4 n = way * inverse, q = vec4(pair.a.vertices[top_a.vertex]), p = other.point(top_b.vertex) - q;
  const double excess = (top_a.excess + top_b.excess) * inverse + kMapError * (pair.a.extent + pair.b.extent);
  return {vec(n), top_a.vertex, top_b.vertex, vec(q), vec(p), dot(n, p), gap(pair, n, p, excess)};
}
static inline AxisSample sample_axis(const PairView& pair, const Level& a, const Level& b, const Vec& direction) {
  return sample_axis(pair, Moved4(pair), a, b, vec4(direction));
}

/// A sample along the same direction without the maps' doubt: its vertices are those that climbs from those of `seen` reach.
static inline AxisSample climbed(const PairView& pair, const AxisSample& seen, std::uint32_t& plane_tests) {
  const auto [a, b, lower] = supports(pair, seen.normal, seen.a, seen.b, plane_tests);
  const Vec point = body_a(pair).point(a), apart = body_b(pair).point(b) - point;
  return {seen.normal, a, b, point, apart, dot(seen.normal, apart), lower};
}

/// The squared length by which the supports of a sample lie aside of each other.
static inline double aside2(const AxisSample& seen) { return dot(seen.apart, seen.apart) - seen.gap * seen.gap; }
/// True if the supports of a sample lie aside of each other by few edges: a walk from them is cheaper than another step.
/// Supports that overlap, but by less than `hidden`, count too.
static inline bool are_near(const AxisSample& seen, const Level& a, const Level& b, double hidden) {
  const double few = kNearEdges * (a.edge_length + b.edge_length);
  return seen.gap > -hidden && aside2(seen) <= few * few;
}

/// The last of the samples that follow `seen`, each along the direction between ellipsoids moved to the supports of the one
/// before, as long as the gap grows, supports are not near, and each look halves the length by which they lie aside. Between
/// bodies curved about as ellipsoids are, one or two looks come near, however fine the bodies are; GJK takes more steps the
/// finer they are. Between others the first look does not halve that length, and GJK follows. `hidden`: as of `are_near`.
static inline AxisSample best_sample(const PairView& pair, const Moved4& other, const Level& a, const Level& b, double hidden,
                                     const AxisSample& seen) {
  const Ellipsoids bodies(a, b, pair.b_in_a);
  AxisSample best = seen;
  for (int looks = 0; looks < kEllipsoidLooks && !are_near(best, a, b, hidden); ++looks) {
    const Vec4 way = bodies.onward(vec4(best.normal), vec4(best.apart));
    if (!has_range(dot(way, way))) break;
    const AxisSample next = sample_axis(pair, other, a, b, way);
    if (!(next.gap > best.gap)) break;
    const bool goes_on = aside2(next) < kLookShare * kLookShare * aside2(best);
    best = next;
    if (!goes_on) break;
  }
  return best;
}

/// A face around a vertex, and how far another point is above it along a direction.
struct FaceBelow {
  std::uint32_t face = kNone;  ///< none is known
  double gap = kInfinity;
};
/// The face around vertex `v` that is below the point at `way` from `v`, seen against the outward direction `n`: both in the
/// body's own frame. Of a ring of fewer than four edges, or more than a mask has bits, none is known. It is a place to begin
/// at, and no proof: in a pose that mirrors, it is another one.
[[gnu::always_inline]] static inline FaceBelow face_below(const ConvexView& view, std::uint32_t v, const Vec4& way,
                                                          const Vec4& n) {
  const Vertex* vertices = view.vertices.data();
  const Vertex& record = vertices[v];
  const HalfEdge* ring = view.half_edges.data() + record.ring_begin;
  const std::uint32_t count = record.ring_count, last = count - 4;
  if (count < 4 || count > 31) return {};
  // Edges counter-clockwise of the way, up to half a turn, fall along this vector: the first one ends the face.
  const Vec4 p = vec4(record), along = cross(way, n), height = all(dot(along, p));
  const auto falls = [&](std::uint32_t i) {
    const HalfEdge* h = ring + i;
    return greater(height, dot(repeated(along),
                               transposed(vertices[h[0].head], vertices[h[1].head], vertices[h[2].head], vertices[h[3].head])))
           << i;
  };
  std::uint32_t fallen = falls(last);
  for (std::uint32_t i = 0; i < last; i += 4) fallen |= falls(i);
  const std::uint32_t next_fallen = fallen >> 1 | fallen << (count - 1), begins = next_fallen & ~fallen & ((1u << count) - 1);
  if (begins == 0) return {};
  const std::uint32_t i = std::uint32_t(std::countr_zero(begins)), j = i + 1 == count ? 0 : i + 1;
  const Vec4 normal = cross(vec4(vertices[ring[i].head]) - p, vec4(vertices[ring[j].head]) - p);
  const Vec2 heights = dots(normal, way, normal, n);
  if (!(heights[1] > 0)) return {};
  return {ring[i].face, heights[0] / heights[1]};
}

static inline MarchStart supports_of(const AxisSample& seen) {
  return {{FeatureKind::Vertex, seen.a}, {FeatureKind::Vertex, seen.b}};
}
/// Where a walk begins from supports: at both vertices. If these lie farther aside of each other than they are apart, the
/// vector between them tells little of the direction between the bodies. Then it is a vertex and the face below it, of either
/// body's the one that is nearer along the normal. `other` is B.
[[gnu::flatten]] static inline MarchStart start_from(const PairView& pair, const Moved4& other, const AxisSample& seen) {
  MarchStart start = supports_of(seen);
  if (dot(seen.apart, seen.apart) < 2 * seen.gap * seen.gap) return start;
  const Vec4 way = vec4(seen.apart), n = vec4(seen.normal);
  const FaceBelow of_a = face_below(pair.a, seen.a, way, n),
                  of_b = face_below(pair.b, seen.b, other.into(-way), other.into(-n));
  if (of_b.gap < of_a.gap)
    start.b = {FeatureKind::Face, of_b.face};
  else if (of_a.face != kNone)
    start.a = {FeatureKind::Face, of_a.face};
  return start;
}

/// The state of a cold start after a look.
struct SupportGjk {
  AxisSample seen;                 ///< the last sample
  double most_lower = -kInfinity;  ///< the greatest `lower` of the samples that were kept
  Vec lower_along{0, 0, 0};        ///< the normal along which `most_lower` is proved
  double upper = kInfinity;        ///< about the distance of the points of `feet_of`
  bool near = false;               ///< some supports were near each other
  MarchStart start;                ///< where a walk begins: from the first supports that were `near`, else at the last
  Simplex simplex;                 ///< its nearest point gives the next direction; with four corners, the pair seems to overlap
};

/// A point of A, the vector from it to a point of B, and an upper bound on the distance of the bodies.
struct Feet {
  Vec point, apart;
  double upper;
};
/// The points of both bodies that the simplex's weights make of its corners.
static inline Feet feet_of(const PairView& pair, const Simplex& simplex) {
  Feet feet{{0, 0, 0}, {0, 0, 0}, 0};
  for (int k = 0; k < simplex.count; ++k) {
    feet.point = feet.point + body_a(pair).point(simplex.corner[k].va) * simplex.weight[k];
    feet.apart = feet.apart + simplex.corner[k].p * simplex.weight[k];
  }
  feet.upper = norm(feet.apart) * (1 + kNormError) + pair.point_error();
  return feet;
}

/// Continues from the sample `seen` until `enough` returns true or nothing changes, for at most `kMapGjkSteps` steps. Both
/// levels have maps. `hidden`: as of `are_near`.
template <class Enough>
[[gnu::flatten]] static SupportGjk support_gjk(const PairView& pair, const Level& a, const Level& b, double hidden,
                                               const AxisSample& seen, Enough enough) {
  const Moved4 other(pair);
  SupportGjk s;
  s.seen = seen;
  for (int steps = 0;; ++steps) {
    if (s.seen.lower > s.most_lower) s.most_lower = s.seen.lower, s.lower_along = s.seen.normal;
    const bool was_near = s.near;
    s.near = was_near || are_near(s.seen, a, b, hidden);
    if (!was_near) s.start = s.near ? start_from(pair, other, s.seen) : supports_of(s.seen);
    const bool known = s.simplex.has(s.seen.a, s.seen.b);
    if (!known) add(s.simplex, {s.seen.apart, s.seen.a, s.seen.b});
    const Vec4 nearest = vec4(s.simplex.nearest);
    s.upper = s.simplex.count == 4 ? 0 : norm(nearest);
    if (known || s.simplex.count == 4 || !(s.upper > pair.point_error()) || enough(s) || steps == kMapGjkSteps) return s;
    s.seen = sample_axis(pair, other, a, b, nearest);
  }
}

/// Where a walk begins at a sample, without `seen` and simplex.
static inline SupportGjk found_at(const PairView& pair, const Moved4& other, const AxisSample& seen) {
  SupportGjk found;
  found.most_lower = seen.lower, found.lower_along = seen.normal;
  found.near = true, found.start = start_from(pair, other, seen);
  return found;
}
/// Where a walk begins on from a sample whose supports are not near: at the best sample if it has come near, else where GJK
/// does, unless its bounds are as narrow as `asked` before. A function of its own: mostly the first supports are near.
[[maybe_unused, gnu::noinline, gnu::flatten]] static SupportGjk search_maps(const PairView& pair, const Level& a,
                                                                            const Level& b, double hidden,
                                                                            const StopRule& asked, const AxisSample& known) {
  const Moved4 other(pair);
  const AxisSample seen = best_sample(pair, other, a, b, hidden, known);
  if (!are_near(seen, a, b, hidden)) {
    return support_gjk(pair, a, b, hidden, seen,
                       [&](const SupportGjk& s) { return s.near || asked.narrow(max(0, s.most_lower), s.upper + hidden); });
  }
  SupportGjk found = found_at(pair, other, seen);
  found.seen = seen;
  return found;
}

}  // namespace swiftlet
