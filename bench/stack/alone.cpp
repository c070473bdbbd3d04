// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "alone.h"

#include <algorithm>
#include <cmath>

#include <swiftlet/build.h>

#include "in_bullet.h"
#include "shapes.h"

namespace swiftlet::stack {
namespace {

constexpr double kHalf = 0.25, kOver = kHalf + kMargin;  // over the floor at rest, margins included

/// The prism on a floor of 60 m whose top is at z = 0.
struct Place {
  explicit Place(std::uint32_t sides, Shapes shapes, double x = 0) : in(shapes) {
    const auto built = [](const Mesh& mesh) {
      return std::make_shared<const Model>(std::move(build(mesh.points)).value().model);
    };
    const auto at = [](double along, double up) {
      return btTransform(btMatrix3x3::getIdentity(), vector_of(Vec3(along, 0, up)));
    };
    floor = &in.add(built(shapes::box({60, 60, 2})), at(0, -1 - kMargin), false);
    body = &in.add(built(shapes::prism(sides, 0.5, 2 * kHalf)), at(x, kOver), true);
  }
  void measure(const btTransform& floor_in_world, Alone& seen) const {
    const btTransform now = floor_in_world.inverse() * body->getWorldTransform();
    seen.hop = std::max(seen.hop, double(now.getOrigin().z()) - kOver);
    seen.wobble = std::max(seen.wobble, std::acos(std::min(1., double(now.getBasis().getColumn(2).z()))));
  }

  InBullet in;
  btRigidBody *floor, *body;
};

}  // namespace

Alone slide(std::uint32_t sides, Shapes shapes, double slope) {
  Place place(sides, shapes, -20);
  place.in.world.setGravity(vector_of(kGravity * Vec3(std::sin(slope), 0, -std::cos(slope))));
  Alone seen;
  double fastest = 0;
  for (int step = 0; step < 120; ++step) {
    place.in.step();
    place.measure(btTransform::getIdentity(), seen);
    fastest = std::max(fastest, double(place.body->getAngularVelocity().length()));
  }
  seen.wobble = fastest;
  seen.moved = double(place.body->getLinearVelocity().x());
  // Bullet multiplies the frictions of both bodies.
  seen.ideal = std::max(0., 2 * kGravity * (std::sin(slope) - kFriction * kFriction * std::cos(slope)));
  return seen;
}

Alone spin(std::uint32_t sides, Shapes shapes) {
  Place place(sides, shapes);
  place.body->setAngularVelocity(btVector3(0, 0, 10));
  Alone seen;
  seen.stopped = 10;
  for (int step = 1; step <= 600; ++step) {
    place.in.step();
    place.measure(btTransform::getIdentity(), seen);
    if (seen.stopped == 10 && place.body->getAngularVelocity().length() < btScalar(0.02)) seen.stopped = step / 60.;
  }
  const btVector3& end = place.body->getWorldTransform().getOrigin();
  seen.moved = std::hypot(double(end.x()), double(end.y()));
  return seen;
}

Alone rock(std::uint32_t sides, Shapes shapes) {
  Place place(sides, shapes, 3);
  place.floor->setCollisionFlags(place.floor->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  Alone seen;
  for (int step = 0; step < 1200; ++step) {
    const double angle = 0.15 * (1 - std::cos(0.01 * step));
    btTransform now(btQuaternion(btVector3(0, 1, 0), btScalar(angle)));
    now.setOrigin(now.getBasis() * vector_of(Vec3(0, 0, -1 - kMargin)));
    place.floor->setWorldTransform(now);
    place.in.step();
    const btTransform top = now * btTransform(btMatrix3x3::getIdentity(), vector_of(Vec3(0, 0, 1 + kMargin)));
    place.measure(top, seen);
    const btVector3 there = top.inverse() * place.body->getWorldTransform().getOrigin();
    seen.moved = std::max(seen.moved, std::hypot(double(there.x()) - 3, double(there.y())));
  }
  return seen;
}

}  // namespace swiftlet::stack
