// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Each query is one target.
#include <swiftlet/query.h>

#include "dilate.h"
#include "ring.h"

namespace swiftlet {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();  // no upper bound is this low

SourceFeature source_feature(const Model& model, Handle feature) {
  const SourceMap source = model.source();
  const ConvexView& view = model.level(0).view;
  SourceFeature result{feature.kind(), {kNone, kNone}, {}};
  const std::uint32_t i = feature.index();
  if (feature.kind() == FeatureKind::Vertex) result.vertices[0] = source.vertex[i];
  if (feature.kind() == FeatureKind::Edge) result.vertices = {source.vertex[origin(view, i)], source.vertex[view.head[i]]};
  if (feature.kind() == FeatureKind::Face) {
    result.triangles = source.face.subspan(source.face_begin[i], source.face_begin[i + 1] - source.face_begin[i]);
  }
  return result;
}

}  // namespace

Answer distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options) {
  return ask(a, b, b_in_a, seed, options, {options.absolute_error, options.relative_error, options.beyond, 0});
}

Answer refine(const Model& a, const Model& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed,
              const QueryOptions& options) {
  const Target target{options.absolute_error, options.relative_error, options.beyond, 0};
  return ask(a, b, b_in_a, seed, options, target, &so_far);
}

Answer intersects(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options) {
  Answer answer = ask(a, b, b_in_a, seed, options, {0, 0, 0, 0});
  if (answer.status == Status::Beyond) answer.status = Status::Converged;
  return answer;
}

Within within(const Model& a, const Model& b, const Pose& b_in_a, double threshold, PairSeed& seed,
              const QueryOptions& options) {
  Within result{Decision::Undecided, ask(a, b, b_in_a, seed, options, {0, 0, threshold, threshold})};
  if (result.answer.status == Status::Beyond) result.answer.status = Status::Converged;
  if (result.answer.lower > threshold) result.decision = Decision::No;
  if (result.answer.upper <= threshold) result.decision = Decision::Yes;
  return result;
}

Contact contact(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options) {
  QueryOptions exact = options;
  exact.absolute_error = exact.relative_error = 0;
  exact.finest_level = 0;
  Contact result{ask(a, b, b_in_a, seed, exact, {0, 0, options.beyond, kNever}), {}, {}};
  if (result.answer.level_a == 0) result.source_a = source_feature(a, result.answer.feature_a);
  if (result.answer.level_b == 0) result.source_b = source_feature(b, result.answer.feature_b);
  return result;
}

}  // namespace swiftlet
