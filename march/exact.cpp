// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Expansions of fixed capacity: the sum of `count` doubles, none overlapping another, least first. Everything is on the stack.
#include "exact.h"

#include <cmath>

#include "double_double.h"
#include "tolerance.h"
#include "wide.h"

namespace swiftlet::exact {
namespace {

template <int N>
struct Expansion {
  int count = 0;
  double part[N];

  void push(double value) {
    if (value != 0) part[count++] = value;
  }
  int sign() const { return count == 0 ? 0 : part[count - 1] > 0 ? 1 : -1; }
};

/// e + b. [Shewchuk, Grow-Expansion] with zeros eliminated.
template <int N>
void grow(Expansion<N>& e, double b) {
  double carry = b;
  int kept = 0;
  for (int i = 0; i < e.count; ++i) {
    const Pair s = two_sum(carry, e.part[i]);
    if (s.low != 0) e.part[kept++] = s.low;
    carry = s.high;
  }
  if (carry != 0) e.part[kept++] = carry;
  e.count = kept;
}

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<N + M> sum;
  sum.count = a.count;
  for (int i = 0; i < a.count; ++i) sum.part[i] = a.part[i];
  for (int i = 0; i < b.count; ++i) grow(sum, b.part[i]);
  return sum;
}

template <int N>
Expansion<N> operator-(Expansion<N> a) {
  for (int i = 0; i < a.count; ++i) a.part[i] = -a.part[i];
  return a;
}

template <int N, int M>
Expansion<N + M> operator-(const Expansion<N>& a, const Expansion<M>& b) {
  return a + -b;
}

template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<2 * N * M> product;
  for (int i = 0; i < a.count; ++i) {
    for (int j = 0; j < b.count; ++j) {
      const Pair p = two_product(a.part[i], b.part[j]);
      grow(product, p.low);
      grow(product, p.high);
    }
  }
  return product;
}

Expansion<1> expansion(double value) {
  Expansion<1> e;
  e.push(value);
  return e;
}
Expansion<2> difference(double a, double b) {
  const Pair s = two_sum(a, -b);
  Expansion<2> e;
  e.push(s.low);
  e.push(s.high);
  return e;
}

template <int N>
using Expansion3 = std::array<Expansion<N>, 3>;

Expansion3<2> difference3(const double a[3], const double b[3]) {
  return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
}

