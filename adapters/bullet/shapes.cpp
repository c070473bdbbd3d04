// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

namespace swiftlet::bullet {
namespace {

/// Of so many kept models those go that no pair uses.
constexpr std::size_t kMostModels = 1024;

const HullShape* hull_shape(const btCollisionShape& shape) {
  return shape.getShapeType() == CONVEX_HULL_SHAPE_PROXYTYPE ? dynamic_cast<const HullShape*>(&shape) : nullptr;
}
const MeshShape* mesh_shape(const btCollisionShape& shape) {
  return shape.getShapeType() == kMeshType ? dynamic_cast<const MeshShape*>(&shape) : nullptr;
}

std::vector<btVector3> vertices_of(const btCollisionShape& shape) {
  std::vector<btVector3> vertices;
  if (shape.getShapeType() == CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE) {
    struct Corners final : btInternalTriangleIndexCallback {
      std::vector<btVector3>& all;
      explicit Corners(std::vector<btVector3>& vertices_) : all(vertices_) {}
      void internalProcessTriangleIndex(btVector3* corners, int, int) override { all.insert(all.end(), corners, corners + 3); }
    } corners(vertices);
    const auto& mesh = *static_cast<const btConvexTriangleMeshShape&>(shape).getMeshInterface();
    const btScalar far(BT_LARGE_FLOAT);
    mesh.InternalProcessAllTriangles(&corners, btVector3(-far, -far, -far), btVector3(far, far, far));
    return vertices;
  }
  const auto& polyhedron = static_cast<const btPolyhedralConvexShape&>(shape);
  vertices.resize(std::size_t(polyhedron.getNumVertices()));
  for (int i = 0; i < polyhedron.getNumVertices(); ++i) polyhedron.getVertex(i, vertices[std::size_t(i)]);
  return vertices;
}

/// FNV-1a over coordinates as words; after each product its high bits are folded into the low ones.
std::uint64_t hash_of(const std::vector<btVector3>& vertices) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const btVector3& v : vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = v[axis];
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3u;
      hash ^= hash >> 29;
    }
  }
  return hash;
}

Body capsule(const btCapsuleShape& shape) {
  Vec3 top = Vec3::Zero();
  top[shape.getUpAxis()] = shape.getHalfHeight();
  return Body::segment(-top, top, shape.getRadius());
}

/// A btBoxShape's margin is inside of it.
Body box(const btBoxShape& shape) {
  const Vec3 half = vector_of(shape.getHalfExtentsWithMargin());
  return Body::box(-half, half);
}

Body triangle(const btTriangleShape& shape) {
  return Body::triangle(vector_of(shape.m_vertices1[0]), vector_of(shape.m_vertices1[1]), vector_of(shape.m_vertices1[2]),
                        shape.getMargin());
}

Body primitive(const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: return Body::point(Vec3::Zero(), static_cast<const btSphereShape&>(shape).getRadius());
    case CAPSULE_SHAPE_PROXYTYPE: return capsule(static_cast<const btCapsuleShape&>(shape));
    case BOX_SHAPE_PROXYTYPE: return box(static_cast<const btBoxShape&>(shape));
    default: return triangle(static_cast<const btTriangleShape&>(shape));
  }
}

}  // namespace

btVector3 vector_of(const Vec3& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }
Vec3 vector_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

Pose pose_of(const btTransform& t) {
  const btMatrix3x3& r = t.getBasis();
  Pose pose;
  for (int row = 0; row < 3; ++row) pose.rotation.row(row) << r[row].x(), r[row].y(), r[row].z();
  pose.translation = vector_of(t.getOrigin());
  return pose;
}

Role role_of(int proxy_type) {
  switch (proxy_type) {
    case SPHERE_SHAPE_PROXYTYPE:
    case CAPSULE_SHAPE_PROXYTYPE:
    case BOX_SHAPE_PROXYTYPE:
    case TRIANGLE_SHAPE_PROXYTYPE: return Role::Body;
    case CONVEX_HULL_SHAPE_PROXYTYPE:
    case CONVEX_POINT_CLOUD_SHAPE_PROXYTYPE:
    case CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE:
    case TETRAHEDRAL_SHAPE_PROXYTYPE: return Role::Points;
    case STATIC_PLANE_PROXYTYPE: return Role::Plane;
    case TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE:
    case TERRAIN_SHAPE_PROXYTYPE: return Role::Triangles;
    default: return Role::Bullets;
  }
}

const MeshShape* unscaled_mesh(const btCollisionShape& shape) {
  const MeshShape* const mesh = mesh_shape(shape);
  return mesh && !mesh->is_scaled() ? mesh : nullptr;
}

Role role_of(const btCollisionShape& shape) {
  if (const MeshShape* const mesh = mesh_shape(shape)) return mesh->is_scaled() ? Role::Triangles : Role::Mesh;
  const HullShape* const hull = hull_shape(shape);
  return hull && !hull->is_scaled() ? Role::Hull : role_of(shape.getShapeType());
}

