// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The vertex that is extreme in a direction, without a climb, and a bound on how wrong that may be. h(n), the height of a body
// along n, is convex in n, and n . v is linear: over a cell of the cube, h(n) - n . v is nowhere more than at the cell's
// corners.
#pragma once

#include <bit>
#include <cstdint>

#include <cube.h>
#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// An entry: a vertex in the low 24 bits, the excess over the level's extent in the high eight: 0, or as a number of five bits
/// exponent and three bits mantissa from 2^-29 to 7. No excess is over 4: two coordinates of the direction differ by at most 1
/// from the middle of the cell, and those of two vertices by 2.
inline constexpr std::uint32_t kMapVertices = 1u << 24;
/// The finest level with a map has at most so many, where there is a choice: cells are no more than three of its edges wide.
inline constexpr std::size_t kMappedVertices = 4096;

static inline std::uint32_t map_vertex(std::uint32_t entry) { return entry & (kMapVertices - 1); }
/// Of the height of a direction whose largest coordinate is 1; over the extent.
static inline double map_excess(std::uint32_t entry) {
  const std::uint64_t code = entry >> 24;
  return code == 0 ? 0 : std::bit_cast<double>((std::uint64_t(1023 - 29) << 52) + ((code - 1) << 49));
}

static inline std::uint32_t map_entry(std::uint32_t vertex, double excess) {
  std::uint32_t code = 0;
  while (map_excess(code << 24) < excess) ++code;
  return code << 24 | vertex;
}

/// A vertex of a level, and what no other exceeds it by along the direction it was asked for.
struct MapSupport {
  std::uint32_t vertex;
  double excess;  ///< times the direction's length; rounding included
};
static inline MapSupport look_up(const Level& level, const Vec& n) {
  const lut::CubeHit hit = lut::cube_hit(level.map_side, n.x, n.y, n.z);
  const std::uint32_t entry = level.support_map[hit.cell];
  return {map_vertex(entry), (map_excess(entry) + kMapError) * level.view.extent * hit.major};
}

}  // namespace swiftlet
