// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proximity queries by multi-level Voronoi marching [Ehmann & Lin 2000]: distance, intersection, threshold and nearest features
// of two bodies. Points and directions are in A's frame, lengths in the bodies' unit. Laws by number: LAWS.md.
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
  NotAsked,       ///< no query has written this answer: nothing is known
  Converged,      ///< the interval is as narrow as asked, or the verdict is proved
  Beyond,         ///< stopped early because lower > options.beyond
  Budget,         ///< the query used up `Budget::steps`; the interval is true
  LevelLimit,     ///< a level that the tolerance needs is absent from a model or finer than the budget allows; the interval is
                  ///< true, and, unless millions of faces share a depth, as narrow as the levels that it names allow
  NotConverged,   ///< the interval is true but wider than asked. Known only for depths of meshes (mesh_query.h), for depths
                  ///< that millions of faces share, and for needles and plates as thin as law 2's bound (README.md, Limits)
  InvalidPose,    ///< the pose is not finite, translates beyond 1e45 or is not orthonormal to 1e-6: nothing is known
  InvalidRadius,  ///< a radius is not a number from 0 to 1e45, or `refine` got an answer of other radii: nothing is known
  InvalidBody,    ///< an empty body, an illegal coordinate, a box turned inside out, an open solid: nothing is known
};

/// What is proved about the two bodies as closed sets.
enum class Verdict : std::uint8_t {
  Undecided,    ///< no other verdict is proved: lower <= 0, and the interval is as narrow as asked or the query ended early
  Disjoint,     ///< lower > 0
  Touching,     ///< the signed distance is within `tolerance` of 0; lower may still be above 0. Bodies in one
                ///< common plane that overlap in it are Touching too, since their depth is 0
  Overlapping,  ///< the bodies share a point: proved by an OverlapProof (Tuning::proof), by balls or ellipsoids inside both, by
                ///< points of the hulls whose distance is less than the sum of the radii, or by upper < 0
};

/// By how many levels a query descends where a level pair does not answer [Ehmann & Lin 2000, sec. 5.2].
enum class Refinement : std::uint8_t {
  Single,        ///< one level finer in one body, the one whose level deviates more
  SingleSingle,  ///< one level finer in both bodies
  DoubleDouble,  ///< two levels finer in both bodies
};

/// Where a query starts. Every policy gives the same verdict and true intervals.
enum class StartPolicy : std::uint8_t {
  Automatic,  ///< the seed's features at the seed's levels; if the bodies turned too far since, or without a seed, the support
              ///< maps, or without maps the coarsest pair. Questions of yes or no sample a direction in the maps first
  Paper,      ///< the seed's features, else the coarsest pair, never the maps; a query leaves features of the coarsest levels
              ///< whose growth in deviation is at most the distance [sec. 5.2]
  Finest,     ///< the seed's features on level 0, without the hierarchy
  Coarsest,   ///< the coarsest level pair, from the seed's features there
  Table,      ///< level 0, from the start tables or else the maps, without the hierarchy, whatever the seed [sec. 5.3]
};

/// The warm start that one query leaves for the next query of the same pair. The caller keeps it; `PairSeed{}` is a cold start.
/// Any bits are legal: a seed changes the work, never the truth.
struct PairSeed {
  FeatureId a, b;                                        ///< features of A and B, on `level_a` and `level_b`
  std::array<std::int16_t, 3> line_in_a{}, line_in_b{};  ///< unit line of centres, times 32767: A to B in A's frame, B to A
                                                         ///< in B's; a query drops the features if it turned far
  std::array<std::int16_t, 3> normal{};                  ///< normal of the answer, times 32767; tried again, also turned with
                                                         ///< the line of centres
  std::uint8_t level_a = 0, level_b = 0;                 ///< the levels of `a` and `b`; without these, those last sampled
  std::uint8_t met = 0;                                  ///< not 0: the bodies overlapped
  std::array<std::uint32_t, 4> inside_a{}, inside_b{};   ///< pairs of vertices of level 0 that proved it, tried again:
                                                         ///< one after the other gives way as the bodies move
};
static_assert(sizeof(PairSeed) <= 64);

