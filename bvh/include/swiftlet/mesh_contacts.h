// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contacts of triangle meshes, each with another or with a convex body: every region where the surfaces come near each other,
// with its nearest pair, and the few points of a region that a simulation wants. Points and directions are in A's frame,
// lengths in the bodies' unit. Laws by number: LAWS.md.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <swiftlet/manifold.h>
#include <swiftlet/mesh.h>
#include <swiftlet/mesh_query.h>

namespace swiftlet {

/// A region where two surfaces are within reach of each other, and its nearest pair of triangles; of solids too it is of their
/// surfaces, and none tells that one body is inside the other. Numbers that mean nothing are NaN, features that mean nothing
/// `FeatureId{}`.
struct MeshContact {
  double lower = 0, upper = std::numeric_limits<double>::infinity();  ///< proved bounds on the bodies' distance in the region
  Verdict verdict = Verdict::Undecided;  ///< Overlapping where two of its triangles cross, by exact signs, or the radii overlap
  FeatureId feature_a, feature_b;        ///< of the nearest points, as Answer names them; of triangles that cross the triangles
  std::uint32_t triangle_a = kNone, triangle_b = kNone;  ///< the nearest pair, in the meshes' order; of a convex body 0
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< A's nearest point; of a crossing, one of it
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< B's
  /// Unit, from A to B, as Answer's; where the surfaces are apart it is known even if radii overlap. NaN where triangles cross:
  /// there `manifold` finds one.
  Vec3 normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 box_min = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< the region's box: smallest coordinates
  Vec3 box_max = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< largest coordinates
};

/// What `contacts` found.
struct MeshContacts {
  /// Converged: all regions are stored. Budget: not all are, as the span is too short or the steps came to an end. LevelLimit:
  /// a mesh was cut, and nothing is stored, or a convex model lacks level 0: all regions within reach of its finest level are
  /// stored, but some may be beyond that of the body, and some be none. Else as of other queries.
  Status status = Status::NotAsked;
  bool is_counted = false;        ///< `count` is the number of regions
  std::uint32_t count = 0;        ///< regions in all; unless `is_counted`, as many as were told apart
  std::uint32_t stored = 0;       ///< regions that the span holds: the lesser of `count` and its size
  std::uint32_t steps = 0;        ///< pairs of nodes that were opened
  std::uint32_t plane_tests = 0;  ///< pairs of triangles that were looked at
};

/// So many regions more than the caller's span holds can be told apart at once.
inline constexpr std::size_t kSpareRegions = 64;

/// Finds every region where the bodies are within `reach` of each other. `into` receives them, nearest first; if there
/// are more, the nearest ones. Of a reach below 0 there is none; if it is NaN, the status is NotConverged.
///
/// What a region is does not depend on the order in which a search sees triangles. The place of two triangles is what their
/// boxes have in common, taken along A's axes and each grown by the reach, the radii and law 2's bound; of a convex body
/// the box is that of its own box. The places of all pairs of triangles within reach are joined: two that meet become the box
/// around both, until none meet. Those boxes are the regions: each pair within reach is in one. So a table on a floor has four
/// regions, and a box on a floor of thousands of triangles one. Since boxes are along A's axes, a rotation of A's frame, or
/// swapping the bodies, may join or part regions whose boxes nearly meet; a power of two changes nothing. A pair whose distance
/// is above the reach by law 2's bound or less may count as within it, whether others do or not.
///
/// Each interval is as narrow as law 2's bound, or as the levels that a convex model has allow, and holds the least distance of
/// all pairs of triangles in the region. If more than `into.size() + kSpareRegions` regions are told apart at a time, the
/// nearest are joined though they do not meet: then `count` is a lower bound of the true number, and `is_counted` false. If
/// `budget` ends the search, the bounds are true, `count` tells the regions so far, and what was not looked at may join them or
/// add others.
///
/// Cost: that of all pairs of triangles within reach but those inside of a region that is no farther, at 0.1 to 0.3
/// microseconds each, and for each a look at the regions so far. Of pairs as near as the nearest to within law 2's bound, as at
/// two tips of many triangles, each may be left to the atomic kernel, which costs far more. Starts cold. Allocates nothing;
/// uses 32 kB of stack, and up to 48 where only exact arithmetic decides.
MeshContacts contacts(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double reach, std::span<MeshContact> into,
                      const Budget& budget = {});

/// Returns the points of a region that `contacts` found about the same bodies in the same pose: where the two surfaces face
/// each other along one normal. The words of `Manifold` and `ManifoldOptions` hold, with these readings.
///
/// Normal. Where the surfaces are apart it is the contact's. Where triangles cross, or touch within law 2's bound, it is that
/// direction of few along which B has the least way to go until each pair of triangles of the region that meets is apart: of
/// the normals of these triangles, the means of them, and the shortest ways of single pairs. What the noise of poses may move
/// has no say in it: a pair that is nearer than a slack of twice `flatness` times the larger body's extent meets too, is apart
/// once it is farther, and a triangle's normal gives way to no other direction that is shorter by less. So faces that are flush
/// are parted where they face each other, whether beside that they cross, touch or miss. The way along the normal is that of
/// the pairs that meet now, without the slack, or longer by up to twice law 2's bound. Each is proved apart, by an axis along
/// which the two do not overlap once B has gone the way; pairs that do not meet now may meet then. Whether a pair meets is
/// asked without the radii, and a pair is apart once it is so with them. The first point's separation is minus the way. It is
/// the depth of the triangles that cross, and not of closed bodies.
///
/// Points. All pairs of the region are projected along the normal; corners of one triangle over the other, and sides that
/// cross, lie on both surfaces within 2^-20 of law 2's size, mostly within twice `tolerance`; at rest the other body's point
/// may lie beside it by the slack, as manifold.h says. Their separations are from the least one to `margin`. Those that reach
/// farthest in 16 directions are candidates, and `most_points` of them are chosen as manifold.h says: triangles of one plane
/// are one face so, however many they are. Where all triangles that cross are seen from the side there may be no such point:
/// then the first one is a point of the crossing, half the way off each surface.
///
/// A feature is a vertex, a side or a triangle of a mesh; those of a convex body are as manifold.h names them. `face_a` and
/// `face_b` are the contact's triangles. `flatness` is about the contact face of a convex body, what counts as rest, and the
/// slack. The manifold is empty if the bodies or the pose are refused, if the contact names no region of them, or if its
/// distance is above `margin`. A region has one normal: of a box that touches wall and floor within one region, the points are
/// on one of both.
///
/// Of a convex model without level 0 normal, way and points are those of its finest level, which holds the body: points may lie
/// outside of it by the level's deviation, and no separation is above the body's.
///
/// Of two convex bodies: manifold.h's, of their signed distance. Cost: 0.1 to 0.3 microseconds for each pair of triangles
/// within reach in the region; if one is a convex body, for those at the region's border 0.02 for each side of its contact
/// face; all once more where a pair at rest would lose points; some 100 more where triangles cross or touch; and where most do,
/// as in soups that cross each other, 10 to 20 for each pair whose boxes meet. Allocates nothing; uses 32 kB of stack, and up
/// to 64 if one is a convex body.
Manifold manifold(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const MeshContact& contact,
                  const ManifoldOptions& options = {}, const Manifold& previous = {});

}  // namespace swiftlet
