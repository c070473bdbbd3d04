// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <swiftlet/check.h>

namespace swiftlet::stability {
namespace {

constexpr double kEps = 0x1p-53;
constexpr double kRoundingOfBound = 1 + 0x1p-48;  // the library adds up the same size in another order

double largest_coordinate(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  return largest;
}

double orthonormality_error(const Mat3& r) { return (r.transpose() * r - Mat3::Identity()).cwiseAbs().maxCoeff(); }

bool is_same(const Pose& p, const Pose& q) { return p.rotation == q.rotation && p.translation == q.translation; }

/// The signed distance is within `bound` of `x`, decided exactly but for the rounding of x +- bound.
bool within_of(const oracle::SignedTruth& truth, double x, double bound) {
  return oracle::compare(truth, x - bound) >= 0 && oracle::compare(truth, x + bound) <= 0;
}
/// The distance, 0 where overlapping, is in [lower - slack, upper + slack].
bool in_interval(const oracle::SignedTruth& truth, double lower, double upper, double slack) {
  return (lower <= slack || oracle::compare(truth, lower - slack) >= 0) && oracle::compare(truth, upper + slack) <= 0;
}

template <class... Values>
Judgement fault(Fault kind, const char* format, Values... values) {
  char message[240];
  std::snprintf(message, sizeof message, format, values...);
  return {kind, message};
}

const char* name(Verdict v) {
  switch (v) {
    case Verdict::Undecided: return "undecided";
    case Verdict::Disjoint: return "disjoint";
    case Verdict::Touching: return "touching";
    case Verdict::Overlapping: return "overlapping";
  }
  return "no verdict";
}

Judgement judge_verdict(const Problem& p, Verdict verdict) {
  const auto wrong = [&](const char* where, const oracle::SignedTruth& truth) {
    return fault(Fault::WrongVerdict, "%s, but the signed distance %s is %.17g, law 2's bound %.3g", name(verdict), where,
                 truth.distance, p.bound);
  };
  const bool proved_right = verdict == Verdict::Disjoint      ? p.asked.sign > 0
                            : verdict == Verdict::Overlapping ? p.asked.sign <= 0
                                                              : within_of(p.asked, 0, p.bound);
  if (!proved_right) return wrong("asked for", p.asked);
  const bool open_in_world = within_of(p.in_world, 0, p.world_bound);
  const Verdict in_world = p.in_world.sign > 0 ? Verdict::Disjoint : Verdict::Overlapping;
  if (!open_in_world && verdict != in_world) return wrong("in the world", p.in_world);
  return {};
}

/// What holds of an answer to any question.
Judgement judge_claims(const Problem& p, const Model& a, const Model& b, const Answer& answer, Question asked,
                       const OverlapProof& proof) {
  if (answer.status != Status::Converged) return fault(Fault::NotConverged, "status %d", int(answer.status));
  const bool is_apart = answer.verdict == Verdict::Disjoint || answer.verdict == Verdict::Touching,
             has_normal = !is_apart || answer.normal.allFinite(),
             finite = has_normal && answer.point_a.allFinite() && answer.point_b.allFinite();
  if (!(answer.lower >= 0 && answer.upper >= answer.lower && finite))
    return fault(Fault::NoNumber, "[%.17g, %.17g]", answer.lower, answer.upper);
  if (!in_interval(p.asked, answer.lower, answer.upper, 0))
    return fault(Fault::WrongDistance, "[%.17g, %.17g] does not hold %.17g", answer.lower, answer.upper, p.asked.distance);
  if (!in_interval(p.in_world, answer.lower, answer.upper, p.world_bound))
    return fault(Fault::WrongDistance, "[%.17g, %.17g] is farther than %.3g from %.17g in the world", answer.lower,
                 answer.upper, p.world_bound, p.in_world.distance);
  if (const Check c = check(a, b, p.b_in_a, answer, asked, &proof); !c) return {Fault::WrongDistance, c.message};
  return {};
}

}  // namespace

Problem problem_of(const Case& c) {
  Problem p;
  p.b_in_a = c.b_in_a();
  p.size = std::max(largest_coordinate(c.a), largest_coordinate(c.b)) + p.b_in_a.translation.norm();
  const double error = orthonormality_error(p.b_in_a.rotation);
  p.bound = (64 * kEps + 2 * error) * p.size * kRoundingOfBound;
  p.world_bound = (64 * kEps + 2 * std::max(error, c.orthonormality_error())) * p.size * kRoundingOfBound;
  p.asked = oracle::signed_distance(c.a, Pose{}, c.b, p.b_in_a);
  const bool same = is_same(c.a_in_world, Pose{}) && is_same(c.b_in_world, p.b_in_a);
  p.in_world = same ? p.asked : oracle::signed_distance(c.a, c.a_in_world, c.b, c.b_in_world);
  return p;
}

Case swapped(const Case& c) {
  Case result = c;
  std::swap(result.a, result.b);
  std::swap(result.a_in_world, result.b_in_world);
  return result;
}

Judgement judge_exact(const Problem& p, const Model& a, const Model& b, const Answer& answer, const OverlapProof& proof) {
  if (Judgement j = judge_claims(p, a, b, answer, Question::Exact, proof); j.fault != Fault::None) return j;
  if (Judgement j = judge_verdict(p, answer.verdict); j.fault != Fault::None) return j;
  if (!(answer.upper - answer.lower <= p.bound))
    return fault(Fault::WrongDistance, "[%.17g, %.17g] is wider than law 2's %.3g", answer.lower, answer.upper, p.bound);
  const Vec3 apart = answer.point_b - answer.point_a;
  if (answer.verdict == Verdict::Disjoint && !((apart - apart.norm() * answer.normal).norm() <= p.bound))
    return fault(Fault::WrongDistance, "the points lie %.17g apart, not along the normal", apart.norm());
  return {};
}

Judgement judge_intersects(const Problem& p, const Model& a, const Model& b, const Answer& answer, const OverlapProof& proof) {
  if (Judgement j = judge_claims(p, a, b, answer, Question::Any, proof); j.fault != Fault::None) return j;
  return judge_verdict(p, answer.verdict);
}

Judgement judge_within(const Problem& p, const Model& a, const Model& b, double threshold, const Within& within,
                       const OverlapProof& proof) {
  if (Judgement j = judge_claims(p, a, b, within.answer, Question::Any, proof); j.fault != Fault::None) return j;
  const int truth = oracle::compare(p.asked, threshold);
  const bool right = within.decision == Decision::Yes  ? truth <= 0
                     : within.decision == Decision::No ? truth > 0
                                                       : within_of(p.asked, threshold, p.bound);
  if (!right)
    return fault(Fault::WrongVerdict, "decision %d on threshold %.17g, but the signed distance is %.17g", int(within.decision),
                 threshold, p.asked.distance);
  // A decision needs no verdict; one that is given has to be right.
  return within.answer.verdict == Verdict::Undecided ? Judgement{} : judge_verdict(p, within.answer.verdict);
}

Judgement judge_signed(const Problem& p, const Model& a, const Model& b, const Answer& answer, const OverlapProof& proof) {
  const Fault wrong = answer.lower < 0 ? Fault::WrongDepth : Fault::WrongDistance;
  if (answer.status != Status::Converged) return fault(Fault::NotConverged, "status %d", int(answer.status));
  const bool finite = answer.normal.allFinite() && answer.point_a.allFinite() && answer.point_b.allFinite();
  if (!(answer.upper >= answer.lower && std::isfinite(answer.lower) && finite))
    return fault(Fault::NoNumber, "[%.17g, %.17g]", answer.lower, answer.upper);
  const auto holds = [&](const oracle::SignedTruth& truth, double slack) {
    return oracle::compare(truth, answer.lower - slack) >= 0 && oracle::compare(truth, answer.upper + slack) <= 0;
  };
  if (!holds(p.asked, 0))
    return fault(wrong, "[%.17g, %.17g] does not hold %.17g", answer.lower, answer.upper, p.asked.distance);
  if (!holds(p.in_world, p.world_bound))
    return fault(wrong, "[%.17g, %.17g] is farther than %.3g from %.17g in the world", answer.lower, answer.upper,
                 p.world_bound, p.in_world.distance);
  const double width = answer.verdict == Verdict::Touching ? 2 * p.bound : p.bound;  // a depth and a distance
  if (!(answer.upper - answer.lower <= width))
    return fault(wrong, "[%.17g, %.17g] is wider than law 2's %.3g", answer.lower, answer.upper, width);
  const Vec3 aside = answer.point_b - answer.point_a - (answer.lower + answer.upper) / 2 * answer.normal;
  if (!(aside.norm() <= 2 * p.bound))
    return fault(wrong, "the points are %.17g off the signed distance along the normal", aside.norm());
  if (const Check c = check(a, b, p.b_in_a, answer, Question::Exact, &proof); !c) return {wrong, c.message};
  return judge_verdict(p, answer.verdict);
}

double error_of(const Problem& p, const Answer& answer) {
  const double truth = answer.is_signed ? p.in_world.distance : std::max(p.in_world.distance, 0.);
  return std::max(std::abs(answer.lower - truth), std::abs(answer.upper - truth));
}

}  // namespace swiftlet::stability
