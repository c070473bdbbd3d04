// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that formulas make: those of [Ehmann & Lin 2001, sec. 8.1] rebuilt, as their own are not published, and bodies of
// large convex parts. Knows triangles alone. Uses libm; coordinates are rounded to float, so that its last bit does not show.
#pragma once

#include <filesystem>

#include <swiftlet/build.h>

namespace swiftlet::bench::mesh {

/// A torus about z whose middle circle has radius 1, of `around` times `across` quadrilaterals.
struct TorusOptions {
  std::uint32_t around, across;
  double middle = 1, tube = 0.25;
  double bend = 0;     ///< moves points along z by this times x^2 - y^2
  double wrinkle = 0;  ///< changes the tube's radius by this fraction, in nine waves around and four across
};
Mesh torus(const TorusOptions& options);

Mesh cup();         ///< 8 000 triangles about z, open upwards, with a wall of 0.06; radius 0.7, height 1.6
Mesh spoon();       ///< 84 triangles along z, bowl below; length 1.4
Mesh spiral_peg();  ///< 8 000 triangles: a closed tube along a helix about z; height 4
/// 40 800 triangles: an open sheet of 2 times 0.8 with seven bumps in a row; `seed` is of the scanner's noise.
Mesh teeth(std::uint64_t seed);

Mesh gear();   ///< 512 triangles about z: sixteen teeth around a hole, radius 1, thickness 0.33
Mesh comb();   ///< a bar with eight teeth, each a closed box of 48 triangles
Mesh frame();  ///< four such boxes around an opening

}  // namespace swiftlet::bench::mesh
