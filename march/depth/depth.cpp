// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about the signed distance; their answers with registers that every processor of the target has: see width.h.
#include <swiftlet/depth.h>

#include "depth/deepening.h"

namespace swiftlet {

void signed_distance_by_two(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options,
                            Answer& answer) {
  answer_signed(a, b, b_in_a, seed, options, answer);
}

void signed_within_by_two(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                          const Effort& effort, Within& result) {
  answer_signed_within(a, b, b_in_a, threshold, seed, effort, result);
}

Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options) {
  Answer answer;
  SWIFTLET_BY_WIDTH(signed_distance, a, b, b_in_a, seed, options, answer);
  return answer;
}
Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options) {
  PairSeed cold;
  return signed_distance(a, b, b_in_a, cold, options);
}

Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed, const Effort& effort) {
  Within result;
  SWIFTLET_BY_WIDTH(signed_within, a, b, b_in_a, threshold, seed, effort, result);
  return result;
}
Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort) {
  PairSeed cold;
  return signed_within(a, b, b_in_a, threshold, cold, effort);
}

}  // namespace swiftlet
