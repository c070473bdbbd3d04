// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hulls for the upper nodes of a mesh's tree or, where its convex patches are large, for the nodes that these have of their
// own.
#include <swiftlet/build_mesh.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "hull_model.h"
#include "mesh_block.h"
#include "numeric/chunks.h"
#include "patches.h"
#include "tree.h"
#include "weld.h"

namespace swiftlet {
namespace {

using namespace lod;

/// A node that gets a hull, and its triangles, which lie one after the other.
struct Place {
  std::uint32_t node, begin, end;
};

/// The root and the nodes of patches or, if there are none, those of the upper levels that have triangles enough.
std::vector<Place> places(const MeshReader::Content& mesh, const HullOptions& options) {
  const std::vector<TriangleRange> below = triangles_below(mesh.nodes);
  const auto place_of = [&](std::uint32_t node) { return Place{node, below[node].begin, below[node].end}; };
  std::vector<Place> found;
  for (std::uint32_t node = 0; node < mesh.nodes.size(); ++node) {
    if (node == 0 || mesh.nodes[node].of_patch()) found.push_back(place_of(node));
  }
  if (found.size() > 1 || mesh.nodes[0].of_patch()) return found;
  found.clear();
  std::uint32_t begin = 0, end = 1;
  for (std::uint32_t level = 0; level < options.levels && begin < end; ++level) {
    std::uint32_t next = end;
    for (std::uint32_t node = begin; node < end; ++node) {
      const Place place = place_of(node);
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
  return hull_model(part, options);
}

bool all_patches_fit(const MeshReader::Content& mesh) {
  for (std::uint32_t node = 0; node < mesh.nodes.size(); ++node) {
    if (mesh.nodes[node].of_patch() && !mesh.hull_at(node)) return false;
  }
  return true;
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
  const auto make = [&](std::size_t i, const Executor& executor) {
    BuildOptions exact;
    exact.table.map_cells = wanted[i].node == 0, exact.executor = executor;
    made[i] = hull_of(content, wanted[i], exact);
    watch.work(double(wanted[i].end - wanted[i].begin));
  };
  make(0, options.executor);
  run_tasks(options.executor, wanted.size() - 1, [&](std::size_t task) { make(task + 1, {}); });
  for (const auto& model : made) {
    if (!*model) return model->error();
  }

  watch.begin("block", 1, 1);
  std::vector<std::size_t> by_size(wanted.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  // Patches first.
  const auto rank = [&](std::size_t i) {
    return std::pair(content.nodes[wanted[i].node].of_patch(), wanted[i].end - wanted[i].begin);
  };
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t x, std::size_t y) { return rank(x) > rank(y); });
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

/// Per triangle of the mesh, the first one with its corners, in any order.
std::vector<std::uint32_t> firsts(const MeshReader::Content& mesh) {
  std::map<Corners, std::uint32_t> first;
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners corners = mesh.triangles[t];
    std::sort(corners.begin(), corners.end());
    result.push_back(first.try_emplace(corners, t).first->second);
  }
  return result;
}

/// A hull takes some 43 bytes for each of its edges, of which large patches have three quarters of the surface's: where that
/// exceeds what the block may take, no patches are looked for.
constexpr double kEdgeBytes = 43, kEdgesInside = 0.75;

/// Per triangle of the user's, its patch if that is large, or kNone; nothing if patches are small. A triangle that is given
/// several times is in the patch of the first.
std::optional<std::vector<std::uint32_t>> large_patches(const MeshModel& mesh, const HullOptions& options, Watch& watch) {
  const MeshReader::Content& content = MeshReader::content(mesh);
  std::vector<std::uint32_t> first(content.triangles.size()), once;
  std::iota(first.begin(), first.end(), 0u);
  std::optional<MeshModel> single;
  if (mesh.topology().duplicates > 0) {
    first = firsts(content);
    Mesh part;
    for (const Vec& v : content.vertices) part.points.push_back(eigen(v));
    for (std::uint32_t t = 0; t < first.size(); ++t) {
      if (first[t] != t) continue;
      part.triangles.push_back(content.triangles[t]);
      once.push_back(t);
    }
    single = MeshModel::from_triangles(part.points, part.triangles).value();  // as many points and triangles at most
  }
  const MeshModel& whole = single ? *single : mesh;
  watch.begin("patches", 0.9, 2 * double(whole.triangle_count()));
  // Breadth first begins anywhere, so that a body of small patches has too many of them soon.
  const double left = options.bytes_per_triangle * double(mesh.triangle_count()) - double(mesh.bytes().size());
  const double all = 3 * double(whole.triangle_count());  // more than its edges; what bytes leave may be beyond integers
  const PatchLimits limits{whole.triangle_count() / options.least_patch,
                           std::size_t(std::clamp(left / (kEdgeBytes * kEdgesInside), 0.0, all))};
  const std::optional<Decomposition> patches = decompose(whole, Growth::BreadthFirst, limits, watch);
  if (!patches) return std::nullopt;
  std::vector<std::uint32_t> patch_of(first.size(), kNone);
  bool any = false;
  for (std::uint32_t p = 0; p < patches->patches.size(); ++p) {
    const Patch& patch = patches->patches[p];
    if (patch.end - patch.first < options.least_triangles) continue;
    any = true;
    for (std::uint32_t i = patch.first; i < patch.end; ++i) {
      const std::uint32_t t = patches->triangles[i];
      patch_of[single ? once[whole.source_triangle()[t]] : t] = p;
    }
  }
  if (!any) return std::nullopt;
  std::vector<std::uint32_t> result(first.size());
  for (std::uint32_t t = 0; t < first.size(); ++t) result[mesh.source_triangle()[t]] = patch_of[first[t]];
  return result;
}

/// The mesh with a tree whose nodes follow its patches; nothing if these are small.
std::optional<Result<MeshModel>> along_patches(const Mesh& mesh, const MeshModel& plain, const HullOptions& options,
                                               Watch& watch) {
  const std::optional<std::vector<std::uint32_t>> patch_of = large_patches(plain, options, watch);
  if (!patch_of) return std::nullopt;
  watch.begin("tree", 1, 1);
  const Result<Soup> soup = weld(mesh.points, mesh.triangles);
  if (!soup) return soup.error();
  MeshParts parts;
  grow_tree(soup.value(), *patch_of, parts, [](double) { return true; });
  watch.end();
  return MeshReader::read(compose(parts));
}

std::optional<Error> problem(const HullOptions& options) {
  if (options.levels < 1 || options.levels > std::uint32_t(kMostDepth))
    return Error{ErrorCode::BadValue, "levels must be from 1 to " + std::to_string(kMostDepth)};
  if (!(options.bytes_per_triangle >= 0)) return Error{ErrorCode::BadValue, "bytes_per_triangle must be a number from 0 on"};
  return std::nullopt;
}

}  // namespace

Result<MeshModel> rebuild_hulls(const MeshModel& mesh, const HullOptions& options) try {
  if (const std::optional<Error> error = problem(options)) return *error;
  if (!mesh.is_whole()) return Error{ErrorCode::BadValue, "the mesh was cut: it has no triangles"};
  Watch watch(options.progress);
  return with_hulls(mesh, options, watch);
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"};
}

Result<MeshModel> build_mesh(const Mesh& mesh, const HullOptions& options) try {
  if (const std::optional<Error> error = problem(options)) return *error;
  constexpr double kTreeDone = 0.2, kPatchesDone = 0.5, kPatchHullsDone = 0.9;
  MeshOptions tree;
  if (options.progress) tree.progress = [&](double done) { return options.progress(kTreeDone * done, "tree"); };
  Result<MeshModel> plain = MeshModel::from_triangles(mesh.points, mesh.triangles, tree);
  if (!plain) return plain;
  const auto after = [&](double begin, double end) -> Progress {
    if (!options.progress) return {};
    return [&options, begin, end](double done, std::string_view stage) {
      return options.progress(begin + (end - begin) * done, stage);
    };
  };
  if (options.least_patch > 0) {
    const Progress progress = after(kTreeDone, kPatchesDone);
    Watch watch(progress);
    if (std::optional<Result<MeshModel>> made = along_patches(mesh, plain.value(), options, watch)) {
      if (!*made) return *made;
      HullOptions of_patches = options;
      of_patches.progress = after(kPatchesDone, kPatchHullsDone);
      const Result<MeshModel> hulled = rebuild_hulls(made->value(), of_patches);
      if (!hulled) return hulled;
      if (all_patches_fit(MeshReader::content(hulled.value()))) {
        if (options.progress && !options.progress(1, "block")) throw Cancelled();
        return hulled;
      }
    }
  }
  HullOptions rest = options;
  rest.progress = after(options.least_patch > 0 ? kPatchHullsDone : kTreeDone, 1);
  return rebuild_hulls(plain.value(), rest);
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"};
}

}  // namespace swiftlet
