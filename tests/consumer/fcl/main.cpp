// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The FCL program of adapters/README.md.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <swiftlet/fcl.h>
#include <cstdio>

int main() {
  const swiftlet::Vec3 corners[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::uint32_t faces[] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  swiftlet::LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = faces;
  const auto model = swiftlet::Model::from_level(arrays);
  if (!model) return std::puts(model.error().message.c_str()), 1;

  const auto shape = std::make_shared<swiftlet::fcl::Convex<double>>(model.value());  // an fcl::Convex
  const fcl::CollisionObjectd a(shape), b(shape, fcl::Matrix3d::Identity(), fcl::Vector3d(5, 0, 0));

  const swiftlet::fcl::Solver<double> solver;  // one per pair, kept from query to query, or one for all
  fcl::DistanceResultd distance;
  fcl::distance(&a, &b, &solver, fcl::DistanceRequestd(true), distance);
  const fcl::Vector3d& p = distance.nearest_points[0];
  std::printf("distance %.12f, from (%.3f, %.3f, %.3f)\n", distance.min_distance, p[0], p[1], p[2]);

  fcl::CollisionResultd collision;
  fcl::collide(&a, &b, &solver, fcl::CollisionRequestd(), collision);
  std::printf("%s\n", collision.isCollision() ? "they collide" : "they do not collide");
}
