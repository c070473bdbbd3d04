// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The descent through levels of detail [Ehmann & Lin 2000, sec. 5.2]. From one level pair to the next only two features are
// carried: the classic implementations carried more of a walk's state, and looped on up to 5 % of queries.
#include "query/descend.h"
#include "pair/certify.h"
#include "pair/conclude.h"
#include "pair/overlap.h"
#include "pair/start.h"
#include "pair/support_gjk.h"
#include "pair/tetrahedron.h"
#include "pair/walk.h"
#include "query/model_pair.h"
#include "query/seed.h"
#include "query/separating_axis.h"

#include <algorithm>

namespace swiftlet {
namespace {

class Descent {
 public:
  Descent(const ModelPair& pair, const Line& line, const StopRule& asked, const Beginning& from, Answer& answer,
          OverlapProof& proof)
      : pair_(pair),
        a_(pair.a),
        b_(pair.b),
        line_(line),
        budget_(pair.limits.budget),
        tuning_(pair.limits.tuning),
        trace_(pair.limits.trace),
        asked_(asked),
        stop_(asked.beyond_by(pair.law_two())),
        law_two_(pair.law_two()),
        finest_a_(pair.finest_a()),
        finest_b_(pair.finest_b()),
        has_maps_(pair.has_maps()),
        exact_(from.exact),
        from_(from),
        answer_(answer),
        proof_(proof) {}

  /// Begins at the features of `place`; if it has none, or a walk from a seed's gets lost, on support maps or the coarsest
  /// pair.
  void start(Place place, PairSeed& seed) {
    const SupportGjk* on_maps = from_.on_maps;
    const bool walked = is_warm(place.start) && !on_maps && march(place, has_maps_, from_.walk);
    const bool seen = on_maps ? on_maps->simplex.count == 4 && overlap(place, *on_maps) && (record(place), true)
                              : !walked && has_maps_ &&
                                    map_gjk(place, sampled() ? vec4(from_.seen.normal) : pair_.first_direction(line_, seed));
    if (!walked && !seen) march(place, false, on_maps ? from_.walk : nullptr);
    const bool met = met_ == MarchStatus::Overlapping;
    if (proof_.count == 4 && answer_.level_a == 0 && answer_.level_b == 0)
      seed.inside_a = proof_.vertex_a, seed.inside_b = proof_.vertex_b;
    if (seen && (asked_.is_threshold() || !met)) {  // vertices that only maps named are no better start than none
      remember(line_, vec(answer_.normal), seed);
      seed.a = seed.b = {};
      seed.met = met;
    } else {
      store(place, seed);
    }
    finish(place);
  }

  /// Goes on from where another query ended, as `answer_` says; from the seed on if the levels of its features may not be read.
  void go_on(PairSeed& seed, double exact_width) {
    Place place{answer_.level_a, answer_.level_b, {answer_.feature_a, answer_.feature_b}};
    answer_.steps = answer_.plane_tests = 0;
    answer_.levels_visited = 0;
    if (!may_read(a_, finest_a_, place.level_a) || !may_read(b_, finest_b_, place.level_b)) {
      Turn turn;
      return start(first_place(a_, b_, line_, seed, finest_a_, finest_b_, tuning_.start, Warm::Near, turn), seed);
    }
    place.start = settled(view_at(place), place.start, answer_.plane_tests);
    met_ = met_before(exact_width);
    if (!answered() && met_ == MarchStatus::NotConverged) narrow_down(place);
    if (tuning_.start != StartPolicy::Coarsest) store(place, seed);  // else the seed stays as the first descent left it
    finish(place);
  }

 private:
  static bool is_warm(const MarchStart& start) { return start.a.kind() != FeatureKind::None; }
  static bool same_levels(const Place& x, const Place& y) { return x.level_a == y.level_a && x.level_b == y.level_b; }
  static bool may_read(const Shape& body, int finest, int level) { return level >= finest && level < body.level_count(); }
  bool finest(const Place& place) const { return place.level_a == finest_a_ && place.level_b == finest_b_; }
  PairView view_at(const Place& place) const { return pair_.view_at(place); }
  double deviation(int level_a, int level_b) const { return pair_.deviation(level_a, level_b); }
  /// Certified GJK may have taken one step more than the budget has.
  std::uint32_t steps_left() const { return swiftlet::steps_left(budget_.steps, answer_.steps); }
  bool sampled() const { return max_abs(from_.seen.normal) > 0; }
  /// The width that the bounds on a coarse pair may have: the allowed width, less 8 u of it for rounding, less the deviation
  /// `error`; 0 on the exact pair. To prove more, such as that coarse levels overlap, takes vertices from all around both.
  double width_left(double error) const { return error > 0 ? max(0, stop_.allowed(answer_.lower) * (1 - 8 * kU) - error) : 0; }
  /// An exact answer allows no width: it is recognised by `met_`.
  bool answered() const { return stop_.met(answer_.lower, answer_.upper); }

