// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <swiftlet/mesh_query.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "method.h"
#include "random.h"

namespace swiftlet::bench::mesh {
namespace {

using shapes::Random;

Vec3 middle(const MeshModel& m) { return (m.box_min() + m.box_max()) / 2; }

double radius(const MeshModel& m) {
  double r2 = 0;
  for (std::size_t i = 0; i < m.vertex_count(); ++i) r2 = std::max(r2, (m.vertex(i) - middle(m)).squaredNorm());
  return std::sqrt(r2);
}

Scene pair(const Mesh& a, const Mesh& b) {
  MeshModel model_a = boxes_of(a), model_b = boxes_of(b);
  const double r = std::max(radius(model_a), radius(model_b));
  return {{}, a, b, std::move(model_a), std::move(model_b), r, {}, {}};
}

/// A turn as a unit quaternion; sums, products and square roots only.
struct Turn {
  double w = 1;
  Vec3 v = Vec3::Zero();

  Mat3 matrix() const { return shapes::from_quaternion(w, v); }
  /// This one after a turn about `axis` by about `angle` radians, if it is small.
  Turn then(const Vec3& axis, double angle) const {
    const Vec3 u = axis * (angle / 2);
    const double w2 = w - u.dot(v);
    const Vec3 v2 = v + w * u + u.cross(v);
    const double length = std::sqrt(w2 * w2 + v2.squaredNorm());
    return {w2 / length, v2 / length};
  }
};

/// Turns B by `turn` and puts the middle of its box at `at` from the middle of A's, rounded to a 2^-44 of the radius.
Pose posed(const Scene& s, const Turn& turn, const Vec3& at) {
  const double unit = std::ldexp(1, std::ilogb(s.radius) - 44);
  Pose pose{turn.matrix(), {}};
  pose.translation = middle(s.model_a) + at - pose.rotation * middle(s.model_b);
  for (int k = 0; k < 3; ++k) pose.translation[k] = std::round(pose.translation[k] / unit) * unit;
  return pose;
}

constexpr double kDegree = std::numbers::pi / 180;

/// B comes from outside along a direction until the gap is as wanted; direction and B turn by so many degrees a query. Where
/// the last bit of the way leads past a ledge, the gap stays a little wider. From there it goes on by up to `deepest` r.
void add_approach(Scene& s, std::size_t count, double least, double most, std::uint64_t seed, double degrees = 1,
                  double deepest = 0) {
  Random random(seed);
  Turn turn, sky;
  turn = turn.then(random.on_sphere(), 2);
  const Vec3 axis = random.on_sphere(), pole = random.on_sphere(), start = random.on_sphere();
  for (std::size_t i = 0; i < count; ++i) {
    turn = turn.then(axis, degrees * kDegree);
    sky = sky.then(pole, degrees * kDegree);
    const Vec3 direction = (sky.matrix() * start).normalized();
    const double gap = random.uniform(least, most) * s.radius;
    double away = 2 * s.radius + gap;
    MeshSeed warm;
    constexpr int kLimit = 400;
    for (int k = 0; k < kLimit; ++k) {
      const double here = distance(s.model_a, s.model_b, posed(s, turn, direction * away), warm).upper;
      if (here <= 1.01 * gap) break;
      away -= here - gap;
    }
    if (deepest > 0) away -= random.uniform(deepest / 5, deepest) * s.radius;
    s.poses.push_back(posed(s, turn, direction * (std::round(away / s.radius * 0x1p30) * 0x1p-30 * s.radius)));
  }
}

/// Any turn, any direction, the middles from 0.25 to 1.25 of the sum of both radii apart: most are disjoint.
void add_random(Scene& s, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const double both = radius(s.model_a) + radius(s.model_b);
  for (std::size_t i = 0; i < count; ++i) {
    Turn turn;
    for (int k = 0; k < 6; ++k) turn = turn.then(random.on_sphere(), random.uniform(1, 2));
    s.poses.push_back(posed(s, turn, random.on_sphere() * (random.uniform(0.25, 1.25) * both)));
  }
}

/// B drifts and tumbles in small steps, drawn towards `home`, which may be a place where it cannot be: it then presses against
/// A. A step that would bring it nearer than the skin is halved, and if that does not help it is thrown another way.
struct Wander {
  Turn turn;
  Vec3 start, home;      ///< of the middle of B's box from that of A's
  double step, degrees;  ///< a query at most; the step in units
  double pull;           ///< the share of the step that leads home
};
void add_wander(Scene& s, std::size_t count, Wander w, std::uint64_t seed) {
  constexpr double kSkin = 1e-4;
  Random random(seed);
  MeshSeed warm;
  const auto is_free = [&](const Turn& turn, const Vec3& at) {
    return distance(s.model_a, s.model_b, posed(s, turn, at), warm).upper > kSkin * s.radius;
  };
  Vec3 at = w.start, drift = random.on_sphere(), axis = random.on_sphere();
  if (!is_free(w.turn, at)) throw std::runtime_error("a motion starts in an overlap");
  while (s.poses.size() < count) {
    constexpr int kThrows = 20, kHalvings = 6;
    bool moved = false;
    for (int throws = 0; throws < kThrows && !moved; ++throws) {
      const Vec3 way_home = w.home - at;
      const Vec3 move = (drift * (1 - w.pull) + way_home * (w.pull / std::max(w.step, way_home.norm()))) * w.step;
      double part = 1;
      for (int k = 0; k < kHalvings && !moved; ++k, part /= 2) {
        const Turn next = w.turn.then(axis, part * w.degrees * kDegree);
        moved = is_free(next, at + part * move);
        if (moved) w.turn = next, at += part * move;
      }
      if (!moved || part < 0.5) drift = random.in_ball(), axis = random.on_sphere();
    }
    s.poses.push_back(posed(s, w.turn, at));
  }
}

/// The upper sheet is a scan of the lower one's form: everywhere near where it lies on it.
void add_shifting(Scene& s, std::size_t count) {
  constexpr double kGap = 0.003, kSlope = 2.4;  // the steepest flank of a tooth
  for (std::size_t i = 0; i < count; ++i) {
    const double t = double(i) / double(count), shift = 0.04 * std::sin(2 * std::numbers::pi * t);
    s.poses.push_back({Mat3::Identity(), Vec3(shift, 0, kGap + kSlope * std::fabs(shift)).cast<float>().cast<double>()});
  }
}

void add_opening(Scene& s, std::size_t count) {
  constexpr double kGap = 0.003, kWidest = 20 * kDegree;
  const Vec3 hinge(0, -0.6, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = double(i) / double(count), angle = kWidest * (1 - std::cos(2 * std::numbers::pi * t)) / 2;
    const Mat3 turn = shapes::from_quaternion(std::cos(angle / 2), Vec3(std::sin(angle / 2), 0, 0));
    s.poses.push_back({turn, (hinge - turn * hinge + Vec3(0, 0, kGap)).cast<float>().cast<double>()});
  }
}

/// B turns by up to `tilt` degrees and shifts by up to `shift` in any direction from where it is placed; of these poses those
/// are taken in which the surfaces cross.
void add_crossing(Scene& s, std::size_t count, const Turn& turn, const Vec3& at, double tilt, double shift,
                  std::uint64_t seed) {
  Random random(seed);
  while (s.poses.size() < count) {
    const Pose pose = posed(s, turn.then(random.on_sphere(), random.uniform(0, tilt) * kDegree), at + shift * random.in_ball());
    if (distance(s.model_a, s.model_b, pose).upper == 0) s.poses.push_back(pose);
  }
  s.stance = Stance::Deep;
}

constexpr double kNearLeast = 0.0005, kNearMost = 0.002, kFarLeast = 0.5, kFarMost = 1.5, kDeepest = 0.05;
constexpr double kSlow = 0.1;  // degrees a query
enum Motion { Near, Far, Any, Pressed, Slow };

void add(Scene& s, Motion motion, std::size_t count) {
  constexpr std::uint64_t kSeed = 22;
  if (motion == Near) add_approach(s, count, kNearLeast, kNearMost, kSeed);
  if (motion == Far) add_approach(s, count, kFarLeast, kFarMost, kSeed);
  if (motion == Any) add_random(s, count, kSeed);
  if (motion == Pressed) add_approach(s, count, kNearLeast, kNearMost, kSeed, 1, kDeepest);
  if (motion == Slow) add_approach(s, count, kNearLeast, kNearMost, kSeed, kSlow);
  s.stance = motion == Near ? Stance::Near : motion == Pressed ? Stance::Pressed : Stance::Any;
}

struct Maker {
  std::string name;
  std::function<std::optional<Scene>(const std::filesystem::path& meshes, std::size_t count)> make;
};

std::vector<Maker> makers() {
  std::vector<Maker> all;
  const auto of_bodies = [&](std::string name, auto make) {
    all.push_back({std::move(name),
                   [make](const std::filesystem::path&, std::size_t count) -> std::optional<Scene> { return make(count); }});
  };
  of_bodies("tori", [](std::size_t count) {
    Scene s = pair(torus({.around = 50, .across = 20, .bend = 0.25}), torus({.around = 50, .across = 20, .wrinkle = 0.25}));
    const Turn upright{std::sqrt(0.5), Vec3(std::sqrt(0.5), 0, 0)};
    add_wander(s, count, {upright, Vec3(1, 0, 0.2), Vec3(1.5, 0.5, 0.2), 0.02, 1, 0.3}, 1);
    return s;
  });
  of_bodies("cup-spoon", [](std::size_t count) {
    Scene s = pair(cup(), spoon());
    add_wander(s, count, {{}, Vec3(0, 0, 1.4), Vec3(0.5, 0, -0.3), 0.02, 1, 0.6}, 2);
    return s;
  });
  for (const bool large : {true, false}) {
    of_bodies(large ? "peg-large-ring" : "peg-small-ring", [large](std::size_t count) {
      Scene s = pair(spiral_peg(), torus({.around = 50, .across = 20, .middle = large ? 1.6 : 0.8, .bend = 0.1}));
      add_wander(s, count, {{}, Vec3(0, 0, 1), Vec3(2, 0, -2), 0.03, 1, 0.5}, 3);
      return s;
    });
  }
  of_bodies("teeth-shifting", [](std::size_t count) {
    Scene s = pair(teeth(1), teeth(2));
    add_shifting(s, count);
    return s;
  });
  of_bodies("teeth-opening", [](std::size_t count) {
    Scene s = pair(teeth(1), teeth(2));
    add_opening(s, count);
    return s;
  });
  const auto of_motions = [&](const std::string& name, std::initializer_list<Motion> motions, auto make) {
    for (const Motion motion : motions) {
      constexpr const char* kNames[] = {"near", "far", "random", "pressed", "slow"};
      all.push_back({name + "-" + kNames[motion],
                     [make, motion](const std::filesystem::path& meshes, std::size_t count) -> std::optional<Scene> {
                       std::optional<Scene> s = make(meshes);
                       if (s) add(*s, motion, count);
                       return s;
                     }});
    }
  };
  const auto of_files = [](const char* a, const char* b) {
    return [a, b](const std::filesystem::path& meshes) -> std::optional<Scene> {
      if (!std::filesystem::exists(meshes / a) || !std::filesystem::exists(meshes / b)) return std::nullopt;
      const Result<Mesh> mesh_a = read_mesh(meshes / a), mesh_b = read_mesh(meshes / b);
      if (!mesh_a || !mesh_b) throw std::runtime_error((mesh_a ? mesh_b : mesh_a).error().message);
      return pair(mesh_a.value(), mesh_b.value());
    };
  };
  of_motions("elephant", {Near, Far, Any, Pressed, Slow}, of_files("elephant.off", "elephant.off"));
  of_motions("bunny", {Near, Far, Any, Pressed, Slow}, of_files("bunny.off", "bunny.off"));
  of_motions("torus400", {Near, Any, Pressed}, [](const std::filesystem::path&) -> std::optional<Scene> {
    const Mesh mesh = torus({.around = 20, .across = 10});
    return pair(mesh, mesh);
  });
  of_motions("comb-frame", {Near, Any, Pressed},
             [](const std::filesystem::path&) -> std::optional<Scene> { return pair(comb(), frame()); });
  of_motions("fetch", {Near, Any, Pressed, Slow}, of_files("fetch_base.stl", "fetch_gripper.stl"));
  of_motions("ur10", {Near, Any, Pressed}, of_files("ur10_forearm.obj", "ur10_wrist2.obj"));
  of_bodies("tori-linked", [](std::size_t count) {
    Scene s = pair(torus({.around = 50, .across = 20, .bend = 0.25}), torus({.around = 50, .across = 20, .wrinkle = 0.25}));
    add_crossing(s, count, {std::sqrt(0.5), Vec3(std::sqrt(0.5), 0, 0)}, Vec3(1, 0, 0.2), 30, 0.6, 4);
    return s;
  });
  of_bodies("gears-meshed", [](std::size_t count) {
    Scene s = pair(gear(), gear());
    add_crossing(s, count, {}, Vec3(1.7, 0, 0), 6, 0.2, 5);
    return s;
  });
  const auto bunnies = of_files("bunny.off", "bunny.off");
  all.push_back({"bunny-in-bunny", [bunnies](const std::filesystem::path& meshes, std::size_t count) {
                   std::optional<Scene> s = bunnies(meshes);
                   if (s) add_crossing(*s, count, {}, Vec3::Zero(), 180, 0.4 * s->radius, 6);
                   return s;
                 }});
  return all;
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const Maker& maker : makers()) names.push_back(maker.name);
  return names;
}

std::optional<Scene> make_scene(const std::string& name, const std::filesystem::path& meshes, std::size_t poses) {
  for (const Maker& maker : makers()) {
    if (maker.name != name) continue;
    std::optional<Scene> scene = maker.make(meshes, poses);
    if (scene) scene->name = name;
    return scene;
  }
  throw std::runtime_error("no scene is called " + name);
}

}  // namespace swiftlet::bench::mesh
