// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// HullShapes against every other shape of Bullet's, in both precisions: exact answers by brute force, both orders of a pair,
// who answers which, and what triangles must never do to a body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <BulletCollision/CollisionShapes/btBox2dShape.h>
#include <BulletCollision/CollisionShapes/btConvex2dShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btConvexTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMinkowskiSumShape.h>
#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <Eigen/Geometry>

#include <swiftlet/triangles.h>

#include "bodies.h"
#include "brute_force.h"
#include "bullet_world.h"
#include "make/surface.h"
#include "numeric/exact.h"
#include "soups.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The oracle ------------------------------------------------------------------------------------------------------------

Polytope moved(const Polytope& body, const btTransform& t) { return moved(body, pose_of(t)); }

TEST(Oracle, KnowsAnswersThatAreKnown) {
  const Polytope cube = polytope_of(bodies::cube());
  EXPECT_NEAR(signed_gap(cube, moved(cube, at(3, 0, 0))), 1, 1e-12);
  EXPECT_NEAR(signed_gap(cube, moved(cube, at(3, 3, 0))), std::sqrt(2.), 1e-12);
  EXPECT_NEAR(signed_gap(cube, moved(cube, at(1.5, 0.2, 0.3))), -0.5, 1e-12);
  EXPECT_NEAR(signed_gap(cube, {{{0, 0, 0.75}}, {}, {}}), -0.25, 1e-12);
  EXPECT_NEAR(signed_gap(cube, {{{2, 2, 2}}, {}, {}}), std::sqrt(3.), 1e-12);
  EXPECT_NEAR(signed_gap(cube, {{{-3, 3, 0}, {3, 3, 0}}, {}, {{0, 1}}}), 2, 1e-12);
}

// ---- Shapes that are bodies ------------------------------------------------------------------------------------------------

/// A shape of Bullet's, and what it is: all points within a radius of a polytope.
struct Known {
  std::shared_ptr<btCollisionShape> shape;
  Polytope core;
  double radius;
};

using Maker = std::function<Known(Random&)>;

Known sphere(Random& r) {
  auto shape = std::make_shared<btSphereShape>(btScalar(r.uniform(0.1, 1)));
  return {shape, {{{0, 0, 0}}, {}, {}}, shape->getRadius()};
}

Known capsule(Random& r) {
  const btScalar radius = btScalar(r.uniform(0.1, 0.6)), height = btScalar(r.uniform(0.2, 2));
  std::shared_ptr<btCapsuleShape> shape;
  switch (r.engine() % 3) {
    case 0: shape = std::make_shared<btCapsuleShapeX>(radius, height); break;
    case 1: shape = std::make_shared<btCapsuleShape>(radius, height); break;
    default: shape = std::make_shared<btCapsuleShapeZ>(radius, height);
  }
  if (r.engine() % 2) shape->setLocalScaling(btVector3(2, 2, 2) * btScalar(r.uniform(0.3, 1)));
  Vec3 top = Vec3::Zero();
  top[shape->getUpAxis()] = shape->getHalfHeight();
  return {shape, {{-top, top}, {}, {{0, 1}}}, shape->getRadius()};
}

Known box(Random& r) {
  auto shape = std::make_shared<btBoxShape>(
      btVector3(btScalar(r.uniform(0.2, 1)), btScalar(r.uniform(0.2, 1)), btScalar(r.uniform(0.2, 1))));
  if (r.engine() % 2) shape->setMargin(btScalar(0.1));
  if (r.engine() % 2) shape->setLocalScaling(btVector3(1, 2, btScalar(0.5)));
  const btVector3 half = shape->getHalfExtentsWithMargin();
  return {shape, polytope_of(bodies::box(half.x(), half.y(), half.z())), 0};
}

Known triangle(Random& r) {
  auto shape = std::make_shared<btTriangleShape>(r.vector(1), r.vector(1), r.vector(1));
  shape->setMargin(btScalar(r.uniform(0, 0.1)));
  return {shape,
          {{vec3(shape->m_vertices1[0]), vec3(shape->m_vertices1[1]), vec3(shape->m_vertices1[2])},
           {{0, 1, 2}},
           {{0, 1}, {1, 2}, {2, 0}}},
          shape->getMargin()};
}

Known hull_of_points(Random& r) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 16; ++i) shape->addPoint(r.vector(1));
  if (r.engine() % 2) shape->setLocalScaling(btVector3(1, 2, btScalar(0.5)));
  const Model model = bodies::must(bullet::model_of(*shape));
  return {shape, polytope_of(model.level(0).view), shape->getMargin()};
}

Known scaled_hull_shape(Random& r) {
  auto shape = std::make_shared<HullShape>(bodies::model(bodies::octahedron()));
  const Vec3 scale(r.uniform(0.5, 1.5), r.uniform(0.5, 1.5), r.uniform(0.5, 1.5));
  shape->setLocalScaling(btVector3(btScalar(scale[0]), btScalar(scale[1]), btScalar(scale[2])));
  Polytope core = polytope_of(bodies::octahedron());
  for (Vec3& p : core.points) p = p.cwiseProduct(vec3(shape->getLocalScaling()));
  return {shape, core, shape->getMargin()};
}

Known point_cloud(Random& r) {
  auto points = std::make_shared<std::vector<btVector3>>();
  for (int i = 0; i < 12; ++i) points->push_back(r.vector(1));
  const std::shared_ptr<btConvexPointCloudShape> shape(
      new btConvexPointCloudShape(points->data(), int(points->size()), btVector3(1, 1, 1)), [points](auto* p) { delete p; });
  return {shape, polytope_of(bodies::must(bullet::model_of(points->data(), int(points->size()))).level(0).view),
          shape->getMargin()};
}

Known tetrahedron(Random& r) {
  btVector3 corners[4];
  do {
    for (btVector3& c : corners) c = r.vector(1);
  } while ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < btScalar(0.1));
  auto shape = std::make_shared<btBU_Simplex1to4>(corners[0], corners[1], corners[2], corners[3]);
  bodies::Polyhedron solid{{}, {}, {}};
  for (const btVector3& c : corners) solid.points.push_back(vec3(c));
  solid.add({0, 2, 1}), solid.add({0, 1, 3}), solid.add({1, 2, 3}), solid.add({2, 0, 3});
  return {shape, polytope_of(solid), shape->getMargin()};
}

const std::map<std::string, Maker> kMakers{{"sphere", sphere},
                                           {"capsule", capsule},
                                           {"box", box},
                                           {"triangle", triangle},
                                           {"hull of points", hull_of_points},
                                           {"scaled HullShape", scaled_hull_shape},
                                           {"point cloud", point_cloud},
                                           {"tetrahedron", tetrahedron}};

/// Two orders of one pair must say the same.
void expect_mirrored(const Point& forth, const Point& back) {
  EXPECT_NEAR(forth.distance, back.distance, kRounding);
  expect_near(forth.on_a - forth.on_b, back.on_b - back.on_a, kRounding * 10);
}

class Solids : public testing::TestWithParam<std::string> {};

TEST_P(Solids, AreAnsweredAsBruteForceSays) {
  World w, bullets(false);
  Random random;
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::octahedron()),
                          bodies::model(bodies::tetrahedron()), stored("fat_a")};
  int apart = 0, deep = 0;
  double worst = 0, bullets_worst = 0;
  for (int i = 0; i < 400; ++i) {
    const Model& model = models[random.engine() % 4];
    HullShape hull(model);
    hull.setMargin(btScalar(random.uniform(0, 0.1)));
    const Known other = kMakers.at(GetParam())(random);
    ASSERT_TRUE(w.hull_pairs->answers(hull, *other.shape));
    const btTransform a_in_world = random.transform(1), b_in_world = random.transform(2);
    const double gap = signed_gap(moved(polytope_of(model.level(0).view), a_in_world), moved(other.core, b_in_world));
    const double expected = gap - hull.getMargin() - other.radius;
    const auto forth = closest_points(w, hull, a_in_world, *other.shape, b_in_world, 10);
    const auto back = closest_points(w, *other.shape, b_in_world, hull, a_in_world, 10);
    ASSERT_EQ(forth.size(), 1u) << i;
    ASSERT_EQ(back.size(), 1u) << i;
    expect_mirrored(forth[0], back[0]);
    (gap > 0 ? apart : deep) += 1;
    worst = std::max(worst, std::abs(forth[0].distance - expected));
    EXPECT_NEAR(forth[0].normal_on_b.length(), 1, kRounding);
    expect_near(forth[0].on_a - forth[0].on_b, forth[0].normal_on_b * forth[0].distance, kRounding * 4);
    // Moved along the normal until a quarter apart, they are a quarter apart.
    if (i % 4 == 0) {
      btTransform a_out = a_in_world;
      a_out.setOrigin(a_out.getOrigin() - forth[0].normal_on_b * (forth[0].distance - btScalar(0.25)));
      const double out = signed_gap(moved(polytope_of(model.level(0).view), a_out), moved(other.core, b_in_world));
      EXPECT_NEAR(out - hull.getMargin() - other.radius, 0.25, 1e-5) << i;
    }
    const auto theirs = closest_points(bullets, hull, a_in_world, *other.shape, b_in_world, 10);
    if (!theirs.empty()) bullets_worst = std::max(bullets_worst, std::abs(theirs[0].distance - expected));
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(deep, 20);
  EXPECT_LE(worst, kRounding * 2);
  std::printf("%s: %d apart, %d deep, farthest from the exact answer %.1e, Bullet's own %.1e\n", GetParam().c_str(), apart,
              deep, worst, bullets_worst);
}

