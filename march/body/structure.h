// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the arrays of a level, whoever wrote them, are safe to walk over. Knows nothing of their layout, believes no
// geometry.
#pragma once

#include <cstddef>
#include <string>

#include <swiftlet/model.h>

namespace swiftlet {

// Each returns what does not fit, or nothing.

/// Whether rings, twins and face loops fit together, so that every walk over them stays inside and every loop closes.
std::string topology_fault(const ConvexView& view);
/// Whether normals are of length 1 and thicknesses numbers.
std::string plane_fault(const ConvexView& view);
/// Whether children and parents exist: the levels beside have so many vertices and faces.
std::string link_fault(const Level& level, std::size_t finer_vertices, std::size_t finer_faces, std::size_t coarser_vertices);

}  // namespace swiftlet
