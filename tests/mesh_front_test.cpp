// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Fronts change the work, never the truth: walks of pairs of meshes, asked with fronts of any capacity, stale and fresh,
// against cold queries and brute force over all pairs of triangles.
#include <swiftlet/mesh_front.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "numeric/width.h"
#include "painted_stack.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

/// B turns and drifts about A by little each time, near contact mostly, and now and then jumps.
class Walk {
 public:
  Walk(Soup a, Soup b, std::uint64_t seed, double degrees)
      : soup_a(std::move(a)),
        soup_b(std::move(b)),
        mesh_a(soup_a.mesh()),
        mesh_b(soup_b.mesh()),
        random_(seed),
        degrees_(degrees) {
    jump();
  }
  const Pose& next() {
    constexpr int kJump = 60;
    if (++steps_ % kJump == 0) jump();
    const double angle = degrees_ * std::acos(-1) / 180;
    pose.rotation = Eigen::AngleAxisd(angle, axis_).toRotationMatrix() * pose.rotation;
    pose.translation += angle * (drift_ + 0.2 * random_.in_ball());
    if (const Answer apart = distance(mesh_a, mesh_b, pose); apart.lower > 0.02) {
      pose.translation -= (1 - 0.01 * random_.uniform(0.1, 1) / apart.lower) * (apart.point_b - apart.point_a);
    } else if (apart.upper == 0 && steps_ % 3 != 0) {
      pose.translation += 2 * angle * pose.translation.normalized();
    }
    return pose;
  }

  Soup soup_a, soup_b;
  MeshModel mesh_a, mesh_b;
  Pose pose;

 private:
  void jump() {
    axis_ = random_.on_sphere(), drift_ = random_.in_ball();
    pose = {random_.rotation(), 1.5 * random_.on_sphere()};
  }

  Random random_;
  double degrees_;
  Vec3 axis_, drift_;
  int steps_ = 0;
};

std::vector<Walk> walks() {
  Random random(3);
  const Soup waves = patch(14, [](double x, double y) { return 0.3 * std::sin(3 * x) * std::cos(2 * y); });
  Soup dented = ball(3);
  for (Vec3& p : dented.points) p *= 0.9 + 0.1 * std::sin(7 * p.x()) * std::cos(5 * p.y());
  std::vector<Walk> all;
  all.emplace_back(torus(24, 12), dented, 1, 0.1);
  all.emplace_back(dented, waves, 2, 0.5);
  all.emplace_back(waves, torus(20, 10), 3, 0.02);
  all.emplace_back(scattered(random, 300, 0.2), dented, 4, 0.2);
  all.emplace_back(tangled(random, 60, 120), scattered(random, 200, 0.3), 5, 3);
  all.emplace_back(dented, dented, 6, 0.1);
  return all;
}

/// Every answer of the pose against a cold one.
void expect_truth(const MeshBody& a, const MeshBody& b, const Pose& pose, MeshSeed& seed, MeshFront& front) {
  const double law_two = tolerance(a, b, pose);
  const Answer cold = distance(a, b, pose);
  const Answer met = intersects(a, b, pose, seed, front);
  ASSERT_EQ(met.verdict, cold.verdict);
  ASSERT_LE(met.lower, cold.upper);
  ASSERT_GE(met.upper, cold.lower);
  const Answer exact = distance(a, b, pose, seed, front);
  ASSERT_EQ(exact.status, Status::Converged);
  ASSERT_EQ(exact.verdict, cold.verdict);
  ASSERT_LE(exact.upper - exact.lower, law_two);
  ASSERT_LE(std::fabs(exact.lower - cold.lower), law_two);
  ASSERT_LE(std::fabs(exact.upper - cold.upper), law_two);
  for (const double factor : {0.0, 0.5, 0.99, 1.0, 1.01, 2.0}) {
    const double threshold = factor * cold.upper;
    ASSERT_EQ(within(a, b, pose, threshold, seed, front).decision, within(a, b, pose, threshold).decision) << factor;
  }
  const ClosestFeatures closest = closest_features(a, b, pose, seed, front);
  ASSERT_LE(std::fabs(closest.answer.upper - cold.upper), law_two);
  ASSERT_EQ(closest.answer.verdict, cold.verdict);
  for (const Options& options : {Options{.relative = 0.1}, Options{.absolute = 0.01}, Options{.beyond = 0.5 * cold.upper}}) {
    const Answer loose = distance(a, b, pose, seed, front, options);
    ASSERT_LE(loose.lower, cold.upper);
    ASSERT_GE(loose.upper, cold.lower);
    ASSERT_NE(loose.status, Status::NotConverged);
  }
}

