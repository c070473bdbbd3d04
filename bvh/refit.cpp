// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A mesh whose points have moved: its tree as it was, with boxes around its triangles where they are now, along new axes where
// the old ones no longer suit the surface.
#include <algorithm>
#include <cmath>
#include <string>

#include <swiftlet/mesh.h>

#include "fit.h"
#include "mesh_block.h"
#include "weld.h"

namespace swiftlet {
namespace {

/// The share of both variances that a covariance along a node's axes may reach, and the share of all moments that rounding
/// makes of it, before the node gets new axes.
constexpr double kSkewed = 0.25, kSkewOfRounding = 0x1p-20;

/// The moments of a surface: its area, twice; its middle; and its second moments around that, twice.
struct Moments {
  double weight = 0;
  Vec mean{0, 0, 0};
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();

  Moments() = default;
  Moments(const Vec& a, const Vec& b, const Vec& c)
      : weight(norm(cross(b - a, c - a))), mean(a + ((b - a) + (c - a)) * (1.0 / 3)) {
    for (const Vec& p : {a - mean, b - mean, c - mean}) square += weight / 12 * eigen(p) * eigen(p).transpose();
  }
  void add(const Moments& other) {
    if (!(other.weight > 0)) return;
    const Vec way = other.mean - mean;
    const double both = weight + other.weight, share = other.weight / both;
    square += other.square + weight * share * eigen(way) * eigen(way).transpose();
    mean = weight > 0 ? mean + way * share : other.mean, weight = both;
  }
  bool suit(const Axes& axes) const {
    double along[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) along[k][l] = eigen(axes.row[k]).dot(square * eigen(axes.row[l]));
    }
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      const double allowed = kSkewed * std::sqrt(max(along[k][k] * along[l][l], 0));
      if (std::fabs(along[k][l]) > max(allowed, kSkewOfRounding * square.trace())) return false;
    }
    return true;
  }
};

/// Puts boxes around the triangles below each node, whose corners are over the mesh's unit.
void fit_tree(std::span<const Vec> vertices, std::span<const Corners> triangles, std::vector<Node>& nodes) {
  const std::vector<TriangleRange> below = triangles_below(nodes);
  std::vector<Moments> moments(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    const std::uint32_t first = node.first(), count = std::uint32_t(node.count());
    for (std::uint32_t child = first; child < first + count; ++child) {
      const auto corner = [&](std::size_t k) { return vertices[triangles[child][k]]; };
      moments[i].add(node.lowest() ? Moments(corner(0), corner(1), corner(2)) : moments[child]);
    }
    if (moments[i].weight > 0 && !moments[i].suit(axes_of(node))) put_axes(principal_axes(moments[i].square), node);
    const Axes along = axes_of(node);
    Bounds boxes[kFanOut];
    for (std::uint32_t child = 0; child < count; ++child) {
      const std::uint32_t at = first + child;
      const TriangleRange range = node.lowest() ? TriangleRange{at, at + 1} : below[at];
      for (std::uint32_t t = range.begin; t < range.end; ++t) {
        for (const std::uint32_t v : triangles[t]) boxes[child].add(along.along(vertices[v]));
      }
    }
    put_boxes({boxes, count}, along, node);
  }
}

}  // namespace

Result<MeshModel> refit(const MeshModel& mesh, std::span<const Vec3> points) {
  const MeshReader::Content& content = MeshReader::content(mesh);
  if (!content.is_whole()) return Error{ErrorCode::BadValue, "the mesh was cut: it has no points to be moved"};
  MeshParts parts = MeshReader::parts(mesh);
  parts.hulls.clear();
  for (std::size_t v = 0; v < parts.vertices.size(); ++v) {
    const std::uint32_t point = parts.source_vertex[v];
    if (point >= points.size())
      return Error{ErrorCode::BadValue, "there are " + std::to_string(points.size()) +
                                            " points, and the mesh has one from point " + std::to_string(point)};
    const Result<Vec> moved = vertex_at(points, point);
    if (!moved) return moved.error();
    parts.vertices[v] = moved.value();
  }

  Bounds box;
  for (const Vec& v : parts.vertices) box.add(v);
  parts.box_min = {box.least[0], box.least[1], box.least[2]}, parts.box_max = {box.most[0], box.most[1], box.most[2]};
  parts.unit = unit_of(max(max_abs(parts.box_min), max_abs(parts.box_max)));
  std::vector<Vec> over_unit;
  over_unit.reserve(parts.vertices.size());
  for (const Vec& v : parts.vertices) over_unit.push_back(scaled(v, -parts.unit));
  fit_tree(over_unit, parts.triangles, parts.nodes);

  std::vector<std::uint32_t> at(parts.triangles.size());  // by the user's numbers, in whose order sums are made
  for (std::uint32_t t = 0; t < at.size(); ++t) at[parts.source_triangle[t]] = t;
  CornerSums sums;
  for (const std::uint32_t t : at) {
    const Corners& c = parts.triangles[t];
    sums.add(parts.vertices[c[0]], parts.vertices[c[1]], parts.vertices[c[2]]);
  }
  sums.put(parts.topology);
  return MeshReader::read(compose(parts));
}

}  // namespace swiftlet
