// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies that stand on each other in Bullet, until they fall: with swiftlet's hull pairs, with Bullet's own hulls and, where
// the bodies are boxes, with Bullet's boxes. Knows Bullet's dynamics and models; nothing of how pairs are answered.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet::stack {

/// Who answers the pairs. Everything else is equal: masses, inertia, outer sizes, margins, friction, solver, time step.
enum class Shapes : std::uint8_t { Swiftlet, Hulls, Boxes };
const char* name(Shapes shapes);

/// A body at its place before a start shakes it. Lengths in metres, z up.
struct Placing {
  std::shared_ptr<const Model> model;
  Vec3 position;
  Mat3 rotation = Mat3::Identity();
  double yaw = 0;  ///< radians, after `rotation`
};

/// Bodies on a floor that ends at z = 0.
struct Scene {
  std::string name;
  std::vector<Placing> placings;
  bool are_boxes = false;    ///< each body is a box along its axes
  bool starts_high = false;  ///< the bodies fall before they rest; none can fall down any more
  Vec3 pen = Vec3::Zero();   ///< half the sides of walls around, none if 0
};

/// A tower of ten prisms of radius 0.5 and height 0.5, each turned by `twist` against the one below.
Scene tower(std::uint32_t sides, double twist);
Scene wall();     ///< six rows of bricks, joints staggered
Scene pyramid();  ///< rows of 7 to 1 boxes
Scene pile();     ///< 40 boxes and 12-sided prisms that fall into a pen
/// Real links, each on its largest facet, a box on top of each. Throws std::runtime_error where `meshes` lacks them.
Scene links(const std::filesystem::path& meshes);

/// What became of one start. Means are over the steps until the fall.
struct Outcome {
  int stood = 0;  ///< steps until one body lay half its half height lower, or leaned by 30 degrees; `steps` where none did
  bool fell = false;
  double drift = 0;    ///< metres: the farthest that a body that stood moved sideways from its place
  double energy = 0;   ///< joules per body: mean kinetic energy over the last quarter
  double asleep = 0;   ///< share of the bodies that Bullet would have let sleep at the end
  double step_us = 0;  ///< processor time
  double kept = 0;     ///< share of the contact points that were there the step before
  double points = 0;   ///< contact points per touching pair
  std::uint64_t hash = 0;
};

/// Bullet's scale-independent settings that a run may vary.
struct Setting {
  int iterations = 10;  ///< of the solver; Bullet's default
  int steps = 1200;     ///< of 1/60 s
};

/// Starts the scene with each body shaken by up to 1 mm and 1e-3 radians, as `seed` says.
Outcome run(const Scene& scene, const Setting& setting, Shapes shapes, std::uint64_t seed);

}  // namespace swiftlet::stack
