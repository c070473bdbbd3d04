// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The descent through levels of detail [Ehmann & Lin 2000, sec. 5.2]. Knows the hulls of two bodies and their levels.
#pragma once

#include <swiftlet/query.h>

#include "body/shape.h"
#include "numeric/vec.h"
#include "query/target.h"

namespace swiftlet {

/// Answers `target` for the hulls of two bodies in a legal pose: from `seed` and a default `answer`, or if `goes_on` from what
/// `answer` holds. An unknown normal becomes 0. `proof` must be empty, and is filled if the levels of the answer overlap.
void descend(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error, PairSeed& seed, const Limits& limits,
             const Target& target, bool goes_on, Answer& answer, OverlapProof& proof);

}  // namespace swiftlet
