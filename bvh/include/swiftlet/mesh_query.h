// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proximity of triangle meshes, each with another or with a convex body: distance, intersection, threshold and nearest
// features, by trees of boxes over the triangles and exact signs where triangles meet. Points and directions are in A's frame,
// lengths in the bodies' unit. Laws by number: LAWS.md.
#pragma once

#include <cstdint>
#include <span>

#include <swiftlet/check.h>
#include <swiftlet/mesh.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// The warm start that one mesh query leaves for the next query of the same pair: the nearest triangles. The caller keeps it;
/// `MeshSeed{}` is a cold start. Any bits are legal: a seed changes the work, never the truth.
struct MeshSeed {
  /// Where the last query of two convex patches ended: what PairSeed holds of bodies that are apart.
  struct Patches {
    FeatureId a, b;                                                  ///< features of their hulls
    std::array<std::int16_t, 3> line_in_a{}, line_in_b{}, normal{};  ///< as PairSeed's
  };

  std::uint32_t triangle_a = kNone, triangle_b = kNone;  ///< the last nearest pair; of a convex body 0
  std::array<float, 3> direction{};                      ///< from A to B, in A's frame; tried as a separating axis
  PairSeed pair{};    ///< warm start of both bodies' hulls, or else of a triangle and a convex body
  Patches patches{};  ///< of the patches that hold the nearest triangles
};
static_assert(sizeof(MeshSeed) <= 128);

// Answers are those of query.h, with these readings. `normal` is the unit direction from `point_a` to `point_b`, and no plane
// across it need separate the bodies. Features of a mesh are named as MeshModel says, on level 0; one of a triangle may be the
// whole triangle where a vertex or an edge of it holds the point too. `steps` counts pairs of nodes that were opened,
// `plane_tests` pairs of triangles that were looked at; `Budget::steps` limits their sum. `Budget::finest_level` and `Tuning`
// concern hulls: of a mesh they say nothing. Two convex bodies are answered by query.h.
//
// Of a solid (MeshBody::solid) the surfaces are searched first; where they do not cross, exact signs tell whether a component
// of one body is inside the other. Then the verdict is Overlapping, the distance 0, and both points are one point that lies in
// both; its features are a vertex of the body inside and none of the other. Where the surfaces touch within law 2's bound and
// do not cross, a point that is inside by more than this bound is looked for among a few: if there is none, the verdict is
// Touching, as of surfaces. Cost: some 10 ns for each component of the one body and one or two microseconds for each whose
// vertex is in the other's box; where the surfaces touch, 13 to 62 for each whose vertex is in the other body, as how far
// inside is asked then. No budget limits that.

/// Returns the distance between `a` and `b`, where `b_in_a` maps B's frame into A's: exact by default, or within the errors of
/// `options`. The interval is always true. Cost: see bench/RESULTS.md. Allocates nothing; uses 22 kB of stack, and up
/// to 34 where only exact arithmetic decides.
Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Options& options = {});
/// Returns the distance, from a cold start.
Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Options& options = {});

/// Decides whether the bodies share a point: read `verdict`. It is Overlapping where two triangles cross by exact signs. Of
/// triangles that meet without crossing, as in one plane or in a vertex, it is Touching.
Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Effort& effort = {});
/// Decides from a cold start whether the bodies share a point.
Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Effort& effort = {});

/// Decides whether the distance is at most `threshold` (>= 0). Ends at the first pair of triangles that decides it; of a Yes
/// `lower` is 0 and the verdict is Undecided, since whether the bodies meet was not asked, or, of bodies with radii,
/// Overlapping if that pair proves it.
Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed,
              const Effort& effort = {});
/// Decides from a cold start whether the distance is at most `threshold` (>= 0).
Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

/// Returns the nearest features and the user's ids of the features: of a face the user's triangle, of an edge its ends, of a
/// vertex its point.
ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed,
                                 const ClosestOptions& options = {});
/// Returns the nearest features, from a cold start.
ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const ClosestOptions& options = {});

/// Returns the signed distance. Apart, it is the distance. Where the bodies overlap it is minus the depth: the length of the
/// shortest translation after which no pair of triangles crosses and no point of one is inside the other's volume. Nobody
/// computes the depth of meshes; the interval is what can be proved of it. Moving B along `normal` by -lower leaves the bodies
/// apart or touching, though no plane need separate them then. Any translation by less than -upper leaves them overlapping: it
/// does not part two triangles that cross, or else two balls, one in each solid, around the point that both points then are.
/// The status is NotConverged where this interval is wider than asked, or LevelLimit if a convex model lacks its finest level,
/// and law 2 does not hold for it; the less is asked, the less is done. Nor does law 3: the interval of an overlap depends on
/// the seed, but is always true. Bodies that only touch have an interval of the same kind. Of a mesh that was cut, `lower` is
/// minus infinity unless it is above 0. Cost: that of `distance`, and of an overlap that of some 40 distances, which share what
/// the budget leaves: 0.1 to 5 milliseconds; up to 37 kB of stack.
Answer signed_distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Options& options = {});
/// Returns the signed distance, from a cold start.
Answer signed_distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Options& options = {});

/// Decides whether the signed distance is at most `threshold`. From 0 on as `within`: of a Yes `lower` is minus infinity. Below
/// 0 it asks whether the depth is at least -threshold; Undecided where the interval of `signed_distance` holds the threshold.
Within signed_within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed,
                     const Effort& effort = {});
/// Decides from a cold start whether the signed distance is at most `threshold`.
Within signed_within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

/// Law 2's bound for this pair, as `tolerance` of bodies. NaN where a query refuses the bodies or the pose.
double tolerance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a);

/// Recomputes what `answer` claims by brute force over all pairs of triangles, each by a query of the atomic kernel, without
/// the trees: bounds and verdict must agree with the least distance. Radii must be the bodies', the normal unit and both points
/// numbers, or NaN. Where the bodies overlap, or both points are one that they share, each must lie in its body and features
/// exist or be none. Else, if `upper` is finite, features must exist, each point must lie on its feature and the points be as
/// far apart as the interval says; if `lower` is above law 2's bound, the normal must lead from `point_a` to `point_b`. Of
/// bodies that touch, no two parts may be deeper in each other than law 2's bound. Of solids a corner of every triangle is
/// looked for inside the other, by a ray through all triangles. Cost: about 1 microsecond for each pair of triangles; of a
/// depth also a signed distance of each pair, of Touching of each that crosses.
Check check(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Answer& answer);

/// Proves that the box of every node holds its triangles, that axes are unit and at right angles, that each triangle is in the
/// tree once, that the hull of a node holds its triangles and is convex, that edges and components are as `topology` says, its
/// volume apart, and that `box_min` and `box_max` are the mesh's: all that the truth of answers rests on. Cost: linear in the
/// triangles times the depth of the tree; a microsecond for each vertex inside a hull, a millisecond for one in a face of it.
Check verify(const MeshModel& mesh);

}  // namespace swiftlet
