// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A HullShape against the triangles of a concave shape: those that lie in its box, all in one step. Bullet's own algorithm asks
// for triangle by triangle, and knows neither edges nor sides.
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <swiftlet/triangles.h>

#include "algorithms.h"
#include "held_points.h"

namespace swiftlet::bullet {
namespace {

/// The normals of one manifold's points make smaller angles than this with that of its deepest one; of all others of them have
/// larger ones. Cosine, of 26 degrees.
constexpr double kAlike = 0.9;
/// Points whose normals differ by more than 60 degrees leave nothing to others.
constexpr btScalar kLikeAnEmptyOne = btScalar(0.5);
/// As many as a corner of a room has walls, and one more.
constexpr std::size_t kMostManifolds = 4;

/// Normals that differ by less are one.
constexpr double kOneNormal = 1e-4;
/// Points whose normals are alike; the first one is the deepest.
using Group = std::vector<TrianglePoint>;

/// Collects a concave shape's triangles.
class Gather final : public btTriangleCallback {
 public:
  struct Id {
    int part, index;
    bool operator==(const Id&) const = default;
  };
  Gather(TrianglePair& pair, std::vector<Id>& ids) : pair_(pair), ids_(ids) {}

  /// Both triangles of a square of a heightfield come with the same numbers, one after the other.
  void processTriangle(btVector3* corners, int part, int index) override {
    const Id id{part, index};
    const bool is_second = !ids_.empty() && ids_.back() == id;
    ids_.push_back(id);
    pair_.add(std::uint64_t(std::uint32_t(part)) << 33 | std::uint64_t(std::uint32_t(index)) << 1 | is_second,
              vector_of(corners[0]), vector_of(corners[1]), vector_of(corners[2]));
  }

