// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Convex surface decomposition [Ehmann & Lin 2001, sec. 4]: a closed surface as patches, each on the boundary of its convex
// hull, whose inside the surface does not enter. Such a hull lies in the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "shapes.h"

namespace hull_tree {

/// Patches as lists of triangles. Breadth-first from the first triangle that no patch holds; cost: a hull per triangle tried.
std::vector<std::vector<std::uint32_t>> convex_patches(const Mesh& mesh);

/// The hull of some of a mesh's triangles and points.
struct PartialHull {
  swiftlet::Model model;
  std::vector<std::uint32_t> point;     ///< of the mesh, per vertex
  std::vector<std::uint32_t> triangle;  ///< of the mesh, per triangle that the model's source map names
};
PartialHull hull_of(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                    const std::vector<std::uint32_t>& points = {});

/// The corners of a face, in order.
std::vector<std::uint32_t> corners(const swiftlet::ConvexView& view, std::uint32_t face);
double area(const swiftlet::ConvexView& view, std::uint32_t face);
double area(const Mesh& mesh, std::uint32_t triangle);

}  // namespace hull_tree
