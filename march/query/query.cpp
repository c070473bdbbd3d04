// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The distance queries: each states when its bounds suffice and passes that to `ask`.
#include <swiftlet/query.h>

#include "body/half_edge.h"
#include "body/shape.h"
#include "query/ask.h"
#include "query/descend.h"
#include "query/radii.h"

namespace swiftlet {
namespace {

/// What a distance's options ask for.
StopRule rule_of(const Options& options) {
  return {allowed_error(options.absolute), allowed_error(options.relative), options.beyond, 0};
}

/// Copies `so_far` to `answer` as an unsigned answer with `status` and no work of its own.
void restate(const Answer& so_far, Status status, Answer& answer) {
  answer = so_far;
  answer.status = status;
  answer.steps = answer.plane_tests = 0;
  answer.levels_visited = 0;
  answer.is_signed = false;
}

/// Answers `asked` like `ask`, but goes on from `so_far`, if that tells anything of the distance.
void ask_on(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const StopRule& asked,
            const Answer& so_far, Answer& answer) {
  if (so_far.status == Status::NotAsked) return ask(a, b, b_in_a, seed, limits, asked, answer);
  if (limits.tuning.proof) *limits.tuning.proof = {};
  const Setting at(a, b, b_in_a);
  const Radii& radii = at.radii;
  if (const Status fault = at.fault(); fault != Status::Converged) return refuse(a, b, fault, false, answer);
  if (Radii(so_far) != radii) return refuse(a, b, Status::InvalidRadius, false, answer);
  const bool overlaps = !so_far.is_signed && so_far.verdict == Verdict::Overlapping;
  const bool tells = (so_far.lower > 0 || !so_far.is_signed) && so_far.status < Status::InvalidPose,
             has_features = so_far.feature_a.kind() != FeatureKind::None;  // else balls or ellipsoids answered
  if (overlaps && limits.tuning.proof) {
    // The proof is found again, if the budget suffices.
    ask(a, b, b_in_a, seed, limits, asked, answer);
    if (answer.verdict == Verdict::Overlapping) return;
    *limits.tuning.proof = {};
  }
  if (overlaps) return restate(so_far, Status::Converged, answer);
  if (tells && !has_features && asked.met(so_far.lower, so_far.upper))
    return restate(so_far, so_far.lower > asked.above ? Status::Beyond : Status::Converged, answer);
  if (!tells || !has_features) {
    ask(a, b, b_in_a, seed, limits, asked, answer);
    return tells ? radii.keep_better(so_far, at.law_two(), answer) : void();
  }
  answer = radii.of_hulls(so_far);
  // An answer that is exact for the bodies counts as exact for the hulls, even if rounding with the radii widened it.
  const double law_two = at.law_two(), exact_width = so_far.upper - so_far.lower <= law_two ? answer.upper - answer.lower : 0;
  const ModelPair pair(*at.a, *at.b, at.motion, at.quality.error, limits);
  OverlapProof proof;
  go_on(pair, radii.none() ? asked : radii.of_hulls(asked, law_two), exact_width, seed, answer, proof);
  if (!radii.none()) {
    if (answer.levels_visited == 0) return restate(so_far, answer.status, answer);
    radii.round(answer, proof, law_two);
    radii.round(limits.trace, answer.levels_visited);
  }
  seal(radii, proof, limits.tuning, answer);
}

/// As `distance`, whatever is asked.
[[gnu::noinline]] Answer any_distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                      const Options& options) {
  Answer answer;
  ask(a, b, b_in_a, seed, {options.budget, options.tuning}, rule_of(options), answer);
  return answer;
}

/// As `intersects`, whatever limits it.
[[gnu::noinline]] Answer any_intersection(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                          const Effort& effort) {
  Answer answer;
  ask(a, b, b_in_a, seed, {effort.budget, effort.tuning}, {0, 0, 0, 0}, answer);
  decide(answer);
  return answer;
}

/// True if the finest maps of two models, which have all levels, are hardly ever as precise as `absolute`, as `is_exact` finds
/// without a relative error. An exact distance is answered sooner then.
bool is_finer_than_maps(const Model& a, const Model& b, double absolute) {
  const Level &of_a = a.level(0), &of_b = b.level(0);
  return absolute < of_a.map_doubt + of_b.map_doubt && of_a.map_side > 0 && of_b.map_side > 0 &&
         (a.finest_level() | b.finest_level()) == 0;
}

/// As `distance`, of two models without limits.
[[gnu::noinline]] Answer distance_within(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, double absolute,
                                         double relative) {
  absolute = allowed_error(absolute), relative = allowed_error(relative);
  const bool exact = !(relative > 0) && (!(absolute > 0) || is_finer_than_maps(a, b, absolute));
  return exact ? ask_distance(a, b, b_in_a, seed) : ask_loosely(a, b, b_in_a, seed, absolute, relative);
}

}  // namespace

