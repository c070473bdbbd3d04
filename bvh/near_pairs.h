// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// All pairs of triangles of two trees whose boxes are within reach of each other, nearest boxes first, as far as nobody skips
// them.
#pragma once

#include "boxes.h"
#include "mesh_setting.h"
#include "node_pair.h"
#include "triangle_names.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

class NearPairs {
 public:
  /// Finds what is within `reach` of the surfaces. Boxes are grown by that and by law 2's bound.
  NearPairs(const MeshSetting& at, double reach)
      : a_(at.a),
        b_(at.b),
        motion_(at.motion),
        reach_(reach),
        unit_(unit_of_pair(a_.root->unit, b_.root->unit, motion_.t)),
        frame_(motion_, a_.root->unit, b_.root->unit, unit_, {0, 0, 0}),
        reach_over_unit_(times_power_of_two(reach, -unit_)),
        reach_of_boxes_(reach_over_unit_ < 1e30 ? float(reach_over_unit_ * (1 + kFloatUp)) : HUGE_VALF),
        growth_(reach + at.law_two) {}

  double reach() const { return reach_; }
  /// A direction that parted triangles: it may part boxes too.
  void look(const Vec& n) { frame_.look(n); }

  /// Both boxes of a pair along A's axes, each grown. What a pair within reach has of its nearest points lies in both.
  struct Boxes {
    Box a, b;
  };

  /// Calls `visitor.skips(boxes, lower)` for each pair of nodes, whose distance is at least `lower`, to leave it out, and
  /// `visitor.visit(a, b, lower)` for each pair of triangles that is left. Goes on while `visitor.goes_on()`. Returns a lower
  /// bound on the distance of what was not visited for that, infinite if that is nothing.
  template <class Visitor>
  double run(Visitor& visitor) {
    top_ = 0;
    stack_[top_++] = {0, 0, 0};
    while (top_ > 0 && visitor.goes_on()) open(stack_[--top_], visitor);
    double left = HUGE_VAL;
    for (int i = 0; i < top_; ++i) left = min(left, bound_of(stack_[i]));
    return left;
  }

  /// The boxes of two triangles; of a convex body its own.
  Boxes boxes(std::uint32_t of_a, std::uint32_t of_b) const {
    return {box_around(a_, of_a, kAtRest), box_around(b_, of_b, motion_)};
  }

 private:
  double bound_of(const PairEntry& entry) const { return times_power_of_two(double(entry.lower), unit_); }

  template <class Visitor>
  void open(const PairEntry& entry, Visitor& visitor) {
    const Node &a = a_.nodes[entry.a], &b = b_.nodes[entry.b];
    if (visitor.skips({box_around(a_, a, kAtRest), box_around(b_, b, motion_)}, bound_of(entry))) return;
    NodePair pair(frame_, a, b);
    const float most = pair.square_of(reach_of_boxes_);
    if (!(pair.square() <= most)) return;
    const bool lowest = a.lowest() && b.lowest();
    const int bottom = top_;
    top_ += open_pair(pair, most, reach_over_unit_, {entry.a, entry.b}, {a.lowest(), b.lowest()}, stack_ + top_);
    if (!lowest) return;
    while (top_ > bottom && visitor.goes_on()) {
      const PairEntry next = stack_[--top_];
      visitor.visit(next.a, next.b, bound_of(next));
    }
  }

  /// The box along A's axes of all that a node holds, made larger by what its triangles' own boxes are.
  Box box_around(const MeshView& of, const Node& node, const Motion& in_a) const {
    const double unit = power_of_two(of.root->unit);
    const Axes axes = axes_of(node);
    const Vec middle = apply(in_a, Vec{node.origin[0], node.origin[1], node.origin[2]} * unit);
    Vec half{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const Vec along = rotate(in_a, axes.row[k]);
      half = half + Vec{std::fabs(along.x), std::fabs(along.y), std::fabs(along.z)} * (node.extent[k] * unit);
    }
    const double size = (double(node.extent[0]) + node.extent[1] + node.extent[2]) * unit;
    return grown({middle - half, middle + half}, growth_ + kNodeBoxShare * size);
  }
  Box box_around(const MeshView& of, std::uint32_t triangle, const Motion& in_a) const {
    if (!of.triangles) return box_around(of, *of.nodes, in_a);
    Vec p[3];
    corners(of, triangle, p);
    for (Vec& corner : p) corner = apply(in_a, corner);
    return grown({least_of(least_of(p[0], p[1]), p[2]), most_of(most_of(p[0], p[1]), p[2])}, growth_);
  }

  const MeshView &a_, &b_;
  const Motion& motion_;
  const double reach_;
  const int unit_;  ///< exponent of the pair's unit
  PairFrame frame_;
  const double reach_over_unit_;
  const float reach_of_boxes_;  ///< the same, rounded up
  const double growth_;
  int top_ = 0;
  PairEntry stack_[kMostEntries];
};

}  // namespace
}  // namespace swiftlet
