// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A Convex against every other shape of FCL's, in both precisions and both orders: exact answers by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#include <octomap/octomap.h>
#endif

#include "fcl_world.h"

namespace swiftlet {
namespace {

using namespace fcl_world;

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

/// Distances, signed ones, verdicts, depths, normals and points of one kind of shape.
template <class S>
void expect_brute_force(const char* name, Maker<S> make) {
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::tetrahedron()),
                          bodies::model(bodies::octahedron())};
  const fcl::Solver<S> solver;
  Random random;
  int apart = 0, deep = 0;
  double worst = 0;
  for (int i = 0; i < 240; ++i) {
    const Model& model = models[random.engine() % 3];
    const fcl::Convex<S> a(model);
    const Known<S> b = make(random);
    const Transform<S> a_in_world = random.transform<S>(1), b_in_world = random.transform<S>(2);
    const Polytope a_there = moved(polytope_of(model.level(0).view), fcl::pose_of<S>(a_in_world));
    const double gap = signed_gap(a_there, moved(b.core, fcl::pose_of<S>(b_in_world))) - b.radius;
    if (std::abs(gap) < kRounding<S> * 10) continue;
    (gap > 0 ? apart : deep) += 1;
    const Geometry<S>&hull = a, &other = *b.shape;
    for (const bool a_first : {true, false}) {
      const Geometry<S>&one = a_first ? hull : other, &two = a_first ? other : hull;
      const Transform<S>&one_there = a_first ? a_in_world : b_in_world, &two_there = a_first ? b_in_world : a_in_world;
      const auto plain = measure<S>(one, one_there, two, two_there, solver);
      const auto is_signed = measure<S>(one, one_there, two, two_there, solver, true);
      const auto contacts = collide<S>(one, one_there, two, two_there, solver);
      worst = std::max(worst, std::abs(is_signed.min_distance - gap));
      EXPECT_EQ(contacts.isCollision(), gap <= 0) << i;
      EXPECT_EQ(collide<S>(one, one_there, two, two_there, solver, false).isCollision(), gap <= 0) << i;
      if (gap > 0) {
        EXPECT_NEAR(plain.min_distance, gap, kRounding<S>);
        const Vec3 between = vec3<S>(plain.nearest_points[1]) - vec3<S>(plain.nearest_points[0]);
        EXPECT_NEAR(between.norm(), gap, kRounding<S> * 4);
        continue;
      }
      EXPECT_EQ(plain.min_distance, -1) << i;
      ASSERT_GE(contacts.numContacts(), 1u);
      ASSERT_LE(contacts.numContacts(), 4u);
      EXPECT_NEAR(deepest(contacts), -gap, kRounding<S> * 4) << i;
      // Two, moved along the normal until a quarter apart, is a quarter apart.
      Transform<S> two_out = two_there;
      two_out.translation() += contacts.getContact(0).normal * S(0.25 - gap);
      const Pose b_out = fcl::pose_of<S>(a_first ? two_out : b_in_world),
                 a_out = fcl::pose_of<S>(a_first ? a_in_world : two_out);
      const double out = signed_gap(moved(polytope_of(model.level(0).view), a_out), moved(b.core, b_out)) - b.radius;
      EXPECT_NEAR(out, 0.25, kRounding<S> * 10) << i;
    }
  }
  EXPECT_GT(apart, 60);
  EXPECT_GT(deep, 20);
  EXPECT_LE(worst, kRounding<S>);
  std::printf("%s, %s: %d apart, %d deep, farthest from the exact answer %.1e\n", name,
              std::is_same_v<S, double> ? "double" : "float", apart, deep, worst);
}

TEST(Bodies, AreAnsweredAsBruteForceSays) {
  expect_brute_force<double>("sphere", sphere<double>);
  expect_brute_force<double>("capsule", capsule<double>);
  expect_brute_force<double>("box", box<double>);
  expect_brute_force<double>("convex", convex<double>);
}
TEST(Bodies, AreAnsweredInSinglePrecisionToo) {
  expect_brute_force<float>("sphere", sphere<float>);
  expect_brute_force<float>("capsule", capsule<float>);
  expect_brute_force<float>("box", box<float>);
  expect_brute_force<float>("convex", convex<float>);
}

