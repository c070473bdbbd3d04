// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way of every question about distance: what the last query of the pair left in its seed answers most of them, by a
// separating axis, the nearest features to walk on from, or the vertices that proved an overlap; else the descent. Each file
// that includes this compiles it for the registers of its own flags: see ask.h.
#pragma once

#include <algorithm>
#include <utility>

#include <swiftlet/query.h>

#include "pair/conclude.h"
#include "pair/marcher.h"
#include "pair/start.h"
#include "pair/stop_rule.h"
#include "pair/tetrahedron.h"
#include "pair/walk.h"
#include "query/ask.h"
#include "query/descend.h"
#include "query/limits.h"
#include "query/model_pair.h"
#include "query/radii.h"
#include "query/seed.h"
#include "query/separating_axis.h"
#include "query/spheres.h"

namespace swiftlet {

/// Walks within the budget and the trial of `place` from legal features on its level pair; `enough2` as of `walk`.
template <class Pair>
[[gnu::always_inline]] static inline Walk walk_from(const Pair& pair, const PairView& view, FeatureId a, FeatureId b,
                                                    const Place& place, const Answer& answer, double enough2) {
  const std::uint32_t most = std::min(steps_left(pair.limits.budget.steps, answer.steps), place.trial_steps);
  return walked_by(pair.limits.tuning.plane_rule, view, a, b, most, enough2);
}
/// Walks on the level pair of `place`, from its features, which a seed may have named. They are read one by one, as they were
/// stored: a load of both would wait until both stores are done.
template <class Pair>
[[gnu::always_inline]] static inline Walk walk_from(const Pair& pair, const PairView& view, const Place& place, Answer& answer,
                                                    double enough2) {
  FeatureId a = place.start.a, b = place.start.b;
  if (!is_legal_start(view, a, b)) {
    const MarchStart legal = made_legal(view, place.start, answer.plane_tests);
    a = legal.a, b = legal.b;
  }
  return walk_from(pair, view, a, b, place, answer, enough2);
}
/// Answers from a walk on the level pair of `place` if the tests that end it, or `bound` beside features near enough, prove
/// enough. `place` gets the walk's features.
template <class Pair>
[[gnu::always_inline]] static inline bool answers(const Pair& pair, const PairView& view, Walk& walked, const LowerBound& bound,
                                                  const Line& line, const StopRule& asked, bool exact, Turn turn,
                                                  PairSeed& seed, Place& place, Answer& answer) {
  answer.steps += walked.steps;
  answer.plane_tests += walked.plane_tests;
  place.start = {walked.a, walked.b};
  Proof proof;
  const bool early = asked.is_loose() && walked.end == WalkEnd::Enough;
  if (early) {
    const Nearest& at = walked.nearest;
    proof = {max(0, bound.lower), upper_at(view, at, norm(at.point_b - at.point_a)), bound.normal};
  } else if (settle(view, walked, asked.zero, asked.above, answer.plane_tests, proof) != Doubt::None) {
    return false;
  }
  double upper = proof.upper;
  if (early || place.level_a != 0 || place.level_b != 0) {
    upper = (upper + pair.deviation(place.level_a, place.level_b)) * (1 + 2 * kU);
    if (!asked.beyond_by(pair.law_two()).met(proof.lower, upper)) return false;
  }
  answer.status = proof.lower > asked.above ? Status::Beyond : Status::Converged;
  answer.verdict = proof.lower > 0 ? Verdict::Disjoint : Verdict::Undecided;
  answer.lower = proof.lower;
  answer.upper = upper;
  answer.normal = eigen(proof.normal);
  answer.point_a = eigen(walked.nearest.point_a);
  answer.point_b = eigen(walked.nearest.point_b);
  answer.level_a = std::int16_t(place.level_a), answer.level_b = std::int16_t(place.level_b);
  answer.feature_a = walked.a, answer.feature_b = walked.b;
  answer.levels_visited = 1;
  note(pair.limits.trace, 0, {place.level_a, place.level_b, answer.lower, answer.upper, answer.steps, answer.plane_tests});
  keep(pair, asked, exact, answer, place, seed);
  turn == Turn::Little ? remember(vec4(proof.normal), seed) : remember(line, proof.normal, seed);
  seed.met = false;
  return true;
}

/// A place on the maps of two levels, which deviate by `deviation`, where a walk may begin, or bounds that answer `asked`: from
/// the sample `known` on, or, if that is null, from the direction `first`. Mostly the first supports are near. A function of
/// its own, as what it needs would widen the frame of every question.
[[gnu::noinline]] static SupportGjk nearest_on_maps(const PairView& view, const Level& a, const Level& b, double deviation,
                                                    const StopRule& asked, const AxisSample* known, const Vec4& first) {
  const Moved4 other(view);
  const AxisSample seen = known ? *known : sample_axis(view, other, a, b, first);
  return are_near(seen, a, b, deviation) ? found_at(view, other, seen) : search_maps(view, a, b, deviation, asked, seen);
}

/// Makes the tetrahedron of `proof` follow the origin out of a face: the corner across from that is replaced by what the maps
/// name beyond it. Returns false if that is not as far as the origin, or no other than the face has.
[[maybe_unused, gnu::noinline, gnu::flatten]] static bool follow(const ModelPair& pair, const Tetrahedron::Exit& exit,
                                                                 OverlapProof& proof) {
  const Place at = pair.finest_mapped();
  const Level &a = pair.a.level(at.level_a), &b = pair.b.level(at.level_b);
  const PairView view = pair.view_of(a, b);
  const AxisSample seen = sample_axis(view, Moved4(view), a, b, exit.out);
  const std::uint32_t va = descendant(pair.a, at.level_a, seen.a), vb = descendant(pair.b, at.level_b, seen.b);
  for (std::size_t k = 0; k < 4; ++k)
    if (proof.vertex_a[k] == va && proof.vertex_b[k] == vb) return false;
  proof.vertex_a[exit.across] = va, proof.vertex_b[exit.across] = vb;
  return !(seen.gap > 0);
}
/// Answers that the bodies overlap if the vertex pairs that proved it last time still do, or do once they have followed the
/// origin.
template <class Pair>
[[gnu::always_inline]] static inline bool overlaps_as_before(const Pair& pair, PairSeed& seed, Answer& answer,
                                                             OverlapProof& proof) {
  const PairView view = pair.view_at({0, 0, {}});
  const auto names = [](const std::array<std::uint32_t, 4>& v, const ConvexView& body) {
    return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])) < body.vertices.size();
  };
  if (pair.finest_a() != 0 || pair.finest_b() != 0 || !names(seed.inside_a, view.a) || !names(seed.inside_b, view.b))
    return false;
  OverlapProof now{4, seed.inside_a, seed.inside_b};
  int steps = 0;
  for (;; ++steps) {
    const Tetrahedron tetrahedron(view, now);
    if (tetrahedron.is_deep(view)) {
      Vec common;
      if (!tetrahedron.finds_common(view, common)) return false;
      answer.point_a = answer.point_b = eigen(common);
      break;
    }
    const Tetrahedron::Exit exit = tetrahedron.exit();
    bool follows = exit.across < 4 && steps < kOriginSteps && pair.has_maps();
    if (follows) in_general(pair, [&](const ModelPair& general) { follows = follow(general, exit, now); });
    if (!follows) return false;
  }
  answer.status = Status::Converged;
  answer.verdict = Verdict::Overlapping;
  answer.lower = answer.upper = 0;
  answer.feature_a = {FeatureKind::Vertex, now.vertex_a[0]}, answer.feature_b = {FeatureKind::Vertex, now.vertex_b[0]};
  answer.levels_visited = 1;
  note(pair.limits.trace, 0, {0, 0, 0, 0});
  if (steps > 0) seed.inside_a = now.vertex_a, seed.inside_b = now.vertex_b;
  proof = now;
  return true;
}

