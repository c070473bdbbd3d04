// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What two contact faces have in common, seen along one normal. Knows nothing of which corners a manifold keeps.
#pragma once

#include "manifold/candidates.h"
#include "manifold/contact_face.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// The vertices of a body as a unit normal shows them: two coordinates across the normal and one along it.
struct SeenBody {
  const ConvexView& view;
  Vec x, y, n;  ///< the axes in the body's own frame, right-handed where the pose does not mirror
  Vec shift;
  Vec operator()(std::uint32_t vertex) const {
    const Vec p = vec(view.vertices[vertex]);
    return {dot(x, p) + shift.x, dot(y, p) + shift.y, dot(n, p) + shift.z};
  }
};

/// Both bodies of a pair as one normal of the common frame shows them.
struct Projection {
  /// `middle`, a point near both contact faces, is seen at 0. The axis y and `side`, a side of a contact face, make an angle
  /// that no two sides of a regular polygon make: a sweep along y meets few sides crosswise.
  Projection(const PairView& pair, const Vec& normal, const Vec& middle, const Vec& side);
  /// The point of the common frame, which is A's, that is seen there.
  Vec point(const Vec& seen) const { return middle + a.x * seen.x + a.y * seen.y + a.n * seen.z; }

  SeenBody a, b;
  Vec middle;
};

/// A side of one of two faces, in the common frame; 0 where both are points.
Vec any_side(const PairView& pair, const ContactFace& a, const ContactFace& b);

/// Adds the corners of the common area to `corners`, in order along each border; nothing where there is none. What stands out
/// by less than `bound`, at least the rounding of the pair's points, is not cut off. Cost: the sum of the sides of both faces.
void clip(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound, Candidates& corners);

}  // namespace swiftlet
