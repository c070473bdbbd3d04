// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The atomic kernel: every kind of body against every other, from every start, under every stop rule. Truth is the oracle's.
#include <swiftlet/check.h>
#include <swiftlet/march.h>
#include <swiftlet/query.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "body/half_edge.h"
#include "oracle.h"
#include "pair/pair_view.h"
#include "pair/walk.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using bodies::law_two;
using bodies::model;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Named {
  const char* name;
  Model model;
  const ConvexView& view() const { return model.level(0).view; }
  std::vector<Vec3> points() const { return bodies::points_of(view()); }
};

std::vector<Named> all_kinds() {
  std::vector<Vec3> pentagon = shapes::polygon(5).points;
  return {{"point", model(bodies::point({0.1, 0.2, 0.3}))},
          {"segment", model(bodies::segment({-1, 0, 0}, {1, 0.5, 0}))},
          {"triangle", model(bodies::two_sided({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}))},
          {"polygon", model(bodies::two_sided(pentagon))},
          {"cube", model(bodies::cube())},
          {"solid", model(bodies::body_of(shapes::random_polytope(30, 4)))}};
}

std::vector<Named> small_solids() {
  return {{"tetrahedron", model(bodies::tetrahedron())},
          {"cube", model(bodies::cube())},
          {"octahedron", model(bodies::octahedron())},
          {"prism", model(bodies::body_of(shapes::prism(5, 1, 0.6)), {true, {}})}};
}

std::vector<FeatureId> features(const ConvexView& v) {
  std::vector<FeatureId> all;
  for (std::uint32_t i = 0; i < v.vertices.size(); ++i) all.emplace_back(FeatureKind::Vertex, i);
  for (std::uint32_t i = 0; i < v.half_edges.size(); ++i) all.emplace_back(FeatureKind::Edge, i);
  for (std::uint32_t i = 0; i < v.face_first.size(); ++i) all.emplace_back(FeatureKind::Face, i);
  return all;
}

/// Law 7's function for one level pair of few sides a face: from 16 steps on a walk ends where it comes back to the features at
/// which it was after the last power of two of steps. What is ever seen is far below; see the census at the end.
std::size_t most_steps(const ConvexView& a, const ConvexView& b) { return 16 + 3 * features(a).size() * features(b).size(); }

/// What the whole file saw, printed once.
struct Census : testing::Environment {
  std::uint32_t steps = 0, plane_tests = 0;
  double share = 0;  ///< of the features of both bodies
  int marches = 0, disjoint = 0, touching = 0, overlapping = 0;
  double widest = 0;  ///< interval over law 2's bound

  void TearDown() override {
    if (marches == 0) return;
    std::printf(
        "march: %d marches, %d disjoint, %d touching, %d overlapping; at most %u steps (%.2f of the features), %u plane tests; "
        "widest interval %.3f of law 2\n",
        marches, disjoint, touching, overlapping, steps, share, plane_tests, widest);
  }
};
Census& census = *static_cast<Census*>(testing::AddGlobalTestEnvironment(new Census));

/// Everything that a result must be, whatever was asked.
void expect_true(const ConvexView& a, const ConvexView& b, const Pose& pose, const oracle::Truth& truth, const MarchResult& r) {
  ++census.marches;
  census.steps = std::max(census.steps, r.steps);
  census.plane_tests = std::max(census.plane_tests, r.plane_tests);
  const std::size_t count = features(a).size() + features(b).size();
  census.share = std::max(census.share, double(r.steps) / double(count));
  ASSERT_LE(r.steps, most_steps(a, b));
  ASSERT_LE(r.steps, count + 12) << "not wrong, but never seen: look";
  ASSERT_TRUE(oracle::holds(truth, r.lower, r.upper))
      << "[" << r.lower << ", " << r.upper << "] does not hold " << truth.distance;
  switch (r.status) {
    case MarchStatus::Disjoint:
      ++census.disjoint;
      ASSERT_GT(r.lower, 0);
      ASSERT_FALSE(truth.overlapping);
      ASSERT_NEAR(r.normal.norm(), 1, 1e-15);
      break;
    case MarchStatus::Touching:
      ++census.touching;
      ASSERT_LE(r.upper, law_two(a, b, pose));
      break;
    case MarchStatus::Overlapping:
      ++census.overlapping;
      ASSERT_EQ(r.upper, 0);
      ASSERT_TRUE(truth.overlapping);
      ASSERT_TRUE(r.proof.count >= 1 && r.proof.count <= 4);
      break;
    default: break;
  }
}

