// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What is inside a closed mesh, by rational arithmetic: the parity of a ray through all triangles, in a direction that is drawn
// anew until the ray meets no edge. Shares no code with bvh or march.
#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include <CGAL/Exact_rational.h>

#include "soups.h"

namespace swiftlet::soups {

using Number = CGAL::Exact_rational;

inline int sign(const Number& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Whether a ray crosses an odd number of triangles; nothing if it meets an edge or runs within a plane.
inline std::optional<bool> parity(const std::vector<Triangle<Number>>& all, const Point<Number>& p,
                                  const Point<Number>& along) {
  bool odd = false;
  for (const auto& t : all) {
    const Point<Number> a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const int x = sign(dot(along, cross(a, b))), y = sign(dot(along, cross(b, c))), z = sign(dot(along, cross(c, a)));
    if (x * y < 0 || y * z < 0 || z * x < 0) continue;
    if (x == 0 || y == 0 || z == 0) {
      const Point<Number> n = cross(t[1] - t[0], t[2] - t[0]);
      if (sign(dot(n, n)) == 0 && (x != 0 || y != 0 || z != 0)) continue;  // a flat triangle that the line passes
      return std::nullopt;
    }
    // The line passes through the triangle: ahead of the point or behind it.
    const Point<Number> n = cross(b - a, c - a);
    odd ^= sign(dot(n, a)) * sign(dot(n, along)) > 0;
  }
  return odd;
}
/// Of a point off the surface.
inline bool inside(const std::vector<Triangle<Number>>& all, const Point<Number>& p) {
  shapes::Random random(7);
  for (int tries = 0; tries < 100; ++tries) {
    const Vec3 d = random.on_sphere();
    if (const std::optional<bool> odd = parity(all, p, point<Number>(d))) return *odd;
  }
  throw std::logic_error("no ray is clear of all edges");
}
inline Number squared_distance(const std::vector<Triangle<Number>>& all, const Point<Number>& p) {
  Number least(-1);
  for (const auto& t : all) {
    const Number squared = nearest(Triangle<Number>{p, p, p}, t).squared;
    if (least < 0 || squared < least) least = squared;
  }
  return least;
}

}  // namespace swiftlet::soups
