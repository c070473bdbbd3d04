// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two nodes and the boxes of their children: bounds on the distances of boxes, eight at a time, in floats. A bound is the
// greatest of three: the gaps of two boxes along A's axes, taken together, those along B's, and the gap along one direction
// more, from A's nearest point so far to B's.
#pragma once

#include <array>
#include <utility>

#include "float8.h"
#include "node.h"
#include "numeric/vec4.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

/// The exponent of a pair's unit, from those of both bodies' units.
static inline int unit_of_pair(int of_a, int of_b, const Vec& t) {
  const double length = max_abs(t);
  const int shift = length > 0 ? exponent_of(length) + 1 : -1100, larger = of_a > of_b ? of_a : of_b;
  return shift > larger ? shift : larger;
}

/// A pose as boxes need it. Lengths are over the pair's unit, a power of two that is no less than either body's unit and than
/// the translation, so that no float overflows.
struct PairFrame {
  V3<Vec4> columns;          ///< of R, over 1 / `unit_b`
  Vec4 translation;          ///< over the unit
  Columns rotation, back;    ///< R and its transpose
  double unit_a, unit_b;     ///< the bodies' units, at most 1
  Float4 ahead, ahead_in_b;  ///< a unit direction from A to B, in A's body frame, and R^T times it

  /// `of_a`, `of_b` and `unit` are exponents of the bodies' units and of the pair's.
  PairFrame(const Motion& m, int of_a, int of_b, int unit, const Vec& direction)
      : translation(vec4(scaled(m.t, -unit))), unit_a(power_of_two(of_a - unit)), unit_b(power_of_two(of_b - unit)) {
    columns = {vec4(m.row_x.x, m.row_y.x, m.row_z.x) * unit_b, vec4(m.row_x.y, m.row_y.y, m.row_z.y) * unit_b,
               vec4(m.row_x.z, m.row_y.z, m.row_z.z) * unit_b};
    const auto rounded = [](const Vec& v) { return float4(float(v.x), float(v.y), float(v.z)); };
    back = {rounded(m.row_x), rounded(m.row_y), rounded(m.row_z)};
    rotation = Columns::of_rows(back.x, back.y, back.z);
    look(direction);
  }
  void look(const Vec& direction) {
    ahead = float4(float(direction.x), float(direction.y), float(direction.z));
    ahead_in_b = back * ahead;
  }
};

/// A matrix twice, which times two vectors is two vectors.
struct Twice {
  Float8 x, y, z;
  explicit Twice(const Columns& m) : x(joined(m.x, m.x)), y(joined(m.y, m.y)), z(joined(m.z, m.z)) {}
  Float8 operator*(Float8 v) const { return x * lanes<0>(v) + y * lanes<1>(v) + z * lanes<2>(v); }
};

