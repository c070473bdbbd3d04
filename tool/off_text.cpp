// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "off_text.h"

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

}  // namespace swiftlet::tool
