// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What once went wrong, as literal doubles, with what used to happen.
#include <swiftlet/check.h>
#include <swiftlet/depth.h>
#include <swiftlet/query.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "bodies.h"
#include "oracle.h"

namespace swiftlet {
namespace {

using namespace bodies;

Polyhedron prism(std::vector<Vec3> corners) {  // the lower loop, then the upper one, counter-clockwise from above
  Polyhedron b{std::move(corners), {}, {}};
  const auto n = std::uint32_t(b.points.size() / 2);
  for (std::uint32_t i = n; i-- > 0;) b.corners.push_back(i);
  for (std::uint32_t i = 0; i < n; ++i) b.corners.push_back(n + i);
  b.sizes = {n, n};
  for (std::uint32_t i = 0; i < n; ++i) b.add({i, (i + 1) % n, n + (i + 1) % n, n + i});
  return b;
}
Polyhedron prism3() {
  return prism({{0x1p+0, 0x0p+0, -0x1.3333333333333p-3},
                {-0x1.ffffffffffffcp-2, 0x1.bb67ae8584cabp-1, -0x1.3333333333333p-3},
                {-0x1.0000000000004p-1, -0x1.bb67ae8584ca8p-1, -0x1.3333333333333p-3},
                {0x1p+0, 0x0p+0, 0x1.3333333333333p-3},
                {-0x1.ffffffffffffcp-2, 0x1.bb67ae8584cabp-1, 0x1.3333333333333p-3},
                {-0x1.0000000000004p-1, -0x1.bb67ae8584ca8p-1, 0x1.3333333333333p-3}});
}
Polyhedron prism4() {
  return prism({{0x1p+0, 0x0p+0, -0x1.3333333333333p-3},
                {0x1.1a62633145c07p-54, 0x1p+0, -0x1.3333333333333p-3},
                {-0x1p+0, 0x1.1a62633145c07p-53, -0x1.3333333333333p-3},
                {-0x1.a79394c9e8a0ap-53, -0x1p+0, -0x1.3333333333333p-3},
                {0x1p+0, 0x0p+0, 0x1.3333333333333p-3},
                {0x1.1a62633145c07p-54, 0x1p+0, 0x1.3333333333333p-3},
                {-0x1p+0, 0x1.1a62633145c07p-53, 0x1.3333333333333p-3},
                {-0x1.a79394c9e8a0ap-53, -0x1p+0, 0x1.3333333333333p-3}});
}

/// Exact, true, within law 2, and what `check` recomputes, both ways round.
void expect_sound(const Model& a, const Model& b, const Pose& pose) {
  PairSeed seed;
  const Answer answer = distance(a, b, pose, seed);
  EXPECT_EQ(answer.status, Status::Converged);
  EXPECT_TRUE(oracle::holds(oracle::distance(points_of(a.level(0).view), points_of(b.level(0).view), pose), answer.lower,
                            answer.upper));
  EXPECT_LE(answer.upper - answer.lower, law_two(a.level(0).view, b.level(0).view, pose));
  const Check checked = check(a, b, pose, answer, Question::Exact);
  EXPECT_TRUE(checked) << checked.message;
}

/// Certified GJK chose its active set by the norm, which is flat at the optimum: a step of 1e-9 hid under a rounding of
/// 1e-17, and the march ended NotConverged.
TEST(Regress, ActiveSetWasChosenByAFlatNorm) {
  for (const double tilt : {0x1.3962e9a6af5b5p-31, -0x1.3962e9a6af5b5p-31}) {  // 5.7e-10
    Pose pose{Mat3::Identity(), {2.5, -2.5, 0.5}};
    pose.rotation(0, 2) = tilt;
    pose.rotation(2, 0) = -tilt;
    for (const Polyhedron& a : {prism3(), prism4()}) {
      for (const Polyhedron& b : {prism3(), prism4()}) {
        expect_sound(model(a), model(b), pose);
        expect_sound(model(a), model(b), inverse(pose));
      }
    }
  }
}

/// Coincident triples of the inner polytope gave a zero normal, and the deep overlap was called Touching.
TEST(Regress, DeepOverlapWithCoplanarFacesWasCalledTouching) {
  const Model cube = model(bodies::cube());
  for (const Vec3& t : {Vec3(0, 0.3, 0.1), Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(0, 0, -0.1)}) {
    PairSeed seed;
    const Answer answer = distance(cube, cube, {Mat3::Identity(), t}, seed);
    EXPECT_EQ(answer.verdict, Verdict::Overlapping);
    expect_sound(cube, cube, {Mat3::Identity(), t});
  }
}

/// The line of centres as it came was climbed along with exact comparisons that underflowed or overflowed, and the support
/// climb went round for ever: identical cubes 1e-310 apart, and cubes 1e308 apart, where the answer, where one came, was [0,
/// 0].
TEST(Regress, TinyAndHugeTranslationsLooped) {
  const Model m = nested(2);
  for (const Vec3& t : {Vec3(1e-310, 1e-310, 0), Vec3(0x1p-1073, 0x1p-1074, 0), Vec3(1e-300, 1e-300, 1e-301)}) {
    PairSeed seed;
    EXPECT_EQ(distance(m, m, {Mat3::Identity(), t}, seed).verdict, Verdict::Overlapping);
  }
  for (const Vec3& t : {Vec3(1e308, 1e308, 0), Vec3(1e308, 0, 0), Vec3(1e160, 1e150, 1e140)}) {
    PairSeed seed;
    const Answer answer = distance(m, m, {Mat3::Identity(), t}, seed);
    EXPECT_EQ(answer.status, Status::InvalidPose);
    EXPECT_EQ(answer.upper, std::numeric_limits<double>::infinity());
  }
}

/// Tetrahedra 3.2e-16 apart: some starts proved the gap and answered Disjoint, others answered Touching, which law 3 forbids.
TEST(Regress, VerdictNearContactDependedOnTheStart) {
  Polyhedron a{{{0x1.7f7559069a93p-4, -0x1.549bc0acc0b68p-3, -0x1.75625412040ap-3},
                {0x1.5f8048252321p-2, -0x1.73ca7aa11d3aap-1, 0x1.45566e494c588p-3},
                {0x1.6154cb0d2797p-3, 0x1.5dd22471b432ap-1, 0x1.85ca28a14ca7cp-2},
                {-0x1.5a0de9ffbcb02p-1, -0x1.6ea9b760568bp-2, 0x1.41594e05fb8ep-5}},
               {},
               {}};
  Polyhedron b{{{0x1.8f50f91c297bp-2, -0x1.2649ea26a8104p-2, -0x1.684877b13bd6ep-1},
                {-0x1.da04a139fb2bp-3, 0x1.64202a21cc0bp-2, 0x1.6585e48c70e6ep-1},
                {-0x1.75e552a7fbedp-2, 0x1.6e22b56b58fe8p-3, 0x1.c8ef212892dep-2},
                {0x1.370441f033a88p-3, 0x1.b74ac2bfb33e8p-3, 0x1.6d71fb2f99daep-1}},
               {},
               {}};
  for (Polyhedron* body : {&a, &b}) body->add({2, 1, 0}), body->add({0, 3, 2}), body->add({2, 3, 1}), body->add({1, 3, 0});
  const Model model_a = model(a), model_b = model(b);
  const Pose pose{Mat3::Identity(), {-0x1.d7a59fb700848p-4, -0x1.a8ed805adf87cp-1, -0x1.2e88b9ba946a2p-1}};
  expect_sound(model_a, model_b, pose);
  const MarchStatus cold = march(model_a.level(0).view, model_b.level(0).view, pose).status;
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t j = 0; j < 4; ++j) {
      EXPECT_EQ(march(model_a.level(0).view, model_b.level(0).view, pose, {{FeatureKind::Vertex, i}, {FeatureKind::Vertex, j}})
                    .status,
                cold)
          << i << ' ' << j;
    }
  }
}

