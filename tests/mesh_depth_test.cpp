// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Intervals of the signed distance of meshes, held against translations: by -lower along the normal the bodies come apart, and
// no translation by less than -upper that was tried takes them apart.
#include <swiftlet/build_mesh.h>
#include <swiftlet/depth.h>
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "bodies.h"
#include "painted_stack.h"
#include "solid_truth.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  Soup a, b;
  Pose pose;
  bool solid_a, solid_b;
  MeshModel mesh_a = a.mesh(), mesh_b = b.mesh();

  MeshBody body_a(double radius = 0) const { return solid_a ? MeshBody::solid(mesh_a, radius) : MeshBody(mesh_a, radius); }
  MeshBody body_b(double radius = 0) const { return solid_b ? MeshBody::solid(mesh_b, radius) : MeshBody(mesh_b, radius); }
};

Soup closed(Random& r) {
  switch (r.bits() % 5) {
    case 0: return ball(1);
    case 1: return torus(4 + std::uint32_t(r.bits() % 4), 3, r.uniform(0.2, 0.6));
    case 2: return tetrahedron();
    case 3: return box({-1, -1, -1}, {1, 1, 1});
    default: return box(-Vec3(r.uniform(0.2, 1), r.uniform(0.2, 1), 0.4), Vec3(r.uniform(0.2, 1), 1, 0.5));
  }
}
Case any_case(Random& r, int i) {
  Case c{closed(r), scaled(closed(r), i % 5 ? 1 : 0.1), any_pose(r, i % 5 ? 1.5 : 0.6), r.bits() % 3 != 0, r.bits() % 3 != 0};
  if (i % 4 == 1) c = {any(r), any(r), any_pose(r, 1.5), false, false};  // open, tangled, torn
  if (i % 4 == 2) {
    c.pose = {lattice_rotation(r), Vec3::Zero()};
    for (double& x : c.pose.translation) x = double(int(r.bits() % 9) - 4) / 4;
  }
  if (i % 7 == 3) c.pose.rotation.col(0) += 3e-7 * r.in_ball();
  if (i % 9 == 4) {
    const double s = std::ldexp(1, i % 2 ? 120 : -110);
    for (Soup* soup : {&c.a, &c.b}) {
      *soup = scaled(std::move(*soup), s);
      for (Vec3& p : soup->points)
        for (double& x : p) x = std::fabs(x) < 1e-45 ? 0 : x;  // what is too small for a mesh is 0
    }
    c.pose.translation *= s;
  }
  c.mesh_a = c.a.mesh(), c.mesh_b = c.b.mesh();
  c.solid_a = c.solid_a && c.mesh_a.topology().closed(), c.solid_b = c.solid_b && c.mesh_b.topology().closed();
  return c;
}

/// Whether the bodies, B moved by `by`, are surely apart: surfaces in long doubles, insides by rationals.
bool are_apart(const Case& c, const Vec3& by, double radii) {
  const Pose pose{c.pose.rotation, c.pose.translation + by};
  if (brute_force(c.a, c.b, pose) <= radii) return false;
  const auto of_a = triangles<Number>(c.a), of_b = triangles<Number>(c.b, pose);
  // Of a surface in one piece one point tells.
  const auto any_inside = [](const auto& solid, const auto& guest, const MeshModel& mesh) {
    const auto end = mesh.topology().components == 1 ? guest.begin() + 1 : guest.end();
    return std::any_of(guest.begin(), end, [&](const auto& t) { return inside(solid, t[0]); });
  };
  if (c.solid_a && any_inside(of_a, of_b, c.mesh_b)) return false;
  return !(c.solid_b && any_inside(of_b, of_a, c.mesh_a));
}

/// Whether B, moved by -lower along the normal, is apart from A or touches it.
bool parts(const Case& c, const Answer& answer, double bound, double radii = 0) {
  return are_apart(c, (bound - answer.lower) * answer.normal, radii);
}