/// An exact march: an answer, and within law 2.
void expect_exact(const ConvexView& a, const ConvexView& b, const Pose& pose, const oracle::Truth& truth,
                  const MarchResult& r) {
  expect_true(a, b, pose, truth, r);
  ASSERT_TRUE(r.status == MarchStatus::Disjoint || r.status == MarchStatus::Touching || r.status == MarchStatus::Overlapping)
      << int(r.status);
  ASSERT_LE(r.upper - r.lower, law_two(a, b, pose));
  census.widest = std::max(census.widest, (r.upper - r.lower) / law_two(a, b, pose));
  if (r.status != MarchStatus::Disjoint) return;
  ASSERT_LE(((r.point_b - r.point_a) - (r.point_b - r.point_a).norm() * r.normal).norm(), law_two(a, b, pose));
}

TEST(March, EveryKindOfBodyAgainstEveryOther) {
  const std::vector<Named> kinds = all_kinds();
  shapes::Random random(31);
  int apart = 0, meeting = 0;
  for (const Named& a : kinds) {
    for (const Named& b : kinds) {
      SCOPED_TRACE(std::string(a.name) + " and " + b.name);
      const std::vector<Vec3> points_a = a.points(), points_b = b.points();
      for (int i = 0; i < 40; ++i) {
        const Pose pose{random.rotation(), random.in_ball() * random.uniform(0, 3)};
        const oracle::Truth truth = oracle::distance(points_a, points_b, pose);
        expect_exact(a.view(), b.view(), pose, truth, march(a.view(), b.view(), pose));
        if (HasFatalFailure()) return;
        ++(truth.overlapping ? meeting : apart);
      }
    }
  }
  EXPECT_GE(apart, 500);
  EXPECT_GE(meeting, 50);
}

TEST(March, EveryKindOfBodyTouchesItself) {
  // A point of each put onto a point of the other: contact by construction, where coordinates allow it exactly.
  const std::vector<Named> kinds = all_kinds();
  for (const Named& a : kinds) {
    for (const Named& b : kinds) {
      SCOPED_TRACE(std::string(a.name) + " and " + b.name);
      const std::vector<Vec3> points_a = a.points(), points_b = b.points();
      for (std::size_t i = 0; i < points_a.size(); i += 3) {
        for (std::size_t j = 0; j < points_b.size(); j += 3) {
          const Pose pose{Mat3::Identity(), points_a[i] - points_b[j]};
          const oracle::Truth truth = oracle::distance(points_a, points_b, pose);
          expect_exact(a.view(), b.view(), pose, truth, march(a.view(), b.view(), pose));
          if (HasFatalFailure()) FAIL() << i << ' ' << j;
        }
      }
    }
  }
}

TEST(March, EveryStartGivesTheSameVerdictAndDistance) {
  const std::vector<Named> solids = small_solids();
  shapes::Random random(32);
  const Mat3 quarter = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
  const Pose poses[] = {{random.rotation(), {2.5, 0.3, -0.4}},
                        {random.rotation(), {0.3, 0.1, 0.2}},
                        {Mat3::Identity(), {0, 0, 0}},
                        {Mat3::Identity(), {2, 0, 0}},
                        {quarter, {0.5, 2.5, 0}},
                        {Mat3::Identity(), {0, 0.3, 0.1}}};
  int verdicts[3] = {0, 0, 0};
  for (const Named& a : solids) {
    for (const Named& b : solids) {
      SCOPED_TRACE(std::string(a.name) + " and " + b.name);
      const std::vector<Vec3> points_a = a.points(), points_b = b.points();
      const std::vector<FeatureId> starts_a = features(a.view()), starts_b = features(b.view());
      for (const Pose& pose : poses) {
        const oracle::Truth truth = oracle::distance(points_a, points_b, pose);
        const MarchResult cold = march(a.view(), b.view(), pose);
        ++verdicts[cold.status == MarchStatus::Disjoint ? 0 : cold.status == MarchStatus::Touching ? 1 : 2];
        for (const PlaneRule rule : {PlaneRule::MostViolated, PlaneRule::FirstViolated}) {
          MarchRule stop;
          stop.plane_rule = rule;
          for (const FeatureId from_a : starts_a) {
            for (const FeatureId from_b : starts_b) {
              const MarchResult r = march(a.view(), b.view(), pose, {from_a, from_b}, stop);
              expect_exact(a.view(), b.view(), pose, truth, r);
              EXPECT_EQ(r.status, cold.status);
              if (HasFatalFailure()) {
                FAIL() << "from " << int(from_a.kind()) << ' ' << from_a.index() << " and " << int(from_b.kind()) << ' '
                       << from_b.index();
              }
            }
          }
        }
      }
    }
  }
  for (const int n : verdicts) EXPECT_GE(n, 8);
}

