// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One level as the faces a viewer wants. Knows the half-edges, nothing of files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet::tool {

/// The faces of the exact hull, where a diagonal counts as an edge: loops of half-edges, counter-clockwise seen from outside.
std::vector<std::vector<std::uint32_t>> facets(const ConvexView& view);

/// OFF with seventeen digits, so that every double reads back bit for bit. Its faces are `facets`: exactly convex.
std::string off_text(const ConvexView& view);

}  // namespace swiftlet::tool
