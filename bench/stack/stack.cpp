// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>
#include <stdexcept>

#include <Eigen/Geometry>

#include <swiftlet/build.h>

#include "in_bullet.h"
#include "shapes.h"

namespace swiftlet::stack {
namespace {

constexpr double kFallen = 0.5, kLeaning = 30 * 3.14159265358979 / 180;

std::shared_ptr<const Model> built(const Mesh& mesh) {
  return std::make_shared<const Model>(std::move(build(mesh.points)).value().model);
}

btMatrix3x3 matrix_of(const Mat3& r) {
  return {btScalar(r(0, 0)), btScalar(r(0, 1)), btScalar(r(0, 2)), btScalar(r(1, 0)), btScalar(r(1, 1)),
          btScalar(r(1, 2)), btScalar(r(2, 0)), btScalar(r(2, 1)), btScalar(r(2, 2))};
}

/// Height of a body above its lowest point, as it is placed.
double half_height(const Placing& placing) {
  double lowest = 0;
  for (const Vertex& v : placing.model->level(0).view.vertices) lowest = std::min(lowest, (placing.rotation * point_of(v))[2]);
  return -lowest;
}

/// Calls with three corners of each triangle of level 0, counter-clockwise from outside, and its facet.
template <class Visit>
void each_triangle(const Model& model, Visit visit) {
  const ConvexView& view = model.level(0).view;
  for (std::uint32_t face = 0; face < view.face_first.size(); ++face) {
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    int i = 0;
    for (const std::uint32_t v : FaceLoop(view, face)) {
      const Vec3 p = point_of(view.vertices[v]);
      if (i > 1) visit(face, first, last, p);
      (i == 0 ? first : last) = p;
      ++i;
    }
  }
}

Vec3 centre_of_mass(const Model& model) {
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  each_triangle(model, [&](std::uint32_t, const Vec3& p, const Vec3& q, const Vec3& r) {
    const double six = p.dot(q.cross(r));
    sum += six / 4 * (p + q + r), volume += six;
  });
  return sum / volume;
}

/// The outward normal of the facet on which a body about the origin stands the firmest: the least distance from the place below
/// the origin to a side of the facet is the largest.
Vec3 steadiest_facet(const Model& model) {
  const ConvexView& view = model.level(0).view;
  std::vector<Vec3> areas(view.face_first.size(), Vec3::Zero());
  each_triangle(model,
                [&](std::uint32_t face, const Vec3& p, const Vec3& q, const Vec3& r) { areas[face] += (q - p).cross(r - p); });
  Vec3 best = Vec3::UnitZ();
  double firmest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t face = 0; face < areas.size(); ++face) {
    const Vec3 n = areas[face].normalized();
    std::vector<Vec3> loop;
    for (const std::uint32_t v : FaceLoop(view, face)) loop.push_back(point_of(view.vertices[v]));
    double firm = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 side = loop[(i + 1) % loop.size()] - loop[i];
      firm = std::min(firm, n.cross(side).normalized().dot(-loop[i]));
    }
    if (firm > firmest) firmest = firm, best = n;
  }
  return best;
}

