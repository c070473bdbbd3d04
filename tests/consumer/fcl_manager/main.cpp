// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The broadphase manager of adapters/README.md.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
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

  const auto shape = std::make_shared<swiftlet::fcl::Convex<double>>(model.value());
  fcl::CollisionObjectd fixed(shape), ball(std::make_shared<fcl::Sphered>(0.5));
  fcl::CollisionObjectd floor(std::make_shared<fcl::Boxd>(20, 20, 1), fcl::Matrix3d::Identity(), fcl::Vector3d(0, 0, -1.25));
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects({&fixed, &ball, &floor});
  manager.setup();

  swiftlet::fcl::CollisionPairs<double> pairs;  // lives as long as the scene
  pairs.request = fcl::CollisionRequestd(100, true);
  for (const double x : {4.0, 1.5, 0.75}) {
    ball.setTranslation(fcl::Vector3d(x, x, x));
    ball.computeAABB();
    manager.update();

    pairs.start_step();
    manager.collide(&pairs, pairs.callback);
    for (std::size_t i = 0; i < pairs.result.numContacts(); ++i) {
      const fcl::Contactd& contact = pairs.result.getContact(i);
      std::printf("ball at %.2f: contact at height %.2f, %.3f deep\n", x, contact.pos.z(), contact.penetration_depth);
    }
  }
}
