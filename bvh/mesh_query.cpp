// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The queries about meshes: each turns its question into one about the surfaces, and what the search finds into an answer.
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>

#include "body/shape.h"
#include "mesh_setting.h"
#include "query/ask.h"
#include "solid.h"

namespace swiftlet {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Verdict verdict_of(const MeshFinding& found, double law_two) {
  if (found.verdict == Verdict::Overlapping) return Verdict::Overlapping;
  if (found.lower > 0) return Verdict::Disjoint;
  return found.upper <= law_two ? Verdict::Touching : Verdict::Undecided;
}

Status status_of(const MeshFinding& found, const StopRule& stop, double law_two, bool whole) {
  if (found.verdict == Verdict::Overlapping || stop.at_least(law_two).narrow(found.lower, found.upper) ||
      found.upper < stop.below)
    return Status::Converged;
  if (found.lower > stop.above) return Status::Beyond;
  if (found.cut_short) return Status::Budget;
  if (found.upper - found.lower <= law_two) return Status::Converged;
  return whole ? Status::NotConverged : Status::LevelLimit;
}

/// The memory of a front that is to serve both bodies, or null.
FrontReader::State* serving(MeshFront* front, const MeshSetting& at, const MeshBody& a, const MeshBody& b) {
  FrontReader::State* const state = front ? FrontReader::state(*front) : nullptr;
  if (!state || !a.mesh() || !b.mesh() || !at.a.is_whole() || !at.b.is_whole()) return nullptr;
  if (at.a.has_patches() && at.b.has_patches()) return nullptr;
  state->serve(*a.mesh(), *b.mesh());
  return state;
}

/// Searches. Within law 2's bound of contact of the surfaces or of the bodies, or of a threshold, what is seen first decides
/// the verdict: there a cold search does, so that no seed can [law 3].
void look(const MeshSetting& at, const Pose& b_in_a, const StopRule& stop, std::uint32_t steps, MeshSeed& seed,
          FrontReader::State* front, MeshFinding& found) {
  const bool cold = !front && seed.triangle_a == kNone && seed.direction == MeshSeed{}.direction;
  const StopRule passed = cold ? stop : stop.beyond_by(at.law_two);
  search(at.a, at.b, b_in_a, {passed, at.law_two, at.size, steps, front}, seed, found);
  if (cold || found.sure || found.cut_short || found.refused || found.upper < passed.below) return;
  const double near = 3 * at.law_two;
  const bool near_contact = found.verdict == Verdict::Overlapping || found.upper <= near ||
                            (!at.radii.none() && found.lower <= stop.zero + near && found.upper >= stop.zero - near);
  const bool near_threshold = found.lower <= passed.above && found.upper >= stop.above - near;
  if (!near_contact && !near_threshold) return;
  const std::uint32_t nodes = found.nodes, triangles = found.triangles;
  seed = {}, found = {};
  search(at.a, at.b, b_in_a, {stop, at.law_two, at.size, steps - std::min(steps, nodes + triangles)}, seed, found);
  found.nodes += nodes, found.triangles += triangles;
}

/// True of a mesh without a radius that is its surface.
bool is_plain(const MeshBody& body) { return body.mesh() && !body.is_solid() && body.radius() == 0; }

/// Asks about the surfaces and, of solids, what is inside them.
[[gnu::noinline]] void ask_search(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, QueryPose& placed, MeshSeed& seed,
                                  MeshFront* front, const Budget& budget, const StopRule& asked, Answer& answer) {
  const MeshSetting at(a, b, placed.motion, placed.quality);
  answer.radius_a = a.radius(), answer.radius_b = b.radius();
  if (answer.status = at.fault(); answer.status != Status::Converged) return;

  // With radii thresholds are passed by more than rounding may take back.
  const StopRule stop = at.radii.none() ? asked : at.radii.of_hulls(asked, at.law_two).beyond_by(at.law_two);
  MeshFinding found;
  const double enough = max(stop.above, 0);
  const bool asks_roots = stop.is_threshold() && !(is_plain(a) && is_plain(b));
  const Top top_a{*at.a.root, *at.a.nodes}, top_b{*at.b.root, *at.b.nodes};
  if (const double gap = asks_roots ? gap_of_roots(top_a, top_b, b_in_a, enough, placed) : 0; gap > enough) {
    found.lower = gap;
  } else {
    look(at, b_in_a, stop, budget.steps, seed, serving(front, at, a, b), found);
  }
  const bool any_solid = at.a.solid || at.b.solid;
  if (any_solid && found.verdict != Verdict::Overlapping && !found.refused && !(found.upper < stop.below))
    look_inside(at.a, at.b, b_in_a, {stop, at.law_two, at.size, budget.steps}, found);
  answer.steps = found.nodes, answer.plane_tests = found.triangles;
  if (found.refused) {
    answer.status = Status::InvalidBody;
    return;
  }
  answer.status = status_of(found, stop, at.law_two, at.a.is_whole() && at.b.is_whole());
  describe(at, found, answer);
}

void ask(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront* front, const Budget& budget,
         const StopRule& asked, Answer& answer) {
  QueryPose placed;
  // It is what most questions about bodies far from each other end with, before anything of a search is made.
  if (asked.is_threshold() && is_plain(a) && is_plain(b)) {
    const auto top_of = [](const MeshBody& body) {
      const MeshReader::Content& content = MeshReader::content(*body.mesh());
      return Top{content.root, content.nodes[0]};
    };
    const double enough = max(asked.above, 0), gap = gap_of_roots(top_of(a), top_of(b), b_in_a, enough, placed);
    if (gap > enough) {
      answer.status = asked.narrow(gap, answer.upper) ? Status::Converged : Status::Beyond;
      answer.verdict = Verdict::Disjoint, answer.lower = gap;
      return;
    }
  } else {
    placed.motion = motion(b_in_a), placed.quality = pose_quality(placed.motion);
  }
  ask_search(a, b, b_in_a, placed, seed, front, budget, asked, answer);
}

/// Asks about convex bodies alone; `Asker` asks query.h.
template <class Asker>
bool both_convex(const MeshBody& a, const MeshBody& b, MeshSeed& seed, const Asker& asker) {
  if (a.mesh() || b.mesh()) return false;
  asker(a.convex(), b.convex(), seed.pair);
  return true;
}

}  // namespace

