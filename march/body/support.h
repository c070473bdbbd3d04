// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The support vertex of a body, found by hill climbing over its edges and proved by exact signs.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// Climbs from `v` until no neighbour is higher by `is_higher(vertex, best)`. If that decides exactly and the body is exactly
/// convex, no vertex at all is higher. `plane_tests` grows by the number of neighbours compared.
template <class IsHigher>
static inline std::uint32_t climb(const ConvexView& view, std::uint32_t v, std::uint32_t& plane_tests, IsHigher is_higher) {
  for (;;) {
    const Vertex& record = view.vertices[v];
    std::uint32_t best = v;
    for (std::uint32_t h = record.ring_begin; h < record.ring_begin + record.ring_count; ++h) {
      const std::uint32_t w = view.half_edges[h].head;
      if (is_higher(view.vertices[w], view.vertices[best])) best = w;
    }
    plane_tests += record.ring_count;
    if (best == v) return v;
    v = best;
  }
}

/// The vertex farthest along `n`, climbed to from `start`: no vertex is farther, exactly. `plane_tests` grows by the number of
/// neighbours compared.
std::uint32_t support(const ConvexView& view, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests);
/// The vertex farthest along `n` of a body that `in_common` moves into the common frame. `n` is in the common frame.
std::uint32_t support(const ConvexView& view, const Motion& in_common, const Vec& n, std::uint32_t start,
                      std::uint32_t& plane_tests);

/// A vertex that is about the farthest along `own`, a direction in the body's own frame. The climb compares rounded heights and
/// proves nothing. It ends, because each vertex has one rounded height and heights only grow.
std::uint32_t ascend(const ConvexView& view, const Vec& own, std::uint32_t start, std::uint32_t& plane_tests);

}  // namespace swiftlet
