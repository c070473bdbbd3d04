// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions to bins and back, by comparisons against a table of sines: no libm, hence the same on every machine.
// Knows nothing of hulls.
#include <swiftlet/lut.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "double_bits.h"

namespace swiftlet::lut {
namespace {

// Angles are whole numbers of pi/64, half a step of the finest grid, so that the borders between bins are table entries too.
constexpr int kQuarterTurn = 32;

// clang-format off
// kSine[k] = sin(k pi / 64) to the nearest double.
constexpr std::array<double, kQuarterTurn + 1> kSine{
    0, 0.049067674327418015, 0.0980171403295606, 0.14673047445536175, 0.19509032201612828,
    0.2429801799032639, 0.2902846772544624, 0.33688985339222005, 0.3826834323650898, 0.4275550934302821,
    0.47139673682599764, 0.5141027441932218, 0.5555702330196022, 0.5956993044924334, 0.6343932841636455,
    0.6715589548470184, 0.7071067811865476, 0.7409511253549591, 0.773010453362737, 0.8032075314806449,
    0.8314696123025452, 0.8577286100002721, 0.881921264348355, 0.9039892931234433, 0.9238795325112867,
    0.9415440651830208, 0.9569403357322088, 0.970031253194544, 0.9807852804032304, 0.989176509964781,
    0.9951847266721969, 0.9987954562051724, 1};
// clang-format on

double sine(int angle) {
  angle &= 4 * kQuarterTurn - 1;
  if (angle >= 2 * kQuarterTurn) return -sine(angle - 2 * kQuarterTurn);
  return kSine[angle <= kQuarterTurn ? angle : 2 * kQuarterTurn - angle];
}

double cosine(int angle) { return sine(angle + kQuarterTurn); }

// Samples in a quarter turn.
int quarter_count(Resolution resolution) {
  assert(resolution != Resolution::None);
  return 4 << (int(resolution) - 1);
}

// Where the direction (c, s) falls among the samples 0..quarter_count of the half circle, when mirrored to c, s >= 0.
// A direction on the border between two bins goes to the one farther from c.
int fold_nearest(int quarter, double c, double s) {
  const int half = kQuarterTurn / (2 * quarter);
  int low = 0, high = quarter;
  while (low < high) {
    const int middle = (low + high) / 2, border = (2 * middle + 1) * half;
    if (s * kSine[kQuarterTurn - border] >= c * kSine[border])
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// As above for any sign of c: samples 0..2 quarter of the half circle.
int half_turn_nearest(int quarter, double c, double s) {
  const int folded = fold_nearest(quarter, std::abs(c), s);
  return c < 0 ? 2 * quarter - folded : folded;
}

int azimuth_nearest(int quarter, double x, double y) {
  const int folded = half_turn_nearest(quarter, x, std::abs(y));
  return y < 0 ? (4 * quarter - folded) % (4 * quarter) : folded;
}

// The direction scaled by a power of two to a largest component in [0.5, 1); zero where it names no direction.
std::array<double, 3> scaled(const std::array<double, 3>& direction) {
  double largest = 0;
  for (double c : direction) {
    if (!std::isfinite(c)) return {};
    largest = std::max(largest, std::abs(c));
  }
  if (largest == 0) return direction;
  const int exponent = -1 - exponent_of(largest);
  return {times_power_of_two(direction[0], exponent), times_power_of_two(direction[1], exponent),
          times_power_of_two(direction[2], exponent)};
}

}  // namespace

std::uint32_t sample_count(Resolution resolution) {
  if (resolution == Resolution::None) return 0;
  const int quarter = quarter_count(resolution);
  return std::uint32_t((2 * quarter - 1) * 4 * quarter + 2);
}

// Order: the north pole (+z), the rows of one altitude from north to south, each from +x towards +y, the south pole.
std::array<double, 3> sample(Resolution resolution, std::uint32_t index) {
  if (index == 0) return {0, 0, 1};
  if (index + 1 == sample_count(resolution)) return {0, 0, -1};
  const int quarter = quarter_count(resolution), step = kQuarterTurn / quarter;
  const int row = 1 + int(index - 1) / (4 * quarter), column = int(index - 1) % (4 * quarter);
  return {sine(row * step) * cosine(column * step), sine(row * step) * sine(column * step), cosine(row * step)};
}

std::uint32_t nearest(Resolution resolution, const std::array<double, 3>& direction) {
  const auto [x, y, z] = scaled(direction);
  const int quarter = quarter_count(resolution);
  const double rho = std::sqrt(x * x + y * y);
  const int row = rho > 0 ? half_turn_nearest(quarter, z, rho) : z < 0 ? 2 * quarter : 0;
  if (row == 0) return 0;
  if (row == 2 * quarter) return sample_count(resolution) - 1;
  return std::uint32_t(1 + (row - 1) * 4 * quarter + azimuth_nearest(quarter, x, y));
}

}  // namespace swiftlet::lut
