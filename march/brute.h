// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What checks are made of: supports and containment by brute force, in 106 bits, and failures in words.
#pragma once

#include <cstdio>

#include <swiftlet/check.h>

#include "scene.h"
#include "surface.h"
#include "tolerance.h"
#include "wide.h"

namespace swiftlet {

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

/// How far vertices reach along a direction, when `place` has placed them.
template <class Placing>
static inline DoubleDouble reach(std::span<const Vertex> vertices, const Wide& direction, Placing place) {
  DoubleDouble most = dot(direction, place(vec(vertices[0])));
  for (const Vertex& v : vertices) {
    if (const DoubleDouble h = dot(direction, place(vec(v))); h > most) most = h;
  }
  return most;
}
/// Of the exact hull: as far as itself; without it, no farther than any level that encloses it.
template <class Placing>
static inline DoubleDouble reach(const Model& model, const Wide& direction, Placing place) {
  DoubleDouble least = reach(model.level(model.finest_level()).view.vertices, direction, place);
  for (int i = model.finest_level() + 1; model.finest_level() > 0 && i < model.level_count(); ++i) {
    if (const DoubleDouble h = reach(model.level(i).view.vertices, direction, place); least > h) least = h;
  }
  return least;
}

/// How far B, models or spans of vertices, stands from A along `n`, of any length.
template <class Body>
static inline double gap_along(const Body& a, const Body& b, const Motion& b_in_a, const Vec& n) {
  const Wide direction = wide(n);
  const DoubleDouble most_a = reach(a, direction, [](const Vec&p) { return wide(p); }),
                     least_b = -reach(b, -direction, [&](const Vec&p) { return wide(b_in_a, p); });
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
