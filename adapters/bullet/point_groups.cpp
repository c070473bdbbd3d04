// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "point_groups.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "held_points.h"
#include "shapes.h"

namespace swiftlet::bullet {
namespace {

/// Points whose normals differ by more than 60 degrees leave nothing to others.
constexpr btScalar kLikeAnEmptyOne = btScalar(0.5);
/// As many as a corner of a room has walls, and one more.
constexpr std::size_t kMostManifolds = 4;

/// Whether the points of a group have one normal: those of an area.
bool is_flat(std::span<const TrianglePoint> group) {
  return std::all_of(group.begin(), group.end(), [&](const TrianglePoint& p) {
    return (p.normal - group.front().normal).squaredNorm() < kOneNormal * kOneNormal;
  });
}

/// Two bodies in the order of their sizes.
struct BySize {
  BySize(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
    btVector3 centre_a, centre_b;
    btScalar radius_a, radius_b;
    a.getCollisionShape()->getBoundingSphere(centre_a, radius_a), b.getCollisionShape()->getBoundingSphere(centre_b, radius_b);
    const bool a_is_smaller = radius_a < radius_b;
    const btTransform &of_a = a.getWorldTransform(), &of_b = b.getWorldTransform();
    centre = a_is_smaller ? centre_a : centre_b, radius = a_is_smaller ? radius_a : radius_b;
    smaller_in_larger = a_is_smaller ? of_b.inverseTimes(of_a) : of_a.inverseTimes(of_b);
    larger_in_world = (a_is_smaller ? of_b : of_a).getBasis();
  }
  /// No place of the smaller body has gone farther in the larger one's frame.
  btScalar moved(const btTransform& before) const {
    btVector3 turn;
    for (int i = 0; i < 3; ++i) turn[i] = (smaller_in_larger.getBasis()[i] - before.getBasis()[i]).length();
    return (smaller_in_larger(centre) - before(centre)).length() + turn.length() * radius;
  }

