// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/world.h>

#include <stdexcept>

#include <swiftlet/depth.h>

namespace swiftlet {
namespace {

/// One Newton step of the polar decomposition: |R^T R - I| = e becomes 3/4 e^2, 5e-4 becomes 2e-7. Two such rotations stay
/// within the 1e-6 that a query asks for. Rotations of single precision are off by up to 1e-6 each.
Pose orthonormal(const Pose& pose) {
  const Mat3 gram = pose.rotation.transpose() * pose.rotation;
  return {pose.rotation * (1.5 * Mat3::Identity() - 0.5 * gram), pose.translation};
}

Vec3 transform(const Pose& pose, const Vec3& p) { return pose.rotation * p + pose.translation; }

Pose b_in_a(const Placed& a, const Placed& b) { return relative(orthonormal(a.in_world), orthonormal(b.in_world)); }

/// Both bodies in A's frame, how far apart or how deep.
struct Pair {
  Pose a_in_world, b_in_a;
  Answer answer{};
  Found found = Found::Nearest;
};

Pair pair_of(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  Pair pair{orthonormal(a.in_world), b_in_a(a, b)};
  pair.answer = signed_distance(a.body, b.body, pair.b_in_a, seed, {.beyond = beyond});
  if (pair.answer.status == Status::Beyond)
    pair.found = Found::Beyond;
  else if (pair.answer.normal.hasNaN())
    pair.found = Found::Nothing;
  return pair;
}

}  // namespace

const Model& whole(const Model& model) {
  if (model.finest_level() > 0) throw std::invalid_argument("the model lacks its level 0: Model::ensure(0) adds it");
  return model;
}

double tolerance(const Placed& a, const Placed& b) { return tolerance(a.body, b.body, b_in_a(a, b)); }

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Pair pair = pair_of(a, b, beyond, seed);
  return {pair.found,
          pair.answer.verdict,
          pair.answer.lower,
          pair.a_in_world.rotation * pair.answer.normal,
          transform(pair.a_in_world, pair.answer.point_a),
          transform(pair.a_in_world, pair.answer.point_b)};
}

Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Manifold& manifold) {
  const Pair pair = pair_of(a, b, beyond, seed);
  const ManifoldOptions options{.margin = beyond, .most_points = most_points};
  manifold = pair.found == Found::Nearest ? swiftlet::manifold(a.body, b.body, pair.b_in_a, pair.answer, options, manifold)
                                          : Manifold{};
  manifold.normal = pair.a_in_world.rotation * manifold.normal;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& p = manifold.points[i];
    p.point_a = transform(pair.a_in_world, p.point_a);
    p.point_b = transform(pair.a_in_world, p.point_b);
  }
  return pair.found;
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  return intersects(a.body, b.body, b_in_a(a, b), seed).verdict;
}

}  // namespace swiftlet
