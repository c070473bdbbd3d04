// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A proof of depth. If the origin is surely below every triangle of a closed surface between points of the Minkowski difference
// M, the surface winds around the origin: every ray from there leaves through a triangle, no nearer than the lowest of the
// triangles' planes. M is convex, so the height of that plane is a lower bound on the depth. The surface is made of the facet
// asked about, a point beyond each of its sides, and triangles that close it below:
//
//        r1                r: the ring, far below the facet p if the overlap is shallow. Its triangles may be
//       / : \              degenerate, if two points of the ring coincide.
//     p1-----p2
//    / | p   | \           .
//   r0-p0---p3-r2
//       \ : /
//        r3
#include "depth/facet_proof.h"

#include <algorithm>
#include <limits>

#include "body/support.h"
#include "body/support_map.h"
#include "pair/difference.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Corner = Difference<double>;

/// A polygon between points of M, counter-clockwise seen from where its unit normal points, and a ring below it.
class FacetRing {
 public:
  FacetRing(const PairView& pair, const DepthStart& start) : pair_(pair), rim_(start.count) {
    for (std::size_t k = 0; k < rim(); ++k) p_[k] = difference<double>(pair, start.a[k], start.b[k]);
    normal_ = normalised(cross(p_[1].p - p_[0].p, p_[rim() - 1].p - p_[0].p));
    if (dot(normal_, start.direction) < 0) std::reverse(p_.begin() + 1, p_.begin() + rim_), normal_ = -normal_;
    double high = 0;
    for (std::size_t k = 0; k < rim(); ++k) {
      const double h = dot(normal_, p_[k].p);
      height_ = k == 0 ? h : min(height_, h), high = k == 0 ? h : max(high, h);
    }
    flat_ = high - height_ <= pair.law_two / 8;
  }

  const Vec& normal() const { return normal_; }
  double height() const { return height_; }
  double lower() const { return height_ - pair_.point_error; }  ///< `height()` less the rounding bound
  const Corner& operator[](std::size_t k) const { return p_[k]; }

