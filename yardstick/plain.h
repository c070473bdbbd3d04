// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Our own walk on level 0 without hierarchy, start table or certificate: what each of these costs and brings. Proves nothing.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::yardstick {

/// Default: cold, the first vertex of each.
struct PlainSeed {
  FeatureId a, b;
};

struct PlainResult {
  double distance = 0;   ///< between the features, rounded; 0 when inside
  bool inside = false;   ///< the walk ended inside: overlapping, or nearly
  bool stalled = false;  ///< no answer; the distance is the least seen
  std::uint32_t steps = 0, plane_tests = 0;
};

PlainResult plain(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, PlainSeed& seed,
                  PlaneRule rule = PlaneRule::MostViolated);

/// The paper's start: the vertices that the models' tables name for the line of centres [Ehmann & Lin 2000, sec. 4.6].
PlainSeed table_start(const Model& a, const Model& b, const Pose& b_in_a);

}  // namespace swiftlet::yardstick