TEST(March, SmallBodiesInLargeOnesOverlapFromEveryStart) {
  const Model outer = model(bodies::body_of(shapes::icosahedron()));
  const Model inner = model(bodies::moved(bodies::tetrahedron(), 0.05 * Mat3::Identity()));
  const ConvexView &a = outer.level(0).view, &b = inner.level(0).view;
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.1, 0.3, -0.2), Vec3(0.6, 0, 0)}) {
    for (const FeatureId from_a : features(a)) {
      for (const FeatureId from_b : features(b)) {
        ASSERT_EQ(march(a, b, {Mat3::Identity(), at}, {from_a, from_b}).status, MarchStatus::Overlapping);
        ASSERT_EQ(march(b, a, {Mat3::Identity(), -at}, {from_b, from_a}).status, MarchStatus::Overlapping);
      }
    }
  }
}

TEST(March, GarbageFeaturesCountAsCold) {
  const Model cube = model(bodies::cube());
  const ConvexView& v = cube.level(0).view;
  const Pose pose{bodies::rotation(1, 2, 3, 4), {3, 1, 0.5}};
  const MarchResult cold = march(v, v, pose);
  for (const FeatureKind kind : {FeatureKind::None, FeatureKind::Vertex, FeatureKind::Edge, FeatureKind::Face}) {
    for (const std::uint32_t index : {24u, 25u, 1000u, 0x3fffffffu}) {
      const MarchResult r = march(v, v, pose, {{kind, index}, {kind, index}});
      EXPECT_EQ(r.lower, cold.lower);
      EXPECT_EQ(r.upper, cold.upper);
      EXPECT_EQ(r.steps, cold.steps);
      EXPECT_EQ(march(v, v, pose, {{kind, index}, cold.b}).status, MarchStatus::Disjoint);
    }
  }
}

TEST(March, StoredFeaturesStartTheNextMarchAtItsEnd) {
  shapes::Random random(33);
  const Model m = model(bodies::body_of(shapes::ellipsoid({1, 1, 1}, 500, 1)));
  const ConvexView& v = m.level(0).view;
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random.rotation(), 2.5 * random.on_sphere()};
    const MarchResult cold = march(v, v, pose), warm = march(v, v, pose, {cold.a, cold.b});
    ASSERT_EQ(warm.steps, 0u) << i;
    ASSERT_EQ(warm.a, cold.a);
    ASSERT_EQ(warm.lower, cold.lower);
    ASSERT_LT(warm.plane_tests, cold.plane_tests + 1);
  }
}

