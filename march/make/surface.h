// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Plain arrays to the surface of a convex body: proved convex, faces grouped, half-edges linked. Knows one level.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet {

/// The arrays of a ConvexView, and where each comes from.
struct Surface {
  std::vector<Vertex> vertices;
  std::vector<FacePlane> planes;
  std::vector<HalfEdge> half_edges;
  std::vector<std::uint32_t> face_first;
  std::vector<std::uint32_t> vertex_input;  ///< per vertex, the input's
  std::vector<std::uint32_t> input_vertex;  ///< per input vertex, ours; kNone where it is no vertex of the hull
  std::vector<std::uint32_t> input_face;    ///< per input face, the face that holds it
  int dimension = 3;
  double extent = 0, volume = 0;

  ConvexView view() const;
};

/// Proves that the arrays bound a convex body, or says where they do not. `repair` flips the reflex edges of triangles whose
/// vertices were rounded.
Result<Surface> make_surface(const LevelArrays& level, bool repair);

/// A vertex of `exact_hull` above some facet of `level`, by exact support climbs from facet to facet; kNone: the level encloses
/// it.
std::uint32_t vertex_outside(const ConvexView& exact_hull, const ConvexView& level);

/// Calls visit(a, b, c) with three vertices of each exact facet, which span its plane, counter-clockwise from outside.
template <class Visit>
void each_facet(const ConvexView& view, Visit visit);

}  // namespace swiftlet

#include "body/half_edge.h"

namespace swiftlet {

template <class Visit>
void each_facet(const ConvexView& view, Visit visit) {
  std::vector<bool> seen(view.half_edges.size(), false);
  for (std::uint32_t first = 0; first < view.half_edges.size(); ++first) {
    if (seen[first] || view.half_edges[first].face == kNone) continue;
    std::uint32_t h = first;
    do {
      seen[h] = true;
      h = next_in_facet(view, h);
    } while (h != first && !seen[h]);
    visit(origin(view, first), view.half_edges[first].head, view.half_edges[next_in_facet(view, first)].head);
  }
}

}  // namespace swiftlet