/// In the table of contacts: the points lie on both surfaces, and the deepest is as deep as the closest points say.
TEST_P(Solids, TouchWhereTheyAreClosest) {
  World w;
  Random random;
  const Model model = bodies::model(bodies::cube());
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    HullShape hull(model);
    const Known other = kMakers.at(GetParam())(random);
    btCollisionObject a, b;
    a.setCollisionShape(&hull), b.setCollisionShape(other.shape.get());
    a.setWorldTransform(random.transform(0.5)), b.setWorldTransform(random.transform(1.5));
    w.world.addCollisionObject(&a), w.world.addCollisionObject(&b);
    w.world.performDiscreteCollisionDetection();
    const auto closest = closest_points(w, hull, a.getWorldTransform(), *other.shape, b.getWorldTransform(), 10);
    ASSERT_EQ(closest.size(), 1u);
    const btPersistentManifold* const manifold =
        w.dispatcher.getNumManifolds() ? w.dispatcher.getManifoldByIndexInternal(0) : nullptr;
    if (manifold && manifold->getNumContacts() > 0) {
      ++touching;
      const btScalar sign = manifold->getBody0() == &a ? 1 : -1;
      btScalar deepest = 100;
      for (int k = 0; k < manifold->getNumContacts(); ++k) {
        const btManifoldPoint& p = manifold->getContactPoint(k);
        deepest = std::min(deepest, p.getDistance());
        EXPECT_GE(p.getDistance(), closest[0].distance - kRounding * 4);
        if (closest[0].distance > 0) expect_near(p.m_normalWorldOnB, closest[0].normal_on_b * sign, btScalar(1e-2));
      }
      EXPECT_NEAR(deepest, closest[0].distance, kRounding * 4);
    } else {
      EXPECT_GT(closest[0].distance, 0);
    }
    w.world.removeCollisionObject(&a), w.world.removeCollisionObject(&b);
  }
  EXPECT_GT(touching, 60);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Solids,
                         testing::Values("sphere", "capsule", "box", "triangle", "hull of points", "scaled HullShape",
                                         "point cloud", "tetrahedron"),
                         [](const auto& about) {
                           std::string name = about.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

// ---- Models of points ------------------------------------------------------------------------------------------------------

/// Random points, and those of ellipsoids, prisms, grids and sheets that are thinner than rounding once they are turned: each
/// model is convex by proof, has no corner but the points, and holds them all, by exact signs.
TEST(ModelOf, HoldsItsPoints) {
  Random random;
  using Place = std::function<btVector3(int, int)>;
  const Place on_ellipsoid = [&](int, int) {
    return random.vector(1).normalized() * btVector3(1, btScalar(0.8), btScalar(0.5));
  };
  const Place anywhere = [&](int, int) { return random.vector(1); };
  const Place on_prism = [](int i, int n) {
    const double angle = 4 * 3.14159265358979 * (i / 2) / n;
    return btVector3(btScalar(std::cos(angle)), btScalar(std::sin(angle)), i % 2 ? btScalar(1) : btScalar(-1));
  };
  const Place in_grid = [](int i, int n) {
    const int side = int(std::lround(std::cbrt(n)));
    const btVector3 place(btScalar(i % side), btScalar(i / side % side), btScalar(i / side / side % side));
    return place * (2 / btScalar(side - 1)) - btVector3(1, 1, 1);
  };
  const Place in_sheet = [&](int i, int) { return random.vector(1) * btVector3(1, 1, i % 2 ? kRounding / 100 : btScalar(0)); };
  for (const Place& place : {on_ellipsoid, anywhere, on_prism, in_grid, in_sheet}) {
    for (const int count : {8, 64, 216, 512}) {
      for (int turn = 0; turn < 6; ++turn) {
        const btTransform turned = turn ? random.transform(1) : at(0, 0, 0);
        std::vector<btVector3> points;
        for (int i = 0; i < count; ++i) points.push_back(turned(place(i, count)));
        const Model model = bodies::must(bullet::model_of(points.data(), count));
        const ConvexView& view = model.level(0).view;
        for (const Vec3& v : bodies::points_of(view))
          EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const btVector3& p) { return vec3(p) == v; }));
        int above = 0;
        each_facet(view, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
          for (const btVector3& p : points)
            above += exact::orientation(&view.vertices[i].x, &view.vertices[j].x, &view.vertices[k].x, vec3(p).data()) > 0;
        });
        EXPECT_EQ(above, 0);
      }
    }
  }
  const btVector3 flat_ones[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(bullet::model_of(flat_ones, 4).error().code, ErrorCode::NotSolid);
  EXPECT_EQ(bullet::model_of(flat_ones, 0).error().code, ErrorCode::NotSolid);
}

// ---- Planes ----------------------------------------------------------------------------------------------------------------

TEST(Planes, AreAnsweredByTheLowestVertex) {
  World w;
  Random random;
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::octahedron()), stored("fat_a"), stored("plate")};
  for (int i = 0; i < 400; ++i) {
    HullShape hull(models[random.engine() % 4]);
    hull.setMargin(btScalar(random.uniform(0, 0.1)));
    btVector3 normal = random.vector(1);
    normal.normalize();
    btStaticPlaneShape plane(normal, btScalar(random.uniform(-2, 2)));
    const btTransform a_in_world = random.transform(1), b_in_world = random.transform(1);
    const Vec3 up = (pose_of(b_in_world).rotation * vec3(plane.getPlaneNormal())).normalized();
    double least = kInfinity;
    for (const Vec3& p : moved(polytope_of(hull.model().level(0).view), a_in_world).points)
      least = std::min(least, up.dot(p - pose_of(b_in_world).translation) - plane.getPlaneConstant());
    const auto forth = closest_points(w, hull, a_in_world, plane, b_in_world, 10);
    const auto back = closest_points(w, plane, b_in_world, hull, a_in_world, 10);
    ASSERT_EQ(forth.size(), 1u) << i;
    ASSERT_EQ(back.size(), 1u) << i;
    EXPECT_NEAR(forth[0].distance, least - hull.getMargin(), kRounding * 2);
    EXPECT_NEAR(vec3(forth[0].normal_on_b).dot(up), 1, kRounding * 2);
    expect_near(forth[0].on_a - forth[0].on_b, forth[0].normal_on_b * forth[0].distance, kRounding * 4);
    expect_mirrored(forth[0], back[0]);
  }
}

TEST(Planes, HoldASinglePoint) {
  World w;
  const Vec3 place(0, 0, 0);
  LevelArrays arrays;
  arrays.vertices = {&place, 1};
  HullShape point(Model::from_level(arrays).value());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  for (const double margin : {0.04, 0.}) {
    point.setMargin(btScalar(margin));
    EXPECT_TRUE(closest_points(w, point, at(3, 2, 10), plane, at(0, 0, 0)).empty());
    const auto touching = closest_points(w, point, at(3, 2, -0.5), plane, at(0, 0, 0));
    ASSERT_EQ(touching.size(), 1u);
    EXPECT_NEAR(touching[0].distance, -0.5 - margin, kRounding);
    expect_near(touching[0].normal_on_b, btVector3(0, 0, 1), kRounding);
    expect_near(touching[0].on_b, btVector3(3, 2, 0), kRounding * 4);
  }
}

/// Deep or apart, the four corners of the lowest face.
TEST(Planes, HoldAFaceByItsCorners) {
  World w;
  HullShape hull(bodies::model(bodies::box(1, 2, 3)));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  blind_bullet(hull);
  for (const double height : {3.05, 3.0, 2.5, -1.0}) {
    for (const bool hull_first : {true, false}) {
      btCollisionObject a, b;
      a.setCollisionShape(&hull), b.setCollisionShape(&plane);
      a.setWorldTransform(at(10, 20, height));
      for (btCollisionObject* object : hull_first ? std::array{&a, &b} : std::array{&b, &a}) w.world.addCollisionObject(object);
      w.world.performDiscreteCollisionDetection();
      ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
      const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
      ASSERT_EQ(manifold.getNumContacts(), 4);
      for (int i = 0; i < 4; ++i) {
        const btManifoldPoint& p = manifold.getContactPoint(i);
        const bool is_first = manifold.getBody0() == &a;
        const btVector3 on_hull = is_first ? p.getPositionWorldOnA() : p.getPositionWorldOnB(),
                        on_plane = is_first ? p.getPositionWorldOnB() : p.getPositionWorldOnA();
        EXPECT_NEAR(p.getDistance(), height - 3 - CONVEX_DISTANCE_MARGIN, kRounding * 4);
        expect_near(p.m_normalWorldOnB, btVector3(0, 0, is_first ? btScalar(1) : btScalar(-1)), kRounding);
        EXPECT_NEAR(on_plane.z(), 0, kRounding * 4);
        EXPECT_NEAR(std::abs(on_hull.x() - 10), 1, kRounding * 4);
        EXPECT_NEAR(std::abs(on_hull.y() - 20), 2, kRounding * 4);
      }
      w.world.removeCollisionObject(&a), w.world.removeCollisionObject(&b);
    }
  }
}

// ---- Triangles -------------------------------------------------------------------------------------------------------------

/// A mesh with its shape, and its triangles for the oracle.
struct Surface {
  btTriangleMesh mesh;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  std::vector<Polytope> triangles;

  void add(const btVector3& p, const btVector3& q, const btVector3& r) {
    mesh.addTriangle(p, q, r);
    triangles.push_back({{vec3(p), vec3(q), vec3(r)}, {{0, 1, 2}}, {{0, 1}, {1, 2}, {2, 0}}});
  }
  btBvhTriangleMeshShape& finish() {
    shape = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
    return *shape;
  }
};

/// Squares over [-size, size]^2, each cut in two, up in z; rows and columns of uneven width.
std::unique_ptr<Surface> terrain(int cells, double size, const std::function<double(double, double)>& height,
                                 bool flipped = false) {
  auto surface = std::make_unique<Surface>();
  Random random;
  std::vector<double> line{-size};
  for (int i = 1; i < cells; ++i) line.push_back(size * (2. * i / cells - 1 + random.uniform(-0.3, 0.3) / cells));
  line.push_back(size);
  const auto corner = [&](int i, int j) {
    return btVector3(btScalar(line[i]), btScalar(line[j]), btScalar(height(line[i], line[j])));
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const btVector3 p = corner(i, j), q = corner(i + 1, j), r = corner(i + 1, j + 1), s = corner(i, j + 1);
      if ((i + j) % 2 == int(flipped))
        surface->add(p, q, r), surface->add(p, r, s);
      else
        surface->add(q, r, s), surface->add(q, s, p);
    }
  }
  surface->finish();
  return surface;
}

