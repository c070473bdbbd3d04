// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The descent through levels of detail [Ehmann & Lin 2000, sec. 5.2]. Knows the hulls of two bodies and their levels.
#pragma once

#include <optional>

#include <swiftlet/query.h>

#include "body/shape.h"
#include "numeric/vec.h"
#include "pair/stop_rule.h"
#include "query/limits.h"

namespace swiftlet {

/// Answers `asked` for the hulls of two bodies in a legal pose, from `seed` and a default `answer`; or, if `exact_width` is
/// given, goes on from what `answer` holds, which is exact if it is no wider than that or law 2's bound. Thresholds are passed
/// by more than law 2's bound. An unknown normal becomes 0. `proof` must be empty, and is filled if the levels of the answer
/// overlap.
void descend(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error, PairSeed& seed, const Limits& limits,
             const StopRule& asked, std::optional<double> exact_width, Answer& answer, OverlapProof& proof);

}  // namespace swiftlet
