// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rounded bodies: a body is the set of all points within its radius of its hull. A question about bodies is turned into one
// about their hulls, and the answer about the hulls into one about the bodies. Distances and depths handle radii through this
// file; manifolds and checks read them from the answer. Knows nothing of how the hulls' answer is found.
#pragma once

#include <swiftlet/query.h>

#include "body/shape.h"
#include "numeric/vec.h"
#include "pair/pair_view.h"
#include "pair/stop_rule.h"

namespace swiftlet {

static inline bool is_radius(double value) { return value >= 0 && value <= kMostCoordinate; }

/// The radii of two bodies. If both are 0, every question and every bound stays as it is.
class Radii {
 public:
  Radii(const Body& a, const Body& b) : a_(a.radius()), b_(b.radius()) {}
  explicit Radii(const Answer& answer) : a_(answer.radius_a), b_(answer.radius_b) {}
  Radii(double a, double b) : a_(a), b_(b) {}

  /// True if both radii are legal. If not, no question, answer or bound may be converted.
  bool legal() const { return is_radius(a_) && is_radius(b_); }
  bool none() const { return a_ + b_ == 0; }
  double sum() const { return a_ + b_; }
  double a() const { return a_; }
  double b() const { return b_; }
  bool operator==(const Radii&) const = default;
  /// Law 2's bound for the bodies: each radius is added to its hull's extent.
  double law_two(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error) const;

  /// Turns a question about the bodies into one about their hulls. `law_two` is law 2's bound for the bodies; it exceeds the
  /// rounding of the converted bounds.
  StopRule of_hulls(const StopRule& of, double law_two) const;
  /// Turns an answer about the bodies back into one about their hulls, as far as it determines that.
  Answer of_hulls(Answer of) const;

  /// Carries what `so_far`, another answer about the bodies' distance, proves by more than `rounding` better over to `answer`:
  /// the normal with `lower`; points, features and levels with `upper`.
  void keep_better(Answer so_far, double rounding, Answer& answer) const;

  /// Turns an answer about the hulls' distance into one about the bodies'. Clears `proof` unless the hulls overlap.
  void round(Answer& answer, OverlapProof& proof, double law_two) const;
  /// Turns an answer about the hulls' signed distance into one about the bodies'.
  void round_signed(Answer& answer, OverlapProof& proof, double law_two) const;
  /// Convert the bounds of the first `visited` records of `trace`, or of all if it is shorter.
  void round(std::span<LevelRecord> trace, int visited) const;
  void round_signed(std::span<LevelRecord> trace, int visited) const;

 private:
  /// `less` is `bound` - a - b, `more` is `bound` + a + b. A result that is rounded is replaced by the next double towards
  /// `side`, so that it remains a bound.
  double less(double bound, double side) const;
  double more(double bound, double side) const;
  /// Turn a bound on the hulls' distance into one on the bodies' signed distance.
  double lower(double of_hulls) const;
  double upper(double of_hulls) const;
  void move_points(Answer& answer) const;

  double a_, b_;
};

/// What every query computes first: the shapes of both bodies, their radii, the pose, and whether all of these are legal.
class Setting {
 public:
  [[gnu::always_inline]] Setting(const Body& of_a, const Body& of_b, const Pose& b_in_a)
      : a(of_a), b(of_b), motion(swiftlet::motion(b_in_a)), quality(pose_quality(motion)), radii(of_a, of_b) {}
  /// The status with which the query must be refused, or `Converged` if everything is legal.
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

/// Fills the answer of a refused query: the status `why` and the radii; nothing else is known.
void refuse(const Body& a, const Body& b, Status why, bool is_signed, Answer& answer);

/// True if the normal proves the lower bound. The level pair that `proof` is about may overlap although a coarser pair, which
/// proved the bound, is disjoint: levels enclose the body, not each other.
static inline bool separates(const Answer& answer, const OverlapProof& proof) {
  if (answer.is_signed) return answer.lower > -kInfinity;
  return answer.lower > 0 || proof.count == 0;
}
/// Completes `answer`: adds the radii, sets an unknown normal and unknown points to NaN, and copies `proof` to `tuning`.
static inline void seal(const Radii& radii, const OverlapProof& proof, const Tuning& tuning, Answer& answer) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  answer.radius_a = radii.a(), answer.radius_b = radii.b();
  if (tuning.proof) *tuning.proof = proof;
  if (!(answer.lower > 0) && (!separates(answer, proof) || max_abs(vec(answer.normal)) == 0)) answer.normal.setConstant(kNaN);
  if (!(answer.upper < kInfinity)) answer.point_a.setConstant(kNaN), answer.point_b.setConstant(kNaN);
}

/// Ends a question of yes or no: it is answered once `lower` is beyond the threshold, and the status then is Converged.
static inline void decide(Answer& answer) {
  if (answer.status == Status::Beyond) answer.status = Status::Converged;
}
/// The same, and reads off the answer whether the distance is at most `threshold`. Where the query was refused, nothing tells.
static inline void decide(Within& result, double threshold) {
  decide(result.answer);
  if (result.answer.status >= Status::InvalidPose) return;
  if (result.answer.lower > threshold) result.decision = Decision::No;
  if (result.answer.upper <= threshold) result.decision = Decision::Yes;
}

}  // namespace swiftlet
