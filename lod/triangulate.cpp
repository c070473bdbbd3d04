// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangulate.h"

#include <optional>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

namespace swiftlet::lod {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Projection_traits_3<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Traits>;
/// Of a face: 1 inside of the polygon, 0 outside, -1 while that is unknown.
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Traits, CGAL::Triangulation_face_base_with_info_2<int, Traits>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Traits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                                            CGAL::No_constraint_intersection_tag>;

/// The triangles inside; nothing of a polygon that crosses or touches itself.
std::optional<Triangles> inside(std::span<const Vec3> points, std::span<const std::uint64_t> polygon, const Vec3& normal) try {
  Delaunay plane{Traits(Kernel::Vector_3(normal.x(), normal.y(), normal.z()))};
  std::vector<Delaunay::Vertex_handle> corners;
  for (const std::uint64_t index : polygon) {
    const Vec3& p = points[index];
    corners.push_back(plane.insert({p.x(), p.y(), p.z()}));
    corners.back()->info() = std::uint32_t(index);
  }
  if (plane.number_of_vertices() != polygon.size()) return std::nullopt;
  for (std::size_t i = 0; i < corners.size(); ++i) plane.insert_constraint(corners[i], corners[(i + 1) % corners.size()]);

  for (const auto face : plane.all_face_handles()) face->info() = -1;
  std::vector<std::pair<Delaunay::Face_handle, int>> to_do{{plane.infinite_face(), 0}};
  while (!to_do.empty()) {
    const auto [face, is_inside] = to_do.back();
    to_do.pop_back();
    if (face->info() >= 0) continue;
    face->info() = is_inside;
    for (int i = 0; i < 3; ++i) to_do.emplace_back(face->neighbor(i), is_inside != int(face->is_constrained(i)));
  }
  Triangles found;
  for (const auto face : plane.finite_face_handles())
    if (face->info() == 1) found.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  if (found.size() + 2 != polygon.size()) return std::nullopt;
  return found;
} catch (const Delaunay::Intersection_of_constraints_exception&) {
  return std::nullopt;
}

/// CGAL multiplies a normal by ways in the polygon, and its exact arithmetic takes no infinity. Legal coordinates make none
/// longer.
constexpr double kLongestNormal = 1e150;

}  // namespace

void triangulate(std::span<const Vec3> points, std::span<const std::uint64_t> polygon, Triangles& triangles) {
  const Vec3& first = points[polygon[0]];
  const auto area = [&](std::size_t k) -> Vec3 { return (points[polygon[k - 1]] - first).cross(points[polygon[k]] - first); };
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k) normal += area(k);
  bool is_fan = true;
  for (std::size_t k = 2; k < polygon.size(); ++k) is_fan = is_fan && !(area(k).dot(normal) < 0);
  if (!is_fan && normal.cwiseAbs().maxCoeff() <= kLongestNormal) {
    if (const std::optional<Triangles> found = inside(points, polygon, normal)) {
      triangles.insert(triangles.end(), found->begin(), found->end());
      return;
    }
  }
  for (std::size_t k = 2; k < polygon.size(); ++k)
    triangles.push_back({std::uint32_t(polygon[0]), std::uint32_t(polygon[k - 1]), std::uint32_t(polygon[k])});
}

}  // namespace swiftlet::lod
