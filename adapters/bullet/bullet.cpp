// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/bullet.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <new>
#include <utility>

#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>

#include <swiftlet/world.h>

#include "algorithms.h"
#include "held_points.h"

namespace swiftlet::bullet {
namespace {

/// A HullShape and a convex shape or plane, in either order, as the kernel sees them.
class SolidPair {
 public:
  SolidPair(Solid a, Solid b) : a_(std::move(a)), b_(std::move(b)) {}

  bool is_current(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) const {
    return a_.is_current(*a.getCollisionShape()) && b_.is_current(*b.getCollisionShape());
  }
  Nearest nearest(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, double beyond, PairSeed& seed) const {
    if (b_.role() == Role::Plane) return swiftlet::nearest(a_.placed(a), half_space_of(b), beyond);
    if (a_.role() != Role::Plane) return swiftlet::nearest(a_.placed(a), b_.placed(b), beyond, seed);
    Nearest near = swiftlet::nearest(b_.placed(b), half_space_of(a), beyond);
    near.normal = -near.normal;
    std::swap(near.point_a, near.point_b);
    return near;
  }
  Found contacts(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, double beyond, PairSeed& seed,
                 Manifold& manifold, Rest& rest) const {
    constexpr std::uint32_t kMost = MANIFOLD_CACHE_SIZE;
    if (b_.role() == Role::Plane) return swiftlet::contacts(a_.placed(a), half_space_of(b), beyond, kMost, manifold);
    if (a_.role() != Role::Plane) return swiftlet::contacts(a_.placed(a), b_.placed(b), beyond, kMost, seed, manifold, rest);
    swap(manifold);
    const Found found = swiftlet::contacts(b_.placed(b), half_space_of(a), beyond, kMost, manifold);
    swap(manifold);
    return found;
  }

 private:
  static void swap(Manifold& manifold) {
    manifold.normal = -manifold.normal;
    std::swap(manifold.face_a, manifold.face_b);
    for (ManifoldPoint& p : manifold.points) std::swap(p.point_a, p.point_b), std::swap(p.feature_a, p.feature_b);
  }

