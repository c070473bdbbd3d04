// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The distance of two hulls far beyond what doubles tell, by brute force. Knows vertices and poses; nothing of methods or
// marches.
#pragma once

#include <optional>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::bench {

/// The distance of the stored vertices' hulls under the stored pose, in 64 bits of mantissa: right to 1e-17 of what the
/// coordinates are, near contact to 1e-15. None where they overlap, or touch nearly.
std::optional<long double> nearest(const ConvexView& a, const ConvexView& b, const Pose& b_in_a);

}  // namespace swiftlet::bench
