// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The laws, for the signed distance: how deep bodies overlap, judged by rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/depth.h>

#include "case.h"
#include "oracle.h"
#include "shapes.h"
#include "suite.h"
#include "tolerance.h"

namespace swiftlet {
namespace {

using Points = std::vector<Vec3>;

struct Body {
  Points points;
  Model model;
};
Body body(const Points& points, const BuildOptions& options = {}) {
  Result<Built> built = build(points, options);
  if (!built) throw std::runtime_error(built.error().message);
  return {points, built.value().model};
}
Body body(const Mesh& mesh) { return body(mesh.points); }

double extent(const Points& points) {
  double most = 0;
  for (const Vec3& p : points) most = std::max(most, p.cwiseAbs().maxCoeff());
  return most;
}
/// Law 2's bound.
double bound_of(const Body& a, const Body& b, const Pose& pose) {
  const double error = (pose.rotation.transpose() * pose.rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
  return (64 * 0x1p-53 + 2 * error) * (std::max(extent(a.points), extent(b.points)) + pose.translation.norm());
}

std::string describe(const SignedAnswer& s) {
  char text[400];
  std::snprintf(text, sizeof text, "[%.17g, %.17g] width %.3g status %d verdict %d normal (%.9g, %.9g, %.9g) steps %u", s.lower,
                s.upper, s.upper - s.lower, int(s.status), int(s.verdict), s.normal[0], s.normal[1], s.normal[2], s.steps);
  return text;
}

/// What is wrong with an exact answer; empty if nothing.
std::string fault(const Body& a, const Body& b, const Pose& pose, const SignedAnswer& s) {
  const double bound = bound_of(a, b, pose);
  const oracle::SignedTruth truth = oracle::signed_distance(a.points, Pose{}, b.points, pose);
  std::string wrong;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) wrong += std::string(what) + "; ";
  };
  require(s.status == Status::Converged, "not converged");
  require(oracle::compare(truth, s.lower) >= 0, "lower is above the truth");
  require(oracle::compare(truth, s.upper) <= 0, "upper is below the truth");
  require(s.upper - s.lower <= bound, "wider than law 2");
  require(s.verdict != Verdict::Disjoint || truth.sign > 0, "disjoint");
  require(s.verdict != Verdict::Overlapping || truth.sign <= 0, "overlapping");
  require(s.verdict != Verdict::Touching || std::abs(truth.distance) <= bound, "touching");
  require(s.verdict != Verdict::Undecided, "undecided");
  require(std::abs(s.normal.norm() - 1) <= 1e-15, "normal is no unit");
  require(oracle::gap(a.points, b.points, pose, s.normal).upper >= s.lower, "the normal does not prove lower");
  require((s.point_b - s.point_a - s.normal * (s.lower + s.upper) / 2).norm() <= 2 * bound, "points");
  const Pose back{pose.rotation, pose.translation};
  require(oracle::distance(a.points, Points{s.point_a}, Pose{}).bounds.lower <= bound, "point_a off A");
  require(oracle::distance(Points{s.point_b}, b.points, back).bounds.lower <= bound, "point_b off B");
  if (!wrong.empty()) {
    char text[100];
    std::snprintf(text, sizeof text, " truth %.17g bound %.3g", truth.distance, bound);
    wrong += describe(s) + text;
  }
  return wrong;
}

TEST(SignedDistance, KnowsTwoCubes) {
  const Body cube = body(shapes::cube());
  for (const double x : {5., 2.5, 2., 1.5, .25, 0., -1.5}) {
    const Pose pose{Mat3::Identity(), {x, .125, -.125}};
    PairSeed seed;
    for (int round = 0; round < 3; ++round) {
      const SignedAnswer s = signed_distance(cube.model, cube.model, pose, seed);
      EXPECT_EQ(fault(cube, cube, pose, s), "") << x << " " << round;
    }
  }
}

TEST(SignedDistance, HoldsTheTruthOfRandomOverlaps) {
  shapes::Random random(41);
  int overlapping = 0;
  std::uint32_t most = 0;
  for (int i = 0; i < 300; ++i) {
    Points p, q;
    const int n = 4 + int(random.bits() % 12);
    for (int k = 0; k < n; ++k) p.push_back(random.in_ball()), q.push_back(random.in_ball());
    const Body a = body(p), b = body(q);
    const Pose pose{random.rotation(), random.in_ball() * .7};
    PairSeed seed;
    for (int round = 0; round < 2; ++round) {
      const SignedAnswer s = signed_distance(a.model, b.model, pose, seed);
      EXPECT_EQ(fault(a, b, pose, s), "") << i << " round " << round;
      overlapping += s.verdict == Verdict::Overlapping;
      most = std::max(most, s.steps);
    }
  }
  std::printf("%d overlapping, at most %u steps\n", overlapping, most);
  EXPECT_GE(overlapping, 150);
}

TEST(SignedDistance, HoldsTheTruthOfTheSuite) {
  int overlapping = 0;
  for (const auto& file : stability::suite_files()) {
    for (const stability::Case& c : stability::read_cases(file)) {
      const Body a = body(c.a), b = body(c.b);
      const Pose pose = c.b_in_a();
      PairSeed seed;
      for (int round = 0; round < 2; ++round) {
        const SignedAnswer s = signed_distance(a.model, b.model, pose, seed);
        EXPECT_EQ(fault(a, b, pose, s), "") << c.name << " round " << round;
        overlapping += s.verdict == Verdict::Overlapping;
      }
    }
  }
  std::printf("%d overlapping\n", overlapping);
}

}  // namespace
}  // namespace swiftlet
