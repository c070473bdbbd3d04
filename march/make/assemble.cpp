// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Makes a Model of surfaces, finest first [Ehmann & Lin 2000, sec. 4.3]: proves enclosure, measures deviations, fills links and
// tables. Knows all levels of one model, no poses.
#include <algorithm>
#include <string>

#include <swiftlet/march.h>

#include "body/block.h"
#include "body/shape.h"
#include "body/table.h"
#include "make/surface.h"
#include "numeric/chunks.h"
#include "pair/certify.h"
#include "pair/start.h"
#include "pair/walk.h"

namespace swiftlet {
namespace {

/// The data of one level before it is written to the block.
struct Draft {
  Surface surface;
  std::vector<std::uint32_t> child_vertex, parent_face;
  std::vector<FeatureId> child_face;
  double deviation = 0;
};

/// A polytope of one vertex, which can be moved.
class PointBody {
 public:
  void move_to(const Vertex& v) { record_ = {v.x, v.y, v.z, 0, 0}; }
  ConvexView view() const {
    ConvexView v;
    v.vertices = {&record_, 1};
    v.extent = max_abs(vec(record_));
    v.centre = Vec3(record_.x, record_.y, record_.z);
    return v;
  }

 private:
  Vertex record_{};
};

constexpr std::size_t kWalksPerTask = 1024;  ///< vertices, faces: each walk begins where the one before ended, the first afar

constexpr std::size_t tasks_over(std::size_t count) { return (count + kWalksPerTask - 1) / kWalksPerTask; }

/// Returns the largest distance of a vertex of `level` from `exact_hull`. The distance to a convex body is a convex function,
/// so no other point of the level is farther.
double deviation_from(const ConvexView& exact_hull, const ConvexView& level, const Executor& executor) {
  MarchRule rule;
  rule.relative = kDeviationPrecision;
  std::vector<double> farthest(tasks_over(level.vertices.size()));
  over_chunks(executor, level.vertices.size(), kWalksPerTask, [&](std::size_t begin, std::size_t end) {
    MarchStart start;
    PointBody point;
    for (const Vertex& v : level.vertices.subspan(begin, end - begin)) {
      point.move_to(v);
      const MarchResult r = march(point.view(), exact_hull, Pose{}, start, rule);
      start.b = r.b;
      farthest[begin / kWalksPerTask] = std::max(farthest[begin / kWalksPerTask], r.upper);
    }
  });
  return *std::max_element(farthest.begin(), farthest.end()) * (1 + 2 * kU);
}

double squared_distance(const ConvexView& view, std::uint32_t v, const Vec& p) {
  const Vec d = vec(view.vertices[v]) - p;
  return dot(d, d);
}

/// Climbs from `start` to a vertex whose neighbours are all no nearer to `p`.
std::uint32_t nearest_of_rings(const ConvexView& view, const Vec& p, std::uint32_t start) {
  for (std::uint32_t best = start;; start = best) {
    const Vertex& ring = view.vertices[start];
    for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
      if (squared_distance(view, view.half_edges[h].head, p) < squared_distance(view, best, p)) best = view.half_edges[h].head;
    }
    if (best == start) return best;
  }
}

/// Returns the feature of `body` nearest to `point`, or `FeatureId{}` if a walk finds the point inside.
FeatureId nearest_feature(const ConvexView& point, const ConvexView& body, const MarchStart& start) {
  const PairView pair = pair_view(point, body, kAtRest, 0);
  std::uint32_t climbs = 0;
  const MarchStart from = settled(pair, start, climbs);
  if (walk(pair, from.a, from.b, PlaneRule::MostViolated, ~0u).end == WalkEnd::Inside) return {};
  return march(point, body, Pose{}, start).b;
}

/// Writes a near vertex of `finer` for each of `vertices` to `nearest`: the nearest corner of the nearest feature. A vertex
/// may lie inside `finer` if that was enlarged to enclose a level finer still; then `nearest_of_rings` climbs from the result
/// for the vertex before.
void find_nearest(std::span<const Vertex> vertices, const ConvexView& finer, std::span<std::uint32_t> nearest) {
  MarchStart start;
  PointBody point;
  std::uint32_t best = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex& v = vertices[i];
    point.move_to(v);
    start.b = nearest_feature(point.view(), finer, start);
    if (start.b.kind() == FeatureKind::None) start.b = {FeatureKind::Vertex, nearest_of_rings(finer, vec(v), best)};
    best = any_vertex(finer, start.b);
    const auto offer = [&](std::uint32_t w) {
      if (squared_distance(finer, w, vec(v)) < squared_distance(finer, best, vec(v))) best = w;
    };
    if (start.b.kind() == FeatureKind::Edge) offer(finer.half_edges[start.b.index()].head);
    if (start.b.kind() == FeatureKind::Face) {
      const std::uint32_t first = finer.face_first[start.b.index()];
      std::uint32_t h = first;
      do {
        offer(finer.half_edges[h].head);
        h = next_in_face(finer, h);
      } while (h != first);
    }
    nearest[i] = best;
  }
}

