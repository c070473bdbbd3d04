// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The depth of the overlap of one level pair: what is asked of it (`DepthGoal`), where the search begins (`DepthStart`) and
// what is found (`Depth`).
#pragma once

#include <array>
#include <cstdint>

#include "numeric/vec.h"
#include "pair/certify.h"
#include "pair/stop_rule.h"

namespace swiftlet {

/// When bounds `lower` and `upper` on the depth of the level pair are good enough.
struct DepthGoal {
  /// `asked` is about the exact hulls, whose depth is less by at most `of_error`. `law_two` is that of the level pair.
  DepthGoal(const StopRule& asked, double law_two, double of_error, bool finest, double of_floor)
      : stop(asked.at_least(law_two)), error(of_error), is_finest(finest), floor(of_floor) {
    stop.zero += error, stop.rounding += error, stop.above += error;
  }

  StopRule stop;
  double error;    ///< 0 if the levels are the exact hulls
  bool is_finest;  ///< no finer level pair follows: the depth of this one is found, also where that is not as precise as asked
  /// Used in place of a `lower` of 0 or less: a lower bound that is known otherwise, or one below which nothing is asked.
  double floor;
  std::uint32_t step_budget = ~0u;  ///< the most supports to compute

  bool narrow(double lower, double upper) const { return stop.narrow(lower > 0 ? lower : floor, upper); }
  bool passed(double lower, double upper) const { return stop.passed(lower, upper); }
  /// True if no lower bound on this level pair can suffice, because its `error` takes up the width that is allowed.
  bool is_too_coarse(double upper) const { return error > 0 && stop.allowed(upper) <= stop.least && upper <= stop.above; }
  /// True if no bounds on it can, and a finer level pair follows.
  bool hopeless(double lower, double upper) const { return !is_finest && is_too_coarse(upper) && lower >= stop.below; }
  /// True if a facet of the Minkowski difference is wanted, with its points. Where a finer level pair follows, bounds suffice.
  bool wants_facet() const { return error == 0 || is_finest; }
};

/// Where the search begins: up to four vertex pairs, ideally those whose differences are the corners of a facet of the
/// Minkowski difference, in order around it, and a direction of any length.
struct DepthStart {
  int count = 0;
  std::array<std::uint32_t, 4> a{}, b{};
  Vec direction{0, 0, 0};          ///< from A to B
  FeatureId feature_a, feature_b;  ///< features whose vertices make the pairs; None: not named
};

enum class DepthEnd : std::uint8_t {
  Converged,  ///< the bounds are as narrow as the goal asks, or past one of its thresholds
  Apart,      ///< a direction separates the bodies: upper < 0
  Budget,
  NotConverged,  ///< the bounds are true but wider than asked
};

/// Bounds on the depth: the least height h(n) of the Minkowski difference {p - q} over all unit n. It is below 0 if the bodies
/// are apart.
struct Depth {
  DepthEnd end = DepthEnd::NotConverged;
  double lower = 0;                        ///< proved if it is above 0
  double upper = kInfinity;                ///< proved by the supports along `normal`
  Vec normal{0, 0, 0};                     ///< unit, from A to B: B is free when moved along it by `upper`
  Vec point_a{0, 0, 0}, point_b{0, 0, 0};  ///< witness points: point_a - point_b is the depth times `normal`
  ActiveSet active;                        ///< the vertex pairs and weights that make the points
  FeatureId feature_a, feature_b;          ///< features that hold the points, if the start named them
  std::uint32_t steps = 0;                 ///< number of supports computed
};

}  // namespace swiftlet