/// Every kind touches the cube [-1, 1]^3 from above, where it is `height` up.
template <class S>
void expect_touching(const Geometry<S>& other, double height, double apart) {
  const fcl::Convex<S> cube(bodies::model(bodies::cube()));
  const fcl::Solver<S> solver;
  for (const bool cube_first : {true, false}) {
    const auto ask = [&](double z, bool contacts) {
      return cube_first ? collide<S>(cube, at<S>(0, 0, 0), other, at<S>(0, 0, z), solver, contacts)
                        : collide<S>(other, at<S>(0, 0, z), cube, at<S>(0, 0, 0), solver, contacts);
    };
    for (const bool contacts : {true, false}) {
      EXPECT_FALSE(ask(height + apart, contacts).isCollision());
      EXPECT_TRUE(ask(height, contacts).isCollision());
      EXPECT_TRUE(ask(height - apart, contacts).isCollision());
    }
    const auto touching = ask(height, true);
    ASSERT_GE(touching.numContacts(), 1u);
    for (std::size_t i = 0; i < touching.numContacts(); ++i) {
      const auto& contact = touching.getContact(i);
      EXPECT_GT(contact.penetration_depth, 0);
      EXPECT_LE(contact.penetration_depth, 1e-11);
      EXPECT_NEAR(contact.pos[2], 1, kRounding<S>);
      const bool is_up = contact.o1 == &cube;
      EXPECT_NEAR(contact.normal[2], is_up ? 1 : -1, kRounding<S>);
    }
  }
}

template <class S>
std::shared_ptr<::fcl::BVHModel<::fcl::OBBRSS<S>>> floor_of_two() {
  auto mesh = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>();
  using Point = ::fcl::Vector3<S>;
  mesh->beginModel();
  mesh->addTriangle(Point(-4, -4, 0), Point(4, -4, 0), Point(4, 4, 0));
  mesh->addTriangle(Point(-4, -4, 0), Point(4, 4, 0), Point(-4, 4, 0));
  mesh->endModel();
  return mesh;
}

TEST(Touching, Collides) {
  const auto all = [](auto scalar, double apart) {
    using S = decltype(scalar);
    expect_touching<S>(::fcl::Sphere<S>(S(0.5)), 1.5, apart);
    expect_touching<S>(::fcl::Capsule<S>(S(0.5), 2), 2.5, apart);
    expect_touching<S>(::fcl::Box<S>(1, 1, 1), 1.5, apart);
    expect_touching<S>(fcl::Convex<S>(bodies::model(bodies::octahedron())), 2, apart);
    expect_touching<S>(::fcl::Halfspace<S>(::fcl::Vector3<S>(0, 0, -1), 0), 1, apart);
    expect_touching<S>(::fcl::Plane<S>(::fcl::Vector3<S>(0, 0, 1), 0), 1, apart);
    expect_touching<S>(*floor_of_two<S>(), 1, apart);
  };
  all(double(), 1e-9);
  all(float(), 1e-5);
}

/// The depth of bodies that touch is `tolerance`, which single precision may not hold: then its least normal number.
TEST(Touching, HasADepthHoweverSmallTheBodies) {
  const double size = 1e-32f;
  const fcl::Convex<float> cube(bodies::model(bodies::box(size, size, size)));
  const ::fcl::Boxf box(float(2 * size), float(2 * size), float(2 * size));
  const fcl::Solver<float> solver;
  for (const Geometry<float>* const other :
       {static_cast<const Geometry<float>*>(&cube), static_cast<const Geometry<float>*>(&box)}) {
    const auto touching = collide<float>(cube, at<float>(0, 0, 0), *other, at<float>(0, 0, 2 * size), solver);
    ASSERT_GE(touching.numContacts(), 1u);
    for (std::size_t i = 0; i < touching.numContacts(); ++i) EXPECT_GT(touching.getContact(i).penetration_depth, 0);
  }
}

// ---- Half-spaces and planes ------------------------------------------------------------------------------------------------