/// Returns a near vertex of `finer` for each vertex of `level`.
std::vector<std::uint32_t> nearest_vertices(const ConvexView& level, const ConvexView& finer, const Executor& executor) {
  std::vector<std::uint32_t> nearest(level.vertices.size());
  over_chunks(executor, nearest.size(), kWalksPerTask, [&](std::size_t begin, std::size_t end) {
    find_nearest(level.vertices.subspan(begin, end - begin), finer, std::span(nearest).subspan(begin));
  });
  return nearest;
}

/// Returns the face of `finer` whose corners are the children of the corners of `face`, or kNone if refinement removes `face`.
std::uint32_t kept_face(const ConvexView& level, std::uint32_t face, const std::vector<std::uint32_t>& child,
                        const ConvexView& finer) {
  const std::uint32_t h = level.face_first[face];
  const std::uint32_t c0 = child[origin(level, h)], c1 = child[level.half_edges[h].head];
  const Vertex& ring = finer.vertices[c0];
  for (std::uint32_t k = ring.ring_begin; k < ring.ring_begin + ring.ring_count; ++k) {
    if (finer.half_edges[k].head != c1 || is_diagonal(finer, k)) continue;
    std::uint32_t coarse = h, fine = k;
    do {
      if (child[level.half_edges[coarse].head] != finer.half_edges[fine].head) return kNone;
      coarse = next_in_face(level, coarse);
      fine = next_in_face(finer, fine);
    } while (coarse != h && fine != k);
    return coarse == h && fine == k ? finer.half_edges[k].face : kNone;
  }
  return kNone;
}

Result<bool> link_to_finer(Draft& level, const LevelArrays& arrays, const Draft& finer, const std::string& name,
                           const Executor& executor) {
  const ConvexView view = level.surface.view(), fine = finer.surface.view();
  const auto lacks = [&](std::size_t has, const char* member, std::size_t wants, const char* of) -> Error {
    return {ErrorCode::BadValue, name + member + " has " + std::to_string(has) + " entries for " + std::to_string(wants) + of};
  };
  const std::size_t vertices = level.surface.input_vertex.size(), faces = level.surface.input_face.size();
  if (const std::size_t has = arrays.child_vertex.size(); has != 0 && has != vertices)
    return lacks(has, "child_vertex", vertices, " vertices");
  if (const std::size_t has = arrays.child_of_face.size(); has != 0 && has != faces)
    return lacks(has, "child_of_face", faces, " faces");
  const auto ours = [&](std::uint32_t input) {
    return input < finer.surface.input_vertex.size() ? finer.surface.input_vertex[input] : kNone;
  };
  if (arrays.child_vertex.empty()) {
    level.child_vertex = nearest_vertices(view, fine, executor);
  } else {
    for (const std::uint32_t input : level.surface.vertex_input) {
      const std::uint32_t child = ours(arrays.child_vertex[input]);
      if (child == kNone)
        return Error{ErrorCode::BadValue,
                     name + "vertex " + std::to_string(input) + " has no child among the finer level's vertices"};
      level.child_vertex.push_back(child);
    }
  }
  std::vector<std::uint32_t> removed(view.face_first.size(), kNone);
  for (std::size_t f = 0; f < arrays.child_of_face.size(); ++f) {
    if (arrays.child_of_face[f] >= finer.surface.input_vertex.size())
      return Error{ErrorCode::BadValue, name + "face " + std::to_string(f) + " has the child " +
                                            std::to_string(arrays.child_of_face[f]) + ", no vertex of the finer level"};
    removed[level.surface.input_face[f]] = ours(arrays.child_of_face[f]);
  }
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    const std::uint32_t kept = kept_face(view, f, level.child_vertex, fine);
    if (kept != kNone)
      level.child_face.push_back({FeatureKind::Face, kept});
    else
      level.child_face.push_back(
          {FeatureKind::Vertex, removed[f] != kNone ? removed[f] : level.child_vertex[origin(view, view.face_first[f])]});
  }
  return true;
}

