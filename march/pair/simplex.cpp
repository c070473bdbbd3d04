// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/simplex.h"

namespace swiftlet {
namespace {

/// The segment from the newest corner r to r + u, beside the origin: how far the nearest point is along u, and by how much its
/// squared norm is less than that of r.
struct Along {
  double share, gain;
};
Along along(double towards, double length2) {
  if (!(towards > 0)) return {0, 0};
  if (towards >= length2) return {1, 2 * towards - length2};
  const double share = towards / length2;
  return {share, share * towards};
}

}  // namespace

void Simplex::keep(const Corner& only) {
  nearest_ = only.p, weight_[0] = 1;
  corner_[0] = only, count_ = 1;
}

void Simplex::keep(const Corner& p, const Corner& q, double share_p) {
  if (!(share_p > 0)) return keep(q);
  if (share_p == 1) return keep(p);
  nearest_ = q.p + (p.p - q.p) * share_p;
  weight_[0] = share_p, weight_[1] = 1 - share_p;
  const Corner newest = q;
  corner_[0] = p, corner_[1] = newest, count_ = 2;
}

void Simplex::add_second(const Corner& q) {
  const Corner p = corner_[0];
  const Vec u = p.p - q.p;
  keep(p, q, along(-dot(q.p, u), dot(u, u)).share);
}

void Simplex::add_third(const Corner& r) {
  const Corner p = corner_[0], q = corner_[1];
  const Vec u = p.p - r.p, v = q.p - r.p;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), ru = -dot(r.p, u), rv = -dot(r.p, v);
  const double area2 = uu * vv - uv * uv, w_p = ru * vv - rv * uv, w_q = rv * uu - ru * uv, w_r = area2 - w_p - w_q;
  if (w_p > 0 && w_q > 0 && w_r > 0) {
    const double scale = 1 / area2;
    weight_ = {w_p * scale, w_q * scale, w_r * scale};
    nearest_ = r.p + u * weight_[0] + v * weight_[1];
    corner_[2] = r, count_ = 3;
    return;
  }
  const Along on_p = along(ru, uu), on_q = along(rv, vv);
  on_p.gain >= on_q.gain ? keep(p, r, on_p.share) : keep(q, r, on_q.share);
}

void Simplex::add_fourth(const Corner& apex) {
  const Simplex base = *this;
  double least2 = kInfinity;
  for (const auto& [i, j, opposite] : {std::array{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
    const Vec n = cross(base[i].p - apex.p, base[j].p - apex.p);
    const double height = dot(n, base[opposite].p - apex.p), from_origin = dot(n, apex.p);
    if (height < 0 ? from_origin > 0 : height > 0 && from_origin < 0) continue;  // the origin is on the inner side
    Simplex face;
    face.corner_[0] = base[i], face.corner_[1] = base[j], face.count_ = 2;
    face.add_third(apex);
    if (const double d2 = dot(face.nearest_, face.nearest_); d2 < least2) least2 = d2, *this = face;
  }
  if (least2 < kInfinity) return;
  corner_[3] = apex, count_ = 4;
}

[[gnu::flatten]] void Simplex::add(const Corner& corner) {
  switch (count_) {
    case 0: return keep(corner);
    case 1: return add_second(corner);
    case 2: return add_third(corner);
    default: return add_fourth(corner);
  }
}

OverlapProof Simplex::proof() const {
  OverlapProof proof{4, {}, {}};
  for (int k = 0; k < 4; ++k) proof.vertex_a[k] = corner_[k].va, proof.vertex_b[k] = corner_[k].vb;
  return proof;
}

}  // namespace swiftlet
