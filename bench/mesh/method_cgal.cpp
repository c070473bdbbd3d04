// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// CGAL's AABB trees as a method, by Rigid_triangle_mesh_collision_detection, which moves one tree through the other without
// building it again and decides triangles by exact predicates on rounded points. It answers intersection alone: of two trees
// CGAL offers no distance.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

#include "heap.h"
#include "method.h"

namespace swiftlet::bench::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// The mesh with its topology, or, where that is no manifold, every triangle on points of its own.
Surface surface_of(const Mesh& mesh) {
  namespace Pmp = CGAL::Polygon_mesh_processing;
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
  Surface surface;
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
  if (Pmp::is_polygon_soup_a_polygon_mesh(triangles)) {
    Pmp::polygon_soup_to_polygon_mesh(points, triangles, surface);
  } else {
    for (const auto& t : triangles)
      surface.add_face(surface.add_vertex(points[t[0]]), surface.add_vertex(points[t[1]]), surface.add_vertex(points[t[2]]));
  }
  return surface;
}

class CgalSession final : public Session {
 public:
  CgalSession(const Mesh& a, const Mesh& b) {
    measure(*this, [&] {
      a_ = surface_of(a), b_ = surface_of(b);
      id_a_ = trees_.add_mesh(a_);
      id_b_ = trees_.add_mesh(b_);
    });
  }

  Reply ask(const Question&, const Pose& b_in_a) override {
    const Mat3& r = b_in_a.rotation;
    const Vec3& t = b_in_a.translation;
    trees_.set_transformation(
        id_b_, {r(0, 0), r(0, 1), r(0, 2), t[0], r(1, 0), r(1, 1), r(1, 2), t[1], r(2, 0), r(2, 1), r(2, 2), t[2]});
    return {.yes = !trees_.get_all_intersections(id_a_, std::array{id_b_}).empty()};
  }

 private:
  Surface a_, b_;
  CGAL::Rigid_triangle_mesh_collision_detection<Surface> trees_;
  std::size_t id_a_ = 0, id_b_ = 0;
};

class CgalMethod final : public Method {
 public:
  std::string name() const override { return "cgal"; }
  std::string settings() const override {
    return "CGAL " CGAL_VERSION_STR ", Rigid_triangle_mesh_collision_detection, intersection alone";
  }
  bool can(const Question& question) const override { return question.kind == Kind::Intersects; }
  std::unique_ptr<Session> open(const Mesh& a, const Mesh& b) const override { return std::make_unique<CgalSession>(a, b); }
};

}  // namespace

std::unique_ptr<Method> cgal_method() { return std::make_unique<CgalMethod>(); }

}  // namespace swiftlet::bench::mesh