TEST(MeshFront, OfAnyCapacityChangesNoAnswer) {
  std::size_t most = 0;
  for (Walk& walk : walks()) {
    std::vector<MeshFront> fronts;
    for (const std::size_t capacity : {0, 1, 8, 40, 200, 16384}) fronts.emplace_back(capacity);
    std::vector<MeshSeed> seeds(fronts.size());
    for (int i = 0; i < 240; ++i) {
      const Pose& pose = walk.next();
      for (std::size_t k = 0; k < fronts.size(); ++k) {
        expect_truth(walk.mesh_a, walk.mesh_b, pose, seeds[k], fronts[k]);
        if (testing::Test::HasFatalFailure()) FAIL() << i << ' ' << k;
        ASSERT_LE(fronts[k].size(), fronts[k].capacity());
        most = std::max(most, fronts[k].size());
      }
    }
  }
  EXPECT_GE(most, 500u);
  EXPECT_EQ(MeshFront(1).capacity(), 0u);
  EXPECT_EQ(MeshFront(40).capacity(), 40u);
}

TEST(MeshFront, IntervalsHoldTheTruth) {
  int used = 0;
  for (Walk& walk : walks()) {
    MeshFront front;
    MeshSeed seed;
    for (int i = 0; i < 60; ++i) {
      const Answer answer = distance(walk.mesh_a, walk.mesh_b, walk.next(), seed, front);
      used += front.size() > 0;
      if (i % 10 != 9) continue;
      const double truth = brute_force(walk.soup_a, walk.soup_b, walk.pose);
      const double slack = tolerance(walk.mesh_a, walk.mesh_b, walk.pose) / 64;
      ASSERT_LE(answer.lower, truth + slack) << i;
      ASSERT_GE(answer.upper, truth - slack) << i;
      const Check checked = check(walk.mesh_a, walk.mesh_b, walk.pose, answer);
      ASSERT_TRUE(checked) << checked.message;
    }
  }
  EXPECT_GE(used, 60);
}

TEST(MeshFront, SavesWorkWhereBodiesMoveLittle) {
  Walk walk(torus(48, 24), ball(4), 1, 0.05);
  MeshFront front;
  MeshSeed warm, with_front;
  double plain = 0, saved = 0;
  for (int i = 0; i < 50; ++i) {
    const Pose& pose = walk.next();
    plain += intersects(walk.mesh_a, walk.mesh_b, pose, warm).steps;
    saved += intersects(walk.mesh_a, walk.mesh_b, pose, with_front, front).steps;
  }
  EXPECT_GT(front.size(), 0u);
  EXPECT_LT(saved, 0.5 * plain);
  front.clear();
  EXPECT_EQ(front.size(), 0u);
}

