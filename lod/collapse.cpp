// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Garland & Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997, as CGAL has it. Knows nothing of
// hulls.
#include "collapse.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_triangle_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
constexpr double kCollectedWork = 1.5, kCollapsedWork = 12;  ///< per edge, about microseconds

using Mesh3 = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh3 to_mesh(const Polytope& body) {
  Mesh3 mesh;
  mesh.reserve(body.points.size(), 3 * body.triangles.size() / 2, body.triangles.size());
  for (const Vec3& p : body.points) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : body.triangles)
    mesh.add_face(Mesh3::Vertex_index(a), Mesh3::Vertex_index(b), Mesh3::Vertex_index(c));
  return mesh;
}

namespace SMS = CGAL::Surface_mesh_simplification;

/// Counts the edges that are looked at first, and those that collapse.
class Counter : public SMS::Edge_collapse_visitor_base<Mesh3> {
 public:
  explicit Counter(Watch& watch) : watch_(watch) {}
  void OnCollected(const Profile&, const boost::optional<FT>&) { watch_.work(kCollectedWork); }
  void OnCollapsed(const Profile&, const vertex_descriptor&) { watch_.work(kCollapsedWork); }

 private:
  Watch& watch_;
};

}  // namespace

std::vector<Vec3> collapse(const Polytope& body, std::size_t triangle_count, Watch& watch) try {
  Mesh3 mesh = to_mesh(body);
  SMS::GarlandHeckbert_triangle_policies<Mesh3, Kernel> policies(mesh);
  SMS::edge_collapse(
      mesh, SMS::Count_stop_predicate<Mesh3>(3 * triangle_count / 2 + 1),
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()).visitor(Counter(watch)));
  std::vector<Vec3> points;
  for (Mesh3::Vertex_index v : mesh.vertices()) {
    const Vec3 p{mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()};
    if (p.allFinite()) points.push_back(p);
  }
  return points;
} catch (const CGAL::Failure_exception&) {
  return {};
}

double collapse_work(double before, double after) {
  return kCollectedWork * 1.5 * before + kCollapsedWork * 0.5 * (before - after);
}

}  // namespace swiftlet::lod
