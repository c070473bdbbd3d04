// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Turns any two feature ids into a start that a walk on one level pair can take. Knows no levels.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>

#include "body/half_edge.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// `settled` of a start that is not legal.
MarchStart made_legal(const PairView& pair, const MarchStart& start, std::uint32_t& plane_tests);
/// True if `a` and `b` name features of their views, not both faces.
static inline bool is_legal_start(const PairView& pair, FeatureId a, FeatureId b) {
  const bool faces = a.kind() == FeatureKind::Face && b.kind() == FeatureKind::Face;
  return names_feature(pair.a, a) && names_feature(pair.b, b) && !faces;
}
/// `start` made legal: an id that names no feature of its view becomes the support vertex along the line of centres; of two
/// faces, that of B becomes one of its vertices. `plane_tests` grows by the tests of the support climbs.
static inline MarchStart settled(const PairView& pair, const MarchStart& start, std::uint32_t& plane_tests) {
  return is_legal_start(pair, start.a, start.b) ? start : made_legal(pair, start, plane_tests);
}

}  // namespace swiftlet
