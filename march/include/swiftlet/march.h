// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The atomic kernel: one Voronoi march [Ehmann & Lin 2000, sec. 5.1] on one level pair. Queries are made of marches; a bounding
// volume hierarchy of convex pieces calls one per node pair. Knows nothing of levels. Laws by number: LAWS.md.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet {

/// Which violated Voronoi plane a step follows [Ehmann & Lin 2000, sec. 5.1].
enum class PlaneRule : std::uint8_t {
  MostViolated,   ///< of a triangle the side that the point is farthest beyond, of a larger face the nearest such side; at a
                  ///< vertex, the plane of the neighbour highest towards the point
  FirstViolated,  ///< the first one found
};

/// How a march ended. The bounds hold in every case.
enum class MarchStatus : std::uint8_t {
  Disjoint,      ///< the interval is as narrow as asked, and lower > 0
  Touching,      ///< the signed distance is within tolerance of 0: upper is at most law 2's bound
  Overlapping,   ///< proved by `proof`; lower = upper = 0
  Near,          ///< the interval is as narrow as asked and lower = 0: whether the bodies overlap was not asked
  Beyond,        ///< stopped because lower > rule.beyond
  Budget,        ///< rule.step_budget ended the march, nearer than it began; the bounds hold. A sequence of marches, each
                 ///< from the features of the one before, ends whatever the budget
  NotConverged,  ///< none of the above could be proved; the bounds hold. Known only for needles and plates whose
                 ///< thickness is within law 2's bound (README.md, Limits)
  InvalidPose,   ///< the pose is not finite, translates beyond 1e45 or is not orthonormal to 1e-6: bounds are [0, inf]
};

/// Why the tests that ended a walk did not prove its bounds, so that support vertices and certified GJK did.
enum class Doubt : std::uint8_t {
  None,       ///< they did
  NoMinimum,  ///< the walk got inside a body, stalled, or spent its budget
  Neighbour,  ///< a neighbour is as high as the feature within rounding, or the point is that near to the side of its face
  Width,      ///< the bounds are wider than law 2's: rounding, slivers
  Lean,       ///< the points lean against the plane
  Threshold,  ///< the distance is within law 2's bound of 0 or of another threshold: a cold start decides
  Asked,      ///< the caller asked for the careful proof
};

/// Up to four vertex pairs whose differences have the origin in their convex hull, which proves that the bodies share a point.
struct OverlapProof {
  std::uint32_t count = 0;                              ///< number of pairs; 0: nothing is proved
  std::array<std::uint32_t, 4> vertex_a{}, vertex_b{};  ///< pair i is vertex_a[i] of A and vertex_b[i] of B, i < count
};

/// The features at which a march begins, for example those another march ended on, or vertices from `table_start`. The default,
/// `FeatureId{}`, stands for the support vertex along the line of centres. Any value is legal: an id that names no feature of
/// its view counts as the default.
struct MarchStart {
  FeatureId a, b;  ///< a feature of A's view, a feature of B's view
};

/// When a march stops: as soon as upper - lower <= max(absolute, relative * lower), or lower > beyond.
struct MarchRule {
  double absolute = 0, relative = 0;                        ///< the bodies' unit; a fraction. Law 2's bound is always enough
  double beyond = std::numeric_limits<double>::infinity();  ///< the bodies' unit; 0: ask only whether they are apart
  double floor = 0;                                         ///< a lower bound already proved; the result's is never less
  std::uint32_t step_budget = ~0u;  ///< steps of the walk, not time. If the budget ends the walk no nearer than it began,
                                    ///< certified GJK follows and counts as one more step
  PlaneRule plane_rule = PlaneRule::MostViolated;  ///< changes the steps, never the truth of the bounds
  bool careful = false;  ///< prove bounds by support vertices and certified GJK even where the walk's own tests do: for tests
};

/// The result of a march. Lengths are in the bodies' unit.
struct MarchResult {
  MarchStatus status = MarchStatus::NotConverged;  ///< how the march ended
  Doubt doubt = Doubt::None;                       ///< why the walk's own tests were not the proof
  /// A feature of A; with `b` it can be stored and start the next march. Disjoint, Touching or Near: the features that hold
  /// `point_a` and `point_b`, within law 2's bound plus the thickness of a face. Overlapping: features that share a point,
  /// proved exactly, mostly an edge of one body and a face of the other; if one body lies inside the other and the surfaces
  /// share no point, `FeatureId{}` for the outer body and any vertex of the inner one. Else the features where the march ended.
  FeatureId a;
  FeatureId b;                                             ///< the feature of B that goes with `a`
  double lower = 0;                                        ///< proved bounds on the distance between the two polytopes
  double upper = std::numeric_limits<double>::infinity();  ///< the upper bound of that interval
  Vec3 normal = Vec3::Zero();  ///< unit, A's frame, from A to B: the separating direction that proves `lower`; or 0
  /// The witness point of A, in A's frame. Overlapping: both points are the one that the features share, or one in both bodies.
  Vec3 point_a = Vec3::Zero();
  Vec3 point_b = Vec3::Zero();    ///< the witness point of B, in A's frame
  OverlapProof proof;             ///< filled where the status is Overlapping
  std::uint32_t steps = 0;        ///< changes of feature; certified GJK counts as one
  std::uint32_t plane_tests = 0;  ///< Voronoi planes and support comparisons evaluated
};

/// Marches from `start` to the nearest features of `a` and `b`. Allocates nothing.
/// Law 7: a walk ends within 16 + 3 n steps on n feature pairs, where a pair counts once for each side of a large face that the
/// walk may remember (march/README.md), and within rounding of a threshold a cold walk follows. The most ever seen is |A| +
/// |B|; on 2 000 triangles about 50. If the bodies overlap, finding features that share a point takes about as many plane tests
/// again as a cold march. If one body lies inside the other, it takes 1 to 5 for each feature of both, whatever the ratio of
/// their sizes: 1 000 vertices in 1 000 take 0.4 ms, or 6 ms where doubles cannot tell the surfaces apart.
MarchResult march(const ConvexView& a, const ConvexView& b, const Pose& b_in_a, const MarchStart& start = {},
                  const MarchRule& rule = {});

/// Returns a vertex of level 0 that faces `direction` (body frame, any length), by one look-up in the start table, or in the
/// support maps if there is no table; `FeatureId{}` if the model has neither, or lacks level 0. To start a march of two levels
/// 0, pass the line of centres: towards B in A's frame, towards A in B's. This saves the support climbs of the default start.
FeatureId table_start(const Model& model, const Vec3& direction);

/// Returns the caller's tag of a face, or the largest tag among the faces at an edge or vertex; 0 without tags, and for
/// `FeatureId{}`. The feature must be one of the view's.
std::uint8_t tag(const ConvexView& view, FeatureId feature);

}  // namespace swiftlet