  /// Goes on to finer pairs from a pair whose bounds are not narrow enough.
  void narrow_down(Place& place) {
    if (!finest(place)) place = refined(place);
    const bool mapped = has_maps_ && place.level_a >= a_.map_level() && place.level_b >= b_.map_level();
    const Vec known = vec(answer_.normal);
    if (mapped && map_gjk(place, max_abs(known) > 0 ? vec4(known) : pair_.first_direction(line_, {}))) return;
    march(place, false);
  }

  /// The march status of the exact hulls that `answer_` implies if it is exact: on level 0, no wider than `exact_width` or law
  /// 2's bound. NotConverged if it can still be narrowed.
  MarchStatus met_before(double exact_width) const {
    if (answer_.level_a != 0 || answer_.level_b != 0 || !(answer_.upper - answer_.lower <= max(law_two_, exact_width)))
      return MarchStatus::NotConverged;
    switch (answer_.verdict) {
      case Verdict::Overlapping: return MarchStatus::Overlapping;
      case Verdict::Touching: return MarchStatus::Touching;
      case Verdict::Disjoint: return MarchStatus::Disjoint;
      default: return MarchStatus::NotConverged;
    }
  }

  /// Runs GJK on support maps, first on the pair that the axis test sampled or on the coarsest pair that might answer, then on
  /// each finer one. Returns true if that answers; else `place` becomes where a walk begins. From the first pair on, GJK visits
  /// every finer pair and begins anew there, from the same direction: of two tolerances that begin on the same pair, the looser
  /// one does the same work and stops earlier.
  bool map_gjk(Place& place, const Vec4& direction) {
    const Place least = pair_.finest_mapped();
    place = exact_ || asked_.is_threshold() ? least : mapped_for(pair_, asked_, norm(line_.in_a));
    for (bool first = true;; first = false) {
      const bool last = same_levels(place, least);
      const PairView pair = view_at(place);
      const Level &of_a = a_.level(place.level_a), &of_b = b_.level(place.level_b);
      const double error = deviation(place.level_a, place.level_b);
      const Moved4 other(pair);
      const AxisSample known = sampled() && first ? from_.seen : sample_axis(pair, other, of_a, of_b, direction),
                       seen = best_sample(pair, other, of_a, of_b, error, known);
      const SupportGjk found = support_gjk(pair, of_a, of_b, error, seen, [&](const SupportGjk& s) {
        if (exact_) return s.near;
        const double lower = max(answer_.lower, s.most_lower), upper = min(answer_.upper, s.upper + error);
        if (stop_.met(lower, upper) || (!last && !stop_.allows(upper, error))) return true;
        const double doubt = s.seen.gap > 0 ? kDoubtShare * (s.seen.gap - s.seen.lower) + error : kHiddenShare * error;
        return s.near && !stop_.allows(lower, doubt);
      });
      if (!exact_) take(place, found, pair);
      if (asked_.is_threshold() && last && !answered() && found.seen.gap > asked_.above) climb(place, found.seen, pair);
      // Bounds that agree as an exact answer's do promise features that hold the points, and a plane that fits them: where the
      // points lie between several vertices, a walk finds both.
      const bool lacks_features = found.simplex.count > 1 && answer_.upper - answer_.lower <= law_two_;
      if ((answered() && !lacks_features) || (found.simplex.count == 4 && overlap(place, found))) return record(place), true;
      if (!asked_.is_threshold()) place.start = found.start;
      if (finest(place)) return false;  // a walk on the same pair follows
      record(place);
      if (last) return place = refined(place), false;
      place = {std::max(place.level_a - 1, least.level_a), std::max(place.level_b - 1, least.level_b), {}};
    }
  }

  /// Bounds the distance along the direction of `seen` by climbs, because maps are uncertain by some 1e-3 of a body.
  void climb(Place& place, const AxisSample& seen, const PairView& pair) {
    const AxisSample top = climbed(pair, seen, answer_.plane_tests);
    place.start = supports_of(top);
    carry(place, {std::max(0.0, top.lower), apart(pair, top.a, top.b), top.normal, top.point, top.point + top.apart},
          pair.law_two);
  }
  void take(Place& place, const SupportGjk& s, const PairView& pair) {
    place.start = supports_of(s.seen);
    const Feet feet =
        s.simplex.count < 4 ? feet_of(pair, s.simplex) : Feet{s.seen.point, s.seen.apart, apart(pair, s.seen.a, s.seen.b)};
    carry(place, {std::max(0.0, s.most_lower), feet.upper, s.lower_along, feet.point, feet.point + feet.apart}, pair.law_two);
  }

