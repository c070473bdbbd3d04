// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How near are two bodies? All points and directions are in A's frame, lengths in the bodies' unit. The laws that the queries
// keep are in LAWS.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include <swiftlet/body.h>
#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// How a query ended.
enum class Status : std::uint8_t {
  NotAsked,       ///< no query wrote this answer yet: nothing is known
  Converged,      ///< the interval is as narrow as asked, or the verdict is proved
  Beyond,         ///< stopped early, as asked: lower > options.beyond
  Budget,         ///< the budget's steps ended the march; the interval is true
  LevelLimit,     ///< a level that the tolerance needs is absent from a model or finer than the budget allows; the interval
                  ///< is true, and as narrow as the levels that the answer names allow
  NotConverged,   ///< the interval is true but wider than asked. Known only of needles and plates whose thickness is
                  ///< what law 2 rounds away (README.md, Limits)
  InvalidPose,    ///< not finite, translated beyond 1e45, or not orthonormal to 1e-6: nothing is known
  InvalidRadius,  ///< a radius that is no number from 0 to 1e45: likewise
  InvalidBody,    ///< a primitive with a coordinate that no model may have, or a box of negative extent: likewise
};

/// What is proved of the two bodies as closed sets.
enum class Verdict : std::uint8_t {
  Undecided,    ///< none is proved: lower <= 0, and the interval is as narrow as asked or the query ended early
  Disjoint,     ///< lower > 0
  Touching,     ///< the signed distance is within `tolerance` of 0; lower may still be above 0. So is the depth of bodies that
                ///< share a plane, whichever way they lie in it
  Overlapping,  ///< they share a point: proved, by an OverlapProof (Tuning::proof), by points of the hulls that are less than
                ///< both radii apart, or by upper < 0
};

/// The levels in which order are refined [Ehmann & Lin 2000, sec. 5.2]: one level of one body (the coarser one), of both,
/// or two of both.
enum class Refinement : std::uint8_t {
  Single,        ///< one level of the coarser body at a time
  SingleSingle,  ///< one level of both
  DoubleDouble,  ///< two levels of both
};

/// Where a query starts. All give the same verdict and true intervals.
enum class StartPolicy : std::uint8_t {
  Automatic,  ///< the seed's features at the seed's level; when the bodies turned too far for that, or cold: the support maps,
              ///< or without these the coarsest pair. Questions of yes or no look along the maps first
  Paper,      ///< as Automatic, but the seed climbs to where the motion it can absorb is the distance [sec. 5.2]
  Finest,     ///< the seed's features on level 0, without hierarchy
  Coarsest,   ///< the coarsest pair, from the seed's features there
  Table,      ///< level 0, from the start tables or else the maps, without hierarchy, whatever the seed [sec. 5.3]
};

/// What one query leaves for the next one of the same pair. The caller carries it; `PairSeed{}` is cold. Any bits are legal: a
/// seed changes the work, never the truth.
struct PairSeed {
  FeatureId a, b;                                        ///< features at the levels below
  std::array<std::int16_t, 3> line_in_a{}, line_in_b{};  ///< the line of centres, in units of 1/32767: how far it turned tells
                                                         ///< whether the features are worth a try
  std::array<std::int16_t, 3> normal{};                  ///< the answer's, in the same units: a verdict is tried along it first
  std::uint8_t level_a = 0, level_b = 0;                 ///< where `a` and `b` lie
  std::uint8_t met = 0;                                  ///< not 0: the bodies overlapped at these features
};
static_assert(sizeof(PairSeed) <= 32);

/// One level pair that a query visited.
struct LevelRecord {
  int level_a = 0, level_b = 0;                                       ///< the pair
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< proved so far, of the bodies
  std::uint32_t steps = 0, plane_tests = 0;                           ///< spent here
};

/// How far a query may go. What ends at it is true, and says so by its status.
struct Budget {
  std::uint32_t steps = ~0u;  ///< over all levels: changes of feature, or supports; not time
  int finest_level = 0;       ///< read no level finer than this; models may hold less
};

/// For experts: how a query goes, and what it tells beside its answer. The answer is true whatever is set here.
struct Tuning {
  StartPolicy start = StartPolicy::Automatic;        ///< where it starts
  Refinement refinement = Refinement::SingleSingle;  ///< how it descends
  PlaneRule plane_rule = PlaneRule::MostViolated;    ///< how it walks
  std::span<LevelRecord> trace{};  ///< filled with the level pairs visited, the last one in the last place if too short;
                                   ///< a trace asks for bounds at every level, which costs a certificate each
  OverlapProof* proof = nullptr;   ///< filled where the answer rests on vertices of the hulls, those of its levels, that prove
                                   ///< an overlap; else its count becomes 0. An answer about a coarser level may rest on one
};

/// What is asked of a distance. By default an exact one: the interval is no wider than `tolerance`.
struct Options {
  double absolute = 0;  ///< stop when upper - lower <= max(absolute, relative * (the bound nearer to 0))
  double relative = 0;  ///< a fraction of that bound
  double beyond = std::numeric_limits<double>::infinity();  ///< stop when lower > beyond
  Budget budget{};                                          ///< how far it may go
  Tuning tuning{};                                          ///< how it goes
};

