// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles are found by corners, else by a climb to where their plane would touch the hull, else by the hull's plane beside
// them, unless a tree of the hull's planes tells that the triangle is below all. Depths are bounded by a few planes first.
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

#include "numeric/exact.h"
#include "numeric/wide.h"

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
bool closes(const std::vector<Triangle>& triangles, std::size_t point_count) {
  std::vector<std::uint32_t> begin(point_count + 2), heads(3 * triangles.size());  // the ends of the edges out of each point
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) ++begin[corner + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) heads[begin[from + 1]++] = to;
  const auto out_of = [&](std::uint32_t point) {
    return std::span(heads).subspan(begin[point], begin[point + 1] - begin[point]);
  };
  for (std::uint32_t from = 0; from < point_count; ++from) std::sort(out_of(from).begin(), out_of(from).end());
  for (std::uint32_t from = 0; from < point_count; ++from) {
    const auto ends = out_of(from);
    if (std::adjacent_find(ends.begin(), ends.end()) != ends.end()) return false;
    for (const std::uint32_t to : ends)
      if (!std::binary_search(out_of(to).begin(), out_of(to).end(), from)) return false;
  }
  return true;
}

/// Finds hull triangles by the plane they lie on.
class PlaneFinder {
 public:
  PlaneFinder(const Polytope& body, double rounding)
      : body_(body), climber_(body), edges_(half_edges(body)), rounding_(rounding), diameter_(0) {
    for (const Vec3& p : body.points) diameter_ = std::max(diameter_, 2 * (p - body.points[0]).norm());
  }

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
  /// False if p, q, r, which were last asked about, are farther below the hull than a plane of it may lean by the rounding of
  /// three points: by that over the triangle's altitude.
  bool may_lean(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const Vec3 twice = area_normal(p, q, r), normal = twice.normalized();
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()}),
                 below = normal.dot(body_.points[last_] - p);
    return !(below * twice.norm() > 2 * rounding_ * longest * diameter_);
  }

 private:
  const Polytope& body_;
  Climber climber_;
  HalfEdges edges_;
  double rounding_, diameter_;  ///< `diameter_` is that of a ball around the first vertex
  std::uint32_t last_ = 0;
};

/// The hull's triangles and their planes. Which triangle is nearest is found in doubles, so that beside a needle it may be
/// another one; how deep a point is below a plane is right to rounding, however thin the triangle.
class HullFaces {
 public:
  explicit HullFaces(const Polytope& body) : body_(body), normals_(body.triangles.size(), Vec3::Zero()) {
    for (const auto& [a, b, c] : body.triangles) triangles_.emplace_back(cgal(a), cgal(b), cgal(c));
    tree_.emplace(triangles_.cbegin(), triangles_.cend());
  }
  /// A triangle about as near to `p` as any.
  std::uint32_t about_nearest(const Vec3& p) const {
    return std::uint32_t(tree_->closest_point_and_primitive({p.x(), p.y(), p.z()}).second - triangles_.cbegin());
  }
  /// How far `p` is below the plane of a triangle.
  double depth(std::uint32_t triangle, const Vec3& p) { return normal(triangle).dot(corner(triangle) - p); }
  const Vec3& normal(std::uint32_t triangle) {
    Vec3& normal = normals_[triangle];
    if (!normal.isZero()) return normal;
    const auto& [a, b, c] = body_.triangles[triangle];
    return normal = eigen(exact::plane(vec(body_.points[a]), vec(body_.points[b]), vec(body_.points[c])).normal);
  }

 private:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

  const Vec3& corner(std::uint32_t triangle) const { return body_.points[body_.triangles[triangle][0]]; }
  Kernel::Point_3 cgal(std::uint32_t vertex) const {
    const Vec3& p = body_.points[vertex];
    return {p.x(), p.y(), p.z()};
  }

  const Polytope& body_;
  Triangles triangles_;
  std::optional<Tree> tree_;
  std::vector<Vec3> normals_;  ///< 0 before they are asked for
};

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

