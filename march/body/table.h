// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Fills the tables that cold queries start from, which name a vertex for each direction. Knows lut and vertices.
#pragma once

#include <array>
#include <span>
#include <string>

#include <swiftlet/model.h>

#include "body/block.h"
#include "numeric/vec.h"

namespace swiftlet {

/// An error text if `spec` asks for a table or maps out of range, else empty.
std::string spec_fault(const TableSpec& spec);

/// Finds by brute force the vertex nearest to each sample point, which lies `radius_factor` bounding radii from the centre
/// [Ehmann & Lin 2000, sec. 4.6]; ties go to the lowest index. Cost: samples x vertices. Sets `header.resolution`,
/// `header.radius_factor` and `table`.
void fill_table(BlockParts& parts, const TableSpec& spec, std::span<const Vertex> vertices, const Executor& executor = {});

/// Fills the support maps of `levels`, given finest first: for each cell the support vertex of its middle, and the most by
/// which any other vertex is higher over the cell; and the ellipsoids of level 0, if that is given. Cost: a climb per cell and
/// corner, mostly of one ring. Sets `maps` and what the headers say of them.
void fill_maps(BlockParts& parts, const TableSpec& spec, std::span<const ConvexView> levels, const Executor& executor = {});

/// A bound on how much `above` rises along a direction whose image by the map frame is a corner of a cell, and of which `n` is
/// a rounded multiple. `above` leads from a vertex to the highest.
double excess_at(const std::array<double, 6>& frame, const Vec& n, const Vec& above);

}  // namespace swiftlet
