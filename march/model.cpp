// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <swiftlet/model.h>

#include <algorithm>

#include "block.h"
#include "certify.h"
#include "ring.h"
#include "support_map.h"
#include "table.h"

namespace swiftlet {

Result<Model> Model::from_level(const LevelArrays& level, const ModelOptions& options) {
  return from_levels({&level, 1}, options);
}

SourceMap Model::source() const { return body_->source; }

Vec3 Model::centre() const { return body_->levels[0].view.centre; }
double Model::radius() const { return body_->header.radius; }
Vec3 Model::box_min() const { return Vec3(body_->header.box_min[0], body_->header.box_min[1], body_->header.box_min[2]); }
Vec3 Model::box_max() const { return Vec3(body_->header.box_max[0], body_->header.box_max[1], body_->header.box_max[2]); }
double Model::volume() const { return body_->levels[0].volume; }
int Model::dimension() const { return int(body_->header.dimension); }

double Model::extent() const {
  double extent = 0;
  for (const Level& level : body_->levels) extent = std::max(extent, level.view.extent);
  return extent;
}

std::uint32_t Model::support(const Vec3& direction) const {
  const ConvexView& view = body_->levels[0].view;
  const Scene alone = scene(view, view, kAtRest, 0);
  std::uint32_t start = 0, comparisons = 0;
  if (const Level& exact = body_->levels[0]; exact.map_side > 0) {
    start = look_up(exact, rescaled(vec(direction))).vertex;
  } else if (!body_->table.empty()) {
    start = body_->table[lut::nearest(lut::Resolution(body_->header.resolution), {direction[0], direction[1], direction[2]})];
  }
  return support_a(alone, rescaled(vec(direction)), start, comparisons);
}

FaceLoop::Iterator& FaceLoop::Iterator::operator++() {
  half_edge_ = next_in_face(*view_, half_edge_);
  started_ = true;
  return *this;
}

TableSpec Model::table_spec() const {
  return {lut::Resolution(body_->header.resolution), body_->header.radius_factor, body_->header.map_side};
}
std::span<const std::uint32_t> Model::table() const { return body_->table; }

Model Model::with_table(const TableSpec& spec) const {
  const std::span<const std::byte> block = bytes();
  const auto copy = [&](const Section& s) {
    const auto part = block.subspan(s.offset, s.bytes);
    return std::vector<std::byte>(part.begin(), part.end());
  };
  BlockParts parts;
  parts.header = body_->header;
  parts.level_headers.resize(body_->levels.size());
  std::memcpy(parts.level_headers.data(), block.data() + sizeof(BlockHeader), parts.level_headers.size() * sizeof(LevelHeader));
  for (const LevelHeader& level : parts.level_headers) parts.levels.push_back(copy(level.section));
  parts.source = copy(body_->header.source);
  for (LevelHeader& level : parts.level_headers) level.map_side = 0;
  fill_table(parts, spec, body_->levels[0].view.vertices);
  std::vector<std::span<const Vertex>> vertices;
  for (const Level& level : body_->levels) vertices.push_back(level.view.vertices);
  fill_maps(parts, spec, vertices);
  return std::move(BlockReader::read(compose(parts))).value();
}

std::span<const std::byte> Model::bytes() const { return body_->block.view(); }
std::uint64_t Model::hash() const { return hash_of(bytes()); }

}  // namespace swiftlet