template <class S>
void expect_lowest_vertex() {
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::tetrahedron()), stored("fat_a"),
                          stored("plate")};
  const fcl::Solver<S> solver;
  Random random;
  std::array<int, 2> apart{}, deep{};
  for (int i = 0; i < 400; ++i) {
    const Model& model = models[random.engine() % 4];
    const fcl::Convex<S> hull(model);
    const bool is_plane = i % 2;
    const ::fcl::Vector3<S> normal = random.vector(1).cast<S>();
    const S offset = S(random.uniform(-2, 2));
    const ::fcl::Halfspace<S> half_space(normal, offset);  // FCL divides both by the normal's length
    const ::fcl::Plane<S> plane(normal, offset);
    const Geometry<S>& flat = is_plane ? static_cast<const Geometry<S>&>(plane) : half_space;
    const Transform<S> a_in_world = random.transform<S>(1), b_in_world = random.transform<S>(1);
    const Pose b_pose = fcl::pose_of<S>(b_in_world);
    const Vec3 up = (b_pose.rotation * vec3<S>(half_space.n)).normalized();
    double least = kFarthest, most = -kFarthest;
    for (const Vec3& p : moved(polytope_of(model.level(0).view), fcl::pose_of<S>(a_in_world)).points) {
      const double height = up.dot(p - b_pose.translation) - double(half_space.d);
      least = std::min(least, height), most = std::max(most, height);
    }
    const bool from_below = is_plane && -most > least;
    const double gap = from_below ? -most : least;
    const Vec3 towards = from_below ? up : Vec3(-up);  // from the hull
    if (std::abs(gap) < kRounding<S> * 10) continue;
    (gap > 0 ? apart : deep)[is_plane] += 1;
    for (const bool hull_first : {true, false}) {
      const Geometry<S>&one = hull_first ? static_cast<const Geometry<S>&>(hull) : flat, &two = hull_first ? flat : hull;
      const Transform<S>&one_there = hull_first ? a_in_world : b_in_world, &two_there = hull_first ? b_in_world : a_in_world;
      const auto signed_one = measure<S>(one, one_there, two, two_there, solver, true);
      EXPECT_NEAR(signed_one.min_distance, gap, kRounding<S>) << i;
      const auto contacts = collide<S>(one, one_there, two, two_there, solver);
      EXPECT_EQ(contacts.isCollision(), gap <= 0) << i;
      const Vec3 from_one = hull_first ? towards : Vec3(-towards);
      if (gap > 0) {
        const Vec3 between = vec3<S>(signed_one.nearest_points[1]) - vec3<S>(signed_one.nearest_points[0]);
        EXPECT_LE((between - gap * from_one).norm(), kRounding<S> * 4) << i;
        continue;
      }
      EXPECT_EQ(measure<S>(one, one_there, two, two_there, solver).min_distance, -1);
      ASSERT_GE(contacts.numContacts(), 1u);
      EXPECT_NEAR(deepest(contacts), -gap, kRounding<S>) << i;
      for (std::size_t k = 0; k < contacts.numContacts(); ++k) {
        EXPECT_LE((vec3<S>(contacts.getContact(k).normal) - from_one).norm(), kRounding<S>) << i;
      }
    }
  }
  for (const int count : {apart[0], apart[1], deep[0], deep[1]}) EXPECT_GT(count, 40);
}

TEST(Flat, IsAnsweredByTheLowestVertex) {
  expect_lowest_vertex<double>();
  expect_lowest_vertex<float>();
}

/// Deep or not, the corners of the lowest face.
TEST(Flat, HoldsAFaceByItsCorners) {
  const fcl::Convex<double> box(bodies::model(bodies::box(1, 2, 3)));
  const ::fcl::Halfspaced ground(Vec3(0, 0, 1), 0);
  for (const double height : {3.0, 2.5, -1.0}) {
    const auto contacts = collide<double>(box, at<double>(10, 20, height), ground, at<double>(0, 0, 0), fcl::Solver<double>());
    ASSERT_EQ(contacts.numContacts(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& contact = contacts.getContact(i);
      EXPECT_NEAR(contact.penetration_depth, 3 - height, 1e-11);
      EXPECT_NEAR(std::abs(contact.pos[0] - 10), 1, 1e-12);
      EXPECT_NEAR(std::abs(contact.pos[1] - 20), 2, 1e-12);
      EXPECT_NEAR(contact.pos[2], (height - 3) / 2, 1e-12);
      EXPECT_NEAR(contact.normal[2], -1, 1e-12);
    }
  }
}

/// A component of the normal may be smaller than any coordinate of a body.
TEST(Flat, MayLeanHoweverLittle) {
  const fcl::Convex<double> cube(bodies::model(bodies::cube()));
  const fcl::Solver<double> solver;
  for (const double lean : {1e-60, 1e-80, 1e-300}) {
    for (const Vec3& normal : {Vec3(lean, 0, 1), Vec3(0, lean, 1), Vec3(-lean, lean, 1)}) {
      const ::fcl::Halfspaced ground(normal, 0);
      const ::fcl::Planed plane(normal, 0);
      for (const Geometry<double>* const flat :
           {static_cast<const Geometry<double>*>(&ground), static_cast<const Geometry<double>*>(&plane)}) {
        EXPECT_EQ(measure<double>(cube, at<double>(0, 0, 1.5), *flat, at<double>(0, 0, 0), solver).min_distance, 0.5);
        EXPECT_EQ(collide<double>(cube, at<double>(0, 0, 0.75), *flat, at<double>(0, 0, 0), solver).numContacts(), 4u);
      }
    }
  }
}

Transform<double> stretched(double by) {
  Transform<double> t = Transform<double>::Identity();
  t.linear() *= by;
  return t;
}

/// Poses that are no rigid motion.
std::vector<Transform<double>> no_poses() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  return {at<double>(0, 0, kNan), at<double>(kInfinity, 0, 0), stretched(1.01), stretched(2), stretched(0.5), stretched(kNan)};
}

