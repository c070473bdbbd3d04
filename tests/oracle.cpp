// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Knows rationals and one algorithm for bodies apart, the minimum-norm point of the difference body by growing and shrinking a
// simplex of vertex pairs. Run in double it is a guess where to start; run in rationals every comparison is exact, each round
// strictly nearer, the simplices finitely many: it ends at the truth. How deep bodies overlap is the nearest facet of the
// difference body, whose hull CGAL computes exactly.
//
//   P. Wolfe, Finding the nearest point in a polytope. Mathematical Programming 11, 1976.
//   E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects in
//   three-dimensional space. IEEE Journal of Robotics and Automation 4, 1988.
#include "oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace swiftlet::oracle {

using Rational = CGAL::Gmpq;

struct Exact {
  Rational distance2;
};

namespace {

template <class N>
using Point = std::array<N, 3>;

template <class N>
N dot(const Point<N>& p, const Point<N>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

template <class N>
Point<N> point(const Vec3& p) {
  return {N(p[0]), N(p[1]), N(p[2])};
}

Vec3 rounded(const Point<Rational>& p) { return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])}; }

template <class N>
struct Motion {
  Point<Point<N>> column;
  Point<N> translation;

  explicit Motion(const Pose& pose)
      : column{point<N>(pose.rotation.col(0)), point<N>(pose.rotation.col(1)), point<N>(pose.rotation.col(2))},
        translation(point<N>(pose.translation)) {}

  Point<N> operator()(const Vec3& p_body) const {
    const Point<N> p = point<N>(p_body);
    Point<N> moved = translation;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) moved[i] = moved[i] + column[j][i] * p[j];
    return moved;
  }

  /// The direction in the body's frame in which its points order as their images do along `n`.
  Point<N> direction_in_body(const Point<N>& n) const { return {dot(column[0], n), dot(column[1], n), dot(column[2], n)}; }
};

template <class N>
Point<N> opposite(const Point<N>& n) {
  return {-n[0], -n[1], -n[2]};
}

// --- Roots -----------------------------------------------------------------------------------------------------------------

// Half the binary exponent of q > 0, rounded: q / 4^result is near 1 and fits a double whatever q.
long half_exponent(const Rational& q) {
  return (long(mpz_sizeinbase(mpq_numref(q.mpq()), 2)) - long(mpz_sizeinbase(mpq_denref(q.mpq()), 2))) / 2;
}

Rational scaled(const Rational& q, long exponent) {
  Rational result;
  if (exponent >= 0)
    mpq_mul_2exp(result.mpq(), q.mpq(), mp_bitcnt_t(exponent));
  else
    mpq_div_2exp(result.mpq(), q.mpq(), mp_bitcnt_t(-exponent));
  return result;
}

bool root_at_least(const Rational& q, double s) { return std::isfinite(s) && Rational(s) * Rational(s) <= q; }

// The greatest double whose square is at most q, and the least whose square is at least q.
Interval square_root(const Rational& q) {
  if (CGAL::sign(q) == CGAL::ZERO) return {};
  const long half = half_exponent(q);
  double s = std::ldexp(std::sqrt(CGAL::to_double(scaled(q, -2 * half))), int(half));
  const double infinity = std::numeric_limits<double>::infinity();
  while (!root_at_least(q, s)) s = std::nextafter(s, 0);
  while (root_at_least(q, std::nextafter(s, infinity))) s = std::nextafter(s, infinity);
  return {s, Rational(s) * Rational(s) == q ? s : std::nextafter(s, infinity)};
}

// --- Support ---------------------------------------------------------------------------------------------------------------

std::uint32_t support(std::span<const Vec3> points, const Point<double>& direction) {
  const Vec3 n(direction[0], direction[1], direction[2]);
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < points.size(); ++i)
    if (points[i].dot(n) > points[best].dot(n)) best = i;
  return best;
}

// The direction, rounded, at a power of two that makes its largest coordinate about 1.
Vec3 rounded_direction(const Point<Rational>& direction) {
  const auto longer = [](const Rational& p, const Rational& q) { return CGAL::abs(p) < CGAL::abs(q); };
  const Rational largest = CGAL::abs(*std::max_element(direction.begin(), direction.end(), longer));
  if (CGAL::sign(largest) == CGAL::ZERO) return Vec3::Zero();
  const long exponent = -2 * half_exponent(largest);
  return rounded({scaled(direction[0], exponent), scaled(direction[1], exponent), scaled(direction[2], exponent)});
}

