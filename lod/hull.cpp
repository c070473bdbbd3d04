// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rank by exact predicates, then quickhull in space, a monotone chain in the plane, or the two ends of a segment.
#include "hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <numeric>

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Mesh3 = CGAL::Surface_mesh<Point3>;
using Ids = std::vector<std::uint32_t>;

Point3 exact(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

bool before(const Vec3& p, const Vec3& q) {
  return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
}

/// The first of every set of equal points, in lexicographic order.
Ids distinct(std::span<const Vec3> points) {
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  std::sort(ids.begin(), ids.end(), [&](std::uint32_t i, std::uint32_t j) {
    return before(points[i], points[j]) || (points[i] == points[j] && i < j);
  });
  ids.erase(std::unique(ids.begin(), ids.end(), [&](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; }),
            ids.end());
  return ids;
}

/// Which coordinates to keep so that a plane projects one to one.
struct Projection {
  int u = 0, v = 1;
  Point2 operator()(const Vec3& p) const { return {p[u], p[v]}; }
};

Projection widest_projection(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 normal = area_normal(p, q, r);
  Projection best;
  double widest = -1;
  for (const auto& [axis, u, v] : {std::array{2, 0, 1}, std::array{0, 1, 2}, std::array{1, 2, 0}}) {
    const Projection onto{u, v};
    if (std::abs(normal[axis]) > widest && !CGAL::collinear(onto(p), onto(q), onto(r)))
      widest = std::abs(normal[axis]), best = onto;
  }
  return best;
}

/// Andrew's monotone chain over lexicographically sorted points, run once each way; keeps strict left turns only.
Ids polygon(std::span<const Vec3> points, const Ids& sorted, const Projection& onto) {
  Ids order = sorted, loop;
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return onto(points[i]) < onto(points[j]); });
  for (int pass = 0; pass < 2; ++pass, std::reverse(order.begin(), order.end())) {
    const std::size_t base = loop.size();
    for (std::uint32_t id : order) {
      while (loop.size() >= base + 2 &&
             !CGAL::left_turn(onto(points[loop.end()[-2]]), onto(points[loop.back()]), onto(points[id])))
        loop.pop_back();
      loop.push_back(id);
    }
    loop.pop_back();
  }
  return loop;
}

Mesh3 quickhull(std::span<const Vec3> points, const Ids& ids) {
  std::vector<Point3> input;
  input.reserve(ids.size());
  for (std::uint32_t id : ids) input.push_back(exact(points[id]));
  Mesh3 mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  return mesh;
}

/// Whether the faces beside an edge lie in one plane.
bool is_flat(const Mesh3& mesh, Mesh3::Halfedge_index h) {
  const auto apex = [&](Mesh3::Halfedge_index side) { return mesh.point(mesh.target(mesh.next(side))); };
  return CGAL::coplanar(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), apex(h), apex(mesh.opposite(h)));
}

/// A vertex of the hull has at least three edges with a true dihedral angle; quickhull also returns points inside faces and
/// edges.
bool is_extreme(const Mesh3& mesh, Mesh3::Vertex_index vertex) {
  int sharp = 0;
  for (Mesh3::Halfedge_index h : CGAL::halfedges_around_target(vertex, mesh)) {
    if (!is_flat(mesh, h) && ++sharp == 3) return true;
  }
  return false;
}

/// The points' ids of the mesh's vertices; `sorted` is in lexicographic order.
Ids identify(const Mesh3& mesh, std::span<const Vec3> points, const Ids& sorted) {
  Ids ids;
  for (Mesh3::Vertex_index v : mesh.vertices()) {
    const Vec3 p{mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()};
    ids.push_back(*std::lower_bound(sorted.begin(), sorted.end(), p,
                                    [&](std::uint32_t id, const Vec3& q) { return before(points[id], q); }));
  }
  return ids;
}

/// Vertices ascending; facets fanned from their lowest corner, the triangles sorted: independent of the order quickhull met
/// points in and of how it cut coplanar ones into triangles.
void put_in_order(const Mesh3& mesh, const Ids& ids, Hull& hull) {
  hull.vertices = ids;
  std::sort(hull.vertices.begin(), hull.vertices.end());
  Ids rank;
  for (std::uint32_t id : ids)
    rank.push_back(std::uint32_t(std::lower_bound(hull.vertices.begin(), hull.vertices.end(), id) - hull.vertices.begin()));
  std::vector<bool> flat(mesh.num_halfedges()), passed(mesh.num_halfedges());
  for (Mesh3::Halfedge_index h : mesh.halfedges()) flat[h] = is_flat(mesh, h);
  for (Mesh3::Halfedge_index first : mesh.halfedges()) {
    if (flat[first] || passed[first]) continue;
    Ids border;
    Mesh3::Halfedge_index h = first;
    do {
      passed[h] = true;
      border.push_back(rank[mesh.source(h)]);
      h = mesh.next(h);
      while (flat[h]) h = mesh.next(mesh.opposite(h));
    } while (h != first);
    std::rotate(border.begin(), std::min_element(border.begin(), border.end()), border.end());
    for (std::size_t i = 1; i + 1 < border.size(); ++i) hull.triangles.push_back({border[0], border[i], border[i + 1]});
  }
  std::sort(hull.triangles.begin(), hull.triangles.end());
}

void solid_hull(std::span<const Vec3> points, const Ids& sorted, Hull& hull) {
  Mesh3 mesh = quickhull(points, sorted);
  Ids ids = identify(mesh, points, sorted), extreme;
  for (Mesh3::Vertex_index v : mesh.vertices())
    if (is_extreme(mesh, v)) extreme.push_back(ids[v]);
  if (extreme.size() < ids.size()) {
    std::sort(extreme.begin(), extreme.end(), [&](std::uint32_t i, std::uint32_t j) { return before(points[i], points[j]); });
    mesh = quickhull(points, extreme);
    ids = identify(mesh, points, extreme);
  }
  put_in_order(mesh, ids, hull);
}

}  // namespace

Hull hull(std::span<const Vec3> points) {
  const Ids sorted = distinct(points);
  const Vec3 &first = points[sorted.front()], &last = points[sorted.back()];
  const auto off_line = std::find_if(sorted.begin(), sorted.end(), [&](std::uint32_t id) {
    return !CGAL::collinear(exact(first), exact(last), exact(points[id]));
  });
  const auto off_plane = off_line == sorted.end() ? off_line : std::find_if(off_line, sorted.end(), [&](std::uint32_t id) {
    return !CGAL::coplanar(exact(first), exact(last), exact(points[*off_line]), exact(points[id]));
  });

  Hull result;
  result.duplicates = points.size() - sorted.size();
  if (sorted.size() == 1) {
    result.vertices = sorted;
  } else if (off_line == sorted.end()) {
    result.dimension = 1;
    result.vertices = {sorted.front(), sorted.back()};
  } else if (off_plane == sorted.end()) {
    result.dimension = 2;
    result.vertices = polygon(points, sorted, widest_projection(first, last, points[*off_line]));
  } else {
    result.dimension = 3;
    solid_hull(points, sorted, result);
  }
  result.interior = sorted.size() - result.vertices.size();
  return result;
}

Polytope solid(std::span<const Vec3> points, const Hull& hull) {
  Polytope body;
  body.triangles = hull.triangles;
  for (std::uint32_t id : hull.vertices) body.points.push_back(points[id]);
  return body;
}

}  // namespace swiftlet::lod
