// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Algorithm 1 of [Ehmann & Lin 2001]: pieces are split top down; hulls and classes of faces are made bottom up.
#include <swiftlet/build_hull_tree.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

#include "body/block.h"
#include "fit.h"
#include "inside.h"
#include "mesh_block.h"
#include "numeric/chunks.h"
#include "watch.h"

namespace swiftlet {
namespace {

using namespace lod;
using Ids = std::vector<std::uint32_t>;

/// A node's hull while the tree is built.
struct Draft {
  Model hull;
  Ids points{};     ///< of the mesh, per vertex of the hull
  Ids triangles{};  ///< of the mesh: those that lie in faces of the hull
  std::vector<std::uint8_t> classes{};
  std::vector<std::array<std::uint32_t, 2>> in_child{};
  std::optional<MeshModel> surface{};

  const ConvexView& view() const { return hull.level(0).view; }
};

/// Arrays one after the other, equal ones once.
template <class T>
class Pool {
 public:
  HullRange add(std::span<const T> array) {
    const std::span<const std::byte> bytes = std::as_bytes(array);
    auto& places = places_[hash_of(bytes)];
    for (const HullRange& place : places) {
      if (std::ranges::equal(std::as_bytes(std::span(all_).subspan(place.begin, place.count)), bytes)) return place;
    }
    places.push_back({std::uint32_t(all_.size()), std::uint32_t(array.size())});
    all_.insert(all_.end(), array.begin(), array.end());
    return places.back();
  }
  bool is_full() const { return all_.size() > std::uint32_t(-1); }  ///< ranges cannot name its end
  std::vector<T> take() {
    all_.shrink_to_fit();
    return std::move(all_);
  }

