// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What Bullet's shapes are to the kernel. The table of adapters/README.md in code; knows no algorithm.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <swiftlet/bullet.h>
#include <swiftlet/world.h>

namespace swiftlet::bullet {

btVector3 vector_of(const Vec3& v);
Vec3 vector_of(const btVector3& v);
Pose pose_of(const btTransform& t);

/// What a shape is in a pair with a HullShape or a MeshShape.
enum class Role : std::uint8_t {
  Bullets,   ///< nothing that the kernel answers: the pair is Bullet's
  Hull,      ///< a HullShape
  Body,      ///< a primitive
  Points,    ///< the hull of points, of which a model can be built
  Plane,     ///< a half-space
  Mesh,      ///< a MeshShape
  Triangles  ///< hands out triangles
};

/// By the shape's type; a HullShape that is scaled is a hull of points, a MeshShape that is hands out triangles.
Role role_of(const btCollisionShape& shape);
Role role_of(int proxy_type);                                   ///< of a shape of this type that is none of swiftlet's
const MeshShape* unscaled_mesh(const btCollisionShape& shape);  ///< null of any other shape

HalfSpace half_space_of(const btCollisionObjectWrapper& body);  ///< of a Plane

/// Models of Bullet's own hulls, one for each set of points. Any thread may ask.
class HullModels {
 public:
  /// The model of a shape that is a hull of points, in its present scaling; null where its points do not span a solid, or
  /// rounding keeps them from being convex.
  std::shared_ptr<const Model> of(const btCollisionShape& shape);

 private:
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const Model>> models_;  ///< by a hash of the points; null: there is none
};

/// A convex shape or plane, as the kernel sees it. Borrows the shape.
class Solid {
 public:
  /// None where the kernel sees nothing in the shape.
  static std::optional<Solid> of(const btCollisionShape& shape, HullModels& models);

  Role role() const { return role_; }
  /// Whether the shape still is what the model was built of: nobody scaled it or added points.
  bool is_current(const btCollisionShape& shape) const;
  Placed placed(const btCollisionObjectWrapper& body) const;  ///< of a Hull, Body or Points
  Vec3 centre(const btCollisionShape& shape) const;           ///< likewise: in the middle of it, in its frame

 private:
  explicit Solid(Role role) : role_(role) {}

  Role role_;
  const btCollisionShape* shape_ = nullptr;  ///< of Points, as are all that follow
  std::shared_ptr<const Model> model_;
  int point_count_ = 0;
  btVector3 scaling_{1, 1, 1};
};

/// Watches the two shapes of a pair: Bullet lets anyone scale a shape between steps, give it another margin, or a body another
/// shape. What was found of it is void then, such as points of contact, which are places on both.
class Watch {
 public:
  /// Whether a shape is not what it was when this was called last.
  bool changed(const btCollisionShape& a, const btCollisionShape& b);

 private:
  struct Seen {
    const btCollisionShape* shape = nullptr;
    btVector3 scaling{0, 0, 0};
    Body body;  ///< of a primitive; of all else a point with the shape's margin
    bool operator==(const Seen&) const = default;
  };
  static Seen seen(const btCollisionShape& shape);

  Seen a_, b_;
};

}  // namespace swiftlet::bullet
