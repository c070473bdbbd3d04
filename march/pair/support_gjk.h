// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// GJK on support maps for a cold start [Gilbert, Johnson & Keerthi 1988]. The direction is at first about that between
// ellipsoids, between round bodies the line of centres, and turns towards that of the distance. Each support is one look-up in
// a table of directions, a support map, without a climb. Every step proves bounds. Knows one level pair.
#pragma once

#include <cstdint>
#include <limits>

#include <swiftlet/march.h>

#include "body/support_map.h"
#include "pair/certify.h"
#include "pair/pair_view.h"
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
/// Samples the maps along `direction`, of any length: it is normalised first, as M n of a short one may underflow.
[[gnu::flatten]] static inline AxisSample sample_axis(const PairView& pair, const Level& a, const Level& b,
                                                      const Vec& direction) {
  const Moved other = body_b(pair);
  const Vec n = normalised(direction);
  const MapSupport top_a = look_up(a, n), top_b = look_up(b, -other.into(n));
  const Vec q = body_a(pair).point(top_a.vertex), p = other.point(top_b.vertex) - q;
  const double excess = top_a.excess + top_b.excess + kMapError * (pair.a.extent + pair.b.extent);
  return {n, top_a.vertex, top_b.vertex, q, p, dot(n, p), gap(pair, vec4(n), vec4(p), excess)};
}

/// True if a level is about as wide in all directions.
static inline bool is_round(const Level& level) {
  const auto& m = level.map_frame;
  return std::fabs(m[3] - m[0]) + std::fabs(m[5] - m[0]) + std::fabs(m[1]) + std::fabs(m[2]) + std::fabs(m[4]) < kRound * m[0];
}

/// A symmetric matrix.
struct Symmetric {
  double xx, xy, xz, yy, yz, zz;
};
static inline double squared_along(const Symmetric& q, const Vec& n) {
  return n.x * (q.xx * n.x + 2 * (q.xy * n.y + q.xz * n.z)) + n.y * (q.yy * n.y + 2 * q.yz * n.z) + n.z * q.zz * n.z;
}
/// A vector along x for which `q` x is along `v`, for a positive definite `q`.
static inline Vec solved(const Symmetric& q, const Vec& v) {
  const double xx = q.yy * q.zz - q.yz * q.yz, xy = q.xz * q.yz - q.xy * q.zz, xz = q.xy * q.yz - q.xz * q.yy,
               yy = q.xx * q.zz - q.xz * q.xz, yz = q.xy * q.xz - q.xx * q.yz, zz = q.xx * q.yy - q.xy * q.xy;
  return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
}

/// About the direction of the distance, where `line` is the line of centres: the bodies are taken for ellipsoids, the points
/// M^T y, |y| <= 1, for the map frame M. The distance h of two of them lies along n where (h + M_a^T M_a / |M_a n| + M_b^T M_b
/// / |M_b n|) n = `line`. `kEllipsoidSteps` steps take h and the lengths from the last n. Between round bodies, `line`.
[[gnu::flatten]] static inline Vec between_ellipsoids(const Level& a, const Level& b, const Motion& b_in_a, const Vec& line) {
  if (is_round(a) && is_round(b)) return line;
  const auto &m = a.map_frame, &f = b.map_frame;
  const Vec &x = b_in_a.row_x, &y = b_in_a.row_y, &z = b_in_a.row_z;
  const Vec r{x.x * f[0] + x.y * f[1] + x.z * f[2], y.x * f[0] + y.y * f[1] + y.z * f[2], z.x * f[0] + z.y * f[1] + z.z * f[2]},
      s{x.y * f[3] + x.z * f[4], y.y * f[3] + y.z * f[4], z.y * f[3] + z.z * f[4]}, t{x.z * f[5], y.z * f[5], z.z * f[5]};
  const Symmetric of_a{m[0] * m[0],
                       m[0] * m[1],
                       m[0] * m[2],
                       m[1] * m[1] + m[3] * m[3],
                       m[1] * m[2] + m[3] * m[4],
                       m[2] * m[2] + m[4] * m[4] + m[5] * m[5]},
      of_b{r.x * r.x + s.x * s.x + t.x * t.x, r.x * r.y + s.x * s.y + t.x * t.y, r.x * r.z + s.x * s.z + t.x * t.z,
           r.y * r.y + s.y * s.y + t.y * t.y, r.y * r.z + s.y * s.z + t.y * t.z, r.z * r.z + s.z * s.z + t.z * t.z};
  Vec n = normalised(line);
  for (int k = 0; k < kEllipsoidSteps; ++k) {
    const double wide_a = std::sqrt(squared_along(of_a, n)), wide_b = std::sqrt(squared_along(of_b, n)),
                 h = max(0, dot(n, line) - wide_a - wide_b), by_a = 1 / wide_a, by_b = 1 / wide_b;
    n = normalised(
        solved({h + of_a.xx * by_a + of_b.xx * by_b, of_a.xy * by_a + of_b.xy * by_b, of_a.xz * by_a + of_b.xz * by_b,
                h + of_a.yy * by_a + of_b.yy * by_b, of_a.yz * by_a + of_b.yz * by_b, h + of_a.zz * by_a + of_b.zz * by_b},
               line));
  }
  return n;
}

/// The state of the algorithm after a step.
struct SupportGjk {
  AxisSample seen;                                               ///< the last sample
  double most_lower = -std::numeric_limits<double>::infinity();  ///< the greatest `lower` of all samples
  Vec lower_along{0, 0, 0};                                      ///< the normal along which `most_lower` is proved
  double upper = std::numeric_limits<double>::infinity();        ///< about the distance of the points of `feet_of`
  bool near = false;  ///< some supports were within a few edges of each other across `normal`: a walk is cheaper
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
/// levels have maps. Supports that overlap, but by less than `hidden`, count as `near` too.
template <class Enough>
[[gnu::flatten]] static SupportGjk support_gjk(const PairView& pair, const Level& a, const Level& b, double hidden,
                                               const AxisSample& seen, Enough enough) {
  const double few = kNearEdges * (a.edge_length + b.edge_length);
  SupportGjk s;
  s.seen = seen;
  for (int steps = 0;; ++steps) {
    if (s.seen.lower > s.most_lower) s.most_lower = s.seen.lower, s.lower_along = s.seen.normal;
    const bool was_near = s.near;
    s.near = was_near || (s.seen.gap > -hidden && dot(s.seen.apart, s.seen.apart) - s.seen.gap * s.seen.gap <= few * few);
    if (!was_near) s.start_a = s.seen.a, s.start_b = s.seen.b;
    const bool known = s.simplex.has(s.seen.a, s.seen.b);
    if (!known) s.simplex.add({s.seen.apart, s.seen.a, s.seen.b});
    s.upper = s.simplex.count() == 4 ? 0 : norm(s.simplex.nearest());
    if (known || s.simplex.count() == 4 || !(s.upper > pair.point_error()) || enough(s) || steps == kMapGjkSteps) return s;
    s.seen = sample_axis(pair, a, b, s.simplex.nearest());
  }
}

}  // namespace swiftlet
