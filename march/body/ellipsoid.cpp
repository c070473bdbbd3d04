// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "body/ellipsoid.h"

#include <cmath>

#include "body/half_edge.h"
#include "body/support_map.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"

namespace swiftlet {
namespace {

/// True if the product of the Frobenius norms of M and its inverse is at most `kMostSlender`. It bounds the product of their
/// norms.
bool is_stout(const std::array<double, 6>& frame) {
  double squares = 0, of_inverse = 0;
  for (const double entry : frame) squares += entry * entry;
  for (const Vec& axis : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}) {
    const Vec column = ball_coordinates(frame, axis);
    of_inverse += dot(column, column);
  }
  return std::sqrt(squares) * std::sqrt(of_inverse) <= kMostSlender;
}

}  // namespace

double scale_around(const ConvexView& view, const Vec& centre, const std::array<double, 6>& frame) {
  if (!(view.extent > 0) || !is_stout(frame)) return kInfinity;
  double most = 0;
  for (const Vertex& v : view.vertices) most = max(most, norm(ball_coordinates(frame, vec(v) - centre)));
  return most * (1 + kEllipsoidSlack);
}

double scale_inside(const ConvexView& view, const Vec& centre, const std::array<double, 6>& frame) {
  if (view.face_first.empty() || !is_stout(frame)) return 0;
  double least = kInfinity;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    if (!is_first_in_facet(view, h)) continue;
    const std::uint32_t a = origin(view, h), b = view.half_edges[h].head, c = view.half_edges[next_in_facet(view, h)].head;
    const exact::Plane plane = exact::plane(vec(view.vertices[a]), vec(view.vertices[b]), vec(view.vertices[c]));
    if (!(dot(plane.normal, plane.normal) > 0)) continue;
    const double height = plane.height - dot(plane.normal, centre) - kInnerError * view.extent;
    least = min(least, height / norm(into_map(frame, plane.normal)));
  }
  return least < kInfinity ? max(0, least * (1 - kEllipsoidSlack)) : 0;
}

}  // namespace swiftlet
