// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// From level pair to finer level pair, until the question is answered [Ehmann & Lin 2000, sec. 5.2].
#pragma once

#include <swiftlet/query.h>

namespace swiftlet {

/// The question: an interval narrow enough, or a threshold passed.
struct Target {
  double absolute, relative;
  double clear_above;   ///< answered when lower > this
  double hit_below;     ///< answered when upper <= this
  double zero = 0;      ///< the hulls' distance that `relative` counts from, where the bodies touch
  double rounding = 0;  ///< by so much narrower than `absolute` and `relative` say
  double exact = 0;     ///< an earlier answer is exact where it is this narrow, or within law 2's bound of the hulls
  bool is_threshold() const { return clear_above < std::numeric_limits<double>::infinity(); }
};

/// From the seed, or on from `so_far`, an answer about the hulls of these models in this pose.
Answer descend(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
               const Target& target, const Answer* so_far = nullptr);

}  // namespace swiftlet
