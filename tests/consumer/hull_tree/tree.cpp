// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "patches.h"
#include "triangles.h"

namespace hull_tree {
namespace {

using swiftlet::FeatureKind;
using Ids = std::vector<std::uint32_t>;

/// The mesh's points around a face, sorted: what a face of a node and one of its child have in common if they are the same.
Ids border(const Node& node, std::uint32_t face) {
  Ids points;
  for (const std::uint32_t v : corners(node.view, face)) points.push_back(node.point[v]);
  std::ranges::sort(points);
  return points;
}

/// The mesh's triangles in a face.
Ids triangles_in(const Node& node, std::uint32_t face) {
  const swiftlet::SourceMap source = node.model.source();
  Ids triangles;
  for (std::uint32_t k = source.face_begin[face]; k < source.face_begin[face + 1]; ++k)
    triangles.push_back(node.triangle[source.face[k]]);
  return triangles;
}

class Construction {
 public:
  Construction(const Mesh& mesh, const std::vector<Ids>& patches) : mesh_(mesh) {
    for (const Ids& patch : patches) {
      tree_.nodes.push_back(node_of(hull_of(mesh, patch), Contained, {}));
      tree_.size = std::max(tree_.size, tree_.nodes.back().model.extent());
    }
    tree_.leaf_count = std::uint32_t(patches.size());
  }

  Tree finished() {
    Ids leaves(tree_.leaf_count);
    for (std::uint32_t k = 0; k < tree_.leaf_count; ++k) leaves[k] = k;
    construct(leaves);
    return std::move(tree_);
  }

 private:
  /// Algorithm 1 of the paper.
  std::uint32_t construct(const Ids& leaves) {
    if (leaves.size() == 1) return leaves[0];
    auto [lower, upper] = split(leaves);
    const std::uint32_t left = construct(lower), right = construct(upper);
    std::set<std::uint32_t> points, triangles;
    std::map<Ids, std::uint8_t> known;
    for (const std::uint32_t child : {left, right}) {
      const Node& node = tree_.nodes[child];
      points.insert(node.point.begin(), node.point.end());
      for (std::uint32_t f = 0; f < node.tags.size(); ++f) {
        const Ids in_face = triangles_in(node, f);
        triangles.insert(in_face.begin(), in_face.end());
        known[border(node, f)] = node.tags[f];
      }
    }
    Node node = node_of(hull_of(mesh_, {triangles.begin(), triangles.end()}, {points.begin(), points.end()}), Free, known);
    node.child = {left, right};
    for (std::size_t side = 0; side < 2; ++side) {
      const Ids& there = tree_.nodes[node.child[side]].point;
      for (const std::uint32_t p : node.point) {
        const auto at = std::ranges::find(there, p);
        node.vertex_in_child[side].push_back(at == there.end() ? swiftlet::kNone : std::uint32_t(at - there.begin()));
      }
    }
    tree_.nodes.push_back(std::move(node));
    return tree_.root();
  }

  /// A face that the surface covers is the surface's, one that a child has keeps its tag, others are `made`. A face is a whole
  /// polygon: where the surface covers a part of it, it is made.
  Node node_of(PartialHull hull, Tag made, const std::map<Ids, std::uint8_t>& known) {
    Node node{
        std::move(hull.model), {}, {}, std::move(hull.point), std::move(hull.triangle), {swiftlet::kNone, swiftlet::kNone}, {}};
    node.view = node.model.level(0).view;
    for (std::uint32_t f = 0; f < node.view.face_first.size(); ++f) {
      double covered = 0;
      for (const std::uint32_t t : triangles_in(node, f)) covered += area(mesh_, t);
      const auto same = known.find(border(node, f));
      node.tags.push_back(covered >= (1 - 1e-9) * area(node.view, f) ? std::uint8_t(Original)
                          : same != known.end()                      ? same->second
                                                                     : std::uint8_t(made));
    }
    node.view.tags = node.tags;
    return node;
  }

  /// At the midpoint of the leaves' centres along the coordinate in which they spread most; the paper takes the axis of their
  /// greatest variance.
  std::pair<Ids, Ids> split(const Ids& leaves) const {
    const auto centre = [&](std::uint32_t leaf) { return tree_.nodes[leaf].model.centre(); };
    Vec3 least = centre(leaves[0]), most = least;
    for (const std::uint32_t leaf : leaves) least = least.cwiseMin(centre(leaf)), most = most.cwiseMax(centre(leaf));
    Eigen::Index axis;
    (most - least).maxCoeff(&axis);
    const double middle = (least[axis] + most[axis]) / 2;
    Ids sorted = leaves;
    std::ranges::sort(sorted, {}, [&](std::uint32_t leaf) { return centre(leaf)[axis]; });
    auto first = std::ranges::find_if(sorted, [&](std::uint32_t leaf) { return centre(leaf)[axis] > middle; });
    if (first == sorted.begin() || first == sorted.end()) first = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    return {{sorted.begin(), first}, {first, sorted.end()}};
  }

  const Mesh& mesh_;
  Tree tree_;
};

}  // namespace

Tree hull_tree_of(const Mesh& mesh, const std::vector<Ids>& patches) { return Construction(mesh, patches).finished(); }

Ids corners(const swiftlet::ConvexView& view, swiftlet::FeatureId feature) {
  const std::uint32_t i = feature.index();
  switch (feature.kind()) {
    case FeatureKind::Vertex: return {i};
    case FeatureKind::Edge: return {view.half_edges[view.half_edges[i].twin].head, view.half_edges[i].head};
    case FeatureKind::Face: return corners(view, i);
    default: return {};
  }
}

double off_feature(const Node& node, swiftlet::FeatureId feature, const Pose& node_in_a, const Vec3& p_a) {
  std::vector<Vec3> loop;
  for (const std::uint32_t v : corners(node.view, feature)) {
    const swiftlet::Vertex& at = node.view.vertices[v];
    loop.push_back(node_in_a.rotation * Vec3(at.x, at.y, at.z) + node_in_a.translation);
  }
  if (loop.size() == 1) return (p_a - loop[0]).norm();
  if (loop.size() == 2) return distance(p_a, loop[0], loop[1]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 2; k < loop.size(); ++k) least = std::min(least, distance(p_a, Triangle{loop[0], loop[k - 1], loop[k]}));
  return least;
}

}  // namespace hull_tree
