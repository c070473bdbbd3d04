// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves an overlap by four vertex pairs in doubles: the tetrahedron of their differences holds the origin, and a ball around
// it. Its four corners, and its four faces, are lanes of vectors.
#pragma once

#include <swiftlet/march.h>

#include "numeric/vec4.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// True if the four vertex pairs of `proof` prove that the bodies overlap, and the origin is more than twice law 2's bound from
/// every plane of the tetrahedron of their differences. Doubles decide; what they cannot, is not deep. `common`, if wanted,
/// becomes a point within law 2's bound of both bodies; where doubles find none, the result is false too.
static inline bool proves_deep_overlap(const PairView& pair, const OverlapProof& proof, Vec* common = nullptr) {
  const Vertex *a = pair.a.vertices.data(), *b = pair.b.vertices.data();
  const auto& [count, of_a, of_b] = proof;
  const Motion& m = pair.b_in_a;
  const V3<Vec4> p = transposed(a[of_a[0]], a[of_a[1]], a[of_a[2]], a[of_a[3]]),
                 q = transposed(b[of_b[0]], b[of_b[1]], b[of_b[2]], b[of_b[3]]);
  const auto moved = [&q](const Vec& row, double t) { return q.x * row.x + q.y * row.y + q.z * row.z + all(t); };
  const V3<Vec4> corner = p - V3<Vec4>{moved(m.row_x, m.t.x), moved(m.row_y, m.t.y), moved(m.row_z, m.t.z)};
  // The faces opposite corners 2, 0, 1 and 3, by normals into the tetrahedron, or all out of it. The first three hold corner 3,
  // from which the edges lead.
  const V3<Vec4> edge = corner - V3<Vec4>{lane<3>(corner.x), lane<3>(corner.y), lane<3>(corner.z)};
  const V3<Vec4> normal = cross(edge, V3<Vec4>{yzx(edge.x), yzx(edge.y), yzx(edge.z)});
  const auto with = [](const Vec4& three, double fourth) { return vec4(low(three), Vec2{three[2], fourth}); };
  const V3<Vec4> n{with(normal.x, -sum(normal.x)), with(normal.y, -sum(normal.y)), with(normal.z, -sum(normal.z))};
  const auto on_face = [&](const Vec4& of) { return with(lane<3>(of), of[0]); };
  const Vec4 height = -dot(V3<Vec4>{on_face(corner.x), on_face(corner.y), on_face(corner.z)}, n), inside = abs(height);
  const unsigned in = greater(height, all(0));
  const double rounding = kTetrahedronError * pair.magnitude * pair.magnitude * pair.magnitude, least = 2 * pair.law_two;
  const Vec4 surely = inside - all(rounding);
  const bool deep = greater(surely, all(0)) == 15 && greater(surely * surely, dot(n, n) * (least * least)) == 15;
  if (!deep || (in != 0 && in != 15)) return false;
  if (!common) return true;
  const auto total = [](const Vec4& of) { return (of[0] + of[1]) + (of[2] + of[3]); };
  const Vec4 weight = with(yzx(inside), inside[3]) * (1 / total(inside));
  const Vec off{total(corner.x * weight), total(corner.y * weight), total(corner.z * weight)};
  *common = {total(p.x * weight), total(p.y * weight), total(p.z * weight)};
  return 4 * dot(off, off) <= pair.law_two * pair.law_two;
}

}  // namespace swiftlet
