// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions by where they leave an octahedron: its upper and its lower half, each a square of side x side cells when seen
// along z and turned by 45 degrees. Additions, one division, no libm; hence the same on every machine. Static, so that every
// unit compiles its own copy under its own floating-point flags. Knows nothing of hulls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "double_bits.h"

namespace swiftlet::lut {

static inline std::uint32_t octahedron_cell_count(std::uint32_t side) { return 2 * side * side; }

/// Where a direction leaves the octahedron.
struct OctahedronHit {
  std::uint32_t cell;
  double length;  ///< the sum of the direction's coordinates, as magnitudes
};
/// Of a direction of any length; of no direction (0, NaN) some cell. side >= 1.
static inline OctahedronHit octahedron_hit(std::uint32_t side, double x, double y, double z) {
  const double length = std::fabs(x) + std::fabs(y) + std::fabs(z), half = 0.5 * side, scale = half / length, last = side - 0.5;
  const auto index = [&](double along) {  // 1 is in the last cell, as are infinities; beside a NaN any is in some
    const double at = along * scale + half, least = at < last ? at : last;
    return std::uint32_t(std::int32_t(least > 0 ? least : 0));
  };
  const auto lower = std::uint32_t(bit_cast<std::uint64_t>(z) >> 63);
  return {(lower * side + index(x - y)) * side + index(x + y), length};
}
static inline std::uint32_t octahedron_cell(std::uint32_t side, double x, double y, double z) {
  return octahedron_hit(side, x, y, z).cell;
}

/// The point (i, j) of the grid on a half of the octahedron |x| + |y| + |z| = side, i and j in 0..2 side: even on the borders
/// between cells, odd in their middle. `lower` is cell / side^2, the cell's row and column are (j - 1) / 2 and (i - 1) / 2 of
/// its middle. A cell is flat, or along x = 0 or y = 0 two triangles with its corners, or in the middle of an odd side four
/// around the pole; so a function that is convex over all directions and grows with their length is largest over a cell at a
/// corner or at that pole.
static inline std::array<double, 3> octahedron_point(std::uint32_t side, std::uint32_t lower, std::uint32_t i,
                                                     std::uint32_t j) {
  const double p = double(i) - side, q = double(j) - side, z = side - std::max(std::fabs(p), std::fabs(q));
  return {(p + q) / 2, (p - q) / 2, lower ? -z : z};
}

}  // namespace swiftlet::lut
