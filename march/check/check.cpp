// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Checks of distances and models. Supports are maxima over all vertices, without hill climbing. Marches are used only for the
// deviations in `verify`, and for an overlap or an upper bound that neither planes nor the answer's points prove.
#include <swiftlet/check.h>

#include "body/ellipsoid.h"
#include "body/support.h"
#include "body/support_map.h"
#include "body/table.h"
#include "check/brute.h"
#include "query/radii.h"

namespace swiftlet {
namespace {

/// Returns a cell of the level's support map whose error bound is too small, or kNone. Corners of a cell suffice, and of one
/// around a pole of the octahedron the pole: over the cell the body's height above the cell's vertex is largest at one of
/// these. Requires an exactly convex body: its heights are climbed to.
std::uint32_t map_fault(const Level& level) {
  const std::uint32_t side = level.map_side;
  if (!(level.view.extent > 0)) return kNone;
  std::vector<std::uint32_t> tops((side + 1) * (side + 1));  // highest vertices at the corners of the cells of one half
  std::uint32_t tests = 0, near = 0;
  for (std::uint32_t cell = 0; cell < lut::octahedron_cell_count(side); ++cell) {
    const std::uint32_t lower = cell / (side * side), row = cell / side % side, column = cell % side;
    const std::uint32_t entry = level.support_map[cell];
    const auto direction = [&](std::uint32_t i, std::uint32_t j) {
      const std::array<double, 3> d = lut::octahedron_point(side, lower, i, j);
      return from_map(level.map_frame, {d[0] / side, d[1] / side, d[2] / side});
    };
    const auto is_too_small = [&](const Vec& n, std::uint32_t top) {
      const Vec above = vec(level.view.vertices[top]) - vec(level.view.vertices[map_vertex(entry)]);
      return !(excess_at(level.map_frame, n, above) <= map_excess(entry));
    };
    for (const std::uint32_t corner : {0, 1, 2, 3}) {
      const std::uint32_t i = column + corner % 2, j = row + corner / 2;
      const Vec n = direction(2 * i, 2 * j);
      std::uint32_t& top = tops[j * (side + 1) + i];
      if (corner == 3 || row == 0 || column == 0) top = near = support(level.view, rescaled(n), near, tests);
      if (is_too_small(n, top)) return cell;
    }
    const bool has_pole = 2 * row + 1 == side && 2 * column + 1 == side;
    const Vec pole = direction(side, side);
    if (has_pole && is_too_small(pole, support(level.view, rescaled(pole), near, tests))) return cell;
  }
  return kNone;
}

/// Returns a face above whose plane a vertex is higher than the plane says, or kNone. Requires an exactly convex body.
std::uint32_t over_fault(const ConvexView& view) {
  for (std::uint32_t f = 0; f < view.planes.size(); ++f) {
    if (!(height_over(view, vec(view.planes[f]), origin(view, view.face_first[f])) <= view.planes[f].over)) return f;
  }
  return kNone;
}

/// Returns a face from whose plane a vertex is farther than the plane says, or kNone.
std::uint32_t thickness_fault(const ConvexView& view) {
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    const std::uint32_t f = view.half_edges[h].face;
    if (f >= view.planes.size()) continue;
    const FacePlane& plane = view.planes[f];
    const Vec on = vec(view.vertices[origin(view, view.face_first[f])]), p = vec(view.vertices[origin(view, h)]);
    if (!(thickness_at(vec(plane), on, p, view.extent) <= plane.thickness)) return f;
  }
  return kNone;
}

/// True if a point is in the body, up to law 2's bound.
bool surely_holds(const ConvexView& body, const Vec& p) {
  const Vertex record{p.x, p.y, p.z, 0, 0};
  ConvexView point;
  point.vertices = {&record, 1};
  point.extent = max_abs(p);
  return march(point, body, Pose{}).lower <= kLawTwo * body.extent;
}

/// Recomputes the numbers of level `i` that prove nothing: dimension, edges, triangles, edge length and volume.
/// `dimension` is that of the level's surface. Lengths and volumes are compared up to the rounding of their sums.
Check numbers_hold(const Model& model, int i, int dimension) {
  const Level& level = model.level(i);
  const ConvexView& view = level.view;
  if (model.dimension() != dimension) return failed("level %d has dimension %d, not %d", i, dimension, model.dimension());
  std::size_t borders = 0;
  double length = 0;
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    borders += !is_diagonal(view, h);
    length += norm(vec(view.vertices[view.half_edges[h].head]) - vec(view.vertices[origin(view, h)]));
  }
  const auto count = [](std::size_t n) { return static_cast<unsigned long long>(n); };
  if (level.edge_count != borders / 2)
    return failed("level %d has %llu edges, not %llu", i, count(borders / 2), count(level.edge_count));
  const std::size_t triangles = dimension >= 2 ? 2 * view.vertices.size() - 4 : 0;
  if (level.triangle_count != triangles)
    return failed("level %d has %llu triangles, not %llu", i, count(triangles), count(level.triangle_count));
  const double halves = double(view.half_edges.size()), mean = view.half_edges.empty() ? 0 : length / halves;
  if (!(std::fabs(level.edge_length - mean) <= 2 * kU * (halves + 4) * mean))
    return failed("level %d: its edges are %.17g long, not %.17g", i, mean, level.edge_length);
  const Vec apex = vec(view.vertices[0]);
  const double reach = reach_of(view), size = reach * reach * reach;
  double six_times = 0, terms = 0;
  if (dimension == 3) {
    for (std::uint32_t first = 0; first < view.half_edges.size(); ++first) {
      if (!is_first_in_facet(view, first)) continue;
      const Vec p = vec(view.vertices[origin(view, first)]) - apex;
      for (std::uint32_t h = next_in_facet(view, first); view.half_edges[h].head != origin(view, first);
           h = next_in_facet(view, h)) {
        const Vec q = vec(view.vertices[origin(view, h)]) - apex, r = vec(view.vertices[view.half_edges[h].head]) - apex;
        six_times += dot(cross(p, q), r), terms += 1;
      }
    }
  }
  if (!(std::fabs(6 * level.volume - six_times) <= 32 * kU * terms * size))
    return failed("level %d: its volume is %.17g, not %.17g", i, six_times / 6, level.volume);
  return kPassed;
}

}  // namespace

