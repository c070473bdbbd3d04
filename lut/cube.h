// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions by where they leave a cube: six faces of side x side cells. Comparisons, one division, no libm; hence the same on
// every machine. Static, so that every unit compiles its own copy under its own floating-point flags. Knows nothing of hulls.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace swiftlet::lut {

static inline std::uint32_t cube_cell_count(std::uint32_t side) { return 6 * side * side; }

/// Where a direction leaves the cube.
struct CubeHit {
  std::uint32_t cell;
  double major;  ///< the direction's largest coordinate, as a magnitude
};
/// Of a direction of any length; of no direction (0, NaN) some cell. side >= 1.
static inline CubeHit cube_hit(std::uint32_t side, double x, double y, double z) {
  const double d[5] = {x, y, z, x, y}, ax = std::fabs(x), ay = std::fabs(y), az = std::fabs(z);
  const std::uint32_t axis = ax >= ay ? (ax >= az ? 0 : 2) : (ay >= az ? 1 : 2);
  const double major = std::fabs(d[axis]), half = 0.5 * side, scale = half / major, last = side - 0.5;
  const auto index = [&](double along) {  // 1 is in the last cell, as are infinities; beside a NaN any is in some
    const double at = along * scale + half, least = at < last ? at : last;
    return std::uint32_t(least > 0 ? least : 0);
  };
  return {((2 * axis + (d[axis] < 0)) * side + index(d[axis + 2])) * side + index(d[axis + 1]), major};
}
static inline std::uint32_t cube_cell(std::uint32_t side, double x, double y, double z) { return cube_hit(side, x, y, z).cell; }

/// The corner (i, j) of the grid on a face of the cube [-1, 1]^3, i and j in 0..2 side: even on the borders between cells, odd
/// in their middle. `face` is cell / side^2, the cell's row and column are (j - 1) / 2 and (i - 1) / 2 of its middle.
static inline std::array<double, 3> cube_point(std::uint32_t side, std::uint32_t face, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t axis = face / 2;
  std::array<double, 3> p{};
  p[axis] = face % 2 ? -1 : 1;
  p[(axis + 1) % 3] = double(i) / side - 1;
  p[(axis + 2) % 3] = double(j) / side - 1;
  return p;
}

}  // namespace swiftlet::lut
