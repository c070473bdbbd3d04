// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// MeshShapes in Bullet, in both precisions: beside every pair of triangles, beside planes and boxes where a mesh is flat, and
// in scenes, beside btGImpactMeshShape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include "bodies.h"
#include "brute_force.h"
#include "bullet_world.h"
#include "counted_allocations.h"
#include "soups.h"

namespace swiftlet {
namespace {

using bullet::MeshShape;
using soups::Soup;

/// Squares over [-size, size]^2, each cut in two; open.
Soup floor_of(std::uint32_t cells, double size, const std::function<double(double, double)>& height) {
  Soup soup = soups::patch(cells, [&](double x, double y) { return height(size * x, size * y); });
  for (Vec3& p : soup.points) p[0] *= size, p[1] *= size;
  return soup;
}
double flat(double, double) { return 0; }
double bowl(double x, double y) { return 0.25 * (x * x + y * y); }

/// A regular prism around z.
bodies::Polyhedron prism(std::uint32_t sides, double radius, double half_height) {
  bodies::Polyhedron solid{{}, {}, {}};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {-half_height, half_height})
      solid.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t k = (i + 1) % sides;
    solid.add({2 * i, 2 * k, 2 * k + 1, 2 * i + 1});
  }
  for (std::uint32_t i = 0; i < sides; ++i) solid.corners.push_back(2 * i + 1);
  for (std::uint32_t i = sides; i-- > 0;) solid.corners.push_back(2 * i);
  solid.sizes.insert(solid.sizes.end(), 2, sides);
  return solid;
}

std::vector<Polytope> triangles_of(const Soup& soup) {
  std::vector<Polytope> all;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    all.push_back({{soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2)}, {{0, 1, 2}}, {{0, 1}, {1, 2}, {2, 0}}});
  return all;
}

Point nearest_of(const std::vector<Point>& points) {
  return *std::min_element(points.begin(), points.end(),
                           [](const Point& p, const Point& q) { return p.distance < q.distance; });
}

// ---- The shape -------------------------------------------------------------------------------------------------------------

TEST(MeshShapes, HandOutTheTrianglesInABox) {
  struct Seen final : btTriangleCallback {
    std::vector<int> triangles;
    std::vector<btVector3> corners;
    void processTriangle(btVector3* p, int part, int index) override {
      EXPECT_EQ(part, 0);
      triangles.push_back(index);
      corners.insert(corners.end(), p, p + 3);
    }
  };
  Random random;
  const Soup soup = soups::torus(24, 12);
  MeshShape shape(soup.mesh());
  for (const btVector3& scale : {btVector3(1, 1, 1), btVector3(2, btScalar(0.5), -1)}) {
    shape.setLocalScaling(scale);
    for (int i = 0; i < 50; ++i) {
      const btVector3 p = random.vector(1.5), q = random.vector(1.5);
      btVector3 least = p, most = p;
      least.setMin(q), most.setMax(q);
      Seen seen;
      shape.processAllTriangles(&seen, least, most);
      std::vector<int> expected;
      for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        Vec3 low = Vec3::Constant(9), high = -low;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 at = soup.corner(t, k).cwiseProduct(vec3(scale));
          low = low.cwiseMin(at), high = high.cwiseMax(at);
        }
        if ((low.array() <= vec3(most).array()).all() && (high.array() >= vec3(least).array()).all())
          expected.push_back(int(t));
      }
      for (std::size_t k = 0; k < seen.corners.size(); ++k) {
        const Vec3 at = soup.corner(std::size_t(seen.triangles[k / 3]), k % 3).cwiseProduct(vec3(scale));
        expect_near(seen.corners[k], btVector3(btScalar(at[0]), btScalar(at[1]), btScalar(at[2])), kRounding);
      }
      std::sort(seen.triangles.begin(), seen.triangles.end());
      EXPECT_EQ(seen.triangles, expected);
    }
  }
}

/// Where moments are known: boxes, a ring [Wikipedia: a solid torus], and two boxes that make an L.
TEST(MeshShapes, HaveTheInertiaOfTheirSolid) {
  const auto inertia_of = [](const Soup& soup) {
    btVector3 inertia;
    MeshShape(soup.mesh()).calculateLocalInertia(2, inertia);
    return vec3(inertia);
  };
  const Soup block = soups::box({1, -2, 0}, {2, 1, 5});  // sides 1, 3, 5
  EXPECT_LT((inertia_of(block) - 2 / 12. * Vec3(34, 26, 10)).norm(), 1e-5);
  const double r = 0.4;
  const Vec3 ring(2 * (0.5 + 5 / 8. * r * r), 2 * (0.5 + 5 / 8. * r * r), 2 * (1 + 0.75 * r * r));
  EXPECT_LT((inertia_of(soups::torus(200, 100, r)) - ring).norm(), 2e-3);
  Soup open = block;
  open.triangles.pop_back();
  EXPECT_LT((inertia_of(open) - 2 / 12. * Vec3(34, 26, 10)).norm(), 1e-5);  // of the box around it
  EXPECT_FALSE(MeshShape(open.mesh()).is_solid());
  EXPECT_TRUE(MeshShape(block.mesh()).is_solid());
  Soup inside_out = block;
  for (auto& [p, q, t] : inside_out.triangles) std::swap(p, q);
  EXPECT_FALSE(MeshShape(inside_out.mesh()).is_solid());

  const Mat3 turn = bodies::rotation(1, 2, 3, 4);
  MeshShape turned(soups::moved(block, turn, Vec3(1, 2, 3)).mesh());
  btVector3 moments;
  const btTransform axes = turned.principal_axes(2, moments);
  expect_near(
      axes.getOrigin(),
      btVector3(1, 2, 3) +
          [&] {
            const Vec3 c = turn * Vec3(1.5, -0.5, 2.5);
            return btVector3(btScalar(c[0]), btScalar(c[1]), btScalar(c[2]));
          }(),
      kRounding * 4);
  Vec3 sorted = vec3(moments);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_LT((sorted - 2 / 12. * Vec3(10, 26, 34)).norm(), 1e-5);
  const Mat3 basis = pose_of(axes).rotation, back = turn.transpose() * basis;
  EXPECT_NEAR(back.cwiseAbs().maxCoeff(), 1, 1e-5);
  EXPECT_NEAR(basis.determinant(), 1, 1e-5);
}

