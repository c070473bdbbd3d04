// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bodies.h"

#include <cmath>
#include <numbers>

#include "random.h"

namespace swiftlet::bench::mesh {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3 rounded(const Vec3& p) { return p.cast<float>().cast<double>(); }

/// Adds a sheet of columns times rows of points, `point(i, j)`, and the two triangles of each of its quadrilaterals. A sheet
/// that is closed in a direction has no seam there. Returns the index of its first point.
template <class Point>
std::uint32_t add_sheet(Mesh& mesh, std::uint32_t columns, bool round, std::uint32_t rows, bool round_too, const Point& point) {
  const auto first = std::uint32_t(mesh.points.size());
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t j = 0; j < rows; ++j) mesh.points.push_back(rounded(point(i, j)));
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return first + (i % columns) * rows + j % rows; };
  for (std::uint32_t i = 0; i + (round ? 0 : 1) < columns; ++i) {
    for (std::uint32_t j = 0; j + (round_too ? 0 : 1) < rows; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return first;
}

/// A sphere's net: rings of `sides` points between two poles, 2 * sides * rings triangles.
template <class Point>
Mesh capped(std::uint32_t sides, std::uint32_t rings, const Vec3& south, const Vec3& north, const Point& point) {
  Mesh mesh;
  add_sheet(mesh, sides, true, rings, false, point);
  const auto pole = std::uint32_t(mesh.points.size());
  mesh.points.push_back(rounded(south));
  mesh.points.push_back(rounded(north));
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t here = i * rings, next = (i + 1) % sides * rings;
    mesh.triangles.push_back({pole, next, here});
    mesh.triangles.push_back({pole + 1, here + rings - 1, next + rings - 1});
  }
  return mesh;
}

/// The six sides of a box, each of `cells` times `cells` squares; points on its edges are repeated.
void add_box(Mesh& mesh, const Vec3& low, const Vec3& high, std::uint32_t cells) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      add_sheet(mesh, cells + 1, false, cells + 1, false, [&](std::uint32_t i, std::uint32_t j) {
        if (!upper) std::swap(i, j);
        Vec3 p;
        p[axis] = upper ? high[axis] : low[axis];
        p[u] = low[u] + (high[u] - low[u]) * i / cells;
        p[v] = low[v] + (high[v] - low[v]) * j / cells;
        return p;
      });
    }
  }
}

}  // namespace

Mesh torus(const TorusOptions& o) {
  Mesh mesh;
  add_sheet(mesh, o.around, true, o.across, true, [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
    const double u = kTurn * i / o.around, v = kTurn * j / o.across;
    const double tube = o.tube * (1 + o.wrinkle * (std::cos(9 * u) + std::cos(4 * v + 2 * u)) / 2);
    const double out = o.middle + tube * std::cos(v), x = out * std::cos(u), y = out * std::sin(u);
    return {x, y, tube * std::sin(v) + o.bend * (x * x - y * y)};
  });
  return mesh;
}

Mesh gear() {
  constexpr std::uint32_t kTeeth = 16;
  constexpr double kHole = 0.4, kRoot = 0.75, kThick = 0.33, kFlank = 0.25;
  Mesh mesh;
  // Of each tooth two points at the root and two at the tip; around the wall from outside above to outside below.
  add_sheet(mesh, 4 * kTeeth, true, 4, true, [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
    const bool is_outer = j == 0 || j == 3, is_above = j <= 1, is_tip = i % 4 >= 2;
    const double u = kTurn * (i + (i % 4 == 1 ? kFlank : i % 4 == 2 ? -kFlank : 0)) / (4 * kTeeth);
    const double r = !is_outer ? kHole : is_tip ? 1 : kRoot;
    return {r * std::cos(u), r * std::sin(u), is_above ? kThick / 2 : -kThick / 2};
  });
  return mesh;
}

