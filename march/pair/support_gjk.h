// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// GJK on support maps for a cold start [Gilbert, Johnson & Keerthi 1988]. The direction is at first the line of centres and
// turns towards that of the distance. Each support is one look-up in a table of directions, a support map, without a climb.
// Every step proves bounds. Knows one level pair.
#pragma once

#include <cstdint>
#include <limits>

#include <swiftlet/march.h>

#include "body/support_map.h"
#include "pair/certify.h"
#include "pair/pair_view.h"
#include "pair/simplex.h"

namespace swiftlet {

/// The state of the algorithm after a step.
struct SupportGjk {
  std::uint32_t a = 0, b = 0;  ///< support vertices of A along `normal` and of B against it, as the maps have them
  double gap = 0;              ///< between vertices `a` and `b` along `normal`
  double lower = 0;  ///< bound proved along `normal`: the gap less rounding and the maps' uncertainty; may be negative
  double most_lower = -std::numeric_limits<double>::infinity();  ///< the greatest `lower` of all steps so far
  Vec lower_along{0, 0, 0};                                      ///< the normal along which `most_lower` is proved
  double upper = 0;  ///< upper bound: the distance of `point_a` and `point_b` plus rounding
  Vec normal{0, 0, 0}, point_a{0, 0, 0}, point_b{0, 0, 0};
  bool near = false;  ///< `a` and `b` are within a few edges of each other across `normal`: a walk is cheaper
  std::uint32_t start_a = 0, start_b = 0;  ///< where a walk begins: the first supports that were `near`, else `a` and `b`
  bool meets = false;  ///< the pair seems to overlap: in doubles, the differences of the pairs in `proof` hold the origin
  OverlapProof proof{};
};

/// The supports that the maps have along one direction, and the bound that they prove.
struct AxisSample {
  Vec normal;          ///< the direction at length 1; 0 if it names no direction
  std::uint32_t a, b;  ///< support vertices of A along `normal` and of B against it, as the maps have them
  Vec point, apart;    ///< vertex `a`, and the vector from it to vertex `b`: common frame
  double gap, lower;   ///< as in SupportGjk
};
/// Samples the maps along `direction`. It may have any length, because its positive multiples all lie in the same cell of a
/// map.
static inline AxisSample sample_axis(const PairView& pair, const Level& a, const Level& b, const Vec& direction) {
  const Moved other = body_b(pair);
  const MapSupport top_a = look_up(a, direction), top_b = look_up(b, -other.into(direction));
  const Vec q = body_a(pair).point(top_a.vertex), p = other.point(top_b.vertex) - q;
  const auto [n, scale] = unit_of(direction);
  return {n, top_a.vertex, top_b.vertex, q, p, dot(n, p), gap(pair, n, p, (top_a.excess + top_b.excess) * scale)};
}

/// Continues from the sample `seen` until `enough` returns true or nothing changes, for at most `kMapGjkSteps` steps. Both
/// levels have maps. Supports that overlap, but by less than `hidden`, count as `near` too.
template <class Enough>
SupportGjk support_gjk(const PairView& pair, const Level& a, const Level& b, double hidden, AxisSample seen, Enough enough) {
  const double few = kNearEdges * (a.edge_length + b.edge_length);
  Simplex simplex;
  SupportGjk s;
  bool was_near = false;
  s.upper = std::numeric_limits<double>::infinity();
  for (int steps = 0;; ++steps) {
    const Vec &n = seen.normal, &q = seen.point, &p = seen.apart;
    s.a = seen.a, s.b = seen.b;
    s.gap = seen.gap, s.lower = seen.lower;
    s.normal = n;
    if (s.lower > s.most_lower) s.most_lower = s.lower, s.lower_along = n;
    const double upper = norm(p) * (1 + kNormError) + pair.point_error;
    if (upper < s.upper) s.upper = upper, s.point_a = q, s.point_b = q + p;
    const Vec aside = p - n * s.gap;
    s.near = s.gap > -hidden && dot(aside, aside) <= few * few;
    if (!was_near) s.start_a = s.a, s.start_b = s.b;
    was_near = was_near || s.near;
    if (enough(s) || steps == kMapGjkSteps || simplex.has(s.a, s.b)) return s;
    const Simplex::Nearest nearest = simplex.add({p, q, s.a, s.b});
    if (nearest.count == 4) {
      s.meets = true;
      s.proof = simplex.proof();
      return s;
    }
    const Simplex::Points points = simplex.reduce(nearest);
    const double distance = norm(nearest.point), nearer = norm(points.apart) * (1 + kNormError) + pair.point_error;
    if (nearer < s.upper) s.upper = nearer, s.point_a = points.a, s.point_b = points.a + points.apart;
    if (!(distance > pair.point_error)) return s;
    seen = sample_axis(pair, a, b, nearest.point);
  }
}

}  // namespace swiftlet
