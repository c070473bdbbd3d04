// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "random.h"

#include <cmath>

namespace swiftlet::shapes {

std::uint64_t Random::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

double Random::uniform(double low, double high) { return low + (high - low) * (double(bits() >> 11) * 0x1p-53); }

Vec3 Random::in_ball() {
  for (;;) {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    if (x * x + y * y + z * z <= 1) return {x, y, z};
  }
}

Vec3 Random::on_sphere() {
  for (;;) {
    const Vec3 p = in_ball();
    const double length2 = p.x() * p.x() + p.y() * p.y() + p.z() * p.z();
    if (length2 > 1e-4) return p / std::sqrt(length2);
  }
}

Mat3 Random::rotation() {
  for (;;) {  // a point in the 4-ball, normalised
    const double w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    const double length2 = w * w + x * x + y * y + z * z;
    if (length2 > 1 || length2 < 1e-4) continue;
    const double length = std::sqrt(length2);
    return from_quaternion(w / length, Vec3(x, y, z) / length);
  }
}

Mat3 from_quaternion(double w, const Vec3& v) {
  const double x = v.x(), y = v.y(), z = v.z();
  Mat3 r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return r;
}

}  // namespace swiftlet::shapes
