// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Polygons of mesh files as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet::lod {

/// Adds two triangles fewer than the polygon has corners, wound as it is: a fan from its first corner or, where that would
/// reach out of it, since it is concave, a constrained Delaunay triangulation. A polygon that crosses or touches itself, seen
/// along its normal, becomes a fan.
void triangulate(std::span<const Vec3> points, std::span<const std::uint64_t> polygon,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace swiftlet::lod
