// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Knows exact numbers and one algorithm for bodies apart, the minimum-norm point of the difference body by growing and
// shrinking a simplex of vertex pairs. Run in double it is a guess where to start; run in dyadic numbers every comparison is
// exact, each round strictly nearer, the simplices finitely many: it ends at the truth. How deep bodies overlap is the nearest
// facet of the difference body, whose hull CGAL computes exactly.
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
#include <CGAL/Gmpzf.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace swiftlet::oracle {

using Rational = CGAL::Gmpq;
/// Sums and products of doubles: an integer times a power of two, where a rational would look for common divisors each time.
using Dyadic = CGAL::Gmpzf;

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

Rational rational(const Dyadic& x) {
  Rational result;
  mpz_set(mpq_numref(result.mpq()), x.man());
  if (x.exp() >= 0)
    mpq_mul_2exp(result.mpq(), result.mpq(), mp_bitcnt_t(x.exp()));
  else
    mpq_div_2exp(result.mpq(), result.mpq(), mp_bitcnt_t(-x.exp()));
  return result;
}
Point<Rational> rational(const Point<Dyadic>& p) { return {rational(p[0]), rational(p[1]), rational(p[2])}; }

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

// The same, each coordinate cut to 53 bits.
Vec3 rounded_direction(const Point<Dyadic>& direction) {
  std::array<std::pair<double, long>, 3> parts;
  std::optional<long> exponent;
  for (std::size_t i = 0; i < 3; ++i) {
    parts[i] = direction[i].to_double_exp();
    if (parts[i].first != 0) exponent = std::max(exponent.value_or(parts[i].second), parts[i].second);
  }
  Vec3 n = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    if (parts[i].first != 0) n[int(i)] = std::ldexp(parts[i].first, int(std::max(parts[i].second - *exponent, -2000l)));
  return n;
}

// Exact: doubles only sort out what cannot be the answer. Rounding the direction costs 2^-52 of each coordinate, the products
// and sums less than 3 * 2^-53 of the sum of their absolute values: 2^-50 of it covers both. The last term is underflow.
std::uint32_t support(std::span<const Vec3> points, const Point<Dyadic>& direction) {
  const Vec3 n = rounded_direction(direction);
  std::vector<double> along(points.size());
  double greatest = -std::numeric_limits<double>::infinity(), extent = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    greatest = std::max(greatest, along[i] = points[i].dot(n));
    extent = std::max(extent, points[i].lpNorm<Eigen::Infinity>());
  }
  const double error = std::ldexp(n.lpNorm<1>() * extent, -50) + 8 * std::numeric_limits<double>::denorm_min();
  std::optional<std::uint32_t> best;
  Dyadic best_along;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (along[i] < greatest - 2 * error) continue;
    const Dyadic exactly = dot(direction, point<Dyadic>(points[i]));
    if (best && exactly <= best_along) continue;
    best = i;
    best_along = exactly;
  }
  return *best;
}

// --- The nearest point of a simplex ----------------------------------------------------------------------------------------

template <class N>
using Matrix = std::vector<std::vector<N>>;

/// x = numerators / denominator, the denominator above 0.
template <class N>
struct Fractions {
  std::vector<N> numerators;
  N denominator;
};

// Solves m x = y by elimination; m is symmetric and semidefinite, nothing comes back when it is singular.
std::optional<Fractions<double>> solved(Matrix<double> m, std::vector<double> y) {
  const std::size_t n = y.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!(m[k][k] > 0)) return std::nullopt;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < n; ++j) m[i][j] = m[i][j] - factor * m[k][j];
      y[i] = y[i] - factor * y[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) y[k] = y[k] - m[k][j] * y[j];
    y[k] = y[k] / m[k][k];
  }
  return Fractions<double>{std::move(y), 1};
}