/// Answers, if that suffices, by what needs no features: the balls and ellipsoids around and inside the bodies, the vertices
/// that proved an overlap, of verdicts a sample of the maps, which `seen` becomes. `line` has its first half, and gets the
/// second if the balls do not answer.
template <class Pair>
[[gnu::always_inline]] static inline bool answers_at_once(const Pair& pair, const StopRule& asked, bool exact, Line& line,
                                                          PairSeed& seed, AxisSample& seen, Answer& answer,
                                                          OverlapProof& proof) {
  const Tuning& tuning = pair.limits.tuning;
  const bool automatic = tuning.start == StartPolicy::Automatic, asks = asked.is_threshold(),
             unwatched = pair.limits.trace.empty() && !tuning.proof && !tuning.careful;
  if (asks && automatic && unwatched && spheres_are_apart(pair, line.in_a, asked, answer)) return true;
  if ((asks || seed.met) && automatic && unwatched && spheres_meet(pair, line.in_a, answer)) return true;
  store(turned_line(vec4(line.in_a), pair.motion), line.in_b);
  // Where a sample gave the seed its direction, the ellipsoids had not answered: they are not asked again.
  const bool knows = asks && !seed.met && SinceStored(seed, line.in_a).serves(),
             likely = seed.met || (asks && !knows && are_close(pair, line.in_a));
  if (likely && automatic && unwatched && ellipsoids_meet(pair, line, answer)) return true;
  if (asks && !seed.met && !knows && automatic && unwatched && ellipsoids_are_apart(pair, line, asked, answer)) return true;
  if (seed.met && automatic && overlaps_as_before(pair, seed, answer, proof)) return true;
  const bool samples = !seed.met && pair.limits.trace.empty() && pair.has_maps();
  if (asks && samples && separating_axis(pair, line, asked, knows, seed, seen, answer)) return true;
  return !asks && !exact && automatic && unwatched && spheres_suffice(pair, line.in_a, norm(line.in_a), asked, answer);
}

