// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The block of memory that makes a model, and that its file holds: layout and hashes. Knows nothing of files or geometry.
//
//   BlockHeader | LevelHeader x level_count | support maps | coarsest level | ... | level 0 | table | source map
//
// The header of a cut block names its finest level. Of finer levels only the LevelHeaders are left, with a section offset of 0,
// and the table and the source map are empty.
//
// Sections begin at multiples of 64 bytes. Little-endian, IEEE doubles. A level section holds, one after the other: Vertex[V],
// FacePlane[P], HalfEdge[H], then 32-bit words face_first[F], child_vertex[V] child_face[F] (not on level 0),
// parent_face[F] (not on the coarsest). The maps: 2 map_side^2 words per level, finest first, so that the map that queries
// begin with shares a page with the headers. The source section: vertex[V] face_begin[F + 1] face[...].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/model.h>

#include "body/file.h"

namespace swiftlet {

inline constexpr int kMaxLevels = 32;
/// Sides of a support map. Small bodies have more cells than they ask for: cells across an axis are of no use for a box.
inline constexpr std::uint32_t kLeastMapSide = 16, kMaxMapSide = 4096;
inline constexpr std::uint32_t kMostMapCells = 64;          ///< the largest TableSpec::map_cells
inline constexpr std::uint32_t kMaxIndex = (1u << 30) - 1;  ///< the largest index in a FeatureId

struct Section {
  std::uint64_t offset, bytes, hash;
};

struct BlockHeader {
  char magic[8];
  std::uint32_t version, level_count;
  std::uint64_t total_bytes, header_hash;  ///< the hash of all headers, taken with header_hash at 0
  std::uint32_t dimension, resolution;
  double radius_factor;
  double centre[3], radius, inner_radius, scale_around, scale_inside, box_min[3], box_max[3];
  Section maps, table, source;
  std::uint64_t source_face_count;
  std::uint32_t map_cells;     ///< TableSpec::map_cells
  std::uint32_t finest_level;  ///< the finest level that the block holds
};
static_assert(sizeof(BlockHeader) == 240);

struct LevelHeader {
  Section section;
  std::uint32_t vertex_count, half_edge_count, face_count, plane_count;
  std::uint64_t edge_count, triangle_count;
  double extent, deviation, volume, edge_length;
  std::uint32_t map_side, rims;  ///< ConvexView::rims
  double reach;
  float map_frame[6] = {1, 0, 0, 1, 0, 1};  ///< Level::map_frame over the extent
};
static_assert(sizeof(LevelHeader) == 128);

/// Level::map_frame as a header states it.
static inline std::array<double, 6> map_frame(const LevelHeader& l) {
  std::array<double, 6> frame;
  for (std::size_t k = 0; k < 6; ++k) frame[k] = l.extent * l.map_frame[k];
  return frame;
}

inline constexpr std::size_t kMostHeaderBytes = sizeof(BlockHeader) + kMaxLevels * sizeof(LevelHeader);

/// The headers of a block: all that is known before any section is read.
struct Headers {
  BlockHeader block;
  std::vector<LevelHeader> levels;  ///< finest first

  /// Level::prefix: bytes from the block's start to the end of `level`, after all coarser levels; all bytes if `level` is the
  /// block's finest; 0 if the block lacks it.
  std::uint64_t prefix(int level) const;
  /// The finest level in the block that `detail` allows.
  int finest(const Detail& detail) const;
};

/// Whether these first bytes are those of a block, of whatever version.
bool is_model_block(std::span<const std::byte> start);

/// An error text if a file of `bytes` bytes is not exactly the block that its headers describe, else empty.
std::string length_fault(const Headers& headers, std::uint64_t bytes);

/// A block begins at an address that is a multiple of 64.
using Block = OwnedBytes;

/// Zeroed heap memory for a block that is about to be written.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::size_t size);
  std::byte* data() { return data_.get(); }
  std::span<const std::byte> view() const { return {data_.get(), size_}; }
  operator Block() && { return {data_, view()}; }

 private:
  std::size_t size_;
  std::shared_ptr<std::byte[]> data_;
};

struct Model::Content {
  Block block;
  Headers headers;
  int finest;                 ///< the finest level whose view is ready
  std::vector<Level> levels;  ///< finest first; levels finer than `finest` have numbers but no view
  SourceMap source;
  std::span<const std::uint32_t> table;
};

/// FNV-1a over 8-byte words, the last one filled up with zeros; after each product the high half is folded into the low one. It
/// detects damage, not malice.
std::uint64_t hash_of(std::span<const std::byte> bytes);

/// The sections from which `compose` makes a block. Levels finer than `header.finest_level` have empty sections; if there are
/// any, the table and the source map are empty too.
struct BlockParts {
  BlockHeader header{};                    ///< `compose` fills in sizes, offsets and hashes
  std::vector<LevelHeader> level_headers;  ///< finest first
  std::vector<std::vector<std::byte>> levels;
  std::vector<std::byte> maps, table, source;
};
AlignedBytes compose(const BlockParts& parts);

/// Makes a Model from a block, which the builder or a file provides.
class BlockReader {
 public:
  /// Reads the headers at the start of a block. Checks their hash, that numbers are in range, that sizes fit the counts, and
  /// that sections follow one another.
  static Result<Headers> read_headers(std::span<const std::byte> start);
  /// Returns the model that a complete block holds.
  static Result<Model> read(Block block);
  /// Returns a model of the block's levels from `finest` to the coarsest. Finer levels are not read, and may be cut off.
  static Result<Model> read(Block block, int finest);
  /// Returns `model` with the levels of its block from `finest` on made ready.
  static Result<Model> refined(const Model& model, int finest);
  /// Returns the sections for a block of the model's levels from `finest` on. These levels must be ready.
  static BlockParts parts(const Model& model, int finest);
  /// Returns a model of one level whose arrays someone else holds, for queries alone: it has no block, and vertices are their
  /// own ids. `level` must outlive it and not move.
  static Model lent(const Level& level, double radius) { return Model(nullptr, {&level, 1}, radius, 1, 0); }

 private:
  static Result<Model> with_levels(std::shared_ptr<Model::Content> body, int finest);
};

}  // namespace swiftlet
