// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The one block of memory that a model is, and that its file is. Layout, hashes and structural checks; no geometry.
//
//   BlockHeader | LevelHeader x level_count | support maps | coarsest level | ... | level 0 | table | source map
//
// Sections begin at multiples of 64 bytes. Little-endian, IEEE doubles. A level section holds, one after the other: Vertex[V],
// FacePlane[P], then 32-bit words head[H] twin[H] face[H] face_first[F], child_vertex[V] child_face[F] (not on level 0),
// parent_face[F] (not on the coarsest). The maps: 6 map_side^2 words per level, coarsest first. The source section: vertex[V]
// face_begin[F + 1] face[...].
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet {

inline constexpr int kMaxLevels = 32;
inline constexpr std::uint32_t kMaxMapSide = 64;
inline constexpr std::uint32_t kMaxIndex = (1u << 30) - 1;  ///< what a Handle names

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
  std::uint32_t map_side;  ///< TableSpec::map_side
  std::uint32_t reserved;  ///< 0
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

/// Bytes at a multiple of 64.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::size_t size) : size_(size), data_(new (std::align_val_t{64}) std::byte[size]()) {}
  std::byte* data() { return data_.get(); }
  std::span<const std::byte> view() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  std::size_t size_;
  std::unique_ptr<std::byte[], Free> data_;
};

struct Model::Body {
  AlignedBytes block;
  BlockHeader header;
  std::vector<Level> levels;
  SourceMap source;
  std::span<const std::uint32_t> table;
};

/// FNV-1a over 8-byte words, the last one filled with zeros. Finds damage, not malice.
std::uint64_t hash_of(std::span<const std::byte> bytes);

/// The sections of a block to be.
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
  /// What the first bytes of a file of `file_size` bytes promise, checked before more is read.
  static Result<BlockHeader> read_header(std::span<const std::byte> start, std::uint64_t file_size);
  /// Checks hashes, ranges and topology, never geometry, and makes the views.
  static Result<Model> read(AlignedBytes block);
};

}  // namespace swiftlet
