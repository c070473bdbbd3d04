// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Knows how test bodies are made; sees CGAL for their hulls, so that no test body comes out of the code under test.
#include "shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace swiftlet::shapes {

Mat3 rotation(const Vec3& axis, double angle) { return from_quaternion(std::cos(angle / 2), axis * std::sin(angle / 2)); }

Mesh hull(std::span<const Vec3> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  CGAL::get_default_random() = CGAL::Random(0);  // the hull draws from it: the same order, whatever was built before
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::convex_hull_3(input.begin(), input.end(), surface);
  Mesh mesh;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    mesh.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t corner = 0;
    for (const auto v : vertices_around_face(surface.halfedge(f), surface)) triangle.at(corner++) = v;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

const char* name(Family family) {
  switch (family) {
    case Family::Fat: return "fat";
    case Family::Plate: return "plate";
    case Family::Long: return "long";
  }
  return "";
}

Vec3 semi_axes(Family family) {
  switch (family) {
    case Family::Fat: return {1, 1, 1};
    case Family::Plate: return {1, 1, .1};
    case Family::Long: return {1, .1, .1};
  }
  return Vec3::Zero();
}

namespace {

Vec3 area_centroid(const Mesh& mesh) {
  Vec3 moment = Vec3::Zero();
  double area = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 p = mesh.points[i], q = mesh.points[j], r = mesh.points[k], u = q - p, v = r - p;
    const Vec3 n(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
    const double twice = std::sqrt(n.x() * n.x() + n.y() * n.y() + n.z() * n.z());
    moment += twice * (p + q + r);
    area += twice;
  }
  return moment / (3 * area);
}

}  // namespace

Mesh ellipsoid(const Vec3& semi_axes, std::uint32_t triangles, std::uint64_t seed) {
  assert(triangles % 2 == 0 && triangles >= 4);
  Random random(seed);
  std::vector<Vec3> points(triangles / 2 + 2);
  for (Vec3& p : points) p = random.on_sphere().cwiseProduct(semi_axes);
  Mesh mesh = hull(points);
  const Vec3 centroid = area_centroid(mesh);
  double radius2 = 0;
  for (Vec3& p : mesh.points) {
    p -= centroid;
    radius2 = std::max(radius2, p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
  }
  const double radius = std::sqrt(radius2);
  for (Vec3& p : mesh.points) p /= radius;
  return hull(mesh.points);
}

Pair pair(Family family, std::uint32_t triangles) {
  const auto seed = [&](std::uint64_t body) { return 1000003 * body + triangles; };
  return {ellipsoid(semi_axes(family), triangles, seed(1)), ellipsoid(semi_axes(family), triangles, seed(2))};
}

namespace {

// Fans the polygon over the mesh's points into triangles.
void add_polygon(Mesh& mesh, std::span<const std::uint32_t> loop) {
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) mesh.triangles.push_back({loop[0], loop[i], loop[i + 1]});
}

void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  add_polygon(mesh, std::array{a, b, c, d});
}

std::vector<Vec3> circle(std::uint32_t sides, double radius, double z) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return points;
}

// 0, 1, ..., count - 1 from `first` on, or backwards.
std::vector<std::uint32_t> loop(std::uint32_t first, std::uint32_t count, bool backwards) {
  std::vector<std::uint32_t> ids(count);
  for (std::uint32_t i = 0; i < count; ++i) ids[backwards ? count - 1 - i : i] = first + i;
  return ids;
}

void append(std::vector<Vec3>& points, const std::vector<Vec3>& more) { points.insert(points.end(), more.begin(), more.end()); }

}  // namespace

Mesh box(const Vec3& size) {
  Mesh mesh = meshed_cube(1);
  for (Vec3& p : mesh.points) p = p.cwiseProduct(size / 2);
  return mesh;
}

Mesh cube() { return meshed_cube(1); }

