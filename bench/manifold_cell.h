// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contact manifolds beside each other: two bodies, poses of one on the other, who is asked, and how true the points are.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "manifolds.h"
#include "rig.h"

namespace swiftlet::bench {

struct ManifoldCell {
  std::string name;
  Model a, b;
  std::vector<Pose> poses;
};

/// An upright prism of so many sides; of 4 a cube.
Model prism(std::uint32_t sides);
/// Two equal prisms, one on the other and so deep in it, turning and sliding about by 0.1 degrees a pose.
ManifoldCell stacked(const Model& prism, double depth, std::uint32_t poses);

/// Cubes, prisms of 12 to 1 000 sides, and ellipsoids of 2 000 triangles, a millionth of a unit and a hundredth deep.
std::vector<ManifoldCell> manifold_cells(const Shelf& shelf, std::uint32_t poses);

/// Every method coherent and cold, in rounds that alternate; times are medians. Of a row `error` is the farthest that a point
/// lies off the surface that it is said to lie on, over the radius, `wrong` counts points that are outside their body by more
/// than a millionth of that, `failed` queries without a point, and `steps` is the number of points per query.
std::vector<Row> measure(const ManifoldCell& cell, int rounds);

}  // namespace swiftlet::bench
