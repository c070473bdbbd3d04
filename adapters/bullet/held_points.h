// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The points of Bullet's manifold from step to step. Bodies that rest on each other keep theirs, as places on both, and with
// them the impulses that hold them up: the corners of the area that they share, of which the deepest four would count, change
// from step to step on a round face.
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <swiftlet/manifold.h>

namespace swiftlet::bullet {

/// In shares of Bullet's breaking threshold: points stay while the deepest of them is as deep as the deepest place of contact,
/// to the first; and an area counts as that of a step before until a body has moved against the other by the second.
constexpr btScalar kHeldDepth = btScalar(0.01), kAtRest = btScalar(0.02);
/// Points stay while they span this share of the area that the best ones span.
constexpr btScalar kHeldArea = btScalar(0.9);
/// Normals that differ by less are one. Only points of one normal take turns.
constexpr btScalar kOneNormal = btScalar(1e-4);

/// Keeps the points of the manifold that `result` fills, unless they have left each other or are not as deep as `now` says: all
/// get the normal of this step and what the bodies are made of now, and take turns. `now` is of bodies at rest: its points
/// are those of a step before, but the first separation is of this step.
bool hold_on(const Manifold& now, btManifoldResult& result);

/// The same if they also stand for the area of this step.
bool hold_the_area(const Manifold& now, btManifoldResult& result);

/// The same of bodies that did not move against each other, whose normals turned by `turn` since the step before.
bool hold_turned(const btMatrix3x3& turn, btManifoldResult& result);

/// Before the points of `now` are added: a point of the steps before that lies near one of these on both bodies comes to lie
/// where that one will, so that Bullet takes both for one, with its impulses; the others go. A point that slid would push on
/// with what it needed elsewhere: piles then come to rest later. Of a contact that goes on one
/// point stays in any case, or Bullet would call it ended and begun: true if that is none of this step's. It is the first, and
/// goes once another has come. `swapped`: the manifold's first body is the second one of `now`.
bool carry_over(btPersistentManifold& points, const Manifold& now, bool swapped);

}  // namespace swiftlet::bullet
