// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The one block of memory that a model is, and that its file is: layout and hashes. Knows nothing of files or geometry.
//
//   BlockHeader | LevelHeader x level_count | support maps | coarsest level | ... | level 0 | table | source map
//
// A block cut short at a level says so in its header: of the finer levels only the LevelHeaders are left, at offset 0, and
// table and source map are empty.
//
// Sections begin at multiples of 64 bytes. Little-endian, IEEE doubles. A level section holds, one after the other: Vertex[V],
// FacePlane[P], HalfEdge[H], then 32-bit words face_first[F], child_vertex[V] child_face[F] (not on level 0),
// parent_face[F] (not on the coarsest). The maps: 6 map_side^2 words per level, finest first, so that the one that queries
// begin with shares a page with the headers. The source section: vertex[V] face_begin[F + 1] face[...].
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet {

inline constexpr int kMaxLevels = 32;
inline constexpr std::uint32_t kMaxMapSide = 64;
inline constexpr std::uint32_t kMaxIndex = (1u << 30) - 1;  ///< what a FeatureId names

struct Section {
  std::uint64_t offset, bytes, hash;
};

struct BlockHeader {
  char magic[8];
  std::uint32_t version, level_count;
  std::uint64_t total_bytes, header_hash;  ///< over the headers with header_hash as 0
  std::uint32_t dimension, resolution;
  double radius_factor;
  double centre[3], radius, box_min[3], box_max[3];
  Section maps, table, source;
  std::uint64_t source_face_count;
  std::uint32_t map_side;      ///< TableSpec::map_side
  std::uint32_t finest_level;  ///< of those in the block
};
static_assert(sizeof(BlockHeader) == 216);

struct LevelHeader {
  Section section;
  std::uint32_t vertex_count, half_edge_count, face_count, plane_count;
  std::uint64_t edge_count, triangle_count;
  double extent, deviation, volume, edge_length;
  std::uint32_t map_side, reserved;  ///< 0
};
static_assert(sizeof(LevelHeader) == 96);

inline constexpr std::size_t kMostHeaderBytes = sizeof(BlockHeader) + kMaxLevels * sizeof(LevelHeader);

/// What is known of a block before any of its sections is read.
struct Headers {
  BlockHeader block;
  std::vector<LevelHeader> levels;  ///< finest first

  /// Bytes of the shortest beginning of the block that holds `level` and all coarser ones; the whole where it is the finest.
  std::uint64_t prefix(int level) const;
  /// The finest of the block's levels that `detail` asks for.
  int finest(const Detail& detail) const;
};

/// Whether a file of so many bytes is the whole block.
std::string length_fault(const Headers& headers, std::uint64_t bytes);

/// Memory and who keeps it: the heap, or a mapping of a file.
struct Block {
  std::shared_ptr<const std::byte[]> owner;
  std::span<const std::byte> bytes;  ///< from a multiple of 64 on
};

/// A block to be written.
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
  int finest;                 ///< of the levels whose views are ready
  std::vector<Level> levels;  ///< finest first; of those finer than `finest` only the numbers
  SourceMap source;
  std::span<const std::uint32_t> table;
};

/// FNV-1a over 8-byte words, the last one filled with zeros. Finds damage, not malice.
std::uint64_t hash_of(std::span<const std::byte> bytes);

/// The sections of a block to be. Those of levels finer than `header.finest_level` are empty, as are its table and source map.
struct BlockParts {
  BlockHeader header{};                    ///< sizes, offsets and hashes are filled in by compose
  std::vector<LevelHeader> level_headers;  ///< finest first
  std::vector<std::vector<std::byte>> levels;
  std::vector<std::byte> maps, table, source;
};
AlignedBytes compose(const BlockParts& parts);

/// The way into a Model, from the builder as from a file.
class BlockReader {
 public:
  /// The headers at the start of a block: their hash, numbers in range, sizes that fit the counts, sections one after the
  /// other.
  static Result<Headers> read_headers(std::span<const std::byte> start);
  /// A model of a whole block.
  static Result<Model> read(Block block);
  /// A model of a block's levels from `finest` on. Of the finer ones nothing is read, and they may be missing at the block's
  /// end.
  static Result<Model> read(Block block, int finest);
  /// The same with more levels of the block.
  static Result<Model> refined(const Model& model, int finest);
  /// What a block of a model's levels from `finest` on is made of; these are ready.
  static BlockParts parts(const Model& model, int finest);

 private:
  static Result<Model> with_levels(std::shared_ptr<Model::Content> body, int finest);
};

}  // namespace swiftlet
