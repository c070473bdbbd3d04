// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/intersections.h>
#include <Eigen/Geometry>

namespace swiftlet::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Real = Kernel::FT;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Vector3 = Kernel::Vector_3;

Vector3 exact(const Vec3& v) { return {v[0], v[1], v[2]}; }
Real dot(const Vector3& p, const Vector3& q) { return p * q; }

Vector3 moved(const Pose& pose, const Vec3& p) {
  const Vector3 q = exact(p);
  return {dot(exact(pose.rotation.row(0)), q) + pose.translation[0], dot(exact(pose.rotation.row(1)), q) + pose.translation[1],
          dot(exact(pose.rotation.row(2)), q) + pose.translation[2]};
}

/// Two directions across n, at right angles, of lengths |u| and |u| |n|.
struct Frame {
  Vector3 n, u, v;
  explicit Frame(const Vec3& direction) : n(exact(direction)) {
    Eigen::Index least = 0;
    direction.cwiseAbs().minCoeff(&least);
    u = CGAL::cross_product(n, exact(Vec3::Unit(least)));
    v = CGAL::cross_product(n, u);
  }
  Point2 seen(const Vector3& p) const { return {dot(u, p), dot(v, p)}; }
};

using Loop = std::vector<Point2>;  // counter-clockwise

Loop seen_hull(const ConvexView& view, const std::vector<std::uint32_t>& faces, const Pose& pose, const Frame& frame) {
  const std::set<std::uint32_t> wanted(faces.begin(), faces.end());
  Loop seen, hull;
  for (const HalfEdge& h : view.half_edges) {
    const Vertex& p = view.vertices[h.head];
    if (wanted.count(h.face)) seen.push_back(frame.seen(moved(pose, Vec3(p.x, p.y, p.z))));
  }
  CGAL::convex_hull_2(seen.begin(), seen.end(), std::back_inserter(hull));
  return hull;
}

bool holds(const Loop& loop, const Point2& p) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (CGAL::orientation(loop[i], loop[(i + 1) % loop.size()], p) == CGAL::RIGHT_TURN) return false;
  }
  return true;
}

/// How far a place lies inside of a loop; 0 outside.
double depth_in(const Loop& loop, const Point2& p, const Frame& frame) {
  if (loop.size() < 3 || !holds(loop, p)) return 0;
  Real least = CGAL::squared_distance(p, Kernel::Line_2(loop.back(), loop.front()));
  for (std::size_t i = 1; i < loop.size(); ++i)
    least = std::min(least, CGAL::squared_distance(p, Kernel::Line_2(loop[i - 1], loop[i])));
  return std::sqrt(CGAL::to_double(least / dot(frame.u, frame.u)));
}

/// Coordinates are stretched by |u| and by |v| = |u| |n|.
double area_of(const Loop& loop, const Frame& frame) {
  const CGAL::Polygon_2<Kernel> polygon(loop.begin(), loop.end());
  return CGAL::to_double(polygon.area() / dot(frame.u, frame.u)) / std::sqrt(CGAL::to_double(dot(frame.n, frame.n)));
}

}  // namespace

Overlay overlay(const ConvexView& a, const std::vector<std::uint32_t>& faces_a, const ConvexView& b,
                const std::vector<std::uint32_t>& faces_b, const Pose& b_in_a, const Vec3& n, const Vec3& point) {
  const Frame frame(n);
  const Loop loop_a = seen_hull(a, faces_a, Pose{}, frame), loop_b = seen_hull(b, faces_b, b_in_a, frame);
  Loop common, hull;
  for (const Point2& p : loop_a) {
    if (holds(loop_b, p)) common.push_back(p);
  }
  for (const Point2& p : loop_b) {
    if (holds(loop_a, p)) common.push_back(p);
  }
  for (std::size_t i = 0; i < loop_a.size(); ++i) {
    const Kernel::Segment_2 side_a(loop_a[i], loop_a[(i + 1) % loop_a.size()]);
    for (std::size_t j = 0; j < loop_b.size(); ++j) {
      const Kernel::Segment_2 side_b(loop_b[j], loop_b[(j + 1) % loop_b.size()]);
      if (!CGAL::do_intersect(side_a, side_b)) continue;
      const auto met = CGAL::intersection(side_a, side_b);
      if (const Point2* p = boost::get<Point2>(&*met)) common.push_back(*p);
    }
  }
  CGAL::convex_hull_2(common.begin(), common.end(), std::back_inserter(hull));
  return {hull.size(), hull.size() > 2 ? area_of(hull, frame) : 0, depth_in(hull, frame.seen(exact(point)), frame)};
}

