// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Support maps: a table of directions gives an approximate support vertex v without a climb, and a bound on its error, the
// excess. The support function h(n) of a body is convex in n and n . v is linear, so over a cell of directions h(n) - n . v is
// largest at a corner of the cell or at a pole of the octahedron in its middle, where v is the highest.
//
// Directions are looked up as M n, where M is the level's map frame. The heights of the body's points x along n are those of
// the points M^-T x along M n, and these make a body that is about as wide in all directions. So plates and needles need no
// more cells than balls.
#pragma once

#include <array>
#include <cstdint>

#include <octahedron.h>
#include <swiftlet/model.h>

#include "numeric/vec4.h"

namespace swiftlet {

/// An entry of a map holds a vertex in the low 24 bits and in the high eight the excess for a direction whose image by the map
/// frame has coordinates that sum to 1 in magnitude: 0, or a number of five bits exponent and three bits mantissa from 2^-29 to
/// 7. No excess is over 4: the coordinates of two directions in a cell differ by at most 2 in all, and those of two points
/// M^-T x by at most 2 each.
inline constexpr std::uint32_t kMapVertices = 1u << 24;

static inline std::uint32_t map_vertex(std::uint32_t entry) { return entry & (kMapVertices - 1); }
/// The excess of an entry.
static inline double map_excess(std::uint32_t entry) {
  const std::uint64_t code = entry >> 24;
  return code == 0 ? 0 : bit_cast<double>((std::uint64_t(1023 - 29) << 52) + ((code - 1) << 49));
}

static inline std::uint32_t map_entry(std::uint32_t vertex, double excess) {
  std::uint32_t code = 0;
  while (map_excess(code << 24) < excess) ++code;
  return code << 24 | vertex;
}

/// M n.
static inline Vec into_map(const std::array<double, 6>& m, const Vec& n) {
  return {m[0] * n.x + m[1] * n.y + m[2] * n.z, m[3] * n.y + m[4] * n.z, m[5] * n.z};
}
static inline Vec into_map(const Level& level, const Vec& n) { return into_map(level.map_frame, n); }

/// M^-T x: the y for which x is M^T y. In an ellipsoid's frame it has length 1 on the surface.
static inline Vec ball_coordinates(const std::array<double, 6>& m, const Vec& x) {
  const double a = x.x / m[0], b = (x.y - m[1] * a) / m[3];
  return {a, b, (x.z - m[2] * a - m[4] * b) / m[5]};
}

/// A direction n for which M n is `m`.
static inline Vec from_map(const std::array<double, 6>& frame, const Vec& m) {
  const double z = m.z / frame[5], y = (m.y - frame[4] * z) / frame[3];
  return {(m.x - frame[1] * y - frame[2] * z) / frame[0], y, z};
}

/// A vertex of a level, and a bound on how much higher any other vertex is along the direction that was looked up.
struct MapSupport {
  std::uint32_t vertex;
  double excess;  ///< a height along the direction at its given length, without `kMapError`
};
static inline MapSupport look_up(const Level& level, const Vec& n) {
  const Vec m = into_map(level, n);
  const lut::OctahedronHit hit = lut::octahedron_hit(level.map_side, m.x, m.y, m.z);
  const std::uint32_t entry = level.support_map[hit.cell];
  return {map_vertex(entry), map_excess(entry) * hit.length};
}

/// The same for a direction of each of two bodies, in two lanes.
struct MapSupports {
  MapSupport a, b;
};
static inline MapSupports look_up(const Level& a, const Vec4& n_a, const Level& b, const Vec4& n_b) {
  const Vec m = into_map(a, vec(n_a)), k = into_map(b, vec(n_b));
  const Vec2 x{m.x, k.x}, y{m.y, k.y}, z{m.z, k.z}, side{double(a.map_side), double(b.map_side)};
  // The cell as `lut::octahedron_hit` finds it.
  const Vec2 length = abs(x) + abs(y) + abs(z), half = side * Vec2{0.5, 0.5}, scale = half / length,
             last = side - Vec2{0.5, 0.5};
  const auto index = [&](Vec2 along) { return whole(max(Vec2{0, 0}, min(last, along * scale + half))); };
  const auto row = index(x - y), column = index(x + y);
  const auto found = [&](const Level& level, std::size_t lane) {
    const auto lower = std::uint32_t(bit_cast<std::uint64_t>(double(z[lane])) >> 63);
    const std::uint32_t cell =
        (lower * level.map_side + std::uint32_t(row[lane])) * level.map_side + std::uint32_t(column[lane]);
    const std::uint32_t entry = level.support_map[cell];
    return MapSupport{map_vertex(entry), map_excess(entry) * length[lane]};
  };
  return {found(a, 0), found(b, 1)};
}

}  // namespace swiftlet
