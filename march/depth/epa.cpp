// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The expanding polytope algorithm [van den Bergen 2001]. The polytope is the exact convex hull of points of the Minkowski
// difference M, rounded to a grid. It is convex and closed whatever the points, so its lowest facet proves a lower bound, less
// what the grid moved the points by. The support of M along that facet's normal proves an upper bound. If the support is above
// the facet, it is the next point; if not, both bounds agree up to rounding, however nearly coplanar the facets are.
#include "depth/epa.h"

#include <algorithm>

#include "body/support.h"
#include "body/support_map.h"
#include "depth/exact_hull.h"
#include "pair/difference.h"

namespace swiftlet {
namespace {

/// A cone of directions spanned by `x`, `y` and `z`, counter-clockwise seen from outside.
struct Cone {
  Vec x, y, z;
};

/// A supporting plane of M.
struct Plane {
  double height = kInfinity;  ///< proved: no point of M is higher
  Vec normal{0, 0, 0};
};

/// A point of M rounded to the grid, and the vertex pair whose difference it is.
struct Corner {
  Vec p;
  std::uint32_t a, b;
};

/// The point of a triangle nearest to the origin.
struct Foot {
  std::array<DoubleDouble, 3> weight;
  Wide point;
};

/// The foot on a triangle whose plane is `height` above the origin: the point inside, if it is as near as the plane; else the
/// nearest of that and the points on the edges, because the weights inside a sliver may be noise.
Foot foot_on(const Wide& a, const Wide& b, const Wide& c, double height) {
  const DoubleDouble zero(0), one(1);
  const Wide n = cross(b - a, c - a);
  const DoubleDouble u = dot(n, cross(b, c)), v = dot(n, cross(c, a)), w = dot(n, cross(a, b));
  Foot best{{one, zero, zero}, a};
  if (u > zero && v > zero && w > zero) {
    const DoubleDouble sum = u + v + w, share_v = v / sum, share_w = w / sum;
    best = {{one - share_v - share_w, share_v, share_w}, a + (b - a) * share_v + (c - a) * share_w};
    if (norm(rounded(best.point)) <= std::fabs(height) * (1 + kPlaneHeightError)) return best;
  }
  const auto along = [&](std::size_t from, std::size_t to, const Wide& p, const Wide& q) {
    const Wide e = q - p;
    const DoubleDouble length2 = dot(e, e), rise = -dot(p, e);
    const DoubleDouble t = !(rise > zero) ? zero : !(rise < length2) ? one : rise / length2;
    const Wide point = t < one ? p + e * t : q;
    if (!(dot(point, point) < dot(best.point, best.point))) return;
    best = {{zero, zero, zero}, point};
    best.weight[from] = one - t, best.weight[to] = t;
  };
  along(0, 1, a, b), along(1, 2, b, c), along(2, 0, c, a);
  return best;
}

/// How an expansion ended.
enum class End : std::uint8_t {
  Enough,     ///< the goal is met
  TooCoarse,  ///< the goal cannot be met on these levels
  Apart,
  Budget,
  Full,   ///< no room for another point
  Stuck,  ///< rounding exceeded its bound: never seen
  Flat,   ///< M has no volume on the grid
};

class Polytope {
 public:
  Polytope(const PairView& pair, const Level& a, const Level& b, const DepthGoal& goal, std::uint32_t& plane_tests)
      : pair_(pair),
        level_a_(a),
        level_b_(b),
        goal_(goal),
        plane_tests_(plane_tests),
        exact_(goal.stop.is_exact()),
        binade_(power_of_two(exponent_of(max(pair.magnitude, kLeastWidth)))),
        moved_((kGridError + kPlaneHeightFloor) * pair.magnitude) {}

