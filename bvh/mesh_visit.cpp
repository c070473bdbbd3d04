// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way down one tree, by boxes along the axes of the mesh's frame around those of its nodes.
#include <swiftlet/mesh_visit.h>

#include <cmath>

#include "mesh_block.h"

namespace swiftlet {
namespace {

bool enters(MeshVisitor& visitor, const Node& node, double unit) {
  const Axes axes = axes_of(node);
  const double size = double(node.extent[0]) + node.extent[1] + node.extent[2];
  Vec3 half = Vec3::Constant(kNodeBoxShare * size);
  for (int k = 0; k < 3; ++k) half += eigen(axes.row[k]).cwiseAbs() * double(node.extent[k]);
  const Vec3 middle(node.origin[0], node.origin[1], node.origin[2]);
  return visitor.enters((middle - half) * unit, (middle + half) * unit);
}

}  // namespace

void visit_triangles(const MeshModel& mesh, MeshVisitor& visitor) {
  const MeshReader::Content& content = MeshReader::content(mesh);
  if (!content.is_whole()) return;
  const double unit = power_of_two(content.header.unit);
  std::uint32_t stack[(kFanOut - 1) * kMostDepth + 1];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = content.nodes[stack[--top]];
    if (!enters(visitor, node, unit)) continue;
    if (!node.lowest()) {
      for (int i = node.count(); i-- > 0;) stack[top++] = node.first() + std::uint32_t(i);
      continue;
    }
    for (std::uint32_t t = node.first(); t < node.first() + std::uint32_t(node.count()); ++t) {
      const auto corner = [&](std::size_t k) { return eigen(content.vertices[content.triangles[t][k]]); };
      const Vec3 p = corner(0), q = corner(1), r = corner(2);
      if (visitor.enters(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)) && !visitor.visit(t)) return;
    }
  }
}

}  // namespace swiftlet
