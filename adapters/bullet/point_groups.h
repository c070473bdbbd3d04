// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Many points of contact of one pair in Bullet's manifolds, of which each holds points whose normals are alike. Knows neither
// shapes nor where the points come from.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <swiftlet/manifold.h>
#include <swiftlet/triangles.h>

namespace swiftlet::bullet {

/// The cosine of 26 degrees: directions whose cosine is above it are alike. The normals of one manifold's points are like that
/// of its deepest one, as long as there are manifolds for all others.
inline constexpr double kAlike = 0.9;

/// What Bullet calls a triangle of a shape; -1 of a shape that has none.
struct TriangleId {
  int part = -1, index = -1;
  bool operator==(const TriangleId&) const = default;
};
/// The triangles that a point is of, on either body.
struct PointIds {
  TriangleId first, second;
};

/// The manifolds of a pair. Points are the first body's `point_a` and the second one's `point_b`; which of them is Bullet's
/// first is said once.
class PointGroups {
 public:
  /// On `shared`, a manifold of the caller's, or if it is null on manifolds of its own, of which it has at least one.
  PointGroups(btDispatcher& dispatcher, btPersistentManifold* shared, const btCollisionObjectWrapper& a,
              const btCollisionObjectWrapper& b, bool first_is_a);
  ~PointGroups();
  PointGroups(const PointGroups&) = delete;
  PointGroups& operator=(const PointGroups&) = delete;

  btPersistentManifold& first() const { return shared_ ? *shared_ : *own_.front(); }
  std::span<btPersistentManifold* const> own() const { return own_; }
  void clear();  ///< takes the points out of manifolds of its own

  /// Keeps the points as they were handed over, as places on both bodies with normals of the larger one, while no place of
  /// either has moved against the other by more than `kAtRest` of the breaking threshold since then: no contact has got deeper
  /// by more. For shapes that stay what they were, which `Watch` tells. Returns false where a step's points are wanted instead.
  bool hold(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b, btManifoldResult& result);

  /// Adds a point to the manifold that `result` has.
  void add(const TrianglePoint& p, std::span<const PointIds> ids, const btCollisionObjectWrapper& a,
           btManifoldResult& result) const;
  /// Hands over the points of a step, whose `triangle` is the place in `ids`: each group of them goes to the manifold whose
  /// points had the most similar normals; at most four of each.
  void hand_over(std::span<const TrianglePoint> points, std::span<const PointIds> ids, const btCollisionObjectWrapper& a,
                 const btCollisionObjectWrapper& b, btManifoldResult& result);

 private:
  /// Points whose normals are alike; the first one is the deepest.
  using Group = std::vector<TrianglePoint>;
  /// Where the bodies were when points were handed over.
  struct Rest {
    btTransform smaller_in_larger;
    btMatrix3x3 larger_in_world;  ///< of the step before
  };

  void divide(std::span<const TrianglePoint> points);
  btPersistentManifold& take(const TrianglePoint& p, const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
  Manifold manifold_of(const Group& group, const Spread& chosen) const;

  btDispatcher& dispatcher_;
  btPersistentManifold* const shared_;
  const bool first_is_a_;
  std::vector<btPersistentManifold*> own_;   ///< at least one, unless the caller has one for all
  std::vector<btPersistentManifold*> free_;  ///< those that no group of this step has taken yet
  std::vector<Group> groups_;
  std::size_t group_count_ = 0;       ///< of this step: the others keep their memory
  std::vector<std::uint32_t> order_;  ///< of the points, the deepest first
  std::optional<Rest> rest_;
};

}  // namespace swiftlet::bullet