TEST(March, TablesStartWhereTheBodiesFaceEachOther) {
  shapes::Random random(36);
  const Model none = model(bodies::body_of(shapes::ellipsoid({1, 0.8, 0.6}, 2000, 1)), {false, {lut::Resolution::None, 2, 0}});
  ASSERT_EQ(table_start(none, {1, 0, 0}), FeatureId{});
  const ConvexView& v = none.level(0).view;
  for (const TableSpec& spec : {TableSpec{}, TableSpec{lut::Resolution::Degrees5, 2, 0}}) {
    const Model m = none.with_table(spec).value();
    std::uint64_t looked_up = 0, climbed = 0;
    for (int i = 0; i < 200; ++i) {
      const Pose pose{random.rotation(), random.on_sphere() * random.uniform(2, 6)};
      const Vec3 line = pose.rotation * m.centre() + pose.translation - m.centre();
      const MarchStart start{table_start(m, line), table_start(m, pose.rotation.transpose() * -line)};
      ASSERT_EQ(start.a.kind(), FeatureKind::Vertex);
      const Vertex& named = v.vertices[start.a.index()];
      const auto height = [&](const Vertex& w) { return line.normalized().dot(Vec3(w.x, w.y, w.z)); };
      for (const Vertex& w : v.vertices) ASSERT_LE(height(w), height(named) + 0.05) << i;
      const MarchResult by_table = march(v, v, pose, start), cold = march(v, v, pose);
      ASSERT_EQ(by_table.status, cold.status);
      ASSERT_NEAR(by_table.lower, cold.lower, law_two(v, v, pose));
      looked_up += by_table.plane_tests, climbed += cold.plane_tests;
    }
    EXPECT_LT(looked_up, climbed / 2);
  }
  for (const Vec3& odd : {Vec3(0, 0, 0), Vec3(std::nan(""), 1, 0), Vec3(kInfinity, 0, 0)})
    ASSERT_LT(table_start(none.with_table({}).value(), odd).index(), v.vertices.size());
}

// ---- Stop rules ------------------------------------------------------------------------------------------------------------

struct Rules : testing::Test {
  Model m = model(bodies::body_of(shapes::ellipsoid({1, 0.5, 0.3}, 200, 2)));
  const ConvexView& v = m.level(0).view;
  std::vector<Vec3> points = bodies::points_of(v);
  shapes::Random random{34};
  Pose pose() { return {random.rotation(), random.on_sphere() * random.uniform(1, 3)}; }
};
using MarchRules = Rules;

TEST_F(MarchRules, BeyondStopsAboveAndOnlyAbove) {
  int stopped = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose p = pose();
    const oracle::Truth truth = oracle::distance(points, points, p);
    MarchRule rule;
    rule.beyond = i % 2 ? 0.5 : truth.distance;
    const MarchResult r = march(v, v, p, {}, rule);
    expect_true(v, v, p, truth, r);
    if (HasFatalFailure()) return;
    if (r.status == MarchStatus::Beyond) {
      ASSERT_GT(r.lower, rule.beyond);
      ++stopped;
    } else {
      ASSERT_FALSE(r.lower > rule.beyond);
      expect_exact(v, v, p, truth, r);
    }
    ASSERT_FALSE(truth.distance > rule.beyond + law_two(v, v, p) && r.status != MarchStatus::Beyond);
  }
  EXPECT_GE(stopped, 50);
}

TEST_F(MarchRules, FloorIsNeverUndercut) {
  for (int i = 0; i < 200; ++i) {
    const Pose p = pose();
    const MarchResult plain = march(v, v, p);
    MarchRule rule;
    rule.floor = plain.lower * (i % 2 ? 0.5 : 1);
    const MarchResult r = march(v, v, p, {}, rule);
    ASSERT_GE(r.lower, rule.floor);
    ASSERT_GE(r.lower, plain.lower);
    ASSERT_GE(r.upper, r.lower);
  }
}

TEST_F(MarchRules, ErrorsAreKeptAndNarrowEnoughIsEnough) {
  int near = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose p{random.rotation(), random.on_sphere() * random.uniform(0.2, 2)};
    const oracle::Truth truth = oracle::distance(points, points, p);
    MarchRule rule;
    rule.absolute = i % 3 == 0 ? 0.3 : 0;
    rule.relative = i % 3 == 1 ? 0.1 : 0;
    const MarchResult r = march(v, v, p, {}, rule), exact = march(v, v, p);
    expect_true(v, v, p, truth, r);
    if (HasFatalFailure()) return;
    ASSERT_LE(r.upper - r.lower, std::max({rule.absolute, rule.relative * r.lower, law_two(v, v, p)}));
    ASSERT_LE(r.steps + r.plane_tests, exact.steps + exact.plane_tests);
    ASSERT_NE(r.status, MarchStatus::NotConverged);
    near += r.status == MarchStatus::Near;
    if (r.status == MarchStatus::Near) {
      ASSERT_EQ(r.lower, 0);
    }
  }
  EXPECT_GE(near, 20);
}

