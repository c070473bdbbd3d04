// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The first place of a query, the links between levels, and directions packed into a seed. Does not walk.
#include "query/seed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "body/half_edge.h"
#include "body/support_map.h"
#include "pair/certify.h"

namespace swiftlet {
namespace {

bool legal_level(const Shape& body, int level, int finest) { return level >= finest && level < body.level_count(); }

constexpr double kLineUnit = 32767;
std::array<std::int16_t, 3> packed(const Vec& unit) {
  const auto units = [](double x) { return std::int16_t(x * kLineUnit); };
  return {units(unit.x), units(unit.y), units(unit.z)};
}

/// True if the line of centres, of squared length `length2`, has turned so far since a seed packed it as `was` that a walk
/// would cross more than about `kWarmEdges` edges of the level (`kWarmEdgesUnmapped` without a map). A level of V vertices is
/// taken to have sqrt(V) edges per radian; the angle is taken as its chord, whose square is 2 - 2 cos.
bool turned_far(const Vec& line, double length2, const std::array<std::int16_t, 3>& was, const Level& level) {
  if ((was[0] | was[1] | was[2]) == 0) return false;  // unknown, as in a seed made by hand
  const double along = dot(line, {double(was[0]), double(was[1]), double(was[2])});
  const double edges = level.map_side > 0 ? kWarmEdges : kWarmEdgesUnmapped;
  const double whole = 2 * double(level.view.vertices.size()), least = whole - edges * edges;
  return least > 0 && !(along > 0 && along * along * (whole * whole) >= least * least * length2 * (kLineUnit * kLineUnit));
}

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

Place first_place(const Shape& a, const Shape& b, const Line& line, const PairSeed& seed, int finest_a, int finest_b,
                  StartPolicy policy) {
  const bool seed_fits = seed.a.kind() != FeatureKind::None && seed.b.kind() != FeatureKind::None &&
                         legal_level(a, seed.level_a, finest_a) && legal_level(b, seed.level_b, finest_b);
  Place coarsest = coarsest_place(a, b);
  switch (policy) {
    case StartPolicy::Table:
      if (finest_a == 0 && finest_b == 0) return {0, 0, from_tables(a, b, line)};
      return {finest_a, finest_b, {}};
    case StartPolicy::Finest:
      if (seed_fits && seed.level_a == finest_a && seed.level_b == finest_b) {
        return {finest_a, finest_b, {seed.a, seed.b}};
      }
      return {finest_a, finest_b, {}};
    case StartPolicy::Coarsest:
      if (seed.level_a == coarsest.level_a && seed.level_b == coarsest.level_b) coarsest.start = {seed.a, seed.b};
      return coarsest;
    default:
      if (!seed_fits) return coarsest;
      Place place{seed.level_a, seed.level_b, {seed.a, seed.b}};
      const Level &level_a = a.level(seed.level_a), &level_b = b.level(seed.level_b);
      const bool has_choice = seed.level_a < coarsest.level_a || seed.level_b < coarsest.level_b || level_a.map_side > 0;
      if (policy == StartPolicy::Paper || !has_choice) return place;
      if (turned_far(line, seed, level_a, level_b)) return coarsest;
      place.trial_steps = kTrialSteps;
      return place;
  }
}

bool turned_far(const Line& line, const PairSeed& seed, const Level& a, const Level& b) {
  const double length2 = dot(line.in_a, line.in_a);
  return turned_far(line.in_a, length2, seed.line_in_a, a) || turned_far(line.in_b, length2, seed.line_in_b, b);
}

void remember(const Line& line, const Vec& normal, PairSeed& seed) {
  seed.normal = packed(normal * (1 - 4 * kU));
  const double length = norm(line.in_a), inverse = length > 0 ? (1 - 4 * kU) / length : 0;  // so that no coordinate is above 1
  const double scale = std::isfinite(inverse) ? inverse : 0;  // centres nearer than 1e-308 count as one point
  seed.line_in_a = packed(line.in_a * scale);
  seed.line_in_b = packed(line.in_b * scale);
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
