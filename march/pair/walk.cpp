// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The walk, compiled for the registers of this file's flags: see width.h.
#include "pair/walk.h"

#include "pair/marcher.h"

namespace swiftlet {

Walk SWIFTLET_OF_WIDTH(walk)(const PairView& pair, FeatureId a, FeatureId b, PlaneRule rule, std::uint32_t step_budget,
                             double enough2) {
  return walked_by(rule, pair, a, b, step_budget, enough2);
}

}  // namespace swiftlet
