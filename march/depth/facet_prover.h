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
//
// The corners of the facet, and the triangles of the pyramid, are lanes of vectors; mostly the pyramid is all. Each file that
// includes this compiles it for the registers of its own flags: see facet_proof.cpp. Nothing here is defined for other files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "body/support.h"
#include "body/support_map.h"
#include "depth/facet_proof.h"
#include "numeric/vec4.h"
#include "pair/difference.h"
#include "pair/pair_view4.h"

namespace swiftlet {
namespace {

/// A polygon of three or four points of M, and the surface below it.
class FacetProof {
 public:
  FacetProof(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, std::uint32_t& plane_tests)
      : pair_(pair),
        other_(pair),
        a_(a),
        b_(b),
        start_(start),
        plane_tests_(plane_tests),
        sides_(std::size_t(start.count)),
        rim_(pair, lanes(start.a), lanes(start.b)),
        normal_(start.direction) {
    const V3<Vec4>&p = rim_.p, n = repeated(normal_);
    const Vec4 x = n.x * p.x, y = n.y * p.y, z = n.z * p.z, height = x + y + z;
    height_ = least(height), height_error_ = kGapError * greatest(abs(x) + abs(y) + abs(z));
    flat_ = greatest(height) - height_ <= pair.law_two / 8;
  }

  const Vec& normal() const { return normal_; }
  double height() const { return height_; }  ///< of the polygon's lowest corner along the normal
  /// `height()` less what bounds its rounding, as that of a `gap`.
  double lower() const { return height_ - (height_error_ + pair_.motion_error); }

