// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Blocks of meshes, and how their hashes are made right again after a change.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include <mesh_block.h>

namespace swiftlet::soups {

using Block = std::vector<std::byte>;

inline Block bytes_of(const MeshModel& mesh) { return {mesh.bytes().begin(), mesh.bytes().end()}; }
/// Of a block that is no shorter than one.
inline MeshHeader header_of(const Block& block) {
  MeshHeader header;
  std::memcpy(&header, block.data(), sizeof header);
  return header;
}
/// What a block consists of behind its header.
inline std::vector<Section*> sections_of(MeshHeader& header) {
  std::vector<Section*> sections{&header.hulls,    &header.hull_models,     &header.shells,       &header.triangles,
                                 &header.vertices, &header.source_triangle, &header.source_vertex};
  for (std::uint32_t k = 0; k < header.levels && k < kMostDepth; ++k) sections.push_back(&header.level[k]);
  return sections;
}
/// Makes every hash fit what it covers, as far as the sections lie inside the block.
inline void rehash(Block& block) {
  MeshHeader header = header_of(block);
  for (Section* s : sections_of(header)) {
    if (s->offset <= block.size() && s->bytes <= block.size() - s->offset)
      s->hash = hash_of(std::span<const std::byte>(block).subspan(s->offset, s->bytes));
  }
  header.header_hash = 0;
  header.header_hash = hash_of(std::as_bytes(std::span(&header, 1)));
  std::memcpy(block.data(), &header, sizeof header);
}

}  // namespace swiftlet::soups
