// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How far points lie off a solid, in doubles: to choose a level by. The deviations that models state are proved elsewhere.
#pragma once

#include <memory>
#include <span>

#include <swiftlet/executor.h>

#include "polytope.h"

namespace swiftlet::lod {

class Deviation {
 public:
  /// Keeps a copy of the surface.
  explicit Deviation(const Polytope& body);
  ~Deviation();
  /// The greatest distance from the surface. Quick where points beside each other in the list are near each other.
  double operator()(std::span<const Vec3> points, const Executor& executor = {}) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace swiftlet::lod