double flat(double, double) { return 0; }

double least_gap(const Surface& surface, const Polytope& hull, const btTransform& surface_in_world) {
  double least = kInfinity;
  for (const Polytope& t : surface.triangles) least = std::min(least, signed_gap(hull, moved(t, surface_in_world)));
  return least;
}

TEST(Triangles, AreAsFarAsBruteForceSays) {
  World w;
  Random random;
  const auto hills = terrain(6, 3, [](double x, double y) { return 0.4 * std::sin(2 * x) * std::cos(3 * y); });
  const std::array models{bodies::model(bodies::cube()), bodies::model(bodies::octahedron()),
                          bodies::model(bodies::tetrahedron(0.6))};
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    HullShape hull(models[random.engine() % 3]);
    hills->shape->setMargin(btScalar(i % 2 ? 0.03 : 0));
    const btTransform surface_in_world = random.transform(1);
    btTransform hull_in_world = random.transform(2);
    hull_in_world.setOrigin(surface_in_world(hull_in_world.getOrigin() + btVector3(0, 0, 2)));
    const double gap = least_gap(*hills, moved(polytope_of(hull.model().level(0).view), hull_in_world), surface_in_world);
    if (gap <= 0) continue;
    ++apart;
    for (const bool hull_first : {true, false}) {
      btCollisionShape &a = hull_first ? static_cast<btCollisionShape&>(hull) : *hills->shape,
                       &b = hull_first ? *hills->shape : static_cast<btCollisionShape&>(hull);
      const btTransform &a_in_world = hull_first ? hull_in_world : surface_in_world,
                        &b_in_world = hull_first ? surface_in_world : hull_in_world;
      const auto points = closest_points(w, a, a_in_world, b, b_in_world, 10);
      ASSERT_FALSE(points.empty());
      const Point& nearest = *std::min_element(points.begin(), points.end(),
                                               [](const Point& p, const Point& q) { return p.distance < q.distance; });
      EXPECT_NEAR(nearest.distance, gap - hull.getMargin() - hills->shape->getMargin(), kRounding * 4) << i;
      expect_near(nearest.on_a - nearest.on_b, nearest.normal_on_b * nearest.distance, kRounding * 4);
    }
  }
  EXPECT_GT(apart, 100);
}

/// On a flat floor of many triangles, apart or deep, no normal but the floor's, and the depth of the lowest vertex.
TEST(Triangles, OfOnePlaneAreOnePlane) {
  const auto floor = terrain(12, 3, flat);
  Random random;
  const std::array models{bodies::model(bodies::box(0.5, 0.5, 0.5)), bodies::model(bodies::tetrahedron(0.6)), stored("fat_a")};
  for (int i = 0; i < 400; ++i) {
    World w;
    HullShape hull(models[random.engine() % 3]);
    const btTransform surface_in_world = random.transform(1);
    btTransform pose = random.transform(1);
    if (i % 2) pose.setBasis(btMatrix3x3(btQuaternion(btVector3(0, 0, 1), btScalar(i))));  // lies flat
    double least = kInfinity;
    for (const Vec3& p : moved(polytope_of(hull.model().level(0).view), pose).points) least = std::min(least, p[2]);
    const double gap = random.uniform(-0.3, hull.getMargin());  // core and core
    pose.setOrigin(pose.getOrigin() + btVector3(0, 0, btScalar(gap - least)));
    btCollisionObject a, b;
    a.setCollisionShape(&hull), b.setCollisionShape(floor->shape.get());
    a.setWorldTransform(surface_in_world * pose), b.setWorldTransform(surface_in_world);
    w.world.addCollisionObject(&a), w.world.addCollisionObject(&b);
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
    ASSERT_GT(manifold.getNumContacts(), 0);
    const btVector3 up = surface_in_world.getBasis() * btVector3(0, 0, manifold.getBody0() == &a ? btScalar(1) : btScalar(-1));
    btScalar deepest = 100;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& p = manifold.getContactPoint(k);
      deepest = std::min(deepest, p.getDistance());
      expect_near(p.m_normalWorldOnB, up, kRounding * 4);
    }
    // A tip that leans under a triangle which the body does not cut is below its neighbour.
    const bool leans = gap < 0 && i % 2 == 0;
    EXPECT_GE(deepest, gap - hull.getMargin() - kRounding * 8) << i;
    EXPECT_LE(deepest, (leans ? 0.4 : 1) * (gap - hull.getMargin()) + kRounding * 8) << i;
    w.world.removeCollisionObject(&a), w.world.removeCollisionObject(&b);
  }
}

// ---- Motion ----------------------------------------------------------------------------------------------------------------

/// A heightfield over [-size, size]^2, up in z.
struct Field {
  std::vector<float> heights;
  std::unique_ptr<btHeightfieldTerrainShape> shape;
  Field(int cells, double size, const std::function<double(double, double)>& height)
      : heights(std::size_t(cells + 1) * (cells + 1)) {
    const double width = 2 * size / cells;
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i)
        heights[std::size_t(j * (cells + 1) + i)] = float(height(i * width - size, j * width - size));
    }
    shape = std::make_unique<btHeightfieldTerrainShape>(cells + 1, cells + 1, heights.data(), btScalar(-10), btScalar(10), 2,
                                                        false);
    shape->setLocalScaling(btVector3(btScalar(width), btScalar(width), 1));
  }
};

/// A box of half a metre that is half through the floor, or more, at the end of the step in which they meet: it comes back to
/// where it came from, on either side. Faster ones pass a floor between two steps, which is for continuous detection.
void expect_no_fall_through(btCollisionShape& floor, const char* name) {
  HullShape hull(bodies::model(bodies::box(0.25, 0.25, 0.25)));
  hull.setMargin(btScalar(0.01));
  int deep = 0, fell = 0;
  for (const double side : {1., -1.}) {
    for (const double speed : {5., 15., 25., 29.}) {
      for (int phase = 0; phase < 8; ++phase) {
        Dynamics d;
        d.world.setGravity(btVector3(0, 0, 0));
        d.add(floor, at(0, 0, 0));
        const double way = speed * kStep, start = 0.27 + way * (0.02 + phase / 8.);
        btTransform in_world = at(0.13, 0.07, side * start);
        in_world.setRotation(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.3 * (phase % 3))));
        const btRigidBody& body = d.add(hull, in_world, 1, btVector3(0, 0, btScalar(-side * speed)));
        double lowest = 1;
        for (int step = 0; step < 120; ++step)
          d.step(), lowest = std::min(lowest, side * body.getWorldTransform().getOrigin().z());
        deep += lowest < 0;
        const bool is_through = side * body.getWorldTransform().getOrigin().z() < 0.2;
        fell += is_through;
        EXPECT_FALSE(is_through) << name << " " << speed << " m/s, phase " << phase << ", side " << side << ": " << lowest;
      }
    }
  }
  EXPECT_GT(deep, 6);
  std::printf("%s: of 64 fast boxes %d had their centre beyond the floor, %d stayed there\n", name, deep, fell);
}

TEST(Triangles, NeverPushABodyThrough) {
  const auto floor = terrain(9, 3, flat);
  expect_no_fall_through(*floor->shape, "mesh");
  Surface two;
  two.add(btVector3(-3, -3, 0), btVector3(3, -3, 0), btVector3(3, 3, 0)),
      two.add(btVector3(-3, -3, 0), btVector3(3, 3, 0), btVector3(-3, 3, 0));
  expect_no_fall_through(two.finish(), "two large triangles");
  btScaledBvhTriangleMeshShape scaled(floor->shape.get(), btVector3(1, 2, 3));
  expect_no_fall_through(scaled, "scaled mesh");
  Field field(9, 3, flat);
  expect_no_fall_through(*field.shape, "heightfield");
  bullet::MeshShape mesh(bullet::mesh_of(floor->mesh).value());
  mesh.setMargin(0);
  expect_no_fall_through(mesh, "MeshShape");
}

/// What a slide over a flat floor did to a body, along the floor's normal.
struct Slide {
  double rise = 0, speed = 0;  ///< from its height of rest, and of its velocity: the largest
  double lost = 0;             ///< of the speed it had
};

/// Without friction, weighed down along `up`, the floor's normal.
Slide slide(btCollisionShape& floor, HullShape& hull, const btVector3& up, double speed, bool with_swiftlet = true) {
  Dynamics d(with_swiftlet);
  d.world.setGravity(up * btScalar(-9.81));
  d.add(floor, at(0, 0, 0)).setFriction(0);
  const btTransform upright(shortestArcQuat(btVector3(0, 0, 1), up));
  btRigidBody& body = d.add(hull, upright * at(-14, -5, 0.3), 1);
  body.setFriction(0);
  for (int step = 0; step < 120; ++step) d.step();  // comes to rest
  const btVector3 velocity = upright * btVector3(btScalar(speed), btScalar(0.37 * speed), 0);
  body.setLinearVelocity(velocity);
  const double rest = up.dot(body.getWorldTransform().getOrigin());
  Slide most;
  for (int step = 0; step < 120; ++step) {
    d.step();
    most.rise = std::max(most.rise, std::abs(up.dot(body.getWorldTransform().getOrigin()) - rest));
    most.speed = std::max(most.speed, std::abs(double(up.dot(body.getLinearVelocity()))));
  }
  most.lost = 1 - body.getLinearVelocity().length() / velocity.length();
  return most;
}

void print(const char* name, const Slide& s) {
  std::printf("  %s: %.1e m, %.1e m/s, lost %.1f %%\n", name, s.rise, s.speed, 100 * s.lost);
}

