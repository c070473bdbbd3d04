// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How much stack queries take: each runs on a painted stack of its own, and the paint that is left tells. Figures are of
// optimised code.
#include <swiftlet/build.h>
#include <swiftlet/depth.h>
#include <swiftlet/manifold.h>
#include <swiftlet/query.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <new>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "painted_stack.h"
#include "shapes.h"

namespace swiftlet {
namespace {

/// The most that a kind of query took.
struct Most {
  std::size_t verdicts = 0, distances = 0, depths = 0, manifolds = 0;
};

Most measured(const Body& a, const Body& b, int poses, std::size_t aside) {
  PaintedStack stack(aside);
  Most most;
  int i = -1;
  const auto keep = [&](std::size_t& kind, const std::function<void()>& work) {
    const std::size_t used = stack.use(work);
    if (i >= 0) kind = std::max(kind, used);  // what is called for the first time is looked up by the loader, on this stack
  };
  shapes::Random random(1);
  alignas(Manifold) unsigned char points[sizeof(Manifold)];
  const Manifold before;
  const ManifoldOptions wide{.margin = 1};
  for (; i < poses; ++i) {
    const Pose pose{random.rotation(), random.in_ball() * (i % 2 ? 0.3 : 2.5)};
    keep(most.verdicts, [&] { intersects(a, b, pose); });
    keep(most.verdicts, [&] { within(a, b, pose, 0.5); });
    keep(most.distances, [&] { distance(a, b, pose); });
    keep(most.distances, [&] { distance(a, b, pose, {.relative = 0.01}); });
    keep(most.distances, [&] { closest_features(a, b, pose); });
    keep(most.distances, [&] { refine(a, b, pose, distance(a, b, pose, {.relative = 0.1})); });
    Answer deep;
    keep(most.depths, [&] { deep = signed_distance(a, b, pose); });
    keep(most.depths, [&] { signed_within(a, b, pose, -0.1); });
    keep(most.manifolds, [&] { new (points) Manifold(manifold(a, b, pose, deep, wide, before)); });
  }
  return most;
}

TEST(Stack, OfAQueryIsWhatItsCostLineSays) {
  const Model fat = bodies::must(build(shapes::ellipsoid({1, 1, 1}, 500, 1))).model,
              plate = bodies::must(build(shapes::ellipsoid({1, 1, 0.1}, 400, 2))).model,
              prism = bodies::must(build(shapes::box({0.5, 0.5, 1}))).model,
              slivers = bodies::must(build(shapes::moved(shapes::meshed_cube(4), {shapes::Random(1).rotation(), Vec3::Zero()})))
                            .model;
  const Body triangle = Body::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), box = Body::box({-1, -1, -1}, {1, 1, 1});
  Most most;
  for (const auto& [a, b] : {std::pair<Body, Body>{fat, fat},
                             {fat, plate},
                             {plate, prism},
                             {prism, prism},
                             {slivers, slivers},
                             {fat, triangle},
                             {triangle, triangle},
                             {box, prism}}) {
    for (const std::size_t aside : {0, 16}) {
      const Most m = measured(a, b, 100, aside);
      most = {std::max(most.verdicts, m.verdicts), std::max(most.distances, m.distances), std::max(most.depths, m.depths),
              std::max(most.manifolds, m.manifolds)};
    }
  }
  std::size_t resting = 0;  // a depth whose facet the seed knows: no polytope grows
  PaintedStack stack;
  PairSeed seed;
  for (int i = 0; i < 50; ++i) {
    const Pose pose{Eigen::AngleAxisd(1e-4 * i, Vec3::UnitZ()).toRotationMatrix(), {0.1, 0.2, 1.9 - 1e-3 * i}};
    const std::size_t used = stack.use([&] { signed_distance(prism, box, pose, seed); });
    if (i > 0) resting = std::max(resting, used);
  }
  const Model coin = bodies::must(build(shapes::prism(260, 1, 1))).model;
  for (const Body& floor : {Body(coin), Body(prism)}) {  // found by halving
    alignas(Manifold) unsigned char points[sizeof(Manifold)];
    Manifold before;
    for (int i = 0; i < 50; ++i) {
      Pose pose{Eigen::AngleAxisd(0.01 * i, Vec3::UnitZ()).toRotationMatrix(), {0.1 + 0.02 * i, 0.2, 5}};
      pose.translation.z() -= distance(floor, coin, pose).lower + 1e-4;
      const Answer deep = signed_distance(floor, coin, pose);
      const std::size_t used =
          stack.use([&] { new (points) Manifold(manifold(floor, coin, pose, deep, {.margin = 1e-3}, before)); });
      before = *std::launder(reinterpret_cast<const Manifold*>(points));
      if (i > 0) most.manifolds = std::max(most.manifolds, used);
    }
    EXPECT_EQ(before.count, 4u);
  }
  std::printf("bytes of stack: verdicts %zu, distances %zu, depths at rest %zu, depths %zu, manifolds %zu\n", most.verdicts,
              most.distances, resting, most.depths, most.manifolds);
  EXPECT_GE(std::min(resting, most.verdicts), 1000u) << "nothing was measured";
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(most.verdicts, 9'600u);
  EXPECT_LE(most.distances, 10'000u);
  EXPECT_LE(resting, 10'000u);
  EXPECT_LE(most.depths, 26'000u);
  EXPECT_LE(most.manifolds, 9'300u);
}

}  // namespace
}  // namespace swiftlet
