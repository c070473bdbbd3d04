// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Turns plain arrays into the surface of a convex body: proves it convex, groups facets to faces, links half-edges. Knows one
// level.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/model.h>

#include "numeric/tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The arrays of a ConvexView, and their correspondence with the input arrays.
struct Surface {
  std::vector<Vertex> vertices;
  std::vector<FacePlane> planes;
  std::vector<HalfEdge> half_edges;
  std::vector<std::uint32_t> face_first;
  std::vector<std::uint32_t> vertex_input;  ///< per vertex of `vertices`, the input vertex
  std::vector<std::uint32_t> input_vertex;  ///< per input vertex, the index in `vertices`; kNone if it is no vertex of the hull
  std::vector<std::uint32_t> input_face;    ///< per input face, the face in `face_first` that contains it
  int dimension = 3;
  std::uint32_t rims = 0;
  double extent = 0, volume = 0;

  ConvexView view() const;
};

/// Makes the surface of a convex body of plain arrays, and proves it convex; else returns an error that says where it is not.
/// With `repair`, it first flips reflex edges between the given faces, which rounding of the vertices may have made.
/// The same surface on any executor.
Result<Surface> make_surface(const LevelArrays& level, bool repair, const Executor& executor = {});

/// Returns a vertex of `exact_hull` that lies above some facet of `level`, or kNone if the level encloses the hull. Decided by
/// exact support climbs from facet to facet.
std::uint32_t vertex_outside(const ConvexView& exact_hull, const ConvexView& level);

/// Returns a bound on the heights of all vertices of `view` above the plane through vertex `v` with the normal `n`: the
/// largest, rounded up, at least 0. Requires an exactly convex body and coordinates of `n` that are 0 or at least
/// kLeastNormalEntry. Cost: a support climb from `v`.
double height_over(const ConvexView& view, const Vec& n, std::uint32_t v);

/// Returns an upper bound on the distance of two points of a body: twice the radius of a ball around all vertices, whose centre
/// is that of the bounding box or the mean of the vertices. Cost: linear in the vertices.
double reach_of(const ConvexView& view);

/// Returns the radius, rounded up, of a ball around `centre` that holds the body. Cost: linear in the vertices.
double outer_radius_of(const ConvexView& view, const Vec& centre);

/// Returns a bound on the distance of `p` from the plane through `on` with the normal `n`, unit up to `kUnitNormalError`, for
/// points of a body of `extent`.
static inline double thickness_at(const Vec& n, const Vec& on, const Vec& p, double extent) {
  const Vec d = p - on, terms{n.x * d.x, n.y * d.y, n.z * d.z};
  return (std::fabs(dot(n, d)) + kThicknessError * norm_1(terms)) * (1 + 2 * kUnitNormalError) + kThicknessFloor * extent;
}

/// Returns the radius, rounded down, of a ball around `centre` that the body holds; 0 if there is none. Cost: linear in the
/// facets.
double inner_radius_of(const ConvexView& view, const Vec& centre);

/// Calls visit(a, b, c) for each exact facet with three of its vertices, which span its plane, counter-clockwise from outside.
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
