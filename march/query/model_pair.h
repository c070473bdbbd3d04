// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two bodies in a legal pose, and what every query computes about them before it searches any level pair.
#pragma once

#include <cmath>
#include <type_traits>

#include <swiftlet/query.h>

#include "pair/pair_view.h"
#include "query/limits.h"
#include "query/seed.h"

namespace swiftlet {

/// Two bodies in a pose. `ShapeType` is `const Shape` or a reference to it, `LimitsType` NoLimits or a reference to Limits.
template <class ShapeType, class LimitsType>
struct PairOf {
  PairOf(const Shape& of_a, const Shape& of_b, const Motion& m, double error, LimitsType of)
      : a(of_a), b(of_b), motion(m), pose_error(error), shift(shift_of(m)), limits(of) {}

  /// The greatest width of an exact answer about the exact hulls.
  [[gnu::always_inline]] double law_two() const {
    return swiftlet::law_two(a.level(0).view, b.level(0).view, shift, pose_error);
  }
  Line line() const {
    const Vec4 in_a = between_centres(a, b, motion);
    Line line;
    store(in_a, line.in_a), store(turned_line(in_a, motion), line.in_b);
    return line;
  }
  /// Directions as of `seed`. Always inlined: as `finest_mapped`.
  [[gnu::always_inline]] Vec4 first_direction(const Line& line, const PairSeed& seed, Turn known = Turn::Some) const {
    return swiftlet::first_direction(seed, SinceStored(seed, line.in_a), known, a.level(0), b.level(0), motion, line);
  }
  [[gnu::always_inline]] Vec4 new_direction(const Line& line, const PairSeed& seed) const {
    return swiftlet::new_direction(seed, SinceStored(seed, line.in_a), a.level(0), b.level(0), motion, line.in_a);
  }
  /// The finest levels that the query may read.
  int finest_a() const { return finest(a); }
  int finest_b() const { return finest(b); }
  /// The query may use support maps: both bodies have them, and the start policy is Automatic.
  bool has_maps() const {
    return limits.tuning.start == StartPolicy::Automatic && a.map_level() < a.level_count() && b.map_level() < b.level_count();
  }
  /// The finest level pair that has support maps and that the query may read. Always inlined: else it is a symbol of the files
  /// for AVX2, which may have none (width.h).
  [[gnu::always_inline]] Place finest_mapped() const {
    return {std::max(a.map_level(), finest_a()), std::max(b.map_level(), finest_b()), {}};
  }
  [[gnu::always_inline]] bool finest_has_maps() const {
    return has_maps() && a.map_level() <= finest_a() && b.map_level() <= finest_b();
  }
  /// The most by which the exact hulls may be farther apart than these levels. A pose that is not exactly orthonormal may
  /// stretch B, and its deviation, by 1.5 times its error and a little of second order.
  double deviation(int level_a, int level_b) const {
    return a.level(level_a).deviation + b.level(level_b).deviation * stretch_of(pose_error);
  }
  /// An estimate, not a bound, of the error of what the support maps say about the exact hulls.
  double map_error(const Place& place) const {
    return deviation(place.level_a, place.level_b) + a.level(place.level_a).map_doubt + b.level(place.level_b).map_doubt;
  }
  /// About the least error to which anything but a walk on the exact pair bounds the distance.
  double least_error() const {
    const Place mapped = finest_mapped();
    if (finest_has_maps()) return map_error(mapped);
    const int coarser_a = std::min(1, a.level_count() - 1), coarser_b = std::min(1, b.level_count() - 1);
    double least = kInfinity;
    if (coarser_a + coarser_b > 0) least = deviation(coarser_a, coarser_b);
    return has_maps() ? min(least, map_error(mapped)) : least;
  }
  /// True if bodies whose centres are `length` apart are so near, by the balls inside, that the vertices of a sample, which lie
  /// about a quarter of an edge of each body aside of each other, are likely to be more than `allowed` farther apart than the
  /// bodies.
  bool is_near(double length, double allowed) const {
    const Level &of_a = a.level(0), &of_b = b.level(0);
    const double aside = (of_a.edge_length + of_b.edge_length) / 4;
    return 2 * allowed * (length - of_a.view.inner_radius - of_b.view.inner_radius) < aside * aside;
  }
  PairView view_of(const Level& of_a, const Level& of_b) const {
    return pair_view(of_a.view, of_b.view, motion, shift, pose_error);
  }
  PairView view_at(const Place& place) const { return view_of(a.level(place.level_a), b.level(place.level_b)); }

  /// The finest level of a body that the query may read.
  int finest(const Shape& body) const {
    if constexpr (std::is_same_v<LimitsType, NoLimits>)
      return body.finest_level();
    else
      return finest_allowed(body, limits.budget);
  }

  ShapeType a, b;
  const Motion& motion;
  const double pose_error, shift;  ///< `shift` is |t|
  const LimitsType limits;
};
using ModelPair = PairOf<const Shape&, const Limits&>;
/// Two models and no limits. Compilers keep what it holds in registers and fold the limits as long as all that takes a
/// reference to it is inlined: other functions get a pair of their own, by `in_general`.
using PlainPair = PairOf<const Shape, NoLimits>;

/// Calls `use` for the same pair as a ModelPair.
template <class Use>
[[gnu::always_inline]] static inline void in_general(const ModelPair& pair, const Use& use) {
  use(pair);
}
template <class Use>
[[gnu::noinline]] static void in_general(const Model& a, const Model& b, const Motion& m, double pose_error, const Use& use) {
  use(ModelPair(Shape(a), Shape(b), m, pose_error, {NoLimits::budget, NoLimits::tuning}));
}
template <class Use>
[[gnu::always_inline]] static inline void in_general(const PlainPair& pair, const Use& use) {
  in_general(*pair.a.model(), *pair.b.model(), pair.motion, pair.pose_error, use);
}

}  // namespace swiftlet
