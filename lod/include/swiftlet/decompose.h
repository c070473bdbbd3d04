// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Convex surface decomposition [Ehmann & Lin 2001, sec. 4]: a mesh's triangles as patches, each on the boundary of its convex
// hull. A program that links it comes under CGAL's GPL.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/mesh.h>

namespace swiftlet {

/// The order in which a patch takes in the triangles around it, and where patches begin.
enum class Growth : std::uint8_t {
  DepthFirst,    ///< across the edges of the triangle that joined last; begins at the first triangle left
  BreadthFirst,  ///< in the order in which they came within reach; begins at the first triangle left
  Cresting,      ///< breadth first; begins at the triangle left that is farthest from reflex edges, counted in triangles
};

/// Options of `decompose`.
struct DecomposeOptions {
  Growth growth = Growth::Cresting;  ///< how patches grow
  Progress progress;                 ///< empty: no calls
};

/// Triangles of a mesh that lie on the boundary of their convex hull.
struct Patch {
  std::uint32_t first, end;  ///< its triangles: Decomposition::triangles[first] to [end - 1], in the order in which they joined
  std::uint32_t virtual_faces;  ///< triangles that close its hull, cut into triangles over all vertices of the patch
  bool flat;                    ///< all its points lie in one plane: its hull has no volume
};

/// The result of `decompose`.
struct Decomposition {
  std::vector<std::uint32_t> triangles;  ///< each of the mesh's once, by its index there, patch after patch
  std::vector<Patch> patches;            ///< in the order in which they were begun

  // Edges across which no patch grows. Triangles with the same corners count as one, so that a surface given with both of its
  // sides has no more defects than one of them.
  std::uint32_t reflex_edges = 0;        ///< the surface is concave or folded back onto itself; once for each side given
  std::uint32_t open_edges = 0;          ///< of one triangle
  std::uint32_t non_manifold_edges = 0;  ///< of more than two triangles, or of two of which one is given more often
  std::uint32_t flipped_edges = 0;       ///< of two triangles that run along it in the same direction
  std::uint32_t slit_edges = 0;          ///< of two triangles, the corners of one of which lie on one line

  // Triangles that a patch reached across an edge that is none of these and did not take in, counted once for each patch.
  std::uint32_t not_convex = 0;  ///< the triangle or one of the patch would not lie on the boundary of the hull
  std::uint32_t entered = 0;     ///< the surface would enter the hull
};

/// Decomposes the surface into patches. Each triangle is in one patch, and these hold, decided exactly:
/// - every triangle of a patch lies on the boundary of the hull of the patch, which is on the inner side of it;
/// - no point of the surface is inside of a hull that has a volume, so that those of a closed mesh that is not inside out lie
///   in the solid;
/// - of a flat hull, beyond the first triangle of the patch, no triangle that reaches to the inner side of its plane meets it,
///   and no triangle in its plane ends within it: that of a closed mesh that does not cross itself lies in the solid too, and
///   that of a flat open surface is covered by its patch.
///
/// A patch grows from one triangle to another across their common edge, unless the edge is reflex, has more than two triangles,
/// or its triangles run along it in the same direction. Triangles with the same corners count as one there, and each time that
/// a surface is given it is decomposed: links are often given twice. Where triangles lie in one plane they join like others. A
/// triangle whose corners lie on one line is a patch of its own. The same mesh gives the same patches.
///
/// Cost: some 20 microseconds a triangle; see lod/README.md. Errors: BadValue for a mesh that was cut, Cancelled.
Result<Decomposition> decompose(const MeshModel& mesh, const DecomposeOptions& options = {});

}  // namespace swiftlet
