// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The bodies that queries take: a model or a primitive, rounded by a radius. Knows models, not poses of pairs or queries.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// What a body is made of.
enum class BodyKind : std::uint8_t {
  Model,     ///< a convex hull at several levels of detail
  Point,     ///< with a radius, a sphere
  Segment,   ///< with a radius, a capsule
  Triangle,  ///< flat, with two sides
  Box,       ///< its edges are parallel to the axes of the body's frame
};

/// The set of all points within `radius()` of a model's hull or of a primitive. A `Body` is a view: trivially copyable, without
/// a heap block. Every query takes bodies, and a `Model` converts to one.
///
/// Coordinates are in the body's own frame and follow the rules of `LevelArrays::vertices`; no coordinate of a box's smallest
/// corner exceeds that of its largest; a radius is from 0 to 1e45. A query about any other body answers InvalidBody or
/// InvalidRadius. Primitives may be degenerate: a box without height, a triangle on one line, a segment without length.
class Body {
 public:
  /// An empty body: a query about it answers InvalidBody.
  Body() : radius_(0), kind_(BodyKind::Point) { corners_.fill(std::numeric_limits<double>::quiet_NaN()); }
  /// Borrows `model`, which must outlive every query about the body and not move. The conversion is implicit.
  Body(const Model& model, double radius = 0) : model_(&model), radius_(radius) {}
  Body(const Model&&, double radius = 0) = delete;  ///< a temporary model would not outlive the expression

  static Body point(const Vec3& p, double radius = 0);                                   ///< a sphere around p
  static Body segment(const Vec3& p, const Vec3& q, double radius = 0);                  ///< a capsule from p to q
  static Body triangle(const Vec3& p, const Vec3& q, const Vec3& r, double radius = 0);  ///< vertices in any order
  static Body box(const Vec3& smallest, const Vec3& largest, double radius = 0);         ///< two opposite corners

  BodyKind kind() const { return kind_; }        ///< what the body is made of
  double radius() const { return radius_; }      ///< in the body's unit
  const Model* model() const { return model_; }  ///< null for a primitive
  /// Point `i` of a primitive: p, q, r in this order, or a box's smallest (0) and largest (1) corner. NaN for any other `i`.
  Vec3 corner(int i) const;
  /// True if both are made of the same numbers, or borrow the same model.
  bool operator==(const Body&) const = default;

 private:
  Body(BodyKind kind, double radius) : radius_(radius), kind_(kind) {}
  Body& with(int i, const Vec3& p);

  const Model* model_ = nullptr;
  std::array<double, 9> corners_{};
  double radius_;
  BodyKind kind_ = BodyKind::Model;
};

/// Law 2's bound for this pair (LAWS.md), in the bodies' unit: the interval of an exact answer is no wider, and exact answers
/// of two queries about the same bodies differ by no more. It is (64 * 2^-53 + 2 e) * size, at least 2^-450. `size` is the
/// larger of both bodies' (largest absolute coordinate + radius), plus |translation|; `e` is the largest entry of |R^T R - I|.
/// With radii each bound may be off by one more unit in its last place. NaN where a query refuses the bodies or the pose.
double tolerance(const Body& a, const Body& b, const Pose& b_in_a);

}  // namespace swiftlet
