// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The expanding polytope [van den Bergen 2001], with a proof that needs no convexity: a closed surface of triangles between
// points of the Minkowski difference M winds once around a point c inside. Triangles are replaced by a cone of triangles to a
// new point only where a plane has c below it, and the triangle and the new point not, so that the tetrahedra between old and
// new surface miss c. Where at last all planes have c and the origin below them, the surface winds around the origin as well:
// every ray leaves through a triangle no nearer than the nearest plane, and M is convex. So the planes may be rounded as they
// like, and the polytope need not be convex.
#include "expand.h"

#include <algorithm>

#include "difference.h"
#include "support_map.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of the polytope; counter-clockwise from outside, no corner below the plane.
template <class Real>
struct Facet {
  V3<Real> normal;
  Real height;   ///< of the plane above the origin
  double above;  ///< proved: no point of M is higher; infinite until the support is found and is no way on
  std::array<std::uint8_t, 3> corner;
  std::array<std::uint16_t, 3> beside;  ///< the facet across the edge from each corner to the next
  bool open;                            ///< about to be replaced
  bool known;                           ///< of the start's polygon: mostly M's own
};

/// A cone of directions: the span of three corners of a cell of the octahedron, counter-clockwise from outside.
struct Cone {
  Vec x, y, z;
};

/// A supporting plane of M.
struct Plane {
  double height = kInfinity;  ///< proved: no point of M is higher
  Vec normal{0, 0, 0};
};

/// The point of a triangle nearest to the origin.
template <class Real>
struct Foot {
  std::array<Real, 3> weight;
  V3<Real> point;
};

/// Inside by areas over the normal, which slivers keep; else on the nearest edge.
template <class Real>
Foot<Real> foot(const V3<Real>& a, const V3<Real>& b, const V3<Real>& c) {
  const Real zero(0), one(1);
  const V3<Real> n = cross(b - a, c - a);
  const Real u = dot(n, cross(b, c)), v = dot(n, cross(c, a)), w = dot(n, cross(a, b));
  if (u > zero && v > zero && w > zero) {
    const Real sum = u + v + w, share_v = v / sum, share_w = w / sum;
    return {{one - share_v - share_w, share_v, share_w}, a + (b - a) * share_v + (c - a) * share_w};
  }
  Foot<Real> best{};
  const auto along = [&](std::size_t from, std::size_t to, const V3<Real>& p, const V3<Real>& q) {
    const V3<Real> e = q - p;
    const Real length2 = dot(e, e), rise = -dot(p, e);
    const Real t = !(rise > zero) ? zero : !(rise < length2) ? one : rise / length2;
    const V3<Real> point = t < one ? p + e * t : q;
    if (from > 0 && !(dot(point, point) < dot(best.point, best.point))) return;
    best = {{zero, zero, zero}, point};
    best.weight[from] = one - t, best.weight[to] = t;
  };
  along(0, 1, a, b), along(1, 2, b, c), along(2, 0, c, a);
  return best;
}

/// At length 1, but for a rounding of the length that a double shows.
template <class Real>
V3<Real> unit(const V3<Real>& v) {
  if constexpr (std::is_same_v<Real, double>) {
    return normalised(v);
  } else {
    const double length = norm(rounded(v));
    return length > kLeastDirection ? v * Real(1 / length) : V3<Real>{Real(0), Real(0), Real(0)};
  }
}

/// How an expansion ended.
enum class End : std::uint8_t {
  Enough,     ///< the goal is met
  TooCoarse,  ///< it cannot be, on these levels
  Apart,
  Budget,
  Full,   ///< no room for another point
  Stuck,  ///< this arithmetic cannot tell any more
};

/// What all polytopes of one question share.
struct Search {
  const Scene& scene;
  const Level &level_a, &level_b;
  const DepthGoal& goal;
  std::uint32_t& plane_tests;
  const bool exact;  ///< the facet itself is wanted: bounds that are narrow leave its plane room to lean
  std::uint32_t steps = 0;
  Plane best{};

