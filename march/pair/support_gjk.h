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

/// True if a level is about as wide in all directions.
static inline bool is_round(const Level& level) {
  const auto& m = level.map_frame;
  return std::fabs(m[3] - m[0]) + std::fabs(m[5] - m[0]) + std::fabs(m[1]) + std::fabs(m[2]) + std::fabs(m[4]) < kRound * m[0];
}

/// About the direction of the distance, at any length, where `line` is the line of centres: the bodies are taken for
/// ellipsoids, the points M^T y, |y| <= 1, for the map frame M. The distance h of two of them lies along n where (h / |n| +
/// M_a^T M_a / |M_a n| + M_b^T M_b / |M_b n|) n is along `line`, and h / |n| = (n . `line` - |M_a n| - |M_b n|) / n . n.
/// `kEllipsoidSteps` steps take these from the last n. Between round bodies, `line`.
[[gnu::flatten]] static inline Vec4 between_ellipsoids(const Level& a, const Level& b, const Motion& b_in_a, const Vec4& line) {
  if (is_round(a) && is_round(b)) return line;
  using Columns = V3<Vec4>;
  const auto &m = a.map_frame, &f = b.map_frame;
  const Columns turn = transposed(b_in_a.row_x, b_in_a.row_y, b_in_a.row_z, b_in_a.row_z);
  // The rows of M_a, and those of M_b turned into A's frame.
  const Columns rows_a{vec4(m[0], m[1], m[2]), vec4(0, m[3], m[4]), vec4(0, 0, m[5])},
      rows_b{turn.x * f[0] + turn.y * f[1] + turn.z * f[2], turn.y * f[3] + turn.z * f[4], turn.z * f[5]};
  const auto times = [](const Columns& c, const Vec4& v) { return dot(repeated(v), c); };
  const auto square = [](const Columns& rows) {  // M^T M
    const Columns x = repeated(rows.x), y = repeated(rows.y), z = repeated(rows.z);
    return Columns{x.x * rows.x + y.x * rows.y + z.x * rows.z, x.y * rows.x + y.y * rows.y + z.y * rows.z,
                   x.z * rows.x + y.z * rows.y + z.z * rows.z};
  };
  const Columns of_a = square(rows_a), of_b = square(rows_b);
  Vec4 n = line;
  for (int k = 0; k < kEllipsoidSteps; ++k) {
    const double wide_a = std::sqrt(dot(n, times(of_a, n))), wide_b = std::sqrt(dot(n, times(of_b, n))),
                 h = max(0, (dot(n, line) - wide_a - wide_b) / dot(n, n));
    const Vec4 by_a = all(1 / wide_a), by_b = all(1 / wide_b), x = vec4(1, 0, 0) * h + of_a.x * by_a + of_b.x * by_b,
               y = vec4(0, 1, 0) * h + of_a.y * by_a + of_b.y * by_b, z = vec4(0, 0, 1) * h + of_a.z * by_a + of_b.z * by_b;
    // Cramer's rule, without the determinant, which is positive.
    n = times({cross(y, z), cross(z, x), cross(x, y)}, line);
  }
  return has_range(dot(n, n)) ? n : line;
}

/// True if the supports of a sample lie aside of each other by few edges: a walk from them is cheaper than another step.
/// Supports that overlap, but by less than `hidden`, count too.
static inline bool are_near(const AxisSample& seen, const Level& a, const Level& b, double hidden) {
  const double few = kNearEdges * (a.edge_length + b.edge_length);
  return seen.gap > -hidden && dot(seen.apart, seen.apart) - seen.gap * seen.gap <= few * few;
}

/// The state of the algorithm after a step.
struct SupportGjk {
  AxisSample seen;                                               ///< the last sample
  double most_lower = -std::numeric_limits<double>::infinity();  ///< the greatest `lower` of all samples
  Vec lower_along{0, 0, 0};                                      ///< the normal along which `most_lower` is proved
  double upper = std::numeric_limits<double>::infinity();        ///< about the distance of the points of `feet_of`
  bool near = false;                                             ///< some supports were near each other
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