std::shared_ptr<const Model> HullModels::of(const btCollisionShape& shape) {
  const std::vector<btVector3> vertices = vertices_of(shape);
  const std::uint64_t hash = hash_of(vertices);
  const std::lock_guard lock(mutex_);
  if (const auto known = models_.find(hash); known != models_.end()) return known->second;
  if (models_.size() >= kMostModels) std::erase_if(models_, [](const auto& entry) { return entry.second.use_count() <= 1; });
  Result<Model> built = model_of(vertices.data(), int(vertices.size()));
  return models_[hash] = built ? std::make_shared<const Model>(std::move(built).value()) : nullptr;
}

Form::Signs Form::signs_of(const btCollisionShape& shape) {
  Signs signs{.shape = &shape, .type = shape.getShapeType()};
  const Role role = role_of(signs.type);
  if (role == Role::Body) return signs;
  signs.scaling = shape.getLocalScaling();
  if (const MeshShape* const mesh = mesh_shape(shape)) {
    signs.block = mesh->mesh().bytes().data();
  } else if (role == Role::Points) {
    const auto& points = static_cast<const btPolyhedralConvexAabbCachingShape&>(shape);
    signs.point_count = points.getNumVertices();
    points.getNonvirtualAabb(btTransform::getIdentity(), signs.least, signs.most, 0);
    if (const HullShape* const hull = hull_shape(shape)) signs.block = hull->model().bytes().data();
  } else if (role == Role::Plane) {
    const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
    signs.least = plane.getPlaneNormal(), signs.most.setX(plane.getPlaneConstant());
  } else if (role == Role::Triangles) {
    shape.getAabb(btTransform::getIdentity(), signs.least, signs.most);
  }
  return signs;
}

Form::Form(const btCollisionShape& shape) : signs_(signs_of(shape)) {
  if (const HullShape* const hull = hull_shape(shape)) kept_ = hull->model();
  if (const MeshShape* const mesh = mesh_shape(shape)) kept_ = mesh->mesh();
}

bool Form::is_of(const btCollisionShape& shape) const { return signs_ == signs_of(shape); }

std::optional<Solid> Solid::of(const btCollisionShape& shape, HullModels& models) {
  Solid solid(role_of(shape));
  if (solid.role_ == Role::Bullets || solid.role_ == Role::Mesh || solid.role_ == Role::Triangles) return std::nullopt;
  if (solid.role_ != Role::Points) return solid;
  solid.model_ = models.of(shape);
  if (!solid.model_) return std::nullopt;
  solid.form_ = Form(shape);
  return solid;
}

bool Solid::is_current(const btCollisionShape& shape) const {
  return role_ == role_of(shape) && (role_ != Role::Points || form_.is_of(shape));
}

Body Solid::body(const btCollisionShape& shape) const {
  if (role_ == Role::Hull) return Body(static_cast<const HullShape&>(shape).model(), shape.getMargin());
  if (role_ == Role::Points) return Body(*model_, shape.getMargin());
  return primitive(shape);
}

Placed Solid::placed(const btCollisionObjectWrapper& object) const {
  return {body(*object.getCollisionShape()), pose_of(object.getWorldTransform())};
}

Vec3 Solid::centre(const btCollisionShape& shape) const {
  if (role_ == Role::Hull) return static_cast<const HullShape&>(shape).model().centre();
  if (role_ == Role::Points) return model_->centre();
  const Body body = primitive(shape);
  if (body.kind() != BodyKind::Triangle) return Vec3::Zero();
  return (body.corner(0) + body.corner(1) + body.corner(2)) / 3;
}

bool is_legal(const Body& body) { return !std::isnan(tolerance(body, Body::point(Vec3::Zero()), Pose{})); }

Watch::Change Watch::look(const btCollisionShape& shape) {
  const bool is_primitive = role_of(shape.getShapeType()) == Role::Body, is_same = form_.is_of(shape);
  const Body size = is_primitive ? primitive(shape) : Body::point(Vec3::Zero(), shape.getMargin());
  if (is_same && size == size_) return Change::None;
  size_ = size;
  if (is_same) return Change::Size;
  form_ = Form(shape);
  return Change::Form;
}

/// Single precision leaves the normal's length wrong by an ulp.
HalfSpace half_space_of(const btCollisionObjectWrapper& body) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(*body.getCollisionShape());
  const Pose in_world = pose_of(body.getWorldTransform());
  const Vec3 normal = vector_of(plane.getPlaneNormal());
  const Vec3 up = (in_world.rotation * normal).normalized();
  return {up, up.dot(in_world.translation) + plane.getPlaneConstant() / normal.norm()};
}

}  // namespace swiftlet::bullet
