// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in Bullet: shapes that hold a model or a mesh, and their pairs in both tables of a dispatcher. In the precision of
// the Bullet it is compiled with: CMake's target is swiftlet::bullet for single, swiftlet::bullet_float64 for double.
#pragma once

#include <memory>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet::bullet {

/// A btConvexHullShape of the vertices of a model's level 0, rounded to btScalar; to all of Bullet but HullPairs it is just
/// that. Its margin lies outside the hull, as that of every btConvexHullShape. Points that are added later are not the model's.
class HullShape : public btConvexHullShape {
 public:
  /// Shares the model's block. Throws std::invalid_argument where the model lacks level 0 (Detail).
  explicit HullShape(const Model& model);
  const Model& model() const { return model_; }  ///< in double precision, as given
  /// A model is rigid: with a local scaling the shape counts as any btConvexHullShape of its scaled points.
  bool is_scaled() const;

 private:
  Model model_;
};

/// The model of the exact convex hull of points, for hulls of which there is no mesh: also of those whose rounding has moved
/// them off their faces. Errors: NotSolid where all lie in one plane; BadValue of a coordinate that no model may have
/// (LevelArrays). Cost: 1 ms for 200 corners, 14 ms for 2 000.
Result<Model> model_of(const btVector3* points, int count);
/// Of a shape's scaled points.
Result<Model> model_of(const btConvexHullShape& shape);

/// The shape type of a MeshShape: that which Bullet keeps for this use. Bullet's own algorithms take it for any concave shape.
inline constexpr int kMeshType = FAST_CONCAVE_MESH_PROXYTYPE;

/// A mesh as a shape of bodies that stand or move, in the place of btBvhTriangleMeshShape and btGImpactMeshShape. To all of
/// Bullet but HullPairs it is a btConcaveShape that hands out the triangles in a box, by the mesh's tree: rays, sweeps, the
/// debug drawer and the pairs of convex shapes that HullPairs leaves to Bullet see those. Triangles keep the user's numbers, in
/// part 0. Its margin, 0.04 as a hull's, is a radius around the triangles.
class MeshShape : public btConcaveShape {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();  ///< Bullet's, as every shape has it

  /// Shares the mesh's block. Throws std::invalid_argument where the mesh was cut: its triangles are gone.
  explicit MeshShape(const MeshModel& mesh);
  const MeshModel& mesh() const { return mesh_; }  ///< in double precision, as given
  /// True if the triangles bound a volume and face outwards: then a body inside is pushed out. Of any other mesh each triangle
  /// has two sides, and pushes a body back to that from which it came.
  bool is_solid() const { return is_solid_; }
  /// A mesh is rigid: with a local scaling other than 1 its pairs are those of a concave shape of Bullet's with scaled
  /// triangles, which meets no plane and no other mesh.
  bool is_scaled() const;
  /// Where a body of this shape and `mass` turns by itself: the centre of mass and the principal axes, in the shape's frame,
  /// and the moments about these. Of a solid of constant density; of any other mesh of its box. Bullet has a body's origin
  /// there: put the shape into a btCompoundShape at the inverse of this, or make the mesh of points that it has moved.
  btTransform principal_axes(btScalar mass, btVector3& inertia) const;

  /// Hands out the scaled triangles whose boxes meet this one, in the shape's frame.
  void processAllTriangles(btTriangleCallback* callback, const btVector3& least, const btVector3& most) const override;
  /// The box of the mesh's box in the world, with the margin.
  void getAabb(const btTransform& in_world, btVector3& least, btVector3& most) const override;
  void setLocalScaling(const btVector3& scaling) override { scaling_ = scaling; }  ///< see `is_scaled`
  const btVector3& getLocalScaling() const override { return scaling_; }           ///< 1 at first
  /// The moments of inertia about axes through the centre of mass that are parallel to the shape's, of the body that
  /// `principal_axes` speaks of, scaled. Those of Bullet's bodies, whose origin is there and whose axes are the principal ones.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  const char* getName() const override { return "SwiftletMesh"; }  ///< for debuggers

 private:
  MeshModel mesh_;
  bool is_solid_;
  btVector3 scaling_{1, 1, 1};
  Vec3 centre_;  ///< of mass
  Mat3 spread_;  ///< mean of the products of coordinates, from the centre: the inertia of mass 1 is its trace less itself
};

/// The mesh of what btBvhTriangleMeshShape and btGImpactMeshShape are made of, in its scaling; triangles are numbered part
/// after part. Errors: as MeshModel::from_triangles.
Result<MeshModel> mesh_of(const btStridingMeshInterface& triangles);

/// Makes the pairs of an unscaled HullShape or MeshShape swiftlet's, in contacts and in closest-point queries, apart or
/// overlapping: with one another, a sphere, capsule, box, triangle, static plane or hull of points, in either order and as
/// children of compounds; of a HullShape also with Bullet's triangle meshes and heightfields. All other pairs stay with what
/// the dispatcher's configuration has for them; adapters/README.md has the table. Create one after the dispatcher and before
/// the world; it outlives the world.
class HullPairs {
 public:
  explicit HullPairs(btCollisionDispatcher& dispatcher);  ///< registers itself in both of the dispatcher's tables
  ~HullPairs();
  HullPairs(const HullPairs&) = delete;
  HullPairs& operator=(const HullPairs&) = delete;

  /// Whether pairs of these two shapes are swiftlet's, as they now are and in poses that are rigid motions; of children of
  /// compounds their own shapes decide. Of a hull of points this builds the model, unless a pair has it.
  bool answers(const btCollisionShape& a, const btCollisionShape& b) const;

 private:
  struct Entries;
  std::unique_ptr<Entries> entries_;
};

}  // namespace swiftlet::bullet
