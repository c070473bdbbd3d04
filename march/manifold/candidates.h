// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The corners of a common area that a manifold may be made of: all of them or, of many, those that hold most of the area.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <swiftlet/manifold.h>

#include <double_bits.h>

#include "numeric/tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The borders of an area between its lowest and its highest corner.
enum class Border : std::uint8_t { Left, Right };

/// A point of the plane that both faces are projected to.
struct PlanePoint {
  double x, y;
};
static inline PlanePoint operator+(const PlanePoint& p, const PlanePoint& q) { return {p.x + q.x, p.y + q.y}; }
static inline PlanePoint operator-(const PlanePoint& p, const PlanePoint& q) { return {p.x - q.x, p.y - q.y}; }
static inline PlanePoint operator*(const PlanePoint& p, double s) { return {p.x * s, p.y * s}; }
static inline double dot(const PlanePoint& p, const PlanePoint& q) { return p.x * q.x + p.y * q.y; }
static inline double cross(const PlanePoint& p, const PlanePoint& q) { return p.x * q.y - p.y * q.x; }

/// Both features of a point, in one word.
class Names {
 public:
  Names() = default;
  Names(FeatureId a, FeatureId b) : bits_(bit_cast<std::uint32_t>(a) | std::uint64_t(bit_cast<std::uint32_t>(b)) << 32) {}
  explicit Names(const ManifoldPoint& point) : Names(point.feature_a, point.feature_b) {}
  FeatureId a() const { return bit_cast<FeatureId>(std::uint32_t(bits_)); }
  FeatureId b() const { return bit_cast<FeatureId>(std::uint32_t(bits_ >> 32)); }
  bool operator==(const Names&) const = default;
  /// One of 64 bits. Names of other bits are others; equal bits are rare, also among few features.
  std::uint64_t bit() const { return std::uint64_t(1) << (bits_ * 0x9e3779b97f4a7c15u >> 58); }

 private:
  std::uint64_t bits_;
};

/// A possible point of the manifold, projected.
struct Candidate {
  Vec on_a;           ///< the point of A
  double separation;  ///< by which B's point is farther along the normal
  Names names;

  PlanePoint place() const { return {on_a.x, on_a.y}; }
};

/// The corners, those that the manifold before names in addition, and a deepest point.
inline constexpr int kMostCandidates = kMostCorners + int(kMostManifoldPoints) + 1;

/// All corners of an area or, of more than `kMostCorners`, as many that hold most of it, the deepest among them. The corners
/// that `previous` names come in addition, so that what stays does not depend on them.
class Candidates {
 public:
  /// Corners with a separation above `farthest` are left out.
  Candidates(double farthest, const Manifold& previous);

  /// Begins anew, and leaves out corners whose chords cut off no more than half of `enough` from the first one on. Both borders
  /// begin at `lowest`.
  void begin(const PlanePoint& lowest, double enough);
  double enough() const { return enough_; }
  double farthest() const { return farthest_; }
  /// Whether to add the next corner of a border, which goes on from there by `way`: if not, a chord cuts off little. The left
  /// border's places are mirrored. `rise()`: the separation rises from there on if it is at least 0.
  bool wants(Border border, const PlanePoint& at, const PlanePoint& way, auto&& rise) {
    return !is_crowded_ || cuts(border, at, way) || turns(border, rise);
  }
  /// The same of a corner somewhere between `from` and `to`.
  bool wants(Border border, const PlanePoint& from, const PlanePoint& to, const PlanePoint& next, auto&& rise) {
    return !is_crowded_ || cuts(border, from, to, next) || turns(border, rise);
  }
  /// What `previous` names.
  std::span<const Names> previous() const { return {previous_, std::size_t(previous_count_)}; }
  /// Whether to add a corner with these names: not if one is kept already, as sides that are nearly parallel may pass the lead
  /// twice, and a corner may come as a crossing near it and as itself; one that is not `wanted` only if `previous` names it.
  [[gnu::always_inline]] bool takes(Names names, bool wanted) const { return !has(names) && (wanted || knows(names)); }
  /// Adds the corner that follows on a border, which is seen from below to above.
  [[gnu::always_inline]] void add(Border border, const Candidate& candidate, bool wanted) {
    if (!(candidate.separation <= farthest_)) return;
    if (!wanted) return keep(border, candidate);
    least_ = min(least_, candidate.separation);
    if (candidate.separation < deepest_) deepest_ = candidate.separation, deepest_named_ = candidate.names;
    if (count_[0] + count_[1] == kMostCorners) thin();
    const std::size_t side = std::size_t(border);
    row(border, count_[side]++) = candidate;
    name_bits_ |= candidate.names.bit();
    const PlanePoint place = candidate.place();
    last_[side] = {border == Border::Left ? -place.x : place.x, place.y}, cut_off_[side] = 0;
  }
  /// Joins both borders into one row around the area, the corners that `previous` names in addition where they lie.
  void close();
  /// Adds a point deeper than all corners, after `close`; it takes the place of a corner with its names. It is there whether
  /// `previous` names it or not.
  void add_deepest(const Candidate& candidate);

