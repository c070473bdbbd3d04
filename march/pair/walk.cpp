// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk with the registers that every processor of the target has, and the choice between these and walk_avx2.cpp.
#include "pair/walk.h"

#include "numeric/width.h"
#include "pair/marcher.h"

namespace swiftlet {

Walk walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
#if SWIFTLET_BY_FOUR
  if (by_four()) return walk_by_four(pair, a, b, rule, step_budget);
#endif
  return walked(pair, a, b, rule, step_budget);
}

}  // namespace swiftlet
