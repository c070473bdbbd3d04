// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are all within a radius of their hulls: what is asked of them becomes a question of the hulls, and the hulls'
// answer becomes theirs. The only place that knows radii, but for checks. Knows nothing of the way between.
#pragma once

#include <swiftlet/depth.h>

#include "descend.h"
#include "vec.h"

namespace swiftlet {

static inline bool is_radius(double value) { return value >= 0 && value <= kMostCoordinate; }

/// By the radii of some options. Without any, all that it makes of questions and answers is themselves.
class Dilation {
 public:
  explicit Dilation(const QueryOptions& options) : a_(options.radius_a), b_(options.radius_b) {}

  /// Else nothing else is asked of it.
  bool legal() const { return is_radius(a_) && is_radius(b_); }
  bool none() const { return a_ + b_ == 0; }
  double sum() const { return a_ + b_; }
  /// Of the bodies.
  double law_two(const Model& a, const Model& b, const Motion& b_in_a) const;

  /// The question as one of the hulls. Law 2's bound, of the bodies, is more than the bounds are rounded by.
  Target of_hulls(const Target& of, double law_two) const;
  /// An answer about the bodies, as it was of the hulls, as far as it tells.
  Answer of_hulls(Answer of) const;

  void dilate(Answer& answer, double law_two) const;
  void dilate(SignedAnswer& answer, double law_two) const;
  void dilate(LevelRecord& record) const;

 private:
  Dilation(double a, double b) : a_(a), b_(b) {}
  /// bound - a - b, at most a place off, to the side that is named.
  double less(double bound, double side) const;
  double more(double bound, double side) const;
  /// The hulls' bounds as the bodies', below 0 where these overlap.
  double lower(double of_hulls) const;
  double upper(double of_hulls) const;
  template <class AnyAnswer>
  void move_points(AnyAnswer& answer) const;

  double a_, b_;
};

/// Answers `target` of the hulls of `a` and `b` dilated by the options' radii: from the seed, or on from `so_far`.
Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
           const Target& target, const Dilation& dilation, const Answer* so_far);
static inline Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
                         const Target& target, const Answer* so_far = nullptr) {
  const Dilation dilation(options);
  if (!dilation.legal()) {
    Answer invalid;
    invalid.status = Status::InvalidRadius;
    return invalid;
  }
  return dilation.none() ? descend(a, b, b_in_a, seed, options, target, so_far)
                         : ask(a, b, b_in_a, seed, options, target, dilation, so_far);
}

}  // namespace swiftlet
