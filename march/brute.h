// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What checks are made of: supports and containment by brute force, in 106 bits, and failures in words.
#pragma once

#include <cstdio>

#include <swiftlet/check.h>

#include "double_double.h"
#include "scene.h"
#include "surface.h"
#include "tolerance.h"

namespace swiftlet {

using Wide = V3<DoubleDouble>;
static inline Wide wide(const Vec& v) { return {v.x, v.y, v.z}; }
static inline Wide wide(const Motion& m, const Vec& p) {
  const Wide q = wide(p);
  return Wide{dot(wide(m.row_x), q), dot(wide(m.row_y), q), dot(wide(m.row_z), q)} + wide(m.t);
}

template <class... Values>
Check failed(const char* format, Values... values) {
  if constexpr (sizeof...(Values) == 0) {
    return {false, format};
  } else {
    char message[256];
    std::snprintf(message, sizeof message, format, values...);
    return {false, message};
  }
}
inline const Check kPassed{true, ""};

/// How far B stands from A along `n`, of any length: least coordinate of B less greatest of A.
static inline double gap_along(const Scene& scene, const Vec& n) {
  const Wide direction = wide(n);
  DoubleDouble most_a = dot(direction, wide(vec(scene.a.vertices[0]))),
               least_b = dot(direction, wide(scene.b_in_a, vec(scene.b.vertices[0])));
  for (const Vertex& v : scene.a.vertices) {
    if (const DoubleDouble h = dot(direction, wide(vec(v))); h > most_a) most_a = h;
  }
  for (const Vertex& v : scene.b.vertices) {
    if (const DoubleDouble h = dot(direction, wide(scene.b_in_a, vec(v))); h < least_b) least_b = h;
  }
  return double(least_b - most_a) / norm(n);
}

/// Whether a point lies in a body, up to `slack`: below every face's plane by then.
static inline bool holds(const ConvexView& view, const Vec& p, double slack) {
  if (view.face_first.empty() || view.vertices.size() < 4)
    return true;  // flat bodies: the distance to them is checked by lower
  bool inside = true;
  each_facet(view, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Wide o = wide(vec(view.vertices[a])), n = cross(wide(vec(view.vertices[b])) - o, wide(vec(view.vertices[c])) - o);
    inside = inside && double(dot(n, wide(p) - o)) <= slack * norm({double(n.x), double(n.y), double(n.z)});
  });
  return inside;
}

}  // namespace swiftlet
