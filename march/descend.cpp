// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Nothing of a walk but two features survives a change of level: the classics carried more, and looped on up to 5 % of queries.
#include "descend.h"

#include <algorithm>
#include <cmath>

#include "certify.h"
#include "conclude.h"
#include "seed.h"
#include "walk.h"

namespace swiftlet {
namespace {

class Descent {
 public:
  Descent(const Model& a, const Model& b, const Motion& m, double pose_error, const QueryOptions& options, const Target& target)
      : a_(a),
        b_(b),
        motion_(m),
        line_(line_of_centres(a, b, m)),
        pose_error_(pose_error),
        stretch_(std::sqrt(1 + 3 * pose_error)),
        options_(options),
        target_(target),
        law_two_(scene(a.level(0).view, b.level(0).view, m, pose_error).law_two),
        finest_a_(std::clamp(options.finest_level, 0, a.level_count() - 1)),
        finest_b_(std::clamp(options.finest_level, 0, b.level_count() - 1)) {}

  Answer run(PairSeed& seed) {
    Place place = first_place(a_, b_, line_, seed, options_);
    for (;;) {
      const Scene pair = scene(a_.level(place.level_a).view, b_.level(place.level_b).view, motion_, pose_error_);
      const bool last = place.level_a == finest_a_ && place.level_b == finest_b_;
      const std::uint32_t steps_before = answer_.steps, tests_before = answer_.plane_tests;
      met_ = MarchStatus::NotConverged;
      MarchStart found =
          last && max_abs(place.direction) > 0 ? enter(pair, place) : settled(pair, place.start, answer_.plane_tests);
      if (!last || !answered()) {
        const std::uint32_t left = steps_left();
        const Walk walked = walk(pair, found.a, found.b, options_.plane_rule, std::min(left, place.trial_steps));
        answer_.steps += walked.steps;
        answer_.plane_tests += walked.plane_tests;
        spent_ = walked.end == WalkEnd::Budget && answer_.steps >= options_.step_budget;
        if (walked.end == WalkEnd::Budget && !spent_) {
          record(place, steps_before, tests_before);
          place = coarsest_place(a_, b_);
          continue;
        }
        remember_coarsest(place, walked, seed);
        found = last || spent_ || may_answer(place, walked) ? bound(pair, place, walked) : MarchStart{walked.a, walked.b};
      }
      record(place, steps_before, tests_before);
      if (last || spent_ || answered()) return finish(place, found, seed);
      place = refined(place, found);
    }
  }

 private:
  double deviation(int level_a, int level_b) const {
    return a_.level(level_a).deviation + stretch_ * b_.level(level_b).deviation;
  }
  /// Certified progress may have taken one more than the budget.
  std::uint32_t steps_left() const { return options_.step_budget - std::min(answer_.steps, options_.step_budget); }
  bool narrow(double lower, double width) const { return width <= std::max(target_.absolute, target_.relative * lower); }
  /// Thresholds are passed only by more than law 2's bound: nearer, what can be proved depends on the start.
  bool answered() const {
    return narrow(answer_.lower, answer_.upper - answer_.lower) || answer_.lower > target_.clear_above + law_two_ ||
           answer_.upper < target_.hit_below - law_two_;
  }

  /// Whether a certificate is wanted on the way down. Of bodies apart always, whatever the tolerance, so that a looser one
  /// stops earlier on the same way; where levels overlap, only if their deviations are an answer.
  bool may_answer(const Place& place, const Walk& walked) const {
    const double error = deviation(place.level_a, place.level_b);
    return walked.end == WalkEnd::Minimum || !options_.trace.empty() || narrow(0, error) ||
           error < target_.hit_below - law_two_;
  }

  /// Enters a pair along a direction, the finest one along the coarser one's: the supports there bound the distance before any
  /// walk, and are better starts than the child features unless these hold them.
  MarchStart enter(const Scene& pair, const Place& place) {
    const Vec& n = place.direction;
    const auto [va, vb, lower] =
        supports(pair, n, any_vertex(pair.a, place.start.a), any_vertex(pair.b, place.start.b), answer_.plane_tests);
    MarchResult r;
    r.a = {FeatureKind::Vertex, va};
    r.b = {FeatureKind::Vertex, vb};
    r.lower = std::max(0.0, lower);
    r.upper = apart(pair, va, vb);
    r.normal = eigen(n);
    r.point_a = eigen(body_a(pair).point(va));
    r.point_b = eigen(body_b(pair).point(vb));
    carry(place, r, pair.law_two);
    const auto better = [](const ConvexView& view, Handle child, std::uint32_t v) {
      return any_vertex(view, child) == v ? child : Handle{FeatureKind::Vertex, v};
    };
    return {better(pair.a, place.start.a, va), better(pair.b, place.start.b, vb)};
  }

