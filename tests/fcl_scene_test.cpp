// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Who answers which pair of FCL's, as adapters/README.md says; broadphase managers; what stays FCL's own; times beside FCL's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#include <octomap/octomap.h>
#endif

#include "fcl_world.h"

namespace swiftlet {
namespace {

using Geometry = ::fcl::CollisionGeometryd;
using Transform = fcl_world::Transform<double>;

constexpr auto at = fcl_world::at<double>;
using fcl_world::Random;
using fcl_world::stored;

/// The same corners and faces without the model.
std::shared_ptr<::fcl::Convexd> without_model(const ::fcl::Convexd& convex) {
  return std::make_shared<::fcl::Convexd>(std::make_shared<std::vector<Vec3>>(convex.getVertices()), convex.getFaceCount(),
                                          std::make_shared<std::vector<int>>(convex.getFaces()));
}

std::shared_ptr<fcl::Convex<double>> hull(const Model& model) { return std::make_shared<fcl::Convex<double>>(model); }

template <class BV>
std::shared_ptr<::fcl::BVHModel<BV>> hills() {
  const auto corner = [](int i, int j) { return Vec3(i / 2., j / 2., std::sin(i * 1.3) * std::cos(j * 0.9) / 2); };
  auto mesh = std::make_shared<::fcl::BVHModel<BV>>();
  mesh->beginModel();
  for (int i = -8; i < 8; ++i) {
    for (int j = -8; j < 8; ++j) {
      mesh->addTriangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      mesh->addTriangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
  mesh->endModel();
  return mesh;
}

/// The same triangles as a mesh of ours.
template <class BV>
std::shared_ptr<fcl::Mesh<BV>> mesh_hills() {
  return std::make_shared<fcl::Mesh<BV>>(fcl::mesh_of(*hills<BV>()).value());
}

#if FCL_HAVE_OCTOMAP
std::shared_ptr<::fcl::OcTreed> clutter() {
  auto tree = std::make_shared<octomap::OcTree>(0.25);
  Random random;
  tree->updateNode(octomap::point3d(0.1f, 0.1f, 0.1f), true);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random.vector(1.5);
    tree->updateNode(octomap::point3d(float(p[0]), float(p[1]), float(p[2])), true);
  }
  return std::make_shared<::fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}
#endif

// ---- Who answers -----------------------------------------------------------------------------------------------------------

/// FCL's solver, which counts how often it is asked.
struct Counting : ::fcl::detail::GJKSolver_libccd<double> {
  using Base = ::fcl::detail::GJKSolver_libccd<double>;
  mutable int times = 0;

  template <class... Arguments>
  bool shapeIntersect(Arguments&&... arguments) const {
    return ++times, Base::shapeIntersect(std::forward<Arguments>(arguments)...);
  }
  template <class... Arguments>
  bool shapeDistance(Arguments&&... arguments) const {
    return ++times, Base::shapeDistance(std::forward<Arguments>(arguments)...);
  }
  template <class... Arguments>
  bool shapeSignedDistance(Arguments&&... arguments) const {
    return ++times, Base::shapeSignedDistance(std::forward<Arguments>(arguments)...);
  }
  template <class... Arguments>
  bool shapeTriangleIntersect(Arguments&&... arguments) const {
    return ++times, Base::shapeTriangleIntersect(std::forward<Arguments>(arguments)...);
  }
  template <class... Arguments>
  bool shapeTriangleDistance(Arguments&&... arguments) const {
    return ++times, Base::shapeTriangleDistance(std::forward<Arguments>(arguments)...);
  }
};
using CountingSolver = fcl::Solver<double, Counting>;

/// One of every kind that FCL has, around the origin, by its name on the page.
std::vector<std::pair<std::string, std::shared_ptr<Geometry>>> zoo() {
  const auto cube = hull(bodies::model(bodies::cube()));
  std::vector<std::pair<std::string, std::shared_ptr<Geometry>>> all{
      {"swiftlet::fcl::Convex", cube},
      {"fcl::Convex", without_model(*cube)},
      {"fcl::Sphere", std::make_shared<::fcl::Sphered>(1)},
      {"fcl::Capsule", std::make_shared<::fcl::Capsuled>(1, 1)},
      {"fcl::Box", std::make_shared<::fcl::Boxd>(1, 1, 1)},
      {"fcl::Halfspace", std::make_shared<::fcl::Halfspaced>(Vec3(0, 0, 1), 0)},
      {"fcl::Plane", std::make_shared<::fcl::Planed>(Vec3(0, 0, 1), 0)},
      {"fcl::TriangleP", std::make_shared<::fcl::TrianglePd>(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0))},
      {"fcl::Ellipsoid", std::make_shared<::fcl::Ellipsoidd>(1, 1.5, 2)},
      {"fcl::Cylinder", std::make_shared<::fcl::Cylinderd>(1, 1)},
      {"fcl::Cone", std::make_shared<::fcl::Coned>(1, 1)},
      {"fcl::BVHModel", hills<::fcl::AABBd>()},
      {"fcl::BVHModel", hills<::fcl::OBBd>()},
      {"fcl::BVHModel", hills<::fcl::RSSd>()},
      {"fcl::BVHModel", hills<::fcl::kIOSd>()},
      {"fcl::BVHModel", hills<::fcl::OBBRSSd>()},
      {"fcl::BVHModel", hills<::fcl::KDOP<double, 16>>()},
      {"fcl::BVHModel", hills<::fcl::KDOP<double, 18>>()},
      {"fcl::BVHModel", hills<::fcl::KDOP<double, 24>>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::AABBd>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::OBBd>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::RSSd>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::kIOSd>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::OBBRSSd>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::KDOP<double, 16>>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::KDOP<double, 18>>()},
      {"swiftlet::fcl::Mesh", mesh_hills<::fcl::KDOP<double, 24>>()}};
#if FCL_HAVE_OCTOMAP
  all.emplace_back("fcl::OcTree", clutter());
#endif
  return all;
}

/// The rows of the page's table that begin with a class of FCL's, and who answers.
std::map<std::string, std::string> table_of_the_page() {
  std::ifstream page(std::string(SWIFTLET_TEST_DIR) + "/../adapters/README.md");
  std::map<std::string, std::string> rows;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `fcl::") && !line.starts_with("| `swiftlet::fcl::")) continue;
    const std::size_t end = line.find(" | ", 2), next = line.find(" | ", end + 3);
    if (end == std::string::npos || next == std::string::npos) continue;
    const std::string names = line.substr(2, end - 2);
    for (std::size_t begin = 0; (begin = names.find('`', begin)) != std::string::npos;) {
      const std::size_t close = names.find('`', begin + 1);
      rows[names.substr(begin + 1, close - begin - 1)] = line.substr(end + 3, next - end - 3);
      begin = close + 1;
    }
  }
  return rows;
}

/// Of the page's second table: with a Mesh in place of the Convex the others are swiftlet's where it says so. FCL's own
/// functions of two BVHModels ask no solver, so that what they answer shows only where they have no relative error.
TEST(WhoAnswers, AMeshsPairsAsThePageSays) {
  const auto mesh = mesh_hills<::fcl::OBBRSSd>();
  const std::set<std::string> ours{"swiftlet::fcl::Convex", "fcl::Sphere", "fcl::Capsule", "fcl::Box"};
  int asked = 0;
  for (const auto& [name, shape] : zoo()) {
    if (shape->getObjectType() != ::fcl::OT_GEOM || name == "fcl::TriangleP" || name == "fcl::Plane" ||
        name == "fcl::Halfspace")
      continue;
    const CountingSolver solver;
    ::fcl::CollisionResultd collision;
    ::fcl::collide(mesh.get(), at(0, 0, 0), shape.get(), at(0, 0, 0.1), &solver, ::fcl::CollisionRequestd(1, true), collision);
    EXPECT_EQ(solver.others.times > 0, ours.count(name) == 0) << name;
    EXPECT_TRUE(collision.isCollision()) << name;
    ++asked;
  }
  EXPECT_EQ(asked, 8);
}

/// The page's table and what happens are one and the same, in both orders, of distances and collisions.
TEST(WhoAnswers, IsWhatThePageSays) {
  const std::map<std::string, std::string> page = table_of_the_page();
  const auto cube = hull(bodies::model(bodies::cube()));
  const auto& collisions = ::fcl::getCollisionFunctionLookTable<CountingSolver>().collision_matrix;
  const auto& distances = ::fcl::getDistanceFunctionLookTable<CountingSolver>().distance_matrix;
  std::set<std::string> seen{"fcl::continuousCollide"};  // its own test
  std::set<::fcl::NODE_TYPE> types{::fcl::BV_UNKNOWN};   // no geometry has it
  std::set<::fcl::NODE_TYPE> without_distance;
  int ours = 0, theirs = 0;
  for (const auto& [name, shape] : zoo()) {
    seen.insert(name), types.insert(shape->getNodeType());
    ASSERT_TRUE(page.count(name)) << name << " is in no row of the page";
    const std::string who = page.at(name);
    ASSERT_TRUE(who == "swiftlet" || who == "`Others`" || who == "the solver") << name << ": " << who;
    (who == "`Others`" ? theirs : ours) += 1;
    for (const bool cube_first : {true, false}) {
      const Geometry* const one = cube_first ? cube.get() : shape.get();
      const Geometry* const two = cube_first ? shape.get() : cube.get();
      const ::fcl::NODE_TYPE i = one->getNodeType(), j = two->getNodeType();
      if (who == "the solver") {
        EXPECT_EQ(collisions[i][j], nullptr);
        EXPECT_EQ(distances[i][j], nullptr);
        continue;
      }
      for (const double height : {0.1, 30.}) {
        const Transform one_there = cube_first ? at(0, 0, height) : at(0, 0, 0),
                        two_there = cube_first ? at(0, 0, 0) : at(0, 0, height);
        const CountingSolver solver;
        ::fcl::CollisionResultd collision;
        ::fcl::collide(one, one_there, two, two_there, &solver, ::fcl::CollisionRequestd(1, true), collision);
        EXPECT_EQ(solver.others.times > 0, who == "`Others`") << name;
        EXPECT_EQ(collision.isCollision(), height < 1) << name;

        if (!distances[i][j] && !distances[j][i]) {
          without_distance.insert(shape->getNodeType());
          continue;
        }
        const CountingSolver measuring;
        ::fcl::DistanceResultd distance;
        ::fcl::distance(one, one_there, two, two_there, &measuring, ::fcl::DistanceRequestd(true), distance);
        EXPECT_EQ(measuring.others.times > 0, who == "`Others`") << name;
        EXPECT_EQ(distance.min_distance > 0, height > 1) << name;
      }
    }
  }
  for (const auto& [name, who] : page) EXPECT_TRUE(seen.count(name)) << name << " is a row of the page, and no shape here";
  const std::set<::fcl::NODE_TYPE> boxes{::fcl::BV_AABB, ::fcl::BV_OBB, ::fcl::BV_KDOP16, ::fcl::BV_KDOP18, ::fcl::BV_KDOP24};
  EXPECT_EQ(without_distance, boxes) << "meshes of which the page says that FCL has no distance";
#if !FCL_HAVE_OCTOMAP
  types.insert(::fcl::GEOM_OCTREE);
#endif
  EXPECT_EQ(types.size(), std::size_t(::fcl::NODE_COUNT)) << "a kind of geometry is in no row";
  std::printf("%d kinds of geometry are swiftlet's, %d are left to the other solver\n", ours, theirs);
}

/// Poses that are no rigid motion, and boxes of negative size, are the other solver's too.
TEST(WhoAnswers, LeavesWhatIsNoBodyToTheOther) {
  const auto cube = hull(bodies::model(bodies::cube()));
  const ::fcl::Convexd& plain = *cube;
  Transform stretched = at(0, 0, 1);
  stretched.linear() *= 1.5;
  const CountingSolver solver;
  solver.shapeIntersect(plain, stretched, ::fcl::Boxd(1, 1, 1), at(0, 0, 0));
  solver.shapeIntersect(plain, stretched, ::fcl::Halfspaced(Vec3(0, 0, 1), 0), at(0, 0, 0));
  solver.shapeIntersect(plain, at(0, 0, 0), ::fcl::Boxd(-1, 1, 1), at(0, 0, 0));
  EXPECT_EQ(solver.others.times, 3);
}

/// It takes no solver: a Convex is to it what an fcl::Convex of the same points is.
TEST(ContinuousCollide, IsFclsOwn) {
  EXPECT_EQ(table_of_the_page()["fcl::continuousCollide"], "FCL");
  const auto ours = hull(stored("fat_a"));
  const auto theirs = without_model(*ours);
  int hits = 0;
  for (const auto solver : {::fcl::CCDC_NAIVE, ::fcl::CCDC_CONSERVATIVE_ADVANCEMENT}) {
    ::fcl::ContinuousCollisionRequestd request;
    request.ccd_solver_type = solver;
    request.ccd_motion_type = solver == ::fcl::CCDC_NAIVE ? ::fcl::CCDM_TRANS : ::fcl::CCDM_LINEAR;
    for (int i = 0; i < 10; ++i) {
      const auto ask = [&](const ::fcl::Convexd& shape) {
        ::fcl::ContinuousCollisionResultd result;
        ::fcl::continuousCollide(&shape, at(-5, 0, 0), at(5, 0.1 * i, 0), &shape, at(0, 0.4 * i, 0), at(0, 0.4 * i, 0), request,
                                 result);
        return std::pair(result.is_collide, result.time_of_contact);
      };
      EXPECT_EQ(ask(*ours), ask(*theirs));
      hits += ask(*ours).first;
    }
  }
  EXPECT_GT(hits, 4);
}

// ---- Models of FCL's own hulls ---------------------------------------------------------------------------------------------

TEST(ModelOf, IsTheModelOfTheSameFaces) {
  for (const char* const name : {"fat_a", "long", "plate"}) {
    const Model model = stored(name);
    const auto theirs = without_model(*hull(model));
    const Result<Model> back = fcl::model_of(*theirs);
    ASSERT_TRUE(bool(back)) << name << ": " << back.error().message;
    EXPECT_NEAR(back.value().volume(), model.volume(), 1e-12 * model.volume());
    const fcl::Convex<float> single(model);
    const Result<Model> rounded = fcl::model_of<float>(single);
    ASSERT_TRUE(bool(rounded)) << name << ": " << rounded.error().message;
    EXPECT_NEAR(rounded.value().volume(), model.volume(), 1e-5 * model.volume());
  }
  const auto points =
      std::make_shared<std::vector<Vec3>>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}});
  const auto dented = std::make_shared<std::vector<int>>(
      std::vector<int>{3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 1, 4});
  EXPECT_FALSE(fcl::model_of(::fcl::Convexd(points, 6, dented)));
}

