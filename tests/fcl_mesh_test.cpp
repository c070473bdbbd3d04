// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes in FCL: against each other and against shapes, in both precisions and all of FCL's boxes, beside every pair of
// triangles and beside FCL's own answers; its relative error; managers; times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "fcl_world.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace fcl_world;
using soups::Soup;

/// A mesh of ours in FCL's boxes, and its triangles.
struct KnownMesh {
  Soup soup;
  MeshModel mesh = soup.mesh();
};

/// Closed and open, scattered, duplicate and flat triangles.
const std::vector<KnownMesh>& known_meshes() {
  static const std::vector<KnownMesh> all = [] {
    shapes::Random random(5);
    Soup twice = soups::tetrahedron();
    twice.add(soups::tetrahedron());
    twice.add({0, 0, 2}, {0, 0, 2.5}, {0, 0, 3});
    return std::vector<KnownMesh>{{soups::torus(12, 6)},
                                  {soups::scattered(random, 25, 0.8)},
                                  {twice},
                                  {soups::patch(3, [](double x, double y) { return x * y; })}};
  }();
  return all;
}

/// Of two placed soups the distance, by every pair of triangles.
template <class S>
double truth_of(const Soup& a, const Transform<S>& a_in_world, const Soup& b, const Transform<S>& b_in_world) {
  return soups::brute_force(a, b, relative(fcl::pose_of<S>(a_in_world), fcl::pose_of<S>(b_in_world)));
}

/// The triangle alone.
Soup only(const Soup& of, int triangle) {
  Soup one;
  one.add(of.corner(std::size_t(triangle), 0), of.corner(std::size_t(triangle), 1), of.corner(std::size_t(triangle), 2));
  return one;
}

template <class S>
::fcl::DistanceResult<S> measure_within(const Geometry<S>& a, const Transform<S>& a_there, const Geometry<S>& b,
                                        const Transform<S>& b_there, const auto& solver, double relative, double absolute) {
  ::fcl::DistanceResult<S> result;
  ::fcl::distance(&a, a_there, &b, b_there, &solver, ::fcl::DistanceRequest<S>(true, false, S(relative), S(absolute)), result);
  return result;
}

