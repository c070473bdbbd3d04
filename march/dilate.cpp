// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "dilate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "double_double.h"
#include "scene.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is no radius counts as 0 where asserts are off.
double radius(double value) {
  assert(value >= 0 && value <= kMostCoordinate);
  return larger(0, value);
}

class Dilation {
 public:
  explicit Dilation(const QueryOptions& options) : a_(radius(options.radius_a)), b_(radius(options.radius_b)) {}

  bool none() const { return a_ + b_ == 0; }

  double law_two(const Model& a, const Model& b, const Motion& m) const {
    const ConvexView &hull_a = a.level(0).view, &hull_b = b.level(0).view;
    return swiftlet::law_two(hull_a.extent + a_, hull_b.extent + b_, norm(m.t), pose_quality(m).error);
  }

  /// The question as one of the hulls. Law 2's bound is more than the bounds are rounded by.
  Target of_hulls(const Target& of, double law_two) const {
    const double sum = a_ + b_;
    return {of.absolute, of.relative, of.clear_above + sum, of.hit_below + sum, sum, (1 + of.relative) * law_two};
  }

  /// The hulls' bounds as the bodies', below 0 where these overlap.
  double lower(double of_hulls) const { return less(of_hulls, -kInfinity); }
  double upper(double of_hulls) const { return less(of_hulls, kInfinity); }

  void dilate(Answer& answer, double law_two) const {
    const double low = lower(answer.lower), high = upper(answer.upper);
    if (answer.verdict != Verdict::Overlapping) {
      answer.verdict = verdict(low, high, law_two);
      answer.proof = {};  // coarse levels may overlap
      answer.point_a = eigen(vec(answer.point_a) + vec(answer.normal) * a_);
      answer.point_b = eigen(vec(answer.point_b) - vec(answer.normal) * b_);
    }
    answer.lower = larger(0, low);
    answer.upper = larger(answer.lower, high);
  }

  /// An answer about the bodies, as it was of the hulls, as far as it tells.
  Answer of_hulls(Answer of) const {
    if (of.proof.count != 0) return of;
    of.verdict = of.verdict == Verdict::Disjoint ? Verdict::Disjoint : Verdict::Undecided;
    of.point_a = eigen(vec(of.point_a) - vec(of.normal) * a_);
    of.point_b = eigen(vec(of.point_b) + vec(of.normal) * b_);
    of.lower = of.lower > 0 ? more(of.lower, -kInfinity) : 0;
    of.upper = more(of.upper, kInfinity);
    return of;
  }

  void dilate(SignedAnswer& answer, double law_two) const {
    answer.lower = lower(answer.lower);
    answer.upper = upper(answer.upper);
    answer.verdict = verdict(answer.lower, answer.upper, law_two);
    answer.point_a = eigen(vec(answer.point_a) + vec(answer.normal) * a_);
    answer.point_b = eigen(vec(answer.point_b) - vec(answer.normal) * b_);
    if (answer.upper < 0) answer.proof = {};
  }

  void dilate(LevelRecord& record) const {
    record.lower = larger(0, lower(record.lower));
    record.upper = larger(record.lower, upper(record.upper));
  }

 private:
  /// bound - a - b, at most a place off, to the side that is named.
  double less(double bound, double side) const {
    if (!std::isfinite(bound)) return bound;
    const Pair sum = two_sum(a_, b_), rest = two_sum(bound, -sum.high);
    const double lost = rest.low - sum.low;
    return lost == 0 ? rest.high : std::nextafter(rest.high + lost, side);
  }

  /// bound + a + b, likewise.
  double more(double bound, double side) const { return Dilation(-a_, -b_).less(bound, side); }

  Dilation(double a, double b) : a_(a), b_(b) {}

  static Verdict verdict(double lower, double upper, double law_two) {
    if (upper < 0) return Verdict::Overlapping;
    if (lower > 0) return Verdict::Disjoint;
    return lower >= -law_two && upper <= law_two ? Verdict::Touching : Verdict::Undecided;
  }

  double a_, b_;
};

/// The same answer, for no work.
Answer known(Answer answer, Status status) {
  answer.status = status;
  answer.steps = answer.plane_tests = 0;
  answer.levels_visited = 0;
  return answer;
}

}  // namespace

Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
           const Target& target, const Answer* so_far) {
  const Dilation dilation(options);
  if (dilation.none()) return descend(a, b, b_in_a, seed, options, target, so_far);
  if (so_far && so_far->verdict == Verdict::Overlapping) return known(*so_far, Status::Converged);
  const double law_two = dilation.law_two(a, b, motion(b_in_a));
  Answer hulls;
  if (so_far) hulls = dilation.of_hulls(*so_far);
  Answer answer = descend(a, b, b_in_a, seed, options, dilation.of_hulls(target, law_two), so_far ? &hulls : nullptr);
  if (so_far && answer.levels_visited == 0 && answer.status != Status::InvalidPose) return known(*so_far, answer.status);
  dilation.dilate(answer, law_two);
  const std::size_t recorded = std::min(options.trace.size(), std::size_t(answer.levels_visited));
  for (LevelRecord& record : options.trace.first(recorded)) dilation.dilate(record);
  return answer;
}

QueryOptions of_hulls(const QueryOptions& options) {
  const Dilation dilation(options);
  if (dilation.none()) return options;
  QueryOptions hulls = options;
  hulls.radius_a = hulls.radius_b = 0;
  hulls.relative_error = 0;
  hulls.beyond = dilation.of_hulls({0, 0, options.beyond, 0}, 0).clear_above;
  return hulls;
}

void dilate(SignedAnswer& answer, const Model& a, const Model& b, const Pose& b_in_a, const QueryOptions& options) {
  const Dilation dilation(options);
  if (!dilation.none() && answer.status != Status::InvalidPose) dilation.dilate(answer, dilation.law_two(a, b, motion(b_in_a)));
}

}  // namespace swiftlet