  /// Finds the point of the polygon over the origin and returns its distance from `normal()` * `height()`; infinite if there is
  /// none. Within law 2's bound, the point's vertex pairs, weights and witness points are written to `depth`.
  double stand(Depth& depth) {
    if (!flat_) return kInfinity;
    const V3<Vec4>& p = rim_.p;
    const Vec4 turn = dot(repeated(normal_), cross(p, V3<Vec4>{next(p.x), next(p.y), next(p.z)}));
    // From the third corner to the first: a side of a triangle, a diagonal of a quadrangle.
    const double back = sides_ == 3 ? turn[3] : dot(normal_, cross(vec(p, 2), vec(p, 0)));
    std::array<std::size_t, 3> of{0, 1, 2};
    std::array<double, 3> weight{turn[1], back, turn[0]};
    double sum = weight[0] + weight[1] + weight[2];
    const bool beyond = sides_ == 4 && back * sum < 0;
    if (beyond) of = {0, 2, 3}, weight = {turn[2], turn[3], -back}, sum = weight[0] + weight[1] + weight[2];
    if (!(std::fabs(sum) > 0)) return kInfinity;
    turned_ = sum < 0;
    weight[1] = max(weight[1] / sum, 0), weight[2] = max(weight[2] / sum, 0);
    weight[0] = 1 - weight[1] - weight[2];
    if (weight[0] < 0) {  // the sum stays 1
      weight[1] = weight[1] / (1 - weight[0]), weight[2] = 1 - weight[1], weight[0] = 0;
    }
    const Vec4 weights =
        beyond ? vec4(Vec2{weight[0], 0}, Vec2{weight[1], weight[2]}) : vec4(Vec2{weight[0], weight[1]}, Vec2{weight[2], 0});
    const auto weighed = [&weights](const V3<Vec4>& points) {
      const auto total = [&weights](const Vec4& of_points) {
        const Vec4 x = of_points * weights;
        return x[0] + x[1] + x[2] + x[3];
      };
      return Vec{total(points.x), total(points.y), total(points.z)};
    };
    const Vec foot = weighed(p);
    const double off = norm(foot - normal_ * height_);
    if (off > pair_.law_two) return off;
    depth.active.count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] == 0) continue;
      const auto slot = std::size_t(depth.active.count++);
      depth.active.a[slot] = start_.a[of[k]], depth.active.b[slot] = start_.b[of[k]], depth.active.weight[slot] = weight[k];
    }
    depth.point_a = weighed(rim_.of_a);
    depth.point_b = depth.point_a - foot;
    return off;
  }

  /// True if the origin is surely below all triangles but the polygon, by more than that is high. Where M is seen to be no
  /// higher than the polygon along some direction, `lowest` becomes that, of any length. To be called after `stand`.
  bool closes(Vec& lowest) {
    const Vec4 tip = about_highest(vec4(-normal_));
    if (!(dot(normal_, vec(tip)) < -pair_.point_error())) return false;
    const V3<Vec4>& p = rim_.p;
    // The side before a triangle's first corner leads from its third, which is in the last lane too.
    const V3<Vec4> before{previous(p.x), previous(p.y), previous(p.z)},
        &from = turned_ ? before : p, u = (turned_ ? p : before) - from, v = repeated(tip) - from, area = cross(u, v);
    const Vec4 area2 = dot(area, area), height = dot(area, from),
               error = sqrt(dot(u, u) * dot(v, v)) * (kOutwardError * pair_.magnitude),
               distance = (height - error) / sqrt(area2);
    const unsigned in_range = at_most(all(kLeastSquare), area2) & greater(all(kInfinity), area2),
                   all_sides = (1u << sides_) - 1;
    if ((in_range & greater(distance, all(least_distance())) & all_sides) == all_sides) return true;
    for (std::size_t k = 0; k < sides_; ++k) {
      const auto i = std::uint8_t(k), j = std::uint8_t(k == 0 ? sides_ - 1 : k - 1), t = std::uint8_t(sides_);
      p_[k] = vec(p, k);
      triangle_[k] = {turned_ ? std::array{j, i, t} : std::array{i, j, t}, vec(area, k), height[int(k)],
                      in_range >> k & 1 ? distance[int(k)] : 0};
    }
    p_[sides_] = vec(tip);
    return grows(lowest);
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

  /// The four lanes of a start's vertices: the last of three comes twice.
  std::array<std::uint32_t, 4> lanes(const std::array<std::uint32_t, 4>& of) const {
    return {of[0], of[1], of[2], of[sides_ - 1]};
  }
  Vec4 point(std::uint32_t of_a, std::uint32_t of_b) const { return vec4(pair_.a.vertices[of_a]) - other_.point(of_b); }
  /// A point of M that is higher along `direction` than others.
  Vec climbed(const Vec& direction) {
    return vec(point(ascend(pair_.a, direction, start_.a[0], plane_tests_),
                     ascend(pair_.b, vec(other_.into(vec4(-direction))), start_.b[0], plane_tests_)));
  }
  /// A point of M that is nearly the highest along `direction`.
  Vec4 about_highest(const Vec4& direction) {
    if (a_.map_side == 0 || b_.map_side == 0) return vec4(climbed(vec(direction)));
    const auto [of_a, of_b] = look_up(a_, direction, b_, -other_.into(direction));
    return point(of_a.vertex, of_b.vertex);
  }

  /// As `closes`, from the pyramid on.
  [[gnu::noinline, gnu::flatten]] bool grows(Vec& lowest) {
    points_ = sides_ + 1, triangles_ = sides_;
    for (std::size_t t = nearest(); !(triangle_[t].distance > least_distance()); t = nearest()) {
      if (is_beside(triangle_[t])) {
        triangle_[t].distance = kInfinity;
        continue;
      }
      if (points_ == kFacetPoints) return false;
      const Vec out = outwards(triangle_[t]);
      const double level = dot(out, p_[triangle_[t].corner[0]]) + kOutwardError * pair_.magnitude * norm(out);
      Vec& p = p_[points_];
      p = vec(about_highest(vec4(out)));
      if (!(dot(out, p) > level)) p = climbed(out);
      if (!(dot(out, p) > level)) return lowest = out, false;
      if (!join()) return false;
    }
    return std::any_of(triangle_.begin(), triangle_.begin() + triangles_, [&](const Triangle& t) { return t.has(sides_); });
  }

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
  double least_distance() const { return height_ + pair_.point_error(); }

  /// True if the origin is surely below a triangle that is as high as the polygon; `height()` becomes that of the lowest
  /// corner.
  bool is_beside(const Triangle& of) {
    double low = height_, error = height_error_;
    for (const std::uint8_t k : of.corner) {
      const Vec products{normal_.x * p_[k].x, normal_.y * p_[k].y, normal_.z * p_[k].z};
      low = min(low, products.x + products.y + products.z), error = max(error, kGapError * norm_1(products));
    }
    const bool is = of.distance > 0 && height_ - low <= pair_.law_two / 8;
    if (is) height_ = low, height_error_ = error;
    return is;
  }

  /// Where a point of M beyond a triangle is looked for: along its normal or, where it has a side of the polygon, along that of
  /// the other plane through the side that is as near as the polygon. Any point beyond that plane will do.
  Vec outwards(const Triangle& of) const {
    if (of.corner[0] >= sides_ || of.corner[1] >= sides_) return of.area;
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
  const Moved4 other_;
  const Level &a_, &b_;
  const DepthStart& start_;
  std::uint32_t& plane_tests_;
  const std::size_t sides_;  ///< the number of the polygon's corners
  const Differences rim_;    ///< these corners
  std::size_t points_, triangles_;
  double height_, height_error_;
  bool flat_, turned_;  ///< `turned_`: clockwise seen from where the normal points
  Vec normal_;
  std::array<Vec, kFacetPoints> p_;  ///< the polygon's corners first, then the tip
  std::array<Triangle, kMostTriangles> triangle_;
};

/// As `prove_facet`.
[[gnu::flatten]] bool proves_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start,
                                   const Ceiling& ceiling, const DepthGoal& goal, std::uint32_t& plane_tests, Depth& depth) {
  depth.steps = 0, depth.upper = kInfinity, depth.normal = {0, 0, 0};
  if (start.count < 3) return false;
  FacetProof facet(pair, a, b, start, plane_tests);
  const Vec& n = facet.normal();
  const double off = facet.lower() > 0 ? facet.stand(depth) : kInfinity;
  if (!(off <= pair.law_two)) return false;
  double upper = ceiling.height(n);
  const auto is_close = [&] { return goal.narrow(facet.lower(), upper) && off + (upper - facet.height()) <= pair.law_two; };
  bool close = is_close();
  while (!close && tighten(ceiling.moved, ceiling.seen, plane_tests)) upper = ceiling.height(n), close = is_close();
  if (!close) {
    ++depth.steps, upper = -supports(pair, n, start.a[0], start.b[0], plane_tests).lower;
    if (!is_close()) return false;
  }
  depth.upper = upper;
  const double lower_before = facet.lower();
  if (!facet.closes(depth.normal) || (facet.lower() < lower_before && !is_close())) return false;
  const double lower = facet.lower();
  depth.end = goal.passed(lower, upper) || !goal.hopeless(lower, upper) ? DepthEnd::Converged : DepthEnd::NotConverged;
  depth.lower = lower;
  depth.normal = n;
  if (depth.active.count == 3) depth.feature_a = start.feature_a, depth.feature_b = start.feature_b;
  return true;
}

}  // namespace
}  // namespace swiftlet
