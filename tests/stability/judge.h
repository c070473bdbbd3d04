// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What an answer has to be, given the exact truth: the laws as a judge reads them. Knows the oracle and the public structs;
// asks no query itself.
#pragma once

#include <string>

#include <swiftlet/depth.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "case.h"
#include "oracle.h"

namespace swiftlet::stability {

/// A case as a query gets it, and the truth.
struct Problem {
  Pose b_in_a;
  double size = 0;               ///< of law 2: largest coordinate of A and of B, plus |translation|
  double bound = 0;              ///< law 2's for this pose: how wide an exact interval may be
  double world_bound = 0;        ///< the same with the greatest orthonormality error of this pose and both world poses
  oracle::SignedTruth asked;     ///< of this pose: every proved claim must hold of it exactly
  oracle::SignedTruth in_world;  ///< of the world poses, which `relative` rounded: held within `world_bound`
};
Problem problem_of(const Case& c);

/// B first.
Case swapped(const Case& c);

enum class Fault {
  None,
  WrongVerdict,
  WrongDistance,  ///< an interval that lies or is wider than allowed, points or a normal that do not fit it
  WrongDepth,     ///< likewise, of an overlap
  NoNumber,       ///< NaN, or no interval at all
  NotConverged,   ///< any status but Converged: no budget, limit or illegal pose was asked for
};

struct Judgement {
  Fault fault = Fault::None;
  std::string message;  ///< empty without a fault
};

/// An answer, and the proof that an overlap rests on, of `distance` or `closest_features` without tolerance.
Judgement judge_exact(const Problem& problem, const Model& a, const Model& b, const Answer& answer, const OverlapProof& proof);
/// Of `signed_distance` without tolerance.
Judgement judge_signed(const Problem& problem, const Model& a, const Model& b, const Answer& answer, const OverlapProof& proof);
/// Of `intersects`: the interval may be wide.
Judgement judge_intersects(const Problem& problem, const Model& a, const Model& b, const Answer& answer,
                           const OverlapProof& proof);
Judgement judge_within(const Problem& problem, const Model& a, const Model& b, double threshold, const Within& within,
                       const OverlapProof& proof);

/// The interval's farther end from the distance in the world. Length.
double error_of(const Problem& problem, const Answer& answer);

}  // namespace swiftlet::stability