// ---- Managers --------------------------------------------------------------------------------------------------------------

/// Bodies of many kinds in a box, which drift.
struct Scene {
  std::vector<std::unique_ptr<::fcl::CollisionObjectd>> objects;
  std::vector<Vec3> velocities;
  ::fcl::DynamicAABBTreeCollisionManagerd manager;
  Random random;

  Scene(int count, double size) {
    const std::array models{stored("fat_a"), stored("fat_b"), bodies::model(bodies::cube())};
    for (int i = 0; i < count; ++i) {
      std::shared_ptr<Geometry> shape;
      switch (i % 6) {
        case 0: shape = std::make_shared<::fcl::Sphered>(0.7); break;
        case 1: shape = std::make_shared<::fcl::Capsuled>(0.4, 1); break;
        case 2: shape = std::make_shared<::fcl::Cylinderd>(0.5, 1); break;
        default: shape = hull(models[std::size_t(i % 3)]);
      }
      objects.push_back(std::make_unique<::fcl::CollisionObjectd>(shape, random.transform<double>(size)));
      velocities.push_back(random.vector(0.05));
      manager.registerObject(objects.back().get());
    }
    manager.setup();
  }
  void step() {
    for (std::size_t i = 0; i < objects.size(); ++i) move(i, velocities[i]);
    manager.update();
  }
  void move(std::size_t i, const Vec3& by) {
    objects[i]->setTranslation(objects[i]->getTranslation() + by);
    objects[i]->computeAABB();
  }
};

