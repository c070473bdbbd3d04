// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The vertex of a body that is farthest in a direction, found by a climb over its edges and proved by exact signs.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>

#include "numeric/vec.h"

namespace swiftlet {

/// The vertex farthest along n, climbed to from `start`: no vertex is farther. `plane_tests` grows by the neighbours compared.
std::uint32_t support(const ConvexView& view, const Vec& n, std::uint32_t start, std::uint32_t& plane_tests);
/// Likewise of a body that a pose carries into the common frame, where n is.
std::uint32_t support(const ConvexView& view, const Motion& in_common, const Vec& n, std::uint32_t start,
                      std::uint32_t& plane_tests);

/// The same in doubles, where nothing needs to be proved: a vertex that looks the highest along a direction of the body's own.
/// Every vertex has one height, rounded: none comes twice.
std::uint32_t ascend(const ConvexView& view, const Vec& own, std::uint32_t start, std::uint32_t& plane_tests);

}  // namespace swiftlet
