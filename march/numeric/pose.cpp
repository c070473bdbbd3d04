// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Relative and inverse poses: rotations are inverted, not transposed, and translations subtracted first.
#include <swiftlet/pose.h>

#include "numeric/vec4.h"

namespace swiftlet {
namespace {

/// The matrix inverse, by cofactors.
Motion inverse_rotation(const Motion& m) {
  const Vec cx = cross(m.row_y, m.row_z), cy = cross(m.row_z, m.row_x), cz = cross(m.row_x, m.row_y);
  const double scale = 1 / dot(m.row_x, cx);
  return {Vec{cx.x, cy.x, cz.x} * scale, Vec{cx.y, cy.y, cz.y} * scale, Vec{cx.z, cy.z, cz.z} * scale, {0, 0, 0}};
}

Pose pose(const Motion& turn_only, const Vec& translation) {
  Pose p;
  for (int column = 0; column < 3; ++column) {
    const auto pick = [column](const Vec& row) { return column == 0 ? row.x : column == 1 ? row.y : row.z; };
    p.rotation.col(column) = Vec3(pick(turn_only.row_x), pick(turn_only.row_y), pick(turn_only.row_z));
  }
  p.translation = eigen(translation);
  return p;
}

Motion product(const Motion& a, const Motion& b) {
  const auto row = [&](const Vec& r) { return b.row_x * r.x + b.row_y * r.y + b.row_z * r.z; };
  return {row(a.row_x), row(a.row_y), row(a.row_z), {0, 0, 0}};
}

}  // namespace

Pose relative(const Pose& a_in_world, const Pose& b_in_world) {
  const Motion a = motion(a_in_world), b = motion(b_in_world), back = inverse_rotation(a);
  return pose(product(back, b), rotate(back, b.t - a.t));
}

Pose inverse(const Pose& p) {
  const Motion m = motion(p), back = inverse_rotation(m);
  return pose(back, -rotate(back, m.t));
}

}  // namespace swiftlet
