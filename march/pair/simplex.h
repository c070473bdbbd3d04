// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The simplex step of GJK [Gilbert, Johnson & Keerthi 1988]: the point nearest to the origin in the hull of at most four points
// of the Minkowski difference. Two solvers: `Simplex` for a cold start, which takes only a direction from the point, and
// `nearest_to_origin` for certified GJK, which takes its bounds from it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <swiftlet/march.h>

#include "pair/difference.h"

namespace swiftlet {

/// The solver in doubles. It tests the Voronoi regions of [Ericson 2004, sec. 5.1] that hold the newest corner. With
/// `nearest_to_origin` instead, a whole cold query takes up to 14 % more instructions.
class Simplex {
 public:
  struct Corner {
    Vec p, a;  ///< `a` is the point of A, `p` that of B less `a`, in the common frame
    std::uint32_t va, vb;
  };
  struct Nearest {
    Vec point{0, 0, 0};          ///< the point of the simplex nearest to the origin
    int count = 0;               ///< number of corners whose hull holds `point`; 4: the simplex holds the origin
    std::array<int, 4> index{};  ///< the corners whose hull holds `point`, ascending
    std::array<double, 4> weight{};
  };

  bool has(std::uint32_t va, std::uint32_t vb) const;
  /// Adds a corner and finds the nearest point, taking for granted that the new corner is one of those that hold it.
  Nearest add(const Corner& corner);
  /// A point of A, and the vector from it to a point of B.
  struct Points {
    Vec a{0, 0, 0}, apart{0, 0, 0};
  };
  /// Keeps only the corners that hold the nearest point. Returns the points that the weights in `nearest` make of these
  /// corners: if a triangle is nearly a line, `nearest.point` is no combination of the corners, and off by more than rounding.
  Points reduce(const Nearest& nearest);
  OverlapProof proof() const;

 private:
  Nearest on_segment(int i, int j) const;
  Nearest on_triangle(int i, int j, int k) const;
  Nearest on_tetrahedron() const;

  std::array<Corner, 4> corner_;
  int count_ = 0;
};

/// The point of a simplex nearest to the origin, as a convex combination of its corners.
template <class Real>
struct NearestOrigin {
  int count = 0;
  std::array<int, 4> index{};
  std::array<Real, 4> weight{};
  V3<Real> point{Real(0), Real(0), Real(0)};
  double norm2 = std::numeric_limits<double>::infinity();
  bool holds_origin = false;  ///< the simplex has four corners and holds the origin
};

/// The solver in doubles or 106 bits. It tries every subset of the first `count` points of `set`, so that no degeneracy
/// confuses it: a candidate is a point of the simplex if its weights are positive, and smaller subsets stand for weights of 0.
/// Through each candidate goes the plane normal to the line from the origin to it; the solver takes the candidate whose plane
/// cuts off the least of the simplex. The candidate's norm is no criterion: it is flat about
/// the optimum, and would hide a step of 1e-9 under a rounding of 1e-17.
template <class Real>
static inline NearestOrigin<Real> nearest_to_origin(const std::array<Difference<Real>, 4>& set, int count) {
  NearestOrigin<Real> best;
  const Real zero(0);
  double least_cut = std::numeric_limits<double>::infinity();
  const auto offer = [&](int n, std::array<int, 4> index, std::array<Real, 4> weight, const V3<Real>& point) {
    const Real norm2 = dot(point, point);
    Real cut = zero;
    for (int i = 0; i < count; ++i) {
      if (const Real beyond = norm2 - dot(set[i].p, point); beyond > cut) cut = beyond;
    }
    const double length = std::sqrt(rounded(norm2));
    const double relative = length > 0 ? std::fmin(rounded(cut) / length, length) : 0;  // every plane proves a bound >= 0
    if (relative < least_cut) least_cut = relative, best = {n, index, weight, point, rounded(norm2), false};
  };
  for (int i = 0; i < count; ++i) offer(1, {i}, {Real(1)}, set[i].p);
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const V3<Real>&p = set[i].p, u = set[j].p - p;
      const Real length2 = dot(u, u), along = -dot(p, u);
      if (!(along > zero && along < length2)) continue;
      const Real t = along / length2;
      offer(2, {i, j}, {Real(1) - t, t}, p + u * t);
    }
  }
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        const V3<Real>&p = set[i].p, &q = set[j].p, &r = set[k].p;
        const V3<Real> n = cross(q - p, r - p);
        const Real n2 = dot(n, n), wp = dot(n, cross(q, r)), wq = dot(n, cross(r, p)), wr = dot(n, cross(p, q));
        if (!(n2 > zero && wp > zero && wq > zero && wr > zero)) continue;
        const Real sum = wp + wq + wr;  // n2, but for rounding
        offer(3, {i, j, k}, {wp / sum, wq / sum, wr / sum}, n * (dot(n, p) / n2));
      }
    }
  }
  if (count == 4) {
    const V3<Real>&p = set[0].p, &q = set[1].p, &r = set[2].p, &s = set[3].p;
    const std::array<Real, 4> w{dot(cross(q, s), r), dot(cross(p, r), s), dot(cross(p, s), q), dot(cross(p, q), r)};
    const bool positive = w[0] > zero && w[1] > zero && w[2] > zero && w[3] > zero;
    const bool negative = w[0] < zero && w[1] < zero && w[2] < zero && w[3] < zero;
    if (positive || negative) {
      const Real sum = w[0] + w[1] + w[2] + w[3];
      best = {4, {0, 1, 2, 3}, {w[0] / sum, w[1] / sum, w[2] / sum, w[3] / sum}, {zero, zero, zero}, 0, true};
    }
  }
  return best;
}

}  // namespace swiftlet