TEST(MeshShapes, RefuseAMeshThatWasCut) {
  EXPECT_THROW(MeshShape(soups::torus(64, 32).mesh().cut({.deviation = 10})), std::invalid_argument);
}

TEST(MeshShapes, AreMadeOfBulletsMeshes) {
  btTriangleMesh theirs;
  const Soup soup = soups::torus(12, 8);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    btVector3 p[3];
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = btVector3(btScalar(soup.corner(t, k)[0]), btScalar(soup.corner(t, k)[1]), btScalar(soup.corner(t, k)[2]));
    theirs.addTriangle(p[0], p[1], p[2]);
  }
  const MeshModel mesh = bullet::mesh_of(theirs).value();
  EXPECT_EQ(mesh.triangle_count(), soup.triangles.size());
  EXPECT_TRUE(mesh.topology().closed());
  btTriangleMesh empty;
  EXPECT_EQ(bullet::mesh_of(empty).error().code, ErrorCode::Empty);
}

TEST(MeshShapes, AreSeenByRaysAndSweeps) {
  World w;
  MeshShape shape(soups::torus(48, 24).mesh());
  btCollisionObject object;
  object.setCollisionShape(&shape);
  const btTransform in_world(btQuaternion(btVector3(1, 1, 0).normalized(), btScalar(0.3)), btVector3(3, 4, 5));
  object.setWorldTransform(in_world);
  w.world.addCollisionObject(&object);
  btVector3 least, most;
  shape.getAabb(in_world, least, most);
  for (std::size_t i = 0; i < shape.mesh().vertex_count(); ++i) {
    const Vec3 v = shape.mesh().vertex(i);
    const btVector3 p = in_world(btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(p[k], least[k] + shape.getMargin() - kRounding * 4);
      EXPECT_LE(p[k], most[k] - shape.getMargin() + kRounding * 4);
    }
  }
  const auto height_at = [&](double x) {
    const btVector3 from = in_world(btVector3(btScalar(x), 0, 3)), to = in_world(btVector3(btScalar(x), 0, -3));
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    w.world.rayTest(from, to, hit);
    return hit.hasHit() ? 3 - 6 * double(hit.m_closestHitFraction) : -9;
  };
  EXPECT_NEAR(height_at(1), 0.4, 1e-5);
  EXPECT_EQ(height_at(0), -9);
  btSphereShape ball(btScalar(0.1));
  const btTransform from = in_world * at(1, 0, 3), to = in_world * at(1, 0, -3);
  btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
  w.world.convexSweepTest(&ball, from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_NEAR(3 - 6 * hit.m_closestHitFraction, 0.4 + 0.1 + shape.getMargin(), 2e-3);
  w.world.removeCollisionObject(&object);
}

// ---- Answers ---------------------------------------------------------------------------------------------------------------

/// Small and large beside the mesh, in both orders, with margins: the least over all triangles by brute force.
TEST(MeshAnswers, OfConvexBodiesAreAsBruteForceSays) {
  World w;
  Random random;
  shapes::Random soups_random(3);
  int apart = 0;
  for (int i = 0; i < 160; ++i) {
    const Soup soup = soups::scaled(soups::any(soups_random), random.uniform(0.3, 2));
    MeshShape mesh(soup.mesh());
    mesh.setMargin(btScalar(random.uniform(0, 0.05)));
    const double x = random.uniform(0.1, 2), y = random.uniform(0.1, 2), z = random.uniform(0.1, 2);
    HullShape hull(bodies::model(bodies::box(x, y, z)));
    btBoxShape box{btVector3(btScalar(x), btScalar(y), btScalar(z))};
    btSphereShape ball{btScalar(x)};
    btCapsuleShapeX capsule{btScalar(x), btScalar(2 * y)};
    struct {
      btCollisionShape* shape;
      Polytope core;
      double radius;
    } const others[] = {{&hull, polytope_of(bodies::box(x, y, z)), hull.getMargin()},
                        {&box, polytope_of(bodies::box(x, y, z)), 0},
                        {&ball, {{{0, 0, 0}}, {}, {}}, x},
                        {&capsule, {{{-y, 0, 0}, {y, 0, 0}}, {}, {{0, 1}}}, x}};
    for (const auto& other : others) {
      ASSERT_TRUE(w.hull_pairs->answers(mesh, *other.shape));
      const btTransform mesh_in_world = random.transform(1), in_world = random.transform(4);
      double gap = kFarthest;
      const Polytope body = moved(other.core, pose_of(in_world));
      for (const Polytope& t : triangles_of(soup)) gap = std::min(gap, signed_gap(moved(t, pose_of(mesh_in_world)), body));
      if (gap <= 0) continue;
      ++apart;
      const auto forth = closest_points(w, mesh, mesh_in_world, *other.shape, in_world, 10);
      const auto back = closest_points(w, *other.shape, in_world, mesh, mesh_in_world, 10);
      const bool encloses = !forth.empty() && nearest_of(forth).distance < gap - mesh.getMargin() - other.radius - 1e-3;
      if (encloses) {  // apart from all triangles, inside of the solid
        EXPECT_TRUE(mesh.is_solid());
        continue;
      }
      ASSERT_FALSE(forth.empty()) << i;
      ASSERT_FALSE(back.empty()) << i;
      EXPECT_NEAR(nearest_of(forth).distance, gap - mesh.getMargin() - other.radius, kRounding * 4) << i;
      EXPECT_NEAR(nearest_of(back).distance, gap - mesh.getMargin() - other.radius, kRounding * 4) << i;
      const Point p = nearest_of(forth);
      expect_near(p.on_a - p.on_b, p.normal_on_b * p.distance, kRounding * 4);
    }
  }
  EXPECT_GT(apart, 300);
}

TEST(MeshAnswers, OfTwoMeshesAreAsBruteForceSays) {
  World w;
  Random random;
  shapes::Random soups_random(5);
  int apart = 0, meet = 0;
  for (int i = 0; i < 200; ++i) {
    const Soup soup_a = soups::any(soups_random), soup_b = soups::any(soups_random);
    MeshShape a(soup_a.mesh()), b(soup_b.mesh());
    a.setMargin(btScalar(0.03));
    b.setMargin(btScalar(i % 2 ? 0.05 : 0));
    const btTransform a_in_world = random.transform(1), b_in_world = random.transform(i % 2 ? 3 : 0.5);
    const double gap = soups::brute_force(soup_a, soup_b, relative(pose_of(a_in_world), pose_of(b_in_world)));
    const auto forth = closest_points(w, a, a_in_world, b, b_in_world, 10);
    const auto back = closest_points(w, b, b_in_world, a, a_in_world, 10);
    ASSERT_EQ(forth.size() > 0, back.size() > 0);
    if (gap <= 1e-6) {
      ++meet;
      ASSERT_FALSE(forth.empty()) << i;
      EXPECT_LE(forth[0].distance, -a.getMargin() - b.getMargin() + 1e-4) << i;
      continue;
    }
    ASSERT_EQ(forth.size(), 1u) << i;
    if (forth[0].distance < gap - 0.1) continue;  // one encloses the other
    ++apart;
    EXPECT_NEAR(forth[0].distance, gap - a.getMargin() - b.getMargin(), kRounding * 10) << i;
    EXPECT_NEAR(back[0].distance, forth[0].distance, kRounding * 10) << i;
    expect_near(forth[0].on_a - forth[0].on_b, forth[0].normal_on_b * forth[0].distance, kRounding * 10);
  }
  EXPECT_GT(apart, 60);
  EXPECT_GT(meet, 30);
}

TEST(MeshAnswers, OfPlanesAreThoseOfTheLowestVertex) {
  World w;
  Random random;
  shapes::Random soups_random(7);
  for (int i = 0; i < 200; ++i) {
    const Soup soup = soups::any(soups_random);
    MeshShape mesh(soup.mesh());
    btStaticPlaneShape plane(random.vector(1).normalized(), btScalar(random.uniform(-1, 1)));
    const btTransform in_world = random.transform(2), plane_in_world = random.transform(1);
    const Vec3 up = (pose_of(plane_in_world).rotation * vec3(plane.getPlaneNormal())).normalized();
    double least = kFarthest;
    for (const auto& t : soup.triangles) {
      for (const std::uint32_t v : t) {
        const Vec3 p = pose_of(in_world).rotation * soup.points[v] + pose_of(in_world).translation;
        least = std::min(least, up.dot(p - pose_of(plane_in_world).translation) - plane.getPlaneConstant());
      }
    }
    for (const bool mesh_first : {true, false}) {
      const auto points = mesh_first ? closest_points(w, mesh, in_world, plane, plane_in_world, 10)
                                     : closest_points(w, plane, plane_in_world, mesh, in_world, 10);
      ASSERT_EQ(points.size(), 1u);
      EXPECT_NEAR(points[0].distance, least - mesh.getMargin(), kRounding * 4);
      EXPECT_NEAR(vec3(points[0].normal_on_b).dot(up), mesh_first ? 1 : -1, kRounding * 4);
    }
  }
}

/// As of a hull: a margin that is no radius makes no contact, and none that is not finite.
TEST(MeshAnswers, TakeNoMarginThatIsNoRadius) {
  World w;
  const MeshModel cube = soups::box({-1, -1, -1}, {1, 1, 1}).mesh();
  for (const btScalar margin :
       {std::numeric_limits<btScalar>::quiet_NaN(), std::numeric_limits<btScalar>::infinity(), btScalar(-1), btScalar(0.04)}) {
    MeshShape odd(cube), mesh(cube), small(soups::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}).mesh());
    odd.setMargin(margin);
    HullShape hull(bodies::model(bodies::box(2, 2, 2)));
    btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
    for (btCollisionShape* other : {static_cast<btCollisionShape*>(&mesh), static_cast<btCollisionShape*>(&small),
                                    static_cast<btCollisionShape*>(&hull), static_cast<btCollisionShape*>(&plane)}) {
      for (const double height : {0.3, 0.99}) {
        EXPECT_EQ(closest_points(w, odd, at(0, 0, height), *other, at(0, 0, 0)).empty(), margin != btScalar(0.04))
            << margin << " " << other->getName();
        EXPECT_EQ(closest_points(w, *other, at(0, 0, 0), odd, at(0, 0, height)).empty(), margin != btScalar(0.04))
            << margin << " " << other->getName();
      }
    }
  }
}

