// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A cold start: from the line of centres towards the direction of the distance by steps of [Gilbert, Johnson & Keerthi 1988]
// whose supports come from maps, one look-up each and no climb. Every step proves bounds. Knows one level pair.
#pragma once

#include <cstdint>
#include <limits>

#include <swiftlet/march.h>

#include "body/support_map.h"
#include "pair/certify.h"
#include "pair/pair_view.h"
#include "pair/simplex.h"

namespace swiftlet {

/// What one step saw.
struct SupportGjk {
  std::uint32_t a = 0, b = 0;  ///< supports along `normal` and against it, as the maps know them
  double gap = 0;              ///< of these vertices along `normal`
  double lower = 0;            ///< proved along `normal`: less than the gap by what the maps are uncertain of; may be negative
  double most_lower = -std::numeric_limits<double>::infinity();  ///< of all steps so far: more steps never prove less
  Vec lower_along{0, 0, 0};                                      ///< what that is proved along
  double upper = 0;                                              ///< the distance of the points
  Vec normal{0, 0, 0}, point_a{0, 0, 0}, point_b{0, 0, 0};
  bool near = false;                       ///< `a` and `b` lie no more than a few edges aside of each other: a walk is cheaper
  std::uint32_t start_a = 0, start_b = 0;  ///< where a walk begins: the first supports that were near, else these
  bool meets = false;  ///< the pair seems to overlap: the differences of `proof`'s vertices look to hold the origin
  OverlapProof proof{};
};

/// What maps say along one direction, of any length.
struct AxisSample {
  Vec normal{0, 0, 0};                 ///< the direction at length 1; 0 where it names none
  std::uint32_t a = 0, b = 0;          ///< supports along it and against it, as the maps know them
  Vec point{0, 0, 0}, apart{0, 0, 0};  ///< A's, and from there to B's
  double gap = 0, lower = 0;           ///< as in SupportGjk
};
/// Looks up before the length is known: cells are where a direction of any length goes.
static inline AxisSample sample_axis(const PairView& pair, const Level& a, const Level& b, const Vec& direction) {
  const Moved other = body_b(pair);
  const MapSupport top_a = look_up(a, direction), top_b = look_up(b, -other.into(direction));
  const Vec q = body_a(pair).point(top_a.vertex), p = other.point(top_b.vertex) - q;
  const auto [n, scale] = unit_of(direction);
  return {n, top_a.vertex, top_b.vertex, q, p, dot(n, p), gap(pair, n, p, (top_a.excess + top_b.excess) * scale)};
}

/// Goes on from what was sampled, until that is enough or nothing changes. Both levels have maps. Supports that overlap by
/// less than `hidden` count as near too.
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
