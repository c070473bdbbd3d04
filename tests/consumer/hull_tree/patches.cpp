// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "patches.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include <swiftlet/march.h>
#include <Eigen/Geometry>

namespace hull_tree {
namespace {

using swiftlet::ConvexView;
using swiftlet::MarchStatus;
using swiftlet::Model;

/// A height that rounding makes of a flat edge, over the mesh's size.
constexpr double kFlat = 1e-15;

template <class T>
T needed(swiftlet::Result<T> result) {
  if (result) return std::move(result).value();
  std::printf("%s\n", result.error().message.c_str());
  std::exit(1);
}

Model two_sided(const Mesh& mesh, std::uint32_t triangle) {
  std::vector<Vec3> points;
  for (const std::uint32_t corner : mesh.triangles[triangle]) points.push_back(mesh.points[corner]);
  const std::uint32_t loops[] = {0, 1, 2, 2, 1, 0};
  swiftlet::LevelArrays arrays;
  arrays.vertices = points;
  arrays.face_vertices = loops;
  return needed(Model::from_level(arrays));
}

class Growth {
 public:
  explicit Growth(const Mesh& mesh) : mesh_(mesh), patch_(mesh.triangles.size(), swiftlet::kNone) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      solo_.push_back(two_sided(mesh, t));
      const auto& [a, b, c] = mesh.triangles[t];
      normal_.push_back((mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized());
      size_ = std::max(size_, solo_.back().extent());
      for (int k = 0; k < 3; ++k) left[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) neighbour_.push_back(left.at({mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][k]}));
    }
  }

  std::vector<std::vector<std::uint32_t>> patches() {
    std::vector<std::vector<std::uint32_t>> all;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (patch_[t] == swiftlet::kNone) all.push_back(grown(t, std::uint32_t(all.size())));
    }
    return all;
  }

 private:
  std::vector<std::uint32_t> grown(std::uint32_t seed, std::uint32_t id) {
    std::vector<std::uint32_t> patch{seed};
    std::set<std::uint32_t> tried{seed};
    patch_[seed] = id;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t t = neighbour_[3 * patch[next] + k];
        if (patch_[t] != swiftlet::kNone || !tried.insert(t).second || !is_convex_with(patch, t)) continue;
        patch.push_back(t);
        patch_[t] = id;
        if (hull_is_inside(patch, id)) continue;
        patch.pop_back();
        patch_[t] = swiftlet::kNone;
      }
    }
    return patch;
  }

  double height(std::uint32_t point, std::uint32_t triangle) const {
    return normal_[triangle].dot(mesh_.points[point] - mesh_.points[mesh_.triangles[triangle][0]]);
  }
  bool is_below(std::uint32_t t, std::uint32_t plane) const {
    return std::ranges::all_of(mesh_.triangles[t], [&](std::uint32_t p) { return height(p, plane) <= kFlat * size_; });
  }
  bool is_above(std::uint32_t t, std::uint32_t plane) const {
    return std::ranges::all_of(mesh_.triangles[t], [&](std::uint32_t p) { return height(p, plane) >= 0; });
  }

  /// Neither sees the other from outside.
  bool is_convex_with(const std::vector<std::uint32_t>& patch, std::uint32_t t) const {
    return std::ranges::all_of(patch, [&](std::uint32_t p) { return is_below(t, p) && is_below(p, t); });
  }

  bool hull_is_inside(const std::vector<std::uint32_t>& patch, std::uint32_t id) const {
    const Model hull = hull_of(mesh_, patch).model;
    double covered = 0, all = 0;
    for (const std::uint32_t t : patch) covered += area(mesh_, t);
    for (std::uint32_t f = 0; f < hull.level(0).view.face_first.size(); ++f) all += area(hull.level(0).view, f);
    // Nothing enters a hull that is flat, or is so up to rounding: the patch itself must be convex.
    if (hull.volume() < 1e-12 * std::pow(all, 1.5) && all > 2 * covered * (1 + 1e-9)) return false;
    for (std::uint32_t t = 0; t < solo_.size(); ++t) {
      if (patch_[t] == id || (solo_[t].box_max().array() < hull.box_min().array()).any() ||
          (solo_[t].box_min().array() > hull.box_max().array()).any() ||
          std::ranges::any_of(patch, [&](std::uint32_t p) { return is_above(t, p); })) {
        continue;
      }
      if (march(hull.level(0).view, solo_[t].level(0).view, {}).status == MarchStatus::Overlapping) return false;
    }
    return true;
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> patch_, neighbour_;
  std::vector<Model> solo_;
  std::vector<Vec3> normal_;
  double size_ = 0;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> convex_patches(const Mesh& mesh) { return Growth(mesh).patches(); }

PartialHull hull_of(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& points) {
  std::set<std::uint32_t> ids(points.begin(), points.end());
  for (const std::uint32_t t : triangles) ids.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  const std::vector<std::uint32_t> used(ids.begin(), ids.end());
  const auto local = [&](std::uint32_t p) { return std::uint32_t(std::ranges::lower_bound(used, p) - used.begin()); };

  Mesh part;
  for (const std::uint32_t p : used) part.points.push_back(mesh.points[p]);
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    part.triangles.push_back({local(a), local(b), local(c)});
  }
  swiftlet::BuildOptions options;
  options.max_levels = 1;
  options.table.resolution = swiftlet::lut::Resolution::Degrees22;
  PartialHull hull{needed(swiftlet::build(part, options)).model, {}, triangles};
  for (const std::uint32_t p : hull.model.source().vertex) hull.point.push_back(used[p]);
  return hull;
}

std::vector<std::uint32_t> corners(const ConvexView& view, std::uint32_t face) {
  std::vector<std::uint32_t> loop;
  for (const std::uint32_t v : swiftlet::FaceLoop(view, face)) loop.push_back(v);
  return loop;
}

double area(const ConvexView& view, std::uint32_t face) {
  const auto point = [&](std::uint32_t v) { return Vec3(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z); };
  const std::vector<std::uint32_t> loop = corners(view, face);
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 2; k < loop.size(); ++k) {
    twice += (point(loop[k - 1]) - point(loop[0])).cross(point(loop[k]) - point(loop[0]));
  }
  return twice.norm() / 2;
}

double area(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm() / 2;
}

}  // namespace hull_tree
