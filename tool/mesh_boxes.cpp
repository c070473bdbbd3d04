// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_boxes.h"

#include <cmath>

#include "mesh_block.h"

namespace swiftlet::tool {

std::vector<OrientedBox> lowest_boxes(const MeshModel& mesh) {
  const MeshReader::Content& content = MeshReader::content(mesh);
  const double unit = std::ldexp(1.0, content.header.unit);
  std::vector<OrientedBox> boxes;
  for (const Node& node : content.nodes) {
    const Axes axes = axes_of(node);
    for (int child = 0; child < node.count(); ++child) {
      if (!node.lowest() && node.first() + std::uint32_t(child) < content.nodes.size()) continue;
      OrientedBox box{Vec3(node.origin), {}};
      for (int k = 0; k < 3; ++k) {
        box.middle += double(node.centre[k][child]) * eigen(axes.row[k]);
        box.half[std::size_t(k)] = unit * double(node.half[k][child]) * eigen(axes.row[k]);
      }
      box.middle *= unit;
      boxes.push_back(box);
    }
  }
  return boxes;
}

}  // namespace swiftlet::tool
