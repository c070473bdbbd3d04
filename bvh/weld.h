// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From the user's points and triangles to a mesh whose vertices are all different, and what it is made of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <swiftlet/mesh.h>

#include "numeric/vec.h"

namespace swiftlet {

/// Triangles in the user's order over vertices that are all different.
struct Soup {
  std::vector<Vec> vertices;                            ///< in the order in which triangles first name them
  std::vector<std::uint32_t> source;                    ///< per vertex, the first of the user's points there
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices
  std::vector<std::uint32_t> shells;                    ///< per component, its first triangle
  MeshTopology topology;
};

/// A user's point as a vertex. Error: BadValue, which names the point.
Result<Vec> vertex_at(std::span<const Vec3> points, std::uint32_t point);

/// Sums up what corners say of triangles, taken in the user's order.
class CornerSums {
 public:
  void add(const Vec& a, const Vec& b, const Vec& c);
  /// Sets the number of flat triangles and, of a closed surface, the volume.
  void put(MeshTopology& topology) const;

 private:
  std::uint32_t flat_ = 0;
  std::optional<Vec> from_;  ///< the first corner: volumes are summed from it, so that none is as large as the mesh is far away
  double volume_ = 0;        ///< six times that
};

/// Fills in `topology` and `shells`. Returns, per triangle, the first one of its component.
std::vector<std::uint32_t> survey(Soup& soup);

/// Errors: Empty, BadValue (names the triangle or point), TooLarge.
Result<Soup> weld(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace swiftlet