  bool suffices(double upper, double lower) const { return goal.suffices(upper, lower, scene.law_two); }
  bool narrow(double lower) const { return suffices(best.height, lower); }
  bool passed(double lower) const { return goal.passed(best.height, lower); }
  bool hopeless(double lower) const { return goal.hopeless(best.height, lower); }
};

/// A polytope inside the Minkowski difference M, and what it proves.
template <class Real>
class Polytope {
  using Corner = Difference<Real>;

 public:
  explicit Polytope(Search& search)
      : search_(search), scene_(search.scene), resolution_(rounding<Real>(scene_) * (std::is_same_v<Real, double> ? 1 : 4)) {}

  /// Four points of M, the start's first; if need be nearer to one plane than doubles could tell. False where M has no room for
  /// them: planes were found that say so.
  bool begin(const DepthStart& start, bool crowned) {
    return begin(start, crowned, kRoom * scene_.point_error) ||
           (resolution_ < scene_.point_error && begin(start, crowned, kRoom * resolution_));
  }

  /// M and three points far away that no direction of the cone sees above the origin: over the cone its heights are those of M,
  /// elsewhere no less.
  bool begin(const Cone& cone) {
    clear();
    push(support(normalised(cone.x + cone.y + cone.z), 0, 0));
    for (const Vec& edge : {cross(cone.x, cone.y), cross(cone.y, cone.z), cross(cone.z, cone.x)}) {
      const int exponent = std::ilogb(scene_.magnitude) - std::ilogb(max_abs(edge)) + 1;
      const Vec far{std::ldexp(edge.x, exponent), std::ldexp(edge.y, exponent), std::ldexp(edge.z, exponent)};
      push({widened<Real>(-far), kNone, kNone});
    }
    return close();
  }

  /// Adds the support of the nearest facet until the goal is met and the plane is that of the nearest point: of several facets
  /// as near, points and plane are to be of one. With `bounds_only` it is any plane.
  End grow(bool bounds_only = false) {
    for (;;) {
      std::size_t next = nearest_facet();
      lower_ = below(rounded(facet_[next].height));
      if (search_.passed(lower_)) return End::Enough;
      if (search_.hopeless(lower_)) return End::TooCoarse;
      if (search_.best.height < -scene_.law_two) return End::Apart;
      if (search_.narrow(lower_) && bounds_only) return End::Enough;
      if (search_.narrow(lower_)) next = nearest_point().facet;
      if (facet_[next].above < kInfinity) {
        if (!search_.suffices(facet_[next].above, lower_)) return End::Stuck;
        search_.best = {facet_[next].above, rounded(facet_[next].normal)};
        return End::Enough;
      }
      if (search_.steps >= search_.goal.step_budget) return End::Budget;
      if (corner_count_ == kDepthPoints) return End::Full;
      const Corner ahead = facet_[next].known || search_.goal.error > 0 ? nearest_corner(facet_[next]) : look_out(facet_[next]);
      if (leads_on(facet_[next], ahead) && add(ahead, next)) continue;
      const Corner top = support(rounded(facet_[next].normal), ahead.a, ahead.b);
      const bool will_do = !search_.exact && search_.suffices(last_.height, lower_);
      if (will_do || !sees(facet_[next], top) || known(top)) {
        facet_[next].above = last_.height;
        continue;
      }
      if (!add(top, next)) return End::Stuck;
    }
  }

  /// Proved of the heights of M, over all directions or the cone; 0 before anything is.
  double lower() const { return lower_; }

