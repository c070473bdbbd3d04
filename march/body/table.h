// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Fills the tables that cold queries start from: which vertex for which direction. Knows lut and vertices.
#pragma once

#include <span>
#include <string>

#include <swiftlet/model.h>

#include "body/block.h"

namespace swiftlet {

/// What is wrong with a table and maps as somebody asks for them; empty: nothing.
std::string spec_fault(const TableSpec& spec);

/// The vertex nearest to each sample point, radius_factor bounding radii from the centre [Ehmann & Lin 2000, sec. 4.6], by
/// brute force; ties go to the lowest index. Cost: samples x vertices. Sets header.resolution, header.radius_factor and
/// `table`.
void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices);

/// The support maps of all levels, given finest first, by brute force: the vertex extreme at the middle of each cell, and the
/// most that any other exceeds it by over the cell. Cost: cells x vertices. Sets the headers' map_side and `maps`.
void fill_maps(BlockParts& parts, const TableSpec& spec, std::span<const std::span<const Vertex>> levels);

}  // namespace swiftlet