SourceFeature source_feature(const MeshBody& body, FeatureId feature, int level) {
  if (!body.mesh()) return level == 0 ? source_feature(body.convex(), feature) : SourceFeature{};
  const MeshModel& mesh = *body.mesh();
  SourceFeature source{feature.kind(), {kNone, kNone}, {}};
  const std::uint32_t i = feature.index();
  const auto vertex = [&](std::uint32_t v) { return mesh.source_vertex()[v]; };
  if (feature.kind() == FeatureKind::Vertex) source.vertices[0] = vertex(i);
  if (feature.kind() == FeatureKind::Edge) {
    const std::array<std::uint32_t, 3> corners = mesh.triangle(i / 3);
    source.vertices = {vertex(corners[i % 3]), vertex(corners[(i + 1) % 3])};
  }
  if (feature.kind() == FeatureKind::Face) source.triangles = mesh.source_triangle().subspan(i, 1);
  return source;
}

void describe(const MeshSetting& at, const MeshFinding& found, Answer& answer) {
  answer.lower = found.lower, answer.upper = found.upper;
  answer.verdict = verdict_of(found, at.law_two);
  answer.feature_a = found.feature_a, answer.feature_b = found.feature_b;
  answer.level_a = std::int16_t(found.level_a), answer.level_b = std::int16_t(found.level_b);
  answer.normal = eigen(found.normal);
  if (answer.upper < kInfinity) answer.point_a = eigen(found.point_a), answer.point_b = eigen(found.point_b);
  if (!at.radii.none()) {
    OverlapProof none;
    if (answer.verdict != Verdict::Overlapping) answer.verdict = Verdict::Disjoint;  // `round` tells from the bounds
    at.radii.round(answer, none, at.law_two);
  }
  if (found.verdict == Verdict::Overlapping || answer.normal.isZero(0)) answer.normal = Vec3::Constant(kUnknown);
}

