// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Lays levels out as flat arrays; the model proves them again and derives what links and bounds they lack.
#include "bake.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet::lod {
namespace {

/// One level's arrays; LevelArrays points into them.
struct Storage {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> loops, vertex_child, face_child;

  LevelArrays arrays() const {
    LevelArrays level;
    level.vertices = vertices, level.face_vertices = loops;
    level.child_vertex = vertex_child, level.child_of_face = face_child;
    return level;
  }
};

LevelArrays arrays(const Finest& finest) {
  LevelArrays level;
  level.vertices = finest.vertices, level.face_vertices = finest.loops, level.face_sizes = finest.sizes;
  level.vertex_source = finest.sources;
  level.face_source_begin = finest.face_source_begin, level.face_source = finest.face_sources;
  return level;
}

Storage stored(const CoarseLevel& coarse, double scale) {
  Storage level;
  for (const Vec3& p : coarse.body.points) level.vertices.push_back(p / scale);
  for (const Triangle& triangle : coarse.body.triangles)
    level.loops.insert(level.loops.end(), triangle.begin(), triangle.end());
  level.vertex_child = coarse.vertex_child;
  level.face_child = coarse.triangle_child;
  return level;
}

/// Without the levels that deviate more than allowed, and those that a coarser one beats.
std::vector<LevelArrays> worth_keeping(const Model& model, const std::vector<LevelArrays>& levels, double max_deviation,
                                       std::string& end) {
  std::vector<LevelArrays> kept;
  double least = std::numeric_limits<double>::infinity();
  if (max_deviation > 0) least = std::nextafter(max_deviation, least);
  if (max_deviation > 0 && model.level(model.level_count() - 1).deviation > max_deviation)
    end = "the next level would deviate more than allowed";
  for (int i = model.level_count() - 1; i >= 0; --i) {
    if (i == 0 || model.level(i).deviation < least) {
      kept.push_back(levels[std::size_t(i)]);
      least = model.level(i).deviation;
    } else if (!kept.empty()) {
      kept.back().child_vertex = kept.back().child_of_face = {};  // they named the level that goes
    }
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

}  // namespace

Result<Model> bake(const Finest& finest, const std::vector<CoarseLevel>& coarse, double scale, const BuildOptions& options,
                   std::string& end) {
  std::vector<Storage> storage;
  for (const CoarseLevel& level : coarse) storage.push_back(stored(level, scale));
  std::vector<LevelArrays> levels{arrays(finest)};
  for (const Storage& level : storage) levels.push_back(level.arrays());

  const ModelOptions how{.repair = false, .table = options.table, .executor = options.executor};
  Result<Model> model = Model::from_levels(levels, how);
  while (!model && levels.size() > 1) {
    end = model.error().message;
    levels.pop_back();
    model = Model::from_levels(levels, how);
  }
  if (!model) return model;
  const std::vector<LevelArrays> worth = worth_keeping(model.value(), levels, options.max_deviation, end);
  return worth.size() == levels.size() ? std::move(model) : Model::from_levels(worth, how);
}

}  // namespace swiftlet::lod
