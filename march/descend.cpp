// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Nothing of a walk but two features survives a change of level: the classics carried more, and looped on up to 5 % of queries.
#include "descend.h"

#include <algorithm>
#include <cmath>

#include "conclude.h"
#include "seed.h"
#include "walk.h"

namespace swiftlet {
namespace {

class Descent {
 public:
  Descent(const Model& a, const Model& b, const Motion& m, double pose_error, const QueryOptions& options, const Target& target)
      : a_(a), b_(b), motion_(m), pose_error_(pose_error), stretch_(std::sqrt(1 + 3 * pose_error)), options_(options), target_(target),
        finest_a_(std::min(options.finest_level, a.level_count() - 1)), finest_b_(std::min(options.finest_level, b.level_count() - 1)) {}

  Answer run(PairSeed& seed) {
    Place place = first_place(a_, b_, motion_, seed, options_);
    for (;;) {
      const Scene pair = scene(a_.level(place.level_a).view, b_.level(place.level_b).view, motion_, pose_error_);
      std::uint32_t climbs = 0;
      const MarchStart from = settled(pair, place.start, climbs);
      const std::uint32_t left = options_.step_budget - answer_.steps;
      const Walk walked = walk(pair, from.a, from.b, options_.plane_rule, std::min(left, place.trial_steps));
      answer_.steps += walked.steps;
      answer_.plane_tests += walked.plane_tests + climbs;
      const bool spent = walked.end == WalkEnd::Budget && answer_.steps >= options_.step_budget;
      if (walked.end == WalkEnd::Budget && !spent) {
        record(place, walked.steps, walked.plane_tests + climbs);
        place = coarsest_place(a_, b_);
        continue;
      }
      remember_coarsest(place, walked, seed);
      const bool last = spent || (place.level_a == finest_a_ && place.level_b == finest_b_);
      MarchStart found{walked.a, walked.b};
      if (last || !options_.trace.empty() || may_answer(place, walked)) found = bound(pair, place, walked, spent);
      record(place, walked.steps, walked.plane_tests + climbs);
      if (last || answered()) return finish(place, found, last, spent, seed);
      place = refined(place, found);
    }
  }

 private:
  double deviation(int level_a, int level_b) const {
    return a_.level(level_a).deviation + stretch_ * b_.level(level_b).deviation;
  }
  bool narrow(double lower, double width) const { return width <= std::max(target_.absolute, target_.relative * lower); }
  bool answered() const {
    return narrow(answer_.lower, answer_.upper - answer_.lower) || answer_.lower > target_.clear_above ||
           answer_.upper <= target_.hit_below;
  }

  /// Whether a certificate at this place could answer: costs nothing, proves nothing.
  bool may_answer(const Place& place, const Walk& walked) const {
    const double error = deviation(place.level_a, place.level_b), distance = walked.end == WalkEnd::Minimum ? walked.distance : 0;
    return narrow(distance, error) || (walked.end == WalkEnd::Minimum && distance > target_.clear_above) ||
           distance + error <= target_.hit_below;
  }

  /// Certifies a walk, carries the better bounds, and says which features it ended on.
  MarchStart bound(const Scene& pair, const Place& place, const Walk& walked, bool spent) {
    MarchRule rule;
    rule.beyond = target_.clear_above;
    Walk capped = walked;
    if (spent) capped.end = WalkEnd::Budget;
    const MarchResult r = conclude(pair, capped, rule);
    answer_.steps += r.steps - walked.steps;
    answer_.plane_tests += r.plane_tests - walked.plane_tests;
    // A finer pair's plane replaces a coarser one's that is better by no more than rounding: it belongs to the points.
    if (r.lower >= answer_.lower - pair.law_two) {
      answer_.lower = r.lower;
      answer_.normal = r.normal;
    }
    const double upper = (r.upper + deviation(place.level_a, place.level_b)) * (1 + 2 * kU);
    if (upper <= answer_.upper) {
      answer_.upper = upper;
      answer_.point_a = r.point_a;
      answer_.point_b = r.point_b;
    }
    answer_.level_a = place.level_a;
    answer_.level_b = place.level_b;
    answer_.proof = r.proof;
    met_ = r.status;
    return {r.a, r.b};
  }

  void record(const Place& place, std::uint32_t steps, std::uint32_t plane_tests) {
    if (!options_.trace.empty()) {
      const auto slot = std::min<std::size_t>(answer_.levels_visited, options_.trace.size() - 1);
      options_.trace[slot] = {place.level_a, place.level_b, answer_.lower, answer_.upper, steps, plane_tests};
    }
    ++answer_.levels_visited;
  }

