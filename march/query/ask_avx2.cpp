// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about distance with registers of four doubles, compiled for AVX2: see width.h.
#include "query/ask.h"

#if SWIFTLET_BY_FOUR
#include "query/recall.h"

namespace swiftlet {

void ask_by_four(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const StopRule& asked,
                 Answer& answer) {
  answer_bodies(a, b, b_in_a, seed, limits, asked, answer);
}

void ask_models_by_four(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const StopRule& asked,
                        Answer& answer) {
  answer_models(a, b, b_in_a, seed, asked, answer);
}

void ask_hulls_by_four(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer, OverlapProof& proof) {
  answer_hulls(pair, asked, seed, answer, proof);
}

}  // namespace swiftlet
#endif
