// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Builds the tree of boxes over triangles: see tree.cpp.
#pragma once

#include <functional>

#include "mesh_block.h"
#include "weld.h"

namespace swiftlet {

/// Fills `parts` from `soup`: the tree, and vertices and triangles in its order. `go_on` gets the fraction done. False if it
/// asked to stop.
bool grow_tree(const Soup& soup, MeshParts& parts, const std::function<bool(double fraction)>& go_on);

}  // namespace swiftlet
