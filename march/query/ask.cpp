// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about distance with the registers that every processor of the target has, and the choice between these and
// ask_avx2.cpp.
#include "query/ask.h"

#include "numeric/width.h"
#include "query/recall.h"

namespace swiftlet {

void ask(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const StopRule& asked,
         Answer& answer) {
#if SWIFTLET_BY_FOUR
  if (by_four()) return ask_by_four(a, b, b_in_a, seed, limits, asked, answer);
#endif
  answer_bodies(a, b, b_in_a, seed, limits, asked, answer);
}

void ask_hulls(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer, OverlapProof& proof) {
#if SWIFTLET_BY_FOUR
  if (by_four()) return ask_hulls_by_four(pair, asked, seed, answer, proof);
#endif
  answer_hulls(pair, asked, seed, answer, proof);
}

}  // namespace swiftlet
