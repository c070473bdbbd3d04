// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How near or how deep? One number from far apart to deep inside. All points and directions are in A's frame.
#pragma once

#include <limits>

#include <swiftlet/query.h>

namespace swiftlet {

/// What a query found of the signed distance of the two exact hulls: the distance where they are apart; where they overlap,
/// minus the depth, which is the length of the least translation that separates them (their interiors: they still touch then).
struct SignedAnswer {
  Status status = Status::NotConverged;  ///< how it ended
  /// What is proved. Overlapping: by `upper` < 0, which stands for a polytope inside the Minkowski difference that holds a ball
  /// of that radius, or by `proof`. Touching: the signed distance is within law 2's bound of 0, and so is the depth of bodies
  /// that share a plane, whichever way they lie in it.
  Verdict verdict = Verdict::Undecided;
  double lower = -std::numeric_limits<double>::infinity();  ///< proved bounds on the signed distance, the bodies' unit
  double upper = std::numeric_limits<double>::infinity();   ///< the other bound
  /// Unit, from A to B; 0 without one. `lower` is proved by the gap of the bodies in this direction, negative where they
  /// overlap: B moved along it by -lower is free.
  Vec3 normal = Vec3::Zero();
  Vec3 point_a = Vec3::Zero();               ///< the nearest point of A, or that deepest inside B, on the level below
  Vec3 point_b = Vec3::Zero();               ///< of B: point_b - point_a is the signed distance times the normal
  int level_a = 0, level_b = 0;              ///< the level pair they lie on
  Handle feature_a, feature_b;               ///< on those levels; of an overlap, a pair of the deepest
  OverlapProof proof;                        ///< Overlapping with `upper` = 0: vertices of level 0
  std::uint32_t steps = 0, plane_tests = 0;  ///< work: a support of both bodies or a change of feature is one step
};

/// The signed distance between `a` and `b`, where `b_in_a` maps B's frame into A's: exact by default, that is within law 2's
/// bound, or to the options' errors, of which `relative_error` is one of the bound nearer to 0. A body without thickness has no
/// depth along it: 0 where both share a plane.
/// Of bodies with radii it is the hulls' less both.
/// Of the options, `trace` is not read; `beyond`, `start`, `refinement` and `plane_rule` matter only while the bodies are
/// apart. Cost: apart that of `distance`; overlapping that of a walk to the local least and of some ten points that confirm it
/// where the overlap is shallow, a climb for each point of a polytope where it is deep, 5 to 30, all vertices of the Minkowski
/// difference at worst, where many facets are about as deep. Nothing is allocated.
/// Errors are statuses, and the interval is always true. Source: [van den Bergen 2001]; the proof is our own (march/README.md).
SignedAnswer signed_distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed,
                             const QueryOptions& options = {});

/// A decision and what it rests on.
struct SignedWithin {
  Decision decision = Decision::Undecided;  ///< Undecided only within law 2's bound of the threshold, or as the status says
  SignedAnswer answer;                      ///< as far as the decision needed
};

/// Is the signed distance at most `threshold`? Below 0: do they overlap by -threshold or more? Ends at the first level pair,
/// and with the first plane or polytope, that decides. The options' errors and `beyond` are not read.
SignedWithin signed_within(const Model& a, const Model& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                           const QueryOptions& options = {});

}  // namespace swiftlet