// Of no more than three rows, along the first.
Dyadic determinant(const Matrix<Dyadic>& m) {
  if (m.empty()) return 1;
  if (m.size() == 1) return m[0][0];
  if (m.size() == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// The same by Cramer's rule, which needs no division.
std::optional<Fractions<Dyadic>> solved(const Matrix<Dyadic>& m, const std::vector<Dyadic>& y) {
  Fractions<Dyadic> x{{}, determinant(m)};
  if (CGAL::sign(x.denominator) != CGAL::POSITIVE) return std::nullopt;
  for (std::size_t k = 0; k < y.size(); ++k) {
    Matrix<Dyadic> replaced = m;
    for (std::size_t i = 0; i < y.size(); ++i) replaced[i][k] = y[i];
    x.numerators.push_back(determinant(replaced));
  }
  return x;
}

// Weights of the point nearest to the origin in the affine hull of the points `subset`, whose dot products are `gram`; nothing
// when the points are affinely dependent.
template <class N>
std::optional<Fractions<N>> affine_weights(const Matrix<N>& gram, const std::vector<std::size_t>& subset) {
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
  std::optional<Fractions<N>> weights = solved(std::move(edges), std::move(towards));
  if (!weights) return std::nullopt;
  N first = weights->denominator;
  for (const N& w : weights->numerators) first = first - w;
  weights->numerators.insert(weights->numerators.begin(), first);
  return weights;
}

/// The square is norm2 / weights.denominator.
template <class N>
struct Nearest {
  N norm2;
  std::vector<std::size_t> subset;  ///< the points that span it, all with positive weights
  Fractions<N> weights;
};

// Every point of the simplex lies beyond the plane through the nearest point, perpendicular to it.
template <class N>
bool is_nearest(const Matrix<N>& gram, const Nearest<N>& candidate) {
  return std::all_of(gram.begin(), gram.end(), [&](const std::vector<N>& row) {
    N along(0);
    for (std::size_t j = 0; j < candidate.subset.size(); ++j)
      along = along + row[candidate.subset[j]] * candidate.weights.numerators[j];
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
    auto weights = affine_weights(gram, subset);
    if (!weights) continue;
    const std::vector<N>& w = weights->numerators;
    if (!std::all_of(w.begin(), w.end(), [](const N& x) { return x > N(0); })) continue;
    N norm2(0);  // the nearest point's dot product with each point of its subset is the same
    for (std::size_t j = 0; j < subset.size(); ++j) norm2 = norm2 + gram[subset[0]][subset[j]] * w[j];
    Nearest<N> candidate{norm2, subset, std::move(*weights)};
    if (best && candidate.norm2 * best->weights.denominator >= best->norm2 * candidate.weights.denominator) continue;
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
  N norm2{0};       ///< of the nearest point of A - B, times the weights' denominator
  Point<N> b_to_a;  ///< that point, times the same
  std::vector<VertexPair> pairs;
  Fractions<N> weights;  ///< one per pair: nearest points are the same combination of their vertices

  bool is_as_far_as(const Solution& other) const {
    return norm2 * other.weights.denominator >= other.norm2 * weights.denominator;
  }
};

Rational distance2(const Solution<Dyadic>& solution) {
  return rational(solution.norm2) / rational(solution.weights.denominator);
}

template <class N>
class Solver {
 public:
  Solver(Placed<N> a, Placed<N> b) : a_(std::move(a)), b_(std::move(b)) {}

  // Of exact numbers neither a repeated pair nor a standstill can occur before the end; in double they are the end.
  Solution<N> solve(std::vector<VertexPair> pairs) const {
    std::optional<Solution<N>> solution;
    for (;;) {
      Solution<N> next = nearest_of(pairs);
      if (solution && next.is_as_far_as(*solution)) return *solution;
      solution = std::move(next);
      if (!(solution->norm2 > N(0))) return *solution;
      const VertexPair w = support_pair(solution->b_to_a);
      const auto& kept = solution->pairs;
      if (std::find(kept.begin(), kept.end(), w) != kept.end() || dot(solution->b_to_a, difference(w)) >= solution->norm2)
        return *solution;
      pairs = kept;
      pairs.push_back(w);
    }
  }

  /// Times the weights' denominator.
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
      for (int k = 0; k < 3; ++k) sum[k] = sum[k] + solution.weights.numerators[i] * p[k];
    }
    return sum;
  }

  Solution<N> nearest_of(const std::vector<VertexPair>& pairs) const {
    std::vector<Point<N>> differences;
    for (const VertexPair& pair : pairs) differences.push_back(difference(pair));
    Nearest<N> found = nearest(differences);
    Solution<N> solution;
    solution.norm2 = found.norm2;
    for (std::size_t i : found.subset) solution.pairs.push_back(pairs[i]);
    solution.weights = std::move(found.weights);
    solution.b_to_a = combination(solution, [&](const VertexPair& pair) { return difference(pair); });
    return solution;
  }

  Placed<N> a_, b_;
};

/// A point times the denominator, as it is.
Point<Rational> divided(const Point<Dyadic>& p, const Solution<Dyadic>& solution) {
  const Rational by = rational(solution.weights.denominator);
  return {rational(p[0]) / by, rational(p[1]) / by, rational(p[2]) / by};
}

// --- What doubles of more bits show by themselves ---------------------------------------------------------------------------

using Extended = long double;
constexpr Extended kEps = std::numeric_limits<Extended>::epsilon();
/// Of at least 64 bits, and sums of products of doubles neither overflow nor vanish.
constexpr bool kIsExtended =
    std::numeric_limits<Extended>::digits >= 64 && std::numeric_limits<Extended>::max_exponent >= 16384;

/// Whether the points that a solution in doubles combines, its weights taken as they are, surely lie within the bound of each
/// other. A coordinate of a difference is off by less than 3 eps of the absolute values that it is summed from, their weighted
/// sum by 2 more; root, sum of weights and quotient by less than 8 of the result. Twice that covers this sum's own rounding.
bool surely_within(const Solution<double>& guess, std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a,
                   double bound) {
  Point<Extended> sum{};
  Extended weights = 0, largest = 0;
  for (std::size_t i = 0; i < guess.pairs.size(); ++i) {
    const Extended weight = guess.weights.numerators[i];
    weights += weight;
    for (int c = 0; c < 3; ++c) {
      const Extended p = a[guess.pairs[i].a][c], t = b_in_a.translation[c];
      Extended difference = p - t, absolute = std::fabs(p) + std::fabs(t);
      for (int k = 0; k < 3; ++k) {
        const Extended product = Extended(b_in_a.rotation(c, k)) * b[guess.pairs[i].b][k];
        difference -= product, absolute += std::fabs(product);
      }
      sum[std::size_t(c)] += weight * difference;
      largest = std::max(largest, absolute);
    }
  }
  return std::sqrt(dot(sum, sum)) / weights * (1 + 16 * kEps) + 32 * kEps * largest <= bound;
}

/// Whether the gap surely is at least so wide. It is off by less than 8 eps of the absolute values that it is summed from, the
/// direction's length by less than 4 of itself.
bool surely_apart(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a, const Vec3& direction, double least) {
  Point<Extended> n{}, n_b{};
  Extended shift = 0, length1 = 0, stretch = 0, extent = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    n[c] = direction[int(c)];
    shift += n[c] * b_in_a.translation[int(c)];
    length1 += std::fabs(n[c]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      n_b[k] += n[c] * b_in_a.rotation(int(c), int(k));
      stretch = std::max(stretch, std::fabs(Extended(b_in_a.rotation(int(c), int(k)))));
    }
  }
  const auto along = [&](const Point<Extended>& m, const Vec3& p, Extended factor) {
    for (const double x : p) extent = std::max(extent, factor * std::fabs(Extended(x)));
    return m[0] * p[0] + m[1] * p[1] + m[2] * p[2];
  };
  Extended most = -std::numeric_limits<Extended>::infinity(), fewest = -most;
  for (const Vec3& p : a) most = std::max(most, along(n, p, 1));
  for (const Vec3& p : b) fewest = std::min(fewest, along(n_b, p, 3 * stretch));
  const Extended size = length1 * (2 * extent + b_in_a.translation.lpNorm<Eigen::Infinity>());
  const Extended wanted = least * std::sqrt(dot(n, n));
  return shift + fewest - most - 16 * kEps * size >= wanted + 8 * kEps * std::fabs(wanted);
}

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

using Lazy = CGAL::Lazy_exact_nt<Dyadic>;
using LazyPoint = CGAL::Simple_cartesian<Lazy>::Point_3;

Point<Dyadic> exactly(const LazyPoint& p) { return {p.x().exact(), p.y().exact(), p.z().exact()}; }

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
  const Placed<Dyadic> placed_a(corners_a, a_in_world), placed_b(corners_b, b_in_world);
  std::vector<Point<Dyadic>> moved_b;
  for (std::uint32_t j = 0; j < corners_b.size(); ++j) moved_b.push_back(placed_b[j]);
  std::vector<LazyPoint> result;
  for (std::uint32_t i = 0; i < corners_a.size(); ++i) {
    const Point<Dyadic> p = placed_a[i];
    for (const Point<Dyadic>& q : moved_b) result.emplace_back(Lazy(p[0] - q[0]), Lazy(p[1] - q[1]), Lazy(p[2] - q[2]));
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
  Point<Dyadic> normal{};  ///< outward, any length
};

/// From the origin, which the hull of the points holds, to the nearest plane of a facet.
Depth depth_of_origin(const std::vector<LazyPoint>& points) {
  if (!is_solid(points)) return {};
  CGAL::Surface_mesh<LazyPoint> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::optional<Depth> least;
  for (const auto face : hull.faces()) {
    const auto h = hull.halfedge(face);
    const Point<Dyadic> p = exactly(hull.point(hull.source(h))), q = exactly(hull.point(hull.target(h))),
                        r = exactly(hull.point(hull.target(hull.next(h))));
    const Point<Dyadic> n = cross(q - p, r - p);
    const Dyadic along = dot(n, p);
    if (along < 0) throw std::logic_error("the minimum norm is 0, but the hull of the differences does not hold the origin");
    const Rational square = rational(along * along) / rational(dot(n, n));
    if (!least || square < least->square) least = Depth{square, n};
  }
  return *least;
}

}  // namespace

