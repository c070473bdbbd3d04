// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rank by exact predicates, then quickhull in space, a monotone chain in the plane, or the two ends of a segment.
#include "hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "numeric/chunks.h"

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Ids = std::vector<std::uint32_t>;
constexpr std::size_t kPerTask = 8192;  ///< vertices, half-edges

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

/// As plain arrays: CGAL fills meshes of half-edges by way of a hash table, which takes as long as the hull.
Polytope quickhull(std::span<const Vec3> points, const Ids& ids) {
  namespace internal = CGAL::Convex_hull_3::internal;
  std::vector<Point3> input, corners;
  input.reserve(ids.size());
  for (std::uint32_t id : ids) input.push_back(exact(points[id]));
  Polytope mesh;
  internal::Indexed_triangle_set<std::vector<Point3>, std::vector<Triangle>> filled(corners, mesh.triangles);
  CGAL::convex_hull_3(input.begin(), input.end(), filled,
                      internal::Default_traits_for_Chull_3<Point3, CGAL::Surface_mesh<Point3>>::type());
  if (corners.size() == 4) {  // CGAL 5.5 gives the hull of four points inside out
    const auto& [a, b, c] = mesh.triangles.front();
    if (CGAL::orientation(corners[a], corners[b], corners[c], corners[6 - a - b - c]) == CGAL::POSITIVE)
      for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  }
  mesh.points.reserve(corners.size());
  for (const Point3& p : corners) mesh.points.emplace_back(p.x(), p.y(), p.z());
  return mesh;
}

/// Per half-edge, whether the faces beside it lie in one plane.
std::vector<std::uint8_t> flat_edges(const Polytope& mesh, const HalfEdges& edges, const Executor& executor) {
  std::vector<std::uint8_t> flat(edges.twin.size());
  const auto corner = [&](std::uint32_t h) { return exact(mesh.points[origin(mesh, h)]); };
  over_chunks(executor, flat.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
    for (auto h = std::uint32_t(begin); h < end; ++h)
      flat[h] = CGAL::coplanar(corner(h), corner(HalfEdges::next(h)), corner(HalfEdges::previous(h)),
                               corner(HalfEdges::previous(edges.twin[h])));
  });
  return flat;
}

/// The points' ids of the mesh's vertices; `sorted` is in lexicographic order.
Ids identify(const Polytope& mesh, std::span<const Vec3> points, const Ids& sorted, const Executor& executor) {
  Ids ids(mesh.points.size());
  over_chunks(executor, ids.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      ids[v] = *std::lower_bound(sorted.begin(), sorted.end(), mesh.points[v],
                                 [&](std::uint32_t id, const Vec3& q) { return before(points[id], q); });
  });
  return ids;
}

/// Vertices ascending; facets fanned from their lowest corner, the triangles sorted: independent of the order quickhull met
/// points in and of how it cut coplanar ones into triangles.
void put_in_order(const Polytope& mesh, const HalfEdges& edges, const std::vector<std::uint8_t>& flat, const Ids& ids,
                  Hull& hull) {
  hull.vertices = ids;
  std::sort(hull.vertices.begin(), hull.vertices.end());
  Ids rank;
  for (std::uint32_t id : ids)
    rank.push_back(std::uint32_t(std::lower_bound(hull.vertices.begin(), hull.vertices.end(), id) - hull.vertices.begin()));
  std::vector<bool> passed(flat.size());
  hull.triangles.reserve(mesh.triangles.size());
  Ids border;
  for (std::uint32_t first = 0; first < flat.size(); ++first) {
    if (flat[first] || passed[first]) continue;
    border.clear();
    std::uint32_t h = first;
    do {
      passed[h] = true;
      border.push_back(rank[origin(mesh, h)]);
      h = HalfEdges::next(h);
      while (flat[h]) h = HalfEdges::next(edges.twin[h]);
    } while (h != first);
    std::rotate(border.begin(), std::min_element(border.begin(), border.end()), border.end());
    for (std::size_t i = 1; i + 1 < border.size(); ++i) hull.triangles.push_back({border[0], border[i], border[i + 1]});
  }
  std::sort(hull.triangles.begin(), hull.triangles.end());
}

void solid_hull(std::span<const Vec3> points, const Ids& sorted, const Executor& executor, Hull& hull) {
  Polytope mesh = quickhull(points, sorted);
  HalfEdges edges = half_edges(mesh);
  std::vector<std::uint8_t> flat = flat_edges(mesh, edges, executor);
  Ids ids = identify(mesh, points, sorted, executor);
  // A vertex of the hull has at least three edges with a true dihedral angle; quickhull also returns points inside faces and
  // edges.
  std::vector<std::uint8_t> sharp(mesh.points.size());
  for (std::uint32_t h = 0; h < flat.size(); ++h)
    if (std::uint8_t& count = sharp[origin(mesh, h)]; !flat[h] && count < 3) ++count;
  Ids extreme;
  for (std::uint32_t v = 0; v < sharp.size(); ++v)
    if (sharp[v] == 3) extreme.push_back(ids[v]);
  if (extreme.size() < ids.size()) {
    std::sort(extreme.begin(), extreme.end(), [&](std::uint32_t i, std::uint32_t j) { return before(points[i], points[j]); });
    mesh = quickhull(points, extreme);
    edges = half_edges(mesh);
    flat = flat_edges(mesh, edges, executor);
    ids = identify(mesh, points, extreme, executor);
  }
  put_in_order(mesh, edges, flat, ids, hull);
}

}  // namespace

Hull hull(std::span<const Vec3> points, const Executor& executor) {
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
    solid_hull(points, sorted, executor, result);
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
