// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Expansions [Shewchuk 1997]: a number is the sum of few doubles that do not overlap, the least first. All are on the stack.
#include "numeric/exact.h"

#include <algorithm>
#include <cmath>

#include "numeric/double_double.h"
#include "numeric/tolerance.h"
#include "numeric/wide.h"

namespace swiftlet::exact {
namespace {

/// An exact number: the sum of at most `kParts` doubles.
template <int kParts>
class ExpansionOf {
 public:
  ExpansionOf() = default;
  explicit ExpansionOf(double value) { *this += value; }

  int sign() const { return count_ == 0 ? 0 : part_[count_ - 1] > 0 ? 1 : -1; }
  /// The number rounded to 100 bits.
  DoubleDouble rounded() const {
    DoubleDouble sum(0);
    for (int i = count_; i-- > 0;) sum = sum + DoubleDouble(part_[i]);
    return sum;
  }

  /// The number rounded up to a double. The parts below the last sum up to less than its ulp.
  double rounded_up() const {
    if (count_ == 0) return 0;
    const double last = part_[count_ - 1];
    return count_ > 1 && part_[count_ - 2] > 0 ? next_above(last) : last;
  }

  /// [Shewchuk 1997, Grow-Expansion] with zeros eliminated.
  ExpansionOf& operator+=(double b) {
    if (count_ == kParts) compress();
    double carry = b;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const HighLow s = two_sum(carry, part_[i]);
      if (s.low != 0) part_[kept++] = s.low;
      carry = s.high;
    }
    if (carry != 0) part_[kept++] = carry;
    count_ = kept;
    return *this;
  }
  ExpansionOf& operator+=(HighLow b) { return *this += b.low, *this += b.high; }
  /// Adds a * b, or subtracts it.
  template <int kPartsOfA, int kPartsOfB>
  void add_product(const ExpansionOf<kPartsOfA>& a, const ExpansionOf<kPartsOfB>& b, int sign = 1) {
    for (int i = 0; i < a.count_; ++i) {
      for (int j = 0; j < b.count_; ++j) *this += two_product(sign * a.part_[i], b.part_[j]);
    }
    compress();
  }

 private:
  /// [Shewchuk 1997, Compress].
  void compress() {
    if (count_ < 2) return;
    int bottom = count_ - 1;
    double carry = part_[bottom];
    for (int i = bottom; i-- > 0;) {
      const HighLow s = quick_two_sum(carry, part_[i]);
      carry = s.high;
      if (s.low != 0) part_[bottom--] = s.high, carry = s.low;
    }
    part_[bottom] = carry;
    int kept = 0;
    for (int i = bottom + 1; i < count_; ++i) {
      const HighLow s = quick_two_sum(part_[i], carry);
      if (s.low != 0) part_[kept++] = s.low;
      carry = s.high;
    }
    part_[kept++] = carry;
    count_ = kept;
  }