Checked::Checked(const Body& of_a, const Body& of_b, const Pose& b_in_a, const Answer& of, Question asked)
    : pose(b_in_a), at(of_a, of_b, b_in_a), a(at.a), b(at.b), answer(of), is_exact(asked == Question::Exact) {
  const auto has = [](const Shape& body, int level) { return level >= body.finest_level() && level < body.level_count(); };
  if (at.fault() != Status::Converged || !has(a, of.level_a) || !has(b, of.level_b)) return;
  const double error = at.quality.error;
  const Level &level_a = a.level(of.level_a), &level_b = b.level(of.level_b);
  stretch = std::sqrt(1 + 3 * error);
  radii = at.radii.sum();
  if (!of.normal.hasNaN()) normal = vec(of.normal);
  point_a = vec(of.point_a) - normal * at.radii.a(), point_b = vec(of.point_b) + normal * at.radii.b();
  // Radii round each bound outwards, by at most 4 u of it.
  touching = at.law_two();
  narrow = Radii(0, 0).law_two(a, b, at.motion, error) + (radii > 0 ? 8 * kU * std::fabs(of.lower) : 0);
  slack = max(pair_view(level_a.view, level_b.view, at.motion, error).law_two, touching);
  magnitude = pair_view(a.level(a.finest_level()).view, b.level(b.finest_level()).view, at.motion, error).magnitude;
  deviation = level_a.deviation + stretch * level_b.deviation;
}

Check Checked::interval_holds() const {
  if (answer.status > Status::InvalidBody) return failed("%d is no status", int(answer.status));
  if (answer.verdict > Verdict::Overlapping) return failed("%d is no verdict", int(answer.verdict));
  const Status fault = at.fault();
  const auto is_refusal = [](Status s) {
    return s == Status::InvalidPose || s == Status::InvalidRadius || s == Status::InvalidBody;
  };
  if (fault != Status::Converged || is_refusal(answer.status)) {
    return fault == answer.status       ? kPassed
           : fault == Status::Converged ? failed("pose, radii and bodies are legal")
                                        : failed("the pose, a radius or a body is not legal");
  }
  if (answer.status == Status::NotAsked) return failed("the answer says nothing");
  if (Radii(answer) != at.radii) return failed("the answer is of other radii");
  const auto has = [](const Shape& body, int level) { return level >= body.finest_level() && level < body.level_count(); };
  if (!has(a, answer.level_a) || !has(b, answer.level_b))
    return failed("levels (%d, %d) are not there", int(answer.level_a), int(answer.level_b));
  if (!(answer.upper >= answer.lower && answer.upper > -kInfinity))
    return failed("[%.17g, %.17g] is no interval", answer.lower, answer.upper);
  if (answer.lower > 0) {
    const double gap = gap_along(a, b, at.motion, normal);
    if (!(double(of_hulls(answer.lower) - gap * (1 + kNormError)) <= kDoubleDoubleError * (magnitude + radii)))
      return failed("lower is %.17g, but the gap along the normal is %.17g", answer.lower, gap - radii);
  }
  return kPassed;
}

