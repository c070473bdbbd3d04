// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The separating-axis test along the last answer's direction, then the line of centres: most questions of yes or no end there.
#pragma once

#include "pair/support_gjk.h"
#include "query/model_pair.h"
#include "query/target.h"

namespace swiftlet {

/// What the test sampled, for the descent that follows where it does not answer.
struct AxisTest {
  Place at;
  AxisSample seen;  ///< its normal is 0: nothing was sampled
};

/// Fills `answer` and returns true where the bodies are proved to be farther apart than `target` asks. A direction of the seed
/// that the line of centres makes superfluous is forgotten.
bool separating_axis(const ModelPair& pair, const Target& target, PairSeed& seed, AxisTest& first, Answer& answer);

}  // namespace swiftlet