/// One level pair that a query visited.
struct LevelRecord {
  int level_a = 0, level_b = 0;                                       ///< the levels of A and B
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< bounds proved so far for the bodies
  std::uint32_t steps = 0, plane_tests = 0;                           ///< work on this level pair
  Doubt doubt = Doubt::None;  ///< why the tests of a walk on this pair were not the proof; None also if none was wanted
};

/// Limits on a query. The interval of a query that ends at a limit is true, and the status names the limit.
struct Budget {
  std::uint32_t steps = ~0u;  ///< sum over all levels: changes of feature in walks, supports in depths; not time. What is begun
                              ///< is ended: a distance may take two more, a depth the supports of its first polytope, up to 24
  int finest_level = 0;       ///< no level finer than this is read; a model may lack it
};

/// Settings for experts: how a query proceeds, and what it reports beside its answer. The answer is true with any settings.
struct Tuning {
  StartPolicy start = StartPolicy::Automatic;        ///< where the query starts
  Refinement refinement = Refinement::SingleSingle;  ///< how it descends through the levels
  PlaneRule plane_rule = PlaneRule::MostViolated;    ///< how it walks on one level pair
  bool careful = false;                              ///< as MarchRule::careful
  std::span<LevelRecord> trace{};  ///< receives the level pairs visited; if it is too short, its last record is overwritten. A
                                   ///< trace costs one certificate per level pair
  OverlapProof* proof = nullptr;   ///< receives vertices of the answer's levels that prove an overlap of these, if the answer
                                   ///< rests on such a proof; else its `count` becomes 0
};

/// Options of a distance query. The default asks for an exact answer, whose interval is no wider than `tolerance`. An
/// `absolute` or `relative` that is NaN or negative asks for the same.
struct Options {
  double absolute = 0;  ///< stop when upper - lower <= max(absolute, relative * (the bound nearer to 0)); the bodies' unit
  double relative = 0;  ///< a fraction of the bound nearer to 0
  double beyond = std::numeric_limits<double>::infinity();  ///< stop when lower > beyond; the bodies' unit
  Budget budget{};                                          ///< limits on the query
  Tuning tuning{};                                          ///< settings for experts
};

/// Options of a question of yes or no.
struct Effort {
  Budget budget{};  ///< limits on the query
  Tuning tuning{};  ///< settings for experts
};

/// The result of a query. A number that means nothing is NaN, a feature that means nothing is `FeatureId{}`.
struct Answer {
  Status status = Status::NotAsked;       ///< how the query ended
  Verdict verdict = Verdict::Undecided;   ///< what is proved; set by every query, also by distances
  bool is_signed = false;                 ///< `lower` and `upper` bound the signed distance (depth.h)
  std::uint8_t levels_visited = 0;        ///< number of level pairs visited: the records that a complete trace has
  std::int16_t level_a = 0, level_b = 0;  ///< the level pair that answered
  FeatureId feature_a;  ///< on `level_a`, holds `point_a` on the hull if a distance's interval is that of an exact answer; of
                        ///< a question of yes or no it may be that of the last sample; none where balls or ellipsoids around
                        ///< or inside the bodies answered, or no point is known
  FeatureId feature_b;  ///< on `level_b`, holds `point_b` on the hull; none where `feature_a` is
  std::uint32_t steps = 0, plane_tests = 0;                           ///< work, as MarchResult counts it, over all levels
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< proved bounds on the distance of the bodies
  /// Unit, from A to B: the gap of the bodies along it proves `lower`; of a signed answer below 0, moving B along it by -lower
  /// separates them; of another overlap, by radii alone, the hulls are apart along it. NaN where no such direction is known,
  /// for example for an overlap of hulls whose depth was not asked for.
  Vec3 normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  /// The witness point of A: its point nearest to B, or deepest inside B, on `level_a`, moved by A's radius along the normal.
  /// Of an exact answer point_b - point_a is the signed distance times the normal. For an overlap of hulls whose depth was not
  /// asked for, it is any point that lies in both hulls within `tolerance`, or NaN if 106-bit arithmetic finds none.
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< the witness point of B
  double radius_a = 0, radius_b = 0;                                        ///< radii of the bodies asked about

  /// Returns the middle of the interval, at most half its width from the truth; NaN if `lower` or `upper` is infinite.
  double value() const;
};
static_assert(sizeof(Answer) == 128);