// ---- Scenes ----------------------------------------------------------------------------------------------------------------

struct Motion {
  double rise = 0, speed = 0, lost = 0;  ///< the largest, along z, and the share of its speed that was lost
};
/// Without friction: comes to rest, is pushed, and slides for two seconds.
Motion slide(btCollisionShape& ground, btCollisionShape& shape, double height) {
  Dynamics d;
  d.add(ground, at(0, 0, 0)).setFriction(0);
  btRigidBody& body = d.add(shape, at(-10, -3, height), 1);
  body.setFriction(0);
  for (int step = 0; step < 120; ++step) d.step();
  body.setLinearVelocity(btVector3(5, btScalar(1.7), 0)), body.setAngularVelocity(btVector3(0, 0, 0));
  const double rest = body.getWorldTransform().getOrigin().z(), speed = body.getLinearVelocity().length();
  Motion most;
  for (int step = 0; step < 120; ++step) {
    d.step();
    most.rise = std::max(most.rise, std::abs(body.getWorldTransform().getOrigin().z() - rest));
    most.speed = std::max(most.speed, std::abs(double(body.getLinearVelocity().z())));
  }
  most.lost = 1 - body.getLinearVelocity().length() / speed;
  return most;
}

/// No inner edge of a floor is felt: whatever slides does so as on a plane.
TEST(MeshScenes, BodiesSlideAsOnOnePlane) {
  const MeshModel floor = floor_of(100, 20, flat).mesh();
  MeshShape ground(floor), brick(soups::box({-0.5, -0.4, -0.25}, {0.5, 0.4, 0.25}).mesh());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  HullShape box(bodies::model(bodies::box(0.5, 0.4, 0.25))), coin(bodies::model(bodies::float_rounded(prism(40, 0.5, 0.1))));
  btSphereShape ball(btScalar(0.4));
  btBoxShape bullets_box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.25)));
  btCapsuleShapeX capsule(btScalar(0.3), btScalar(0.8));
  struct {
    const char* name;
    btCollisionShape* shape;
    double height;
  } const bodies_of_all_kinds[] = {{"box", &box, 0.3},          {"coin", &coin, 0.15},
                                   {"sphere", &ball, 0.45},     {"btBoxShape", &bullets_box, 0.3},
                                   {"capsule", &capsule, 0.35}, {"mesh", &brick, 0.34}};
  for (const auto& [name, shape, height] : bodies_of_all_kinds) {
    const Motion on_plane = slide(plane, *shape, height), on_mesh = slide(ground, *shape, height);
    std::printf("%s: on a plane %.1e m, %.1e m/s, on the mesh %.1e m, %.1e m/s, lost %.4f\n", name, on_plane.rise,
                on_plane.speed, on_mesh.rise, on_mesh.speed, on_mesh.lost);
    EXPECT_LE(on_mesh.rise, 1.2 * on_plane.rise + 1e-5) << name;
    EXPECT_LE(on_mesh.speed, 1.2 * on_plane.speed + 1e-4) << name;
    EXPECT_LE(on_mesh.lost, 1e-4) << name;
  }
}