TEST(Triangles, SpreadOverWhatTouches) {
  const auto at_place = [](double x, double y, double separation) {
    return TrianglePoint{-Vec3::UnitZ(), {x, y, separation}, {x, y, 0}, separation, 0, false};
  };
  const auto chosen = [](const std::vector<TrianglePoint>& points) {
    const Spread spread = swiftlet::spread(points, 1e-4);
    return std::set<std::uint32_t>(spread.index.begin(), spread.index.begin() + spread.count);
  };
  // The deepest of a line is in its middle.
  EXPECT_EQ(chosen({at_place(0, 0, -2), at_place(-1, 0, -1), at_place(0.5, 1e-9, -1), at_place(0.9, 0, -1)}),
            (std::set<std::uint32_t>{0, 1, 3}));
  // Points beside that do not touch span more.
  const std::vector<TrianglePoint> both{at_place(1, 0, -1e-3), at_place(-1, 0, -1e-3), at_place(0, 1, 0),
                                        at_place(0, -1, 5e-5), at_place(3, 3, 0.01),   at_place(-3, -3, 0.01),
                                        at_place(-3, 3, 2e-4)};
  EXPECT_EQ(chosen(both), (std::set<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(chosen({both[0], both[4], both[5], both[6]}), (std::set<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Triangles, LetABoxSlideAsOnOnePlane) {
  constexpr double kUlp = 0x1p-20;  // of places 8 to 16 m away in single precision
  HullShape hull(bodies::model(bodies::box(0.5, 0.4, 0.25)));
  for (const double tilt : {0., 0.3}) {
    const auto height = [&](double x, double y) { return tilt * x + tilt / 2 * y; };
    const auto floor = terrain(60, 30, height), fine = terrain(150, 30, height);
    const Field field(60, 20, height);
    const btVector3 up = btVector3(btScalar(-tilt), btScalar(-tilt / 2), 1).normalized();
    btStaticPlaneShape plane(up, 0);
    for (const double speed : {1., 4., 8.}) {
      const Slide on_plane = slide(plane, hull, up, speed), on_mesh = slide(*floor->shape, hull, up, speed),
                  on_fine = slide(*fine->shape, hull, up, speed), on_field = slide(*field.shape, hull, up, speed),
                  bullets = slide(*floor->shape, hull, up, speed, false);
      std::printf("tilted by %g, %g m/s\n", tilt, speed);
      print("plane", on_plane), print("mesh", on_mesh), print("fine mesh", on_fine), print("heightfield", on_field);
      print("Bullet's mesh", bullets);
      for (const Slide& other : {on_mesh, on_fine, on_field}) {
        EXPECT_LE(other.rise, 1.1 * on_plane.rise + kUlp);
        EXPECT_LE(other.speed, 1.1 * on_plane.speed + kUlp / kStep);
      }
    }
  }
}

/// Children of compounds as well, on either side: two boxes on a floor that is itself a child.
TEST(Triangles, LetCompoundsSlideToo) {
  const auto floor = terrain(60, 30, flat);
  btCompoundShape ground;
  ground.addChildShape(at(0.3, 0.2, -0.1), floor->shape.get());
  HullShape half(bodies::model(bodies::box(0.5, 0.4, 0.25)));
  btCompoundShape both;
  both.addChildShape(at(-0.7, 0, 0), &half), both.addChildShape(at(0.7, 0, 0), &half);
  Dynamics d;
  d.add(ground, at(0, 0, 0)).setFriction(0);
  btRigidBody& body = d.add(both, at(-18, -6, 0.2), 1);
  body.setFriction(0);
  for (int step = 0; step < 120; ++step) d.step();
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), -0.1 + 0.25 + half.getMargin(), 1e-2);
  body.setLinearVelocity(btVector3(6, 2, 0));
  const btScalar rest = body.getWorldTransform().getOrigin().z();
  for (int step = 0; step < 120; ++step) {
    d.step();
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), rest, 1e-5);
    EXPECT_NEAR(body.getLinearVelocity().x(), 6, 1e-4);
  }
  EXPECT_EQ(d.dispatcher.getNumManifolds(), 2);
}

/// A round body rolls on as on a plane: no triangle's edge stops or lifts it.
TEST(Triangles, LetARoundBodyRollAsOnOnePlane) {
  const auto floor = terrain(60, 30, flat);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  HullShape hull(stored("fat_a"));
  const auto roll = [&](btCollisionShape& on, bool with_swiftlet) {
    Dynamics d(with_swiftlet);
    d.add(on, at(0, 0, 0)).setFriction(1);
    btRigidBody& body = d.add(hull, at(-15, -5, hull.model().radius() + 0.1), 1, btVector3(4, 1, 0));
    body.setFriction(1);
    for (int step = 0; step < 90; ++step) d.step();
    return body.getWorldTransform().getOrigin();
  };
  const btVector3 on_plane = roll(plane, true), on_mesh = roll(*floor->shape, true), bullets = roll(*floor->shape, false);
  std::printf("rolled to %g %g %g on the plane, %g %g %g on the mesh, Bullet's mesh %g %g %g\n", on_plane.x(), on_plane.y(),
              on_plane.z(), on_mesh.x(), on_mesh.y(), on_mesh.z(), bullets.x(), bullets.y(), bullets.z());
  EXPECT_LE((on_plane - on_mesh).length(), 0.2);
}

/// In a corner each face has its own manifold.
TEST(Triangles, OfTwoFacesHoldABodyByBoth) {
  Surface valley;
  for (int j = -4; j < 4; ++j) {
    for (const int s : {-1, 1}) {
      const btVector3 p(0, btScalar(j), 0), q(btScalar(4 * s), btScalar(j), 4), r(btScalar(4 * s), btScalar(j + 1), 4),
          t(0, btScalar(j + 1), 0);
      valley.add(p, q, r), valley.add(p, r, t);
    }
  }
  HullShape hull(bodies::model(bodies::box(0.5, 0.8, 0.5)));
  Dynamics d;
  d.add(valley.finish(), at(0, 0, 0));
  btTransform in_world = at(0, 0.3, 0.9);
  in_world.setRotation(btQuaternion(btVector3(0, 1, 0), btScalar(0.25 * 3.14159265358979)));
  const btRigidBody& body = d.add(hull, in_world, 1);
  for (int step = 0; step < 180; ++step) d.step();
  EXPECT_LE(body.getLinearVelocity().length(), 1e-3);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), std::sqrt(2.) * (0.5 + hull.getMargin()), 0.01);
  ASSERT_EQ(d.dispatcher.getNumManifolds(), 2);
  for (int m = 0; m < 2; ++m) {
    const btPersistentManifold& manifold = *d.dispatcher.getManifoldByIndexInternal(m);
    EXPECT_EQ(manifold.getNumContacts(), 4);
    for (int i = 0; i < manifold.getNumContacts(); ++i)
      EXPECT_NEAR(std::abs(manifold.getContactPoint(i).m_normalWorldOnB.x()), std::sqrt(0.5), 1e-4);
  }
}

/// The walls of a shallow groove share a manifold, as normals less than 26 degrees apart do. Points that stay from step to step
/// were all given the normal of the deepest one, which is one wall's: the other wall pushed sideways.
TEST(Triangles, OfAShallowGrooveKeepTheirNormals) {
  constexpr double kSlope = 0.15;
  Surface groove;
  for (int j = -4; j < 4; ++j) {
    for (const int s : {-1, 1}) {
      const btVector3 p(0, btScalar(j), 0), q(btScalar(4 * s), btScalar(j), btScalar(4 * kSlope)),
          r(btScalar(4 * s), btScalar(j + 1), btScalar(4 * kSlope)), t(0, btScalar(j + 1), 0);
      groove.add(p, q, r), groove.add(p, r, t);
    }
  }
  HullShape hull(bodies::model(bodies::box(0.5, 0.8, 0.5)));
  Dynamics d;
  d.add(groove.finish(), at(0, 0, 0));
  const btRigidBody& body = d.add(hull, at(0, 0.3, 0.5 * kSlope + 0.56), 1);
  for (int step = 0; step < 180; ++step) {
    d.step();
    if (step < 120) continue;
    ASSERT_EQ(d.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& manifold = *d.dispatcher.getManifoldByIndexInternal(0);
    EXPECT_EQ(manifold.getNumContacts(), 4);
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& p = manifold.getContactPoint(i);  // a wall pushes inwards
      EXPECT_LT(p.m_normalWorldOnB.x() * p.m_normalWorldOnB.z() * p.m_positionWorldOnB.x(), 0) << step << ": " << i;
    }
    EXPECT_LE(body.getLinearVelocity().length(), 1e-3) << step;
  }
}

/// A hull that is scaled while it lies on a mesh is Bullet's from then on, and swiftlet's again when it is not.
TEST(Triangles, PassAScaledHullOnToBullet) {
  World w;
  const auto floor = terrain(6, 3, flat);
  HullShape hull(bodies::model(bodies::box(0.5, 0.5, 0.5)));
  btCollisionObject a, b;
  a.setCollisionShape(&hull), b.setCollisionShape(floor->shape.get());
  a.setWorldTransform(at(0.1, 0.2, 0.53));
  w.world.addCollisionObject(&a), w.world.addCollisionObject(&b);
  const auto deepest = [&] {
    w.world.performDiscreteCollisionDetection();
    return swiftlet::deepest(w.dispatcher);
  };
  EXPECT_NEAR(deepest(), -0.01, 1e-5);
  hull.setLocalScaling(btVector3(1, 1, btScalar(1.04)));
  EXPECT_NEAR(deepest(), -0.03, 1e-3);
  EXPECT_NEAR(deepest(), -0.03, 1e-3);
  hull.setLocalScaling(btVector3(1, 1, 1));
  EXPECT_NEAR(deepest(), -0.01, 1e-5);
  w.world.removeCollisionObject(&a), w.world.removeCollisionObject(&b);
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0);
}