/// Answers from `place` on. `known` is the walk from its features, if that is not null. `seen` is a sample of the pair's maps,
/// if it has a direction, on the level pair whose maps are searched, and `bound` what samples have proved.
template <class Pair>
[[gnu::always_inline]] static inline void answer_from(const Pair& pair, const StopRule& asked, bool exact, const Line& line,
                                                      const AxisSample& seen, LowerBound& bound, Turn turn, Place place,
                                                      const Walk* known, PairSeed& seed, Answer& answer, OverlapProof& proof) {
  const Tuning& tuning = pair.limits.tuning;
  const auto descends = [&](Place from, const SupportGjk* on_maps, const Walk* walk) {
    answer.normal.setZero();
    in_general(pair, [&](const ModelPair& general) {
      descend(general, line, asked, {seen, on_maps, walk, exact}, from, seed, answer, proof);
    });
  };
  const bool walks = !tuning.careful && tuning.start != StartPolicy::Coarsest;
  if (walks && place.start.a.kind() != FeatureKind::None) {
    const PairView view = pair.view_at(place);
    const double enough2 = enough2_of(pair, place, asked, bound.lower);
    Walk walked = known ? *known : walk_from(pair, view, place, answer, enough2);
    if (answers(pair, view, walked, bound, line, asked, exact, turn, seed, place, answer)) return;
    const bool lost = walked.end == WalkEnd::Budget && answer.steps < pair.limits.budget.steps;
    if (!lost) return descends(place, nullptr, &walked);
    place = coarsest_place(pair.a, pair.b);
  }
  if (!walks || place.start.a.kind() != FeatureKind::None || !(exact || bound.is_known()) || !pair.finest_has_maps())
    return descends(place, nullptr, nullptr);
  place = pair.finest_mapped();
  const PairView view = pair.view_at(place);
  // Cold, the points of a search of the maps answer too. Where the last direction serves still, a walk does, whose features the
  // next query goes on from.
  const bool sampled = bound.is_known() && max_abs(seen.normal) > 0, cold = !exact && !SinceStored(seed, line.in_a).serves();
  const SupportGjk found = nearest_on_maps(
      view, pair.a.level(place.level_a), pair.b.level(place.level_b), pair.deviation(place.level_a, place.level_b),
      cold ? asked : kExact, sampled ? &seen : nullptr, sampled ? vec4(seen.normal) : pair.first_direction(line, seed, turn));
  place.start = found.start;
  if (found.simplex.count == 4) return descends(place, &found, nullptr);
  if (cold && search_suffices(view, pair.deviation(place.level_a, place.level_b), asked, found, place, answer)) {
    remember(line, found.lower_along, seed);
    keep(pair, asked, exact, answer, place, seed);
    // Vertices that only maps name are a good start on coarser levels alone.
    if (seed.level_a == place.level_a && seed.level_b == place.level_b) seed.a = seed.b = {};
    return;
  }
  if (!(found.most_lower < bound.lower)) bound = {found.most_lower, found.lower_along};
  const double enough2 = enough2_of(pair, place, asked, bound.lower);
  Walk walked = walk_from(pair, view, place.start.a, place.start.b, place, answer, enough2);
  if (answers(pair, view, walked, bound, line, asked, exact, Turn::Some, seed, place, answer)) return;
  descends(place, &found, &walked);
}

