// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A layer of one's own over the atomic kernel, on the installed headers: a bracket is two boxes below their hull, whose faces
// carry tags. A march on the hulls answers where nearest features are the bracket's own, else marches on the boxes do. The
// product's layers answer the same questions about the same bodies. Ends with 1 where two answers differ.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include <swiftlet/build_hull_tree.h>
#include <swiftlet/march.h>
#include <swiftlet/mesh_query.h>

namespace {

using swiftlet::ConvexView;
using swiftlet::MarchResult;
using swiftlet::MarchRule;
using swiftlet::MarchStart;
using swiftlet::MarchStatus;
using swiftlet::Model;
using swiftlet::Pose;
using Outline = std::vector<std::array<double, 2>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The prism of height 1 over an outline, counter-clockwise: its two caps, then a side for each edge.
Model prism(const Outline& outline) {
  std::vector<swiftlet::Vec3> points;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) points.emplace_back(x, y, z);
  const auto n = std::uint32_t(outline.size());
  std::vector<std::uint32_t> corners, sizes{n, n};
  for (std::uint32_t i = n; i-- > 0;) corners.push_back(i);
  for (std::uint32_t i = 0; i < n; ++i) corners.push_back(n + i);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    corners.insert(corners.end(), {i, j, n + j, n + i}), sizes.push_back(4);
  }
  swiftlet::LevelArrays arrays;
  arrays.vertices = points, arrays.face_vertices = corners, arrays.face_sizes = sizes;
  return Model::from_level(arrays).value();
}

struct Bracket {
  Model hull = prism({{0, 0}, {3, 0}, {3, 1}, {1, 3}, {0, 3}});
  std::array<Model, 2> boxes{prism({{0, 0}, {3, 0}, {3, 1}, {0, 1}}), prism({{0, 0}, {1, 0}, {1, 3}, {0, 3}})};
  std::vector<std::uint8_t> tags = std::vector<std::uint8_t>(7, 1);  ///< 1: the bracket's own
  ConvexView root = hull.level(0).view;

  Bracket() {
    // The caps, and the side across the corner, are more than the boxes have. A model keeps faces in an order of its own.
    const swiftlet::SourceMap source = hull.source();
    for (std::size_t face = 0; face < tags.size(); ++face) {
      const std::uint32_t given = source.face[source.face_begin[face]];
      if (given == 0 || given == 1 || given == 4) tags[face] = 0;
    }
    root.tags = tags;
  }
  bool owns(swiftlet::FeatureId feature) const {
    return feature.kind() == swiftlet::FeatureKind::Vertex || swiftlet::tag(root, feature) == 1;
  }
};

/// A pair of nodes and the features where its last march ended.
struct Item {
  const ConvexView &a, &b;
  MarchStart start{};
};

std::uint64_t steps = 0;

MarchResult visit(Item& item, const Pose& b_in_a, MarchRule rule) {
  rule.step_budget = 4;
  MarchResult r;
  do {
    r = march(item.a, item.b, b_in_a, item.start, rule);
    item.start = {r.a, r.b};
    rule.floor = r.lower;
    steps += r.steps;
    rule.step_budget *= 2;  // a circle is known by its length: by as few steps again it would not be
  } while (r.status == MarchStatus::Budget);
  return r;
}

/// The distance of two brackets, and whether the hulls alone told it.
double distance(const Bracket& a, const Bracket& b, const Pose& b_in_a, bool& by_hulls) {
  Item roots{a.root, b.root};
  MarchRule rule;
  const MarchResult r = visit(roots, b_in_a, rule);
  by_hulls = r.status != MarchStatus::Overlapping && a.owns(r.a) && b.owns(r.b);
  if (by_hulls) return r.upper;
  double least = kInfinity;
  rule.floor = r.lower;  // no boxes are nearer than the hulls
  for (const Model& of_a : a.boxes) {
    for (const Model& of_b : b.boxes) {
      Item boxes{of_a.level(0).view, of_b.level(0).view};
      rule.beyond = least;  // a pair that is farther ends with Beyond
      const MarchResult pair = visit(boxes, b_in_a, rule);
      if (pair.status != MarchStatus::Beyond && pair.upper < least) least = pair.upper;
    }
  }
  return least;
}

/// The bracket's surface, as a mesh.
swiftlet::MeshModel mesh() {
  const Outline outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<swiftlet::Vec3> points;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) points.emplace_back(x, y, z);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    triangles.push_back({i, j, j + 6}), triangles.push_back({i, j + 6, i + 6});
  }
  // The caps from the inner corner, which sees all others.
  for (std::uint32_t i = 4; i < 8; ++i) {
    triangles.push_back({3, (i + 1) % 6, i % 6}), triangles.push_back({9, i % 6 + 6, (i + 1) % 6 + 6});
  }
  return swiftlet::MeshModel::from_triangles(points, triangles).value();
}

}  // namespace

int main() {
  const Bracket bracket;
  const swiftlet::MeshModel surface = mesh();
  const auto patches = swiftlet::decompose(surface);
  if (!patches) return std::puts(patches.error().message.c_str()), 1;
  const auto tree = swiftlet::build_hull_tree(surface, patches.value());
  if (!tree) return std::puts(tree.error().message.c_str()), 1;
  swiftlet::HullPair pair(tree.value(), tree.value(), {.piece_caching = true, .priority = true, .front = true});

  int wrong = 0, by_hulls = 0, poses = 0;
  for (int k = 0; k < 200; ++k, ++poses) {
    // Turned about z by a rational angle, and moved around through the opening of the other one.
    const double t = k / 100.0 - 1, w = 1 + t * t;
    Pose pose;
    pose.rotation << (1 - t * t) / w, -2 * t / w, 0, 2 * t / w, (1 - t * t) / w, 0, 0, 0, 1;
    pose.translation = {1.5 + 2.5 * t, 1.25 + 0.01 * (k % 50), 0.02 * (k % 7)};
    bool told = false;
    const double ours = distance(bracket, bracket, pose, told), by_mesh = swiftlet::distance(surface, surface, pose).upper,
                 by_tree = pair.distance(pose).answer.upper;
    by_hulls += told;
    if (std::fabs(ours - by_mesh) > 1e-12 || std::fabs(ours - by_tree) > 1e-12) {
      std::printf("pose %d: %.17g by boxes, %.17g by the mesh, %.17g by SWIFT++\n", k, ours, by_mesh, by_tree);
      ++wrong;
    }
  }
  std::printf("%d poses, %d told by the hulls, %llu steps; %d answers differ\n", poses, by_hulls,
              static_cast<unsigned long long>(steps), wrong);
  return wrong == 0 && by_hulls > 0 && by_hulls < poses ? 0 : 1;
}