  Solid a_, b_;
};

/// Lives as long as Bullet knows the pair, and with it the pair's seed.
class HullAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  HullAlgorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                const btCollisionObjectWrapper& b, SolidPair solids)
      : btActivatingCollisionAlgorithm(info),
        shared_(info.m_manifold),
        persistent_(shared_ ? shared_ : m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject())),
        state_(std::make_unique<State>(std::move(solids), Others(create, *m_dispatcher, shared_))) {
    if (create.all_points) state_->touches = std::make_unique<Touches>();
  }
  ~HullAlgorithm() override {
    if (!shared_) m_dispatcher->releaseManifold(persistent_);
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    const Watch::Change of_a = state_->watch_a.look(*a->getCollisionShape()),
                        of_b = state_->watch_b.look(*b->getCollisionShape());
    if (std::max(of_a, of_b) != Watch::Change::None) clear(), state_->others.stop();
    result->setPersistentManifold(persistent_);
    if (answer(*a, *b, *result)) {
      if (!shared_) result->refreshContactPoints();
      state_->others.stop();
      return;
    }
    clear();
    state_->others.process(*a, *b, info, *result);
  }
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return state_->others.time_of_impact(*a, *b, info, *result);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (!shared_) manifolds.push_back(persistent_);
    state_->others.add_manifolds(manifolds);
  }

 private:
  void clear() {
    if (!shared_) persistent_->clearManifold();
  }
  /// False where it has nothing to say, and the configuration's algorithm shall.
  bool answer(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result) {
    if (!state_->solids.is_current(a, b)) return false;
    const btScalar touching = persistent_->getContactBreakingThreshold() + result.m_closestPointDistanceThreshold;
    return state_->touches ? add_all(a, b, touching, result) : add_nearest(a, b, touching, result);
  }

  /// Bullet's normal is on B and points to A.
  bool add_nearest(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btScalar touching,
                   btManifoldResult& result) {
    // As far as Bullet's own algorithm looks.
    const btScalar reach = a.getCollisionShape()->getMargin() + b.getCollisionShape()->getMargin() + touching;
    const Nearest near = state_->solids.nearest(a, b, reach, seed_);
    if (near.found == Found::Nothing) return false;
    if (near.found == Found::Nearest)
      result.addContactPoint(vector_of(-near.normal), vector_of(near.point_b), btScalar(near.distance));
    return true;
  }

  /// Points that hold the area of this step. A manifold of Bullet's that is shared keeps those of others.
  bool add_all(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btScalar touching,
               btManifoldResult& result) {
    SolidPair& solids = state_->solids;
    Manifold& now = state_->touches->manifold;
    Rest& rest = state_->touches->rest;
    const bool holds = !shared_ && persistent_->getBody0() == a.getCollisionObject();
    rest.within = holds ? kAtRest * persistent_->getContactBreakingThreshold() : -1;
    Found found = solids.contacts(a, b, touching, seed_, now, rest);
    if (found == Found::AtRest) {
      if (hold_on(now, result)) return true;
      rest.within = -1;
      found = solids.contacts(a, b, touching, seed_, now, rest);
    }
    if (found == Found::Nothing) return false;
    if (holds && hold_the_area(now, result)) return true;
    const bool one_goes = !shared_ && carry_over(*persistent_, now, persistent_->getBody0() != a.getCollisionObject());
    for (std::uint32_t i = now.count; i-- > 0;) {  // the deepest is the first and comes last: it takes the place of others
      const ManifoldPoint& p = now.points[i];
      result.addContactPoint(vector_of(-now.normal), vector_of(p.point_b), btScalar(p.separation));
      if (one_goes && i + 1 == now.count) persistent_->removeContactPoint(0);
    }
    return true;
  }

  /// Of the step before; none where closest points are asked for.
  struct Touches {
    Manifold manifold;
    Rest rest;
  };
  struct State {
    State(SolidPair pair, Others bullets) : solids(std::move(pair)), others(std::move(bullets)) {}

    SolidPair solids;
    Watch watch_a, watch_b;
    std::unique_ptr<Touches> touches;
    Others others;
  };

  btPersistentManifold* const shared_;      ///< of the caller's; null: it has one of its own
  btPersistentManifold* const persistent_;  ///< either
  std::unique_ptr<State> state_;
  PairSeed seed_;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(HullAlgorithm) <= sizeof(btConvexConcaveCollisionAlgorithm));

/// Whether swiftlet answers the pair, but for Points of which there is no model.
bool is_ours(Role a, Role b) {
  if (a == Role::Bullets || b == Role::Bullets) return false;
  if (a == Role::Hull || b == Role::Hull) return true;
  return (a == Role::Mesh && b != Role::Triangles) || (b == Role::Mesh && a != Role::Triangles);
}

/// Of a small body and a large one it is the corners of the small one that meet the faces of the large one.
bool is_no_larger(const MeshShape& mesh, const btCollisionShape& body) {
  btVector3 middle;
  btScalar radius;
  body.getBoundingSphere(middle, radius);
  return (mesh.mesh().box_max() - mesh.mesh().box_min()).norm() / 2 <= double(radius);
}

bool is_surface(Role role) { return role == Role::Mesh || role == Role::Triangles; }

}  // namespace

HullShape::HullShape(const Model& model) : model_(whole(model)) {
  for (const Vertex& v : model.level(0).view.vertices) addPoint(vector_of(Vec3(v.x, v.y, v.z)), false);
  recalcLocalAabb();
}

bool HullShape::is_scaled() const { return getLocalScaling() != btVector3(1, 1, 1); }

Others::Algorithm Others::make(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) const {
  btCollisionAlgorithmConstructionInfo info(&dispatcher_, 0);
  info.m_manifold = shared_;
  return {create_.others->CreateCollisionAlgorithm(info, &a, &b), Free{&dispatcher_}};
}

void Others::Free::operator()(btCollisionAlgorithm* algorithm) const {
  algorithm->~btCollisionAlgorithm();
  dispatcher->freeCollisionAlgorithm(algorithm);
}

