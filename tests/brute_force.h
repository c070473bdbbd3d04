// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Distance and depth of two small polytopes in one frame, by brute force over their features and all separating axes. What the
// adapters' answers are judged by.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include <swiftlet/pose.h>

#include "bodies.h"

namespace swiftlet {

inline constexpr double kFarthest = std::numeric_limits<double>::infinity();

/// A solid, a flat triangle, a segment or a point.
struct Polytope {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;
};

inline Polytope moved(Polytope body, const Pose& pose) {
  for (Vec3& p : body.points) p = pose.rotation * p + pose.translation;
  return body;
}

inline Polytope polytope_of(const ConvexView& view) {
  Polytope body{bodies::points_of(view), {}, {}};
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    std::vector<int> loop;
    for (const std::uint32_t v : FaceLoop(view, f)) loop.push_back(int(v));
    for (std::size_t i = 2; i < loop.size(); ++i) body.triangles.push_back({loop[0], loop[i - 1], loop[i]});
    for (std::size_t i = 0; i < loop.size(); ++i) body.edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
  return body;
}

inline Polytope polytope_of(const bodies::Polyhedron& body) { return polytope_of(bodies::model(body).level(0).view); }

inline double point_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0., 1.) : 0;
  return (p - a - t * d).norm();
}

inline double point_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const auto is_left = [&](const Vec3& q, const Vec3& r) { return n.dot((r - q).cross(p - q)) >= 0; };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::abs(n.dot(p - a));
  return std::min({point_segment(p, a, b), point_segment(p, b, c), point_segment(p, c, a)});
}

inline double segment_segment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double least = std::min({point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b)});
  const Vec3 u = b - a, v = d - c, n = u.cross(v);
  if (n.squaredNorm() < 1e-20 * u.squaredNorm() * v.squaredNorm()) return least;
  const double s = (c - a).cross(v).dot(n) / n.squaredNorm(), t = (c - a).cross(u).dot(n) / n.squaredNorm();
  return s > 0 && s < 1 && t > 0 && t < 1 ? std::min(least, std::abs(n.dot(c - a)) / n.norm()) : least;
}

/// Apart, the distance of the nearest features; else minus the least depth, which lies along a normal or a product of edges.
inline double signed_gap(const Polytope& a, const Polytope& b) {
  double best = -kFarthest;
  const auto consider = [&](const Vec3& axis) {
    if (axis.norm() < 1e-9) return;
    const Vec3 n = axis.normalized();
    double least_a = kFarthest, most_a = -kFarthest, least_b = kFarthest, most_b = -kFarthest;
    for (const Vec3& p : a.points) least_a = std::min(least_a, n.dot(p)), most_a = std::max(most_a, n.dot(p));
    for (const Vec3& p : b.points) least_b = std::min(least_b, n.dot(p)), most_b = std::max(most_b, n.dot(p));
    best = std::max({best, least_b - most_a, least_a - most_b});
  };
  const auto edge = [](const Polytope& body, int i) {
    return Vec3(body.points[body.edges[i][1]] - body.points[body.edges[i][0]]);
  };
  for (const Polytope* body : {&a, &b}) {
    for (const auto& [i, j, k] : body->triangles)
      consider((body->points[j] - body->points[i]).cross(body->points[k] - body->points[i]));
  }
  for (int i = 0; i < int(a.edges.size()); ++i) {
    for (int j = 0; j < int(b.edges.size()); ++j) consider(edge(a, i).cross(edge(b, j)));
  }
  if (best <= 0) return best;
  double least = kFarthest;
  const auto points_of_one = [&](const Polytope& one, const Polytope& other) {
    for (const Vec3& p : one.points) {
      for (const auto& [i, j, k] : other.triangles)
        least = std::min(least, point_triangle(p, other.points[i], other.points[j], other.points[k]));
      if (other.points.size() == 1) least = std::min(least, (p - other.points[0]).norm());
    }
  };
  points_of_one(a, b), points_of_one(b, a);
  for (const auto& [i, j] : a.edges) {
    for (const auto& [k, l] : b.edges)
      least = std::min(least, segment_segment(a.points[i], a.points[j], b.points[k], b.points[l]));
    for (const Vec3& p : b.points) least = std::min(least, point_segment(p, a.points[i], a.points[j]));
  }
  return least;
}

}  // namespace swiftlet
