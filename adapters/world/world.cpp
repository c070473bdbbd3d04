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

/// Both hulls, how far apart or how deep.
struct Hulls {
  Pose a_in_world, b_in_a;
  SignedAnswer answer;
  Found found = Found::Nothing;
};

Hulls hulls_of(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  Hulls hulls;
  hulls.a_in_world = orthonormal(a.in_world);
  hulls.b_in_a = relative(hulls.a_in_world, orthonormal(b.in_world));
  QueryOptions options;
  options.beyond = beyond + a.radius + b.radius;
  hulls.answer = signed_distance(*a.model, *b.model, hulls.b_in_a, seed, options);
  if (hulls.answer.status == Status::InvalidPose) return hulls;
  if (hulls.answer.status == Status::Beyond)
    hulls.found = Found::Beyond;
  else if (!hulls.answer.normal.isZero())
    hulls.found = Found::Nearest;
  return hulls;
}

}  // namespace

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Hulls hulls = hulls_of(a, b, beyond, seed);
  Nearest result;
  result.found = hulls.found;
  result.verdict = hulls.answer.verdict;
  result.distance = hulls.answer.lower - (a.radius + b.radius);
  result.normal = hulls.a_in_world.rotation * hulls.answer.normal;
  result.point_a = transform(hulls.a_in_world, hulls.answer.point_a) + a.radius * result.normal;
  result.point_b = transform(hulls.a_in_world, hulls.answer.point_b) - b.radius * result.normal;
  return result;
}

Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Patch& patch) {
  const Hulls hulls = hulls_of(a, b, beyond, seed);
  PatchOptions options;
  options.margin = beyond + a.radius + b.radius;
  options.most_points = most_points;
  patch =
      hulls.found == Found::Nearest ? swiftlet::patch(*a.model, *b.model, hulls.b_in_a, hulls.answer, options, patch) : Patch{};
  patch.normal = hulls.a_in_world.rotation * patch.normal;
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    PatchPoint& p = patch.points[i];
    p.point_a = transform(hulls.a_in_world, p.point_a) + a.radius * patch.normal;
    p.point_b = transform(hulls.a_in_world, p.point_b) - b.radius * patch.normal;
    p.separation -= a.radius + b.radius;
  }
  return hulls.found;
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  const Pose b_in_a = relative(orthonormal(a.in_world), orthonormal(b.in_world));
  return intersects(*a.model, *b.model, b_in_a, seed, with_radii(a, b)).verdict;
}

}  // namespace swiftlet
