// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <optional>

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletDynamicsCommon.h>
#include <Eigen/Geometry>

#include <swiftlet/build.h>
#include <swiftlet/bullet.h>
#include <swiftlet/query.h>

#include "shapes.h"

namespace swiftlet::pile {
namespace {

using bullet::HullPairs;
using bullet::HullShape;
constexpr double kGravity = 9.81;
constexpr int kJudgedEvery = 10;

/// Of the processor, not of the wall: other programs on the machine count less.
double microseconds(std::clock_t since) { return 1e6 * double(std::clock() - since) / CLOCKS_PER_SEC; }

/// Bullet's dispatcher with a clock.
class TimedDispatcher final : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;
  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    const std::clock_t begin = std::clock();
    btCollisionDispatcher::dispatchAllCollisionPairs(pairs, info, dispatcher);
    spent_us += microseconds(begin);
  }
  double spent_us = 0;
};

struct BodyStart {
  const Model* model;
  btTransform in_world;
  btVector3 velocity;
};

/// Everything that falls, and what it falls on: boxes, mass 0.
struct Start {
  std::vector<Model> models;
  std::vector<BodyStart> moving, fixed;
};

Model built(const Mesh& mesh) { return std::move(build(mesh)).value().model; }

/// Every point has its opposite, so that the centre of mass is the origin.
Model ellipsoid(const Vec3& semi_axes, std::uint32_t vertices, shapes::Random& random) {
  std::vector<Vec3> points;
  while (points.size() < vertices) {
    points.push_back(random.on_sphere().cwiseProduct(semi_axes));
    points.push_back(-points.back());
  }
  return std::move(build(points)).value().model;
}

btVector3 vector_of(const Vec3& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }

btTransform at(const Vec3& p) { return btTransform(btQuaternion::getIdentity(), vector_of(p)); }

/// A floor of 200 m, and around a pile four walls 6 m apart.
void add_pen(Start& start, Motion motion) {
  const Model* const floor = &start.models.emplace_back(built(shapes::box({200, 200, 2})));
  start.fixed.push_back({floor, at({0, 0, -1}), btVector3(0, 0, 0)});
  if (motion == Motion::Roll) return;
  const Model* const wall = &start.models.emplace_back(built(shapes::box({2, 40, 40})));
  const Model* const side = &start.models.emplace_back(built(shapes::box({40, 2, 40})));
  for (const double s : {-1., 1.}) {
    start.fixed.push_back({wall, at({4 * s, 0, 20}), btVector3(0, 0, 0)});
    start.fixed.push_back({side, at({0, 4 * s, 20}), btVector3(0, 0, 0)});
  }
}

Start start_of(const Scene& scene, std::uint64_t seed) {
  Start start;
  start.models.reserve(scene.bodies + 3);  // bodies point into it
  add_pen(start, scene.motion);
  shapes::Random random(seed);
  for (int i = 0; i < scene.bodies; ++i) {
    const bool rolls = scene.motion == Motion::Roll;
    const Vec3 axes = rolls ? Vec3(1, 0.97, 0.94) : Vec3(1, random.uniform(0.4, 1), random.uniform(0.4, 1));
    const std::uint32_t vertices = scene.vertices[i % scene.vertices.size()];
    const Model* const model = &start.models.emplace_back(ellipsoid(0.5 * axes, vertices, random));

    const int layer = i / 9;
    Vec3 place(2.2 * (i % 3 - 1) + random.uniform(-0.4, 0.4), 2.2 * (i / 3 % 3 - 1) + random.uniform(-0.4, 0.4),
               1.5 + 1.3 * layer);
    btVector3 velocity(0, 0, 0);
    if (rolls) {
      const int rank = i / 8;
      place = Vec3(-12 + 1.5 * rank, 2.5 * (i % 8) - 9, 0.56);
      velocity = btVector3(btScalar(2 + 0.5 * (i % 3)), 0, 0);
    }
    btTransform in_world = at(place);
    const Mat3 r = random.rotation();
    in_world.setBasis(btMatrix3x3(btScalar(r(0, 0)), btScalar(r(0, 1)), btScalar(r(0, 2)), btScalar(r(1, 0)), btScalar(r(1, 1)),
                                  btScalar(r(1, 2)), btScalar(r(2, 0)), btScalar(r(2, 1)), btScalar(r(2, 2))));
    start.moving.push_back({model, in_world, velocity});
  }
  return start;
}

Pose pose_of(const btTransform& t) {
  // Through a quaternion in double: the query as such refuses what single precision leaves of a rotation.
  const btQuaternion q = t.getRotation();
  Pose pose;
  pose.rotation = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
  pose.translation = Vec3(t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z());
  return pose;
}

