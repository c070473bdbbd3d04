// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Checks of depths by definition: the least height of all planes that can bound the Minkowski difference, selected by exact
// signs. No polytope is expanded.
#include <swiftlet/check.h>

#include <array>
#include <optional>
#include <vector>

#include "body/half_edge.h"
#include "check/brute.h"

namespace swiftlet {
namespace {

/// Returns v * 2^exponent.
Wide scaled(const Wide& v, int exponent) {
  const auto scale = [&](const DoubleDouble& x) {
    return DoubleDouble(HighLow{times_power_of_two(x.high, exponent), times_power_of_two(x.low, exponent)});
  };
  return {scale(v.x), scale(v.y), scale(v.z)};
}

/// A normal or the direction of an edge, scaled by a power of two so that its largest coordinate is from 1 to 2. 0 stays 0.
struct Direction {
  Wide fine;
  Vec rough;
};
Direction direction(const Wide& v) {
  const double largest = max_abs(rounded(v));
  const Wide fine = scaled(v, largest > 0 ? -exponent_of(largest) : 0);
  return {fine, rounded(fine)};
}
Direction operator-(const Direction& d) { return {-d.fine, -d.rough}; }

/// Returns the sign of n . d, or 0 if rounding leaves it in doubt.
int rough_side(const Vec& n, const Direction& d) {
  const double x = dot(n, d.rough);
  return x > kRoughSideError ? 1 : x < -kRoughSideError ? -1 : 0;
}
int side(const Direction& n, const Direction& d) {
  if (const int sign = rough_side(n.rough, d)) return sign;
  const double x = double(dot(n.fine, d.fine));
  return x > kSideError ? 1 : x < -kSideError ? -1 : 0;
}

/// Returns the pose with its translation times 2^exponent and rotation entries below kLeastEntry set to 0.
Motion scaled(const Motion& m, int exponent) {
  const auto entry = [](double x) { return std::fabs(x) < kLeastEntry ? 0 : x; };
  const auto row = [&](const Vec& r) { return Vec{entry(r.x), entry(r.y), entry(r.z)}; };
  return {row(m.row_x), row(m.row_y), row(m.row_z), rounded(scaled(wide(m.t), exponent))};
}

/// A body scaled by 2^exponent: its vertices in its own frame, and its points, facets and edges in the common frame.
struct Solid {
  struct Facet {
    std::array<std::uint32_t, 3> corner;
    Direction normal;
  };
  struct Edge {
    std::uint32_t tail, head;
    std::array<std::uint32_t, 2> beside;  ///< facets to the left and right; kNone for a segment
    Direction along;
  };

  Solid(const ConvexView& view, const Motion& m, int exponent) : motion(m) {
    for (Vertex v : view.vertices) {
      v.x = times_power_of_two(v.x, exponent), v.y = times_power_of_two(v.y, exponent), v.z = times_power_of_two(v.z, exponent);
      vertices.push_back(v);
      points.push_back(wide(m, vec(v)));
      rough_points.push_back(rounded(points.back()));
      reach = max(reach, max_abs(rough_points.back()));
    }
    std::vector<std::uint32_t> facet_of(view.half_edges.size(), kNone);
    for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
      if (facet_of[h] != kNone || view.half_edges[h].face == kNone) continue;
      const std::array<std::uint32_t, 3> corner{origin(view, h), view.half_edges[h].head,
                                                view.half_edges[next_in_facet(view, h)].head};
      for (std::uint32_t k = h; facet_of[k] == kNone; k = next_in_facet(view, k)) facet_of[k] = std::uint32_t(facets.size());
      facets.push_back({corner, direction(facet_normal(m, vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]))});
    }
    for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
      if (view.half_edges[h].twin < h) continue;
      const std::uint32_t tail = origin(view, h), head = view.half_edges[h].head;
      edges.push_back({tail,
                       head,
                       {facet_of[h], facet_of[view.half_edges[h].twin]},
                       direction(rotated(m, vertices[head], vertices[tail]))});
    }
  }

  Vec rough_normal(std::uint32_t facet) const { return facet == kNone ? Vec{0, 0, 0} : facets[facet].normal.rough; }
  const double* at(std::uint32_t v) const { return &vertices[v].x; }

  /// Returns how far the body reaches along `n`, times the length of `n`.
  DoubleDouble height(const Direction& n) const {
    double most = -kInfinity;
    for (const Vec& p : rough_points) most = max(most, dot(n.rough, p));
    DoubleDouble height = -kInfinity;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dot(n.rough, rough_points[i]) < most - 2 * kRoughHeightError * reach) continue;
      if (const DoubleDouble h = dot(n.fine, points[i]); h > height) height = h;
    }
    return height;
  }

  const Motion motion;
  std::vector<Vertex> vertices;
  std::vector<Wide> points;
  std::vector<Vec> rough_points;
  double reach = 0;  ///< the largest coordinate of a point
  std::vector<Facet> facets;
  std::vector<Edge> edges;
};