/// What a question of yes or no may take.
struct Effort {
  Budget budget{};  ///< how far it may go
  Tuning tuning{};  ///< how it goes
};

/// What a query found. A field that means nothing is NaN, a feature None.
struct Answer {
  Status status = Status::NotAsked;       ///< how it ended
  Verdict verdict = Verdict::Undecided;   ///< what is proved; also where a distance was asked for
  bool is_signed = false;                 ///< the interval is that of the signed distance (depth.h)
  std::uint8_t levels_visited = 0;        ///< level pairs: entries of a trace that were wanted
  std::int16_t level_a = 0, level_b = 0;  ///< the level pair that answered
  FeatureId feature_a, feature_b;  ///< that hold the points below, on those levels; of an overlap's depth, of the deepest
  std::uint32_t steps = 0, plane_tests = 0;                           ///< work, as MarchResult counts it, over all levels
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< proved bounds on the distance of the bodies
  /// Unit, from A to B: `lower` is proved by the gap of the bodies in this direction; where they overlap, B moved along it by
  /// -lower is free. NaN where none is known, as of an overlap of hulls whose depth was not asked for.
  Vec3 normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  /// The nearest point of A, or that deepest inside B, on the level above, moved by the body's radius along the normal:
  /// point_b - point_a is the signed distance times the normal. Of an overlap of hulls whose depth was not asked for, a point
  /// that lies in both hulls, within `tolerance`, wherever the search ended, or NaN where not even 106 bits tell one.
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< likewise, of B
  double radius_a = 0, radius_b = 0;                                        ///< of the bodies asked about

  /// The middle of the interval, at most half its width from the truth; NaN where it has no upper or no lower end.
  double value() const;
};
static_assert(sizeof(Answer) == 128);

/// The distance between `a` and `b`, where `b_in_a` maps B's frame into A's: to the options' errors, exact by default. The
/// interval is always true, errors are statuses. A seed is what the last query of this pair left; without one the query starts
/// from nothing. Cost: law 7 bounds the steps (march.h); nothing is allocated; 4 kB of stack, 12 kB where only exact arithmetic
/// tells a side.
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options = {});
/// Likewise, cold.
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options = {});

/// `distance`, on from an answer of any query about the same bodies and pose, to the precision that the options ask for: from
/// its features, with its bounds, at the cost of the difference. The interval is never wider than before, but for `tolerance`,
/// by which a plane that fits its points may be worse; one that is as narrow as asked comes back as it is. Steps and plane
/// tests are this call's. Bounds are taken at their word: another pair's or pose's answer makes these wrong. Of a signed answer
/// below 0 the distance is 0. An answer of other radii than the bodies' is InvalidRadius.
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed,
              const Options& options = {});
/// Likewise, without a seed for the queries that follow.
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, const Options& options = {});

/// Do they share a point? Read `verdict`. Ends at the first level pair that is disjoint.
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Effort& effort = {});
/// Likewise, cold.
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, const Effort& effort = {});

/// Is the distance at most the threshold?
enum class Decision : std::uint8_t {
  Undecided,  ///< the interval holds the threshold
  No,         ///< proved: lower > threshold
  Yes,        ///< proved: upper <= threshold
};

/// A decision and what it rests on.
struct Within {
  Decision decision = Decision::Undecided;  ///< Undecided only within `tolerance` of the threshold, or as the status says
  Answer answer;                            ///< as far as the decision needed
};

/// Is the distance at most `threshold` (>= 0)? Ends at the first level pair that decides.
Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed, const Effort& effort = {});
/// Likewise, cold.
Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

/// The user's ids of a nearest feature.
struct SourceFeature {
  FeatureKind kind = FeatureKind::None;  ///< None: the answer is not on level 0
  std::array<std::uint32_t, 2> vertices{kNone,
                                        kNone};  ///< a vertex's one id, an edge's two; a primitive's points are 0, 1, ...
  std::span<const std::uint32_t> triangles;      ///< a face's; none or several; lives as long as the model
};

/// Where two bodies are nearest.
struct ClosestFeatures {
  Answer answer;                     ///< exact, on level 0; Beyond: as far as that needed
  SourceFeature source_a, source_b;  ///< of the answer's features
};

/// What is asked of the nearest features, which are those of level 0, exactly.
struct ClosestOptions {
  double beyond = std::numeric_limits<double>::infinity();  ///< stop when lower > beyond
  std::uint32_t steps = ~0u;                                ///< as Budget::steps
  Tuning tuning{};                                          ///< how it goes
};

/// The nearest features, their points and normal, and the user's own ids for them, while the hulls are disjoint: where only the
/// radii overlap, by normal . (point_a - point_b), `distance` stops at that verdict, and this goes on to the nearest features.
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                 const ClosestOptions& options = {});
/// Likewise, cold.
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, const ClosestOptions& options = {});

}  // namespace swiftlet
