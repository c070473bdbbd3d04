// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Growth over the dual graph by the three tests of [Ehmann & Lin 2001, sec. 4]: what edges say is found out once for all, then
// a patch's hull decides (patch_hull.h), then the triangles in the boxes of what the hull gains (wedge.h, surface_tree.h). A
// triangle that does not fit a hull does not fit a larger one: it is tried once for each patch.
#include <swiftlet/decompose.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <span>
#include <tuple>

#include "mesh_block.h"
#include "numeric/exact.h"
#include "patch_hull.h"
#include "patches.h"
#include "surface_tree.h"

namespace swiftlet {
namespace {

using namespace lod;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Content = MeshReader::Content;

enum class EdgeKind : std::uint8_t {
  Flat,  ///< both triangles lie in one plane, on both sides of the edge
  Convex,
  Reflex,  ///< or folded back
  Slit,    ///< one of the triangles has no plane
  Defect,  ///< the triangle is joined to none
};

/// Edge k of triangle t, from corner k to the next, is 3 t + k.
struct DualGraph {
  std::vector<std::uint32_t> across;  ///< per edge, the same one of the triangle that is joined there, or kNone
  std::vector<EdgeKind> kind;
  std::vector<bool> open;  ///< per edge: the surface ends here
  std::vector<bool> slit;  ///< per triangle: its corners lie on one line
};

/// An edge as one triangle has it.
struct Side {
  std::uint32_t low, high, third, edge;  ///< third: the triangle's other corner
  bool forward;
};

const Vec& corner(const Content& mesh, std::uint32_t edge) { return mesh.vertices[mesh.triangles[edge / 3][edge % 3]]; }
std::uint32_t next(std::uint32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }

EdgeKind kind_of(const Content& mesh, const DualGraph& graph, std::uint32_t edge) {
  const std::uint32_t other = graph.across[edge];
  if (other == kNone) return EdgeKind::Defect;
  if (graph.slit[edge / 3] || graph.slit[other / 3]) return EdgeKind::Slit;
  const Vec &a = corner(mesh, edge), &b = corner(mesh, next(edge)), &c = corner(mesh, next(next(edge))),
            &d = corner(mesh, next(next(other)));
  const int side = exact::orientation(a, b, c, d);
  if (side != 0) return side > 0 ? EdgeKind::Reflex : EdgeKind::Convex;
  const auto point = [](const Vec& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::coplanar_orientation(point(a), point(b), point(c), point(d)) == CGAL::NEGATIVE ? EdgeKind::Flat
                                                                                              : EdgeKind::Reflex;
}

/// Joins the triangles of one edge two by two. Those with the same corners are one triangle given several times: if there are
/// two different ones, copies that run along the edge in opposite directions are joined in order. What cannot be joined counts.
void join(std::span<const Side> sides, DualGraph& graph, Decomposition& counts) {
  const auto second = std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return s.third != sides[0].third; });
  if (second == sides.end()) {
    for (const Side& side : sides) graph.open[side.edge] = true;
    ++counts.open_edges;
    return;
  }
  if (std::any_of(second, sides.end(), [&](const Side& s) { return s.third != second->third; })) {
    ++counts.non_manifold_edges;
    return;
  }
  const auto joined = [&](const Side& side) { return graph.across[side.edge] != kNone; };
  bool is_any = false;
  for (auto side = sides.begin(); side != second; ++side) {
    const auto other =
        std::find_if(second, sides.end(), [&](const Side& s) { return s.forward != side->forward && !joined(s); });
    if (other == sides.end()) continue;
    graph.across[side->edge] = other->edge, graph.across[other->edge] = side->edge;
    is_any = true;
  }
  if (std::all_of(sides.begin(), sides.end(), joined)) return;
  ++(is_any ? counts.non_manifold_edges : counts.flipped_edges);
}

DualGraph dual_graph(const Content& mesh, Decomposition& counts, Watch& watch) {
  const std::size_t count = mesh.triangles.size();
  DualGraph graph{std::vector<std::uint32_t>(3 * count, kNone), std::vector<EdgeKind>(3 * count), std::vector<bool>(3 * count),
                  std::vector<bool>(count)};
  std::vector<Side> sides;
  sides.reserve(3 * count);
  for (std::uint32_t edge = 0; edge < 3 * count; ++edge) {
    const std::uint32_t v = mesh.triangles[edge / 3][edge % 3], w = mesh.triangles[edge / 3][next(edge) % 3];
    const std::uint32_t third = mesh.triangles[edge / 3][next(next(edge)) % 3];
    if (v != w) sides.push_back({std::min(v, w), std::max(v, w), third, edge, v < w});
    if (edge % 3 == 0)
      graph.slit[edge / 3] = exact::collinear(&corner(mesh, edge).x, &corner(mesh, edge + 1).x, &corner(mesh, edge + 2).x);
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::tie(x.low, x.high, x.third, x.edge) < std::tie(y.low, y.high, y.third, y.edge);
  });
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    join({sides.data() + i, end - i}, graph, counts);
  }
  for (std::uint32_t edge = 0; edge < 3 * count; ++edge) {
    graph.kind[edge] = kind_of(mesh, graph, edge);
    if (graph.across[edge] < edge) {
      counts.reflex_edges += graph.kind[edge] == EdgeKind::Reflex;
      counts.slit_edges += graph.kind[edge] == EdgeKind::Slit;
    }
    if (edge % 3 == 0) watch.work();
  }
  return graph;
}