/// Finds the least height of the Minkowski difference of A and B over the planes that can bound it, each parallel to a facet of
/// A, to a facet of B, or to an edge of each. Let e be an edge of A and f an edge of B. N = e x f is the normal of a supporting
/// plane of the difference if no vertex of the facets beside e is above e along N, and no vertex of the facets beside f is
/// below f; by convexity this then holds for all vertices. On the facet to the left of e, with normal n, N . (w - v) is -f . n
/// up to a positive factor; on the right it is f . n; on the facets beside f it is e . n and -e . n.
class LeastHeight {
 public:
  LeastHeight(const PairView& pair, int exponent)
      : a_(pair.a, kAtRest, exponent),
        b_(pair.b, scaled(pair.b_in_a, exponent), exponent),
        tie_(kHeightError / 2 * times_power_of_two(pair.magnitude, exponent)) {}

  /// Returns the least height at the scale of the check; infinite where all differences lie on a line.
  DoubleDouble find() {
    for (const Solid* body : {&a_, &b_}) {
      for (const Solid::Facet& facet : body->facets) {
        const Direction &n = facet.normal, opposite = -n;
        take(n.fine, a_.height(n) + b_.height(opposite));
        take(n.fine, a_.height(opposite) + b_.height(n));
      }
    }
    for (const Solid::Edge& e : a_.edges) {
      const Vec left = a_.rough_normal(e.beside[0]), right = a_.rough_normal(e.beside[1]);
      for (const Solid::Edge& f : b_.edges) {
        const double l = dot(left, f.along.rough), r = dot(right, f.along.rough);
        if (min(l, r) <= kRoughSideError && max(l, r) >= -kRoughSideError) take(e, f);
      }
    }
    return least_;
  }

 private:
  /// Returns true if `height` is less than the least so far by more than rounding; of planes equally near, one is enough.
  bool is_lower(const DoubleDouble& height) const { return height + tie_ < least_; }

  void take(const Wide& n, const DoubleDouble& height) {
    const DoubleDouble square = dot(n, n);
    if (!(square.high > 0)) return;
    if (const DoubleDouble h = height / root(square); h < least_) least_ = h;
  }

  void take(const Solid::Edge& e, const Solid::Edge& f) {
    bool below = true, above = true;  // where the vertices of the facets beside e and f lie along N
    const auto may_bound = [&](int sign) {
      below = below && sign >= 0, above = above && sign <= 0;
      return below || above;
    };
    for (const std::size_t k : {0, 1}) {  // most pairs bound nothing, which doubles show
      const int side = k == 0 ? 1 : -1;
      if (!may_bound(side * rough_side(a_.rough_normal(e.beside[k]), f.along))) return;
      if (!may_bound(side * rough_side(b_.rough_normal(f.beside[k]), e.along))) return;
    }
    Wide n = cross(e.along.fine, f.along.fine);
    if (!(max_abs(rounded(n)) >= 4 * kCancelled)) {
      n = direction(exact::edge_normal(a_.at(e.tail), a_.at(e.head), b_.motion, b_.at(f.head), b_.at(f.tail))).fine;
    }
    const DoubleDouble square = dot(n, n);
    if (!(square.high > 0)) return;
    const DoubleDouble height = dot(n, a_.points[e.tail] - b_.points[f.tail]) / root(square);
    below = below && is_lower(height), above = above && is_lower(-height);
    if (!below && !above) return;
    for (const std::size_t k : {0, 1}) {
      const int side = k == 0 ? 1 : -1;
      if (!may_bound(side * side_in_a(e.beside[k], f)) || !may_bound(side * side_in_b(f.beside[k], e))) return;
    }
    if (below) least_ = height;
    if (above && is_lower(-height)) least_ = -height;
  }

  /// Returns the sign of n . f, where n is the normal of a facet of A; 0 if `facet` is kNone.
  int side_in_a(std::uint32_t facet, const Solid::Edge& f) const {
    if (facet == kNone) return 0;
    const auto& [corner, normal] = a_.facets[facet];
    if (const int sign = side(normal, f.along)) return sign;
    return exact::compare_turned_along_normal(a_.at(corner[0]), a_.at(corner[1]), a_.at(corner[2]), b_.motion, b_.at(f.head),
                                              b_.at(f.tail));
  }
  /// Returns the sign of n . e, where n is the normal of a facet of B; 0 if `facet` is kNone.
  int side_in_b(std::uint32_t facet, const Solid::Edge& e) const {
    if (facet == kNone) return 0;
    const auto& [corner, normal] = b_.facets[facet];
    if (const int sign = side(normal, e.along)) return sign;
    return exact::compare_along_turned_normal(b_.motion, b_.at(corner[0]), b_.at(corner[1]), b_.at(corner[2]), a_.at(e.head),
                                              a_.at(e.tail));
  }