/// A stack of five moves no more on a mesh than on a plane, by more than the width of a margin in half a minute.
TEST(MeshScenes, AStackStandsOnAMesh) {
  MeshShape floor(floor_of(24, 4, flat).mesh()), brick(soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}).mesh());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  HullShape box(bodies::model(bodies::box(0.4, 0.3, 0.2)));
  for (btCollisionShape* shape : {static_cast<btCollisionShape*>(&box), static_cast<btCollisionShape*>(&brick)}) {
    for (btCollisionShape* ground : {static_cast<btCollisionShape*>(&plane), static_cast<btCollisionShape*>(&floor)}) {
      const double base = ground == &plane ? 0.24 : 0.28;
      double moved = 0, speed = 0;
      for (unsigned seed = 0; seed < 4; ++seed) {
        Random random{std::mt19937(seed)};
        Dynamics d;
        d.add(*ground, at(0, 0, 0));
        std::vector<btVector3> starts;
        for (int i = 0; i < 5; ++i) {
          btTransform pose = at(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), base + 0.002 + 0.48 * i);
          pose.setRotation(btQuaternion(btVector3(0, 0, 1), btScalar(random.uniform(-0.1, 0.1))));
          d.add(*shape, pose, 1).setFriction(btScalar(0.6));
          starts.push_back(pose.getOrigin());
        }
        for (int step = 0; step < 1200; ++step) d.step();
        for (std::size_t i = 0; i < 5; ++i) {
          const btVector3 p = d.bodies[i + 1]->getWorldTransform().getOrigin(), way = p - starts[i];
          moved = std::max(moved, std::hypot(double(way.x()), double(way.y())));
          speed = std::max(speed, double(d.bodies[i + 1]->getLinearVelocity().length()));
          EXPECT_NEAR(p.z(), base + 0.48 * double(i), 0.01) << i;
        }
      }
      std::printf("four stacks of five %s on a %s: moved %.4f m in 20 s, at the end %.1e m/s\n",
                  shape == &box ? "hulls" : "meshes", ground == &plane ? "plane" : "mesh", moved, speed);
      EXPECT_LE(moved, 0.03);
      EXPECT_LE(speed, 0.02);
    }
  }
}

/// Rings touch along a circle, with many points that are about equally deep and others beside them that do not touch.
TEST(MeshScenes, AStackOfRingsStands) {
  MeshShape floor(floor_of(1, 8, flat).mesh()), ring(soups::torus(24, 12, 0.3).mesh());
  for (const bool turned : {false, true}) {
    Random random{std::mt19937(5)};
    Dynamics d;
    d.add(floor, at(0, 0, 0));
    constexpr int kRings = 4;
    for (int i = 0; i < kRings; ++i) {
      btTransform pose = at(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), 0.39 + 0.69 * i);
      if (turned) pose.setRotation(btQuaternion(btVector3(0, 0, 1), btScalar(random.uniform(-3, 3))));
      d.add(ring, pose, 1);
    }
    for (int step = 0; step < 400; ++step) {
      d.step();
      ASSERT_GT(deepest(d.dispatcher), -0.06) << turned << ", step " << step;
    }
    for (int i = 0; i < kRings; ++i)
      EXPECT_NEAR(d.bodies[std::size_t(i) + 1]->getWorldTransform().getOrigin().z(), 0.38 + 0.68 * i, 0.05) << turned;
  }
}

/// The middle of a plate is behind the outer slopes of what it lies on, where it bears on a rim alone.
TEST(MeshScenes, APlateLiesOnARim) {
  MeshShape floor(floor_of(1, 8, flat).mesh()), ring(soups::torus(24, 12, 0.3).mesh());
  const auto crater = [](double x, double y) { return std::max(0., 0.3 - std::abs(std::hypot(x, y) - 1) * 0.9); };
  MeshShape rim(floor_of(48, 4, crater).mesh());
  btBoxShape plate(btVector3(btScalar(1.2), btScalar(1.2), btScalar(0.1)));
  HullShape hull(bodies::model(bodies::box(1.16, 1.16, 0.06)));
  for (btConvexShape* shape : {static_cast<btConvexShape*>(&plate), static_cast<btConvexShape*>(&hull)}) {
    Random random{std::mt19937(5)};
    Dynamics on_ring;
    on_ring.add(floor, at(0, 0, 0));
    on_ring.add(ring, at(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), 0.34), 1);
    btRigidBody& body = on_ring.add(*shape, at(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), 0.82), 1);
    for (int step = 0; step < 400; ++step) {
      on_ring.step();
      ASSERT_GT(deepest(on_ring.dispatcher), -0.1) << step;
    }
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.8, 0.08);
    for (const double height : {1., 3., 6.}) {
      Dynamics on_rim;
      on_rim.add(rim, at(0, 0, 0));
      btRigidBody& falling = on_rim.add(*shape, at(0.01, 0.02, 0.4 + height), 1);
      for (int step = 0; step < 400; ++step) on_rim.step();
      EXPECT_NEAR(falling.getWorldTransform().getOrigin().z(), 0.3 + 0.1 + 0.04, 0.04) << height;
      EXPECT_GT(deepest(on_rim.dispatcher), -0.05);
    }
  }
}

