// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A direction of contact is right where no triangle that holds the point rises above the plane across the direction: it then
// lies in the normal cone of the surface there [Rockafellar 1970, sec. 2], between the normals of the faces at an edge. Other
// directions come from triangles that are looked at alone, of which an inner edge is the nearest part or the shortest way out.
// These are replaced by the normal of the face, on the side from which the model came.
#include <swiftlet/triangles.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include <swiftlet/depth.h>

#include "along.h"

namespace swiftlet {
namespace {

/// Over the model's radius: what is nearer counts as one place. Some units in the last place of single precision, in which
/// engines keep meshes.
constexpr double kOnePlace = 0x1p-20;

/// Whether `p` lies above or below the triangle, or beside it by no more than `slack`.
bool covers(const std::array<Vec3, 3>& corners, const Vec3& normal, const Vec3& p, double slack) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = corners[std::size_t(i)], side = corners[std::size_t((i + 1) % 3)] - from;
    if (normal.cross(side).dot(p - from) < -slack * side.norm()) return false;
  }
  return true;
}

}  // namespace

/// One step's pair, as all triangles see it.
struct TrianglePair::View {
  Body a;
  Pose a_in_world, b_in_a;
  Mat3 into_b;
  Vec3 centre;  ///< the model's, in the surface's frame
  double radius, beyond, one_place;

  Vec3 in_b(const Vec3& p_a) const { return into_b * (p_a - b_in_a.translation); }
};

void TrianglePair::clear() {
  triangles_.clear();
  widest_ = 0;
}

void TrianglePair::add(std::uint64_t name, const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 least = p.cwiseMin(q).cwiseMin(r), most = p.cwiseMax(q).cwiseMax(r);
  triangles_.push_back({{p, q, r}, least, most, normal_of(Body::triangle(p, q, r), Side::Front), {name, {}, false}});
  widest_ = std::max(widest_, most[0] - least[0]);
}

std::span<const TrianglePoint> TrianglePair::contacts(const Placed& a, const Pose& surface, double radius, const Vec3& moved,
                                                      double beyond) {
  points_.clear();
  const Pose a_in_world = orthonormal(a.in_world), surface_in_world = orthonormal(surface);
  const Pose b_in_a = relative(a_in_world, surface_in_world);
  const Mat3 into_b = b_in_a.rotation.transpose();
  const Model& model = *a.body.model();
  View view{a.body, a_in_world, b_in_a, into_b, {}, radius, beyond, kOnePlace * model.radius()};
  view.centre = view.in_b(model.centre());
  recall(view.centre - surface_in_world.rotation.transpose() * moved);
  by_x_.resize(triangles_.size());
  std::iota(by_x_.begin(), by_x_.end(), 0u);
  std::sort(by_x_.begin(), by_x_.end(),
            [&](std::uint32_t i, std::uint32_t j) { return triangles_[i].least[0] < triangles_[j].least[0]; });
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) meet(view, i);

  memories_.clear();
  for (const Triangle& t : triangles_) memories_.push_back(t.memory);
  std::sort(memories_.begin(), memories_.end(), [](const Memory& m, const Memory& n) { return m.name < n.name; });
  return points_;
}

/// Turns each triangle's normal to the side on which the model is known to be, or was `before`.
void TrianglePair::recall(const Vec3& before) {
  for (Triangle& t : triangles_) {
    const auto known = std::lower_bound(memories_.begin(), memories_.end(), t.memory.name,
                                        [](const Memory& m, std::uint64_t name) { return m.name < name; });
    if (known != memories_.end() && known->name == t.memory.name)
      t.memory = *known;
    else
      t.memory.is_behind = t.normal.dot(before - t.corners[0]) < 0;
    if (t.memory.is_behind) t.normal = -t.normal;
  }
}