  /// Takes over the bounds of a pair where they are better: the plane with lower; points, levels and features with upper. A
  /// finer pair's replace a coarser one's that are better by no more than rounding, so that plane and points belong together.
  void carry(const Place& place, const MarchResult& r, double rounding) {
    if (r.lower >= answer_.lower - rounding) {
      answer_.lower = r.lower;
      answer_.normal = r.normal;
    }
    const double error = deviation(place.level_a, place.level_b);
    const double upper = error > 0 ? (r.upper + error) * (1 + 2 * kU) : r.upper;
    if (upper <= answer_.upper + rounding) {
      answer_.upper = upper;
      answer_.point_a = r.point_a;
      answer_.point_b = r.point_b;
      answer_.level_a = place.level_a;
      answer_.level_b = place.level_b;
      answer_.feature_a = r.a;
      answer_.feature_b = r.b;
      answer_.proof = r.proof;
    }
    answer_.upper = std::max(answer_.upper, answer_.lower);
  }

  /// Certifies a walk, carries the better bounds, and says which features it ended on.
  MarchStart bound(const Scene& pair, const Place& place, const Walk& walked) {
    MarchRule rule;
    rule.beyond = target_.clear_above;
    rule.step_budget = walked.steps + steps_left();
    Walk capped = walked;
    if (spent_) capped.end = WalkEnd::Budget;
    const MarchResult r = conclude(pair, capped, rule);
    answer_.steps += r.steps - walked.steps;
    answer_.plane_tests += r.plane_tests - walked.plane_tests;
    carry(place, r, pair.law_two);
    met_ = r.status;
    return {r.a, r.b};
  }

  void record(const Place& place, std::uint32_t steps_before, std::uint32_t tests_before) {
    if (!options_.trace.empty()) {
      const auto slot = std::min<std::size_t>(answer_.levels_visited, options_.trace.size() - 1);
      options_.trace[slot] = {place.level_a,
                              place.level_b,
                              answer_.lower,
                              answer_.upper,
                              answer_.steps - steps_before,
                              answer_.plane_tests - tests_before};
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
    if (answer_.lower > 0) next.direction = vec(answer_.normal);
    const auto refine_a = [&] {
      if (next.level_a > finest_a_) next.start.a = child(a_, next.level_a, next.start.a), --next.level_a;
    };
    const auto refine_b = [&] {
      if (next.level_b > finest_b_) next.start.b = child(b_, next.level_b, next.start.b), --next.level_b;
    };
    if (options_.refinement == Refinement::Single) {
      const bool a_is_coarser = a_.level(next.level_a).deviation >= b_.level(next.level_b).deviation;
      if (next.level_b == finest_b_ || (a_is_coarser && next.level_a > finest_a_))
        refine_a();
      else
        refine_b();
      return next;
    }
    if (options_.refinement == Refinement::DoubleDouble) refine_a(), refine_b();
    refine_a(), refine_b();  // whatever the value: a descent ends
    return next;
  }

  Answer finish(const Place& place, const MarchStart& found, PairSeed& seed) {
    const bool exact_levels = place.level_a == 0 && place.level_b == 0;
    if (met_ == MarchStatus::Overlapping && exact_levels)
      answer_.verdict = Verdict::Overlapping;
    else if (met_ == MarchStatus::Touching && exact_levels)
      answer_.verdict = Verdict::Touching;
    else if (answer_.lower > 0)
      answer_.verdict = Verdict::Disjoint;
    const bool exact =
        exact_levels && (met_ == MarchStatus::Disjoint || met_ == MarchStatus::Touching || met_ == MarchStatus::Overlapping);
    if (answer_.lower > target_.clear_above + law_two_)
      answer_.status = Status::Beyond;
    else if (answered() || exact)
      answer_.status = Status::Converged;
    else if (spent_)
      answer_.status = Status::Budget;
    else if (!exact_levels)
      answer_.status = Status::LevelLimit;
    else
      answer_.status = Status::NotConverged;
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
      const bool suffices =
          options_.start != StartPolicy::Finest && (lower > target_.clear_above || (lower > 0 && narrow(lower, error)));
      if (!absorbs && !suffices) break;
      kept.start = {parent(a_, kept.level_a++, kept.start.a), parent(b_, kept.level_b++, kept.start.b)};
    }
    remember_line(line_, seed);
    seed.a = kept.start.a;
    seed.b = kept.start.b;
    seed.level_a = std::uint8_t(kept.level_a);
    seed.level_b = std::uint8_t(kept.level_b);
  }

  const Model& a_;
  const Model& b_;
  const Motion motion_;
  const Line line_;
  const double pose_error_, stretch_;  ///< stretch bounds the rotation's norm
  const QueryOptions& options_;
  const Target& target_;
  const double law_two_;
  const int finest_a_, finest_b_;
  Answer answer_;
  MarchStatus met_ = MarchStatus::NotConverged;
  bool spent_ = false;  ///< the caller's step budget
};

}  // namespace

Answer descend(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
               const Target& target) {
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
