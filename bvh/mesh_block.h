// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The block of memory that makes a mesh, and that its file holds: layout, hashes and what is safe to read of it.
//
//   MeshHeader | nodes, level by level | hulls | their models | shells | triangles | vertices | source of triangles
//              | source of vertices
//
// The header of a cut block names the levels of nodes that it holds; what comes after the models is then empty, and hulls are
// those of nodes held. Sections begin at multiples of 64 bytes. Little-endian, IEEE doubles and floats.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/mesh.h>

#include "body/block.h"
#include "node.h"

namespace swiftlet {

using Corners = std::array<std::uint32_t, 3>;

/// The point with coordinates that no body may have put to 0.
static inline Vec legal(Vec p) {
  for (double* const x : {&p.x, &p.y, &p.z}) *x = std::fabs(*x) < kLeastCoordinate ? 0 : *x;
  return p;
}

struct MeshHeader {
  char magic[8];
  std::uint32_t version, depth;
  std::uint64_t total_bytes, header_hash;  ///< the hash of the header, taken with header_hash at 0
  std::uint32_t node_count, triangle_count, vertex_count;
  std::int32_t unit;  ///< exponent of the power of two that nodes are measured in
  double box_min[3], box_max[3], volume;
  std::uint32_t components, open_edges, non_manifold_edges, flipped_edges, flat_triangles, duplicates;
  std::uint32_t levels;          ///< of nodes, that the block holds; `depth` unless it was cut
  std::uint32_t hull_count;      ///< at most one for each node that the block holds
  std::uint32_t hull_units;      ///< size of all models of hulls, over 64 bytes
  std::uint32_t unused;          ///< 0
  double deviation[kMostDepth];  ///< [k]: of the mesh cut after k + 1 levels
  Section level[kMostDepth];     ///< the nodes of each level, one after the other
  Section hulls, hull_models, shells, triangles, vertices, source_triangle, source_vertex;
};
static_assert(sizeof(MeshHeader) == 824);

/// The hull of a node's triangles: a model's block. Sorted by node.
struct HullRecord {
  std::uint32_t node, first_triangle;
  std::uint64_t offset, bytes;  ///< of the block, from where the section of models begins; a multiple of 64
};
static_assert(sizeof(HullRecord) == 24);

/// A convex model that holds the triangles of a node, the first of which is `first_triangle`. If it has level 0, that is their
/// hull, and its source ids tell a triangle that is likely to hold a point of a feature: a vertex has the id 3 t + k if it is
/// corner k of the triangle t after the first, a face those of triangles. They may be wrong: they are tried, not believed.
struct NodeHull {
  std::uint32_t node, first_triangle;
  Model model;
};

/// A patch whose node has a hull: its triangles are `begin` to `end` - 1.
struct PatchRange {
  std::uint32_t begin, end, node;
};
/// Where a node is to the patches that have hulls.
enum class PatchPlace : std::uint8_t { Elsewhere, Above, At };

struct MeshModel::Content {
  Block block;
  MeshHeader header;
  MeshTopology topology;
  Root root;
  std::span<const Node> nodes;
  std::vector<NodeHull> hulls;            ///< sorted by node
  std::vector<std::uint32_t> hull_of;     ///< per node, up to the last that has one, its place in `hulls`, or kNone
  std::vector<PatchPlace> patch_place;    ///< per node, up to the last of a patch with a hull; empty if there are none
  std::vector<PatchRange> patches;        ///< sorted by their triangles; empty of a mesh that was cut
  std::span<const std::uint32_t> shells;  ///< per component, one of its triangles
  std::span<const Corners> triangles;
  std::span<const Vec> vertices;
  std::span<const std::uint32_t> source_triangle, source_vertex;

  bool is_whole() const { return header.levels == header.depth; }
  const NodeHull* hull_at(std::uint32_t node) const {
    return node < hull_of.size() && hull_of[node] != kNone ? &hulls[hull_of[node]] : nullptr;
  }
};

/// What a block is made of.
struct MeshParts {
  int unit = 0, depth = 0;
  Vec box_min, box_max;
  MeshTopology topology;
  std::vector<Node> nodes;
  std::vector<NodeHull> hulls;  ///< sorted by node
  std::vector<std::uint32_t> shells;
  std::vector<Corners> triangles;
  std::vector<Vec> vertices;
  std::vector<std::uint32_t> source_triangle, source_vertex;
};
AlignedBytes compose(const MeshParts& parts);

/// Triangles from `begin` to `end` - 1.
struct TriangleRange {
  std::uint32_t begin, end;
};
/// The triangles below each node, which lie one after the other. The children of a node come after it.
std::vector<TriangleRange> triangles_below(std::span<const Node> nodes);

/// True if a file that begins with these bytes is a mesh's.
bool is_mesh_block(std::span<const std::byte> start);

/// Makes a mesh from a block, and shows what it is made of.
class MeshReader {
 public:
  static Result<MeshModel> read(Block block);
  /// The header at the start of a block, which may end early: its hash and ranges are checked.
  static Result<MeshHeader> read_header(std::span<const std::byte> start);
  /// The levels of nodes that `detail` asks for; all of them if it wants the whole mesh.
  static std::uint32_t levels(const MeshHeader& header, const Detail& detail);
  /// A mesh of the first `levels` levels of nodes, fewer than the whole tree's, in a block of its own. What follows them may be
  /// cut off: hulls are kept if all of them are there.
  static Result<MeshModel> cut(std::span<const std::byte> bytes, std::uint32_t levels);
  /// The parts of a whole mesh.
  static MeshParts parts(const MeshModel& mesh);
  using Content = MeshModel::Content;
  static const Content& content(const MeshModel& mesh) { return *mesh.content_; }
};

}  // namespace swiftlet