  /// Begins with the start's polygon, a point beyond each of its sides and one off its plane: often these prove the depth.
  /// Returns false if M is flat on the grid; the supporting planes found then bound the depth.
  bool begin(const DepthStart& start) {
    lower_ = 0;
    std::array<Corner, 9> found;
    int count = 0;
    for (; count < start.count; ++count) {
      const auto k = std::size_t(count);
      found[k] = corner_of(start.a[k], start.b[k]);
    }
    const Vec hint = normalised(dot(start.direction, start.direction) > 0 ? start.direction : Vec{1, 0, 0});
    if (count < 3 || on_line(found)) {
      if (!find_triangle(hint, found)) return false;
      count = 3;
    }
    rim_ = count;
    Vec n = exact::plane(found[0].p, found[1].p, found[2].p).normal;
    const double turn = dot(n, hint) < 0 ? -1 : 1;  // 1: the polygon is counter-clockwise seen from the hint's side
    n = n * turn;
    Corner apex;
    if (!leave_plane(-n, {found[0], found[1], found[2]}, apex)) return false;
    close({found[0], found[1], found[2], apex});
    if (count == 4) include(found[3]);
    for (int i = 0; i < rim_; ++i) {
      const Corner &from = found[std::size_t(i)], &to = found[std::size_t((i + 1) % rim_)];
      const Vec side = to.p - from.p;
      include(about_highest(n * norm(side) + cross(side, n) * (turn * kFlare), from));
    }
    return true;
  }

  /// Begins with one point of M and all that lies from there along the directions that no direction of the cone leans towards:
  /// along the cone's directions the hull of M and these is as high as M, along others it is unbounded.
  void begin(const Cone& cone) {
    lower_ = 0, rim_ = 0;
    const Corner first = support(normalised(cone.x + cone.y + cone.z), 0, 0);
    hull_.begin({-cross(cone.x, cone.y), -cross(cone.y, cone.z), -cross(cone.z, cone.x)}, first.p);
    vertex_pair_[3] = {first.a, first.b};
  }

  /// Adds the support along the lowest facet's normal until the goal is met and, unless `bounds_only`, the best plane is that
  /// of the facet with the nearest point: of several facets as low, points and plane must belong to one.
  End grow(bool bounds_only = false) {
    for (;;) {
      int next = hull_.lowest();
      lower_ = below(hull_.facet(next).height);
      if (goal_.passed(lower_, best_.height)) return End::Enough;
      if (goal_.hopeless(lower_, best_.height)) return End::TooCoarse;
      if (best_.height < -pair_.law_two) return End::Apart;
      if (narrow(lower_) && bounds_only) return End::Enough;
      if (narrow(lower_)) next = nearest_point().facet;
      const HullFacet& facet = hull_.sharpened(next);
      if (facet.above < kInfinity) {
        if (!goal_.narrow(lower_, facet.above)) return End::Stuck;
        best_ = {facet.above, facet.normal};
        return End::Enough;
      }
      const Corner from = first_corner(facet);
      if (steps_ >= goal_.step_budget) {
        if (best_.height == kInfinity) support(facet.normal, from.a, from.b);  // any plane bounds the depth
        return End::Budget;
      }
      if (hull_.corner_count() == ExactHull::kMostPoints) return End::Full;
      const Corner ahead = is_starts(facet) || !goal_.wants_facet() ? from : climb(facet.normal, from.a, from.b);
      if (leads_on(next, ahead)) {
        add(ahead, next);
        continue;
      }
      Corner top = support(facet.normal, ahead.a, ahead.b);
      bool sees = hull_.sees(next, top.p);
      const bool will_do = !exact_ && goal_.narrow(lower_, last_.height);
      if (!will_do && !sees && !goal_.narrow(lower_, last_.height)) {
        top = support_exactly(facet.normal, top.a, top.b);
        sees = hull_.sees(next, top.p);
      }
      if (sees && !will_do)
        add(top, next);
      else
        hull_.set_above(next, last_.height);
    }
  }