double area(const std::vector<Vec3>& points, const Vec3& n) {
  const Frame frame(n);
  Loop seen, loop;
  for (const Vec3& p : points) seen.push_back(frame.seen(exact(p)));
  CGAL::convex_hull_2(seen.begin(), seen.end(), std::back_inserter(loop));
  return loop.size() > 2 ? area_of(loop, frame) : 0;
}

double height_over(const ConvexView& body, const Pose& in_a, const Vec3& point) {
  std::vector<Vector3> vertices;
  for (const Vertex& v : body.vertices) vertices.push_back(moved(in_a, Vec3(v.x, v.y, v.z)));
  const Vector3 p = exact(point);
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& [head, twin, face] : body.half_edges) {
    if (face == kNone) continue;
    // The facet on the left: its corner after the head follows the twin, clockwise, in the head's ring.
    const Vertex& ring = body.vertices[head];
    const std::uint32_t next = twin == ring.ring_begin ? twin + ring.ring_count - 1 : twin - 1;
    const Vector3 &q = vertices[body.half_edges[twin].head], &r = vertices[head], &s = vertices[body.half_edges[next].head];
    const Vector3 normal = CGAL::cross_product(r - q, s - q);
    const Real height = dot(normal, p - q), square = dot(normal, normal);
    if (square == 0) continue;
    const double apart = std::sqrt(CGAL::to_double(height * height / square));
    highest = std::max(highest, height < 0 ? -apart : apart);
  }
  return std::isinf(highest) ? 0 : highest;
}

namespace {

/// The sides of a face, from tail to head.
std::vector<std::array<Vec3, 2>> sides_of(const ConvexView& body, std::uint32_t face) {
  std::vector<std::array<Vec3, 2>> result;
  const auto point = [&](std::uint32_t v) { return Vec3(body.vertices[v].x, body.vertices[v].y, body.vertices[v].z); };
  for (const HalfEdge& h : body.half_edges) {
    const HalfEdge& back = body.half_edges[h.twin];
    if (h.face == face && back.face != face) result.push_back({point(back.head), point(h.head)});
  }
  return result;
}

}  // namespace

Vec3 face_normal(const ConvexView& body, FeatureId face) {
  const auto sides = sides_of(body, face.index());
  const Vector3 first = exact(sides[0][0]);
  Vector3 sum(0, 0, 0);
  for (const auto& [p, q] : sides) sum += CGAL::cross_product(exact(p) - first, exact(q) - first);
  const Real square = dot(sum, sum);
  if (square == 0) return Vec3::Zero();
  const auto rounded = [&](const Real& x) {  // of a lazy number `to_double` alone is right to 1e-5
    const double cosine = std::sqrt(CGAL::to_double(CGAL::exact(Real(x * x / square))));
    return x < 0 ? -cosine : cosine;
  };
  return {rounded(sum.x()), rounded(sum.y()), rounded(sum.z())};
}

bool faces_best(const ConvexView& body, const Vec3& n, FeatureId feature, FeatureId face) {
  const auto facing = [&](std::uint32_t f) {
    const Vec3 normal = f < body.planes.size() ? Vec3(body.planes[f].x, body.planes[f].y, body.planes[f].z)
                                               : face_normal(body, {FeatureKind::Face, f});
    return normal.isZero() ? -1 : normal.dot(n);
  };
  const auto is_at_feature = [&](const HalfEdge& h) {
    if (feature.kind() == FeatureKind::Vertex) return h.head == feature.index();
    if (feature.kind() == FeatureKind::Face) return h.face == feature.index();
    return h.twin == feature.index() || body.half_edges[h.twin].twin == feature.index();
  };
  const double most = facing(face.index()) + 0x1p-42;
  return std::none_of(body.half_edges.begin(), body.half_edges.end(),
                      [&](const HalfEdge& h) { return h.face != kNone && is_at_feature(h) && facing(h.face) > most; });
}

std::vector<std::uint32_t> flat_faces(const ConvexView& body, FeatureId face, double flatness) {
  const Vec3 n = face_normal(body, face), p = sides_of(body, face.index())[0][0];
  std::vector<bool> is_flat(body.face_first.size());
  for (std::uint32_t other = 0; other < body.face_first.size(); ++other) {
    const auto sides = sides_of(body, other);
    is_flat[other] = std::all_of(sides.begin(), sides.end(),
                                 [&](const auto& side) { return n.dot(side[0] - p) >= -flatness * body.extent; }) &&
                     n.dot(face_normal(body, {FeatureKind::Face, other})) > 0;
  }
  std::vector<std::uint32_t> faces{face.index()};
  is_flat[face.index()] = false;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (const HalfEdge& h : body.half_edges) {
      const std::uint32_t beside = body.half_edges[h.twin].face;
      if (h.face != faces[i] || beside == kNone || !is_flat[beside]) continue;
      is_flat[beside] = false;
      faces.push_back(beside);
    }
  }
  return faces;
}

}  // namespace swiftlet::oracle
