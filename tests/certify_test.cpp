// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Certificates and supports against exact arithmetic, from features that are nearest and from any others. Knows certify.h.
#include "pair/certify.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <swiftlet/build.h>

#include "bodies.h"
#include "body/half_edge.h"
#include "oracle.h"
#include "pair/walk.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using shapes::Random;

std::vector<Model> models() {
  std::vector<Model> result;
  for (const Mesh& mesh : {shapes::pair(shapes::Family::Fat, 200).a, shapes::pair(shapes::Family::Plate, 200).b, shapes::cube(),
                           shapes::meshed_cube(3), shapes::prism(24, 1, 0.2), shapes::needle(), shapes::sliver(),
                           shapes::dodecahedron(), shapes::tetrahedron()}) {
    result.push_back(bodies::must(build(mesh)).model);
  }
  return result;
}

std::vector<Vec3> points(const ConvexView& view) {
  std::vector<Vec3> result;
  for (const Vertex& v : view.vertices) result.emplace_back(v.x, v.y, v.z);
  return result;
}

FeatureId any_feature(Random& random, const ConvexView& view) {
  const auto below = [&](std::size_t n) { return std::uint32_t(random.bits() % n); };
  switch (random.bits() % 3) {
    case 0: return {FeatureKind::Vertex, below(view.vertices.size())};
    case 1: return {FeatureKind::Edge, below(view.half_edges.size())};
    default: return {FeatureKind::Face, below(view.face_first.size())};
  }
}

/// Two bodies and a pose between them, as certificates see them.
struct Trial {
  const ConvexView &a, &b;
  Pose pose;
  std::vector<Vec3> points_a = points(a), points_b = points(b);
  Motion b_in_a = motion(pose);
  PairView pair_view() const { return swiftlet::pair_view(a, b, b_in_a, 4e-16); }
};

/// Rotations of a cube too, so that faces and edges are parallel.
template <class Visit>
void each_trial(int rounds, Visit visit) {
  const std::vector<Model> all = models();
  Random random(41);
  for (int round = 0; round < rounds; ++round) {
    for (const Model& a : all) {
      for (const Model& b : all) {
        Pose pose{round % 3 == 0 ? Mat3(Mat3::Identity()) : random.rotation(), random.on_sphere() * random.uniform(0.1, 4)};
        if (round % 3 == 1) pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
        visit(Trial{a.level(0).view, b.level(0).view, pose}, random);
      }
    }
  }
}

TEST(Certify, FromAnyFeaturesTheIntervalHoldsTheDistance) {
  int parted = 0, trials = 0, proved = 0;
  each_trial(6, [&](const Trial& t, Random& random) {
    const oracle::Truth truth = oracle::distance(t.points_a, t.points_b, t.pose);
    for (int k = 0; k < 6; ++k) {
      FeatureId fa = any_feature(random, t.a), fb = any_feature(random, t.b);
      if (fa.kind() == FeatureKind::Face && fb.kind() == FeatureKind::Face) fb = {FeatureKind::Vertex, any_vertex(t.b, fb)};
      if (k >= 3) {
        const Walk end = walk(t.pair_view(), fa, fb, PlaneRule::MostViolated, ~0u);
        fa = end.a, fb = end.b;
        if (Proof proof; end.end == WalkEnd::Minimum && certify(t.pair_view(), end.nearest, proof) == Doubt::None) {
          EXPECT_TRUE(oracle::holds(truth, proof.lower, proof.upper))
              << proof.lower << " " << truth.distance << " " << proof.upper;
          ++proved;
        }
      }
      std::uint32_t tests = 0;
      const Certificate c = certify(t.pair_view(), witness(t.pair_view(), fa, fb), tests);
      EXPECT_TRUE(oracle::holds(truth, c.lower, c.upper)) << c.lower << " " << truth.distance << " " << c.upper;
      ++trials;
      parted += c.lower > 0;
    }
  });
  EXPECT_GE(parted, trials / 3);
  EXPECT_GE(proved, trials / 10);
}

TEST(Certify, SupportsProveTheGapAlongAnyDirection) {
  int along_faces = 0;
  each_trial(4, [&](const Trial& t, Random& random) {
    for (int k = 0; k < 4; ++k) {
      Vec n = vec(random.on_sphere());
      const std::uint32_t f = std::uint32_t(random.bits() % t.a.face_first.size());
      if (k % 2 == 1) {  // level with a whole face, up to rounding
        const std::uint32_t h = t.a.face_first[f], v = origin(t.a, h);
        const Vec p = vec(t.a.vertices[v]);
        n = normalised(cross(vec(t.a.vertices[t.a.half_edges[h].head]) - p,
                             vec(t.a.vertices[t.a.half_edges[next_in_facet(t.a, h)].head]) - p));
        ++along_faces;
      }
      std::uint32_t tests = 0;
      const Supports s = supports(t.pair_view(), n, std::uint32_t(random.bits() % t.a.vertices.size()),
                                  std::uint32_t(random.bits() % t.b.vertices.size()), tests);
      const oracle::Interval gap = oracle::gap(t.points_a, t.points_b, t.pose, eigen(n));
      EXPECT_LE(s.lower, gap.upper);
      EXPECT_GE(s.lower, gap.lower - t.pair_view().law_two);
    }
  });
  EXPECT_GE(along_faces, 500);
}

/// On smooth bodies the tests that end a walk are the proof, but for some whose rounding is wider than law 2's bound.
TEST(Certify, WalksOnSmoothBodiesProveWhereTheyEnd) {
  const shapes::Pair pair = shapes::pair(shapes::Family::Fat, 2000);
  const Model a = bodies::must(build(pair.a)).model, b = bodies::must(build(pair.b)).model;
  Random random(42);
  constexpr int kTrials = 500;
  int proved = 0;
  for (int k = 0; k < kTrials; ++k) {
    const Trial t{a.level(0).view, b.level(0).view, {random.rotation(), random.on_sphere() * 2.2}};
    const Walk end = walk(t.pair_view(), {FeatureKind::Vertex, 0}, {FeatureKind::Vertex, 0}, PlaneRule::MostViolated, ~0u);
    ASSERT_EQ(end.end, WalkEnd::Minimum);
    Proof proof;
    const Doubt doubt = certify(t.pair_view(), end.nearest, proof);
    EXPECT_TRUE(doubt == Doubt::None || doubt == Doubt::Width) << int(doubt);
    proved += doubt == Doubt::None;
  }
  EXPECT_GE(proved, kTrials * 99 / 100);
}

}  // namespace
}  // namespace swiftlet