/// A margin of the mesh's that is no radius makes the pair Bullet's.
TEST(Triangles, WithAMarginBelow0AreBullets) {
  World w, bullets(false);
  const auto floor = terrain(6, 3, flat);
  HullShape hull(bodies::model(bodies::box(0.5, 0.5, 0.5)));
  const auto deepest = [&](World& in) {
    btScalar least = 1;
    for (const Point& p : closest_points(in, hull, at(0.1, 0.2, 0.4), *floor->shape, at(0, 0, 0), 0, false))
      least = std::min(least, p.distance);
    return least;
  };
  for (const double margin : {0., 0.04}) {
    floor->shape->setMargin(btScalar(margin));
    EXPECT_NEAR(deepest(w), -0.1 - hull.getMargin() - margin, 1e-5);
  }
  floor->shape->setMargin(btScalar(-0.01));
  EXPECT_LT(deepest(w), 0);
  EXPECT_EQ(deepest(w), deepest(bullets));
}

/// Engines have corners as near to 0 as rounding leaves them.
TEST(Triangles, HaveCornersHoweverNearTo0) {
  const Model cube = bodies::model(bodies::box(0.5, 0.5, 0.5));
  for (const double tiny : {0., 1e-60, 1e-80, -1e-300}) {
    TrianglePair pair;
    pair.add(0, {-4, -4, tiny}, {4, -4, 0}, {0, 4, tiny});
    EXPECT_EQ(pair.contacts({Body(cube), Pose{Mat3::Identity(), {0, 0, 0.4}}}, Pose{}, 0, Vec3::Zero(), 0).size(), 4u) << tiny;
  }
}

/// Around the border of a sheet, a body may come to its other side.
TEST(Triangles, MayBePassedAroundTheBorder) {
  World w;
  const auto sheet = terrain(4, 1, flat);
  HullShape hull(bodies::model(bodies::box(0.2, 0.2, 0.2)));
  btCollisionObject a, b;
  a.setCollisionShape(&hull), b.setCollisionShape(sheet->shape.get());
  w.world.addCollisionObject(&a), w.world.addCollisionObject(&b);
  const auto up = [&](double x, double z) {
    a.setWorldTransform(at(x, 0.1, z));
    w.world.performDiscreteCollisionDetection();
    const btPersistentManifold* const m = w.dispatcher.getNumManifolds() ? w.dispatcher.getManifoldByIndexInternal(0) : nullptr;
    return m && m->getNumContacts() ? m->getContactPoint(0).m_normalWorldOnB.z() * (m->getBody0() == &a ? 1 : -1) : btScalar(0);
  };
  EXPECT_NEAR(up(0, 0.21), 1, 1e-5);
  EXPECT_NEAR(up(0, -0.1), 1, 1e-5);  // pushed back up
  EXPECT_NEAR(up(0, 0.21), 1, 1e-5);
  for (int i = 0; i <= 20; ++i) up(i * 0.1, 0.21);
  for (int i = 0; i <= 20; ++i) up(2 - i * 0.1, -0.21);
  EXPECT_NEAR(up(0, -0.21), -1, 1e-5);
  EXPECT_NEAR(up(0, 0.1), -1, 1e-5);  // pushed back down
  w.world.removeCollisionObject(&a), w.world.removeCollisionObject(&b);
}

// ---- Shapes that are scaled ------------------------------------------------------------------------------------------------

/// A shape that is scaled while it lies on another is what it now is: the pair's contacts are as deep as those of one that
/// meets anew, and none lies where the shape was.
TEST(ScaledWhileThePairLives, HasTheContactsOfANewPair) {
  const std::shared_ptr<Surface> ground = terrain(6, 3, flat);
  const auto cube = std::make_shared<const MeshModel>(soups::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).mesh());
  using Shape = std::shared_ptr<btCollisionShape>;
  const std::vector<std::pair<std::string, std::function<Shape()>>> uppers{
      {"HullShape", [] { return std::make_shared<HullShape>(bodies::model(bodies::box(0.5, 0.5, 0.5))); }},
      {"MeshShape", [&] { return std::make_shared<bullet::MeshShape>(*cube); }},
      {"btConvexHullShape",
       [] {
         auto hull = std::make_shared<btConvexHullShape>();
         for (int i = 0; i < 8; ++i) hull->addPoint(btVector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1) * btScalar(0.5));
         return hull;
       }},
      {"btBoxShape", [] { return std::make_shared<btBoxShape>(btVector3(1, 1, 1) * btScalar(0.5)); }},
      {"btCapsuleShape", [] { return std::make_shared<btCapsuleShapeX>(btScalar(0.5), btScalar(0.8)); }}};
  struct Ground {
    std::string name;
    Shape shape;
    double z = 0;
  };
  const std::vector<Ground> grounds{
      {"btStaticPlaneShape", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0))},
      {"HullShape", std::make_shared<HullShape>(bodies::model(bodies::box(3, 3, 0.5))), -0.5},
      {"large MeshShape", std::make_shared<bullet::MeshShape>(bullet::mesh_of(ground->mesh).value())},
      {"small MeshShape", std::make_shared<bullet::MeshShape>(soups::box({-0.2, -0.2, -0.5}, {0.2, 0.2, 0}).mesh())},
      {"btBvhTriangleMeshShape", Shape(ground, ground->shape.get())}};
  int answered = 0;
  for (const auto& [upper_name, make] : uppers) {
    for (const Ground& below : grounds) {
      const std::string name = upper_name + " on " + below.name;
      const auto lie = [&below](World& w, btCollisionObject& a, btCollisionObject& b, btCollisionShape& upper) {
        a.setCollisionShape(&upper), b.setCollisionShape(below.shape.get());
        a.setWorldTransform(at(0.1, 0.1, 0.49)), b.setWorldTransform(at(0, 0, below.z));
        w.world.addCollisionObject(&a), w.world.addCollisionObject(&b);
      };
      World living;
      btCollisionObject a, b;
      const Shape upper = make();
      if (!living.hull_pairs->answers(*upper, *below.shape)) continue;
      ++answered;
      lie(living, a, b, *upper);
      for (const Vec3& scale : {Vec3(1, 1, 1), Vec3(1.04, 1.04, 1.04), Vec3(0.5, 0.5, 1), Vec3(1, 1, 1.02), Vec3(1, 1, 1)}) {
        upper->setLocalScaling(btVector3(btScalar(scale[0]), btScalar(scale[1]), btScalar(scale[2])));
        World fresh;
        btCollisionObject fresh_a, fresh_b;
        const Shape same = make();
        same->setLocalScaling(upper->getLocalScaling());
        lie(fresh, fresh_a, fresh_b, *same);
        for (int step = 0; step < 3; ++step) {
          living.world.performDiscreteCollisionDetection(), fresh.world.performDiscreteCollisionDetection();
          EXPECT_NEAR(deepest(living.dispatcher), deepest(fresh.dispatcher), 1e-3) << name << ": " << scale.transpose();
        }
        btVector3 least, most;
        upper->getAabb(a.getWorldTransform(), least, most);
        for (int m = 0; m < living.dispatcher.getNumManifolds(); ++m) {
          const btPersistentManifold& manifold = *living.dispatcher.getManifoldByIndexInternal(m);
          for (int i = 0; i < manifold.getNumContacts(); ++i) {
            const btManifoldPoint& p = manifold.getContactPoint(i);
            const btVector3& on = manifold.getBody0() == &a ? p.getPositionWorldOnA() : p.getPositionWorldOnB();
            for (int axis = 0; axis < 3; ++axis) {
              EXPECT_GE(on[axis], least[axis] - 1e-3) << name << ": " << scale.transpose();
              EXPECT_LE(on[axis], most[axis] + 1e-3) << name << ": " << scale.transpose();
            }
          }
        }
        fresh.world.removeCollisionObject(&fresh_a), fresh.world.removeCollisionObject(&fresh_b);
      }
      living.world.removeCollisionObject(&a), living.world.removeCollisionObject(&b);
      EXPECT_EQ(living.dispatcher.getNumManifolds(), 0) << name;
    }
  }
  EXPECT_EQ(answered, 18);
}

/// A body that gets another shape of the same kind comes to rest as high as that is.
TEST(ExchangedWhileThePairLives, AShapeIsTheOneThatTheBodyHas) {
  const auto hull = [](double half) { return std::make_shared<HullShape>(bodies::model(bodies::box(half, half, half))); };
  const auto mesh = [](double half) {
    return std::make_shared<bullet::MeshShape>(soups::box({-half, -half, -half}, {half, half, half}).mesh());
  };
  const auto points = [&](double half) {
    auto shape = std::make_shared<btConvexHullShape>();
    for (int i = 0; i < 8; ++i) shape->addPoint(hull(half)->getUnscaledPoints()[i]);
    return shape;
  };
  using Shape = std::shared_ptr<btCollisionShape>;
  using Make = std::function<Shape(double)>;
  constexpr double kHalves[] = {0.5, 0.3, 0.9};
  HullShape slab(bodies::model(bodies::box(3, 3, 0.5)));
  bullet::MeshShape block(soups::box({-3, -3, -0.5}, {3, 3, 0.5}).mesh());
  for (btCollisionShape* const floor : {static_cast<btCollisionShape*>(&slab), static_cast<btCollisionShape*>(&block)}) {
    for (const Make& make : {Make(hull), Make(mesh), Make(points)}) {
      const Shape shapes[] = {make(kHalves[0]), make(kHalves[1]), make(kHalves[2])};  // they outlive the world
      Dynamics d;
      d.add(*floor, at(0, 0, -0.5));
      btRigidBody& body = d.add(*shapes[0], at(0, 0, 0.5 + 0.08), 1);
      for (int i = 0; i < 3; ++i) {
        body.setCollisionShape(shapes[i].get());
        for (int step = 0; step < 200; ++step) d.step();
        EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), kHalves[i] + 0.08, 0.02)
            << shapes[i]->getName() << " on " << floor->getName() << ", the " << i << "th";
      }
    }
  }
}