/// Nothing is allocated in a step in which bodies slide, once the memory of the first steps is there.
TEST(MeshScenes, BodiesThatSlideAllocateNothing) {
  MeshShape floor(floor_of(24, 6, flat).mesh()), brick(soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}).mesh());
  HullShape hull(bodies::model(bodies::box(0.4, 0.3, 0.2)));
  Dynamics d;
  d.add(floor, at(0, 0, 0)).setFriction(0);
  d.add(brick, at(-3, 0.03, 0.28), 1, btVector3(1, btScalar(0.3), 0));
  d.add(hull, at(-3, 2.03, 0.28), 1, btVector3(1, btScalar(0.3), 0));
  for (int step = 0; step < 120; ++step) d.step();
  const long before = allocations;
  for (int step = 0; step < 120; ++step) d.step();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(d.bodies[1]->getWorldTransform().getOrigin().x(), 0.9);
}

/// A body that a platform turns with rests on it, and its points turn with both.
TEST(MeshScenes, NormalsTurnWithBodiesAtRest) {
  MeshShape platform(soups::box({-2, -2, -0.1}, {2, 2, 0.1}).mesh()),
      brick(soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}).mesh());
  Dynamics d;
  d.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& ground = d.add(platform, at(0, 0, 0));
  ground.setCollisionFlags(ground.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  btRigidBody& body = d.add(brick, at(0, 0, 0.375), 1);
  for (int step = 0; step < 200; ++step) {
    const btTransform turn(btQuaternion(btVector3(1, 0, 0), btScalar(0.01 * step)), btVector3(0, 0, 0));
    ground.setWorldTransform(turn), body.setWorldTransform(turn * at(0, 0, 0.375));
    body.setLinearVelocity(btVector3(0, 0, 0)), body.setAngularVelocity(btVector3(0, 0, 0));
    d.world.performDiscreteCollisionDetection();
    ASSERT_EQ(d.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& manifold = *d.dispatcher.getManifoldByIndexInternal(0);
    EXPECT_EQ(manifold.getNumContacts(), 4);
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btVector3 normal = manifold.getContactPoint(i).m_normalWorldOnB;
      EXPECT_NEAR(std::abs(normal.dot(turn.getBasis() * btVector3(0, 0, 1))), 1, 1e-5) << step;
      EXPECT_NEAR(manifold.getContactPoint(i).getDistance(), -0.005, 1e-5) << step;
    }
  }
}

/// Hulls, spheres and meshes rain into a bowl at up to 10 m/s.
TEST(MeshScenes, NothingFallsThroughABowl) {
  MeshShape pan(floor_of(32, 3, bowl).mesh()), ring(soups::scaled(soups::torus(16, 8), 0.25).mesh()),
      brick(soups::box({-0.3, -0.2, -0.15}, {0.3, 0.2, 0.15}).mesh());
  HullShape box(bodies::model(bodies::box(0.2, 0.25, 0.15))), pointed(bodies::model(bodies::tetrahedron(0.25))),
      coin(bodies::model(bodies::float_rounded(prism(12, 0.3, 0.08))));
  btSphereShape ball(btScalar(0.2));
  btCollisionShape* const kinds[] = {&box, &pointed, &coin, &ball, &ring, &brick};
  Dynamics d;
  d.add(pan, at(0, 0, 0));
  Random random;
  for (int i = 0; i < 18; ++i) {
    btTransform in_world = random.transform(0.1);
    in_world.setOrigin(btVector3(btScalar(i % 3 - 1), btScalar(i / 3 % 3 - 1), btScalar(1.5 + 1.2 * (i / 9))));
    btRigidBody& body = d.add(*kinds[i % 6], in_world, 1, btVector3(0, 0, btScalar(-random.uniform(0, 10))));
    body.setDamping(0, btScalar(0.1));
  }
  int deep = 0;
  for (int step = 0; step < 480; ++step) {
    d.step();
    for (const auto& body : d.bodies) {
      const btVector3& p = body->getWorldTransform().getOrigin();
      deep += !body->isStaticObject() && p.z() < bowl(p.x(), p.y());
    }
  }
  double fastest = 0;
  for (const auto& body : d.bodies) {
    if (body->isStaticObject()) continue;
    const btVector3& p = body->getWorldTransform().getOrigin();
    EXPECT_GT(p.z(), bowl(p.x(), p.y())) << "fell through";
    EXPECT_LT(std::max(std::abs(p.x()), std::abs(p.y())), 3) << "left the bowl";
    fastest = std::max(fastest, double(body->getLinearVelocity().length()));
  }
  std::printf("bowl: %d times a centre was below it, at the end the fastest moves at %.2f m/s\n", deep, fastest);
}

/// A ring and a brick that are meshes, on each kind of ground. A ring that falls aslant goes on wobbling.
TEST(MeshScenes, MeshesComeToRest) {
  MeshShape floor(floor_of(24, 6, flat).mesh()), ring(soups::scaled(soups::torus(32, 16), 0.5).mesh()),
      brick(soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}).mesh()), slab(soups::box({-4, -4, -1}, {4, 4, 1}).mesh());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btBoxShape table(btVector3(4, 4, 1));
  HullShape hull(bodies::model(bodies::box(4, 4, 1)));
  struct {
    const char* name;
    btCollisionShape* shape;
    double top, margin;
  } const grounds[] = {{"plane", &plane, 0, 0},
                       {"btBoxShape", &table, 1, 0},
                       {"HullShape", &hull, 1, 0.04},
                       {"open mesh", &floor, 0, 0.04},
                       {"solid mesh", &slab, 1, 0.04}};
  for (const auto& [name, ground, top, margin] : grounds) {
    for (MeshShape* shape : {&ring, &brick}) {
      for (const double speed : {0., 4., 8.}) {
        Dynamics d;
        d.add(*ground, at(0, 0, -top));
        btTransform pose = at(0.3, 0.1, 1.2);
        pose.setRotation(btQuaternion(btVector3(1, 2, btScalar(0.5)).normalized(), btScalar(0.6)));
        btRigidBody& body = d.add(*shape, pose, 1, btVector3(0, 0, btScalar(-speed)));
        body.setDamping(0, btScalar(0.3));
        for (int step = 0; step < 600; ++step) d.step();
        const btVector3 p = body.getWorldTransform().getOrigin();
        EXPECT_NEAR(p.z(), 0.2 + 0.04 + margin, shape == &brick ? 1e-3 : 0.015) << name << " " << speed;
        EXPECT_LT(std::hypot(p.x(), p.y()), 1.5) << name << " " << speed;
        EXPECT_LT(body.getLinearVelocity().length(), 0.1) << name << " " << speed;
      }
    }
  }
}