TEST(MeshDepth, IsBoundedByTranslationsThatSeparateAndThatDoNot) {
  int deep = 0, narrow = 0, tried = 0;
  for (int i = 0; i < 140; ++i) {
    Random random(std::uint64_t(4000 + i));
    const Case c = any_case(random, i);
    const MeshBody a = c.body_a(), b = c.body_b();
    const double bound = tolerance(a, b, c.pose);
    MeshSeed seed;
    for (int again = 0; again < 2; ++again) {  // cold and warm
      const Answer answer = signed_distance(a, b, c.pose, seed);
      ASSERT_TRUE(answer.is_signed);
      ASSERT_LE(answer.lower, answer.upper);
      if (answer.lower > 0) {
        Answer plain = distance(a, b, c.pose);
        plain.is_signed = true;
        if (again == 0) {
          ASSERT_EQ(std::memcmp(&plain, &answer, sizeof plain), 0) << i;
        }
        continue;
      }
      ASSERT_EQ(answer.status, answer.upper - answer.lower <= bound ? Status::Converged : Status::NotConverged) << i;
      ASSERT_TRUE(parts(c, answer, bound)) << i << ": " << answer.lower;
      ASSERT_NEAR(answer.normal.norm(), 1, 1e-15);
      const Check checked = check(a, b, c.pose, answer);
      ASSERT_TRUE(checked) << i << ": " << checked.message;
      narrow += answer.upper - answer.lower <= 0.1 * -answer.upper;
      const auto found_out = [&](const auto& change) {
        Answer wrong = answer;
        change(wrong);
        return !check(a, b, c.pose, wrong);
      };
      ASSERT_TRUE(found_out([&](Answer& w) { w.upper = 10 * answer.lower - 4 * bound, w.lower = 20 * w.upper; }));
      if (!(answer.upper < -4 * bound)) continue;
      ++deep;
      ASSERT_EQ(answer.verdict, Verdict::Overlapping);
      ASSERT_TRUE(found_out([&](Answer& w) { w.lower = w.upper = 0.5 * answer.upper; }));
      for (int k = 0; k < 12; ++k, ++tried) {
        const Vec3 n = k == 0 ? answer.normal : k == 1 ? Vec3(-answer.normal) : random.on_sphere();
        const double length = -answer.upper * (k % 3 == 2 ? random.uniform() : 0.999);
        ASSERT_FALSE(are_apart(c, length * n, 0)) << i << ": moved by " << length << " of " << -answer.upper;
      }
      for (const double threshold : {2 * answer.lower, 0.5 * (answer.lower + answer.upper), 0.5 * answer.upper, 0.0, 1.0}) {
        const Within w = signed_within(a, b, c.pose, threshold);
        ASSERT_TRUE(w.answer.is_signed);
        if (threshold > answer.upper) {
          ASSERT_EQ(w.decision, Decision::Yes) << i << ' ' << threshold;
        } else if (threshold < answer.lower) {
          ASSERT_EQ(w.decision, Decision::No) << i << ' ' << threshold;
        }
        ASSERT_TRUE(w.decision != Decision::Undecided || w.answer.status == Status::NotConverged ||
                    w.answer.upper - w.answer.lower <= bound);
      }
    }
  }
  std::printf("%d overlaps, %d of at most 10 %%; %d translations\n", deep, narrow, tried);
  EXPECT_GE(deep, 80);
  EXPECT_GE(narrow, 20);
}

// Rings that are linked and cross: no plane parts them, but short translations do.
TEST(MeshDepth, OfLinkedRingsIsFarLessThanThatOfTheirHulls) {
  Random random(12);
  const Soup ring = torus(8, 4, 0.25);
  const MeshModel mesh = ring.mesh();
  const Model hull = build(ring.points).value().model;
  std::vector<double> widths, shares;
  int parted = 0;
  for (int i = 0; i < 40; ++i) {
    Case c{ring, ring, {}, true, true};
    c.pose.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    c.pose.translation = Vec3(1, 0, 0) + 0.7 * random.in_ball();
    const Answer answer = signed_distance(MeshBody::solid(mesh), MeshBody::solid(mesh), c.pose);
    if (!(answer.upper < 0)) continue;
    ASSERT_TRUE(parts(c, answer, tolerance(mesh, mesh, c.pose))) << i;
    shares.push_back(answer.lower / signed_distance(hull, hull, c.pose).lower);
    widths.push_back((answer.upper - answer.lower) / -answer.lower);
    // The shortest of many translations that part them is no shorter than what is proved.
    double least = kInfinity;
    for (int k = 0; k < 20; ++k) {
      const double length = -answer.lower * random.uniform(0.5, 1.05);
      const Vec3 by = length * (answer.normal + (k % 2) * random.in_ball()).normalized();
      if (length < least && are_apart(c, by, 0)) least = length;
    }
    ASSERT_GE(least, -answer.upper) << i;
    parted += least < kInfinity;
  }
  std::sort(widths.begin(), widths.end()), std::sort(shares.begin(), shares.end());
  ASSERT_GE(widths.size(), 12u);
  const double width = widths[widths.size() / 2], share = shares[shares.size() / 2];
  std::printf("%zu overlaps, %d parted; medians: width over depth %.3f, depth over that of the hulls %.3f\n", widths.size(),
              parted, width, share);
  EXPECT_GE(parted, 12);
  EXPECT_LT(width, 0.4);
  EXPECT_LT(share, 0.3);
}

