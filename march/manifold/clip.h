// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What two contact faces have in common, seen along one normal. Knows nothing of which corners a manifold keeps.
#pragma once

#include "manifold/candidates.h"
#include "manifold/contact_face.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// Points of the common frame by two coordinates across a unit normal and one along it.
struct Projection {
  /// `middle` is at 0; near what is looked at, so that little is lost. `y` and a `side` of what is looked at make an angle that
  /// no two sides of a regular polygon make: a sweep along y meets few of them crosswise.
  Projection(const Vec& normal, const Vec& middle, const Vec& side);
  Vec point(const Vec& seen) const { return middle + x * seen.x + y * seen.y + n * seen.z; }

  Vec x, y, n;  ///< right-handed
  Vec middle;
};

/// A side of one of two faces, in the common frame; 0 where both are points.
Vec any_side(const PairView& pair, const ContactFace& a, const ContactFace& b);

/// Adds the corners of the common area to `corners`, in order along each border; nothing where there is none. What stands out
/// by less than `bound`, at least the rounding of the pair's points, is not cut off. Cost: the sum of the sides of both faces.
void clip(const PairView& pair, const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
          Candidates& corners);

}  // namespace swiftlet
