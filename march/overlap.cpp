// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.h"

#include "aim.h"
#include "progress.h"
#include "ring.h"

namespace swiftlet {
namespace {

constexpr int kMostIterations = 12;

/// A few vertices of one body in the common frame.
struct Corners {
  int count = 0;
  std::array<std::uint32_t, 4> vertex{};
  std::array<Vec, 4> point{};
  int highest(const Vec& n) const {
    int best = 0;
    for (int k = 1; k < count; ++k) best = dot(n, point[k]) > dot(n, point[best]) ? k : best;
    return best;
  }
};

template <class P>
Corners corners(const P& body, Handle feature, std::uint32_t behind) {
  Corners c;
  const auto add = [&](std::uint32_t v) {
    c.vertex[c.count] = v;
    c.point[c.count++] = body.point(v);
  };
  add(behind);
  add(any_vertex(body.view, feature));
  if (feature.kind() == FeatureKind::Edge) add(body.view.head[feature.index()]);
  if (feature.kind() == FeatureKind::Face) {
    const std::uint32_t h = body.view.face_first[feature.index()];
    add(body.view.head[h]);
    add(body.view.head[next_in_facet(body.view, h)]);
  }
  return c;
}

template <class P>
Vec outward(const P& body, std::uint32_t face) {
  const std::uint32_t h = body.view.face_first[face];
  const Vec p = body.own(origin(body.view, h)), q = body.own(body.view.head[h]);
  return body.turned(cross(q - p, body.own(body.view.head[next_in_facet(body.view, h)]) - p));
}

}  // namespace

Vec across(const Scene& scene, const MarchStart& met) {
  if (met.a.kind() == FeatureKind::Face) return outward(body_a(scene), met.a.index());
  if (met.b.kind() == FeatureKind::Face) return -outward(body_b(scene), met.b.index());
  return {0, 0, 0};
}

Vec common_point(const Scene& scene, const OverlapProof& proof) {
  std::array<Vec, 4> a, p;
  for (int k = 0; k < 4; ++k) {
    a[k] = body_a(scene).point(proof.vertex_a[k]);
    p[k] = a[k] - body_b(scene).point(proof.vertex_b[k]);
  }
  Vec sum{0, 0, 0};
  double whole = 0;
  for (int k = 0; k < 4; ++k) {
    const double weight = std::fabs(dot(cross(p[(k + 1) % 4], p[(k + 2) % 4]), p[(k + 3) % 4]));
    sum = sum + a[k] * weight;
    whole += weight;
  }
  return sum * (1 / whole);
}

bool meet(const Scene& scene, const MarchStart& met, std::uint32_t behind_a, std::uint32_t behind_b, OverlapProof& proof) {
  const Corners a = corners(body_a(scene), met.a, behind_a), b = corners(body_b(scene), met.b, behind_b);
  Simplex simplex;
  Vec n = across(scene, met);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const int i = a.highest(n), j = b.highest(-n);
    const Vec p = b.point[j] - a.point[i];
    if (dot(n, p) > 0 || simplex.has(a.vertex[i], b.vertex[j])) return false;
    const Simplex::Nearest nearest = simplex.add({p, a.point[i], a.vertex[i], b.vertex[j]});
    if (nearest.count == 4) {
      proof = simplex.proof();
      return proves_deep_overlap(scene, proof);
    }
    simplex.reduce(nearest);
    n = nearest.point;
  }
  return false;
}

}  // namespace swiftlet