TEST(MeshDepth, OfRoundedBodiesHasTheSumOfTheRadiiInIt) {
  int deep = 0, by_radii_alone = 0;
  for (int i = 0; i < 60; ++i) {
    Random random(std::uint64_t(8000 + i));
    Case c = any_case(random, i);
    if (c.mesh_a.extent() > 100 || c.mesh_a.extent() < 0.01) continue;
    c.pose.translation *= random.uniform(1, 2);
    const double ra = random.uniform(0, 0.5), rb = random.uniform(0, 0.3);
    const MeshBody a = c.body_a(ra), b = c.body_b(rb);
    const Answer answer = signed_distance(a, b, c.pose);
    const double bound = tolerance(a, b, c.pose);
    if (answer.lower > 0) continue;
    const Check checked = check(a, b, c.pose, answer);
    ASSERT_TRUE(checked) << i << ": " << checked.message;
    ASSERT_TRUE(parts(c, answer, bound, ra + rb)) << i;
    if (!(answer.upper < -4 * bound)) continue;
    ++deep, by_radii_alone += brute_force(c.a, c.b, c.pose) > 0;
    for (int k = 0; k < 8; ++k) {
      const Vec3 n = k == 0 ? answer.normal : k == 1 ? Vec3(-answer.normal) : random.on_sphere();
      ASSERT_FALSE(are_apart(c, -0.999 * answer.upper * n, ra + rb)) << i;
    }
  }
  EXPECT_GE(deep, 25);
  EXPECT_GE(by_radii_alone, 5);
}

TEST(MeshDepth, OfSolidBoxesAndBallsIsNarrow) {
  const MeshModel cube = box({-1, -1, -1}, {1, 1, 1}).mesh(), round = ball(4).mesh();
  for (const double x : {1.9, 1.5, 1.0, 0.25}) {
    const Answer answer = signed_distance(MeshBody::solid(cube), MeshBody::solid(cube), shift(0.125, x, 0.25));
    EXPECT_LE(answer.lower, -(2 - x));
    EXPECT_GE(answer.upper, -(2 - x));
    EXPECT_NEAR(answer.lower, -(2 - x), 1e-13);
    EXPECT_NEAR(answer.upper, -(2 - x), 1e-13);
    EXPECT_EQ(answer.point_a, answer.point_b);
    const Answer balls = signed_distance(MeshBody::solid(round), MeshBody::solid(round), shift(0.1 * x, x, 0.3 * x));
    EXPECT_NEAR(balls.value(), -(2 - x * std::hypot(0.1, 1.0, 0.3)), 0.02);
    EXPECT_LE(balls.upper - balls.lower, 0.03 * -balls.upper);
  }
  const Answer same = signed_distance(MeshBody::solid(cube), MeshBody::solid(cube), {});
  EXPECT_NEAR(same.lower, -2, 1e-13);
  EXPECT_NEAR(same.upper, -2, 1e-13);
  const Answer beside = signed_distance(MeshBody::solid(cube), MeshBody::solid(cube), shift(2, 0, 0));
  EXPECT_EQ(beside.verdict, Verdict::Touching);
  EXPECT_NEAR(beside.lower, 0, 1e-13);
  EXPECT_NEAR(beside.upper, 0, 1e-13);
}

