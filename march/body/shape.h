// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A body as queries read it: its levels, without the radius around it. A model keeps its own levels; a primitive is one level
// on the stack.
#pragma once

#include <array>
#include <cassert>
#include <optional>
#include <span>

#include <swiftlet/body.h>

#include "numeric/vec.h"

namespace swiftlet {

/// The one level of a primitive: a point, a segment, a polygon of two sides, or a box.
struct Primitive {
  explicit Primitive(const Body& body);
  Primitive(const Primitive&) = delete;  ///< `level` points into this object
  Primitive& operator=(const Primitive&) = delete;

  bool is_legal;
  std::array<Vertex, 8> vertices;
  Level level;
  double radius;  ///< the largest distance of a vertex from the centre, rounded up, as Model::radius
};

class Shape {
 public:
  explicit Shape(const Model& model)
      : levels_(&model.level(0)),
        model_(&model),
        level_count_(model.level_count()),
        finest_level_(model.finest_level()),
        map_level_(model.map_level()) {}
  explicit Shape(const Primitive& primitive) : levels_(&primitive.level), primitive_(&primitive) {}

  int level_count() const { return level_count_; }
  int finest_level() const { return finest_level_; }
  int map_level() const { return map_level_; }
  const Level& level(int index) const {
    assert(index >= 0 && index < level_count_);
    return levels_[index];
  }
  double radius() const { return model_ ? model_->radius() : primitive_->radius; }
  Vec size() const;                              ///< the sides of the bounding box
  const Model* model() const { return model_; }  ///< null for a primitive

 private:
  const Level* levels_;
  const Model* model_ = nullptr;
  const Primitive* primitive_ = nullptr;
  int level_count_ = 1, finest_level_ = 0, map_level_ = 1;
};

/// The shape of a body, together with the storage that a primitive's shape needs while a query runs.
class ShapeOf {
 public:
  explicit ShapeOf(const Body& body) : shape_(body.model() ? Shape(*body.model()) : Shape(primitive_.emplace(body))) {}
  bool is_legal() const { return !primitive_ || primitive_->is_legal; }
  operator const Shape&() const { return shape_; }
  const Shape& operator*() const { return shape_; }

 private:
  std::optional<Primitive> primitive_;
  const Shape shape_;
};

/// The same body with radius 0.
Body without_radius(const Body& body);

/// The bounding box of vertices, along the axes of their frame.
struct Box {
  Vec least, most;
};
Box box_of(std::span<const Vertex> vertices);

/// The user's number of a vertex of level 0: of a model the mesh vertex, of a primitive the point in the order given, of a box
/// the corner, numbered by bits, x 1, y 2, z 4.
std::uint32_t source_vertex(const Body& body, const Shape& shape, std::uint32_t vertex);

}  // namespace swiftlet
