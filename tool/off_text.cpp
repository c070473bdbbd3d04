// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "off_text.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "body/half_edge.h"
#include "text.h"

namespace swiftlet::tool {

std::vector<std::vector<std::uint32_t>> facets(const ConvexView& view) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<bool> seen(view.half_edges.size(), false);
  for (std::uint32_t first = 0; first < view.half_edges.size(); ++first) {
    if (seen[first] || view.half_edges[first].face == kNone) continue;
    loops.emplace_back();
    for (std::uint32_t h = first; !seen[h]; h = next_in_facet(view, h)) {
      seen[h] = true;
      loops.back().push_back(h);
    }
  }
  return loops;
}

namespace {

/// Places in the order of their ids.
std::vector<std::uint32_t> by_id(std::span<const std::uint32_t> ids) {
  std::vector<std::uint32_t> places(ids.size());
  std::iota(places.begin(), places.end(), 0u);
  std::stable_sort(places.begin(), places.end(), [ids](std::uint32_t x, std::uint32_t y) { return ids[x] < ids[y]; });
  return places;
}

}  // namespace

std::string off_text(const ConvexView& view) {
  const auto loops = facets(view);
  std::string text = format("OFF\n%zu %zu 0\n", view.vertices.size(), loops.size());
  for (const Vertex& v : view.vertices) text += format("%.17g %.17g %.17g\n", v.x, v.y, v.z);
  for (const auto& loop : loops) {
    text += std::to_string(loop.size());
    for (std::uint32_t h : loop) text.append(" ").append(std::to_string(origin(view, h)));
    text += "\n";
  }
  return text;
}

std::string off_text(const MeshModel& mesh) {
  std::string text = format("OFF\n%zu %zu 0\n", mesh.vertex_count(), mesh.triangle_count());
  std::vector<std::uint32_t> place(mesh.vertex_count());
  std::uint32_t written = 0;
  for (const std::uint32_t v : by_id(mesh.source_vertex())) {
    const Vec3 p = mesh.vertex(v);
    text += format("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    place[v] = written++;
  }
  for (const std::uint32_t t : by_id(mesh.source_triangle())) {
    const std::array<std::uint32_t, 3> corner = mesh.triangle(t);
    text += format("3 %u %u %u\n", place[corner[0]], place[corner[1]], place[corner[2]]);
  }
  return text;
}

}  // namespace swiftlet::tool