/// As `samples_suffice`, in a function of its own: what it needs would widen the frame of every question.
[[maybe_unused, gnu::noinline]] static bool any_sample_suffices(const ModelPair& pair, const Line& line, const StopRule& asked,
                                                                PairSeed& seed, AxisSample& seen, LowerBound& bound,
                                                                Answer& answer) {
  return samples_suffice(pair, line, asked, seed, seen, bound, answer);
}

/// As `ask_hulls`.
template <class Pair>
[[gnu::always_inline]] static inline void answer_hulls(const Pair& pair, const StopRule& asked, PairSeed& seed, Answer& answer,
                                                       OverlapProof& proof) {
  Line line;
  store(between_centres(pair.a, pair.b, pair.motion), line.in_a);
  const bool exact = is_exact(pair, line.in_a, asked);
  AxisSample seen;
  seen.normal = {0, 0, 0};
  if (answers_at_once(pair, asked, exact, line, seed, seen, answer, proof)) return;
  Turn turn;
  const Warm warm = asked.is_threshold() ? Warm::TwiceAsFar : Warm::Near;
  const Place place =
      first_place(pair.a, pair.b, line, seed, pair.finest_a(), pair.finest_b(), pair.limits.tuning.start, warm, turn);
  const Tuning& tuning = pair.limits.tuning;
  LowerBound bound;
  const bool samples = asked.is_loose() && !asked.is_threshold() && !exact && place.start.a.kind() == FeatureKind::None &&
                       !seed.met && pair.has_maps() && pair.limits.trace.empty() && !tuning.proof && !tuning.careful;
  bool suffice = false;
  if (samples) {
    in_general(pair, [&](const ModelPair& general) {
      suffice = any_sample_suffices(general, line, asked, seed, seen, bound, answer);
    });
  }
  if (suffice) return;
  answer_from(pair, asked, exact, line, seen, bound, turn, place, nullptr, seed, answer, proof);
}

/// As `ask`.
[[gnu::always_inline]] static inline void answer_bodies(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                                        const Limits& limits, const StopRule& asked, Answer& answer) {
  if (limits.tuning.proof) *limits.tuning.proof = {};
  const Setting at(a, b, b_in_a);
  const Radii& radii = at.radii;
  if (const Status fault = at.fault(); fault != Status::Converged) return refuse(a, b, fault, false, answer);
  const ModelPair pair(*at.a, *at.b, at.motion, at.quality.error, limits);
  OverlapProof proof;
  if (radii.none()) {
    answer_hulls(pair, asked, seed, answer, proof);
  } else {
    ask_hulls(pair, radii.of_hulls(asked, at.law_two()), seed, answer, proof);
    radii.round(answer, proof, at.law_two());
    radii.round(limits.trace, answer.levels_visited);
  }
  seal(radii, proof, limits.tuning, answer);
}

// What is asked: the questions that most queries ask, whose other limits are constants that compilers fold; or any question.
namespace {
struct ExactDistance {
  static constexpr bool is_loose = false;
  const StopRule& asked() const { return kExact; }
};
struct LooseDistance {
  static constexpr bool is_loose = true;
  double absolute, relative;
  StopRule asked() const { return {absolute, relative}; }
};
struct AnyOverlap {
  static constexpr StopRule rule{0, 0, 0, 0};
  const StopRule& asked() const { return rule; }
};
struct AnyQuestion {
  const StopRule& rule;
  const StopRule& asked() const { return rule; }
};
}  // namespace

/// As `answer_bodies`, for two models without radii and without limits.
template <class Question>
[[gnu::flatten]] static void answer_question(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                                             const Question& question, Answer& answer) {
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) return refuse(a, b, Status::InvalidPose, false, answer);
  const PlainPair pair(Shape(a), Shape(b), m, quality.error, NoLimits{});
  OverlapProof proof;
  answer_hulls(pair, question.asked(), seed, answer, proof);
  seal({0, 0}, proof, NoLimits::tuning, answer);
}

