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
/// Makes every hash fit what it covers, as far as the sections lie inside the block.
inline void rehash(Block& block) {
  MeshHeader header = header_of(block);
  for (Section* s : {&header.nodes, &header.triangles, &header.vertices, &header.source_triangle, &header.source_vertex}) {
    if (s->offset <= block.size() && s->bytes <= block.size() - s->offset)
      s->hash = hash_of(std::span<const std::byte>(block).subspan(s->offset, s->bytes));
  }
  header.header_hash = 0;
  header.header_hash = hash_of(std::as_bytes(std::span(&header, 1)));
  std::memcpy(block.data(), &header, sizeof header);
}

}  // namespace swiftlet::soups
