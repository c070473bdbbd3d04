// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The truth: distances by brute force over all pairs of triangles, in doubles, without swiftlet's kernel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shapes.h"

namespace hull_tree {

using Triangle = std::array<Vec3, 3>;

double distance(const Vec3& p, const Vec3& a, const Vec3& b);  ///< from the segment a b
double distance(const Vec3& p, const Triangle& t);
double distance(const Triangle& a, const Triangle& b);  ///< 0 where they cross

/// A mesh as triangles with a ball around each.
struct Soup {
  std::vector<Triangle> triangles;
  std::vector<Vec3> centre;
  std::vector<double> radius;
};
Soup soup(const Mesh& mesh, const Pose& pose = {});

/// Over all pairs; those whose balls are farther apart than the best are not measured.
double distance(const Soup& a, const Soup& b);

/// Per pair of patches the distance of their triangles where that is at most `most`, else infinity; [patch of a * patches of b
/// + patch of b].
std::vector<double> patch_distances(const Soup& a, const Soup& b, const std::vector<std::uint32_t>& patch_a,
                                    const std::vector<std::uint32_t>& patch_b, std::uint32_t patches_a, std::uint32_t patches_b,
                                    double most);

}  // namespace hull_tree