class World {
 public:
  World(const Scene& scene, const Setting& setting, Shapes shapes, std::uint64_t seed)
      : scene_(scene), setting_(setting), in_(shapes) {
    in_.world.getSolverInfo().m_numIterations = setting.iterations;
    add_fixed(Vec3(20, 20, 1), Vec3(0, 0, -1 - kMargin));
    if (scene.pen != Vec3::Zero()) {
      for (const double s : {-1., 1.}) {
        add_fixed(Vec3(1, 10, 10), Vec3(s * (scene.pen[0] + 1), 0, 0));
        add_fixed(Vec3(10, 1, 10), Vec3(0, s * (scene.pen[1] + 1), 0));
      }
    }
    shapes::Random random(seed);
    for (const Placing& placing : scene.placings) {
      const Vec3 shake(random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3), random.uniform(0, 1e-4));
      const Mat3 turn = shapes::rotation(Vec3::UnitZ(), placing.yaw + random.uniform(-1e-3, 1e-3));
      const btTransform start(matrix_of(turn * placing.rotation), vector_of(placing.position + shake));
      moving_.push_back({&in_.add(placing.model, start, true), start, half_height(placing)});
    }
  }

  Outcome run() {
    const int rest_from = setting_.steps * 3 / 4;
    int resting = 0;
    while (outcome_.stood < setting_.steps && !outcome_.fell) {
      step();
      if (++outcome_.stood > rest_from) outcome_.energy += kinetic_energy() / double(moving_.size()), ++resting;
    }
    if (resting > 0) outcome_.energy /= resting;
    outcome_.step_us /= outcome_.stood;
    outcome_.kept = points_ > 0 ? kept_ / points_ : 0;
    outcome_.points = pairs_ > 0 ? points_ / pairs_ : 0;
    for (const Moving& m : moving_) {
      const btVector3 moved = m.body->getWorldTransform().getOrigin() - (scene_.starts_high ? m.halfway : m.start.getOrigin());
      outcome_.drift = std::max(outcome_.drift, std::hypot(double(moved.x()), double(moved.y())));
      outcome_.asleep += double(m.calm_steps >= 120) / double(moving_.size());
      for (int axis = 0; axis < 3; ++axis) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &m.body->getWorldTransform().getOrigin()[axis], sizeof(btScalar));
        outcome_.hash = (outcome_.hash ^ bits) * 0x100000001b3u, outcome_.hash ^= outcome_.hash >> 29;
      }
    }
    return outcome_;
  }

 private:
  struct Moving {
    btRigidBody* body;
    btTransform start;
    double half_height;
    int calm_steps = 0;  ///< in a row, as Bullet counts them before it lets a body sleep
    btVector3 halfway{0, 0, 0};
  };

  void add_fixed(const Vec3& half, const Vec3& position) {
    in_.add(built(shapes::box(2 * half)), btTransform(btMatrix3x3::getIdentity(), vector_of(position)), false);
  }

  void step() {
    const std::clock_t begin = std::clock();
    in_.step();
    outcome_.step_us += 1e6 * double(std::clock() - begin) / CLOCKS_PER_SEC;
    for (int i = 0; i < in_.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *in_.dispatcher.getManifoldByIndexInternal(i);
      pairs_ += manifold.getNumContacts() > 0;
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        ++points_;
        kept_ += manifold.getContactPoint(k).getLifeTime() > 1;
      }
    }
    for (Moving& m : moving_) {
      const btTransform& now = m.body->getWorldTransform();
      const bool calm = m.body->getLinearVelocity().length2() < 0.64 && m.body->getAngularVelocity().length2() < 1;
      m.calm_steps = calm ? m.calm_steps + 1 : 0;
      if (outcome_.stood == setting_.steps / 2) m.halfway = now.getOrigin();
      if (scene_.starts_high) continue;
      const btVector3 up_there = m.start.getBasis().transpose() * btVector3(0, 0, 1), up = now.getBasis() * up_there;
      outcome_.fell |= double(m.start.getOrigin().z() - now.getOrigin().z()) > kFallen * m.half_height ||
                       double(up.z()) < std::cos(kLeaning);
    }
  }

  double kinetic_energy() const {
    double sum = 0;
    for (const Moving& m : moving_) {
      const btVector3 spin = m.body->getAngularVelocity();
      sum += 0.5 * double(m.body->getLinearVelocity().length2()) / double(m.body->getInvMass()) +
             0.5 * double(spin.dot(m.body->getInvInertiaTensorWorld().inverse() * spin));
    }
    return sum;
  }

  const Scene& scene_;
  const Setting setting_;
  InBullet in_;
  std::vector<Moving> moving_;
  Outcome outcome_;
  double points_ = 0, kept_ = 0, pairs_ = 0;
};

/// Stands on what ends at `height`, margins between.
Placing standing(const std::shared_ptr<const Model>& model, double x, double y, double height, double yaw = 0) {
  Placing placing{model, Vec3(x, y, 0), Mat3::Identity(), yaw};
  placing.position[2] = height + kMargin + half_height(placing);
  return placing;
}

}  // namespace