  /// The points that the nearest point is the difference of. Whether it lies along the plane's normal.
  bool witness(Depth& depth) const {
    if (facet_count_ == 0) return false;
    const Nearest nearest = nearest_point();
    if (is_far(facet_[nearest.facet])) return false;
    depth.active.count = 0;
    depth.point_a = depth.point_b = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = rounded(nearest.foot.weight[k]);
      if (weight == 0) continue;
      const Corner& c = corner(facet_[nearest.facet], k);
      const auto slot = std::size_t(depth.active.count++);
      depth.active.a[slot] = c.a, depth.active.b[slot] = c.b, depth.active.weight[slot] = weight;
      depth.point_a = depth.point_a + body_a(scene_).point(c.a) * weight;
      depth.point_b = depth.point_b + body_b(scene_).point(c.b) * weight;
    }
    return norm(rounded(nearest.foot.point) - search_.best.normal * search_.best.height) <= scene_.law_two;
  }

 private:
  static constexpr int kDepthFacets = 4 * kDepthPoints;  // a sphere of n points has 2 n - 4: both what goes and what comes
  static constexpr std::uint16_t kNobody = 0xffff;

  void clear() {
    corner_count_ = facet_count_ = free_count_ = 0;
    lower_ = 0;
  }
  void push(const Corner& c) { corner_[std::size_t(corner_count_++)] = c; }
  const Corner& corner(const Facet<Real>& f, std::size_t k) const { return corner_[f.corner[k]]; }
  bool is_far(const Facet<Real>& f) const {
    return corner(f, 0).a == kNone || corner(f, 1).a == kNone || corner(f, 2).a == kNone;
  }
  bool known(const Corner& c) const {
    return std::any_of(corner_.begin(), corner_.begin() + corner_count_, [&](const Corner& k) { return same(k, c); });
  }

  /// A proved lower bound of a height that this arithmetic computed.
  double below(double height) const {
    if constexpr (std::is_same_v<Real, double>) return height - scene_.point_error;
    return height - (kGapError * std::fabs(height) + kDoubleDoubleError * scene_.magnitude);
  }

  /// A vertex pair highest along unit n, climbed to from what a map says or the vertices given; the plane there is kept if it
  /// is the best.
  Corner support(const Vec& n, std::uint32_t a, std::uint32_t b) {
    ++search_.steps;
    a = higher(search_.level_a, n, a);
    b = higher(search_.level_b, body_b(scene_).into(-n), b);
    Corner top;
    if constexpr (std::is_same_v<Real, double>) {
      const Supports s = supports(scene_, n, a, b, search_.plane_tests);
      top = difference<Real>(scene_, s.a, s.b);
      last_ = {-s.lower, n};
    } else {
      top =
          difference<Real>(scene_, support_a(scene_, n, a, search_.plane_tests), support_b(scene_, n, b, search_.plane_tests));
      const double height = rounded(dot(widened<Real>(n), top.p));
      last_ = {height + (kGapError * std::fabs(height) + kDoubleDoubleError * scene_.magnitude), n};
    }
    if (last_.height < search_.best.height) search_.best = last_;
    return top;
  }
  /// A vertex pair about as high, as maps know it; without maps by a climb from another.
  Corner glance(const Vec& n, const Corner& from) {
    if (search_.level_a.map_side == 0 || search_.level_b.map_side == 0) return climb(n, from.a, from.b);
    return difference<Real>(scene_, look_up(search_.level_a, n).vertex,
                            look_up(search_.level_b, body_b(scene_).into(-n)).vertex);
  }
  /// A vertex pair about as high above a facet as there is one, which proves nothing.
  Corner look_out(const Facet<Real>& f) {
    const Corner near = nearest_corner(f);
    return climb(rounded(f.normal), near.a, near.b);
  }
  /// One of a facet's that is no far point, or else any of M.
  Corner nearest_corner(const Facet<Real>& f) const {
    for (const std::size_t k : {0, 1, 2}) {
      if (corner(f, k).a != kNone) return corner(f, k);
    }
    return corner_[0];
  }
  Corner climb(const Vec& n, std::uint32_t a, std::uint32_t b) {
    ++search_.steps;
    const Vec own = body_b(scene_).into(-n);
    return difference<Real>(scene_, ascend(scene_.a, n, higher(search_.level_a, n, a), search_.plane_tests),
                            ascend(scene_.b, own, higher(search_.level_b, own, b), search_.plane_tests));
  }
  /// Whether a corner is a way on, and no plane through it is wanted for its own sake.
  bool leads_on(const Facet<Real>& f, const Corner& c) const {
    const double height = rounded(dot(f.normal, c.p));
    return sees(f, c) && !known(c) && height > larger(0, search_.goal.shallower) &&
           (search_.exact || !search_.suffices(height, lower_));
  }
  static std::uint32_t higher(const Level& level, const Vec& own, std::uint32_t other) {
    if (level.map_side == 0) return other;
    const std::uint32_t seen = look_up(level, own).vertex;
    return dot(own, vec(level.view.vertices[seen]) - vec(level.view.vertices[other])) > 0 ? seen : other;
  }
  V3<Real> across(int i, int j, int k) const {
    const V3<Real>& p = corner_[std::size_t(i)].p;
    return unit(cross(corner_[std::size_t(j)].p - p, corner_[std::size_t(k)].p - p));
  }
  /// With each point farther than `room` off the others.
  bool begin(const DepthStart& start, bool crowned, double room) {
    clear();
    const Vec hint = normalised(dot(start.direction, start.direction) > 0 ? start.direction : Vec{1, 0, 0});
    push_all(start);
    if (!span_triangle(room) && !find_triangle(hint, room)) return false;
    const int rim = corner_count_;
    Vec n;
    if (!orient(hint, n)) return false;
    if (crowned && crown(n, rim, room)) return true;
    const bool has_fourth = rim == 4;
    const Corner fourth = corner_[3];
    corner_count_ = 3, facet_count_ = 0;
    if (!leave_plane(-n, room) || !close()) return false;
    const std::size_t below = has_fourth ? seeing(fourth) : kNobody;
    return below == kNobody || add(fourth, below);
  }
  void push_all(const DepthStart& start) {
    for (int k = 0; k < start.count; ++k) push(difference<Real>(scene_, start.a[std::size_t(k)], start.b[std::size_t(k)]));
  }
  /// Puts the corners in the order in which they go around a normal on the side of `hint`.
  bool orient(const Vec& hint, Vec& n) {
    n = rounded(across(0, 1, 2));
    if (dot(n, hint) < 0) std::reverse(corner_.begin() + 1, corner_.begin() + corner_count_), n = -n;
    return dot(n, n) > 0;
  }
  /// One beyond each side of the polygon.
  void push_ring(const Vec& n, int rim) {
    for (int i = 0; i < rim; ++i) {
      const Vec side = rounded(corner_[std::size_t((i + 1) % rim)].p - corner_[std::size_t(i)].p);
      push(glance(n * norm(side) + cross(side, n) * kFlare, corner_[std::size_t(i)]));
    }
  }
  double outward_error(const V3<Real>& u, const V3<Real>& v) const {
    return kOutwardError * scene_.magnitude * std::sqrt(rounded(dot(u, u)) * rounded(dot(v, v)));
  }
  /// Below a polygon at the top, along n, of M: a ring of points, one beyond each side, and one at the bottom. What proves a
  /// depth is often no more. False if that folds.
  bool crown(const Vec& n, int rim, double room) {
    push_ring(n, rim);
    if (!leave_plane(-n, room)) return false;
    inside_ = (corner_[0].p + corner_[1].p + corner_[2].p + corner_[std::size_t(2 * rim)].p) * Real(0.25);
    std::array<int, 9> at;
    for (int i = 0; i <= 2 * rim; ++i) {
      at[std::size_t(i)] = 0;
      while (!same(corner_[std::size_t(at[std::size_t(i)])], corner_[std::size_t(i)])) ++at[std::size_t(i)];
    }
    const auto facet = [&](int i, int j, int k) {
      i = at[std::size_t(i)], j = at[std::size_t(j)], k = at[std::size_t(k)];
      return i == j || j == k || k == i || (outward(i, j, k) && face(i, j, k));
    };
    for (int i = 2; i < rim; ++i) {
      if (!facet(0, i - 1, i)) return false;
    }
    const int tops = facet_count_;
    for (int i = 0, last = rim - 1; i < rim; last = i++) {
      if (!facet((i + 1) % rim, i, rim + i) || !facet(rim + i, i, rim + last) || !facet(rim + i, rim + last, 2 * rim))
        return false;
    }
    for (int k = 0; k < tops; ++k) facet_[std::size_t(k)].known = true;
    return link();
  }
  /// Whether the inside surely is behind a triangle.
  bool outward(int i, int j, int k) const {
    const V3<Real>& p = corner_[std::size_t(i)].p;
    const V3<Real> u = corner_[std::size_t(j)].p - p, v = corner_[std::size_t(k)].p - p;
    return rounded(dot(cross(u, v), p - inside_)) > outward_error(u, v);
  }
  /// Whether the first three points are there and on no line.
  bool span_triangle(double room) const {
    if (corner_count_ < 3) return false;
    const Vec u = rounded(corner_[1].p - corner_[0].p), v = rounded(corner_[2].p - corner_[0].p);
    return norm(cross(u, v)) > room * larger(norm(u), norm(v));
  }
  bool find_triangle(const Vec& hint, double room) {
    corner_count_ = 0;
    push(support(hint, 0, 0));
    if (!leave_plane(-hint, room)) return false;
    const Vec u = normalised(rounded(corner_[1].p - corner_[0].p)), v = normalised(cross(u, least_axis(u)));
    return (leave_plane(v, room) || leave_plane(cross(u, v), room)) && span_triangle(room);
  }
  /// Pushes a point of M off the plane through the first one, on the side of `direction` or else the other.
  bool leave_plane(const Vec& direction, double room) {
    const auto leaves = [&](const Corner& top) {
      return std::fabs(rounded(dot(widened<Real>(direction), top.p - corner_[0].p))) > room && (push(top), true);
    };
    return leaves(glance(direction, corner_[0])) || leaves(support(direction, corner_[0].a, corner_[0].b)) ||
           leaves(support(-direction, corner_[0].a, corner_[0].b));
  }

  /// The tetrahedron of the first four points.
  bool close() {
    inside_ = (corner_[0].p + corner_[1].p + corner_[2].p + corner_[3].p) * Real(0.25);
    if (dot(across(0, 1, 2), corner_[3].p - corner_[0].p) > Real(0)) std::swap(corner_[1], corner_[2]);
    return face(0, 1, 2) && face(0, 2, 3) && face(0, 3, 1) && face(1, 3, 2) && link();
  }
  /// Finds who is beside whom, of few corners. False where that is not one other facet for each edge.
  bool link() {
    std::array<std::uint16_t, 81> at;
    at.fill(kNobody);
    const auto edge = [](const Facet<Real>& f, std::size_t from, std::size_t to) {
      return std::size_t(9 * f.corner[from] + f.corner[to]);
    };
    for (int k = 0; k < facet_count_; ++k) {
      for (const std::size_t e : {0, 1, 2}) {
        std::uint16_t& of = at[edge(facet_[std::size_t(k)], e, (e + 1) % 3)];
        if (of != kNobody) return false;
        of = std::uint16_t(k);
      }
    }
    for (int k = 0; k < facet_count_; ++k) {
      Facet<Real>& f = facet_[std::size_t(k)];
      for (const std::size_t e : {0, 1, 2}) {
        if ((f.beside[e] = at[edge(f, (e + 1) % 3, e)]) == kNobody) return false;
      }
    }
    return true;
  }

  bool face(int i, int j, int k) {
    Facet<Real>& f = facet_[std::size_t(facet_count_)];
    f.corner = {std::uint8_t(i), std::uint8_t(j), std::uint8_t(k)};
    return stand(f) && ++facet_count_ > 0;
  }
  /// Gives a facet the best plane of two: across the triangle, or, where that is uncertain, from the origin to its longest
  /// edge. False if neither has the inside below it.
  bool stand(Facet<Real>& f) const {
    f.height = Real(-kInfinity), f.above = kInfinity;
    f.open = f.known = false;
    const V3<Real>& p = corner(f, 0).p;
    if (!offer(f, unit(cross(corner(f, 1).p - p, corner(f, 2).p - p)))) {
      const V3<Real> e[3] = {corner(f, 1).p - corner(f, 0).p, corner(f, 2).p - corner(f, 1).p, corner(f, 0).p - corner(f, 2).p};
      std::size_t longest = 0;
      for (const std::size_t m : {1, 2}) longest = dot(e[m], e[m]) > dot(e[longest], e[longest]) ? m : longest;
      const V3<Real>&u = e[longest], &q = corner(f, longest).p;
      offer(f, unit(q * dot(u, u) - u * dot(q, u)));
    }
    return f.height > Real(-kInfinity);
  }
  /// Takes unit n if it makes the plane higher and has the inside below; whether all corners lie on that plane, well within law
  /// 2's bound: then no other is wanted, for a plane that leans is no way on.
  bool offer(Facet<Real>& f, const V3<Real>& n) const {
    const Real h[3] = {dot(n, corner(f, 0).p), dot(n, corner(f, 1).p), dot(n, corner(f, 2).p)};
    const Real &low = h[0] < h[1] ? h[0] : h[1], &high = h[0] < h[1] ? h[1] : h[0];
    const Real &least = h[2] < low ? h[2] : low, &most = h[2] > high ? h[2] : high;
    if (!(dot(n, inside_) + Real(2 * resolution_) < least)) return false;  // nor if n is 0
    if (least > f.height) f.normal = n, f.height = least;
    return !(most > least + Real(scene_.law_two / 8));
  }

  std::size_t nearest_facet() const {
    int nearest = 0;
    for (int k = 1; k < facet_count_; ++k) {
      if (facet_[std::size_t(k)].height < facet_[std::size_t(nearest)].height) nearest = k;
    }
    return std::size_t(nearest);
  }
  struct Nearest {
    std::size_t facet = 0;
    Foot<Real> foot{};
  };
  /// The point of the surface nearest to the origin: none of a facet higher than the best plane is.
  Nearest nearest_point() const {
    Nearest best{nearest_facet(), {}};
    best.foot = foot_of(facet_[best.facet]);
    for (std::size_t k = 0; int(k) < facet_count_; ++k) {
      if (k == best.facet || rounded(facet_[k].height) > search_.best.height + scene_.law_two) continue;
      const Foot<Real> at = foot_of(facet_[k]);
      if (dot(at.point, at.point) < dot(best.foot.point, best.foot.point)) best = {k, at};
    }
    return best;
  }
  Foot<Real> foot_of(const Facet<Real>& f) const { return foot(corner(f, 0).p, corner(f, 1).p, corner(f, 2).p); }
  bool sees(const Facet<Real>& f, const Corner& c) const { return dot(f.normal, c.p) > f.height + Real(resolution_); }
  std::size_t seeing(const Corner& c) const {
    for (std::size_t k = 0; int(k) < facet_count_; ++k) {
      if (sees(facet_[k], c)) return k;
    }
    return kNobody;
  }

  /// Facets about to go.
  struct Hole {
    int count = 0;
    std::array<std::uint16_t, kDepthFacets> facet;
  };
  void open(Hole& hole, std::uint16_t k) {
    facet_[k].open = true;
    hole.facet[std::size_t(hole.count++)] = k;
  }
  /// Replaces facet `from` and those around it that see `top` above them by a cone to it. False, and as before, where the
  /// cone would fold back for more than rounding.
  bool add(const Corner& top, std::size_t from) {
    Hole hole;
    open(hole, std::uint16_t(from));
    for (int i = 0; i < hole.count; ++i) {
      for (const std::uint16_t g : facet_[hole.facet[std::size_t(i)]].beside) {
        if (!facet_[g].open && sees(facet_[g], top)) open(hole, g);
      }
    }
    push(top);
    int fresh = cone(hole);
    while (fresh < 0 && widen(hole, std::uint16_t(-1 - fresh))) fresh = cone(hole);
    if (fresh < 0 || !join(fresh)) {
      --corner_count_;
      for (int i = 0; i < hole.count; ++i) facet_[hole.facet[std::size_t(i)]].open = false;
      return false;
    }
    facet_count_ += std::max(0, fresh - free_count_);
    free_count_ = std::max(0, free_count_ - fresh);
    for (int i = 0; i < hole.count; ++i) {
      const std::uint16_t k = hole.facet[std::size_t(i)];
      facet_[k].height = Real(kInfinity);
      free_[std::size_t(free_count_++)] = k;
    }
    return true;
  }
  /// Where the next facet but k is put.
  std::uint16_t room_for(int k) const {
    return k < free_count_ ? free_[std::size_t(free_count_ - 1 - k)] : std::uint16_t(facet_count_ + k - free_count_);
  }
  /// Facets from the border of a hole to the last corner, and how many; -1 - k where that over the edge to facet k would fold.
  int cone(const Hole& hole) {
    int fresh = 0;
    for (int i = 0; i < hole.count; ++i) {
      const Facet<Real>& f = facet_[hole.facet[std::size_t(i)]];
      for (std::size_t e = 0; e < 3; ++e) {
        if (facet_[f.beside[e]].open) continue;
        Facet<Real>& side = facet_[room_for(fresh)];
        side.corner = {f.corner[e], f.corner[(e + 1) % 3], std::uint8_t(corner_count_ - 1)};
        side.beside = {f.beside[e], kNobody, kNobody};
        if (!stand(side)) return -1 - int(f.beside[e]);
        ++fresh;
      }
    }
    return fresh;
  }
  /// Takes out a facet over whose edge the cone would fold. Only rounding hid the new corner from it, or a fold of the surface:
  /// any may go that has the inside below itself and that corner.
  bool widen(Hole& hole, std::uint16_t k) {
    const Facet<Real>& f = facet_[k];
    if (!(dot(f.normal, inside_) + Real(2 * resolution_) < dot(f.normal, corner_[std::size_t(corner_count_ - 1)].p)))
      return false;
    return open(hole, k), true;
  }
  /// Tells the facets of a cone and those around it of each other. False where its border passes a corner twice.
  bool join(int fresh) {
    const auto top = std::uint8_t(corner_count_ - 1);
    for (int k = 0; k < fresh; ++k) starting_[facet_[room_for(k)].corner[0]] = room_for(k);
    for (int k = 0; k < fresh; ++k) {
      Facet<Real>& f = facet_[room_for(k)];
      f.beside[1] = starting_[f.corner[1]];
      Facet<Real>& next = facet_[f.beside[1]];
      if (next.corner[0] != f.corner[1] || next.corner[2] != top || next.beside[2] != kNobody) return false;
      next.beside[2] = room_for(k);
    }
    for (int k = 0; k < fresh; ++k) {
      const Facet<Real>& f = facet_[room_for(k)];
      Facet<Real>& outer = facet_[f.beside[0]];
      for (std::size_t e = 0; e < 3; ++e) {
        if (outer.corner[e] == f.corner[1] && outer.corner[(e + 1) % 3] == f.corner[0]) outer.beside[e] = room_for(k);
      }
    }
    return true;
  }

  Search& search_;
  const Scene& scene_;
  const double resolution_;  ///< what heights are uncertain of
  V3<Real> inside_{};
  int corner_count_ = 0, facet_count_ = 0;
  double lower_ = 0;
  Plane last_;  ///< of the last support
  std::array<Corner, kDepthPoints> corner_;
  std::array<Facet<Real>, kDepthFacets> facet_;
  int free_count_ = 0;
  std::array<std::uint16_t, kDepthFacets> free_;        ///< places of facets that are gone
  std::array<std::uint16_t, kDepthPoints> starting_{};  ///< of the cone that was joined last, by a facet's first corner
};