TEST_F(MarchRules, BudgetEndsWithTrueBounds) {
  int ended = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose p = pose();
    const oracle::Truth truth = oracle::distance(points, points, p);
    const MarchStart far{{FeatureKind::Vertex, std::uint32_t(random.bits() % v.vertices.size())},
                         {FeatureKind::Vertex, std::uint32_t(random.bits() % v.vertices.size())}};
    for (std::uint32_t budget = 0; budget < 12; ++budget) {
      MarchRule rule;
      rule.step_budget = budget;
      const MarchResult r = march(v, v, p, far, rule);
      expect_true(v, v, p, truth, r);
      if (HasFatalFailure()) FAIL() << "budget " << budget;
      ASSERT_LE(r.steps, budget + 1);
      if (r.status == MarchStatus::Budget)
        ++ended;
      else
        expect_exact(v, v, p, truth, r);
    }
  }
  EXPECT_GE(ended, 300);
}

TEST_F(MarchRules, BudgetsResumedFromTheirFeaturesEnd) {
  // Boxes in a grid of poses came round for ever: a face, an edge, the face again.
  const Model one = model(bodies::box(1, 2, 0.5)), other = model(bodies::triangulated(bodies::cube()));
  std::uint32_t most = 0;
  const auto expect_end = [&](const ConvexView& a, const ConvexView& b, const Pose& p, std::uint32_t budget) {
    MarchRule rule;
    rule.step_budget = budget;
    MarchResult r = march(a, b, p, {}, rule);
    double upper = kInfinity;
    for (std::uint32_t marches = 1; r.status == MarchStatus::Budget; ++marches) {
      ASSERT_LT(r.upper, upper) << "budget " << budget;
      upper = r.upper;
      r = march(a, b, p, {r.a, r.b}, rule);
      most = std::max(most, marches);
    }
    const MarchResult whole = march(a, b, p);
    ASSERT_EQ(r.status, whole.status);
    ASSERT_NEAR(r.lower, whole.lower, law_two(a, b, p));
  };
  for (int i = 0; i < 2000; ++i) {
    const Pose p{i % 2 ? random.rotation() : Mat3(Mat3::Identity()), 4 * random.in_ball()};
    for (const std::uint32_t budget : {0u, 1u, 2u, 3u, 5u, 13u}) {
      expect_end(one.level(0).view, other.level(0).view, p, budget);
      if (i % 10 == 0) expect_end(v, v, p, budget);
      if (HasFatalFailure()) FAIL() << i;
    }
  }
  std::printf("at most %u marches\n", most);
}

// ---- Status, poses, tags ---------------------------------------------------------------------------------------------------

TEST(March, IllegalPosesAreSaidSo) {
  const Model cube = model(bodies::cube());
  const ConvexView& v = cube.level(0).view;
  const auto expect_invalid = [&](const Pose& pose, bool invalid) {
    const MarchResult r = march(v, v, pose);
    EXPECT_EQ(r.status == MarchStatus::InvalidPose, invalid);
    if (!invalid) return;
    EXPECT_EQ(r.lower, 0);
    EXPECT_EQ(r.upper, kInfinity);
  };
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e46, 1e308}) {
    Pose p;
    p.translation.y() = bad;
    expect_invalid(p, true);
    p = {};
    p.rotation(1, 2) = bad;
    expect_invalid(p, true);
  }
  for (const double off : {0.0, 1e-17, 2e-7, 4.9e-7, 5.1e-7, 1e-3, -4.9e-7, -5.1e-7, -1.0, -2.0}) {
    Pose p{(1 + off) * Mat3::Identity(), {5, 0, 0}};  // R^T R - I is about 2 off; at -2, a reflection, it is 0
    expect_invalid(p, !(std::fabs(2 * off + off * off) <= 1e-6));
  }
  expect_invalid({Mat3::Zero(), {5, 0, 0}}, true);
}