/// Differences on one line have no facet: bodies on one line ended NotConverged unless an axis lay across it.
TEST(Regress, CollinearBodiesHadNoFacetToLookAcross) {
  const Model segment = model({{{-1, -1, -1}, {1, 1, 1}}, {}, {}}), point = model({{{0, 0, 0}}, {}, {}});
  for (const Model* other : {&segment, &point}) {
    PairSeed seed;
    const Answer answer = distance(segment, *other, Pose{}, seed);
    EXPECT_EQ(answer.status, Status::Converged);
    EXPECT_EQ(answer.verdict, Verdict::Touching);
  }
  expect_sound(segment, segment, {Mat3::Identity(), {0.5, 0.5, 0.5}});
}

/// The upper bound was rounded up once more after the march had met law 2's bound.
TEST(Regress, TwoPointsWereWiderThanLawTwo) {
  const Model a = model({{{0x1.12223de3eb026p-1, -0x1.5327a9fda26e6p-1, 0x1.8f693dabc6dp-7}}, {}, {}});
  const Model b = model({{{-0x1.e95786ae1bbe8p-2, 0x1.7a9ab55736c04p-2, 0x1.a6e8b833c9c4p-2}}, {}, {}});
  expect_sound(a, b, Pose{});
}

/// A level below 0 was read: out of bounds.
TEST(Regress, NegativeFinestLevelCrashed) {
  const Model cube = model(bodies::cube());
  Options options;
  options.budget.finest_level = -1;
  PairSeed seed;
  EXPECT_EQ(distance(cube, cube, {Mat3::Identity(), {5, 0, 0}}, seed, options).status, Status::Converged);
}

