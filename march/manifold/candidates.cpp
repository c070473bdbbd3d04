// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// If there are too many corners, those are left out whose chords cut off little: the bound on that grows with the area.
#include "manifold/candidates.h"

#include <algorithm>

namespace swiftlet {

Candidates::Candidates(double farthest, const Manifold& previous) : farthest_(farthest), previous_(previous) {
  for (std::uint32_t i = 0; i < std::min(previous.count, kMostManifoldPoints); ++i) {
    known_bits_[0] |= std::uint64_t(1) << previous.points[i].feature_a.index() % 64;
    known_bits_[1] |= std::uint64_t(1) << previous.points[i].feature_b.index() % 64;
  }
}

void Candidates::add(Border border, const Candidate& candidate, bool wanted) {
  if (!(candidate.separation <= farthest_) || has_named(candidate)) return;
  const bool knows = known_count_ < int(kMostManifoldPoints) && is_known(candidate);
  if (knows) known_[std::size_t(known_count_++)] = candidate;
  if (knows || wanted) least_ = min(least_, candidate.separation);
  if (wanted) append(border, candidate);
}

void Candidates::append(Border border, const Candidate& candidate) {
  if (candidate.separation < deepest_)
    deepest_ = candidate.separation, deepest_named_ = {candidate.feature_a, candidate.feature_b};
  if (count_[0] + count_[1] == kMostCorners) thin();
  const std::size_t side = std::size_t(border);
  row(border, count_[side]++) = candidate;
  name_bits_ |= name_bit(candidate);
  last_[side] = {border == Border::Left ? -candidate.on_a.x : candidate.on_a.x, candidate.on_a.y}, cut_off_[side] = 0;
}

void Candidates::add_deepest(const Candidate& candidate) {
  if (!(candidate.separation <= farthest_)) return;
  bool is_there = false;
  const auto replace = [&](Candidate& other) {
    if (!is_same(candidate, other)) return;
    other = candidate;
    is_there = true;
  };
  std::for_each(all_.begin(), all_.begin() + count_[0], replace);
  std::for_each(known_.begin(), known_.begin() + known_count_, replace);
  least_ = candidate.separation;
  if (!is_there) append(Border::Left, candidate);
}

bool Candidates::has_named(const Candidate& candidate) const {
  if (!(name_bits_ & name_bit(candidate))) return false;
  const auto is_named_so = [&](const Candidate& other) { return is_same(candidate, other); };
  return std::any_of(all_.begin(), all_.begin() + count_[0], is_named_so) ||
         std::any_of(all_.end() - count_[1], all_.end(), is_named_so);
}

bool Candidates::is_known(const Candidate& candidate) const {
  if (!may_know(0, candidate.feature_a.index()) || !may_know(1, candidate.feature_b.index())) return false;
  const auto first = previous_.points.begin();
  return std::any_of(first, first + std::min(previous_.count, kMostManifoldPoints),
                     [&](const ManifoldPoint& p) { return is_same(p, candidate); });
}

/// Leaves out corners, until a quarter of the room is free, by chords that cut off ever more.
void Candidates::thin() {
  is_crowded_ = true;
  const Place lowest = row(count_[0] > 0 ? Border::Left : Border::Right, 0).place();
  double area = 0;
  for (const Border border : {Border::Left, Border::Right}) {
    for (int i = 1; i < count_[std::size_t(border)]; ++i)
      area += std::fabs(cross(row(border, i - 1).place() - lowest, row(border, i).place() - lowest));
  }
  do {
    name_bits_ = 0;
    enough_ = max(kChordGrowth * enough_, area * kLeastChord);
    thin(Border::Left, lowest, true), thin(Border::Right, lowest, count_[0] == 0);
  } while (count_[0] + count_[1] > kMostCorners * 3 / 4);
}

/// The deepest corner and the border's last one stay.
void Candidates::thin(Border border, Place last, bool keeps_first) {
  int& count = count_[std::size_t(border)];
  int kept = 0;
  double cut_off = 0;
  for (int i = 0; i < count; ++i) {
    const Candidate& c = row(border, i);
    if ((i > 0 || !keeps_first) && i + 1 < count) {
      cut_off += std::fabs(cross(c.place() - last, row(border, i + 1).place() - last));
      if (cut_off <= enough_ && !is_same(c, deepest_named_)) continue;
    }
    last = c.place(), cut_off = 0;
    name_bits_ |= name_bit(c);
    if (kept++ != i) row(border, kept - 1) = c;
  }
  count = kept;
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
