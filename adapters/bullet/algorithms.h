// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How the dispatcher gets an algorithm for a pair of shapes. Knows which, not how they work.
#pragma once

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "shapes.h"

namespace swiftlet::bullet {

/// One entry of a dispatcher's table: makes algorithms for the pairs that swiftlet answers, and leaves all others to what was
/// there.
struct Create : btCollisionAlgorithmCreateFunc {
  btCollisionAlgorithmCreateFunc* others = nullptr;
  HullModels* models = nullptr;
  bool all_points = false;  ///< of contact, not the nearest one alone
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override;
};

/// An object as Bullet hands one to an algorithm where it is no part of a compound.
inline btCollisionObjectWrapper wrapped(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

/// What the configuration does with a pair for as long as swiftlet has nothing to say: its algorithm, on the manifold `shared`
/// of the caller's if it takes one, else on manifolds that live as long as it does.
class Others {
 public:
  Others(const Create& create, btDispatcher& dispatcher, btPersistentManifold* shared)
      : create_(create), dispatcher_(dispatcher), shared_(shared) {}

  void process(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, const btDispatcherInfo& info,
               btManifoldResult& result);
  btScalar time_of_impact(btCollisionObject& a, btCollisionObject& b, const btDispatcherInfo& info,
                          btManifoldResult& result) const;
  void add_manifolds(btManifoldArray& manifolds) const {
    if (algorithm_) algorithm_->getAllContactManifolds(manifolds);
  }
  void stop() { algorithm_.reset(); }

 private:
  struct Free {
    btDispatcher* dispatcher;
    void operator()(btCollisionAlgorithm* algorithm) const;
  };
  using Algorithm = std::unique_ptr<btCollisionAlgorithm, Free>;
  Algorithm make(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) const;

  const Create& create_;
  btDispatcher& dispatcher_;
  btPersistentManifold* const shared_;
  Algorithm algorithm_;
};

/// How fast an object is at a point of the world: what has moved it in the last step.
inline btVector3 velocity_at(const btCollisionObjectWrapper& body, const btVector3& point) {
  const btRigidBody* const rigid = btRigidBody::upcast(body.getCollisionObject());
  return rigid ? rigid->getVelocityInLocalPoint(point - rigid->getWorldTransform().getOrigin()) : btVector3(0, 0, 0);
}

/// A convex body, which is `a` or `b`, and triangles.
btCollisionAlgorithm* create_triangles_algorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                                 bool body_is_a, Solid solid);

/// A MeshShape, and another one, a plane or, with its `solid`, a convex body that is no smaller.
btCollisionAlgorithm* create_mesh_algorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info,
                                            const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                            std::optional<Solid> solid = {});

}  // namespace swiftlet::bullet
