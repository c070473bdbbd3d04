// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A convex body against the triangles of a concave shape: those that lie in its box, all in one step. Bullet's own algorithm
// asks for triangle by triangle, and knows neither edges nor sides.
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <swiftlet/triangles.h>

#include "algorithms.h"
#include "mesh_pair.h"
#include "point_groups.h"

namespace swiftlet::bullet {
namespace {

/// Collects a concave shape's triangles.
class Gather final : public btTriangleCallback {
 public:
  Gather(TrianglePair& pair, std::vector<PointIds>& ids) : pair_(pair), ids_(ids) {}

  /// In some versions of Bullet both triangles of a heightfield's square have the same numbers, one after the other; in 3.24
  /// no two triangles have.
  void processTriangle(btVector3* corners, int part, int index) override {
    const TriangleId id{part, index};
    const bool is_second = !ids_.empty() && ids_.back().second == id;
    ids_.push_back({{}, id});
    pair_.add(std::uint64_t(std::uint32_t(part)) << 33 | std::uint64_t(std::uint32_t(index)) << 1 | is_second,
              vector_of(corners[0]), vector_of(corners[1]), vector_of(corners[2]));
  }

 private:
  TrianglePair& pair_;
  std::vector<PointIds>& ids_;
};

class TrianglesAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  TrianglesAlgorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                     const btCollisionObjectWrapper& b, bool body_is_a, Solid solid)
      : btActivatingCollisionAlgorithm(info),
        create_(create),
        state_(std::make_unique<State>(create, info, a, b, body_is_a, std::move(solid))) {}

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    PointGroups& groups = state_->groups;
    const btCollisionObjectWrapper &body = state_->body_is_a ? *a : *b, &surface = state_->body_is_a ? *b : *a;
    look(*body.getCollisionShape(), *surface.getCollisionShape());
    result->setPersistentManifold(&groups.first());
    if (!is_ours(body, surface)) {
      groups.clear();
      state_->others.process(*a, *b, info, *result);
      return;
    }
    state_->others.stop();
    if (create_.all_points && unscaled_mesh(*surface.getCollisionShape()) && groups.hold(*a, *b, *result)) return;
    const double touching = groups.first().getContactBreakingThreshold() + result->m_closestPointDistanceThreshold;
    const Placed placed = state_->solid.placed(body);
    const Pose surface_in_world = pose_of(surface.getWorldTransform());
    const double radius = surface.getCollisionShape()->getMargin();
    const Vec3 moved = create_.all_points ? moved_by(body, surface, info.m_timeStep) : Vec3::Zero();
    if (add_way_out(placed, *a, *b, moved, *result)) return;
    gather(body, surface, touching);
    const MeshShape* const mesh = unscaled_mesh(*surface.getCollisionShape());
    const bool is_solid = mesh && mesh->is_solid();
    const auto points = state_->pair.contacts(placed, surface_in_world, radius, moved, touching, is_solid);
    if (create_.all_points) {
      groups.hand_over(points, state_->ids, *a, *b, *result);
      return;
    }
    for (const TrianglePoint& p : points) {  // as Bullet does: one point of each triangle
      if (p.is_deepest_of_its) groups.add(p, state_->ids, *a, *result);
    }
  }

  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return state_->others.time_of_impact(*a, *b, info, *result);
  }

  void getAllContactManifolds(btManifoldArray& manifolds) override {
    for (btPersistentManifold* manifold : state_->groups.own()) manifolds.push_back(manifold);
    state_->others.add_manifolds(manifolds);
  }

 private:
  struct State {
    State(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
          const btCollisionObjectWrapper& b, bool is_a, Solid of)
        : body_is_a(is_a),
          solid(std::move(of)),
          groups(*info.m_dispatcher1, info.m_manifold, a, b, is_a),
          others(create, *info.m_dispatcher1, info.m_manifold) {}

    const bool body_is_a;
    Solid solid;
    Watch watch_body, watch_surface;
    PointGroups groups;
    TrianglePair pair;
    std::vector<PointIds> ids;
    Enclosed enclosed;
    Others others;  ///< where the pair is not ours
  };

  /// Forgets what was found of shapes that are others now; the sides of a surface are those of its triangles.
  void look(const btCollisionShape& body, const btCollisionShape& surface) {
    const Watch::Change of_body = state_->watch_body.look(body), of_surface = state_->watch_surface.look(surface);
    if (std::max(of_body, of_surface) == Watch::Change::None) return;
    state_->groups.clear(), state_->others.stop();
    if (of_surface == Watch::Change::Form) state_->pair = TrianglePair(), state_->enclosed = Enclosed();
  }

  /// Whether the body still is what it was, both poses are rigid motions, and the margin of Bullet's triangles is a radius.
  bool is_ours(const btCollisionObjectWrapper& body, const btCollisionObjectWrapper& surface) const {
    const Role role = role_of(*surface.getCollisionShape());
    if (role != Role::Mesh && !(role == Role::Triangles && state_->solid.role() == Role::Hull)) return false;
    if (!state_->solid.is_current(*body.getCollisionShape())) return false;
    const double radius = role == Role::Triangles ? surface.getCollisionShape()->getMargin() : 0;
    const Placed point{Body::point(Vec3::Zero(), radius), pose_of(surface.getWorldTransform())};
    return !std::isnan(tolerance(state_->solid.placed(body), point));
  }

  /// Of a body that was inside a solid when both met, and still is.
  bool add_way_out(const Placed& body, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, const Vec3& moved,
                   btManifoldResult& result) {
    const bool body_is_a = state_->body_is_a;
    const MeshShape* const mesh = unscaled_mesh(*(body_is_a ? b : a).getCollisionShape());
    if (!mesh || !state_->enclosed.may_hold()) return false;
    const PlacedMeshShape placed(*mesh, pose_of((body_is_a ? b : a).getWorldTransform()));
    const Vec3 centre = state_->solid.centre(*(body_is_a ? a : b).getCollisionShape());
    const std::optional<TrianglePoint> way = state_->enclosed.way_out(placed, body, centre, moved);
    if (!way) return false;
    state_->ids.assign(1, {});
    if (create_.all_points)
      state_->groups.hand_over({&*way, 1}, state_->ids, a, b, result);
    else
      state_->groups.add(*way, state_->ids, a, result);
    return true;
  }

  void gather(const btCollisionObjectWrapper& body, const btCollisionObjectWrapper& surface, double touching) {
    const btConcaveShape& shape = static_cast<const btConcaveShape&>(*surface.getCollisionShape());
    const btTransform in_surface = surface.getWorldTransform().inverse() * body.getWorldTransform();
    const btScalar reach = btScalar(touching) + shape.getMargin();
    const btVector3 around(reach, reach, reach);
    state_->pair.clear();
    state_->ids.clear();
    if (const MeshShape* const mesh = unscaled_mesh(shape)) {
      btVector3 least, most;
      body.getCollisionShape()->getAabb(btTransform::getIdentity(), least, most);
      const auto add = [&](std::uint32_t t, const Vec3& p, const Vec3& q, const Vec3& r) {
        state_->ids.push_back({{}, {0, int(mesh->mesh().source_triangle()[t])}});
        state_->pair.add(t, p, q, r);
      };
      for_triangles(mesh->mesh(), {vector_of(least - around), vector_of(most + around), pose_of(in_surface)}, add);
      return;
    }
    btVector3 least, most;
    body.getCollisionShape()->getAabb(in_surface, least, most);
    Gather gather(state_->pair, state_->ids);
    shape.processAllTriangles(&gather, least - around, most + around);
  }

  /// How far the body's centre came in the last step, against the surface.
  Vec3 moved_by(const btCollisionObjectWrapper& body, const btCollisionObjectWrapper& surface, btScalar time_step) const {
    const btVector3 centre = body.getWorldTransform()(vector_of(state_->solid.centre(*body.getCollisionShape())));
    return vector_of((velocity_at(body, centre) - velocity_at(surface, centre)) * time_step);
  }

  const Create& create_;
  std::unique_ptr<State> state_;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(TrianglesAlgorithm) <= sizeof(btConvexConcaveCollisionAlgorithm));

}  // namespace

btCollisionAlgorithm* create_triangles_algorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                                                 bool body_is_a, Solid solid) {
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(TrianglesAlgorithm));
  return new (place) TrianglesAlgorithm(create, info, a, b, body_is_a, std::move(solid));
}

}  // namespace swiftlet::bullet