/// Sets `parent_face`: per face of `level`, the support vertex of `coarser` along the face's normal.
void link_to_coarser(Draft& level, const ConvexView& coarser, const Executor& executor) {
  const ConvexView view = level.surface.view();
  level.parent_face.resize(view.face_first.size());
  over_chunks(executor, view.face_first.size(), kWalksPerTask, [&](std::size_t begin, std::size_t end) {
    std::uint32_t v = 0, comparisons = 0;
    for (auto f = std::uint32_t(begin); f < end; ++f)
      level.parent_face[f] = v = support(coarser, face_normal(Resting{view, 0}, f), v, comparisons);
  });
}

template <class T>
void append(std::vector<std::byte>& to, const std::vector<T>& from) {
  const auto bytes = std::as_bytes(std::span(from));
  to.insert(to.end(), bytes.begin(), bytes.end());
}

std::vector<std::byte> level_bytes(const Draft& d) {
  std::vector<std::byte> bytes;
  append(bytes, d.surface.vertices);
  append(bytes, d.surface.planes);
  append(bytes, d.surface.half_edges);
  append(bytes, d.surface.face_first);
  append(bytes, d.child_vertex);
  append(bytes, d.child_face);
  append(bytes, d.parent_face);
  return bytes;
}

LevelHeader level_header(const Draft& d) {
  const Surface& s = d.surface;
  const ConvexView view = s.view();
  LevelHeader header{};
  header.vertex_count = std::uint32_t(s.vertices.size());
  header.half_edge_count = std::uint32_t(s.half_edges.size());
  header.face_count = std::uint32_t(s.face_first.size());
  header.plane_count = std::uint32_t(s.planes.size());
  header.rims = s.rims;
  std::size_t borders = 0;
  double length = 0;
  for (std::uint32_t h = 0; h < s.half_edges.size(); ++h) {
    borders += !is_diagonal(view, h);
    length += norm(vec(view.vertices[view.half_edges[h].head]) - vec(view.vertices[origin(view, h)]));
  }
  header.edge_length = s.half_edges.empty() ? 0 : length / double(s.half_edges.size());
  header.edge_count = borders / 2;
  header.triangle_count = s.dimension >= 2 ? 2 * s.vertices.size() - 4 : 0;
  header.extent = s.extent;
  header.deviation = d.deviation;
  header.volume = s.volume;
  header.reach = reach_of(view);
  return header;
}

/// Returns the area centroid, or the mean of the vertices if the body has no area.
Vec centroid(const ConvexView& view) {
  const Vec o = vec(view.vertices[0]);
  Vec sum{0, 0, 0};
  double area = 0;
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    const std::uint32_t first = view.face_first[f];
    const Vec p = vec(view.vertices[origin(view, first)]) - o;
    for (std::uint32_t h = next_in_face(view, first); view.half_edges[h].head != origin(view, first);
         h = next_in_face(view, h)) {
      const Vec q = vec(view.vertices[origin(view, h)]) - o, r = vec(view.vertices[view.half_edges[h].head]) - o;
      const double twice = norm(cross(q - p, r - p));
      sum = sum + (p + q + r) * (twice / 3);
      area += twice;
    }
  }
  if (area > 0) return o + sum * (1 / area);
  for (const Vertex& v : view.vertices) sum = sum + (vec(v) - o) * (1.0 / double(view.vertices.size()));
  return o + sum;
}

void describe(BlockHeader& header, const Surface& surface) {
  const ConvexView view = surface.view();
  const Vec c = centroid(view);
  const Box box = box_of(view.vertices);
  header.dimension = std::uint32_t(surface.dimension);
  header.radius = outer_radius_of(view, c);
  for (const auto& [to, from] : {std::pair{header.centre, c}, {header.box_min, box.least}, {header.box_max, box.most}}) {
    to[0] = from.x, to[1] = from.y, to[2] = from.z;
  }
}