  btVector3 centre;  ///< of a ball around the smaller one, in its frame
  btScalar radius;
  btTransform smaller_in_larger;
  btMatrix3x3 larger_in_world;
};

}  // namespace

PointGroups::PointGroups(btDispatcher& dispatcher, btPersistentManifold* shared, const btCollisionObjectWrapper& a,
                         const btCollisionObjectWrapper& b, bool first_is_a)
    : dispatcher_(dispatcher), shared_(shared), first_is_a_(first_is_a) {
  if (!shared_) own_.push_back(dispatcher_.getNewManifold(a.getCollisionObject(), b.getCollisionObject()));
}

PointGroups::~PointGroups() {
  for (btPersistentManifold* manifold : own_) dispatcher_.releaseManifold(manifold);
}

void PointGroups::clear() {
  for (btPersistentManifold* manifold : own_) manifold->clearManifold();
  rest_.reset();
}

bool PointGroups::hold(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result) {
  if (!rest_) return false;
  const BySize now(a, b);
  if (!(now.moved(rest_->smaller_in_larger) <= kAtRest * first().getContactBreakingThreshold())) return false;
  const btMatrix3x3 turn = now.larger_in_world * rest_->larger_in_world.transpose();
  for (btPersistentManifold* manifold : own_) {
    result.setPersistentManifold(manifold);
    if (!hold_turned(turn, result)) return false;
    result.refreshContactPoints();
  }
  rest_->larger_in_world = now.larger_in_world;
  result.setPersistentManifold(own_.front());
  return true;
}

/// Bullet's normal is on its second body and points to the first. The result of a compound's child may have the bodies the
/// other way round.
void PointGroups::add(const TrianglePoint& p, std::span<const PointIds> ids, const btCollisionObjectWrapper& a,
                      btManifoldResult& result) const {
  const bool a_is_first = result.getBody0Internal() == a.getCollisionObject();
  const PointIds& of = ids[p.triangle];
  const TriangleId &id_a = first_is_a_ == a_is_first ? of.first : of.second,
                   &id_b = first_is_a_ == a_is_first ? of.second : of.first;
  if (id_a.index >= 0) result.setShapeIdentifiersA(id_a.part, id_a.index);
  if (id_b.index >= 0) result.setShapeIdentifiersB(id_b.part, id_b.index);
  if (first_is_a_)
    result.addContactPoint(vector_of(-p.normal), vector_of(p.point_b), btScalar(p.separation));
  else
    result.addContactPoint(vector_of(p.normal), vector_of(p.point_a), btScalar(p.separation));
}

void PointGroups::hand_over(std::span<const TrianglePoint> points, std::span<const PointIds> ids,
                            const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result) {
  divide(points);
  free_.assign(own_.begin(), own_.end());
  if (shared_) free_.push_back(shared_);
  for (std::size_t g = 0; g < group_count_; ++g) {
    const Group& group = groups_[g];
    btPersistentManifold& manifold = take(group.front(), a, b);
    const Spread chosen = spread(group, kAtRest * first().getContactBreakingThreshold());
    result.setPersistentManifold(&manifold);
    const Manifold now = manifold_of(group, chosen);
    const bool swapped = manifold.getBody0() != a.getCollisionObject();
    if (shared_ || swapped || !is_flat(group) || !hold_the_area(now, result)) {
      const bool one_goes = !shared_ && carry_over(manifold, now, swapped);
      for (std::uint32_t i = chosen.count; i-- > 0;) {  // the deepest comes last
        add(group[chosen.index[i]], ids, a, result);
        if (one_goes && i + 1 == chosen.count) manifold.removeContactPoint(0);
      }
    }
    if (!shared_) result.refreshContactPoints();
  }
  if (shared_) return;
  for (btPersistentManifold* manifold : free_) {
    manifold->clearManifold();
    if (own_.size() == 1) break;
    std::erase(own_, manifold);
    dispatcher_.releaseManifold(manifold);
  }
  result.setPersistentManifold(own_.front());
  rest_.reset();
  if (own_.front()->getBody0() != a.getCollisionObject()) return;
  const BySize now(a, b);
  rest_ = {now.smaller_in_larger, now.larger_in_world};
}

/// Points whose normals are alike, beginning with the deepest. A manifold of the caller's has room for one group.
void PointGroups::divide(std::span<const TrianglePoint> points) {
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(points[i].separation, i) < std::pair(points[j].separation, j);
  });
  group_count_ = 0;
  const std::size_t most = shared_ ? 1 : kMostManifolds;
  for (const std::uint32_t i : order_) {
    const TrianglePoint& p = points[i];
    const auto likeness = [&](const Group& group) { return group.front().normal.dot(p.normal); };
    const auto end = groups_.begin() + std::ptrdiff_t(group_count_);
    const auto best =
        std::max_element(groups_.begin(), end, [&](const Group& g, const Group& h) { return likeness(g) < likeness(h); });
    if (best != end && (likeness(*best) >= kAlike || group_count_ == most)) {
      best->push_back(p);
      continue;
    }
    if (group_count_ == groups_.size()) groups_.emplace_back();
    groups_[group_count_++].assign(1, p);
  }
}

/// Of the manifolds that are free the one whose points had the most similar normals, or an empty one, or a new one.
btPersistentManifold& PointGroups::take(const TrianglePoint& p, const btCollisionObjectWrapper& a,
                                        const btCollisionObjectWrapper& b) {
  const btVector3 normal = vector_of(first_is_a_ ? Vec3(-p.normal) : p.normal);
  const auto likeness = [&](const btPersistentManifold* m) {
    return m->getNumContacts() ? m->getContactPoint(0).m_normalWorldOnB.dot(normal) : kLikeAnEmptyOne;
  };
  const auto found =
      std::max_element(free_.begin(), free_.end(), [&](const auto* m, const auto* n) { return likeness(m) < likeness(n); });
  if (found == free_.end() || (!shared_ && likeness(*found) < kLikeAnEmptyOne)) {
    own_.push_back(dispatcher_.getNewManifold(a.getCollisionObject(), b.getCollisionObject()));
    return *own_.back();
  }
  btPersistentManifold& manifold = **found;
  free_.erase(found);
  return manifold;
}

/// The chosen points of a group as two bodies' manifold.
Manifold PointGroups::manifold_of(const Group& group, const Spread& chosen) const {
  Manifold now;
  now.normal = first_is_a_ ? group.front().normal : Vec3(-group.front().normal);
  for (std::uint32_t i = 0; i < chosen.count; ++i) {
    const TrianglePoint& p = group[chosen.index[i]];
    ManifoldPoint& point = now.points[now.count++];
    point.point_a = first_is_a_ ? p.point_a : p.point_b;
    point.point_b = first_is_a_ ? p.point_b : p.point_a;
    point.separation = p.separation;
  }
  return now;
}

}  // namespace swiftlet::bullet