/// Memory for one shape at a time.
class Place {
 public:
  Place() = default;
  ~Place() { clear(); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  template <class Shape, class... Arguments>
  Shape& make(Arguments&&... arguments) {
    static_assert(sizeof(Shape) <= sizeof memory_);
    clear();
    Shape* const made = ::new (static_cast<void*>(memory_)) Shape(std::forward<Arguments>(arguments)...);
    shape_ = made;
    return *made;
  }

 private:
  void clear() {
    if (shape_) std::exchange(shape_, nullptr)->~btCollisionShape();
  }
  alignas(16) std::byte memory_[1024];
  btCollisionShape* shape_ = nullptr;
};

/// A shape that is made where another was destroyed has its address, and may have as many points.
TEST(ExchangedWhileThePairLives, AShapeInThePlaceOfAnotherIsAnother) {
  using Make = std::function<btCollisionShape&(Place&, double)>;
  const auto cube = [](double half) { return bodies::model(bodies::box(half, half, half)); };
  const Make hull = [&](Place& place, double half) -> btCollisionShape& { return place.make<HullShape>(cube(half)); };
  const Make mesh = [](Place& place, double half) -> btCollisionShape& {
    return place.make<bullet::MeshShape>(soups::box({-half, -half, -half}, {half, half, half}).mesh());
  };
  const Make points = [&](Place& place, double half) -> btCollisionShape& {
    auto& shape = place.make<btConvexHullShape>();
    for (int i = 0; i < 8; ++i) shape.addPoint(HullShape(cube(half)).getUnscaledPoints()[i]);
    return shape;
  };
  const Make plane = [](Place& place, double half) -> btCollisionShape& {
    return place.make<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(half));
  };
  const auto expect_rest = [&](const Make& below, const Make& above, std::initializer_list<std::array<double, 2>> halves) {
    const double margins = &below == &plane ? 0.04 : 0.08;
    Place floor, place;
    Dynamics d;
    btRigidBody *ground = nullptr, *body = nullptr;
    for (const auto& [half_below, half_above] : halves) {
      btCollisionShape &lower = below(floor, half_below), &upper = above(place, half_above);
      if (!ground) ground = &d.add(lower, at(0, 0, 0)), body = &d.add(upper, at(0, 0, half_below + half_above + margins), 1);
      ground->setCollisionShape(&lower), body->setCollisionShape(&upper);
      for (int step = 0; step < 200; ++step) d.step();
      EXPECT_NEAR(body->getWorldTransform().getOrigin().z(), half_below + half_above + margins, 0.02)
          << upper.getName() << " of " << half_above << " on " << lower.getName() << " of " << half_below;
    }
  };
  for (const Make* below : {&hull, &mesh}) {
    for (const Make* above : {&hull, &mesh, &points}) expect_rest(*below, *above, {{2, 0.5}, {2, 0.3}, {2, 0.9}});
  }
  for (const Make* below : {&hull, &mesh, &plane}) {
    for (const Make* above : {&hull, &mesh}) expect_rest(*below, *above, {{2, 0.5}, {1.8, 0.5}, {1.9, 0.5}});
  }
}

// ---- Who answers -----------------------------------------------------------------------------------------------------------

/// One shape of every class that Bullet has, each about as large as a cube of side 2 around the origin, and what it borrows.
struct Zoo {
  btTriangleMesh pyramid;
  std::vector<btVector3> corners{btVector3(1, 1, -1), btVector3(-1, 1, -1), btVector3(-1, -1, -1), btVector3(1, -1, -1),
                                 btVector3(0, 0, 1)};
  std::vector<float> heights = std::vector<float>(9, 0.5f);
  btSphereShape child{1};
  std::vector<std::pair<std::string, std::shared_ptr<btCollisionShape>>> all;

  Zoo() {
    for (const auto& [i, j, k] : {std::array{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 2}, {3, 2, 0}})
      pyramid.addTriangle(corners[i], corners[j], corners[k]);
    add("HullShape", std::make_shared<HullShape>(bodies::model(bodies::octahedron())));
    add("btBoxShape", std::make_shared<btBoxShape>(btVector3(1, 1, 1)));
    add("btTriangleShape", std::make_shared<btTriangleShape>(corners[0], corners[1], corners[4]));
    add("btBU_Simplex1to4", std::make_shared<btBU_Simplex1to4>(corners[0], corners[1], corners[2], corners[4]));
    add("btConvexTriangleMeshShape", std::make_shared<btConvexTriangleMeshShape>(&pyramid));
    add("btConvexHullShape", std::make_shared<btConvexHullShape>(&corners[0].x(), int(corners.size())));
    add("btConvexPointCloudShape",
        std::make_shared<btConvexPointCloudShape>(corners.data(), int(corners.size()), btVector3(1, 1, 1)));
    add("btSphereShape", std::make_shared<btSphereShape>(btScalar(1)));
    const btScalar radii[] = {btScalar(0.5), btScalar(0.7)};
    add("btMultiSphereShape", std::make_shared<btMultiSphereShape>(corners.data(), radii, 2));
    add("btCapsuleShape", std::make_shared<btCapsuleShape>(btScalar(0.5), btScalar(1)));
    add("btConeShape", std::make_shared<btConeShape>(btScalar(1), btScalar(2)));
    add("btCylinderShape", std::make_shared<btCylinderShape>(btVector3(1, 1, 1)));
    add("btUniformScalingShape", std::make_shared<btUniformScalingShape>(&child, btScalar(0.9)));
    add("btMinkowskiSumShape", std::make_shared<btMinkowskiSumShape>(&child, &child));
    add("btBox2dShape", std::make_shared<btBox2dShape>(btVector3(1, 1, btScalar(0.1))));
    add("btConvex2dShape", std::make_shared<btConvex2dShape>(&child));
    const auto mesh = std::make_shared<btBvhTriangleMeshShape>(&pyramid, true);
    add("btBvhTriangleMeshShape", mesh);
    add("btScaledBvhTriangleMeshShape",
        std::make_shared<btScaledBvhTriangleMeshShape>(mesh.get(), btVector3(1, btScalar(1.1), 1)));
    add("btMultimaterialTriangleMeshShape", std::make_shared<btMultimaterialTriangleMeshShape>(&pyramid, true));
    add("btHeightfieldTerrainShape",
        std::make_shared<btHeightfieldTerrainShape>(3, 3, heights.data(), btScalar(-1), btScalar(1), 2, false));
    const auto gimpact = std::make_shared<btGImpactMeshShape>(&pyramid);
    gimpact->updateBound();
    add("btGImpactMeshShape", gimpact);
    add("MeshShape", std::make_shared<bullet::MeshShape>(bullet::mesh_of(pyramid).value()));
    add("btSdfCollisionShape", std::make_shared<btSdfCollisionShape>());
    add("btEmptyShape", std::make_shared<btEmptyShape>());
    add("btStaticPlaneShape", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(1)));
    const auto compound = std::make_shared<btCompoundShape>();
    compound->addChildShape(at(0, 0, 0), &child);
    add("btCompoundShape", compound);
  }
  void add(const char* name, std::shared_ptr<btCollisionShape> shape) { all.emplace_back(name, std::move(shape)); }
};

/// The rows that begin with a class, of the page's table under a heading, and who answers.
std::map<std::string, std::string> table_of_the_page(const std::string& heading) {
  std::ifstream page(std::string(SWIFTLET_TEST_DIR) + "/../adapters/README.md");
  std::map<std::string, std::string> rows;
  bool is_below = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) is_below = line == heading;
    if (!is_below || !(line.starts_with("| `bt") || line.starts_with("| `HullShape`") || line.starts_with("| `MeshShape`")))
      continue;
    const std::size_t end = line.find(" | ", 2), next = line.find(" | ", end + 3);
    if (end == std::string::npos || next == std::string::npos) continue;
    std::string names = line.substr(2, end - 2);
    for (std::size_t begin = 0; (begin = names.find('`', begin)) != std::string::npos;) {
      const std::size_t close = names.find('`', begin + 1);
      rows[names.substr(begin + 1, close - begin - 1)] = line.substr(end + 3, next - end - 3);
      begin = close + 1;
    }
  }
  return rows;
}

/// The page's table, `answers` and what happens are one and the same, in both tables of the dispatcher and both orders.
TEST(WhoAnswers, IsWhatThePageSays) {
  const std::map<std::string, std::string> page = table_of_the_page("### Who answers a HullShape's pair");
  Zoo zoo;
  World w, bullets(false);
  std::set<std::string> seen;
  int ours = 0, theirs = 0;
  for (const auto& [name, shape] : zoo.all) {
    seen.insert(name);
    ASSERT_TRUE(page.count(name)) << name << " is in no row of the page";
    HullShape hull(bodies::model(bodies::cube()));
    const bool is_ours = w.hull_pairs->answers(hull, *shape), is_compound = shape->isCompound();
    EXPECT_EQ(is_ours, w.hull_pairs->answers(*shape, hull));
    EXPECT_EQ(page.at(name), is_compound ? "child by child" : is_ours ? "swiftlet" : "Bullet") << name;
    (is_ours || is_compound ? ours : theirs) += 1;
    if (name == "btGImpactMeshShape" || name == "btSdfCollisionShape" || name == "btEmptyShape")
      continue;  // no answer by default

    const btTransform in_world = at(0.1, 0.05, 2.03);
    for (const bool hull_first : {true, false}) {
      const auto ask = [&](World& world) {
        return hull_first ? closest_points(world, hull, in_world, *shape, at(0, 0, 0), btScalar(3))
                          : closest_points(world, *shape, at(0, 0, 0), hull, in_world, btScalar(3));
      };
      const auto touches = [&](World& world) {
        btCollisionObject a, b;
        a.setCollisionShape(&hull), b.setCollisionShape(shape.get());
        a.setWorldTransform(in_world);
        for (btCollisionObject* object : hull_first ? std::array{&a, &b} : std::array{&b, &a})
          world.world.addCollisionObject(object);
        world.world.performDiscreteCollisionDetection();
        std::vector<btScalar> found;
        for (int m = 0; m < world.dispatcher.getNumManifolds(); ++m) {
          const btPersistentManifold& manifold = *world.dispatcher.getManifoldByIndexInternal(m);
          for (int i = 0; i < manifold.getNumContacts(); ++i) found.push_back(manifold.getContactPoint(i).getDistance());
        }
        world.world.removeCollisionObject(&a), world.world.removeCollisionObject(&b);
        return found;
      };
      const auto before = ask(w);
      const auto touched = touches(w), touched_in_bullet = touches(bullets);
      ASSERT_FALSE(before.empty()) << name;
      if (is_ours || is_compound) {
        blind_bullet(hull);
        const auto after = ask(w);
        ASSERT_EQ(after.size(), before.size()) << name;
        for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].distance, before[i].distance) << name;
        EXPECT_EQ(touches(w), touched) << name;
        for (int i = 0; i < hull.getNumPoints(); ++i) hull.getUnscaledPoints()[i] -= btVector3(50, 50, 50);
      } else {
        const auto others = ask(bullets);
        ASSERT_EQ(before.size(), others.size()) << name;
        for (std::size_t i = 0; i < others.size(); ++i) {
          EXPECT_EQ(before[i].distance, others[i].distance) << name;
          EXPECT_TRUE(before[i].on_b == others[i].on_b) << name;
        }
        EXPECT_EQ(touched, touched_in_bullet) << name;
      }
    }
  }
  for (const auto& [name, who] : page) EXPECT_TRUE(seen.count(name)) << name << " is a row of the page, and no shape here";
  std::printf("%d classes of shapes are swiftlet's, %d Bullet's\n", ours, theirs);
}

