// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions and the two Eigen types the public surface uses. Knows nothing of bodies.
#pragma once

#include <Eigen/Core>

/// How near are two convex bodies? models (model.h), queries (query.h), and the builder (build.h).
namespace swiftlet {

/// A point or direction in the frame its name ends with (`p_a`: body A's frame). Any length unit, the caller's.
using Vec3 = Eigen::Matrix<double, 3, 1>;
/// Column-major whatever the consumer's EIGEN_DEFAULT_TO_ROW_MAJOR says.
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::ColMajor>;

/// Maps a point p of its own frame to `rotation * p + translation`. Used as given: a rotation that is rounded, orthonormal to
/// 1e-6, is legal, as is a reflection, and the answer is the one for these very doubles. Translations reach to 1e45.
struct Pose {
  Mat3 rotation = Mat3::Identity();  ///< abs(R^T R - I) <= 1e-6 in every entry, or queries answer InvalidPose
  Vec3 translation = Vec3::Zero();   ///< in the frame mapped to, the bodies' unit
};

/// The pose of B in A's frame, from both poses in a common frame. Translations are subtracted first, so that a common
/// translation exact in double changes no bit, and A's rotation is inverted, not transposed.
Pose relative(const Pose& a_in_world, const Pose& b_in_world);

/// The pose that undoes `pose`; its rotation is the matrix inverse.
Pose inverse(const Pose& pose);

}  // namespace swiftlet