/// FCL's solvers would end the program.
TEST(Flat, HasNoDistanceInAPoseThatIsNone) {
  const fcl::Convex<double> cube(bodies::model(bodies::cube()));
  const ::fcl::Convexd& plain = cube;
  const ::fcl::Halfspaced ground(Vec3(0, 0, 1), -2);
  const ::fcl::Planed plane(Vec3(0, 0, 1), -2);
  const fcl::Solver<double> solver;
  const auto expect_none = [&](const auto& flat, const Transform<double>& hull_there, const Transform<double>& flat_there) {
    for (const bool is_signed : {false, true}) {
      const auto result = measure<double>(cube, hull_there, flat, flat_there, solver, is_signed);
      EXPECT_EQ(result.min_distance, ::fcl::DistanceResultd().min_distance);
      EXPECT_EQ(result.o1, nullptr);
    }
    double distance = 0;
    Vec3 p = Vec3::Zero(), q = Vec3::Zero();
    EXPECT_FALSE(solver.shapeDistance(flat, flat_there, plain, hull_there, &distance, &p, &q));
    EXPECT_TRUE(std::isnan(distance) && p.hasNaN() && q.hasNaN());
  };
  const Transform<double> here = at<double>(0, 0, 0);
  for (const Transform<double>& nowhere : no_poses()) {
    expect_none(ground, nowhere, here);
    expect_none(plane, nowhere, here);
    expect_none(ground, here, nowhere);
    expect_none(plane, here, nowhere);
  }
  for (const double by : {1 + 2e-4, 1 - 2e-4}) {  // is given back, as to any body
    EXPECT_NEAR(measure<double>(cube, here, ground, stretched(by), solver).min_distance, 1, 1e-12);
    EXPECT_NEAR(measure<double>(cube, here, plane, stretched(by), solver).min_distance, 1, 1e-12);
  }
}

/// Of solids and triangles, too. FCL's solver ends the program of a distance there.
TEST(Shapes, MeetNothingInAPoseThatIsNotFinite) {
  const fcl::Convex<double> cube(bodies::model(bodies::cube()));
  const ::fcl::Convexd& plain = cube;
  const ::fcl::Sphered ball(1);
  const ::fcl::Boxd box(1, 1, 1);
  const fcl::Solver<double> solver;
  const Transform<double> here = at<double>(0, 0, 0);
  const Vec3 p(0, 0, 0), q(1, 0, 0), r(0, 1, 0);
  for (const Transform<double>& nowhere : no_poses()) {
    if (nowhere.matrix().allFinite()) continue;
    for (const Geometry<double>* const other :
         {static_cast<const Geometry<double>*>(&cube), static_cast<const Geometry<double>*>(&ball),
          static_cast<const Geometry<double>*>(&box)}) {
      for (const auto& [hull_there, there] : {std::pair(here, nowhere), std::pair(nowhere, here)}) {
        EXPECT_FALSE(collide<double>(cube, hull_there, *other, there, solver).isCollision());
        EXPECT_FALSE(collide<double>(*other, there, cube, hull_there, solver, false).isCollision());
        for (const bool is_signed : {false, true})
          EXPECT_EQ(measure<double>(cube, hull_there, *other, there, solver, is_signed).o1, nullptr);
      }
    }
    double distance = 0;
    EXPECT_FALSE(solver.shapeTriangleIntersect(plain, nowhere, p, q, r));
    EXPECT_FALSE(solver.shapeTriangleIntersect(plain, here, p, q, r, nowhere));
    EXPECT_FALSE(solver.shapeTriangleDistance(plain, nowhere, p, q, r, &distance));
    EXPECT_TRUE(std::isnan(distance));
    distance = 0;
    EXPECT_FALSE(solver.shapeTriangleDistance(plain, here, p, q, r, nowhere, &distance));
    EXPECT_TRUE(std::isnan(distance));
  }
}