/// The same of a mesh, whose rows are a table of their own. What is Bullet's, it answers by the triangles or not at all.
TEST(WhoAnswers, OfAMeshIsWhatThePageSays) {
  const std::map<std::string, std::string> page = table_of_the_page("### Who answers a MeshShape's pair");
  Zoo zoo;
  World w, bullets(false);
  btTriangleMesh cube;
  const btVector3 p(1, 1, 1), q(1, -1, -1), r(-1, 1, -1), s(-1, -1, 1);
  cube.addTriangle(p, q, r), cube.addTriangle(p, r, s), cube.addTriangle(p, s, q), cube.addTriangle(q, s, r);
  bullet::MeshShape mesh(bullet::mesh_of(cube).value());
  std::set<std::string> seen;
  for (const auto& [name, shape] : zoo.all) {
    seen.insert(name);
    ASSERT_TRUE(page.count(name)) << name << " is in no row of the page";
    const bool is_ours = w.hull_pairs->answers(mesh, *shape), is_compound = shape->isCompound();
    EXPECT_EQ(is_ours, w.hull_pairs->answers(*shape, mesh));
    const std::string& who = page.at(name);
    EXPECT_EQ(is_ours, who == "swiftlet") << name;
    if (who != "swiftlet" && who != "child by child" && who != "Bullet" && who != "nobody")
      ADD_FAILURE() << name << ": " << who;
    if (name == "btGImpactMeshShape" || name == "btEmptyShape" || name == "btSdfCollisionShape") continue;
    for (const bool mesh_first : {true, false}) {
      const auto ask = [&](World& world) {
        const btTransform in_world = at(0.1, 0.05, 2.03);
        return mesh_first ? closest_points(world, mesh, in_world, *shape, at(0, 0, 0), 3, is_ours && &world == &w)
                          : closest_points(world, *shape, at(0, 0, 0), mesh, in_world, 3, is_ours && &world == &w);
      };
      const auto points = ask(w), theirs = ask(bullets);
      EXPECT_EQ(points.empty(), who == "nobody") << name;
      if (is_ours || is_compound) continue;
      ASSERT_EQ(points.size(), theirs.size()) << name;
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].distance, theirs[i].distance) << name;
    }
  }
  for (const auto& [name, who] : page) EXPECT_TRUE(seen.count(name)) << name << " is a row of the page, and no shape here";
}

/// Scaled, a MeshShape is a concave shape of Bullet's, but to a HullShape, which takes its triangles.
TEST(WhoAnswers, OfAScaledMeshBulletDoes) {
  World w;
  const auto floor = terrain(6, 3, flat);
  bullet::MeshShape mesh(bullet::mesh_of(floor->mesh).value());
  mesh.setMargin(0);
  mesh.setLocalScaling(btVector3(1, 1, 2));
  HullShape hull(bodies::model(bodies::cube()));
  btSphereShape ball(1);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 1);
  EXPECT_TRUE(w.hull_pairs->answers(hull, mesh));
  EXPECT_FALSE(w.hull_pairs->answers(ball, mesh));
  EXPECT_FALSE(w.hull_pairs->answers(plane, mesh));
  EXPECT_FALSE(w.hull_pairs->answers(mesh, mesh));
  for (btCollisionShape* shape : {static_cast<btCollisionShape*>(&hull), static_cast<btCollisionShape*>(&ball)}) {
    const auto points = closest_points(w, *shape, at(0.1, 0.2, 1.2), mesh, at(0, 0, 0), 1, shape == &hull);
    ASSERT_FALSE(points.empty());
    btScalar least = 9;
    for (const Point& p : points) least = std::min(least, p.distance);
    EXPECT_NEAR(least, shape == &hull ? 0.2 - hull.getMargin() : 0.2, 1e-4);
  }
}

/// What is no body, as by its margin, is Bullet's; a MeshShape whose margin is no radius touches nothing.
TEST(WhoAnswers, OfMarginsThatAreNoRadiusBulletDoes) {
  World w, bullets(false);
  HullShape hull(bodies::model(bodies::cube())), odd(bodies::model(bodies::cube()));
  odd.setMargin(btScalar(-0.5));
  const auto floor = terrain(6, 3, flat), sunk = terrain(6, 3, flat);
  sunk->shape->setMargin(btScalar(-0.01));
  bullet::MeshShape small(soups::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).mesh()), large(bullet::mesh_of(floor->mesh).value());
  btSphereShape ball(1), nothing(-1);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  for (btCollisionShape* shape : {static_cast<btCollisionShape*>(&ball), static_cast<btCollisionShape*>(floor->shape.get()),
                                  static_cast<btCollisionShape*>(&plane), static_cast<btCollisionShape*>(&small),
                                  static_cast<btCollisionShape*>(&large), static_cast<btCollisionShape*>(&hull)}) {
    EXPECT_TRUE(w.hull_pairs->answers(hull, *shape)) << shape->getName();
    EXPECT_FALSE(w.hull_pairs->answers(odd, *shape)) << shape->getName();
    EXPECT_FALSE(w.hull_pairs->answers(*shape, odd)) << shape->getName();
    std::vector<Point> ours = closest_points(w, odd, at(0, 0, 0.4), *shape, at(0, 0, 0), 0, false),
                       theirs = closest_points(bullets, odd, at(0, 0, 0.4), *shape, at(0, 0, 0), 0, false);
    ASSERT_EQ(ours.size(), theirs.size()) << shape->getName();
    for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(ours[i].distance, theirs[i].distance) << shape->getName();
  }
  EXPECT_FALSE(w.hull_pairs->answers(hull, *sunk->shape));
  EXPECT_FALSE(w.hull_pairs->answers(hull, nothing));
  large.setMargin(-1);
  EXPECT_TRUE(w.hull_pairs->answers(hull, large));
}

/// Shapes of the user's own, and types that have no class: nothing that is not named is taken.
TEST(WhoAnswers, LeavesUnknownTypesAlone) {
  struct Other : btSphereShape {
    explicit Other(int type) : btSphereShape(1) { m_shapeType = type; }
  };
  const Zoo zoo;
  std::set<int> ours;
  World w;
  HullShape hull(bodies::model(bodies::cube()));
  for (const auto& [name, shape] : zoo.all) {
    if (w.hull_pairs->answers(hull, *shape)) ours.insert(shape->getShapeType());
  }
  EXPECT_EQ(ours.size(), 14u);
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    if (ours.count(type)) continue;
    EXPECT_FALSE(w.hull_pairs->answers(hull, Other(type))) << type;
  }
  for (const auto& [name, shape] : zoo.all) {
    for (const auto& [other_name, other] : zoo.all) {
      if (name.find('b') != 0 || other_name.find('b') != 0) continue;  // one of ours
      EXPECT_FALSE(w.hull_pairs->answers(*shape, *other)) << name << " " << other_name;
    }
  }
}

// ---- Beside Bullet ---------------------------------------------------------------------------------------------------------

Model ellipsoid(int vertices) {
  Random random;
  std::vector<btVector3> points;
  for (int i = 0; i < vertices; ++i) {
    const btVector3 p = random.vector(1);
    points.push_back(p.normalized() * btVector3(1, btScalar(0.8), btScalar(0.6)));
  }
  return bodies::must(bullet::model_of(points.data(), vertices));
}

struct Others {
  std::unique_ptr<Surface> hills = terrain(20, 4, [](double x, double y) { return 0.1 * std::sin(2 * x) * std::cos(3 * y); });
  btSphereShape sphere{1};
  btCapsuleShape capsule{btScalar(0.5), 1};
  btBoxShape box{btVector3(1, btScalar(0.8), btScalar(0.6))};
  btConvexHullShape hull;
  btStaticPlaneShape plane{btVector3(0, 0, 1), 0};
  btCylinderShape cylinder{btVector3(btScalar(0.7), 1, btScalar(0.7))};
  std::vector<std::pair<std::string, btCollisionShape*>> all{
      {"sphere", &sphere}, {"capsule", &capsule},        {"box", &box},          {"hull of 60 points", &hull},
      {"plane", &plane},   {"mesh", hills->shape.get()}, {"cylinder", &cylinder}};
  Others() {
    for (const Vec3& p : bodies::points_of(ellipsoid(60).level(0).view))
      hull.addPoint(btVector3(btScalar(p[0]), btScalar(p[1]), btScalar(p[2])));
  }
};

