// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Nothing here climbs or marches but `verify`'s deviations: supports are maxima over all vertices.
#include <swiftlet/check.h>

#include "brute.h"
#include "dilate.h"
#include "support_map.h"

namespace swiftlet {
namespace {

/// The cell of a level's support map that promises too much, or kNone: over a cell the heights above its vertex are highest at
/// a corner.
std::uint32_t map_fault(const Level& level) {
  const std::uint32_t side = level.map_side;
  std::vector<double> heights((side + 1) * (side + 1));  // of the body, at the corners of one face's cells
  for (std::uint32_t cell = 0; cell < lut::cube_cell_count(side); ++cell) {
    const std::uint32_t face = cell / (side * side), row = cell / side % side, column = cell % side;
    for (const std::uint32_t corner : {0, 1, 2, 3}) {
      const std::array<double, 3> d = lut::cube_point(side, face, 2 * (column + corner % 2), 2 * (row + corner / 2));
      const Vec n{d[0], d[1], d[2]};
      double& most = heights[(row + corner / 2) * (side + 1) + column + corner % 2];
      if (corner == 3 || row == 0 || column == 0) {
        most = dot(n, vec(level.view.vertices[0]));
        for (const Vertex& v : level.view.vertices) most = larger(most, dot(n, vec(v)));
      }
      const std::uint32_t entry = level.support_map[cell];
      const double excess = most - dot(n, vec(level.view.vertices[map_vertex(entry)]));
      if (!(excess <= (map_excess(entry) + kMapError) * level.view.extent)) return cell;
    }
  }
  return kNone;
}

}  // namespace

Check check(const Model& a, const Model& b, const Pose& b_in_a, const Answer& answer, double radius_a, double radius_b) {
  if (answer.status == Status::InvalidPose) {
    return pose_quality(motion(b_in_a)).legal ? failed("the pose is legal") : kPassed;
  }
  const bool radii_are_legal = is_radius(radius_a) && is_radius(radius_b);
  if (answer.status == Status::InvalidRadius) return radii_are_legal ? failed("the radii are legal") : kPassed;
  if (!radii_are_legal) return failed("the radii are not legal");
  const Motion m = motion(b_in_a);
  const PoseQuality quality = pose_quality(m);
  if (!quality.legal) return failed("the pose is not legal");
  if (answer.level_a < a.finest_level() || answer.level_a >= a.level_count() || answer.level_b < b.finest_level() ||
      answer.level_b >= b.level_count()) {
    return failed("levels (%d, %d) are not there", answer.level_a, answer.level_b);
  }
  if (!(answer.lower >= 0 && answer.upper >= answer.lower))
    return failed("[%.17g, %.17g] is no interval", answer.lower, answer.upper);
  const ConvexView &exact_a = a.level(0).view, &exact_b = b.level(0).view;
  const Scene whole = scene(exact_a, exact_b, m, quality.error);
  const double radii = radius_a + radius_b,
               touching = law_two(exact_a.extent + radius_a, exact_b.extent + radius_b, norm(m.t), quality.error);
  const bool hulls_overlap = answer.proof.count != 0;
  double apart = std::numeric_limits<double>::infinity();  // the hulls, as the points prove it

  if (answer.lower > 0) {
    const double gap = gap_along(a, b, m, vec(answer.normal));
    const DoubleDouble claimed = DoubleDouble(answer.lower) + radius_a + radius_b;
    if (!(double(claimed - gap * (1 + kNormError)) <= kDoubleDoubleError * (whole.magnitude + radii))) {
      return failed("lower is %.17g, but the gap along the normal is %.17g", answer.lower, gap - radii);
    }
  }
  if (std::isfinite(answer.upper) && !(hulls_overlap && answer.point_a.hasNaN() && answer.point_b.hasNaN())) {
    const Level &level_a = a.level(answer.level_a), &level_b = b.level(answer.level_b);
    const Scene pair = scene(level_a.view, level_b.view, m, quality.error);
    const Vec n = hulls_overlap ? Vec{0, 0, 0} : vec(answer.normal);
    const Vec p = vec(answer.point_a) - n * radius_a, q = vec(answer.point_b) + n * radius_b;
    const double slack = larger(pair.law_two, touching);
    apart = norm(q - p) + level_a.deviation + level_b.deviation * (1 + 2 * quality.error);
    if (!hulls_overlap && !(apart <= answer.upper + radii + 2 * slack))
      return failed("upper is %.17g, but the points prove only %.17g", answer.upper, apart - radii);
    if (!holds(level_a.view, kAtRest, p, slack)) return failed("point_a is not on level %d of A", answer.level_a);
    if (!holds(level_b.view, m, q, slack)) return failed("point_b is not on level %d of B", answer.level_b);
  }
  switch (answer.verdict) {
    case Verdict::Disjoint:
      if (!(answer.lower > 0)) return failed("disjoint without a lower bound");
      break;
    case Verdict::Touching:
      if (!(answer.upper <= touching)) return failed("touching with an upper bound of %.17g", answer.upper);
      break;
    case Verdict::Overlapping: {
      if (!hulls_overlap && radii > 0) {
        if (!(answer.upper == 0 && apart <= radii + 2 * touching))
          return failed("overlap of radii with points %.17g apart", apart);
        break;
      }
      if (answer.level_a != 0 || answer.level_b != 0) return failed("overlap without a proof on level 0");
      if (const Check proof = check_proof(exact_a, exact_b, m, answer.proof); !proof) return proof;
      break;
    }
    case Verdict::Undecided: break;
  }
  return kPassed;
}

Check verify(const Model& model) {
  if (model.finest_level() > 0) return failed("level 0 is not there: nothing tells whether the others enclose it");
  const ConvexView& exact_hull = model.level(0).view;
  for (int i = 0; i < model.level_count(); ++i) {
    const Level& level = model.level(i);
    const ConvexView& view = level.view;
    // The arrays of this level, proved convex again from nothing.
    std::vector<Vec3> points;
    for (const Vertex& v : view.vertices) points.emplace_back(v.x, v.y, v.z);
    std::vector<std::uint32_t> corners, sizes;
    std::vector<bool> seen(view.head.size(), false);
    for (std::uint32_t first = 0; first < view.head.size(); ++first) {
      if (seen[first] || view.face[first] == kNone) continue;
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
    if (const std::uint32_t cell = map_fault(level); cell != kNone)
      return failed("level %d: its support map is wrong in cell %u", i, unsigned(cell));
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
  return kPassed;
}

}  // namespace swiftlet