/// Faces tilted by 2^-32 stall the walk on a pair of edges, whose plane bounds the distance to the last bit, but lies 1e-10 of
/// an angle beside the line between the points: the normal was not theirs.
TEST(Regress, NearlyParallelFacesLeftTheNormalBesideThePoints) {
  Polyhedron tilted = cube();
  for (Vec3& p : tilted.points) p.z() += 0x1p-32 * p.x();
  const Model a = model(tilted), b = model(cube());
  const ConvexView &view_a = a.level(0).view, &view_b = b.level(0).view;
  const Pose pose{Mat3::Identity(), {0, 0, -2.5}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (std::uint32_t j = 0; j < 8; ++j) {
      const MarchResult r = march(view_a, view_b, pose, {{FeatureKind::Vertex, i}, {FeatureKind::Vertex, j}});
      EXPECT_EQ(r.status, MarchStatus::Disjoint);
      const Vec3 d = r.point_b - r.point_a;
      EXPECT_LE((d - d.norm() * r.normal).norm(), law_two(view_a, view_b, pose)) << i << ' ' << j;
    }
  }
}

/// Law 2's bound was taken with |R^T R - I| in doubles, which rounding made larger than it is: an interval of 3.9968e-14 passed
/// where the law allows 3.97188e-14.
TEST(Regress, LawTwoAllowedForTheRoundingOfOrthonormality) {
  const Model cube = model(bodies::cube());
  Pose pose;
  pose.rotation << 0x1.fffffffffffffp-1, -0x1.161dd27da3843p-29, -0x1.9d1a4f195fc0ap-27,  //
      0x1.161dd24a3bea1p-29, 0x1p+0, -0x1.fdb0319588b59p-30,                              //
      0x1.9d1a4f1b89796p-27, 0x1.fdb0312556093p-30, 0x1.fffffffffffffp-1;
  pose.translation = {-0x1.00000051cd626p+1, 0x1.718f104ec0fa4p-3, 0x1p+2};
  PairSeed seed;
  seed.a = {FeatureKind::Edge, 18};
  seed.b = {FeatureKind::Edge, 4};
  seed.line_in_a = {-14642, 1321, 29284};
  seed.line_in_b = {14642, -1321, -29284};
  const Answer answer = distance(cube, cube, pose, seed);
  EXPECT_EQ(answer.status, Status::Converged);
  EXPECT_LE(answer.upper - answer.lower, 3.97188e-14);
}

/// Cubes turned by 1e-8: plane and points came from different iterates, and the points differed by their distance times the
/// normal only within 2.7e-10. On others within 9e-8: the root of law 2's bound.
TEST(Regress, PointsLeanedFromTheNormal) {
  const Model cube = model(bodies::cube());
  Pose pose;
  pose.rotation << 0x1p+0, 0x1.3793ac44199bdp-32, -0x1.68b15c8f99f1fp-34,  //
      -0x1.3793ac4419073p-32, 0x1p+0, 0x1.a5dab248fa80cp-40,               //
      0x1.68b15c8fa1f7bp-34, -0x1.a5dab1db3a9ecp-40, 0x1p+0;
  pose.translation = {-0x1.ac84a9dd1534cp-34, -0x1.ffffffff556eap-1, 0x1.3fffffffa0a7bp+1};
  PairSeed seed;
  const Answer answer = distance(cube, cube, pose, seed);
  EXPECT_EQ(answer.verdict, Verdict::Disjoint);
  const Vec3 apart = answer.point_b - answer.point_a;
  EXPECT_LE((apart - apart.norm() * answer.normal).norm(), law_two(cube.level(0).view, cube.level(0).view, pose));
  expect_sound(cube, cube, pose);
}

