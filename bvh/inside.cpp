// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts the triangles that a ray crosses. The ray is parallel to an axis of the mesh's frame and infinitely little beside the
// point: by epsilon along the next axis and by its square along the third [Edelsbrunner & Muecke 1990]. So it meets no edge and
// no vertex, and each edge is passed on the same side by both of its triangles. Signs are exact.
#include "inside.h"

#include <cmath>

#include "numeric/exact.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {

double coordinate(const Vec& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

struct Enclosure::Ray {
  Vec point;             ///< in its body's frame
  Vec from;              ///< in the mesh's frame, about
  double error;          ///< how far `from` may be off
  int axis = 0;          ///< of the mesh's frame
  double direction = 1;  ///< 1, or -1 if the ray goes backwards
};

Enclosure::Enclosure(const MeshReader::Content& mesh, const Pose& b_in_a, bool is_b)
    : mesh_(mesh),
      motion_(swiftlet::motion(b_in_a)),
      back_(swiftlet::motion(inverse(b_in_a))),
      is_b_(is_b),
      turn_(dot(motion_.row_x, cross(motion_.row_y, motion_.row_z)) > 0 ? 1 : -1) {}

/// False if the point is outside the mesh's box. Else the ray goes where it leaves the box soonest.
bool Enclosure::starts_inside_box(const Vec& point, Ray& ray) const {
  ray.point = point;
  if (is_b_) {
    const Vec way = point - motion_.t;
    ray.from = rotate(back_, way), ray.error = kTurnBackError * norm(way);
  } else {
    ray.from = apply(motion_, point), ray.error = kTurnError * norm(point) + kShiftError * norm(motion_.t);
  }
  double least = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = coordinate(ray.from, axis);
    const double to_least = at - mesh_.header.box_min[axis], to_most = mesh_.header.box_max[axis] - at;
    // The differences are rounded, but never from above 0 to below it.
    if (to_least < -ray.error || to_most < -ray.error) return false;
    if (to_least < least) least = to_least, ray.axis = axis, ray.direction = -1;
    if (to_most < least) least = to_most, ray.axis = axis, ray.direction = 1;
  }
  return true;
}

/// On which side the ray's line passes the line from v to w, seen against the axis: 1 on the left. 0 if v and w are at one
/// place of that view.
int Enclosure::passes(const Ray& ray, const Vec& v, const Vec& w) const {
  // The determinant of v, w and the axis, all from the point: v moved along the axis stands for that.
  Vec along = v;
  const bool down = coordinate(v, ray.axis) > 0;
  (ray.axis == 0 ? along.x : ray.axis == 1 ? along.y : along.z) = down ? -mesh_.root.extent : mesh_.root.extent;
  const std::array<const double*, 3> own{&v.x, &w.x, &along.x}, point{&ray.point.x, &ray.point.x, &ray.point.x};
  // Of B all three differences are turned and negative.
  const int sign = is_b_ ? -turn_ * exact::triple_product(point, own, motion_) : exact::triple_product(own, point, motion_);
  if (sign != 0) return down ? -sign : sign;
  const int x = (ray.axis + 1) % 3, y = (ray.axis + 2) % 3;
  if (coordinate(v, y) != coordinate(w, y)) return coordinate(v, y) > coordinate(w, y) ? 1 : -1;
  return coordinate(v, x) < coordinate(w, x) ? 1 : coordinate(v, x) > coordinate(w, x) ? -1 : 0;
}

bool Enclosure::crosses(const Ray& ray, const Corners& triangle) const {
  const Vec &a = mesh_.vertices[triangle[0]], &b = mesh_.vertices[triangle[1]], &c = mesh_.vertices[triangle[2]];
  const int turn = passes(ray, a, b);
  if (turn == 0 || passes(ray, b, c) != turn || passes(ray, c, a) != turn) return false;
  const std::array<const double*, 3> own{&a.x, &b.x, &c.x}, point{&ray.point.x, &ray.point.x, &ray.point.x};
  // Above 0 where the point is on the side from which the corners are counter-clockwise.
  const int side = is_b_ ? turn_ * exact::triple_product(point, own, motion_) : -exact::triple_product(own, point, motion_);
  return side * turn * ray.direction < 0;
}

bool Enclosure::holds_without_tree(const Vec& point) const {
  Ray ray;
  if (!starts_inside_box(point, ray)) return false;
  bool inside = false;
  for (const Corners& triangle : mesh_.triangles) inside ^= crosses(ray, triangle);
  return inside;
}

bool Enclosure::holds(const Vec& point) const {
  Ray ray;
  if (!starts_inside_box(point, ray)) return false;
  const Vec from = scaled(ray.from, -mesh_.header.unit);
  const double slack = times_power_of_two(ray.error, -mesh_.header.unit) * (1 + kAxisError) + kRayError;
  bool inside = false;
  constexpr int kMostEntries = (kFanOut - 1) * kMostDepth + 1;
  std::uint32_t stack[kMostEntries];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = mesh_.nodes[stack[--top]];
    const Axes axes = axes_of(node);
    const Vec start = axes.along(from - Vec{node.origin[0], node.origin[1], node.origin[2]});
    const double at[3] = {start.x, start.y, start.z};  // the ray's start from the node's origin, along the node's axes
    double along[3];                                   // the ray's direction along them
    for (int k = 0; k < 3; ++k) along[k] = eigen(axes.row[k])[ray.axis] * ray.direction;
    for (int i = 0; i < node.count(); ++i) {
      double off[3], half[3];
      bool meets = true;
      for (int k = 0; k < 3; ++k) {
        off[k] = at[k] - double(node.centre[k][i]), half[k] = double(node.half[k][i]) + slack;
        // The ray comes into the slab between two sides of the box at no time from 0 on.
        if ((off[k] > half[k] && along[k] >= 0) || (off[k] < -half[k] && along[k] <= 0)) meets = false;
      }
      // It is in no two of the slabs at one time. Three intervals that meet two by two have a time in common.
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3;
        if (std::fabs(off[k] * along[l] - off[l] * along[k]) > half[k] * std::fabs(along[l]) + half[l] * std::fabs(along[k]))
          meets = false;
      }
      if (!meets) continue;
      const std::uint32_t child = node.first() + std::uint32_t(i);
      if (node.lowest())
        inside ^= crosses(ray, mesh_.triangles[child]);
      else
        stack[top++] = child;
    }
  }
  return inside;
}

}  // namespace swiftlet
