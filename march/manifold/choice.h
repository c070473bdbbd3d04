// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Which corners of a common area a manifold gets.
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

/// One of least separation, which comes first, then whichever adds most to the area, those of `previous` before others; then
/// each but the first gives way to one that adds distinctly more. What is chosen depends on nothing but the first and which are
/// there, and stays what it is when asked again: all that changes them lets their area grow. What stands out by no more than
/// `bound` adds nothing. Cost: 32 times the candidates.
Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound);

}  // namespace swiftlet
