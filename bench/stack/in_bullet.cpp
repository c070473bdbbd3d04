// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "in_bullet.h"

namespace swiftlet::stack {

btVector3 vector_of(const Vec3& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }
Vec3 point_of(const Vertex& v) { return {v.x, v.y, v.z}; }

InBullet::InBullet(Shapes shapes) : shapes_(shapes) {
  if (shapes == Shapes::Swiftlet) hull_pairs.emplace(dispatcher);
  world.setGravity(btVector3(0, 0, btScalar(-kGravity)));
}

InBullet::~InBullet() {
  for (const auto& body : bodies_) world.removeRigidBody(body.get());
}

btRigidBody& InBullet::add(const std::shared_ptr<const Model>& model, const btTransform& start, bool moves) {
  btCollisionShape& shape = shape_of(model);
  const btScalar mass = moves ? btScalar(kDensity * model->volume()) : 0;
  btVector3 inertia(0, 0, 0);
  if (moves) shape.calculateLocalInertia(mass, inertia);
  btRigidBody& body = *bodies_.emplace_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
  body.setWorldTransform(start);
  body.setInterpolationWorldTransform(start);
  body.setFriction(btScalar(kFriction));
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&body);
  return body;
}

btCollisionShape& InBullet::shape_of(const std::shared_ptr<const Model>& model) {
  std::unique_ptr<btCollisionShape>& shape = shape_of_[model];
  if (shape) return *shape;
  const auto& vertices = model->level(0).view.vertices;
  if (shapes_ == Shapes::Boxes) {
    Vec3 half = Vec3::Zero();
    for (const Vertex& v : vertices) half = half.cwiseMax(point_of(v).cwiseAbs());
    shape = std::make_unique<btBoxShape>(vector_of(half + Vec3::Constant(kMargin)));
  } else if (shapes_ == Shapes::Swiftlet) {
    shape = std::make_unique<bullet::HullShape>(*model);
  } else {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vertex& v : vertices) hull->addPoint(vector_of(point_of(v)), false);
    hull->recalcLocalAabb();
    shape = std::move(hull);
  }
  shape->setMargin(btScalar(kMargin));
  return *shape;
}

}  // namespace swiftlet::stack
