// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks a generated pair everything, has every answer judged, or some of them and the others held against each other, and
// counts. Knows queries and the judge; not how pairs are made.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include "case.h"
#include "exact_check.h"
#include "shapes.h"

namespace swiftlet::stability {

/// What was seen of a family.
struct Tally {
  std::uint64_t pairs = 0;                  ///< bodies and pose, however often asked
  std::uint64_t judged = 0;                 ///< of these, those whose answers were judged
  std::uint64_t answers = 0;                ///< of all queries
  std::uint64_t solved = 0;                 ///< pairs whose distance was also found exactly
  std::uint64_t trials = 0, hits = 0;       ///< of what the family is made for
  std::array<std::uint64_t, 4> verdicts{};  ///< of answers, by Verdict
  std::uint64_t failed = 0;                 ///< answers, or relations between them, that are wrong
  std::uint32_t steps = 0;                  ///< most of one answer
  std::uint64_t depths = 0;                 ///< of answers, those of an overlap with its depth
  std::uint32_t supports = 0;               ///< most steps of one of these
  std::uint64_t manifolds = 0;              ///< judged
  double widest = 0;                        ///< exact interval, in units of law 2's bound, of a touching depth twice that
  std::array<std::uint64_t, 6> doubts{};    ///< of exact distances of bodies that do not overlap, by Doubt
  std::uint64_t hash = 0;                   ///< of all bits of all answers, in order

  double hit_rate() const { return trials ? double(hits) / double(trials) : 0; }
  Tally& operator+=(const Tally& other);  ///< the hash becomes that of both, in any order
};

/// What one batch of a family sees and finds wrong.
class Examiner {
 public:
  /// `label` names the batch in the cases of failures. The same seed gives the same batch. `judge_every`: Pair::ask.
  Examiner(std::string family, std::string label, std::uint64_t seed, std::uint64_t judge_every = 1)
      : random(seed),
        manifold_options_(~seed),
        judge_every_(judge_every),
        family_(std::move(family)),
        label_(std::move(label)) {}

  void hit(bool is_hit) { ++tally.trials, tally.hits += is_hit; }
  void count(const Answer& answer);  ///< in the tally

  shapes::Random random;
  Tally tally;
  std::vector<Case> failures;       ///< the pairs that failed, once each, with what was wrong; at most 8
  std::vector<std::string> faults;  ///< what was wrong with pairs of meshes, which no Case holds, and these

 private:
  friend class Pair;
  shapes::Random manifold_options_;  ///< apart, so that the pairs do not depend on it
  Manifold manifold_;                ///< the latest, of whatever pair
  std::uint64_t judge_every_;
  std::string family_, label_;
};

/// One generated pair under examination. Of those that are judged every 24th is solved exactly before it is asked.
class Pair {
 public:
  /// The subjects outlive it.
  Pair(Examiner& examiner, const Subject& a, const Subject& b, const Pose& b_in_a);
  ~Pair();
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  /// The distance from `seed`; then `intersects`, `within` at a threshold near the truth, and the signed distance, which must
  /// agree, from copies of it. `seed` moves on to what the distance or the signed distance left, either as often. Every eighth
  /// time both from a cold start as well, which must agree. Pairs that the examiner does not judge: `compare`.
  Answer ask(PairSeed& seed);
  Answer ask() {
    PairSeed cold;
    return ask(cold);
  }
  /// Without exact arithmetic, at some microseconds: the distance and the signed distance converge within law 2, the latter to
  /// what is the gap along its normal, and agree, also from where they ended and with the bodies swapped. `seed` moves on as in
  /// `ask`. What else is asked of this pair is not judged either.
  Answer compare(PairSeed& seed) { return compare(seed, examiner_.random.bits()); }
  /// The atomic kernel on level 0, from its own start: judged, and done within seconds.
  void march();
  /// The exact distance alone. `options` change the way, not what is asked.
  Answer exact(PairSeed& seed, const Options& options = {});
  /// The distance to whatever precision, budget or level.
  Answer loose(PairSeed& seed, const Options& options);

  /// The signed distance on coarse levels.
  Answer coarse_depth(PairSeed& seed, const Options& options);

  /// The exact signed distance, and again from where that ended.
  Answer exact_depth(PairSeed& seed);

  /// The exact distance and the march on level 0 once more, proved the careful way: the same verdict as `answer`, which is what
  /// the distance from `seed` gave, and as the march without care.
  void carefully(PairSeed seed, const Answer& answer);

  /// Of one in 32 exact answers, but of overlaps without depth, the manifold, as options of all kinds ask for it; from that of
  /// another pair, and again from itself, which must keep its points.
  void manifolds(const Answer& answer);

  /// Both are exact answers of this pair or of one with the same truth: the same verdict, intervals within law 2's bound.
  void agree(const Answer& one, const Answer& other, const char* what);
  void require(bool holds, const std::string& what);
  void solve() { judge_.truth(); }
  double law_two() const { return judge_.law_two(); }

 private:
  using Query = Answer (*)(const Body&, const Body&, const Pose&, PairSeed&, const Options&);
  using Judgement = std::string (Judge::*)(const Answer&, const OverlapProof&);
  Answer limited(Query query, Judgement judgement, const char* name, PairSeed& seed, const Options& options);
  Answer examine(PairSeed& seed, std::uint64_t choice);
  Answer compare(PairSeed& seed, std::uint64_t choice);
  void count(const Answer& answer) { examiner_.count(answer); }
  void count(const Manifold& manifold);
  /// Why the tests of the last walk did not prove `answer`. The query is asked again for it: a trace is more work.
  void count_doubt(PairSeed seed, Options options, const Answer& answer);
  void judged(const std::string& wrong, const char* query, const PairSeed& seed);

  Examiner& examiner_;
  const Subject &a_, &b_;
  Pose b_in_a_;
  Judge judge_;
  bool is_judged_;  ///< all its answers
  bool has_failed_ = false;
};

}  // namespace swiftlet::stability
