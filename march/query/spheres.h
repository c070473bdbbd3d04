// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the balls around and inside two bodies tell, and then ellipsoids: many pairs of a scene are far apart or deep in each
// other. Reads no feature.
//
// Law 2's bound of a pair exceeds the rounding of these tests: of the vector between the centres 13 u of B's extent and 2 u of
// |t|; of its length, 5 u of at most 2 sqrt(3) extents and |t|; of the radii, whose sum is at most 4 sqrt(3) extents, 2 u.
// Ellipsoids have slack for all but the rounding of the vector between the centres.
#pragma once

#include <cmath>

#include <swiftlet/query.h>

#include "body/support_map.h"
#include "numeric/tolerance.h"
#include "pair/stop_rule.h"
#include "query/model_pair.h"

namespace swiftlet {

/// Fills `answer` and returns true if bodies that reach `radii` in all from their centres along the line between these, which
/// is `length` long, are farther apart than `asked.above`. `between` leads from A's centre to B's, rounded.
template <class Pair>
static inline bool are_apart(const Pair& pair, const Vec& between, double length, double radii, const StopRule& asked,
                             Answer& answer) {
  if (!(length > radii + max(asked.above, 0) + 2 * pair.law_two())) return false;
  const int level_a = pair.finest_a(), level_b = pair.finest_b();
  const Vec centre = vec(pair.a.level(0).view.centre);
  answer.status = Status::Beyond;
  answer.verdict = Verdict::Disjoint;
  answer.lower = length - radii - pair.law_two();
  answer.upper = length + pair.law_two() + pair.deviation(level_a, level_b);
  answer.normal = eigen(between * (1 / length));
  answer.point_a = eigen(centre);
  answer.point_b = eigen(centre + between);
  answer.level_a = std::int16_t(level_a), answer.level_b = std::int16_t(level_b);
  return true;
}
/// The same by the balls around the bodies.
template <class Pair>
static inline bool spheres_are_apart(const Pair& pair, const Vec& between, const StopRule& asked, Answer& answer) {
  const double radii = pair.a.radius() + pair.b.radius() * stretch_of(pair.pose_error), apart2 = dot(between, between);
  return apart2 > radii * radii && has_range(apart2) && are_apart(pair, between, std::sqrt(apart2), radii, asked, answer);
}
/// The same by the ellipsoids around them, along the line of centres.
template <class Pair>
static inline bool ellipsoids_are_apart(const Pair& pair, const Line& line, const StopRule& asked, Answer& answer) {
  const Level &a = pair.a.level(0), &b = pair.b.level(0);
  const Vec way_a = into_map(a, line.in_a), way_b = into_map(b, line.in_b);
  const double apart2 = dot(line.in_a, line.in_a), wide2_a = dot(way_a, way_a), wide2_b = dot(way_b, way_b),
               radii = a.scale_around * std::sqrt(wide2_a) + b.scale_around * std::sqrt(wide2_b);  // times the length
  if (!(apart2 > radii && has_range(apart2) && has_range(wide2_a) && has_range(wide2_b))) return false;
  const double length = std::sqrt(apart2);
  return are_apart(pair, line.in_a, length, radii / length, asked, answer);
}

/// Fills `answer` and returns true if the balls around and inside the bodies bound their distance as narrowly as asked.
/// `between`, which is `length` long, leads from A's centre to B's.
template <class Pair>
static inline bool spheres_suffice(const Pair& pair, const Vec& between, double length, const StopRule& asked, Answer& answer) {
  const double stretch = stretch_of(pair.pose_error), inside_a = pair.a.level(0).view.inner_radius,
               inside = inside_a + pair.b.level(0).view.inner_radius * (2 - stretch),
               around = pair.a.radius() + pair.b.radius() * stretch;
  if (!asked.allows(length - around, min(length, around) - inside)) return false;  // nor do they with rounding
  const double margin = pair.law_two(), lower = max(0, length - around - margin), upper = length - inside + margin;
  if (!(length - inside > margin && asked.narrow(lower, upper)) || pair.finest_a() != 0 || pair.finest_b() != 0) return false;
  const Vec normal = between * (1 / length), point_a = vec(pair.a.level(0).view.centre) + normal * inside_a;
  answer.status = Status::Converged;
  answer.verdict = lower > 0 ? Verdict::Disjoint : Verdict::Undecided;
  answer.lower = lower;
  answer.upper = upper;
  answer.normal = eigen(normal);
  answer.point_a = eigen(point_a);
  answer.point_b = eigen(point_a + normal * (length - inside));
  return true;
}

/// Fills `answer`: the bodies overlap at `common`.
static inline void take_common(const Vec& common, Answer& answer) {
  answer.status = Status::Converged;
  answer.verdict = Verdict::Overlapping;
  answer.normal.setZero();
  answer.lower = answer.upper = 0;
  answer.point_a = answer.point_b = eigen(common);
}
/// True if the centres are nearer than half of the radii around the bodies in all: of bodies that overlap, most are.
template <class Pair>
static inline bool are_close(const Pair& pair, const Vec& between) {
  const double radii = pair.a.radius() + pair.b.radius() * stretch_of(pair.pose_error);
  return 4 * dot(between, between) < radii * radii;
}
/// Fills `answer` and returns true if the balls inside the bodies are proved to overlap by more than law 2's bound.
template <class Pair>
static inline bool spheres_meet(const Pair& pair, const Vec& between, Answer& answer) {
  const ConvexView &a = pair.a.level(0).view, &b = pair.b.level(0).view;
  const double radii = a.inner_radius + b.inner_radius * (2 - stretch_of(pair.pose_error)), apart2 = dot(between, between);
  if (!(apart2 < radii * radii)) return false;
  const double least = radii - 2 * pair.law_two();
  if (!(least > 0 && apart2 < least * least) || pair.finest_a() != 0 || pair.finest_b() != 0) return false;
  take_common(vec(a.centre) + between * (a.inner_radius / radii), answer);
  return true;
}
/// The same of the ellipsoids inside: a point of the line of centres is in both.
template <class Pair>
static inline bool ellipsoids_meet(const Pair& pair, const Line& line, Answer& answer) {
  const Level &a = pair.a.level(0), &b = pair.b.level(0);
  const Vec way_a = ball_coordinates(a.map_frame, line.in_a), way_b = ball_coordinates(b.map_frame, line.in_b);
  const double share_a = a.scale_inside / std::sqrt(dot(way_a, way_a)), share_b = b.scale_inside / std::sqrt(dot(way_b, way_b)),
               share = share_a + share_b, beyond = share * (1 - kSlenderTurn * pair.pose_error) - (1 + kEllipsoidSlack),
               least = kSlenderLine * pair.law_two();
  if (!(beyond > 0 && beyond * beyond * dot(line.in_a, line.in_a) > least * least) || pair.finest_a() != 0 ||
      pair.finest_b() != 0)
    return false;
  take_common(vec(a.view.centre) + line.in_a * (share_a / share), answer);
  return true;
}

}  // namespace swiftlet
