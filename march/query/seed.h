// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Where a march starts: at the features of a seed, on the coarsest pair, or at an entry of a start table. Knows levels and the
// links between them; does not walk.
#pragma once

#include <algorithm>
#include <cstdint>

#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "body/shape.h"
#include "pair/ellipsoids.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// A feature pair and the levels it lies on.
struct Place {
  int level_a, level_b;
  MarchStart start;
  std::uint32_t trial_steps = ~0u;  ///< a walk that takes more steps is given up for a cold start
};

/// The line of centres: `in_a` leads from A's centre to B's in A's frame, `in_b` from B's centre to A's in B's frame.
struct Line {
  Padded in_a, in_b;
};
/// From A's centre to B's, in A's frame.
static inline Vec4 between_centres(const Shape& a, const Shape& b, const Motion& m) {
  const V3<Vec4> columns = transposed(m.row_x, m.row_y, m.row_z, m.row_z);
  return dot(repeated(vec(b.level(0).view.centre)), columns) + vec4(m.t) - vec4(vec(a.level(0).view.centre));
}
/// From B's centre to A's in B's frame, where `in_a` leads the other way in A's.
static inline Vec4 turned_line(const Vec4& in_a, const Motion& m) {
  return -dot(repeated(in_a), V3<Vec4>{vec4(m.row_x), vec4(m.row_y), vec4(m.row_z)});
}

/// How far the line of centres has turned since a seed was stored.
enum class Turn {
  Little,  ///< by less than half an edge of either level: the line that is stored still serves
  Some,
  Far,  ///< so far that a walk from the seed's features costs more than a cold start
};
constexpr double kLineUnit = 32767;  ///< the length of a direction in a seed

/// How far a query walks from a seed's features: where a cold start costs more than for a distance, as for a threshold or a
/// depth, from twice as far.
enum class Warm { Near, TwiceAsFar };

/// `a` and `b` are the levels of the seed, `in_a` and `in_b` the line of centres.
static inline Turn turn_of(const Vec4& in_a, const Vec4& in_b, const PairSeed& seed, const Level& a, const Level& b,
                           Warm warm) {
  // In place of a negative cosine stands a number whose square is 0: a maximum with 0 itself takes g++ one instruction more.
  const Vec2 along = dots(in_a, vec4(seed.line_in_a.data()), in_b, vec4(seed.line_in_b.data())),
             cosines = max(along, Vec2{} + std::numeric_limits<double>::min()), cos2 = cosines * cosines;
  const double whole = dot(in_a, in_a) * (kLineUnit * kLineUnit);
  const unsigned same = at_least(cos2, Vec2{a.same_cos2, b.same_cos2} * whole);
  if (same == 3) return Turn::Little;
  const auto is_far = [whole, warm](double cosine2, const std::array<std::int16_t, 3>& was, const Level& level) {
    const bool known = (was[0] | was[1] | was[2]) != 0;  // not of a seed made by hand
    const double twice = max(0, 2 * level.near_cos2 - 1), near_cos2 = warm == Warm::Near ? level.near_cos2 : twice * twice;
    return known && cosine2 < near_cos2 * whole;
  };
  const bool is_far_in_a = !(same & 1) && is_far(cos2[0], seed.line_in_a, a),
             is_far_in_b = !(same & 2) && is_far(cos2[1], seed.line_in_b, b);
  return is_far_in_a || is_far_in_b ? Turn::Far : Turn::Some;
}
static inline Turn turn_of(const Line& line, const PairSeed& seed, const Level& a, const Level& b, Warm warm) {
  return turn_of(vec4(line.in_a), vec4(line.in_b), seed, a, b, warm);
}

/// How much shorter the line of centres is along what it was when the seed was stored, in the body in which that is more. A
/// sample along the direction stored then is likely to be about as much wider.
static inline double shortened(const Vec4& in_a, const Vec4& in_b, const PairSeed& seed) {
  const Vec2 along = dots(in_a, vec4(seed.line_in_a.data()), in_b, vec4(seed.line_in_b.data()));
  return norm(in_a) - std::min(along[0], along[1]) * (1 / kLineUnit);
}

/// The finest level of a body that a query may read.
static inline int finest_allowed(const Shape& body, const Budget& budget) {
  return std::clamp(budget.finest_level, body.finest_level(), body.level_count() - 1);
}

/// The coarsest level pair, without features to start from.
static inline Place coarsest_place(const Shape& a, const Shape& b) { return {a.level_count() - 1, b.level_count() - 1, {}}; }

/// True if the seed names features on levels that the query may read.
static inline bool fits(const PairSeed& seed, const Shape& a, const Shape& b, int finest_a, int finest_b) {
  return seed.a.kind() != FeatureKind::None && seed.b.kind() != FeatureKind::None && seed.level_a >= finest_a &&
         seed.level_a < a.level_count() && seed.level_b >= finest_b && seed.level_b < b.level_count();
}

/// The place where a query begins by a policy other than Automatic.
Place place_by_policy(const Shape& a, const Shape& b, const Line& line, const PairSeed& seed, int finest_a, int finest_b,
                      StartPolicy policy);