TEST(March, ReflectionsAreAnsweredAsGiven) {
  // R^T R = I: legal, and the truth is of these very doubles.
  const Model m = model(bodies::body_of(shapes::random_polytope(20, 7)));
  const ConvexView& v = m.level(0).view;
  const std::vector<Vec3> points = bodies::points_of(v);
  shapes::Random random(35);
  for (int i = 0; i < 100; ++i) {
    const Pose pose{random.rotation() * Vec3(1, 1, -1).asDiagonal(), random.in_ball() * 3};
    expect_exact(v, v, pose, oracle::distance(points, points, pose), march(v, v, pose));
    if (HasFatalFailure()) FAIL() << i;
  }
}

/// From a vertex and a face, triangular or larger, of either body: behind a mirrored face a walk must not find a minimum.
TEST(March, ReflectionsOfCornersAndFacesAreAnsweredAsGiven) {
  const std::vector<bodies::Polyhedron> shapes{bodies::cube(), bodies::octahedron(), bodies::tetrahedron(1),
                                               bodies::tetrahedron(3)};
  shapes::Random random(36);
  for (const bodies::Polyhedron& a : shapes) {
    for (const bodies::Polyhedron& b : shapes) {
      const Model model_a = model(a), model_b = model(b);
      const ConvexView &view_a = model_a.level(0).view, &view_b = model_b.level(0).view;
      for (int i = 0; i < 150; ++i) {
        const auto steps = [&] { return 0.75 * double(int(random.bits() % 13) - 6); };
        const Mat3 turn = i % 2 ? random.rotation() : Mat3(Mat3::Identity());
        const Pose pose{turn * Vec3(1, 1, -1).asDiagonal(), {steps(), steps(), steps()}};
        const oracle::Truth truth = oracle::distance(a.points, b.points, pose);
        const auto expect_true = [&](const MarchStart& start) {
          const MarchResult r = march(view_a, view_b, pose, start);
          EXPECT_TRUE(oracle::holds(truth, r.lower, r.upper)) << i << ' ' << r.lower << ' ' << truth.distance << ' ' << r.upper;
          EXPECT_EQ(r.status == MarchStatus::Disjoint, r.lower > 0) << i;
        };
        expect_true({});
        for (std::uint32_t f = 0; f < view_b.face_first.size(); ++f)
          expect_true({{FeatureKind::Vertex, f % std::uint32_t(view_a.vertices.size())}, {FeatureKind::Face, f}});
        for (std::uint32_t f = 0; f < view_a.face_first.size(); ++f)
          expect_true({{FeatureKind::Face, f}, {FeatureKind::Vertex, f % std::uint32_t(view_b.vertices.size())}});
      }
    }
  }
}

/// A gem: the intersection of half-spaces, as the polar of a random polytope [Ziegler 1995, sec. 2.3]. Its faces have up to a
/// dozen sides, some of them slivers when it is pressed flat, and are flat up to rounding only.
bodies::Polyhedron gem(std::uint32_t planes, std::uint64_t seed, double flat) {
  const Mesh polar = shapes::random_polytope(planes, seed);
  std::vector<Vec3> corners;
  for (const auto& t : polar.triangles) {
    Mat3 m;
    for (int i = 0; i < 3; ++i) m.row(i) = polar.points[t[std::size_t(i)]];
    const Vec3 corner = m.partialPivLu().solve(Vec3::Ones());
    corners.push_back(corner.cwiseProduct(Vec3(1, 1, flat)));
  }
  return bodies::body_of(shapes::hull(corners));
}

/// The corners of a feature, as the oracle takes them.
std::vector<Vec3> corners_of(const ConvexView& view, FeatureId feature) {
  std::vector<std::uint32_t> indices;
  if (feature.kind() == FeatureKind::Vertex) indices = {feature.index()};
  if (feature.kind() == FeatureKind::Edge) indices = {origin(view, feature.index()), view.half_edges[feature.index()].head};
  if (feature.kind() == FeatureKind::Face)
    for (const std::uint32_t v : FaceLoop(view, feature.index())) indices.push_back(v);
  std::vector<Vec3> corners;
  for (const std::uint32_t v : indices) corners.emplace_back(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z);
  return corners;
}

