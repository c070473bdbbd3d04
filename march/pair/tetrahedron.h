// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves an overlap by four vertex pairs in doubles: the tetrahedron of their differences holds the origin, and a ball around
// it. Where the origin has left the tetrahedron, it says through which face. Its four corners, and its four faces, are lanes of
// vectors.
#pragma once

#include <array>
#include <bit>

#include <swiftlet/march.h>

#include "pair/difference.h"

namespace swiftlet {
namespace {

/// The tetrahedron of four differences. Lanes of faces are in the order of the corners across from them: 2, 0, 1, 3.
struct Tetrahedron : Differences {
  V3<Vec4> normal;  ///< of the faces: all into the tetrahedron, or all out of it
  Vec4 height;      ///< of the origin along `normal` above the faces, times their lengths

  Tetrahedron(const PairView& pair, const OverlapProof& proof) : Differences(pair, proof.vertex_a, proof.vertex_b) {
    // The first three faces hold corner 3, from which the edges lead.
    const V3<Vec4> edge = p - V3<Vec4>{lane<3>(p.x), lane<3>(p.y), lane<3>(p.z)},
                   three = cross(edge, V3<Vec4>{yzx(edge.x), yzx(edge.y), yzx(edge.z)});
    normal = {with(three.x, -sum(three.x)), with(three.y, -sum(three.y)), with(three.z, -sum(three.z))};
    const auto on_face = [](const Vec4& of) { return with(lane<3>(of), of[0]); };
    height = -dot(V3<Vec4>{on_face(p.x), on_face(p.y), on_face(p.z)}, normal);
  }

  /// True if the bodies surely overlap, and the origin is more than twice law 2's bound from every face. Doubles decide; what
  /// they cannot, is not deep.
  bool is_deep(const PairView& pair) const {
    const unsigned in = greater(height, all(0));
    const double rounding = kTetrahedronError * pair.magnitude * pair.magnitude * pair.magnitude, least = 2 * pair.law_two;
    const Vec4 surely = abs(height) - all(rounding);
    const bool deep = greater(surely, all(0)) == 15 && greater(surely * surely, dot(normal, normal) * (least * least)) == 15;
    return deep && (in == 0 || in == 15);
  }
  /// Of a deep one: true if `common` becomes a point within law 2's bound of both bodies; false if doubles find none.
  bool finds_common(const PairView& pair, Vec& common) const {
    const Vec4 inside = abs(height), weight = with(yzx(inside), inside[3]) * (1 / total(inside));
    const Vec off{total(p.x * weight), total(p.y * weight), total(p.z * weight)};
    common = {total(of_a.x * weight), total(of_a.y * weight), total(of_a.z * weight)};
    return 4 * dot(off, off) <= pair.law_two * pair.law_two;
  }
  /// The face that the origin is the farthest beyond, by its outward normal and the corner across from it; 4 if by none.
  struct Exit {
    Vec4 out{};
    std::size_t across = 4;
  };
  Exit exit() const {
    const double outwards = total(height) < 0 ? 1 : -1;
    const Vec4 beyond = max(height * outwards, all(0)), beyond2 = beyond / dot(normal, normal) * beyond;
    const double most = greatest(beyond2);
    if (!(most > 0)) return {};
    const int face = std::countr_zero(equal(beyond2, all(most)));
    return {vec4(vec(normal, std::size_t(face))) * outwards, std::array<std::size_t, 4>{2, 0, 1, 3}[face]};
  }

 private:
  static Vec4 with(const Vec4& three, double fourth) { return vec4(low(three), Vec2{three[2], fourth}); }
  static double total(const Vec4& of) { return (of[0] + of[1]) + (of[2] + of[3]); }
};

/// True if the four vertex pairs of `proof` prove that the bodies overlap deeply.
[[maybe_unused]] bool proves_deep_overlap(const PairView& pair, const OverlapProof& proof) {
  return Tetrahedron(pair, proof).is_deep(pair);
}

}  // namespace
}  // namespace swiftlet
