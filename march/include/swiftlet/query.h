// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How near are two bodies? Four queries on models at several levels. All points and directions are in A's frame.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include <swiftlet/march.h>
#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// How a query ended.
enum class Status : std::uint8_t {
  Converged,     ///< the interval is as narrow as asked, or the verdict is proved
  Beyond,        ///< stopped early, as asked: lower > options.beyond
  Budget,        ///< options.step_budget ended the march; the interval is true
  LevelLimit,    ///< a level that the tolerance needs is absent from a model or forbidden by options.finest_level; the interval
                 ///< is true, and as narrow as the levels that the answer names allow
  NotConverged,  ///< the interval is true but wider than asked. No valid model and pose is known that answers so
  InvalidPose,   ///< not finite, translated beyond 1e45, or not orthonormal to 1e-6: the interval is [0, inf]
  InvalidRadius,  ///< a radius that is no number from 0 to 1e45: likewise
};

/// What is proved of the two bodies as closed sets.
enum class Verdict : std::uint8_t {
  Undecided,    ///< none is proved: lower is 0, and the interval is as narrow as asked or the query ended early
  Disjoint,     ///< lower > 0
  Touching,     ///< the signed distance is within law 2's bound of 0; lower may still be above 0
  Overlapping,  ///< proved by `Answer::proof`, or without one by points of the hulls less than both radii apart
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
  Handle a, b;                                           ///< features at the levels below
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

/// What the bodies are, when a query may stop, and how it goes there. Lengths are in the bodies' unit.
struct QueryOptions {
  /// A body is all that lies within its radius of its hull: a margin, a sphere around a point, a capsule around a segment. 0 to
  /// 1e45, or the status is InvalidRadius. Whatever is asked and answered is of these bodies; law 2's size counts the radii,
  /// and each bound may be off by its last place more.
  double radius_a = 0;
  double radius_b = 0;        ///< likewise, of B
  double absolute_error = 0;  ///< stop when upper - lower <= max(absolute_error, relative_error * lower)
  double relative_error = 0;  ///< a fraction of lower
  double beyond = std::numeric_limits<double>::infinity();  ///< stop when lower > beyond
  int finest_level = 0;                                     ///< read no level finer than this; models may hold less
  std::uint32_t step_budget = ~0u;                          ///< over all levels; steps, not time
  StartPolicy start = StartPolicy::Automatic;               ///< where it starts
  Refinement refinement = Refinement::SingleSingle;         ///< how it descends
  PlaneRule plane_rule = PlaneRule::MostViolated;           ///< how it walks
  std::span<LevelRecord> trace;  ///< filled with the level pairs visited, the last one in the last place if too short;
                                 ///< a trace asks for bounds at every level, which costs a certificate each
};

/// What a query found. Points and directions are in A's frame, lengths in the bodies' unit.
struct Answer {
  Status status = Status::NotConverged;                               ///< how it ended
  Verdict verdict = Verdict::Undecided;                               ///< what is proved; also where a distance was asked for
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< proved bounds on the distance of the bodies
  Vec3 normal = Vec3::Zero();  ///< unit, from A to B; `lower` is proved by the gap in this direction; 0 if none is known
  /// Nearest points of the levels below, each moved by its body's radius along the normal. Where only the radii overlap each is
  /// inside the other body, and they are deepest if the answer is a contact's. Where the hulls do, each lies in both, within
  /// law 2's bound, wherever the search ended, or is NaN where not even 106 bits tell a common point; and the normal is the
  /// last direction looked along: neither is a place or a way to separate.
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();               ///< likewise, of B
  int level_a = 0, level_b = 0;              ///< the level pair they lie on: the one that answered
  Handle feature_a, feature_b;               ///< on those levels
  OverlapProof proof;                        ///< that the hulls overlap: vertices of those levels
  std::uint32_t steps = 0, plane_tests = 0;  ///< work, as MarchResult counts it, over all levels
  int levels_visited = 0;                    ///< entries of options.trace that were wanted
};

/// The distance between `a` and `b`, where `b_in_a` maps B's frame into A's: exact by default, that is within law 2's bound,
/// upper - lower <= (64 * 2^-53 + 2 r) * size. There size is the largest coordinate of A or B, and its radius, plus
/// |translation|, and r the largest entry of |R^T R - I|: of an ordinary rounded rotation some 2^-53, without which widths
/// to 1.09 times 64 * 2^-53 * size were seen. Cost: law 7 bounds the steps (march.h); nothing is allocated. Errors are
/// statuses, and the interval is always true.
Answer distance(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options = {});

/// `distance`, on from an answer of any of these queries about the same models, pose and radii, to the precision that the
/// options ask for: from its features, with its bounds, at the cost of the difference. The interval is never wider than before,
/// but for law 2's bound, by which a plane that fits its points may be worse; one that is as narrow as asked comes back as it
/// is. Steps and plane tests are this call's. Bounds are taken at their word: another pair's or pose's answer makes these
/// wrong.
Answer refine(const Model& a, const Model& b, const Pose& b_in_a, const Answer& so_far, PairSeed& seed,
              const QueryOptions& options = {});

/// Do they share a point? Read `verdict`. Ends at the first level pair that is disjoint.
/// The options' errors and `beyond` are not read.
Answer intersects(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options = {});

/// Is the distance at most the threshold?
enum class Decision : std::uint8_t {
  Undecided,  ///< the interval holds the threshold
  No,         ///< proved: lower > threshold
  Yes,        ///< proved: upper <= threshold
};

/// A decision and what it rests on.
struct Within {
  Decision decision = Decision::Undecided;  ///< Undecided only within law 2's bound of the threshold, or as the status says
  Answer answer;                            ///< as far as the decision needed
};

/// Is the distance at most `threshold` (>= 0)? Ends at the first level pair that decides.
/// The options' errors and `beyond` are not read.
Within within(const Model& a, const Model& b, const Pose& b_in_a, double threshold, PairSeed& seed,
              const QueryOptions& options = {});

/// The user's ids of a nearest feature.
struct SourceFeature {
  FeatureKind kind = FeatureKind::None;                 ///< None: the answer is not on level 0
  std::array<std::uint32_t, 2> vertices{kNone, kNone};  ///< a vertex's one id, an edge's two
  std::span<const std::uint32_t> triangles;             ///< a face's; none or several; lives as long as the model
};

/// Where the bodies are nearest.
struct Contact {
  Answer answer;                     ///< exact, on level 0; Beyond: as far as that needed
  SourceFeature source_a, source_b;  ///< of the answer's features
};

/// The nearest features, their points and normal, and the user's own ids for them, while the hulls are disjoint: where only the
/// radii overlap, by normal . (point_a - point_b), `distance` stops at that verdict, and this goes on to the nearest features.
/// The options' errors and `finest_level` are not read.
Contact contact(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options = {});

}  // namespace swiftlet
