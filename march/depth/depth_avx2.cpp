// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers about the signed distance with registers of four doubles, compiled for AVX2: see width.h.
#include "numeric/width.h"

#if SWIFTLET_BY_FOUR
#include "depth/deepening.h"

namespace swiftlet {

void signed_distance_by_four(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options,
                             Answer& answer) {
  answer_signed(a, b, b_in_a, seed, options, answer);
}

void signed_within_by_four(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                           const Effort& effort, Within& result) {
  answer_signed_within(a, b, b_in_a, threshold, seed, effort, result);
}

}  // namespace swiftlet
#endif
