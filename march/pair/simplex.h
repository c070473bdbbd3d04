// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The point nearest to the origin of at most four points of the Minkowski difference, what an iteration of [Gilbert, Johnson &
// Keerthi 1988] goes on from. Two solvers: a cold start takes a direction from it and needs no more, certified GJK lives by it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <swiftlet/march.h>

#include "pair/difference.h"

namespace swiftlet {

/// In doubles, by the regions of [Ericson 2004, sec. 5.1] that hold the newest corner. A whole cold query takes up to
/// 14 % more instructions with the solver below.
class Simplex {
 public:
  struct Corner {
    Vec p, a;  ///< b - a, and a, in the common frame
    std::uint32_t va, vb;
  };
  struct Nearest {
    Vec point{0, 0, 0};          ///< to the origin
    int count = 0;               ///< of corners that hold it; 4: the simplex holds the origin
    std::array<int, 4> index{};  ///< ascending
    std::array<double, 4> weight{};
  };

  bool has(std::uint32_t va, std::uint32_t vb) const;
  /// Adds a corner and finds the nearest point, the new corner among those that hold it.
  Nearest add(const Corner& corner);
  /// A point of A, and from there to one of B.
  struct Points {
    Vec a{0, 0, 0}, apart{0, 0, 0};
  };
  /// Keeps what holds the nearest point; returns the points that its weights stand for: of a triangle seen as a line the
  /// nearest point is no combination of the corners, and off by more than rounding.
  Points reduce(const Nearest& nearest);
  OverlapProof proof() const;

 private:
  Nearest on_segment(int i, int j) const;
  Nearest on_triangle(int i, int j, int k) const;
  Nearest on_tetrahedron() const;

  std::array<Corner, 4> corner_;
  int count_ = 0;
};

/// The nearest point as a convex combination.
template <class Real>
struct NearestOrigin {
  int count = 0;
  std::array<int, 4> index{};
  std::array<Real, 4> weight{};
  V3<Real> point{Real(0), Real(0), Real(0)};
  double norm2 = std::numeric_limits<double>::infinity();
  bool holds_origin = false;  ///< four points around it
};

/// In doubles or 106 bits, by every subset, which no degeneracy confuses: a candidate with weights >= 0 is a point of the
/// simplex. The nearest is the one whose plane cuts off the least of the simplex: its norm alone is flat about the optimum, and
/// would hide a step of 1e-9 under a rounding of 1e-17.
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
    const double relative = length > 0 ? std::fmin(rounded(cut) / length, length) : 0;  // no plane proves less than 0
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
