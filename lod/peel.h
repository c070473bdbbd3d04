// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Simplification by removing independent vertices [Ehmann & Lin 2000, sec. 4.4.1]. Knows nothing of enclosing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polytope.h"

namespace swiftlet::lod {

/// Per vertex, the sum over its edges of 1 - cos(dihedral angle): 3 at a cube's corner, 8/3 at an octahedron's.
std::vector<double> importances(const Polytope& body);

/// Vertices of which no two are neighbours, least important first (equal ones: the lower index), at most `most`. Only those of
/// importance <= 1, as the paper has it (SWIFT's source: < 1); where these are fewer than one in twenty, the bound is doubled
/// until it is enough or bounds nothing, for else the hierarchy of a sphere stalls at 24 triangles and a cube's never begins.
std::vector<std::uint32_t> independent_set(const Polytope& body, std::size_t most);

/// For each triangle of `coarse`, whose corners are vertices of `fine`: the removed vertex whose hole the triangle fills, or
/// its first corner if it fills none [sec. 4.4.3].
std::vector<std::uint32_t> removed_above(const Polytope& fine, const std::vector<std::uint32_t>& removed,
                                         const std::vector<Triangle>& coarse);

}  // namespace swiftlet::lod