/// Of what is not 0: the fixed bodies are.
double median(std::vector<double> values) {
  std::erase(values, 0.);
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

class World {
 public:
  World(const Start& start, bool with_swiftlet) {
    if (with_swiftlet) hull_pairs_.emplace(dispatcher_);
    world_.setGravity(btVector3(0, 0, btScalar(-kGravity)));
    for (const BodyStart& body : start.fixed) add(body, 0);
    for (const BodyStart& body : start.moving) add(body, btScalar(body.model->volume()));
    energy_at_start_ = energy_ = energy();
  }
  ~World() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void step(bool resting) {
    dispatcher_.spent_us = 0;
    const std::clock_t begin = std::clock();
    world_.stepSimulation(btScalar(1) / 60, 0);
    sums_.step_us += microseconds(begin);
    sums_.narrowphase_us += dispatcher_.spent_us;
    sums_.pairs += broadphase_.getOverlappingPairCache()->getNumOverlappingPairs();
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      sums_.contacts += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts();
    }
    const double before = std::exchange(energy_, energy());
    sums_.energy_gained += std::max(0., energy_ - before);
    if (resting) add_jitter();
    if (++steps_ % kJudgedEvery == 0) judge();
  }

  Measures measures() const {
    Measures m = sums_;
    for (double* mean : {&m.step_us, &m.narrowphase_us, &m.pairs, &m.contacts}) *mean /= steps_;
    m.penetration = penetrating_ ? sums_.penetration / penetrating_ : 0;
    m.jitter = std::sqrt(median(speed2_) / std::max(1, resting_steps_));
    m.energy_gained /= energy_at_start_;
    for (const auto& body : bodies_) {
      if (body->isStaticObject()) continue;
      const btVector3& p = body->getWorldTransform().getOrigin();
      m.height += p.z() / moving_count_;
      for (int axis = 0; axis < 3; ++axis) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &p[axis], sizeof(btScalar));
        m.hash = (m.hash ^ bits) * 0x100000001b3u;
      }
    }
    return m;
  }

 private:
  void add(const BodyStart& start, btScalar mass) {
    HullShape& shape = *shapes_.emplace_back(std::make_unique<HullShape>(*start.model));
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody& body = *bodies_.emplace_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    body.setWorldTransform(start.in_world);
    body.setInterpolationWorldTransform(start.in_world);
    body.setLinearVelocity(start.velocity);
    body.setActivationState(DISABLE_DEACTIVATION);  // sleep would hide the jitter
    moving_count_ += mass > 0;
    world_.addRigidBody(&body);
  }

  double energy() const {
    double sum = 0;
    for (const auto& body : bodies_) {
      if (body->isStaticObject()) continue;
      const double mass = 1 / body->getInvMass();
      const btVector3 spin = body->getAngularVelocity();
      sum += mass * (0.5 * body->getLinearVelocity().length2() + kGravity * body->getWorldTransform().getOrigin().z());
      sum += 0.5 * spin.dot(body->getInvInertiaTensorWorld().inverse() * spin);
    }
    return sum;
  }

  void add_jitter() {
    speed2_.resize(bodies_.size());
    ++resting_steps_;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const btRigidBody& body = *bodies_[i];
      speed2_[i] += body.getLinearVelocity().length2() + 0.25 * body.getAngularVelocity().length2();  // at radius 0.5
    }
  }

  /// Where the pairs that Bullet looks at really are.
  void judge() {
    const btBroadphasePairArray& pairs = broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      const auto& a = *static_cast<const btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
      const auto& b = *static_cast<const btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
      const auto& hull_a = *static_cast<const HullShape*>(a.getCollisionShape());
      const auto& hull_b = *static_cast<const HullShape*>(b.getCollisionShape());
      const Answer hulls =
          distance(hull_a.model(), hull_b.model(), relative(pose_of(a.getWorldTransform()), pose_of(b.getWorldTransform())));
      double gap = hulls.lower;
      if (hulls.verdict == Verdict::Overlapping) {
        ++sums_.overlaps;
        btGjkEpaSolver2::sResults results;
        btGjkEpaSolver2::Penetration(&hull_a, a.getWorldTransform(), &hull_b, b.getWorldTransform(),
                                     b.getWorldTransform().getOrigin() - a.getWorldTransform().getOrigin(), results, false);
        gap = std::min(0., double(results.distance));
      }
      const double penetration = hull_a.getMargin() + hull_b.getMargin() - gap;
      if (penetration <= 0) continue;
      ++penetrating_;
      sums_.penetration += penetration;
      sums_.worst_penetration = std::max(sums_.worst_penetration, penetration);
    }
  }

  btDefaultCollisionConfiguration configuration_;
  TimedDispatcher dispatcher_{&configuration_};
  std::optional<HullPairs> hull_pairs_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<HullShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;

  Measures sums_;
  std::vector<double> speed2_;  // per body, summed over the last quarter
  int steps_ = 0, resting_steps_ = 0, moving_count_ = 0, penetrating_ = 0;
  double energy_at_start_ = 0, energy_ = 0;
};

}  // namespace

std::vector<Scene> scenes() {
  return {{"pile of 20 vertices", Motion::Pile, {20}, 60},
          {"pile of 200 vertices", Motion::Pile, {200}, 60},
          {"pile of 2000 vertices", Motion::Pile, {2000}, 60},
          {"pile of 20 to 2000 vertices", Motion::Pile, {20, 60, 200, 600, 2000}, 60},
          {"roll of 500 vertices", Motion::Roll, {500}, 32}};
}

std::array<Measures, 2> run(const Scene& scene, int steps, std::uint64_t seed) {
  const Start start = start_of(scene, seed);
  World with_swiftlet(start, true), bullets(start, false);
  for (int i = 0; i < steps; ++i) {
    const bool resting = i >= steps - steps / 4;
    World& first = i % 2 ? with_swiftlet : bullets;
    World& second = i % 2 ? bullets : with_swiftlet;
    first.step(resting);
    second.step(resting);
  }
  return {with_swiftlet.measures(), bullets.measures()};
}

}  // namespace swiftlet::pile
