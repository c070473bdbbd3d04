// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The members of `Model`: what its block says of it, its support vertices, and models with fewer levels or other maps.
#include <swiftlet/model.h>

#include <algorithm>
#include <string>

#include "body/block.h"
#include "body/half_edge.h"
#include "body/shape.h"
#include "body/support.h"
#include "body/support_map.h"
#include "body/table.h"

namespace swiftlet {

Result<Model> Model::from_level(const LevelArrays& level, const ModelOptions& options) {
  return from_levels({&level, 1}, options);
}

SourceMap Model::source() const { return content_ ? content_->source : SourceMap{}; }

Vec3 Model::centre() const { return levels_->view.centre; }
Vec3 Model::box_min() const {
  if (!content_) return eigen(box_of(levels_->view.vertices).least);
  return Vec3(content_->headers.block.box_min[0], content_->headers.block.box_min[1], content_->headers.block.box_min[2]);
}
Vec3 Model::box_max() const {
  if (!content_) return eigen(box_of(levels_->view.vertices).most);
  return Vec3(content_->headers.block.box_max[0], content_->headers.block.box_max[1], content_->headers.block.box_max[2]);
}
double Model::volume() const { return content_->levels[0].volume; }
int Model::dimension() const { return int(content_->headers.block.dimension); }

double Model::extent() const {
  double extent = 0;
  for (const Level& level : content_->levels) extent = std::max(extent, level.view.extent);
  return extent;
}

std::uint32_t Model::support(const Vec3& direction) const {
  const Level& finest = level(finest_level_);
  const ConvexView& view = finest.view;
  std::uint32_t start = 0, comparisons = 0;
  if (finest.map_side > 0) {
    start = look_up(finest, rescaled(vec(direction))).vertex;
  } else if (!content_->table.empty()) {
    start = content_->table[lut::nearest(lut::Resolution(content_->headers.block.resolution),
                                         {direction[0], direction[1], direction[2]})];
  }
  return swiftlet::support(view, rescaled(vec(direction)), start, comparisons);
}

FaceLoop::Iterator& FaceLoop::Iterator::operator++() {
  half_edge_ = next_in_face(*view_, half_edge_);
  started_ = true;
  return *this;
}

TableSpec Model::table_spec() const {
  return {lut::Resolution(content_->headers.block.resolution), content_->headers.block.radius_factor,
          content_->headers.block.map_cells};
}
std::span<const std::uint32_t> Model::table() const { return content_->table; }

Result<Model> Model::with_table(const TableSpec& spec) const {
  if (std::string fault = spec_fault(spec); !fault.empty()) return Error{ErrorCode::BadValue, std::move(fault)};
  BlockParts parts = BlockReader::parts(*this, finest_level_);
  for (LevelHeader& level : parts.level_headers) level.map_side = 0;
  parts.maps.clear();
  fill_table(parts, spec, content_->levels[0].view.vertices);
  std::vector<ConvexView> views;
  for (const Level& level : content_->levels) views.push_back(level.view);
  fill_maps(parts, spec, views);
  return BlockReader::read(compose(parts));
}

Model Model::cut(const Detail& detail) const {
  const int finest = std::max(content_->headers.finest(detail), finest_level_);
  if (finest == int(content_->headers.block.finest_level)) return *this;
  return std::move(BlockReader::read(compose(BlockReader::parts(*this, finest)))).value();
}

Result<int> Model::ensure(int level) {
  const auto present = int(content_->headers.block.finest_level);
  if (level < present || level >= level_count_) {
    return Error{ErrorCode::BadValue, "level " + std::to_string(level) + " is not in this model, which has levels " +
                                          std::to_string(present) + " to " + std::to_string(level_count_ - 1)};
  }
  if (level < finest_level_) {
    Result<Model> finer = BlockReader::refined(*this, level);
    if (!finer) return finer.error();
    *this = std::move(finer).value();
  }
  return finest_level_;
}

std::span<const std::byte> Model::bytes() const { return content_->block.bytes; }
std::uint64_t Model::hash() const { return hash_of(bytes()); }

}  // namespace swiftlet
