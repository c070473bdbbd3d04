// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "numeric/tolerance.h"

namespace swiftlet {

bool is_rigid(const Pose& pose) {
  constexpr double kMostError = 5e-4;
  return ((pose.rotation.transpose() * pose.rotation - Mat3::Identity()).array().abs() <= kMostError).all();
}

Pose orthonormal(const Pose& pose) {
  if (!is_rigid(pose)) return {Mat3::Constant(std::numeric_limits<double>::quiet_NaN()), pose.translation};
  const Mat3 gram = pose.rotation.transpose() * pose.rotation;
  return {pose.rotation * (1.5 * Mat3::Identity() - 0.5 * gram), pose.translation};
}

Vec3 transform(const Pose& pose, const Vec3& p) { return pose.rotation * p + pose.translation; }

Vec3 legal(const Vec3& p) {
  return p.unaryExpr([](double x) { return std::abs(x) < kLeastCoordinate ? 0 : x; });
}

void into_world(const Pose& a_in_world, Manifold& manifold) {
  manifold.normal = a_in_world.rotation * manifold.normal;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& p = manifold.points[i];
    p.point_a = transform(a_in_world, p.point_a);
    p.point_b = transform(a_in_world, p.point_b);
  }
}

namespace {

/// The vertices of a primitive, numbered as queries do: those of a box by bits, x 1, y 2, z 4.
class Vertices {
 public:
  explicit Vertices(const Body& body) {
    if (body.kind() == BodyKind::Box) {
      for (int i = 0; i < 8; ++i) add({body.corner(i & 1)[0], body.corner(i >> 1 & 1)[1], body.corner(i >> 2 & 1)[2]});
      return;
    }
    const int count = body.kind() == BodyKind::Point ? 1 : body.kind() == BodyKind::Segment ? 2 : 3;
    for (int i = 0; i < count; ++i) add(body.corner(i));
  }
  const Vec3* begin() const { return all_.data(); }
  const Vec3* end() const { return all_.data() + count_; }

 private:
  void add(const Vec3& p) { all_[count_++] = p; }
  std::array<Vec3, 8> all_;
  std::size_t count_ = 0;
};

/// The vertex of a body that is lowest along `up`, in the body's frame.
struct Lowest {
  std::uint32_t index;
  Vec3 at;
};
Lowest lowest_of(const Body& body, const Vec3& up) {
  if (const Model* const model = body.model()) {
    const std::uint32_t lowest = model->support(-up);
    const Vertex& v = model->level(model->finest_level()).view.vertices[lowest];
    return {lowest, Vec3(v.x, v.y, v.z)};
  }
  const Vertices vertices(body);
  const Vec3* const lowest =
      std::min_element(vertices.begin(), vertices.end(), [&](const Vec3& p, const Vec3& q) { return up.dot(p) < up.dot(q); });
  return {std::uint32_t(lowest - vertices.begin()), *lowest};
}

}  // namespace

Ball ball_around(const Body& body) {
  if (const Model* const model = body.model()) return {model->centre(), model->radius()};
  const Vertices vertices(body);
  Ball ball{Vec3::Zero(), 0};
  for (const Vec3& v : vertices) ball.centre += v / double(vertices.end() - vertices.begin());
  for (const Vec3& v : vertices) ball.radius = std::max(ball.radius, (v - ball.centre).norm());
  return ball;
}

Vec3 normal_of(const Body& triangle, Side side) {
  const Vec3 p = triangle.corner(0), area = (triangle.corner(1) - p).cross(triangle.corner(2) - p);
  const double twice = area.norm();
  if (!(twice > 0)) return Vec3::Zero();
  return side == Side::Front ? Vec3(area / twice) : Vec3(-area / twice);
}

Answer above(const Body& a, const Body& triangle, const Pose& b_in_a, Side side, const Vec3& normal) {
  const Vec3 up = b_in_a.rotation * normal;
  const auto [lowest, p] = lowest_of(a, up);
  const double height = up.dot(p - transform(b_in_a, triangle.corner(0)));
  Answer answer;
  answer.status = Status::Converged;
  answer.is_signed = true;
  answer.feature_a = {FeatureKind::Vertex, lowest};
  double outside = 0;  // how far the model's finest level reaches beyond the body
  if (const Model* const model = a.model()) {
    answer.level_a = std::int16_t(model->finest_level());
    outside = model->level(model->finest_level()).deviation;
  }
  answer.feature_b = {FeatureKind::Face, side == Side::Front ? 0u : 1u};
  answer.radius_a = a.radius();
  answer.radius_b = triangle.radius();
  answer.lower = height - a.radius() - triangle.radius();
  answer.upper = answer.lower + outside;
  answer.verdict = answer.lower > 0 ? Verdict::Disjoint : answer.upper <= 0 ? Verdict::Overlapping : Verdict::Undecided;
  answer.normal = -up;
  answer.point_a = p - up * a.radius();
  answer.point_b = p - up * (height - triangle.radius());
  return answer;
}

}  // namespace swiftlet
