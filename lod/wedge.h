// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether a triangle enters what a convex hull gains by a new vertex, decided exactly. Knows nothing of patches or meshes.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "numeric/vec.h"

namespace swiftlet::lod {

using Corners3 = std::array<Vec, 3>;

/// A tetrahedron that a hull gains: it stands on a face of the hull that the new vertex sees.
///
/// A face of a tetrahedron is a mask of its corners: bits 0 to 2 those of the base, bit 3 the new vertex.
struct Wedge {
  std::array<Vec, 4> corner;  ///< three counter-clockwise seen from the new vertex, which is the last
  /// Per side of the base: the tetrahedron's face over it, from corner k and k + 1 to the new vertex, is one of the new hull's.
  std::array<bool, 3> outer;
  bool base_outer = false;  ///< the base lies on the new hull's boundary

  /// True if that face lies on the new hull's boundary. Corners always do, and so do the edges at the new vertex.
  bool is_outer(unsigned face) const;
};

/// A triangle that a flat hull gains, from an edge that the new vertex sees; the three run counter-clockwise.
struct FlatWedge {
  std::array<Vec, 3> corner;    ///< the edge's ends and the new vertex
  std::array<bool, 2> outer{};  ///< per end of the edge: the side from there to the new vertex is one of the new hull's
  int u, v;                     ///< coordinates that the plane projects to, one to one and without turning over
};

/// Planes about a wedge that have it on one side by more than rounding, to leave out in doubles what lies beyond them.
class Outline {
 public:
  /// `size`: the largest coordinate of the wedge and of what is asked about.
  Outline(const Wedge& wedge, double size);
  Outline(const FlatWedge& wedge, double size);
  /// True only if the box does not meet the wedge.
  bool is_apart(const Vec3& least, const Vec3& most) const;
  /// True only if the triangle does not meet the wedge, or in no more than a corner of it on the new hull's boundary.
  bool is_apart(const Corners3& triangle) const;
  /// True only if all triangles that have a corner at `hub` and the others in the box meet the wedge in no more than the hub,
  /// which is a corner of the wedge on the new hull's boundary.
  bool is_apart_around(const Vec& hub, const Vec& least, const Vec& most) const;

 private:
  void add(const Vec& outward, double size);
  bool is_apart_at(std::size_t corner, const Corners3& triangle, std::size_t at) const;

  std::array<Vec, 4> corner_;
  std::array<bool, 4> is_outer_;  ///< per corner: it lies on the new hull's boundary
  std::size_t corners_ = 0;

  std::array<Vec, 4> outward_;
  std::array<double, 4> above_;
  std::size_t count_ = 0;
  Vec3 least_, most_;
};

/// True if the triangle meets the part of the wedge that is inside of the new hull.
bool enters(const Corners3& triangle, const Wedge& wedge);

/// True if a part of the triangle that is in the wedge's plane meets the wedge where that is inside of the new hull, and the
/// triangle reaches to the inner side of the plane. `outline`: the wedge's.
bool enters(const Corners3& triangle, const FlatWedge& wedge, const Outline& outline);
/// True if a segment in the wedge's plane does.
bool enters(const std::array<Vec, 2>& segment, const FlatWedge& wedge);

}  // namespace swiftlet::lod