using ContactKey = std::tuple<const Geometry*, const Geometry*, double>;

std::vector<ContactKey> sorted_contacts(const ::fcl::CollisionResultd& result) {
  std::vector<ContactKey> keys;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& c = result.getContact(i);
    keys.emplace_back(std::min(c.o1, c.o2), std::max(c.o1, c.o2), c.penetration_depth);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

TEST(Managers, FindTheCollisionsOfAllPairs) {
  Scene scene(40, 4);
  fcl::CollisionPairs<double> pairs;
  pairs.request = ::fcl::CollisionRequestd(10000, true);
  int ours = 0;
  for (int step = 0; step < 40; ++step) {
    scene.step();
    pairs.start_step();
    scene.manager.collide(&pairs, pairs.callback);
    ::fcl::CollisionResultd expected;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.objects.size(); ++j) {
        const fcl::Solver<double> cold;
        ::fcl::CollisionResultd one;
        ::fcl::collide(scene.objects[i].get(), scene.objects[j].get(), &cold, pairs.request, one);
        for (std::size_t k = 0; k < one.numContacts(); ++k) expected.addContact(one.getContact(k));
      }
    }
    const auto found = sorted_contacts(pairs.result), wanted = sorted_contacts(expected);
    ASSERT_EQ(found.size(), wanted.size()) << step;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(std::get<0>(found[i]), std::get<0>(wanted[i]));
      EXPECT_EQ(std::get<1>(found[i]), std::get<1>(wanted[i]));
      const std::array kinds{std::get<0>(found[i])->getNodeType(), std::get<1>(found[i])->getNodeType()};
      const auto has = [&](::fcl::NODE_TYPE type) { return std::count(kinds.begin(), kinds.end(), type) > 0; };
      if (!has(::fcl::GEOM_CONVEX) || has(::fcl::GEOM_CYLINDER)) continue;  // FCL's depths depend on the order
      ++ours;
      EXPECT_NEAR(std::get<2>(found[i]), std::get<2>(wanted[i]), 1e-12);
    }
  }
  EXPECT_GT(ours, 1000);
}

