// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Regions of contact: boxes that do not meet, each with its nearest pair so far. Which boxes they are at last does not depend
// on the order in which places come: joining two that meet is forced, whenever it is done. Knows no trees and no triangles.
#pragma once

#include <array>
#include <cstdint>
#include <new>
#include <span>

#include <swiftlet/mesh_contacts.h>

#include "boxes.h"

namespace swiftlet {

class Regions {
 public:
  /// `room` holds the first regions, and room of this object's own the others.
  explicit Regions(std::span<MeshContact> room) : room_(room) {}
  Regions(const Regions&) = delete;
  Regions& operator=(const Regions&) = delete;

  std::size_t size() const { return size_; }
  bool overflowed() const { return overflowed_; }  ///< regions that do not meet were joined
  MeshContact& operator[](std::size_t i) { return i < room_.size() ? room_[i] : spare_[i - room_.size()].contact; }

  /// The region whose box holds `place`; null if there is none.
  MeshContact* holding(const Box& place) {
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t at = last_ + i < size_ ? last_ + i : last_ + i - size_;
      if (holds(box_of((*this)[at]), place)) return last_ = at, &(*this)[at];
    }
    return nullptr;
  }

  /// Joins `place` with the regions that it meets, and these with those that they then meet. Returns the region that holds it,
  /// a new one if it meets none.
  MeshContact& add(const Box& place) {
    Box box = place;
    std::size_t into = kNowhere;
    if (meets_none(box)) {
      if (size_ == room_.size() + kSpareRegions) {
        overflowed_ = true;
        into = nearest(box);
        box = around(box, box_of((*this)[into]));
      } else {
        into = size_++;
        if (into >= room_.size()) new (&spare_[into - room_.size()].contact) MeshContact;
        (*this)[into] = {};
        (*this)[into].lower = HUGE_VAL;
      }
    }
    for (std::size_t i = 0; i < size_;) {
      if (i == into || !meet(box, box_of((*this)[i]))) {
        ++i;
        continue;
      }
      box = around(box, box_of((*this)[i]));
      if (into == kNowhere) {
        into = i;
      } else {
        join((*this)[into], (*this)[i]);
        if (into == --size_) into = i;
        if (i != size_) (*this)[i] = (*this)[size_];
      }
      i = 0;
    }
    last_ = into;
    MeshContact& region = (*this)[into];
    region.box_min = eigen(box.least), region.box_max = eigen(box.most);
    return region;
  }

  /// Whether the nearest pair of `x` is nearer than that of `y`. Two regions have no pair in common, so one is.
  static bool is_nearer(const MeshContact& x, const MeshContact& y) {
    const bool crosses = x.verdict == Verdict::Overlapping;
    if (crosses != (y.verdict == Verdict::Overlapping)) return crosses;
    if (x.upper != y.upper) return x.upper < y.upper;
    return x.triangle_a != y.triangle_a ? x.triangle_a < y.triangle_a : x.triangle_b < y.triangle_b;
  }
  static Box box_of(const MeshContact& region) { return {vec(region.box_min), vec(region.box_max)}; }

 private:
  static constexpr std::size_t kNowhere = ~std::size_t{0};
  union Spare {
    Spare() {}
    MeshContact contact;
  };

  bool meets_none(const Box& box) {
    for (std::size_t i = 0; i < size_; ++i)
      if (meet(box, box_of((*this)[i]))) return false;
    return true;
  }
  /// The region whose box grows least.
  std::size_t nearest(const Box& box) {
    std::size_t found = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < size_; ++i) {
      const Box region = box_of((*this)[i]);
      if (const double growth = sides(around(box, region)) - sides(region); growth < least) least = growth, found = i;
    }
    return found;
  }
  static void join(MeshContact& into, const MeshContact& other) {
    const double lower = min(into.lower, other.lower);
    if (is_nearer(other, into)) into = other;
    into.lower = lower;
  }

  std::span<MeshContact> room_;
  std::size_t size_ = 0, last_ = 0;
  bool overflowed_ = false;
  std::array<Spare, kSpareRegions> spare_;
};

/// What is asked about the surfaces, without radii.
struct RegionQuestion {
  double reach;
  std::uint32_t steps;  ///< the most pairs of nodes and triangles to look at
};

struct RegionFinding {
  bool cut_short = false;                  ///< the budget ended the search
  bool refused = false;                    ///< the kernel refused a body
  std::uint32_t nodes = 0, triangles = 0;  ///< pairs opened, and looked at
  PairSeed seed{};                         ///< of the kernel's queries
};

}  // namespace swiftlet
