// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where two bodies lie on each other: few points that stand for the whole area of contact, as a simulation wants them.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/query.h>

namespace swiftlet {

/// The most points that a manifold holds.
inline constexpr std::uint32_t kMostManifoldPoints = 8;

/// A place of contact: a point of each body, one above the other along the manifold's normal. In A's frame.
struct ManifoldPoint {
  Vec3 point_a = Vec3::Zero();  ///< in A, below its surface by no more than the flatness asked for
  Vec3 point_b = Vec3::Zero();  ///< in B likewise: `point_a` + `separation` * normal, within twice `tolerance`
  double separation = 0;        ///< along the normal, the bodies' unit; negative where the bodies overlap
  /// What the point lies on, on the answer's levels: a corner of one body and the contact face of the other, or an edge of
  /// each, which is named by the lesser of its half-edges. It names the point from manifold to manifold: the same pair, the
  /// same place of the bodies.
  FeatureId feature_a;
  FeatureId feature_b;  ///< likewise, of B
};

/// The area in which two bodies face each other, seen along one normal, by its corners.
struct Manifold {
  Vec3 normal = Vec3::Zero();  ///< that of the answer: unit, from A to B, A's frame
  FeatureId face_a;            ///< the contact face of A, on the answer's level; none where A has no faces
  FeatureId face_b;            ///< likewise, of B
  std::uint32_t count = 0;     ///< of points; 0: the bodies are farther apart than asked, or the answer gives none
  std::array<ManifoldPoint, kMostManifoldPoints> points{};  ///< the first `count`, in order around the area from the deepest on
};

/// What a manifold shall hold. Lengths are in the bodies' unit.
struct ManifoldOptions {
  double margin = 0;              ///< points farther apart than this, and than `tolerance` more, are left out
  std::uint32_t most_points = 4;  ///< 1 to kMostManifoldPoints
  /// Faces that lie within so much of a body's contact face are one face with it, which makes one square of the two triangles
  /// of a rounded one; seen narrower than this, from the side, they may be a line. Over the body's extent; by default 4 ulps of
  /// single precision, from which such squares come. The faces of a model are flat to 4 ulps of its input's precision by
  /// themselves: less has no effect on them.
  double flatness = 0x1p-21;
};

/// The manifold around the deepest or nearest features of `answer`, an exact one of these bodies at this pose, signed or of
/// bodies that are apart. The contact face of a body is, of those at that feature, the one that faces best along the normal;
/// both are projected along it, and the corners of what they have in common are the points. Where there are more than asked for
/// those stay that hold the least separation and most of the area: of a round face four keep 0.6, eight 0.9, of a square all;
/// of any three keep 0.19 at least. Those of `previous`, the manifold of this pair a moment ago, are preferred. The least
/// separation of a manifold is the answer's, within `tolerance`. No points of an answer without a normal (a distance knows no
/// way out of an overlap), of other radii than the bodies', or of levels and features that these do not have. Nothing is
/// allocated; 4 kB of stack. Cost: the sum of both faces' sides.
Manifold manifold(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const ManifoldOptions& options = {},
                  const Manifold& previous = {});

}  // namespace swiftlet
