// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/world.h>

namespace swiftlet {
namespace {

/// One Newton step of the polar decomposition: |R^T R - I| = e becomes 3/4 e^2, 5e-4 becomes 2e-7. Two such rotations stay
/// within the 1e-6 that a query asks for. Rotations of single precision are off by up to 1e-6 each.
Pose orthonormal(const Pose& pose) {
  const Mat3 gram = pose.rotation.transpose() * pose.rotation;
  return {pose.rotation * (1.5 * Mat3::Identity() - 0.5 * gram), pose.translation};
}

Vec3 transform(const Pose& pose, const Vec3& p) { return pose.rotation * p + pose.translation; }

QueryOptions with_radii(const Placed& a, const Placed& b) {
  QueryOptions options;
  options.radius_a = a.radius;
  options.radius_b = b.radius;
  return options;
}

Found found(const Answer& bodies) {
  if (bodies.status == Status::InvalidPose) return Found::Nothing;
  if (bodies.status == Status::Beyond) return Found::Beyond;
  return bodies.proof.count != 0 || bodies.normal.isZero() ? Found::Overlap : Found::Nearest;
}

}  // namespace

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Pose a_in_world = orthonormal(a.in_world), b_in_world = orthonormal(b.in_world);
  QueryOptions options = with_radii(a, b);
  options.beyond = beyond;
  const Answer bodies = contact(*a.model, *b.model, relative(a_in_world, b_in_world), seed, options).answer;

  Nearest result;
  result.found = found(bodies);
  result.distance = bodies.lower > 0 ? bodies.lower : bodies.normal.dot(bodies.point_b - bodies.point_a);
  result.normal = a_in_world.rotation * bodies.normal;
  result.point_a = transform(a_in_world, bodies.point_a);
  result.point_b = transform(a_in_world, bodies.point_b);
  return result;
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  const Pose b_in_a = relative(orthonormal(a.in_world), orthonormal(b.in_world));
  return intersects(*a.model, *b.model, b_in_a, seed, with_radii(a, b)).verdict;
}

}  // namespace swiftlet