template <class BV>
void expect_truth_of_meshes() {
  using S = typename BV::S;
  // FCL has no distance functions for these boxes.
  const bool has_distance = ::fcl::getDistanceFunctionLookTable<fcl::Solver<S>>()
                                .distance_matrix[fcl::Mesh<BV>(known_meshes()[0].mesh).getNodeType()]
                                                [fcl::Mesh<BV>(known_meshes()[0].mesh).getNodeType()] != nullptr;
  const fcl::Solver<S> solver;
  Random random;
  int apart = 0, meeting = 0;
  for (int i = 0; i < 60; ++i) {
    const KnownMesh &a = known_meshes()[random.engine() % 4], &b = known_meshes()[random.engine() % 4];
    const fcl::Mesh<BV> first(a.mesh), second(b.mesh);
    const Transform<S> a_there = random.transform<S>(1.5), b_there = random.transform<S>(1.5);
    const double truth = truth_of<S>(a.soup, a_there, b.soup, b_there);
    if (truth > 0 && truth < 10 * kRounding<S>) continue;
    (truth > 0 ? apart : meeting) += 1;
    const auto collision = collide<S>(first, a_there, second, b_there, solver, false, 1);
    ASSERT_EQ(collision.isCollision(), truth == 0) << truth;
    if (truth == 0) {
      const auto& contact = collision.getContact(0);
      EXPECT_LE(truth_of<S>(only(a.soup, int(contact.b1)), a_there, only(b.soup, int(contact.b2)), b_there), kRounding<S>);
    }
    if (!has_distance) continue;
    const auto distance = measure<S>(first, a_there, second, b_there, solver);
    EXPECT_NEAR(distance.min_distance, truth, kRounding<S>);
    EXPECT_NEAR((vec3<S>(distance.nearest_points[0]) - vec3<S>(distance.nearest_points[1])).norm(), truth, 2 * kRounding<S>);
    EXPECT_NEAR(truth_of<S>(only(a.soup, distance.b1), a_there, only(b.soup, distance.b2), b_there), truth, 2 * kRounding<S>);
    EXPECT_EQ(distance.o1, &first);
    EXPECT_EQ(distance.o2, &second);
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(meeting, 10);
}

TEST(MeshGeometry, AreWhatTheirTrianglesAre) {
  expect_truth_of_meshes<::fcl::AABBd>();
  expect_truth_of_meshes<::fcl::OBBd>();
  expect_truth_of_meshes<::fcl::RSSd>();
  expect_truth_of_meshes<::fcl::kIOSd>();
  expect_truth_of_meshes<::fcl::OBBRSSd>();
  expect_truth_of_meshes<::fcl::KDOP<double, 16>>();
  expect_truth_of_meshes<::fcl::KDOP<double, 18>>();
  expect_truth_of_meshes<::fcl::KDOP<double, 24>>();
  expect_truth_of_meshes<::fcl::OBBRSSf>();
}

/// All points within a radius of a polytope, against every triangle.
template <class S>
void expect_truth_of_shapes(Maker<S> make) {
  const fcl::Solver<S> solver;
  Random random;
  int apart = 0, meeting = 0;
  for (int i = 0; i < 60; ++i) {
    const KnownMesh& a = known_meshes()[std::size_t(i % 2)];
    const fcl::Mesh<::fcl::OBBRSS<S>> mesh(a.mesh);
    const Geometry<S>& ours = mesh;
    const Known<S> b = make(random);
    const Transform<S> a_there = random.transform<S>(1), b_there = random.transform<S>(1.5);
    const Polytope core = moved(b.core, fcl::pose_of<S>(b_there));
    double gap = kFarthest;
    for (std::size_t t = 0; t < a.soup.triangles.size(); ++t) {
      const Polytope one{
          {a.soup.corner(t, 0), a.soup.corner(t, 1), a.soup.corner(t, 2)}, {{0, 1, 2}}, {{0, 1}, {1, 2}, {2, 0}}};
      gap = std::min(gap, signed_gap(moved(one, fcl::pose_of<S>(a_there)), core) - b.radius);
    }
    if (std::abs(gap) < 10 * kRounding<S>) continue;
    (gap > 0 ? apart : meeting) += 1;
    for (const bool mesh_first : {true, false}) {
      const Geometry<S>&one = mesh_first ? ours : *b.shape, &two = mesh_first ? *b.shape : ours;
      const Transform<S>&one_there = mesh_first ? a_there : b_there, &two_there = mesh_first ? b_there : a_there;
      EXPECT_EQ(collide<S>(one, one_there, two, two_there, solver, false).isCollision(), gap < 0);
      const auto found = measure<S>(one, one_there, two, two_there, solver);
      EXPECT_NEAR(found.min_distance, gap > 0 ? gap : -1, kRounding<S>);
      EXPECT_EQ(found.o1, &mesh) << "FCL has the mesh as 1 in either order";
      EXPECT_EQ(found.b2, -1);
      if (gap < 0) continue;
      EXPECT_NEAR((vec3<S>(found.nearest_points[0]) - vec3<S>(found.nearest_points[1])).norm(), gap, 4 * kRounding<S>);
    }
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(meeting, 10);
}

TEST(MeshGeometry, MeetShapesAsTheirTrianglesDo) {
  expect_truth_of_shapes<double>(sphere<double>);
  expect_truth_of_shapes<double>(capsule<double>);
  expect_truth_of_shapes<double>(box<double>);
  expect_truth_of_shapes<double>(convex<double>);
  expect_truth_of_shapes<float>(sphere<float>);
  expect_truth_of_shapes<float>(convex<float>);
}

/// The pair of each call, or none where the distance is above what the result holds already.
TEST(MeshGeometry, KeepTheLeastOfManyPairs) {
  const fcl::Mesh<::fcl::OBBRSSd> torus(known_meshes()[0].mesh), hills(known_meshes()[3].mesh);
  const fcl::Solver<double> solver;
  const ::fcl::DistanceRequestd request(true);
  ::fcl::DistanceResultd result;
  for (const double height : {4., 3., 5., 2.5, 6.}) {
    const double before = result.min_distance;
    const double alone = measure<double>(torus, at<double>(0, 0, height), hills, at<double>(0, 0, 0), solver).min_distance;
    ::fcl::distance(&torus, at<double>(0, 0, height), &hills, at<double>(0, 0, 0), &solver, request, result);
    EXPECT_EQ(result.min_distance, std::min(before, alone));
  }
  ::fcl::distance(&torus, at<double>(0.5, 0, 0), &hills, at<double>(0, 0, 0), &solver, request, result);
  EXPECT_EQ(result.min_distance, 0) << "of two meshes that cross";
}

/// Contacts of meshes that cross: no more than asked, the deepest first, each between triangles that meet; and the second one,
/// moved along the normal by the depth of the only region, is out.
template <class S>
void expect_contacts_of_boxes() {
  const fcl::Solver<S> solver;
  const MeshModel cube = soups::box({-1, -1, -1}, {1, 1, 1}).mesh();
  const fcl::Mesh<::fcl::OBBRSS<S>> first(cube), second(cube);
  const fcl::Convex<S> hull(bodies::model(bodies::cube()));
  Random random;
  for (int i = 0; i < 40; ++i) {
    const Transform<S> a_there = random.transform<S>(1);
    Transform<S> b_there = random.transform<S>(0);
    b_there.translation() = a_there.translation() + (1.2 * random.vector(1).normalized()).template cast<S>();
    for (const Geometry<S>* const other : {static_cast<const Geometry<S>*>(&second), static_cast<const Geometry<S>*>(&hull)}) {
      const auto all = collide<S>(first, a_there, *other, b_there, solver);
      if (!collide<S>(first, a_there, *other, b_there, solver, false, 1).isCollision()) {
        EXPECT_FALSE(all.isCollision());
        continue;
      }
      ASSERT_GE(all.numContacts(), 1u);
      const auto one = collide<S>(first, a_there, *other, b_there, solver, true, 1);
      ASSERT_EQ(one.numContacts(), 1u);
      EXPECT_EQ(one.getContact(0).penetration_depth, S(deepest(all)));
      for (std::size_t k = 0; k < all.numContacts(); ++k) {
        const auto& contact = all.getContact(k);
        EXPECT_EQ(contact.o1, &first);
        EXPECT_EQ(contact.o2, other);
        EXPECT_NEAR(contact.normal.norm(), 1, kRounding<S>);
        EXPECT_GT(contact.penetration_depth, 0);
        ASSERT_TRUE(contact.b1 >= 0 && contact.b1 < 12);
        ASSERT_TRUE(other == &hull ? contact.b2 == -1 : contact.b2 >= 0 && contact.b2 < 12);
        const Soup box = soups::box({-1, -1, -1}, {1, 1, 1});
        if (other != &second) continue;
        EXPECT_LE(truth_of<S>(only(box, int(contact.b1)), a_there, only(box, int(contact.b2)), b_there), kRounding<S>);
      }
    }
  }
  // A cube a quarter deep in another one's top: one region, its normal up, four points.
  for (const Geometry<S>* const other : {static_cast<const Geometry<S>*>(&second), static_cast<const Geometry<S>*>(&hull)}) {
    const auto found = collide<S>(first, at<S>(0, 0, 0), *other, at<S>(0.3, 0.2, 1.75), solver);
    ASSERT_EQ(found.numContacts(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(found.getContact(k).normal[2], 1, kRounding<S>);
      EXPECT_NEAR(found.getContact(k).penetration_depth, 0.25, kRounding<S>);
      EXPECT_NEAR(found.getContact(k).pos[2], 0.875, kRounding<S>);
    }
  }
  // Touching counts, as of shapes.
  const auto touching = collide<S>(first, at<S>(0, 0, 0), second, at<S>(0.5, 0, 2), solver);
  ASSERT_GE(touching.numContacts(), 1u);
  EXPECT_GT(touching.getContact(0).penetration_depth, 0);
  EXPECT_LE(touching.getContact(0).penetration_depth, kRounding<S>);
}

/// Apart by less than law 2's bound, which is touching: no number of a contact is left as it was.
TEST(MeshGeometry, HasContactsWhereItTouches) {
  const fcl::Mesh<::fcl::OBBRSSd> cube(soups::box({-1, -1, -1}, {1, 1, 1}).mesh());
  for (const double gap : {-8e-15, 0., 8e-15}) {
    for (const bool contacts : {true, false}) {
      const auto there = at<double>(0.3, 0.2, 2 + gap);
      const auto found = collide<double>(cube, at<double>(0, 0, 0), cube, there, fcl::Solver<double>(), contacts);
      EXPECT_EQ(found.numContacts(), contacts ? 4u : 1u) << gap;
      for (std::size_t k = 0; k < found.numContacts(); ++k) {
        const auto& contact = found.getContact(k);
        EXPECT_NEAR(contact.pos[2], 1, 1e-13);
        EXPECT_LE(contact.pos.head<2>().cwiseAbs().maxCoeff(), 1);
        EXPECT_NEAR(contact.penetration_depth, 0, 1e-13);
        EXPECT_NEAR(contact.normal[2], contacts ? 1 : 0, 1e-12);
      }
    }
  }
}

TEST(MeshGeometry, HasContacts) {
  expect_contacts_of_boxes<double>();
  expect_contacts_of_boxes<float>();
}

/// FCL reads rel_err and stops no earlier for it.
TEST(MeshGeometry, HonourFclsErrors) {
  const KnownMesh &a = known_meshes()[0], &b = known_meshes()[1];
  const fcl::Mesh<::fcl::OBBRSSd> first(a.mesh), second(b.mesh);
  Random random;
  int looser = 0, apart = 0;
  for (int i = 0; i < 60; ++i) {
    const Transform<double> a_there = random.transform<double>(1), b_there = random.transform<double>(5);
    const double truth = truth_of<double>(a.soup, a_there, b.soup, b_there);
    if (truth < 1e-6) continue;
    ++apart;
    for (const auto& [relative, absolute] : {std::pair(0., 0.), {0.25, 0.}, {0., 0.25}}) {
      const fcl::Solver<double> cold;
      const auto found = measure_within<double>(first, a_there, second, b_there, cold, relative, absolute);
      const double most = std::max((1 + relative) * found.min_distance, found.min_distance + absolute) + 1e-12;
      EXPECT_LE(found.min_distance, truth + 1e-12);
      EXPECT_LE(truth, most);
      EXPECT_LE((found.nearest_points[0] - found.nearest_points[1]).norm(), most);
      looser += found.min_distance < truth - 1e-6;
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(looser, 30) << "nothing was left undone";
}

TEST(MeshGeometry, RefuseAMeshThatWasCut) {
  EXPECT_THROW(fcl::Mesh<::fcl::OBBRSSd>(soups::torus(64, 32).mesh().cut({.deviation = 10})), std::invalid_argument);
}

TEST(MeshGeometry, OfFclsOwnAreTheSameTriangles) {
  for (const KnownMesh& known : known_meshes()) {
    const fcl::Mesh<::fcl::RSSd> ours(known.mesh);
    const auto back = fcl::mesh_of(ours);
    ASSERT_TRUE(bool(back)) << back.error().message;
    ASSERT_EQ(std::size_t(ours.num_tris), known.soup.triangles.size());
    for (std::size_t t = 0; t < known.soup.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(ours.vertices[ours.tri_indices[t][k]], known.soup.corner(t, k)) << "the user's triangle has another number";
    }
    EXPECT_EQ(back.value().topology(), known.mesh.topology());
  }
  ::fcl::BVHModel<::fcl::RSSd> cloud;
  cloud.beginModel();
  cloud.addVertex({0, 0, 0});
  cloud.addVertex({1, 0, 0});
  cloud.endModel();
  EXPECT_EQ(fcl::mesh_of(cloud).error().code, ErrorCode::Empty);
}

/// What is no rigid motion is FCL's; and a BVHModel of FCL's own, too.
TEST(MeshGeometry, LeaveTheRestToFcl) {
  const fcl::Mesh<::fcl::OBBRSSd> ours(known_meshes()[0].mesh);
  const ::fcl::BVHModel<::fcl::OBBRSSd> theirs(ours);
  const fcl::Solver<double> solver;
  const ::fcl::detail::GJKSolver_libccd<double> fcls;
  for (const double by : {1.01, 1.5, 2.}) {
    Transform<double> stretched = at<double>(0, 0, 4);
    stretched.linear() *= by;
    EXPECT_EQ(measure<double>(ours, stretched, ours, at<double>(0, 0, 0), solver).min_distance,
              measure<double>(ours, stretched, ours, at<double>(0, 0, 0), fcls).min_distance);
  }
  EXPECT_EQ(measure<double>(theirs, at<double>(0, 0, 3), ours, at<double>(0, 0, 0), solver).min_distance,
            measure<double>(theirs, at<double>(0, 0, 3), ours, at<double>(0, 0, 0), fcls).min_distance);
  const ::fcl::Coned cone(1, 1);
  EXPECT_EQ(measure<double>(ours, at<double>(0, 0, 3), cone, at<double>(0, 0, 0), solver).min_distance,
            measure<double>(ours, at<double>(0, 0, 3), cone, at<double>(0, 0, 0), fcls).min_distance);
}

/// libccd would end the program of what FCL asks it about triangles.
TEST(MeshGeometry, MeetNothingInAPoseThatIsNotFinite) {
  const fcl::Mesh<::fcl::OBBRSSd> ours(known_meshes()[0].mesh);
  const ::fcl::Boxd box(1, 1, 1);
  const fcl::Solver<double> solver;
  const Transform<double> here = at<double>(0, 0, 0);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Transform<double> nowhere = at<double>(x, 0, 0);
    for (const auto& [mesh_there, there] : {std::pair(here, nowhere), std::pair(nowhere, here)}) {
      for (const Geometry<double>* const other :
           {static_cast<const Geometry<double>*>(&box), static_cast<const Geometry<double>*>(&ours)}) {
        EXPECT_FALSE(collide<double>(ours, mesh_there, *other, there, solver).isCollision());
        EXPECT_EQ(measure<double>(ours, mesh_there, *other, there, solver).o1, nullptr);
      }
    }
  }
}

struct Met {
  std::size_t pairs = 0;  ///< that collide
  int steps_apart = 0;    ///< in which none do
};

/// Meshes, hulls and spheres that drift in a box: a manager finds what all pairs give.
Met meet_in_managers(int count, double size) {
  Random random;
  std::vector<std::unique_ptr<::fcl::CollisionObjectd>> objects;
  ::fcl::DynamicAABBTreeCollisionManagerd manager;
  for (int i = 0; i < count; ++i) {
    std::shared_ptr<Geometry<double>> shape;
    if (i % 3 == 0)
      shape = convex<double>(random).shape;
    else if (i % 3 == 1)
      shape = std::make_shared<fcl::Mesh<::fcl::OBBRSSd>>(known_meshes()[std::size_t(i / 3 % 4)].mesh);
    else
      shape = std::make_shared<::fcl::Sphered>(0.4);
    objects.push_back(std::make_unique<::fcl::CollisionObjectd>(shape, random.transform<double>(size)));
    manager.registerObject(objects.back().get());
  }
  manager.setup();
  fcl::CollisionPairs<double> collisions;
  collisions.request = ::fcl::CollisionRequestd(10000, false);
  fcl::DistancePairs<double> distances;
  Met all;
  for (int step = 0; step < 20; ++step) {
    for (auto& object : objects) {
      object->setTranslation(object->getTranslation() + random.vector(0.1));
      object->computeAABB();
    }
    manager.update();
    collisions.start_step(), distances.start_step();
    manager.collide(&collisions, collisions.callback);
    manager.distance(&distances, distances.callback);
    ::fcl::DistanceResultd least;
    std::vector<std::pair<const Geometry<double>*, const Geometry<double>*>> wanted, found;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      for (std::size_t j = i + 1; j < objects.size(); ++j) {
        const fcl::Solver<double> cold;
        ::fcl::CollisionResultd one;
        ::fcl::collide(objects[i].get(), objects[j].get(), &cold, collisions.request, one);
        if (one.isCollision()) wanted.emplace_back(std::minmax(one.getContact(0).o1, one.getContact(0).o2));
        ::fcl::distance(objects[i].get(), objects[j].get(), &cold, distances.request, least);
      }
    }
    for (std::size_t i = 0; i < collisions.result.numContacts(); ++i)
      found.emplace_back(std::minmax(collisions.result.getContact(i).o1, collisions.result.getContact(i).o2));
    for (auto* const pairs : {&wanted, &found}) {
      std::sort(pairs->begin(), pairs->end());
      pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
    }
    EXPECT_EQ(found, wanted);
    all.pairs += wanted.size();
    EXPECT_EQ(distances.result.min_distance > 0, least.min_distance > 0);
    if (least.min_distance <= 0) continue;
    ++all.steps_apart;
    EXPECT_NEAR(distances.result.min_distance, least.min_distance, 1e-9);
  }
  return all;
}

TEST(MeshGeometry, MeetInManagers) {
  EXPECT_GT(meet_in_managers(30, 6).pairs, 40u);
  EXPECT_GT(meet_in_managers(12, 12).steps_apart, 10);
}

/// Of this process: other programs' load does not count.
double cpu_seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// A torus that passes through another one's hole, and a torus over hills; both warm, as in a manager.
TEST(BesideFcl, MeshTimes) {
  constexpr int kPoses = 100;
  const Soup ring = soups::torus(64, 32, 0.3),
             hills =
                 soups::scaled(soups::patch(40, [](double x, double y) { return 0.1 * std::sin(9 * x) * std::cos(7 * y); }), 3);
  const auto mesh_of_soup = [](const Soup& soup) { return std::make_shared<fcl::Mesh<::fcl::OBBRSSd>>(soup.mesh()); };
  const auto torus = mesh_of_soup(ring), ground = mesh_of_soup(hills);
  std::printf(
      "| pair | exact | FCL | 10 %% | FCL | collides | FCL | farthest from one another |\n|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, other, centre] : {std::tuple("tori of 4 096 triangles, linked", torus, Vec3(1, 0, 0)),
                                            {"a torus over hills of 3 200", ground, Vec3(0, 0, 1.7)}}) {
    std::vector<Transform<double>> poses;
    for (int i = 0; i < kPoses; ++i) {
      Transform<double> t = at<double>(centre[0], centre[1] + 0.1 * std::sin(0.1 * i), centre[2] + 0.2 * std::cos(0.05 * i));
      t.linear() = Eigen::AngleAxisd(1.4 + 0.01 * i, Vec3::UnitX()).matrix();
      poses.push_back(t);
    }
    const fcl::Solver<double> ours;
    const ::fcl::detail::GJKSolver_libccd<double> theirs;
    const auto us_of = [&](const auto& solver, const auto& ask) {
      std::vector<double> times;
      for (int round = 0; round < 3; ++round) {
        times.push_back(cpu_seconds([&] {
          for (const Transform<double>& t : poses) ask(t, solver);
        }));
      }
      return *std::min_element(times.begin(), times.end()) / kPoses * 1e6;
    };
    const Geometry<double>& still = *other;
    const auto distance = [&](double relative) {
      return [&, relative](const Transform<double>& t, const auto& solver) {
        measure_within<double>(*torus, t, still, at<double>(0, 0, 0), solver, relative, 0);
      };
    };
    const auto meets = [&](const Transform<double>& t, const auto& solver) {
      collide<double>(*torus, t, still, at<double>(0, 0, 0), solver, false, 1);
    };
    double farthest = 0;
    for (const Transform<double>& t : poses) {
      farthest = std::max(farthest, std::abs(measure<double>(*torus, t, still, at<double>(0, 0, 0), ours).min_distance -
                                             measure<double>(*torus, t, still, at<double>(0, 0, 0), theirs).min_distance));
      EXPECT_EQ(collide<double>(*torus, t, still, at<double>(0, 0, 0), ours, false, 1).isCollision(),
                collide<double>(*torus, t, still, at<double>(0, 0, 0), theirs, false, 1).isCollision());
    }
    EXPECT_LE(farthest, 1e-9);
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.0e |\n", name, us_of(ours, distance(0)),
                us_of(theirs, distance(0)), us_of(ours, distance(0.1)), us_of(theirs, distance(0.1)), us_of(ours, meets),
                us_of(theirs, meets), farthest);
  }
}

}  // namespace
}  // namespace swiftlet
