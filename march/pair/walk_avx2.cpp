// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk with registers of four doubles, compiled for AVX2: see width.h.
#include "pair/walk.h"

#if SWIFTLET_BY_FOUR
#include "pair/marcher.h"

namespace swiftlet {

Walk walk_by_four(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return walked(pair, a, b, rule, step_budget);
}

}  // namespace swiftlet
#endif
