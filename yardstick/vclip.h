// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// V-Clip written from the paper [Mirtich 1997, MERL TR-97-05]. Knows ConvexView and Pose; shares no algorithm
// with march, proves nothing, and says so when it gives up. Where it differs from the paper: vclip.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::yardstick {

/// n . p - offset, positive beyond the plane; n is a unit vector.
struct alignas(32) VclipPlane {
  double x, y, z, offset;
};

/// A vertex with the planes of its Voronoi region, eight beside each other: one per edge, which leads away from the vertex.
/// Places without an edge hold a plane that nothing is beyond. More than eight edges continue in another record.
struct alignas(64) VclipVertex {
  double x, y, z;
  std::uint32_t next, unused;       ///< record; kNone
  FeatureId edge[8], neighbour[8];  ///< the edge and its other end
  double plane_x[8], plane_y[8], plane_z[8];
  double offset[8], far_offset[8];  ///< of the planes through the vertex, and through the other ends
};
static_assert(sizeof(VclipVertex) == 448);

/// An edge with the four planes of its Voronoi region; the two along the axis differ in their offset only.
struct alignas(64) VclipEdge {
  double axis_x, axis_y, axis_z;      ///< unit, from tail to head
  double tail_at, head_at, length;    ///< axis . tail, axis . head
  FeatureId tail, head, left, right;  ///< the neighbours in the order of the tests, seen from outside; None beside a segment
  VclipPlane side[2];                 ///< through the edge and the normal of the left, right face, pointing away from that face
};
static_assert(sizeof(VclipEdge) == 128);

/// One polytope with the Voronoi planes of all features. Immutable; queries share it.
class VclipBody {
 public:
  /// Polygonal faces as the view has them, diagonals dropped. Needs a solid, a flat polygon or a segment. For vertices and
  /// faces: the view of Model::from_level.
  explicit VclipBody(const ConvexView& view);
  std::size_t bytes() const;  ///< heap

  std::vector<VclipVertex> vertices;  ///< the first `vertex_count`, then their continuations
  std::size_t vertex_count = 0;
  std::vector<VclipEdge> edges;
  std::vector<VclipPlane> faces;
  std::vector<std::uint32_t> loop_begin,
      loop;  ///< per face its edges (index >> 1), left of which it lies, or right (index & 1)
};

/// The features where the last query of the pair ended. Default: cold, the first vertex of each. Ids number the edges of
/// VclipBody.
struct VclipSeed {
  FeatureId a, b;
};

enum class VclipEnd : std::uint8_t {
  Disjoint,
  Penetrating,
  Capped,  ///< no end within the cap on steps: distance and points are NaN
};

struct VclipResult {
  VclipEnd end = VclipEnd::Capped;
  double distance = 0;            ///< 0 when penetrating
  Vec3 point_a, point_b;          ///< nearest points in A's frame while disjoint; else NaN
  std::uint32_t steps = 0;        ///< changes of feature. The paper counts visits of a state: one more
  std::uint32_t plane_tests = 0;  ///< points against planes, and directions against edges
  bool penetrating() const { return end == VclipEnd::Penetrating; }
};

/// Allocates nothing. A seed that names no feature counts as cold.
VclipResult vclip(const VclipBody& a, const VclipBody& b, const Pose& b_in_a, VclipSeed& seed);

}  // namespace swiftlet::yardstick
