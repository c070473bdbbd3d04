// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Support maps: a table of directions gives an approximate support vertex v without a climb, and a bound on its error, the
// excess. The support function h(n) of a body is convex in n and n . v is linear, so over a cell of the cube of directions
// h(n) - n . v is largest at a corner of the cell.
#pragma once

#include <bit>
#include <cstdint>

#include <cube.h>
#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// An entry of a map holds a vertex in the low 24 bits and the excess, relative to the level's extent, in the high eight: 0, or
/// a number of five bits exponent and three bits mantissa from 2^-29 to 7. No excess is over 4 extents: two coordinates of the
/// direction differ by at most 1 from the cell's middle, and two vertices by at most 2 extents in a coordinate.
inline constexpr std::uint32_t kMapVertices = 1u << 24;
/// The most vertices of the finest level with a map, except where every level has more. A cell is then at most three of the
/// level's edges wide.
inline constexpr std::size_t kMappedVertices = 4096;

static inline std::uint32_t map_vertex(std::uint32_t entry) { return entry & (kMapVertices - 1); }
/// The excess of an entry, relative to the level's extent, for a direction whose largest coordinate is 1.
static inline double map_excess(std::uint32_t entry) {
  const std::uint64_t code = entry >> 24;
  return code == 0 ? 0 : std::bit_cast<double>((std::uint64_t(1023 - 29) << 52) + ((code - 1) << 49));
}

static inline std::uint32_t map_entry(std::uint32_t vertex, double excess) {
  std::uint32_t code = 0;
  while (map_excess(code << 24) < excess) ++code;
  return code << 24 | vertex;
}

/// A vertex of a level, and a bound on how much higher any other vertex is along the direction that was looked up.
struct MapSupport {
  std::uint32_t vertex;
  double excess;  ///< a height along the direction at its given length; includes rounding errors
};
static inline MapSupport look_up(const Level& level, const Vec& n) {
  const lut::CubeHit hit = lut::cube_hit(level.map_side, n.x, n.y, n.z);
  const std::uint32_t entry = level.support_map[hit.cell];
  return {map_vertex(entry), (map_excess(entry) + kMapError) * level.view.extent * hit.major};
}

}  // namespace swiftlet