  /// Adds supports above the facet by which the ray along the plane's normal leaves the polytope, until M leaves by the same.
  /// An exact search takes the plane of that facet for `plane` if it is no higher, and goes on along its normal.
  End leave_along(Plane& plane) {
    for (int turns = 0;;) {
      const int lowest = hull_.lowest();
      const bool is_inside = hull_.facet(lowest).height > 0;
      const int next = is_inside ? left_by(plane.normal) : lowest;
      const HullFacet& facet = hull_.sharpened(next);
      if (facet.above == kInfinity) {
        if (steps_ >= goal_.step_budget) return End::Budget;
        if (hull_.corner_count() == ExactHull::kMostPoints) return End::Full;
        const Corner from = first_corner(facet);
        Corner top = climb(facet.normal, from.a, from.b);
        if (!hull_.sees(next, top.p)) top = support_exactly(facet.normal, top.a, top.b);
        if (hull_.sees(next, top.p))
          add(top, next);
        else
          hull_.set_above(next, last_.height);
        continue;
      }
      if (!is_inside || !exact_ || facet.above > plane.height || turns++ == kSlides) return End::Enough;
      plane = {facet.above, facet.normal};
    }
  }

  /// A proved lower bound on the heights of M, over all directions or the cone; 0 before one is proved.
  double lower() const { return lower_; }
  const Plane& best() const { return best_; }
  std::uint32_t steps() const { return steps_; }
  bool narrow(double lower) const { return goal_.narrow(lower, best_.height); }

  /// Writes to `depth` the witness points whose difference is the nearest point, their vertex pairs and weights.
  void witness(Depth& depth) {
    // Of several facets as low, points and plane must belong to one.
    const Vec at = best_.normal * best_.height;
    const NearestFacet nearest = nearest_point(at);
    write_points(hull_.facet(nearest.facet), nearest.foot.weight, depth);
  }
  /// The same of the points whose difference is where the ray along `n` leaves the polytope.
  void witness_along(const Vec& n, Depth& depth) const {
    const HullFacet& facet = hull_.facet(left_by(n));
    std::array<DoubleDouble, 3> weight = shares<DoubleDouble>(facet, n);
    const DoubleDouble zero(0);
    for (DoubleDouble& w : weight) w = w > zero ? w : zero;
    const DoubleDouble sum = weight[0] + weight[1] + weight[2];
    if (!(sum > zero)) return;
    for (DoubleDouble& w : weight) w = w / sum;
    write_points(facet, weight, depth);
  }

 private:
  struct VertexPair {
    std::uint32_t a, b;
  };
  struct NearestFacet {
    int facet;
    Foot foot;
  };

  /// A proved lower bound on the height of M if that of the hull's lowest facet is `height`.
  double below(double height) const { return height - (kPlaneHeightError * std::fabs(height) + moved_); }

  // ---- Points of M ----

  /// The nearest point whose coordinates are multiples of 2 u * `binade_`, rounded once.
  Vec on_grid(const Wide& p) const {
    const auto snapped = [this](const DoubleDouble& x) {
      const double anchor = std::copysign(binade_, rounded(x));
      return std::fabs(rounded(x)) < binade_ ? rounded(x + anchor) - anchor : rounded(x);
    };
    return {snapped(p.x), snapped(p.y), snapped(p.z)};
  }
  [[gnu::noinline]] Corner corner_of(std::uint32_t a, std::uint32_t b) const {
    return {on_grid(difference<DoubleDouble>(pair_, a, b).p), a, b};
  }
  Corner corner(std::uint8_t k) const { return {hull_.corner(k), vertex_pair_[k].a, vertex_pair_[k].b}; }
  /// True if a facet is part of the start's polygon, which is mostly a facet of M.
  bool is_starts(const HullFacet& f) const {
    return std::all_of(f.corner.begin(), f.corner.end(), [&](std::uint8_t k) { return of_start(k); });
  }
  bool of_start(std::uint8_t k) const { return k < 3 ? rim_ > 0 : k == 4 && rim_ == 4; }

