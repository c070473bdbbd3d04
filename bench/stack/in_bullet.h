// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A Bullet world whose pairs are answered by one kind of shapes, and its bodies. Knows models.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include <swiftlet/bullet.h>

#include "stack.h"

namespace swiftlet::stack {

constexpr double kMargin = 0.04;  ///< Bullet's default, outside the points
constexpr double kFriction = 0.6, kGravity = 9.81, kDensity = 1000;

btVector3 vector_of(const Vec3& v);
Vec3 point_of(const Vertex& v);

/// Its members live as long as its bodies.
class InBullet {
 public:
  explicit InBullet(Shapes shapes);
  ~InBullet();
  InBullet(const InBullet&) = delete;
  InBullet& operator=(const InBullet&) = delete;

  /// A body of density kDensity, or a fixed one of mass 0, that never sleeps: a stack that sleeps does not fall.
  btRigidBody& add(const std::shared_ptr<const Model>& model, const btTransform& start, bool moves);
  void step() { world.stepSimulation(btScalar(1) / 60, 0); }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  std::optional<bullet::HullPairs> hull_pairs;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

 private:
  btCollisionShape& shape_of(const std::shared_ptr<const Model>& model);

  const Shapes shapes_;
  std::map<std::shared_ptr<const Model>, std::unique_ptr<btCollisionShape>> shape_of_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace swiftlet::stack
