// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One level pair and one pose, as every step of a march reads them: all points in A's frame, B's by one transform.
#pragma once

#include <swiftlet/model.h>

#include "tolerance.h"
#include "vec.h"

namespace swiftlet {

/// The two polytopes and the pose between them.
struct Scene {
  const ConvexView& a;
  const ConvexView& b;
  Motion b_in_a;
  double magnitude;     ///< bounds |p| and |R q + t| over all points, summed
  double motion_error;  ///< bounds the rounding of a vertex of B carried into A's frame
  double point_error;   ///< bounds the rounding of two convex combinations of such vertices, one of each body
  double law_two;       ///< at most law 2's bound for this pair: the width an exact answer keeps
};

/// A body of a scene at rest in the common frame, which is its own.
struct Resting {
  const ConvexView& view;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec point(std::uint32_t v) const { return own(v); }
  Vec turned(const Vec& n) const { return n; }  ///< a direction of its own frame in the common one
  Vec local(const Vec& p) const { return p; }   ///< a point of the common frame in its own
  Vec into(const Vec& n) const { return n; }    ///< orders its own points as `n` orders their images
};
/// A body of a scene that the pose moves into it. `local` takes the pose for a rigid motion.
struct Moved {
  const ConvexView& view;
  const Motion& motion;
  Vec own(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec point(std::uint32_t v) const { return apply(motion, own(v)); }
  Vec turned(const Vec& n) const { return turn(motion, n); }
  Vec local(const Vec& p) const { return turn_back(motion, p - motion.t); }
  Vec into(const Vec& n) const { return turn_back(motion, n); }
};

static inline Resting body_a(const Scene& s) { return {s.a}; }
static inline Moved body_b(const Scene& s) { return {s.b, s.b_in_a}; }

/// What a pose is worth: whether it is legal, and how far from a rigid motion it is.
struct PoseQuality {
  bool legal;
  double error;  ///< largest entry of |R^T R - I|
};
static inline PoseQuality pose_quality(const Motion& m) {
  const auto entry = [](double a, double b, double c) { return a + b + c; };
  const Vec &x = m.row_x, &y = m.row_y, &z = m.row_z;
  const double entries[6] = {entry(x.x * x.x, y.x * y.x, z.x * z.x) - 1, entry(x.y * x.y, y.y * y.y, z.y * z.y) - 1,
                             entry(x.z * x.z, y.z * y.z, z.z * z.z) - 1, entry(x.x * x.y, y.x * y.y, z.x * z.y),
                             entry(x.x * x.z, y.x * y.z, z.x * z.z),     entry(x.y * x.z, y.y * y.z, z.y * z.z)};
  double worst = 0;
  // Farther away exact signs and squares overflow, and a climb need not end.
  const auto within = [](double value, double most) { return std::fabs(value) <= most; };  // no NaN is
  bool legal = within(m.t.x, kMostCoordinate) && within(m.t.y, kMostCoordinate) && within(m.t.z, kMostCoordinate);
  for (const double value : entries) {
    legal = legal && within(value, kOrthonormality);
    worst = larger(worst, std::fabs(value));
  }
  return {legal, worst};
}

static inline Scene scene(const ConvexView& a, const ConvexView& b, const Motion& m, double pose_error) {
  const double t = norm(m.t), stretch = kSqrt3 * (1 + pose_error);
  const double magnitude = stretch * (a.extent + b.extent) + t,
               motion_error = kTurnError * stretch * b.extent + kShiftError * t;
  return {a,
          b,
          m,
          magnitude,
          motion_error,
          kPointError * magnitude + motion_error,
          larger((kLawTwo + 2 * larger(0, pose_error - kOrthonormalityError)) * (larger(a.extent, b.extent) + t), kLeastWidth)};
}

}  // namespace swiftlet