SourceFeature source_feature(const Body& body, FeatureId feature) {
  SourceFeature result{feature.kind(), {kNone, kNone}, {}};
  const ShapeOf shape(body);
  const ConvexView& view = (*shape).level(0).view;
  const auto source = [&](std::uint32_t vertex) { return source_vertex(body, shape, vertex); };
  const std::uint32_t i = feature.index();
  if (feature.kind() == FeatureKind::Vertex) result.vertices[0] = source(i);
  if (feature.kind() == FeatureKind::Edge) result.vertices = {source(origin(view, i)), source(view.half_edges[i].head)};
  if (feature.kind() == FeatureKind::Face && body.model()) {
    const SourceMap map = body.model()->source();
    if (!map.face_begin.empty())
      result.triangles = map.face.subspan(map.face_begin[i], map.face_begin[i + 1] - map.face_begin[i]);
  }
  return result;
}

double Answer::value() const {
  return std::isfinite(lower) && std::isfinite(upper) ? lower + (upper - lower) / 2 : std::numeric_limits<double>::quiet_NaN();
}

Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options) {
  const auto bits = [](double x) { return bit_cast<std::uint64_t>(x); };
  const std::uint64_t limits = limits_in(options.budget, options.tuning) | (bits(options.beyond) ^ bits(kInfinity));
  if (limits != 0 || !are_models(a, b)) return any_distance(a, b, b_in_a, seed, options);
  if ((bits(options.absolute) | bits(options.relative)) == 0) return ask_distance(*a.model(), *b.model(), b_in_a, seed);
  return distance_within(*a.model(), *b.model(), b_in_a, seed, options.absolute, options.relative);
}
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
  return are_models(a, b) ? ask_distance(*a.model(), *b.model(), b_in_a, seed) : any_distance(a, b, b_in_a, seed, {});
}
Answer distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed) { return ask_distance(a, b, b_in_a, seed); }
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options) {
  PairSeed cold;
  return distance(a, b, b_in_a, cold, options);
}

Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed, const Options& options) {
  Answer answer;
  ask_on(a, b, b_in_a, seed, {options.budget, options.tuning}, rule_of(options), so_far, answer);
  return answer;
}
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, const Options& options) {
  PairSeed cold;
  return refine(a, b, b_in_a, so_far, cold, options);
}

Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Effort& effort) {
  if (limits_in(effort.budget, effort.tuning) == 0 && are_models(a, b))
    return ask_intersection(*a.model(), *b.model(), b_in_a, seed);
  return any_intersection(a, b, b_in_a, seed, effort);
}
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed) {
  return are_models(a, b) ? ask_intersection(*a.model(), *b.model(), b_in_a, seed) : any_intersection(a, b, b_in_a, seed, {});
}
Answer intersects(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed) {
  return ask_intersection(a, b, b_in_a, seed);
}
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, const Effort& effort) {
  PairSeed cold;
  return intersects(a, b, b_in_a, cold, effort);
}

Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed, const Effort& effort) {
  Within result;
  ask(a, b, b_in_a, seed, {effort.budget, effort.tuning}, {0, 0, threshold, threshold}, result.answer);
  decide(result, threshold);
  return result;
}
Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort) {
  PairSeed cold;
  return within(a, b, b_in_a, threshold, cold, effort);
}

ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                 const ClosestOptions& options) {
  const Budget budget{options.steps, 0};
  ClosestFeatures result;
  ask(a, b, b_in_a, seed, {budget, options.tuning}, {0, 0, options.beyond}, result.answer);
  if (result.answer.level_a == 0) result.source_a = source_feature(a, result.answer.feature_a);
  if (result.answer.level_b == 0) result.source_b = source_feature(b, result.answer.feature_b);
  return result;
}
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, const ClosestOptions& options) {
  PairSeed cold;
  return closest_features(a, b, b_in_a, cold, options);
}

}  // namespace swiftlet
