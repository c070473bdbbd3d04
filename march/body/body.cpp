// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Constructors and corners of `Body`.
#include <swiftlet/body.h>

#include <limits>
#include <type_traits>

namespace swiftlet {

static_assert(std::is_trivially_copyable_v<Body>);

Body& Body::with(int i, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) corners_[std::size_t(3 * i + axis)] = p[axis];
  return *this;
}

Body Body::point(const Vec3& p, double radius) { return Body(BodyKind::Point, radius).with(0, p); }
Body Body::segment(const Vec3& p, const Vec3& q, double radius) {
  return Body(BodyKind::Segment, radius).with(0, p).with(1, q);
}
Body Body::triangle(const Vec3& p, const Vec3& q, const Vec3& r, double radius) {
  return Body(BodyKind::Triangle, radius).with(0, p).with(1, q).with(2, r);
}
Body Body::box(const Vec3& smallest, const Vec3& largest, double radius) {
  return Body(BodyKind::Box, radius).with(0, smallest).with(1, largest);
}

Vec3 Body::corner(int i) const {
  constexpr int kCorners[] = {0, 1, 2, 3, 2};
  if (i < 0 || i >= kCorners[int(kind_)]) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return Vec3(corners_[std::size_t(3 * i)], corners_[std::size_t(3 * i + 1)], corners_[std::size_t(3 * i + 2)]);
}

}  // namespace swiftlet
