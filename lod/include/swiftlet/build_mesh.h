// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose upper nodes have convex hulls, which answer bodies that are apart by one march. A program that links the builder
// comes under CGAL's GPL; the meshes it writes are the user's.
#pragma once

#include <cstdint>

#include <swiftlet/build.h>
#include <swiftlet/mesh.h>

namespace swiftlet {

/// Which nodes of a mesh get hulls. Where the boxes of two nodes with hulls are apart, a query asks how far the hulls are,
/// which is worth most where surfaces are nearly convex or far apart.
struct HullOptions {
  std::uint32_t levels = 4;            ///< levels of nodes, from the root on, that may have hulls: 1 to 16
  std::uint32_t least_triangles = 64;  ///< below the root no node of fewer triangles has a hull
  /// The most bytes of the mesh's block per triangle: the largest nodes get hulls first, as long as these fit. The hull of
  /// a body that is nearly convex takes some 70 bytes a triangle.
  double bytes_per_triangle = 120;
  /// Where the surface's convex patches (decompose.h) hold so many triangles in the mean, each patch of `least_triangles` has a
  /// node of its own, which is asked by its hull also where boxes meet. They and the root alone have hulls then, patches first;
  /// if not all fit, the mesh is made as without. 0: patches are not looked for. Of curved bodies that reach into each other,
  /// of patches of 48 triangles or more, it makes exact distances near contact two to four times as fast, from some 150 to 200
  /// bytes a triangle, and intersections slower; where roots' hulls are apart, as of most links of robots, it brings nothing.
  std::uint32_t least_patch = 0;
  Progress progress;    ///< empty: no calls
  Executor executor{};  ///< runs what can be cut into tasks; empty: the calling thread does. The same bytes on any
};

/// Makes a mesh as MeshModel::from_triangles does, with hulls. Queries about it give what those about a mesh without hulls
/// give, within law 2's bound, and sooner where bodies are apart. Errors: as MeshModel::from_triangles, and BadValue for an
/// option out of its range.
Result<MeshModel> build_mesh(const Mesh& mesh, const HullOptions& options = {});

/// Returns the mesh with new hulls, for example after `refit`. Its tree stays: patches have the nodes that they had, and
/// `least_patch` is not read. Errors: BadValue for an option out of its range or a mesh that was cut, and Cancelled.
Result<MeshModel> rebuild_hulls(const MeshModel& mesh, const HullOptions& options = {});

}  // namespace swiftlet