/// Writes the source section of a block, the user's ids of vertices and faces; returns the number of its triangle ids.
Result<std::uint64_t> write_source(BlockParts& parts, const LevelArrays& arrays, const Surface& surface) {
  const std::size_t inputs = surface.input_face.size();
  const bool own_ids = arrays.face_source_begin.empty();
  if (!own_ids) {
    const auto& begin = arrays.face_source_begin;
    if (begin.size() != inputs + 1 || begin.front() != 0 || begin.back() != arrays.face_source.size() ||
        !std::is_sorted(begin.begin(), begin.end())) {
      return Error{ErrorCode::BadValue, "face_source_begin does not fit the faces"};
    }
  }
  if (!arrays.vertex_source.empty() && arrays.vertex_source.size() != surface.input_vertex.size()) {
    return Error{ErrorCode::BadValue, "vertex_source does not fit the vertices"};
  }
  std::vector<std::uint32_t> vertex, face_begin(surface.face_first.size() + 1, 0), face;
  for (const std::uint32_t v : surface.vertex_input)
    vertex.push_back(arrays.vertex_source.empty() ? v : arrays.vertex_source[v]);
  std::vector<std::vector<std::uint32_t>> held(surface.face_first.size());
  for (std::uint32_t f = 0; f < inputs; ++f) {
    auto& list = held[surface.input_face[f]];
    if (own_ids)
      list.push_back(f);
    else
      list.insert(list.end(), arrays.face_source.begin() + arrays.face_source_begin[f],
                  arrays.face_source.begin() + arrays.face_source_begin[f + 1]);
  }
  for (std::size_t f = 0; f < held.size(); ++f) {
    std::sort(held[f].begin(), held[f].end());
    face.insert(face.end(), held[f].begin(), held[f].end());
    face_begin[f + 1] = std::uint32_t(face.size());
  }
  append(parts.source, vertex);
  append(parts.source, face_begin);
  append(parts.source, face);
  return std::uint64_t(face.size());
}

}  // namespace

Result<Model> Model::from_levels(std::span<const LevelArrays> levels, const ModelOptions& options) {
  if (levels.empty()) return Error{ErrorCode::Empty, "no levels"};
  if (levels.size() > kMaxLevels)
    return Error{ErrorCode::TooLarge, std::to_string(levels.size()) + " levels, at most " + std::to_string(kMaxLevels)};
  if (std::string fault = spec_fault(options.table); !fault.empty()) return Error{ErrorCode::BadValue, std::move(fault)};
  std::vector<Draft> drafts;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string name = levels.size() == 1 ? "" : "level " + std::to_string(i) + ": ";
    Result<Surface> surface = make_surface(levels[i], options.repair, options.executor);
    if (!surface) return Error{surface.error().code, name + surface.error().message};
    Draft draft;
    draft.surface = std::move(surface).value();
    if (i > 0) {
      const ConvexView exact_hull = drafts[0].surface.view(), view = draft.surface.view();
      if (drafts[0].surface.dimension < 3 || draft.surface.dimension < 3)
        return Error{ErrorCode::NotSolid, name + "only solids have coarser levels"};
      if (const std::uint32_t v = vertex_outside(exact_hull, view); v != kNone) {
        return Error{ErrorCode::NotEnclosing,
                     name + "vertex " + std::to_string(drafts[0].surface.vertex_input[v]) + " of level 0 is outside"};
      }
      draft.deviation = deviation_from(exact_hull, view, options.executor);
      if (auto linked = link_to_finer(draft, levels[i], drafts.back(), name, options.executor); !linked) return linked.error();
      link_to_coarser(drafts.back(), view, options.executor);
    }
    drafts.push_back(std::move(draft));
  }
  BlockParts parts;
  describe(parts.header, drafts[0].surface);
  for (const Draft& draft : drafts) {
    parts.level_headers.push_back(level_header(draft));
    parts.levels.push_back(level_bytes(draft));
  }
  const Vec centre{parts.header.centre[0], parts.header.centre[1], parts.header.centre[2]};
  parts.header.inner_radius = inner_radius_of(drafts[0].surface.view(), centre);
  const Result<std::uint64_t> sources = write_source(parts, levels[0], drafts[0].surface);
  if (!sources) return sources.error();
  parts.header.source_face_count = sources.value();
  fill_table(parts, options.table, drafts[0].surface.vertices, options.executor);
  std::vector<ConvexView> views;
  for (const Draft& draft : drafts) views.push_back(draft.surface.view());
  fill_maps(parts, options.table, views, options.executor);
  views.clear(), drafts.clear();  // what is composed needs as much room again
  return BlockReader::read(compose(parts));
}

}  // namespace swiftlet
