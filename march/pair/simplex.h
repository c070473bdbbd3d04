// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The simplex step of GJK [Gilbert, Johnson & Keerthi 1988]: the point nearest to the origin in the hull of at most four points
// of the Minkowski difference. Two solvers: `Simplex` for a cold start, which takes only a direction from the point, and
// `nearest_to_origin` for certified GJK, which takes its bounds from it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <swiftlet/march.h>

#include "pair/difference.h"

namespace swiftlet {

/// The solver in doubles: the corners that hold the nearest point of those added so far. It tests the Voronoi regions of
/// [Ericson 2004, sec. 5.1] that hold the newest corner. With `nearest_to_origin` instead, a whole cold query takes up to 14 %
/// more instructions.
class Simplex {
 public:
  struct Corner {
    Vec p;  ///< vertex `vb` of B less vertex `va` of A, in the common frame
    std::uint32_t va, vb;
  };

  int count() const { return count_; }  ///< 4: the simplex holds the origin
  const Corner& operator[](int k) const { return corner_[k]; }
  double weight(int k) const { return weight_[k]; }  ///< of at most three corners; they sum to 1, but for rounding
  /// The point of the simplex nearest to the origin. It is off the weighted sum of the corners by rounding.
  const Vec& nearest() const { return nearest_; }
  bool has(std::uint32_t va, std::uint32_t vb) const {
    for (int k = 0; k < count_; ++k) {
      if (corner_[k].va == va && corner_[k].vb == vb) return true;
    }
    return false;
  }
  /// Adds a corner and drops those that do not hold the nearest point, taking for granted that the new one does.
  void add(const Corner& corner);
  OverlapProof proof() const;

 private:
  void add_second(const Corner& q);
  void add_third(const Corner& r);
  void add_fourth(const Corner& apex);
  void keep(const Corner& only);
  void keep(const Corner& p, const Corner& q, double share_p);

  std::array<Corner, 4> corner_;
  std::array<double, 3> weight_;
  Vec nearest_;
  int count_ = 0;
};

/// The point of a simplex nearest to the origin, as a convex combination of its corners.
template <class Real>
struct NearestOrigin {
  int count = 0;
  std::array<int, 4> index{};
  std::array<Real, 4> weight{};
  V3<Real> point{Real(0), Real(0), Real(0)};
  double norm2 = kInfinity;
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
  double least_cut = kInfinity;
  const auto offer = [&](int n, std::array<int, 4> index, std::array<Real, 4> weight, const V3<Real>& point) {
    const Real norm2 = dot(point, point);
    Real cut = zero;
    for (int i = 0; i < count; ++i) {
      if (const Real beyond = norm2 - dot(set[i].p, point); beyond > cut) cut = beyond;
    }
    const double length = std::sqrt(rounded(norm2));
    const double relative = length > 0 ? min(length, rounded(cut) / length) : 0;  // every plane proves a bound >= 0
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