Mesh cup() {
  constexpr std::uint32_t kSides = 80, kRings = 50, kFloor = 8, kWall = 16, kRim = 2;
  static_assert(2 * (kFloor + kWall) + kRim == kRings);
  constexpr double kRadius = 0.7, kHeight = 1.6, kThick = 0.06;
  const auto wall = [](double height) { return kRadius * (0.75 + 0.25 * std::sqrt(height / kHeight)); };
  // Outside from the middle of the floor up to the rim, then inside back down.
  return capped(kSides, kRings, Vec3(0, 0, 0), Vec3(0, 0, kThick), [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
    const std::uint32_t half = kFloor + kWall;
    double out, z;
    if (j >= half && j < half + kRim) {
      out = wall(kHeight) - kThick * (j - half + 1) / (kRim + 1);
      z = kHeight + 0.4 * kThick;
    } else {
      const bool inside = j >= half;
      const std::uint32_t k = inside ? kRings - 1 - j : j;
      const double thick = inside ? kThick : 0;
      if (k < kFloor) {
        out = (wall(0) - thick) * (k + 1) / kFloor;
        z = thick;
      } else {
        z = thick + (kHeight - thick) * (k - kFloor + 1) / kWall;
        out = wall(z) - thick;
      }
    }
    const double u = kTurn * i / kSides;
    return {out * std::cos(u), out * std::sin(u), z};
  });
}

Mesh spoon() {
  constexpr std::uint32_t kSides = 6, kRings = 7;
  struct Ring {
    double z, width, thick, behind;
  };
  constexpr Ring kAlong[kRings] = {{0.03, 0.08, 0.02, 0.00},  {0.12, 0.15, 0.03, -0.04}, {0.24, 0.16, 0.03, -0.05},
                                   {0.36, 0.10, 0.03, -0.02}, {0.44, 0.03, 0.02, 0.00},  {0.90, 0.03, 0.02, 0.04},
                                   {1.36, 0.05, 0.02, 0.02}};
  return capped(kSides, kRings, Vec3(0, 0, 0), Vec3(0, 0.02, 1.4), [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
    const Ring& ring = kAlong[j];
    const double u = kTurn * i / kSides;
    return {ring.width * std::cos(u), ring.behind + ring.thick * std::sin(u), ring.z};
  });
}

Mesh spiral_peg() {
  constexpr std::uint32_t kSides = 20, kRings = 200;
  constexpr double kTurns = 3, kHeight = 4, kAway = 0.25, kTube = 0.22;
  const auto middle = [](double s) -> Vec3 {
    return {kAway * std::cos(kTurns * kTurn * s), kAway * std::sin(kTurns * kTurn * s), kHeight * (s - 0.5)};
  };
  return capped(kSides, kRings, middle(0) - Vec3(0, 0, kTube), middle(1) + Vec3(0, 0, kTube),
                [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
                  const double u = kTurn * i / kSides;
                  return middle(double(j) / (kRings - 1)) + kTube * Vec3(std::cos(u), std::sin(u), 0);
                });
}

Mesh teeth(std::uint64_t seed) {
  constexpr std::uint32_t kAlong = 204, kAcross = 100;
  constexpr double kNoise = 5e-4;
  shapes::Random random(seed);
  Mesh mesh;
  add_sheet(mesh, kAlong + 1, false, kAcross + 1, false, [&](std::uint32_t i, std::uint32_t j) -> Vec3 {
    const double s = double(i) / kAlong, t = double(j) / kAcross;
    const double crown = std::sin(7 * kTurn / 2 * s) * std::sin(kTurn / 2 * t);
    const double cusps = std::cos(14 * kTurn * s) * std::cos(3 * kTurn * t);
    return {2 * s - 1, 0.8 * (t - 0.5), 0.2 * crown * crown * (1 + 0.1 * cusps) + kNoise * random.uniform(-1, 1)};
  });
  return mesh;
}

Mesh comb() {
  Mesh mesh;
  add_box(mesh, Vec3(-1, 0, -0.1), Vec3(1, 0.25, 0.1), 2);
  for (int k = 0; k < 8; ++k) {
    const double x = -1 + k * 0.265625;
    add_box(mesh, Vec3(x, -0.75, -0.1), Vec3(x + 0.140625, 0, 0.1), 2);
  }
  return mesh;
}

Mesh frame() {
  Mesh mesh;
  for (const double side : {-1., 1.}) {
    const double low = side < 0 ? -1 : 0.75, high = side < 0 ? -0.75 : 1;
    add_box(mesh, Vec3(-1, low, -0.1), Vec3(1, high, 0.1), 2);
    add_box(mesh, Vec3(low, -0.75, -0.1), Vec3(high, 0.75, 0.1), 2);
  }
  return mesh;
}

}  // namespace swiftlet::bench::mesh
