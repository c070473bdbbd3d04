// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether a closed mesh encloses a point of another body, by exact signs under the stored pose. Knows no other body than this
// point.
#pragma once

#include "mesh_block.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The volume that a closed mesh encloses: all points from which a ray crosses the surface an odd number of times. So a shell
/// within another one is a cavity, and a mesh that is inside out encloses the same.
class Enclosure {
 public:
  /// The mesh is body A of the pose or, if `is_b`, body B; points are those of the other body, in its frame.
  Enclosure(const MeshReader::Content& mesh, const Pose& b_in_a, bool is_b);

  /// True of a point inside, false of one outside, and either of a point on the surface: so what it calls inside lies in the
  /// closed volume. Exact. Coordinates are legal ones of bodies. Cost: the triangles whose boxes a ray meets.
  bool holds(const Vec& point) const;
  /// The same by a ray through all triangles, without the tree.
  bool holds_without_tree(const Vec& point) const;

 private:
  struct Ray;
  bool starts_inside_box(const Vec& point, Ray& ray) const;
  int passes(const Ray& ray, const Vec& v, const Vec& w) const;
  bool crosses(const Ray& ray, const Corners& triangle) const;

  const MeshReader::Content& mesh_;
  const Motion motion_, back_;  ///< the pose, and the inverse of its rotation
  const bool is_b_;
  const int turn_;  ///< the sign of the rotation's determinant
};

}  // namespace swiftlet
