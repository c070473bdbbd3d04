// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers a question about distance: see recall.h. Compiled once for each width of registers.
#pragma once

#include <swiftlet/query.h>

#include "pair/stop_rule.h"
#include "query/limits.h"
#include "query/model_pair.h"

namespace swiftlet {

/// Answers `asked` for two bodies. `answer` must be a default one.
void ask(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const StopRule& asked,
         Answer& answer);

/// Answers `asked` for the hulls of two bodies. Thresholds are passed by more than law 2's bound. An unknown normal becomes 0.
/// `proof` must be empty, and is filled if the levels of the answer overlap.
void ask_hulls(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer, OverlapProof& proof);

/// The same by registers of four doubles: see width.h.
void ask_by_four(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const StopRule& asked,
                 Answer& answer);
void ask_hulls_by_four(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer, OverlapProof& proof);

}  // namespace swiftlet
