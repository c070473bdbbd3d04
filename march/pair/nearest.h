// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the last state of a walk knows: the nearest points of two features, and how far its own tests prove that either body
// rises above its feature. Knows one level pair.
#pragma once

#include <array>
#include <cstdint>

#include "body/half_edge.h"
#include "numeric/vec4.h"

namespace swiftlet {

/// The vertices of a vertex, an edge, a facet or a diagonal within a face, of which the last is repeated.
using FeatureCorners = std::array<std::uint32_t, 3>;
constexpr FeatureCorners kNoCorners{kNone, kNone, kNone};

/// The nearest points of two features of a pair, in the common frame. `V` is Vec4 in registers, Padded in memory.
template <class V>
struct NearestOf {
  V normal;            ///< from A to B, any length
  V apart;             ///< from a vertex of A's feature to a vertex of B's, rounded as `Moved::point` is
  V point_a, point_b;  ///< a point of each feature
  double blur;         ///< how far both points may be beside their features, besides the rounding of their own coordinates
  /// Upper bounds on how far A rises along `normal`, taken at length 1, above any vertex of its feature, and B against it above
  /// any of its own. Infinite where the walk's tests do not tell.
  double over_a, over_b;
  /// Of what the tests were about: of each feature or, of a face of many corners, of the facet or the diagonal. kNoCorners: of
  /// the whole face.
  FeatureCorners corners_a, corners_b;
};
using Nearest = NearestOf<Padded>;

static inline void store(const NearestOf<Vec4>& from, Nearest& to) {
  store(from.normal, to.normal), store(from.apart, to.apart), store(from.point_a, to.point_a), store(from.point_b, to.point_b);
  to.blur = from.blur, to.over_a = from.over_a, to.over_b = from.over_b;
  to.corners_a = from.corners_a, to.corners_b = from.corners_b;
}
static inline void store(const NearestOf<Vec4>& from, NearestOf<Vec4>& to) { to = from; }
static inline NearestOf<Vec4> loaded(const Nearest& from) {
  return {vec4(from.normal), vec4(from.apart), vec4(from.point_a), vec4(from.point_b), from.blur,
          from.over_a,       from.over_b,      from.corners_a,     from.corners_b};
}

}  // namespace swiftlet