ConvexLeaf::ConvexLeaf(const Body& of) : body(without_radius(of)) {
  const ShapeOf shape(body);
  is_legal = shape.is_legal();
  if (!is_legal) return;
  const ConvexView& view = (*shape).level(0).view;
  const int unit = unit_of(view.extent);
  point = view.vertices.empty() ? vec(body.model()->centre()) : vec(view.vertices[0]);
  const Model* const model = body.model();
  const Box box = model ? Box{vec(model->box_min()), vec(model->box_max())} : box_of(view.vertices);
  node.link = Node::link_of(0, 1, true);
  node.axis[0][0] = node.axis[1][1] = 1;
  for (int k = 0; k < 3; ++k) {
    const double low = times_power_of_two(eigen(box.least)[k], -unit), high = times_power_of_two(eigen(box.most)[k], -unit);
    node.origin[k] = low + (high - low) / 2;
    node.half[k][0] = node.extent[k] = float((max(high - node.origin[k], node.origin[k] - low) + kBoxMargin) * (1 + kFloatUp));
  }
  root = root_of(node, unit, view.extent);
}

MeshView::MeshView(const MeshBody& body) {
  if (const MeshModel* const mesh = body.mesh()) {
    content = &MeshReader::content(*mesh);
    root = &content->root, nodes = content->nodes.data(), triangles = content->triangles.data(),
    vertices = content->vertices.data();
    node_count = std::uint32_t(content->nodes.size()), triangle_count = std::uint32_t(content->triangles.size());
    solid = body.is_solid();
    is_legal = !solid || (content->topology.closed() && content->is_whole());
    return;
  }
  content = nullptr, solid = false;
  const ConvexLeaf& leaf = convex.emplace(body.convex());
  root = &leaf.root, nodes = &leaf.node, triangles = nullptr, vertices = nullptr, node_count = triangle_count = 1,
  is_legal = leaf.is_legal;
}

std::uint32_t MeshView::patch_with(std::uint32_t triangle) const {
  if (convex) return 0;
  const auto next = std::upper_bound(content->patches.begin(), content->patches.end(), triangle,
                                     [](std::uint32_t t, const PatchRange& patch) { return t < patch.begin; });
  return next != content->patches.begin() && triangle < (next - 1)->end ? (next - 1)->node : kNone;
}

namespace {

/// The least of a point's barycentric coordinates in a triangle, whose plane it is taken into. Below 0 outside.
double least_share(const Vec& point, const Vec& p, const Vec& q, const Vec& r) {
  const Vec n = cross(q - p, r - p);
  const auto share = [&](const Vec& from, const Vec& to) { return dot(cross(to - from, point - from), n); };
  const double least = min(share(p, q), min(share(q, r), share(r, p)));
  return least / dot(n, n);
}

}  // namespace

std::uint32_t MeshView::triangle_at(std::uint32_t node, FeatureId feature, const Vec& point) const {
  if (convex) return 0;
  const NodeHull& hull = *content->hull_at(node);
  const SourceMap source = hull.model.source();
  const ConvexView& view = hull.model.level(0).view;
  if (feature.kind() == FeatureKind::Vertex) return hull.first_triangle + source.vertex[feature.index()] / 3;

  // Of the triangles that lie in a face the one that holds the point; an edge of the surface is one of a triangle in either
  // face at it.
  std::uint32_t nearest = kNone, looked_at = 0;
  double most = -HUGE_VAL;
  const auto look_in = [&](std::uint32_t face) {
    if (face >= view.face_first.size()) return;
    for (std::uint32_t i = source.face_begin[face]; i < source.face_begin[face + 1] && most < 0; ++i) {
      const std::uint32_t t = hull.first_triangle + source.face[i];
      if (t >= triangle_count || looked_at++ == kMostInFace) return;
      const auto corner = [&](int k) { return vertices[triangles[t].data()[k]]; };
      const double share = least_share(point, corner(0), corner(1), corner(2));
      if (nearest == kNone || share > most) nearest = t, most = share;
    }
  };
  std::uint32_t half_edge;
  if (feature.kind() == FeatureKind::Edge) {
    half_edge = feature.index();
    look_in(view.half_edges[half_edge].face);
    if (most < 0) look_in(view.half_edges[view.half_edges[half_edge].twin].face);
  } else {
    half_edge = view.face_first[feature.index()];
    look_in(feature.index());
  }
  return nearest != kNone ? nearest : hull.first_triangle + source.vertex[view.half_edges[half_edge].head] / 3;
}

