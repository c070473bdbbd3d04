// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From level pair to finer level pair, until the question is answered [Ehmann & Lin 2000, sec. 5.2].
#pragma once

#include <swiftlet/query.h>

#include "body/shape.h"
#include "numeric/vec.h"
#include "query/target.h"

namespace swiftlet {

/// An answer about the hulls of two bodies in a legal pose, from the seed, or on from what `answer` holds; else it is a new
/// one. Its normal is 0 where none is known. `proof` is empty before, and filled where levels of the answer overlap.
void descend(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error, PairSeed& seed, const Limits& limits,
             const Target& target, bool goes_on, Answer& answer, OverlapProof& proof);

}  // namespace swiftlet
