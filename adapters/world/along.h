// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A pair of bodies in A's frame, and a model seen along the normal of a flat face. Knows no engine.
#pragma once

#include <swiftlet/triangles.h>

namespace swiftlet {

/// The point with coordinates that no body may have put to 0.
Vec3 legal(const Vec3& p);

/// Takes a manifold of A's frame into the world's.
void into_world(const Pose& a_in_world, Manifold& manifold);

/// A ball around a body without its radius, in the body's frame.
struct Ball {
  Vec3 centre;
  double radius;
};
Ball ball_around(const Body& body);

/// The normal of one side of a triangle: unit, in the triangle's frame; 0 where its corners lie on one line.
Vec3 normal_of(const Body& triangle, Side side);

/// How far the body `a` is above one side of a triangle, as if the triangle had no end: `lower` and `upper` are the least
/// height less both radii, `point_a` is the lowest point and `point_b` the foot below it, inside the triangle or not. A
/// manifold may grow from it. `normal` is the side's, in the triangle's frame. Exact but for rounding. Cost: one support.
Answer above(const Body& a, const Body& triangle, const Pose& b_in_a, Side side, const Vec3& normal);

}  // namespace swiftlet
