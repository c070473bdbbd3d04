// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The distance queries: each states when its bounds suffice and passes that to `ask`. Knows nothing of how `ask` answers.
#include <swiftlet/query.h>

#include "body/half_edge.h"
#include "body/shape.h"
#include "query/radii.h"

namespace swiftlet {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();  // no upper bound is this low

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

}  // namespace

double Answer::value() const {
  return std::isfinite(lower) && std::isfinite(upper) ? lower + (upper - lower) / 2 : std::numeric_limits<double>::quiet_NaN();
}

Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options) {
  Answer answer;
  ask(a, b, b_in_a, seed, {options.budget, options.tuning}, {options.absolute, options.relative, options.beyond, 0}, answer);
  return answer;
}
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options) {
  PairSeed cold;
  return distance(a, b, b_in_a, cold, options);
}

Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed, const Options& options) {
  Answer answer;
  ask(a, b, b_in_a, seed, {options.budget, options.tuning}, {options.absolute, options.relative, options.beyond, 0}, answer,
      &so_far);
  return answer;
}
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, const Options& options) {
  PairSeed cold;
  return refine(a, b, b_in_a, so_far, cold, options);
}

Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Effort& effort) {
  Answer answer;
  ask(a, b, b_in_a, seed, {effort.budget, effort.tuning}, {0, 0, 0, 0}, answer);
  decide(answer);
  return answer;
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
  ask(a, b, b_in_a, seed, {budget, options.tuning}, {0, 0, options.beyond, kNever}, result.answer);
  if (result.answer.level_a == 0) result.source_a = source_feature(a, result.answer.feature_a);
  if (result.answer.level_b == 0) result.source_b = source_feature(b, result.answer.feature_b);
  return result;
}
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, const ClosestOptions& options) {
  PairSeed cold;
  return closest_features(a, b, b_in_a, cold, options);
}

}  // namespace swiftlet
