// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles are found by corners, else by a climb to where their plane would touch the hull. Depths are bounded by a few planes
// first.
#include "trace.h"

#include <swiftlet/lut.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

namespace swiftlet::lod {
namespace {

using Ids = std::vector<std::uint32_t>;

bool before(const Vec3& p, const Vec3& q) {
  return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
}

Triangle from_lowest(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

/// Per point, the first of those equal to it.
Ids first_of_equals(std::span<const Vec3> points) {
  Ids order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return before(points[i], points[j]) || (points[i] == points[j] && i < j);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && points[order[k]] == points[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

/// Every edge once in each direction: two-sided triangles do not close.
bool closes(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> forth, back;
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      forth.emplace_back(from, to), back.emplace_back(to, from);
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back && std::adjacent_find(forth.begin(), forth.end()) == forth.end();
}

/// Finds hull triangles by the plane they lie on.
class PlaneFinder {
 public:
  PlaneFinder(const Polytope& body, double rounding)
      : body_(body), climber_(body), edges_(half_edges(body)), rounding_(rounding) {}

  /// The largest hull triangle at the vertex where the plane of p, q, r touches, if all lie on one plane; else kNone.
  std::uint32_t find(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 normal = area_normal(p, q, r).normalized();
    if (!normal.allFinite() || normal.isZero()) return kNone;
    last_ = climber_.climb(normal, last_);
    const double height = normal.dot(body_.points[last_]);
    const auto on_plane = [&](const Vec3& point) { return height - normal.dot(point) <= rounding_; };
    if (!on_plane(p) || !on_plane(q) || !on_plane(r)) return kNone;
    std::uint32_t best = kNone;
    double largest = 0;
    const std::uint32_t first = edges_.outgoing[last_];
    std::uint32_t h = first;
    do {
      const auto& [a, b, c] = body_.triangles[h / 3];
      const double along = normal.dot(area_normal(body_.points[a], body_.points[b], body_.points[c]));
      if (along > largest && on_plane(body_.points[a]) && on_plane(body_.points[b]) && on_plane(body_.points[c]))
        largest = along, best = h / 3;
      h = edges_.rotate(h);
    } while (h != first);
    return best;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  const Polytope& body_;
  Climber climber_;
  HalfEdges edges_;
  double rounding_;
  std::uint32_t last_ = 0;
};

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>>>;

Kernel::Point_3 cgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// No less than the depth of a point, from the supports in a few directions: most points are seen not to be the deepest by it.
class CoarseDepth {
 public:
  explicit CoarseDepth(const Polytope& body) {
    const Climber climber(body);
    std::uint32_t top = 0;
    for (std::uint32_t k = 0; k < lut::sample_count(lut::Resolution::Degrees22); ++k) {
      const std::array<double, 3> sample = lut::sample(lut::Resolution::Degrees22, k);
      const Vec3 direction(sample[0], sample[1], sample[2]);
      top = climber.climb(direction, top);
      planes_.emplace_back(direction, direction.dot(body.points[top]));
    }
  }
  double operator()(const Vec3& p) const {
    double depth = std::numeric_limits<double>::infinity();
    for (const auto& [normal, height] : planes_) depth = std::min(depth, height - normal.dot(p));
    return depth;
  }

 private:
  std::vector<std::pair<Vec3, double>> planes_;
};

/// The vertices of the mesh's triangles that are none of the hull's.
Ids inner_vertices(const Mesh& mesh, const Hull& hull) {
  Ids used, inner;
  for (const Triangle& triangle : mesh.triangles) used.insert(used.end(), triangle.begin(), triangle.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::set_difference(used.begin(), used.end(), hull.vertices.begin(), hull.vertices.end(), std::back_inserter(inner));
  return inner;
}

}  // namespace

double rounding_of(std::span<const Vec3> points) {
  double size = 0;
  bool floats = true;
  for (const Vec3& p : points) {
    size = std::max(size, p.cwiseAbs().maxCoeff());
    floats = floats && p.cast<float>().cast<double>() == p;
  }
  return 8 * size * (floats ? 0x1p-24 : 0x1p-53);
}

std::vector<std::vector<std::uint32_t>> triangles_on(const Mesh& mesh, const Hull& hull, const Polytope& body) {
  const Ids first = first_of_equals(mesh.points);
  std::vector<std::vector<std::uint32_t>> found(body.triangles.size());
  std::optional<PlaneFinder> planes;  // of a triangulated hull every triangle is found by its corners
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    Triangle corners{first[i], first[j], first[k]};
    bool all_extreme = true;
    for (std::uint32_t& corner : corners) {
      const auto at = std::lower_bound(hull.vertices.begin(), hull.vertices.end(), corner);
      all_extreme = all_extreme && at != hull.vertices.end() && *at == corner;
      corner = std::uint32_t(at - hull.vertices.begin());
    }
    corners = from_lowest(corners);
    const auto at = std::lower_bound(body.triangles.begin(), body.triangles.end(), corners);
    if (all_extreme && at != body.triangles.end() && *at == corners) {
      found[at - body.triangles.begin()].push_back(t);
    } else {
      if (!planes) planes.emplace(body, rounding_of(mesh.points));
      const std::uint32_t on = planes->find(mesh.points[i], mesh.points[j], mesh.points[k]);
      if (on < found.size()) found[on].push_back(t);
    }
  }
  return found;
}

double volume_ratio(const Mesh& mesh, const Polytope& body) {
  const Ids first = first_of_equals(mesh.points);
  Polytope surface{mesh.points, mesh.triangles};
  for (Triangle& triangle : surface.triangles)
    for (std::uint32_t& corner : triangle) corner = first[corner];
  return !surface.triangles.empty() && closes(surface.triangles) ? std::abs(volume(surface)) / volume(body) : 1;
}

double deepest_dent(const Mesh& mesh, const Hull& hull, const Polytope& body) {
  const Ids inner = inner_vertices(mesh, hull);
  if (inner.empty()) return 0;
  Faces faces;
  for (const auto& [a, b, c] : body.triangles)
    faces.emplace_back(cgal(body.points[a]), cgal(body.points[b]), cgal(body.points[c]));
  const Tree tree(faces.cbegin(), faces.cend());
  const CoarseDepth bound(body);

  std::vector<std::pair<double, std::uint32_t>> at_most;
  for (std::uint32_t v : inner) at_most.emplace_back(bound(mesh.points[v]), v);
  std::sort(at_most.begin(), at_most.end(), std::greater<>());
  double deepest = 0;
  for (const auto& [depth, v] : at_most) {
    if (depth <= deepest) break;
    deepest = std::max(deepest, std::sqrt(tree.squared_distance(cgal(mesh.points[v]))));
  }
  return deepest;
}

}  // namespace swiftlet::lod
