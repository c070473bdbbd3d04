// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contacts of meshes: scenes whose regions anyone can count, and random ones beside brute force over all pairs of triangles in
// long doubles. What is within rounding of a region's border is decided by two brute forces, one with boxes and a reach a
// little larger and one with a little smaller ones: where both say the same, so must the query. mesh_exact_test.cpp has exact
// truth.
#include <swiftlet/mesh_contacts.h>

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "mesh_regions.h"
#include "painted_stack.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

struct Found {
  MeshContacts about;
  std::vector<MeshContact> regions;
};
Found find(const MeshBody& a, const MeshBody& b, const Pose& pose, double reach, std::size_t room = 256,
           const Budget& budget = {}) {
  Found found;
  found.regions.resize(room);
  found.about = contacts(a, b, pose, reach, found.regions, budget);
  found.regions.resize(found.about.stored);
  return found;
}

Soup floor_of(std::uint32_t side, double size) {
  Soup soup = patch(side, [](double, double) { return 0.0; });
  for (Vec3& p : soup.points) p.head<2>() *= size;
  return soup;
}
/// A plate on four legs, which stand at z = 0.
Soup table() {
  Soup soup = box({-1, -1, 1}, {1, 1, 1.1});
  for (const double x : {-0.9, 0.8})
    for (const double y : {-0.9, 0.8}) soup.add(box({x, y, 0}, {x + 0.1, y + 0.1, 1}));
  return soup;
}

// ---- Scenes ----------------------------------------------------------------------------------------------------------------

TEST(MeshContacts, OfATableOnAFloorAreFour) {
  for (const std::uint32_t side : {1u, 2u, 7u, 40u}) {
    const MeshModel ground = floor_of(side, 5).mesh(), body = table().mesh();
    for (const double height : {0.01, 0.0, -0.01}) {
      const Found found = find(ground, body, shift(0.013, 0.017, height), 0.02);
      EXPECT_EQ(found.about.status, Status::Converged);
      EXPECT_TRUE(found.about.is_counted);
      ASSERT_EQ(found.about.count, 4u) << side << " " << height;
      for (const MeshContact& region : found.regions) {
        EXPECT_NEAR(region.lower, std::max(height, 0.0), 1e-13);
        EXPECT_NEAR(region.upper, std::max(height, 0.0), 1e-13);
        EXPECT_EQ(region.verdict, height > 0 ? Verdict::Disjoint : height < 0 ? Verdict::Overlapping : Verdict::Touching);
        EXPECT_TRUE(height <= 0 || region.normal.z() > 1 - 1e-12);
      }
      EXPECT_EQ(find(body, ground, inverse(shift(0.013, 0.017, height)), 0.02).about.count, 4u);
    }
    EXPECT_EQ(find(ground, body, shift(0, 0, 0.03), 0.02).about.count, 0u);
  }
}

TEST(MeshContacts, OfABoxOnAFloorOfAnyTrianglesAreOne) {
  const MeshModel body = box({-1, -1, 0}, {1, 1, 2}).mesh();
  for (const std::uint32_t side : {1u, 3u, 32u, 100u}) {
    const MeshModel ground = floor_of(side, 5).mesh();
    for (const double height : {0.01, 0.0, -0.01}) {
      const Found found = find(ground, body, shift(0.1037, 0.2041, height), 0.02);
      ASSERT_EQ(found.about.count, 1u) << side << " " << height;
      const MeshContact& region = found.regions[0];
      EXPECT_NEAR(region.box_min.x(), -0.92, 0.01);
      EXPECT_NEAR(region.box_max.y(), 1.22, 0.01);
      EXPECT_EQ(region.verdict, height > 0 ? Verdict::Disjoint : height < 0 ? Verdict::Overlapping : Verdict::Touching);
    }
  }
}

TEST(MeshContacts, OfConvexBodiesCountAsOneTriangle) {
  const MeshModel ground = floor_of(9, 5).mesh();
  const Body crate = Body::box({-1, -1, 0}, {1, 1, 2}), ball_body = Body::point({0, 0, 0}, 0.5);
  EXPECT_EQ(find(ground, crate, shift(0.1, 0.2, 0.01), 0.02).about.count, 1u);
  EXPECT_EQ(find(crate, ground, shift(0.1, 0.2, -0.01), 0.02).about.count, 1u);
  EXPECT_EQ(find(crate, ground, shift(0.1, 0.2, -0.03), 0.02).about.count, 0u);
  const Found over = find(ground, ball_body, shift(0.1, 0.2, 0.51), 0.02);
  ASSERT_EQ(over.about.count, 1u);
  EXPECT_NEAR(over.regions[0].lower, 0.01, 1e-13);
  EXPECT_NEAR(over.regions[0].point_b.z(), 0.01, 1e-13);
  const Found in = find(ground, ball_body, shift(0.1, 0.2, 0.49), 0.02);
  ASSERT_EQ(in.about.count, 1u);
  EXPECT_EQ(in.regions[0].verdict, Verdict::Overlapping);
  EXPECT_NEAR(in.regions[0].normal.z(), 1, 1e-14);  // the surfaces are apart
  const Found two = find(crate, crate, shift(2.01, 0, 0), 0.02);
  ASSERT_EQ(two.about.count, 1u);
  EXPECT_NEAR(two.regions[0].upper, 0.01, 1e-13);
  EXPECT_EQ(find(crate, crate, shift(2.03, 0, 0), 0.02).about.count, 0u);
}

