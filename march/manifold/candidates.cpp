// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// If there are too many corners, the one whose removal takes the least area is left out [Visvalingam & Whyatt 1993].
#include "manifold/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

double twice_area(const Vec& p, const Vec& q, const Vec& r) {
  return std::fabs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
}

}  // namespace

void Candidates::add(Border border, const Candidate& candidate) {
  if (!(candidate.separation <= farthest_) || has_named(candidate)) return;
  if (is_known(candidate) && known_count_ < int(kMostManifoldPoints)) known_[std::size_t(known_count_++)] = candidate;
  if (candidate.separation < deepest_)
    deepest_ = candidate.separation, deepest_named_ = {candidate.feature_a, candidate.feature_b};
  const std::size_t side = std::size_t(border);
  if (count_[0] + count_[1] < kMostCorners) {
    cut_off_[side] = 0;
  } else if (replaces_last(border, candidate)) {
    --count_[side];
  } else {
    thin();
    cut_off_[side] = 0;
  }
  all_[std::size_t(border == Border::Left ? count_[0] : kMostCorners - 1 - count_[1])] = candidate;
  ++count_[side];
}

void Candidates::add_deepest(const Candidate& candidate) {
  bool is_there = false;
  const auto replace = [&](Candidate& other) {
    if (!is_same(candidate, other)) return;
    other = candidate;
    is_there = true;
  };
  std::for_each(all_.begin(), all_.begin() + count_[0], replace);
  std::for_each(known_.begin(), known_.begin() + known_count_, replace);
  if (is_there)
    deepest_ = candidate.separation;
  else
    add(Border::Left, candidate);
}

bool Candidates::has_named(const Candidate& candidate) const {
  for (int i = 0; i < kMostCorners; ++i) {
    const bool is_kept = i < count_[0] || i >= kMostCorners - count_[1];
    if (is_kept && is_same(at(i), candidate)) return true;
  }
  return false;
}

bool Candidates::is_known(const Candidate& candidate) const {
  const auto first = previous_.points.begin();
  return std::any_of(first, first + std::min(previous_.count, kMostManifoldPoints),
                     [&](const ManifoldPoint& p) { return is_same(p, candidate); });
}

/// Returns true if of all corners that may be left out the last one of a border takes the least area. The area that the chord
/// to it has cut off before counts, since close corners take little each.
bool Candidates::replaces_last(Border border, const Candidate& candidate) {
  const std::size_t side = std::size_t(border);
  if (count_[side] < 2) return false;
  const int last = border == Border::Left ? count_[0] - 1 : kMostCorners - count_[1], step = border == Border::Left ? 1 : -1;
  const double area = cut_off_[side] + twice_area(at(last - step).on_a, at(last).on_a, candidate.on_a);
  if (!(area < next_area_) || is_deepest(last)) return false;
  cut_off_[side] = area;
  return true;
}

/// Leaves out the corner that takes the least area with it. The last ones of both borders and the deepest corner stay.
void Candidates::thin() {
  const int left = count_[0], right = kMostCorners - count_[1];
  double least = std::numeric_limits<double>::infinity();
  int flattest = 0;
  next_area_ = least;
  const auto consider = [&](int below, int i, int above) {
    const double area = twice_area(at(below).on_a, at(i).on_a, at(above).on_a);
    if (area >= next_area_ || is_deepest(i)) return;
    next_area_ = max(least, area);
    if (area < least) least = area, flattest = i;
  };
  // The borders meet below.
  for (int i = right == kMostCorners; i + 1 < left; ++i) consider(i == 0 ? kMostCorners - 1 : i - 1, i, i + 1);
  for (int i = kMostCorners - 1 - (left == 0); i > right; --i) consider(i + 1 == kMostCorners ? 0 : i + 1, i, i - 1);
  if (flattest < left)
    std::move(all_.begin() + flattest + 1, all_.begin() + left, all_.begin() + flattest);
  else
    std::move_backward(all_.begin() + right, all_.begin() + flattest, all_.begin() + flattest + 1);
  --count_[flattest < left ? 0 : 1];
}

void Candidates::close() {
  std::move(all_.end() - count_[1], all_.end(), all_.begin() + count_[0]);
  count_[0] += count_[1];
  count_[1] = 0;
  int kept = 0;
  for (int i = 0; i < known_count_; ++i) {
    const Candidate& c = known_[std::size_t(i)];
    const auto is_named_so = [&](const Candidate& other) { return is_same(c, other); };
    if (!has_named(c) && std::none_of(known_.begin(), known_.begin() + kept, is_named_so)) known_[std::size_t(kept++)] = c;
  }
  known_count_ = kept;
}

}  // namespace swiftlet
