// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A binary tree of convex hulls over a surface, its faces told apart by where they lie [Ehmann & Lin 2001, sec. 5].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <swiftlet/body.h>
#include <swiftlet/march.h>
#include <swiftlet/model.h>

#include "shapes.h"

namespace hull_tree {

/// What lies behind a face, weakest first: the kernel gives an edge the largest tag beside it, here the class of most pruning
/// power.
enum Tag : std::uint8_t {
  Free,       ///< made by an inner node's hull: no piece reaches it, but where they meet its border
  Contained,  ///< made by a leaf's hull: inside the solid
  Original,   ///< the surface
};

struct Node {
  swiftlet::Model model;
  std::vector<std::uint8_t> tags;
  swiftlet::ConvexView view;            ///< the model's, with the tags
  std::vector<std::uint32_t> point;     ///< of the mesh, per vertex
  std::vector<std::uint32_t> triangle;  ///< of the mesh, per triangle that the model's source map names
  std::array<std::uint32_t, 2> child{swiftlet::kNone, swiftlet::kNone};
  std::array<std::vector<std::uint32_t>, 2> vertex_in_child;  ///< per vertex; kNone where the child lacks it
  bool is_leaf() const { return child[0] == swiftlet::kNone; }
};

/// Leaf k is the hull of patch k. The root is the last node.
struct Tree {
  std::vector<Node> nodes;
  std::uint32_t leaf_count = 0;
  double size = 0;  ///< largest absolute coordinate
  std::uint32_t root() const { return std::uint32_t(nodes.size()) - 1; }
};
/// Law 2's bound for two whole bodies.
inline double tolerance(const Tree& a, const Tree& b, const Pose& b_in_a) {
  return swiftlet::tolerance(a.nodes[a.root()].model, b.nodes[b.root()].model, b_in_a);
}

Tree hull_tree_of(const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& patches);

/// The tag of a witness feature. Every vertex of every node is one of the mesh's.
inline std::uint8_t tag_of(const Node& node, swiftlet::FeatureId feature) {
  return feature.kind() == swiftlet::FeatureKind::Vertex ? std::uint8_t(Original) : tag(node.view, feature);
}

/// The vertices of a feature.
std::vector<std::uint32_t> corners(const swiftlet::ConvexView& view, swiftlet::FeatureId feature);
/// The distance of a point of A's frame from a feature of a node that stands there.
double off_feature(const Node& node, swiftlet::FeatureId feature, const Pose& node_in_a, const Vec3& p_a);

}  // namespace hull_tree