Truth distance(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a) {
  assert(!a.empty() && !b.empty());
  const auto guess = Solver<double>(Placed<double>(a), {b, b_in_a}).solve({{0, 0}});
  const Solver<Dyadic> solver(Placed<Dyadic>(a), {b, b_in_a});
  const auto solution = solver.solve(guess.pairs);
  const Rational square = distance2(solution);
  Truth truth;
  truth.overlapping = CGAL::sign(square) == CGAL::ZERO;
  truth.bounds = square_root(square);
  truth.distance = truth.bounds.lower;
  std::tie(truth.bounds2.lower, truth.bounds2.upper) = CGAL::to_interval(square);
  truth.witness_a = rounded(divided(solver.point_a(solution), solution));
  truth.witness_b = rounded(divided(solver.point_b(solution), solution));
  if (!truth.overlapping) truth.normal = rounded_direction(opposite(divided(solution.b_to_a, solution))).stableNormalized();
  truth.exact = std::make_shared<const Exact>(Exact{square});
  return truth;
}

SignedTruth signed_distance(std::span<const Vec3> a, const Pose& a_in_world, std::span<const Vec3> b, const Pose& b_in_world) {
  assert(!a.empty() && !b.empty());
  const auto guess = Solver<double>({a, a_in_world}, {b, b_in_world}).solve({{0, 0}});
  const auto solution = Solver<Dyadic>({a, a_in_world}, {b, b_in_world}).solve(guess.pairs);
  SignedTruth truth;
  Rational square = distance2(solution);
  Point<Rational> normal = opposite(divided(solution.b_to_a, solution));
  truth.sign = int(CGAL::sign(square));
  if (truth.sign == 0) {
    const Depth depth = depth_of_origin(differences(a, a_in_world, b, b_in_world));
    square = depth.square;
    normal = rational(depth.normal);
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
  if (x < truth.bounds.lower) return 1;
  if (x > truth.bounds.upper) return -1;
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
  // No double lies between the bounds.
  return lower <= truth.bounds.lower && upper >= truth.bounds.upper;
}

bool is_within(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a, double bound) {
  assert(!a.empty() && !b.empty());
  const auto guess = Solver<double>(Placed<double>(a), {b, b_in_a}).solve({{0, 0}});
  if (kIsExtended && surely_within(guess, a, b, b_in_a, bound)) return true;
  const Rational square = distance2(Solver<Dyadic>(Placed<Dyadic>(a), {b, b_in_a}).solve(guess.pairs));
  return bound >= square_root(square).upper;
}

bool is_apart_along(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a, const Vec3& direction, double least) {
  if (kIsExtended && surely_apart(a, b, b_in_a, direction, least)) return true;
  return least <= gap(a, b, b_in_a, direction).lower;
}

Interval gap(std::span<const Vec3> a, std::span<const Vec3> b, const Pose& b_in_a, const Vec3& direction) {
  const Point<Dyadic> n = point<Dyadic>(direction);
  const Dyadic along = Solver<Dyadic>(Placed<Dyadic>(a), {b, b_in_a}).least_along(opposite(n));
  const Interval size = square_root(rational(along * along) / rational(dot(n, n)));
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
