// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The axes along which two triangles can be parted: the normals of both, the cross products of their sides, and, where both lie
// in one plane, the normals of their sides in it [Gottschalk 1996]; and the line of their middles, which is there for any.
// Knows how far B must go along a direction until one of them parts the triangles.
#pragma once

#include "triangle_pair.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

class PairAxes {
 public:
  /// `b` are corners of B in its own frame. `size` is law 2's size.
  PairAxes(const Vec (&a)[3], const Vec (&b)[3], const Motion& b_in_a, double size) : pair_(a, b, b_in_a, size) {
    Vec side_a[3], side_b[3];
    for (int k = 0; k < 3; ++k) side_a[k] = a[(k + 1) % 3] - a[k], side_b[k] = rotate(b_in_a, b[(k + 1) % 3] - b[k]);
    const Vec normal_a = normalised(cross(side_a[0], side_a[1])), normal_b = normalised(cross(side_b[0], side_b[1]));
    add(normal_a), add(normal_b), add(normalised(pair_.between_middles()));
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) add(normalised(cross(side_a[i], side_b[k])));
      add(normalised(cross(normal_a, side_a[i]))), add(normalised(cross(normal_b, side_b[i])));
    }
  }

  /// By how much the triangles overlap along the axis along which they do least; negative if they are apart by as much. The
  /// axis, from A to B. Points in one place have none: then it is 0, and the overlap infinite.
  double least(Vec& axis) const {
    double found = HUGE_VAL;
    axis = {0, 0, 0};
    for (int i = 0; i < count_; ++i) {
      if (ahead_[i] < found) found = ahead_[i], axis = axis_[i];
      if (back_[i] < found) found = back_[i], axis = -axis_[i];
    }
    return found;
  }
  /// How far B must go along a unit direction until an axis parts it from A by `room`, rounded up; infinite if none does so. 0
  /// if they are that far apart.
  double travel(const Vec& n, double room) const {
    double found = HUGE_VAL;
    for (int i = 0; i < count_; ++i) {
      const double slope = dot(axis_[i], n), along = slope > 0 ? ahead_[i] : back_[i];
      if (std::fabs(slope) > kLeastSlope) found = min(found, (along + room) / (std::fabs(slope) - kSlopeError));
    }
    return max(0, found);
  }

 private:
  static constexpr int kMostAxes = 18;

  void add(const Vec& axis) {
    if (!(dot(axis, axis) > 0)) return;
    axis_[count_] = axis;
    const auto [ahead, back] = pair_.gaps(axis);
    ahead_[count_] = -ahead, back_[count_] = -back;
    ++count_;
  }

  TrianglePair pair_;
  int count_ = 0;
  Vec axis_[kMostAxes];
  double ahead_[kMostAxes], back_[kMostAxes];  ///< the overlap along the axis that going ahead, or back, must undo; rounded up
};

}  // namespace
}  // namespace swiftlet