/// Each step leads to features that are no farther, up to 1e-12, and no walk comes back: between faces that are flat but for
/// the rounding of doubles, from vertices anywhere, behind the body too.
TEST(March, NoStepLeadsAway) {
  const std::vector<Named> all = {{"plate", model(bodies::body_of(shapes::ellipsoid({1, 0.8, 0.02}, 1000, 3)))},
                                  {"gem", model(gem(40, 5, 1))},
                                  {"flat gem", model(gem(60, 6, 0.05))},
                                  {"coin", model(bodies::body_of(shapes::prism(40, 1, 0.1)))},
                                  {"cube", model(bodies::cube())}};
  shapes::Random random(4);
  for (const Named& one : all) {
    for (const Named& other : all) {
      const ConvexView &a = one.view(), &b = other.view();
      const auto any_vertex = [&](const ConvexView& view) {
        return FeatureId{FeatureKind::Vertex, std::uint32_t(random.uniform(0, double(view.vertices.size())))};
      };
      for (int i = 0; i < 40; ++i) {
        const Pose pose{random.rotation(), random.uniform(0.5, 3) * (a.extent + b.extent) / 2 * random.on_sphere()};
        const Motion m = motion(pose);
        const PairView pair = pair_view(a, b, m, 0);
        const FeatureId from_a = any_vertex(a), from_b = any_vertex(b);
        double before = std::numeric_limits<double>::infinity();
        for (std::uint32_t steps = 1;; ++steps) {
          const Walk w = walk(pair, from_a, from_b, PlaneRule::MostViolated, steps);
          ASSERT_NE(w.end, WalkEnd::Stalled);
          if (w.end != WalkEnd::Budget) break;
          const double now = oracle::distance(corners_of(a, w.a), corners_of(b, w.b), pose).distance;
          ASSERT_LE(now, before + 1e-12) << one.name << " and " << other.name << ", " << i << ", step " << steps;
          before = now;
        }
      }
    }
  }
}

/// Between flat triangles, whose two sides are in one place, a few walks come back to where they were. They end there, and the
/// query is answered by other means.
TEST(March, WalksThatComeBackEnd) {
  const Model flat = model(bodies::two_sided(shapes::polygon(3).points));
  const ConvexView& view = flat.level(0).view;
  const std::uint32_t vertices = std::uint32_t(view.vertices.size());
  shapes::Random random(4);
  const auto any_vertex = [&] { return FeatureId{FeatureKind::Vertex, std::uint32_t(random.uniform(0, vertices))}; };
  const std::size_t most = most_steps(view, view);
  int came_back = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Pose pose{random.rotation(), 1.5 * random.on_sphere()};
    const Motion m = motion(pose);
    const PairView pair = pair_view(view, view, m, 0);
    const FeatureId a = any_vertex(), b = any_vertex();
    const Walk w = walk(pair, a, b, PlaneRule::MostViolated, ~0u);
    ASSERT_NE(w.end, WalkEnd::Budget);
    ASSERT_LE(w.steps, most);
    if (w.end != WalkEnd::Stalled) continue;
    ++came_back;
    bool is_cycle = false;
    for (std::uint32_t steps = 1; steps < w.steps && !is_cycle; ++steps) {
      const Walk again = walk(pair, w.a, w.b, PlaneRule::MostViolated, steps);
      is_cycle = again.a == w.a && again.b == w.b;
    }
    EXPECT_TRUE(is_cycle) << i;
    PairSeed cold;
    const Answer answer = distance(flat, flat, pose, cold);
    const MarchResult marched = march(view, view, pose, {a, b});
    EXPECT_EQ(marched.status == MarchStatus::Disjoint, answer.verdict == Verdict::Disjoint) << i;
    EXPECT_LE(marched.lower, answer.upper) << i;
    EXPECT_GE(marched.upper, answer.lower) << i;
  }
  std::printf("%d of 1 000 000 walks came back\n", came_back);
  EXPECT_GE(came_back, 5);
}