const char* name(Shapes shapes) {
  constexpr const char* kNames[] = {"swiftlet", "Bullet's hulls", "Bullet's boxes"};
  return kNames[int(shapes)];
}

Scene tower(std::uint32_t sides, double twist) {
  constexpr double kHeight = 0.5;
  Scene scene{std::to_string(sides) + "-gon tower" + (twist != 0 ? " twisted" : ""), {}};
  scene.are_boxes = sides == 4;
  const auto model =
      built(sides == 4 ? shapes::box({std::sqrt(0.5), std::sqrt(0.5), kHeight}) : shapes::prism(sides, 0.5, kHeight));
  for (int i = 0; i < 10; ++i) scene.placings.push_back(standing(model, 0, 0, i * (kHeight + 2 * kMargin), i * twist));
  return scene;
}

Scene wall() {
  Scene scene{"brick wall", {}, true};
  const auto brick = built(shapes::box({0.8, 0.4, 0.4})), half = built(shapes::box({0.36, 0.4, 0.4}));
  constexpr double kPitch = 0.8 + 2 * kMargin;
  for (int row = 0; row < 6; ++row) {
    const double height = row * (0.4 + 2 * kMargin), shift = row % 2 ? 0.5 : 0;
    for (int i = 0; i + row % 2 < 6; ++i) scene.placings.push_back(standing(brick, (i + shift) * kPitch, 0, height));
    if (row % 2 == 0) continue;
    for (const double end : {-0.25, 5.25}) scene.placings.push_back(standing(half, end * kPitch, 0, height));
  }
  return scene;
}

Scene pyramid() {
  Scene scene{"pyramid", {}, true};
  const auto box = built(shapes::box({0.5, 0.5, 0.5}));
  for (int row = 0; row < 7; ++row)
    for (int i = 0; i < 7 - row; ++i)
      scene.placings.push_back(standing(box, 0.7 * (i + 0.5 * row), 0, row * (0.5 + 2 * kMargin)));
  return scene;
}

Scene pile() {
  Scene scene{"pile", {}};
  scene.starts_high = true;
  scene.pen = Vec3(1.5, 1.5, 0);
  const std::shared_ptr<const Model> bodies[] = {built(shapes::box({0.5, 0.5, 0.5})), built(shapes::prism(12, 0.3, 0.4))};
  shapes::Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Vec3 place(0.9 * (i % 3 - 1), 0.9 * (i / 3 % 3 - 1), 0.6 + 0.8 * (i / 9));
    scene.placings.push_back({bodies[i % 2], place, random.rotation()});
  }
  return scene;
}

Scene links(const std::filesystem::path& meshes) {
  Scene scene{"links", {}};
  constexpr const char* kFiles[] = {"fetch_base.stl",  "fetch_head_pan.stl", "fetch_gripper.stl",
                                    "fetch_wheel.stl", "ur10_wrist2.obj",    "ur10_forearm.obj"};
  for (const char* file : kFiles) {
    const auto mesh = read_mesh(meshes / file);
    if (!mesh) throw std::runtime_error(mesh.error().message);
    const Model read = *built(mesh.value());
    const Vec3 middle = centre_of_mass(read);
    std::vector<Vec3> points;
    for (const Vertex& v : read.level(0).view.vertices) points.push_back((point_of(v) - middle) * (0.5 / read.radius()));
    const auto model = std::make_shared<const Model>(std::move(build(points)).value().model);
    Placing link{model, Vec3(1.5 * double(scene.placings.size()), 0, 0)};
    link.rotation = Eigen::Quaterniond::FromTwoVectors(steadiest_facet(*model), -Vec3::UnitZ()).toRotationMatrix();
    link.position[2] = kMargin + half_height(link);
    scene.placings.push_back(link);
  }
  return scene;
}

Outcome run(const Scene& scene, const Setting& setting, Shapes shapes, std::uint64_t seed) {
  return World(scene, setting, shapes, seed).run();
}

}  // namespace swiftlet::stack
