// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The bodies of a pair view with vectors of four lanes: the same numbers as `Resting` and `Moved` compute.
#pragma once

#include "numeric/vec4.h"
#include "pair/pair_view.h"

namespace swiftlet {
namespace {

/// Body A of a pair: its own frame is the common frame.
struct Resting4 {
  const ConvexView& view;
  const double reach;
  static constexpr double kWay = Resting::kWay, kImage = Resting::kImage;
  explicit Resting4(const PairView& pair) : view(pair.a), reach(pair.reach_a) {}
  Vec4 own(std::uint32_t v) const { return vec4(view.vertices[v]); }
  Vec4 point(std::uint32_t v) const { return own(v); }
  /// The vector between two vertices in the common frame, from that in the own frame: right to `kWay` of its length.
  Vec4 way(const Vec4& own_way) const { return own_way; }
  Vec4 image(const Vec4& n) const { return n; }
  /// -1 if the body is mirrored in the common frame: cross products of ways then point the other way.
  double sense() const { return 1; }
  Vec4 local(const Vec4& p) const { return p; }
  Vec4 into(const Vec4& n) const { return n; }
};

/// Body B of a pair, which the pose moves into the common frame.
struct Moved4 {
  const ConvexView& view;
  const double reach;
  const Motion& motion;
  const V3<Vec4> columns;
  const Vec4 t;
  static constexpr double kWay = Moved::kWay, kImage = Moved::kImage;
  explicit Moved4(const PairView& pair)
      : view(pair.b),
        reach(pair.reach_b),
        motion(pair.b_in_a),
        columns(transposed(motion.row_x, motion.row_y, motion.row_z, motion.row_z)),
        t(vec4(motion.t)) {}
  Vec4 own(std::uint32_t v) const { return vec4(view.vertices[v]); }
  Vec4 point(std::uint32_t v) const {
    const Vertex& p = view.vertices[v];
    return dot(V3<Vec4>{all(p.x), all(p.y), all(p.z)}, columns) + t;
  }
  Vec4 way(const Vec4& own_way) const { return dot(repeated(own_way), columns); }
  Vec4 image(const Vec4& n) const {
    const auto [x, y, z] = rows();
    return dots(cross(y, z), n, cross(z, x), n, cross(x, y), n, cross(x, y), n);
  }
  double sense() const { return dot(rows().x, cross(rows().y, rows().z)) < 0 ? -1 : 1; }
  Vec4 local(const Vec4& p) const { return into(p - t); }
  Vec4 into(const Vec4& n) const { return dot(repeated(n), rows()); }

 private:
  V3<Vec4> rows() const { return {vec4(motion.row_x), vec4(motion.row_y), vec4(motion.row_z)}; }
};

}  // namespace
}  // namespace swiftlet