/// As `recalled_distance`, whatever the pose and the seed are.
template <class Question>
[[gnu::noinline]] static Answer distance_anew(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                                              const Question& question) {
  Answer answer;
  answer_question(a, b, b_in_a, seed, question, answer);
  return answer;
}
/// The same from the end of `known` on, a walk on the level pair of `place`, or cold if that is null.
template <class Question>
[[gnu::noinline, gnu::flatten]] static Answer distance_from(const Model& a, const Model& b, const Motion& m, double pose_error,
                                                            const Line& line, Turn turn, Place place, const Walk* known,
                                                            PairSeed& seed, const Question& question) {
  const PlainPair pair(Shape(a), Shape(b), m, pose_error, NoLimits{});
  Answer answer;
  OverlapProof proof;
  AxisSample seen;
  seen.normal = {0, 0, 0};
  place = known ? Place{place.level_a, place.level_b, {known->a, known->b}} : coarsest_place(pair.a, pair.b);
  const StopRule& asked = question.asked();
  // A sample gave the seed its direction, and the balls do not answer this query: another sample is tried at once.
  const bool was_sampled = Question::is_loose && seed.a.kind() == FeatureKind::None && has_direction(seed),
             exact = !Question::is_loose || (!was_sampled && is_exact(pair, line.in_a, asked));
  LowerBound bound;
  const bool at_once = !exact && !known &&
                       ((!was_sampled && spheres_suffice(pair, line.in_a, norm(line.in_a), asked, answer)) ||
                        (pair.has_maps() && samples_suffice(pair, line, asked, seed, seen, bound, answer)));
  if (!at_once) answer_from(pair, asked, exact, line, seen, bound, turn, place, known, seed, answer, proof);
  seal({0, 0}, proof, NoLimits::tuning, answer);
  return answer;
}
/// Answers a loose question by a sample, if that suffices, and is likely to for `stricter`.
[[gnu::noinline, gnu::flatten]] static bool sampled_distance(const Model& a, const Model& b, const Motion& m, double pose_error,
                                                             const Line& line, PairSeed& seed, const LooseDistance& question,
                                                             const LooseDistance& stricter, Answer& answer) {
  const PlainPair pair(Shape(a), Shape(b), m, pose_error, NoLimits{});
  if (!pair.has_maps() || is_exact(pair, line.in_a, stricter.asked())) return false;
  AxisSample seen;
  LowerBound bound;
  if (!samples_suffice(pair, line, question.asked(), seed, seen, bound, answer)) return false;
  seal({0, 0}, OverlapProof(), NoLimits::tuning, answer);
  return true;
}

