// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Branch and bound, the child of the lesser bound first.
#include "plane_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "numeric/exact.h"

namespace swiftlet::lod {
namespace {

constexpr std::uint32_t kLeaf = 4;  ///< planes
/// Of a bound on depths and of a depth, over the largest coordinate of the points: each is a sum of some ten products of at
/// most twice that.
constexpr double kDepthError = 64 * 0x1p-53;

}  // namespace

void PlaneTree::make() {
  for (const Vec3& p : body_.points) {
    origin_ += p / double(body_.points.size());
    size_ = std::max(size_, p.cwiseAbs().maxCoeff());
  }
  planes_.reserve(body_.triangles.size());
  for (const auto& [a, b, c] : body_.triangles) {
    const Vec3& corner = body_.points[a];
    const Vec3 normal = eigen(exact::plane(vec(corner), vec(body_.points[b]), vec(body_.points[c])).normal);
    planes_.push_back({normal, corner, normal.dot(corner - origin_)});
  }
  nodes_.reserve(planes_.size());
  make_node(0, std::uint32_t(planes_.size()));
}

std::uint32_t PlaneTree::make_node(std::uint32_t begin, std::uint32_t end) {
  const auto at = std::uint32_t(nodes_.size());
  Node node{planes_[begin].normal, planes_[begin].normal, planes_[begin].height, begin, end, 0};
  double most_height = node.least_height;
  for (std::uint32_t i = begin; i < end; ++i) {
    node.least_normal = node.least_normal.cwiseMin(planes_[i].normal);
    node.most_normal = node.most_normal.cwiseMax(planes_[i].normal);
    node.least_height = std::min(node.least_height, planes_[i].height);
    most_height = std::max(most_height, planes_[i].height);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return at;
  // What a box leaves open of a depth is its width along a normal's coordinate times one of the point, or along the height.
  int axis = 0;
  const double width = (node.most_normal - node.least_normal).maxCoeff(&axis) * size_;
  const bool by_height = most_height - node.least_height > width;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      planes_.begin() + begin, planes_.begin() + middle, planes_.begin() + end,
      [&](const Plane& p, const Plane& q) { return by_height ? p.height < q.height : p.normal[axis] < q.normal[axis]; });
  make_node(begin, middle);
  const std::uint32_t second = make_node(middle, end);
  nodes_[at].second = second;
  return at;
}

double PlaneTree::least_depth(const Node& node, const Vec3& p) const {
  const Vec3 at = p - origin_;
  const double highest = node.least_normal.cwiseProduct(at).cwiseMax(node.most_normal.cwiseProduct(at)).sum();
  return node.least_height - highest - kDepthError * std::max(size_, p.cwiseAbs().maxCoeff());
}

void PlaneTree::descend(std::uint32_t index, const Vec3& p, double enough, double& least) {
  const Node& node = nodes_[index];
  if (node.second == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      ++looked_at_;
      if (const double depth = planes_[i].normal.dot(planes_[i].corner - p); depth < least) least = depth, last_ = i;
    }
    return;
  }
  std::array<std::pair<double, std::uint32_t>, 2> children{
      {{least_depth(nodes_[index + 1], p), index + 1}, {least_depth(nodes_[node.second], p), node.second}}};
  looked_at_ += 2;
  if (children[1].first < children[0].first) std::swap(children[0], children[1]);
  for (const auto& [bound, child] : children)
    if (least > enough && bound < least) descend(child, p, enough, least);
}

double PlaneTree::depth(const Vec3& p, double enough) {
  if (planes_.empty()) make();
  ++looked_at_;
  double least = planes_[last_].normal.dot(planes_[last_].corner - p);
  if (least > enough) descend(0, p, enough, least);
  return least;
}

}  // namespace swiftlet::lod
