// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// An arm of two links among obstacles, all ellipsoids of about 2 000 triangles. Knows nothing of queries or planners.
#pragma once

#include <array>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace planner {

/// Radians: yaw and pitch of the shoulder, which is the origin, and pitch of the elbow.
using Angles = std::array<double, 3>;

struct Obstacle {
  swiftlet::Model model;
  swiftlet::Pose in_world;
};

struct Scene {
  std::array<swiftlet::Model, 2> link;  ///< along x from its joint, of length 1
  std::vector<Obstacle> obstacles;
};
Scene make_scene();

/// The links' poses.
std::array<swiftlet::Pose, 2> links_in_world(const Angles& angles);

/// For each link how far any of its points moves at most between two sets of angles, each of which turns steadily.
std::array<double, 2> longest_ways(const Angles& from, const Angles& to);

}  // namespace planner
