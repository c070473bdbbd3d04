// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// [Wolfe 1976]: the point of least norm of the hull of all differences of a vertex of B and one of A, every support by a scan
// of all vertices. The norm of the point bounds the distance from above, the support along it from below; it ends where they
// meet.
#include "nearest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/QR>

namespace swiftlet::bench {
namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;

constexpr Real kMeet = 1e-17L, kNear = 1e-15L, kZero = 1e-18L;  // of the coordinates twice, of a weight

Point highest(const ConvexView& view, const Point& direction) {
  Point best = Point::Zero();
  Real height = -HUGE_VALL;
  for (const auto& vertex : view.vertices) {
    const Point p(vertex.x, vertex.y, vertex.z);
    if (const Real h = direction.dot(p); h > height) height = h, best = p;
  }
  return best;
}

/// Points and their weights in the combination of least norm: four at most, but where more lie in a plane.
struct Corral {
  std::vector<Point> points;
  std::vector<Real> weights;

  Point point() const {
    Point v = Point::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) v += weights[i] * points[i];
    return v;
  }
  /// The weights of the point of least norm in the plane, line or space through the points.
  std::vector<Real> affine() const {
    Eigen::Matrix<Real, 3, Eigen::Dynamic> edges(3, Eigen::Index(points.size()) - 1);
    for (Eigen::Index i = 0; i < edges.cols(); ++i) edges.col(i) = points[std::size_t(i) + 1] - points[0];
    std::vector<Real> result{1};
    if (edges.cols() == 0) return result;
    const Eigen::Matrix<Real, Eigen::Dynamic, 1> solved = edges.colPivHouseholderQr().solve(-points[0]);
    for (Eigen::Index i = 0; i < solved.size(); ++i) result.push_back(solved[i]), result[0] -= solved[i];
    return result;
  }
  /// Goes towards that point as far as the hull allows, and drops whom it leaves behind, until it lies within.
  void descend() {
    while (true) {
      const std::vector<Real> to = affine();
      Real way = 1;
      for (std::size_t i = 0; i < to.size(); ++i) {
        if (to[i] <= kZero) way = std::min(way, weights[i] > to[i] ? weights[i] / (weights[i] - to[i]) : 0);
      }
      for (std::size_t i = 0; i < to.size(); ++i) weights[i] += way * (to[i] - weights[i]);
      if (way >= 1) return;
      for (std::size_t i = points.size(); i-- > 0;) {
        if (weights[i] > kZero || points.size() == 1) continue;
        points.erase(points.begin() + std::ptrdiff_t(i));
        weights.erase(weights.begin() + std::ptrdiff_t(i));
      }
    }
  }
};

}  // namespace

std::optional<long double> nearest(const ConvexView& a, const ConvexView& b, const Pose& b_in_a) {
  constexpr int kRounds = 200;  // 5 to 20 but near contact, where the direction, a difference, is rounded more
  const Eigen::Matrix<Real, 3, 3> rotation = b_in_a.rotation.cast<Real>();
  const Point translation = b_in_a.translation.cast<Real>();
  const auto lowest = [&](const Point& v) -> Point {  // of B less A
    return rotation * highest(b, -(rotation.transpose() * v)) + translation - highest(a, v);
  };
  const Real size = std::max(a.extent, b.extent) + translation.norm();
  Corral corral{{lowest(translation)}, {1}};
  Real lower = 0, upper = 0;
  for (int i = 0; i < kRounds; ++i) {
    const Point v = corral.point(), next = lowest(v);
    upper = v.norm();
    if (upper < 1e-12L * size) return std::nullopt;
    lower = std::max(lower, v.dot(next) / upper);
    if (upper - lower <= kMeet * size) return upper;
    corral.points.push_back(next);
    corral.weights.push_back(0);
    corral.descend();
  }
  if (upper - lower <= kNear * size) return upper;
  return std::nullopt;
}

}  // namespace swiftlet::bench
