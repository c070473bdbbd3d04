// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hulls for the upper nodes of a mesh's tree.
#include <swiftlet/build_mesh.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "mesh_block.h"
#include "numeric/chunks.h"
#include "watch.h"

namespace swiftlet {
namespace {

using namespace lod;

/// A node that gets a hull, and its triangles, which lie one after the other.
struct Place {
  std::uint32_t node, begin, end;
};

/// The nodes of the upper levels that have triangles enough.
std::vector<Place> places(const MeshReader::Content& mesh, const HullOptions& options) {
  std::vector<Place> found;
  const auto triangles = [&](std::uint32_t node) {
    std::uint32_t low = node, high = node;
    while (!mesh.nodes[low].lowest()) low = mesh.nodes[low].first();
    while (!mesh.nodes[high].lowest()) high = mesh.nodes[high].first() + std::uint32_t(mesh.nodes[high].count()) - 1;
    return Place{node, mesh.nodes[low].first(), mesh.nodes[high].first() + std::uint32_t(mesh.nodes[high].count())};
  };
  std::uint32_t begin = 0, end = 1;
  for (std::uint32_t level = 0; level < options.levels && begin < end; ++level) {
    std::uint32_t next = end;
    for (std::uint32_t node = begin; node < end; ++node) {
      const Place place = triangles(node);
      if (node == 0 || place.end - place.begin >= options.least_triangles) found.push_back(place);
      if (!mesh.nodes[node].lowest()) next += std::uint32_t(mesh.nodes[node].count());
    }
    begin = end, end = next;
  }
  return found;
}

/// The hull of a node's triangles, with the ids that `NodeHull` wants: each corner of a triangle is a point of its own.
Result<Model> hull_of(const MeshReader::Content& mesh, const Place& place, const BuildOptions& options) {
  Mesh part;
  for (std::uint32_t t = place.begin; t < place.end; ++t) {
    const auto first = std::uint32_t(part.points.size());
    for (const std::uint32_t v : mesh.triangles[t]) part.points.push_back(eigen(mesh.vertices[v]));
    part.triangles.push_back({first, first + 1, first + 2});
  }
  Result<Built> built = build(part, options);
  if (!built) return built.error();
  return std::move(built).value().model;
}

Result<MeshModel> with_hulls(const MeshModel& mesh, const HullOptions& options, Watch& watch) {
  const MeshReader::Content& content = MeshReader::content(mesh);
  MeshParts parts = MeshReader::parts(mesh);
  parts.hulls.clear();
  const std::vector<Place> wanted = places(content, options);
  double work = 0;
  for (const Place& place : wanted) work += double(place.end - place.begin);
  watch.begin("hulls", 0.95, work);
  std::vector<std::optional<Result<Model>>> made(wanted.size());
  // The root's alone is large; it is asked cold, and has a support map.
  const auto make = [&](std::size_t i, std::uint32_t map_cells, const Executor& executor) {
    BuildOptions exact;
    exact.max_levels = 1, exact.table.map_cells = map_cells, exact.executor = executor;
    made[i] = hull_of(content, wanted[i], exact);
    watch.work(double(wanted[i].end - wanted[i].begin));
  };
  make(0, 1, options.executor);
  run_tasks(options.executor, wanted.size() - 1, [&](std::size_t task) { make(task + 1, 0, {}); });
  for (const auto& model : made) {
    if (!*model) return model->error();
  }

  watch.begin("block", 1, 1);
  std::vector<std::size_t> by_size(wanted.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  const auto triangles = [&](std::size_t i) { return wanted[i].end - wanted[i].begin; };
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t x, std::size_t y) { return triangles(x) > triangles(y); });
  double left = options.bytes_per_triangle * double(mesh.triangle_count()) - double(compose(parts).view().size());
  std::vector<bool> fits(wanted.size());
  for (const std::size_t i : by_size) {
    // Its model ends at a multiple of 64 bytes.
    const double bytes = double((made[i]->value().bytes().size() + 63) / 64 * 64 + sizeof(HullRecord));
    fits[i] = bytes <= left;
    if (fits[i]) left -= bytes;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (fits[i]) parts.hulls.push_back({wanted[i].node, wanted[i].begin, made[i]->value()});
  }
  Result<MeshModel> result = MeshReader::read(compose(parts));
  watch.end();
  return result;
}

}  // namespace

Result<MeshModel> rebuild_hulls(const MeshModel& mesh, const HullOptions& options) try {
  if (options.levels < 1 || options.levels > std::uint32_t(kMostDepth))
    return Error{ErrorCode::BadValue, "levels must be from 1 to " + std::to_string(kMostDepth)};
  if (!(options.bytes_per_triangle >= 0)) return Error{ErrorCode::BadValue, "bytes_per_triangle must be a number from 0 on"};
  if (!mesh.is_whole()) return Error{ErrorCode::BadValue, "the mesh was cut: it has no triangles"};
  Watch watch(options.progress);
  return with_hulls(mesh, options, watch);
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"};
}

Result<MeshModel> build_mesh(const Mesh& mesh, const HullOptions& options) {
  constexpr double kTreeDone = 0.2;
  MeshOptions tree;
  if (options.progress) tree.progress = [&](double done) { return options.progress(kTreeDone * done, "tree"); };
  const Result<MeshModel> plain = MeshModel::from_triangles(mesh.points, mesh.triangles, tree);
  if (!plain) return plain;
  HullOptions rest = options;
  if (options.progress)
    rest.progress = [&](double done, std::string_view stage) {
      return options.progress(kTreeDone + (1 - kTreeDone) * done, stage);
    };
  return rebuild_hulls(plain.value(), rest);
}

}  // namespace swiftlet
