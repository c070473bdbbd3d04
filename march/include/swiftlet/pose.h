// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions and the two Eigen types that the public headers use. Knows nothing of bodies.
#pragma once

#include <Eigen/Core>

/// Proximity of two convex bodies: models (model.h), queries (query.h) and the builder (build.h).
namespace swiftlet {

/// A point or direction. A suffix of its name tells the frame (`p_a`: body A's frame). Lengths are in the caller's unit.
using Vec3 = Eigen::Matrix<double, 3, 1>;
/// A 3 x 3 matrix, column-major even where the consumer defines EIGEN_DEFAULT_TO_ROW_MAJOR.
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::ColMajor>;

/// A motion that maps a point p of its own frame to `rotation * p + translation`. A rounded rotation, orthonormal to 1e-6, is
/// legal, and so is a reflection; the stored doubles are used as they are, and answers hold for them.
struct Pose {
  Mat3 rotation = Mat3::Identity();  ///< abs(R^T R - I) <= 1e-6 in every entry, else queries answer InvalidPose
  Vec3 translation = Vec3::Zero();   ///< in the target frame and the bodies' unit, each coordinate at most 1e45 in magnitude
};

/// Returns the pose of B in A's frame, given both poses in a common frame. Translations are subtracted first, so that a common
/// translation that is exact in double changes no bit. A's rotation is inverted, not transposed. The errors of both rotations
/// add up, so that two legal ones, rounded to single precision, may have a relative one that is InvalidPose; rotations made of
/// quaternions that are normalised in double are orthonormal to 1e-15.
Pose relative(const Pose& a_in_world, const Pose& b_in_world);

/// Returns the pose that undoes `pose`; its rotation is the matrix inverse of `pose.rotation`.
Pose inverse(const Pose& pose);

}  // namespace swiftlet
