// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Cut in halves along the longest side of the box around triangles' middles. Triangles with a hub count as one place, the
// hub's, until all of a node are its own; then as their middles without it.
#include "surface_tree.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "numeric/exact.h"

namespace swiftlet::lod {
namespace {

double coordinate(const Vec& p, int k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }

/// Corners in common are the rule, and the exact sign of 0 is dear.
int side_of(const Corners3& plane, const Vec& p) {
  const auto is = [&](const Vec& q) { return q.x == p.x && q.y == p.y && q.z == p.z; };
  return std::ranges::any_of(plane, is) ? 0 : exact::orientation(plane[0], plane[1], plane[2], p);
}

}  // namespace

void SurfaceTree::Box::add(const Vec& p) {
  least = {min(least.x, p.x), min(least.y, p.y), min(least.z, p.z)};
  most = {max(most.x, p.x), max(most.y, p.y), max(most.z, p.z)};
}

SurfaceTree::SurfaceTree(const MeshReader::Content& mesh, const std::vector<bool>& open)
    : mesh_(mesh), hub_of_(mesh.triangles.size(), kNone), order_(mesh.triangles.size()) {
  std::vector<std::uint32_t> count(mesh.vertices.size());
  for (const auto& corners : mesh.triangles) {
    for (const std::uint32_t v : corners) ++count[v];
  }
  place_.reserve(order_.size());
  for (std::uint32_t t = 0; t < order_.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const std::uint32_t hub = *std::max_element(corners.begin(), corners.end(), [&](std::uint32_t v, std::uint32_t w) {
      return std::tuple(count[v], w) < std::tuple(count[w], v);
    });
    if (count[hub] > kHub) hub_of_[t] = hub;
    place_.push_back(count[hub] > kHub ? mesh.vertices[hub] : (corner(t, 0) + corner(t, 1) + corner(t, 2)) * (1.0 / 3));
  }
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(order_.size());
  grow(0, std::uint32_t(order_.size()), Node{}, open);
}

/// Notes whether all triangles lie in one plane.
void SurfaceTree::find_plane(Node& node, const std::vector<bool>& open) const {
  const auto points = [&](std::uint32_t t) { return Corners3{corner(t, 0), corner(t, 1), corner(t, 2)}; };
  std::uint32_t i = node.begin;
  const auto is_slit = [&](const Corners3& t) { return exact::collinear(&t[0].x, &t[1].x, &t[2].x); };
  while (i < node.end && is_slit(points(order_[i]))) ++i;
  if (i == node.end) return;
  const Corners3 plane = points(order_[i]);
  node.plane = order_[i];
  node.is_flat = std::all_of(order_.begin() + node.begin, order_.begin() + node.end, [&](std::uint32_t t) {
    return !open[t] && std::ranges::all_of(
                           points(t), [&](const Vec& p) { return exact::orientation(plane[0], plane[1], plane[2], p) == 0; });
  });
}

/// Notes whether all corners but the hub lie in one plane, which the hub does not.
void SurfaceTree::find_ring(Node& node) const {
  std::vector<std::uint32_t> ring;
  const auto at = [&](std::uint32_t v) { return mesh_.vertices[v]; };
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]]) {
      if (v == node.hub || (ring.size() == 1 && v == ring[0])) continue;
      if (ring.size() < 2) ring.push_back(v);
      const Vec &p = mesh_.vertices[ring[0]], &q = mesh_.vertices[ring.back()], &r = mesh_.vertices[v];
      if (ring.size() == 2 && !exact::collinear(&p.x, &q.x, &r.x)) ring.push_back(v);
      if (ring.size() == 3 && exact::orientation(p, at(ring[1]), at(ring[2]), r) != 0) return;
    }
  }
  if (ring.size() < 3 || exact::orientation(at(ring[0]), at(ring[1]), at(ring[2]), at(node.hub)) == 0) return;
  node.is_ring = true;
  node.ring = {ring[0], ring[1], ring[2]};
}

std::uint32_t SurfaceTree::grow(std::uint32_t begin, std::uint32_t end, const Node& parent, const std::vector<bool>& open) {
  const auto index = std::uint32_t(nodes_.size());
  Node node{};
  node.begin = begin, node.end = end;
  node.hub = hub_of_[order_[begin]];
  Box places;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t t = order_[i];
    for (std::size_t k = 0; k < 3; ++k) node.box.add(corner(t, k));
    if (hub_of_[t] != node.hub) node.hub = kNone;
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t t = order_[i];
    if (node.hub != kNone) {
      Vec sum{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        if (mesh_.triangles[t][k] == node.hub) continue;
        node.around.add(corner(t, k)), sum = sum + corner(t, k);
      }
      place_[t] = sum;
    }
    places.add(place_[t]);
  }
  if (parent.is_flat) {
    node.is_flat = true, node.plane = parent.plane;
  } else {
    find_plane(node, open);
  }
  if (node.hub != kNone && !node.is_flat) {
    if (parent.is_ring) {
      node.is_ring = true, node.ring = parent.ring;
    } else {
      find_ring(node);
    }
  }
  nodes_.push_back(node);
  if (end - begin <= kInLeaf) return index;
  int axis = 0;
  const Vec side = places.most - places.least;
  for (int k = 1; k < 3; ++k) axis = coordinate(side, k) > coordinate(side, axis) ? k : axis;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](std::uint32_t x, std::uint32_t y) {
        return std::tuple(coordinate(place_[x], axis), hub_of_[x], x) < std::tuple(coordinate(place_[y], axis), hub_of_[y], y);
      });
  grow(begin, middle, node, open);
  nodes_[index].right = grow(middle, end, node, open);
  return index;
}

bool SurfaceTree::is_parted(const FlatWedge& wedge, const Corners3& plane) {
  return std::ranges::all_of(plane, [&](const Vec& p) { return side_of(wedge.corner, p) == 0; });
}

bool SurfaceTree::is_parted(const Wedge& wedge, const Corners3& plane) {
  int least = 1, most = -1;
  unsigned face = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const int side = side_of(plane, wedge.corner[k]);
    least = std::min(least, side), most = std::max(most, side);
    face |= unsigned(side == 0) << k;
  }
  return face != 0b1111 && (least >= 0 || most <= 0) && wedge.is_outer(face);
}

}  // namespace swiftlet::lod
