// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/march.h>

#include <algorithm>

#include "conclude.h"
#include "ring.h"
#include "seed.h"

namespace swiftlet {

MarchResult march(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, const MarchStart& start,
                  const MarchRule& rule) {
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) {
    MarchResult invalid;
    invalid.status = MarchStatus::InvalidPose;
    return invalid;
  }
  const Scene pair = scene(a, b, m, quality.error);
  std::uint32_t climbs = 0;
  const MarchStart from = settled(pair, start, climbs);
  MarchResult result = conclude(pair, walk(pair, from.a, from.b, rule.plane_rule, rule.step_budget), rule);
  result.plane_tests += climbs;
  result.lower = std::max(result.lower, rule.floor);
  result.upper = std::max(result.upper, result.lower);
  return result;
}

std::uint8_t tag(const ConvexView& view, Handle feature) {
  if (view.tags.empty()) return 0;
  const auto of_half_edge = [&](std::uint32_t h) { return view.face[h] == kNone ? std::uint8_t{0} : view.tags[view.face[h]]; };
  switch (feature.kind()) {
    case FeatureKind::Face: return view.tags[feature.index()];
    case FeatureKind::Edge: return std::max(of_half_edge(feature.index()), of_half_edge(view.twin[feature.index()]));
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
