// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk with registers of four doubles, compiled for AVX2: without FMA, which would round differently. It may define no
// symbol but `walk_by_four`, as the linker might take a function that it shares with other files for theirs, too, and these run
// on any processor. Without optimisation inline functions are such symbols, and this file is empty.
#if SWIFTLET_WALK_AVX2 && defined(__OPTIMIZE__)
#include "pair/marcher.h"

namespace swiftlet {

Walk walk_by_four(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return walked(pair, a, b, rule, step_budget);
}

}  // namespace swiftlet
#endif
