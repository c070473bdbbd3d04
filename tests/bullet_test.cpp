// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in Bullet, in both precisions: margins, signs and normals against exact answers; who answers which pair; what
// lives as long as a pair does. Piles of hulls are pile_test.cpp's.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include <swiftlet/bullet.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "bodies.h"
#include "bullet_world.h"

namespace swiftlet {
namespace {

TEST(HullShape, IsABtConvexHullShapeOfTheModelsVertices) {
  const HullShape hull(bodies::model(bodies::box(1, 2, 3)));
  btConvexHullShape bullets;
  for (int i = 0; i < hull.getNumPoints(); ++i) bullets.addPoint(hull.getUnscaledPoints()[i]);
  EXPECT_EQ(hull.getNumPoints(), 8);
  EXPECT_EQ(hull.getShapeType(), bullets.getShapeType());
  EXPECT_EQ(hull.getMargin(), bullets.getMargin());
  btVector3 low, high, bullets_low, bullets_high;
  hull.getAabb(at(1, 0, 0), low, high);
  bullets.getAabb(at(1, 0, 0), bullets_low, bullets_high);
  EXPECT_EQ(low, bullets_low);
  EXPECT_EQ(high, bullets_high);
}

/// It would hand Bullet a larger hull.
TEST(HullShape, RefusesAModelWithoutItsLevelZero) {
  const Model nested = bodies::nested();
  EXPECT_EQ(HullShape(nested).getNumPoints(), 6);
  const Model cut = nested.cut({.deviation = 2});
  ASSERT_GT(cut.finest_level(), 0);
  EXPECT_THROW(HullShape{cut}, std::invalid_argument);
}

TEST(ClosestPoints, LieOnTheMarginsAndTheNormalPointsFromBToA) {
  World w;
  HullShape a(bodies::model(bodies::box(1, 1, 1))), b(bodies::model(bodies::box(2, 2, 2)));
  for (const btScalar margin : {btScalar(0), btScalar(0.04), btScalar(0.25)}) {
    b.setMargin(margin);
    const auto points = closest_points(w, a, at(10, 0, 0), b, at(14, 0, 0), 2);  // hulls 1 apart along x
    ASSERT_EQ(points.size(), 1u);
    const btScalar from_a = a.getMargin();
    EXPECT_NEAR(points[0].distance, 1 - from_a - margin, kRounding * 10);
    expect_near(points[0].normal_on_b, btVector3(-1, 0, 0), kRounding);
    EXPECT_NEAR(points[0].on_a.x(), 11 + from_a, kRounding * 10);
    EXPECT_NEAR(points[0].on_b.x(), 12 - margin, kRounding * 10);
  }
}

TEST(ClosestPoints, AreNegativeWhereOnlyTheMarginsOverlap) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  a.setMargin(btScalar(0.1)), b.setMargin(btScalar(0.1));
  const auto points = closest_points(w, a, at(0, 0, 0), b, at(0, 0, 2.05));  // its lower tip 0.05 above the cube
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].distance, -0.15, kRounding);
  expect_near(points[0].normal_on_b, btVector3(0, 0, -1), kRounding);
  expect_near(points[0].on_a, btVector3(0, 0, btScalar(1.1)), kRounding);
  expect_near(points[0].on_b, btVector3(0, 0, btScalar(0.95)), kRounding);
}

TEST(ClosestPoints, KeepTheirNormalWhereTheHullsJustTouch) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  blind_bullet(a), blind_bullet(b);
  const auto points = closest_points(w, a, at(0, 0, 0), b, at(0, 2, 0));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].distance, -a.getMargin() - b.getMargin(), kRounding);
  expect_near(points[0].normal_on_b, btVector3(0, -1, 0), kRounding);
}

