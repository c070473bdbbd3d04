// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Lays levels out as flat arrays; the model proves them again and derives what links and bounds they lack.
#include "bake.h"

namespace swiftlet::lod {
namespace {

/// One level's arrays; LevelArrays points into them.
struct Storage {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> loops, sizes, sources, face_source_begin, face_sources, vertex_child, face_child;

  LevelArrays arrays() const {
    return {vertices, loops, sizes, sources, face_source_begin, face_sources, vertex_child, face_child};
  }
};

Storage stored(const Finest& finest) {
  Storage level;
  level.vertices = finest.vertices;
  level.sources = finest.sources;
  level.face_source_begin.push_back(0);
  for (std::size_t f = 0; f < finest.faces.size(); ++f) {
    level.loops.insert(level.loops.end(), finest.faces[f].begin(), finest.faces[f].end());
    level.sizes.push_back(std::uint32_t(finest.faces[f].size()));
    level.face_sources.insert(level.face_sources.end(), finest.face_sources[f].begin(), finest.face_sources[f].end());
    level.face_source_begin.push_back(std::uint32_t(level.face_sources.size()));
  }
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

}  // namespace

Result<Model> bake(const Finest& finest, const std::vector<CoarseLevel>& coarse, double scale, const BuildOptions& options,
                   std::string& end) {
  std::vector<Storage> storage{stored(finest)};
  for (const CoarseLevel& level : coarse) storage.push_back(stored(level, scale));
  std::vector<LevelArrays> levels;
  for (const Storage& level : storage) levels.push_back(level.arrays());

  Result<Model> model = Model::from_levels(levels, {.repair = false, .table = options.table});
  while (!model && levels.size() > 1) {
    end = model.error().message;
    levels.pop_back();
    model = Model::from_levels(levels, {.repair = false, .table = options.table});
  }
  if (!model || !(options.max_deviation > 0)) return model;

  int kept = 1;
  while (kept < model.value().level_count() && model.value().level(kept).deviation <= options.max_deviation) ++kept;
  if (kept == model.value().level_count()) return model;
  end = "the next level would deviate more than allowed";
  levels.resize(std::size_t(kept));
  return Model::from_levels(levels, {.repair = false, .table = options.table});
}

}  // namespace swiftlet::lod
