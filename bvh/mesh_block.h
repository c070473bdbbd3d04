// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The block of memory that makes a mesh, and that its file holds: layout, hashes and what is safe to read of it.
//
//   MeshHeader | nodes, level by level | triangles | vertices | source of triangles | source of vertices
//
// Sections begin at multiples of 64 bytes. Little-endian, IEEE doubles and floats.
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

struct MeshHeader {
  char magic[8];
  std::uint32_t version, depth;
  std::uint64_t total_bytes, header_hash;  ///< the hash of the header, taken with header_hash at 0
  std::uint32_t node_count, triangle_count, vertex_count;
  std::int32_t unit;  ///< exponent of the power of two that nodes are measured in
  double box_min[3], box_max[3], volume;
  std::uint32_t components, open_edges, non_manifold_edges, flipped_edges, flat_triangles, duplicates;
  Section nodes, triangles, vertices, source_triangle, source_vertex;
};
static_assert(sizeof(MeshHeader) == 248);

struct MeshModel::Content {
  Block block;
  MeshHeader header;
  MeshTopology topology;
  double extent;
  std::span<const Node> nodes;
  std::span<const Corners> triangles;
  std::span<const Vec> vertices;
  std::span<const std::uint32_t> source_triangle, source_vertex;
};

/// What a block is made of.
struct MeshParts {
  int unit = 0, depth = 0;
  Vec box_min, box_max;
  MeshTopology topology;
  std::vector<Node> nodes;
  std::vector<Corners> triangles;
  std::vector<Vec> vertices;
  std::vector<std::uint32_t> source_triangle, source_vertex;
};
AlignedBytes compose(const MeshParts& parts);

/// True if a file that begins with these bytes is a mesh's.
bool is_mesh_block(std::span<const std::byte> start);

/// Makes a mesh from a block, and shows what it is made of.
class MeshReader {
 public:
  static Result<MeshModel> read(Block block);
  using Content = MeshModel::Content;
  static const Content& content(const MeshModel& mesh) { return *mesh.content_; }
};

}  // namespace swiftlet
