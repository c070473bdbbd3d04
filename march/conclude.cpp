// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "conclude.h"

#include "certify.h"
#include "progress.h"

namespace swiftlet {
namespace {

MarchStatus status_of(const Scene& scene, const Goal& goal, const Certificate& c) {
  if (c.lower > goal.beyond) return MarchStatus::Beyond;
  if (!goal.met(c.lower, c.upper)) return MarchStatus::NotConverged;
  if (c.lower > 0) return MarchStatus::Disjoint;
  return c.upper <= scene.law_two ? MarchStatus::Touching : MarchStatus::Near;
}

}  // namespace

MarchResult conclude(const Scene& scene, const Walk& walk, const MarchRule& rule) {
  MarchResult r;
  r.steps = walk.steps;
  r.plane_tests = walk.plane_tests;
  r.a = walk.a;
  r.b = walk.b;
  const Goal goal{std::fmax(rule.absolute, scene.law_two), rule.relative, rule.beyond};
  Certificate c = certify(scene, walk.a, walk.b, r.plane_tests);
  r.status = status_of(scene, goal, c);
  // That the features touch says nothing of the bodies: only certified progress tells touching from overlapping.
  const bool settled = r.status == MarchStatus::Disjoint || r.status == MarchStatus::Beyond || r.status == MarchStatus::Near;
  if (!settled && walk.end == WalkEnd::Budget) {
    r.status = MarchStatus::Budget;
  } else if (!settled) {
    const Meeting meeting = progress(scene, c, goal, r.plane_tests);
    c = meeting.certificate;
    r.status = meeting.status == MarchStatus::Disjoint ? status_of(scene, goal, c) : meeting.status;
    r.proof = meeting.proof;
    r.a = feature_of(scene.a, c.active, c.active.a);
    r.b = feature_of(scene.b, c.active, c.active.b);
    ++r.steps;
  }
  r.lower = c.lower;
  r.upper = std::fmax(c.upper, c.lower);
  r.normal = eigen(c.normal);
  r.point_a = eigen(c.point_a);
  r.point_b = eigen(c.point_b);
  return r;
}

}  // namespace swiftlet