TEST(ClosestPoints, MirrorUnderSwap) {
  World w;
  HullShape a(stored("fat_a")), b(stored("plate"));
  const btTransform a_in_world = at(1, 2, 3), b_in_world(btQuaternion(btVector3(1, 2, 3), 1), btVector3(2, 4, 5));
  const auto forth = closest_points(w, a, a_in_world, b, b_in_world, 5),
             back = closest_points(w, b, b_in_world, a, a_in_world, 5);
  ASSERT_EQ(forth.size(), 1u);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_NEAR(forth[0].distance, back[0].distance, kRounding);
  expect_near(forth[0].normal_on_b, -back[0].normal_on_b, kRounding * 10);
  expect_near(forth[0].on_a, back[0].on_b, kRounding * 10);
}

/// In single precision the rounding of rotation and points, 1e-7 of the size each, is all the error. Bullet's own has 2e-3.
TEST(ClosestPoints, AgreeWithTheExactDistanceLessBothMargins) {
  World w, bullets(false);
  const std::array models{stored("fat_a"), stored("fat_b"), stored("long"), stored("plate")};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto transform = [&] {
    const btQuaternion q(btScalar(uniform(random)), btScalar(uniform(random)), btScalar(uniform(random)),
                         btScalar(uniform(random)));
    return btTransform(q.normalized(),
                       btVector3(btScalar(uniform(random)), btScalar(uniform(random)), btScalar(uniform(random))) * 2);
  };
  int apart = 0;
  double worst = 0, bullets_worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Model &model_a = models[random() % 4], &model_b = models[random() % 4];
    HullShape a(model_a), b(model_b);
    const btTransform a_in_world = transform(), b_in_world = transform();
    const Answer truth = distance(model_a, model_b, relative(pose_of(a_in_world), pose_of(b_in_world)));
    ASSERT_NE(truth.status, Status::InvalidPose);
    if (truth.verdict != Verdict::Disjoint) continue;
    ++apart;
    const double margins = a.getMargin() + b.getMargin();
    const auto points = closest_points(w, a, a_in_world, b, b_in_world, 10);
    ASSERT_EQ(points.size(), 1u) << i;
    worst = std::max(worst, std::abs(points[0].distance + margins - truth.lower));
    EXPECT_NEAR(points[0].normal_on_b.length(), 1, kRounding);
    expect_near(points[0].on_a - points[0].on_b, points[0].normal_on_b * points[0].distance, kRounding * 4);
    const auto others = closest_points(bullets, a, a_in_world, b, b_in_world, 10);
    ASSERT_EQ(others.size(), 1u) << i;
    bullets_worst = std::max(bullets_worst, std::abs(others[0].distance + margins - truth.lower));
  }
  EXPECT_GT(apart, 1000);
  EXPECT_LE(worst, kRounding);
  EXPECT_LE(bullets_worst, 1e-2) << "the two mean different things";
  std::printf("%d pairs: farthest from the exact distance %.1e, Bullet's own %.1e\n", apart, worst, bullets_worst);
}

TEST(ClosestPoints, ReachAsFarAsBullets) {
  World w, bullets(false);
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  for (const double gap : {0.05, 0.15, 0.25, 0.35, 1.0}) {
    for (const btScalar threshold : {btScalar(0), btScalar(0.1)}) {
      const btTransform b_in_world = at(2 + gap, 0, 0);
      EXPECT_EQ(closest_points(w, a, at(0, 0, 0), b, b_in_world, threshold).size(),
                closest_points(bullets, a, at(0, 0, 0), b, b_in_world, threshold).size())
          << gap << " " << threshold;
    }
  }
}

