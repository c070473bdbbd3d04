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
  Vec in_a, in_b;
};
static inline Line line_of_centres(const Shape& a, const Shape& b, const Motion& b_in_a) {
  const Vec between = apply(b_in_a, vec(b.level(0).view.centre)) - vec(a.level(0).view.centre);
  return {between, -rotate_back(b_in_a, between)};
}

/// True if the line of centres has turned so far since the seed was stored that a walk from the seed's features costs more than
/// a cold start. `a` and `b` are the levels of the seed.
bool turned_far(const Line& line, const PairSeed& seed, const Level& a, const Level& b);

/// The place where a query begins; `finest_a` and `finest_b` are the finest levels that it may read.
Place first_place(const Shape& a, const Shape& b, const Line& line, const PairSeed& seed, int finest_a, int finest_b,
                  StartPolicy policy);

/// Stores the line of centres and an answer's normal in the seed.
void remember(const Line& line, const Vec& normal, PairSeed& seed);
static inline Vec direction(const PairSeed& seed) {
  return {double(seed.normal[0]), double(seed.normal[1]), double(seed.normal[2])};
}
/// The direction stored in `seed` if the line of centres has turned by less than the angle whose cosine is kSameLine, else 0.
static inline Vec last_direction(const Vec& line, const PairSeed& seed) {
  if ((seed.normal[0] | seed.normal[1] | seed.normal[2]) == 0) return {0, 0, 0};
  const Vec was{double(seed.line_in_a[0]), double(seed.line_in_a[1]), double(seed.line_in_a[2])};
  const double along = dot(line, was);
  const bool same = along > 0 && along * along > kSameLine * kSameLine * dot(line, line) * dot(was, was);
  return same ? direction(seed) : Vec{0, 0, 0};
}

/// The finest level of a body that a query may read.
static inline int finest_allowed(const Shape& body, const Budget& budget) {
  return std::clamp(budget.finest_level, body.finest_level(), body.level_count() - 1);
}

/// The coarsest level pair, without features to start from.
static inline Place coarsest_place(const Shape& a, const Shape& b) { return {a.level_count() - 1, b.level_count() - 1, {}}; }

/// The feature that stands for `feature` of `level` one level finer (`child`) or coarser (`parent`).
FeatureId child(const Shape& body, int level, FeatureId feature);
FeatureId parent(const Shape& body, int level, FeatureId feature);

/// A vertex of `level` that is nearly the farthest in a direction, by a support map; for a body without maps, vertex 0.
std::uint32_t about_farthest(const Shape& body, int level, const Vec& direction);

/// The vertex of level `finer` that stands for `vertex` of `level`, by the links to children.
std::uint32_t descendant(const Shape& body, int level, std::uint32_t vertex, int finer = 0);

}  // namespace swiftlet