Check Checked::members_hold() const {
  const auto is_known = [](const Vec3& v) { return v.allFinite(); };
  const auto is_unknown = [](const Vec3& v) { return std::isnan(v[0]) && std::isnan(v[1]) && std::isnan(v[2]); };
  const Vec3 &p = answer.point_a, &q = answer.point_b, &n = answer.normal;
  if (!is_unknown(n)) {
    const Wide unit = wide(vec(n));
    if (!(std::fabs(double(dot(unit, unit) - 1.0)) <= kUnitError)) return failed("the normal's length is %.17g", n.norm());
  }
  if (!(is_known(p) && is_known(q)) && !(is_unknown(p) && is_unknown(q))) return failed("a point is no point");
  if (answer.lower > 0 && std::isfinite(answer.upper) && !is_known(p)) return failed("disjoint without points");
  const auto named = [](const Shape& body, int level, FeatureId feature) {
    return names_feature(body.level(level).view, feature);
  };
  const bool none = answer.feature_a == FeatureId{} && answer.feature_b == FeatureId{};
  return none || (named(a, answer.level_a, answer.feature_a) && named(b, answer.level_b, answer.feature_b))
             ? kPassed
             : failed("a feature that is not there");
}

Check Checked::is_narrow() const {
  const double width = answer.upper - answer.lower, allowed = touching + (radii > 0 ? 8 * kU * std::fabs(answer.lower) : 0);
  return !is_certain() || width <= allowed ? kPassed : failed("exact, but the bounds are %.17g apart", width);
}

Check Checked::points_are_nearest() const {
  if (!(std::isfinite(answer.lower) && answer.upper - answer.lower <= narrow) || answer.status == Status::Budget)
    return kPassed;
  const Wide n = wide(normal), between = wide(vec(answer.point_b)) - wide(vec(answer.point_a));
  const double along = std::clamp(double(dot(between, n)), answer.lower, answer.upper);
  const double aside = norm(rounded(between - n * DoubleDouble(along)));
  // Points w apart have w . n >= lower and |w| <= upper, up to twice the slack: aside^2 = (|w| - w . n) (|w| + w . n). In an
  // overlap -w is a facet's point nearest to 0, of a polytope around the ball of radius -upper and below the plane of height
  // -lower along n: aside^2 <= lower^2 - upper^2.
  const bool may_lean = !is_exact || answer.status == Status::Beyond;
  const double lean = may_lean ? std::sqrt(2 * (narrow + 2 * slack) * norm(point_b - point_a)) : 0;
  if (is_certain() && !(deviation <= touching))
    return failed("exact, but the points are of levels that deviate by %.17g", deviation);
  return aside <= slack + deviation + lean ? kPassed
                                           : failed("the points are %.17g off the signed distance along the normal", aside);
}

Check Checked::points_lie_in_their_levels() const {
  if (!holds(a.level(answer.level_a).view, kAtRest, point_a, slack))
    return failed("point_a is not in level %d of A", int(answer.level_a));
  if (!holds(b.level(answer.level_b).view, at.motion, point_b, slack))
    return failed("point_b is not in level %d of B", int(answer.level_b));
  return kPassed;
}

