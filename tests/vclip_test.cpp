// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The baseline deserves its name: V-Clip answers as the oracle does while bodies are disjoint, and takes the published number
// of states on the orbit. Knows vclip.h; nothing of march but the views.
#include "vclip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using yardstick::VclipBody;
using yardstick::VclipEnd;
using yardstick::VclipResult;
using yardstick::VclipSeed;

struct Shape {
  Mesh mesh;
  Model model;
  VclipBody body;
  explicit Shape(Mesh m) : mesh(std::move(m)), model(build(mesh).value().model), body(model.level(0).view) {}
};

/// Asks about random poses, warm start kept, until `count` of them were disjoint.
void expect_agreement(const std::string& name, const Shape& a, const Shape& b, int count, std::uint64_t seed_of_poses) {
  shapes::Random random(seed_of_poses);
  const double reach = a.model.radius() + b.model.radius(), tolerance = 64 * 0x1p-53 * 4 * reach;
  int disjoint = 0, overlapping = 0;
  double worst = 0;
  VclipSeed seed;
  while (disjoint < count) {
    ASSERT_LT(overlapping, 20 * count + 100) << name << " overlaps too often";
    const Pose pose{random.rotation(), random.on_sphere() * random.uniform(0.1, 1.3) * reach};
    const oracle::Truth truth = oracle::distance(a.mesh.points, b.mesh.points, pose);
    const VclipResult r = yardstick::vclip(a.body, b.body, pose, seed);
    ASSERT_NE(r.end, VclipEnd::Capped) << name << " pose " << disjoint + overlapping;
    ASSERT_EQ(r.penetrating(), truth.overlapping)
        << name << " pose " << disjoint + overlapping << " distance " << truth.distance;
    if (truth.overlapping) {
      ++overlapping;
      continue;
    }
    ++disjoint;
    const double error =
        std::max(std::fabs(r.distance - truth.distance), std::fabs((r.point_b - r.point_a).norm() - truth.distance));
    worst = std::max(worst, error);
    ASSERT_LE(error, tolerance) << name << " pose " << disjoint + overlapping;
  }
  std::printf("%s: %d disjoint, %d overlapping, largest error %.2g\n", name.c_str(), disjoint, overlapping, worst);
}

class VclipFamily : public testing::TestWithParam<shapes::Family> {};

TEST_P(VclipFamily, AgreesWithTheOracle) {
  const shapes::Pair pair = shapes::pair(GetParam(), 2000);
  expect_agreement(shapes::name(GetParam()), Shape(pair.a), Shape(pair.b), 2000, 11 + std::uint64_t(GetParam()));
}

/// [Mirtich 1997] on the orbit of [Ehmann & Lin 2000]: what V-Clip 1.0 took on other orbits of the same definition, a body
/// against itself. Twenty orbits give a mean within a few per cent.
TEST_P(VclipFamily, TakesThePublishedNumberOfStates) {
  constexpr std::array speeds{0.5, 2.0, 10.0, 40.0, 80.0, 160.0};
  constexpr double published[3][6] = {
      {2.0, 4.6, 18.2, 58.7, 95.5, 129}, {1.9, 4.3, 16.9, 55.4, 91.7, 125}, {1.8, 4.0, 14.8, 51.1, 88.7, 119}};
  const Shape shape(shapes::pair(GetParam(), 2000).a);
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    std::uint64_t states = 0;
    for (std::uint64_t orbit = 0; orbit < 20; ++orbit) {
      const shapes::Orbit motion(100 + orbit, 2, speeds[k]);
      VclipSeed seed;
      for (std::uint64_t i = 1; i <= 500; ++i)
        states += yardstick::vclip(shape.body, shape.body, motion.pose(i), seed).steps + 1;
    }
    const double expected = published[std::size_t(GetParam())][k];
    EXPECT_NEAR(double(states) / 1e4, expected, 0.1 * expected) << speeds[k] << " degrees";
  }
}

INSTANTIATE_TEST_SUITE_P(Families, VclipFamily, testing::ValuesIn(shapes::kFamilies),
                         [](const auto& family) { return std::string(shapes::name(family.param)); });

TEST(Vclip, AgreesWithTheOracleOnFewFaces) {
  const Shape cube(shapes::cube()), box(shapes::box({1, 2, 4})), prism(shapes::prism(60, 1, 0.2)), needle(shapes::needle());
  const Shape octahedron(shapes::octahedron()), meshed(shapes::meshed_cube(5));
  expect_agreement("cube and cube", cube, cube, 1000, 1);
  expect_agreement("cube and box", cube, box, 500, 2);
  expect_agreement("prism and prism", prism, prism, 1000, 3);
  expect_agreement("prism and cube", prism, cube, 500, 4);
  expect_agreement("needle and meshed cube", needle, meshed, 500, 5);
  expect_agreement("octahedron and prism", octahedron, prism, 500, 6);
}

TEST(Vclip, SurvivesSeedsThatNameNothing) {
  const Shape cube(shapes::cube());
  Pose apart;
  apart.translation = {5, 0.25, 0.5};
  for (const FeatureKind kind : {FeatureKind::None, FeatureKind::Vertex, FeatureKind::Edge, FeatureKind::Face}) {
    VclipSeed seed{{kind, 1000}, {kind, 3}};
    EXPECT_DOUBLE_EQ(yardstick::vclip(cube.body, cube.body, apart, seed).distance, 3);
    VclipSeed faces{{kind, 0}, {kind, 0}};
    EXPECT_DOUBLE_EQ(yardstick::vclip(cube.body, cube.body, apart, faces).distance, 3);
  }
}

}  // namespace
}  // namespace swiftlet
