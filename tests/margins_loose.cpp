// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The kernel's walk a second time, named `loose_walk`, with no margin for the rounding of its tests.
#include "pair/pair_view.h"

namespace swiftlet {
constexpr double kNoError = 0;
}
#define kScanError kNoError
#define kBesideError kNoError
#define kAcrossError kNoError
#define kFlatError kNoError
#define kFootError kNoError
#include "pair/marcher.h"

namespace swiftlet {

Walk loose_walk(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget) {
  return walked_by(rule, pair, a, b, step_budget, -1);
}

}  // namespace swiftlet
