// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two triangles in one frame: their nearest points, a direction across which they are apart, and whether they cross, in doubles
// that know their error. The nearest points of two triangles apart lie on an edge of each, or on a corner of one and the inside
// of the other [Larsen et al. 1999]; where that is not the answer, or not surely, the proof fails and the caller asks the
// kernel.
#pragma once

#include <array>

#include "mesh_tolerance.h"
#include "numeric/vec.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

/// Which corners of a triangle hold a point.
enum class Part : std::uint8_t { Corner, Side, Inside };
struct PartId {
  Part part;
  std::uint8_t index;  ///< of the corner, or of the side's first corner
};

/// Nearest points.
struct NearestPoints {
  Vec a;       ///< from A's first corner
  Vec way;     ///< from it to the point of B
  Vec across;  ///< a direction at right angles to the features that hold them; 0 if these are corners
  PartId on_a, on_b;
};

/// What is known of a distance: nearest points, bounds, and the direction along which the lower one is the triangles' gap.
struct Measured {
  NearestPoints points;
  double lower, upper;
  Vec normal;
};

class TrianglePair {
 public:
  /// `b` are corners of B in its own frame. `size` is law 2's size.
  TrianglePair(const Vec (&a)[3], const Vec (&b)[3], const Motion& b_in_a, double size) {
    lanes_a_ = transposed(a[0], a[1], a[2], a[0]) - repeated4(a[0]);
    // B's first corner is turned in the lane that is free.
    const auto but_last = [](double x) { return vec4(Vec2{x, x}, Vec2{x, 0}); };
    const V3<Vec4> from_first =
        transposed(b[0], b[1], b[2], b[0]) - V3<Vec4>{but_last(b[0].x), but_last(b[0].y), but_last(b[0].z)};
    lanes_b_ = {dot(repeated4(b_in_a.row_x), from_first), dot(repeated4(b_in_a.row_y), from_first),
                dot(repeated4(b_in_a.row_z), from_first)};
    way_ = vec(lanes_b_, 3) + (b_in_a.t - a[0]);
    const Vec4 squares = max(dot(lanes_a_, lanes_a_), dot(lanes_b_, lanes_b_));
    side_ = std::sqrt(max(squares[1], squares[2])), length_ = norm(way_), way_error_ = kWayOfPairError * size;
  }

  const Vec& way() const { return way_; }  ///< from A's first corner to B's
  /// The gap of the triangles along a unit direction, negative if they overlap along it, less what rounding may have added.
  double gap(const Vec& n) const {
    const V3<Vec4> along = repeated4(n);
    const Vec4 a = dot(along, lanes_a_), b = dot(along, lanes_b_);
    return surely(dot(n, way_) + (min(min(b[0], b[1]), b[2]) - max(max(a[0], a[1]), a[2])));
  }
  /// The gaps along a unit direction and against it.
  std::array<double, 2> gaps(const Vec& n) const {
    const V3<Vec4> along = repeated4(n);
    const Vec4 a = dot(along, lanes_a_), b = dot(along, lanes_b_);
    const double way = dot(n, way_);
    return {surely(way + (min(min(b[0], b[1]), b[2]) - max(max(a[0], a[1]), a[2]))),
            surely((min(min(a[0], a[1]), a[2]) - max(max(b[0], b[1]), b[2])) - way)};
  }
  /// True if along a face's normal the triangles overlap by no more than `depth`.
  bool faces_part(double depth) const {
    for (const Vec& normal : {cross(side_a(1), side_a(2)), cross(side_b(1), side_b(2))}) {
      const Vec n = normalised(normal);
      if (dot(n, n) > 0 && max(gap(n), gap(-n)) >= -depth) return true;
    }
    return false;
  }
  /// The distance of points, with what rounding may have taken.
  double upper(const Vec& way) const {
    const double length = norm(way);
    return length + (way_error_ + kLengthOfWay * length_ + kLengthOfSide * side_ + kLengthOfItself * length);
  }

  /// The way from the middle of A to the middle of B, about.
  Vec between_middles() const { return way_ + (side_b(1) + side_b(2) - side_a(1) - side_a(2)) * (1.0 / 3); }

