// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// GJK on support maps for a cold start [Gilbert, Johnson & Keerthi 1988]. The direction is at first about that between
// ellipsoids, between round bodies the line of centres, and turns towards that of the distance. Each support is one look-up in
// a table of directions, a support map, without a climb. Every step proves bounds. Knows one level pair.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>

#include "body/support_map.h"
#include "pair/certify.h"
#include "pair/pair_view.h"
#include "pair/pair_view4.h"
#include "pair/simplex.h"

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

/// True if the supports of a sample lie aside of each other by few edges: a walk from them is cheaper than another step.
/// Supports that overlap, but by less than `hidden`, count too.
static inline bool are_near(const AxisSample& seen, const Level& a, const Level& b, double hidden) {
  const double few = kNearEdges * (a.edge_length + b.edge_length);
  return seen.gap > -hidden && dot(seen.apart, seen.apart) - seen.gap * seen.gap <= few * few;
}

/// The state of the algorithm after a step.
struct SupportGjk {
  AxisSample seen;                         ///< the last sample
  double most_lower = -kInfinity;          ///< the greatest `lower` of all samples
  Vec lower_along{0, 0, 0};                ///< the normal along which `most_lower` is proved
  double upper = kInfinity;                ///< about the distance of the points of `feet_of`
  bool near = false;                       ///< some supports were near each other
  std::uint32_t start_a = 0, start_b = 0;  ///< where a walk begins: the first supports that were `near`, else the last
  Simplex simplex;  ///< its nearest point gives the next direction; with four corners, the pair seems to overlap
};

/// A point of A, the vector from it to a point of B, and an upper bound on the distance of the bodies.
struct Feet {
  Vec point, apart;
  double upper;
};
/// The points of both bodies that the simplex's weights make of its corners.
static inline Feet feet_of(const PairView& pair, const Simplex& simplex) {
  Feet feet{{0, 0, 0}, {0, 0, 0}, 0};
  for (int k = 0; k < simplex.count(); ++k) {
    feet.point = feet.point + body_a(pair).point(simplex[k].va) * simplex.weight(k);
    feet.apart = feet.apart + simplex[k].p * simplex.weight(k);
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
    if (!was_near) s.start_a = s.seen.a, s.start_b = s.seen.b;
    const bool known = s.simplex.has(s.seen.a, s.seen.b);
    if (!known) s.simplex.add({s.seen.apart, s.seen.a, s.seen.b});
    const Vec4 nearest = vec4(s.simplex.nearest());
    s.upper = s.simplex.count() == 4 ? 0 : norm(nearest);
    if (known || s.simplex.count() == 4 || !(s.upper > pair.point_error()) || enough(s) || steps == kMapGjkSteps) return s;
    s.seen = sample_axis(pair, other, a, b, nearest);
  }
}

}  // namespace swiftlet
