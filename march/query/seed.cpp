// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The first place of a query, the links between levels, and directions packed into a seed. Does not walk.
#include "query/seed.h"

#include <algorithm>

#include "body/half_edge.h"
#include "body/support_map.h"
#include "pair/certify.h"

namespace swiftlet {
namespace {

FeatureId table_start(const Shape& body, const Vec& direction) {
  return body.model() ? swiftlet::table_start(*body.model(), eigen(direction)) : FeatureId{};
}
MarchStart from_tables(const Shape& a, const Shape& b, const Line& line) {
  return {table_start(a, line.in_a), table_start(b, line.in_b)};
}

}  // namespace

FeatureId table_start(const Model& model, const Vec3& direction) {
  if (model.finest_level() > 0 || (model.table().empty() && model.map_level() == model.level_count())) return {};
  if (model.table().empty()) return {FeatureKind::Vertex, about_farthest(Shape(model), 0, vec(direction))};
  const std::uint32_t sample = lut::nearest(model.table_spec().resolution, {direction[0], direction[1], direction[2]});
  return {FeatureKind::Vertex, model.table()[sample]};
}

Place place_by_policy(const Shape& a, const Shape& b, const Line& line, const PairSeed& seed, int finest_a, int finest_b,
                      StartPolicy policy) {
  const bool seed_fits = fits(seed, a, b, finest_a, finest_b);
  const MarchStart of_seed{seed.a, seed.b};
  Place coarsest = coarsest_place(a, b);
  switch (policy) {
    case StartPolicy::Table:
      if (finest_a == 0 && finest_b == 0) return {0, 0, from_tables(a, b, line)};
      return {finest_a, finest_b, {}};
    case StartPolicy::Finest:
      if (seed_fits && seed.level_a == finest_a && seed.level_b == finest_b) return {finest_a, finest_b, of_seed};
      return {finest_a, finest_b, {}};
    case StartPolicy::Coarsest:
      if (seed.level_a == coarsest.level_a && seed.level_b == coarsest.level_b) coarsest.start = of_seed;
      return coarsest;
    default: return seed_fits ? Place{seed.level_a, seed.level_b, of_seed} : coarsest;
  }
}

FeatureId child(const Shape& body, int level, FeatureId feature) {
  const Level& from = body.level(level);
  const ConvexView& fine = body.level(level - 1).view;
  const auto vertex_child = [&](std::uint32_t v) { return from.child_vertex[v]; };
  if (feature.kind() == FeatureKind::Vertex) return {FeatureKind::Vertex, vertex_child(feature.index())};
  if (feature.kind() == FeatureKind::Face) return from.child_face[feature.index()];
  // The child of an edge is the finer level's edge between the children of its ends, if there is one. Otherwise it is the
  // vertex that stands for the face on the edge's left, or if a face does, the child of the edge's origin.
  const std::uint32_t tail = vertex_child(origin(from.view, feature.index())),
                      head = vertex_child(from.view.half_edges[feature.index()].head);
  const Vertex& ring = fine.vertices[tail];
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (fine.half_edges[h].head == head) return {FeatureKind::Edge, h};
  }
  const FeatureId beside = from.child_face[from.view.half_edges[feature.index()].face];
  return beside.kind() == FeatureKind::Vertex ? beside : FeatureId{FeatureKind::Vertex, tail};
}

FeatureId parent(const Shape& body, int level, FeatureId feature) {
  const Level& from = body.level(level);
  std::uint32_t face = feature.index();
  if (feature.kind() == FeatureKind::Vertex) face = from.view.half_edges[from.view.vertices[feature.index()].ring_begin].face;
  if (feature.kind() == FeatureKind::Edge) face = from.view.half_edges[feature.index()].face;
  return {FeatureKind::Vertex, from.parent_face[face]};
}

std::uint32_t about_farthest(const Shape& body, int level, const Vec& direction) {
  const int mapped = std::max(level, body.map_level());
  if (mapped == body.level_count()) return 0;
  return descendant(body, mapped, look_up(body.level(mapped), direction).vertex, level);
}

std::uint32_t descendant(const Shape& body, int level, std::uint32_t vertex, int finer) {
  for (; level > finer; --level) vertex = body.level(level).child_vertex[vertex];
  return vertex;
}

}  // namespace swiftlet