class NodePair {
 public:
  NodePair(const PairFrame& frame, const Node& a, const Node& b)
      : a_(a), b_(b), unit_a_(float(frame.unit_a)), unit_b_(float(frame.unit_b)), direction_(frame.ahead) {
    const Float4 x_a = load4(a.axis[0]), y_a = load4(a.axis[1]), x_b = load4(b.axis[0]), y_b = load4(b.axis[1]);
    const Columns of_a = Columns::of_rows(x_a, y_a, cross(x_a, y_a)), of_b = Columns::of_rows(x_b, y_b, cross(x_b, y_b));
    const Twice twice_a(of_a), twice_b(of_b);
    const V3<Vec4>& r = frame.columns;
    const Vec4 at_b = (r.x * b.origin[0] + r.y * b.origin[1] + r.z * b.origin[2]) + frame.translation;
    const Float4 offset = float4(at_b - vec4(a.origin[0], a.origin[1], a.origin[2]) * frame.unit_a);
    const Float8 x_y = twice_a * (Twice(frame.rotation) * joined(x_b, y_b));
    const Float8 z_offset = twice_a * joined(frame.rotation * cross(x_b, y_b), offset);
    const Float8 offset_ahead = twice_b * joined(frame.back * offset, frame.ahead_in_b);
    m_[0] = low(x_y), m_[1] = high(x_y), m_[2] = low(z_offset);
    offset_a_ = high(z_offset), offset_b_ = low(offset_ahead);
    ahead_a_ = of_a * frame.ahead, ahead_b_ = high(offset_ahead);
    extent_a_ = load4(a.extent) * unit_a_, extent_b_ = load4(b.extent) * unit_b_;
    const Float4 lengths = sums(extent_a_, extent_b_, abs(offset));
    size_a_ = lengths[0], size_b_ = lengths[1];
    slack_ = kBoxSlack * (size_a_ + size_b_ + lengths[2]) + kLeastBoxSlack;
    const Float4 x = abs(m_[0]), y = abs(m_[1]), z = abs(m_[2]);
    extent_b_in_a_ = x * lane<0>(extent_b_) + y * lane<1>(extent_b_) + z * lane<2>(extent_b_);
    extent_a_in_b_ = sums(x * extent_a_, y * extent_a_, z * extent_a_);
    const Float8 along = sums(abs(joined(ahead_a_, ahead_b_)) * joined(extent_a_, extent_b_));
    const Float4 ahead = frame.ahead * offset;
    offset_ahead_ = (lane<0>(ahead) + lane<1>(ahead) + lane<2>(ahead))[0];
    top_of_a_ = low(along)[0], bottom_of_b_ = offset_ahead_ - high(along)[0];
  }
  /// The square of the gap between all of A and all of B.
  float square() const {
    const Float8 reach = joined(extent_a_, extent_b_) + joined(extent_b_in_a_, extent_a_in_b_);
    const Float8 along = sums(squared(abs(joined(offset_a_, offset_b_)) - reach));
    const float ahead = bottom_of_b_ > top_of_a_ ? bottom_of_b_ - top_of_a_ : 0;
    return max(max(low(along), high(along)), Float4{ahead * ahead, 0, 0, 0})[0];
  }
  const Node& a() const { return a_; }
  const Node& b() const { return b_; }
  float size_a() const { return size_a_; }
  float size_b() const { return size_b_; }
  /// The square that a child's gap must exceed, if the distance is to be no less than `limit`.
  float square_of(float limit) const {
    const float most = (limit + slack_) * (1 + kBoundShare);
    return most * most;
  }
  /// The bound on a distance that the square of a gap proves.
  float lower(float square) const {
    const float bound = std::sqrt(square) * (1 - kBoundShare) - slack_;
    return bound > 0 ? bound : 0;
  }

  /// Sees the children of A, or of B, along both nodes' axes.
  void look_at_a() {
    Float8 up = all8(0);
    for (int k = 0; k < 3; ++k) {
      const Float8 centre = load8(a_.centre[k]) * all8(unit_a_), half = load8(a_.half[k]) * all8(unit_a_);
      store(centre, own_a_[k]), store(half, half_a_[k]);
      const Float8 along = all8(ahead_a_[k]);
      up = up + along * centre + abs(along) * half;
    }
    for (int l = 0; l < 3; ++l) {
      Float8 centre = all8(-offset_b_[l]), half = all8(0);
      for (int k = 0; k < 3; ++k) {
        const Float8 m = all8(m_[l][k]);
        centre = centre + m * load8(own_a_[k]), half = half + abs(m) * load8(half_a_[k]);
      }
      store(centre, in_b_[l]), store(half, half_in_b_[l]);
    }
    store(up, top_a_);
  }
  void look_at_b() {
    Float8 down = all8(offset_ahead_);
    for (int l = 0; l < 3; ++l) {
      own_b_[l] = load8(b_.centre[l]) * all8(unit_b_), half_b_[l] = load8(b_.half[l]) * all8(unit_b_);
      const Float8 along = all8(ahead_b_[l]);
      down = down + along * own_b_[l] - abs(along) * half_b_[l];
    }
    for (int k = 0; k < 3; ++k) {
      in_a_[k] = all8(offset_a_[k]), half_in_a_[k] = all8(0);
      for (int l = 0; l < 3; ++l) {
        const Float8 m = all8(m_[l][k]);
        in_a_[k] = in_a_[k] + m * own_b_[l], half_in_a_[k] = half_in_a_[k] + abs(m) * half_b_[l];
      }
    }
    bottom_b_ = down;
  }

