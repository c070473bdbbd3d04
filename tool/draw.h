// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models and meshes as pictures. Knows geometry and SVG, nothing of files.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <swiftlet/mesh.h>
#include <swiftlet/model.h>

namespace swiftlet::tool {

/// An SVG of all levels side by side, finest first: orthographic, seen from the front, the right and a little above, z up, all
/// to one scale. Over each coarser level lies the outline of the finest that is there. Cost: about 40 bytes per triangle.
std::string draw(const Model& model, const std::string& title);

/// An SVG of the mesh from there, each triangle over those that are farther away by their middles, from whichever side it is
/// seen. Of a mesh that was cut its lowest boxes instead. Cost: about 70 bytes per triangle, 250 per box.
std::string draw(const MeshModel& mesh, const std::string& title);

/// The same of a whole mesh whose triangles are in patches, given by number: each has a colour of its own.
std::string draw(const MeshModel& mesh, const std::string& title, std::span<const std::uint32_t> patch_of);

}  // namespace swiftlet::tool
