// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions about distance, compiled for the registers of this file's flags: see width.h.
#include "query/ask.h"

#include "query/recall.h"

namespace swiftlet {

void SWIFTLET_OF_WIDTH(ask)(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits,
                            const StopRule& asked, Answer& answer) {
  answer_bodies(a, b, b_in_a, seed, limits, asked, answer);
}
void SWIFTLET_OF_WIDTH(ask_models)(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const StopRule& asked,
                                   Answer& answer) {
  answer_models(a, b, b_in_a, seed, asked, answer);
}
Answer SWIFTLET_OF_WIDTH(ask_distance)(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed) {
  return recalled_distance(a, b, b_in_a, seed, ExactDistance{});
}
Answer SWIFTLET_OF_WIDTH(ask_loosely)(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, double absolute,
                                      double relative) {
  return recalled_distance(a, b, b_in_a, seed, LooseDistance{absolute, relative});
}
[[gnu::flatten]] Answer SWIFTLET_OF_WIDTH(ask_intersection)(const Model& a, const Model& b, const Pose& b_in_a,
                                                            PairSeed& seed) {
  return answered_intersection(a, b, b_in_a, seed);
}
void SWIFTLET_OF_WIDTH(ask_hulls)(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer,
                                  OverlapProof& proof) {
  answer_hulls(pair, asked, seed, answer, proof);
}

}  // namespace swiftlet
