// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The atomic kernel on levels of models.
#include <swiftlet/march.h>

#include <cstddef>

#include "convert.h"

using namespace swiftlet;
using namespace swiftlet::c;

namespace {

static_assert(int(MarchStatus::Disjoint) == SWIFTLET_MARCH_DISJOINT && int(MarchStatus::Touching) == SWIFTLET_MARCH_TOUCHING);
static_assert(int(MarchStatus::Overlapping) == SWIFTLET_MARCH_OVERLAPPING && int(MarchStatus::Near) == SWIFTLET_MARCH_NEAR);
static_assert(int(MarchStatus::Beyond) == SWIFTLET_MARCH_BEYOND && int(MarchStatus::Budget) == SWIFTLET_MARCH_BUDGET);
static_assert(int(MarchStatus::NotConverged) == SWIFTLET_MARCH_NOT_CONVERGED);
static_assert(int(MarchStatus::InvalidPose) == SWIFTLET_MARCH_INVALID_POSE);

swiftlet_march_rule default_rule() {
  const MarchRule from;
  return {sizeof(swiftlet_march_rule),   from.step_budget, from.absolute, from.relative, from.beyond, from.floor,
          std::int32_t(from.plane_rule), from.careful};
}

MarchRule rule_of(const swiftlet_march_rule* given) {
  MarchRule to;
  if (!given) return to;
  swiftlet_march_rule room = default_rule();
  const swiftlet_march_rule& from = read(given, room, "rule");
  to.absolute = from.absolute, to.relative = from.relative;
  to.beyond = from.beyond, to.floor = from.floor;
  to.step_budget = from.step_budget;
  to.plane_rule = enumerator(from.plane_rule, PlaneRule::FirstViolated, "rule.plane_rule");
  to.careful = from.careful != 0;
  return to;
}

const ConvexView& view_of(const swiftlet_model* handle, std::int32_t level, const char* name) {
  const Model& model = model_of(handle, name);
  need(level >= model.finest_level() && level < model.level_count(), "the model lacks the level");
  return model.level(level).view;
}

swiftlet_march_result plain(const MarchResult& from) {
  swiftlet_march_result to{};
  to.status = std::int32_t(from.status), to.doubt = std::int32_t(from.doubt);
  to.a = c::plain(from.a), to.b = c::plain(from.b);
  to.lower = from.lower, to.upper = from.upper;
  copy(from.normal, to.normal);
  copy(from.point_a, to.point_a);
  copy(from.point_b, to.point_b);
  to.steps = from.steps, to.plane_tests = from.plane_tests;
  to.proof = c::plain(from.proof);
  return to;
}

}  // namespace

swiftlet_code swiftlet_march_rule_init(swiftlet_march_rule* rule, size_t size, swiftlet_error* error) {
  return init(default_rule(), rule, size, error);
}

swiftlet_code swiftlet_march(const swiftlet_model* a, int32_t level_a, const swiftlet_model* b, int32_t level_b,
                             const swiftlet_pose* b_in_a, swiftlet_feature start_a, swiftlet_feature start_b,
                             const swiftlet_march_rule* rule, swiftlet_march_result* result, swiftlet_error* error) {
  return guard(error, [&] {
    const ConvexView &view_a = view_of(a, level_a, "a"), &view_b = view_of(b, level_b, "b");
    need(result, "result");
    check_output(result, "result", offsetof(swiftlet_march_result, normal));
    write(plain(march(view_a, view_b, pose_of(b_in_a), {feature_of(start_a), feature_of(start_b)}, rule_of(rule))), result);
  });
}