TEST(MeshDepth, OfAConvexBodyInASolidHoldsTheKernels) {
  const MeshModel cube = box({-1, -1, -1}, {1, 1, 1}).mesh();
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const double ra = i % 3 ? 0 : 0.125, rb = i % 2 ? 0 : 0.25;
    const Pose pose = any_pose(random, 2);
    const Body part = i % 4 ? Body::box({-0.5, -0.5, -0.25}, {0.5, 0.5, 0.25}, rb)
                            : Body::triangle(random.in_ball(), random.in_ball(), random.in_ball(), rb);
    const Answer truth = signed_distance(Body::box({-1, -1, -1}, {1, 1, 1}, ra), part, pose);
    for (const bool swapped : {false, true}) {
      const MeshBody solid = MeshBody::solid(cube, ra), guest = part;
      const Answer answer = swapped ? signed_distance(guest, solid, inverse(pose)) : signed_distance(solid, guest, pose);
      EXPECT_LE(answer.lower, truth.upper + 1e-14) << i;
      EXPECT_GE(answer.upper, truth.lower - 1e-14) << i;
      const Check checked = swapped ? check(guest, solid, inverse(pose), answer) : check(solid, guest, pose, answer);
      EXPECT_TRUE(checked) << checked.message;
    }
  }
}

/// Both are intervals of one depth.
TEST(MeshDepth, WithHullsAgrees) {
  Random random(11);
  int narrower = 0, asked = 0;
  for (int i = 0; i < 60; ++i) {
    const Case c = any_case(random, i);
    const auto hulled = [](const Soup& soup) { return build_mesh(Mesh{soup.points, soup.triangles}).value(); };
    const MeshModel a = hulled(c.a), b = hulled(c.b);
    const Answer plain = signed_distance(c.mesh_a, c.mesh_b, c.pose), answer = signed_distance(a, b, c.pose);
    if (answer.lower > 0) continue;
    const double bound = tolerance(a, b, c.pose);
    ++asked, narrower += answer.lower > plain.lower + 1e-3 * c.mesh_a.extent();
    ASSERT_LE(answer.lower, plain.upper + bound) << i;
    ASSERT_LE(plain.lower, answer.upper + bound) << i;
    Case surfaces = c;
    surfaces.solid_a = surfaces.solid_b = false;
    ASSERT_TRUE(parts(surfaces, answer, bound)) << i;
    const Check checked = check(a, b, c.pose, answer);
    ASSERT_TRUE(checked) << i << ": " << checked.message;
  }
  std::printf("%d of %d are narrower\n", narrower, asked);
  EXPECT_GE(asked, 30);
}

TEST(MeshDepth, OfConvexBodiesIsTheKernels) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Body a = Body::box({-1, -1, -1}, {1, 1, 1}), b = Body::box({-0.5, -0.5, -0.25}, {0.5, 0.5, 0.25}, 0.1);
    const Pose pose = any_pose(random, 2);
    const Answer of_mesh = signed_distance(MeshBody(a), MeshBody(b), pose), plain = signed_distance(a, b, pose);
    EXPECT_EQ(std::memcmp(&of_mesh, &plain, sizeof plain), 0);
    EXPECT_EQ(signed_within(MeshBody(a), MeshBody(b), pose, -0.1).decision, signed_within(a, b, pose, -0.1).decision);
  }
}

/// Each forgery passes if check leaves out one of its proofs.
TEST(MeshDepth, CheckRefusesADepthThatNothingProves) {
  const MeshModel small = scaled(box({-1, -1, -1}, {1, 1, 1}), 0.125).mesh();
  const Body block = Body::box({-1, -1, -1}, {1, 1, 1});
  const Pose pose = shift(1.115, 0.1, 0.2);  // 0.01 deep
  const Answer answer = signed_distance(block, small, pose);
  ASSERT_TRUE(check(block, small, pose, answer)) << check(block, small, pose, answer).message;
  ASSERT_EQ(answer.verdict, Verdict::Overlapping);
  const auto refuses = [&](const Vec3& point_a, const Vec3& point_b, double upper) {
    Answer forged = answer;
    forged.point_a = point_a, forged.point_b = point_b, forged.upper = upper, forged.lower = upper - 0.05;
    return !check(block, small, pose, forged);
  };
  EXPECT_TRUE(refuses(Vec3::Zero(), answer.point_b, -0.9)) << "a ball in one body alone";
  EXPECT_TRUE(refuses({1e-80, 0, 0}, {1e-80, 0, 0}, -999)) << "a ball around no point of the kernel's";
  Answer aside = intersects(block, small, pose);
  aside.point_a = aside.point_b = {1e-80, 0, 0};
  EXPECT_FALSE(check(block, small, pose, aside)) << "so little is 0, and not in the small one";
  const Model nested = bodies::nested();
  const Result<Model> cut = nested.cut({.deviation = 0.5 * nested.level(nested.level_count() - 1).deviation});
  ASSERT_TRUE(cut);
  ASSERT_GT(cut.value().finest_level(), 0);
  const Pose deep = shift(0.1, 0, 0);
  const Body coarse(cut.value());
  Answer shallow = signed_distance(coarse, small, deep);
  shallow.lower = shallow.upper = -1e-6;
  shallow.status = Status::Converged;
  EXPECT_FALSE(check(coarse, small, deep, shallow)) << "a translation that does not part them";
}

