// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/world.h>

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>

#include <swiftlet/depth.h>

#include "along.h"
#include "numeric/tolerance.h"

namespace swiftlet {
namespace {

Pose b_in_a(const Placed& a, const Placed& b) { return relative(orthonormal(a.in_world), orthonormal(b.in_world)); }

/// Both bodies in A's frame, how far apart or how deep.
struct Pair {
  Pose a_in_world, b_in_a;
  Answer answer{};
  Found found = Found::Nearest;
};

Pair pair_of(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  const Pose a_in_world = orthonormal(a.in_world);
  Pair pair{a_in_world, relative(a_in_world, orthonormal(b.in_world))};
  pair.answer = signed_distance(a.body, b.body, pair.b_in_a, seed, {.beyond = beyond});
  if (pair.answer.status == Status::Beyond)
    pair.found = Found::Beyond;
  else if (pair.answer.normal.hasNaN())
    pair.found = Found::Nothing;
  return pair;
}

Nearest in_world(const Pair& pair) {
  return {pair.found,
          pair.answer.verdict,
          pair.answer.lower,
          pair.a_in_world.rotation * pair.answer.normal,
          transform(pair.a_in_world, pair.answer.point_a),
          transform(pair.a_in_world, pair.answer.point_b)};
}

bool is_at_rest(const Rest& rest, const Pose& b_in_a) {
  for (std::uint32_t i = 0; i < rest.count; ++i) {
    if (!((transform(b_in_a, rest.in_b[i]) - rest.in_a[i]).squaredNorm() <= rest.within * rest.within)) return false;
  }
  return rest.count > 0 && rest.within >= 0;
}

/// `manifold` is in A's frame.
void note(const Manifold& manifold, const Pose& b_in_a, Rest& rest) {
  const Pose back = inverse(b_in_a);
  rest.count = manifold.count;
  for (std::uint32_t i = 0; i < rest.count; ++i) {
    rest.in_a[i] = manifold.points[i].point_b;
    rest.in_b[i] = transform(back, rest.in_a[i]);
  }
}

Found contacts(const Placed& a, const Body& b, const Pair& pair, double beyond, std::uint32_t most_points, Manifold& manifold,
               Rest* rest = nullptr) {
  const ManifoldOptions options{.margin = beyond, .most_points = most_points};
  manifold.normal = pair.a_in_world.rotation.transpose() * manifold.normal;  // names and normal alone are read of the last one
  manifold =
      pair.found == Found::Nearest ? swiftlet::manifold(a.body, b, pair.b_in_a, pair.answer, options, manifold) : Manifold{};
  if (rest) note(manifold, pair.b_in_a, *rest);
  into_world(pair.a_in_world, manifold);
  return pair.found;
}

/// A triangle in the half-space's plane, below a model and larger, also than one of a single point.
Placed part_below(const Placed& a, const HalfSpace& b) {
  const Model& model = *a.body.model();
  const Vec3 centre = transform(a.in_world, model.centre()), foot = centre - b.normal * (b.normal.dot(centre) - b.offset);
  const double size = std::max({model.radius(), a.body.radius(), kLeastExtent});
  const Vec3 side = b.normal.unitOrthogonal() * size, other = b.normal.cross(side);
  return {Body::triangle(legal(4 * side), legal(4 * other - 4 * side), legal(-4 * other - 4 * side)), {Mat3::Identity(), foot}};
}

Pair pair_of(const Placed& a, const Placed& part, double beyond) {
  const Pose a_in_world = orthonormal(a.in_world);
  Pair pair{a_in_world, relative(a_in_world, orthonormal(part.in_world))};
  if (tolerance(a.body, part.body, pair.b_in_a) >= 0)
    pair.answer = above(a.body, part.body, pair.b_in_a, Side::Front, normal_of(part.body, Side::Front));
  else
    pair.found = Found::Nothing;  // no rigid motion, or no body
  if (pair.found == Found::Nearest && pair.answer.lower > beyond) pair.found = Found::Beyond;
  return pair;
}

}  // namespace

const Model& whole(const Model& model) {
  if (model.finest_level() > 0) throw std::invalid_argument("the model lacks its level 0: Model::ensure(0) adds it");
  return model;
}

double tolerance(const Placed& a, const Placed& b) { return tolerance(a.body, b.body, b_in_a(a, b)); }
double tolerance(const Placed& a, const HalfSpace& b) { return tolerance(a, part_below(a, b)); }

Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed) {
  return in_world(pair_of(a, b, beyond, seed));
}

Nearest nearest(const Placed& a, const HalfSpace& b, double beyond) { return in_world(pair_of(a, part_below(a, b), beyond)); }

Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Manifold& manifold) {
  return contacts(a, b.body, pair_of(a, b, beyond, seed), beyond, most_points, manifold);
}

Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Manifold& manifold,
               Rest& rest) {
  const Pair pair = pair_of(a, b, beyond, seed);
  if (pair.found == Found::Nearest && is_at_rest(rest, pair.b_in_a)) {
    manifold.normal = pair.a_in_world.rotation * pair.answer.normal;
    manifold.points[0].separation = pair.answer.lower;
    return Found::AtRest;
  }
  return contacts(a, b.body, pair, beyond, most_points, manifold, &rest);
}

Found contacts(const Placed& a, const HalfSpace& b, double beyond, std::uint32_t most_points, Manifold& manifold) {
  const Placed part = part_below(a, b);
  return contacts(a, part.body, pair_of(a, part, beyond), beyond, most_points, manifold);
}

Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed) {
  return intersects(a.body, b.body, b_in_a(a, b), seed).verdict;
}

}  // namespace swiftlet
