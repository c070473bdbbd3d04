// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The largest polygon of few candidates.
#pragma once

#include <array>

#include "manifold/candidates.h"

namespace swiftlet {

struct LargestPolygon {
  double twice_area = 0;
  int count = 0;
  std::array<int, kMostManifoldPoints> corner;  ///< indices of candidates

  const int* begin() const { return corner.data(); }
  const int* end() const { return corner.data() + count; }
};

/// Returns the largest polygon of at most `most` corners, 3 or more, all of them candidates and one of them `first`, or none if
/// not even twice the area of the candidates' hull is more than `enough`. If `first` lies inside of the hull, farther than
/// `bound` from its corners, it counts among `most`: as a corner beside the nearest side of the hull, or none where others make
/// a larger polygon, of which the candidate farthest from it is one. Cost: `most` times the square of the number of candidates.
LargestPolygon largest_polygon(const Candidates& candidates, int first, int most, double bound, double enough);

}  // namespace swiftlet
