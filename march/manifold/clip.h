// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The intersection of two contact faces, projected along one normal. Does not know which of its corners a manifold keeps.
#pragma once

#include "manifold/candidates.h"
#include "manifold/contact_face.h"
#include "numeric/width.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// Projects the vertices of a body: x and y across a unit normal, z along it.
struct SeenBody {
  const ConvexView& view;
  Vec x, y, n;  ///< the axes in the body's own frame, right-handed where the pose does not mirror
  Vec shift;
  [[gnu::always_inline]] PlanePoint at(std::uint32_t vertex) const {
    const Vec p = vec(view.vertices[vertex]);
    return {dot(x, p) + shift.x, dot(y, p) + shift.y};
  }
  [[gnu::always_inline]] double z(std::uint32_t vertex) const { return dot(n, vec(view.vertices[vertex])) + shift.z; }
  [[gnu::always_inline]] Vec2 z(std::uint32_t vertex, std::uint32_t other) const {
    const Vertex &p = view.vertices[vertex], &q = view.vertices[other];
    return n.x * Vec2{p.x, q.x} + n.y * Vec2{p.y, q.y} + n.z * Vec2{p.z, q.z} + shift.z;
  }
};

/// The projections of both bodies of a pair along one normal of the common frame.
struct Projection {
  /// `middle`, a point near both contact faces, is seen at 0. Axis x, which is the sweep line, and `side`, a side of a contact
  /// face, make an angle that no two sides of a regular polygon of up to 20 corners make: few sides are parallel to the line.
  /// It is small, and the face above the side, so that the sweep begins nearby.
  Projection(const PairView& pair, const Vec& normal, const Vec& middle, const Vec& side);
  /// The point of the common frame, A's, whose projection is `seen`.
  Vec point(const Vec& seen) const { return middle + a.x * seen.x + a.y * seen.y + a.n * seen.z; }

  SeenBody a, b;
  Vec middle;
};

/// A side of one of two faces, in the common frame; 0 where both are points.
Vec any_side(const PairView& pair, const ContactFace& a, const ContactFace& b);

/// Does as `clip`, of two faces of three or four sides whose corners surely turn inwards. Returns false, and adds nothing, of
/// others. Adds all corners to the left border, clockwise.
bool clip_four_sides(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                     Candidates& corners);

/// Does as `clip`, by halving: of two rims, or a rim and a face of few corners. If there are many, it adds those that hold
/// nearly all of the area, the deepest, and those that the manifold before names. Returns false, and adds nothing, if a border
/// may turn outwards or the faces hardly overlap. Cost: the logarithm of the sides of both faces for each corner.
bool clip_by_halving(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                     Candidates& corners);

SWIFTLET_BOTH_WIDTHS(void, clip, const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                     Candidates& corners);
/// Adds the corners of the intersection to `corners`, each border's from below to above, and closes it. A corner that lies
/// outside of the other face by less than `bound`, which covers the rounding of the pair's points, counts as inside. Cost: the
/// sum of the sides of both faces, or that of halving.
static inline void clip(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                        Candidates& corners) {
  const bool is_large = a.corner_count() + b.corner_count() >= kManyCorners;
  if (is_large ? !clip_by_halving(projection, a, b, bound, corners) : !clip_four_sides(projection, a, b, bound, corners))
    SWIFTLET_BY_WIDTH(clip, projection, a, b, bound, corners);
  corners.close();
}

}  // namespace swiftlet