TEST(MeshDepth, SaysWhatItDoesNotKnow) {
  const MeshModel cube = box({-1, -1, -1}, {1, 1, 1}).mesh();
  Soup open = box({-1, -1, -1}, {1, 1, 1});
  open.triangles.pop_back();
  const MeshModel half = open.mesh();
  Pose bad;
  bad.translation[0] = std::numeric_limits<double>::quiet_NaN();
  const auto expect_nothing = [](const Answer& answer, Status status) {
    EXPECT_EQ(answer.status, status);
    EXPECT_EQ(answer.lower, -kInfinity);
    EXPECT_EQ(answer.upper, kInfinity);
    EXPECT_TRUE(answer.is_signed);
    EXPECT_TRUE(answer.normal.hasNaN() && answer.point_a.hasNaN() && answer.point_b.hasNaN());
  };
  expect_nothing(signed_distance(cube, cube, bad), Status::InvalidPose);
  expect_nothing(signed_distance(MeshBody::solid(half), cube, {}), Status::InvalidBody);
  expect_nothing(signed_distance(MeshBody(cube, -1), cube, {}), Status::InvalidRadius);
  for (const double threshold : {-0.5, 0.0, 0.5, std::numeric_limits<double>::quiet_NaN()})
    expect_nothing(signed_within(cube, cube, bad, threshold).answer, Status::InvalidPose);
  for (const std::uint32_t steps : {0u, 1u, 3u, 30u}) {
    const Answer answer = signed_distance(cube, cube, shift(1, 0.5, 0.25), {.budget = {.steps = steps}});
    EXPECT_LE(answer.lower, -1);
    EXPECT_GE(answer.upper, -1);
  }
  EXPECT_EQ(signed_within(cube, cube, shift(3, 0, 0), 0.5).decision, Decision::No);
  const Within near = signed_within(cube, cube, shift(3, 0, 0), 1.5);
  EXPECT_EQ(near.decision, Decision::Yes);
  EXPECT_EQ(near.answer.lower, -kInfinity) << "whether they overlap was not asked";
}

TEST(MeshDepth, IsAnsweredInBatchesAsAlone) {
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    const Case c = any_case(random, i);
    const MeshPairQuery pair{c.body_a(), c.body_b(), c.pose};
    const Answer alone = signed_distance(pair.a, pair.b, pair.b_in_a);
    Answer of_pairs, of_poses;
    signed_distance(std::span(&pair, 1), std::span(&of_pairs, 1));
    signed_distance(pair.a, pair.b, std::span(&c.pose, 1), std::span(&of_poses, 1));
    EXPECT_EQ(std::memcmp(&alone, &of_pairs, sizeof alone), 0);
    EXPECT_EQ(std::memcmp(&alone, &of_poses, sizeof alone), 0);
    Within by_pairs, by_poses;
    const double threshold = -0.1 * c.mesh_a.extent();
    signed_within(std::span(&pair, 1), threshold, std::span(&by_pairs, 1));
    signed_within(pair.a, pair.b, std::span(&c.pose, 1), threshold, std::span(&by_poses, 1));
    const Decision decision = signed_within(pair.a, pair.b, pair.b_in_a, threshold).decision;
    EXPECT_EQ(by_pairs.decision, decision);
    EXPECT_EQ(by_poses.decision, decision);
  }
}

TEST(MeshDepth, UsesTheStackThatItsCostLineSays) {
  Random random(5);
  PaintedStack stack;
  std::size_t most = 0;
  for (int i = -1; i < 60; ++i) {
    const Case c = any_case(random, i + 1);
    const std::size_t used = stack.use([&] { signed_distance(c.body_a(), c.body_b(), c.pose); });
    if (i >= 0) most = std::max(most, used);
  }
  std::printf("bytes of stack: %zu\n", most);
  EXPECT_GE(most, 10000u) << "nothing was measured";
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(most, 37'000u);
}

}  // namespace
}  // namespace swiftlet
