// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in Bullet: a hull shape that holds a model, and its pairs in both tables of a dispatcher. In the precision of the
// Bullet it is compiled with: single as swiftlet::bullet, double as swiftlet::bullet_float64.
#pragma once

#include <memory>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

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

/// The model of the convex hull of points, for hulls of which there is no mesh. Errors: NotSolid where they lie in one plane;
/// NotConvex or BadValue where doubles cannot tell the hull, as of a turned grid whose points rounding has moved off its faces;
/// single-precision points are told apart. Cost: the points times the faces, 20 ms for 2 000 points. The builder of
/// swiftlet::lod takes any points.
Result<Model> model_of(const btVector3* points, int count);
/// Of a shape's scaled points.
Result<Model> model_of(const btConvexHullShape& shape);

/// Makes the pairs of an unscaled HullShape swiftlet's, in contacts and in closest-point queries, apart or overlapping: with
/// another one, a sphere, capsule, box, triangle, static plane, hull of points, triangle mesh or heightfield, in either order
/// and as children of compounds. All other pairs stay with what the dispatcher's configuration has for them; adapters/README.md
/// has the table. Create one after the dispatcher and before the world; it outlives the world.
class HullPairs {
 public:
  explicit HullPairs(btCollisionDispatcher& dispatcher);  ///< registers itself in both of the dispatcher's tables
  ~HullPairs();
  HullPairs(const HullPairs&) = delete;
  HullPairs& operator=(const HullPairs&) = delete;

  /// Whether pairs of these two shapes are swiftlet's; of children of compounds their own shapes decide. Of a hull of points
  /// this builds the model, unless a pair has it.
  bool answers(const btCollisionShape& a, const btCollisionShape& b) const;

 private:
  struct Entries;
  std::unique_ptr<Entries> entries_;
};

}  // namespace swiftlet::bullet
