// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A mesh that falls on a mesh of Bullet's.
#include <btBulletDynamicsCommon.h>
#include <swiftlet/bullet.h>
#include <cstdio>

int main() {
  btTriangleMesh their_ground;
  their_ground.addTriangle(btVector3(-9, 0, -9), btVector3(-9, 0, 9), btVector3(9, 0, 9));
  their_ground.addTriangle(btVector3(-9, 0, -9), btVector3(9, 0, 9), btVector3(9, 0, -9));
  const swiftlet::Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<std::uint32_t, 3> triangles[] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  swiftlet::bullet::HullPairs pairs(dispatcher);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

  swiftlet::bullet::MeshShape ground(swiftlet::bullet::mesh_of(their_ground).value());  // of what a btBvhTriangleMeshShape has
  swiftlet::bullet::MeshShape corner(swiftlet::MeshModel::from_triangles(points, triangles).value());
  btVector3 inertia;
  const btTransform axes = corner.principal_axes(1, inertia);
  btCompoundShape shape;  // Bullet's bodies have their origin at the centre of mass
  shape.addChildShape(axes.inverse(), &corner);
  btRigidBody floor(0, nullptr, &ground), body(1, nullptr, &shape, inertia);
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 1, 0)) * axes);
  world.addRigidBody(&floor);
  world.addRigidBody(&body);
  for (int step = 0; step < 300; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  std::printf("lies %.2f above the ground\n", (body.getWorldTransform() * axes.inverse()).getOrigin().y());

  world.removeRigidBody(&body);
  world.removeRigidBody(&floor);
}
