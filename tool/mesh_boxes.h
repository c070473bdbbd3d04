// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is left of a mesh that was cut: the boxes around its surface. Reads the tree's nodes.
#pragma once

#include <array>
#include <vector>

#include <swiftlet/mesh.h>

namespace swiftlet::tool {

/// A box of any orientation, in the mesh's frame and unit.
struct OrientedBox {
  Vec3 middle;
  std::array<Vec3, 3> half;  ///< from the middle to the middle of a side, along each axis
};

/// The lowest boxes that the mesh holds, of which every triangle is in one.
std::vector<OrientedBox> lowest_boxes(const MeshModel& mesh);

}  // namespace swiftlet::tool
