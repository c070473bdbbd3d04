// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/march.h>

#include <algorithm>

#include "body/half_edge.h"
#include "pair/certify.h"
#include "pair/conclude.h"
#include "pair/intersection.h"
#include "pair/start.h"
#include "pair/witness.h"

namespace swiftlet {
namespace {

MarchResult settled_result(const Walk& walked, const Proof& proof, const MarchRule& rule) {
  MarchResult r;
  r.status = proof.lower > rule.beyond ? MarchStatus::Beyond : MarchStatus::Disjoint;
  r.a = walked.a, r.b = walked.b;
  r.lower = proof.lower, r.upper = proof.upper;
  r.normal = eigen(proof.normal);
  r.point_a = eigen(walked.nearest.point_a), r.point_b = eigen(walked.nearest.point_b);
  r.steps = walked.steps, r.plane_tests = walked.plane_tests;
  return r;
}

/// Proves bounds from the end of a walk. If the budget ended the walk no nearer than it began, certified GJK goes on, so that
/// marches which start from one another's features do not cycle.
MarchResult concluded(const PairView& pair, const MarchStart& from, Walk walked, const MarchRule& rule) {
  Proof proof;
  const Doubt doubt = rule.careful ? Doubt::Asked : settle(pair, walked, 0, rule.beyond, walked.plane_tests, proof);
  if (doubt == Doubt::None) return settled_result(walked, proof, rule);
  MarchResult r = conclude<Until::Exact>(pair, walked, rule);
  std::uint32_t tests = 0;
  if (r.status == MarchStatus::Budget && !(r.upper < certify(pair, witness(pair, from.a, from.b), tests).upper)) {
    walked.end = WalkEnd::Stalled;
    r = conclude<Until::Exact>(pair, walked, rule);
  }
  r.doubt = doubt;
  return r;
}

/// Moves features and points of an overlap from where the proof was found to where the surfaces cross.
void cross(const PairView& pair, MarchResult& r) {
  const Intersection where = intersection(pair, r.proof, r.plane_tests);
  r.a = where.a;
  r.b = where.b;
  r.point_a = r.point_b = eigen(where.point);
}

}  // namespace

MarchResult march(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, const MarchStart& start,
                  const MarchRule& rule) {
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) {
    MarchResult invalid;
    invalid.status = MarchStatus::InvalidPose;
    return invalid;
  }
  const PairView pair = pair_view(a, b, m, quality.error);
  std::uint32_t climbs = 0;
  const MarchStart from = settled(pair, start, climbs);
  MarchResult result = concluded(pair, from, walk(pair, from.a, from.b, rule.plane_rule, rule.step_budget), rule);
  if (result.status == MarchStatus::Overlapping) cross(pair, result);
  result.plane_tests += climbs;
  result.lower = std::max(result.lower, rule.floor);
  result.upper = std::max(result.upper, result.lower);
  return result;
}

std::uint8_t tag(const ConvexView& view, FeatureId feature) {
  if (view.tags.empty()) return 0;
  const auto of_half_edge = [&](std::uint32_t h) {
    return view.half_edges[h].face == kNone ? std::uint8_t{0} : view.tags[view.half_edges[h].face];
  };
  switch (feature.kind()) {
    case FeatureKind::Face: return view.tags[feature.index()];
    case FeatureKind::Edge: return std::max(of_half_edge(feature.index()), of_half_edge(view.half_edges[feature.index()].twin));
    case FeatureKind::Vertex: {
      const Vertex& ring = view.vertices[feature.index()];
      std::uint8_t largest = 0;
      for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h)
        largest = std::max(largest, of_half_edge(h));
      return largest;
    }
    default: return 0;
  }
}

}  // namespace swiftlet
