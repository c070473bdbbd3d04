// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Rounded bodies: converts questions and answers between bodies and their hulls. Knows nothing of walks.
#include "query/radii.h"

#include <algorithm>
#include <cmath>

#include "numeric/double_double.h"
#include "pair/pair_view.h"

namespace swiftlet {
namespace {

Verdict verdict(double lower, double upper, double law_two) {
  if (upper < 0) return Verdict::Overlapping;
  if (lower > 0) return Verdict::Disjoint;
  return lower >= -law_two && upper <= law_two ? Verdict::Touching : Verdict::Undecided;
}

}  // namespace

double tolerance(const Body& a, const Body& b, const Pose& b_in_a) {
  const ShapeOf shape_a(a), shape_b(b);
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal || !is_radius(a.radius()) || !is_radius(b.radius()) || !shape_a.is_legal() || !shape_b.is_legal())
    return std::numeric_limits<double>::quiet_NaN();
  const double largest = max((*shape_a).level(0).view.extent + a.radius(), (*shape_b).level(0).view.extent + b.radius());
  return max((kLawTwo + 2 * quality.error) * (largest + norm(m.t)), kLeastWidth);
}

double Radii::law_two(const Shape& a, const Shape& b, const Motion& b_in_a, double pose_error) const {
  return swiftlet::law_two(a.level(0).view.extent + a_, b.level(0).view.extent + b_, norm(b_in_a.t), pose_error);
}

StopRule Radii::of_hulls(const StopRule& of, double law_two) const {
  if (none()) return of;
  return {of.absolute, of.relative, of.above + sum(), of.below + sum(), sum(), (1 + of.relative) * law_two};
}

Answer Radii::of_hulls(Answer of) const {
  of.is_signed = false;
  if (of.normal.hasNaN()) of.normal.setZero();
  if (none()) return of;
  of.verdict = of.verdict == Verdict::Disjoint ? Verdict::Disjoint : Verdict::Undecided;
  Radii(-a_, -b_).move_points(of);
  of.lower = of.lower > 0 ? more(of.lower, -kInfinity) : 0;
  of.upper = more(of.upper, kInfinity);
  return of;
}

void Radii::keep_better(Answer so_far, double rounding, Answer& answer) const {
  if (answer.status >= Status::InvalidPose || answer.verdict == Verdict::Overlapping) return;
  const bool lower = so_far.lower > answer.lower + rounding, upper = so_far.upper + rounding < answer.upper;
  const Radii back(-a_, -b_);
  back.move_points(so_far), back.move_points(answer);
  if (lower) {
    answer.lower = so_far.lower;
    answer.normal = so_far.normal;
    answer.verdict = so_far.verdict;
  }
  if (upper) {
    answer.upper = max(so_far.upper, answer.lower);
    answer.point_a = so_far.point_a, answer.point_b = so_far.point_b;
    answer.feature_a = so_far.feature_a, answer.feature_b = so_far.feature_b;
    answer.level_a = so_far.level_a, answer.level_b = so_far.level_b;
  }
  move_points(answer);
}

void Radii::round(Answer& answer, OverlapProof& proof, double law_two) const {
  const double low = lower(answer.lower), high = upper(answer.upper);
  if (answer.verdict != Verdict::Overlapping) {
    // A distance of 0 that is not known to be a touch may be of hulls deep in each other.
    const bool may_overlap = !(answer.lower > 0) && answer.verdict != Verdict::Touching;
    answer.verdict = verdict(may_overlap ? -kInfinity : low, high, law_two);
    if (!separates(answer, proof)) answer.normal.setZero();
    proof = {};
    move_points(answer);
  }
  answer.lower = max(0, low);
  answer.upper = max(answer.lower, high);
}

void Radii::round_signed(Answer& answer, OverlapProof& proof, double law_two) const {
  if (none()) return;
  answer.lower = lower(answer.lower);
  answer.upper = upper(answer.upper);
  answer.verdict = verdict(answer.lower, answer.upper, law_two);
  if (answer.upper < 0) proof = {};
  move_points(answer);
}

void Radii::round(std::span<LevelRecord> trace, int visited) const {
  for (LevelRecord& record : trace.first(std::min(trace.size(), std::size_t(visited)))) {
    record.lower = max(0, lower(record.lower));
    record.upper = max(record.lower, upper(record.upper));
  }
}
void Radii::round_signed(std::span<LevelRecord> trace, int visited) const {
  for (LevelRecord& record : trace.first(std::min(trace.size(), std::size_t(visited)))) {
    record.lower = lower(record.lower);
    record.upper = upper(record.upper);
  }
}

double Radii::less(double bound, double side) const {
  if (!std::isfinite(bound)) return bound;
  const HighLow sum = two_sum(a_, b_), rest = two_sum(bound, -sum.high);
  const double lost = rest.low - sum.low;
  if (lost == 0) return rest.high;
  return side > 0 ? next_above(rest.high + lost) : next_below(rest.high + lost);
}
double Radii::more(double bound, double side) const { return Radii(-a_, -b_).less(bound, side); }
double Radii::lower(double of_hulls) const { return less(of_hulls, -kInfinity); }
double Radii::upper(double of_hulls) const { return less(of_hulls, kInfinity); }

void Radii::move_points(Answer& answer) const {
  if (answer.normal.hasNaN()) return;  // none is known, and no point has been moved
  answer.point_a = eigen(vec(answer.point_a) + vec(answer.normal) * a_);
  answer.point_b = eigen(vec(answer.point_b) - vec(answer.normal) * b_);
}

void refuse(const Body& a, const Body& b, Status why, bool is_signed, Answer& answer) {
  answer.status = why;
  answer.is_signed = is_signed;
  if (is_signed) answer.lower = -kInfinity;
  answer.radius_a = a.radius(), answer.radius_b = b.radius();
}

}  // namespace swiftlet