TEST(HullPairs, AnswerBothTablesThemselves) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  object_b.setWorldTransform(at(0, 0, 2.05));
  w.world.addCollisionObject(&object_a), w.world.addCollisionObject(&object_b);
  blind_bullet(a), blind_bullet(b);

  w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
  const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
  ASSERT_EQ(manifold.getNumContacts(), 4);  // the corners of the common face, in one step
  const btScalar up = manifold.getBody0() == &object_a ? btScalar(-1) : btScalar(1);
  for (int i = 0; i < 4; ++i) {
    const btManifoldPoint& p = manifold.getContactPoint(i);
    EXPECT_NEAR(p.getDistance(), 0.05 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
    expect_near(p.m_normalWorldOnB, btVector3(0, 0, up), kRounding);
    EXPECT_NEAR(std::abs(p.getPositionWorldOnA().x()), 1, kRounding);
    EXPECT_NEAR(std::abs(p.getPositionWorldOnA().y()), 1, kRounding);
  }

  const auto points = closest_points(w, a, at(0, 0, 0), b, at(0, 0, 3), 2);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].distance, 1 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);

  w.world.removeCollisionObject(&object_a), w.world.removeCollisionObject(&object_b);
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0);
}

/// A pair that separates keeps no contact, and one that comes back gets it again: one algorithm, one seed, many poses.
TEST(HullPairs, FollowAMovingPair) {
  World w;
  HullShape a(stored("fat_a")), b(stored("fat_b"));
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  w.world.addCollisionObject(&object_a), w.world.addCollisionObject(&object_b);
  int contacts = 0;
  for (int step = 0; step < 400; ++step) {
    const double angle = step * 0.05;
    object_b.setWorldTransform(btTransform(btQuaternion(btVector3(1, 1, 0).normalized(), btScalar(angle)),
                                           btVector3(btScalar(2.05 + 0.15 * std::sin(angle)), 0, 0)));
    w.world.performDiscreteCollisionDetection();
    const Answer truth = distance(a.model(), b.model(), pose_of(object_b.getWorldTransform()));
    const btPersistentManifold* const manifold =
        w.dispatcher.getNumManifolds() ? w.dispatcher.getManifoldByIndexInternal(0) : nullptr;
    btScalar least = 1;
    for (int i = 0; manifold && i < manifold->getNumContacts(); ++i) {
      least = std::min(least, manifold->getContactPoint(i).getDistance());
    }
    const double expected = truth.lower - a.getMargin() - b.getMargin();
    if (manifold && expected < manifold->getContactBreakingThreshold() - 1e-5) {
      ++contacts;
      // Points that hold the area may be less deep than the deepest place by this share of the threshold: held_points.h.
      EXPECT_LE(least, expected + 0.05 * manifold->getContactBreakingThreshold() + kRounding * 2) << step;
    } else if (expected > 0.1) {
      EXPECT_EQ(least, 1) << step;
    }
  }
  EXPECT_GT(contacts, 50);
  w.world.removeCollisionObject(&object_a), w.world.removeCollisionObject(&object_b);
}

TEST(HullPairs, AnswerInsideCompoundsToo) {
  World w;
  HullShape child(bodies::model(bodies::cube())), other(bodies::model(bodies::cube()));
  btCompoundShape compound;
  compound.addChildShape(at(-2, 0, 0), &child);
  compound.addChildShape(at(2, 0, 0), &child);
  const auto points = closest_points(w, compound, at(0, 0, 0), other, at(2, 0, 2.05));
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points[0].distance, 0.05 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
  expect_near(points[0].normal_on_b, btVector3(0, 0, -1), kRounding);
}

/// What is not swiftlet's is Bullet's, to the bit.
void expect_bullets_own(btCollisionShape& a, btCollisionShape& b, const btTransform& b_in_world) {
  World w, bullets(false);
  const auto ours = closest_points(w, a, at(0, 0, 0), b, b_in_world, 2);
  const auto theirs = closest_points(bullets, a, at(0, 0, 0), b, b_in_world, 2);
  ASSERT_EQ(ours.size(), 1u);
  ASSERT_EQ(theirs.size(), 1u);
  EXPECT_EQ(ours[0].distance, theirs[0].distance);
  EXPECT_EQ(ours[0].normal_on_b, theirs[0].normal_on_b);
  EXPECT_EQ(ours[0].on_b, theirs[0].on_b);
}