/// Returns the distance between `a` and `b`, where `b_in_a` maps B's frame into A's: exact by default, or within the errors of
/// `options`. The interval is always true; errors are statuses. `seed` holds what the last query of this pair left, and
/// receives the warm start for the next. Cost: law 7 bounds the steps (march.h). Allocates nothing; uses 4 kB of stack, and
/// 10 kB where only exact arithmetic decides a sign.
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options);
/// Returns the exact distance, as with default options, and sooner, since none are read.
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed);
/// Returns the same of two models without radii, and sooner, since no bodies are made of them.
Answer distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed);
/// Returns the distance, from a cold start.
Answer distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options = {});

/// Continues `distance` from `so_far`, the answer of any query about the same bodies and pose, to the precision that `options`
/// asks for. It starts from the features and bounds of `so_far` and costs only the work still missing. The interval is at most
/// `tolerance` wider than before, where a plane that fits the points replaces one with a better bound; an interval that is
/// already as narrow as asked is returned as it is. `steps` and `plane_tests` count this call alone. The bounds of `so_far` are
/// trusted: an answer about another pair or pose makes the result wrong. From a signed answer below 0 the result is the
/// distance, 0. Status InvalidRadius if the radii of `so_far` are not those of the bodies.
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed,
              const Options& options = {});
/// Continues `distance` from `so_far` without leaving a seed for later queries.
Answer refine(const Body& a, const Body& b, const Pose& b_in_a, const Answer& so_far, const Options& options = {});

/// Decides whether the bodies share a point: read `verdict`. Ends at the first level pair that is proved disjoint.
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Effort& effort);
/// Decides the same as with the default effort, and sooner, since none is read.
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed);
/// Decides the same of two models without radii, and sooner, since no bodies are made of them.
Answer intersects(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed);
/// Decides from a cold start whether the bodies share a point.
Answer intersects(const Body& a, const Body& b, const Pose& b_in_a, const Effort& effort = {});

/// The answer to whether a distance is at most a threshold.
enum class Decision : std::uint8_t {
  Undecided,  ///< the interval contains the threshold
  No,         ///< proved: lower > threshold
  Yes,        ///< proved: upper <= threshold
};

/// The result of a threshold query.
struct Within {
  Decision decision = Decision::Undecided;  ///< Undecided only within `tolerance` of the threshold, or if `status` says why
  Answer answer;                            ///< its interval is only as narrow as the decision needs
};

/// Decides whether the distance is at most `threshold` (>= 0). Ends at the first level pair that decides it. Of a threshold
/// that is NaN the decision is Undecided, whatever the status.
Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed, const Effort& effort = {});
/// Decides from a cold start whether the distance is at most `threshold` (>= 0).
Within within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

/// A nearest feature by the user's own ids. A primitive's points are 0, 1, ... in the order given; of a box with volume corner
/// i has the largest x, y and z where bits 0, 1 and 2 of i are set.
struct SourceFeature {
  FeatureKind kind = FeatureKind::None;  ///< None if the answer is not on level 0
  std::array<std::uint32_t, 2> vertices{kNone,
                                        kNone};  ///< the vertex, or both ends of the edge; a primitive's points are 0, 1, ...
  std::span<const std::uint32_t> triangles;      ///< the triangles of the face, none or several; lives as long as the model
};

/// The result of `closest_features`.
struct ClosestFeatures {
  Answer answer;                     ///< exact, on level 0; with status Beyond only as narrow as that needs
  SourceFeature source_a, source_b;  ///< the answer's features by the user's ids
};

/// Options of `closest_features`, which always asks for the exact answer on level 0.
struct ClosestOptions {
  double beyond = std::numeric_limits<double>::infinity();  ///< stop when lower > beyond; the bodies' unit
  std::uint32_t steps = ~0u;                                ///< as Budget::steps
  Tuning tuning{};                                          ///< settings for experts
};

/// Returns the nearest features, their points and normal, and the user's ids of the features, as long as the hulls are
/// disjoint. Where the bodies overlap only by their radii, `distance` stops at that verdict; this query goes on to the nearest
/// features, and the overlap is normal . (point_a - point_b).
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed,
                                 const ClosestOptions& options = {});
/// Returns the nearest features, from a cold start.
ClosestFeatures closest_features(const Body& a, const Body& b, const Pose& b_in_a, const ClosestOptions& options = {});

}  // namespace swiftlet
