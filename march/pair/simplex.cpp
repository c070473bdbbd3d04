// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/simplex.h"

#include <limits>

namespace swiftlet {

bool Simplex::has(std::uint32_t va, std::uint32_t vb) const {
  for (int k = 0; k < count_; ++k) {
    if (corner_[k].va == va && corner_[k].vb == vb) return true;
  }
  return false;
}

/// The nearest point of the segment between corners i and j, j the newest.
Simplex::Nearest Simplex::on_segment(int i, int j) const {
  const Vec &p = corner_[i].p, &q = corner_[j].p, u = p - q;
  const double along = -dot(q, u), length2 = dot(u, u);
  if (!(along > 0)) return {q, 1, {j}, {1}};
  if (along >= length2) return {p, 1, {i}, {1}};
  const double t = along / length2;
  return {q + u * t, 2, {i, j}, {t, 1 - t}};
}

/// The nearest point of a triangle [Ericson 2004, sec. 5.1.5], sought only in the regions that hold corner k, the newest.
Simplex::Nearest Simplex::on_triangle(int i, int j, int k) const {
  const Vec &p = corner_[i].p, &q = corner_[j].p, &r = corner_[k].p;
  const Vec u = p - r, v = q - r, n = cross(u, v);
  const double area2 = dot(n, n), w_p = dot(n, cross(v, r)), w_q = dot(n, cross(r, u)), w_r = area2 - w_p - w_q;
  if (w_p > 0 && w_q > 0 && w_r > 0) return {n * (dot(n, r) / area2), 3, {i, j, k}, {w_p / area2, w_q / area2, w_r / area2}};
  const Nearest a = on_segment(i, k), b = on_segment(j, k);
  return dot(a.point, a.point) <= dot(b.point, b.point) ? a : b;
}

Simplex::Nearest Simplex::on_tetrahedron() const {
  Nearest best;
  double least2 = std::numeric_limits<double>::infinity();
  const Vec& apex = corner_[3].p;
  for (const auto& [i, j, opposite] : {std::array{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
    const Vec n = cross(corner_[i].p - apex, corner_[j].p - apex);
    const double height = dot(n, corner_[opposite].p - apex), from_origin = dot(n, apex);
    if (height < 0 ? from_origin > 0 : height > 0 && from_origin < 0) continue;  // the origin is on the inner side
    const Nearest face = on_triangle(i, j, 3);
    if (const double d2 = dot(face.point, face.point); d2 < least2) least2 = d2, best = face;
  }
  if (best.count == 0) best.count = 4;
  return best;
}

Simplex::Nearest Simplex::add(const Corner& corner) {
  corner_[count_++] = corner;
  switch (count_) {
    case 1: return {corner.p, 1, {0}, {1}};
    case 2: return on_segment(0, 1);
    case 3: return on_triangle(0, 1, 2);
    default: return on_tetrahedron();
  }
}

Simplex::Points Simplex::reduce(const Nearest& nearest) {
  Points points;
  for (int k = 0; k < nearest.count; ++k) {
    if (nearest.index[k] != k) corner_[k] = corner_[nearest.index[k]];
    points.a = points.a + corner_[k].a * nearest.weight[k];
    points.apart = points.apart + corner_[k].p * nearest.weight[k];
  }
  count_ = nearest.count;
  return points;
}

OverlapProof Simplex::proof() const {
  OverlapProof proof{4, {}, {}};
  for (int k = 0; k < 4; ++k) proof.vertex_a[k] = corner_[k].va, proof.vertex_b[k] = corner_[k].vb;
  return proof;
}

}  // namespace swiftlet
