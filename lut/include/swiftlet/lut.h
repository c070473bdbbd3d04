// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions on the sphere as small integers: the latitude-longitude samples of [Ehmann & Lin 2000, sec. 4.6].
// Knows nothing of hulls.
#pragma once

#include <array>
#include <cstdint>

/// Directions as small integers, for start tables.
namespace swiftlet::lut {

/// The spacing of samples: multiples of 22.5, 11.25 or 5.625 degrees in altitude and azimuth, with each pole once.
enum class Resolution : std::uint8_t {
  None,       ///< no samples
  Degrees22,  ///< 22.5 degrees apart
  Degrees11,  ///< 11.25 degrees
  Degrees5,   ///< 5.625 degrees
};

/// Returns the number of samples: 0, 114, 482 or 1986.
std::uint32_t sample_count(Resolution resolution);

/// Returns the unit direction of sample `index` < sample_count(resolution).
std::array<double, 3> sample(Resolution resolution, std::uint32_t index);

/// Returns the index of the sample nearest to `direction` (any length), first in altitude, then in azimuth. The zero vector
/// gives the north pole. Requires a resolution other than None. Cost: constant, no trigonometry.
std::uint32_t nearest(Resolution resolution, const std::array<double, 3>& direction);

}  // namespace swiftlet::lut
