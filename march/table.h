// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Fills a start table: which vertex for which direction. Knows lut and vertices.
#pragma once

#include <span>

#include <swiftlet/model.h>

#include "block.h"

namespace swiftlet {

/// The vertex nearest to each sample point, radius_factor bounding radii from the centre [Ehmann & Lin 2000, sec. 4.6], by
/// brute force; ties go to the lowest index. Cost: samples x vertices. Sets header.resolution, header.radius_factor and
/// `table`.
void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices);

}  // namespace swiftlet
