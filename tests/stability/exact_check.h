// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Is an answer true? Decided in exact arithmetic over all points of both bodies; shares nothing with march, neither
// predicate nor bound. Knows models and answers; not how they were asked for.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "oracle.h"

namespace swiftlet::stability {

/// A body as given and as built. Every vertex of level 0 is one of `points`, whose hull is the truth.
struct Subject {
  std::vector<Vec3> points;
  Model model;
  double extent;  ///< largest absolute coordinate of `points`
};
/// Throws std::logic_error where a vertex of level 0 is none of the points.
Subject make_subject(std::vector<Vec3> points, Model model);

/// One pair. What its answers claim, each claim proved or refuted; an explanation comes back, empty when all of them are true.
/// Cost: on bodies of 8 to 60 vertices about 0.1 ms an answer on level 0; coarser ones need `truth()` once.
class Judge {
 public:
  /// Both subjects outlive the judge.
  Judge(const Subject& a, const Subject& b, const Pose& b_in_a);

  /// Law 2's bound: (64 * 2^-53 + 2 |R^T R - I|) size, of the exact |R^T R - I|.
  double law_two() const { return law_two_; }

  /// Any answer to a legal pose. Law 1: `lower` <= the gap along `normal`, and `normal` a unit vector; `upper` >= the distance
  /// between the features named, or, where these do not show it or are coarse, >= the truth. The verdict: Disjoint has lower >
  /// 0; Overlapping four vertex pairs of level 0 whose differences hold the origin, those of `proof`; Touching an upper bound
  /// within law 2's, and a normal along which the bodies overlap by no more than that. The steps stay below law 7's bound. A
  /// signed answer: lower <= truth <= upper.
  std::string interval(const Answer& answer, const OverlapProof& proof = {});

  /// The answer to a query for the exact distance: `interval`, and it converged on level 0 with a verdict and is no wider than
  /// law 2 allows. Unless overlapping, its points lie within law 2's bound of the features named, are as far apart as the
  /// interval says, and differ by their distance times the normal as nearly as the interval implies. A signed one: `lower` at
  /// most the gap along the normal, `upper` at least the truth: of bodies apart as in `interval`, of an overlap by every plane
  /// that bounds the Minkowski difference. The points lie within law 2's bound of the features named, of an overlap at least of
  /// both bodies, and differ by the signed distance times the normal.
  std::string exact(const Answer& answer, const OverlapProof& proof = {});

  /// A signed answer that ended on coarse levels: `interval`, and its status is Converged or LevelLimit. Its points lie within
  /// law 2's bound of the levels named, and are as far apart as the interval says, up to these levels' deviations.
  std::string coarse(const Answer& answer, const OverlapProof& proof = {});

  /// The answer to `intersects`: `interval`, and it converged with a verdict.
  std::string verdict(const Answer& answer, const OverlapProof& proof = {});

  /// The answer to `within`: `interval`; Yes and No are shown by the bounds; Undecided only within law 2 of the threshold.
  std::string decision(const Within& within, double threshold, const OverlapProof& proof = {});

  /// The manifold of an exact answer of these bodies: its normal; as many points as fit and are asked for, none farther apart
  /// than the margin and law 2's bound; each pair named, no two alike, one above the other, on the vertices and edges that it
  /// names, within law 2's bound in both bodies and below their surfaces by no more than the flatness; the first as deep as the
  /// answer says; in order around an area which is most of what both contact faces have in common, by exact clipping. Where the
  /// pair was at rest since `before`, points may lie beside their features by twice the flatness.
  std::string manifold(const Manifold& manifold, const Answer& answer, const ManifoldOptions& options,
                       const Manifold& before = {}) const;

  /// The distance by exact minimum norm, found at the first call; from then on every interval and verdict is held against it.
  const oracle::Truth& truth();
  bool has_truth() const { return has_truth_; }

 private:
  std::string too_high(const Answer& answer) const;
  std::string upper_bound(const Answer& answer);
  std::string proved_verdict(const Answer& answer, const OverlapProof& proof);
  std::string proved_overlap(const Answer& answer, const OverlapProof& proof) const;
  std::string witnesses(const Answer& answer);
  std::string signed_interval(const Answer& answer, const OverlapProof& proof);
  std::string signed_upper_bound(const Answer& answer, const OverlapProof& proof);
  std::string signed_exact(const Answer& answer);
  std::string area_of(const Manifold& manifold, const ManifoldOptions& options, double bound) const;
  bool within_law_two(const Vec3& p_a, std::span<const Vec3> points, const Pose& pose) const;

  const Subject &a_, &b_;
  Pose b_in_a_;
  double size_, law_two_;
  double least_depth_ = 0;  ///< what no plane was found to be nearer than
  bool has_truth_ = false;
  oracle::Truth truth_;
};

/// The vertices of a feature of a level.
std::vector<Vec3> vertices_of(const ConvexView& view, FeatureId feature);

}  // namespace swiftlet::stability
