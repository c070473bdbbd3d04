// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rounded bodies: all that lies within a radius of a hull. What is asked of bodies becomes a question of their hulls, and the
// hulls' answer becomes theirs. The only place that knows radii, but for checks. Knows nothing of the way between.
#pragma once

#include <swiftlet/query.h>

#include "body/shape.h"
#include "numeric/vec.h"
#include "pair/pair_view.h"
#include "query/descend.h"

namespace swiftlet {

static inline bool is_radius(double value) { return value >= 0 && value <= kMostCoordinate; }

/// The radii of two bodies. Where both are 0, all that it makes of questions and answers is themselves.
class Radii {
 public:
  Radii(const Body& a, const Body& b) : a_(a.radius()), b_(b.radius()) {}
  explicit Radii(const Answer& answer) : a_(answer.radius_a), b_(answer.radius_b) {}

  /// Else nothing else is asked of it.
  bool legal() const { return is_radius(a_) && is_radius(b_); }
  bool none() const { return a_ + b_ == 0; }
  double sum() const { return a_ + b_; }
  double a() const { return a_; }
  double b() const { return b_; }
  bool operator==(const Radii&) const = default;
  /// Of the bodies.
  double law_two(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error) const;

  /// The question as one of the hulls. Law 2's bound, of the bodies, is more than the bounds are rounded by.
  Target of_hulls(const Target& of, double law_two) const;
  /// An answer about the bodies, as it was of the hulls, as far as it tells.
  Answer of_hulls(Answer of) const;

  /// The hulls' distance as the bodies'; `proof` is forgotten where it proves nothing of these.
  void round(Answer& answer, OverlapProof& proof, double law_two) const;
  /// The hulls' signed distance as the bodies'.
  void round_signed(Answer& answer, OverlapProof& proof, double law_two) const;
  /// The same of a trace's first `visited` records, as far as there was room for them.
  void round(std::span<LevelRecord> trace, int visited) const;
  void round_signed(std::span<LevelRecord> trace, int visited) const;

 private:
  Radii(double a, double b) : a_(a), b_(b) {}
  /// bound - a - b, at most a place off, to the side that is named.
  double less(double bound, double side) const;
  double more(double bound, double side) const;
  /// The hulls' bounds as the bodies', below 0 where these overlap.
  double lower(double of_hulls) const;
  double upper(double of_hulls) const;
  void move_points(Answer& answer) const;

  double a_, b_;
};

/// What every query asks first: whether bodies and pose are legal, and their shapes.
class Setting {
 public:
  Setting(const Body& of_a, const Body& of_b, const Pose& b_in_a)
      : a(of_a), b(of_b), motion(swiftlet::motion(b_in_a)), quality(pose_quality(motion)), radii(of_a, of_b) {}
  /// Converged where nothing is wrong.
  Status fault() const {
    if (!quality.legal) return Status::InvalidPose;
    if (!radii.legal()) return Status::InvalidRadius;
    return a.is_legal() && b.is_legal() ? Status::Converged : Status::InvalidBody;
  }
  double law_two() const { return radii.law_two(*a, *b, motion, quality.error); }

  const ShapeOf a, b;
  const Motion motion;
  const PoseQuality quality;
  const Radii radii;
};

/// An answer that tells nothing but why.
void refuse(const Body& a, const Body& b, Status why, bool is_signed, Answer& answer);

/// What is not known becomes NaN, and the answer carries the radii.
void seal(const Radii& radii, const OverlapProof& proof, const Tuning& tuning, Answer& answer);

/// Answers `target` of two bodies: from the seed, or on from `so_far`. `answer` is a new one before.
void ask(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Limits& limits, const Target& target,
         Answer& answer, const Answer* so_far = nullptr);

}  // namespace swiftlet
