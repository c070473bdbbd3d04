// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One level, or a mesh, as the faces a viewer wants. Knows the half-edges, nothing of files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>

namespace swiftlet::tool {

/// The faces of the exact hull, where a diagonal counts as an edge: loops of half-edges, counter-clockwise seen from outside.
std::vector<std::vector<std::uint32_t>> facets(const ConvexView& view);

/// OFF with seventeen digits, so that every double reads back bit for bit. Its faces are `facets`: exactly convex.
std::string off_text(const ConvexView& view);

/// The same of a whole mesh: the user's triangles and vertices, both in the user's order. Of equal points that one is there
/// which a triangle names first, of points without triangles none.
std::string off_text(const MeshModel& mesh);

}  // namespace swiftlet::tool