  void take(const Plane& plane) {
    last_ = plane;
    if (last_.height < best_.height) best_ = last_;
  }
  /// The vertex pair highest along unit `n`, by hill climbing from the maps' vertices or from `a` and `b`, whichever are
  /// higher. Its plane becomes `last_`, and `best_` if it is lower.
  Corner support(const Vec& n, std::uint32_t a, std::uint32_t b) {
    ++steps_;
    const Supports s = supports(pair_, n, higher(level_a_, n, a), higher(level_b_, body_b(pair_).into(-n), b), plane_tests_);
    take({-s.lower, n});
    return corner_of(s.a, s.b);
  }
  /// As `support`, but climbs from `a` and `b` by exact comparisons and computes the height in 106 bits.
  Corner support_exactly(const Vec& n, std::uint32_t a, std::uint32_t b) {
    ++steps_;
    a = support_a(pair_, n, a, plane_tests_), b = support_b(pair_, n, b, plane_tests_);
    const double height = rounded(dot(wide(n), difference<DoubleDouble>(pair_, a, b).p));
    take({height + (kGapError * std::fabs(height) + kDoubleDoubleError * pair_.magnitude), n});
    return corner_of(a, b);
  }
  /// A vertex pair that is nearly the highest along `n`, by the support maps; without maps by hill climbing from `from`.
  Corner about_highest(const Vec& n, const Corner& from) {
    if (level_a_.map_side == 0 || level_b_.map_side == 0) return climb(n, from.a, from.b);
    return corner_of(look_up(level_a_, n).vertex, look_up(level_b_, body_b(pair_).into(-n)).vertex);
  }
  /// A vertex pair that looks the highest along `n`, by hill climbing in doubles. Proves nothing.
  Corner climb(const Vec& n, std::uint32_t a, std::uint32_t b) {
    ++steps_;
    const Vec own = body_b(pair_).into(-n);
    return corner_of(ascend(pair_.a, n, higher(level_a_, n, a), plane_tests_),
                     ascend(pair_.b, own, higher(level_b_, own, b), plane_tests_));
  }
  static std::uint32_t higher(const Level& level, const Vec& own, std::uint32_t other) {
    if (level.map_side == 0) return other;
    const std::uint32_t seen = look_up(level, own).vertex;
    return dot(own, vec(level.view.vertices[seen]) - vec(level.view.vertices[other])) > 0 ? seen : other;
  }

  // ---- Where to begin ----

  static bool on_line(const std::array<Corner, 9>& of) {
    const Vec n = exact::plane(of[0].p, of[1].p, of[2].p).normal;
    return dot(n, n) == 0;
  }
  bool find_triangle(const Vec& hint, std::array<Corner, 9>& found) {
    found[0] = support(hint, 0, 0);
    const Vec least = least_axis(hint), across = normalised(cross(hint, least));
    const auto is_other = [&](const Corner& c) { return max_abs(c.p - found[0].p) > 0; };
    const auto leaves_line = [&](const Corner& c) { return found[2] = c, !on_line(found); };
    if (!first_of({-hint, least, across}, found[0], found[1], is_other)) return false;
    const Vec u = normalised(found[1].p - found[0].p), v = normalised(cross(u, least_axis(u)));
    return first_of({v, cross(u, v)}, found[0], found[2], leaves_line);
  }
  /// Finds a point of M off the plane of three corners, along `direction` if there is one, else against it; false if M is flat.
  bool leave_plane(const Vec& direction, const std::array<Corner, 3>& of, Corner& apex) {
    const auto leaves = [&](const Corner& c) { return exact::orientation(of[0].p, of[1].p, of[2].p, c.p) != 0; };
    apex = about_highest(direction, of[0]);
    return leaves(apex) || first_of({direction}, of[0], apex, leaves);
  }
  /// Finds the first support along or against one of `directions` for which `serves` is true, in doubles, then exactly. Returns
  /// false if there is none: M is flat, and its exact heights are all that is known of it.
  template <class Serves>
  bool first_of(std::initializer_list<Vec> directions, const Corner& from, Corner& found, Serves serves) {
    for (const Vec& n : directions) {
      for (const Vec& side : {n, -n}) {
        if (found = support(side, from.a, from.b); serves(found)) return true;
      }
    }
    for (const Vec& n : directions) {
      for (const Vec& side : {n, -n}) {
        if (found = support_exactly(side, found.a, found.b); serves(found)) return true;
      }
    }
    return false;
  }
  void close(const std::array<Corner, 4>& corners) {
    hull_.begin({corners[0].p, corners[1].p, corners[2].p, corners[3].p});
    for (std::size_t k = 0; k < 4; ++k) vertex_pair_[k] = {corners[k].a, corners[k].b};
  }
  void include(const Corner& c) {
    if (const int facet = hull_.seen_from(c.p); facet >= 0) add(c, facet);
  }
  void add(const Corner& c, int facet) { vertex_pair_[std::size_t(hull_.add(c.p, facet))] = {c.a, c.b}; }