TEST(MeshFront, UsesTheStackThatTheHeaderTells) {
  Walk walk(torus(24, 12), ball(3), 1, 0.1);
  MeshFront front;
  MeshSeed plain_seed, seed;
  PaintedStack stack;
  std::size_t plain = 0, most = 0;
  for (int i = -5; i < 40; ++i) {
    const Pose& pose = walk.next();
    const std::size_t used = stack.use([&] { distance(walk.mesh_a, walk.mesh_b, pose, plain_seed); }),
                      used_with = stack.use([&] { distance(walk.mesh_a, walk.mesh_b, pose, seed, front); });
    if (i < 0) continue;  // what is called for the first time is looked up by the loader, on this stack
    plain = std::max(plain, used), most = std::max(most, used_with);
  }
  EXPECT_GT(front.size(), 0u);
  std::printf("bytes of stack: %zu, with a front %zu\n", plain, most);
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(plain, 22'000u);
  EXPECT_LE(most, plain + (7u << 10));
}

/// Law 1, and what a budget left to do is done next time.
TEST(MeshFront, ThatABudgetEndedLosesNothing) {
  int ended = 0;
  Random random(7);
  for (Walk& walk : walks()) {
    MeshFront front(4096);
    MeshSeed seed;
    for (int i = 0; i < 200; ++i) {
      const Pose& pose = walk.next();
      const Answer cold = distance(walk.mesh_a, walk.mesh_b, pose);
      const auto steps = std::uint32_t(random.bits() % 40);
      const Answer short_of = distance(walk.mesh_a, walk.mesh_b, pose, seed, front, {.budget = {.steps = steps}});
      ASSERT_LE(short_of.lower, cold.upper);
      ASSERT_GE(short_of.upper, cold.lower);
      ASSERT_TRUE(short_of.status == Status::Budget || short_of.status == Status::Converged);
      ASSERT_LE(short_of.steps + short_of.plane_tests, steps + 2);
      ended += short_of.status == Status::Budget;
      if (i % 3 == 0) expect_truth(walk.mesh_a, walk.mesh_b, pose, seed, front);
      if (testing::Test::HasFatalFailure()) FAIL() << i;
    }
  }
  EXPECT_GE(ended, 200);
}

TEST(MeshFront, OfOtherBodiesStartsAnew) {
  std::vector<Walk> all = walks();
  MeshFront front;
  MeshSeed seed;
  for (int i = 0; i < 300; ++i) {
    Walk& walk = all[std::size_t(i) / 20 % all.size()];
    const Pose& pose = walk.next();
    switch (i % 40) {
      case 7: expect_truth(walk.mesh_b, walk.mesh_a, inverse(pose), seed, front); break;
      case 13: expect_truth(walk.mesh_a, Body::box({-0.5, -0.25, -0.5}, {0.5, 0.25, 0.5}), pose, seed, front); break;
      case 19: expect_truth(MeshBody(walk.mesh_a, 0.01), MeshBody(walk.mesh_b, 0.02), pose, seed, front); break;
      case 29: {
        const MeshModel cut = walk.mesh_a.cut({.deviation = 1e9});
        const Answer of_boxes = distance(cut, walk.mesh_b, pose, seed, front);
        ASSERT_LE(of_boxes.lower, distance(walk.mesh_a, walk.mesh_b, pose).upper);
        break;
      }
      default: expect_truth(walk.mesh_a, walk.mesh_b, pose, seed, front);
    }
    if (testing::Test::HasFatalFailure()) FAIL() << i;
  }
  const auto solid = [](const MeshModel& mesh) { return MeshBody::solid(mesh); };
  for (int i = 0; i < 60; ++i) expect_truth(solid(all.back().mesh_a), solid(all.back().mesh_b), all.back().next(), seed, front);
}

TEST(MeshFront, OfAMeshThatWasRefittedStartsAnew) {
  Walk walk(torus(24, 12), ball(3), 1, 0.1);
  MeshFront front;
  MeshSeed seed;
  Random random(8);
  for (int i = 0; i < 120; ++i) {
    if (i % 15 == 14) {  // in the place of the old one, perhaps at its address
      const Vec3 wave = 4 * random.in_ball(), way = 0.2 * random.in_ball();
      for (Vec3& p : walk.soup_a.points) p += std::sin(wave.dot(p)) * way;
      walk.mesh_a = refit(walk.mesh_a, walk.soup_a.points).value();
    }
    const Pose& pose = walk.next();
    expect_truth(walk.mesh_a, walk.mesh_b, pose, seed, front);
    if (testing::Test::HasFatalFailure()) FAIL() << i;
    if (i % 15 != 14) continue;
    const double truth = brute_force(walk.soup_a, walk.soup_b, pose);
    ASSERT_NEAR(distance(walk.mesh_a, walk.mesh_b, pose, seed, front).upper, truth,
                2 * tolerance(walk.mesh_a, walk.mesh_b, pose));
  }
}

TEST(MeshFront, IsMovedAndThenEmpty) {
  Walk walk(torus(24, 12), ball(3), 1, 0.1);
  MeshFront front, other(64);
  MeshSeed seed;
  for (int i = 0; i < 20; ++i) expect_truth(walk.mesh_a, walk.mesh_b, walk.next(), seed, front);
  other = std::move(front);
  EXPECT_EQ(other.capacity(), MeshFront::kPairs);
  EXPECT_EQ(front.capacity(), 0u);  // NOLINT: what it is then is said
  EXPECT_EQ(front.size(), 0u);
  front.clear();
  expect_truth(walk.mesh_a, walk.mesh_b, walk.next(), seed, other);
  expect_truth(walk.mesh_a, walk.mesh_b, walk.next(), seed, front);
}

/// Law 5: scaled by a power of two everything is the same to the last bit, wherever the unit of the pair is.
TEST(MeshFront, ScalesWithTheBodies) {
  for (const int exponent : {-60, 60, 3}) {
    Walk walk(torus(24, 12), ball(3), 1, 0.1);
    const MeshModel large_a = scaled(walk.soup_a, std::ldexp(1, exponent)).mesh(),
                    large_b = scaled(walk.soup_b, std::ldexp(1, exponent)).mesh();
    MeshFront front, large_front;
    MeshSeed seed, large_seed;
    for (int i = 0; i < 60; ++i) {
      Pose large = walk.next();
      large.translation *= std::ldexp(1, exponent);
      const Answer small = distance(walk.mesh_a, walk.mesh_b, walk.pose, seed, front);
      const Answer other = distance(large_a, large_b, large, large_seed, large_front);
      ASSERT_EQ(std::ldexp(small.upper, exponent), other.upper) << i;
      ASSERT_EQ(std::ldexp(small.lower, exponent), other.lower) << i;
      ASSERT_EQ(small.steps, other.steps) << i;
    }
  }
}

/// Law 3, on any number of threads and with registers of any width: the same calls give the same bits.
TEST(MeshFront, OfTheSameCallsGivesTheSameBits) {
  const std::vector<Walk> all = walks();
  const auto answers = [&] {
    std::vector<Answer> found;
    for (Walk walk : all) {
      MeshFront front(2048);
      MeshSeed seed;
      for (int i = 0; i < 50; ++i) {
        const Pose& pose = walk.next();
        found.push_back(intersects(walk.mesh_a, walk.mesh_b, pose, seed, front));
        found.push_back(distance(walk.mesh_a, walk.mesh_b, pose, seed, front));
        found.push_back(within(walk.mesh_a, walk.mesh_b, pose, 0.01, seed, front).answer);
      }
    }
    return found;
  };
  const auto same = [](const std::vector<Answer>& x, const std::vector<Answer>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(Answer)) == 0;
  };
  const std::vector<Answer> first = answers();
  for (const Width width : {Width::Two, Width::Four}) {
    if (set_width(width)) {
      EXPECT_TRUE(same(answers(), first));
    }
  }
  std::vector<int> alike(3, 0);
  std::vector<std::thread> threads;
  for (int& it : alike) threads.emplace_back([&] { it = same(answers(), first); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::count(alike.begin(), alike.end(), 1), 3);
}

}  // namespace
}  // namespace swiftlet
