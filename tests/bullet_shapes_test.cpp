// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// HullShapes against every other shape of Bullet's, in both precisions: exact answers by brute force, both orders of a pair,
// who answers which, and what triangles must never do to a body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMinkowskiSumShape.h>
#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "bullet_world.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The oracle: polyhedra in the world's frame, by brute force ------------------------------------------------------------

/// A solid, a flat triangle, a segment or a point.
struct Polytope {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;
};

Polytope moved(Polytope body, const btTransform& t) {
  const Pose pose = pose_of(t);
  for (Vec3& p : body.points) p = pose.rotation * p + pose.translation;
  return body;
}

Polytope polytope_of(const ConvexView& view) {
  Polytope body{bodies::points_of(view), {}, {}};
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) {
    std::vector<int> loop;
    for (const std::uint32_t v : FaceLoop(view, f)) loop.push_back(int(v));
    for (std::size_t i = 2; i < loop.size(); ++i) body.triangles.push_back({loop[0], loop[i - 1], loop[i]});
    for (std::size_t i = 0; i < loop.size(); ++i) body.edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
  return body;
}

Polytope polytope_of(const bodies::Polyhedron& body) { return polytope_of(bodies::model(body).level(0).view); }

double point_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0., 1.) : 0;
  return (p - a - t * d).norm();
}

double point_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const auto is_left = [&](const Vec3& q, const Vec3& r) { return n.dot((r - q).cross(p - q)) >= 0; };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::abs(n.dot(p - a));
  return std::min({point_segment(p, a, b), point_segment(p, b, c), point_segment(p, c, a)});
}

double segment_segment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double least = std::min({point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b)});
  const Vec3 u = b - a, v = d - c, n = u.cross(v);
  if (n.squaredNorm() < 1e-20 * u.squaredNorm() * v.squaredNorm()) return least;
  const double s = (c - a).cross(v).dot(n) / n.squaredNorm(), t = (c - a).cross(u).dot(n) / n.squaredNorm();
  return s > 0 && s < 1 && t > 0 && t < 1 ? std::min(least, std::abs(n.dot(c - a)) / n.norm()) : least;
}

/// Apart, the distance of the nearest features; else minus the least depth, which lies along a normal or a product of edges.
double signed_gap(const Polytope& a, const Polytope& b) {
  double best = -kInfinity;
  const auto consider = [&](const Vec3& axis) {
    if (axis.norm() < 1e-9) return;
    const Vec3 n = axis.normalized();
    double least_a = kInfinity, most_a = -kInfinity, least_b = kInfinity, most_b = -kInfinity;
    for (const Vec3& p : a.points) least_a = std::min(least_a, n.dot(p)), most_a = std::max(most_a, n.dot(p));
    for (const Vec3& p : b.points) least_b = std::min(least_b, n.dot(p)), most_b = std::max(most_b, n.dot(p));
    best = std::max({best, least_b - most_a, least_a - most_b});
  };
  const auto edge = [](const Polytope& body, int i) {
    return Vec3(body.points[body.edges[i][1]] - body.points[body.edges[i][0]]);
  };
  for (const Polytope* body : {&a, &b}) {
    for (const auto& [i, j, k] : body->triangles)
      consider((body->points[j] - body->points[i]).cross(body->points[k] - body->points[i]));
  }
  for (int i = 0; i < int(a.edges.size()); ++i) {
    for (int j = 0; j < int(b.edges.size()); ++j) consider(edge(a, i).cross(edge(b, j)));
  }
  if (best <= 0) return best;
  double least = kInfinity;
  const auto points_of_one = [&](const Polytope& one, const Polytope& other) {
    for (const Vec3& p : one.points) {
      for (const auto& [i, j, k] : other.triangles)
        least = std::min(least, point_triangle(p, other.points[i], other.points[j], other.points[k]));
      if (other.points.size() == 1) least = std::min(least, (p - other.points[0]).norm());
    }
  };
  points_of_one(a, b), points_of_one(b, a);
  for (const auto& [i, j] : a.edges) {
    for (const auto& [k, l] : b.edges)
      least = std::min(least, segment_segment(a.points[i], a.points[j], b.points[k], b.points[l]));
    for (const Vec3& p : b.points) least = std::min(least, point_segment(p, a.points[i], a.points[j]));
  }
  return least;
}

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

struct Random {
  std::mt19937 engine{7};
  double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine); }
  btVector3 vector(double size) {
    return btVector3(btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1))) * btScalar(size);
  }
  btTransform transform(double size) {
    const btQuaternion q(btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)), btScalar(uniform(-1, 1)),
                         btScalar(uniform(-1, 1)));
    return btTransform(q.normalized(), vector(size));
  }
};

/// A shape of Bullet's, and what it is: all points within a radius of a polytope.
struct Known {
  std::shared_ptr<btCollisionShape> shape;
  Polytope core;
  double radius;
};

using Maker = std::function<Known(Random&)>;

Vec3 vec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

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

}  // namespace
}  // namespace swiftlet
