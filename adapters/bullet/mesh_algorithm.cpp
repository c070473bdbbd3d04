// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A MeshShape against another one, a plane or a convex body that is no smaller. Bullet has no algorithm for two concave shapes.
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>

#include "algorithms.h"
#include "mesh_pair.h"
#include "point_groups.h"

namespace swiftlet::bullet {
namespace {

class MeshAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  MeshAlgorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                const btCollisionObjectWrapper& b, std::optional<Solid> solid)
      : btActivatingCollisionAlgorithm(info), create_(create) {
    const bool mesh_is_a = role_of(*a.getCollisionShape()) == Role::Mesh;
    state_ = std::make_unique<State>(create, info, a, b, mesh_is_a, std::move(solid));
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    PointGroups& groups = state_->groups;
    forget(std::max(state_->watch_a.look(*a->getCollisionShape()), state_->watch_b.look(*b->getCollisionShape())));
    result->setPersistentManifold(&groups.first());
    const bool first_is_a = state_->first_is_a;
    const btCollisionObjectWrapper &first = first_is_a ? *a : *b, &second = first_is_a ? *b : *a;
    const MeshShape *const mesh = unscaled_mesh(*first.getCollisionShape()), *const other_mesh =
                                                                                 unscaled_mesh(*second.getCollisionShape());
    const std::optional<Solid>& solid = state_->solid;
    const btCollisionShape& other = *second.getCollisionShape();
    const bool is_ours =
        solid ? solid->is_current(other) && is_legal(solid->body(other)) : other_mesh || role_of(other) == Role::Plane;
    if (!mesh || !is_ours) {  // scaled since they met, or no body
      groups.clear();
      state_->others.process(*a, *b, info, *result);
      return;
    }
    state_->others.stop();
    const PlacedMeshShape placed(*mesh, pose_of(first.getWorldTransform()));
    const Placed of_first{Body::point(Vec3::Zero(), mesh->getMargin()), placed.in_world};
    const Placed of_second = solid ? solid->placed(second)
                                   : Placed{Body::point(Vec3::Zero(), other_mesh ? other_mesh->getMargin() : 0),
                                            pose_of(second.getWorldTransform())};
    if (std::isnan(tolerance(of_first, of_second))) return groups.clear();  // no rigid motion, or a margin that is no radius
    if (create_.all_points && groups.hold(*a, *b, *result)) return;
    const double touching = groups.first().getContactBreakingThreshold() + result->m_closestPointDistanceThreshold;
    if (other_mesh)
      bodies(placed, {*other_mesh, of_second.in_world}, first, second, info.m_timeStep, touching);
    else if (solid)
      bodies(placed, PlacedMeshShape(of_second), first, second, info.m_timeStep, touching);
    else
      plane(placed, second, touching);
    if (create_.all_points) {
      groups.hand_over(state_->points, state_->ids, *a, *b, *result);
      return;
    }
    for (const TrianglePoint& p : state_->points) groups.add(p, state_->ids, *a, *result);
  }

  /// Bullet sweeps no concave shape.
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&, btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    for (btPersistentManifold* manifold : state_->groups.own()) manifolds.push_back(manifold);
    state_->others.add_manifolds(manifolds);
  }

 private:
  struct State {
    State(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
          const btCollisionObjectWrapper& b, bool is_a, std::optional<Solid> of)
        : first_is_a(is_a),
          solid(std::move(of)),
          groups(*info.m_dispatcher1, info.m_manifold, a, b, is_a),
          others(create, *info.m_dispatcher1, info.m_manifold) {}

    const bool first_is_a;             ///< a mesh; of two meshes Bullet's first
    const std::optional<Solid> solid;  ///< the second one, if it is convex
    Watch watch_a, watch_b;
    PointGroups groups;
    MeshPair pair;
    std::vector<TrianglePoint> points;  ///< all, or the nearest alone
    std::vector<PointIds> ids;
    Others others;  ///< where the pair is not ours
  };

  void forget(Watch::Change change) {
    if (change == Watch::Change::None) return;
    state_->groups.clear(), state_->others.stop();
    if (change == Watch::Change::Form) state_->pair.forget_vertices();
  }

  void bodies(const PlacedMeshShape& first, const PlacedMeshShape& second, const btCollisionObjectWrapper& first_object,
              const btCollisionObjectWrapper& second_object, btScalar time_step, double touching) {
    state_->points.clear();
    if (create_.all_points) {
      const Vec3 middle = (first.mesh().box_min() + first.mesh().box_max()) / 2;
      const btVector3 centre = first_object.getWorldTransform()(vector_of(middle));
      const Vec3 moved = vector_of((velocity_at(first_object, centre) - velocity_at(second_object, centre)) * time_step);
      const auto points = state_->pair.contacts(first, second, moved, touching);
      state_->points.assign(points.begin(), points.end());
    } else if (const std::optional<TrianglePoint> near = state_->pair.nearest(first, second, touching)) {
      state_->points.push_back(*near);
    }
    state_->ids.assign(state_->pair.ids().begin(), state_->pair.ids().end());
  }

  void plane(const PlacedMeshShape& mesh, const btCollisionObjectWrapper& object, double touching) {
    contacts(mesh, half_space_of(object), touching, state_->points, state_->ids);
    if (create_.all_points || state_->points.empty()) return;
    const Spread deepest = spread(state_->points, 0);
    state_->points.assign(1, TrianglePoint(state_->points[deepest.index[0]]));
  }

  const Create& create_;
  std::unique_ptr<State> state_;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(MeshAlgorithm) <= sizeof(btConvexConcaveCollisionAlgorithm));

}  // namespace

btCollisionAlgorithm* create_mesh_algorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info,
                                            const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                            std::optional<Solid> solid) {
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(MeshAlgorithm));
  return new (place) MeshAlgorithm(create, info, a, b, std::move(solid));
}

}  // namespace swiftlet::bullet