  /// Squares of the gaps of eight pairs of boxes, and of the distances of their centres.
  struct Near {
    Float8 gap, centres;
  };
  /// Compares each child of A with all of B. Returns the children whose squared gap is at most `most`, one bit each.
  unsigned near_a(float most, Near& near) const {
    Float8 along_a = all8(0), along_b = all8(0), centres = all8(0);
    for (int k = 0; k < 3; ++k) {
      const Float8 way = load8(own_a_[k]) - all8(offset_a_[k]);
      along_a = along_a + squared(abs(way) - (load8(half_a_[k]) + all8(extent_b_in_a_[k])));
      along_b = along_b + squared(abs(load8(in_b_[k])) - (load8(half_in_b_[k]) + all8(extent_b_[k])));
      centres = centres + way * way;
    }
    near.centres = centres;
    return chosen(along_a, along_b, all8(bottom_of_b_) - load8(top_a_), most, near.gap) & ((1u << a_.count()) - 1);
  }
  /// The same between each child of B and all of A.
  unsigned near_b(float most, Near& near) const {
    Float8 along_a = all8(0), along_b = all8(0), centres = all8(0);
    for (int k = 0; k < 3; ++k) {
      along_a = along_a + squared(abs(in_a_[k]) - (half_in_a_[k] + all8(extent_a_[k])));
      centres = centres + in_a_[k] * in_a_[k];
      along_b = along_b + squared(abs(own_b_[k] + all8(offset_b_[k])) - (half_b_[k] + all8(extent_a_in_b_[k])));
    }
    near.centres = centres;
    return chosen(along_a, along_b, bottom_b_ - all8(top_of_a_), most, near.gap) & ((1u << b_.count()) - 1);
  }
  /// The same between each child of B and child `i` of A.
  unsigned near_b(int i, float most, Near& near) const {
    Float8 along_a = all8(0), along_b = all8(0), centres = all8(0);
    for (int k = 0; k < 3; ++k) {
      const Float8 way = in_a_[k] - all8(own_a_[k][i]);
      along_a = along_a + squared(abs(way) - (half_in_a_[k] + all8(half_a_[k][i])));
      centres = centres + way * way;
      along_b = along_b + squared(abs(own_b_[k] - all8(in_b_[k][i])) - (half_b_[k] + all8(half_in_b_[k][i])));
    }
    near.centres = centres;
    return chosen(along_a, along_b, bottom_b_ - all8(top_a_[i]), most, near.gap) & ((1u << b_.count()) - 1);
  }

 private:
  friend class PairBounds;

  static Float8 squared(Float8 gap) {
    const Float8 positive = max(gap, all8(0));
    return positive * positive;
  }
  static unsigned chosen(Float8 along_a, Float8 along_b, Float8 ahead, float most, Float8& square) {
    square = max(max(along_a, along_b), squared(ahead));
    return at_most(square, all8(most));
  }

  const Node &a_, &b_;
  float unit_a_, unit_b_, size_a_, size_b_, slack_, offset_ahead_;
  Float4 direction_;            ///< that of the search when the pair was made; hulls that are asked since may have turned it
  Float4 m_[3];                 ///< B's axes in A's node frame
  Float4 offset_a_, offset_b_;  ///< from A's origin to B's, along the axes of each
  Float4 ahead_a_, ahead_b_;
  Float4 extent_a_, extent_b_, extent_b_in_a_, extent_a_in_b_;       ///< half the sides of both, along the axes of each
  float top_of_a_, bottom_of_b_;                                     ///< where A ends and B begins ahead of A's origin
  alignas(32) float own_a_[3][kFanOut], half_a_[3][kFanOut];         ///< A's children along A's axes, from A's origin
  alignas(32) float in_b_[3][kFanOut], half_in_b_[3][kFanOut];       ///< along B's, from B's origin
  alignas(32) float top_a_[kFanOut];                                 ///< how far they reach ahead of A's origin
  Float8 own_b_[3], half_b_[3], in_a_[3], half_in_a_[3], bottom_b_;  ///< B's children likewise; where they begin
};

/// A pair of nodes, or of triangles, that a search has still to look at; `lower` bounds the distance of their boxes, over the
/// unit.
struct PairEntry {
  std::uint32_t a, b;
  float lower;
};
/// The most entries of a search that opens the last pair first: each step down leaves at most 63 behind if it opens both
/// nodes, and 7 if one.
inline constexpr int kMostEntries = 64 * kMostDepth + 8;

