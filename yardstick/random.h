// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers, points and rotations from fixed seeds. Uses bits, sums, products and square roots only: the same on every machine.
#pragma once

#include <cstdint>

#include <swiftlet/pose.h>

namespace swiftlet::shapes {

/// splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform(double low = 0, double high = 1);
  Vec3 in_ball();    ///< uniform in the unit ball
  Vec3 on_sphere();  ///< a point of the ball normalised, that is uniform on the unit sphere
  Mat3 rotation();   ///< uniform, each entry rounded

 private:
  std::uint64_t state_;
};

/// The rotation of the unit quaternion w + x i + y j + z k, each entry rounded.
Mat3 from_quaternion(double w, const Vec3& xyz);

}  // namespace swiftlet::shapes
