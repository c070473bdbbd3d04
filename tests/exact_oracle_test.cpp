// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The exact predicates against CGAL's on doubles that nearly degenerate. Knows exact.h and CGAL's rationals.
#include "numeric/exact.h"

#include <cmath>
#include <limits>

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "numeric/vec4.h"
#include "shapes.h"

namespace swiftlet::exact {
namespace {

using Number = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Number>;
using Point = Kernel::Point_3;
using Direction = Kernel::Vector_3;

Point rational(const Vec3& p) { return {Number(p.x()), Number(p.y()), Number(p.z())}; }
Point rational(const Pose& pose, const Vec3& p) {
  const Point q = rational(p);
  const auto row = [&](int i) -> Number {
    return Number(pose.rotation(i, 0)) * q.x() + Number(pose.rotation(i, 1)) * q.y() + Number(pose.rotation(i, 2)) * q.z() +
           Number(pose.translation[i]);
  };
  return {row(0), row(1), row(2)};
}
int sign(const Number& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Each coordinate moved by up to two ulps.
Vec3 nudged(shapes::Random& random, Vec3 p) {
  for (double& x : p) {
    for (int steps = int(random.uniform(0, 3)); steps > 0; --steps) {
      x = std::nextafter(
          x, random.uniform() < 0.5 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity());
    }
  }
  return p;
}

/// Doubles in floating point disagree with the truth often enough for a filter that trusts them to be found out.
struct Doubt {
  int wrong_in_doubles = 0, signs[3] = {0, 0, 0};
  void add(int truth, double in_doubles) {
    ++signs[truth + 1];
    wrong_in_doubles += truth != (in_doubles > 0 ? 1 : in_doubles < 0 ? -1 : 0);
  }
  void expect_hard(int tries) const {
    EXPECT_GE(wrong_in_doubles, tries / 50);
    EXPECT_GE(signs[0], tries / 5);
    EXPECT_GE(signs[2], tries / 5);
  }
};

constexpr int kTries = 5000;

TEST(ExactOracle, OrientationAgreesNearThePlane) {
  shapes::Random random(11);
  Doubt doubt;
  for (int i = 0; i < kTries; ++i) {
    const Vec3 a = random.in_ball(), b = random.in_ball(), c = random.in_ball();
    const Vec3 d = nudged(random, a + random.uniform(-2, 2) * (b - a) + random.uniform(-2, 2) * (c - a));
    const int truth = CGAL::orientation(rational(a), rational(b), rational(c), rational(d));
    ASSERT_EQ(orientation(a.data(), b.data(), c.data(), d.data()), truth) << i;
    doubt.add(truth, (b - a).cross(c - a).dot(d - a));
  }
  doubt.expect_hard(kTries);
}

TEST(ExactOracle, CompareAlongTurnedAgreesNearZero) {
  shapes::Random random(12);
  Doubt doubt;
  for (int i = 0; i < kTries; ++i) {
    const Mat3 r = random.rotation();
    const Vec3 n = random.on_sphere(), v = random.in_ball();
    const Vec3 w = nudged(random, v + (r.transpose() * n).cross(random.in_ball()));
    const Pose turn{r, Vec3::Zero()};
    const Direction e = rational(turn, w) - rational(turn, v), along = rational(n) - CGAL::ORIGIN;
    const int truth = sign(along * e);
    ASSERT_EQ(compare_along_turned(n.data(), motion(turn), w.data(), v.data()), truth) << i;
    doubt.add(truth, n.dot(r * (w - v)));
  }
  doubt.expect_hard(kTries);
}

TEST(ExactOracle, TetrahedronAgreesWhenTheOriginIsNearAFace) {
  shapes::Random random(13);
  int held = 0, bounded_by_rounding = 0;
  for (int i = 0; i < kTries; ++i) {
    const Pose pose{random.rotation(), random.in_ball()};
    std::array<Vec3, 4> p{random.in_ball(), random.in_ball(), {}, random.in_ball()};
    p[2] = -random.uniform() * p[0] - random.uniform() * p[1];  // the plane 0, 1, 2 passes the origin, nearly
    std::array<std::array<double, 3>, 4> a, b;
    std::array<Point, 4> exactly;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 q = random.in_ball(), moved = pose.rotation * q + pose.translation, source = nudged(random, p[k] + moved);
      a[k] = {source.x(), source.y(), source.z()};
      b[k] = {q.x(), q.y(), q.z()};
      exactly[k] = CGAL::ORIGIN + (rational(source) - rational(pose, q));
    }
    const CGAL::Tetrahedron_3<Kernel> tetrahedron(exactly[0], exactly[1], exactly[2], exactly[3]);
    const bool expected = !tetrahedron.is_degenerate() && !tetrahedron.has_on_unbounded_side(Point(0, 0, 0));
    ASSERT_EQ(tetrahedron_holds_origin(a, b, motion(pose)), expected) << i;
    held += expected;
    bounded_by_rounding += CGAL::abs((exactly[0] - CGAL::ORIGIN) *
                                     CGAL::cross_product(exactly[1] - CGAL::ORIGIN, exactly[2] - CGAL::ORIGIN)) < Number(1e-14);
  }
  EXPECT_GE(held, kTries / 20);
  EXPECT_GE(kTries - held, kTries / 20);
  EXPECT_GE(bounded_by_rounding, kTries * 9 / 10);
}

}  // namespace
}  // namespace swiftlet::exact
