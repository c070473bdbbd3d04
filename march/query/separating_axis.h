// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The separating-axis test, along the last answer's normal, then along the line of centres. Each direction takes one look-up in
// the support map of each body. Most questions of yes or no end here.
#pragma once

#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "query/model_pair.h"

namespace swiftlet {

/// The direction along which a cold query samples first: `likely`, or, if that is 0, about that of the distance.
static inline Vec4 first_direction(const ModelPair& pair, const Line& line, const Vec& likely) {
  return max_abs(likely) > 0
             ? vec4(likely)
             : between_ellipsoids(pair.a.level(0), pair.b.level(0), pair.motion, vec4(line.in_a), kEllipsoidSteps);
}

/// Fills `answer` and returns true if the bodies are proved to be farther apart than `asked.above`. If the line of centres
/// proves it and the seed's direction does not, that direction is cleared. `seen` becomes the last sample, on the finest pair
/// with maps.
static inline bool separating_axis(const ModelPair& pair, const Vec& between, const StopRule& asked, PairSeed& seed,
                                   AxisSample& seen, Answer& answer) {
  const Place at = pair.finest_mapped();
  const int level_a = at.level_a, level_b = at.level_b;
  const Level &of_a = pair.a.level(level_a), &of_b = pair.b.level(level_b);
  const PairView view = pair.view_at(at);
  const auto clears = [&](const Vec& direction) {
    seen = sample_axis(view, of_a, of_b, direction);
    return seen.lower > max(asked.above, 0) + pair.law_two();
  };
  const Vec last = last_direction(between, seed);
  if (!(max_abs(last) > 0 && clears(last))) {
    if (!clears(between)) return false;
    seed.normal = {};
  }

  const double error = pair.deviation(level_a, level_b), upper = norm(seen.apart) * (1 + kNormError) + view.point_error();
  answer.status = Status::Beyond;
  answer.verdict = Verdict::Disjoint;
  answer.lower = seen.lower;
  answer.upper = error > 0 ? (upper + error) * (1 + 2 * kU) : upper;
  answer.normal = eigen(seen.normal);
  answer.point_a = eigen(seen.point);
  answer.point_b = eigen(seen.point + seen.apart);
  answer.level_a = std::int16_t(level_a), answer.level_b = std::int16_t(level_b);
  answer.feature_a = {FeatureKind::Vertex, seen.a}, answer.feature_b = {FeatureKind::Vertex, seen.b};
  answer.levels_visited = 1;
  return true;
}

}  // namespace swiftlet