 private:
  std::vector<T> all_;
  std::unordered_map<std::uint64_t, std::vector<HullRange>> places_;  ///< by hash
};

void make_unique(Ids& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// The mesh's points around a face, from the least one on.
Ids border(const Draft& draft, std::uint32_t face) {
  Ids loop;
  for (const std::uint32_t v : FaceLoop(draft.view(), face)) loop.push_back(draft.points[v]);
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

class Construction {
 public:
  Construction(const MeshModel& mesh, const Decomposition& patches, const HullTreeOptions& options, Watch& watch)
      : mesh_(mesh), patches_(patches), options_(options), watch_(watch) {}

  Result<HullTree> run() {
    centres_.reserve(patches_.patches.size());
    for (const Patch& patch : patches_.patches) centres_.push_back(centre_of(patch));
    Ids all(patches_.patches.size());
    std::iota(all.begin(), all.end(), 0u);
    split_all(all);

    watch_.begin("hulls", 0.99, double(nodes_.size()));
    drafts_.resize(nodes_.size());
    std::vector<std::optional<Error>> errors(nodes_.size());
    // Children have greater indices than their parent: from the lowest nodes up, those of one depth are tasks.
    std::vector<Ids> at_depth;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      at_depth.resize(std::max(at_depth.size(), std::size_t(depth_[i]) + 1));
      at_depth[depth_[i]].push_back(i);
    }
    for (auto level = at_depth.rbegin(); level != at_depth.rend(); ++level) {
      run_tasks(options_.executor, level->size(), [&](std::size_t task) {
        errors[(*level)[task]] = fill((*level)[task]);
        watch_.work(1);
      });
      for (const std::uint32_t i : *level) {
        if (errors[i]) return *errors[i];
      }
    }
    watch_.end();
    return packed();
  }

 private:
  Vec3 centre_of(const Patch& patch) const {
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (std::uint32_t i = patch.first; i < patch.end; ++i) {
      const auto corners = mesh_.triangle(patches_.triangles[i]);
      const Vec3 p = mesh_.vertex(corners[0]), q = mesh_.vertex(corners[1]), r = mesh_.vertex(corners[2]);
      const double area = (q - p).cross(r - p).norm();
      sum += (p + q + r) * (area / 3), weight += area;
    }
    return weight > 0 ? Vec3(sum / weight) : mesh_.vertex(mesh_.triangle(patches_.triangles[patch.first])[0]);
  }

  /// Splits pieces until each is alone. Nodes come before their children.
  void split_all(const Ids& all) {
    struct Open {
      Ids pieces;
      std::uint32_t parent, side, depth;
    };
    std::vector<Open> open{{all, kNone, 0, 0}};
    while (!open.empty()) {
      Open here = std::move(open.back());
      open.pop_back();
      const std::uint32_t index = std::uint32_t(nodes_.size());
      nodes_.emplace_back(), depth_.push_back(here.depth), piece_.push_back(kNone);
      nodes_.back().first = std::uint32_t(triangles_.size());
      if (here.parent != kNone) nodes_[here.parent].child[here.side] = index;
      if (here.pieces.size() == 1) {
        const Patch& patch = patches_.patches[here.pieces[0]];
        piece_[index] = here.pieces[0];
        triangles_.insert(triangles_.end(), patches_.triangles.begin() + patch.first, patches_.triangles.begin() + patch.end);
        continue;
      }
      const std::size_t cut = split(here.pieces);
      // The first side is taken next, so that the triangles of a node are a range.
      open.push_back({Ids(here.pieces.begin() + std::ptrdiff_t(cut), here.pieces.end()), index, 1, here.depth + 1});
      open.push_back({Ids(here.pieces.begin(), here.pieces.begin() + std::ptrdiff_t(cut)), index, 0, here.depth + 1});
    }
  }

  /// Sorts pieces along the axis of their centres' greatest variance; returns how many are on the first side.
  std::size_t split(Ids& pieces) const {
    Vec3 mean = Vec3::Zero();
    for (const std::uint32_t piece : pieces) mean += centres_[piece] / double(pieces.size());
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (const std::uint32_t piece : pieces) square += (centres_[piece] - mean) * (centres_[piece] - mean).transpose();
    const Vec3 axis = eigen(principal_axes(square).row[0]);
    const auto along = [&](std::uint32_t piece) { return axis.dot(centres_[piece]); };
    std::sort(pieces.begin(), pieces.end(),
              [&](std::uint32_t x, std::uint32_t y) { return along(x) < along(y) || (along(x) == along(y) && x < y); });
    const auto at = [&](double place) {
      return std::size_t(std::find_if(pieces.begin(), pieces.end(), [&](std::uint32_t piece) { return along(piece) > place; }) -
                         pieces.begin());
    };
    const std::size_t half = pieces.size() / 2;
    std::size_t cut = half;
    switch (options_.split) {
      case HullSplit::Median: break;
      case HullSplit::Midpoint: cut = at((along(pieces.front()) + along(pieces.back())) / 2); break;
      case HullSplit::Mean: cut = at(axis.dot(mean)); break;
      case HullSplit::Gap: {
        double widest = 0;
        for (std::size_t i = 1; i < pieces.size(); ++i) {
          const double gap = along(pieces[i]) - along(pieces[i - 1]);
          if (gap > widest) widest = gap, cut = i;
        }
      }
    }
    return cut == 0 || cut == pieces.size() ? half : cut;  // all centres are one
  }

  /// Makes the hull of a node whose children have theirs.
  std::optional<Error> fill(std::uint32_t index) {
    HullNode& node = nodes_[index];
    Ids points, triangles;
    if (node.is_piece()) {
      const Patch& patch = patches_.patches[piece_[index]];
      node.end = node.first + patch.end - patch.first;
      triangles.assign(triangles_.begin() + node.first, triangles_.begin() + node.end);
    } else {
      for (const std::uint32_t c : node.child) {
        points.insert(points.end(), drafts_[c]->points.begin(), drafts_[c]->points.end());
        triangles.insert(triangles.end(), drafts_[c]->triangles.begin(), drafts_[c]->triangles.end());
      }
      node.end = nodes_[node.child[1]].end;
      std::sort(triangles.begin(), triangles.end());
    }
    for (const std::uint32_t t : triangles) {
      const auto corners = mesh_.triangle(t);
      points.insert(points.end(), corners.begin(), corners.end());
    }
    make_unique(points);

    Mesh part;
    for (const std::uint32_t p : points) part.points.push_back(mesh_.vertex(p));
    for (const std::uint32_t t : triangles) {
      auto corners = mesh_.triangle(t);
      for (std::uint32_t& v : corners) v = std::uint32_t(std::lower_bound(points.begin(), points.end(), v) - points.begin());
      part.triangles.push_back(corners);
    }
    BuildOptions exact;
    exact.max_levels = 1, exact.table.map_cells = 0;
    Result<Built> built = build(part, exact);
    if (!built) return built.error();
    Draft& draft = drafts_[index].emplace(Draft{std::move(built).value().model});
    const SourceMap source = draft.hull.source();
    for (const std::uint32_t p : source.vertex) draft.points.push_back(points[p]);
    for (const std::uint32_t t : source.face) draft.triangles.push_back(triangles[t]);

    const bool in_solid = node.is_piece() && lies_in_solid(draft.hull);
    classify(node, triangles, in_solid, draft);
    if (node.is_piece()) {
      // A flat patch that covers one side of its hull is all of it.
      const auto is_original = [](std::uint8_t c) { return FaceClass(c) == FaceClass::Original; };
      const bool covers = draft.hull.dimension() == 2 && std::any_of(draft.classes.begin(), draft.classes.end(), is_original);
      if (!in_solid && !covers) {
        Result<MeshModel> surface = MeshModel::from_triangles(part.points, part.triangles);
        if (!surface) return surface.error();
        draft.surface = std::move(surface).value();
      }
    } else {
      const Ids left = places(draft.points, drafts_[node.child[0]]->points),
                right = places(draft.points, drafts_[node.child[1]]->points);
      for (std::size_t v = 0; v < left.size(); ++v) draft.in_child.push_back({left[v], right[v]});
    }
    return {};
  }

  /// The tree, of which nothing but the mesh's own triangles names anything of the mesh.
  Result<HullTree> packed() {
    HullArrays hulls;
    Pool<Vertex> vertices;
    Pool<HalfEdge> half_edges;
    Pool<std::uint32_t> face_first;
    Pool<FacePlane> planes;
    Pool<std::uint8_t> classes;
    Pool<std::array<std::uint32_t, 2>> in_child;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      HullNode& node = nodes_[i];
      Draft& draft = *drafts_[i];
      const Level& level = draft.hull.level(0);
      node.centre = level.view.centre, node.radius = draft.hull.radius();
      node.extent = level.view.extent, node.inner_radius = level.view.inner_radius, node.reach = level.view.reach;
      node.edge_length = float(level.edge_length);
      node.same_cos2 = float(level.same_cos2), node.near_cos2 = float(level.near_cos2);
      node.vertices = vertices.add(level.view.vertices), node.half_edges = half_edges.add(level.view.half_edges);
      node.face_first = face_first.add(level.view.face_first), node.planes = planes.add(level.view.planes);
      node.classes = classes.add(draft.classes).begin, node.in_child = in_child.add(draft.in_child).begin;
      if (half_edges.is_full()) return Error{ErrorCode::TooLarge, "the hulls have more than 2^32 half-edges"};
      if (draft.surface) {
        node.surface = std::uint32_t(hulls.surfaces.size());
        hulls.surfaces.push_back(std::move(*draft.surface));
      }
      drafts_[i].reset();
    }
    hulls.nodes = std::move(nodes_);
    hulls.nodes.shrink_to_fit(), hulls.surfaces.shrink_to_fit();
    hulls.vertices = vertices.take(), hulls.half_edges = half_edges.take(), hulls.face_first = face_first.take();
    hulls.planes = planes.take(), hulls.classes = classes.take(), hulls.in_child = in_child.take();
    return HullTree(mesh_, std::move(triangles_), std::move(hulls));
  }

  /// True if the volume of a piece, which no surface enters, is in the solid: then one point of it is. A mesh may be inside
  /// out, or a component of it bound a cavity.
  bool lies_in_solid(const Model& piece) const {
    const ConvexView& view = piece.level(0).view;
    if (!mesh_.topology().closed() || !(view.inner_radius > 0)) return false;
    return Enclosure(MeshReader::content(mesh_), Pose(), false).holds(vec(view.centre));
  }

  /// Per id, its place among others, or kNone.
  static Ids places(const Ids& ids, const Ids& among) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted;
    for (std::uint32_t i = 0; i < among.size(); ++i) sorted.push_back({among[i], i});
    std::sort(sorted.begin(), sorted.end());
    Ids found;
    for (const std::uint32_t id : ids) {
      const auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair{id, 0u});
      found.push_back(at != sorted.end() && at->first == id ? at->second : kNone);
    }
    return found;
  }

