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

/// Chooses a candidate of least separation, which comes first, then those that `previous` names, then those that add most to
/// the area. Where the largest polygon of `most` candidates has more area than these by `kKeptWorth`, it is chosen instead, and
/// it always is where `previous` names none. The same candidates are chosen when `previous` is the result. A candidate that
/// stands out by no more than `bound` adds nothing. Cost: `most` times the square of the candidates' number.
Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound);

}  // namespace swiftlet
