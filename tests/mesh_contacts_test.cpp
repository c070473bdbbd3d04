// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Contacts of meshes: scenes whose regions anyone can count, and random ones beside brute force over all pairs of triangles in
// long doubles. What is within rounding of a region's border is decided by two brute forces, one with boxes and a reach a
// little larger and one with a little smaller ones. mesh_exact_test.cpp has exact truth.
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

/// Two patches so nearly parallel that the nearest pairs are at the reach, and all others above it by less than law 2's bound:
/// the query counts some of these and others not, and finds four regions. The judge wanted one, as there is one region if none
/// of them counts, and one if all do.
TEST(Regress, RegionsOfPairsAtTheReachWereCountedByTheJudge) {
  const Soup soup = patch(3, [](double, double) { return 0.0; });
  const MeshModel mesh = soup.mesh();
  Pose pose = shift(-0x1.b8201453bf0ep-5, -0x1.fa943d86c97dp-4, 0x1.284b177fa83b6p-33);
  pose.rotation << 1, 0, 0x1.1ae57db4f79bp-49, 0, 1, 0, -0x1.1ae57db4f79bp-49, 0, 1;
  const double law_two = tolerance(mesh, mesh, pose), reach = 0x1.2849fc9a2a866p-33 + law_two / 16;
  const Found found = find(mesh, mesh, pose, reach);
  EXPECT_GT(found.about.count, 1u);
  const BrutePairs pairs(soup, soup, pose, law_two / 16, reach + law_two, {});
  int told = 0;
  EXPECT_EQ(fault_of(found.regions, pairs, reach, law_two, mesh, mesh, told), "");
  EXPECT_EQ(told, 0);
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

struct Pair {
  Soup a, b;
  Pose pose;
  double reach;
};
/// Apart, touching and crossing; one region or many.
std::vector<Pair> pairs_of_all_kinds() {
  Random random(23);
  std::vector<Pair> all;
  for (const double height : {0.01, 0.0, -0.01}) {
    all.push_back({floor_of(9, 5), table(), shift(0.013, 0.017, height), 0.02});
    all.push_back({ball(3), ball(2), {random.rotation(), Vec3(0, 0, 1.98 + height)}, 0.05});
  }
  for (int i = 0; i < 60; ++i) all.push_back({any(random), any(random), any_pose(random, 2), random.uniform(0, 0.3)});
  for (int i = 0; i < 20; ++i)
    all.push_back({scattered(random, 40, 0.2), scattered(random, 40, 0.2), any_pose(random, 0.3), random.uniform(0, 0.05)});
  return all;
}

void expect_scaled(const MeshContact& of, const MeshContact& by, double scale) {
  EXPECT_EQ(by.lower, of.lower == std::numeric_limits<double>::denorm_min() ? by.lower : of.lower * scale);
  EXPECT_EQ(by.upper, of.upper * scale);
  EXPECT_EQ(by.verdict, of.verdict);
  EXPECT_EQ(by.triangle_a, of.triangle_a);
  EXPECT_EQ(by.triangle_b, of.triangle_b);
  EXPECT_EQ(by.feature_a, of.feature_a);
  EXPECT_EQ(by.feature_b, of.feature_b);
  EXPECT_EQ(by.box_min, of.box_min * scale);
  EXPECT_EQ(by.box_max, of.box_max * scale);
  EXPECT_TRUE(by.point_a == of.point_a * scale || of.point_a.hasNaN());
  EXPECT_TRUE(by.normal == of.normal || of.normal.hasNaN());
}

TEST(MeshContacts, ScaleByAPowerOfTwoBitForBit) {
  for (const Pair& pair : pairs_of_all_kinds()) {
    const MeshModel a = pair.a.mesh(), b = pair.b.mesh();
    const Found found = find(a, b, pair.pose, pair.reach);
    for (const int power : {-60, -3, 1, 100}) {
      const double scale = std::ldexp(1, power);
      const MeshModel x = scaled(pair.a, scale).mesh(), y = scaled(pair.b, scale).mesh();
      const Pose pose{pair.pose.rotation, pair.pose.translation * scale};
      const Found other = find(x, y, pose, pair.reach * scale);
      ASSERT_EQ(other.about.count, found.about.count);
      EXPECT_EQ(other.about.steps, found.about.steps);
      EXPECT_EQ(other.about.plane_tests, found.about.plane_tests);
      for (std::size_t i = 0; i < found.regions.size(); ++i) {
        expect_scaled(found.regions[i], other.regions[i], scale);
        const Manifold m = manifold(a, b, pair.pose, found.regions[i], {.margin = pair.reach}),
                       n = manifold(x, y, pose, other.regions[i], {.margin = pair.reach * scale});
        ASSERT_EQ(m.count, n.count);
        EXPECT_EQ(m.normal, n.normal);
        for (std::uint32_t k = 0; k < m.count; ++k) {
          EXPECT_EQ(m.points[k].separation * scale, n.points[k].separation);
          EXPECT_EQ(m.points[k].point_a * scale, n.points[k].point_a);
          EXPECT_EQ(m.points[k].feature_a, n.points[k].feature_a);
        }
      }
    }
  }
}

TEST(MeshContacts, SwappingTheBodiesKeepsDistances) {
  for (const Pair& pair : pairs_of_all_kinds()) {
    const MeshModel a = pair.a.mesh(), b = pair.b.mesh();
    const Found found = find(a, b, pair.pose, pair.reach), swapped = find(b, a, inverse(pair.pose), pair.reach);
    const double law_two = tolerance(a, b, pair.pose);
    ASSERT_EQ(found.about.count > 0, swapped.about.count > 0);
    // Boxes are along other axes, so that regions may be others; but the nearest is the same.
    if (found.about.count == 0) continue;
    EXPECT_NEAR(found.regions[0].upper, swapped.regions[0].upper, law_two);
    EXPECT_NEAR(found.regions[0].lower, swapped.regions[0].lower, law_two);
    const Answer answer = distance(a, b, pair.pose);
    EXPECT_NEAR(found.regions[0].upper, answer.upper, law_two);
    EXPECT_TRUE(found.regions[0].verdict == answer.verdict || answer.upper <= law_two);
  }
}

TEST(MeshContacts, WithRadiiReachFarther) {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    const MeshModel a = any(random).mesh(), b = any(random).mesh();
    const Pose pose = any_pose(random, 2);
    const double of_a = random.uniform(0, 0.2), of_b = i % 2 ? 0 : random.uniform(0, 0.2), reach = random.uniform(0, 0.1);
    const Found thin = find(a, b, pose, reach + of_a + of_b), thick = find({a, of_a}, {b, of_b}, pose, reach);
    const double law_two = tolerance(MeshBody(a, of_a), MeshBody(b, of_b), pose);
    ASSERT_EQ(thin.about.count, thick.about.count);
    for (std::size_t k = 0; k < thin.regions.size(); ++k) {
      const MeshContact &x = thin.regions[k], &y = thick.regions[k];
      const double signed_distance = x.upper - of_a - of_b;
      EXPECT_NEAR(y.upper, std::max(signed_distance, 0.0), law_two);
      EXPECT_TRUE(signed_distance <= law_two || y.verdict == Verdict::Disjoint);
      EXPECT_TRUE(signed_distance >= -law_two || y.verdict == Verdict::Overlapping);
      const Manifold m = manifold({a, of_a}, {b, of_b}, pose, y, {.margin = reach});
      if (x.verdict != Verdict::Disjoint || m.count == 0) continue;
      EXPECT_NEAR(m.points[0].separation, signed_distance, 2 * law_two);
    }
  }
}

