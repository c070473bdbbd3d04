// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk with the registers that every processor of the target has, and the choice between it and walk_avx2.cpp, made once.
#include "pair/walk.h"

#include "pair/marcher.h"

namespace swiftlet {

#if SWIFTLET_WALK_AVX2 && defined(__OPTIMIZE__)
namespace {
const bool has_four = __builtin_cpu_supports("avx2");
bool by_four = has_four;  // before it is set, walks are by two
}  // namespace

Walk walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return by_four ? walk_by_four(pair, a, b, rule, step_budget) : walked(pair, a, b, rule, step_budget);
}

bool set_width(Width width) {
  by_four = width == Width::Four && has_four;
  return by_four == (width == Width::Four);
}
#else
Walk walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return walked(pair, a, b, rule, step_budget);
}

bool set_width(Width width) { return width == Width::Two; }
#endif

}  // namespace swiftlet