/// Both see the same pairs touch. The times are of whole steps of the narrowphase, of one pair, in the middle.
TEST(BesideBullet, PairsTouchInTheSameSteps) {
  Others others;
  for (const int vertices : {8, 60, 200}) {
    HullShape hull(ellipsoid(vertices));
    for (const auto& [name, shape] : others.all) {
      World both[2] = {World(true), World(false)};
      btCollisionObject a[2], b[2];
      for (int w = 0; w < 2; ++w) {
        a[w].setCollisionShape(&hull), b[w].setCollisionShape(shape);
        both[w].world.addCollisionObject(&b[w]), both[w].world.addCollisionObject(&a[w]);
      }
      Random random;
      std::vector<double> times[2];
      int touching[2] = {}, differ = 0;
      btVector3 axis = random.vector(1).normalized();
      for (int step = 0; step < 600; ++step) {
        btTransform pose(btQuaternion(axis, btScalar(0.01 * step)), btVector3(btScalar(0.003 * step - 0.9), btScalar(0.2), 3));
        const auto near = closest_points(both[0], hull, pose, *shape, at(0, 0, 0), 10);
        ASSERT_FALSE(near.empty());
        const Point& nearest =
            *std::min_element(near.begin(), near.end(), [](const Point& p, const Point& q) { return p.distance < q.distance; });
        pose.setOrigin(pose.getOrigin() - nearest.normal_on_b * (nearest.distance + btScalar(0.03 * std::sin(0.05 * step))));
        bool touches[2];
        for (int w = 0; w < 2; ++w) {
          a[w].setWorldTransform(pose);
          both[w].world.updateAabbs();
          both[w].world.computeOverlappingPairs();
          const auto begin = std::chrono::steady_clock::now();
          both[w].dispatcher.dispatchAllCollisionPairs(both[w].broadphase.getOverlappingPairCache(),
                                                       both[w].world.getDispatchInfo(), &both[w].dispatcher);
          times[w].push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
          touches[w] = false;
          for (int m = 0; m < both[w].dispatcher.getNumManifolds(); ++m)
            touches[w] |= both[w].dispatcher.getManifoldByIndexInternal(m)->getNumContacts() > 0;
          touching[w] += touches[w];
        }
        differ += touches[0] != touches[1];
      }
      for (auto& t : times) std::nth_element(t.begin(), t.begin() + 300, t.end());
      std::printf("| %d vertices, %s | %.2f | %.2f |\n", vertices, name.c_str(), times[0][300], times[1][300]);
      EXPECT_GT(touching[0], 200) << name;
      EXPECT_LE(differ, 60) << name << " " << touching[0] << " " << touching[1];
      for (int w = 0; w < 2; ++w) both[w].world.removeCollisionObject(&a[w]), both[w].world.removeCollisionObject(&b[w]);
    }
  }
}

/// Bodies of all kinds on hills between four planes: none is lost, and of the pairs that touch with a HullShape none is
/// Bullet's but a cylinder's.
TEST(BesideBullet, AMixedWorldIsSwiftlets) {
  const auto hills = terrain(16, 5, [](double x, double y) { return 0.3 * std::sin(1.3 * x) * std::cos(1.7 * y); });
  const Others others;
  for (const bool with_swiftlet : {true, false}) {
    Dynamics d(with_swiftlet);
    d.add(*hills->shape, at(0, 0, 0));
    btStaticPlaneShape walls[4] = {
        {btVector3(1, 0, 0), -4}, {btVector3(-1, 0, 0), -4}, {btVector3(0, 1, 0), -4}, {btVector3(0, -1, 0), -4}};
    for (btStaticPlaneShape& wall : walls) d.add(wall, at(0, 0, 0));
    HullShape small(ellipsoid(20)), large(ellipsoid(60)), cube(bodies::model(bodies::box(0.5, 0.5, 0.5)));
    btSphereShape sphere(btScalar(0.5));
    btCapsuleShape capsule(btScalar(0.3), btScalar(0.6));
    btBoxShape box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.3)));
    btCylinderShape cylinder(btVector3(btScalar(0.4), btScalar(0.5), btScalar(0.4)));
    btConvexHullShape points;
    for (int i = 0; i < large.getNumPoints(); ++i) points.addPoint(large.getUnscaledPoints()[i] * btScalar(0.6));
    btCompoundShape compound;
    compound.addChildShape(at(-0.5, 0, 0), &cube), compound.addChildShape(at(0.5, 0, 0), &sphere);
    btCollisionShape* const kinds[] = {&small, &sphere, &large, &capsule, &cube, &box, &compound, &points, &small, &cylinder};
    Random random;
    for (int i = 0; i < 50; ++i) {
      btTransform in_world = random.transform(0.3);
      in_world.setOrigin(in_world.getOrigin() + btVector3(btScalar(1.6 * (i % 5) - 3.2), btScalar(1.6 * (i / 5 % 5) - 3.2),
                                                          btScalar(2 + 2 * (i / 25))));
      d.add(*kinds[i % 10], in_world, 1);
    }
    long touching = 0, with_hull = 0, hull_hull = 0, ours = 0;
    double lowest = 10, jitter = 0;
    for (int step = 0; step < 600; ++step) {
      d.step();
      if (step >= 450)
        for (const auto& body : d.bodies)
          jitter += body->isStaticObject() ? 0 : body->getLinearVelocity().length2() / (150 * 50);
      for (const auto& body : d.bodies) {
        if (!body->isStaticObject()) lowest = std::min(lowest, double(body->getWorldTransform().getOrigin().z()));
      }
      if (step % 10) continue;
      for (int m = 0; m < d.dispatcher.getNumManifolds(); ++m) {
        const btPersistentManifold& manifold = *d.dispatcher.getManifoldByIndexInternal(m);
        if (!manifold.getNumContacts()) continue;
        const btCollisionShape &a = *manifold.getBody0()->getCollisionShape(), &b = *manifold.getBody1()->getCollisionShape();
        const auto is_hull = [](const btCollisionShape& shape) { return dynamic_cast<const HullShape*>(&shape) != nullptr; };
        const bool any = is_hull(a) || is_hull(b);
        ++touching, with_hull += any, hull_hull += is_hull(a) && is_hull(b);
        if (!with_swiftlet || !any) continue;
        const bool has_compound = a.isCompound() || b.isCompound();
        ours += has_compound || d.hull_pairs->answers(a, b);
        const int other = is_hull(a) ? b.getShapeType() : a.getShapeType();
        EXPECT_EQ(has_compound || d.hull_pairs->answers(a, b), other != CYLINDER_SHAPE_PROXYTYPE);
      }
    }
    EXPECT_GT(lowest, -0.5) << "a body was lost";
    std::printf(
        "%s: of %ld touching manifolds %ld are hull and hull, %ld have a hull, %ld of these swiftlet's; lowest %.2f m, jitter "
        "%.4f m/s\n",
        with_swiftlet ? "swiftlet" : "Bullet", touching, hull_hull, with_hull, ours, lowest, std::sqrt(jitter));
  }
}

/// Hulls dropped on hills of small triangles stay above them, come to rest, and gain no energy.
TEST(BesideBullet, HullsComeToRestOnHills) {
  const auto height = [](double x, double y) { return std::sin(2 * x) * std::cos(2.6 * y); };
  const auto hills = terrain(40, 5, height);
  struct {
    double gained = 0, jitter = 0, contacts = 0;
  } both[2];
  for (int w = 0; w < 2; ++w) {
    Dynamics d(w == 0);
    d.add(*hills->shape, at(0, 0, 0));
    btStaticPlaneShape walls[4] = {
        {btVector3(1, 0, 0), -4}, {btVector3(-1, 0, 0), -4}, {btVector3(0, 1, 0), -4}, {btVector3(0, -1, 0), -4}};
    for (btStaticPlaneShape& wall : walls) d.add(wall, at(0, 0, 0));
    HullShape box(bodies::model(bodies::box(0.4, 0.3, 0.2))), pointed(bodies::model(bodies::tetrahedron(0.4))),
        round(ellipsoid(60));
    Random random;
    for (int i = 0; i < 25; ++i) {
      btTransform in_world = random.transform(0.2);
      in_world.setOrigin(in_world.getOrigin() + btVector3(btScalar(1.6 * (i % 5) - 3.2), btScalar(1.6 * (i / 5) - 3.2), 3));
      d.add(i % 3 == 0 ? box : i % 3 == 1 ? pointed : round, in_world, 1, btVector3(0, 0, -4));
    }
    const auto energy = [&] {
      double sum = 0;
      for (const auto& body : d.bodies) {
        if (body->isStaticObject()) continue;
        const btVector3 spin = body->getAngularVelocity();
        sum += 0.5 * body->getLinearVelocity().length2() + 9.81 * body->getWorldTransform().getOrigin().z() +
               0.5 * spin.dot(body->getInvInertiaTensorWorld().inverse() * spin);
      }
      return sum;
    };
    const double start = energy();
    double before = start;
    for (int step = 0; step < 480; ++step) {
      d.step();
      const double now = energy();
      both[w].gained += std::max(0., now - before) / start;
      before = now;
      for (const auto& body : d.bodies) {
        if (body->isStaticObject()) continue;
        if (step >= 360) both[w].jitter += body->getLinearVelocity().length2() / (120 * 25);
        const btVector3& p = body->getWorldTransform().getOrigin();
        EXPECT_TRUE(w == 1 || p.z() > height(p.x(), p.y()) - 0.05) << step;
      }
      for (int m = 0; m < d.dispatcher.getNumManifolds(); ++m)
        both[w].contacts += d.dispatcher.getManifoldByIndexInternal(m)->getNumContacts() / 480.;
    }
    both[w].jitter = std::sqrt(both[w].jitter);
    std::printf("| %s | %.1e | %.1f | %.0f |\n", w == 0 ? "swiftlet" : "Bullet", both[w].gained, 1000 * both[w].jitter,
                both[w].contacts);
  }
  EXPECT_LE(both[0].gained, both[1].gained);
  EXPECT_LE(both[0].jitter, both[1].jitter);
}

}  // namespace
}  // namespace swiftlet
