// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The roots of two trees, before anything of a search is made: a bound on the distance of two bodies by the balls around them,
// the boxes of their roots and those below.
#pragma once

#include "float8.h"
#include "numeric/vec4.h"
#include "search.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

static inline Columns columns(const float (&m)[3][4]) { return {load4(m[0]), load4(m[1]), load4(m[2])}; }
static inline Columns columns(const Vec& x, const Vec& y, const Vec& z) {
  return {float4(vec4(x)), float4(vec4(y)), float4(vec4(z))};
}
static inline Columns operator*(const Columns& a, const Columns& b) { return {a * b.x, a * b.y, a * b.z}; }

/// A direction of the body's frame along its root's axes.
static inline Vec4 along(const Root& root, const Vec& n) {
  return vec4(root.axes_x) * all(n.x) + vec4(root.axes_y) * all(n.y) + vec4(root.axes_z) * all(n.z);
}

/// How far the boxes of a root's children reach from the middle of its own along a direction. Over the body's unit, times the
/// direction's length.
static inline float reach_of_children(const Top& top, Float4 n) {
  const Float4 n_along = columns(top.root.axes_x, top.root.axes_y, top.root.axes_z) * n, sizes = abs(n_along);
  Float8 reach = all8(0);
  for (int k = 0; k < 3; ++k)
    reach = reach + (all8(n_along[k]) * load8(top.node.centre[k]) + all8(sizes[k]) * load8(top.node.half[k]));
  return greatest(reach);
}

/// The gap of the boxes below both roots along the direction in which ellipsoids part that have the axes and sides of the
/// roots' boxes. With matrices A and B their gap along n is n way less the roots of n A n and n B n, which are at most the root
/// of 2 n (A + B) n together; and n way over the root of n (A + B) n is greatest for (A + B)^-1 way. A threshold adds a ball of
/// its radius. `size` is at least as long as all that reaches along a direction, and no less than 2^-46 of each body's unit.
static inline double gap_of_children(const Top& of_a, const Top& of_b, const Motion& b_in_a, double size, double enough) {
  const Root &a = of_a.root, &b = of_b.root;
  // In floats, over a power of two.
  const int unit = exponent_of(size) + 1;
  const double share = power_of_two(-unit);
  const float unit_a = float(power_of_two(a.unit - unit)), unit_b = float(power_of_two(b.unit - unit)),
              apart = float(enough * share), least = apart * apart + kLeastSpread;
  const Columns back = columns(b_in_a.row_x, b_in_a.row_y, b_in_a.row_z), rotation = Columns::of_rows(back.x, back.y, back.z);
  const Columns spread_a = columns(a.spread), spread_b = rotation * columns(b.spread) * back;
  const auto spread = [&](Float4 row_a, Float4 row_b) {
    const float share_a = unit_a * unit_a, share_b = unit_b * unit_b;
    return row_a * Float4{share_a, share_a, share_a, share_a} + row_b * Float4{share_b, share_b, share_b, share_b};
  };
  const Float4 x = spread(spread_a.x, spread_b.x) + Float4{least, 0, 0, 0},
               y = spread(spread_a.y, spread_b.y) + Float4{0, least, 0, 0},
               z = spread(spread_a.z, spread_b.z) + Float4{0, 0, least, 0};
  const Float4 way = float4(vec4(apply(b_in_a, b.middle) - a.middle) * all(share));
  const Float4 n = Columns{cross(y, z), cross(z, x), cross(x, y)} * way;  // the inverse times its determinant
  const Float4 lengths = sums(n * way, n * n, n);
  const float gap = lengths[0] - reach_of_children(of_a, n) * unit_a - reach_of_children(of_b, -(back * n)) * unit_b;
  return double(gap / std::sqrt(lengths[1])) * power_of_two(unit);
}

/// See `gap_of_roots`.
static inline double gap_between(const Top& of_a, const Top& of_b, const Pose& pose, double enough, QueryPose& placed) {
  placed.motion = motion(pose), placed.quality = pose_quality(placed.motion);
  if (!placed.quality.legal) return 0;
  const Root &a = of_a.root, &b = of_b.root;
  const Motion& b_in_a = placed.motion;
  const Vec way = apply(b_in_a, b.centre) - a.centre;
  const double square = dot(way, way);
  if (!has_range(square)) return 0;
  const double length = std::sqrt(square), reach = a.reach + b.reach,
               slack = kBoxSlack * (length + max(a.extent, b.extent) + norm(b_in_a.t) + 2 * reach);
  if (const double of_balls = length - reach - slack; of_balls > enough) return of_balls;
  // No direction parts boxes by more than a ball in B's around its ball's centre is outside of A's.
  const Vec4 way_a = along(a, way), outside = max(abs(way_a - vec4(a.aside)) - vec4(a.half), all(0));
  const double within = max(b.inside + enough, 0);
  if (dot(outside, outside) <= within * within) return 0;
  // Boxes are put along the way as it is: to wait for its unit direction would take as long as all else.
  const Vec4 way_b = -along(b, rotate_back(b_in_a, way));
  const double share = 1 / length;
  const auto reach_along = [&](const Root& of, const Vec4& n) {
    return min(sum(n * vec4(of.aside) + abs(n) * vec4(of.half)) * share, of.reach);
  };
  const double reach_of_boxes = reach_along(a, way_a) + reach_along(b, way_b), of_boxes = length - reach_of_boxes - slack;
  if (of_boxes > enough) return of_boxes;
  if (of_boxes < enough - (enough > 0 ? kMeetLittle / 2 : kMeetLittle) * reach_of_boxes) return 0;
  return gap_of_children(of_a, of_b, b_in_a, reach + reach_of_boxes + enough, enough) - slack;
}

}  // namespace
}  // namespace swiftlet