// Exact: doubles only sort out what cannot be the answer. Rounding the direction costs 2^-52 of each coordinate, the products
// and sums less than 3 * 2^-53 of the sum of their absolute values: 2^-50 of it covers both. The last term is underflow.
std::uint32_t support(std::span<const Vec3> points, const Point<Rational>& direction) {
  const Vec3 n = rounded_direction(direction);
  std::vector<double> along(points.size());
  double greatest = -std::numeric_limits<double>::infinity(), extent = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    greatest = std::max(greatest, along[i] = points[i].dot(n));
    extent = std::max(extent, points[i].lpNorm<Eigen::Infinity>());
  }
  const double error = std::ldexp(n.lpNorm<1>() * extent, -50) + 8 * std::numeric_limits<double>::denorm_min();
  std::optional<std::uint32_t> best;
  Rational best_along;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (along[i] < greatest - 2 * error) continue;
    const Rational exactly = dot(direction, point<Rational>(points[i]));
    if (best && exactly <= best_along) continue;
    best = i;
    best_along = exactly;
  }
  return *best;
}

// --- The nearest point of a simplex ----------------------------------------------------------------------------------------

template <class N>
using Matrix = std::vector<std::vector<N>>;

// Solves m x = y in place by elimination; m is symmetric and semidefinite, nothing comes back when it is singular.
template <class N>
std::optional<std::vector<N>> solved(Matrix<N> m, std::vector<N> y) {
  const std::size_t n = y.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!(m[k][k] > N(0))) return std::nullopt;
    for (std::size_t i = k + 1; i < n; ++i) {
      const N factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < n; ++j) m[i][j] = m[i][j] - factor * m[k][j];
      y[i] = y[i] - factor * y[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) y[k] = y[k] - m[k][j] * y[j];
    y[k] = y[k] / m[k][k];
  }
  return y;
}

// Weights of the point nearest to the origin in the affine hull of the points `subset`, whose dot products are `gram`; nothing
// when the points are affinely dependent.
template <class N>
std::optional<std::vector<N>> affine_weights(const Matrix<N>& gram, const std::vector<std::size_t>& subset) {
  const std::size_t o = subset[0], n = subset.size() - 1;
  Matrix<N> edges(n, std::vector<N>(n));
  std::vector<N> towards(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t p = subset[i + 1];
    towards[i] = gram[o][o] - gram[o][p];
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t q = subset[j + 1];
      edges[i][j] = gram[p][q] - gram[o][p] - gram[o][q] + gram[o][o];
    }
  }
  std::optional<std::vector<N>> weights = solved(std::move(edges), std::move(towards));
  if (!weights) return std::nullopt;
  N first(1);
  for (const N& w : *weights) first = first - w;
  weights->insert(weights->begin(), first);
  return weights;
}

template <class N>
struct Nearest {
  N norm2;
  std::vector<std::size_t> subset;  ///< the points that span it, all with positive weights
  std::vector<N> weights;
};

// Every point of the simplex lies beyond the plane through the nearest point, perpendicular to it.
template <class N>
bool is_nearest(const Matrix<N>& gram, const Nearest<N>& candidate) {
  return std::all_of(gram.begin(), gram.end(), [&](const std::vector<N>& row) {
    N along(0);
    for (std::size_t j = 0; j < candidate.subset.size(); ++j) along = along + row[candidate.subset[j]] * candidate.weights[j];
    return along >= candidate.norm2;
  });
}

// The point nearest to the origin in the hull of at most four points: all their subsets, largest first.
template <class N>
Nearest<N> nearest(const std::vector<Point<N>>& points) {
  Matrix<N> gram(points.size(), std::vector<N>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) gram[i][j] = gram[j][i] = dot(points[i], points[j]);
  std::optional<Nearest<N>> best;
  for (unsigned mask = (1u << points.size()) - 1; mask > 0; --mask) {
    std::vector<std::size_t> subset;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (mask >> i & 1) subset.push_back(i);
    const auto weights = affine_weights(gram, subset);
    if (!weights || !std::all_of(weights->begin(), weights->end(), [](const N& w) { return w > N(0); })) continue;
    N norm2(0);  // the nearest point's dot product with each point of its subset is the same
    for (std::size_t j = 0; j < subset.size(); ++j) norm2 = norm2 + gram[subset[0]][subset[j]] * (*weights)[j];
    Nearest<N> candidate{norm2, subset, *weights};
    if (best && candidate.norm2 >= best->norm2) continue;
    best = std::move(candidate);
    if (is_nearest(gram, *best)) break;
  }
  return *best;
}