template <int N, int M>
auto dot3(const Expansion3<N>& a, const Expansion3<M>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <int N, int M>
auto cross3(const Expansion3<N>& a, const Expansion3<M>& b) {
  return Expansion3<4 * N * M>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec subtract(const double a[3], const double b[3]) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec absolute(const Vec& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// The magnitude that bounds the rounding of a triple product of rounded differences.
double permanent(const Vec& u, const Vec& v, const Vec& w) {
  const Vec a = absolute(u), b = absolute(v), c = absolute(w);
  return (a.y * b.z + a.z * b.y) * c.x + (a.z * b.x + a.x * b.z) * c.y + (a.x * b.y + a.y * b.x) * c.z;
}

/// The sign of `value` if no error up to `bound` can change it, else 0.
int certain_sign(double value, double bound) { return value > bound ? 1 : value < -bound ? -1 : 0; }

/// b - a in two doubles per coordinate, exactly.
V3<DoubleDouble> wide_difference(const double b[3], const double a[3]) {
  return {two_sum(b[0], -a[0]), two_sum(b[1], -a[1]), two_sum(b[2], -a[2])};
}

/// The two largest parts of an expansion.
template <int N>
DoubleDouble leading(const Expansion<N>& e) {
  DoubleDouble sum(0);
  for (int i = e.count; i-- > 0 && i + 2 >= e.count;) sum = sum + DoubleDouble(e.part[i]);
  return sum;
}

/// a - (R b + t), one coordinate.
Expansion<8> offset(double a, const Vec& row, const double b[3], double t) {
  Expansion<8> e;
  grow(e, a);
  grow(e, -t);
  for (const auto& [r, x] : {Pair{row.x, b[0]}, Pair{row.y, b[1]}, Pair{row.z, b[2]}}) {
    const Pair p = two_product(-r, x);
    grow(e, p.low);
    grow(e, p.high);
  }
  return e;
}
Expansion3<8> offset3(const double a[3], const double b[3], const Motion& m) {
  return {offset(a[0], m.row_x, b, m.t.x), offset(a[1], m.row_y, b, m.t.y), offset(a[2], m.row_z, b, m.t.z)};
}

using Rows = std::array<Expansion3<1>, 3>;
Rows rows(const Motion& m) {
  const auto row = [](const Vec& r) { return Expansion3<1>{expansion(r.x), expansion(r.y), expansion(r.z)}; };
  return {row(m.row_x), row(m.row_y), row(m.row_z)};
}

/// R (w - v).
Expansion3<12> turned(const Motion& m, const double w[3], const double v[3]) {
  const Expansion3<2> d = difference3(w, v);
  const Rows r = rows(m);
  return {dot3(r[0], d), dot3(r[1], d), dot3(r[2], d)};
}

/// R u x R v is the matrix of R's cofactors times u x v, whatever R is.
Expansion3<384> turned_cross(const Motion& m, const double a[3], const double b[3], const double c[3]) {
  const Expansion3<16> n = cross3(difference3(b, a), difference3(c, a));
  const Rows r = rows(m);
  return {dot3(cross3(r[1], r[2]), n), dot3(cross3(r[2], r[0]), n), dot3(cross3(r[0], r[1]), n)};
}

template <int N>
Wide rounded(const Expansion3<N>& v) {
  const auto sum = [](const Expansion<N>& e) {
    DoubleDouble s;
    for (int i = 0; i < e.count; ++i) s = s + e.part[i];
    return s;
  };
  return {sum(v[0]), sum(v[1]), sum(v[2])};
}

}  // namespace

int orientation(const double a[3], const double b[3], const double c[3], const double d[3]) {
  const Vec u = subtract(b, a), v = subtract(c, a), w = subtract(d, a);
  const double magnitude = permanent(u, v, w);
  if (const int sign = certain_sign(dot(cross(u, v), w), kTripleProductError * magnitude)) return sign;
  const auto wide = dot(cross(wide_difference(b, a), wide_difference(c, a)), wide_difference(d, a));
  if (const int sign = certain_sign(double(wide), kWideTripleProductError * magnitude)) return sign;
  return dot3(cross3(difference3(b, a), difference3(c, a)), difference3(d, a)).sign();
}

bool collinear(const double a[3], const double b[3], const double c[3]) {
  const auto n = cross3(difference3(b, a), difference3(c, a));
  return n[0].sign() == 0 && n[1].sign() == 0 && n[2].sign() == 0;
}

Plane plane(const Vec& a, const Vec& b, const Vec& c) {
  const V3<DoubleDouble> u = wide_difference(&b.x, &a.x), v = wide_difference(&c.x, &a.x);
  V3<DoubleDouble> n = cross(u, v);
  const auto largest = [](const V3<DoubleDouble>& w) { return max_abs({w.x.high, w.y.high, w.z.high}); };
  if (largest(n) < kLeastWideArea * largest(u) * largest(v)) {
    const auto exact_n = cross3(difference3(&b.x, &a.x), difference3(&c.x, &a.x));
    n = {leading(exact_n[0]), leading(exact_n[1]), leading(exact_n[2])};
  }
  const Unit unit = unit_of({n.x.high, n.y.high, n.z.high});
  const V3<DoubleDouble> p{DoubleDouble(a.x), DoubleDouble(a.y), DoubleDouble(a.z)};
  return {unit.n, double(dot(n, p)) * unit.scale};
}

int compare_along(const double n[3], const double w[3], const double v[3]) {
  const Vec direction{n[0], n[1], n[2]}, e = subtract(w, v);
  if (const int sign = certain_sign(dot(direction, e), kDotError * dot(absolute(direction), absolute(e)))) return sign;
  return dot3(Expansion3<1>{expansion(n[0]), expansion(n[1]), expansion(n[2])}, difference3(w, v)).sign();
}

int compare_along_normal(const double a[3], const double b[3], const double c[3], const double w[3], const double v[3]) {
  const Vec p = subtract(b, a), q = subtract(c, a), e = subtract(w, v);
  if (const int sign = certain_sign(dot(cross(p, q), e), kTripleProductError * permanent(p, q, e))) return sign;
  return dot3(cross3(difference3(b, a), difference3(c, a)), difference3(w, v)).sign();
}

int compare_along_turned(const double n[3], const Motion& m, const double w[3], const double v[3]) {
  const Vec direction{n[0], n[1], n[2]}, e = subtract(w, v), a = absolute(e), b = absolute(direction);
  const double magnitude = b.x * dot(absolute(m.row_x), a) + b.y * dot(absolute(m.row_y), a) + b.z * dot(absolute(m.row_z), a);
  if (const int sign = certain_sign(dot(direction, turn(m, e)), kTurnedDotError * magnitude)) return sign;
  const Expansion3<2> d = difference3(w, v);
  const auto row = [&](const Vec& r) { return dot3(Expansion3<1>{expansion(r.x), expansion(r.y), expansion(r.z)}, d); };
  return (expansion(n[0]) * row(m.row_x) + expansion(n[1]) * row(m.row_y) + expansion(n[2]) * row(m.row_z)).sign();
}

int triple_product(const std::array<const double*, 3>& a, const std::array<const double*, 3>& b, const Motion& m) {
  // With the first and last less the middle one, which leaves no more of a body than the difference of two of its vertices:
  // of the facets of a body far away from the other such are all that doubles see.
  const auto in_doubles = [](const double* p) { return Vec{p[0], p[1], p[2]}; };
  const auto less_middle = [&](std::size_t k) { return subtract(a[k], a[1]) - turn(m, subtract(b[k], b[1])); };
  const auto turned_size = [&](const Vec& v) {
    const Vec size = absolute(v);
    return Vec{dot(absolute(m.row_x), size), dot(absolute(m.row_y), size), dot(absolute(m.row_z), size)};
  };
  const auto size_less_middle = [&](std::size_t k) {
    return absolute(subtract(a[k], a[1])) + turned_size(subtract(b[k], b[1]));
  };
  const Vec va = in_doubles(a[1]), vb = in_doubles(b[1]);
  const double most = permanent(size_less_middle(0), absolute(va) + absolute(m.t) + turned_size(vb), size_less_middle(2));
  const double value = dot(cross(less_middle(0), va - apply(m, vb)), less_middle(2));
  if (const int sign = certain_sign(value, kOffsetTripleProductError * most)) return sign;
  const auto wide_less_middle = [&](std::size_t k) {
    const Wide d = wide(in_doubles(b[k])) - wide(vb);
    return wide(in_doubles(a[k])) - wide(va) - Wide{dot(wide(m.row_x), d), dot(wide(m.row_y), d), dot(wide(m.row_z), d)};
  };
  const double wide_value = double(dot(cross(wide_less_middle(0), wide(va) - wide(m, vb)), wide_less_middle(2)));
  if (const int sign = certain_sign(wide_value, kWideOffsetTripleProductError * most)) return sign;
  return dot3(cross3(offset3(a[0], b[0], m), offset3(a[1], b[1], m)), offset3(a[2], b[2], m)).sign();
}

int compare_turned_along_normal(const double a[3], const double b[3], const double c[3], const Motion& m, const double w[3],
                                const double v[3]) {
  return dot3(cross3(difference3(b, a), difference3(c, a)), turned(m, w, v)).sign();
}

int compare_along_turned_normal(const Motion& m, const double a[3], const double b[3], const double c[3], const double w[3],
                                const double v[3]) {
  return dot3(turned_cross(m, a, b, c), difference3(w, v)).sign();
}

Wide turned_normal(const Motion& m, const double a[3], const double b[3], const double c[3]) {
  return rounded(turned_cross(m, a, b, c));
}

Wide edge_normal(const double a[3], const double b[3], const Motion& m, const double w[3], const double v[3]) {
  return rounded(cross3(difference3(b, a), turned(m, w, v)));
}

bool tetrahedron_holds_origin(const std::array<std::array<double, 3>, 4>& a, const std::array<std::array<double, 3>, 4>& b,
                              const Motion& m) {
  // With p_k = a_k - (R b_k + t), the origin's barycentric coordinates are triple products of the p's over their sum.
  std::array<Vec, 4> p;
  std::array<Vec, 4> size;  // |a| + |R| |b| + |t|, which scales the rounding of p
  for (int k = 0; k < 4; ++k) {
    const Vec va{a[k][0], a[k][1], a[k][2]}, vb{b[k][0], b[k][1], b[k][2]}, ab = absolute(vb);
    p[k] = va - apply(m, vb);
    size[k] =
        absolute(va) + absolute(m.t) + Vec{dot(absolute(m.row_x), ab), dot(absolute(m.row_y), ab), dot(absolute(m.row_z), ab)};
  }
  constexpr int kFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};  // opposite point k, counter-clockwise from outside
  std::array<int, 4> sign;
  bool certain = true;
  for (int k = 0; k < 4; ++k) {
    const auto [i, j, l] = kFace[k];
    sign[k] = certain_sign(dot(cross(p[i], p[j]), p[l]), kOffsetTripleProductError * permanent(size[i], size[j], size[l]));
    certain = certain && sign[k] != 0;
  }
  if (!certain) {
    std::array<Expansion3<8>, 4> e;
    for (int k = 0; k < 4; ++k) {
      e[k] = offset3(a[k].data(), b[k].data(), m);
    }
    bool flat = true;
    for (int k = 0; k < 4; ++k) {
      const auto [i, j, l] = kFace[k];
      sign[k] = dot3(cross3(e[i], e[j]), e[l]).sign();
      flat = flat && sign[k] == 0;
    }
    if (flat) return false;  // coplanar with the origin, or all four on planes through it
  }
  // The four products sum to six times the volume: with none of the opposite sign, the origin is inside or on the boundary.
  const bool any_positive = sign[0] > 0 || sign[1] > 0 || sign[2] > 0 || sign[3] > 0;
  const bool any_negative = sign[0] < 0 || sign[1] < 0 || sign[2] < 0 || sign[3] < 0;
  return any_positive != any_negative;
}

}  // namespace swiftlet::exact