/// Per triangle, how many edges from it to the nearest reflex one, its own being 0; kNone if none can be reached.
std::vector<std::uint32_t> distances(const DualGraph& graph) {
  std::vector<std::uint32_t> distance(graph.slit.size(), kNone), reached;
  for (std::uint32_t edge = 0; edge < graph.kind.size(); ++edge) {
    if (graph.kind[edge] != EdgeKind::Reflex || distance[edge / 3] == 0) continue;
    distance[edge / 3] = 0;
    reached.push_back(edge / 3);
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (std::uint32_t edge = 3 * reached[i]; edge < 3 * reached[i] + 3; ++edge) {
      const std::uint32_t other = graph.across[edge];
      if (other == kNone || distance[other / 3] != kNone) continue;
      distance[other / 3] = distance[reached[i]] + 1;
      reached.push_back(other / 3);
    }
  }
  return distance;
}

std::vector<std::uint32_t> seeds(const DualGraph& graph, Growth growth) {
  std::vector<std::uint32_t> order(graph.slit.size());
  std::iota(order.begin(), order.end(), 0u);
  if (growth != Growth::Cresting) return order;
  const std::vector<std::uint32_t> distance = distances(graph);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) { return distance[x] > distance[y]; });
  return order;
}

class Decomposer {
 public:
  Decomposer(const MeshModel& mesh, Growth growth, const PatchLimits& limits, Watch& watch)
      : content_(MeshReader::content(mesh)), growth_(growth), limits_(limits), watch_(watch), hull_(content_.vertices) {}

  std::optional<Decomposition> run() {
    const std::size_t count = content_.triangles.size();
    graph_ = dual_graph(content_, result_, watch_);
    const auto convex_sides = std::size_t(std::count(graph_.kind.begin(), graph_.kind.end(), EdgeKind::Convex));
    if (convex_sides / 2 > limits_.convex_edges) return std::nullopt;
    std::vector<bool> open(count);
    for (std::uint32_t edge = 0; edge < 3 * count; ++edge) open[edge / 3] = open[edge / 3] || graph_.open[edge];
    tree_.emplace(content_, open);
    result_.triangles.reserve(count);
    patch_of_.assign(count, kNone), refused_.assign(count, kNone);
    for (const std::uint32_t seed : seeds(graph_, growth_)) {
      if (patch_of_[seed] != kNone) continue;
      if (result_.patches.size() == limits_.patches) return std::nullopt;
      grow(seed);
    }
    return std::move(result_);
  }

