// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A proof of depth. The facet asked about is one side of a closed surface between points of the Minkowski difference M:
//
//      p1---------p2        p: the facet, of which every point is at least as far from the origin as it is high.
//      |\    p   /|         t: the tip, far below.
//      | p0----p3 |
//       \  \  /  /
//        ---t---
//
// If the origin is surely below the planes of all other triangles, by more than the facet is high, that height is a lower bound
// on the depth. Of a triangle beside the facet in its plane, as flush faces of many sides have them, the height of the corners
// says as much, and the origin need only be below it. Each of these triangles that a ray from the origin passes adds one to the
// number of times that the surface winds around the origin. A ray towards the tip passes no point of the facet, so that number
// is above 0, and every ray passes some triangle before it leaves M, which is convex.
//
// The surface begins as a pyramid. A triangle that the origin is too near to is taken away, with all others that some point of
// M beyond it sees, and the edges they leave are joined to that point. The surface stays closed whichever triangles go: what a
// point sees need not be sure.
#include "depth/facet_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/support.h"
#include "body/support_map.h"
#include "pair/difference.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A polygon between points of M, and the surface below it.
class FacetProof {
 public:
  FacetProof(const PairView& pair, const DepthStart& start)
      : pair_(pair), start_(start), rim_(std::size_t(start.count)), normal_(start.direction) {
    const Resting body = body_a(pair);
    const Moved other = body_b(pair);
    double high = 0;
    Vec q{0, 0, 0};
    for (std::size_t k = 0; k < rim_; ++k) {
      if (k == 0 || start.b[k] != start.b[k - 1]) q = other.point(start.b[k]);
      p_[k] = body.point(start.a[k]) - q;
      const double h = dot(normal_, p_[k]);
      height_ = k == 0 ? h : min(height_, h), high = k == 0 ? h : max(high, h);
    }
    flat_ = high - height_ <= pair.law_two / 8;
  }

  const Vec& normal() const { return normal_; }
  double height() const { return height_; }                       ///< of the polygon's lowest corner along the normal
  double lower() const { return height_ - pair_.point_error(); }  ///< `height()` less the rounding bound

