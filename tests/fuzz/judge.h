// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers on good models, judged by certificate and oracle.
#pragma once

#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/patch.h>
#include <swiftlet/query.h>

#include "fuzz.h"
#include "oracle.h"

namespace swiftlet::fuzz {

/// A pose of any bits, or one near enough to rigid, or one that touches along an axis: the first byte says.
Pose take_pose(Bytes& bytes);
PairSeed take_seed(Bytes& bytes);
/// Any numbers, no radii.
PatchOptions take_patch_options(Bytes& bytes);
/// Any count and names.
Patch take_patch(Bytes& bytes);

/// Two models, a pose that is legal, and the truth.
class Judge {
 public:
  Judge(const Model& a, const Model& b, const Pose& b_in_a);

  /// What is wrong with an answer to any question; law 2 too where an exact one was asked for without a budget.
  std::string fault(const Answer& answer, bool exact) const;
  std::string fault(const Within& within, double threshold) const;
  /// With an exact signed distance of hulls.
  std::string fault(const SignedAnswer& answer) const;
  /// With its patch: points of both bodies, one above the other, the least as far apart as the answer says.
  std::string fault(const Patch& patch, const SignedAnswer& answer, const PatchOptions& options) const;
  const oracle::Truth& truth() const { return truth_; }

 private:
  const Model& a_;
  const Model& b_;
  const Pose& b_in_a_;
  oracle::Truth truth_;
  double law_two_;
};

/// Whether a query takes it.
bool is_legal(const Pose& pose);

}  // namespace swiftlet::fuzz
