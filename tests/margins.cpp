// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "margins.h"

#include <algorithm>
#include <cmath>

#include <CGAL/Gmpzf.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "body/ellipsoid.h"
#include "body/support_map.h"
#include "pair/pair_view.h"
#include "pair/witness.h"

namespace swiftlet::margins {
namespace {

using shapes::Random;

// ---- Exact numbers ---------------------------------------------------------------------------------------------------------

using Dyadic = CGAL::Gmpzf;  // nothing is divided

struct Exact3 {
  Dyadic x, y, z;
};
Exact3 exact(const Vec& v) { return {Dyadic(v.x), Dyadic(v.y), Dyadic(v.z)}; }
Exact3 operator+(const Exact3& a, const Exact3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Exact3 operator-(const Exact3& a, const Exact3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Exact3 operator*(const Exact3& a, const Dyadic& s) { return {a.x * s, a.y * s, a.z * s}; }
Dyadic inner(const Exact3& a, const Exact3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Exact3 outer(const Exact3& a, const Exact3& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double rounded(const Dyadic& x) { return CGAL::to_double(x); }
double length(const Exact3& v) { return std::sqrt(rounded(inner(v, v))); }

struct Matrix {
  Exact3 x, y, z;  // rows
};
Matrix exact(const Motion& m) { return {exact(m.row_x), exact(m.row_y), exact(m.row_z)}; }
Exact3 operator*(const Matrix& m, const Exact3& v) { return {inner(m.x, v), inner(m.y, v), inner(m.z, v)}; }
Matrix cofactors(const Matrix& m) { return {outer(m.y, m.z), outer(m.z, m.x), outer(m.x, m.y)}; }
Matrix transposed(const Matrix& m) { return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}}; }

// ---- Scenes ----------------------------------------------------------------------------------------------------------------

Vec row(const Scene& s, int i) { return {s[std::size_t(3 * i)], s[std::size_t(3 * i + 1)], s[std::size_t(3 * i + 2)]}; }
Vec p(const Scene& s, int i) { return row(s, 4 + i); }
Motion pose(const Scene& s) { return {row(s, 0), row(s, 1), row(s, 2), row(s, 3)}; }
void put(Scene& s, int i, const Vec& v) {
  s[std::size_t(12 + 3 * i)] = v.x, s[std::size_t(13 + 3 * i)] = v.y, s[std::size_t(14 + 3 * i)] = v.z;
}

double sine_of_dot(const Vec& a, const Vec& b) {
  const Exact3 x = exact(a), y = exact(b);
  return std::fabs(rounded(inner(x, y))) / (length(x) * length(y));
}

/// The bodies as the walk reads them, with nothing in their views.
const ConvexView kEmpty{};
template <class Body>
Body body(const Motion& m) {
  if constexpr (std::is_same_v<Body, Moved>)
    return {kEmpty, 0, m};
  else
    return {kEmpty, 0};
}
template <class Body>
Exact3 image(const Scene& s, const Exact3& v) {
  if constexpr (std::is_same_v<Body, Moved>)
    return exact(pose(s)) * v;
  else
    return v;
}

// ---- Random numbers --------------------------------------------------------------------------------------------------------

double sign(Random& random) { return random.bits() & 1 ? -1 : 1; }
/// 1 plus up to 2^27 ulps: products of such numbers have any low bits, and errors of nearly half an ulp of 1.
double near_one(Random& random) { return 1 + double(random.bits() >> (37 + random.bits() % 26)) * 0x1p-52; }
double tiny(Random& random) { return sign(random) * std::exp2(random.uniform(-56, -20)); }

// ---- Kinds -----------------------------------------------------------------------------------------------------------------

/// p0 a direction, p1 and p2 vertices.
template <class Body>
double scan_error(const Scene& s) {
  const Motion m = pose(s);
  const Vec d = p(s, 0), v = p(s, 1), w = p(s, 2), own = body<Body>(m).into(d);
  const double rise = dot(own, w) - dot(own, v), extent = max(max_abs(v), max_abs(w));
  const Dyadic truth = inner(exact(d), image<Body>(s, exact(w) - exact(v)));
  return std::fabs(rounded(Dyadic(rise) - truth)) / (extent * norm_1(d)) / kU;
}
template <class Body>
double beside_error(const Scene& s) {
  const Motion m = pose(s);
  const Vec d = p(s, 0), v = p(s, 1), w = p(s, 2);
  const double rise = dot(body<Body>(m).into(d), w - v);
  const Exact3 way = exact(w) - exact(v);
  return std::fabs(rounded(Dyadic(rise) - inner(exact(d), image<Body>(s, way)))) / (length(way) * norm_1(d)) / kU;
}
/// Puts the vertices at one height in half of the scenes, up to rounding.
void level_vertices(Random& random, Scene& s) {
  if (random.uniform() < 0.5) return;
  const Vec own = rotate_back(pose(s), p(s, 0)), way = p(s, 2) - p(s, 1);
  put(s, 2, p(s, 1) + across(way, own, dot(own, own)));
}

/// Puts the vertices at opposite corners of a cube, and one row of R along its diagonal and d along that row's axis: every term
/// is then as large as it can be. In the other half of the scenes as above.
void opposite_vertices(Random& random, Scene& s) {
  if (random.bits() & 1) return level_vertices(random, s);
  const double a = std::sqrt(1. / 2), b = std::sqrt(1. / 3), c = std::sqrt(1. / 6), scale = max_abs(p(s, 1));
  const Scene turn{b, b, b, a, -a, 0, c, c, -2 * c};
  for (std::size_t i = 0; i < 9; ++i) s[i] = turn[i] + random.uniform(-0x1p-24, 0x1p-24);
  put(s, 0, {near_one(random), tiny(random), tiny(random)});
  for (const int i : {1, 2}) put(s, i, Vec{near_one(random), near_one(random), near_one(random)} * (i == 1 ? scale : -scale));
}

/// p0 and p1 vertices.
template <class Body>
double way_error(const Scene& s) {
  const Motion m = pose(s);
  const Exact3 truth = image<Body>(s, exact(p(s, 1)) - exact(p(s, 0)));
  return length(exact(body<Body>(m).rotated(p(s, 1) - p(s, 0))) - truth) / length(truth) / kU;
}

/// p0 a point, p1 and p2 the ends of an edge, all in the common frame: as in `vertex_edge`.
double across_error(const Scene& s) {
  const Vec u = p(s, 2) - p(s, 1), r = p(s, 0) - p(s, 1);
  const double uu = dot(u, u), ru = dot(r, u), extent = max(max_abs(p(s, 0)), max(max_abs(p(s, 1)), max_abs(p(s, 2))));
  if (!(ru > 0 && ru < uu)) return -1;
  const Vec up = across(r, u, uu);
  return norm(up) > kLawTwo * extent ? sine_of_dot(up, u) / kU : -1;
}

/// The ends are opposite corners of the cube of the extent in half of the scenes: the longest edge.
void longest_edge(Random& random, Scene& s, int tail, int head) {
  if (random.bits() & 1) return;
  const Vec one = p(s, tail);
  const double x = max_abs(one);
  const auto corner = [&](double to) {
    return Vec{std::copysign(x, one.x) * to * near_one(random), std::copysign(x, one.y) * to * near_one(random),
               std::copysign(x, one.z) * to * near_one(random)};
  };
  put(s, tail, corner(1)), put(s, head, corner(-1));
}
/// A fraction of an edge, in half of the calls near the ends or the middle.
double fraction(Random& random) {
  const double x = random.uniform();
  switch (random.bits() % 4) {
    case 0: return 0.5 + (x - 0.5) * 1e-9;
    case 1: return random.bits() & 1 ? 1 - 1e-9 * x : 1e-9 * x;
    default: return x;
  }
}
/// The point is as near to the edge as certificates go, or up to 2^30 times as far.
void near_edge(Random& random, Scene& s) {
  longest_edge(random, s, 1, 2);
  const Vec a = p(s, 1), b = p(s, 2), way = b - a, aside = across(p(s, 0), way, dot(way, way));
  const double extent = max(max_abs(a), max_abs(b)),
               height = (64 + 20 * random.uniform()) * kU * std::exp2(random.uniform() < 0.8 ? 0 : random.uniform(0, 30));
  put(s, 0, a + way * fraction(random) + aside * (height * extent / norm(aside)));
}

/// p0, p1 and p2, p3 the ends of two edges, parallel within rounding: as in `edge_edge`.
template <bool of_v>
double parallel_error(const Scene& s) {
  const Vec u = p(s, 1) - p(s, 0), v = p(s, 3) - p(s, 2);
  const double uu = dot(u, u), vv = dot(v, v);
  const Parameters at = nearest_on_segments(p(s, 0), u, uu, p(s, 2), v, vv);
  if (!(at.s > 0 && at.s < 1 && at.t > 0 && at.t < 1)) return -1;
  const Vec d = p(s, 2) + v * at.t - (p(s, 0) + u * at.s), n = cross(u, v);
  double extent = 0;
  for (int i = 0; i < 4; ++i) extent = max(extent, max_abs(p(s, i)));
  if (dot(n, n) > kU * uu * vv || !(norm(d) > kLawTwo * extent)) return -1;
  const BetweenEdges between = between_edges(u, uu, v, vv, d);
  if (!of_v) return sine_of_dot(between.normal, u) / kU;
  return (sine_of_dot(between.normal, v) - (between.tilt_v - kAcrossError - kFlatError)) / kU;
}
void parallel_edges(Random& random, Scene& s) {
  longest_edge(random, s, 0, 1);
  const Vec a = p(s, 0), b = p(s, 1), way = b - a, aside = across(p(s, 2), way, dot(way, way));
  const double extent = max(max_abs(a), max_abs(b)), height = (64 + 20 * random.uniform()) * kU * extent / norm(aside),
               wobble = random.uniform() < 0.5 ? 0 : std::exp2(random.uniform(-55, -28)) * norm(way) / norm(aside);
  const auto on = [&](double x) { return a + way * x + aside * (height + x * wobble); };
  const double tail = fraction(random), head = fraction(random);
  put(s, 2, on(tail)), put(s, 3, on(head));
}

/// p0 and p1 vectors.
double flat_error(const Scene& s) {
  const Vec u = p(s, 0), v = p(s, 1);
  const Exact3 x = exact(u), y = exact(v);
  return length(exact(cross(u, v)) - outer(x, y)) / (length(x) * length(y)) / kU;
}
double tilt_error(const Scene& s) {
  const Vec u = p(s, 0), v = p(s, 1);
  const double uu = dot(u, u), vv = dot(v, v);
  const Vec n = between_edges(u, uu, v, vv, cross(u, v)).normal;
  return dot(n, n) > kU * uu * vv ? sine_of_dot(n, u) * std::sqrt(dot(n, n) / uu / vv) / kU : -1;
}

/// p0 and p1 the vectors of two edges: what the righted normal has of either, or how far it is turned, in tilts.
struct Righted {
  Vec u, v, normal, righted;
  double tilt;
  explicit Righted(const Scene& s) : u(p(s, 0)), v(p(s, 1)) {
    const double uu = dot(u, u), vv = dot(v, v);
    const BetweenEdges<Vec> between = between_edges(u, uu, v, vv, cross(u, v));
    normal = between.normal, tilt = between.tilt_u, righted = swiftlet::righted(normal, u, uu, v, vv);
  }
  bool is_tried() const { return tilt > kLeastTilt && tilt < kMostTilt; }
};
double righted_error(const Scene& s) {
  const Righted r(s);
  return r.is_tried() ? max(sine_of_dot(r.righted, r.u), sine_of_dot(r.righted, r.v)) / kU : -1;
}
double righted_turn(const Scene& s) {
  const Righted r(s);
  return r.is_tried() ? length(exact(r.righted) - exact(r.normal)) / length(exact(r.normal)) / r.tilt : -1;
}
void slim_edges(Random& random, Scene& s) {
  const Vec u = p(s, 0), aside = across(p(s, 1), u, dot(u, u));
  put(s, 1, u * sign(random) + aside * (norm(u) / norm(aside) * std::exp2(random.uniform(-10, -1.5))));
}

/// p0 a normal.
double image_error(const Scene& s) {
  const Motion m = pose(s);
  const Exact3 n = exact(p(s, 0));
  return length(exact(body<Moved>(m).image(p(s, 0))) - cofactors(exact(m)) * n) / length(n) / kU;
}

/// p0, p1 and p2 corners: the sine between a triangle's computed normal and its own, relative to its slant.
template <class Body>
double triangle_error(const Scene& s) {
  const Motion m = pose(s);
  const Body b = body<Body>(m);
  const Vec u = b.rotated(p(s, 1) - p(s, 0)), v = b.rotated(p(s, 2) - p(s, 0)), n = cross(u, v);
  const Exact3 q = exact(p(s, 0)), x = image<Body>(s, exact(p(s, 1)) - q), y = image<Body>(s, exact(p(s, 2)) - q),
               normal = outer(x, y);
  const double slant = std::sqrt(dot(u, u) * dot(v, v) / dot(n, n));
  if (!(slant < 0x1p30)) return -1;
  return length(outer(exact(n), normal)) / (length(exact(n)) * length(normal)) / slant / kU;
}

/// In half of the scenes both sides lead along diagonals of a cube, from near the origin, and R is nearly the identity: errors
/// of all coordinates then lift a side out of the triangle's plane.
void diagonal_sides(Random& random, Scene& s) {
  if (random.bits() & 1) return;
  const double scale = max_abs(p(s, 1));
  for (std::size_t i = 0; i < 9; ++i) s[i] = (i % 4 == 0 ? 1 : 0) + random.uniform(-0x1p-24, 0x1p-24);
  put(s, 0, Vec{tiny(random), tiny(random), tiny(random)} * scale);
  const auto coordinate = [&] { return sign(random) * near_one(random) * scale; };
  for (const int i : {1, 2}) put(s, i, {coordinate(), coordinate(), coordinate()});
}

/// p0 a corner, p1 and p2 vectors of weights p3.x and p3.y: what the sums of a point lose.
double stand_error(const Scene& s) {
  const double f = std::fabs(s[21]), g = std::fabs(s[22]);
  if (!(f + g <= 1)) return -1;
  const Vec corner = p(s, 0), a = p(s, 1) * f, b = p(s, 2) * g;
  const Exact3 q = exact(corner);
  const double magnitude = max(length(q), max(length(q + exact(p(s, 1))), length(q + exact(p(s, 2)))));
  return length(exact(corner + a + b) - q - exact(a) - exact(b)) / magnitude / kU;
}

/// p0 and p1 a triangle's sides, p2 a point in its prism: how far the point below it, from weights, is outside the triangle.
double weights_error(const Scene& s) {
  const Vec u = p(s, 0), v = p(s, 1), n = cross(u, v), c = cross(n, p(s, 2));
  const double nn = dot(n, n), beyond_u = dot(u, c), beyond_v = -dot(v, c);
  if (beyond_u > 0 || beyond_v > 0 || -(beyond_u + beyond_v + nn) > 0 || nn < 0x1p-60 * dot(u, u) * dot(v, v)) return -1;
  const double f = -beyond_v / nn, g = -beyond_u / nn;
  // Where the weights f and g sum to more than 1, both are divided by the sum: all is multiplied by it.
  const Dyadic sum = f + g > 1 || Dyadic(f) + Dyadic(g) > Dyadic(1.0) ? Dyadic(f) + Dyadic(g) : Dyadic(1.0);
  const Exact3 off = (exact(u * f) + exact(v * g)) * sum - exact(u) * Dyadic(f) - exact(v) * Dyadic(g);
  return length(off) / rounded(sum) / (norm_1(u) + norm_1(v)) / kU;
}
void over_triangle(Random& random, Scene& s) {
  const double f = random.uniform() < 0.5 ? random.uniform() : std::exp2(random.uniform(-60, 0)),
               g = random.uniform() < 0.7 ? 1 - f : random.uniform();
  if (random.bits() & 1) put(s, int(random.bits() % 2), p(s, int(random.bits() % 2)) * std::exp2(-random.uniform(0, 40)));
  const Vec u = p(s, 0), v = p(s, 1);
  put(s, 2, u * f + v * g + cross(u, v) * ((random.uniform() < 0.5 ? 1e-15 : 1) * random.uniform() / std::sqrt(dot(u, u))));
}

/// p0 a point in the common frame, p1 and p2 the ends of a polygon's side and p3 its normal, in the own frame: how far the
/// point's height over the side, along the own normal, is from that of the point below it along the image of the normal.
double foot_length(const Scene& s) {
  const Motion m = pose(s);
  const Vec u = p(s, 2) - p(s, 1), n = p(s, 3);
  const double uu = dot(u, u);
  if (std::fabs(dot(n, u)) > 0x1p-48 * std::sqrt(uu) || std::fabs(dot(n, n) - 1) > 1e-15) return -1;
  const double beyond = dot(body<Moved>(m).local(p(s, 0)) - p(s, 1), cross(u, n));
  const Matrix r = exact(m), back = transposed(cofactors(r));
  const Dyadic det = inner(r.x, outer(r.y, r.z));
  // All lengths times det: x is the point in the own frame. `below` times `slope` is the point below it.
  const Exact3 tail = exact(p(s, 1)), side = exact(p(s, 2)) - tail, normal = exact(n),
               x = back * (exact(p(s, 0)) - exact(m.t)) - tail * det, down = back * (transposed(back) * normal);
  const Dyadic slope = inner(normal, down);
  const Exact3 below = x * slope - down * inner(normal, x);
  const Dyadic truth = inner(below, outer(side, normal)), scale = slope * det;
  return std::fabs(rounded(Dyadic(beyond) * scale - truth)) / rounded(scale) / std::sqrt(uu);
}
double foot_magnitude(const Scene& s, double pose_error) {
  const ConvexView none;
  const double own = max(max_abs(p(s, 1)), max_abs(p(s, 2)));
  ConvexView a, b;
  a.extent = max_abs(p(s, 0)), b.extent = own;
  return pair_view(a, b, pose(s), pose_error).magnitude;
}
double foot_error(const Scene& s) {
  const double pose_error = pose_quality(pose(s)).error, length = foot_length(s);
  if (length < 0 || pose_error > 0x1p-40) return -1;
  return length / foot_magnitude(s, pose_error) / (kU + 0.4 * pose_error);  // 15 u + 6 pose_error, over 15
}
double foot_turn(const Scene& s) {
  const double pose_error = pose_quality(pose(s)).error, length = foot_length(s);
  if (length < 0 || pose_error < 1e-9) return -1;
  return (length / foot_magnitude(s, pose_error) - kFootError) / pose_error;
}
template <bool rigid>
void over_polygon(Random& random, Scene& s) {
  if (rigid) {
    const Mat3 r = random.rotation();
    for (int i = 0; i < 9; ++i) s[std::size_t(i)] = r(i / 3, i % 3);
  }
  const Vec way = p(s, 2) - p(s, 1), n = normalised(across(p(s, 3), way, dot(way, way)));
  put(s, 3, n);
  // Half of the points are above the side, at any height.
  const double height = norm(way) * std::exp2(random.uniform(-10, 30));
  if (random.uniform() < 0.5) put(s, 0, apply(pose(s), p(s, 1) + way * random.uniform() + n * height));
}

/// p0 a direction, p1 and p2 vertices: `gap`, and the length of the unit direction. With e = x - y / |d| for the computed x and
/// the exact y = d . c: e = (x^2 |d|^2 - y^2) / (|d| (x |d| + y)).
double gap_error(const Scene& s) {
  const Vec d = p(s, 0), n = d * (1 / std::sqrt(dot(d, d))), c = p(s, 2) - p(s, 1);
  const double x = dot(n, c), products = std::fabs(n.x * c.x) + std::fabs(n.y * c.y) + std::fabs(n.z * c.z);
  const Exact3 direction = exact(d);
  const Dyadic y = inner(direction, exact(p(s, 2)) - exact(p(s, 1))), dd = inner(direction, direction);
  const double l = std::sqrt(rounded(dd)), sum = std::fabs(x) * l + std::fabs(rounded(y));
  if (x * rounded(y) < 0) return sum / l / products / kU;
  return std::fabs(rounded(Dyadic(x) * Dyadic(x) * dd - y * y)) / (l * sum) / products / kU;
}
/// p0 and p1 points.
double norm_error(const Scene& s) {
  const double x = norm(p(s, 1) - p(s, 0));
  const Exact3 c = exact(p(s, 1)) - exact(p(s, 0));
  const Dyadic cc = inner(c, c);
  const double l = std::sqrt(rounded(cc));
  return std::fabs(rounded(Dyadic(x) * Dyadic(x) - cc)) / (x + l) / l / kU;
}

/// p0 a point of B. Of `turn` the translation's own rounding is taken off, of `shift` the rotation's.
double moved_error(const Scene& s) {
  const Motion m = pose(s);
  return length(exact(apply(m, p(s, 0))) - exact(m) * exact(p(s, 0)) - exact(m.t)) / kU;
}
double turn_error(const Scene& s) { return (moved_error(s) - length(exact(row(s, 3)))) / length(exact(p(s, 0))); }
double shift_error(const Scene& s) {
  const double t = length(exact(row(s, 3)));
  return t > 0 ? (moved_error(s) - 4 * kSqrt3 * length(exact(p(s, 0)))) / t : -1;
}
void small_shift(Random& random, Scene& s) {
  for (std::size_t i = 9; i < 12; ++i) s[i] *= std::exp2(-random.uniform(20, 60));
}
void large_shift(Random& random, Scene& s) {
  for (std::size_t i = 12; i < 15; ++i) s[i] *= std::exp2(-random.uniform(20, 60));
}

/// p0 and p1 hold a map frame.
std::array<double, 6> frame(const Scene& s) { return {s[12], s[13], s[14], s[15], s[16], s[17]}; }
/// The vector M^-T x times the product of M's diagonal.
Exact3 ball_coordinates_by(const std::array<double, 6>& m, const Exact3& x) {
  const Dyadic m0(m[0]), m1(m[1]), m2(m[2]), m3(m[3]), m4(m[4]), m5(m[5]), second = x.y * m0 - m1 * x.x;
  return {x.x * m3 * m5, second * m5, (x.z * m0 - m2 * x.x) * m3 - m4 * second};
}

/// The scale of the ellipsoid around a vertex and the origin.
double around(const std::array<double, 6>& m, const Vec& v) {
  const Vertex vertex{v.x, v.y, v.z, 0, 0};
  ConvexView view;
  view.vertices = {&vertex, 1}, view.extent = max_abs(v);
  return scale_around(view, {0, 0, 0}, m);
}
/// The kernel takes M for a frame of ellipsoids.
bool has_ellipsoid(const std::array<double, 6>& m) {
  return min(m[0], min(m[3], m[5])) > 0 && around(m, {1, 0, 0}) < kInfinity;
}
/// p2 a point of a body around the origin: how far the ellipsoid around it falls short of it along the ellipsoid's own normal
/// there, without the slack.
double around_error(const Scene& s) {
  const std::array<double, 6> m = frame(s);
  const Vec w = p(s, 2), n = from_map(m, ball_coordinates(m, w)), way = into_map(m, n);
  const double scale = around(m, w);
  if (!(has_ellipsoid(m) && has_range(dot(way, way)))) return -1;
  const Dyadic height = inner(exact(n), exact(w));
  return (rounded(height - Dyadic(scale * std::sqrt(dot(way, way)))) / rounded(height) + kEllipsoidSlack) / kU;
}
/// p2 a line: by how much less of it than its transposed pose says lies in the ellipsoid of a body.
double slender_turn(const Scene& s) {
  const std::array<double, 6> m = frame(s);
  const double pose_error = pose_quality(pose(s)).error;
  if (pose_error < 1e-9 || !has_ellipsoid(m)) return -1;
  const Matrix r = exact(pose(s));
  const Exact3 x = exact(p(s, 2)), asked = ball_coordinates_by(m, transposed(r) * x),
               truth = ball_coordinates_by(m, transposed(cofactors(r)) * x);
  const Dyadic det = inner(r.x, outer(r.y, r.z)), asked2 = inner(asked, asked) * det * det, truth2 = inner(truth, truth);
  const double long_asked = std::sqrt(rounded(asked2));
  return rounded(truth2 - asked2) / (std::sqrt(rounded(truth2)) + long_asked) / long_asked / pose_error;
}
/// p2 and p3 centres of B and A: by how much of law 2's bound less of the line between them lies in the ellipsoid of a body
/// than the rounded line says.
double slender_line(const Scene& s) {
  const std::array<double, 6> m = frame(s);
  const Motion b_in_a = pose(s);
  const Vec line = apply(b_in_a, p(s, 2)) - p(s, 3);
  const double bound = law_two(max_abs(p(s, 3)), max_abs(p(s, 2)), norm(b_in_a.t), pose_quality(b_in_a).error);
  if (!(has_ellipsoid(m) && max_abs(line) > 0)) return -1;
  const Exact3 asked = ball_coordinates_by(m, exact(line)),
               truth = ball_coordinates_by(m, exact(b_in_a) * exact(p(s, 2)) + exact(b_in_a.t) - exact(p(s, 3)));
  const Dyadic asked2 = inner(asked, asked), truth2 = inner(truth, truth);
  const double long_asked = std::sqrt(rounded(asked2));
  return rounded(truth2 - asked2) / (std::sqrt(rounded(truth2)) + long_asked) / long_asked * norm(line) / bound;
}
/// A frame as slender as they may be, of principal axes `axes`, the longest first.
void put_frame(Random& random, Scene& s, const Mat3& axes) {
  const double middle = std::exp2(random.uniform(0, 8));
  for (double longest = 256; longest > 1; longest *= 1 - 0x1p-10) {
    const Vec3 widths(longest, std::min(middle, longest), 1);
    const Mat3 square = axes * widths.cwiseAbs2().asDiagonal() * axes.transpose(), m = square.llt().matrixU();
    if (!(m.norm() * m.inverse().norm() < 256 * (1 - 1e-9))) continue;
    put(s, 0, {m(0, 0), m(0, 1), m(0, 2)}), put(s, 1, {m(1, 1), m(1, 2), m(2, 2)});
    return;
  }
}
Mat3 rotation(Random& random);
/// In any directions, or nearly along the axes.
void slender_frame(Random& random, Scene& s) { put_frame(random, s, random.bits() & 1 ? random.rotation() : rotation(random)); }
/// The pose's error changes the line where the frame is the most slender; half of the line is along either axis of these.
void slender_pose(Random& random, Scene& s) {
  Mat3 error;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k <= i; ++k) error(i, k) = error(k, i) = sign(random) * (random.bits() % 4 == 0 ? random.uniform() : 1);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(error);
  const Vec3 most = eigen.eigenvectors().col(2), least = eigen.eigenvectors().col(0);
  Mat3 axes;
  axes.col(0) = (most + least).normalized(), axes.col(2) = (most - least).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  put_frame(random, s, axes);
  const Mat3 turn = Mat3::Identity() + error * std::exp2(-random.uniform(22, 29));
  for (int i = 0; i < 9; ++i) s[std::size_t(i)] = turn(i / 3, i % 3);
  put(s, 2, vec(Vec3(axes.col(0) * 256 + axes.col(2) * sign(random) * random.uniform(0.5, 1.5))));
}
/// The centres are near each other and far from the origins, and half of the line is along either axis.
void slender_centres(Random& random, Scene& s) {
  const Mat3 axes = random.rotation();
  put_frame(random, s, axes);
  const Vec line = vec(Vec3(axes.col(0) * 256 + axes.col(2) * sign(random) * random.uniform(0.5, 1.5)));
  put(s, 3, apply(pose(s), p(s, 2)) - line * (max_abs(p(s, 2)) * std::exp2(-random.uniform(10, 50))));
}

constexpr double u(double margin) { return margin / kU; }

// Kinds that do not bite, and the largest errors that 10^6 scenes and some structured ones have shown. `across parallel v`: 3.0
// of 7.9, as what the two products lose lies seldom along the other edge. `righted turn`: 0.74 of 2.5, which sums three worst
// cases. `triangle B`: 7.5 of 15.8 and `image`: 5.0 of 11.2, which count sqrt(3) as if all coordinates could lose most at once.
// `foot`: 6.3 of 15. `foot turn`: 2.4 of 6: where the point is above the side, what R^T turns the point and what it turns the
// normal are opposite. `ellipsoid`: 214 of 1 544 and `slender line`: 4.2 of 26, as neither the terms that cancel nor the line's
// error lie wholly along a frame's shortest axis.
const Kind kKinds[] = {
    {"scan A", u(kScanError), 8, true, false, 3, level_vertices, scan_error<Resting>},
    {"scan B", u(kScanError), 14 * kSqrt3, true, true, 3, opposite_vertices, scan_error<Moved>},
    {"beside A", u(kBesideError), 4, true, false, 3, level_vertices, beside_error<Resting>},
    {"beside B", u(kBesideError), 7, true, true, 3, level_vertices, beside_error<Moved>},
    {"way A", u(kWayError), 1, true, false, 2, nullptr, way_error<Resting>},
    {"way B", u(kTurnedWayError), 1 + 3 * kSqrt3, true, true, 2, nullptr, way_error<Moved>},
    {"across", u(kAcrossError), 4.5, true, false, 3, near_edge, across_error},
    {"across parallel u", u(kAcrossError), 4.5, true, false, 4, parallel_edges, parallel_error<false>},
    {"across parallel v", u(kAcrossError + kFlatError), 4.5 + 3.4, false, false, 4, parallel_edges, parallel_error<true>},
    {"flat", u(kFlatError), 3.4, true, false, 2, nullptr, flat_error},
    {"flat, as a tilt", u(kFlatError), 3.4, true, false, 2, nullptr, tilt_error},
    {"righted", u(kAcrossError), 5, true, false, 2, slim_edges, righted_error},
    {"righted turn", kRightedTurn, 2.5, false, false, 2, slim_edges, righted_turn},
    {"triangle A", u(2 * kWayError + kFlatError), 5.4, true, false, 3, nullptr, triangle_error<Resting>},
    {"triangle B", u(2 * kTurnedWayError + kFlatError), 15.8, false, true, 3, diagonal_sides, triangle_error<Moved>},
    {"image", u(kImageError), 11.2, false, true, 1, nullptr, image_error},
    {"stand", u(kPointSumError), 2, true, false, 4, nullptr, stand_error},
    {"weights", u(kWeightError), 3, true, false, 3, over_triangle, weights_error},
    {"foot", 20, 15, false, true, 4, over_polygon<true>, foot_error},
    {"foot turn", kFootTurn, 6, false, true, 4, over_polygon<false>, foot_turn},
    {"gap", u(kGapError), 9.5, true, false, 3, nullptr, gap_error},
    {"norm", u(kNormError), 3.5, true, false, 2, nullptr, norm_error},
    {"turn", u(kTurnError), 4 * kSqrt3, true, true, 1, small_shift, turn_error},
    {"shift", u(kShiftError), 1, true, true, 1, large_shift, shift_error},
    {"ellipsoid", u(kEllipsoidSlack), 6 * 256 + 8, false, false, 3, slender_frame, around_error},
    {"slender turn", kSlenderTurn, 272, true, true, 3, slender_pose, slender_turn},
    {"slender line", kSlenderLine, 26, false, true, 4, slender_centres, slender_line},
};

// ---- The search ------------------------------------------------------------------------------------------------------------

Vec direction(Random& random, std::uint64_t style) {
  switch (style % 4) {
    case 0: return vec(random.in_ball());
    case 1: return {sign(random) * near_one(random), sign(random) * near_one(random), sign(random) * near_one(random)};
    case 2: {
      Vec v{tiny(random), tiny(random), tiny(random)};
      (random.bits() & 1 ? v.x : random.bits() & 1 ? v.y : v.z) = sign(random) * near_one(random);
      return v;
    }
    default: {
      const Vec3 v = random.in_ball();
      return {double(float(v.x())), double(float(v.y())), double(float(v.z()))};
    }
  }
}

Mat3 rotation(Random& random) {
  Mat3 r = Mat3::Identity();
  const double a = std::sqrt(1. / 2), b = std::sqrt(1. / 3), c = std::sqrt(1. / 6);
  switch (random.bits() % 6) {
    case 0: r = random.rotation(); break;
    case 1: r << 2. / 3, 2. / 3, -1. / 3, 2. / 3, -1. / 3, 2. / 3, -1. / 3, 2. / 3, 2. / 3; break;
    case 2: r = shapes::from_quaternion(1, random.in_ball() * std::exp2(-random.uniform(0, 30))); break;
    case 3: r << b, b, b, a, -a, 0, c, c, -2 * c; break;
    case 4: r << b, a, c, b, -a, c, b, 0, -2 * c; break;
    default: break;
  }
  for (int i = 0; i < 3; ++i) r.col(i) *= sign(random), r.row(i).swap(r.row(int(random.bits() % 3)));
  if (r.row(0).cross(r.row(1)).dot(r.row(2)) < 0) r = -r;
  // To float32's precision, or a little beside a double's.
  const double off = random.bits() & 1 ? 0x1p-24 : 0x1p-50;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) += random.uniform(-off, off);
  return r;
}

Scene random_scene(Random& random, const Kind& kind) {
  Scene s{};
  const Mat3 r = kind.posed ? rotation(random) : Mat3::Identity();
  for (int i = 0; i < 9; ++i) s[std::size_t(i)] = r(i / 3, i % 3);
  const double scale = std::exp2(std::floor(random.uniform(-100, 100)));
  const std::uint64_t one_style = random.bits();  // of all vectors of half of the scenes
  const bool alike = random.bits() & 1;
  for (int i = -1; i < kind.vectors; ++i) {
    Vec v = direction(random, alike ? one_style : random.bits()) * scale;
    if (i > 0 && random.bits() % 3 == 0) v = p(s, i - 1) * sign(random) + v * std::exp2(-random.uniform(0, 50));
    if (i >= 0 || kind.posed) put(s, i, v);
  }
  if (kind.arrange) kind.arrange(random, s);
  return s;
}

/// Turns the pose, whose matrix stays as orthonormal as it was, or moves a vector, by any amount.
void move(Random& random, const Kind& kind, Scene& s) {
  const double by = std::exp2(random.uniform(-45, -1));
  if (kind.posed && (random.bits() & 1)) {
    const Mat3 turn = shapes::from_quaternion(1, random.in_ball() * by);
    const Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> r(s.data());
    const Mat3 turned = turn * r;
    for (int i = 0; i < 9; ++i) s[std::size_t(i)] = turned(i / 3, i % 3);
  } else {
    const int i = int(random.bits() % std::uint64_t(kind.vectors));
    put(s, i, p(s, i) + vec(random.in_ball()) * (by * max_abs(p(s, i))));
  }
}

void mutate(Random& random, const Kind& kind, Scene& s) {
  if (random.bits() % 8 == 0) move(random, kind, s);
  for (std::uint64_t times = 1 + random.bits() % 3; times > 0; --times) {
    const std::size_t first = kind.posed ? 0 : 12, i = first + random.bits() % (12 + 3 * std::size_t(kind.vectors) - first);
    double& x = s[i];
    const double ulps = sign(random) * std::exp2(random.uniform(-53, -24));
    const std::uint64_t how = random.bits() % 8;
    if (how < 4 || i < 9)
      x += ulps * (i < 9 && (random.bits() & 1) ? 1 : x);
    else if (how == 4)
      x = std::copysign(std::exp2(std::round(std::log2(std::fabs(x) + 1e-40))) * near_one(random), x);
    else if (how == 5)
      x = tiny(random) * max_abs(row(s, int(i / 3)));
    else if (how == 6)
      x = -x;
    else
      x = sign(random) * s[3 * (i / 3) + random.bits() % 3] * near_one(random);
  }
}

/// The error of a scene, -1 of one that is none of the kind.
double judged(const Kind& kind, const Scene& s, Attack& attack) {
  if (kind.posed && !pose_quality(pose(s)).legal) return -1;
  const double error = kind.error(s);
  if (!(error >= 0)) return -1;
  ++attack.count;
  if (error > attack.largest && std::isfinite(error)) attack.largest = error, attack.worst = s;
  return error;
}

}  // namespace

std::span<const Kind> kinds() { return kKinds; }

Attack attack(const Kind& kind, std::uint64_t count) {
  Random random(std::uint64_t(&kind - kKinds) + 1);
  Attack result;
  constexpr int kDraws = 200, kClimb = 400;
  for (int climb = 0; result.count < count; ++climb) {
    // Every third climb starts at the worst of new scenes, the others at the worst one ever found.
    Scene best = result.worst;
    double most = climb % 3 != 0 ? result.largest : -1;
    for (int i = 0; i < kDraws && climb % 3 == 0; ++i) {
      const Scene next = random_scene(random, kind);
      if (const double error = judged(kind, next, result); error >= most) most = error, best = next;
    }
    for (int i = 0; i < kClimb && result.count < count; ++i) {
      Scene next = best;
      mutate(random, kind, next);
      if (const double error = judged(kind, next, result); error >= most) most = error, best = next;
    }
  }
  return result;
}

}  // namespace swiftlet::margins