/// Overlaps too: a cube sunk half into another, where Bullet sees nothing.
TEST(HullPairs, AnswerOverlappingHullsThemselves) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  blind_bullet(a), blind_bullet(b);
  const auto expect_half = [](const btVector3& normal_on_b, const btVector3& on_a, btScalar distance) {
    EXPECT_NEAR(distance, -0.5 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
    expect_near(normal_on_b, btVector3(0, 0, -1), kRounding);
    EXPECT_NEAR(on_a.z(), 1 + CONVEX_DISTANCE_MARGIN, kRounding);
  };
  const auto points = closest_points(w, a, at(0, 0, 0), b, at(0.25, 0.5, 1.5));
  ASSERT_EQ(points.size(), 1u);
  expect_half(points[0].normal_on_b, points[0].on_a, points[0].distance);

  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  object_b.setWorldTransform(at(0.25, 0.5, 1.5));
  w.world.addCollisionObject(&object_a), w.world.addCollisionObject(&object_b);
  w.world.performDiscreteCollisionDetection();
  const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
  ASSERT_EQ(manifold.getNumContacts(), 4);
  ASSERT_EQ(manifold.getBody0(), &object_a);
  for (int i = 0; i < 4; ++i) {
    const btManifoldPoint& p = manifold.getContactPoint(i);
    expect_half(p.m_normalWorldOnB, p.getPositionWorldOnA(), p.getDistance());
  }
  w.world.removeCollisionObject(&object_a), w.world.removeCollisionObject(&object_b);
}