// --- The nearest point of the difference body ------------------------------------------------------------------------------

/// Points where their pose puts them; without one, where they are.
template <class N>
class Placed {
 public:
  explicit Placed(std::span<const Vec3> points) : points_(points) {}
  Placed(std::span<const Vec3> points, const Pose& pose) : points_(points), motion_(pose) {}

  Point<N> operator[](std::uint32_t i) const { return motion_ ? (*motion_)(points_[i]) : point<N>(points_[i]); }
  std::uint32_t support_along(const Point<N>& n) const { return support(points_, motion_ ? motion_->direction_in_body(n) : n); }

 private:
  std::span<const Vec3> points_;
  std::optional<Motion<N>> motion_;
};

struct VertexPair {
  std::uint32_t a, b;
  bool operator==(const VertexPair&) const = default;
};

template <class N>
struct Solution {
  N distance2{0};
  Point<N> b_to_a;  ///< nearest point of A - B
  std::vector<VertexPair> pairs;
  std::vector<N> weights;  ///< one per pair: nearest points are the same combination of their vertices
};

template <class N>
class Solver {
 public:
  Solver(Placed<N> a, Placed<N> b) : a_(std::move(a)), b_(std::move(b)) {}

  // In rationals neither a repeated pair nor a standstill can occur before the end; in double they are the end.
  Solution<N> solve(std::vector<VertexPair> pairs) const {
    std::optional<Solution<N>> solution;
    for (;;) {
      Solution<N> next = nearest_of(pairs);
      if (solution && next.distance2 >= solution->distance2) return *solution;
      solution = std::move(next);
      if (!(solution->distance2 > N(0))) return *solution;
      const VertexPair w = support_pair(solution->b_to_a);
      const auto& kept = solution->pairs;
      if (std::find(kept.begin(), kept.end(), w) != kept.end() || dot(solution->b_to_a, difference(w)) >= solution->distance2)
        return *solution;
      pairs = kept;
      pairs.push_back(w);
    }
  }

  Point<N> point_a(const Solution<N>& solution) const {
    return combination(solution, [&](const VertexPair& pair) { return a_[pair.a]; });
  }
  Point<N> point_b(const Solution<N>& solution) const {
    return combination(solution, [&](const VertexPair& pair) { return b_[pair.b]; });
  }

  /// The least of n.(a - b).
  N least_along(const Point<N>& n) const { return dot(n, difference(support_pair(n))); }

 private:
  Point<N> difference(const VertexPair& pair) const {
    const Point<N> p = a_[pair.a], q = b_[pair.b];
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }

  // The pair with the least n.(a - b).
  VertexPair support_pair(const Point<N>& n) const { return {a_.support_along(opposite(n)), b_.support_along(n)}; }

  template <class PointOf>
  Point<N> combination(const Solution<N>& solution, PointOf point_of) const {
    Point<N> sum{N(0), N(0), N(0)};
    for (std::size_t i = 0; i < solution.pairs.size(); ++i) {
      const Point<N> p = point_of(solution.pairs[i]);
      for (int k = 0; k < 3; ++k) sum[k] = sum[k] + solution.weights[i] * p[k];
    }
    return sum;
  }

  Solution<N> nearest_of(const std::vector<VertexPair>& pairs) const {
    std::vector<Point<N>> differences;
    for (const VertexPair& pair : pairs) differences.push_back(difference(pair));
    Nearest<N> found = nearest(differences);
    Solution<N> solution;
    solution.distance2 = found.norm2;
    for (std::size_t i : found.subset) solution.pairs.push_back(pairs[i]);
    solution.weights = std::move(found.weights);
    solution.b_to_a = combination(solution, [&](const VertexPair& pair) { return difference(pair); });
    return solution;
  }

