// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "patch_oracle.h"

#include <cmath>
#include <set>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/intersections.h>

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
  /// The point of a plane that is seen there.
  Vector3 on_plane(const Point2& at, const Vector3& origin, const Vector3& normal) const {
    const Vector3 p = u * (at.x() / dot(u, u)) + v * (at.y() / dot(v, v));
    return p + n * (dot(normal, origin - p) / dot(normal, n));
  }
};

struct Face {
  std::vector<Point2> loop;  // counter-clockwise
  Vector3 origin, normal;
};

Face face_of(const ConvexView& view, const std::vector<std::uint32_t>& faces, const Pose& pose, const Frame& frame) {
  const std::set<std::uint32_t> wanted(faces.begin(), faces.end());
  const auto point = [&](std::uint32_t v) {
    const Vertex& p = view.vertices[v];
    return moved(pose, Vec3(p.x, p.y, p.z));
  };
  std::vector<Point2> seen;
  for (std::uint32_t h = 0; h < view.head.size(); ++h) {
    if (wanted.count(view.face[h])) seen.push_back(frame.seen(point(view.head[h])));
  }
  Face face;
  CGAL::convex_hull_2(seen.begin(), seen.end(), std::back_inserter(face.loop));
  // Three corners far apart: of a walking face the plane is not one.
  std::vector<Vector3> corners;
  for (std::uint32_t h = 0; h < view.head.size(); ++h) {
    if (view.face[h] == faces[0]) corners.push_back(point(view.head[h]));
  }
  face.origin = corners[0];
  Real most = 0;
  for (const Vector3& p : corners) {
    for (const Vector3& q : corners) {
      const Vector3 normal = CGAL::cross_product(p - corners[0], q - corners[0]);
      if (dot(normal, normal) > most) most = dot(normal, normal), face.normal = normal;
    }
  }
  return face;
}

bool holds(const std::vector<Point2>& loop, const Point2& p) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (CGAL::orientation(loop[i], loop[(i + 1) % loop.size()], p) == CGAL::RIGHT_TURN) return false;
  }
  return true;
}

/// Coordinates are stretched by |u| and by |v| = |u| |n|.
double area_of(const std::vector<Point2>& loop, const Frame& frame) {
  const CGAL::Polygon_2<Kernel> polygon(loop.begin(), loop.end());
  return CGAL::to_double(polygon.area() / dot(frame.u, frame.u)) / std::sqrt(CGAL::to_double(dot(frame.n, frame.n)));
}

}  // namespace

Overlay overlay(const ConvexView& a, const std::vector<std::uint32_t>& faces_a, const ConvexView& b,
                const std::vector<std::uint32_t>& faces_b, const Pose& b_in_a, const Vec3& n) {
  const Frame frame(n);
  const Face face_a = face_of(a, faces_a, Pose{}, frame), face_b = face_of(b, faces_b, b_in_a, frame);
  std::vector<Point2> common;
  for (const Point2& p : face_a.loop) {
    if (holds(face_b.loop, p)) common.push_back(p);
  }
  for (const Point2& p : face_b.loop) {
    if (holds(face_a.loop, p)) common.push_back(p);
  }
  for (std::size_t i = 0; i < face_a.loop.size(); ++i) {
    const Kernel::Segment_2 side_a(face_a.loop[i], face_a.loop[(i + 1) % face_a.loop.size()]);
    for (std::size_t j = 0; j < face_b.loop.size(); ++j) {
      const Kernel::Segment_2 side_b(face_b.loop[j], face_b.loop[(j + 1) % face_b.loop.size()]);
      if (!CGAL::do_intersect(side_a, side_b)) continue;
      const auto met = CGAL::intersection(side_a, side_b);
      if (const Point2* p = boost::get<Point2>(&*met)) common.push_back(*p);
    }
  }
  std::vector<Point2> loop;
  CGAL::convex_hull_2(common.begin(), common.end(), std::back_inserter(loop));
  Overlay result;
  const double length = std::sqrt(CGAL::to_double(dot(frame.n, frame.n)));
  for (const Point2& at : loop) {
    const Vector3 p = frame.on_plane(at, face_a.origin, face_a.normal), q = frame.on_plane(at, face_b.origin, face_b.normal);
    result.corners.push_back({{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())},
                              CGAL::to_double(dot(q - p, frame.n)) / length});
  }
  if (loop.size() > 2) result.area = area_of(loop, frame);
  return result;
}

double area(const std::vector<Vec3>& points, const Vec3& n) {
  const Frame frame(n);
  std::vector<Point2> seen, loop;
  for (const Vec3& p : points) seen.push_back(frame.seen(exact(p)));
  CGAL::convex_hull_2(seen.begin(), seen.end(), std::back_inserter(loop));
  return loop.size() > 2 ? area_of(loop, frame) : 0;
}

bool lies_in(const ConvexView& body, const Pose& in_a, const Vec3& point, double tolerance) {
  std::vector<Vector3> vertices;
  for (const Vertex& v : body.vertices) vertices.push_back(moved(in_a, Vec3(v.x, v.y, v.z)));
  const Vector3 p = exact(point);
  for (std::uint32_t h = 0; h < body.head.size(); ++h) {
    if (body.face[h] == kNone) continue;
    // The facet on the left of h: its corner after the head follows the twin, clockwise, in the head's ring.
    const Vertex& ring = body.vertices[body.head[h]];
    const std::uint32_t back = body.twin[h], next = back == ring.ring_begin ? back + ring.ring_count - 1 : back - 1;
    const Vector3 &q = vertices[body.head[back]], &r = vertices[body.head[h]], &s = vertices[body.head[next]];
    const Vector3 normal = CGAL::cross_product(r - q, s - q);
    const Real height = dot(normal, p - q);
    if (height > 0 && height * height > dot(normal, normal) * Real(tolerance) * Real(tolerance)) return false;
  }
  return true;
}

}  // namespace swiftlet::oracle
