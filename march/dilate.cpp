// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "dilate.h"

#include <algorithm>
#include <cmath>

#include "double_double.h"
#include "scene.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Verdict verdict(double lower, double upper, double law_two) {
  if (upper < 0) return Verdict::Overlapping;
  if (lower > 0) return Verdict::Disjoint;
  return lower >= -law_two && upper <= law_two ? Verdict::Touching : Verdict::Undecided;
}

/// The same answer, for no work.
Answer known(Answer answer, Status status) {
  answer.status = status;
  answer.steps = answer.plane_tests = 0;
  answer.levels_visited = 0;
  return answer;
}

}  // namespace

double Dilation::law_two(const Model& a, const Model& b, const Motion& b_in_a) const {
  const ConvexView &hull_a = a.level(0).view, &hull_b = b.level(0).view;
  return swiftlet::law_two(hull_a.extent + a_, hull_b.extent + b_, norm(b_in_a.t), pose_quality(b_in_a).error);
}

Target Dilation::of_hulls(const Target& of, double law_two) const {
  if (none()) return of;
  return {of.absolute, of.relative, of.clear_above + sum(), of.hit_below + sum(), sum(), (1 + of.relative) * law_two};
}

Answer Dilation::of_hulls(Answer of) const {
  if (of.proof.count != 0) return of;
  of.verdict = of.verdict == Verdict::Disjoint ? Verdict::Disjoint : Verdict::Undecided;
  Dilation(-a_, -b_).move_points(of);
  of.lower = of.lower > 0 ? more(of.lower, -kInfinity) : 0;
  of.upper = more(of.upper, kInfinity);
  return of;
}

void Dilation::dilate(Answer& answer, double law_two) const {
  const double low = lower(answer.lower), high = upper(answer.upper);
  if (answer.verdict != Verdict::Overlapping) {
    answer.verdict = verdict(low, high, law_two);
    answer.proof = {};  // coarse levels may overlap
    move_points(answer);
  }
  answer.lower = larger(0, low);
  answer.upper = larger(answer.lower, high);
}

void Dilation::dilate(SignedAnswer& answer, double law_two) const {
  if (none() || answer.status == Status::InvalidPose) return;
  answer.lower = lower(answer.lower);
  answer.upper = upper(answer.upper);
  answer.verdict = verdict(answer.lower, answer.upper, law_two);
  if (answer.upper < 0) answer.proof = {};
  move_points(answer);
}

void Dilation::dilate(LevelRecord& record) const {
  record.lower = larger(0, lower(record.lower));
  record.upper = larger(record.lower, upper(record.upper));
}

double Dilation::less(double bound, double side) const {
  if (!std::isfinite(bound)) return bound;
  const Pair sum = two_sum(a_, b_), rest = two_sum(bound, -sum.high);
  const double lost = rest.low - sum.low;
  return lost == 0 ? rest.high : std::nextafter(rest.high + lost, side);
}
double Dilation::more(double bound, double side) const { return Dilation(-a_, -b_).less(bound, side); }
double Dilation::lower(double of_hulls) const { return less(of_hulls, -kInfinity); }
double Dilation::upper(double of_hulls) const { return less(of_hulls, kInfinity); }

template <class AnyAnswer>
void Dilation::move_points(AnyAnswer& answer) const {
  answer.point_a = eigen(vec(answer.point_a) + vec(answer.normal) * a_);
  answer.point_b = eigen(vec(answer.point_b) - vec(answer.normal) * b_);
}

Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
           const Target& target, const Dilation& dilation, const Answer* so_far) {
  if (so_far && so_far->verdict == Verdict::Overlapping) return known(*so_far, Status::Converged);
  const double law_two = dilation.law_two(a, b, motion(b_in_a));
  Target of_hulls = dilation.of_hulls(target, law_two);
  Answer hulls;
  if (so_far) {
    hulls = dilation.of_hulls(*so_far);
    // Exact of the bodies is exact, whatever place the radii cost it.
    if (so_far->upper - so_far->lower <= law_two) of_hulls.exact = hulls.upper - hulls.lower;
  }
  Answer answer = descend(a, b, b_in_a, seed, options, of_hulls, so_far ? &hulls : nullptr);
  if (so_far && answer.levels_visited == 0 && answer.status != Status::InvalidPose) return known(*so_far, answer.status);
  dilation.dilate(answer, law_two);
  const std::size_t recorded = std::min(options.trace.size(), std::size_t(answer.levels_visited));
  for (LevelRecord& record : options.trace.first(recorded)) dilation.dilate(record);
  return answer;
}

}  // namespace swiftlet