/// FCL's solvers would end the program there, too; with a half-space they do not, and are asked.
TEST(Flat, APlaneMeetsNothingInAPoseThatIsNone) {
  const fcl::Convex<double> cube(bodies::model(bodies::cube()));
  const ::fcl::Planed plane(Vec3(0, 0, 1), 0);
  const fcl::Solver<double> solver;
  const Transform<double> here = at<double>(0, 0, 0);
  ASSERT_TRUE(collide<double>(cube, here, plane, here, solver).isCollision());
  for (const Transform<double>& nowhere : no_poses()) {
    for (const bool contacts : {true, false}) {
      EXPECT_FALSE(collide<double>(cube, nowhere, plane, here, solver, contacts).isCollision());
      EXPECT_FALSE(collide<double>(cube, here, plane, nowhere, solver, contacts).isCollision());
      EXPECT_FALSE(collide<double>(plane, nowhere, cube, here, solver, contacts).isCollision());
      EXPECT_FALSE(collide<double>(plane, here, cube, nowhere, solver, contacts).isCollision());
    }
  }
}

// ---- Triangles -------------------------------------------------------------------------------------------------------------

template <class S>
Polytope triangle(const ::fcl::Vector3<S>& p, const ::fcl::Vector3<S>& q, const ::fcl::Vector3<S>& r) {
  return {{vec3<S>(p), vec3<S>(q), vec3<S>(r)}, {{0, 1, 2}}, {{0, 1}, {1, 2}, {2, 0}}};
}

/// FCL's tables have no row for it; the solver answers who asks it.
TEST(TriangleP, IsAnsweredByTheSolverAlone) {
  const fcl::Convex<double> hull(stored("fat_a"));
  const ::fcl::Convexd& plain = hull;
  const fcl::Solver<double> solver;
  Random random;
  for (int i = 0; i < 200; ++i) {
    const ::fcl::TrianglePd flat(random.vector(1), random.vector(1), random.vector(1));
    const Transform<double> a_in_world = random.transform<double>(1), b_in_world = random.transform<double>(2);
    const double gap = signed_gap(moved(polytope_of(hull.model().level(0).view), fcl::pose_of<double>(a_in_world)),
                                  moved(triangle<double>(flat.a, flat.b, flat.c), fcl::pose_of<double>(b_in_world)));
    double forth = 0, back = 0;
    EXPECT_EQ(solver.shapeSignedDistance(plain, a_in_world, flat, b_in_world, &forth), gap > 0);
    EXPECT_EQ(solver.shapeSignedDistance(flat, b_in_world, plain, a_in_world, &back), gap > 0);
    EXPECT_NEAR(forth, gap, 1e-12);
    EXPECT_NEAR(back, gap, 1e-12);
    EXPECT_EQ(solver.shapeIntersect(plain, a_in_world, flat, b_in_world), gap <= 0);
  }
}

