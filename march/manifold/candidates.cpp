// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Of too many corners the one is left out that takes the least area with it [Visvalingam & Whyatt 1993].
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

bool is_same(const ManifoldPoint& point, const Candidate& candidate) {
  return point.feature_a == candidate.feature_a && point.feature_b == candidate.feature_b;
}

void Candidates::add(Border border, const Candidate& candidate) {
  if (!(candidate.separation <= farthest_)) return;
  if (candidate.separation < deepest_)
    deepest_ = candidate.separation, deepest_a_ = candidate.feature_a, deepest_b_ = candidate.feature_b;
  int& count = count_[std::size_t(border)];
  if (count_[0] + count_[1] == kMostCorners) {
    if (replaces_last(border, candidate))
      --count;
    else
      thin();
  }
  at(border == Border::Left ? count : kMostCorners - 1 - count) = candidate;
  ++count;
}

bool Candidates::is_known(int i) const {
  const auto first = previous_.points.begin();
  return std::any_of(first, first + std::min(previous_.count, kMostManifoldPoints),
                     [&](const ManifoldPoint& p) { return is_same(p, (*this)[i]); });
}

bool Candidates::may_be_left_out(int i) const {
  const bool is_deepest = (*this)[i].feature_a == deepest_a_ && (*this)[i].feature_b == deepest_b_;
  return !is_deepest && !is_known(i);
}

/// Whether of all that may be left out the last of a border takes the least area with it.
bool Candidates::replaces_last(Border border, const Candidate& candidate) const {
  if (count_[std::size_t(border)] < 2) return false;
  const int last = border == Border::Left ? count_[0] - 1 : kMostCorners - count_[1], step = border == Border::Left ? 1 : -1;
  const double area = twice_area((*this)[last - step].on_a, (*this)[last].on_a, candidate.on_a);
  return area < next_area_ && may_be_left_out(last);
}

/// The ends of both borders, the least separation and the known ones stay.
void Candidates::thin() {
  const int left = count_[0], right = kMostCorners - count_[1];
  double least = std::numeric_limits<double>::infinity();
  int flattest = 0;
  next_area_ = least;
  const auto look = [&](int first, int last) {
    for (int i = first + 1; i + 1 < last; ++i) {
      const double area = twice_area((*this)[i - 1].on_a, (*this)[i].on_a, (*this)[i + 1].on_a);
      if (area >= next_area_ || !may_be_left_out(i)) continue;
      next_area_ = max(least, area);
      if (area < least) least = area, flattest = i;
    }
  };
  look(0, left), look(right, kMostCorners);
  if (flattest < left)
    std::move(all_.begin() + flattest + 1, all_.begin() + left, all_.begin() + flattest);
  else
    std::move_backward(all_.begin() + right, all_.begin() + flattest, all_.begin() + flattest + 1);
  --count_[flattest < left ? 0 : 1];
}

void Candidates::close() {
  std::move(all_.end() - count_[1], all_.end(), all_.begin() + count_[0]);
  count_ = {count_[0] + count_[1], 0};
}

double Candidates::least() const {
  double least = all_[0].separation;
  for (int i = 1; i < count(); ++i) least = min(least, all_[std::size_t(i)].separation);
  return least;
}

}  // namespace swiftlet
