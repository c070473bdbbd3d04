// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What Bullet's shapes are to the kernel. The table of adapters/README.md in code; knows no algorithm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <variant>

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

/// Tells a shape, in its scaling, from every other one, also from one that is made at its address once it is gone. Neither its
/// margin nor the size of a primitive is part of it. The cost does not depend on the shape, so not all is compared: of a hull
/// of points the number of these and the box around them, of Bullet's triangles the box, which has their margin.
class Form {
 public:
  Form() = default;  ///< of no shape
  explicit Form(const btCollisionShape& shape);
  bool is_of(const btCollisionShape& shape) const;

 private:
  struct Signs {
    const btCollisionShape* shape = nullptr;
    const std::byte* block = nullptr;  ///< of a HullShape or MeshShape
    int type = INVALID_SHAPE_PROXYTYPE, point_count = 0;
    btVector3 scaling{0, 0, 0};               ///< none of a primitive, as its size has it
    btVector3 least{0, 0, 0}, most{0, 0, 0};  ///< corners of the box; of a plane its normal, and how far it lies along that
    bool operator==(const Signs&) const = default;
  };
  static Signs signs_of(const btCollisionShape& shape);

  Signs signs_;
  std::variant<std::monostate, Model, MeshModel> kept_;  ///< keeps the block, so that no other one gets its address
};

/// A convex shape or plane, as the kernel sees it.
class Solid {
 public:
  /// None where the kernel sees nothing in the shape.
  static std::optional<Solid> of(const btCollisionShape& shape, HullModels& models);

  Role role() const { return role_; }
  /// Whether the shape still is what the model was built of.
  bool is_current(const btCollisionShape& shape) const;
  Body body(const btCollisionShape& shape) const;             ///< of a Hull, Body or Points; borrows the model
  Placed placed(const btCollisionObjectWrapper& body) const;  ///< likewise
  Vec3 centre(const btCollisionShape& shape) const;           ///< likewise: in the middle of it, in its frame

 private:
  explicit Solid(Role role) : role_(role) {}

  Role role_;
  Form form_;  ///< of Points, as is the model
  std::shared_ptr<const Model> model_;
};

/// Whether queries take the body: its numbers are coordinates, and its radius is one.
bool is_legal(const Body& body);

/// Watches a shape of a pair: Bullet lets anyone scale a shape between steps, give it another margin, or its body another
/// shape. Points of contact, which are places on both shapes, are void then.
class Watch {
 public:
  enum class Change : std::uint8_t {
    None,
    Size,  ///< another margin, or another size of a primitive
    Form   ///< another shape or scaling: its features are not those that it had
  };
  /// Since this was called last.
  Change look(const btCollisionShape& shape);

 private:
  Form form_;
  Body size_;  ///< of a primitive; of all else a point with the shape's margin
};

}  // namespace swiftlet::bullet
