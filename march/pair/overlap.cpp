// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/overlap.h"
#include "body/half_edge.h"
#include "pair/difference.h"
#include "pair/support_gjk.h"
#include "pair/tetrahedron.h"
#include "pair/witness.h"

#include <limits>

namespace swiftlet {
namespace {

/// A few vertices of one body in the common frame.
struct Corners {
  int count = 0;
  static constexpr int kMost = 8;  ///< a face with more vertices gives only some of them
  std::array<std::uint32_t, kMost> vertex{};
  std::array<Vec, kMost> point{};
  int highest(const Vec& n) const {
    int best = 0;
    for (int k = 1; k < count; ++k) best = dot(n, point[k]) > dot(n, point[best]) ? k : best;
    return best;
  }
};

template <class P>
Corners corners(const P& body, FeatureId feature, std::uint32_t behind) {
  Corners c;
  const auto add = [&](std::uint32_t v) {
    c.vertex[c.count] = v;
    c.point[c.count++] = body.point(v);
  };
  add(behind);
  add(any_vertex(body.view, feature));
  if (feature.kind() == FeatureKind::Edge) add(body.view.half_edges[feature.index()].head);
  if (feature.kind() == FeatureKind::Face) {
    std::uint32_t h = body.view.face_first[feature.index()];
    for (; body.view.half_edges[h].head != c.vertex[1] && c.count < Corners::kMost; h = next_in_face(body.view, h))
      add(body.view.half_edges[h].head);
  }
  return c;
}

}  // namespace

Vec normal_between(const PairView& pair, const MarchStart& met) {
  if (met.a.kind() == FeatureKind::Face) return face_normal(body_a(pair), met.a.index());
  if (met.b.kind() == FeatureKind::Face) return -body_b(pair).rotated(face_normal(body_b(pair), met.b.index()));
  return {0, 0, 0};
}

template <class Real>
Common common_point(const PairView& pair, const OverlapProof& proof) {
  std::array<V3<Real>, 4> a, p;
  for (std::size_t k = 0; k < 4; ++k) {
    a[k] = widened<Real>(vec(pair.a.vertices[proof.vertex_a[k]]));
    p[k] = difference<Real>(pair, proof.vertex_a[k], proof.vertex_b[k]).p;
  }
  std::array<Real, 4> w{dot(cross(p[1], p[3]), p[2]), dot(cross(p[0], p[2]), p[3]), dot(cross(p[0], p[3]), p[1]),
                        dot(cross(p[0], p[1]), p[2])};
  const Real zero(0), all = w[0] + w[1] + w[2] + w[3];
  for (Real& weight : w) weight = weight / all > zero ? weight : zero;  // exact weights all have the sign of their sum
  const Real sum = w[0] + w[1] + w[2] + w[3];
  V3<Real> x{zero, zero, zero}, apart = x;
  for (std::size_t k = 0; k < 4; ++k) x = x + a[k] * (w[k] / sum), apart = apart + p[k] * (w[k] / sum);
  return {rounded(x), norm(rounded(apart))};
}
template Common common_point<DoubleDouble>(const PairView&, const OverlapProof&);

Vec surely_common_point(const PairView& pair, const OverlapProof& proof) {
  if (const Common in_doubles = common_point<double>(pair, proof); 2 * in_doubles.off <= pair.law_two) return in_doubles.point;
  if (const Common wide = common_point<DoubleDouble>(pair, proof); 2 * wide.off <= pair.law_two) return wide.point;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  return {kNowhere, kNowhere, kNowhere};
}

bool meet(const PairView& pair, const MarchStart& met, std::uint32_t behind_a, std::uint32_t behind_b, OverlapProof& proof) {
  const Corners a = corners(body_a(pair), met.a, behind_a), b = corners(body_b(pair), met.b, behind_b);
  Simplex simplex;
  Vec n = normal_between(pair, met);
  for (int iteration = 0; iteration < kMapGjkSteps; ++iteration) {
    const int i = a.highest(n), j = b.highest(-n);
    const Vec p = b.point[j] - a.point[i];
    if (dot(n, p) > 0 || simplex.has(a.vertex[i], b.vertex[j])) return false;
    add(simplex, {p, a.vertex[i], b.vertex[j]});
    if (simplex.count == 4) {
      proof = simplex.proof();
      return proves_deep_overlap(pair, proof);
    }
    n = simplex.nearest;
  }
  return false;
}

}  // namespace swiftlet
