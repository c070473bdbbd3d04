// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/bullet.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

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
  return {Body(hull.model(), hull.getMargin()), pose_of(body.getWorldTransform())};
}

/// Points of the steps before stay while they span this share of the area that this step's span, and are less deep by no more
/// than this share of Bullet's breaking threshold.
constexpr btScalar kHeldArea = btScalar(0.9), kHeldDepth = btScalar(0.02);

/// Lives as long as Bullet knows the pair, and with it the pair's seed. Bullet's manifold collects points over steps, ours
/// holds those of one step.
class HullAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  HullAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                const btCollisionObjectWrapper& b, btConvexPenetrationDepthSolver& depth_solver, bool all_points)
      : btActivatingCollisionAlgorithm(info), depth_solver_(&depth_solver), persistent_(info.m_manifold) {
    if (all_points) manifold_ = std::make_unique<Manifold>();
    if (persistent_) return;
    persistent_ = m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject());
    owns_persistent_ = true;
  }
  ~HullAlgorithm() override {
    if (owns_persistent_) m_dispatcher->releaseManifold(persistent_);
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    result->setPersistentManifold(persistent_);
    if (!answer(*a, *b, *result)) bullets().processCollision(a, b, info, result);
    if (owns_persistent_) result->refreshContactPoints();
  }
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return bullets().calculateTimeOfImpact(a, b, info, result);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (owns_persistent_) manifolds.push_back(persistent_);
  }

 private:
  /// False where it has nothing to say, and Bullet's algorithm shall.
  bool answer(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result) {
    if (hull_of(a).is_scaled() || hull_of(b).is_scaled()) return false;
    const btScalar touching = persistent_->getContactBreakingThreshold() + result.m_closestPointDistanceThreshold;
    return manifold_ ? add_all(a, b, touching, result) : add_nearest(a, b, touching, result);
  }

  /// Bullet's normal is on B and points to A.
  bool add_nearest(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btScalar touching,
                   btManifoldResult& result) {
    // As far as Bullet's own algorithm looks.
    const Nearest near = nearest(placed(a), placed(b), hull_of(a).getMargin() + hull_of(b).getMargin() + touching, seed_);
    if (near.found == Found::Nothing) return false;
    if (near.found == Found::Nearest)
      result.addContactPoint(vector_of(-near.normal), vector_of(near.point_b), btScalar(near.distance));
    return true;
  }

  /// Points that hold the area of this step. A manifold of Bullet's that is shared keeps those of others.
  bool add_all(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btScalar touching,
               btManifoldResult& result) {
    if (contacts(placed(a), placed(b), touching, MANIFOLD_CACHE_SIZE, seed_, *manifold_) == Found::Nothing) return false;
    if (owns_persistent_) {
      if (holds_the_area(a)) return true;
      forget_others(a);
    }
    for (std::uint32_t i = manifold_->count;
         i-- > 0;) {  // the deepest is the first and comes last: it takes the place of others
      const ManifoldPoint& p = manifold_->points[i];
      result.addContactPoint(vector_of(-manifold_->normal), vector_of(p.point_b), btScalar(p.separation));
    }
    return true;
  }

  /// Whether the points of the steps before, as places on both bodies, still stand for the area of this step; if so they get
  /// its normal. Points that stay keep their impulses; the corners of the area, of which the deepest four count, change from
  /// step to step on a round face.
  bool holds_the_area(const btCollisionObjectWrapper& a) {
    const int kept = persistent_->getNumContacts();
    if (kept < 3 || manifold_->count < 3 || persistent_->getBody0() != a.getCollisionObject()) return false;
    const btVector3 n = vector_of(-manifold_->normal);
    const btScalar far = persistent_->getContactBreakingThreshold();
    std::array<btVector3, MANIFOLD_CACHE_SIZE> before, now;
    btScalar deepest = far;
    for (int i = 0; i < kept; ++i) {
      const btManifoldPoint& p = persistent_->getContactPoint(i);
      const btVector3 on_b = persistent_->getBody1()->getWorldTransform()(p.m_localPointB),
                      apart = persistent_->getBody0()->getWorldTransform()(p.m_localPointA) - on_b;
      const btScalar distance = apart.dot(n);
      if (distance > far || (apart - n * distance).length2() > far * far) return false;
      deepest = std::min(deepest, distance);
      before[std::size_t(i)] = on_b;
    }
    for (std::uint32_t i = 0; i < manifold_->count; ++i) now[i] = vector_of(manifold_->points[i].point_b);
    if (area(before, kept, n) < kHeldArea * area(now, int(manifold_->count), n) ||
        manifold_->points[0].separation < deepest - kHeldDepth * far)
      return false;
    for (int i = 0; i < kept; ++i) persistent_->getContactPoint(i).m_normalWorldOnB = n;
    turn_around();
    return true;
  }
  /// Twice the area of three or four places, in any order, seen along `n`.
  static btScalar area(const std::array<btVector3, MANIFOLD_CACHE_SIZE>& p, int count, const btVector3& n) {
    const auto across = [&](const btVector3& u, const btVector3& v) { return btFabs(u.cross(v).dot(n)); };
    if (count == 3) return across(p[1] - p[0], p[2] - p[0]);
    const btScalar of_diagonals[] = {across(p[0] - p[1], p[2] - p[3]), across(p[0] - p[2], p[1] - p[3]),
                                     across(p[0] - p[3], p[1] - p[2])};
    return *std::max_element(std::begin(of_diagonals), std::end(of_diagonals));
  }

  /// Bullet's solver goes through the points one by one, and what it leaves undone is always on the same side of those it
  /// visits in the same order: a tower leans that way more with every step. The first point becomes the last.
  void turn_around() {
    for (int i = 1; i < persistent_->getNumContacts(); ++i)
      std::swap(persistent_->getContactPoint(i - 1), persistent_->getContactPoint(i));
  }

  /// Bullet adds a point to those of the steps before, or carries the impulse of the one nearby over to it. Those that are near
  /// none of this step's go.
  void forget_others(const btCollisionObjectWrapper& a) {
    const bool swapped = persistent_->getBody0() != a.getCollisionObject();
    const btTransform& in_world = persistent_->getBody0()->getWorldTransform();
    for (int i = persistent_->getNumContacts(); i-- > 0;) {
      const btVector3 old = in_world(persistent_->getContactPoint(i).m_localPointA);
      bool stays = false;
      for (std::uint32_t k = 0; k < manifold_->count; ++k) {
        const btVector3 p = vector_of(swapped ? manifold_->points[k].point_b : manifold_->points[k].point_a);
        stays = stays || (p - old).length() < persistent_->getContactBreakingThreshold();
      }
      if (!stays) persistent_->removeContactPoint(i);
    }
  }

  /// Bullet's algorithm on this pair's manifold. It keeps nothing from step to step.
  btConvexConvexAlgorithm bullets() const {
    btCollisionAlgorithmConstructionInfo info(m_dispatcher, 0);
    return {persistent_, info, nullptr, nullptr, depth_solver_, 0, 0};
  }

  btConvexPenetrationDepthSolver* depth_solver_;
  btPersistentManifold* persistent_;
  PairSeed seed_;
  std::unique_ptr<Manifold> manifold_;  ///< of the step before; none where closest points are asked for
  bool owns_persistent_ = false;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(HullAlgorithm) <= sizeof(btConvexConvexAlgorithm));

