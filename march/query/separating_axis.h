// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The separating-axis test, along the last answer's normal, then along the line of centres. Each direction takes one look-up in
// the support map of each body. Most questions of yes or no end here.
#pragma once

#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "query/model_pair.h"

namespace swiftlet {

/// The last sample of the test. If the test does not answer, the descent begins with it.
struct AxisTest {
  AxisTest() { seen.normal = {0, 0, 0}; }
  Place at;
  AxisSample seen;  ///< on the levels of `at`; its normal is 0 if nothing was sampled, and nothing else is set
};

/// Fills `answer` and returns true if the bodies are proved to be farther apart than `asked.above`. If the line of centres
/// proves it and the seed's direction does not, that direction is cleared.
static inline bool separating_axis(const ModelPair& pair, const Vec& between, const StopRule& asked, PairSeed& seed,
                                   AxisTest& first, Answer& answer) {
  first.at = pair.finest_mapped();
  const int level_a = first.at.level_a, level_b = first.at.level_b;
  const Level &of_a = pair.a.level(level_a), &of_b = pair.b.level(level_b);
  const PairView view = pair.view_at(first.at);
  const auto clears = [&](const Vec& direction) {
    first.seen = sample_axis(view, of_a, of_b, direction);
    return first.seen.lower > max(asked.above, 0) + pair.law_two;
  };
  const Vec last = last_direction(between, seed);
  if (!(max_abs(last) > 0 && clears(last))) {
    if (!clears(between)) return false;
    seed.normal = {};
  }

  const double error = pair.deviation(level_a, level_b), upper = norm(first.seen.apart) * (1 + kNormError) + view.point_error;
  answer.status = Status::Beyond;
  answer.verdict = Verdict::Disjoint;
  answer.lower = first.seen.lower;
  answer.upper = error > 0 ? (upper + error) * (1 + 2 * kU) : upper;
  answer.normal = eigen(first.seen.normal);
  answer.point_a = eigen(first.seen.point);
  answer.point_b = eigen(first.seen.point + first.seen.apart);
  answer.level_a = std::int16_t(level_a), answer.level_b = std::int16_t(level_b);
  answer.feature_a = {FeatureKind::Vertex, first.seen.a}, answer.feature_b = {FeatureKind::Vertex, first.seen.b};
  answer.levels_visited = 1;
  return true;
}

}  // namespace swiftlet
