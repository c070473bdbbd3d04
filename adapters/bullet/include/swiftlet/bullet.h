// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in Bullet: a hull shape that holds a model, and its pairs in both tables of a dispatcher. In the precision of the
// Bullet it is compiled with: single as swiftlet::bullet, double as swiftlet::bullet_float64.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>

#include <swiftlet/model.h>

namespace swiftlet::bullet {

/// A btConvexHullShape of the vertices of a model's level 0, rounded to btScalar; to all of Bullet but HullPairs it is just
/// that. Its margin lies outside the hull, as that of every btConvexHullShape. Points that are added later are not the model's.
class HullShape : public btConvexHullShape {
 public:
  /// Shares the model's block. Throws std::invalid_argument where the model lacks level 0 (Detail).
  explicit HullShape(const Model& model);
  const Model& model() const { return model_; }  ///< in double precision, as given
  /// A model is rigid: a shape with a local scaling is answered by Bullet. Scale the points before the model is built.
  bool is_scaled() const;

 private:
  Model model_;
};

/// Makes pairs of two unscaled HullShapes swiftlet's, in contacts, up to four a step, and in closest-point queries, apart or
/// overlapping. All other pairs stay with what the dispatcher's configuration has for them. Create one after the dispatcher and
/// before the world; it outlives the world.
class HullPairs {
 public:
  explicit HullPairs(btCollisionDispatcher& dispatcher);  ///< registers itself in both of the dispatcher's tables
  HullPairs(const HullPairs&) = delete;
  HullPairs& operator=(const HullPairs&) = delete;

 private:
  struct Create : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithmCreateFunc* others = nullptr;
    btConvexPenetrationDepthSolver* depth_solver = nullptr;
    bool all_points = false;  ///< of contact, not the nearest one alone
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* a,
                                                   const btCollisionObjectWrapper* b) override;
  };
  btGjkEpaPenetrationDepthSolver depth_solver_;
  Create contact_points_, closest_points_;
};

}  // namespace swiftlet::bullet
