// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Sides of two faces in the projection: on which side of one a place lies, and where two of them cross. A border sees x grow
// outwards, so that the left one is mirrored and both are alike.
//
// Each file that includes this compiles it for the registers of its own flags. Nothing here is defined for other files.
#pragma once

#include "manifold/clip.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {

constexpr Border kBorders[] = {Border::Left, Border::Right};
constexpr Border opposite(Border border) { return border == Border::Left ? Border::Right : Border::Left; }

[[maybe_unused]] bool is_below(const PlanePoint& p, const PlanePoint& q) { return p.y < q.y || (p.y == q.y && p.x < q.x); }

/// In one register.
[[maybe_unused]] PlanePoint place(Vec2 v) {
  PlanePoint p;
  __builtin_memcpy(&p, &v, sizeof p);
  return p;
}

/// The way from one place to another.
struct Way : PlanePoint {
  double most;  ///< at least its length: the sum of its coordinates
};
[[maybe_unused]] Way way(const PlanePoint& from, const PlanePoint& to) {
  const Vec2 there = xy(to) - xy(from), sizes = abs(there);
  return {place(there), sizes[0] + sizes[1]};
}

/// Two places and the way from one to the other.
struct Line {
  PlanePoint from, to;
  Way way;

  PlanePoint at(double t) const { return from + way * t; }
  /// The parameter, 0 at `from` and 1 at `to`, of the point nearest to `place`.
  double along(const PlanePoint& place) const {
    const double t = dot(place - from, way), length2 = this->length2();
    return length2 > 0 && t > 0 ? min(t / length2, 1) : 0;
  }
  double length2() const { return dot(way, way); }
  /// Twice the area of the line and a place, positive where that lies to the right of the way.
  double beyond(const PlanePoint& place) const { return cross(place - from, way); }
};

/// On which side of a border's side a place lies whose height is between those of its ends.
enum class Where { Inside, On, Outside };

/// The same of a place within the bound of the line. The side itself may be farther, if it is nearly horizontal.
[[gnu::noinline]] Where near_line(const PlanePoint& place, const Line& side, double bound) {
  const double dx = side.way.x, x = place.x - side.from.x, length2 = side.length2();
  if (x < min(dx, 0) - bound) return length2 - dx * dx > dx * dx ? Where::On : Where::Inside;
  if (x > max(dx, 0) + bound) return length2 - dx * dx > dx * dx ? Where::On : Where::Outside;
  return Where::On;
}
[[gnu::always_inline]] inline Where where(const PlanePoint& place, const Line& side, double bound) {
  const double area = side.beyond(place);
  if (area * area > bound * bound * side.length2()) return area > 0 ? Where::Outside : Where::Inside;
  return near_line(place, side, bound);
}

/// Where two lines cross that are seen alike.
struct Crossing {
  double t_a, t_b;  ///< as parameters on each
  PlanePoint on_a, on_b;
  bool meet;  ///< false if both places are farther apart than the bound, as those of lines that are nearly parallel may be
};
/// Whether two places are apart by no more than a bound, squared.
[[maybe_unused]] bool are_near(const PlanePoint& p, const PlanePoint& q, double bound2) { return dot(p - q, p - q) <= bound2; }
[[gnu::always_inline]] inline Crossing crossing(const Line& a, const Line& b, double bound2) {
  // Neither parameter waits for the other; 0 where that is 0 / 0.
  const Vec2 none{0, 0}, crossed = Vec2{b.beyond(a.from), -a.beyond(b.from)} / cross(b.way, a.way),
                         t = min(max(none, crossed), Vec2{1, 1});
  double t_a = t[0], t_b = t[1];
  PlanePoint on_a = a.at(t_a), on_b = b.at(t_b);
  bool meet = are_near(on_b, on_a, bound2);
  if (!meet) [[unlikely]] {
    // The sides are nearly parallel, and the point on a is uncertain: the last one is the nearest to that on b.
    t_b = b.along(on_a), on_b = b.at(t_b), t_a = a.along(on_b), on_a = a.at(t_a);
    meet = are_near(on_b, on_a, 4 * bound2);
  }
  return {t_a, t_b, on_a, on_b, meet};
}

/// The coordinate along the normal at a place of a face: interpolated between a side of its left border and one of its right
/// border, one in each lane, or that of the nearer one outside. `lower`, `upper`: that of both sides' ends.
[[gnu::always_inline]] inline double depth_between(const Line& left, const Line& right, Vec2 lower, Vec2 upper,
                                                   const PlanePoint& place) {
  const Vec2 none{0, 0}, rise{left.way.y, right.way.y},
      up = (place.y - Vec2{left.from.y, right.from.y}) / rise, t = rise > none ? min(max(up, none), Vec2{1, 1}) : none,
      x = Vec2{-left.from.x, right.from.x} + Vec2{-left.way.x, right.way.x} * t;
  if (x[0] < place.x && place.x < x[1]) [[likely]] {
    const Vec2 z = lower + (upper - lower) * t;
    return z[0] + (z[1] - z[0]) * ((place.x - x[0]) / (x[1] - x[0]));
  }
  if (place.x <= x[0]) return lower[0] + (upper[0] - lower[0]) * left.along({-place.x, place.y});
  return lower[1] + (upper[1] - lower[1]) * right.along(place);
}

}  // namespace
}  // namespace swiftlet