  /// Finds the point of the polygon over the origin and returns its distance from `normal()` * `height()`; infinite if there is
  /// none. Within law 2's bound, the point's vertex pairs, weights and witness points are written to `depth`.
  double stand(Depth& depth) {
    if (!flat_) return kInfinity;
    const auto turn = [this](std::size_t i, std::size_t j) { return dot(normal_, cross(p_[i], p_[j])); };
    std::array<std::size_t, 3> of{0, 1, 2};
    std::array<double, 3> weight{turn(1, 2), turn(2, 0), turn(0, 1)};
    double sum = weight[0] + weight[1] + weight[2];
    if (rim_ == 4 && weight[1] * sum < 0)
      of = {0, 2, 3}, weight = {turn(2, 3), turn(3, 0), -weight[1]}, sum = weight[0] + weight[1] + weight[2];
    if (!(std::fabs(sum) > 0)) return kInfinity;
    turned_ = sum < 0;
    weight[1] = max(weight[1] / sum, 0), weight[2] = max(weight[2] / sum, 0), weight[0] = max(1 - weight[1] - weight[2], 0);
    const Vec foot = p_[of[0]] * weight[0] + p_[of[1]] * weight[1] + p_[of[2]] * weight[2];
    const double off = norm(foot - normal_ * height_);
    if (off > pair_.law_two) return off;
    depth.active.count = 0;
    depth.point_a = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] == 0) continue;
      const auto slot = std::size_t(depth.active.count++);
      depth.active.a[slot] = start_.a[of[k]], depth.active.b[slot] = start_.b[of[k]], depth.active.weight[slot] = weight[k];
      depth.point_a = depth.point_a + body_a(pair_).point(start_.a[of[k]]) * weight[k];
    }
    depth.point_b = depth.point_a - foot;
    return off;
  }

  /// True if the origin is surely below all triangles but the polygon, by more than that is high. `about_highest` returns a
  /// point of M that is nearly the highest along a direction, `climb` one that is higher. Where M is seen to be no higher than
  /// the polygon along some direction, `lowest` becomes that, of any length. To be called after `stand`.
  template <class AboutHighest, class Climb>
  bool closes(AboutHighest about_highest, Climb climb, Vec& lowest) {
    p_[rim_] = about_highest(-normal_);
    if (!(dot(normal_, p_[rim_]) < -pair_.point_error())) return false;
    points_ = rim_ + 1, triangles_ = 0;
    for (std::size_t k = 0, last = rim_ - 1; k < rim_; last = k++) turned_ ? add(last, k, rim_) : add(k, last, rim_);
    for (std::size_t t = nearest(); !(triangle_[t].distance > least()); t = nearest()) {
      if (is_beside(triangle_[t])) {
        triangle_[t].distance = kInfinity;
        continue;
      }
      if (points_ == kFacetPoints) return false;
      const Vec out = outwards(triangle_[t]);
      const double level = dot(out, p_[triangle_[t].corner[0]]) + kOutwardError * pair_.magnitude * norm(out);
      Vec& p = p_[points_];
      p = about_highest(out);
      if (!(dot(out, p) > level)) p = climb(out);
      if (!(dot(out, p) > level)) return lowest = out, false;
      if (!join()) return false;
    }
    return std::any_of(triangle_.begin(), triangle_.begin() + triangles_, [&](const Triangle& t) { return t.has(rim_); });
  }

 private:
  static constexpr std::size_t kMostTriangles = 2 * kFacetPoints;
  struct Triangle {
    std::array<std::uint8_t, 3> corner;
    Vec area;         ///< its normal, twice as long as its area
    double height;    ///< of its plane, times that length
    double distance;  ///< the origin is surely below it by as much, if this is above 0
    bool has(std::size_t k) const { return corner[0] == k || corner[1] == k || corner[2] == k; }
  };

  void add(std::size_t i, std::size_t j, std::size_t k) {
    const Vec &p = p_[i], u = p_[j] - p, v = p_[k] - p, area = cross(u, v);
    const double area2 = dot(area, area), height = dot(area, p),
                 error = kOutwardError * pair_.magnitude * std::sqrt(dot(u, u) * dot(v, v));
    const double distance = has_range(area2) ? (height - error) / std::sqrt(area2) : 0;
    triangle_[triangles_++] = {{std::uint8_t(i), std::uint8_t(j), std::uint8_t(k)}, area, height, distance};
  }
  std::size_t nearest() const {
    std::size_t best = 0;
    for (std::size_t t = 1; t < triangles_; ++t) best = triangle_[t].distance < triangle_[best].distance ? t : best;
    return best;
  }
  double least() const { return height_ + pair_.point_error(); }

  /// True if the origin is surely below a triangle that is as high as the polygon; `height()` becomes that of the lowest
  /// corner.
  bool is_beside(const Triangle& of) {
    double low = height_;
    for (const std::uint8_t k : of.corner) low = min(low, dot(normal_, p_[k]));
    const bool is = of.distance > 0 && height_ - low <= pair_.law_two / 8;
    if (is) height_ = low;
    return is;
  }

  /// Where a point of M beyond a triangle is looked for: along its normal or, where it has a side of the polygon, along that of
  /// the other plane through the side that is as near as the polygon. Any point beyond that plane will do.
  Vec outwards(const Triangle& of) const {
    if (of.corner[0] >= rim_ || of.corner[1] >= rim_) return of.area;
    const Vec across = cross(p_[of.corner[0]], p_[of.corner[1]]);
    return normal_ - across * (2 * dot(normal_, across) / dot(across, across));
  }

  /// Takes away all triangles that the next point sees, and joins the edges they leave to it. Returns false if there is no
  /// room, or it sees none.
  bool join() {
    const std::size_t next = points_++;
    const auto edge_of = [](std::size_t from, std::size_t to) { return std::uint16_t(from << 8 | to); };
    std::array<std::uint16_t, 3 * kMostTriangles> edge;
    std::size_t edges = 0;
    for (std::size_t k = 0; k < triangles_;) {
      if (!(dot(triangle_[k].area, p_[next]) > triangle_[k].height)) {
        ++k;
        continue;
      }
      const std::array<std::uint8_t, 3> corner = triangle_[k].corner;
      triangle_[k] = triangle_[--triangles_];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint8_t from = corner[i], to = corner[i == 2 ? 0 : i + 1];
        const auto end = edge.begin() + edges, twin = std::find(edge.begin(), end, edge_of(to, from));
        if (twin == end)
          edge[edges++] = edge_of(from, to);
        else
          *twin = edge[--edges];
      }
    }
    if (edges == 0 || triangles_ + edges > kMostTriangles) return false;
    for (std::size_t k = 0; k < edges; ++k) add(edge[k] >> 8, edge[k] & 0xff, next);
    return true;
  }

  const PairView& pair_;
  const DepthStart& start_;
  const std::size_t rim_;  ///< the number of the polygon's corners
  std::size_t points_, triangles_;
  double height_ = 0;
  bool flat_, turned_;  ///< `turned_`: clockwise seen from where the normal points
  Vec normal_;
  std::array<Vec, kFacetPoints> p_;  ///< the polygon's corners first
  std::array<Triangle, kMostTriangles> triangle_;
};

}  // namespace

bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, double upper,
                 const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth) {
  depth.steps = 0, depth.upper = kInfinity, depth.normal = {0, 0, 0};
  if (start.count < 3) return false;
  FacetProof facet(pair, start);
  const Vec& n = facet.normal();
  const double off = facet.lower() > 0 ? facet.stand(depth) : kInfinity;
  if (!(off <= pair.law_two)) return false;
  const std::uint32_t va = start.a[0], vb = start.b[0];
  const auto is_close = [&] { return goal.narrow(facet.lower(), upper) && off + (upper - facet.height()) <= pair.law_two; };
  if (!is_close()) ++depth.steps, upper = -supports(pair, n, va, vb, plane_tests).lower;
  if (!is_close()) return false;
  const Moved other = body_b(pair);
  const auto point = [&](std::uint32_t of_a, std::uint32_t of_b) { return body_a(pair).point(of_a) - other.point(of_b); };
  const auto climb = [&](const Vec& direction) {
    return point(ascend(pair.a, direction, va, plane_tests), ascend(pair.b, other.into(-direction), vb, plane_tests));
  };
  const auto about_highest = [&](const Vec& direction) {
    if (a.map_side == 0 || b.map_side == 0) return climb(direction);
    return point(look_up(a, direction).vertex, look_up(b, other.into(-direction)).vertex);
  };
  depth.upper = upper;
  if (!facet.closes(about_highest, climb, depth.normal) || !is_close()) return false;
  const double lower = facet.lower();
  depth.end = goal.passed(lower, upper) || !goal.hopeless(lower, upper) ? DepthEnd::Converged : DepthEnd::NotConverged;
  depth.lower = lower;
  depth.normal = n;
  if (depth.active.count == 3) depth.feature_a = start.feature_a, depth.feature_b = start.feature_b;
  return true;
}

}  // namespace swiftlet
