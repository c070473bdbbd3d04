// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A model as a picture. Knows geometry and SVG, nothing of files.
#pragma once

#include <string>

#include <swiftlet/model.h>

namespace swiftlet::tool {

/// An SVG of all levels side by side, finest first: orthographic, seen from the front, the right and a little above, z up, all
/// to one scale. Over each coarser level lies the outline of level 0. Cost: about 40 bytes per triangle.
std::string draw(const Model& model, const std::string& title);

}  // namespace swiftlet::tool