  /// Returns true if the descendants on level 0 of the corners of `found.simplex` prove that the exact hulls overlap.
  bool overlap(Place& place, const SupportGjk& found) {
    OverlapProof proof = found.simplex.proof();
    if (finest_a_ != 0 || finest_b_ != 0) return false;
    for (std::size_t k = 0; k < proof.count; ++k) {
      proof.vertex_a[k] = descendant(a_, place.level_a, proof.vertex_a[k]);
      proof.vertex_b[k] = descendant(b_, place.level_b, proof.vertex_b[k]);
    }
    const PairView pair = view_at({0, 0, {}});
    if (!proves_deep_overlap(pair, proof)) return false;
    place = {0, 0, {}};
    take_overlap(pair, place, found.seen.normal, proof);
    return true;
  }

  /// Returns true if the features where a walk ended inside prove, together with a vertex of each body that its map names on
  /// the far side, that the levels of the pair overlap.
  bool overlap(const PairView& pair, const Place& place) {
    if (!has_maps_) return false;
    const Vec n = normal_between(pair, place.start);
    const std::uint32_t behind_a = about_farthest(a_, place.level_a, -n),
                        behind_b = about_farthest(b_, place.level_b, body_b(pair).into(n));
    OverlapProof proof;
    if (!meet(pair, place.start, behind_a, behind_b, proof)) return false;
    take_overlap(pair, place, normalised(n), proof);
    return true;
  }
  void take_overlap(const PairView& pair, const Place& place, const Vec& normal, const OverlapProof& proof) {
    met_ = MarchStatus::Overlapping;
    if (place.level_a == 0 && place.level_b == 0) answer_.lower = 0;
    const Vec common = surely_common_point(pair, proof);
    carry(place, {0, 0, normal, common, common, proof}, pair.law_two);
  }

  /// Walks and certifies from level pair to finer level pair until the question is answered. Returns false if `may_give_up` and
  /// the start has turned out to be worse than none. `known`, if not null, is the walk on the first pair.
  bool march(Place& place, bool may_give_up, const Walk* known = nullptr) {
    for (;; known = nullptr) {
      const PairView pair = view_at(place);
      const bool last = finest(place);
      met_ = MarchStatus::NotConverged;
      Walk walked = known ? *known : walk_on(pair, place);
      spent_ = walked.end == WalkEnd::Budget && answer_.steps >= budget_.steps;
      const bool lost = walked.end == WalkEnd::Budget && !spent_;
      const bool wanted = last || worth_certifying(place, walked);
      if (walked.end == WalkEnd::Inside && wanted && overlap(pair, {place.level_a, place.level_b, {walked.a, walked.b}})) {
        place.start = {walked.a, walked.b};
        record(place);
        if (last || answered()) return true;
        place = refined(place);
        continue;
      }
      if (lost || (may_give_up && walked.end == WalkEnd::Inside)) {
        record(place);
        if (may_give_up) return false;
        place = coarsest_place(a_, b_);
        continue;
      }
      place.start = {walked.a, walked.b};
      if (place.level_a + 1 == a_.level_count() && place.level_b + 1 == b_.level_count()) coarsest_ = place.start;
      if (wanted || spent_) bound(pair, place, walked);
      record(place);
      if (last || spent_ || answered()) return true;
      place = refined(place);
    }
  }

  Walk walk_on(const PairView& pair, const Place& place) {
    const MarchStart from = settled(pair, place.start, answer_.plane_tests);
    const double lower = answer_.lower > 0 ? answer_.lower : -kInfinity,
                 enough2 = tuning_.careful ? -1 : enough2_of(pair_, place, stop_, lower);
    const Walk walked = walk(pair, from.a, from.b, tuning_.plane_rule, std::min(steps_left(), place.trial_steps), enough2);
    answer_.steps += walked.steps;
    answer_.plane_tests += walked.plane_tests;
    return walked;
  }

  /// True if a coarse pair is to be certified. A pair whose walk ended at a minimum always is, so that queries with different
  /// tolerances take the same way, and that with the looser one stops earlier. Other pairs are certified if the deviation alone
  /// may answer, or for a trace.
  bool worth_certifying(const Place& place, const Walk& walked) const {
    const double error = deviation(place.level_a, place.level_b);
    return walked.end == WalkEnd::Minimum || walked.end == WalkEnd::Enough || !trace_.empty() || stop_.allows(0, error) ||
           error < stop_.below;
  }

