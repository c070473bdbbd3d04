// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way down a mesh's tree for questions of the caller's own, such as the triangles in a box, near a ray or below a plane.
#pragma once

#include <cstdint>

#include <swiftlet/mesh.h>

namespace swiftlet {

/// A question about the triangles of a mesh, whose boxes it is shown. Boxes are along the axes of the mesh's frame.
class MeshVisitor {
 public:
  /// Decides whether triangles in this box are wanted. Asked of boxes around many triangles, and of each triangle's own box,
  /// whose corners are the triangle's least and largest coordinates.
  virtual bool enters(const Vec3& box_min, const Vec3& box_max) = 0;
  /// Gets a triangle whose own box was entered, by its index in the mesh's order. Returning false ends the visit.
  virtual bool visit(std::uint32_t triangle) = 0;

 protected:
  ~MeshVisitor() = default;
};

/// Visits all triangles whose own boxes `visitor` enters, provided that it enters a box wherever it enters one inside of it.
/// Their order is that of the tree. Of a mesh that was cut there are none. Cost: some 10 ns for each box that is shown.
/// Allocates nothing; uses 1 kB of stack.
void visit_triangles(const MeshModel& mesh, MeshVisitor& visitor);

}  // namespace swiftlet