TEST(Managers, FindTheLeastDistanceOfAllPairs) {
  Scene scene(30, 12);
  fcl::DistancePairs<double> pairs;
  pairs.request.enable_nearest_points = true;
  int apart = 0;
  for (int step = 0; step < 40; ++step) {
    scene.step();
    pairs.start_step();
    scene.manager.distance(&pairs, pairs.callback);
    ::fcl::DistanceResultd expected;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.objects.size(); ++j) {
        const fcl::Solver<double> cold;
        ::fcl::distance(scene.objects[i].get(), scene.objects[j].get(), &cold, pairs.request, expected);
      }
    }
    EXPECT_EQ(pairs.result.min_distance > 0, expected.min_distance > 0);
    if (expected.min_distance <= 0) continue;
    ++apart;
    EXPECT_NEAR(pairs.result.min_distance, expected.min_distance, 1e-6);
  }
  EXPECT_GT(apart, 10);
}

TEST(Managers, StopWhereTheRequestIsSatisfied) {
  Scene scene(40, 2);
  fcl::CollisionPairs<double> pairs;  // asks for one contact
  pairs.start_step();
  scene.manager.collide(&pairs, pairs.callback);
  EXPECT_EQ(pairs.result.numContacts(), 1u);
  EXPECT_LT(pairs.pair_count(), 40u * 39 / 2);
  pairs.start_step();
  EXPECT_FALSE(pairs.result.isCollision());
}