/// True if a query may also begin elsewhere than at the features of these levels: on coarser ones or on maps.
static inline bool has_other_start(const Shape& a, const Shape& b, int level_a, int level_b) {
  return a.level(level_a).map_side > 0 || ((a.level_count() - level_a) | (b.level_count() - level_b)) > 1;
}
/// The place where a query begins, and how far the line of centres has turned if it begins at the seed's features. `finest_a`
/// and `finest_b` are the finest levels that it may read.
static inline Place first_place(const Shape& a, const Shape& b, const Line& line, const PairSeed& seed, int finest_a,
                                int finest_b, StartPolicy policy, Warm warm, Turn& turn) {
  turn = Turn::Some;
  if (policy != StartPolicy::Automatic) return place_by_policy(a, b, line, seed, finest_a, finest_b, policy);
  if (!fits(seed, a, b, finest_a, finest_b)) return coarsest_place(a, b);
  const Place place{seed.level_a, seed.level_b, {seed.a, seed.b}, kTrialSteps};
  const Level &level_a = a.level(place.level_a), &level_b = b.level(place.level_b);
  if (!has_other_start(a, b, place.level_a, place.level_b)) return {place.level_a, place.level_b, place.start};
  turn = turn_of(line, seed, level_a, level_b, warm);
  return turn == Turn::Far ? coarsest_place(a, b) : place;
}

/// What a vector of length 1 is multiplied by to be stored: a little less than the unit, since rounding may have made it
/// longer.
constexpr double kStoredLength = kLineUnit * (1 - 4 * kU);
/// Stores an answer's normal in the seed.
static inline void remember(const Vec4& normal, PairSeed& seed) { store_units(normal * kStoredLength, seed.normal.data()); }
/// Stores the line of centres and an answer's normal in the seed.
static inline void remember(const Vec4& in_a, const Vec4& in_b, const Vec4& normal, PairSeed& seed) {
  remember(normal, seed);
  const double length = norm(in_a), inverse = length > 0 ? kStoredLength / length : 0;
  const double scale = std::isfinite(inverse) ? inverse : 0;  // centres nearer than 2e-304 count as one point
  store_units(in_a * scale, seed.line_in_a.data()), store_units(in_b * scale, seed.line_in_b.data());
}
static inline void remember(const Line& line, const Padded& normal, PairSeed& seed) {
  remember(vec4(line.in_a), vec4(line.in_b), vec4(normal), seed);
}
static inline Vec direction(const PairSeed& seed) {
  return {double(seed.normal[0]), double(seed.normal[1]), double(seed.normal[2])};
}
/// True unless the seed is new.
static inline bool has_direction(const PairSeed& seed) { return (seed.normal[0] | seed.normal[1] | seed.normal[2]) != 0; }
/// How far the line of centres has turned since a seed's direction was stored. Always inlined, as `PairOf::finest_mapped`.
class SinceStored {
 public:
  [[gnu::always_inline]] SinceStored(const PairSeed& seed, const Vec& line) {
    if (!has_direction(seed)) return;
    const Vec4 was = vec4(seed.line_in_a.data()), now = vec4(line);
    along_ = dot(now, was);
    whole2_ = dot(now, now) * dot(was, was);
  }
  /// By less than the angle of `cosine`. False if the seed has no direction.
  [[gnu::always_inline]] bool within(double cosine) const { return along_ > 0 && along_ * along_ > cosine * cosine * whole2_; }
  [[gnu::always_inline]] bool serves() const { return within(kSameLine); }

 private:
  double along_ = -1, whole2_ = 0;
};
/// About the direction of the distance, at any length: the one stored in `seed`, turned with the line of centres, or, where it
/// is unknown or old, the one between ellipsoids, found from the stored one or, where that is older, from the line. Takes the
/// bodies' levels 0.
static inline Vec4 new_direction(const PairSeed& seed, const SinceStored& since, const Level& a, const Level& b,
                                 const Motion& b_in_a, const Vec& line) {
  const Vec4 stored = vec4(seed.normal.data()), now = vec4(line);
  if (!since.within(a.is_round && b.is_round ? kSameLine : kTurnedLine))
    return between_ellipsoids(a, b, b_in_a, now, since.within(kNearLine) ? stored : now);
  constexpr double kOne = 1 / kLineUnit;
  return turned_with_line(a, b, b_in_a, now, vec4(seed.line_in_a.data()) * kOne, stored * kOne);
}
/// That along which a cold start samples first: the one stored in `seed` while its features, if it has any, would serve, else a
/// new one. `known` is how far the line has turned if that is known to be Far, else Some.
static inline Vec4 first_direction(const PairSeed& seed, const SinceStored& since, Turn known, const Level& a, const Level& b,
                                   const Motion& b_in_a, const Line& line) {
  const bool serves = known != Turn::Far && seed.a.kind() != FeatureKind::None && since.serves() &&
                      turn_of(line, seed, a, b, Warm::Near) != Turn::Far;
  return serves ? vec4(seed.normal.data()) : new_direction(seed, since, a, b, b_in_a, line.in_a);
}

/// The feature that stands for `feature` of `level` one level finer (`child`) or coarser (`parent`).
FeatureId child(const Shape& body, int level, FeatureId feature);
FeatureId parent(const Shape& body, int level, FeatureId feature);

/// A vertex of `level` that is nearly the farthest in a direction, by a support map; for a body without maps, vertex 0.
std::uint32_t about_farthest(const Shape& body, int level, const Vec& direction);

/// The vertex of level `finer` that stands for `vertex` of `level`, by the links to children.
std::uint32_t descendant(const Shape& body, int level, std::uint32_t vertex, int finer = 0);

}  // namespace swiftlet