  // ---- The facets ----

  /// The barycentric coordinates, times a number, of the point in which the line along `n` passes a facet's plane.
  template <class Real>
  std::array<Real, 3> shares(const HullFacet& f, const Vec& n) const {
    const auto corner_at = [&](std::size_t k) { return widened<Real>(hull_.corner(f.corner[k])); };
    const V3<Real> a = corner_at(0), b = corner_at(1), c = corner_at(2), along = widened<Real>(n);
    return {dot(along, cross(b, c)), dot(along, cross(c, a)), dot(along, cross(a, b))};
  }
  /// The facet by which the ray along `n` leaves the polytope; what surrounds the origin has one.
  int left_by(const Vec& n) const {
    int best = 0;
    double most = -kInfinity;
    for (int k = 0; k < hull_.facet_count(); ++k) {
      if (hull_.is_gone(k)) continue;
      const auto [u, v, w] = shares<double>(hull_.facet(k), n);
      const double sum = u + v + w;
      if (!(sum > 0)) continue;
      if (const double least = min(u, min(v, w)) / sum; least > most) best = k, most = least;
    }
    return best;
  }
  /// Writes the points that are so many shares of a facet's vertex pairs.
  void write_points(const HullFacet& facet, const std::array<DoubleDouble, 3>& weights, Depth& depth) const {
    depth.active.count = 0;
    depth.point_a = depth.point_b = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = rounded(weights[k]);
      if (weight == 0) continue;
      const VertexPair of = vertex_pair_[facet.corner[k]];
      const auto slot = std::size_t(depth.active.count++);
      depth.active.a[slot] = of.a, depth.active.b[slot] = of.b, depth.active.weight[slot] = weight;
      depth.point_a = depth.point_a + body_a(pair_).point(of.a) * weight;
      depth.point_b = depth.point_b + body_b(pair_).point(of.b) * weight;
    }
  }

  /// The facets' point below the origin that is nearest to `to`: with 0, the point of the polytope's surface nearest to the
  /// origin. A facet higher than `best_` by over law 2's bound is skipped.
  NearestFacet nearest_point(const Vec& to = {0, 0, 0}) {
    const double most = best_.height + pair_.law_two;
    const auto off = [to = wide(to)](const Foot& at) { return dot(at.point - to, at.point - to); };
    const int lowest = hull_.lowest();
    NearestFacet best{lowest, foot_of(hull_.facet(lowest))};
    for (int k = 0; k < hull_.facet_count(); ++k) {
      if (k == lowest || hull_.facet(k).height > most) continue;
      const Foot at = foot_of(hull_.facet(k));
      if (off(at) < off(best.foot)) best = {k, at};
    }
    return best;
  }
  Foot foot_of(const HullFacet& f) const {
    return foot_on(wide(hull_.corner(f.corner[0])), wide(hull_.corner(f.corner[1])), wide(hull_.corner(f.corner[2])), f.height);
  }
  /// The facet's first corner that is a point of M.
  Corner first_corner(const HullFacet& f) const {
    return corner(*std::find_if_not(f.corner.begin(), f.corner.end(), [this](std::uint8_t k) { return hull_.is_ideal(k); }));
  }
  /// True if adding `c` makes the polytope grow above `facet`, and the supporting plane along its normal is not needed.
  bool leads_on(int facet, const Corner& c) const {
    const double height = dot(hull_.facet(facet).normal, c.p);
    return height > max(0, goal_.stop.below) && (exact_ || !goal_.narrow(lower_, height)) && hull_.sees(facet, c.p);
  }