/// A pair that does not come is gone at the start of the second step after its last one.
TEST(Managers, ForgetPairsThatLeave) {
  Scene scene(40, 4);
  fcl::CollisionPairs<double> pairs;
  pairs.request = ::fcl::CollisionRequestd(10000, false);
  const auto collide = [&] {
    pairs.start_step();
    scene.manager.collide(&pairs, pairs.callback);
    return pairs.pair_count();
  };
  const std::size_t before = collide();
  EXPECT_GT(before, 50u);
  EXPECT_EQ(collide(), before);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.move(i, Vec3(100. * double(i), 0, 0));
  scene.manager.update();
  EXPECT_EQ(collide(), before);  // of the step before
  EXPECT_EQ(collide(), 0u);
}

TEST(Managers, GiveTheSameBitsAgain) {
  const auto run = [] {
    Scene scene(40, 4);
    fcl::CollisionPairs<double> pairs;
    pairs.request = ::fcl::CollisionRequestd(10000, true);
    std::vector<double> numbers;
    for (int step = 0; step < 20; ++step) {
      scene.step();
      pairs.start_step();
      scene.manager.collide(&pairs, pairs.callback);
      for (std::size_t i = 0; i < pairs.result.numContacts(); ++i) {
        const auto& c = pairs.result.getContact(i);
        numbers.insert(numbers.end(), {c.penetration_depth, c.pos[0], c.pos[1], c.pos[2], c.normal[0]});
      }
    }
    return numbers;
  };
  const auto once = run();
  EXPECT_GT(once.size(), 1000u);
  EXPECT_EQ(once, run());
}