/// Which vertices are beyond an open surface, and on which side of its triangles a body is, holds of these shapes alone.
TEST(MeshScenes, AnotherMeshIsMetAnew) {
  const auto walled = [](double x, double) { return x > 2 ? 4. : 0.; };  // its box reaches as high as the bodies
  MeshShape trough(floor_of(8, 4, walled).mesh()), block(soups::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).mesh()),
      raised(soups::box({-0.5, -0.5, 0.2}, {0.5, 0.5, 0.5}).mesh());
  Soup pyramid = soups::tetrahedron();
  for (Vec3& p : pyramid.points) p[2] += 2;
  MeshShape of_fewer_vertices(pyramid.mesh());
  for (MeshShape* next : {&raised, &of_fewer_vertices}) {
    Dynamics d;
    d.add(trough, at(0, 0, 0));
    btRigidBody& body = d.add(block, at(0.07, 0.13, 0.6), 1, btVector3(0, 0, -12));
    d.step(), d.step();
    ASSERT_LT(deepest(d.dispatcher), -0.1) << "its corners are not beyond the floor";
    body.setCollisionShape(next);
    d.world.performDiscreteCollisionDetection();
    EXPECT_EQ(d.dispatcher.getNumManifolds(), 1);
    EXPECT_EQ(deepest(d.dispatcher), 1) << "it is above the floor";
  }

  Soup sheet = floor_of(1, 4, flat);
  MeshShape floor(sheet.mesh());
  for (auto& [p, q, r] : sheet.triangles) std::swap(q, r);
  MeshShape turned_over(sheet.mesh());
  btSphereShape ball(btScalar(0.5));
  btCapsuleShapeZ capsule(btScalar(0.4), btScalar(0.2));
  for (btCollisionShape* shape : {static_cast<btCollisionShape*>(&ball), static_cast<btCollisionShape*>(&capsule)}) {
    Dynamics d;
    btRigidBody& ground = d.add(floor, at(0, 0, 0));
    const btRigidBody& body = d.add(*shape, at(0.3, 0.2, 0.5), 1);
    d.step();
    ASSERT_LT(deepest(d.dispatcher), 0);
    ground.setCollisionShape(&turned_over);
    for (int step = 0; step < 60; ++step) d.step();
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.54, 0.02) << shape->getName();
  }
}

/// A vertex is beyond an open surface wherever it went through: by a face, an edge or a vertex, in one step or with a stop in
/// the surface; and it is no longer when it went back. A sheet that has triangles for either side is one surface.
TEST(MeshScenes, OpenSurfacesHoldWhatGoesThroughTheirEdges) {
  Soup halves = floor_of(1, 2, flat), both_sides = halves, two_ways = halves, quarters;
  for (const auto& [p, q, r] : halves.triangles) both_sides.triangles.push_back({q, p, r});
  two_ways.add({-2, -2, 0}, {-2, 2, 0}, {2, -2, 0}), two_ways.add({2, 2, 0}, {2, -2, 0}, {-2, 2, 0});  // cut otherwise
  quarters.points = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {0, 0, 0}};
  for (std::uint32_t k = 0; k < 4; ++k) quarters.triangles.push_back({k, (k + 1) % 4, 4});
  Soup cone;  // its tip is at -0.5
  cone.points = {{0, 0, -0.5}, {0.5, 0, 0.5}, {-0.25, 0.5, 0.5}, {-0.25, -0.5, 0.5}};
  cone.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  MeshShape block(soups::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}).mesh()), pointed(cone.mesh());
  const struct {
    const char* name;
    const Soup& soup;
    bool with_block;  ///< no vertex of it is inside the block, which would leave that by the nearest side
  } sheets[] = {
      {"halves", halves, true}, {"both sides", both_sides, true}, {"two ways", two_ways, true}, {"quarters", quarters, false}};
  const std::vector<double> heights[] = {{0.03, -0.05, -0.2, -0.4, -0.6},
                                         {0.03, 0., -0.05, -0.3, -0.6},
                                         {0.03, 0., 0.03, 0., -0.05, 0.01, 0., -0.3, -0.6}};  // of the lowest point
  for (const auto& [name, sheet, with_block] : sheets) {
    MeshShape floor(sheet.mesh());
    for (MeshShape* shape : {&pointed, &block}) {
      if (shape == &block && !with_block) continue;
      for (const double aside : {0., 0.125, 0.1}) {
        for (const std::vector<double>& way : heights) {
          Dynamics d;
          d.add(floor, at(0, 0, 0));
          btRigidBody& body = d.add(*shape, at(0, 0, 2), 1);
          for (std::size_t i = 0; i < way.size(); ++i) {
            SCOPED_TRACE(testing::Message() << (shape == &block ? "block" : "cone") << " on " << name << ", " << aside
                                            << " aside, " << way[i] << " high, step " << i);
            body.setWorldTransform(at(aside, aside / 3, 0.5 + way[i]));
            body.setLinearVelocity(btVector3(0, 0, i == 0 ? 0 : btScalar((way[i] - way[i - 1]) / kStep)));
            d.world.performDiscreteCollisionDetection();
            for (int m = 0; m < d.dispatcher.getNumManifolds(); ++m) {
              const btPersistentManifold& manifold = *d.dispatcher.getManifoldByIndexInternal(m);
              const double up = manifold.getBody0() == &body ? 1 : -1;
              for (int k = 0; k < manifold.getNumContacts(); ++k)
                EXPECT_GT(up * double(manifold.getContactPoint(k).m_normalWorldOnB.z()), 0.9);
            }
            EXPECT_NEAR(deepest(d.dispatcher), way[i] - shape->getMargin() - floor.getMargin(), 1e-6);
          }
        }
      }
    }
  }
}

