// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The fields of the public answers, by name, work included. A visitor has `number`, `numbers`, `feature` and `count` for one
// field, `pair` for two small ones, and `element` before the fields of an array's element, `element()` after the last.
#pragma once

#include <cstdint>

#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

namespace swiftlet::answers {

void visit(const Answer& answer, auto&& fields) {
  fields.pair("status", answer.status, "verdict", answer.verdict);
  fields.number("lower", answer.lower), fields.number("upper", answer.upper);
  fields.numbers("normal", answer.normal);
  fields.numbers("point_a", answer.point_a), fields.numbers("point_b", answer.point_b);
  fields.pair("level_a", answer.level_a, "level_b", answer.level_b);
  fields.feature("feature_a", answer.feature_a), fields.feature("feature_b", answer.feature_b);
  fields.number("radius_a", answer.radius_a), fields.number("radius_b", answer.radius_b);
  fields.pair("steps", answer.steps, "plane_tests", answer.plane_tests);
  fields.pair("is_signed", answer.is_signed, "levels_visited", answer.levels_visited);
}

void visit(const Manifold& manifold, auto&& fields) {
  fields.numbers("normal", manifold.normal);
  fields.feature("face_a", manifold.face_a), fields.feature("face_b", manifold.face_b);
  fields.count("points", manifold.count);
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    fields.element("point", i);
    fields.numbers("point_a", p.point_a), fields.numbers("point_b", p.point_b);
    fields.number("separation", p.separation);
    fields.feature("feature_a", p.feature_a), fields.feature("feature_b", p.feature_b);
  }
  fields.element();
}

}  // namespace swiftlet::answers
