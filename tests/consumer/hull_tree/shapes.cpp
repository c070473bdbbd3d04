// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.h"

#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

namespace hull_tree {
namespace {

constexpr double kTurn = 6.283185307179586;

/// A tube that closes both ways: quads between points (i, j), cut in two. Where i is right and j up seen from outside.
template <class Point>
Mesh closed_grid(std::uint32_t rows, std::uint32_t columns, Point point) {
  Mesh mesh;
  const auto id = [&](std::uint32_t i, std::uint32_t j) { return i % rows * columns + j % columns; };
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      mesh.points.push_back(point(i, j));
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace

Mesh torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
  return closed_grid(around, across, [=](std::uint32_t i, std::uint32_t j) {
    const double u = kTurn * i / around, v = kTurn * j / across, r = major + minor * std::cos(v);
    return Vec3(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
  });
}

Mesh knot(double tube, std::uint32_t along, std::uint32_t across) {
  const auto centre = [](double t) {
    const double r = 2 + std::cos(3 * t);
    return Vec3(r * std::cos(2 * t), r * std::sin(2 * t), std::sin(3 * t));
  };
  return closed_grid(along, across, [=](std::uint32_t i, std::uint32_t j) {
    const double t = kTurn * i / along, v = kTurn * j / across;
    const Vec3 tangent = (centre(t + 1e-4) - centre(t - 1e-4)).normalized();
    const Vec3 off_torus(std::cos(3 * t) * std::cos(2 * t), std::cos(3 * t) * std::sin(2 * t), std::sin(3 * t));
    const Vec3 across_torus = off_torus.cross(tangent).normalized();
    return Vec3(centre(t) + tube * (std::cos(v) * tangent.cross(across_torus) * -1 - std::sin(v) * across_torus));
  });
}

Mesh gear(std::uint32_t teeth) {
  // Per tooth two points at the root and two at the tip; across: outer and inner wall, above and below.
  return closed_grid(4 * teeth, 4, [=](std::uint32_t i, std::uint32_t j) {
    const bool outer = j == 0 || j == 3, above = j == 0 || j == 1, tip = i % 4 >= 2;
    const double u = kTurn * (i + (i % 4 == 1 ? 0.25 : i % 4 == 2 ? -0.25 : 0)) / (4 * teeth);
    const double r = outer ? (tip ? 96 : 72) : 40;
    return Vec3(std::round(r * std::cos(u)), std::round(r * std::sin(u)), above ? 16 : -16);
  });
}

Mesh cubes(int x, int y, int z, const std::function<bool(int, int, int)>& filled) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> ids;
  const auto id = [&](const std::array<int, 3>& p) {
    const auto [at, is_new] = ids.try_emplace(p, std::uint32_t(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(p[0], p[1], p[2]);
    return at->second;
  };
  const auto solid = [&](const std::array<int, 3>& c) {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < x && c[1] < y && c[2] < z && filled(c[0], c[1], c[2]);
  };
  for (int i = 0; i < x * y * z; ++i) {
    const std::array<int, 3> cube{i % x, i / x % y, i / x / y};
    if (!solid(cube)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beside = cube;
        beside[axis] += 2 * side - 1;
        if (solid(beside)) continue;
        const std::size_t u = (axis + 1 + std::size_t(1 - side)) % 3, v = (axis + 1 + std::size_t(side)) % 3;
        std::array<std::array<int, 3>, 4> corner{cube, cube, cube, cube};
        for (std::size_t k = 0; k < 4; ++k) {
          corner[k][axis] += side;
          corner[k][u] += k == 1 || k == 2;
          corner[k][v] += k == 2 || k == 3;
        }
        const std::uint32_t a = id(corner[0]), b = id(corner[1]), c = id(corner[2]), d = id(corner[3]);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

std::uint64_t Random::bits() {  // splitmix64
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

double Random::uniform(double low, double high) { return low + (high - low) * double(bits() >> 11) * 0x1p-53; }

Vec3 Random::direction() {
  for (;;) {
    const Vec3 p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (const double n = p.norm(); n > 0.1 && n < 1) return p / n;
  }
}

Mat3 Random::rotation() { return hull_tree::rotation(direction(), uniform(0, kTurn)); }

Mat3 Random::quarter_turns() {
  const std::uint64_t choice = bits();
  const auto axis = int(choice % 3);
  Mat3 r = Mat3::Zero();
  for (int k = 0; k < 3; ++k) r(k, (k + axis) % 3) = choice >> (8 + k) & 1 ? -1 : 1;
  if (choice >> 16 & 1) r.row(0).swap(r.row(1));
  return r.determinant() < 0 ? Mat3(-r) : r;
}

Mat3 rotation(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

}  // namespace hull_tree
