// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Worlds with and without swiftlet's pairs, and what contactPairTest reports in them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include <swiftlet/bullet.h>
#include <swiftlet/model_file.h>
#include <swiftlet/pose.h>

namespace swiftlet {

using bullet::HullPairs;
using bullet::HullShape;

inline const btScalar kRounding = sizeof(btScalar) == 4 ? btScalar(4e-6) : btScalar(1e-13);  // at sizes of a few units

/// A collision world without and with swiftlet's hull pairs.
struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  std::optional<HullPairs> hull_pairs;
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};

  explicit World(bool with_swiftlet = true) {
    if (with_swiftlet) hull_pairs.emplace(dispatcher);
  }
};

/// How deep the deepest point of contact lies, above 0 apart; 1 where there is none.
inline btScalar deepest(const btCollisionDispatcher& dispatcher) {
  btScalar least = 1;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int i = 0; i < manifold.getNumContacts(); ++i) least = std::min(least, manifold.getContactPoint(i).getDistance());
  }
  return least;
}

struct Point {
  btVector3 normal_on_b, on_a, on_b;
  btScalar distance;
};

/// What contactPairTest reports, as seen with `a` first. Of a compound, and of triangles that it answers itself, Bullet reports
/// its own order.
inline std::vector<Point> closest_points(World& w, btCollisionShape& a, const btTransform& a_in_world, btCollisionShape& b,
                                         const btTransform& b_in_world, btScalar threshold = 0, bool is_ours = true) {
  struct Collector : btCollisionWorld::ContactResultCallback {
    const btCollisionObject* first = nullptr;
    std::vector<Point> points;
    btScalar addSingleResult(btManifoldPoint& p, const btCollisionObjectWrapper* object, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      EXPECT_TRUE(!first || object->getCollisionObject() == first);
      points.push_back({p.m_normalWorldOnB, p.getPositionWorldOnA(), p.getPositionWorldOnB(), p.getDistance()});
      return 0;
    }
  } collector;
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  object_a.setWorldTransform(a_in_world), object_b.setWorldTransform(b_in_world);
  if (!b.isCompound() && is_ours) collector.first = &object_a;
  collector.m_closestDistanceThreshold = threshold;
  w.world.contactPairTest(&object_a, &object_b, collector);
  return collector.points;
}

/// Moves the points that Bullet sees far aside: only the model can give the answer from then on.
inline void blind_bullet(HullShape& hull) {
  for (int i = 0; i < hull.getNumPoints(); ++i) hull.getUnscaledPoints()[i] += btVector3(50, 50, 50);
}

inline btTransform at(double x, double y, double z) {
  return btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), btScalar(y), btScalar(z)));
}

inline Model stored(const char* name) { return load(std::string(SWIFTLET_TEST_DIR) + "/data/models/" + name + ".swl").value(); }

inline Pose pose_of(const btTransform& t) {
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation(i, j) = t.getBasis()[i][j];
    pose.translation[i] = t.getOrigin()[i];
  }
  return pose;
}

inline Vec3 vec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline void expect_near(const btVector3& p, const btVector3& q, btScalar tolerance) {
  EXPECT_LE((p - q).length(), tolerance) << p.x() << " " << p.y() << " " << p.z() << " and " << q.x() << " " << q.y() << " "
                                         << q.z();
}

struct Random {
  std::mt19937 engine{7};
  double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine); }
  btVector3 vector(double size) {
    return btVector3(btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1))) * btScalar(size);
  }
  btTransform transform(double size) {
    const btQuaternion q(btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)),
                         btScalar(uniform(-1, 1)));
    return btTransform(q.normalized(), vector(size));
  }
};

inline constexpr btScalar kStep = btScalar(1) / 60;

/// A world of bodies that move, 60 steps a second.
struct Dynamics {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  std::optional<HullPairs> hull_pairs;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  explicit Dynamics(bool with_swiftlet = true) {
    if (with_swiftlet) hull_pairs.emplace(dispatcher);
    world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  }
  ~Dynamics() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }
  btRigidBody& add(btCollisionShape& shape, const btTransform& in_world, btScalar mass = 0,
                   const btVector3& velocity = {0, 0, 0}) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody& body = *bodies.emplace_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    body.setWorldTransform(in_world);
    body.setInterpolationWorldTransform(in_world);
    body.setLinearVelocity(velocity);
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
    return body;
  }
  void step() { world.stepSimulation(kStep, 0); }
};

}  // namespace swiftlet
