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

/// Both bodies in A's frame, how far apart or how deep.
struct Pair {
  Pose a_in_world, b_in_a;
  SignedAnswer answer;
  Found found = Found::Nothing;
};

Pair pair_of(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  Pair pair;
  pair.a_in_world = orthonormal(a.in_world);
  pair.b_in_a = relative(pair.a_in_world, orthonormal(b.in_world));
  QueryOptions options = with_radii(a, b);
  options.beyond = beyond;
  pair.answer = signed_distance(*a.model, *b.model, pair.b_in_a, seed, options);
  if (pair.answer.status == Status::InvalidPose) return pair;
  if (pair.answer.status == Status::Beyond)
    pair.found = Found::Beyond;
  else if (!pair.answer.normal.isZero())
    pair.found = Found::Nearest;
  return pair;
}

}  // namespace

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Pair pair = pair_of(a, b, beyond, seed);
  return {pair.found,
          pair.answer.verdict,
          pair.answer.lower,
          pair.a_in_world.rotation * pair.answer.normal,
          transform(pair.a_in_world, pair.answer.point_a),
          transform(pair.a_in_world, pair.answer.point_b)};
}

Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Patch& patch) {
  const Pair pair = pair_of(a, b, beyond, seed);
  PatchOptions options;
  options.margin = beyond;
  options.most_points = most_points;
  options.radius_a = a.radius;
  options.radius_b = b.radius;
  patch =
      pair.found == Found::Nearest ? swiftlet::patch(*a.model, *b.model, pair.b_in_a, pair.answer, options, patch) : Patch{};
  patch.normal = pair.a_in_world.rotation * patch.normal;
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    PatchPoint& p = patch.points[i];
    p.point_a = transform(pair.a_in_world, p.point_a);
    p.point_b = transform(pair.a_in_world, p.point_b);
  }
  return pair.found;
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  const Pose b_in_a = relative(orthonormal(a.in_world), orthonormal(b.in_world));
  return intersects(*a.model, *b.model, b_in_a, seed, with_radii(a, b)).verdict;
}

}  // namespace swiftlet
