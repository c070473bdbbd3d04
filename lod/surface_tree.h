// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A tree over a surface's triangles, to find those that may enter what a hull gains (wedge.h). Triangles around a vertex of
// many meet all that touches this vertex: they have a tree of their own, which also knows where they lie as seen from there, so
// that those that meet a wedge in the vertex alone are left out together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh_block.h"
#include "wedge.h"

namespace swiftlet::lod {

class SurfaceTree {
 public:
  /// `open`: per triangle, the surface ends at one of its edges. Both must outlive the constructor, the mesh the tree.
  SurfaceTree(const MeshReader::Content& mesh, const std::vector<bool>& open);

  /// Calls `is_entered(triangle, i)` for triangles and wedges, by their index, that may meet, until it returns true; then so
  /// does this. What is left out meets the wedge in no more than a corner on the new hull's boundary or, of a flat wedge, lies
  /// in its plane and is not open.
  template <class W, class IsEntered>
  bool any(std::span<const W> wedges, const std::vector<Outline>& outlines, const IsEntered& is_entered) {
    active_.clear();
    for (std::uint32_t i = 0; i < wedges.size(); ++i) active_.push_back(i);
    return any_below(0, 0, wedges, outlines, is_entered);
  }

 private:
  struct Box {
    Vec least{HUGE_VAL, HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    void add(const Vec& p);
  };
  /// Children are the node after it and `right`; 0 of a leaf, which has the triangles order_[begin .. end).
  struct Node {
    Box box, around;  ///< `around`: of what has a hub, without it
    std::uint32_t begin, end, right = 0;
    std::uint32_t hub = kNone;  ///< a corner of all triangles
    bool is_flat = false;       ///< all of them lie in the plane of `plane`, and none is open
    std::uint32_t plane = 0;    ///< a triangle whose corners lie on no line
    bool is_ring = false;       ///< all corners but the hub lie in the plane of three of them, `ring`, and the hub does not
    std::array<std::uint32_t, 3> ring{};
  };

  static constexpr std::uint32_t kHub = 32;  ///< a vertex of more triangles than that is one
  static constexpr std::uint32_t kInLeaf = 4;

  std::uint32_t grow(std::uint32_t begin, std::uint32_t end, const Node& parent, const std::vector<bool>& open);
  void find_plane(Node& node, const std::vector<bool>& open) const;
  void find_ring(Node& node) const;
  const Vec& corner(std::uint32_t triangle, std::size_t k) const { return mesh_.vertices[mesh_.triangles[triangle][k]]; }

  /// True if nothing of a node but what is around its hub is in the wedge's plane, and that is apart from the wedge.
  bool is_ring_apart(const Node&, const Wedge&, const Outline&) const { return false; }
  bool is_ring_apart(const Node& node, const FlatWedge& wedge, const Outline& outline) const {
    const auto at = [&](std::size_t k) { return mesh_.vertices[node.ring[k]]; };
    return outline.is_apart(eigen(node.around.least), eigen(node.around.most)) && is_parted(wedge, {at(0), at(1), at(2)});
  }
  /// True if a wedge lies on one side of a plane and meets it in no more than the new hull's boundary; a flat one, if it lies
  /// in the plane.
  static bool is_parted(const Wedge& wedge, const Corners3& plane);
  static bool is_parted(const FlatWedge& wedge, const Corners3& plane);

  template <class W>
  bool is_apart(const Node& node, const W& wedge, const Outline& outline) const {
    if (outline.is_apart(eigen(node.box.least), eigen(node.box.most))) return true;
    if (node.hub != kNone && outline.is_apart_around(mesh_.vertices[node.hub], node.around.least, node.around.most))
      return true;
    if (node.is_ring && is_ring_apart(node, wedge, outline)) return true;
    return node.is_flat && node.end - node.begin > kInLeaf &&
           is_parted(wedge, {corner(node.plane, 0), corner(node.plane, 1), corner(node.plane, 2)});
  }

  /// Wedges that are not yet known to be apart are active_[first ..].
  template <class W, class IsEntered>
  bool any_below(std::uint32_t index, std::size_t first, std::span<const W> wedges, const std::vector<Outline>& outlines,
                 const IsEntered& is_entered) {
    const Node& node = nodes_[index];
    const std::size_t end = active_.size();
    for (std::size_t i = first; i < end; ++i) {
      if (!is_apart(node, wedges[active_[i]], outlines[active_[i]])) active_.push_back(active_[i]);
    }
    bool found = false;
    if (active_.size() > end) {
      if (node.right != 0) {
        found =
            any_below(index + 1, end, wedges, outlines, is_entered) || any_below(node.right, end, wedges, outlines, is_entered);
      } else {
        for (std::uint32_t t = node.begin; t < node.end && !found; ++t) {
          for (std::size_t i = end; i < active_.size() && !found; ++i) found = is_entered(order_[t], active_[i]);
        }
      }
    }
    active_.resize(end);
    return found;
  }

  const MeshReader::Content& mesh_;
  std::vector<std::uint32_t> hub_of_;  ///< per triangle, or kNone
  std::vector<std::uint32_t> order_;
  std::vector<Vec> place_;  ///< per triangle: what is cut
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> active_;
};

}  // namespace swiftlet::lod