  /// How many corners both borders have.
  int found() const { return count_[0] + count_[1]; }
  /// After `close`.
  int count() const { return count_[0]; }
  const Candidate& operator[](int i) const { return all_[std::size_t(i)]; }
  double least() const { return least_; }  ///< the least separation of all that were added
  /// Whether `previous` names a point so.
  [[gnu::always_inline]] bool knows(Names names) const { return known_name_bits_ & names.bit() && names_before(names); }

 private:
  /// Whether a corner so named is in a row.
  [[gnu::always_inline]] bool has(Names names) const { return name_bits_ & names.bit() && finds(names); }
  bool finds(Names names) const;
  bool names_before(Names names) const;
  Candidate& row(Border border, int i) { return all_[std::size_t(border == Border::Left ? i : kMostCandidates - 1 - i)]; }

  /// Adds a triangle above the border's last chord to the area that the chord to the end of `way` would cut off.
  [[gnu::always_inline]] bool cuts(Border border, const PlanePoint& at, const PlanePoint& way) {
    return (cut_off_[std::size_t(border)] += std::fabs(cross(at - last_[std::size_t(border)], way))) > enough_;
  }
  [[gnu::always_inline]] bool cuts(Border border, const PlanePoint& from, const PlanePoint& to, const PlanePoint& next) {
    const PlanePoint &last = last_[std::size_t(border)], w = next - last;
    const double most = max(std::fabs(cross(from - last, w)), std::fabs(cross(to - last, w)));
    return (cut_off_[std::size_t(border)] += most) > enough_;
  }
  /// True where the separation stops falling along the border.
  bool turns(Border border, auto&& rise) {
    bool& has_turned = has_turned_[std::size_t(border)];
    return !has_turned && (has_turned = rise() >= 0);
  }
  void keep(Border border, Candidate candidate);
  void thin();
  void thin(Border border, PlanePoint last, bool keeps_first);

  const double farthest_;
  std::uint64_t known_name_bits_ = 0, name_bits_ = 0;  ///< of the points of `previous`, and of the corners that are kept
  double least_ = kInfinity, deepest_ = least_;        ///< of all, and of the row
  Names deepest_named_;                                ///< the first corner of the row with that separation
  bool is_crowded_ = false;                            ///< more corners have come than there is room for
  bool has_turned_[2] = {};                            ///< per border, as `turns` found
  double enough_ = 0;                                  ///< twice the area that a chord may cut off
  double cut_off_[2] = {};   ///< twice the area that the chord of each border up to now cuts off, or more
  PlanePoint last_[2] = {};  ///< where it begins: the border's last corner that was added
  int count_[2] = {}, known_count_ = 0, previous_count_;
  std::array<Candidate, kMostCandidates> all_;  ///< the left border from the start, the right one from the end back
  Names previous_[kMostManifoldPoints];
  Candidate known_[kMostManifoldPoints];  ///< those that `previous` names and that are in no row
  Border known_border_[kMostManifoldPoints];
};

}  // namespace swiftlet
