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

/// A vertex, an edge, a facet or a diagonal within a face, by its vertices, of which the last is repeated.
using Part = std::array<std::uint32_t, 3>;
constexpr Part kNoPart{kNone, kNone, kNone};

/// The nearest points of two features of a pair, in the common frame.
struct Nearest {
  Padded normal;            ///< from A to B, any length
  Padded apart;             ///< from a vertex of A's feature to a vertex of B's, rounded as `Moved::point` is
  Padded point_a, point_b;  ///< a point of each feature
  double blur;              ///< how far both points may be beside their features, besides the rounding of their own coordinates
  /// Upper bounds on how far A rises along `normal`, taken at length 1, above any vertex of its feature, and B against it above
  /// any of its own. Infinite where the walk's tests do not tell.
  double over_a, over_b;
  Part part_a, part_b;  ///< what the tests were about: the features, or of a face the facet or the diagonal; kNoPart: the face
};

}  // namespace swiftlet
