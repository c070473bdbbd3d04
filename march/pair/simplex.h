// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The simplex step of GJK [Gilbert, Johnson & Keerthi 1988]: the point nearest to the origin in the hull of at most four points
// of the Minkowski difference. Two solvers: `add` for a cold start, which takes a direction from the point, and
// `nearest_to_origin` for certified GJK, which takes its bounds from it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <swiftlet/march.h>

#include "numeric/vec4.h"
#include "pair/difference.h"

namespace swiftlet {

/// The corners that hold the nearest point of those added so far.
struct Simplex {
  struct Corner {
    Vec p;  ///< vertex `vb` of B less vertex `va` of A, in the common frame
    std::uint32_t va, vb;
  };

  bool has(std::uint32_t va, std::uint32_t vb) const {
    for (int k = 0; k < count; ++k) {
      if (corner[k].va == va && corner[k].vb == vb) return true;
    }
    return false;
  }
  int heaviest() const { return int(std::max_element(weight.begin(), weight.begin() + count) - weight.begin()); }
  OverlapProof proof() const {
    return {
        4, {corner[0].va, corner[1].va, corner[2].va, corner[3].va}, {corner[0].vb, corner[1].vb, corner[2].vb, corner[3].vb}};
  }

  std::array<Corner, 4> corner;
  std::array<double, 3> weight;  ///< of at most three corners; they sum to 1, but for rounding
  Vec nearest;                   ///< to the origin; off the weighted sum of the corners by rounding
  int count = 0;                 ///< of the corners; 4: the simplex holds the origin
};

/// The solver in doubles. Adds a corner and drops those that do not hold the nearest point, taking for granted that the new one
/// does: so the point lies there, on an edge from there, or in a face beside it [Ericson 2004, sec. 5.1]. Edges to the old
/// corners are lanes of vectors, and so are faces, each between a lane's edge and the next lane's.
static inline void add(Simplex& simplex, const Simplex::Corner& corner) {
  const int count = simplex.count;
  std::array<Simplex::Corner, 4>& old = simplex.corner;
  if (count == 0) {
    old[0] = corner, simplex.weight[0] = 1, simplex.nearest = corner.p, simplex.count = 1;
    return;
  }
  const auto of_next = [](const V3<Vec4>& v) { return V3<Vec4>{yzx(v.x), yzx(v.y), yzx(v.z)}; };
  const Vec &second = old[count > 1 ? 1 : 0].p, &third = old[count > 2 ? 2 : 0].p;
  const V3<Vec4> newest = repeated(corner.p), edge = transposed(old[0].p, second, third, third) - newest, next = of_next(edge);

  unsigned faces = count == 2 ? 1 : 0;  // those that the origin is not on the inner side of
  if (count == 3) {
    const V3<Vec4> n = cross(edge, next);
    const Vec4 height = dot(n, of_next(next)), origin = -dot(n, newest), none = all(0);
    faces = ~(greater(height, none) & greater(origin, none)) & ~(greater(none, height) & greater(none, origin)) & 7;
    if (faces == 0) {
      old[3] = corner, simplex.count = 4;
      return;
    }
  }
  const unsigned edges = count == 1 ? 1 : (faces | faces << 1 | faces >> 2) & 7;

  const Vec4 length2 = dot(edge, edge), along = -dot(edge, newest), both = dot(edge, next), next_length2 = yzx(length2),
             next_along = yzx(along);
  const Vec4 u = along * next_length2 - next_along * both, v = next_along * length2 - along * both,
             area2 = length2 * next_length2 - both * both, w = area2 - u - v;
  const Vec4 share = min(max(all(0), along / length2), all(1));  // 0 of an edge without length
  // By how much the squared norm of the nearest point is less than that of the corner.
  const Vec4 gain_on = share * (along + along - share * length2), scale = all(1) / area2,
             gain_in = u * scale * along + v * scale * next_along;
  int i = 0, j = 0;
  double of_i = 0, of_j = 0, of_newest = 1, gain = 0;
  for (unsigned left = edges; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    if (gain_on[k] > gain) gain = gain_on[k], i = k, of_i = share[k], of_newest = 1 - of_i;
  }
  for (unsigned left = faces & greater(min(min(u, v), w), all(0)); left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    if (!(gain_in[k] >= gain)) continue;
    gain = gain_in[k], i = k, j = k + 1;
    of_i = u[k] * scale[k], of_j = v[k] * scale[k], of_newest = w[k] * scale[k];
  }
  if (j == 3) i = 0, j = 2, std::swap(of_i, of_j);

  const Vec kept_i = old[i].p, kept_j = old[j].p;
  int kept = 0;
  const auto keep = [&](const Simplex::Corner& c, double weight) {
    if (weight > 0) old[kept] = c, simplex.weight[kept++] = weight;
  };
  keep(old[i], of_i), keep(old[j], of_j), keep(corner, of_newest);
  simplex.count = kept;
  simplex.nearest = corner.p + (kept_i - corner.p) * of_i + (kept_j - corner.p) * of_j;
}

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
