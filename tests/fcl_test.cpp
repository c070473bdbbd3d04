// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// swiftlet in FCL: distances, points, normals and contacts against exact answers and against FCL's own; who answers which pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/distance.h>

#include <swiftlet/fcl.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "fcl_world.h"

namespace swiftlet {
namespace {

using Convex = fcl::Convex<double>;
using Solver = fcl::Solver<double>;
struct FclsOwn {};  // the calls without a solver: libccd's GJK
using Transform = ::fcl::Transform3d;

constexpr auto at = fcl_world::at<double>;
using fcl_world::stored;

template <class S>
Pose pose_of(const ::fcl::Transform3<S>& t) {
  return {t.linear().template cast<double>(), t.translation().template cast<double>()};
}

struct Measured {
  double distance;
  Vec3 on_a, on_b;
};

template <class AnySolver>
Measured measure(const ::fcl::CollisionGeometryd& a, const Transform& a_in_world, const ::fcl::CollisionGeometryd& b,
                 const Transform& b_in_world, [[maybe_unused]] const AnySolver& solver, bool is_signed = false) {
  ::fcl::DistanceRequestd request(true, is_signed);
  request.distance_tolerance = 1e-12;
  ::fcl::DistanceResultd result;
  if constexpr (std::is_same_v<AnySolver, FclsOwn>) {
    ::fcl::distance(&a, a_in_world, &b, b_in_world, request, result);
  } else {
    ::fcl::distance(&a, a_in_world, &b, b_in_world, &solver, request, result);
  }
  return {result.min_distance, result.nearest_points[0], result.nearest_points[1]};
}

template <class AnySolver>
::fcl::CollisionResultd collide(const ::fcl::CollisionGeometryd& a, const Transform& a_in_world,
                                const ::fcl::CollisionGeometryd& b, const Transform& b_in_world,
                                [[maybe_unused]] const AnySolver& solver, bool contacts = true) {
  const ::fcl::CollisionRequestd request(4, contacts);
  ::fcl::CollisionResultd result;
  if constexpr (std::is_same_v<AnySolver, FclsOwn>) {
    ::fcl::collide(&a, a_in_world, &b, b_in_world, request, result);
  } else {
    ::fcl::collide(&a, a_in_world, &b, b_in_world, &solver, request, result);
  }
  return result;
}

class RandomPoses {
 public:
  Transform next(double spread) {
    Transform t = Transform::Identity();
    t.linear() = Eigen::Quaterniond(uniform(), uniform(), uniform(), uniform()).normalized().toRotationMatrix();
    t.translation() = spread * Vec3(uniform(), uniform(), uniform());
    return t;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  std::mt19937 random_{11};
};

TEST(Convex, IsWhatFclMakesOfTheSameFaces) {
  const Convex box(bodies::model(bodies::box(1, 2, 3)));
  EXPECT_EQ(box.getVertices().size(), 8u);
  EXPECT_EQ(box.getFaceCount(), 6);
  EXPECT_NEAR(box.computeVolume(), 48, 1e-12);
  const Model model = stored("fat_a");
  EXPECT_NEAR(Convex(model).computeVolume(), model.volume(), 1e-12);
}

/// It would hand FCL a larger hull.
TEST(Convex, RefusesAModelWithoutItsLevelZero) {
  const Model nested = bodies::nested();
  EXPECT_EQ(Convex(nested).getVertices().size(), 6u);
  const Model cut = nested.cut({.deviation = 2});
  ASSERT_GT(cut.finest_level(), 0);
  EXPECT_THROW(Convex{cut}, std::invalid_argument);
}

TEST(Distance, OfBoxesIsExact) {
  const Convex a(bodies::model(bodies::box(1, 2, 3))), b(bodies::model(bodies::cube()));
  const Solver solver;
  const Measured face = measure(a, at(10, 0, 0), b, at(14, 0.5, 0.25), solver);
  EXPECT_NEAR(face.distance, 2, 1e-13);
  EXPECT_NEAR(face.on_a.x(), 11, 1e-13);
  EXPECT_NEAR(face.on_b.x(), 13, 1e-13);
  const Measured corner = measure(a, at(0, 0, 0), b, at(1 + 1 + 3, 2 + 1 + 4, 3 + 1 + 12), solver);
  EXPECT_NEAR(corner.distance, 13, 1e-13);
  EXPECT_LE((corner.on_a - Vec3(1, 2, 3)).norm(), 1e-13);
  EXPECT_LE((corner.on_b - Vec3(4, 6, 15)).norm(), 1e-13);
}

TEST(Distance, AndPointsHoldForAnyPose) {
  const std::array models{stored("fat_a"), stored("fat_b"), stored("long"), stored("plate")};
  const std::array<Convex, 4> shapes{Convex(models[0]), Convex(models[1]), Convex(models[2]), Convex(models[3])};
  const Solver solver;
  RandomPoses poses;
  int apart = 0;
  double worst = 0, libccd_worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::size_t a = i % 4, b = i / 4 % 4;
    const Transform a_in_world = poses.next(2), b_in_world = poses.next(2);
    const Answer truth = distance(models[a], models[b], relative(pose_of(a_in_world), pose_of(b_in_world)));
    const Measured ours = measure(shapes[a], a_in_world, shapes[b], b_in_world, solver);
    if (truth.verdict != Verdict::Disjoint) {
      EXPECT_EQ(ours.distance, -1);
      continue;
    }
    ++apart;
    worst = std::max(worst, std::abs(ours.distance - truth.lower));
    EXPECT_NEAR((ours.on_b - ours.on_a).norm(), ours.distance, 1e-12);
    const Measured theirs = measure(shapes[a], a_in_world, shapes[b], b_in_world, FclsOwn());
    libccd_worst = std::max(libccd_worst, std::abs(theirs.distance - truth.lower));
    if (theirs.distance - truth.lower < 1e-9) {
      EXPECT_LE((ours.on_a - theirs.on_a).norm(), 0.1);
      EXPECT_NEAR((theirs.on_b - theirs.on_a).normalized().dot((ours.on_b - ours.on_a).normalized()), 1, 1e-6);
    }
  }
  EXPECT_GT(apart, 1500);
  EXPECT_LE(worst, 1e-13);
  std::printf("%d pairs: farthest from the exact distance %.1e, FCL's own %.1e\n", apart, worst, libccd_worst);
}

/// Of bodies that only touch the signed distance may be below 0 by rounding.
TEST(Distance, IsMinusOneOrNotBelowZero) {
  const Convex cube(bodies::model(bodies::cube()));
  const Solver solver;
  RandomPoses poses;
  int touching = 0;
  for (int i = 0; i < 500; ++i) {
    const Transform there = poses.next(1), beside = there * at(2, 0, 0);
    const double distance = measure(cube, there, cube, beside, solver).distance;
    EXPECT_TRUE(distance == -1 || distance >= 0) << distance;
    touching += distance != -1;
  }
  EXPECT_GT(touching, 100);
}

TEST(Distance, SwapsItsPoints) {
  const Convex a(stored("fat_a")), b(stored("long"));
  const Solver solver;
  const Transform b_in_world = at(1, 2, 1);
  const Measured forth = measure(a, at(0, 0, 0), b, b_in_world, solver), back = measure(b, b_in_world, a, at(0, 0, 0), solver);
  EXPECT_NEAR(forth.distance, back.distance, 1e-13);
  EXPECT_LE((forth.on_a - back.on_b).norm(), 1e-12);
}

TEST(Distance, IsSignedWhereBodiesOverlap) {
  const Convex a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  const Transform b_in_world = at(0, 0, 1.9);  // its tip 0.1 deep in the cube
  const Measured ours = measure(a, at(0, 0, 0), b, b_in_world, Solver(), true);
  EXPECT_NEAR(measure(a, at(0, 0, 0), b, b_in_world, FclsOwn(), true).distance, -0.1, 1e-4);
  EXPECT_NEAR(ours.distance, -0.1, 1e-13);
  EXPECT_NEAR(measure(a, at(0, 0, 0), b, at(0, 0, 2.5), Solver(), true).distance, 0.5, 1e-13);
  // fcl::distance hands out a contact's place instead of these.
  const ::fcl::Convexd &plain_a = a, &plain_b = b;
  Vec3 on_a, on_b;
  EXPECT_FALSE(Solver().shapeSignedDistance(plain_a, at(0, 0, 0), plain_b, b_in_world, nullptr, &on_a, &on_b));
  EXPECT_LE((on_a - Vec3(0, 0, 1)).norm(), 1e-13);
  EXPECT_LE((on_b - Vec3(0, 0, 0.9)).norm(), 1e-13);
}

TEST(Collision, IsTheVerdictAndTouchingCollides) {
  const Convex a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  const Solver solver;
  for (const bool contacts : {false, true}) {
    EXPECT_FALSE(collide(a, at(0, 0, 0), b, at(0, 0, 2 + 1e-9), solver, contacts).isCollision());
    EXPECT_TRUE(collide(a, at(0, 0, 0), b, at(0, 0, 2), solver, contacts).isCollision());
    EXPECT_TRUE(collide(a, at(0, 0, 0), b, at(0, 0, 2 - 1e-9), solver, contacts).isCollision());
  }
}

TEST(Collision, OfTouchingBodiesHasTheNormalFromOneToTwo) {
  const Convex a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  const auto result = collide(a, at(5, 0, 0), b, at(5, 0, 2), Solver());
  ASSERT_EQ(result.numContacts(), 1u);
  const auto& contact = result.getContact(0);
  EXPECT_LE((contact.normal - Vec3(0, 0, 1)).norm(), 1e-13);
  EXPECT_LE((contact.pos - Vec3(5, 0, 1)).norm(), 1e-13);
  EXPECT_GT(contact.penetration_depth, 0);
  EXPECT_LE(contact.penetration_depth, 1e-12);
  EXPECT_EQ(contact.o1, &a);
}

TEST(Collision, OfOverlappingBodiesHasTheirDepth) {
  const Convex a(bodies::model(bodies::cube())), b(bodies::model(bodies::octahedron()));
  const auto tip = collide(a, at(5, 0, 0), b, at(5, 0.5, 1.75), Solver());
  ASSERT_EQ(tip.numContacts(), 1u);
  EXPECT_NEAR(tip.getContact(0).penetration_depth, 0.25, 1e-13);
  EXPECT_LE((tip.getContact(0).normal - Vec3(0, 0, 1)).norm(), 1e-13);
  EXPECT_LE((tip.getContact(0).pos - Vec3(5, 0.5, 0.875)).norm(), 1e-13);
  const auto face = collide(a, at(0, 0, 0), a, at(0.5, 0.25, 1.5), Solver());
  ASSERT_EQ(face.numContacts(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(face.getContact(i).penetration_depth, 0.5, 1e-13);
  EXPECT_EQ(collide(a, at(0, 0, 0), a, at(0, 0, 0), Solver()).numContacts(), 4u);  // two in one place
}

std::vector<fcl::Touch> touches(const Placed& a, const Placed& b) {
  PairSeed seed;
  return fcl::touches(a, b, seed);
}

TEST(Touches, AreNoneOfBodiesThatAreApart) {
  const Model a = bodies::model(bodies::cube()), b = bodies::model(bodies::octahedron());
  for (const double gap : {1.0, 1e-12}) {
    EXPECT_TRUE(touches({a, {}}, {b, {Mat3::Identity(), Vec3(0, 0, 2 + gap)}}).empty()) << gap;
  }
  EXPECT_EQ(touches({a, {}}, {b, {Mat3::Identity(), Vec3(0, 0, 2)}}).size(), 1u);
}

/// It grows with coordinates far from a frame's origin, and with what a rotation lacks of being one.
TEST(Touches, AreAsDeepAsTheTolerance) {
  const double far = 1024, wrong = 1e-4;
  const Model left = bodies::model(bodies::moved(bodies::cube(), Mat3::Identity(), Vec3(-far, 0, 0)));
  const Model right = bodies::model(bodies::moved(bodies::cube(), Mat3::Identity(), Vec3(far, 0, 0)));
  const Pose between{Mat3::Identity(), Vec3(2 - 2 * far, 0, 0)};
  const auto face_on_face = touches({left, {}}, {right, between});
  EXPECT_EQ(face_on_face.size(), 4u);
  for (const fcl::Touch& touch : face_on_face) {
    EXPECT_EQ(touch.depth, tolerance(left, right, between));
    EXPECT_NEAR(touch.point.x(), 1 - far, 1e-9);
  }
  const Placed stretched{right, {Vec3(1, 1 + wrong, 1 - wrong).asDiagonal(), between.translation}};
  const auto on_stretched = touches({left, {}}, stretched);
  EXPECT_EQ(on_stretched.size(), 4u);
  for (const fcl::Touch& touch : on_stretched) EXPECT_GT(touch.depth, tolerance(left, right, between) + wrong * wrong * far);
}

/// Also where the other solver sees no overlap, so that the proof has no contact to go with it. Asked as FCL's tables ask.
template <class Others>
int overlooked_by_others() {
  const Convex a(stored("fat_a")), b(stored("fat_b"));
  const ::fcl::Convexd &plain_a = a, &plain_b = b;
  RandomPoses poses;
  int overlooked = 0;
  for (int i = 0; i < 300; ++i) {
    Transform b_in_world = poses.next(1);
    b_in_world.translation() = 3 * b_in_world.translation().normalized();
    const Measured apart = measure(a, at(0, 0, 0), b, b_in_world, Solver());
    const Vec3 normal = (apart.on_b - apart.on_a).normalized();
    b_in_world.translation() -= (apart.distance + std::pow(10, -(6 + i % 7))) * normal;
    std::vector<::fcl::ContactPointd> ours, theirs;
    EXPECT_TRUE((fcl::Solver<double, Others>().shapeIntersect(plain_a, at(0, 0, 0), plain_b, b_in_world, &ours))) << i;
    if (ours.empty()) ADD_FAILURE() << "no contact of pair " << i;
    if (Others().shapeIntersect(plain_a, at(0, 0, 0), plain_b, b_in_world, &theirs)) continue;
    ++overlooked;
    EXPECT_GT(ours[0].penetration_depth, 0) << i;
    EXPECT_GT(ours[0].normal.dot(normal), 0.9) << i;
    EXPECT_LE((ours[0].pos - apart.on_a).norm(), 1e-5) << i;
  }
  return overlooked;
}

TEST(Collision, HasAContactHoweverThinTheOverlap) {
  const int libccd = overlooked_by_others<::fcl::detail::GJKSolver_libccd<double>>();
  const int indep = overlooked_by_others<::fcl::detail::GJKSolver_indep<double>>();
  std::printf("300 overlaps of 1e-6 to 1e-12: overlooked by FCL's libccd solver %d, by its own %d\n", libccd, indep);
}

TEST(Solver, LeavesOtherShapesToTheOther) {
  const Model model = bodies::model(bodies::octahedron());
  const Convex convex(model);
  const ::fcl::Convexd without_model(std::make_shared<std::vector<Vec3>>(convex.getVertices()), convex.getFaceCount(),
                                     std::make_shared<std::vector<int>>(convex.getFaces()));
  const ::fcl::Boxd box(1, 1, 1);
  const ::fcl::Sphered sphere(0.5);
  const ::fcl::Cylinderd cylinder(0.5, 1);
  Solver solver;
  solver.others.distance_tolerance = 1e-12;  // as measure() asks of FCL
  const Transform there = at(3, 0.25, 0.5);
  const auto expect_same = [&](const ::fcl::CollisionGeometryd& a, const ::fcl::CollisionGeometryd& b) {
    EXPECT_EQ(measure(a, at(0, 0, 0), b, there, solver).distance, measure(a, at(0, 0, 0), b, there, FclsOwn()).distance);
    EXPECT_EQ(collide(a, at(0, 0, 0), b, at(0.25, 0.5, 0.25), solver).numContacts(),
              collide(a, at(0, 0, 0), b, at(0.25, 0.5, 0.25), FclsOwn()).numContacts());
  };
  expect_same(convex, without_model);
  expect_same(without_model, convex);
  expect_same(convex, cylinder);
  expect_same(cylinder, convex);
  expect_same(box, sphere);
  expect_same(without_model, box);

  ::fcl::BVHModel<::fcl::OBBRSSd> mesh;
  mesh.beginModel();
  mesh.addTriangle(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0));
  mesh.endModel();
  expect_same(mesh, without_model);
  expect_same(mesh, sphere);
}

TEST(Solver, TakesSinglePrecision) {
  const Model model = stored("fat_a");
  const fcl::Convex<float> shape(model);
  const ::fcl::Convexf& plain = shape;
  const fcl::Solver<float> solver;
  RandomPoses poses;
  for (int i = 0; i < 100; ++i) {
    ::fcl::Transform3f b_in_world = poses.next(3).cast<float>();
    b_in_world.translation().x() += 4;
    float distance_found = 0;
    solver.shapeDistance(plain, ::fcl::Transform3f::Identity(), plain, b_in_world, &distance_found);
    const Answer truth = distance(model, model, pose_of(b_in_world));
    ASSERT_NE(truth.status, Status::InvalidPose);
    EXPECT_NEAR(distance_found, truth.verdict == Verdict::Disjoint ? truth.lower : -1, 3e-6);
  }
}

/// The seed changes the work, never the answer: one solver for one pair, one for all, a new one each time.
TEST(Solver, MayServeOnePairOrAll) {
  const Convex a(stored("fat_a")), b(stored("fat_b")), c(stored("long"));
  const Solver shared, first, second;
  for (int i = 0; i < 100; ++i) {
    const Transform b_in_world = at(3, 0.02 * i, 0), c_in_world = at(0.03 * i, 3, 1);
    for (const auto& [other, pose, own] : {std::tuple(&b, b_in_world, &first), std::tuple(&c, c_in_world, &second)}) {
      const double truth = measure(a, at(0, 0, 0), *other, pose, Solver()).distance;
      EXPECT_NEAR(measure(a, at(0, 0, 0), *other, pose, shared).distance, truth, 1e-13);
      EXPECT_NEAR(measure(a, at(0, 0, 0), *other, pose, *own).distance, truth, 1e-13);
    }
  }
}

}  // namespace
}  // namespace swiftlet
