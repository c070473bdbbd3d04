// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "seed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "certify.h"
#include "ring.h"

namespace swiftlet {
namespace {

bool names_feature(const ConvexView& view, Handle h) {
  switch (h.kind()) {
    case FeatureKind::Vertex: return h.index() < view.vertices.size();
    case FeatureKind::Edge: return h.index() < view.head.size();
    case FeatureKind::Face: return h.index() < view.face_first.size();
    default: return false;
  }
}

bool legal_level(const Model& model, int level, int finest) { return level >= finest && level < model.level_count(); }

Place level_place(int level_a, int level_b, const MarchStart& start) { return {level_a, level_b, start}; }

constexpr double kLineUnit = 32767;
Vec unpacked(const std::array<std::int16_t, 3>& v) { return Vec{double(v[0]), double(v[1]), double(v[2])} * (1 / kLineUnit); }
std::array<std::int16_t, 3> packed(const Vec& v) {
  const auto unit = [](double x) {
    const double units = larger(-1, smaller(1, x)) * kLineUnit;
    return std::int16_t(units < 0 ? units - 0.5 : units + 0.5);
  };
  return {unit(v.x), unit(v.y), unit(v.z)};
}

/// The steps a walk will take from features found when the line of centres was `seed`'s.
double predicted_steps(const Model& a, const Model& b, const Line& line, const PairSeed& seed) {
  const double edges_a =
      norm(line.in_a - unpacked(seed.line_in_a)) * std::sqrt(double(a.level(seed.level_a).view.vertices.size()));
  const double edges_b =
      norm(line.in_b - unpacked(seed.line_in_b)) * std::sqrt(double(b.level(seed.level_b).view.vertices.size()));
  return kStepsPerEdge * (edges_a + edges_b);
}

/// The table's vertices for the direction between the centres.
MarchStart from_tables(const Model& a, const Model& b, const Line& line) {
  MarchStart start;
  const auto look_up = [](const Model& model, const Vec& direction) -> Handle {
    if (model.table().empty()) return {};
    const std::uint32_t sample = lut::nearest(model.table_spec().resolution, {direction.x, direction.y, direction.z});
    return {FeatureKind::Vertex, model.table()[sample]};
  };
  start.a = look_up(a, line.in_a);
  start.b = look_up(b, line.in_b);
  return start;
}

}  // namespace

Line line_of_centres(const Model& a, const Model& b, const Motion& m) {
  const Vec d = apply(m, vec(b.level(0).view.centre)) - vec(a.level(0).view.centre);
  const double length = norm(d);
  const Vec in_a = length > 0 ? d * (1 / length) : Vec{0, 0, 0};
  return {in_a, -turn_back(m, in_a)};
}

MarchStart settled(const Scene& scene, const MarchStart& start, std::uint32_t& plane_tests) {
  MarchStart s = start;
  const bool known_a = names_feature(scene.a, s.a), known_b = names_feature(scene.b, s.b);
  if (!known_a || !known_b) {
    const Vec d = rescaled(apply(scene.b_in_a, vec(scene.b.centre)) - vec(scene.a.centre));
    if (!known_a) s.a = {FeatureKind::Vertex, support_a(scene, d, 0, plane_tests)};
    if (!known_b) s.b = {FeatureKind::Vertex, support_b(scene, d, 0, plane_tests)};
  }
  if (s.a.kind() == FeatureKind::Face && s.b.kind() == FeatureKind::Face) s.b = {FeatureKind::Vertex, any_vertex(scene.b, s.b)};
  return s;
}

Place coarsest_place(const Model& a, const Model& b) { return level_place(a.level_count() - 1, b.level_count() - 1, {}); }

Place first_place(const Model& a, const Model& b, const Line& line, const PairSeed& seed, const QueryOptions& options) {
  const int finest_a = std::clamp(options.finest_level, 0, a.level_count() - 1);
  const int finest_b = std::clamp(options.finest_level, 0, b.level_count() - 1);
  const bool seed_fits = seed.a.kind() != FeatureKind::None && seed.b.kind() != FeatureKind::None &&
                         legal_level(a, seed.level_a, finest_a) && legal_level(b, seed.level_b, finest_b);
  Place coarsest = coarsest_place(a, b);
  switch (options.start) {
    case StartPolicy::Table:
      if (finest_a == 0 && finest_b == 0) return level_place(0, 0, from_tables(a, b, line));
      return level_place(finest_a, finest_b, {});
    case StartPolicy::Finest:
      if (seed_fits && seed.level_a == finest_a && seed.level_b == finest_b) {
        return level_place(finest_a, finest_b, {seed.a, seed.b});
      }
      return level_place(finest_a, finest_b, {});
    case StartPolicy::Coarsest: coarsest.start = {seed.coarse_a, seed.coarse_b}; return coarsest;
    default:
      if (!seed_fits) return coarsest;
      Place place = level_place(seed.level_a, seed.level_b, {seed.a, seed.b});
      const int above = std::max(coarsest.level_a - seed.level_a, coarsest.level_b - seed.level_b);
      if (options.start == StartPolicy::Paper || above <= 0) return place;
      const double descent = kStepsPerLevel * (above + 1);
      if (predicted_steps(a, b, line, seed) > descent) return coarsest;
      place.trial_steps = std::uint32_t(kTrialFactor * descent);
      return place;
  }
}

void remember_line(const Line& line, PairSeed& seed) {
  seed.line_in_a = packed(line.in_a);
  seed.line_in_b = packed(line.in_b);
}

Handle child(const Model& model, int level, Handle feature) {
  const Level& from = model.level(level);
  const ConvexView& fine = model.level(level - 1).view;
  const auto vertex_child = [&](std::uint32_t v) { return from.child_vertex[v]; };
  if (feature.kind() == FeatureKind::Vertex) return {FeatureKind::Vertex, vertex_child(feature.index())};
  if (feature.kind() == FeatureKind::Face) return from.child_face[feature.index()];
  // An edge that the finer level still has is its own child; else whatever stands for a face beside it.
  const std::uint32_t tail = vertex_child(origin(from.view, feature.index())),
                      head = vertex_child(from.view.head[feature.index()]);
  const Vertex& ring = fine.vertices[tail];
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (fine.head[h] == head) return {FeatureKind::Edge, h};
  }
  const Handle beside = from.child_face[from.view.face[feature.index()]];
  return beside.kind() == FeatureKind::Vertex ? beside : Handle{FeatureKind::Vertex, tail};
}

Handle parent(const Model& model, int level, Handle feature) {
  const Level& from = model.level(level);
  std::uint32_t face = feature.index();
  if (feature.kind() == FeatureKind::Vertex) face = from.view.face[from.view.vertices[feature.index()].ring_begin];
  if (feature.kind() == FeatureKind::Edge) face = from.view.face[feature.index()];
  return {FeatureKind::Vertex, from.parent_face[face]};
}

}  // namespace swiftlet