/// A point keeps the impulse that the solver left with it; what the manifold no longer holds goes at once.
TEST(HullPairs, KeepThePointsOfTheStepBefore) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  object_b.setWorldTransform(at(0, 0, 2.07));
  w.world.addCollisionObject(&object_a), w.world.addCollisionObject(&object_b);
  w.world.performDiscreteCollisionDetection();
  btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
  ASSERT_EQ(manifold.getNumContacts(), 4);
  for (int i = 0; i < 4; ++i) manifold.getContactPoint(i).m_appliedImpulse = btScalar(i + 1);
  object_b.setWorldTransform(at(0.001, 0.001, 2.07));
  w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(manifold.getNumContacts(), 4);
  btScalar impulses = 0;
  for (int i = 0; i < 4; ++i) impulses += manifold.getContactPoint(i).m_appliedImpulse;
  EXPECT_EQ(impulses, 10);
  object_b.setWorldTransform(at(1, 1, 2.07));
  w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(manifold.getNumContacts(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_GE(manifold.getContactPoint(i).getPositionWorldOnA().x(), -kRounding);
  w.world.removeCollisionObject(&object_a), w.world.removeCollisionObject(&object_b);
}

TEST(HullPairs, AnswerScaledHullsByTheirScaledPoints) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  const auto distance = [&] { return closest_points(w, a, at(0, 0, 0), b, at(4, 0, 0), 4)[0].distance; };
  b.setLocalScaling(btVector3(2, 1, 1));
  EXPECT_NEAR(distance(), 1 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
  b.setLocalScaling(btVector3(1, 1, 1));
  blind_bullet(a), blind_bullet(b);
  EXPECT_NEAR(distance(), 2 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
}

/// A body that is scaled while the pair lives is no longer what its algorithm was made for.
TEST(HullPairs, SeeThatAShapeWasScaled) {
  World w;
  HullShape a(bodies::model(bodies::cube()));
  btConvexHullShape b;
  for (int i = 0; i < a.getNumPoints(); ++i) b.addPoint(a.getUnscaledPoints()[i]);
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a), object_b.setCollisionShape(&b);
  object_b.setWorldTransform(at(0, 0, 2.05));
  w.world.addCollisionObject(&object_a), w.world.addCollisionObject(&object_b);
  const auto deepest = [&] {
    w.world.performDiscreteCollisionDetection();
    return swiftlet::deepest(w.dispatcher);
  };
  EXPECT_NEAR(deepest(), 0.05 - 2 * CONVEX_DISTANCE_MARGIN, kRounding);
  b.setLocalScaling(btVector3(1, 1, btScalar(1.02)));
  EXPECT_NEAR(deepest(), 0.03 - 2 * CONVEX_DISTANCE_MARGIN, 1e-4);
  a.setLocalScaling(btVector3(1, 1, btScalar(1.01)));
  EXPECT_NEAR(deepest(), 0.02 - 2 * CONVEX_DISTANCE_MARGIN, 1e-4);
  w.world.removeCollisionObject(&object_a), w.world.removeCollisionObject(&object_b);
}

TEST(HullPairs, LeavePairsWithoutAHullShapeToBullet) {
  HullShape hull(bodies::model(bodies::cube())), scaled(bodies::model(bodies::cube()));
  scaled.setLocalScaling(btVector3(2, 1, 1));
  btConvexHullShape without_model;
  for (int i = 0; i < hull.getNumPoints(); ++i) without_model.addPoint(hull.getUnscaledPoints()[i]);
  btBoxShape box(btVector3(1, 1, 1));
  btSphereShape sphere(1);
  for (btCollisionShape* other : {static_cast<btCollisionShape*>(&without_model), static_cast<btCollisionShape*>(&box),
                                  static_cast<btCollisionShape*>(&sphere)}) {
    expect_bullets_own(without_model, *other, at(4, 0.2, 0.1));
    expect_bullets_own(*other, without_model, at(4, 0.2, 0.1));
    expect_bullets_own(scaled, *other, at(4, 0.2, 0.1));
  }
  btCylinderShape cylinder(btVector3(1, 1, 1));
  expect_bullets_own(hull, cylinder, at(3, 0.2, 0.1));
  expect_bullets_own(cylinder, hull, at(3, 0.2, 0.1));
}

/// A simulation leaves up to 1e-6, which a query as such refuses.
TEST(HullPairs, AcceptRotationsOfSinglePrecision) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  blind_bullet(a), blind_bullet(b);
  for (const double wrong : {1e-7, 1e-6, 1e-5, 1e-4}) {
    btTransform tilted = at(3, 0, 0);
    tilted.getBasis() = btMatrix3x3(btScalar(1 + wrong), 0, 0, 0, btScalar(1 - wrong), 0, 0, btScalar(wrong), 1);
    const auto points = closest_points(w, a, at(0, 0, 0), b, tilted, 4);
    ASSERT_EQ(points.size(), 1u) << wrong;
    EXPECT_NEAR(points[0].distance, 1 - 2 * CONVEX_DISTANCE_MARGIN, 2 * wrong + kRounding);
  }
}

/// Nothing is given back to what is farther off: of twice a rotation one step would make a reflection, which queries take.
/// Bullet answers, and sees the second body elsewhere.
TEST(HullPairs, LeavePosesThatAreNoRigidMotionToBullet) {
  World w;
  HullShape a(bodies::model(bodies::cube())), b(bodies::model(bodies::cube()));
  blind_bullet(b);
  const auto twice = [](const btTransform& t) {
    return btTransform(t.getBasis() * btMatrix3x3(2, 0, 0, 0, 2, 0, 0, 0, 2), t.getOrigin());
  };
  const btTransform here = at(0, 0, 0), there = at(3, 0, 0);
  EXPECT_EQ(closest_points(w, a, here, b, there, 4).size(), 1u);
  EXPECT_TRUE(closest_points(w, a, here, b, twice(there), 4).empty());
  EXPECT_TRUE(closest_points(w, a, twice(here), b, there, 4).empty());
  EXPECT_TRUE(closest_points(w, a, twice(here), b, twice(there), 4).empty());
}

}  // namespace
}  // namespace swiftlet