  NearestPoints nearest() const {
    const V3<Vec4> to_b = rolled(lanes_b_) - lanes_b_, way = repeated4(way_), corner_b = lanes_b_ + way;
    const Vec4 ee = dot(to_b, to_b);
    Vec4 squares[3], of_a[3], of_b[3];
    for (int i = 0; i < 3; ++i) {
      const Vec p = side_a(i);
      const V3<Vec4> d = repeated4(side_a((i + 1) % 3) - p), r = repeated4(p) - corner_b;
      // [Ericson 2004, 5.1.9], and once more from the second parameter, which may have been clamped.
      const Vec4 dd = dot(d, d), de = dot(d, to_b), dr = dot(d, r), er = dot(to_b, r);
      const Vec4 s0 = clamped((de * er - dr * ee) / max(dd * ee - de * de, tiny()));
      const Vec4 t = clamped((de * s0 + er) / max(ee, tiny())), s = clamped((de * t - dr) / max(dd, tiny()));
      const V3<Vec4> between = r + d * s - to_b * t;
      squares[i] = dot(between, between), of_a[i] = s, of_b[i] = t;
    }
    // Which pair of sides is nearest no branch could foresee.
    const Vec4 of_side = min(min(squares[0], squares[1]), squares[2]);
    double least = min(min(of_side[0], of_side[1]), of_side[2]);
    const auto at_least = [&](int i) { return (equal(squares[i], all(least)) & 7u) << 3 * i; };
    const unsigned nearest = at_least(0) | at_least(1) | at_least(2), first = nearest ? __builtin_ctz(nearest) : 0;
    const int i_at = int(first) / 3, k_at = int(first) % 3;
    const double s_at = of_a[i_at][k_at], t_at = of_b[i_at][k_at];
    Over over_a, over_b;
    const bool by_b = over(corner_b, lanes_a_, least, over_a), by_a = over(lanes_a_, corner_b, least, over_b);
    if (by_a) {
      const Vec p = side_a(over_b.corner);
      return {p, way_ + (combined(lanes_b_, over_b.weight) - p), over_b.normal, corner(over_b.corner), {Part::Inside, 0}};
    }
    if (by_b) {
      const Vec p = combined(lanes_a_, over_a.weight);
      return {p, way_ + (side_b(over_a.corner) - p), over_a.normal, {Part::Inside, 0}, corner(over_a.corner)};
    }
    const Vec along_a = side_a((i_at + 1) % 3) - side_a(i_at), along_b = side_b((k_at + 1) % 3) - side_b(k_at);
    const Vec p = side_a(i_at) + along_a * s_at;
    NearestPoints points{p, way_ + (side_b(k_at) + along_b * t_at - p), {0, 0, 0}, place(s_at, i_at), place(t_at, k_at)};
    // Across a side and a corner: the part of their way that is at right angles to the side.
    if (points.on_a.part == Part::Side && points.on_b.part == Part::Side) {
      points.across = cross(along_a, along_b);
    } else if (points.on_a.part == Part::Side || points.on_b.part == Part::Side) {
      const Vec& side = points.on_a.part == Part::Side ? along_a : along_b;
      points.across = cross(cross(side, points.way), side);
    }
    return points;
  }

  /// Bounds the distance by the nearest points: from above by theirs, from below by the gap along the way between them or, if
  /// the bounds are then farther apart than `width`, across the features that hold them, unless the points lean against that
  /// direction by more: of a sliver they may, as rounding moves a point along it.
  Measured measured(double width) const {
    const NearestPoints points = nearest();
    const double upper = this->upper(points.way);
    Vec normal = normalised(points.way);
    double lower = gap(normal);
    if (upper - lower > width && max_abs(points.across) > 0) {
      Vec across = normalised(points.across);
      if (dot(across, points.way) < 0) across = -across;
      const Vec aside = points.way - across * dot(across, points.way);
      const bool leans = dot(aside, aside) > width * width;
      if (const double along = gap(across); along > lower && !leans) lower = along, normal = across;
    }
    return {points, lower, upper, normal};
  }

  /// True if a side of one passes through the other, at `point`, from A's first corner, and no motion by `depth` parts them:
  /// not less than a determinant over the product of two sides, 2 D each.
  bool cross_deeper(double depth, Vec& point) const {
    const double reach = length_ + side_, corner_error = way_error_ + kCornerOfSize * reach;
    const double allowed = (kSideOfCorner * corner_error + kSideOfDepth * depth + kSideOfSize * reach) * reach * reach;
    const Vec a[3] = {side_a(0), side_a(1), side_a(2)}, b[3] = {side_b(0) + way_, side_b(1) + way_, side_b(2) + way_};
    return pierces(a, b, allowed, point) || pierces(b, a, allowed, point);
  }

