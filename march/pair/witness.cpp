// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/witness.h"

namespace swiftlet {
namespace {

// Every pair is computed in the frame of its second body: only the vertices of the first are carried.

template <class P, class Q>
Witness vertex_vertex(const P& a, std::uint32_t va, const Q& b, std::uint32_t vb) {
  return {b.point(vb) - a.point(va), only(va), only(vb)};
}

template <class P, class Q>
Witness vertex_edge(const P& a, std::uint32_t va, const Q& b, std::uint32_t h) {
  const std::uint32_t tail = origin(b.view, h), head = b.view.half_edges[h].head;
  const Vec q = b.own(tail), u = b.own(head) - q, r = b.local(a.point(va)) - q;
  const double uu = dot(u, u), along = dot(r, u) / uu, t = along > 0 ? min(along, 1) : 0;
  const Vec up = r - u * t;
  return {b.rotated(-(t > 0 && t < 1 ? across(up, u, uu) : up)), only(va), between(tail, head, t)};
}

template <class P, class Q>
Witness vertex_face(const P& a, std::uint32_t va, const Q& b, std::uint32_t f) {
  return {-b.rotated(face_normal(b, f)), only(va), below(b, f, b.local(a.point(va)))};
}

template <class P, class Q>
Witness edge_edge(const P& a, std::uint32_t ha, const Q& b, std::uint32_t hb) {
  const std::uint32_t a0 = origin(a.view, ha), a1 = a.view.half_edges[ha].head, b0 = origin(b.view, hb),
                      b1 = b.view.half_edges[hb].head;
  const Vec p0 = b.local(a.point(a0)), u = b.into(a.rotated(a.own(a1) - a.own(a0))), q0 = b.own(b0), v = b.own(b1) - q0;
  const double uu = dot(u, u), vv = dot(v, v);
  const Parameters at = nearest_on_segments(p0, u, uu, q0, v, vv);
  const Vec d = q0 + v * at.t - (p0 + u * at.s);
  return {b.rotated(between_edges(u, uu, v, vv, d).normal), between(a0, a1, at.s), between(b0, b1, at.t)};
}

template <class A, class B>
Witness witness(const A& a, FeatureId fa, const B& b, FeatureId fb) {
  using enum FeatureKind;
  const std::uint32_t i = fa.index(), j = fb.index();
  if (fa.kind() == Face) return swapped(vertex_face(b, any_vertex(b.view, fb), a, i));
  if (fb.kind() == Face) return vertex_face(a, any_vertex(a.view, fa), b, j);
  if (fa.kind() == Edge && fb.kind() == Edge) return edge_edge(a, i, b, j);
  if (fa.kind() == Edge) return swapped(vertex_edge(b, j, a, i));
  if (fb.kind() == Edge) return vertex_edge(a, i, b, j);
  return vertex_vertex(a, i, b, j);
}

}  // namespace

Witness witness(const PairView& pair, FeatureId a, FeatureId b) { return witness(body_a(pair), a, body_b(pair), b); }

}  // namespace swiftlet