  /// Bounds on the distance of one level pair, and the normal, points and overlap proof that go with them.
  struct Bounds {
    double lower, upper;
    Vec normal, point_a, point_b;
    OverlapProof proof{};
  };

  /// Takes over the bounds of a pair if they are better: the normal with `lower`; points, levels, features and proof with
  /// `upper`. Bounds worse by no more than `rounding` are taken over too, so that plane and points belong to one pair.
  void carry(const Place& place, const Bounds& of, double rounding) {
    if (of.lower >= answer_.lower - rounding) {
      answer_.lower = of.lower;
      answer_.normal = eigen(of.normal);
    }
    const double error = deviation(place.level_a, place.level_b);
    const double upper = error > 0 ? (of.upper + error) * (1 + 2 * kU) : of.upper;
    if (upper <= answer_.upper + rounding) {
      answer_.upper = upper;
      answer_.point_a = eigen(of.point_a);
      answer_.point_b = eigen(of.point_b);
      answer_.level_a = std::int16_t(place.level_a);
      answer_.level_b = std::int16_t(place.level_b);
      answer_.feature_a = place.start.a;
      answer_.feature_b = place.start.b;
      proof_ = of.proof;
    }
    answer_.upper = std::max(answer_.upper, answer_.lower);
  }

  /// Certifies a walk and takes over the better bounds; the features of `place` become those of the certificate.
  void bound(const PairView& pair, Place& place, Walk& walked) {
    if (walked.end == WalkEnd::Enough) {
      const Nearest& at = walked.nearest;
      const double upper = upper_at(pair, at, norm(at.point_b - at.point_a));
      return carry(place, {answer_.lower, upper, vec(answer_.normal), at.point_a, at.point_b}, pair.law_two);
    }
    Proof proof;
    doubt_ = tuning_.careful ? Doubt::Asked : settle(pair, walked, asked_.zero, asked_.above, answer_.plane_tests, proof);
    if (doubt_ == Doubt::None) {
      met_ = MarchStatus::Disjoint;
      const Nearest& at = walked.nearest;
      return carry(place, {proof.lower, proof.upper, proof.normal, at.point_a, at.point_b}, pair.law_two);
    }
    MarchRule rule;
    rule.absolute = width_left(deviation(place.level_a, place.level_b));
    rule.beyond = asked_.above;
    rule.step_budget = walked.steps + steps_left();
    MarchResult r = conclude(pair, walked, rule, asked_.zero);
    if (r.status == MarchStatus::Overlapping && !(2 * norm(vec(r.point_b) - vec(r.point_a)) <= pair.law_two))
      r.point_a = r.point_b = eigen(surely_common_point(pair, r.proof));
    answer_.steps += r.steps - walked.steps;
    answer_.plane_tests += r.plane_tests - walked.plane_tests;
    met_ = r.status;
    place.start = {r.a, r.b};
    carry(place, {r.lower, r.upper, vec(r.normal), vec(r.point_a), vec(r.point_b), r.proof}, pair.law_two);
  }

  void record(const Place& place) {
    const int visited = answer_.levels_visited++;
    if (trace_.empty()) return;
    note(trace_, std::size_t(visited),
         {place.level_a, place.level_b, answer_.lower, answer_.upper, answer_.steps - recorded_steps_,
          answer_.plane_tests - recorded_tests_, doubt_});
    recorded_steps_ = answer_.steps;
    recorded_tests_ = answer_.plane_tests;
    doubt_ = Doubt::None;
  }

  /// The next finer level pair, without features to start from.
  Place finer(const Place& place) const {
    Place next{place.level_a, place.level_b, {}};
    const auto refine_a = [&] { next.level_a = std::max(next.level_a - 1, finest_a_); };
    const auto refine_b = [&] { next.level_b = std::max(next.level_b - 1, finest_b_); };
    if (tuning_.refinement == Refinement::Single) {
      const bool a_is_coarser = a_.level(next.level_a).deviation >= b_.level(next.level_b).deviation;
      if (next.level_b == finest_b_ || (a_is_coarser && next.level_a > finest_a_))
        refine_a();
      else
        refine_b();
      return next;
    }
    if (tuning_.refinement == Refinement::DoubleDouble) refine_a(), refine_b();
    refine_a(), refine_b();  // whatever the value, so that a descent ends
    return next;
  }

