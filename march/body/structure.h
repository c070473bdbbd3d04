// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Checks that the arrays of a level from an untrusted source are safe to walk over. Knows nothing of their layout in a file and
// proves no geometry.
#pragma once

#include <cstddef>
#include <string>

#include <swiftlet/model.h>

namespace swiftlet {

// Each function returns an error text, or an empty string if all is well.

/// Checks that rings, twins and face loops fit together, so that every walk over them stays inside and every loop closes. Only
/// a point and a segment have no faces.
std::string topology_fault(const ConvexView& view);
/// Checks that face normals have length 1 up to `kUnitNormalError` and no coordinate too small for exact heights, and that
/// thicknesses and heights are finite and not negative.
std::string plane_fault(const ConvexView& view);
/// Checks that the rims are what ConvexView and `kRimDrop` say. Requires that topology and planes are without fault.
std::string rim_fault(const ConvexView& view);
/// Checks that children and parents exist, given the numbers of vertices and faces of the finer and the coarser level.
std::string link_fault(const Level& level, std::size_t finer_vertices, std::size_t finer_faces, std::size_t coarser_vertices);

}  // namespace swiftlet