/// A cone in four.
std::array<Cone, 4> quarters(const Cone& c) {
  const Vec xy = (c.x + c.y) * 0.5, yz = (c.y + c.z) * 0.5, zx = (c.z + c.x) * 0.5;
  return {{{c.x, xy, zx}, {xy, c.y, yz}, {zx, yz, c.z}, {xy, yz, zx}}};
}

bool ends_all(End end) { return end == End::TooCoarse || end == End::Apart || end == End::Budget; }

/// Bounds the heights over a cone from below, by a polytope of its own or of each of its parts.
template <class Real>
End cover(Polytope<Real>& polytope, const Cone& cone, int depth, double& lower) {
  End end = polytope.begin(cone) ? polytope.grow(true) : End::Stuck;
  if (end == End::Full && depth < kDepthCells) {
    end = End::Enough;
    for (const Cone& quarter : quarters(cone)) {
      if (const End of = cover(polytope, quarter, depth + 1, lower); of != End::Enough) end = of;
      if (ends_all(end)) return end;
    }
    return end;
  }
  lower = smaller(lower, polytope.lower());
  return end;
}

/// All directions, one octant after the other.
template <class Real>
End cover_all(Polytope<Real>& polytope, double& lower) {
  End end = End::Enough;
  lower = kInfinity;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec x{octant & 1 ? -1.0 : 1.0, 0, 0}, y{0, octant & 2 ? -1.0 : 1.0, 0}, z{0, 0, octant & 4 ? -1.0 : 1.0};
    const bool odd = x.x * y.y * z.z < 0;
    if (const End of = cover(polytope, odd ? Cone{x, z, y} : Cone{x, y, z}, 0, lower); of != End::Enough) end = of;
    if (ends_all(end)) return lower = 0, end;
  }
  return end;
}

