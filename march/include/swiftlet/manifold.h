// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contact manifolds: a few points that stand for the whole area in which two bodies touch, as a simulation wants them.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/query.h>

namespace swiftlet {

/// The largest number of points in a manifold.
inline constexpr std::uint32_t kMostManifoldPoints = 8;

/// The largest flatness of a contact face (`ManifoldOptions::flatness`), relative to the body's extent.
inline constexpr double kMostFlatness = 0x1p-10;

/// A place of contact: one point of each body, both on one line along the manifold's normal. In A's frame.
struct ManifoldPoint {
  Vec3 point_a = Vec3::Zero();  ///< in A, below its surface by no more than `flatness` allows
  Vec3 point_b = Vec3::Zero();  ///< in B: `point_a` + `separation` * normal, within twice `tolerance`; or beside B, at rest
  double separation = 0;        ///< along the normal, in the bodies' unit; negative where the bodies overlap
  /// The feature of A that `point_a` lies on, within twice `tolerance`, at the answer's level. Both are a vertex of one body
  /// and the contact face of the other, or an edge of each, named by its half-edge of lower index, or, of a deepest point that
  /// is no corner, the answer's. The pair of features identifies the point from one manifold to the next. The border of a
  /// merged contact face may turn inwards: an edge there stands for the chord that cuts it off, and the point lies on that.
  FeatureId feature_a;
  FeatureId feature_b;  ///< the feature of B that `point_b` lies on
};

/// The area in which two bodies face each other, projected along one normal and given by corners of it.
struct Manifold {
  Vec3 normal = Vec3::Zero();  ///< the answer's normal: unit, from A to B, A's frame
  FeatureId face_a;            ///< the contact face of A, on the answer's level; `FeatureId{}` where A has no faces
  FeatureId face_b;            ///< the contact face of B, on the answer's level
  std::uint32_t count = 0;     ///< number of points; 0: the bodies are farther apart than `margin`, or the answer allows none
  std::array<ManifoldPoint, kMostManifoldPoints> points{};  ///< [0, count): around the area, the deepest, maybe inside, first
};

/// Options of a manifold. Lengths are in the bodies' unit.
struct ManifoldOptions {
  double margin = 0;              ///< points with a separation above this plus `tolerance` are left out
  std::uint32_t most_points = 4;  ///< 1 to kMostManifoldPoints
  /// A height relative to the body's extent: faces that lie within it of a body's contact face, and that sides join to it, are
  /// merged into that face, so that the two triangles of a rounded square count as one square. A face that appears narrower
  /// than this, seen from the side, may count as a line. The default is 4 ulps of single precision, which such squares come
  /// from. The faces of a model are already flat to 4 ulps of its input's precision: a smaller value does not split them. At
  /// most `kMostFlatness`: a larger value counts as that.
  double flatness = 0x1p-21;
};

/// Returns the manifold around the nearest or deepest features of `answer`, which must be an exact answer about these bodies in
/// this pose: a signed one, or one of bodies that are apart. The contact face of a body is, of the faces where that feature
/// reaches farthest along the normal, the one that faces best along it. Both contact faces are projected along the normal; the
/// corners of their intersection are the points. If there are more than `most_points`, those are kept that have the least
/// separation and cover most of the area: four points keep 0.6 of a round face, eight 0.87; four keep all of a square; of any
/// face three keep at least 0.28, four 0.5, eight 0.78. A deepest point inside of the area, as merged faces may have, or beside
/// it by no more than these are flat, is one of them: the others keep what one point fewer does. Points of `previous`, this
/// pair's last manifold, are preferred: a pair at rest keeps its points while poses are off by a few ulps of single precision.
/// The least separation equals the answer's within `tolerance`; where the normal has turned by no more than 8 `flatness` since
/// `previous`, within `flatness` more, for then other corners take turns as the deepest. Where the exact corners then lack a
/// point of `previous`, corners that miss the other face by no more than twice `flatness` count as inside of it, and the other
/// body's point lies beside it by as much: faces that are flush with each other keep their points. The manifold is empty if the
/// answer has no normal (as a distance has none in an overlap), other radii than the bodies, or levels or features that the
/// bodies lack. Allocates nothing; uses 9.3 kB of stack. Cost: the sum of both faces' sides; beyond 256 sides in all, of faces
/// whose corners are numbered one after the other (`ConvexView::rims`), their logarithm; where the border of a merged contact
/// face turns in and out by less than `flatness`, at most the square of its sides.
Manifold manifold(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const ManifoldOptions& options = {},
                  const Manifold& previous = {});

}  // namespace swiftlet