/// Adds the points of contact with one triangle.
void TrianglePair::meet(View& view, std::uint32_t number) {
  Triangle& t = triangles_[number];
  const Body b = Body::triangle(t.corners[0], t.corners[1], t.corners[2], view.radius);
  const double radii = view.a.radius() + view.radius;
  const auto height = [&] { return above(view.a, b, view.b_in_a, t.memory.is_behind ? Side::Back : Side::Front, t.normal); };
  const auto is_over = [&](const Vec3& p_a) {  // the radii are along the normal, which `covers` does not see
    const Vec3 normal = t.memory.is_behind ? Vec3(-t.normal) : t.normal;
    return covers(t.corners, normal, view.in_b(p_a), view.one_place);
  };
  const auto add = [&](const Vec3& normal, const Vec3& point_a, const Vec3& point_b, double separation) {
    points_.push_back({view.a_in_world.rotation * normal, transform(view.a_in_world, point_a),
                       transform(view.a_in_world, point_b), separation, number, false});
  };
  const std::size_t before = points_.size();
  const auto add_all = [&](const Answer& answer, bool only_over) {
    const ManifoldOptions options{.margin = view.beyond, .most_points = kMostManifoldPoints};
    const Manifold all = manifold(view.a, b, view.b_in_a, answer, options);
    for (std::uint32_t i = 0; i < all.count; ++i) {
      const ManifoldPoint& p = all.points[i];
      if (!only_over || is_over(p.point_b)) add(all.normal, p.point_a, p.point_b, p.separation);
    }
    if (points_.size() == before) return;
    const auto deepest = std::min_element(points_.begin() + std::ptrdiff_t(before), points_.end(),
                                          [](const auto& p, const auto& q) { return p.separation < q.separation; });
    deepest->is_deepest_of_its = true;
  };

  const bool has_plane = t.normal != Vec3::Zero();
  Answer face;
  if (has_plane) {
    face = height();
    if (face.lower > view.beyond) return;
    if (face.lower + radii >= 0 && is_over(face.point_b)) return add_all(face, true);  // the nearest point, without a walk
  }

  const Answer alone = signed_distance(view.a, b, view.b_in_a, t.memory.seed, {.beyond = view.beyond});
  const bool is_apart = alone.lower + radii > 0;
  if (has_plane && is_apart && t.normal.dot(view.centre - t.corners[0]) < 0) {  // it went around the border
    t.memory.is_behind = !t.memory.is_behind;
    t.normal = -t.normal;
    face = height();
  }
  if (alone.status == Status::Beyond) return;
  if (!alone.normal.hasNaN()) {
    const Vec3 core_b = alone.point_b + alone.normal * view.radius, direction = view.into_b * -alone.normal;
    const bool leads_back = is_apart || t.normal.dot(direction) >= -kOnePlace;  // not through to the other side
    if (leads_back && is_supported(view, view.in_b(core_b), direction)) return add_all(alone, false);
  }
  if (!has_plane || (is_apart && face.lower + radii < 0)) return;  // apart, and its lowest point is elsewhere
  add_all(face, true);
  if (points_.size() > before || is_apart || alone.normal.hasNaN()) return;
  // Deep in the model and not below its lowest face: no deeper than the shortest way out of the triangle alone.
  const Vec3 up = -face.normal, on_b = alone.point_b + alone.normal * view.radius + up * view.radius;
  add(face.normal, on_b + up * alone.lower, on_b, alone.lower);
  points_.back().is_deepest_of_its = true;
}

/// Whether `direction`, unit, from the surface's point `p` to the model, is right: p is the highest point along it of all
/// triangles that hold p. In the surface's frame.
bool TrianglePair::is_supported(const View& view, const Vec3& p, const Vec3& direction) const {
  const double slack = view.one_place;
  auto next = std::lower_bound(by_x_.begin(), by_x_.end(), p[0] - slack - widest_,
                               [&](std::uint32_t i, double x) { return triangles_[i].least[0] < x; });
  for (; next != by_x_.end() && triangles_[*next].least[0] <= p[0] + slack; ++next) {
    const Triangle& t = triangles_[*next];
    if ((p.array() < t.least.array() - slack).any() || (p.array() > t.most.array() + slack).any()) continue;
    if (t.normal == Vec3::Zero() || std::abs(t.normal.dot(p - t.corners[0])) > slack) continue;
    const Vec3 front = t.memory.is_behind ? Vec3(-t.normal) : t.normal;
    if (!covers(t.corners, front, p, slack)) continue;
    for (const Vec3& q : t.corners) {
      if (direction.dot(q - p) > slack) return false;
    }
  }
  return true;
}

namespace {

/// Twice the area of a triangle, seen along `normal`; positive where it turns left.
double twice_area(const Vec3& normal, const Vec3& p, const Vec3& q, const Vec3& r) { return normal.dot((q - p).cross(r - p)); }

}  // namespace

Spread spread(std::span<const TrianglePoint> points) {
  Spread chosen;
  const auto take_most = [&](auto&& gain) {
    double most = 0;
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (const double g = gain(points[i]); g > most) most = g, found = i;
    }
    if (most > 0) chosen.index[chosen.count++] = found;
    return most > 0;
  };
  const auto place = [&](std::uint32_t i) -> const Vec3& { return points[chosen.index[i]].point_b; };
  if (points.empty()) return chosen;
  const auto deepest =
      std::min_element(points.begin(), points.end(), [](const auto& p, const auto& q) { return p.separation < q.separation; });
  chosen.index[chosen.count++] = std::uint32_t(deepest - points.begin());
  const Vec3& n = deepest->normal;
  if (!take_most([&](const TrianglePoint& p) { return (p.point_b - place(0)).squaredNorm(); })) return chosen;
  if (!take_most([&](const TrianglePoint& p) { return std::abs(twice_area(n, place(0), place(1), p.point_b)); })) return chosen;
  if (twice_area(n, place(0), place(1), place(2)) < 0) std::swap(chosen.index[1], chosen.index[2]);
  take_most([&](const TrianglePoint& p) {
    double gain = 0;
    for (std::uint32_t i = 0; i < 3; ++i) gain = std::max(gain, -twice_area(n, place(i), place((i + 1) % 3), p.point_b));
    return gain;
  });
  return chosen;
}

}  // namespace swiftlet