Check Checked::hulls_overlap(const OverlapProof* proof) const {
  if (proof && proof->count > 0) {
    if (answer.level_a != 0 || answer.level_b != 0) return failed("overlap without a proof on level 0");
    return check_proof(a.level(0).view, b.level(0).view, at.motion, *proof);
  }
  // A march finds a proof in microseconds where one exists for level 0; the depth takes every pair of edges.
  if (a.finest_level() == 0 && b.finest_level() == 0) {
    const ConvexView &finest_a = a.level(0).view, &finest_b = b.level(0).view;
    const MarchResult met = march(finest_a, finest_b, pose);
    if (met.proof.count > 0 && check_proof(finest_a, finest_b, at.motion, met.proof)) return kPassed;
  }
  const DoubleDouble depth = least_depth();
  const double doubt = kHeightError * magnitude;
  if (double(depth) < -doubt) return failed("overlap of hulls that a plane separates");
  const bool is_deep = double(depth) > doubt && depth.high != kInfinity;
  return is_deep || is_near(touching) ? kPassed : failed("overlap that nothing proves");
}

bool Checked::is_near(double upper) const {
  bool found = false;
  each_level_pair([&](int level_a, int level_b, double error) {
    const ConvexView &view_a = a.level(level_a).view, &view_b = b.level(level_b).view;
    const MarchResult near = march(view_a, view_b, pose);
    const Vec near_a = vec(near.point_a), near_b = vec(near.point_b);
    found = found || (norm(near_b - near_a) + error <= upper + radii + 2 * slack && holds(view_a, kAtRest, near_a, slack) &&
                      holds(view_b, at.motion, near_b, slack));
  });
  return found;
}

bool Checked::is_shallow() const {
  const double doubt = kHeightError * (magnitude + radii), most = touching + doubt;
  if (gap_along(a, b, at.motion, normal) - radii >= -most) return true;
  const DoubleDouble depth = least_depth();
  return !(depth.high < kInfinity) || double(depth + radii) <= most;
}

Check check_distance(const Checked& of, const OverlapProof* proof) {
  const Answer& answer = of.answer;
  if (!(answer.lower >= 0)) return failed("lower is %.17g of a distance", answer.lower);
  const bool between = max_abs(of.normal) > 0;  // else the points are common to both hulls
  const double apart = norm(of.point_b - of.point_a) + of.deviation;
  if (between && of.knows_points() && !(apart <= answer.upper + of.radii + 2 * of.slack))
    return failed("upper is %.17g, but the points prove only %.17g", answer.upper, apart - of.radii);
  if (std::isfinite(answer.upper) && !(between && of.knows_points()) && answer.verdict != Verdict::Overlapping &&
      !of.is_near(answer.upper))
    return failed("upper is %.17g, and nothing proves it", answer.upper);
  if (!answer.is_signed && (answer.verdict == Verdict::Disjoint || answer.verdict == Verdict::Touching)) {
    if (const Check nearest = of.points_are_nearest(); !nearest) return nearest;
  }
  switch (answer.verdict) {
    case Verdict::Disjoint: return answer.lower > 0 ? kPassed : failed("disjoint without a lower bound");
    case Verdict::Touching:
      if (!(answer.upper <= of.touching)) return failed("touching with an upper bound of %.17g", answer.upper);
      return of.is_shallow() ? kPassed : failed("touching, but nothing proves that the bodies are not deep in each other");
    case Verdict::Overlapping:
      if (answer.upper != 0) return failed("overlapping with an upper bound of %.17g", answer.upper);
      if (of.radii > 0 && apart <= of.radii + 2 * of.touching && (between || of.radii > 2 * of.slack)) return kPassed;
      return between ? failed("overlap of radii with points %.17g apart", apart) : of.hulls_overlap(proof);
    case Verdict::Undecided:
      if (answer.lower > 0) return failed("undecided with a lower bound of %.17g", answer.lower);
      return !of.is_certain() || answer.is_signed || of.is_shallow() ? kPassed
                                                                     : failed("undecided of bodies deep in each other");
  }
  return kPassed;
}

Check check(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, Question asked, const OverlapProof* proof) {
  const Checked of(a, b, b_in_a, answer, asked);
  if (Check interval = of.interval_holds(); !interval || of.at.fault() != Status::Converged) return interval;
  if (Check members = of.members_hold(); !members) return members;
  if (Check narrow = of.is_narrow(); !narrow) return narrow;
  if (of.knows_points()) {
    if (Check in = of.points_lie_in_their_levels(); !in) return in;
  }
  return answer.is_signed ? check_signed(of, proof) : check_distance(of, proof);
}
Check check(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const OverlapProof* proof) {
  return check(a, b, b_in_a, answer, Question::Any, proof);
}

