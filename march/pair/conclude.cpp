// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair/conclude.h"

#include "pair/gjk.h"
#include "pair/intersection.h"
#include "pair/start.h"
#include "pair/witness.h"

namespace swiftlet {
namespace {

MarchStatus status_of(const PairView& pair, const StopRule& stop, const Certificate& c) {
  if (c.lower > stop.above) return MarchStatus::Beyond;
  if (!stop.narrow(c.lower, c.upper)) return MarchStatus::NotConverged;
  if (c.upper <= pair.law_two) return MarchStatus::Touching;
  return c.lower > 0 ? MarchStatus::Disjoint : MarchStatus::Near;
}

/// Names in `r` the features that hold its points, which the pairs of `active` make.
void name_features(const PairView& pair, const ActiveSet& active, MarchResult& r) {
  r.a = feature_of(pair.a, active, active.a);
  r.b = feature_of(pair.b, active, active.b);
  if (r.status == MarchStatus::Overlapping) return;  // there are no nearest points
  const HeldPoint a = held_at_a(pair, r.a, vec(r.point_a), r.plane_tests),
                  b = held_at_b(pair, r.b, vec(r.point_b), r.plane_tests);
  r.a = a.feature, r.point_a = eigen(a.point);
  r.b = b.feature, r.point_b = eigen(b.point);
}

/// Fills `r` from the end of a walk. True if `r` is so near a threshold that another start might prove another verdict.
template <Until until>
bool from_walk(const PairView& pair, const Walk& walk, const MarchRule& rule, double zero, MarchResult& r) {
  r.steps = walk.steps;
  r.plane_tests = walk.plane_tests;
  r.a = walk.a;
  r.b = walk.b;
  const StopRule asked{rule.absolute, rule.relative, rule.beyond};
  const StopRule stop = asked.beyond_by(pair.law_two).at_least(pair.law_two);
  Certificate c = certify(pair, witness(pair, walk.a, walk.b), r.plane_tests);
  r.status = status_of(pair, stop, c);
  // If the features touch, the bodies touch or overlap: certified GJK decides which.
  const bool decided = r.status != MarchStatus::NotConverged && (r.status != MarchStatus::Touching || c.lower > 0);
  double depth = 0;
  const bool progressed = !decided && walk.end != WalkEnd::Budget;
  if (!decided && !progressed) {
    r.status = MarchStatus::Budget;
  } else if (progressed) {
    const StopRule until_there = until == Until::Exact ? StopRule{pair.law_two, 0, stop.above} : stop;
    const GjkResult meeting = gjk(pair, c, until_there, r.plane_tests);
    c = meeting.certificate;
    r.status = meeting.status == MarchStatus::Disjoint ? status_of(pair, stop, c) : meeting.status;
    r.proof = meeting.proof;
    depth = meeting.depth;
    ++r.steps;
  }
  const bool apart = r.status == MarchStatus::Disjoint || r.status == MarchStatus::Touching || r.status == MarchStatus::Beyond;
  Certificate straight = c;
  const bool straightened = apart && leans(pair, c) && straighten(pair, straight, r.plane_tests) &&
                            (r.status != MarchStatus::Beyond || straight.lower > stop.above);
  if (straightened) c = straight;
  r.lower = c.lower;
  r.upper = max(c.upper, c.lower);
  r.normal = eigen(c.normal);
  r.point_a = eigen(c.point_a);
  r.point_b = eigen(c.point_b);
  if (progressed || straightened) name_features(pair, c.active, r);
  const bool deep = r.status == MarchStatus::Overlapping && depth > pair.law_two;
  const auto near = [&](double threshold) { return is_near(pair, r.lower, r.upper, threshold); };
  return r.upper - r.lower <= 2 * pair.law_two && !deep && (near(0) || near(zero) || near(rule.beyond));
}

/// Replaces `r` by the result of a cold start if the budget allows one: within rounding of a threshold, the result then does
/// not depend on the start.
template <Until until>
void from_nothing(const PairView& pair, const MarchRule& rule, double zero, MarchResult& r) {
  std::uint32_t climbs = 0;
  const MarchStart cold = settled(pair, {}, climbs);
  const Walk cold_walk = walk(pair, cold.a, cold.b, PlaneRule::MostViolated, rule.step_budget - r.steps);
  if (cold_walk.end == WalkEnd::Budget) return;
  MarchResult same;
  from_walk<until>(pair, cold_walk, rule, zero, same);
  same.steps += r.steps;
  same.plane_tests += r.plane_tests + climbs;
  r = same;
}

}  // namespace

Doubt certify_closely(const PairView& pair, Nearest& seen, Doubt doubt, std::uint32_t& plane_tests, Proof& proof) {
  while ((doubt == Doubt::Width || doubt == Doubt::Neighbour) && tighten(pair, seen, plane_tests))
    doubt = certify(pair, seen, proof);
  return doubt;
}

template <Until until>
MarchResult conclude(const PairView& pair, const Walk& walk, const MarchRule& rule, double zero) {
  MarchResult r;
  if (from_walk<until>(pair, walk, rule, zero, r) && r.steps < rule.step_budget) from_nothing<until>(pair, rule, zero, r);
  return r;
}

template MarchResult conclude<Until::Narrow>(const PairView&, const Walk&, const MarchRule&, double);
template MarchResult conclude<Until::Exact>(const PairView&, const Walk&, const MarchRule&, double);

}  // namespace swiftlet