 private:
  bool is_entered_by(std::uint32_t, const Corners3& t, const Wedge& wedge, const Outline&) const {
    return lod::enters(t, wedge);
  }
  bool is_entered_by(std::uint32_t triangle, const Corners3& t, const FlatWedge& wedge, const Outline& outline) const {
    if (lod::enters(t, wedge, outline)) return true;
    if (!graph_.open[3 * triangle] && !graph_.open[3 * triangle + 1] && !graph_.open[3 * triangle + 2]) return false;
    const auto& [a, b, c] = wedge.corner;
    for (const Vec& p : t) {
      if (exact::orientation(a, b, c, p) != 0) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (graph_.open[3 * triangle + k] && lod::enters(std::array{t[k], t[(k + 1) % 3]}, wedge)) return true;
    }
    return false;
  }
  template <class W>
  bool is_entered(std::span<const W> wedges) {
    outlines_.clear();
    for (const W& wedge : wedges) outlines_.emplace_back(wedge, content_.root.extent);
    return tree_->any(wedges, outlines_, [&](std::uint32_t triangle, std::uint32_t i) {
      if (patch_of_[triangle] == patch_ || triangle == tried_) return false;
      const Corners& corners = content_.triangles[triangle];
      const Corners3 t{content_.vertices[corners[0]], content_.vertices[corners[1]], content_.vertices[corners[2]]};
      return !outlines_[i].is_apart(t) && is_entered_by(triangle, t, wedges[i], outlines_[i]);
    });
  }

  void grow(std::uint32_t seed) {
    patch_ = std::uint32_t(result_.patches.size());
    const auto first = std::uint32_t(result_.triangles.size());
    take(seed);
    if (!graph_.slit[seed]) {
      hull_.begin(content_.triangles[seed]);
      std::deque<std::uint32_t> edges{3 * seed, 3 * seed + 1, 3 * seed + 2};
      while (!edges.empty()) {
        const std::uint32_t edge = growth_ == Growth::DepthFirst ? edges.back() : edges.front();
        growth_ == Growth::DepthFirst ? edges.pop_back() : edges.pop_front();
        if (graph_.kind[edge] > EdgeKind::Convex) continue;
        const std::uint32_t other = graph_.across[edge];
        if (patch_of_[other / 3] != kNone || refused_[other / 3] == patch_) continue;
        if (!joins(other)) {
          refused_[other / 3] = patch_;
          continue;
        }
        take(other / 3);
        edges.push_back(next(other)), edges.push_back(next(next(other)));
      }
    }
    const auto end = std::uint32_t(result_.triangles.size());
    const std::uint32_t all = graph_.slit[seed] ? 0 : 2 * hull_.vertex_count() - 4;
    result_.patches.push_back({first, end, all > end - first ? all - (end - first) : 0, graph_.slit[seed] || hull_.flat()});
  }

  void take(std::uint32_t triangle) {
    patch_of_[triangle] = patch_;
    result_.triangles.push_back(triangle);
    watch_.work();
  }

  /// Tries the triangle of an edge that it has in common with the patch.
  bool joins(std::uint32_t edge) {
    tried_ = edge / 3;
    const auto vertex = [&](std::uint32_t e) { return content_.triangles[e / 3][e % 3]; };
    switch (hull_.fits(vertex(edge), vertex(next(edge)), vertex(next(next(edge))))) {
      case PatchHull::Fit::Not: ++result_.not_convex; return false;
      case PatchHull::Fit::Within: break;
      case PatchHull::Fit::Flat:
        if (is_entered(hull_.flat_wedges())) return ++result_.entered, false;
        break;
      case PatchHull::Fit::Solid:
        if (is_entered(hull_.wedges())) return ++result_.entered, false;
        break;
    }
    hull_.join();
    return true;
  }

  const Content& content_;
  const Growth growth_;
  const PatchLimits limits_;
  Watch& watch_;
  DualGraph graph_;
  PatchHull hull_;
  std::optional<SurfaceTree> tree_;
  std::vector<Outline> outlines_;                  ///< of the wedges at hand
  std::vector<std::uint32_t> patch_of_, refused_;  ///< per triangle, its patch, and the last one that did not take it
  std::uint32_t patch_ = 0, tried_ = 0;
  Decomposition result_;
};

}  // namespace

std::optional<Decomposition> lod::decompose(const MeshModel& mesh, Growth growth, const PatchLimits& limits, Watch& watch) {
  return Decomposer(mesh, growth, limits, watch).run();
}

Result<Decomposition> decompose(const MeshModel& mesh, const DecomposeOptions& options) try {
  if (!mesh.is_whole()) return Error{ErrorCode::BadValue, "the mesh was cut: it has no triangles"};
  Watch watch(options.progress);
  watch.begin("patches", 1, 2 * double(mesh.triangle_count()));
  Decomposition result = *lod::decompose(mesh, options.growth, {}, watch);
  watch.end();
  return result;
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the decomposition"};
}

}  // namespace swiftlet