Mesh meshed_cube(std::uint32_t cells) {
  Mesh mesh;
  using Corner = std::array<std::uint32_t, 3>;
  std::map<Corner, std::uint32_t> ids;
  const auto coordinate = [&](std::uint32_t i) { return 2.0 * i / cells - 1; };
  const auto id = [&](const Corner& c) {
    const auto [entry, is_new] = ids.try_emplace(c, std::uint32_t(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(coordinate(c[0]), coordinate(c[1]), coordinate(c[2]));
    return entry->second;
  };
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t axis = side / 2, u = (axis + 1 + side % 2) % 3, v = (axis + 2 - side % 2) % 3;
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
      Corner c{};
      c[axis] = side % 2 ? 0 : cells;
      c[u] = i;
      c[v] = j;
      return id(c);
    };
    for (std::uint32_t i = 0; i < cells; ++i)
      for (std::uint32_t j = 0; j < cells; ++j)
        add_quad(mesh, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
  }
  return mesh;
}

Mesh prism(std::uint32_t sides, double radius, double height) {
  Mesh mesh{circle(sides, radius, -height / 2), {}};
  append(mesh.points, circle(sides, radius, height / 2));
  add_polygon(mesh, loop(0, sides, true));
  add_polygon(mesh, loop(sides, sides, false));
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    add_quad(mesh, i, next, sides + next, sides + i);
  }
  return mesh;
}

Mesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

Mesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

namespace {

// (0, +-p, +-q) and its cyclic permutations.
std::vector<Vec3> golden_rectangles(double p, double q) {
  std::vector<Vec3> points;
  for (double y : {-p, p})
    for (double z : {-q, q}) append(points, {{0, y, z}, {z, 0, y}, {y, z, 0}});
  return points;
}

}  // namespace

Mesh icosahedron() {
  const double golden = std::numbers::phi, radius = std::sqrt(1 + golden * golden);
  return hull(golden_rectangles(1 / radius, golden / radius));
}

Mesh dodecahedron() {
  std::vector<Vec3> points = golden_rectangles(1 / std::numbers::phi, std::numbers::phi);
  append(points, cube().points);
  return hull(points);
}

Mesh needle() {
  Mesh mesh{circle(10, 1e-3, 0), {}};
  append(mesh.points, {{0, 0, -1}, {0, 0, 1}});
  for (std::uint32_t i = 0; i < 10; ++i) {
    const std::uint32_t next = (i + 1) % 10;
    mesh.triangles.push_back({i, next, 11});
    mesh.triangles.push_back({next, i, 10});
  }
  return mesh;
}

Mesh sliver() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-7}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}; }

Mesh random_polytope(std::uint32_t points, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> in_ball(points);
  for (Vec3& p : in_ball) p = random.in_ball();
  return hull(in_ball);
}

Mesh polygon(std::uint32_t sides) {
  Mesh mesh{circle(sides, 1, 0), {}};
  add_polygon(mesh, loop(0, sides, false));
  add_polygon(mesh, loop(0, sides, true));
  return mesh;
}

Mesh segment(double length) { return {{{-length / 2, 0, 0}, {length / 2, 0, 0}}, {}}; }

Mesh point() { return {{Vec3::Zero()}, {}}; }

Mesh moved(const Mesh& mesh, const Pose& pose) {
  Mesh result = mesh;
  for (Vec3& p : result.points) p = pose.rotation * p + pose.translation;
  return result;
}

Mesh float_rounded(const Mesh& mesh) {
  Mesh result = mesh;
  for (Vec3& p : result.points) {
    for (double& x : p) {
      const volatile float rounded = float(x);  // GCC 12 may fold the two casts into none
      x = double(rounded);
    }
  }
  return result;
}

Orbit::Orbit(std::uint64_t seed, double closest, double step) : step_(step * std::numbers::pi / 180) {
  Random random(seed);
  for (;;) {
    Vec3 phase;
    for (double& angle : phase) angle = random.uniform(0, 2 * std::numbers::pi);
    const double eccentricity = std::hypot((2 * phase).array().cos().sum(), (2 * phase).array().sin().sum());
    if (eccentricity > 2.5) continue;
    const double scale = closest * std::sqrt(2 / (3 - eccentricity));
    cosine_ = scale * phase.array().cos();
    sine_ = scale * phase.array().sin();
    break;
  }
  axis_ = random.on_sphere();
}

Pose Orbit::pose(std::uint64_t query) const {
  const double theta = step_ * double(query);
  return {rotation(axis_, theta), cosine_ * std::cos(theta) - sine_ * std::sin(theta)};
}

}  // namespace swiftlet::shapes
