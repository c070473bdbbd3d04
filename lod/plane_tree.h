// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How deep points are below the planes of a solid. Knows nothing of meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "polytope.h"

namespace swiftlet::lod {

/// The planes of a solid's triangles, in a tree of boxes around their normals and heights. A point that is about as far from
/// all triangles has no nearest one that a tree of triangles would find without looking at most; its depths below planes differ
/// by the angle to their normals, which this tree bounds. Made when it is first asked.
class PlaneTree {
 public:
  /// Keeps a reference to the body.
  explicit PlaneTree(const Polytope& body) : body_(body) {}

  /// The least depth of `p` below any plane, which is its distance from the surface if it is inside; or any depth that is at
  /// most `enough`. Depths are right to rounding, however thin the triangles; the least does not depend on what was asked
  /// before.
  double depth(const Vec3& p, double enough);

  /// How many planes and boxes have been looked at.
  std::uint64_t looked_at() const { return looked_at_; }

 private:
  struct Plane {
    Vec3 normal, corner;
    double height;  ///< above `origin_`, in doubles
  };
  struct Node {
    Vec3 least_normal, most_normal;
    double least_height;
    std::uint32_t begin, end;  ///< of the planes
    std::uint32_t second;      ///< the second child, after the first; 0 in a leaf
  };

  void make();
  std::uint32_t make_node(std::uint32_t begin, std::uint32_t end);
  /// No more than the depth, computed as that of a plane is, below any plane of the node.
  double least_depth(const Node& node, const Vec3& p) const;
  void descend(std::uint32_t node, const Vec3& p, double enough, double& least);

  const Polytope& body_;
  Vec3 origin_ = Vec3::Zero();
  double size_ = 0;  ///< the largest coordinate
  std::vector<Plane> planes_;
  std::vector<Node> nodes_;
  std::uint32_t last_ = 0;  ///< the plane that was the lowest for the last point
  std::uint64_t looked_at_ = 0;
};

}  // namespace swiftlet::lod