  /// The next finer level pair, with the children of the features of `place`.
  Place refined(const Place& place) const {
    Place next = finer(place);
    next.start = place.start;
    for (int level = place.level_a; level > next.level_a; --level) next.start.a = child(a_, level, next.start.a);
    for (int level = place.level_b; level > next.level_b; --level) next.start.b = child(b_, level, next.start.b);
    return next;
  }

  void finish(const Place& place) {
    const bool exact_levels = place.level_a == 0 && place.level_b == 0;
    if (met_ == MarchStatus::Overlapping && exact_levels)
      answer_.verdict = Verdict::Overlapping;
    else if (met_ == MarchStatus::Touching && exact_levels)
      answer_.verdict = Verdict::Touching;
    else if (answer_.lower > 0)
      answer_.verdict = Verdict::Disjoint;
    else if (answer_.verdict == Verdict::Disjoint)  // by a bound that a plane which fits the points has replaced
      answer_.verdict = Verdict::Undecided;
    const bool exact =
        exact_levels && (met_ == MarchStatus::Disjoint || met_ == MarchStatus::Touching || met_ == MarchStatus::Overlapping);
    if (answer_.lower > stop_.above)
      answer_.status = Status::Beyond;
    else if (answered() || exact)
      answer_.status = Status::Converged;
    else if (spent_)
      answer_.status = Status::Budget;
    else if (!exact_levels)
      answer_.status = Status::LevelLimit;
    else
      answer_.status = Status::NotConverged;
  }

  /// Stores the features found in `seed`, or their ancestors on the coarsest pair that would have answered as well.
  void store(const Place& place, PairSeed& seed) const {
    Place kept{place.level_a, place.level_b, place.start};
    if (tuning_.start == StartPolicy::Coarsest) {
      kept = coarsest_place(a_, b_);
      kept.start = coarsest_;
    }
    keep(pair_, asked_, exact_, answer_, kept, seed);
    remember(line_, vec(answer_.normal), seed);
    seed.met = met_ == MarchStatus::Overlapping;
  }
  const ModelPair& pair_;
  const Shape& a_;
  const Shape& b_;
  const Line& line_;
  const Budget& budget_;
  const Tuning& tuning_;
  const std::span<LevelRecord> trace_;
  const StopRule& asked_;
  /// Passes a threshold only by more than law 2's bound: within it, what can be proved depends on the start.
  const StopRule stop_;
  const double law_two_;
  const int finest_a_, finest_b_;
  const bool has_maps_;
  const bool exact_;  ///< no coarser pair is likely to answer
  const Beginning& from_;
  Answer& answer_;
  OverlapProof& proof_;
  MarchStatus met_ = MarchStatus::NotConverged;
  MarchStart coarsest_;        ///< features on the coarsest pair, for StartPolicy::Coarsest
  bool spent_ = false;         ///< the caller's step budget is used up
  Doubt doubt_ = Doubt::None;  ///< of the walk on the pair that is visited
  std::uint32_t recorded_steps_ = 0, recorded_tests_ = 0;
};

}  // namespace

void descend(const ModelPair& pair, const Line& line, const StopRule& asked, const Beginning& from, const Place& place,
             PairSeed& seed, Answer& answer, OverlapProof& proof) {
  Descent(pair, line, asked, from, answer, proof).start(place, seed);
}

void go_on(const ModelPair& pair, const StopRule& asked, double exact_width, PairSeed& seed, Answer& answer,
           OverlapProof& proof) {
  const Line line = pair.line();
  Beginning anywhere{};
  anywhere.exact = is_exact(pair, line.in_a, asked);
  Descent(pair, line, asked, anywhere, answer, proof).go_on(seed, exact_width);
}

Place coarsened(const ModelPair& pair, const StopRule& asked, const Answer& answer, Place found) {
  const StopRule stop = asked.beyond_by(pair.law_two());
  const double error_found = pair.deviation(found.level_a, found.level_b);
  double slack = answer.upper;  // for StartPolicy::Paper: deviations may grow by the distance
  while (found.level_a + 1 < pair.a.level_count() && found.level_b + 1 < pair.b.level_count()) {
    const double error = pair.deviation(found.level_a + 1, found.level_b + 1);
    const double grown = error - pair.deviation(found.level_a, found.level_b), lower = answer.lower - (error - error_found);
    const bool absorbs =
        pair.limits.tuning.start == StartPolicy::Paper && (slack -= std::max(0.0, grown)) >= 0 && answer.lower > 0;
    const bool suffices = lower > asked.above || (lower > 0 && stop.allows(lower, error));
    if (!absorbs && !suffices) break;
    found.start = {parent(pair.a, found.level_a++, found.start.a), parent(pair.b, found.level_b++, found.start.b)};
  }
  return found;
}

}  // namespace swiftlet
