// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// If there are too many corners, those are left out whose chords cut off little: the bound on that grows with the area.
#include "manifold/candidates.h"

#include <algorithm>

namespace swiftlet {

Candidates::Candidates(double farthest, const Manifold& previous)
    : farthest_(farthest), previous_count_(int(std::min(previous.count, kMostManifoldPoints))) {
  for (int i = 0; i < previous_count_; ++i) {
    previous_[i] = Names(previous.points[std::size_t(i)]);
    known_name_bits_ |= previous_[i].bit();
  }
}

void Candidates::begin(const PlanePoint& lowest, double enough) {
  is_crowded_ = true, enough_ = enough;
  least_ = deepest_ = kInfinity;
  name_bits_ = 0, known_count_ = 0;
  for (const int side : {0, 1}) cut_off_[side] = 0, count_[side] = 0, has_turned_[side] = false;
  last_[0] = {-lowest.x, lowest.y}, last_[1] = lowest;
}

/// Keeps a corner that `previous` names beside the rows.
void Candidates::keep(Border border, Candidate candidate) {
  least_ = min(least_, candidate.separation);
  const auto end = known_ + known_count_;
  if (std::any_of(known_, end, [&](const Candidate& other) { return other.names == candidate.names; })) return;
  known_border_[known_count_++] = border, *end = candidate;
}

void Candidates::add_deepest(const Candidate& candidate) {
  if (!(candidate.separation <= farthest_)) return;
  const auto end = all_.begin() + count_[0];
  const auto same = std::find_if(all_.begin(), end, [&](const Candidate& other) { return other.names == candidate.names; });
  count_[0] += same == end;
  *same = candidate;
  least_ = candidate.separation;
}

bool Candidates::finds(Names names) const {
  const auto is_named_so = [&](const Candidate& other) { return other.names == names; };
  return std::any_of(all_.begin(), all_.begin() + count_[0], is_named_so) ||
         std::any_of(all_.end() - count_[1], all_.end(), is_named_so);
}

bool Candidates::names_before(Names names) const {
  return std::find(previous_, previous_ + previous_count_, names) != previous_ + previous_count_;
}

/// Leaves out corners, until a quarter of the room is free, by chords that cut off ever more.
void Candidates::thin() {
  is_crowded_ = true;
  const PlanePoint lowest = row(count_[0] > 0 ? Border::Left : Border::Right, 0).place();
  double area = 0;
  for (const Border border : {Border::Left, Border::Right}) {
    PlanePoint before{0, 0};
    for (int i = 0; i < count_[std::size_t(border)]; ++i) {
      const PlanePoint spoke = row(border, i).place() - lowest;
      area += std::fabs(cross(before, spoke)), before = spoke;
    }
  }
  do {
    name_bits_ = 0;
    enough_ = max(kChordGrowth * enough_, area * kLeastChord);
    thin(Border::Left, lowest, true), thin(Border::Right, lowest, count_[0] == 0);
  } while (count_[0] + count_[1] > kMostCorners * 3 / 4);
}

/// The deepest corner and the border's last one stay.
void Candidates::thin(Border border, PlanePoint last, bool keeps_first) {
  const int on = border == Border::Left ? 1 : -1;
  int& count = count_[std::size_t(border)];
  Candidate *c = &row(border, 0), *end = c;
  double cut_off = 0;
  for (int rest = count; rest > 0; --rest, c += on) {
    if (!keeps_first && rest > 1) {
      cut_off += std::fabs(cross(c->place() - last, c[on].place() - last));
      if (cut_off <= enough_ && c->names != deepest_named_) {
        --count;
        if (knows(c->names)) keep(border, *c);
        continue;
      }
    }
    keeps_first = false, last = c->place(), cut_off = 0;
    name_bits_ |= c->names.bit();
    if (end != c) *end = *c;
    end += on;
  }
}

void Candidates::close() {
  for (int i = 0; i < known_count_; ++i) {
    if (has(known_[i].names)) continue;
    const Border border = known_border_[i];
    int at = count_[std::size_t(border)]++;
    for (; at > 0 && row(border, at - 1).place().y > known_[i].place().y; --at) row(border, at) = row(border, at - 1);
    row(border, at) = known_[i];
  }
  std::move(all_.end() - count_[1], all_.end(), all_.begin() + count_[0]);
  count_[0] += count_[1];
  count_[1] = 0;
}

}  // namespace swiftlet