/// A ball that grows while its centre is beyond a surface still belongs on the side from which it came.
TEST(MeshScenes, ABodyThatGrowsKeepsItsSide) {
  MeshShape floor(floor_of(8, 4, flat).mesh());
  Dynamics d;
  d.add(floor, at(0, 0, 0));
  btSphereShape ball(btScalar(0.5));
  const btRigidBody& body = d.add(ball, at(0.3, 0.2, 0.6), 1, btVector3(0, 0, -40));
  d.step();
  ASSERT_LT(body.getWorldTransform().getOrigin().z(), 0);
  for (int step = 0; step < 60; ++step) ball.setUnscaledRadius(btScalar(0.5 + 0.001 * step)), d.step();
  EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.5);
}

/// A ring that hangs on a bar stays on it.
TEST(MeshScenes, ARingHangsOnItsPeg) {
  MeshShape ring(soups::scaled(soups::torus(32, 16, 0.2), 0.5).mesh()),
      bar_mesh(soups::box({-2, -0.1, -0.1}, {2, 0.1, 0.1}).mesh());
  HullShape bar(bodies::model(bodies::box(2, 0.1, 0.1)));
  for (btCollisionShape* peg : {static_cast<btCollisionShape*>(&bar), static_cast<btCollisionShape*>(&bar_mesh)}) {
    Dynamics d;
    d.add(*peg, at(0, 0, 0));
    btTransform pose = at(0, 0, -0.1);
    pose.setRotation(btQuaternion(btVector3(0, 1, 0), btScalar(std::numbers::pi / 2)));
    btRigidBody& body = d.add(ring, pose, 1, btVector3(0, 1, 0));
    body.setDamping(btScalar(0.1), btScalar(0.3));
    for (int step = 0; step < 600; ++step) d.step();
    const btVector3 p = body.getWorldTransform().getOrigin();
    EXPECT_NEAR(p.z(), 0.1 + 0.04 + 0.04 - 0.4, 0.05);  // the inner radius is 0.4
    EXPECT_LT(std::abs(p.x()), 1.5);
    EXPECT_LT(body.getLinearVelocity().length(), 0.2);
  }
}

/// A body that begins inside a solid is pushed out of it; one inside of a closed room whose faces look inwards stays there.
TEST(MeshScenes, SolidsPushOutAndRoomsHold) {
  const Soup walls = soups::box({-2, -2, -2}, {2, 2, 2});
  Soup room = walls;
  for (auto& [p, q, r] : room.triangles) std::swap(p, q);
  MeshShape solid(walls.mesh()), hollow(room.mesh()), brick(soups::box({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1}).mesh());
  HullShape box(bodies::model(bodies::box(0.3, 0.2, 0.1)));
  btSphereShape ball(btScalar(0.3));
  for (btCollisionShape* shape :
       {static_cast<btCollisionShape*>(&box), static_cast<btCollisionShape*>(&ball), static_cast<btCollisionShape*>(&brick)}) {
    for (MeshShape* mesh : {&solid, &hollow}) {
      Dynamics d;
      d.world.setGravity(btVector3(0, 0, 0));
      d.add(*mesh, at(0, 0, 0));
      const btRigidBody& body = d.add(*shape, at(0.1, 0.2, 1.2), 1);
      for (int step = 0; step < 240; ++step) d.step();
      const btVector3 p = body.getWorldTransform().getOrigin();
      const double outside = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
      if (mesh == &solid)
        EXPECT_GT(outside, 2) << shape->getName();
      else
        EXPECT_LT(outside, 2) << shape->getName();
    }
  }
}

/// One solid mesh inside of another leaves it by the nearest wall, as a whole and without a turn, whichever Bullet has first.
TEST(MeshScenes, SolidsPushOutWholeMeshes) {
  MeshShape walls(soups::box({-2, -2, -2}, {2, 2, 2}).mesh()),
      cube(soups::box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}).mesh()), ring(soups::scaled(soups::torus(24, 12), 0.3).mesh());
  shapes::Random random(1);
  for (int i = 0; i < 24; ++i) {
    MeshShape& shape = i % 2 == 0 ? cube : ring;
    const Vec3 start(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    const bool is_first = i % 4 < 2;
    Dynamics d;
    d.world.setGravity(btVector3(0, 0, 0));
    if (!is_first) d.add(walls, at(0, 0, 0));
    const btRigidBody& body = d.add(shape, at(start.x(), start.y(), start.z()), 1);
    if (is_first) d.add(walls, at(0, 0, 0));
    for (int step = 0; step < 240; ++step) d.step();
    const Vec3 p = vec3(body.getWorldTransform().getOrigin());
    Eigen::Index wall, nearest_wall;
    const double outside = p.cwiseAbs().maxCoeff(&wall);
    start.cwiseAbs().maxCoeff(&nearest_wall);
    EXPECT_GT(outside, 2 + (&shape == &cube ? 0.25 : 0.05)) << start.transpose() << " to " << p.transpose();
    EXPECT_LT(body.getAngularVelocity().length(), 0.5) << start.transpose();
    if (&shape == &cube) {
      EXPECT_EQ(wall, nearest_wall) << start.transpose();
    }
  }
}

