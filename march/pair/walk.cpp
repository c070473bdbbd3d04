// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk with registers that every processor of the target has: see width.h.
#include "pair/walk.h"

#include "pair/marcher.h"

namespace swiftlet {

Walk walk_by_two(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return walked(pair, a, b, rule, step_budget);
}

}  // namespace swiftlet
