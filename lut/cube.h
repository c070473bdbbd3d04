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

/// The cell of a direction of any length; of no direction (0, NaN) the first one. side >= 1.
static inline std::uint32_t cube_cell(std::uint32_t side, double x, double y, double z) {
  const double d[5] = {x, y, z, x, y}, ax = std::fabs(x), ay = std::fabs(y), az = std::fabs(z);
  const std::uint32_t axis = ax >= ay ? (ax >= az ? 0 : 2) : (ay >= az ? 1 : 2);
  const double major = d[axis], half = 0.5 * side, scale = half / std::fabs(major);
  const double u = d[axis + 1] * scale + half, v = d[axis + 2] * scale + half;
  if (!(u >= 0 && v >= 0)) return 0;
  const auto clipped = [side](double at) { return at < side ? std::uint32_t(at) : side - 1; };
  return ((2 * axis + (major < 0)) * side + clipped(v)) * side + clipped(u);
}

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