/// The direction from a vertex to an edge may lean along the edge by 0.7 of its length and more where the length is rounding
/// noise. Walks proved a gap along it: of bodies that meet 6.7e-9, of a segment and a point 8.4e-24 apart 3.1e-10.
TEST(Regress, ALeaningDirectionProvedAGap) {
  const Body edge = Body::segment({0x1.14c9c76af6db6p-1, -0x1.284082a86dea3p-30, 0x1.2387ac2b29ac9p-30},
                                  {0x1.85ff4d6618c8p-6, -0x1.c0f9ae5ee1b94p-31, 0x1.73cfcc6885766p-33}),
             sliver = Body::triangle({0x1.0ed0014c91c0cp-9, 0x1.c82edd1342725p-42, 0x1.625ac4030e3e7p-39},
                                     {-0x1.30be4991a9fadp-11, 0x1.d5fa00ea7843fp-40, 0x1.3dafbd9d9d062p-43},
                                     {0x1.6b3f4134cc6c2p-10, 0x1.68a3a6a4111dcp-44, -0x1.da28f4c3d6c5bp-40});
  const Pose meeting{Mat3::Identity(), {0x1.47cca0d65a686p-2, -0x1.0a086eef86031p-30, 0x1.76898be3fd6bap-31}};
  EXPECT_LE(distance(edge, sliver, meeting).lower, tolerance(edge, sliver, meeting));
  EXPECT_NE(intersects(edge, sliver, meeting).verdict, Verdict::Disjoint);
  EXPECT_LE(signed_distance(edge, sliver, meeting).lower, tolerance(edge, sliver, meeting));

  const Body segment = Body::segment({-0x1.8d2102a80105p-4, 0x1.6c52c59091189p-24, -0x1.492b6819832dcp-23},
                                     {0x1.18565c249a978p-1, 0x1.2beb79c35fd67p-23, 0x1.1c1f08b63927fp-25}),
             point = Body::point({-0x1.0fbe71021fae7p-95, 0x1.28963d092dbbfp-94, 0x1.32e823eeafe3bp-96});
  Pose beside;
  beside.rotation << 0x1.d5d81e7b93c5p-4, -0x1.16e9768a669bp-5, 0x1.fc52547bacedcp-1,  //
      -0x1.f0b6bc398aaa3p-1, 0x1.b06b0d002f728p-3, 0x1.e8c5eb2e61ae8p-4,               //
      -0x1.b5a1d214b392ap-3, -0x1.f4274c6d4e6d9p-1, -0x1.20b5accf8af8p-7;
  beside.translation = {0x1.facff83253212p-4, 0x1.bcf8487d16732p-24, -0x1.8043433361562p-24};
  EXPECT_LE(distance(segment, point, beside).lower, tolerance(segment, point, beside));
}

/// The centre of a triangle was that of its box, which is none of its points: the upper bound of bodies far apart was too low.
TEST(Regress, TheCentreOfATriangleWasBesideIt) {
  const Body triangle = Body::triangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), point = Body::point({0, 0, 0});
  const Pose far{Mat3::Identity(), {10, 10, 10}};
  const Answer answer = intersects(triangle, point, far);
  EXPECT_EQ(answer.verdict, Verdict::Disjoint);
  EXPECT_GE(answer.upper, 29 / std::sqrt(3.0));
  EXPECT_NEAR(answer.point_a.sum(), 1, 1e-15);
}

/// A threshold below 0 made balls that overlap prove that the bodies are apart.
TEST(Regress, BallsWereApartByLessThanNothing) {
  const Body box = Body::box({-1, -1, -1}, {1, 1, 1});
  const Pose deep{Mat3::Identity(), {0.5, 0, 0}};
  for (const double threshold : {-1.0, -3.0, -1e300, -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(distance(box, box, deep, {.beyond = threshold}).verdict, Verdict::Overlapping) << threshold;
    EXPECT_NE(within(box, box, deep, threshold).answer.verdict, Verdict::Disjoint) << threshold;
    EXPECT_NE(closest_features(box, box, deep, {.beyond = threshold}).answer.verdict, Verdict::Disjoint) << threshold;
  }
}

/// Which feature holds a point was asked of a face as often as it has sides: where cones of 1 000 sides touch along their rims,
/// a query took 23 ms from the seed of the last one and 0.13 ms from nothing.
TEST(Regress, NamingAPointTookTheSquareOfAFacesSides) {
  constexpr std::uint32_t kSides = 1000;
  bodies::Polyhedron cone;
  std::vector<std::uint32_t> base(kSides);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    cone.points.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), -0.5);
    base[i] = kSides - 1 - i;
  }
  cone.points.emplace_back(0, 0, 0.5);
  cone.corners = base, cone.sizes = {kSides};
  for (std::uint32_t i = 0; i < kSides; ++i) cone.add({i, (i + 1) % kSides, kSides});
  const Model model = bodies::model(cone);
  Pose pose{Mat3::Identity(), {-0.5, 0.5, -1}};
  pose.rotation << 1, 0, 0, 0, -1, -0x1.1a62633145c07p-53, 0, 0x1.1a62633145c07p-53, -1;
  const auto least_time = [&](const PairSeed& from) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 5; ++round) {
      PairSeed seed = from;
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_EQ(distance(model, model, pose, seed).verdict, Verdict::Touching);
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return least;
  };
  PairSeed seed;
  distance(model, model, pose, seed);
  EXPECT_LE(least_time(seed), 20 * least_time({}));
}

}  // namespace
}  // namespace swiftlet