 private:
  TrianglePair& pair_;
  std::vector<Id>& ids_;
};

class TrianglesAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  TrianglesAlgorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper& a,
                     const btCollisionObjectWrapper& b)
      : btActivatingCollisionAlgorithm(info),
        create_(create),
        shared_(info.m_manifold),
        hull_is_a_(role_of(*a.getCollisionShape()) == Role::Hull),
        state_(std::make_unique<State>()) {
    if (!shared_) state_->own.push_back(m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject()));
  }
  ~TrianglesAlgorithm() override {
    for (btPersistentManifold* manifold : state_->own) m_dispatcher->releaseManifold(manifold);
  }

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    btPersistentManifold* const first = shared_ ? shared_ : state_->own.front();
    result->setPersistentManifold(first);
    const btCollisionObjectWrapper &hull = hull_is_a_ ? *a : *b, &surface = hull_is_a_ ? *b : *a;
    const HullShape& shape = static_cast<const HullShape&>(*hull.getCollisionShape());
    const Placed placed{Body(shape.model(), shape.getMargin()), pose_of(hull.getWorldTransform())};
    const Pose surface_in_world = pose_of(surface.getWorldTransform());
    const bool is_rigid = !std::isnan(tolerance(placed, {Body::point(Vec3::Zero()), surface_in_world}));
    if (role_of(shape) != Role::Hull || !is_rigid) {
      others(*a, *b)->processCollision(a, b, info, result);
      return;
    }
    state_->others.reset();
    const double touching = first->getContactBreakingThreshold() + result->m_closestPointDistanceThreshold;
    gather(hull, surface, touching);
    const Vec3 moved = create_.all_points ? moved_by(hull, surface, info.m_timeStep) : Vec3::Zero();
    const btScalar radius = surface.getCollisionShape()->getMargin();
    const auto points = state_->pair.contacts(placed, surface_in_world, radius, moved, touching);
    if (create_.all_points)
      hand_over_groups(points, *a, *b, *result);
    else
      hand_over_nearest(points, surface, *result);
  }

  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return others(wrapped(*a), wrapped(*b))->calculateTimeOfImpact(a, b, info, result);
  }

  void getAllContactManifolds(btManifoldArray& manifolds) override {
    for (btPersistentManifold* manifold : state_->own) manifolds.push_back(manifold);
    if (state_->others) (*state_->others)->getAllContactManifolds(manifolds);
  }

 private:
  struct State {
    TrianglePair pair;
    std::vector<Gather::Id> ids;
    std::vector<Group> groups;
    std::vector<btPersistentManifold*> own;  ///< at least one, unless the caller has one for all
    std::unique_ptr<OthersAlgorithm> others;
  };

  /// Bullet's algorithm for meshes has a manifold of its own, hence it stays as long as it is wanted.
  OthersAlgorithm& others(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
    for (btPersistentManifold* manifold : state_->own) manifold->clearManifold();
    if (!state_->others) state_->others = std::make_unique<OthersAlgorithm>(create_, *m_dispatcher, shared_, a, b);
    return *state_->others;
  }

  void gather(const btCollisionObjectWrapper& hull, const btCollisionObjectWrapper& surface, double touching) {
    const btConcaveShape& shape = static_cast<const btConcaveShape&>(*surface.getCollisionShape());
    btVector3 least, most;
    hull.getCollisionShape()->getAabb(surface.getWorldTransform().inverse() * hull.getWorldTransform(), least, most);
    const btScalar reach = btScalar(touching) + shape.getMargin();
    const btVector3 around(reach, reach, reach);
    state_->pair.clear();
    state_->ids.clear();
    Gather gather(state_->pair, state_->ids);
    shape.processAllTriangles(&gather, least - around, most + around);
  }

  /// How far the hull's centre came in the last step, against the surface: their velocities are those that moved them.
  static Vec3 moved_by(const btCollisionObjectWrapper& hull, const btCollisionObjectWrapper& surface, btScalar time_step) {
    const auto& shape = static_cast<const HullShape&>(*hull.getCollisionShape());
    const btVector3 centre = hull.getWorldTransform()(vector_of(shape.model().centre()));
    const auto velocity = [&](const btCollisionObjectWrapper& body) {
      const btRigidBody* const rigid = btRigidBody::upcast(body.getCollisionObject());
      return rigid ? rigid->getVelocityInLocalPoint(centre - rigid->getWorldTransform().getOrigin()) : btVector3(0, 0, 0);
    };
    return vector_of((velocity(hull) - velocity(surface)) * time_step);
  }

  /// Bullet's normal is on the second body and points to the first.
  void add(const TrianglePoint& p, const btCollisionObjectWrapper& surface, btManifoldResult& result) const {
    const auto [part, index] = state_->ids[p.triangle];
    if (result.getBody0Internal() == surface.getCollisionObject())
      result.setShapeIdentifiersA(part, index);
    else
      result.setShapeIdentifiersB(part, index);
    if (hull_is_a_)
      result.addContactPoint(vector_of(-p.normal), vector_of(p.point_b), btScalar(p.separation));
    else
      result.addContactPoint(vector_of(p.normal), vector_of(p.point_a), btScalar(p.separation));
  }

  /// As Bullet does: one point of each triangle.
  void hand_over_nearest(std::span<const TrianglePoint> points, const btCollisionObjectWrapper& surface,
                         btManifoldResult& result) const {
    for (const TrianglePoint& p : points) {
      if (p.is_deepest_of_its) add(p, surface, result);
    }
  }

  /// Each group of points goes to the manifold whose points had the most similar normals; at most four of each.
  void hand_over_groups(std::span<const TrianglePoint> points, const btCollisionObjectWrapper& a,
                        const btCollisionObjectWrapper& b, btManifoldResult& result) {
    divide(points);
    const btCollisionObjectWrapper& surface = hull_is_a_ ? b : a;
    std::vector<btPersistentManifold*> free = shared_ ? std::vector{shared_} : state_->own;
    for (const Group& group : state_->groups) {
      btPersistentManifold& manifold = taken_from(free, group.front(), a, b);
      const Spread chosen = spread(group);
      result.setPersistentManifold(&manifold);
      const Manifold now = manifold_of(group, chosen);
      const bool swapped = manifold.getBody0() != a.getCollisionObject();
      if (shared_ || swapped || !is_flat(group) || !hold_the_area(now, result)) {
        if (!shared_) forget_others(manifold, now, swapped);
        for (std::uint32_t i = chosen.count; i-- > 0;) add(group[chosen.index[i]], surface, result);  // the deepest comes last
      }
      if (!shared_) result.refreshContactPoints();
    }
    if (shared_) return;
    for (btPersistentManifold* manifold : free) {
      manifold->clearManifold();
      if (state_->own.size() == 1) break;
      std::erase(state_->own, manifold);
      m_dispatcher->releaseManifold(manifold);
    }
    result.setPersistentManifold(state_->own.front());
  }

  /// Points whose normals are alike, beginning with the deepest. A manifold of the caller's has room for one group.
  void divide(std::span<const TrianglePoint> points) {
    std::vector<Group>& groups = state_->groups;
    groups.clear();
    std::vector<TrianglePoint> deepest_first(points.begin(), points.end());
    std::stable_sort(deepest_first.begin(), deepest_first.end(),
                     [](const auto& p, const auto& q) { return p.separation < q.separation; });
    const std::size_t most = shared_ ? 1 : kMostManifolds;
    for (const TrianglePoint& p : deepest_first) {
      const auto likeness = [&](const Group& group) { return group.front().normal.dot(p.normal); };
      const auto best = std::max_element(groups.begin(), groups.end(),
                                         [&](const Group& g, const Group& h) { return likeness(g) < likeness(h); });
      if (best == groups.end() || (likeness(*best) < kAlike && groups.size() < most))
        groups.push_back({p});
      else
        best->push_back(p);
    }
  }

  /// Of the manifolds that are free the one whose points had the most similar normals, or an empty one, or a new one.
  btPersistentManifold& taken_from(std::vector<btPersistentManifold*>& free, const TrianglePoint& p,
                                   const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
    const btVector3 normal = vector_of(hull_is_a_ ? Vec3(-p.normal) : p.normal);
    const auto likeness = [&](const btPersistentManifold* m) {
      return m->getNumContacts() ? m->getContactPoint(0).m_normalWorldOnB.dot(normal) : kLikeAnEmptyOne;
    };
    const auto found =
        std::max_element(free.begin(), free.end(), [&](const auto* m, const auto* n) { return likeness(m) < likeness(n); });
    if (found == free.end() || (!shared_ && likeness(*found) < kLikeAnEmptyOne)) {
      state_->own.push_back(m_dispatcher->getNewManifold(a.getCollisionObject(), b.getCollisionObject()));
      return *state_->own.back();
    }
    btPersistentManifold& manifold = **found;
    free.erase(found);
    return manifold;
  }

  /// Whether the points of a group have one normal: those of an area.
  static bool is_flat(const Group& group) {
    return std::all_of(group.begin(), group.end(), [&](const TrianglePoint& p) {
      return (p.normal - group.front().normal).squaredNorm() < kOneNormal * kOneNormal;
    });
  }

  /// The chosen points of a group as two bodies' manifold.
  Manifold manifold_of(const Group& group, const Spread& chosen) const {
    Manifold now;
    now.normal = hull_is_a_ ? group.front().normal : Vec3(-group.front().normal);
    for (std::uint32_t i = 0; i < chosen.count; ++i) {
      const TrianglePoint& p = group[chosen.index[i]];
      ManifoldPoint& point = now.points[now.count++];
      point.point_a = hull_is_a_ ? p.point_a : p.point_b;
      point.point_b = hull_is_a_ ? p.point_b : p.point_a;
      point.separation = p.separation;
    }
    return now;
  }

  const Create& create_;
  btPersistentManifold* shared_;
  bool hull_is_a_;
  std::unique_ptr<State> state_;
};

// Bullet's pool hands out blocks of at least this size, whatever size is asked for.
static_assert(sizeof(TrianglesAlgorithm) <= sizeof(btConvexConcaveCollisionAlgorithm));

}  // namespace

btCollisionAlgorithm* create_triangles_algorithm(const Create& create, const btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(TrianglesAlgorithm));
  return new (place) TrianglesAlgorithm(create, info, a, b);
}

}  // namespace swiftlet::bullet