bool holds_model(const btCollisionObjectWrapper& body) {
  return dynamic_cast<const HullShape*>(body.getCollisionShape()) != nullptr;
}

}  // namespace

HullShape::HullShape(const Model& model) : model_(whole(model)) {
  for (const Vertex& v : model.level(0).view.vertices) addPoint(vector_of({v.x, v.y, v.z}), false);
  recalcLocalAabb();
}

bool HullShape::is_scaled() const { return getLocalScaling() != btVector3(1, 1, 1); }

btCollisionAlgorithm* HullPairs::Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                  const btCollisionObjectWrapper* a,
                                                                  const btCollisionObjectWrapper* b) {
  if (!holds_model(*a) || !holds_model(*b)) return others->CreateCollisionAlgorithm(info, a, b);
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(HullAlgorithm));
  return new (place) HullAlgorithm(info, *a, *b, *depth_solver, all_points);
}

HullPairs::HullPairs(btCollisionDispatcher& dispatcher) {
  constexpr int kHull = CONVEX_HULL_SHAPE_PROXYTYPE;
  btCollisionConfiguration& configuration = *dispatcher.getCollisionConfiguration();
  contact_points_.others = configuration.getCollisionAlgorithmCreateFunc(kHull, kHull);
  closest_points_.others = configuration.getClosestPointsAlgorithmCreateFunc(kHull, kHull);
  contact_points_.all_points = true;
  contact_points_.depth_solver = closest_points_.depth_solver = &depth_solver_;
  dispatcher.registerCollisionCreateFunc(kHull, kHull, &contact_points_);
  dispatcher.registerClosestPointsCreateFunc(kHull, kHull, &closest_points_);
}

}  // namespace swiftlet::bullet
