// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The corners of a common area that a manifold may be made of: all of them or, of many, those that hold most of the area.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <swiftlet/manifold.h>

#include "numeric/tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The borders of an area between its lowest and its highest corner.
enum class Border : std::uint8_t { Left, Right };

/// A place of contact as a projection shows it.
struct Candidate {
  Vec on_a;           ///< z along the normal
  double separation;  ///< of the point of B that is seen there
  FeatureId feature_a, feature_b;
};

bool is_same(const ManifoldPoint& point, const Candidate& candidate);

class Candidates {
 public:
  /// Candidates farther apart than `farthest` are left out; those that `previous` names are kept, whatever they hold.
  Candidates(double farthest, const Manifold& previous) : farthest_(farthest), previous_(previous) {}

  /// The corner of a border after those that were added to it before.
  void add(Border border, const Candidate& candidate);
  /// Makes one row of both borders, around the area; what is added then belongs to neither.
  void close();

  int count() const { return count_[0]; }
  const Candidate& operator[](int i) const { return all_[std::size_t(i)]; }
  bool is_known(int i) const;  ///< to the manifold before; cost: its points
  double least() const;        ///< separation; of one candidate at least

 private:
  bool replaces_last(Border border, const Candidate& candidate) const;
  void thin();

  Candidate& at(int i) { return all_[std::size_t(i)]; }
  bool may_be_left_out(int i) const;

  const double farthest_;
  const Manifold& previous_;
  double deepest_ = std::numeric_limits<double>::infinity();  ///< separation of the first of the least
  FeatureId deepest_a_, deepest_b_;                           ///< and its features
  double next_area_ = 0;  ///< no candidate that may be left out takes less with it, but for the last ones
  std::array<int, 2> count_{};
  std::array<Candidate, kMostCorners> all_;  ///< the left border from the start, the right one from the end back
};

}  // namespace swiftlet
