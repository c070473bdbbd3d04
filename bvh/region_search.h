// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The search for all regions: pairs of nodes and of triangles that are beyond the reach are left out, and those whose place
// lies inside a region that is no farther than they are. Neither could change a region's box or its distance.
#pragma once

#include "near_pairs.h"
#include "regions.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

class RegionSearch {
 public:
  RegionSearch(const MeshSetting& at, const Pose& b_in_a, const RegionQuestion& question, Regions& regions,
               RegionFinding& finding)
      : at_(at),
        a_(at.a),
        b_(at.b),
        pose_(b_in_a),
        question_(question),
        regions_(regions),
        finding_(finding),
        pairs_(at, question.reach),
        beyond_(next_above(question.reach)) {}

  void run() {
    const double left = pairs_.run(*this);
    finding_.cut_short = left < HUGE_VAL;
    for (std::size_t i = 0; i < regions_.size(); ++i) {
      MeshContact& region = regions_[i];
      region.lower = max(0, min(min(region.lower, limit_of(region)), min(left, region.upper)));
    }
  }

  // ---- What NearPairs asks ----

  bool goes_on() const { return !finding_.refused && finding_.nodes + finding_.triangles < question_.steps; }
  bool skips(const NearPairs::Boxes& boxes, double lower) {
    ++finding_.nodes;
    if (regions_.size() == 0) return false;
    const MeshContact* const region = regions_.holding(common(boxes.a, boxes.b));
    return region && lower >= limit_of(*region);
  }
  /// Bounds the distance of two triangles, or of a triangle and a convex body.
  void visit(std::uint32_t of_a, std::uint32_t of_b, double bound) {
    ++finding_.triangles;
    const auto [box_a, box_b] = pairs_.boxes(of_a, of_b);
    if (!meet(box_a, box_b)) return;
    const Box place = common(box_a, box_b);
    MeshContact* const region = regions_.holding(place);
    const double limit = region ? limit_of(*region) : beyond_;
    if (bound >= limit) return;
    const Ids ids{of_a, of_b};
    if (a_.triangles && b_.triangles)
      measure(ids, place, limit, region);
    else
      ask_kernel(ids, place, limit);
  }

 private:
  struct Ids {
    std::uint32_t a, b;
  };

  /// The bound from which on a pair whose place lies in the region cannot matter to it.
  double limit_of(const MeshContact& region) const {
    if (region.verdict == Verdict::Overlapping) return 0;
    const double width = kLeftOutShare * at_.law_two;
    double limit = region.upper - width;
    if (region.upper - limit > width) limit = next_above(limit);  // it was rounded down
    return max(limit, std::numeric_limits<double>::denorm_min());
  }

  void measure(Ids ids, const Box& place, double limit, MeshContact* region) {
    Vec a[3], b[3];
    corners(a_, ids.a, a), corners(b_, ids.b, b);
    const TrianglePair pair(a, b, at_.motion, at_.size);
    const Vec n = region ? vec(region->normal) : ahead_;
    const double ahead = pair.gap(n);
    if (ahead >= limit || pair.gap(normalised(pair.between_middles())) >= limit) return;
    // Where triangles touch already, a pair that a direction parts up to law 2's bound touches at most.
    if (region && region->upper <= at_.law_two && ((dot(n, n) > 0 && ahead >= -at_.law_two) || pair.faces_part(at_.law_two))) {
      region->lower = 0;
      return;
    }
    const auto [points, lower, upper, normal] = pair.measured(at_.law_two);
    if (lower >= limit) return;
    Vec met;
    if (lower > 0 && upper - lower <= at_.law_two) {
      MeshContact found;
      found.lower = lower, found.upper = upper;
      found.point_a = eigen(points.a + a[0]), found.point_b = eigen(points.a + a[0] + points.way);
      name(a_, ids.a, points.on_a, found.feature_a), name(b_, ids.b, points.on_b, found.feature_b);
      add(ids, place, normal, found);
    } else if (pair.cross_deeper(at_.law_two, met)) {
      add_crossing(ids, place, met + a[0], met + a[0]);
    } else {
      ask_kernel(ids, place, limit);
    }
  }

  /// Leaves it to the atomic kernel, which decides signs exactly.
  [[gnu::noinline]] void ask_kernel(Ids ids, const Box& place, double limit) {
    ClosestOptions options;
    options.beyond = limit;
    const ClosestFeatures closest = closest_features(body_of(a_, ids.a), body_of(b_, ids.b), pose_, finding_.seed, options);
    const Answer& answer = closest.answer;
    if (answer.status >= Status::InvalidPose) {
      finding_.refused = true;
      return;
    }
    if (answer.verdict == Verdict::Overlapping) return add_crossing(ids, place, vec(answer.point_a), vec(answer.point_b));
    if (answer.lower >= limit) return;
    MeshContact found;
    found.lower = answer.lower, found.upper = answer.upper;
    found.point_a = answer.point_a, found.point_b = answer.point_b;
    name(a_, ids.a, closest.source_a, answer.feature_a, found.feature_a);
    name(b_, ids.b, closest.source_b, answer.feature_b, found.feature_b);
    const Vec n = vec(answer.normal);
    add(ids, place, dot(n, n) > 0 ? n : Vec{0, 0, 0}, found);
  }

  /// A pair is within reach: its place joins the regions, and it may be the nearest of its region.
  void add(Ids ids, const Box& place, const Vec& normal, MeshContact& found) {
    found.triangle_a = ids.a, found.triangle_b = ids.b;
    found.normal = eigen(normal);
    if (dot(normal, normal) > 0) ahead_ = normal, pairs_.look(normal);
    MeshContact& region = regions_.add(place);
    const double lower = min(region.lower, found.lower);
    if (Regions::is_nearer(found, region)) {
      found.box_min = region.box_min, found.box_max = region.box_max;
      region = found;
    }
    region.lower = lower;
  }
  void add_crossing(Ids ids, const Box& place, const Vec& point_a, const Vec& point_b) {
    MeshContact found;
    found.verdict = Verdict::Overlapping;
    found.lower = found.upper = 0;
    found.point_a = eigen(point_a), found.point_b = eigen(point_b);
    found.feature_a = whole(a_, ids.a), found.feature_b = whole(b_, ids.b);
    add(ids, place, {0, 0, 0}, found);
  }

  const MeshSetting& at_;
  const MeshView &a_, &b_;
  const Pose& pose_;
  const RegionQuestion& question_;
  Regions& regions_;
  RegionFinding& finding_;
  NearPairs pairs_;
  const double beyond_;  ///< the bound from which on nothing is within reach
  Vec ahead_{0, 0, 0};   ///< a direction that parted triangles
};

}  // namespace
}  // namespace swiftlet
