// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One level pair and one pose, as every step of a march reads them. A's frame is the common frame; the pose carries B into it.
#pragma once

#include <swiftlet/model.h>

#include "numeric/tolerance.h"
#include "numeric/vec.h"
#include "numeric/vec4.h"

namespace swiftlet {

/// The two polytopes and the pose between them.
struct PairView {
  const ConvexView& a;
  const ConvexView& b;
  const Motion& b_in_a;
  double magnitude;         ///< at least |p| + |R q + t| for all points p of A and q of B
  double motion_error;      ///< bounds the rounding of a vertex of B carried into A's frame
  double pose_error;        ///< largest entry of |R^T R - I|
  double law_two;           ///< greatest width of an exact answer; at most law 2's bound for this pair
  double reach_a, reach_b;  ///< at least the distance of any two points of the body, in the common frame

  /// Bounds the rounding of two convex combinations of vertices, one of each body, together.
  double point_error() const { return kPointError * magnitude + motion_error; }
};

/// Body A of a pair: its own frame is the common frame.
struct Resting {
  const ConvexView& view;
  const double reach;
  static constexpr double kWay = kWayError, kImage = 0;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec common(const Vec& p) const { return p; }  ///< carries a point from the own to the common frame
  Vec point(std::uint32_t v) const { return own(v); }
  /// A normal of the image of a plane of own normal `n`, right to `kImage` of the length of `n`, times `Moved4::sense()`.
  Vec image(const Vec& n) const { return n; }
  Vec rotated(const Vec& n) const { return n; }  ///< carries a direction from the own to the common frame
  Vec local(const Vec& p) const { return p; }    ///< carries a point from the common to the own frame
  Vec into(const Vec& n) const { return n; }     ///< a direction that orders own points as `n` orders them in the common frame
};
/// Body B of a pair, which the pose moves into the common frame. Only `rotated`, taken for a normal, and `local` treat the pose
/// as a rigid motion; all else holds for any matrix within `kOrthonormality` of a rotation.
struct Moved {
  const ConvexView& view;
  const double reach;
  const Motion& motion;
  static constexpr double kWay = kTurnedWayError, kImage = kImageError;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec common(const Vec& p) const { return apply(motion, p); }
  Vec point(std::uint32_t v) const { return common(own(v)); }
  Vec image(const Vec& n) const {
    return {dot(cross(motion.row_y, motion.row_z), n), dot(cross(motion.row_z, motion.row_x), n),
            dot(cross(motion.row_x, motion.row_y), n)};
  }
  Vec rotated(const Vec& n) const { return rotate(motion, n); }
  Vec local(const Vec& p) const { return rotate_back(motion, p - motion.t); }
  Vec into(const Vec& n) const { return rotate_back(motion, n); }
};

static inline Resting body_a(const PairView& s) { return {s.a, s.reach_a}; }
static inline Moved body_b(const PairView& s) { return {s.b, s.reach_b, s.b_in_a}; }

/// Says whether a pose is legal and how far it is from a rigid motion.
struct PoseQuality {
  bool legal;
  double error;  ///< largest entry of |R^T R - I|
};
static inline PoseQuality pose_quality(const Motion& m) {
  const Vec4 x = vec4(m.row_x), y = vec4(m.row_y), z = vec4(m.row_z);
  const Vec4 squares = abs(x * x + y * y + z * z - all(1)), across = abs(x * yzx(x) + y * yzx(y) + z * yzx(z));
  const Vec4 most = max(squares, across);
  // A NaN or an infinity in a column of R is also in the column's square, which `most` keeps and the comparison refuses. With a
  // translation above kMostCoordinate exact signs and squares overflow, and a climb may not end.
  const bool legal = ((at_most(most, all(kOrthonormality)) & at_most(abs(vec4(m.t)), all(kMostCoordinate))) & 7) == 7;
  return {legal, max(max(most[0], most[1]), most[2])};
}

/// The greatest width of an exact answer, which is at most law 2's bound of the pair. `shift` is |t|.
static inline double law_two(double extent_a, double extent_b, double shift, double pose_error) {
  return max((kLawTwo + 2 * (max(pose_error, kOrthonormalityError) - kOrthonormalityError)) * (max(extent_a, extent_b) + shift),
             kLeastWidth);
}
static inline double law_two(const ConvexView& a, const ConvexView& b, double shift, double pose_error) {
  return law_two(a.extent, b.extent, shift, pose_error);
}

/// Bounds how many times longer a pose within `pose_error` of a rigid motion makes a vector: the root of 1 + 3 `pose_error`.
static inline double stretch_of(double pose_error) { return 1 + 2 * pose_error; }

/// |t| of a legal pose, whose square is no infinity.
static inline double shift_of(const Motion& m) {
  const Vec4 t = vec4(m.t);
  const double square = dot(t, t);
  return square >= kLeastSquare ? std::sqrt(square) : norm_of_far(t);
}

/// At least the distance of any two points of a body, in its own frame.
static inline double reach(const ConvexView& view) { return view.reach > 0 ? view.reach : 2 * kSqrt3 * view.extent; }

static inline PairView pair_view(const ConvexView& a, const ConvexView& b, const Motion& m, double shift, double pose_error) {
  const double stretch = kSqrt3 * (1 + pose_error);
  return {a,
          b,
          m,
          stretch * (a.extent + b.extent) + shift,
          kTurnError * stretch * b.extent + kShiftError * shift,
          pose_error,
          law_two(a, b, shift, pose_error),
          reach(a),
          reach(b) * stretch_of(pose_error)};
}
static inline PairView pair_view(const ConvexView& a, const ConvexView& b, const Motion& m, double pose_error) {
  return pair_view(a, b, m, norm(m.t), pose_error);
}
/// The same bodies with B moved by a vector of length `way`, which changes the pose to `m`.
static inline PairView moved_by(const PairView& pair, const Motion& m, double way) {
  return {pair.a,       pair.b,       m,           pair.magnitude + way, pair.motion_error + kShiftError * way, pair.pose_error,
          pair.law_two, pair.reach_a, pair.reach_b};
}

}  // namespace swiftlet
