// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The arm and the plant of RECIPES.md beside FCL's BVHModel: the same trajectory, exact distances and verdicts, microseconds of
// the processor for a link in a pose.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <swiftlet/build_mesh.h>
#include <swiftlet/mesh_query.h>

#include "../../tests/consumer/recipes/arm.h"

namespace {

using namespace swiftlet;
using Tree = fcl::BVHModel<fcl::OBBRSSd>;

constexpr int kPoses = 1000, kLinks = 3;

Tree tree(const Mesh& mesh) {
  Tree made;
  std::vector<fcl::Triangle> triangles;
  for (const auto& [p, q, r] : mesh.triangles) triangles.emplace_back(p, q, r);
  made.beginModel();
  made.addSubModel(mesh.points, triangles);
  made.endModel();
  return made;
}

/// Calls ask(link, pose) along the trajectory three times, and prints the least time for one call.
template <class Ask>
void timed(const char* name, const Ask& ask) {
  double best = HUGE_VAL, sum = 0;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t start = std::clock();
    sum = 0;
    for (int step = 0; step < kPoses; ++step) {
      const std::array<Pose, kLinks> poses = plant::arm_at(double(step) / kPoses);
      for (std::size_t k = 0; k < kLinks; ++k) sum += ask(k, poses[k]);
    }
    best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("%-26s %8.2f us, sum of answers %.6f\n", name, 1e6 * best / (kPoses * kLinks), sum);
}

}  // namespace

int main() {
  const Mesh environment = plant::environment();
  const std::vector<Mesh> links = plant::links();
  const Result<MeshModel> room = build_mesh(environment);
  if (!room) return std::puts(room.error().message.c_str()), 1;
  std::vector<MeshModel> ours;
  for (const Mesh& link : links) ours.push_back(build_mesh(link).value());
  std::vector<MeshSeed> seeds(kLinks);
  const auto lower = [&](const Options& options) {
    return [&, options](std::size_t k, const Pose& pose) {
      return distance(room.value(), ours[k], pose, seeds[k], options).lower;
    };
  };
  timed("swiftlet, exact", lower({}));
  timed("swiftlet, to 10 %", lower({.relative = 0.1}));
  timed("swiftlet, intersects", [&](std::size_t k, const Pose& pose) {
    return double(intersects(room.value(), ours[k], pose, seeds[k]).verdict != Verdict::Disjoint);
  });

  const Tree fcl_room = tree(environment);
  std::vector<Tree> theirs;
  for (const Mesh& link : links) theirs.push_back(tree(link));
  const auto placed = [](const Pose& pose) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    t.linear() = pose.rotation, t.translation() = pose.translation;
    return t;
  };
  timed("FCL, exact", [&](std::size_t k, const Pose& pose) {
    fcl::DistanceResultd result;
    fcl::distance(&fcl_room, fcl::Transform3d::Identity(), &theirs[k], placed(pose), fcl::DistanceRequestd(), result);
    return std::max(result.min_distance, 0.0);
  });
  timed("FCL, collide", [&](std::size_t k, const Pose& pose) {
    fcl::CollisionResultd result;
    fcl::collide(&fcl_room, fcl::Transform3d::Identity(), &theirs[k], placed(pose), fcl::CollisionRequestd(), result);
    return double(result.isCollision());
  });
}
