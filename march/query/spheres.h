// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the balls around and inside two bodies tell: many pairs of a scene are far apart or deep in each other. Reads no
// feature.
//
// Law 2's bound of a pair exceeds the rounding of these tests: of the vector between the centres 13 u of B's extent and 2 u of
// |t|; of its length, 5 u of at most 2 sqrt(3) extents and |t|; of the radii, whose sum is at most 4 sqrt(3) extents, 2 u.
#pragma once

#include <swiftlet/query.h>

#include "pair/stop_rule.h"
#include "query/model_pair.h"

namespace swiftlet {

/// Fills `answer` and returns true if the balls around the bodies are proved to be farther apart than `asked.above`. `between`
/// leads from A's centre to B's, rounded.
template <class Pair>
static inline bool spheres_are_apart(const Pair& pair, const Vec& between, const StopRule& asked, Answer& answer) {
  const double radii = pair.a.radius() + pair.b.radius() * stretch_of(pair.pose_error),
               most = radii + max(asked.above, 0) + 2 * pair.law_two(), apart2 = dot(between, between);
  if (!(apart2 > most * most && has_range(apart2))) return false;
  const double length = std::sqrt(apart2);
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

/// Fills `answer` and returns true if the balls around and inside the bodies bound their distance as narrowly as asked.
template <class Pair>
static inline bool spheres_suffice(const Pair& pair, const Vec& between, const StopRule& asked, Answer& answer) {
  const double stretch = stretch_of(pair.pose_error), inside_a = pair.a.level(0).view.inner_radius,
               inside = inside_a + pair.b.level(0).view.inner_radius * (2 - stretch), margin = pair.law_two(),
               around = pair.a.radius() + pair.b.radius() * stretch + margin, length = norm(between),
               lower = max(0, length - around), upper = length - inside + margin;
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

/// Fills `answer` and returns true if the balls inside the bodies are proved to overlap by more than law 2's bound.
template <class Pair>
static inline bool spheres_meet(const Pair& pair, const Vec& between, Answer& answer) {
  const ConvexView &a = pair.a.level(0).view, &b = pair.b.level(0).view;
  const double radii = a.inner_radius + b.inner_radius * (2 - stretch_of(pair.pose_error)), least = radii - 2 * pair.law_two();
  if (!(least > 0 && dot(between, between) < least * least) || pair.finest_a() != 0 || pair.finest_b() != 0) return false;
  answer.status = Status::Converged;
  answer.verdict = Verdict::Overlapping;
  answer.normal.setZero();
  answer.lower = answer.upper = 0;
  answer.point_a = answer.point_b = eigen(vec(a.centre) + between * (a.inner_radius / radii));
  return true;
}

}  // namespace swiftlet
