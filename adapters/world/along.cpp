// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "along.h"

#include <Eigen/Geometry>

namespace swiftlet {

Pose orthonormal(const Pose& pose) {
  const Mat3 gram = pose.rotation.transpose() * pose.rotation;
  return {pose.rotation * (1.5 * Mat3::Identity() - 0.5 * gram), pose.translation};
}

Vec3 transform(const Pose& pose, const Vec3& p) { return pose.rotation * p + pose.translation; }

void into_world(const Pose& a_in_world, Manifold& manifold) {
  manifold.normal = a_in_world.rotation * manifold.normal;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& p = manifold.points[i];
    p.point_a = transform(a_in_world, p.point_a);
    p.point_b = transform(a_in_world, p.point_b);
  }
}

Vec3 normal_of(const Body& triangle, Side side) {
  const Vec3 p = triangle.corner(0), area = (triangle.corner(1) - p).cross(triangle.corner(2) - p);
  const double twice = area.norm();
  if (!(twice > 0)) return Vec3::Zero();
  return side == Side::Front ? Vec3(area / twice) : Vec3(-area / twice);
}

Answer above(const Body& a, const Body& triangle, const Pose& b_in_a, Side side, const Vec3& normal) {
  const Vec3 up = b_in_a.rotation * normal;
  const std::uint32_t lowest = a.model()->support(-up);
  const Vertex& v = a.model()->level(0).view.vertices[lowest];
  const Vec3 p(v.x, v.y, v.z);
  const double height = up.dot(p - transform(b_in_a, triangle.corner(0)));
  Answer answer;
  answer.status = Status::Converged;
  answer.is_signed = true;
  answer.feature_a = {FeatureKind::Vertex, lowest};
  answer.feature_b = {FeatureKind::Face, side == Side::Front ? 0u : 1u};
  answer.radius_a = a.radius();
  answer.radius_b = triangle.radius();
  answer.lower = answer.upper = height - a.radius() - triangle.radius();
  answer.verdict = answer.lower > 0 ? Verdict::Disjoint : Verdict::Overlapping;
  answer.normal = -up;
  answer.point_a = p - up * a.radius();
  answer.point_b = p - up * (height - triangle.radius());
  return answer;
}

}  // namespace swiftlet