void Others::process(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, const btDispatcherInfo& info,
                     btManifoldResult& result) {
  if (!algorithm_) algorithm_ = make(a, b);
  algorithm_->processCollision(&a, &b, info, &result);
}

btScalar Others::time_of_impact(btCollisionObject& a, btCollisionObject& b, const btDispatcherInfo& info,
                                btManifoldResult& result) const {
  return make(wrapped(a), wrapped(b))->calculateTimeOfImpact(&a, &b, info, &result);
}

btCollisionAlgorithm* Create::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                       const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b) {
  const btCollisionShape &shape_a = *a->getCollisionShape(), &shape_b = *b->getCollisionShape();
  const Role role_a = role_of(shape_a), role_b = role_of(shape_b);
  if (!is_ours(role_a, role_b)) return others->CreateCollisionAlgorithm(info, a, b);
  std::optional<Solid> solid_a = Solid::of(shape_a, *models), solid_b = Solid::of(shape_b, *models);
  if (is_surface(role_a) || is_surface(role_b)) {
    const bool second_is = is_surface(role_b);
    if (is_surface(second_is ? role_a : role_b) || role_a == Role::Plane || role_b == Role::Plane)
      return create_mesh_algorithm(*this, info, *a, *b);
    std::optional<Solid>& solid = second_is ? solid_a : solid_b;
    if (!solid) return others->CreateCollisionAlgorithm(info, a, b);
    const MeshShape* const mesh = unscaled_mesh(second_is ? shape_b : shape_a);
    if (mesh && is_no_larger(*mesh, second_is ? shape_a : shape_b))
      return create_mesh_algorithm(*this, info, *a, *b, std::move(solid));
    return create_triangles_algorithm(*this, info, *a, *b, second_is, std::move(*solid));
  }
  if (!solid_a || !solid_b) return others->CreateCollisionAlgorithm(info, a, b);
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(HullAlgorithm));
  return new (place) HullAlgorithm(*this, info, *a, *b, {std::move(*solid_a), std::move(*solid_b)});
}

struct HullPairs::Entries {
  HullModels models;
  std::deque<Create> creates;  ///< the dispatcher points to them
};

HullPairs::HullPairs(btCollisionDispatcher& dispatcher) : entries_(std::make_unique<Entries>()) {
  btCollisionConfiguration& configuration = *dispatcher.getCollisionConfiguration();
  const auto entry = [&](btCollisionAlgorithmCreateFunc* others, bool all_points) {
    Create& create = entries_->creates.emplace_back();
    create.others = others;
    create.models = &entries_->models;
    create.all_points = all_points;
    return &create;
  };
  const auto may_be_ours = [](int type) { return role_of(type) != Role::Bullets || type == kMeshType; };
  for (int a = 0; a < MAX_BROADPHASE_COLLISION_TYPES; ++a) {
    for (int b = 0; b < MAX_BROADPHASE_COLLISION_TYPES; ++b) {
      const auto is_one = [&](int type) { return a == type || b == type; };
      if (!(is_one(CONVEX_HULL_SHAPE_PROXYTYPE) || is_one(kMeshType)) || !may_be_ours(a) || !may_be_ours(b)) continue;
      dispatcher.registerCollisionCreateFunc(a, b, entry(configuration.getCollisionAlgorithmCreateFunc(a, b), true));
      dispatcher.registerClosestPointsCreateFunc(a, b, entry(configuration.getClosestPointsAlgorithmCreateFunc(a, b), false));
    }
  }
}

HullPairs::~HullPairs() = default;

bool HullPairs::answers(const btCollisionShape& a, const btCollisionShape& b) const {
  const auto is_taken = [&](const btCollisionShape& shape) {
    const Role role = role_of(shape);
    if (role == Role::Mesh || role == Role::Plane) return true;
    if (role == Role::Triangles) return is_legal(Body::point(Vec3::Zero(), shape.getMargin()));
    const std::optional<Solid> solid = Solid::of(shape, entries_->models);
    return solid && is_legal(solid->body(shape));
  };
  return is_ours(role_of(a), role_of(b)) && is_taken(a) && is_taken(b);
}

}  // namespace swiftlet::bullet
