// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The axes of a node, and its boxes around what lies below its children. Lengths are over the mesh's unit.
#pragma once

#include <cmath>
#include <span>

#include <Eigen/Eigenvalues>

#include "node.h"

namespace swiftlet {

/// Smallest and largest coordinates along axes.
struct Bounds {
  double least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  void add(const Vec& p) {
    const double x[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k) least[k] = min(least[k], x[k]), most[k] = max(most[k], x[k]);
  }
  void add(const Bounds& other) {
    for (int k = 0; k < 3; ++k) least[k] = min(least[k], other.least[k]), most[k] = max(most[k], other.most[k]);
  }
  double side(int k) const { return most[k] - least[k]; }
};

/// The least float that is not below x >= 0. Bits of such floats are in their order.
static inline float rounded_up(double x) {
  const float f = float(x);
  return double(f) < x ? bit_cast<float>(bit_cast<std::uint32_t>(f) + 1) : f;
}

/// The axes of a surface with these second moments, longest first.
static inline Axes principal_axes(const Eigen::Matrix3d& square) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square.trace() > 0 ? Eigen::Matrix3d(square / square.trace())
                                                                                 : Eigen::Matrix3d::Identity());
  const Vec x = vec(Vec3(solver.eigenvectors().col(2))), y = vec(Vec3(solver.eigenvectors().col(1)));
  return {{x, y, cross(x, y)}};
}
/// Gives a node axes, rounded to floats.
static inline void put_axes(const Axes& axes, Node& n) {
  for (int k = 0; k < 2; ++k)
    n.axis[k][0] = float(axes.row[k].x), n.axis[k][1] = float(axes.row[k].y), n.axis[k][2] = float(axes.row[k].z);
}

/// Sets the origin, the extent and the boxes of a node whose children have these bounds along its axes.
static inline void put_boxes(std::span<const Bounds> boxes, const Axes& along, Node& n) {
  Bounds all;
  for (const Bounds& box : boxes) all.add(box);
  double size = 0;
  for (int k = 0; k < 3; ++k) size += all.side(k);
  const double margin = kBoxMargin * (size + norm(Vec{all.least[0], all.least[1], all.least[2]}));
  // The middle in the body's frame: axes are at right angles but for their rounding, which the boxes below know.
  Vec middle{0, 0, 0};
  for (int k = 0; k < 3; ++k) middle = middle + along.row[k] * (all.least[k] + all.side(k) / 2);
  n.origin[0] = middle.x, n.origin[1] = middle.y, n.origin[2] = middle.z;
  const Vec origin = along.along(middle);
  const double shift[3] = {origin.x, origin.y, origin.z};
  for (int k = 0; k < 3; ++k) {
    double extent = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Bounds& box = boxes[i];
      const double least = box.least[k] - shift[k] - margin, over = box.most[k] - shift[k] + margin;
      const float centre = float(least + (over - least) / 2);
      n.centre[k][i] = centre;
      n.half[k][i] = rounded_up(max(over - double(centre), double(centre) - least));
      extent = max(extent, std::fabs(double(centre)) + double(n.half[k][i]));
    }
    n.extent[k] = rounded_up(extent);
  }
}

}  // namespace swiftlet