  /// Finds the point of the polygon over the origin and returns its distance from `normal()` * `height()`; infinite if there is
  /// none. Within law 2's bound, the point's vertex pairs, weights and witness points are written to `depth`.
  double stand(Depth& depth) const {
    if (!flat_) return kInfinity;
    std::array<std::size_t, 3> of{0, 1, 2};
    if (rim_ == 4 && dot(normal_, cross(p_[0].p, p_[2].p)) > 0) of = {0, 2, 3};
    const Vec &p = p_[of[0]].p, &q = p_[of[1]].p, &r = p_[of[2]].p;
    std::array<double, 3> weight{max(dot(normal_, cross(q, r)), 0), max(dot(normal_, cross(r, p)), 0),
                                 max(dot(normal_, cross(p, q)), 0)};
    const double sum = weight[0] + weight[1] + weight[2];
    if (!(sum > 0)) return kInfinity;
    weight[1] /= sum, weight[2] /= sum, weight[0] = max(1 - weight[1] - weight[2], 0);
    const double off = norm(p * weight[0] + q * weight[1] + r * weight[2] - normal_ * height_);
    if (off > pair_.law_two) return off;
    depth.active.count = 0;
    depth.point_a = depth.point_b = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] == 0) continue;
      const Corner& c = p_[of[k]];
      const auto slot = std::size_t(depth.active.count++);
      depth.active.a[slot] = c.a, depth.active.b[slot] = c.b, depth.active.weight[slot] = weight[k];
      depth.point_a = depth.point_a + body_a(pair_).point(c.a) * weight[k];
      depth.point_b = depth.point_b + body_b(pair_).point(c.b) * weight[k];
    }
    return off;
  }

  /// Looks for a point of the ring beyond each side of the polygon, leaning out less the nearer the side is to the nearest
  /// point. True if the origin is below all triangles, and those that close the surface are no nearer to it than the polygon.
  template <class AboutHighest>
  bool closes(AboutHighest about_highest) {
    for (std::size_t k = 0; k < rim(); ++k) {
      const Vec &p = p_[k].p, &q = p_[after(k)].p, side = q - p;
      const double length = norm(side), beside = kLean * dot(normal_, cross(p, q)) / (length * height_);
      const Vec out = cross(side, normal_), up = normal_ * length;
      Vec direction = up + out * min(max(0, beside), kFlare);
      // Where the facet goes on beyond the side, what is highest there lies in its plane: the ring is looked for below it.
      for (bool lower_down = false;; lower_down = true, direction = out - up * kFlare) {
        p_[rim() + k] = about_highest(direction, p_[k]);
        if (lower_down || !(dot(normal_, p_[rim() + k].p) > lower())) break;
      }
    }
    for (std::size_t k = 2; k < rim(); ++k) {
      if (!covers(0, k - 1, k, 0)) return false;
    }
    const double least = height_ + pair_.point_error;
    for (std::size_t k = 0, last = rim() - 1; k < rim(); last = k++) {
      if (!covers(after(k), k, rim() + k, least) || !covers(rim() + k, k, rim() + last, least)) return false;
      if (k >= 2 && !covers(rim(), rim() + k, rim() + last, least)) return false;
    }
    return true;
  }

 private:
  std::size_t rim() const { return std::size_t(rim_); }
  std::size_t after(std::size_t k) const { return k + 1 == rim() ? 0 : k + 1; }

  /// True if the origin is surely below a triangle's plane by more than `least`, or two corners are the same vertex pair.
  /// Compares squares, so that a product that overflows or vanishes covers nothing.
  bool covers(std::size_t i, std::size_t j, std::size_t k, double least) const {
    const Corner &p = p_[i], &q = p_[j], &r = p_[k];
    if (same(p, q) || same(q, r) || same(r, p)) return true;
    const Vec u = q.p - p.p, v = r.p - p.p, area = cross(u, v);
    const double low = min(dot(area, p.p), min(dot(area, q.p), dot(area, r.p)));
    const double error = kOutwardError * pair_.magnitude;
    return low > 0 && low * low > max(error * error * (dot(u, u) * dot(v, v)), least * least * dot(area, area));
  }

  const PairView& pair_;
  int rim_;
  bool flat_ = false;
  double height_ = 0;  ///< the height of the polygon's lowest corner along the normal
  Vec normal_{0, 0, 0};
  std::array<Corner, 8> p_;  ///< the corners of the polygon, then the ring
};

}  // namespace

bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
                 std::uint32_t& plane_tests, Depth& depth) {
  depth.steps = 0, depth.upper = kInfinity;
  if (start.count < 3) return false;
  FacetRing ring(pair, start);
  const Vec& n = ring.normal();
  const double lower = ring.lower(), off = lower > 0 ? ring.stand(depth) : kInfinity;
  if (!(off <= pair.law_two)) return false;
  ++depth.steps;
  const Supports top = supports(pair, n, ring[0].a, ring[0].b, plane_tests);
  const double upper = -top.lower;
  if (!goal.narrow(lower, upper) || off + (upper - ring.height()) > pair.law_two) return false;
  const auto about_highest = [&](const Vec& direction, const Corner& from) {
    const Vec own = body_b(pair).into(-direction);
    if (a.map_side == 0 || b.map_side == 0)
      return difference<double>(pair, ascend(pair.a, direction, from.a, plane_tests), ascend(pair.b, own, from.b, plane_tests));
    return difference<double>(pair, look_up(a, direction).vertex, look_up(b, own).vertex);
  };
  depth.upper = upper;
  if (!ring.closes(about_highest)) return false;
  depth.end = goal.passed(lower, upper) || !goal.hopeless(lower, upper) ? DepthEnd::Converged : DepthEnd::NotConverged;
  depth.lower = lower;
  depth.normal = n;
  if (depth.active.count == 3) depth.feature_a = start.feature_a, depth.feature_b = start.feature_b;
  return true;
}

}  // namespace swiftlet