template <class BV>
std::shared_ptr<::fcl::BVHModel<BV>> hills(std::vector<Polytope>& triangles) {
  using S = typename BV::S;
  using Point = ::fcl::Vector3<S>;
  const auto corner = [](int i, int j) { return Point(S(i) / 2, S(j) / 2, S(std::sin(i * 1.3) * std::cos(j * 0.9)) / 2); };
  auto mesh = std::make_shared<::fcl::BVHModel<BV>>();
  mesh->beginModel();
  triangles.clear();
  const auto add = [&](const Point& p, const Point& q, const Point& r) {
    mesh->addTriangle(p, q, r);
    triangles.push_back(triangle<S>(p, q, r));
  };
  for (int i = -4; i < 4; ++i) {
    for (int j = -4; j < 4; ++j) {
      add(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      add(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
  mesh->endModel();
  return mesh;
}

/// FCL 0.7 has no distance of a mesh with other volumes.
template <class BV>
constexpr bool kHasDistance =
    std::is_same_v<BV, ::fcl::RSS<typename BV::S>> || std::is_same_v<BV, ::fcl::kIOS<typename BV::S>> ||
    std::is_same_v<BV, ::fcl::OBBRSS<typename BV::S>>;

/// The least distance of all triangles, and a contact of each one that is met: FCL has the mesh as 1.
template <class BV>
void expect_brute_force_of_triangles(const char* name) {
  using S = typename BV::S;
  std::vector<Polytope> triangles;
  const auto mesh = hills<BV>(triangles);
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::tetrahedron()),
                          bodies::model(bodies::octahedron())};
  const fcl::Solver<S> solver;
  Random random;
  int apart = 0, met = 0;
  for (int i = 0; i < 60; ++i) {
    const Model& model = models[random.engine() % 3];
    const fcl::Convex<S> hull(model);
    const Transform<S> a_in_world = random.transform<S>(1);
    Transform<S> b_in_world = random.transform<S>(1);
    b_in_world.translation() += (Vec3(0, 0, 1) * random.uniform(0, 3)).cast<S>();
    const Polytope hull_there = moved(polytope_of(model.level(0).view), fcl::pose_of<S>(b_in_world));
    std::vector<double> gaps;
    for (const Polytope& t : triangles) gaps.push_back(signed_gap(moved(t, fcl::pose_of<S>(a_in_world)), hull_there));
    const double least = *std::min_element(gaps.begin(), gaps.end());
    for (const bool mesh_first : {true, false}) {
      const auto ask = [&](auto&& question, auto... more) {
        return mesh_first ? question(*mesh, a_in_world, hull, b_in_world, solver, more...)
                          : question(hull, b_in_world, *mesh, a_in_world, solver, more...);
      };
      apart += least > 0;
      if (kHasDistance<BV> && std::abs(least) > kRounding<S> * 10) {
        const auto distance = ask(measure<S, fcl::Solver<S>>, false);
        EXPECT_NEAR(distance.min_distance, least > 0 ? least : -1, kRounding<S> * 4) << name << i;
        const Vec3 on_mesh = vec3<S>(distance.nearest_points[0]), on_hull = vec3<S>(distance.nearest_points[1]);
        double off = kFarthest;
        for (const Polytope& t : triangles)
          off = std::min(off, std::abs(signed_gap({{on_mesh}, {}, {}}, moved(t, fcl::pose_of<S>(a_in_world)))));
        if (least > 0) {
          EXPECT_NEAR((on_mesh - on_hull).norm(), least, kRounding<S> * 4) << name << i;
          EXPECT_LE(off, kRounding<S> * 4);
        }
      }
      const auto contacts = ask(collide<S, fcl::Solver<S>>, true, std::size_t(1000));
      std::set<std::size_t> seen;
      for (std::size_t k = 0; k < contacts.numContacts(); ++k) {
        const auto& contact = contacts.getContact(k);
        const auto number = std::size_t(contact.b1);
        seen.insert(number);
        ++met;
        EXPECT_NEAR(contact.penetration_depth, -gaps.at(number), kRounding<S> * 4) << name << i;
        Polytope out = hull_there;  // free of the triangle, once moved along the normal
        for (Vec3& p : out.points) p += vec3<S>(contact.normal) * (double(contact.penetration_depth) + 0.25);
        EXPECT_NEAR(signed_gap(moved(triangles[number], fcl::pose_of<S>(a_in_world)), out), 0.25, kRounding<S> * 10)
            << name << i;
      }
      for (std::size_t t = 0; t < gaps.size(); ++t) {
        EXPECT_TRUE(gaps[t] >= -kRounding<S> * 10 || seen.count(t)) << name << i << " misses triangle " << t;
      }
      EXPECT_EQ(ask(collide<S, fcl::Solver<S>>, false, std::size_t(1)).isCollision(), !seen.empty()) << name << i;
    }
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(met, 100);
}

TEST(Meshes, AreAnsweredTriangleByTriangle) {
  expect_brute_force_of_triangles<::fcl::AABBd>("AABB");
  expect_brute_force_of_triangles<::fcl::OBBd>("OBB");
  expect_brute_force_of_triangles<::fcl::RSSd>("RSS");
  expect_brute_force_of_triangles<::fcl::kIOSd>("kIOS");
  expect_brute_force_of_triangles<::fcl::OBBRSSd>("OBBRSS");
  expect_brute_force_of_triangles<::fcl::KDOP<double, 16>>("KDOP16");
  expect_brute_force_of_triangles<::fcl::KDOP<double, 18>>("KDOP18");
  expect_brute_force_of_triangles<::fcl::KDOP<double, 24>>("KDOP24");
}
TEST(Meshes, AreAnsweredInSinglePrecisionToo) {
  expect_brute_force_of_triangles<::fcl::AABBf>("AABB");
  expect_brute_force_of_triangles<::fcl::OBBRSSf>("OBBRSS");
}

// ---- Octrees ---------------------------------------------------------------------------------------------------------------

#if FCL_HAVE_OCTOMAP
std::shared_ptr<const octomap::OcTree> clutter() {
  auto tree = std::make_shared<octomap::OcTree>(0.25);
  Random random;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = random.vector(1.5);
    tree->updateNode(octomap::point3d(float(p[0]), float(p[1]), float(p[2])), true);
  }
  return tree;
}

/// FCL has the tree as 1.
template <class S>
void expect_brute_force_of_boxes() {
  const auto tree = std::make_shared<::fcl::OcTree<S>>(clutter());
  std::vector<Polytope> boxes;
  for (const auto& [x, y, z, size, cost, threshold] : tree->toBoxes()) {
    boxes.push_back(moved(polytope_of(bodies::box(size / 2, size / 2, size / 2)), {Mat3::Identity(), Vec3(x, y, z)}));
  }
  ASSERT_GT(boxes.size(), 40u);
  const std::array models{bodies::model(bodies::octahedron()), bodies::model(bodies::tetrahedron())};
  const fcl::Solver<S> solver;
  Random random;
  int apart = 0, met = 0;
  for (int i = 0; i < 60; ++i) {
    const Model& model = models[random.engine() % 2];
    const fcl::Convex<S> hull(model);
    const Transform<S> a_in_world = random.transform<S>(1), b_in_world = random.transform<S>(3);
    const Polytope hull_there = moved(polytope_of(model.level(0).view), fcl::pose_of<S>(b_in_world));
    std::vector<double> gaps;
    for (const Polytope& b : boxes) gaps.push_back(signed_gap(moved(b, fcl::pose_of<S>(a_in_world)), hull_there));
    const double least = *std::min_element(gaps.begin(), gaps.end());
    if (std::abs(least) < kRounding<S> * 10) continue;
    (least > 0 ? apart : met) += 1;
    for (const bool tree_first : {true, false}) {
      const auto ask = [&](auto&& question, auto... more) {
        return tree_first ? question(*tree, a_in_world, hull, b_in_world, solver, more...)
                          : question(hull, b_in_world, *tree, a_in_world, solver, more...);
      };
      const auto distance = ask(measure<S, fcl::Solver<S>>, false);
      EXPECT_NEAR(distance.min_distance, least > 0 ? least : -1, kRounding<S> * 4) << i;
      const auto contacts = ask(collide<S, fcl::Solver<S>>, true, std::size_t(1000));
      EXPECT_EQ(contacts.isCollision(), least <= 0) << i;
      EXPECT_NEAR(deepest(contacts), std::max(-least, 0.), kRounding<S> * 4) << i;
      for (std::size_t k = 0; k < contacts.numContacts(); ++k) {
        const auto& contact = contacts.getContact(k);
        EXPECT_EQ(contact.o1, tree.get());
        // One of the boxes is as deep or deeper, and free once the hull is moved along the normal.
        int matches = 0;
        for (std::size_t b = 0; b < boxes.size(); ++b) {
          if (double(contact.penetration_depth) > -gaps[b] + kRounding<S> * 4) continue;
          Polytope out = hull_there;
          for (Vec3& p : out.points) p += vec3<S>(contact.normal) * (0.25 - gaps[b]);
          matches += std::abs(signed_gap(moved(boxes[b], fcl::pose_of<S>(a_in_world)), out) - 0.25) < kRounding<S> * 10;
        }
        EXPECT_GE(matches, 1) << i;
      }
    }
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(met, 10);
}

TEST(OcTrees, AreAnsweredBoxByBox) {
  expect_brute_force_of_boxes<double>();
  expect_brute_force_of_boxes<float>();
}
#endif

}  // namespace
}  // namespace swiftlet
