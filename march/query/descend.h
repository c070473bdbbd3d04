// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The descent through levels of detail [Ehmann & Lin 2000, sec. 5.2]. Knows the hulls of two bodies and their levels.
#pragma once

#include <swiftlet/query.h>

#include "pair/stop_rule.h"
#include "pair/support_gjk.h"
#include "pair/walk.h"
#include "query/model_pair.h"
#include "query/seed.h"

namespace swiftlet {

/// What a query has found out before it descends.
struct Beginning {
  AxisSample seen;  ///< on the pair where a search of the maps would begin; its normal is 0 if nothing was sampled
  const SupportGjk* on_maps = nullptr;  ///< where the search of the first place's maps ended
  const Walk* walk = nullptr;           ///< a walk on the first place that did not answer, counted already
  bool exact = false;                   ///< as `is_exact`
};
/// Answers `asked` for the hulls of two bodies: begins at the features of `place`, or, if it has none, on the maps or on the
/// coarsest pair. Thresholds are passed by more than law 2's bound. `answer` must be a default one with normal 0; an unknown
/// normal stays 0. `proof` must be empty, and is filled if the levels of the answer overlap. `line` is the pair's.
void descend(const ModelPair& pair, const Line& line, const StopRule& asked, const Beginning& from, const Place& place,
             PairSeed& seed, Answer& answer, OverlapProof& proof);

/// The same, but goes on from what `answer` holds, which is exact if it is no wider than `exact_width` or law 2's bound.
void go_on(const ModelPair& pair, const StopRule& asked, double exact_width, PairSeed& seed, Answer& answer,
           OverlapProof& proof);

/// True if nothing but a walk on the finest pair is likely to bound the distance as narrowly as asked, so that the query begins
/// there again. `between` leads from A's centre to B's.
template <class Pair>
static inline bool is_exact(const Pair& pair, const Vec& between, const StopRule& asked) {
  const StartPolicy start = pair.limits.tuning.start;
  if (asked.is_exact() || asked.is_threshold() || start != StartPolicy::Automatic)
    return asked.is_exact() && start != StartPolicy::Paper;
  const double length = norm(between), allowed = asked.allowed(length);
  return allowed < pair.least_error() || pair.is_near(length, allowed);
}

/// The squared distance of features of the level pair `place` that is enough where the bodies are at least `lower` apart, or 0
/// apart if that is negative; negative if none is. Without a bound and its direction `lower` is minus infinity, and none is.
template <class Pair>
[[gnu::always_inline]] static inline double enough2_of(const Pair& pair, const Place& place, const StopRule& asked,
                                                       double lower) {
  if (!asked.is_loose() || !(lower > -kInfinity)) return -1;
  const double least = max(0, lower), allowed = asked.allowed(least),
               most = (least + allowed - pair.deviation(place.level_a, place.level_b)) * (1 - 8 * kU) - 2 * pair.law_two();
  return allowed > 0 && most > least && has_range(most * most) ? most * most : -1;
}

/// The ancestors of the features at `found`, on the coarsest level pair that would have answered as well.
Place coarsened(const ModelPair& pair, const StopRule& asked, const Answer& answer, Place found);
/// Stores in `seed` where the next query begins: at the features `found`, or on a coarser pair that would have answered as
/// well.
template <class Pair>
static inline void keep(const Pair& pair, const StopRule& asked, bool exact, const Answer& answer, const Place& found,
                        PairSeed& seed) {
  const Tuning& tuning = pair.limits.tuning;
  const bool stays = exact || tuning.start == StartPolicy::Finest || tuning.start == StartPolicy::Coarsest;
  const auto store = [&seed](const Place& kept) {
    seed.a = kept.start.a, seed.b = kept.start.b;
    seed.level_a = std::uint8_t(kept.level_a), seed.level_b = std::uint8_t(kept.level_b);
  };
  if (stays) return store(found);
  in_general(pair, [&](const ModelPair& general) { store(coarsened(general, asked, answer, found)); });
}

}  // namespace swiftlet
