// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers a question about distance: see recall.h.
#pragma once

#include <cstdint>

#include <double_bits.h>
#include <swiftlet/query.h>

#include "numeric/width.h"
#include "pair/stop_rule.h"
#include "query/limits.h"
#include "query/model_pair.h"

namespace swiftlet {

SWIFTLET_BOTH_WIDTHS(void, ask, const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits,
                     const StopRule& asked, Answer& answer);
SWIFTLET_BOTH_WIDTHS(void, ask_models, const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                     const StopRule& asked, Answer& answer);
SWIFTLET_BOTH_WIDTHS(Answer, ask_distance, const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed);
SWIFTLET_BOTH_WIDTHS(Answer, ask_loosely, const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, double absolute,
                     double relative);
SWIFTLET_BOTH_WIDTHS(Answer, ask_intersection, const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed);
/// True if both bodies are models without radii: most are. False for a radius of -0, with the same answers.
static inline bool are_models(const Body& a, const Body& b) {
  return a.model() && b.model() && (bit_cast<std::uint64_t>(a.radius()) | bit_cast<std::uint64_t>(b.radius())) == 0;
}
/// The exact distance of two models without limits.
static inline Answer ask_distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed) {
  return SWIFTLET_BY_WIDTH(ask_distance, a, b, b_in_a, seed);
}
/// The same within the error `absolute` or `relative`, of which one is positive.
static inline Answer ask_loosely(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, double absolute,
                                 double relative) {
  return SWIFTLET_BY_WIDTH(ask_loosely, a, b, b_in_a, seed, absolute, relative);
}
/// Whether two models meet, without limits.
static inline Answer ask_intersection(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed) {
  return SWIFTLET_BY_WIDTH(ask_intersection, a, b, b_in_a, seed);
}
/// Answers `asked` for two bodies. `answer` must be a default one. Most queries are about two models without radii and without
/// limits: `ask_models` is the same for these, sooner.
static inline void ask(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits,
                       const StopRule& asked, Answer& answer) {
  if (are_models(a, b) && limits_in(limits.budget, limits.tuning) == 0)
    SWIFTLET_BY_WIDTH(ask_models, *a.model(), *b.model(), b_in_a, seed, asked, answer);
  else
    SWIFTLET_BY_WIDTH(ask, a, b, b_in_a, seed, limits, asked, answer);
}

SWIFTLET_BOTH_WIDTHS(void, ask_hulls, const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer,
                     OverlapProof& proof);
/// Answers `asked` for the hulls of two bodies. Thresholds are passed by more than law 2's bound. An unknown normal becomes 0.
/// `proof` must be empty, and is filled if the levels of the answer overlap.
static inline void ask_hulls(const ModelPair& pair, const StopRule& asked, PairSeed& seed, Answer& answer,
                             OverlapProof& proof) {
  SWIFTLET_BY_WIDTH(ask_hulls, pair, asked, seed, answer, proof);
}

/// A feature of a body's level 0 by the user's ids.
SourceFeature source_feature(const Body& body, FeatureId feature);

}  // namespace swiftlet