TEST(MeshContacts, OfACutSearchAreTrueAndSaySo) {
  int cut = 0;
  for (const Pair& pair : pairs_of_all_kinds()) {
    const MeshModel a = pair.a.mesh(), b = pair.b.mesh();
    const Found all = find(a, b, pair.pose, pair.reach);
    const std::uint32_t work = all.about.steps + all.about.plane_tests;
    EXPECT_LE(all.about.plane_tests, a.triangle_count() * b.triangle_count());
    for (const std::uint32_t steps : {0u, 1u, work / 3, work - 1, work}) {
      const Found some = find(a, b, pair.pose, pair.reach, 256, {.steps = steps});
      EXPECT_LE(some.about.steps + some.about.plane_tests, steps);
      EXPECT_EQ(some.about.is_counted, some.about.status == Status::Converged);
      EXPECT_TRUE(steps < work || some.about.count == all.about.count);
      cut += !some.about.is_counted;
      for (const MeshContact& region : some.regions) {
        double least = kInfinity;  // over what the whole search found in its box
        for (const MeshContact& other : all.regions) {
          const bool inside = (other.box_min.array() <= region.box_max.array()).all() &&
                              (region.box_min.array() <= other.box_max.array()).all();
          if (inside) least = std::min(least, other.upper);
        }
        EXPECT_LE(region.lower, least);
      }
    }
  }
  EXPECT_GT(cut, 100);
}