/// Coins that nearly lie on each other: the walk goes around the rim from one side to the other, and a look at all sides of a
/// face in every state would make that quadratic.
TEST(March, RimsOfFacesOfManySidesAreWalkedInLinearTime) {
  for (const std::uint32_t sides : {100u, 400u, 1600u}) {
    const Model coin = model(bodies::body_of(shapes::prism(sides, 1, 0.2)));
    const ConvexView& view = coin.level(0).view;
    shapes::Random random(sides);
    std::uint32_t most_tests = 0, most_steps = 0;
    for (int i = 0; i < 40; ++i) {
      Pose pose;
      const double angle = random.uniform(0, 6.28);
      pose.rotation = shapes::rotation(Vec3(std::cos(angle), std::sin(angle), 0), std::pow(10, -random.uniform(1, 6))) *
                      shapes::rotation(Vec3::UnitZ(), random.uniform(0, 6.28));
      pose.translation = Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.35);
      const auto any = [&] { return FeatureId(FeatureKind::Vertex, std::uint32_t(random.uniform(0, 2 * sides))); };
      const MarchResult r = march(view, view, pose, {any(), any()});
      ASSERT_EQ(r.status, MarchStatus::Disjoint);
      most_tests = std::max(most_tests, r.plane_tests), most_steps = std::max(most_steps, r.steps);

      Answer answer;
      answer.status = Status::Converged, answer.verdict = Verdict::Disjoint;
      answer.lower = r.lower, answer.upper = r.upper, answer.normal = r.normal;
      answer.point_a = r.point_a, answer.point_b = r.point_b, answer.feature_a = r.a, answer.feature_b = r.b;
      const Check judged = check(coin, coin, pose, answer);
      EXPECT_TRUE(judged) << sides << " sides, " << i << ": " << judged.message;
    }
    std::printf("%u sides: at most %u steps and %u tests\n", sides, most_steps, most_tests);
    EXPECT_GT(most_steps, sides / 4) << "no walk around the rim: the test tests nothing";
    EXPECT_LT(most_tests, 40 * sides);
  }
}

TEST(March, TagsOfEdgesAndVerticesAreTheLargestBeside) {
  const Model cube = model(bodies::cube());
  ConvexView v = cube.level(0).view;
  EXPECT_EQ(tag(v, {FeatureKind::Face, 3}), 0);
  const std::uint8_t tags[] = {5, 0, 9, 2, 7, 3};
  v.tags = tags;
  for (std::uint32_t f = 0; f < 6; ++f) EXPECT_EQ(tag(v, {FeatureKind::Face, f}), tags[f]);
  for (std::uint32_t h = 0; h < v.half_edges.size(); ++h) {
    EXPECT_EQ(tag(v, {FeatureKind::Edge, h}),
              std::max(tags[v.half_edges[h].face], tags[v.half_edges[v.half_edges[h].twin].face]));
  }
  for (std::uint32_t i = 0; i < v.vertices.size(); ++i) {
    std::uint8_t largest = 0;
    for (std::uint32_t h = 0; h < v.half_edges.size(); ++h) {
      if (v.half_edges[h].head == i) largest = std::max(largest, tags[v.half_edges[h].face]);
    }
    EXPECT_EQ(tag(v, {FeatureKind::Vertex, i}), largest);
  }
  EXPECT_EQ(tag(v, {}), 0);
  const Model segment = model(bodies::segment({0, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(tag(segment.level(0).view, {FeatureKind::Edge, 0}), 0);
}

TEST(March, FeaturesOfAnOverlapAreReadable) {
  const Model cube = model(bodies::cube());
  ConvexView v = cube.level(0).view;
  const std::uint8_t tags[] = {1, 1, 1, 1, 1, 1};
  v.tags = tags;
  shapes::Random random(36);
  for (int i = 0; i < 200; ++i) {
    const MarchResult r = march(v, v, {random.rotation(), random.in_ball()});
    ASSERT_EQ(r.status, MarchStatus::Overlapping);
    ASSERT_EQ(tag(v, r.a), 1);  // and they share a point: features_test.cpp
    ASSERT_EQ(tag(v, r.b), 1);
  }
}

}  // namespace
}  // namespace swiftlet
