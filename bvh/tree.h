// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds the tree of boxes over triangles: see tree.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "mesh_block.h"
#include "weld.h"

namespace swiftlet {

/// Fills `parts` from `soup`: the tree, and vertices and triangles in its order. `go_on` gets the fraction done. False if it
/// asked to stop. `patch_of`: per triangle, the patch that it belongs to, or kNone; a patch is not cut before it has a node of
/// its own, which is marked, but for depths at which nodes are cut in equal halves. May be empty.
bool grow_tree(const Soup& soup, std::span<const std::uint32_t> patch_of, MeshParts& parts,
               const std::function<bool(double fraction)>& go_on);

}  // namespace swiftlet