  void remember_coarsest(const Place& place, const Walk& walked, PairSeed& seed) const {
    if (place.level_a != a_.level_count() - 1 || place.level_b != b_.level_count() - 1) return;
    seed.coarse_a = walked.a;
    seed.coarse_b = walked.b;
  }

  Place refined(const Place& place, const MarchStart& found) const {
    Place next{place.level_a, place.level_b, found};
    const auto refine_a = [&] {
      if (next.level_a > finest_a_) next.start.a = child(a_, next.level_a, next.start.a), --next.level_a;
    };
    const auto refine_b = [&] {
      if (next.level_b > finest_b_) next.start.b = child(b_, next.level_b, next.start.b), --next.level_b;
    };
    switch (options_.refinement) {
      case Refinement::Single: {
        const bool a_is_coarser = a_.level(next.level_a).deviation >= b_.level(next.level_b).deviation;
        if (next.level_b == finest_b_ || (a_is_coarser && next.level_a > finest_a_)) refine_a(); else refine_b();
        break;
      }
      case Refinement::DoubleDouble:
        refine_a();
        refine_b();
        [[fallthrough]];
      case Refinement::SingleSingle:
        refine_a();
        refine_b();
    }
    return next;
  }

  Answer finish(const Place& place, const MarchStart& found, bool last, bool spent, PairSeed& seed) {
    const bool exact_levels = place.level_a == 0 && place.level_b == 0;
    if (met_ == MarchStatus::Overlapping && exact_levels) answer_.verdict = Verdict::Overlapping;
    else if (met_ == MarchStatus::Touching && exact_levels) answer_.verdict = Verdict::Touching;
    else if (answer_.lower > 0) answer_.verdict = Verdict::Disjoint;
    answer_.feature_a = found.a;
    answer_.feature_b = found.b;
    const bool exact = exact_levels && (met_ == MarchStatus::Disjoint || met_ == MarchStatus::Touching || met_ == MarchStatus::Overlapping);
    if (answer_.lower > target_.clear_above) answer_.status = Status::Beyond;
    else if (answered() || exact) answer_.status = Status::Converged;
    else if (spent) answer_.status = Status::Budget;
    else if (last && !exact_levels) answer_.status = Status::LevelLimit;
    else answer_.status = Status::NotConverged;
    store(place, found, seed);
    return answer_;
  }

  /// The features found, or their parents as long as the coarser pair would have answered as well.
  void store(const Place& place, const MarchStart& found, PairSeed& seed) const {
    Place kept{place.level_a, place.level_b, found};
    double slack = answer_.upper;  // Paper: the motion a coarser start can absorb is the distance
    while (kept.level_a + 1 < a_.level_count() && kept.level_b + 1 < b_.level_count()) {
      const double grown = deviation(kept.level_a + 1, kept.level_b + 1) - deviation(kept.level_a, kept.level_b);
      const double error = deviation(kept.level_a + 1, kept.level_b + 1);
      const double lower = answer_.lower - (error - deviation(place.level_a, place.level_b));
      const bool absorbs = options_.start == StartPolicy::Paper && (slack -= std::max(0.0, grown)) >= 0 && answer_.lower > 0;
      const bool suffices = options_.start != StartPolicy::Finest && (lower > target_.clear_above || (lower > 0 && narrow(lower, error)));
      if (!absorbs && !suffices) break;
      kept.start = {parent(a_, kept.level_a++, kept.start.a), parent(b_, kept.level_b++, kept.start.b)};
    }
    remember_line(a_, b_, motion_, seed);
    seed.a = kept.start.a;
    seed.b = kept.start.b;
    seed.level_a = std::uint8_t(kept.level_a);
    seed.level_b = std::uint8_t(kept.level_b);
  }

  const Model& a_;
  const Model& b_;
  const Motion motion_;
  const double pose_error_, stretch_;  ///< stretch bounds the rotation's norm
  const QueryOptions& options_;
  const Target& target_;
  const int finest_a_, finest_b_;
  Answer answer_;
  MarchStatus met_ = MarchStatus::NotConverged;
};

}  // namespace

Answer descend(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options, const Target& target) {
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) {
    Answer invalid;
    invalid.status = Status::InvalidPose;
    return invalid;
  }
  return Descent(a, b, m, quality.error, options, target).run(seed);
}

}  // namespace swiftlet