/// So many of a pair's children are visited in order; the others as they were found.
inline constexpr int kSortedFew = 4;
inline constexpr int kMostChildren = kFanOut * kFanOut;
/// Puts the few of `count` entries that have the least keys last, the least of all at the end. Overwrites keys.
static inline void raise_least(PairEntry* entries, float (&key)[kMostChildren], int count, int few) {
  if (count <= kFanOut) {  // to read keys eight at a time would wait until the last are stored
    for (int end = count - 1; few > 0 && end > 0; --end, --few) {
      int at = end;
      for (int i = 0; i < end; ++i) at = key[i] < key[at] ? i : at;
      std::swap(entries[at], entries[end]);
      key[at] = key[end];
    }
    return;
  }
  for (int i = count; i % kFanOut != 0; ++i) key[i] = HUGE_VALF;
  for (int end = count - 1; few > 0 && end > 0; --end, --few) {
    Float8 lanes = load8(key);
    for (int i = kFanOut; i <= end; i += kFanOut) lanes = min(lanes, load8(key + i));
    const float least_key = least(lanes);
    int at = end;
    for (int i = 0; key[at] > least_key && i < end; i += kFanOut) {
      const unsigned equal = at_most(load8(key + i), all8(least_key));
      if (equal != 0) at = i + __builtin_ctz(equal);
    }
    std::swap(entries[at], entries[end]);
    key[at] = key[end], key[end] = HUGE_VALF;
  }
}

/// How two nodes were opened.
struct Opened {
  bool only_a, only_b;  ///< one of them alone
  unsigned rows;        ///< of both: the children of A that are near B, one bit each
};

/// From this ratio of sizes on the larger one of two nodes is opened alone.
inline constexpr float kOneSided = 3;

/// Opens two nodes, or the larger one alone: writes the pairs of children, or of a child and the other node, `nodes`, whose
/// squared gap is at most `most` and that may be within `reach`, over the unit, to `found`, those to visit first at the end.
/// Returns how many there are. A node that `ends` has children that are none. Where both are opened, of A's children only
/// `rows` are. If asked for, `opened` receives how.
static inline int open_pair(NodePair& pair, float most, double reach, std::array<std::uint32_t, 2> nodes,
                            std::array<bool, 2> ends, PairEntry* found, unsigned rows = ~0u, Opened* opened = nullptr) {
  const Node &a = pair.a(), &b = pair.b();
  const bool both = ends[0] == ends[1];
  const bool only_a = both ? !ends[0] && pair.size_a() > kOneSided * pair.size_b() : ends[1];
  const bool only_b = both ? !ends[1] && pair.size_b() > kOneSided * pair.size_a() : ends[0];

  // All are compared before any is written: how many are near no branch could foresee, and there is one for all.
  alignas(32) float gaps[kMostChildren], centres[kMostChildren], keys[kMostChildren];
  std::uint64_t left = 0;
  NodePair::Near near;
  const auto keep = [&](int row, unsigned chosen) {
    store(near.gap, gaps + row * kFanOut), store(near.centres, centres + row * kFanOut);
    left |= std::uint64_t{chosen} << row * kFanOut;
  };
  if (only_b) {
    pair.look_at_b();
    keep(0, pair.near_b(most, near));
  } else if (pair.look_at_a(); only_a) {
    keep(0, pair.near_a(most, near));
  } else {
    pair.look_at_b();
    rows &= pair.near_a(most, near);
    if (opened) opened->rows = rows;
    for (; rows != 0; rows &= rows - 1) {
      const int i = __builtin_ctz(rows);
      keep(i, pair.near_b(i, most, near));
    }
  }
  if (opened) opened->only_a = only_a, opened->only_b = only_b;

  int count = 0;
  for (; left != 0; left &= left - 1) {
    const int at = __builtin_ctzll(left);
    const std::uint32_t row = std::uint32_t(at) / kFanOut, lane = std::uint32_t(at) % kFanOut;
    const float lower = pair.lower(gaps[at]);
    if (double(lower) > reach) continue;
    keys[count] = lower + std::sqrt(centres[at]);
    found[count++] = {only_b ? nodes[0] : a.first() + (only_a ? lane : row), only_a ? nodes[1] : b.first() + lane, lower};
  }
  raise_least(found, keys, count, ends[0] && ends[1] ? 1 : kSortedFew);
  return count;
}

}  // namespace
}  // namespace swiftlet
