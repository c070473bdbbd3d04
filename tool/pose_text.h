// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Poses as a user types them. Knows nothing of models.
#pragma once

#include <string>

#include <swiftlet/pose.h>
#include <swiftlet/result.h>

namespace swiftlet::tool {

/// "x,y,z", or "x,y,z,qw,qx,qy,qz" with a quaternion of any length but 0, or the path of a file that holds the row-major 3x4
/// [R t], taken as it stands. Errors: CannotRead of a file; BadFormat of an empty one; BadValue of a text that is neither of
/// these, a number that is not finite, an R that is no rotation to 1e-6, and a t beyond 1e45.
Result<Pose> read_pose(const std::string& text);

}  // namespace swiftlet::tool
