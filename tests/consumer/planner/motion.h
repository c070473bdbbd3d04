// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether an arm gets from one set of angles to another without nearing an obstacle: continuous, by conservative advancement.
// Knows nothing of planners.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/query.h>

#include "arm.h"

namespace planner {

/// What was asked, and its work.
struct Cost {
  std::uint64_t queries = 0, refined = 0, steps = 0, plane_tests = 0;
};

/// How precise a distance is that decides nothing.
struct Precision {
  double tolerance = 0.1;    ///< relative
  bool only_nearest = true;  ///< of pairs that allow a longer way than others do nothing more is asked
};

class Motions {
 public:
  explicit Motions(const Scene& scene, const Precision& precision = {})
      : scene_(scene), precision_(precision), seeds_(2 * scene.obstacles.size()) {}

  /// Nowhere on the way, each angle turning steadily, does a link come into an obstacle's margin; where it comes within
  /// `kLeastRoom` of that, it may be refused.
  bool are_free(const Angles& from, const Angles& to);

  const Cost& cost() const { return cost_; }

  static constexpr double kMargin = 0.02, kLeastRoom = 0.01;

 private:
  double room(const swiftlet::Model& link, const Obstacle& obstacle, const swiftlet::Pose& link_in_world, double enough,
              swiftlet::PairSeed& seed);
  void count(const swiftlet::Answer& answer);

  const Scene& scene_;
  Precision precision_;
  std::vector<swiftlet::PairSeed> seeds_;  ///< one per pair
  Cost cost_;
};

}  // namespace planner