// ---- Beside FCL ------------------------------------------------------------------------------------------------------------

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Microseconds of both, the median of rounds in which they take turns.
std::pair<double, double> beside(int count, const std::function<void()>& ours, const std::function<void()>& theirs) {
  std::vector<double> a, b;
  for (int round = 0; round < 5; ++round) a.push_back(seconds(ours)), b.push_back(seconds(theirs));
  std::nth_element(a.begin(), a.begin() + 2, a.end()), std::nth_element(b.begin(), b.begin() + 2, b.end());
  return {a[2] / count * 1e6, b[2] / count * 1e6};
}

/// Of a hull that turns past a shape, in and out of contact. FCL's own has no distance to half-spaces, and nothing of planes:
/// it ends the program.
TEST(BesideFcl, Times) {
  constexpr int kPoses = 400;
  std::vector<Transform> poses;
  for (int i = 0; i < kPoses; ++i) {
    Transform t = at(0.4 * std::cos(0.02 * i), 0.3, 1.5 + std::sin(0.02 * i));
    t.linear() = Eigen::AngleAxisd(0.01 * i, Vec3(1, 2, 3).normalized()).matrix();
    poses.push_back(t);
  }
  std::vector<std::pair<std::string, std::shared_ptr<Geometry>>> others{
      {"a sphere", std::make_shared<::fcl::Sphered>(1)},
      {"a capsule", std::make_shared<::fcl::Capsuled>(0.5, 1)},
      {"a box", std::make_shared<::fcl::Boxd>(2, 2, 2)},
      {"a Convex", hull(stored("fat_b"))},
      {"a half-space", std::make_shared<::fcl::Halfspaced>(Vec3(0, 0, 1), 0)},
      {"a plane", std::make_shared<::fcl::Planed>(Vec3(0, 0, 1), 0)},
      {"a mesh of 512 triangles", hills<::fcl::OBBRSSd>()}};
#if FCL_HAVE_OCTOMAP
  others.emplace_back("an octree of 200 boxes", clutter());
#endif
  for (const char* const model : {"cube", "fat_a"}) {
    const auto a = model == std::string("cube") ? hull(bodies::model(bodies::cube())) : hull(stored(model));
    std::printf(
        "a hull of %zu vertices: microseconds of a distance, FCL's; of a collision with contacts, FCL's; its depths are more "
        "than the least by up to\n",
        a->getVertices().size());
    for (const auto& [name, b] : others) {
      const auto distances = [&](const auto& solver) {
        for (const Transform& t : poses) {
          ::fcl::DistanceResultd result;
          ::fcl::distance(a.get(), t, b.get(), at(0, 0, 0), &solver, ::fcl::DistanceRequestd(true), result);
        }
      };
      const auto collisions = [&](const auto& solver) {
        for (const Transform& t : poses) {
          ::fcl::CollisionResultd result;
          ::fcl::collide(a.get(), t, b.get(), at(0, 0, 0), &solver, ::fcl::CollisionRequestd(100, true), result);
        }
      };
      const fcl::Solver<double> ours;
      const ::fcl::detail::GJKSolver_libccd<double> theirs;
      const bool is_plane = b->getNodeType() == ::fcl::GEOM_PLANE,
                 is_flat = is_plane || b->getNodeType() == ::fcl::GEOM_HALFSPACE;
      const auto [distance, fcls_distance] = beside(
          kPoses, [&] { distances(ours); }, [&] { is_flat ? void() : distances(theirs); });
      const auto [collision, fcls_collision] = beside(
          kPoses, [&] { collisions(ours); }, [&] { is_plane ? void() : collisions(theirs); });
      double excess = 0;
      for (const Transform& t : poses) {
        if (is_plane || b->getObjectType() != ::fcl::OT_GEOM) break;
        ::fcl::CollisionResultd least, fcls;
        ::fcl::collide(a.get(), t, b.get(), at(0, 0, 0), &ours, ::fcl::CollisionRequestd(1, true), least);
        ::fcl::collide(a.get(), t, b.get(), at(0, 0, 0), &theirs, ::fcl::CollisionRequestd(1, true), fcls);
        if (!least.isCollision() || !fcls.isCollision()) continue;
        const double more = fcls.getContact(0).penetration_depth - least.getContact(0).penetration_depth;
        EXPECT_GE(more, -1e-5) << name;  // ours is the least
        excess = std::max(excess, more);
      }
      std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.1e |\n", name.c_str(), distance, fcls_distance, collision,
                  fcls_collision, excess);
    }
  }

  Scene scene(200, 7);
  fcl::CollisionPairs<double> pairs;
  pairs.request = ::fcl::CollisionRequestd(100000, true);
  const auto [ours, theirs] = beside(
      20,
      [&] {
        for (int step = 0; step < 20; ++step) {
          scene.step();
          pairs.start_step();
          scene.manager.collide(&pairs, pairs.callback);
        }
      },
      [&] {
        for (int step = 0; step < 20; ++step) {
          scene.step();
          ::fcl::DefaultCollisionData<double> data;
          data.request = pairs.request;
          scene.manager.collide(&data, ::fcl::DefaultCollisionFunction<double>);
        }
      });
  std::printf("a step of 200 bodies: %.0f, FCL's callback %.0f microseconds\n", ours, theirs);
}

}  // namespace
}  // namespace swiftlet