/// As `ask_distance`. Mostly the seed's features are the nearest ones still: their state is then the whole walk and its tests
/// the proof, and what this function holds stays in registers. Whatever else may follow gets copies: a vector or a view whose
/// address another function knows would be kept in memory here, too.
template <class Question>
[[gnu::flatten]] static Answer recalled_distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                                                 const Question& question) {
  const Motion m = motion(b_in_a);
  PoseQuality quality = pose_quality(m);
  FeatureId fa = seed.a, fb = seed.b;
  unsigned other = Question::is_loose ? seed.met | (seed.level_a >= a.level_count()) | (seed.level_b >= b.level_count())
                                      : seed.level_a | seed.level_b | seed.met;
  other |= a.finest_level() | b.finest_level();
  if (other != 0) return distance_anew(a, b, b_in_a, seed, question);
  if (!quality.legal || !is_state(fa, fb)) return distance_anew(a, b, b_in_a, seed, question);

  const int on_a = Question::is_loose ? seed.level_a : 0, on_b = Question::is_loose ? seed.level_b : 0;
  const Level &level_a = a.level(on_a), &level_b = b.level(on_b);
  Vec4 in_a = between_centres(Shape(a), Shape(b), m), in_b = turned_line(in_a, m);
  const auto line = [&] {
    Line stored;
    store(in_a, stored.in_a), store(in_b, stored.in_b);
    return stored;
  };
  const auto go_on = [&](Turn turn, const Walk* known) {
    return distance_from(a, b, m, quality.error, line(), turn, {on_a, on_b, {}}, known, seed, question);
  };
  if constexpr (Question::is_loose) {
    if (fa.kind() == FeatureKind::None) {  // as balls and samples leave it
      const PlainPair pair(Shape(a), Shape(b), m, quality.error, NoLimits{});
      const double length = norm(in_a);
      Answer answer;
      if (spheres_suffice(pair, vec(in_a), length, question.asked(), answer)) return answer;
      const bool serves = has_direction(seed) && question.asked().allows(length, shortened(in_a, in_b, seed));
      if (serves && level_a.map_side > 0 && level_b.map_side > 0) {
        const PairView view = pair_view(level_a.view, level_b.view, m, shift_of(m), quality.error);
        const AxisSample seen = sample_axis(view, Moved4(view), level_a, level_b, vec4(std::as_const(seed).normal.data()));
        const double upper = upper_of(view, level_a.deviation + level_b.deviation * stretch_of(quality.error), seen);
        if (question.asked().narrow(max(0, seen.lower), upper)) {
          take_sample({on_a, on_b, {}}, seen, upper, answer);
          answer.status = Status::Converged;
          return answer;
        }
      }
      return go_on(Turn::Some, nullptr);
    }
  }
  const bool has_choice = has_other_start(Shape(a), Shape(b), on_a, on_b);
  const Turn turn = has_choice ? turn_of(in_a, in_b, seed, level_a, level_b, Warm::Near) : Turn::Some;
  if (turn == Turn::Far) return go_on(turn, nullptr);
  if (!names_feature(level_a, fa) || !names_feature(level_b, fb)) {
    const bool cold = fa.kind() == FeatureKind::None;
    return cold ? go_on(Turn::Some, nullptr) : distance_anew(a, b, b_in_a, seed, question);
  }

  PairView view = pair_view(level_a.view, level_b.view, m, shift_of(m), quality.error);
  Ending seen;
  Marcher march(view, seen);
  const Move move = state(march, Resting4(view), fa, Moved4(view), fb);
  std::uint32_t steps = 0, plane_tests = march.plane_tests();
  if (march.ended() != WalkEnd::Minimum) [[unlikely]] {
    if constexpr (Question::is_loose) {
      // Half as much is left to a sample as to a cold start, as a walk of a few states is the alternative.
      const LooseDistance half{question.absolute / 2, question.relative / 2};
      const double doubt = a.level(0).map_doubt + b.level(0).map_doubt;
      if (half.asked().allows(norm(in_a), doubt)) {
        Answer answer;
        if (sampled_distance(a, b, m, quality.error, line(), seed, question, half, answer)) {
          answer.plane_tests = plane_tests;
          return answer;
        }
      }
    }
    const PairView same = view;
    const Walk walk = walked_on(same, move, march.ended(), plane_tests, has_choice ? kTrialSteps : ~0u);
    if (walk.end != WalkEnd::Minimum) return go_on(turn, &walk);
    seen = loaded(walk.nearest);
    fa = walk.a, fb = walk.b, steps = walk.steps, plane_tests = walk.plane_tests;
  }
  ProofOf<Vec4> proof;
  // Where this proves bounds, `lower` is farther from 0 than they are from each other: no verdict is in doubt.
  bool is_proved = certify(view, seen, proof) == Doubt::None;
  if constexpr (Question::is_loose) {
    const double error = level_a.deviation + level_b.deviation * stretch_of(quality.error);
    if (error > 0) proof.upper = (proof.upper + error) * (1 + 2 * kU);
    is_proved = is_proved && (error == 0 || question.asked().narrow(proof.lower, proof.upper));
  }
  if (!is_proved) [[unlikely]] {
    // The last state once more, so that not all of it is kept.
    const PairView same = view;
    Walk walk = walked<false>(same, fa, fb, 1);
    walk.steps = steps, walk.plane_tests = plane_tests;
    return go_on(turn, &walk);
  }
  seed.a = fa, seed.b = fb;
  turn == Turn::Little ? remember(proof.normal, seed) : remember(in_a, in_b, proof.normal, seed);
  return {.status = Status::Converged,
          .verdict = Verdict::Disjoint,
          .levels_visited = 1,
          .level_a = std::int16_t(on_a),
          .level_b = std::int16_t(on_b),
          .feature_a = fa,
          .feature_b = fb,
          .steps = steps,
          .plane_tests = plane_tests,
          .lower = proof.lower,
          .upper = proof.upper,
          .normal = eigen(vec(proof.normal)),
          .point_a = eigen(vec(seen.point_a)),
          .point_b = eigen(vec(seen.point_b))};
}

/// As `ask_intersection`.
[[gnu::always_inline]] static inline Answer answered_intersection(const Model& a, const Model& b, const Pose& b_in_a,
                                                                  PairSeed& seed) {
  Answer answer;
  answer_question(a, b, b_in_a, seed, AnyOverlap{}, answer);
  decide(answer);
  return answer;
}
/// As `ask_models`.
[[gnu::always_inline]] static inline void answer_models(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                                                        const StopRule& asked, Answer& answer) {
  // No distance is less than a `below` of 0.
  const bool exact = !(asked.absolute > 0 || asked.relative > 0) && !asked.is_threshold() && asked.below <= 0;
  if (exact) return void(answer = ask_distance(a, b, b_in_a, seed));
  answer_question(a, b, b_in_a, seed, AnyQuestion{asked}, answer);
}

}  // namespace swiftlet
