// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the last state of a walk knows: the nearest points of two features, and how far its own tests prove that either body
// rises above its feature. Knows one level pair.
#pragma once

#include <array>
#include <cstdint>

#include "body/half_edge.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The vertices of a vertex, an edge, a facet or a diagonal within a face, of which the last is repeated.
using FeatureCorners = std::array<std::uint32_t, 3>;
constexpr FeatureCorners kNoCorners{kNone, kNone, kNone};

/// The nearest points of two features of a pair, in the common frame.
struct Nearest {
  Padded normal;            ///< from A to B, any length
  Padded apart;             ///< from a vertex of A's feature to a vertex of B's, rounded as `Moved::point` is
  Padded point_a, point_b;  ///< a point of each feature
  double blur;              ///< how far both points may be beside their features, besides the rounding of their own coordinates
  /// Upper bounds on how far A rises along `normal`, taken at length 1, above any vertex of its feature, and B against it above
  /// any of its own. Infinite where the walk's tests do not tell.
  double over_a, over_b;
  /// Of what the tests were about: of each feature or, of a face of many corners, of the facet or the diagonal. kNoCorners: of
  /// the whole face.
  FeatureCorners corners_a, corners_b;
};

}  // namespace swiftlet
