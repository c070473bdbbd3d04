// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers on good models, judged by certificate and oracle.
#pragma once

#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include "fuzz.h"
#include "oracle.h"

namespace swiftlet::fuzz {

/// A pose of any bits, or one near enough to rigid, or one that touches along an axis: the first byte says.
Pose take_pose(Bytes& bytes);
/// Any bits, field by field.
PairSeed take_seed(Bytes& bytes);
inline constexpr std::size_t kSeedBytes = 29;  ///< that make one
/// Any numbers.
ManifoldOptions take_manifold_options(Bytes& bytes);
/// Any count and names.
Manifold take_manifold(Bytes& bytes);

/// Two models, a pose that is legal, and the truth.
class Judge {
 public:
  /// `proof` is what the queries' Tuning::proof fills.
  Judge(const Model& a, const Model& b, const Pose& b_in_a, const OverlapProof& proof);

  /// What is wrong with an answer to any question; law 2 too where an exact one was asked for without a budget. The truth knows
  /// no depth: of an overlap's signed distance the oracle holds the sign and that the normal proves `lower`, the check the
  /// rest.
  std::string fault(const Answer& answer, bool exact) const;
  std::string fault(const Within& within, double threshold) const;
  /// With its manifold: points of both bodies, one above the other, the least as far apart as the answer says.
  std::string fault(const Manifold& manifold, const Answer& answer, const ManifoldOptions& options) const;
  const oracle::Truth& truth() const { return truth_; }

 private:
  const Model& a_;
  const Model& b_;
  const Pose& b_in_a_;
  const OverlapProof& proof_;
  std::vector<Vec3> points_a_, points_b_;
  oracle::Truth truth_;
  double law_two_;
};

/// Whether a query takes it.
bool is_legal(const Pose& pose);

}  // namespace swiftlet::fuzz
