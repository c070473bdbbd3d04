// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the adapter to FCL share: poses, shapes of which the truth is known, and questions in FCL's words.
#pragma once

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <swiftlet/fcl.h>
#include <swiftlet/model_file.h>

#include "bodies.h"
#include "brute_force.h"

namespace swiftlet::fcl_world {

template <class S>
using Geometry = ::fcl::CollisionGeometry<S>;
template <class S>
using Transform = ::fcl::Transform3<S>;

template <class S>
inline constexpr double kRounding = std::is_same_v<S, double> ? 1e-12 : 4e-6;

template <class S>
Transform<S> at(double x, double y, double z) {
  Transform<S> t = Transform<S>::Identity();
  t.translation() = Vec3(x, y, z).cast<S>();
  return t;
}

inline Model stored(const char* name) { return load(std::string(SWIFTLET_TEST_DIR) + "/data/models/" + name + ".swl").value(); }

struct Random {
  std::mt19937 engine{7};
  double uniform(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine); }
  Vec3 vector(double size) { return size * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); }
  template <class S>
  Transform<S> transform(double size) {
    Transform<S> t = Transform<S>::Identity();
    const Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    t.linear() = q.normalized().toRotationMatrix().cast<S>();
    t.translation() = vector(size).cast<S>();
    return t;
  }
};

template <class S, class Solver>
::fcl::DistanceResult<S> measure(const Geometry<S>& a, const Transform<S>& a_in_world, const Geometry<S>& b,
                                 const Transform<S>& b_in_world, const Solver& solver, bool is_signed = false) {
  ::fcl::DistanceResult<S> result;
  ::fcl::distance(&a, a_in_world, &b, b_in_world, &solver, ::fcl::DistanceRequest<S>(true, is_signed), result);
  return result;
}

template <class S, class Solver>
::fcl::CollisionResult<S> collide(const Geometry<S>& a, const Transform<S>& a_in_world, const Geometry<S>& b,
                                  const Transform<S>& b_in_world, const Solver& solver, bool contacts = true,
                                  std::size_t most = 1000) {
  ::fcl::CollisionResult<S> result;
  ::fcl::collide(&a, a_in_world, &b, b_in_world, &solver, ::fcl::CollisionRequest<S>(most, contacts), result);
  return result;
}

template <class S>
Vec3 vec3(const ::fcl::Vector3<S>& v) {
  return v.template cast<double>();
}

template <class S>
double deepest(const ::fcl::CollisionResult<S>& result) {
  double depth = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, double(result.getContact(i).penetration_depth));
  return depth;
}

/// A shape of FCL's, and what it is: all points within a radius of a polytope.
template <class S>
struct Known {
  std::shared_ptr<Geometry<S>> shape;
  Polytope core;
  double radius;
};

template <class S>
Known<S> sphere(Random& r) {
  const auto shape = std::make_shared<::fcl::Sphere<S>>(S(r.uniform(0.1, 1)));
  return {shape, {{{0, 0, 0}}, {}, {}}, shape->radius};
}
template <class S>
Known<S> capsule(Random& r) {
  const auto shape = std::make_shared<::fcl::Capsule<S>>(S(r.uniform(0.1, 0.6)), S(r.uniform(0.2, 2)));
  const Vec3 top(0, 0, shape->lz / 2);
  return {shape, {{-top, top}, {}, {{0, 1}}}, shape->radius};
}
template <class S>
Known<S> box(Random& r) {
  const auto shape = std::make_shared<::fcl::Box<S>>(S(r.uniform(0.2, 2)), S(r.uniform(0.2, 2)), S(r.uniform(0.2, 2)));
  const Vec3 half = vec3<S>(shape->side) / 2;
  return {shape, polytope_of(bodies::box(half[0], half[1], half[2])), 0};
}
template <class S>
Known<S> convex(Random& r) {
  const Model model = bodies::model(r.engine() % 2 ? bodies::octahedron() : bodies::box(0.3, 0.7, 0.5));
  return {std::make_shared<fcl::Convex<S>>(model), polytope_of(model.level(0).view), 0};
}

template <class S>
using Maker = Known<S> (*)(Random&);

}  // namespace swiftlet::fcl_world