/// A narrow cone about a direction.
Cone about(const Vec& n) {
  const Vec u = normalised(cross(n, least_axis(n))), v = cross(n, u);
  return {n + u * kNarrowCone, n + (v * kSqrt3 - u) * (kNarrowCone / 2), n - (v * kSqrt3 + u) * (kNarrowCone / 2)};
}

/// One arithmetic's turn; whether the goal is met or no other arithmetic would help.
template <class Real>
bool settle(Search& search, const DepthStart& start, Depth& depth) {
  Polytope<Real> polytope(search);
  End end = End::Stuck;
  for (const bool crowned : {true, false}) {
    if (end == End::Stuck) end = polytope.begin(start, crowned) ? polytope.grow() : End::Stuck;
  }
  double lower = polytope.lower();
  if (end == End::Full) {
    end = cover_all(polytope, lower);
    if (polytope.begin(about(search.best.normal))) polytope.grow();  // its facet again, for the points
  }
  depth.lower = larger(depth.lower, lower);
  const bool straight = polytope.witness(depth) || !search.exact;
  const bool flat = search.narrow(0);
  if (end == End::Enough || (end == End::Stuck && flat)) depth.end = DepthEnd::Converged;
  if (end == End::Apart) depth.end = DepthEnd::Apart;
  if (end == End::Budget) depth.end = DepthEnd::Budget;
  return (depth.end != DepthEnd::NotConverged && (straight || flat)) || end == End::TooCoarse;
}

}  // namespace

Depth expand(const Scene& scene, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
             std::uint32_t& plane_tests) {
  const bool exact = goal.absolute == 0 && goal.relative == 0 && goal.deeper == kInfinity;
  Search search{scene, a, b, goal, plane_tests, exact};
  Depth depth;
  if (!settle<double>(search, start, depth)) settle<DoubleDouble>(search, start, depth);
  depth.upper = larger(search.best.height, depth.lower);
  depth.normal = search.best.normal;
  depth.steps = search.steps;
  return depth;
}

}  // namespace swiftlet
