// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/bullet.h>

#include <new>

#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <swiftlet/world.h>

namespace swiftlet::bullet {
namespace {

btVector3 vector_of(const Vec3& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }

Pose pose_of(const btTransform& t) {
  const btMatrix3x3& r = t.getBasis();
  Pose pose;
  for (int row = 0; row < 3; ++row) pose.rotation.row(row) << r[row].x(), r[row].y(), r[row].z();
  pose.translation << t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z();
  return pose;
}

const HullShape& hull_of(const btCollisionObjectWrapper& body) {
  return *static_cast<const HullShape*>(body.getCollisionShape());
}

Placed placed(const btCollisionObjectWrapper& body) {
  const HullShape& hull = hull_of(body);
  return {&hull.model(), pose_of(body.getWorldTransform()), hull.getMargin()};
}

/// Lives as long as Bullet knows the pair, and with it the pair's seed.
class HullAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  HullAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                const btCollisionObjectWrapper& b, btConvexPenetrationDepthSolver& depth_solver)
      : btActivatingCollisionAlgorithm(info), depth_solver_(&depth_solver), manifold_(info.m_manifold) {
    if (manifold_) return;
    manifold_ = m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject());
    owns_manifold_ = true;
  }
  ~HullAlgorithm() override {
    if (owns_manifold_) m_dispatcher->releaseManifold(manifold_);
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    result->setPersistentManifold(manifold_);
    if (!answer(*a, *b, *result)) bullets().processCollision(a, b, info, result);
    if (owns_manifold_) result->refreshContactPoints();
  }
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return bullets().calculateTimeOfImpact(a, b, info, result);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (owns_manifold_) manifolds.push_back(manifold_);
  }

 private:
  /// False where it has nothing to say, and Bullet's algorithm shall.
  bool answer(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result) {
    if (hull_of(a).is_scaled() || hull_of(b).is_scaled()) return false;
    // As far as Bullet's own algorithm looks.
    const btScalar reach = hull_of(a).getMargin() + hull_of(b).getMargin() + manifold_->getContactBreakingThreshold() +
                           result.m_closestPointDistanceThreshold;
    const Nearest near = nearest(placed(a), placed(b), reach, seed_);
    if (near.found == Found::Overlap || near.found == Found::Nothing) return false;
    // Bullet's normal is on B and points to A.
    if (near.found == Found::Nearest)
      result.addContactPoint(vector_of(-near.normal), vector_of(near.point_b), btScalar(near.distance));
    return true;
  }

  /// Bullet's algorithm on this pair's manifold. It keeps nothing from step to step.
  btConvexConvexAlgorithm bullets() const {
    btCollisionAlgorithmConstructionInfo info(m_dispatcher, 0);
    return {manifold_, info, nullptr, nullptr, depth_solver_, 0, 0};
  }

  btConvexPenetrationDepthSolver* depth_solver_;
  btPersistentManifold* manifold_;
  PairSeed seed_;
  bool owns_manifold_ = false;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(HullAlgorithm) <= sizeof(btConvexConvexAlgorithm));

bool holds_model(const btCollisionObjectWrapper& body) {
  return dynamic_cast<const HullShape*>(body.getCollisionShape()) != nullptr;
}

}  // namespace

HullShape::HullShape(const Model& model) : model_(model) {
  for (const Vertex& v : model.level(model.finest_level()).view.vertices) addPoint(vector_of({v.x, v.y, v.z}), false);
  recalcLocalAabb();
}

bool HullShape::is_scaled() const { return getLocalScaling() != btVector3(1, 1, 1); }

btCollisionAlgorithm* HullPairs::Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                  const btCollisionObjectWrapper* a,
                                                                  const btCollisionObjectWrapper* b) {
  if (!holds_model(*a) || !holds_model(*b)) return others->CreateCollisionAlgorithm(info, a, b);
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(HullAlgorithm));
  return new (place) HullAlgorithm(info, *a, *b, *depth_solver);
}

HullPairs::HullPairs(btCollisionDispatcher& dispatcher) {
  constexpr int kHull = CONVEX_HULL_SHAPE_PROXYTYPE;
  btCollisionConfiguration& configuration = *dispatcher.getCollisionConfiguration();
  contact_points_.others = configuration.getCollisionAlgorithmCreateFunc(kHull, kHull);
  closest_points_.others = configuration.getClosestPointsAlgorithmCreateFunc(kHull, kHull);
  contact_points_.depth_solver = closest_points_.depth_solver = &depth_solver_;
  dispatcher.registerCollisionCreateFunc(kHull, kHull, &contact_points_);
  dispatcher.registerClosestPointsCreateFunc(kHull, kHull, &closest_points_);
}

}  // namespace swiftlet::bullet