 private:
  /// A gap less what rounding may have added.
  double surely(double gap) const {
    return gap - (way_error_ + kGapOfWay * length_ + kGapOfSide * side_ + kGapOfItself * std::fabs(gap));
  }
  /// A corner over the inside of a triangle: the weights of the triangle's corners in the point below it.
  struct Over {
    int corner;
    double weight[3];
    Vec normal;
  };

  static Vec4 tiny() { return all(std::numeric_limits<double>::min()); }
  static Vec4 clamped(const Vec4& x) { return min(max(x, all(0)), all(1)); }
  static V3<Vec4> repeated4(const Vec& v) { return {all(v.x), all(v.y), all(v.z)}; }
  /// The next corner in each lane but the last.
  static V3<Vec4> rolled(const V3<Vec4>& v) { return {yzx(v.x), yzx(v.y), yzx(v.z)}; }
  static Vec combined(const V3<Vec4>& t, const double (&weight)[3]) {
    return vec(t, 0) * weight[0] + vec(t, 1) * weight[1] + vec(t, 2) * weight[2];
  }
  static PartId corner(int k) { return {Part::Corner, std::uint8_t(k)}; }
  static PartId place(double parameter, int side) {
    if (parameter <= 0) return corner(side);
    if (parameter >= 1) return corner((side + 1) % 3);
    return {Part::Side, std::uint8_t(side)};
  }

  /// Finds the corner nearest to a triangle that it is over, if it is nearer than `least`, which it then becomes.
  static bool over(const V3<Vec4>& corners, const V3<Vec4>& of_triangle, double& least, Over& found) {
    const Vec triangle[3] = {vec(of_triangle, 0), vec(of_triangle, 1), vec(of_triangle, 2)};
    const Vec normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double square = dot(normal, normal);
    if (!(square > 0)) return false;
    Vec4 inward[3];
    for (int k = 0; k < 3; ++k) {
      const Vec p = triangle[k];
      inward[k] = along(cross(normal, triangle[(k + 1) % 3] - p), corners, p);
    }
    unsigned left = at_most(all(0), min(min(inward[0], inward[1]), inward[2])) & 7u;
    if (left == 0) return false;
    const Vec4 height = along(normal, corners, triangle[0]);
    bool nearer = false;
    for (; left != 0; left &= left - 1) {
      const int k = __builtin_ctz(left);
      const double h = height[k] * height[k] / square, sum = inward[0][k] + inward[1][k] + inward[2][k];
      if (!(h < least && sum > 0)) continue;
      least = h, nearer = true;
      found = {k, {inward[1][k] / sum, inward[2][k] / sum, inward[0][k] / sum}, normal};
    }
    return nearer;
  }
  static Vec4 along(const Vec& n, const V3<Vec4>& corners, const Vec& from) {
    return dot(repeated4(n), corners - repeated4(from));
  }

  /// True if a side of `t` passes through `u`: its ends are on different sides of u's plane, and it passes all sides of u on
  /// the same side, each by more than `allowed`.
  static bool pierces(const Vec (&t)[3], const Vec (&u)[3], double allowed, Vec& point) {
    const Vec normal = cross(u[1] - u[0], u[2] - u[0]);
    double height[3];
    for (int k = 0; k < 3; ++k) height[k] = dot(normal, t[k] - u[0]);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (!(min(height[k], height[next]) < -allowed && max(height[k], height[next]) > allowed)) continue;
      const Vec side = t[next] - t[k], to[3] = {u[0] - t[k], u[1] - t[k], u[2] - t[k]};
      const double x = dot(side, cross(to[0], to[1])), y = dot(side, cross(to[1], to[2])), z = dot(side, cross(to[2], to[0]));
      if (!(min(min(x, y), z) > allowed || max(max(x, y), z) < -allowed)) continue;
      point = t[k] + side * (height[k] / (height[k] - height[next]));
      return true;
    }
    return false;
  }

  Vec side_a(int k) const { return vec(lanes_a_, std::size_t(k)); }
  Vec side_b(int k) const { return vec(lanes_b_, std::size_t(k)); }

  V3<Vec4> lanes_a_, lanes_b_;  ///< the corners of each from its first one
  Vec way_;                     ///< from A's first corner to B's
  double side_, length_, way_error_;
};

}  // namespace
}  // namespace swiftlet