// ---- Beside brute force ----------------------------------------------------------------------------------------------------

TEST(MeshContacts, AreThoseOfBruteForce) {
  Random random(20261123);
  int told = 0, many = 0;
  for (int i = 0; i < 800; ++i) {
    const auto strewn = [&] { return scattered(random, 10 + int(random.bits() % 30), random.uniform(0.02, 0.3)); };
    const Soup a = i % 2 ? any(random) : strewn(), b = i % 4 ? any(random) : strewn();
    const Pose pose = any_pose(random, i % 2 ? 2.5 : 0.5);
    const double least = brute_force(a, b, pose);
    const double reach = i % 5 == 0 ? 0 : i % 5 == 1 ? least * 1.001 : least + std::pow(10, random.uniform(-4, -0.5));
    const MeshModel x = a.mesh(), y = b.mesh();
    const Found found = find(x, y, pose, reach);
    ASSERT_EQ(found.about.status, Status::Converged);
    const double law_two = tolerance(x, y, pose);
    const BrutePairs pairs(a, b, pose, law_two / 16, reach + law_two, {});
    const std::string fault = fault_of(found.regions, pairs, reach, law_two, x, y, told);
    ASSERT_EQ(fault, "") << i;
    many += found.about.count > 1;
  }
  EXPECT_GT(told, 780);
  EXPECT_GT(many, 150);
}

// ---- Promises --------------------------------------------------------------------------------------------------------------

/// Two combs whose teeth touch: many regions.
Soup spikes(int side, double sign) {
  Soup soup;
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      const Vec3 tip(i, k, 0), high = sign * Vec3(0, 0, 1);
      soup.add(tip, tip + high + Vec3(0.1, 0, 0), tip + high + Vec3(0, 0.1, 0));
    }
  return soup;
}

TEST(MeshContacts, GiveTheTrueCountWhateverTheRoom) {
  const MeshModel a = spikes(7, -1).mesh(), b = spikes(7, 1).mesh();
  const Pose pose = {Eigen::AngleAxisd(0.001, Vec3::UnitX()).toRotationMatrix(), Vec3(0, 0, 0.01)};
  const Found all = find(a, b, pose, 0.1);
  ASSERT_EQ(all.about.count, 49u);
  EXPECT_TRUE(std::is_sorted(all.regions.begin(), all.regions.end(),
                             [](const MeshContact& x, const MeshContact& y) { return x.upper < y.upper; }));
  for (const std::size_t room : {0u, 1u, 5u, 48u}) {
    const Found some = find(a, b, pose, 0.1, room);
    EXPECT_EQ(some.about.count, 49u);
    EXPECT_TRUE(some.about.is_counted);
    EXPECT_EQ(some.about.status, Status::Budget);
    ASSERT_EQ(some.about.stored, room);
    for (std::size_t i = 0; i < room; ++i) {
      EXPECT_EQ(some.regions[i].triangle_a, all.regions[i].triangle_a);
      EXPECT_EQ(some.regions[i].upper, all.regions[i].upper);
    }
  }
}

TEST(MeshContacts, BeyondAllRoomAreJoinedAndNoneIsLost) {
  const MeshModel a = spikes(20, -1).mesh(), b = spikes(20, 1).mesh();
  const Pose pose = shift(0, 0, 0.01);
  EXPECT_EQ(find(a, b, pose, 0.1, 400).about.count, 400u);
  EXPECT_EQ(find(a, b, pose, 0.1, 400 - kSpareRegions).about.count, 400u);
  const Found few = find(a, b, pose, 0.1, 10);
  EXPECT_FALSE(few.about.is_counted);
  EXPECT_EQ(few.about.status, Status::Budget);
  EXPECT_LE(few.about.count, 10 + kSpareRegions);
  EXPECT_GT(few.about.count, 1u);
  const Found all = find(a, b, pose, 0.1, 400), crowded = find(a, b, pose, 0.1, 200);
  ASSERT_EQ(crowded.about.stored, 200u);
  int held = 0;
  for (const MeshContact& region : all.regions) {
    int within = 0, beside = 0;
    for (const MeshContact& other : crowded.regions) {
      within += (other.box_min.array() <= region.box_min.array() && region.box_max.array() <= other.box_max.array()).all();
      beside += (other.box_min.array() <= region.box_max.array() && region.box_min.array() <= other.box_max.array()).all();
    }
    EXPECT_EQ(within, beside);
    EXPECT_LE(within, 1);
    held += within;
  }
  EXPECT_GT(held, 200);
}

}  // namespace
}  // namespace swiftlet
