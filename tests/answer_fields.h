// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The fields of the public answers, by name, work included. A visitor has `number`, `numbers`, `handle` and `count` for one
// field, `pair` for two small ones, and `element` before the fields of an array's element, `element()` after the last.
#pragma once

#include <cstdint>

#include <swiftlet/depth.h>
#include <swiftlet/patch.h>
#include <swiftlet/query.h>

namespace swiftlet::answers {

void visit_proof(const OverlapProof& proof, auto&& fields) {
  fields.count("proof", proof.count);
  for (std::uint32_t k = 0; k < proof.count; ++k) {
    fields.element("proof", k);
    fields.pair("vertex_a", proof.vertex_a[k], "vertex_b", proof.vertex_b[k]);
  }
  fields.element();
}

/// What Answer and SignedAnswer have in common.
void visit_common(const auto& answer, auto&& fields) {
  fields.pair("status", answer.status, "verdict", answer.verdict);
  fields.number("lower", answer.lower), fields.number("upper", answer.upper);
  fields.numbers("normal", answer.normal);
  fields.numbers("point_a", answer.point_a), fields.numbers("point_b", answer.point_b);
  fields.pair("level_a", answer.level_a, "level_b", answer.level_b);
  fields.handle("feature_a", answer.feature_a), fields.handle("feature_b", answer.feature_b);
  visit_proof(answer.proof, fields);
  fields.pair("steps", answer.steps, "plane_tests", answer.plane_tests);
}

void visit(const SignedAnswer& answer, auto&& fields) { visit_common(answer, fields); }

void visit(const Answer& answer, auto&& fields) {
  visit_common(answer, fields);
  fields.count("levels_visited", std::uint32_t(answer.levels_visited));
}

void visit(const Patch& patch, auto&& fields) {
  fields.numbers("normal", patch.normal);
  fields.handle("face_a", patch.face_a), fields.handle("face_b", patch.face_b);
  fields.count("points", patch.count);
  for (std::uint32_t i = 0; i < patch.count; ++i) {
    const PatchPoint& p = patch.points[i];
    fields.element("point", i);
    fields.numbers("point_a", p.point_a), fields.numbers("point_b", p.point_b);
    fields.number("separation", p.separation);
    fields.handle("feature_a", p.feature_a), fields.handle("feature_b", p.feature_b);
  }
  fields.element();
}

}  // namespace swiftlet::answers
