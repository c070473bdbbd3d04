// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The Bullet program of adapters/README.md.
#include <btBulletDynamicsCommon.h>
#include <swiftlet/bullet.h>
#include <cstdio>

int main() {
  const swiftlet::Vec3 corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::uint32_t faces[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  swiftlet::LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = faces;
  const auto model = swiftlet::Model::from_level(arrays);
  if (!model) return std::puts(model.error().message.c_str()), 1;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  swiftlet::bullet::HullPairs hull_pairs(dispatcher);  // from here on, pairs of HullShapes are swiftlet's
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

  swiftlet::bullet::HullShape shape(model.value());  // a btConvexHullShape, margin 0.04 outside its points
  btVector3 inertia;
  shape.calculateLocalInertia(1, inertia);
  btRigidBody lower(0, nullptr, &shape), upper(1, nullptr, &shape, inertia);
  upper.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 3, 0)));
  world.addRigidBody(&lower);
  world.addRigidBody(&upper);

  int step = 0;
  while (dispatcher.getNumManifolds() == 0 || dispatcher.getManifoldByIndexInternal(0)->getNumContacts() == 0) {
    world.stepSimulation(btScalar(1) / 60, 0), ++step;
  }
  const btManifoldPoint& contact = dispatcher.getManifoldByIndexInternal(0)->getContactPoint(0);
  std::printf("step %d: edge over edge, first contact at height %.2f, still %.2f apart\n", step,
              contact.getPositionWorldOnA().y(), contact.getDistance());
  world.removeRigidBody(&upper);
  world.removeRigidBody(&lower);
}