  /// A face that the surface covers is the surface's, one that a child has keeps its class.
  void classify(const HullNode& node, const Ids& triangles, bool in_solid, Draft& draft) const {
    const ConvexView& view = draft.view();
    std::map<Ids, std::uint8_t> known;
    if (!node.is_piece()) {
      for (const std::uint32_t c : node.child) {
        const Draft& child = *drafts_[c];
        for (std::uint32_t f = 0; f < child.classes.size(); ++f) {
          if (child.classes[f] == std::uint8_t(FaceClass::Contained)) known.emplace(border(child, f), child.classes[f]);
        }
      }
    }
    const SourceMap source = draft.hull.source();
    for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
      Ids in_face;
      for (std::uint32_t k = source.face_begin[f]; k < source.face_begin[f + 1]; ++k)
        in_face.push_back(triangles[source.face[k]]);
      FaceClass c = in_solid ? FaceClass::Contained : FaceClass::Free;
      if (is_covered(view, f, in_face)) {
        c = FaceClass::Original;
      } else if (!known.empty()) {
        const auto same = known.find(border(draft, f));
        if (same != known.end()) c = FaceClass(same->second);
      }
      draft.classes.push_back(std::uint8_t(c));
    }
  }

  /// True if triangles that lie in a face cover it. Directed edges of two neighbours cancel; where those that are left lie on
  /// the face's border, along it, the triangles are the whole face, once or several times: so much follows from their having
  /// the same boundary.
  bool is_covered(const ConvexView& view, std::uint32_t face, const Ids& triangles) const {
    if (triangles.empty()) return false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const std::uint32_t t : triangles) {
      const auto corners = mesh_.triangle(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
        ++edges[{from, to}], --edges[{to, from}];
      }
    }
    std::vector<Vec3> loop;
    for (const std::uint32_t v : FaceLoop(view, face))
      loop.push_back(Vec3(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z));
    // Faces and triangles may be in one plane up to rounding alone.
    for (const Vec3& p : loop) {
      if (!on_plane(loop, p)) return false;
    }
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t v : mesh_.triangle(t)) {
        if (!on_plane(loop, mesh_.vertex(v))) return false;
      }
    }
    bool any = false;
    for (const auto& [edge, count] : edges) {
      if (count <= 0) continue;
      any = true;
      const Vec3 from = mesh_.vertex(edge.first), to = mesh_.vertex(edge.second);
      bool on_border = false;
      for (std::size_t k = 0; k < loop.size() && !on_border; ++k) {
        const Vec3 &p = loop[k], &q = loop[(k + 1) % loop.size()];
        on_border = (q - p).dot(to - from) > 0 && on_line(p, q, from) && on_line(p, q, to);
      }
      if (!on_border) return false;
    }
    return any;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  static Kernel::Point_3 point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
  static bool on_line(const Vec3& p, const Vec3& q, const Vec3& r) {
    return r == p || r == q || CGAL::collinear(point(p), point(q), point(r));
  }
  /// True of a point in the plane of a loop's first three corners, which no line holds.
  static bool on_plane(const std::vector<Vec3>& loop, const Vec3& p) {
    return p == loop[0] || p == loop[1] || p == loop[2] ||
           CGAL::coplanar(point(loop[0]), point(loop[1]), point(loop[2]), point(p));
  }

  const MeshModel& mesh_;
  const Decomposition& patches_;
  const HullTreeOptions& options_;
  Watch& watch_;
  std::vector<Vec3> centres_;  ///< of patches: of their surfaces
  Ids triangles_;
  // Per node.
  std::vector<HullNode> nodes_;  ///< without what drafts know, until the end
  Ids depth_, piece_;
  std::vector<std::optional<Draft>> drafts_;
};

}  // namespace

Result<HullTree> build_hull_tree(const MeshModel& mesh, const Decomposition& patches, const HullTreeOptions& options) try {
  std::vector<bool> seen(mesh.triangle_count());
  std::size_t count = 0;
  for (const Patch& patch : patches.patches) {
    if (patch.first >= patch.end || patch.end > patches.triangles.size())
      return Error{ErrorCode::BadValue, "a patch is no range of the decomposition's triangles"};
    for (std::uint32_t i = patch.first; i < patch.end; ++i) {
      const std::uint32_t t = patches.triangles[i];
      if (t < seen.size() && !seen[t]) seen[t] = true, ++count;
    }
  }
  if (count != mesh.triangle_count() || count != patches.triangles.size() || count == 0)
    return Error{ErrorCode::BadValue, "the patches are not of this mesh: each of its triangles must be in one of them"};
  Watch watch(options.progress);
  return Construction(mesh, patches, options, watch).run();
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"};
}

}  // namespace swiftlet
