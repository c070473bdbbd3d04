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
  double law_two;       ///< law 2's bound for this pair: the width an exact answer keeps
};

/// A body of a scene at rest in the common frame.
struct Resting {
  const ConvexView& view;
  Vec point(std::uint32_t v) const { return vec(view.vertices[v]); }
  Vec turned(const Vec& n) const { return n; }
};
/// A body of a scene that the pose moves into it.
struct Moved {
  const ConvexView& view;
  const Motion& motion;
  Vec point(std::uint32_t v) const { return apply(motion, vec(view.vertices[v])); }
  Vec turned(const Vec& n) const { return turn(motion, n); }
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
  const double e[6] = {entry(x.x * x.x, y.x * y.x, z.x * z.x) - 1, entry(x.y * x.y, y.y * y.y, z.y * z.y) - 1,
                       entry(x.z * x.z, y.z * y.z, z.z * z.z) - 1, entry(x.x * x.y, y.x * y.y, z.x * z.y),
                       entry(x.x * x.z, y.x * y.z, z.x * z.z),     entry(x.y * x.z, y.y * y.z, z.y * z.z)};
  double worst = 0;
  // Farther away exact signs and squares overflow, and a climb need not end.
  bool in_range =
      std::fabs(m.t.x) <= kMostCoordinate && std::fabs(m.t.y) <= kMostCoordinate && std::fabs(m.t.z) <= kMostCoordinate;
  for (const double value : e) {
    worst = std::fmax(worst, std::fabs(value));
    in_range = in_range && std::isfinite(value);
  }
  return {in_range && worst <= kOrthonormality, worst};
}

static inline Scene scene(const ConvexView& a, const ConvexView& b, const Motion& m, double pose_error) {
  const double t = norm(m.t), stretch = std::sqrt(3.0) * (1 + pose_error);
  const double magnitude = stretch * (a.extent + b.extent) + t,
               motion_error = kTurnError * stretch * b.extent + kShiftError * t;
  return {a,
          b,
          m,
          magnitude,
          motion_error,
          kPointError * magnitude + motion_error,
          std::fmax((kLawTwo + 2 * pose_error) * (std::fmax(a.extent, b.extent) + t), kLeastWidth)};
}

}  // namespace swiftlet