// Each query without a front and with one.
namespace {

Answer distance_from(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront* front,
                     const Options& options) {
  Answer answer;
  if (both_convex(a, b, seed, [&](const Body& x, const Body& y, PairSeed& s) { answer = distance(x, y, b_in_a, s, options); }))
    return answer;
  ask(a, b, b_in_a, seed, front, options.budget,
      {allowed_error(options.absolute), allowed_error(options.relative), options.beyond, 0}, answer);
  return answer;
}

Answer intersects_from(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront* front,
                       const Effort& effort) {
  Answer answer;
  if (both_convex(a, b, seed, [&](const Body& x, const Body& y, PairSeed& s) { answer = intersects(x, y, b_in_a, s, effort); }))
    return answer;
  ask(a, b, b_in_a, seed, front, effort.budget, {0, 0, 0, 0}, answer);
  decide(answer);
  return answer;
}

Within within_from(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed, MeshFront* front,
                   const Effort& effort) {
  Within result;
  if (both_convex(a, b, seed,
                  [&](const Body& x, const Body& y, PairSeed& s) { result = within(x, y, b_in_a, threshold, s, effort); }))
    return result;
  ask(a, b, b_in_a, seed, front, effort.budget, {0, 0, threshold, threshold}, result.answer);
  decide(result, threshold);
  // The search ended at the first pair that is near enough, whichever that was. Its points may overlap by the radii, which an
  // interval from 0 on says by the verdict alone.
  const bool by_radii = result.answer.verdict == Verdict::Overlapping && a.radius() + b.radius() > 0;
  if (result.decision == Decision::Yes && !by_radii) result.answer.verdict = Verdict::Undecided, result.answer.lower = 0;
  return result;
}

ClosestFeatures features_from(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront* front,
                              const ClosestOptions& options) {
  ClosestFeatures result;
  if (both_convex(a, b, seed,
                  [&](const Body& x, const Body& y, PairSeed& s) { result = closest_features(x, y, b_in_a, s, options); }))
    return result;
  ask(a, b, b_in_a, seed, front, {options.steps, 0}, {0, 0, options.beyond, -kInfinity}, result.answer);
  const Answer& answer = result.answer;
  result.source_a = source_feature(a, answer.feature_a, answer.level_a);
  result.source_b = source_feature(b, answer.feature_b, answer.level_b);
  return result;
}

}  // namespace

Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Options& options) {
  return distance_from(a, b, b_in_a, seed, nullptr, options);
}
Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                const Options& options) {
  return distance_from(a, b, b_in_a, seed, &front, options);
}
Answer distance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Options& options) {
  MeshSeed cold;
  return distance(a, b, b_in_a, cold, options);
}

Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, const Effort& effort) {
  return intersects_from(a, b, b_in_a, seed, nullptr, effort);
}
Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                  const Effort& effort) {
  return intersects_from(a, b, b_in_a, seed, &front, effort);
}
Answer intersects(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const Effort& effort) {
  MeshSeed cold;
  return intersects(a, b, b_in_a, cold, effort);
}

Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed,
              const Effort& effort) {
  return within_from(a, b, b_in_a, threshold, seed, nullptr, effort);
}
Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, MeshSeed& seed, MeshFront& front,
              const Effort& effort) {
  return within_from(a, b, b_in_a, threshold, seed, &front, effort);
}
Within within(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, double threshold, const Effort& effort) {
  MeshSeed cold;
  return within(a, b, b_in_a, threshold, cold, effort);
}

ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed,
                                 const ClosestOptions& options) {
  return features_from(a, b, b_in_a, seed, nullptr, options);
}
ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, MeshSeed& seed, MeshFront& front,
                                 const ClosestOptions& options) {
  return features_from(a, b, b_in_a, seed, &front, options);
}
ClosestFeatures closest_features(const MeshBody& a, const MeshBody& b, const Pose& b_in_a, const ClosestOptions& options) {
  MeshSeed cold;
  return closest_features(a, b, b_in_a, cold, options);
}

double tolerance(const MeshBody& a, const MeshBody& b, const Pose& b_in_a) {
  const MeshSetting at(a, b, b_in_a);
  return at.fault() == Status::Converged ? max((kLawTwo + 2 * at.quality.error) * at.size, kLeastWidth) : kUnknown;
}

}  // namespace swiftlet