  const PairView& pair_;
  const Level &level_a_, &level_b_;
  const DepthGoal& goal_;
  std::uint32_t& plane_tests_;
  const bool exact_;     ///< the facet itself is wanted: narrow bounds alone leave its plane room to lean
  const double binade_;  ///< the largest power of two that is at most the magnitude
  const double moved_;   ///< bound on what the grid and the rounding of planes add to the hull's heights
  double lower_ = 0;
  int rim_ = 0;  ///< number of corners of the start's polygon
  std::uint32_t steps_ = 0;
  Plane best_, last_;  ///< the lowest supporting plane found, and the last one
  ExactHull hull_;
  std::array<VertexPair, ExactHull::kMostPoints> vertex_pair_;
};

/// One of the cones that all directions are divided into: octants are divided into quarters, and these again, `depth` times.
/// `index` counts those of one depth in order, so that the quarters of a cone follow each other.
struct Cell {
  std::uint64_t index = 0;
  int depth = 0;

  Cone cone() const {
    const auto octant = index >> 2 * depth;
    const Vec x{octant & 1 ? -1.0 : 1.0, 0, 0}, y{0, octant & 2 ? -1.0 : 1.0, 0}, z{0, 0, octant & 4 ? -1.0 : 1.0};
    Cone c = x.x * y.y * z.z < 0 ? Cone{x, z, y} : Cone{x, y, z};
    for (int k = depth; k-- > 0;) {
      const Vec xy = (c.x + c.y) * 0.5, yz = (c.y + c.z) * 0.5, zx = (c.z + c.x) * 0.5;
      const auto quarter = index >> 2 * k & 3;
      c = quarter == 0   ? Cone{c.x, xy, zx}
          : quarter == 1 ? Cone{xy, c.y, yz}
          : quarter == 2 ? Cone{zx, yz, c.z}
                         : Cone{xy, yz, zx};
    }
    return c;
  }
  Cell first_quarter() const { return {4 * index, depth + 1}; }
  /// The cell after this one and its quarters; the ninth octant after the last.
  Cell next() const {
    Cell after{index + 1, depth};
    while (after.depth > 0 && after.index % 4 == 0) after = {after.index / 4, after.depth - 1};
    return after;
  }
  bool is_end() const { return depth == 0 && index == 8; }
};

/// Covers all directions: octant by octant, each that is full by its quarters, by at most so many `cones` in all. `lower`
/// becomes the lower bound, or 0 if the search ends early.
End cover(Polytope& polytope, int cones, double& lower) {
  End end = End::Enough;
  lower = kInfinity;
  cones -= 8;
  for (Cell cell; !cell.is_end();) {
    polytope.begin(cell.cone());
    const End of = polytope.grow(true);
    if (of == End::TooCoarse || of == End::Apart || of == End::Budget) return lower = 0, of;
    if (of == End::Full && cell.depth < kConeQuarters && cones >= 4) {
      cones -= 4;
      cell = cell.first_quarter();
      continue;
    }
    if (of != End::Enough) end = of;
    lower = min(lower, polytope.lower());
    cell = cell.next();
  }
  return end;
}

}  // namespace

Depth epa(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
          std::uint32_t& plane_tests) {
  Polytope polytope(pair, a, b, goal, plane_tests);
  Depth depth;
  const bool has_facets = polytope.begin(start);
  End end = has_facets ? polytope.grow() : End::Flat;
  depth.lower = max(0, polytope.lower());
  Plane best;
  if (end == End::Full) {
    const bool is_rough = goal.is_too_coarse(polytope.best().height);
    double lower = 0;
    end = cover(polytope, is_rough ? kRoughDepthCones : kDepthCones, lower);
    depth.lower = max(depth.lower, lower);
    best = polytope.best();
    // No polytope holds the place of the best plane: the last one is of some cone.
    DepthStart at;
    at.direction = best.normal;
    if (end != End::Apart && polytope.begin(at)) {
      if (const End left = polytope.leave_along(best); end == End::Enough) end = left;
      polytope.witness_along(best.normal, depth);
    }
  } else {
    best = polytope.best();
    if (has_facets) polytope.witness(depth);
  }
  if (end == End::Enough || (end == End::Flat && polytope.narrow(0))) depth.end = DepthEnd::Converged;
  if (end == End::Apart) depth.end = DepthEnd::Apart;
  if (end == End::Budget) depth.end = DepthEnd::Budget;
  depth.upper = end == End::Apart ? best.height : max(best.height, depth.lower);
  depth.normal = best.normal;
  depth.steps = polytope.steps();
  return depth;
}

}  // namespace swiftlet