  const Solid a_, b_;
  const double tie_;
  DoubleDouble least_ = kInfinity;
};

}  // namespace

DoubleDouble Checked::depth_of(int level_a, int level_b) const {
  const PairView pair = pair_view(a.level(level_a).view, b.level(level_b).view, at.motion, at.quality.error);
  const int exponent = pair.magnitude > 0 ? kCheckedExponent - exponent_of(pair.magnitude) : 0;
  const DoubleDouble least = LeastHeight(pair, exponent).find();
  if (!(least.high < kInfinity)) return least;
  return HighLow{times_power_of_two(least.high, -exponent), times_power_of_two(least.low, -exponent)};
}

DoubleDouble Checked::least_depth() const {
  DoubleDouble most = -kInfinity;
  each_level_pair([&](int level_a, int level_b, double error) {
    const DoubleDouble depth = depth_of(level_a, level_b);
    if (error == 0 || !(depth.high < kInfinity))
      most = depth;
    else if (!(depth < 0) && depth - error > most)
      most = depth - error;
  });
  return most;
}

Check check_signed(const Checked& of, const OverlapProof* proof) {
  const Answer& answer = of.answer;
  const Vec& n = of.normal;
  const double doubt = kHeightError * (of.magnitude + of.radii);
  if (std::isfinite(answer.lower)) {
    if (!(std::fabs(double(dot(wide(n), wide(n)) - 1.0)) <= kUnitError)) return failed("the normal's length is %.17g", norm(n));
    const double gap = gap_along(of.a, of.b, of.at.motion, n), error = kNormError * std::fabs(gap) + doubt;
    if (!(double(of.of_hulls(answer.lower) - gap) <= error))
      return failed("lower is %.17g, but the gap along the normal is %.17g", answer.lower, gap - of.radii);
    if (std::isfinite(answer.upper) && !(double(of.of_hulls(answer.upper) - gap) >= -error))
      return failed("upper is %.17g, but the gap along the normal is %.17g", answer.upper, gap - of.radii);
    if (answer.verdict != Verdict::Undecided) {
      if (const Check nearest = of.points_are_nearest(); !nearest) return nearest;
    }
  }
  if (answer.lower > 0) return check_distance(of, proof);
  if (answer.verdict == Verdict::Undecided && answer.upper < -of.touching)
    return failed("undecided with an upper bound of %.17g", answer.upper);
  if (answer.verdict == Verdict::Disjoint) return failed("disjoint without a lower bound");

  std::optional<DoubleDouble> found;
  const auto depth = [&] {
    if (!found) found = of.least_depth();
    return *found;
  };
  const bool proved = proof && proof->count > 0 && check_proof(of.a.level(0).view, of.b.level(0).view, of.at.motion, *proof);
  if (std::isfinite(answer.upper)) {
    const double apart = of.knows_points() ? norm(of.point_b - of.point_a) + of.deviation : kInfinity;
    const DoubleDouble upper = of.of_hulls(answer.upper);
    // A wide interval around 0 may come with the points of an overlap. Any other two points may then prove `upper`, or coarse
    // levels that overlap by less than they deviate.
    const bool is_met = upper.high >= 0 && (proved || apart <= double(upper) + 2 * of.slack || of.is_near(answer.upper));
    const bool may_be_deep = upper.high < 0 || of.a.finest_level() > 0 || of.b.finest_level() > 0;
    const bool is_proved = is_met || (may_be_deep && double(-upper - depth()) <= doubt);
    if (!is_proved && upper.high >= 0) return failed("upper is %.17g, and nothing proves it", answer.upper);
    if (!is_proved && !(depth().high < kInfinity)) return failed("upper is %.17g, but the bodies share a plane", answer.upper);
    if (!is_proved) return failed("upper is %.17g, but the depth is %.17g", answer.upper, double(depth()) + of.radii);
  }
  if (answer.verdict == Verdict::Overlapping && !(answer.upper < 0) && !proved) {
    if (const Check overlap = of.hulls_overlap(nullptr); !overlap) return overlap;
  }
  if (answer.verdict == Verdict::Touching) {
    if (!(std::fabs(answer.upper) <= of.touching)) return failed("touching with an upper bound of %.17g", answer.upper);
    if (!of.is_shallow()) return failed("touching, but nothing proves that the bodies are not deep in each other");
  }
  return kPassed;
}

}  // namespace swiftlet
