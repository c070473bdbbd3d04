// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// About the direction of a distance: that of the distance between ellipsoids which stand for the bodies, how it turns with the
// line of centres, and where it leads on from supports that were seen. Knows one level pair.
#pragma once

#include <cmath>

#include <swiftlet/model.h>

#include "numeric/tolerance.h"
#include "numeric/vec4.h"

namespace swiftlet {

/// Two levels as ellipsoids in A's frame, the points M^T y, |y| <= 1, for the map frame M. Their distance h lies along n, of
/// any length, where K n is the line of centres c. K is h / |n| + M_a^T M_a / |M_a n| + M_b^T M_b / |M_b n|, and n . c is h |n|
/// + |M_a n| + |M_b n|.
class Ellipsoids {
 public:
  using Columns = V3<Vec4>;

  Ellipsoids(const Level& a, const Level& b, const Motion& b_in_a) {
    const auto &m = a.map_frame, &f = b.map_frame;
    const Columns turn = transposed(b_in_a.row_x, b_in_a.row_y, b_in_a.row_z, b_in_a.row_z);
    // M^T M by the rows of M_a, and by those of M_b turned into A's frame.
    const Vec4 x = vec4(m[0], m[1], m[2]), y = vec4(0, m[3], m[4]), z = vec4(0, 0, m[5]);
    of_a_ = {x * m[0], x * m[1] + y * m[3], x * m[2] + y * m[4] + z * m[5]};
    of_b_ = squared({turn.x * f[0] + turn.y * f[1] + turn.z * f[2], turn.y * f[3] + turn.z * f[4], turn.z * f[5]});
  }

  /// The inverse of K(n): its adjugate, by which it multiplies, and its determinant, which is positive.
  struct Inverse {
    Columns adjugate;
    double determinant;
    Vec4 operator*(const Vec4& v) const { return times(adjugate, v); }
  };
  Inverse inverse(const Vec4& n, const Vec4& line) const {
    const Vec4 along = dots(n, times(of_a_, n), n, times(of_b_, n), n, line, n, n);
    const Vec2 wide = sqrt(low(along)), by = Vec2{1, 1} / wide;
    const Vec4 by_a = all(by[0]), by_b = all(by[1]);
    const double h = max(0, along[2] - wide[0] - wide[1]) / along[3];
    const Vec4 x = vec4(h, 0, 0) + of_a_.x * by_a + of_b_.x * by_b, y = vec4(0, h, 0) + of_a_.y * by_a + of_b_.y * by_b,
               z = vec4(0, 0, h) + of_a_.z * by_a + of_b_.z * by_b;
    const Columns adjugate{cross(y, z), cross(z, x), cross(x, y)};
    return {adjugate, dot(x, adjugate.x)};
  }

  /// About the direction, at any length, of the distance between these ellipsoids moved so that `apart` leads from the support
  /// of A along n to that of B against it: a step from n to the direction of the distance of bodies that are curved like them.
  Vec4 onward(const Vec4& n, const Vec4& apart) const {
    const Vec4 of_a = times(of_a_, n), of_b = times(of_b_, n);
    const Vec2 by = Vec2{1, 1} / sqrt(dots(n, of_a, n, of_b));
    const Vec4 line = apart + of_a * all(by[0]) + of_b * all(by[1]);
    return inverse(n, line) * line;
  }

 private:
  static Vec4 times(const Columns& c, const Vec4& v) { return dot(repeated(v), c); }
  /// M^T M of the rows of M.
  static Columns squared(const Columns& rows) {
    const Columns x = repeated(rows.x), y = repeated(rows.y), z = repeated(rows.z);
    return {x.x * rows.x + y.x * rows.y + z.x * rows.z, x.y * rows.x + y.y * rows.y + z.y * rows.z,
            x.z * rows.x + y.z * rows.y + z.z * rows.z};
  }

  Columns of_a_, of_b_;  ///< M^T M
};

/// About the direction of the distance, at any length, where `line` is the line of centres: `kEllipsoidSteps` steps take K from
/// the last n, the first from `from`. Between round bodies, `line`.
[[gnu::flatten]] static inline Vec4 between_ellipsoids(const Level& a, const Level& b, const Motion& b_in_a, const Vec4& line,
                                                       const Vec4& from) {
  if (a.is_round && b.is_round) return line;
  const Ellipsoids bodies(a, b, b_in_a);
  Vec4 n = from;
  for (int k = 0; k < kEllipsoidSteps; ++k) n = bodies.inverse(n, line) * line;
  return has_range(dot(n, n)) ? n : line;
}

/// The same where the direction is known to have been `n` when the line of centres was along `before`, both of length 1: it
/// turns by what K makes of the line's turn. Between round bodies, it turns as the line does.
[[gnu::flatten]] static inline Vec4 turned_with_line(const Level& a, const Level& b, const Motion& b_in_a, const Vec4& line,
                                                     const Vec4& before, const Vec4& n) {
  const double length = norm(line);
  const Vec4 turn = line * (1 / length) - before;
  Vec4 turned = n + turn;
  if (!a.is_round || !b.is_round) {
    const Ellipsoids::Inverse inverse = Ellipsoids(a, b, b_in_a).inverse(n, line);
    turned = n + inverse * turn * (length / inverse.determinant);
  }
  return has_range(dot(turned, turned)) ? turned : n;
}

}  // namespace swiftlet
