// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The atomic kernel: one level pair, one march. What the queries are made of, and what a bounding volume hierarchy of convex
// pieces calls at each node pair. Knows nothing of levels. Laws by number: LAWS.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// Which violated Voronoi plane a step follows [Ehmann & Lin 2000, sec. 5.1].
enum class PlaneRule : std::uint8_t {
  MostViolated,   ///< the plane that the point is farthest beyond; of a vertex's, that of the neighbour highest towards it
  FirstViolated,  ///< the first one found
};

/// How a march ended. The bounds hold in every case.
enum class MarchStatus : std::uint8_t {
  Disjoint,      ///< the interval is as narrow as asked, and lower > 0
  Touching,      ///< the signed distance is within tolerance of 0: upper is at most law 2's bound
  Overlapping,   ///< proved by `proof`; lower = upper = 0
  Near,          ///< the interval is as narrow as asked and begins at 0: the sign was not asked for
  Beyond,        ///< stopped because lower > rule.beyond
  Budget,        ///< rule.step_budget ended the march nearer than it began; the bounds hold. Marches that go on from the
                 ///< feature ids of one another come to an end, whatever the budget
  NotConverged,  ///< neither of the above could be proved; the bounds hold. Known only of needles and plates whose
                 ///< thickness is what law 2 rounds away (README.md, Limits)
  InvalidPose,   ///< not finite, translated beyond 1e45, or not orthonormal to 1e-6: bounds are [0, inf]
};

/// Up to four vertex pairs whose differences hold the origin in their hull: the bodies share a point.
struct OverlapProof {
  std::uint32_t count = 0;                              ///< of pairs; 0: nothing is proved
  std::array<std::uint32_t, 4> vertex_a{}, vertex_b{};  ///< pair i is vertex_a[i] of A and vertex_b[i] of B, i < count
};

/// Where to begin: from what another march ended on, from `table_start`, from features of a parent's. Default: where the bodies
/// face each other along the line of their centres. Anything is legal: a feature id that names no feature of its view counts as
/// the default.
struct MarchStart {
  FeatureId a, b;  ///< features of A's view and of B's
};

/// When to stop: as soon as upper - lower <= max(absolute, relative * lower), or lower > beyond.
struct MarchRule {
  double absolute = 0, relative = 0;  ///< in the bodies' unit, and of `lower`; never narrower than law 2's bound
  double beyond = std::numeric_limits<double>::infinity();  ///< the bodies' unit; 0: only whether they are apart
  double floor = 0;                                         ///< a lower bound already proved; the answer's is never less
  std::uint32_t step_budget = ~0u;  ///< steps of the walk, not time; certified GJK, which follows a walk that the budget
                                    ///< ended no nearer than it began, counts as one more
  PlaneRule plane_rule = PlaneRule::MostViolated;  ///< changes the way, never the truth
};

/// What a march found. Lengths are in the bodies' unit.
struct MarchResult {
  MarchStatus status = MarchStatus::NotConverged;  ///< why it ended
  /// Features, storable, start of the next march. Disjoint, Touching or Near: `point_a` and `point_b` lie on them, within law
  /// 2's bound and, of a face flat only up to rounding, its thickness. Overlapping: they share a point, exactly, mostly an edge
  /// of one and a face of the other; where one body lies inside the other and their surfaces share none, `FeatureId{}` for the
  /// outer body and any vertex of the inner one. Elsewhere where the march stopped.
  FeatureId a;
  FeatureId b;                                             ///< likewise, of B
  double lower = 0;                                        ///< proved bounds on the distance between the two polytopes
  double upper = std::numeric_limits<double>::infinity();  ///< the other bound
  Vec3 normal = Vec3::Zero();  ///< unit, A's frame, from A to B: the direction `lower` is proved in; 0 without one
  /// Nearest points, A's frame; Overlapping: both the point that the features share, or one inside both bodies.
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();    ///< on B
  OverlapProof proof;             ///< where the status is Overlapping
  std::uint32_t steps = 0;        ///< changes of feature
  std::uint32_t plane_tests = 0;  ///< Voronoi planes and support comparisons evaluated
};

/// Marches from `start` to the nearest features of `a` and `b`. Allocates nothing.
/// Law 7: at most 2 * (12 |A| |B| + 1) steps, where |X| counts vertices, half-edges and faces: a state that shortens the
/// distance never returns, twelve in a row that do not end the walk, and within rounding of a threshold a cold walk follows.
/// The most ever seen is |A| + |B|; on 2 000 triangles about 50. Plane tests beside these: where the bodies overlap, to find
/// features that share a point, about as many as a cold march takes; where one lies inside the other, however much larger that
/// is, 1 to 5 for each feature of both: 1 000 vertices in 1 000 take 0.4 ms, 6 ms where doubles cannot tell them apart.
MarchResult march(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, const MarchStart& start = {},
                  const MarchRule& rule = {});

/// A vertex of level 0 that faces a direction (body frame, any length), by one look-up: in the start table, or else in the
/// support maps. `FeatureId{}` where a model has neither, or no level 0. For a march of two level 0 from tables the line of
/// centres is the direction, to B in A's frame and to A in B's; it saves the climbs of the default.
FeatureId table_start(const Model& model, const Vec3& direction);

/// The caller's tag of a feature: a face's own, of an edge or vertex the largest among its faces; 0 without tags, and of
/// `FeatureId{}`.
std::uint8_t tag(const ConvexView& view, FeatureId feature);

}  // namespace swiftlet
