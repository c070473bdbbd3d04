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

Found found(const Answer& hulls) {
  if (hulls.status == Status::InvalidPose) return Found::Nothing;
  if (hulls.status == Status::Beyond) return Found::Beyond;
  return hulls.verdict == Verdict::Overlapping || hulls.normal.isZero() ? Found::Overlap : Found::Nearest;
}

}  // namespace

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Pose a_in_world = orthonormal(a.in_world), b_in_world = orthonormal(b.in_world);
  QueryOptions options;
  options.beyond = beyond + a.radius + b.radius;
  const Answer hulls = distance(*a.model, *b.model, relative(a_in_world, b_in_world), seed, options);

  Nearest result;
  result.found = found(hulls);
  result.distance = hulls.lower - (a.radius + b.radius);
  result.normal = a_in_world.rotation * hulls.normal;
  result.point_a = transform(a_in_world, hulls.point_a) + a.radius * result.normal;
  result.point_b = transform(a_in_world, hulls.point_b) - b.radius * result.normal;
  return result;
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  return intersects(*a.model, *b.model, relative(orthonormal(a.in_world), orthonormal(b.in_world)), seed).verdict;
}

}  // namespace swiftlet
