// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What takes part in a query: a model or a primitive, and all that lies within a radius of it.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// What a body is made of.
enum class BodyKind : std::uint8_t {
  Model,     ///< a hull at several levels
  Point,     ///< with a radius, a sphere
  Segment,   ///< with a radius, a capsule
  Triangle,  ///< both sides of it
  Box,       ///< its sides along the axes of the body's frame
};

/// All points within `radius()` of a model's hull or of a primitive: a view, trivially copyable, without any heap block. Every
/// query takes bodies, and a model is one.
///
/// Coordinates are in the body's own frame and follow the rules of LevelArrays::vertices, a box's smallest corner is nowhere
/// above its largest, and a radius is from 0 to 1e45; the status of a query about any other body is InvalidBody or
/// InvalidRadius. Primitives may be flat: a box without height, a triangle on one line, a segment without length.
class Body {
 public:
  /// None yet: a query about it answers InvalidBody.
  Body();
  /// Borrows the model, which stays where it is as long as the body is asked about. Implicit: models are bodies.
  Body(const Model& model, double radius = 0) : model_(&model), radius_(radius) {}
  Body(const Model&&, double radius = 0) = delete;  ///< a model that ends with the expression

  static Body point(const Vec3& p, double radius = 0);                                   ///< a sphere around p
  static Body segment(const Vec3& p, const Vec3& q, double radius = 0);                  ///< a capsule from p to q
  static Body triangle(const Vec3& p, const Vec3& q, const Vec3& r, double radius = 0);  ///< vertices in any order
  static Body box(const Vec3& smallest, const Vec3& largest, double radius = 0);         ///< two corners across

  BodyKind kind() const { return kind_; }        ///< what it is made of
  double radius() const { return radius_; }      ///< the body's unit
  const Model* model() const { return model_; }  ///< null: a primitive
  /// A primitive's point `i`: p, q, r, or a box's corners, smallest first. NaN where it has none.
  Vec3 corner(int i) const;

 private:
  Body(BodyKind kind, double radius) : radius_(radius), kind_(kind) {}
  Body& with(int i, const Vec3& p);

  const Model* model_ = nullptr;
  std::array<double, 9> corners_{};
  double radius_;
  BodyKind kind_ = BodyKind::Model;
};

/// Law 2's bound for this pair (LAWS.md): an exact answer's interval is no wider, and what two queries say of the same bodies
/// differs by no more. It is (64 * 2^-53 + 2 e) * size; size is the largest coordinate of A or B, and its radius, plus
/// |translation|, and e the largest entry of |R^T R - I|. Radii may cost each bound its last place more. NaN where a query
/// refuses the bodies or the pose.
double tolerance(const Body& a, const Body& b, const Pose& b_in_a);

}  // namespace swiftlet
