// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The separating-axis test, along the last answer's normal, then along the line of centres. Each direction takes one look-up in
// the support map of each body. Most questions of yes or no end here.
#pragma once

#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "query/model_pair.h"

namespace swiftlet {

/// The last sample of the test. If the test does not answer, the descent begins with it.
struct AxisTest {
  Place at;
  AxisSample seen;  ///< on the levels of `at`; its normal is 0 if nothing was sampled
};

/// Fills `answer` and returns true if the bodies are proved to be farther apart than `asked.above`. If the line of centres
/// proves it and the seed's direction does not, that direction is cleared.
bool separating_axis(const ModelPair& pair, const StopRule& asked, PairSeed& seed, AxisTest& first, Answer& answer);

}  // namespace swiftlet