TEST(MeshContacts, RefuseWhatQueriesRefuse) {
  const MeshModel mesh = ball(1).mesh();
  const auto status_of = [&](const MeshBody& a, const Pose& pose, double reach) {
    const Found found = find(a, mesh, pose, reach);
    EXPECT_EQ(found.about.count, 0u);
    return found.about.status;
  };
  Pose crooked;
  crooked.rotation(0, 1) = 0.1;
  EXPECT_EQ(status_of(mesh, crooked, 1), Status::InvalidPose);
  EXPECT_EQ(status_of({mesh, -1}, {}, 1), Status::InvalidRadius);
  EXPECT_EQ(status_of(Body(), {}, 1), Status::InvalidBody);
  EXPECT_EQ(status_of(Body::point({kNaN, 0, 0}), {}, 1), Status::InvalidBody);
  EXPECT_EQ(status_of(mesh, {}, -1), Status::Converged);  // nothing is nearer than that
  EXPECT_EQ(status_of(mesh, {}, kNaN), Status::NotConverged);
  for (const double reach : {1e300, std::numeric_limits<double>::max(), kInfinity}) {
    for (const double radius : {0.0, 0.25}) {
      const Found found = find({mesh, radius}, {mesh, radius}, shift(5, 0, 0), reach);
      EXPECT_TRUE(found.about.is_counted);
      ASSERT_EQ(found.about.count, 1u);
      EXPECT_NEAR(found.regions[0].lower, 3 - 2 * radius, 1e-12);
      EXPECT_NEAR(found.regions[0].upper, 3 - 2 * radius, 1e-12);
    }
  }

  MeshContact nowhere;
  EXPECT_EQ(manifold(mesh, mesh, {}, nowhere).count, 0u);
  MeshContact contact;
  ASSERT_EQ(contacts(mesh, mesh, shift(1.9, 0, 0), 1, {&contact, 1}).count, 1u);
  EXPECT_EQ(manifold(mesh, mesh, crooked, contact).count, 0u);
  EXPECT_EQ(manifold(mesh, {mesh, kNaN}, shift(1.9, 0, 0), contact).count, 0u);
  MeshContact stale = contact;  // of a larger mesh
  stale.feature_a = {FeatureKind::Vertex, 1000000}, stale.point_b -= 3 * stale.normal;
  EXPECT_EQ(manifold(mesh, mesh, shift(1.9, 0, 0), stale).count, 0u);
  EXPECT_EQ(manifold(Body::point({0, 0, 0}), mesh, shift(1.9, 0, 0), stale).count, 0u);
  contact.triangle_b = 1000000;
  EXPECT_EQ(manifold(mesh, mesh, shift(1.9, 0, 0), contact).count, 0u);
}

TEST(MeshContacts, UseTheStackThatTheHeaderTells) {
  if (!kIsMeasured) GTEST_SKIP() << "of optimised code without sanitizers";
  std::size_t most = 0, of_manifolds = 0, of_meshes = 0;
  const Body solid = Body::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (const Pair& pair : pairs_of_all_kinds()) {
    const MeshModel a = pair.a.mesh(), b = pair.b.mesh();
    MeshContact into[4];
    for (const MeshBody& second : {MeshBody(b), MeshBody(solid)}) {
      MeshContacts about;
      most = std::max(most, PaintedStack().use([&] { about = contacts(a, second, pair.pose, pair.reach, into); }));
      for (std::uint32_t i = 0; i < about.stored; ++i) {
        std::size_t& of = second.mesh() ? of_meshes : of_manifolds;
        of = std::max(of, PaintedStack().use([&] { manifold(a, second, pair.pose, into[i]); }));
      }
    }
  }
  EXPECT_LE(most, 48u << 10);
  EXPECT_LE(of_meshes, 32u << 10);
  EXPECT_LE(of_manifolds, 64u << 10) << "of a convex body, of which the kernel knows the depth";
}

}  // namespace
}  // namespace swiftlet