double precise_volume(const Polytope& body) {
  if (body.triangles.empty()) return 0;
  const Wide apex = wide(vec(body.points[body.triangles.front()[0]]));
  const auto from_apex = [&](std::uint32_t v) { return wide(vec(body.points[v])) - apex; };
  DoubleDouble six_times = 0;
  for (const auto& [a, b, c] : body.triangles) six_times = six_times + dot(from_apex(a), cross(from_apex(b), from_apex(c)));
  return double(six_times) / 6;
}

std::vector<std::uint32_t> triangles_on(const Mesh& mesh, const Hull& hull, const Polytope& body, Watch& watch) {
  Ids vertex = first_of_equals(mesh.points);  // per point, the hull's vertex there
  {
    Ids rank(mesh.points.size(), kNone);
    for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) rank[hull.vertices[v]] = v;
    for (std::uint32_t& point : vertex) point = rank[point];
  }
  Ids begin(body.points.size() + 1);  // of the triangles with each lowest corner; they are sorted
  for (const Triangle& triangle : body.triangles) ++begin[triangle[0] + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  Ids found(mesh.triangles.size());
  std::optional<PlaneFinder> planes;  // of a triangulated hull every triangle is found by its corners
  std::optional<HullFaces> faces;
  PlaneTree below(body);
  const double rounding = rounding_of(mesh.points);
  // The plane of a small triangle leans by more than rounding over a large face: the hull's plane there is asked too.
  // Where no plane is near, all triangles may be about equally near, and finding the nearest takes as long as looking at all.
  const auto by_face = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 middle = (p + q + r) / 3;
    const double near = 8 * rounding;  // no less than that of three corners within `rounding`, in doubles
    if (below.depth(middle, near) > near) return kNone;
    if (!faces) faces.emplace(body);
    const std::uint32_t on = faces->about_nearest(middle);
    const auto is_on = [&](const Vec3& point) { return std::abs(faces->depth(on, point)) <= rounding; };
    return is_on(p) && is_on(q) && is_on(r) && faces->normal(on).dot(area_normal(p, q, r)) > 0 ? on : kNone;
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Triangle corners = from_lowest({vertex[i], vertex[j], vertex[k]});
    const bool all_extreme = std::find(corners.begin(), corners.end(), kNone) == corners.end();
    std::uint32_t on = kNone;
    if (all_extreme) {
      const auto last = body.triangles.begin() + begin[corners[0] + 1];
      const auto at = std::lower_bound(body.triangles.begin() + begin[corners[0]], last, corners);
      if (at != last && *at == corners) on = std::uint32_t(at - body.triangles.begin());
    }
    if (on == kNone) {
      if (!planes) planes.emplace(body, rounding);
      on = planes->find(mesh.points[i], mesh.points[j], mesh.points[k]);
    }
    if (on == kNone && planes->may_lean(mesh.points[i], mesh.points[j], mesh.points[k]))
      on = by_face(mesh.points[i], mesh.points[j], mesh.points[k]);
    found[t] = on;
    watch.work();
  }
  return found;
}

std::optional<double> volume_ratio(const Mesh& mesh, const Polytope& body) {
  const Ids first = first_of_equals(mesh.points);
  Polytope surface{mesh.points, mesh.triangles};
  for (Triangle& triangle : surface.triangles)
    for (std::uint32_t& corner : triangle) corner = first[corner];
  if (surface.triangles.empty() || !closes(surface.triangles, surface.points.size())) return std::nullopt;
  return std::abs(precise_volume(surface)) / precise_volume(body);
}

double deepest_dent(const Mesh& mesh, const Hull& hull, const Polytope& body, PlaneTree& planes, Watch& watch) {
  const Ids inner = inner_vertices(mesh, hull);
  if (inner.empty()) return 0;
  const CoarseDepth bound(body);

  std::vector<std::pair<double, std::uint32_t>> at_most;
  for (std::uint32_t v : inner) at_most.emplace_back(bound(mesh.points[v]), v);
  std::sort(at_most.begin(), at_most.end(), std::greater<>());
  double deepest = 0;
  for (const auto& [depth, v] : at_most) {
    if (depth <= deepest) break;
    deepest = std::max(deepest, planes.depth(mesh.points[v], deepest));
    watch.work();
  }
  return deepest;
}

}  // namespace swiftlet::lod
