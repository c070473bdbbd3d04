// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plain.h"

#include "geometry.h"
#include "walk.h"

namespace swiftlet::yardstick {

PlainResult plain(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, PlainSeed& seed, PlaneRule rule) {
  const Motion m = motion(b_in_a);
  const FeatureId first{FeatureKind::Vertex, 0};
  const Walk walked =
      walk(pair_of(a, b, m, 0), seed.a == FeatureId{} ? first : seed.a, seed.b == FeatureId{} ? first : seed.b, rule);
  const bool inside = walked.end == WalkEnd::Inside, stalled = walked.end == WalkEnd::Stalled;
  const auto start = [&](FeatureId h) { return h.kind() == FeatureKind::Face && inside ? first : h; };
  seed = {start(walked.a), start(walked.b)};
  return {inside ? 0 : walked.distance, inside, stalled, walked.steps, walked.plane_tests};
}

PlainSeed table_start(const Model& a, const Model& b, const Pose& b_in_a) {
  const Motion m = motion(b_in_a);
  const Vec line = apply(m, vec(b.centre())) - vec(a.centre()), back = -turn_back(m, line);
  const auto look_up = [](const Model& model, const Vec& d) {
    return FeatureId{FeatureKind::Vertex, model.table()[lut::nearest(model.table_spec().resolution, {d.x, d.y, d.z})]};
  };
  return {look_up(a, line), look_up(b, back)};
}

}  // namespace swiftlet::yardstick
