// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Chooses the few points of a manifold among its candidates.
#pragma once

#include <array>

#include "manifold/candidates.h"

namespace swiftlet {

/// Indices of candidates, around the area.
class Chosen {
 public:
  void add(int i) { index_[std::size_t(count_++)] = i; }
  const int* begin() const { return index_.data(); }
  const int* end() const { return index_.data() + count_; }

 private:
  int count_ = 0;
  std::array<int, kMostManifoldPoints> index_;
};

/// Chooses a candidate of least separation, then those that `previous` names, then those that add most to the area. A candidate
/// that `previous` names counts as one of least separation within `slack` of it: at rest others take turns. The largest polygon
/// of `most` candidates is chosen instead if its area is larger by more than `kKeptWorth`, or if it is larger at all and
/// `previous` names no candidate. The result begins with the candidate of least separation. If `previous` is the result, the
/// same candidates are chosen again. A candidate that stands out by no more than `bound` adds nothing. Cost: `most` times the
/// square of the candidates' number.
Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound, double slack);

}  // namespace swiftlet
