// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Samples of the support maps: one look-up in the map of each body along one direction. The separating-axis test samples along
// the last answer's normal, then along the line of centres; most questions of yes or no end here. A loose distance samples
// once.
#pragma once

#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "query/model_pair.h"

namespace swiftlet {

/// The coarsest pair with maps whose error is likely to be small enough for bodies at most `distance` apart, or the finest.
template <class Pair>
[[gnu::always_inline]] static inline Place mapped_for(const Pair& pair, const StopRule& asked, double distance) {
  const int most_a = pair.a.level_count() - 1, most_b = pair.b.level_count() - 1;
  Place place = pair.finest_mapped();
  while (place.level_a < most_a || place.level_b < most_b) {
    const Place coarser{std::min(place.level_a + 1, most_a), std::min(place.level_b + 1, most_b), {}};
    if (!asked.allows(distance, kMapShare * pair.map_error(coarser))) break;
    place = coarser;
  }
  return place;
}

/// An upper bound on the distance by the vertices of a sample of a level pair that deviates by `deviation`.
static inline double upper_of(const PairView& view, double deviation, const AxisSample& seen) {
  const double upper = norm(vec4(seen.apart)) * (1 + kNormError) + view.point_error();
  return max(max(0, seen.lower), deviation > 0 ? (upper + deviation) * (1 + 2 * kU) : upper);
}
/// Fills `answer` with what a sample of the level pair `at` bounds the distance by, except for the status.
static inline void take_sample(const Place& at, const AxisSample& seen, double upper, Answer& answer) {
  answer.verdict = seen.lower > 0 ? Verdict::Disjoint : Verdict::Undecided;
  answer.lower = max(0, seen.lower);
  answer.upper = upper;
  answer.normal = eigen(seen.normal);
  answer.point_a = eigen(seen.point);
  answer.point_b = eigen(seen.point + seen.apart);
  answer.level_a = std::int16_t(at.level_a), answer.level_b = std::int16_t(at.level_b);
  answer.feature_a = {FeatureKind::Vertex, seen.a}, answer.feature_b = {FeatureKind::Vertex, seen.b};
  answer.levels_visited = 1;
}

/// Answers by the points of the simplex where a search of the maps of `place` ended, which deviate by `deviation`, if these
/// bound the distance as narrowly as asked, but not so narrowly that the features have to hold the points. `place` gets the
/// corner that weighs the most, which the answer names as its features.
static inline bool search_suffices(const PairView& view, double deviation, const StopRule& asked, const SupportGjk& found,
                                   Place& place, Answer& answer) {
  if (found.simplex.count == 0) return false;
  const Simplex::Corner& corner = found.simplex.corner[std::size_t(found.simplex.heaviest())];
  const Feet feet = feet_of(view, found.simplex);
  const AxisSample points{found.lower_along, corner.va, corner.vb, feet.point, feet.apart, found.seen.gap, found.most_lower};
  const double upper = upper_of(view, deviation, points);
  const bool lacks_features = found.simplex.count > 1 && upper - points.lower <= view.law_two;
  if (lacks_features || !asked.narrow(max(0, points.lower), upper)) return false;
  take_sample(place, points, upper, answer);
  answer.status = Status::Converged;
  place.start = supports_of(points);
  return true;
}

/// Samples again, on the finest pair with maps, where the first sample `seen` proves less than `least`: along a new direction,
/// which the seed then keeps, and by climbs where only the maps leave it in doubt. Between round bodies the line of centres,
/// which is then sampled, is as good as any.
[[maybe_unused, gnu::noinline]] static bool clears_elsewhere(const ModelPair& pair, double least, bool knows, const Line& line,
                                                             PairSeed& seed, AxisSample& seen, std::uint32_t& plane_tests) {
  const Place at = pair.finest_mapped();
  const Level &of_a = pair.a.level(at.level_a), &of_b = pair.b.level(at.level_b);
  const PairView view = pair.view_of(of_a, of_b);
  const bool has_better = knows || !pair.a.level(0).is_round || !pair.b.level(0).is_round;
  if (has_better) seen = sample_axis(view, of_a, of_b, vec(pair.new_direction(line, seed)));
  if (!(seen.lower > least)) {
    // Supports along the line of centres are likely to be apart only if those that maps name are by a quarter of their doubt.
    if (!(has_better ? seen.gap > least : 3 * seen.gap + seen.lower > 4 * least)) return false;
    seen = climbed(view, seen, plane_tests);
    if (!(seen.lower > least)) return false;
  }
  remember(line, seen.normal, seed);
  return true;
}
/// Fills `answer` and returns true if the bodies are proved to be farther apart than `asked.above`: along the seed's direction
/// if it `knows` one that still serves, else along the line of centres, or elsewhere. `seen` becomes the last sample, on the
/// finest pair with maps.
template <class Pair>
static inline bool separating_axis(const Pair& pair, const Line& line, const StopRule& asked, bool knows, PairSeed& seed,
                                   AxisSample& seen, Answer& answer) {
  const Place at = pair.finest_mapped();
  const double least = max(asked.above, 0) + pair.law_two();
  const PairView view = pair.view_at(at);
  seen = sample_axis(view, pair.a.level(at.level_a), pair.b.level(at.level_b), knows ? direction(seed) : Vec(line.in_a));
  bool clears = seen.lower > least;
  if (!clears) {
    in_general(pair, [&](const ModelPair& general) {
      clears = clears_elsewhere(general, least, knows, line, seed, seen, answer.plane_tests);
    });
  }
  if (!clears) return false;
  take_sample(at, seen, upper_of(view, pair.deviation(at.level_a, at.level_b), seen), answer);
  answer.status = Status::Beyond;
  return true;
}

/// A bound proved by a sample of maps, and its direction.
struct LowerBound {
  double lower = -kInfinity;
  Vec normal{0, 0, 0};
  bool is_known() const { return lower > -kInfinity; }
};

/// Samples along a new direction the coarsest level pair whose maps are likely to be precise enough, then the finest pair, if a
/// walk on that may follow. Fills `answer` and returns true if one bounds the distance as narrowly as asked; the
/// seed then keeps the direction and the levels in place of features: vertices that only maps name are no better start than
/// none. `seen` becomes the last sample, and `bound` what it proves.
template <class Pair>
[[gnu::always_inline]] static inline bool samples_suffice(const Pair& pair, const Line& line, const StopRule& asked,
                                                          PairSeed& seed, AxisSample& seen, LowerBound& bound, Answer& answer) {
  const Place least = pair.finest_mapped();
  Place at = mapped_for(pair, asked, norm(line.in_a));
  Vec4 along = pair.new_direction(line, seed);
  for (;;) {
    const PairView view = pair.view_at(at);
    seen = sample_axis(view, Moved4(view), pair.a.level(at.level_a), pair.b.level(at.level_b), along);
    const double upper = upper_of(view, pair.deviation(at.level_a, at.level_b), seen);
    if (asked.narrow(max(0, seen.lower), upper)) {
      take_sample(at, seen, upper, answer);
      answer.status = Status::Converged;
      remember(line, seen.normal, seed);
      seed.a = seed.b = {};
      seed.level_a = std::uint8_t(at.level_a), seed.level_b = std::uint8_t(at.level_b);
      return true;
    }
    bound = {seen.lower, seen.normal};
    if (!pair.finest_has_maps() || (at.level_a == least.level_a && at.level_b == least.level_b)) return false;
    at = least, along = vec4(seen.normal);
  }
}

}  // namespace swiftlet
