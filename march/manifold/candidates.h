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

/// A possible point of the manifold, projected.
struct Candidate {
  Vec on_a;           ///< the point of A
  double separation;  ///< by which B's point is farther along the normal
  FeatureId feature_a, feature_b;
};

/// Whether two points, of this manifold or the one before, have the same names.
static inline bool is_same(const auto& point, const auto& other) {
  return point.feature_a == other.feature_a && point.feature_b == other.feature_b;
}

inline constexpr int kMostCandidates = kMostCorners + int(kMostManifoldPoints);

/// All corners of an area or, of more than `kMostCorners`, as many that hold most of it, the deepest among them. The corners
/// that `previous` names come in addition, so that what stays does not depend on them.
class Candidates {
 public:
  /// Corners with a separation above `farthest` are left out.
  Candidates(double farthest, const Manifold& previous) : farthest_(farthest), previous_(previous) {}

  /// Adds the corner that follows on a border, which is seen from below to above, unless one with its names is kept already:
  /// sides that are nearly parallel may pass the lead twice, and a corner may come as a crossing near it and as itself.
  void add(Border border, const Candidate& candidate);
  /// Joins both borders into one row around the area, and drops the corners that `previous` names and that are in the row.
  void close();
  /// Adds a point deeper than all corners, after `close`; it takes the place of the corners with its names.
  void add_deepest(const Candidate& candidate);

  /// After `close`: the candidates are the row, then the corners that `previous` names.
  int count() const { return count_[0] + known_count_; }
  const Candidate& operator[](int i) const { return i < count_[0] ? at(i) : known_[std::size_t(i - count_[0])]; }
  bool is_known(const Candidate& candidate) const;  ///< whether `previous` names it
  double least() const { return deepest_; }         ///< the least separation of all that were added

 private:
  const Candidate& at(int i) const { return all_[std::size_t(i)]; }
  bool has_named(const Candidate& candidate) const;  ///< whether a corner with its names is kept
  bool replaces_last(Border border, const Candidate& candidate);
  bool is_deepest(int i) const { return is_same(at(i), deepest_named_); }
  void thin();

  const double farthest_;
  const Manifold& previous_;
  double deepest_ = std::numeric_limits<double>::infinity();
  struct {
    FeatureId feature_a, feature_b;
  } deepest_named_;         ///< names of the first corner with that separation
  double next_area_ = 0;    ///< at most the area that any corner takes with it which `thin` may leave out
  double cut_off_[2] = {};  ///< the area that the last chord of each border has cut off
  int count_[2] = {}, known_count_ = 0;
  std::array<Candidate, kMostCorners> all_;  ///< the left border from the start, the right one from the end back
  std::array<Candidate, kMostManifoldPoints> known_;
};

}  // namespace swiftlet