  template <int>
  friend class ExpansionOf;
  int count_ = 0;
  double part_[kParts];
};
/// The 2 098 bits of the range of doubles fit in so many parts, because each part of a compressed expansion but the last has 52
/// bits below it.
constexpr int kMostParts = 48;
/// Room for a sum of so many doubles.
template <int kDoubles>
using SumOf = ExpansionOf<std::min(kDoubles, kMostParts)>;

SumOf<2> difference(double a, double b) {
  SumOf<2> e;
  return e += two_sum(a, -b);
}

template <int kParts>
using Expansion3 = std::array<ExpansionOf<kParts>, 3>;

Expansion3<1> exactly(const Vec& v) { return {SumOf<1>(v.x), SumOf<1>(v.y), SumOf<1>(v.z)}; }
Expansion3<2> difference3(const double a[3], const double b[3]) {
  return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
}
template <int kPartsOfA, int kPartsOfB>
auto dot3(const Expansion3<kPartsOfA>& a, const Expansion3<kPartsOfB>& b) {
  SumOf<3 * 2 * kPartsOfA * kPartsOfB> sum;
  for (std::size_t k = 0; k < 3; ++k) sum.add_product(a[k], b[k]);
  return sum;
}
template <int kPartsOfA, int kPartsOfB>
auto cross3(const Expansion3<kPartsOfA>& a, const Expansion3<kPartsOfB>& b) {
  std::array<SumOf<2 * 2 * kPartsOfA * kPartsOfB>, 3> product;
  for (std::size_t k = 0; k < 3; ++k) {
    product[k].add_product(a[(k + 1) % 3], b[(k + 2) % 3]);
    product[k].add_product(a[(k + 2) % 3], b[(k + 1) % 3], -1);
  }
  return product;
}

Vec subtract(const double a[3], const double b[3]) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec absolute(const Vec& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// The sum of the magnitudes of the terms of u x v . w. The rounding error of that triple product is relative to it.
double permanent(const Vec& u, const Vec& v, const Vec& w) {
  const Vec a = absolute(u), b = absolute(v), c = absolute(w);
  return (a.y * b.z + a.z * b.y) * c.x + (a.z * b.x + a.x * b.z) * c.y + (a.x * b.y + a.y * b.x) * c.z;
}

/// The sign of `value` if no error up to `bound`, nor the underflow of products, can change it; else 0.
int certain_sign(double value, double bound) {
  bound += kUnderflow;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

/// b - a in two doubles per coordinate, exactly.
V3<DoubleDouble> wide_difference(const double b[3], const double a[3]) {
  return {two_sum(b[0], -a[0]), two_sum(b[1], -a[1]), two_sum(b[2], -a[2])};
}

/// p q - r s, exactly: eight products of two parts each.
SumOf<16> determinant(const DoubleDouble& p, const DoubleDouble& q, const DoubleDouble& r, const DoubleDouble& s) {
  SumOf<16> sum;
  for (const auto& [f, g] : {std::pair{p, q}, std::pair{r, -s}}) {
    for (const double x : {f.low, f.high}) sum += two_product(x, g.low), sum += two_product(x, g.high);
  }
  return sum;
}
/// The same rounded to 100 bits. Its stack is that of one short expansion: manifolds need planes where their own is deepest.
[[gnu::noinline]] DoubleDouble rounded_determinant(const DoubleDouble& p, const DoubleDouble& q, const DoubleDouble& r,
                                                   const DoubleDouble& s) {
  return determinant(p, q, r, s).rounded();
}

/// a - (R b + t), times 2^exponent, exactly.
Expansion3<8> offset3(const double a[3], const double b[3], const Motion& m, int exponent) {
  const auto scaled = [exponent](double x) { return times_power_of_two(x, exponent); };
  const auto coordinate = [&](double from, const Vec& row, double t) {
    SumOf<8> e(scaled(from));
    e += -scaled(t);
    for (const auto& [r, x] : {HighLow{row.x, b[0]}, HighLow{row.y, b[1]}, HighLow{row.z, b[2]}})
      e += two_product(-r, scaled(x));
    return e;
  };
  return {coordinate(a[0], m.row_x, m.t.x), coordinate(a[1], m.row_y, m.t.y), coordinate(a[2], m.row_z, m.t.z)};
}

/// (a - c) - R (b - d), times 2^exponent, exactly.
Expansion3<14> way3(const double a[3], const double c[3], const double b[3], const double d[3], const Motion& m, int exponent) {
  const auto scaled = [exponent](double x, double y) {
    return two_sum(times_power_of_two(x, exponent), -times_power_of_two(y, exponent));
  };
  const auto coordinate = [&](HighLow of_a, const Vec& row) {
    SumOf<14> e;
    e += of_a;
    for (const auto& [r, x] :
         {std::pair{row.x, scaled(b[0], d[0])}, std::pair{row.y, scaled(b[1], d[1])}, std::pair{row.z, scaled(b[2], d[2])}})
      e += two_product(-r, x.low), e += two_product(-r, x.high);
    return e;
  };
  return {coordinate(scaled(a[0], c[0]), m.row_x), coordinate(scaled(a[1], c[1]), m.row_y),
          coordinate(scaled(a[2], c[2]), m.row_z)};
}

/// The sign of the determinant of the three a[k] - (R b[k] + t), computed at a scale where products of three coordinates stay
/// far from the ends of the range of doubles. The middle difference is subtracted from the others, so that no product has two
/// factors of the translation, however small that is beside the bodies.
int offset_determinant_sign(const std::array<const double*, 3>& a, const std::array<const double*, 3>& b, const Motion& m) {
  double largest = max_abs(m.t);
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis : {0, 1, 2}) largest = max(largest, max(std::fabs(a[k][axis]), std::fabs(b[k][axis])));
  }
  if (largest == 0) return 0;
  const int exponent = kProductExponent - exponent_of(largest);
  const auto less_middle = [&](std::size_t k) { return way3(a[k], a[1], b[k], b[1], m, exponent); };
  return dot3(cross3(less_middle(0), offset3(a[1], b[1], m, exponent)), less_middle(2)).sign();
}

/// R (w - v).
auto rotated(const Motion& m, const double w[3], const double v[3]) {
  const auto d = difference3(w, v);
  return std::array{dot3(exactly(m.row_x), d), dot3(exactly(m.row_y), d), dot3(exactly(m.row_z), d)};
}

/// R (b - a) x R (c - a), computed as the matrix of R's cofactors times (b - a) x (c - a), to which it is equal for any R.
auto turned_cross(const Motion& m, const double a[3], const double b[3], const double c[3]) {
  const auto n = cross3(difference3(b, a), difference3(c, a));
  const auto coordinate = [&](const Vec& row, const Vec& other) { return dot3(cross3(exactly(row), exactly(other)), n); };
  return std::array{coordinate(m.row_y, m.row_z), coordinate(m.row_z, m.row_x), coordinate(m.row_x, m.row_y)};
}

template <int kParts>
Wide rounded(const Expansion3<kParts>& v) {
  return {v[0].rounded(), v[1].rounded(), v[2].rounded()};
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
  const Vec u = subtract(b, a), v = subtract(c, a), rough = cross(u, v);
  const auto certain = [](double coordinate, double p, double q) {
    return certain_sign(coordinate, kCrossProductError * (std::fabs(p) + std::fabs(q))) != 0;
  };
  if (certain(rough.x, u.y * v.z, u.z * v.y) || certain(rough.y, u.z * v.x, u.x * v.z) ||
      certain(rough.z, u.x * v.y, u.y * v.x))
    return false;
  const V3<DoubleDouble> p = wide_difference(b, a), q = wide_difference(c, a);
  return determinant(p.y, q.z, p.z, q.y).sign() == 0 && determinant(p.z, q.x, p.x, q.z).sign() == 0 &&
         determinant(p.x, q.y, p.y, q.x).sign() == 0;
}

Plane plane(const Vec& a, const Vec& b, const Vec& c) {
  return plane(a, wide_difference(&b.x, &a.x), wide_difference(&c.x, &a.x));
}

Plane plane(const Vec& p, const Wide& u, const Wide& v) {
  Wide n = cross(u, v);
  const auto largest = [](const Wide& w) { return max_abs({w.x.high, w.y.high, w.z.high}); };
  if (largest(n) < kLeastWideArea * largest(u) * largest(v)) {
    n = {rounded_determinant(u.y, v.z, u.z, v.y), rounded_determinant(u.z, v.x, u.x, v.z),
         rounded_determinant(u.x, v.y, u.y, v.x)};
  }
  const Unit unit = unit_of({n.x.high, n.y.high, n.z.high});
  return {unit.n, double(dot(n, wide(p))) * unit.scale};
}

int compare_along(const double n[3], const double w[3], const double v[3]) {
  const Vec direction{n[0], n[1], n[2]}, e = subtract(w, v);
  if (const int sign = certain_sign(dot(direction, e), kDotError * dot(absolute(direction), absolute(e)))) return sign;
  return dot3(exactly(direction), difference3(w, v)).sign();
}

double height_along(const double n[3], const double w[3], const double v[3]) {
  return dot3(exactly({n[0], n[1], n[2]}), difference3(w, v)).rounded_up();
}

int compare_along_normal(const double a[3], const double b[3], const double c[3], const double w[3], const double v[3]) {
  const Vec p = subtract(b, a), q = subtract(c, a), e = subtract(w, v);
  if (const int sign = certain_sign(dot(cross(p, q), e), kTripleProductError * permanent(p, q, e))) return sign;
  return dot3(cross3(difference3(b, a), difference3(c, a)), difference3(w, v)).sign();
}

int compare_along_turned(const double n[3], const Motion& m, const double w[3], const double v[3]) {
  const Vec direction{n[0], n[1], n[2]}, e = subtract(w, v), a = absolute(e), b = absolute(direction);
  const double magnitude = b.x * dot(absolute(m.row_x), a) + b.y * dot(absolute(m.row_y), a) + b.z * dot(absolute(m.row_z), a);
  if (const int sign = certain_sign(dot(direction, rotate(m, e)), kTurnedDotError * magnitude)) return sign;
  return dot3(exactly(direction), rotated(m, w, v)).sign();
}

int triple_product(const std::array<const double*, 3>& a, const std::array<const double*, 3>& b, const Motion& m) {
  // The middle difference is subtracted from the first and the last. The determinant keeps its value, and these two then hold
  // only differences of vertices of the same body: where the bodies are far apart, doubles resolve a facet by nothing else.
  const auto in_doubles = [](const double* p) { return Vec{p[0], p[1], p[2]}; };
  const auto less_middle = [&](std::size_t k) { return subtract(a[k], a[1]) - rotate(m, subtract(b[k], b[1])); };
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
  return offset_determinant_sign(a, b, m);
}

int compare_turned_along_normal(const double a[3], const double b[3], const double c[3], const Motion& m, const double w[3],
                                const double v[3]) {
  return dot3(cross3(difference3(b, a), difference3(c, a)), rotated(m, w, v)).sign();
}

int compare_along_turned_normal(const Motion& m, const double a[3], const double b[3], const double c[3], const double w[3],
                                const double v[3]) {
  return dot3(turned_cross(m, a, b, c), difference3(w, v)).sign();
}

Wide turned_normal(const Motion& m, const double a[3], const double b[3], const double c[3]) {
  return rounded(turned_cross(m, a, b, c));
}

Wide edge_normal(const double a[3], const double b[3], const Motion& m, const double w[3], const double v[3]) {
  return rounded(cross3(difference3(b, a), rotated(m, w, v)));
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
  std::array<int, 4> sign;
  bool certain = true;
  for (int k = 0; k < 4; ++k) {
    const auto [i, j, l] = kTetrahedronFace[k];
    sign[k] = certain_sign(dot(cross(p[i], p[j]), p[l]), kOffsetTripleProductError * permanent(size[i], size[j], size[l]));
    certain = certain && sign[k] != 0;
  }
  if (!certain) {
    bool flat = true;
    for (int k = 0; k < 4; ++k) {
      const auto [i, j, l] = kTetrahedronFace[k];
      sign[k] = offset_determinant_sign({a[i].data(), a[j].data(), a[l].data()}, {b[i].data(), b[j].data(), b[l].data()}, m);
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