  Placed<N> a_, b_;
};

// --- The nearest facet of the difference body ------------------------------------------------------------------------------

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Filtered filtered(const Vec3& p) { return {p[0], p[1], p[2]}; }

/// The points that are vertices of their hull, whatever its dimension.
std::vector<Vec3> extreme(std::span<const Vec3> points) {
  std::vector<Filtered> all, kept;
  for (const Vec3& p : points) all.push_back(filtered(p));
  CGAL::extreme_points_3(all, std::back_inserter(kept));
  std::vector<Vec3> result;
  for (const Filtered& p : kept) result.emplace_back(p.x(), p.y(), p.z());
  return result;
}

using Lazy = CGAL::Lazy_exact_nt<Rational>;
using LazyPoint = CGAL::Simple_cartesian<Lazy>::Point_3;

Point<Rational> exactly(const LazyPoint& p) { return {p.x().exact(), p.y().exact(), p.z().exact()}; }

template <class N>
Point<N> operator-(const Point<N>& p, const Point<N>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
template <class N>
Point<N> cross(const Point<N>& p, const Point<N>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

std::vector<LazyPoint> differences(std::span<const Vec3> a, const Pose& a_in_world, std::span<const Vec3> b,
                                   const Pose& b_in_world) {
  const std::vector<Vec3> corners_a = extreme(a), corners_b = extreme(b);
  const Placed<Rational> placed_a(corners_a, a_in_world), placed_b(corners_b, b_in_world);
  std::vector<Point<Rational>> moved_b;
  for (std::uint32_t j = 0; j < corners_b.size(); ++j) moved_b.push_back(placed_b[j]);
  std::vector<LazyPoint> result;
  for (std::uint32_t i = 0; i < corners_a.size(); ++i) {
    const Point<Rational> p = placed_a[i];
    for (const Point<Rational>& q : moved_b) result.emplace_back(Lazy(p[0] - q[0]), Lazy(p[1] - q[1]), Lazy(p[2] - q[2]));
  }
  return result;
}

bool is_solid(const std::vector<LazyPoint>& points) {
  const LazyPoint& o = points[0];
  const auto find = [&](const auto& condition) { return std::find_if(points.begin(), points.end(), condition); };
  const auto p = find([&](const LazyPoint& x) { return x != o; });
  if (p == points.end()) return false;
  const auto q = find([&](const LazyPoint& x) { return !CGAL::collinear(o, *p, x); });
  return q != points.end() && find([&](const LazyPoint& x) { return !CGAL::coplanar(o, *p, *q, x); }) != points.end();
}

struct Depth {
  Rational square{0};
  Point<Rational> normal{};  ///< outward, any length
};

/// From the origin, which the hull of the points holds, to the nearest plane of a facet.
Depth depth_of_origin(const std::vector<LazyPoint>& points) {
  if (!is_solid(points)) return {};
  CGAL::Surface_mesh<LazyPoint> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::optional<Depth> least;
  for (const auto face : hull.faces()) {
    const auto h = hull.halfedge(face);
    const Point<Rational> p = exactly(hull.point(hull.source(h))), q = exactly(hull.point(hull.target(h))),
                          r = exactly(hull.point(hull.target(hull.next(h))));
    const Point<Rational> n = cross(q - p, r - p);
    const Rational along = dot(n, p);
    if (along < 0) throw std::logic_error("the minimum norm is 0, but the hull of the differences does not hold the origin");
    const Rational square = along * along / dot(n, n);
    if (!least || square < least->square) least = Depth{square, n};
  }
  return *least;
}

}  // namespace

Truth distance(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a) {
  assert(!a.empty() && !b.empty());
  const auto guess = Solver<double>(Placed<double>(a), {b, b_in_a}).solve({{0, 0}});
  const Solver<Rational> solver(Placed<Rational>(a), {b, b_in_a});
  const auto solution = solver.solve(guess.pairs);
  Truth truth;
  truth.overlapping = CGAL::sign(solution.distance2) == CGAL::ZERO;
  truth.bounds = square_root(solution.distance2);
  truth.distance = truth.bounds.lower;
  std::tie(truth.bounds2.lower, truth.bounds2.upper) = CGAL::to_interval(solution.distance2);
  truth.witness_a = rounded(solver.point_a(solution));
  truth.witness_b = rounded(solver.point_b(solution));
  if (!truth.overlapping) truth.normal = rounded_direction(opposite(solution.b_to_a)).stableNormalized();
  truth.exact = std::make_shared<const Exact>(Exact{solution.distance2});
  return truth;
}

SignedTruth signed_distance(std::span<const Vec3> a, const Pose& a_in_world, std::span<const Vec3> b, const Pose& b_in_world) {
  assert(!a.empty() && !b.empty());
  const auto guess = Solver<double>({a, a_in_world}, {b, b_in_world}).solve({{0, 0}});
  const auto solution = Solver<Rational>({a, a_in_world}, {b, b_in_world}).solve(guess.pairs);
  SignedTruth truth;
  Rational square = solution.distance2;
  Point<Rational> normal = opposite(solution.b_to_a);
  truth.sign = int(CGAL::sign(square));
  if (truth.sign == 0) {
    const Depth depth = depth_of_origin(differences(a, a_in_world, b, b_in_world));
    square = depth.square;
    normal = depth.normal;
    truth.sign = -int(CGAL::sign(square));
  }
  truth.bounds = square_root(square);
  if (truth.sign < 0) truth.bounds = {-truth.bounds.upper, -truth.bounds.lower};
  truth.distance = truth.sign < 0 ? truth.bounds.upper : truth.bounds.lower;
  if (truth.sign != 0) truth.normal = rounded_direction(normal).stableNormalized();
  truth.exact = std::make_shared<const Exact>(Exact{square});
  return truth;
}

int compare(const SignedTruth& truth, double x) {
  const int sign_x = x > 0 ? 1 : x < 0 ? -1 : 0;
  if (truth.sign != sign_x) return truth.sign < sign_x ? -1 : 1;
  if (std::isinf(x)) return -sign_x;
  const Rational& square = truth.exact->distance2;
  return sign_x * int(CGAL::compare(square, Rational(x) * Rational(x)));
}

std::string squared_text(const SignedTruth& truth) {
  std::ostringstream text;
  text << truth.exact->distance2.numerator();
  if (truth.exact->distance2.denominator() != 1) text << '/' << truth.exact->distance2.denominator();
  return text.str();
}

bool holds(const Truth& truth, double lower, double upper) {
  const Rational& distance2 = truth.exact->distance2;
  const bool above = lower <= 0 || (std::isfinite(lower) && Rational(lower) * Rational(lower) <= distance2);
  const bool below = upper >= 0 && (std::isinf(upper) || distance2 <= Rational(upper) * Rational(upper));
  return above && below;
}

Interval gap(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a, const Vec3& direction) {
  const Point<Rational> n = point<Rational>(direction);
  const Rational along = Solver<Rational>(Placed<Rational>(a), {b, b_in_a}).least_along(opposite(n));
  const Interval size = square_root(along * along / dot(n, n));
  return along >= 0 ? size : Interval{-size.upper, -size.lower};
}

// --- Convexity -------------------------------------------------------------------------------------------------------------

namespace {

// Every directed edge occurs once and so does its opposite; V - E + F = 2; every vertex is used.
bool is_closed_surface(std::size_t vertex_count, std::span<const Triangle> triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> used;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      used.insert(t[i]);
      if (!edges.insert({t[i], t[(i + 1) % 3]}).second) return false;
    }
  const bool paired = std::all_of(edges.begin(), edges.end(), [&](const auto& e) { return edges.count({e.second, e.first}); });
  return paired && used.size() == vertex_count && vertex_count + triangles.size() == edges.size() / 2 + 2;
}

}  // namespace

bool encloses(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const Vec3> points) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const Filtered p = filtered(vertices[t[0]]), q = filtered(vertices[t[1]]), r = filtered(vertices[t[2]]);
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& x) { return CGAL::orientation(p, q, r, filtered(x)) != CGAL::POSITIVE; });
  });
}

bool is_convex(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  const bool has_area = std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return CGAL::collinear(filtered(vertices[t[0]]), filtered(vertices[t[1]]), filtered(vertices[t[2]]));
  });
  return has_area && is_closed_surface(vertices.size(), triangles) && encloses(vertices, triangles, vertices);
}

}  // namespace swiftlet::oracle