/// A solid mesh as a child of a compound, whose centre of mass is then the body's.
TEST(MeshScenes, CompoundsHoldMeshes) {
  const double kEll[6][2] = {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}};  // counter-clockwise
  Soup ell;
  for (const double y : {0., 0.4}) {
    for (const auto& [x, z] : kEll) ell.points.emplace_back(x, y, z);
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t k = (i + 1) % 6;
    ell.triangles.push_back({i, 6 + k, k}), ell.triangles.push_back({i, 6 + i, 6 + k});
  }
  for (const auto& [p, q, r] : {std::array{0u, 1u, 3u}, {1u, 2u, 3u}, {0u, 3u, 5u}, {3u, 4u, 5u}})
    ell.triangles.push_back({p, q, r}), ell.triangles.push_back({6 + r, 6 + q, 6 + p});
  MeshShape shape(ell.mesh());
  ASSERT_TRUE(shape.is_solid());
  btVector3 inertia;
  const btTransform axes = shape.principal_axes(1, inertia);
  btCompoundShape compound;
  compound.addChildShape(axes.inverse(), &shape);
  MeshShape floor(floor_of(24, 6, flat).mesh());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  for (btCollisionShape* ground : {static_cast<btCollisionShape*>(&floor), static_cast<btCollisionShape*>(&plane)}) {
    Dynamics d;
    d.add(*ground, at(0, 0, 0));
    btTransform pose = axes;
    pose.setOrigin(axes.getOrigin() + btVector3(0, 0, btScalar(0.5)));
    btRigidBody& body = *d.bodies.emplace_back(std::make_unique<btRigidBody>(btScalar(1), nullptr, &compound, inertia));
    body.setWorldTransform(pose), body.setInterpolationWorldTransform(pose);
    body.setActivationState(DISABLE_DEACTIVATION);
    d.world.addRigidBody(&body);
    for (int step = 0; step < 300; ++step) d.step();
    const double margins = shape.getMargin() + (ground == &floor ? floor.getMargin() : btScalar(0));
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), axes.getOrigin().z() + margins, 0.01);
    EXPECT_LT(body.getLinearVelocity().length(), 0.02);
  }
}

// ---- Beside btGImpactMeshShape ---------------------------------------------------------------------------------------------

struct Scene {
  const char* name;
  Soup ground, body;
  double height, speed;
};

/// The same meshes, margins and solver. How deep the deepest vertex of the bodies gets below the ground, and whether they rest.
TEST(BesideBullet, MeshesInThePlaceOfGImpact) {
  const Scene scenes[] = {
      {"rings of 1 024 triangles on a flat floor of 1 152", floor_of(24, 4, flat), soups::scaled(soups::torus(32, 16), 0.5),
       0.9, 3},
      {"bricks of 12 triangles on it", floor_of(24, 4, flat), soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}), 0.9, 3},
      {"rings in a bowl of 2 048", floor_of(32, 3, bowl), soups::scaled(soups::torus(32, 16), 0.4), 1.2, 3},
      {"bricks in it", floor_of(32, 3, bowl), soups::box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}), 1.2, 3}};
  for (const Scene& scene : scenes) {
    for (const bool ours : {true, false}) {
      const auto triangles = [](const Soup& soup, btTriangleMesh& mesh) {
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
          btVector3 p[3];
          for (std::size_t k = 0; k < 3; ++k)
            p[k] = btVector3(btScalar(soup.corner(t, k)[0]), btScalar(soup.corner(t, k)[1]), btScalar(soup.corner(t, k)[2]));
          mesh.addTriangle(p[0], p[1], p[2]);
        }
      };
      btTriangleMesh ground_mesh, body_mesh;
      triangles(scene.ground, ground_mesh), triangles(scene.body, body_mesh);
      std::unique_ptr<btCollisionShape> ground, shape;
      constexpr btScalar kMargin = btScalar(0.02);
      if (ours) {
        ground = std::make_unique<MeshShape>(scene.ground.mesh()), shape = std::make_unique<MeshShape>(scene.body.mesh());
        ground->setMargin(kMargin), shape->setMargin(kMargin);
      } else {
        ground = std::make_unique<btBvhTriangleMeshShape>(&ground_mesh, true);
        ground->setMargin(kMargin);
        auto gimpact = std::make_unique<btGImpactMeshShape>(&body_mesh);
        gimpact->setMargin(kMargin);
        gimpact->updateBound();
        shape = std::move(gimpact);
      }
      Dynamics d(ours);
      if (!ours) btGImpactCollisionAlgorithm::registerAlgorithm(&d.dispatcher);
      d.add(*ground, at(0, 0, 0));
      btVector3 inertia;
      MeshShape(scene.body.mesh()).calculateLocalInertia(1, inertia);
      Random random;
      for (int i = 0; i < 4; ++i) {
        btTransform pose = random.transform(0.1);
        pose.setOrigin(
            btVector3(btScalar(1.3 * (i % 2) - 0.6), btScalar(1.3 * (i / 2) - 0.6), btScalar(scene.height + 0.2 * i)));
        btRigidBody& body = *d.bodies.emplace_back(std::make_unique<btRigidBody>(btScalar(1), nullptr, shape.get(), inertia));
        body.setWorldTransform(pose), body.setInterpolationWorldTransform(pose);
        body.setLinearVelocity(btVector3(0, 0, btScalar(-scene.speed)));
        body.setDamping(0, btScalar(0.3));
        d.world.addRigidBody(&body);
      }
      double deepest = 0, resting = 0;
      const bool is_bowl = scene.ground.points[0][2] > 0;
      const std::clock_t begin = std::clock();
      double judged = 0;
      for (int step = 0; step < 600; ++step) {
        d.step();
        const std::clock_t pause = std::clock();
        for (std::size_t i = 1; i < d.bodies.size(); ++i) {
          for (const Vec3& v : scene.body.points) {
            const btVector3 p = d.bodies[i]->getWorldTransform()(btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])));
            const double below = (is_bowl ? bowl(p.x(), p.y()) : 0) - p.z();
            deepest = std::max(deepest, below);
            if (step >= 540) resting = std::max(resting, below);
          }
        }
        judged += double(std::clock() - pause);
      }
      const double us = 1e6 * (double(std::clock() - begin) - judged) / CLOCKS_PER_SEC / 600;
      int asleep = 0, lost = 0;
      double speed = 0;
      for (std::size_t i = 1; i < d.bodies.size(); ++i) {
        const btVector3& p = d.bodies[i]->getWorldTransform().getOrigin();
        asleep += !d.bodies[i]->isActive();
        lost += p.z() < -1;
        speed = std::max(speed, double(d.bodies[i]->getLinearVelocity().length()));
      }
      std::printf("| %s | %s | %.0f | %.1f | %.1f | %d | %d | %.3f |\n", scene.name, ours ? "MeshShape" : "btGImpactMeshShape",
                  us, 1000 * deepest, 1000 * resting, asleep, lost, speed);
      if (ours) {
        EXPECT_EQ(lost, 0);
        EXPECT_LT(resting, 0.01);
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet
