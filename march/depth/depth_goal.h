// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How deep two polytopes overlap: what is asked of one level pair, where to begin, and what is found.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "numeric/vec.h"
#include "pair/certify.h"

namespace swiftlet {

/// When bounds on the depth say enough. `upper` and `lower` are those of the level pair.
struct DepthGoal {
  double absolute = 0, relative = 0;  ///< lengths, and of the lower bound; law 2's bound is always enough
  double error = 0;  ///< the exact hulls' depth is less by at most this: it counts as width, and takes away from `lower`
  double floor = 0;  ///< at most 0: the depth is not less, or nobody cares; stands for a `lower` that is not above 0
  double deeper = std::numeric_limits<double>::infinity();      ///< enough when lower > this
  double shallower = -std::numeric_limits<double>::infinity();  ///< enough when upper < this
  std::uint32_t step_budget = ~0u;                              ///< supports

  bool suffices(double upper, double lower, double law_two) const {
    return upper - (lower > 0 ? lower : floor) <= max(max(absolute, relative * (lower - error)) - error, law_two);
  }
  bool passed(double upper, double lower) const { return lower - error > deeper || upper < shallower; }
  /// Whether no bounds of this pair can suffice, for its error.
  bool hopeless(double upper, double lower) const {
    return error > 0 && max(absolute, relative * (upper - error)) < error && upper - error <= deeper && lower >= shallower;
  }
};

/// Where to begin: up to four vertex pairs, best those of a facet of the Minkowski difference, in order around it, and a
/// direction, any length.
struct DepthStart {
  int count = 0;
  std::array<std::uint32_t, 4> a{}, b{};
  Vec direction{0, 0, 0};          ///< from A to B
  FeatureId feature_a, feature_b;  ///< what the pairs are of; none where they are of no facet
};

enum class DepthEnd : std::uint8_t {
  Converged,  ///< as narrow as the goal asks, or past one of its thresholds
  Apart,      ///< a direction separates the bodies: upper < 0
  Budget,
  NotConverged,  ///< the bounds are true but wider than asked
};

/// The least of the heights h(n) of the Minkowski difference {p - q} over all unit n: the depth, or where the bodies are apart
/// less than 0.
struct Depth {
  DepthEnd end = DepthEnd::NotConverged;
  double lower = 0;                                        ///< proved where above 0
  double upper = std::numeric_limits<double>::infinity();  ///< proved along `normal`
  Vec normal{0, 0, 0};                                     ///< unit, from A to B: B moves along it by `upper` to be free
  Vec point_a{0, 0, 0}, point_b{0, 0, 0};                  ///< deepest points: they differ by the depth times the normal
  ActiveSet active;                                        ///< whose weights make the points
  FeatureId feature_a, feature_b;                          ///< that hold them, where the start named them
  std::uint32_t steps = 0;                                 ///< supports found
};

}  // namespace swiftlet
