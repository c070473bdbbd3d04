// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Primitives answer as the models of the same points do, flat and degenerate ones too, and what is no body is a status.
#include <swiftlet/body.h>
#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

static_assert(std::is_trivially_copyable_v<Body> && sizeof(Body) <= 96);
static_assert(std::is_convertible_v<const Model&, Body> && std::is_convertible_v<Model&, Body>);
static_assert(!std::is_constructible_v<Body, Model> && !std::is_constructible_v<Body, const Model>);
static_assert(!std::is_constructible_v<Body, Model, double>);

/// A primitive, the points of its hull, and a model of these.
struct Twin {
  std::string name;
  Body body;
  std::vector<Vec3> points;
  Model model;
};

Twin box(const std::string& name, const Vec3& least, const Vec3& most) {
  bodies::Polyhedron p;
  for (unsigned bits = 0; bits < 8; ++bits)
    p.points.emplace_back(bits & 1 ? most.x() : least.x(), bits & 2 ? most.y() : least.y(), bits & 4 ? most.z() : least.z());
  for (const std::initializer_list<std::uint32_t> face :
       {std::initializer_list<std::uint32_t>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
    p.add(face);
  return {name, Body::box(least, most), p.points, bodies::model(p)};
}
Twin polygon(const std::string& name, const Body& body, const std::vector<Vec3>& loop) {
  return {name, body, loop, bodies::model(bodies::two_sided(loop))};
}
Twin segment(const std::string& name, const Body& body, const Vec3& p, const Vec3& q) {
  return {name, body, {p, q}, bodies::model(bodies::segment(p, q))};
}
Twin point(const std::string& name, const Body& body, const Vec3& p) {
  return {name, body, {p}, bodies::model(bodies::point(p))};
}

const std::vector<Twin>& twins() {
  const Vec3 o(0, 0, 0), p(1, 0.25, 0), q(-0.5, 1, 0.5), r(0.25, -0.75, 1), far = p + 3 * (q - p);
  static const std::vector<Twin> all{
      box("box", {-1, -0.5, -0.25}, {0.5, 0.75, 1}),
      box("thin box", {-1, -1, 0}, {1, 1, 1e-9}),
      polygon("box without height", Body::box({-1, -0.5, 0.25}, {0.5, 0.75, 0.25}),
              {{-1, -0.5, 0.25}, {0.5, -0.5, 0.25}, {0.5, 0.75, 0.25}, {-1, 0.75, 0.25}}),
      polygon("box without width", Body::box({0, -0.5, 0.25}, {0, 0.75, 1}),
              {{0, -0.5, 0.25}, {0, 0.75, 0.25}, {0, 0.75, 1}, {0, -0.5, 1}}),
      polygon("box without depth", Body::box({-1, 0.5, 0.25}, {0, 0.5, 1}),
              {{-1, 0.5, 0.25}, {-1, 0.5, 1}, {0, 0.5, 1}, {0, 0.5, 0.25}}),
      segment("box of one side", Body::box({-1, 0, 0}, {1, 0, 0}), {-1, 0, 0}, {1, 0, 0}),
      point("box of no side", Body::box(p, p), p),
      polygon("triangle", Body::triangle(p, q, r), {p, q, r}),
      polygon("sliver", Body::triangle(o, {1, 0, 0}, {0.5, 1e-12, 0}), {o, {1, 0, 0}, {0.5, 1e-12, 0}}),
      segment("triangle on a line", Body::triangle({1, 2, 3}, {-1, -2, -3}, {0.5, 1, 1.5}), {1, 2, 3}, {-1, -2, -3}),
      segment("triangle with a corner twice", Body::triangle(p, p, q), p, q),
      point("triangle of one point", Body::triangle(p, p, p), p),
      segment("segment", Body::segment(p, far), p, far),
      point("segment without length", Body::segment(p, p), p),
      point("point", Body::point(p), p),
  };
  return all;
}

/// Exact truth within law 2's bound, in every query; `body` has a primitive in it.
void expect_as_the_model(const Twin& a, const Twin& b, const Pose& pose, double radius) {
  const Body body_a = a.body.model() ? Body(*a.body.model(), radius) : [&] {
    switch (a.body.kind()) {
      case BodyKind::Box: return Body::box(a.body.corner(0), a.body.corner(1), radius);
      case BodyKind::Triangle: return Body::triangle(a.body.corner(0), a.body.corner(1), a.body.corner(2), radius);
      case BodyKind::Segment: return Body::segment(a.body.corner(0), a.body.corner(1), radius);
      default: return Body::point(a.body.corner(0), radius);
    }
  }();
  const Body model_a(a.model, radius);
  const double bound = tolerance(body_a, b.body, pose);
  ASSERT_EQ(bound, tolerance(model_a, b.model, pose));
  const oracle::Truth truth = oracle::distance(a.points, b.points, pose);
  const Answer near = distance(body_a, b.body, pose), as_model = distance(model_a, b.model, pose);
  ASSERT_EQ(near.status, Status::Converged);
  ASSERT_LE(near.upper - near.lower, bound);
  const double expected = std::max(0.0, truth.distance - radius);
  ASSERT_GE(expected, near.lower - bound / 8);
  ASSERT_LE(expected, near.upper + bound / 8);
  ASSERT_TRUE(near.verdict == as_model.verdict || std::fabs(truth.distance - radius) <= 2 * bound);
  ASSERT_EQ(check(body_a, b.body, pose, near, Question::Exact).message, "");

  PairSeed seed;
  distance(body_a, b.body, pose, seed);
  ASSERT_EQ(distance(body_a, b.body, pose, seed).verdict, near.verdict);
  ASSERT_EQ(intersects(body_a, b.body, pose).verdict, near.verdict);
  ASSERT_NE(within(body_a, b.body, pose, near.upper + 4 * bound).decision, Decision::No);
  const Answer deep = signed_distance(body_a, b.body, pose), deep_model = signed_distance(model_a, b.model, pose);
  ASSERT_EQ(deep.status, Status::Converged);
  ASSERT_NEAR(deep.lower, deep_model.lower, 2 * bound);
  ASSERT_NEAR(deep.upper, deep_model.upper, 2 * bound);
  ASSERT_EQ(check(body_a, b.body, pose, deep, Question::Exact).message, "");
  const ClosestFeatures closest = closest_features(body_a, b.body, pose);
  ASSERT_NEAR(closest.answer.lower, near.lower, bound);
  if (near.verdict == Verdict::Disjoint) {
    for (const std::uint32_t id : closest.source_a.vertices) ASSERT_TRUE(id == kNone || id < 8);
    ASSERT_EQ(closest.source_a.kind, closest.answer.feature_a.kind());
    ASSERT_GE(manifold(body_a, b.body, pose, deep, {.margin = deep.upper + bound}).count, 1u);
  }
}

TEST(Body, OfEachKindAnswersAsAModelOfItsPoints) {
  shapes::Random random(1);
  int verdicts[4] = {};
  for (const Twin& a : twins()) {
    for (const Twin& b : twins()) {
      for (int i = 0; i < 24; ++i) {
        Pose pose{random.rotation(), random.in_ball() * 3};
        if (i % 4 == 1) pose.rotation.setIdentity();
        if (i % 4 == 2)
          pose = {Mat3::Identity(), Vec3(double(random.bits() % 9) / 4 - 1, double(random.bits() % 9) / 4 - 1, 0)};
        expect_as_the_model(a, b, pose, i % 3 == 0 ? 0.25 : 0);
        if (testing::Test::HasFatalFailure()) FAIL() << a.name << " and " << b.name << ", pose " << i;
        ++verdicts[int(distance(a.body, b.body, pose).verdict)];
      }
    }
  }
  for (const Verdict v : {Verdict::Disjoint, Verdict::Touching, Verdict::Overlapping})
    EXPECT_GE(verdicts[int(v)], 100) << int(v);
}

TEST(Body, OfAPrimitiveMeetsModelsOfManyLevels) {
  const Mesh mesh = shapes::ellipsoid({1, 0.7, 0.5}, 800, 3);
  const Model hull = bodies::must(build(mesh)).model;
  const Twin with{"ellipsoid", hull, mesh.points, hull};
  shapes::Random random(2);
  for (const Twin& a : twins()) {
    for (int i = 0; i < 12; ++i) {
      expect_as_the_model(a, with, {random.rotation(), random.in_ball() * 2.5}, i % 3 == 0 ? 0.25 : 0);
      if (testing::Test::HasFatalFailure()) FAIL() << a.name << ", pose " << i;
    }
  }
}

/// A number on a coarse lattice, or any of an ordinary size.
double coordinate(shapes::Random& random) {
  switch (random.bits() % 4) {
    case 0: return 0;
    case 1: return double(random.bits() % 5) / 2 - 1;
    case 2: return random.uniform(-2, 2);
    default: return random.uniform(-1, 1) * std::exp2(double(random.bits() % 24) - 12);
  }
}
Vec3 place(shapes::Random& random) { return Vec3(coordinate(random), coordinate(random), coordinate(random)); }
Body any_primitive(shapes::Random& random) {
  const double radius = random.bits() % 3 ? 0 : random.uniform(0, 1);
  const Vec3 p = place(random), q = place(random);
  switch (random.bits() % 4) {
    case 0: return Body::point(p, radius);
    case 1: return Body::segment(p, q, radius);
    case 2: return Body::triangle(p, q, place(random), radius);
    default: return Body::box(p.cwiseMin(q), p.cwiseMax(q), radius);
  }
}

TEST(Body, OfAnyPrimitiveKeepsTheLaws) {
  shapes::Random random(4);
  PairSeed seed;
  int verdicts[4] = {};
  for (int i = 0; i < 40'000; ++i) {
    const Body a = any_primitive(random), b = any_primitive(random);
    const Pose pose{i % 3 ? random.rotation() : Mat3(Mat3::Identity()), place(random)};
    const double bound = tolerance(a, b, pose), last_places = a.radius() + b.radius() > 0 ? bound / 16 : 0;
    OverlapProof proof;
    const Answer near = distance(a, b, pose, seed, {.tuning = {.proof = &proof}}), deep = signed_distance(a, b, pose, seed);
    for (const Answer& answer : {near, deep}) {
      const double width = answer.is_signed && answer.verdict == Verdict::Touching ? 2 * bound : bound;
      ASSERT_EQ(answer.status, Status::Converged) << i;
      ASSERT_LE(answer.upper - answer.lower, width + last_places) << i;
      ASSERT_EQ(check(a, b, pose, answer, Question::Exact).message, "") << i;
    }
    ASSERT_EQ(check(a, b, pose, near, Question::Exact, &proof).message, "") << i;
    ASSERT_TRUE(near.verdict == deep.verdict || (near.upper <= bound && deep.lower >= -bound)) << i;
    ++verdicts[int(near.verdict)];
  }
  for (const Verdict v : {Verdict::Disjoint, Verdict::Touching, Verdict::Overlapping})
    EXPECT_GE(verdicts[int(v)], 50) << int(v);
}

TEST(Body, ThatIsNoneIsAStatus) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const Body good = Body::point({1, 2, 3});
  const Body bad[] = {Body::point({nan, 0, 0}),
                      Body::point({0, infinity, 0}),
                      Body::point({0, 0, 1.1e45}),
                      Body::point({1e-71, 0, 0}),
                      Body::point({1e-46, 0, 0}),
                      Body::segment({0, 0, 0}, {1, nan, 0}),
                      Body::triangle({0, 0, 0}, {1, 0, 0}, {0, -infinity, 0}),
                      Body::box({0, 0, 0}, {1, 1, -1}),
                      Body::box({0, 0, 0}, {1, nan, 1})};
  for (const Body& body : bad) {
    for (const auto& [a, b] : {std::pair(body, good), std::pair(good, body)}) {
      EXPECT_EQ(distance(a, b, Pose{}).status, Status::InvalidBody);
      EXPECT_EQ(intersects(a, b, Pose{}).status, Status::InvalidBody);
      EXPECT_EQ(within(a, b, Pose{}, 1).answer.status, Status::InvalidBody);
      EXPECT_EQ(signed_distance(a, b, Pose{}).status, Status::InvalidBody);
      EXPECT_EQ(signed_within(a, b, Pose{}, -1).answer.status, Status::InvalidBody);
      EXPECT_EQ(closest_features(a, b, Pose{}).answer.status, Status::InvalidBody);
      const Answer answer = distance(a, b, Pose{});
      EXPECT_TRUE(std::isnan(answer.value()) && answer.point_a.hasNaN() && answer.normal.hasNaN());
      EXPECT_TRUE(check(a, b, Pose{}, answer));
      EXPECT_FALSE(check(good, good, Pose{}, answer));
      EXPECT_TRUE(std::isnan(tolerance(a, b, Pose{})));
    }
  }
  EXPECT_EQ(distance(good, good, Pose{}).verdict, Verdict::Touching);
  EXPECT_EQ(distance(Body::point({1e-45, 0, 0}), Body::point({0, 0, 1e45}), Pose{}).status, Status::Converged);
}

TEST(Distance, BeyondANegativeBoundSaysNothingOfBodiesThatOverlap) {
  const Model hull = bodies::must(build(shapes::ellipsoid({1, 1, 1}, 500, 1))).model;
  for (const double x : {0.0, 0.5, 1.9, 3.0}) {
    const Answer answer = distance(hull, hull, {Mat3::Identity(), {x, 0, 0}}, {.beyond = -10});
    EXPECT_GE(answer.lower, 0) << x;
    EXPECT_TRUE(answer.verdict != Verdict::Disjoint || answer.lower > 0) << x;
  }
}

TEST(Distance, OfCentresASubnormalLengthApartLeavesASeed) {
  PairSeed seed;
  for (int i = 0; i < 3; ++i) {
    const Answer answer = distance(Body::point({0, 0, 0}), Body::point({0, 0, 0}), {Mat3::Identity(), {1e-320, 0, 0}}, seed);
    EXPECT_EQ(answer.status, Status::Converged);
  }
}

TEST(Body, TellsItsCorners) {
  const Vec3 p(1, 2, 3), q(4, 5, 6), r(7, 8, 10);
  const Body triangle = Body::triangle(p, q, r, 0.5);
  EXPECT_EQ(triangle.corner(0), p);
  EXPECT_EQ(triangle.corner(1), q);
  EXPECT_EQ(triangle.corner(2), r);
  EXPECT_TRUE(triangle.corner(3).hasNaN() && triangle.corner(-1).hasNaN());
  EXPECT_EQ(triangle.radius(), 0.5);
  EXPECT_EQ(triangle.model(), nullptr);
  EXPECT_TRUE(Body::point(p).corner(1).hasNaN());
  const Model cube = bodies::model(bodies::cube());
  EXPECT_EQ(Body(cube).model(), &cube);
  EXPECT_TRUE(Body(cube).corner(0).hasNaN());
}

TEST(Answer, TellsAValueInTheMiddleOfItsInterval) {
  const Model cube = bodies::model(bodies::cube());
  const Pose apart{Mat3::Identity(), {3, 0, 0}}, inside{Mat3::Identity(), {1.5, 0, 0}};
  EXPECT_NEAR(distance(cube, cube, apart).value(), 1, tolerance(cube, cube, apart));
  EXPECT_NEAR(signed_distance(cube, cube, inside).value(), -0.5, tolerance(cube, cube, inside));
  EXPECT_EQ(distance(cube, cube, inside).value(), 0);
  EXPECT_TRUE(std::isnan(Answer{}.value()));
  EXPECT_TRUE(std::isnan(signed_within(cube, cube, inside, 1).answer.value())) << "how deep was not asked";
}

TEST(Tolerance, IsLawTwosBoundOfTheBodies) {
  const Model cube = bodies::model(bodies::cube());
  shapes::Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Pose pose{random.rotation(), random.in_ball() * std::exp2(double(i % 40) - 10)};
    const double off = (pose.rotation.transpose() * pose.rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
    const double radius = i % 2 ? 7.5 : 0, size = 1 + radius + pose.translation.norm();
    // |R^T R - I| is of 3 products, rounded in whatever order.
    EXPECT_NEAR(tolerance(cube, Body(cube, radius), pose), (64 * 0x1p-53 + 2 * off) * size, 8 * 0x1p-53 * size);
  }
  EXPECT_TRUE(std::isnan(tolerance(cube, cube, {2 * Mat3::Identity(), Vec3::Zero()})));
}

}  // namespace
}  // namespace swiftlet