Check verify(const Model& model) {
  if (model.finest_level() > 0) return failed("level 0 is not there: nothing tells whether the others enclose it");
  const ConvexView& exact_hull = model.level(0).view;
  const Vec middle = vec(exact_hull.centre);
  for (int i = 0; i < model.level_count(); ++i) {
    const Level& level = model.level(i);
    const ConvexView& view = level.view;
    // The facets of this level as plain arrays, which make_surface proves convex anew.
    std::vector<Vec3> points;
    for (const Vertex& v : view.vertices) points.emplace_back(v.x, v.y, v.z);
    std::vector<std::uint32_t> corners, sizes;
    std::vector<bool> seen(view.half_edges.size(), false);
    for (std::uint32_t first = 0; first < view.half_edges.size(); ++first) {
      if (seen[first] || view.half_edges[first].face == kNone) continue;
      std::uint32_t size = 0, h = first;
      for (; !seen[h]; h = next_in_facet(view, h), ++size) {
        seen[h] = true;
        corners.push_back(origin(view, h));
      }
      sizes.push_back(size);
    }
    LevelArrays arrays;
    arrays.vertices = points;
    arrays.face_vertices = corners;
    arrays.face_sizes = sizes;
    const Result<Surface> surface = make_surface(arrays, false);
    if (!surface) return {false, "level " + std::to_string(i) + ": " + surface.error().message};
    if (surface.value().vertices.size() != view.vertices.size())
      return failed("level %d: a vertex is no corner of the hull", i);
    if (const double extent = surface.value().extent; !(view.extent <= extent * (1 + 8 * kU)))  // too small a one does not load
      return failed("level %d: its extent is %.17g, not %.17g", i, extent, view.extent);
    if (const std::uint32_t cell = map_fault(level); cell != kNone)
      return failed("level %d: its support map is wrong in cell %u", i, unsigned(cell));
    if (const std::uint32_t f = over_fault(view); f != kNone)
      return failed("level %d: a vertex is higher above the plane of face %u than %.17g", i, unsigned(f), view.planes[f].over);
    if (const std::uint32_t f = thickness_fault(view); f != kNone)
      return failed("level %d: face %u is thicker than %.17g", i, unsigned(f), view.planes[f].thickness);
    if (const double reach = reach_of(view); !(view.reach >= reach))
      return failed("level %d: its reach is %.17g, provable are %.17g", i, view.reach, reach);
    if (view.inner_radius > 0 && !(view.inner_radius <= inner_radius_of(view, vec(view.centre))))
      return failed("level %d: nothing proves that a ball of radius %.17g is inside", i, view.inner_radius);
    if (const Vec centre = vec(view.centre); level.scale_around < kInfinity || level.scale_inside > 0) {
      if (!(level.scale_around >= scale_around(view, centre, level.map_frame)))
        return failed("level %d: nothing proves that an ellipsoid of scale %.17g is around it", i, level.scale_around);
      if (!(level.scale_inside <= scale_inside(view, centre, level.map_frame)))
        return failed("level %d: nothing proves that an ellipsoid of scale %.17g is inside", i, level.scale_inside);
    }
    if (const Check numbers = numbers_hold(model, i, surface.value().dimension); !numbers) return numbers;
    if (i == 0) continue;
    if (vertex_outside(exact_hull, view) != kNone) return failed("level %d does not enclose level 0", i);
    MarchStart start;
    for (const Vertex& v : view.vertices) {
      const Vertex record{v.x, v.y, v.z, 0, 0};
      ConvexView point;
      point.vertices = {&record, 1};
      point.extent = max_abs(vec(v));
      const MarchResult r = march(point, exact_hull, Pose{}, start);
      start.b = r.b;
      if (r.lower > level.deviation)
        return failed("level %d: a vertex is %.17g from level 0, the deviation is %.17g", i, r.lower, level.deviation);
    }
  }
  // These come last: a march needs a body that is convex.
  if (!surely_holds(exact_hull, middle)) return failed("the centre is outside");
  const Box box = box_of(exact_hull.vertices);
  if (eigen(box.least) != model.box_min() || eigen(box.most) != model.box_max())
    return failed("the box is not that of level 0");
  if (const double radius = outer_radius_of(exact_hull, middle); !(model.radius() >= radius))
    return failed("nothing proves that a ball of radius %.17g is around it", model.radius());
  return kPassed;
}

}  // namespace swiftlet
