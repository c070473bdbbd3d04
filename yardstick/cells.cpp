// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "geometry.h"
#include "random.h"

namespace swiftlet::yardstick {
namespace {

constexpr std::uint32_t kTriangles = 2000, kOrbits = 4, kQueries = 125;

/// As shapes.h has them.
struct Family {
  const char* name;
  Vec3 semi_axes;
};
const Family kFamilies[] = {{"fat", {1, 1, 1}}, {"plate", {1, 1, .1}}, {"long", {1, .1, .1}}};

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

using Triangle = std::array<std::uint32_t, 3>;

double height(const Vec& p, const Vec& a, const Vec& b, const Vec& c) { return dot(cross(b - a, c - a), p - a); }

/// The hull of points on an ellipsoid, all of which are corners: each one replaces the triangles that it sees by a fan over
/// their border. Decides in doubles; Model::from_level proves the outcome.
std::vector<Triangle> hull(std::span<const Vec3> points) {
  std::vector<Vec> p;
  for (const Vec3& point : points) p.push_back(vec(point));
  const bool inward = height(p[3], p[0], p[1], p[2]) > 0;
  const std::uint32_t i = inward ? 1 : 0, j = inward ? 0 : 1;
  std::vector<Triangle> triangles{{i, j, 2}, {j, i, 3}, {i, 2, 3}, {2, j, 3}};
  for (std::uint32_t v = 4; v < p.size(); ++v) {
    const auto seen = std::stable_partition(triangles.begin(), triangles.end(),
                                            [&](const Triangle& t) { return !(height(p[v], p[t[0]], p[t[1]], p[t[2]]) > 0); });
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (auto t = seen; t != triangles.end(); ++t) {
      for (const std::size_t k : {0, 1, 2}) sides.insert({t->at(k), t->at((k + 1) % 3)});
    }
    triangles.erase(seen, triangles.end());
    for (const auto& [tail, head] : sides) {
      if (!sides.contains({head, tail})) triangles.push_back({tail, head, v});
    }
  }
  return triangles;
}

Model ellipsoid(const Vec3& semi_axes, std::uint64_t seed) {
  shapes::Random random(seed);
  std::vector<Vec3> points(kTriangles / 2 + 2);
  for (Vec3& p : points) p = random.on_sphere().cwiseProduct(semi_axes);
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : hull(points)) corners.insert(corners.end(), t.begin(), t.end());
  LevelArrays level;
  level.vertices = points;
  level.face_vertices = corners;
  ModelOptions options;
  options.table = {.resolution = lut::Resolution::Degrees5, .map_cells = 0};
  Result<Model> model = Model::from_level(level, options);
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

// ---- Motions ---------------------------------------------------------------------------------------------------------------

/// The cosine and sine of an angle.
struct Angle {
  double cosine, sine;
  Angle operator+(const Angle& b) const { return {cosine * b.cosine - sine * b.sine, sine * b.cosine + cosine * b.sine}; }
};

/// Half of what a query turns by.
constexpr Angle kNoStep{1, 0};
constexpr Angle kHalfOf1_04{0x1.fffa9a1832d00p-1, 0x1.29638bcad7560p-7},
    kHalfOf10_4{0x1.fde48f554defdp-1, 0x1.733b25fe6ccd5p-4};

Angle any_angle(shapes::Random& random) {
  for (;;) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), length2 = x * x + y * y;
    if (length2 > 1 || length2 < 1e-4) continue;
    const double length = std::sqrt(length2);
    return {x / length, y / length};
  }
}

/// As shapes::Orbit, by sums of angles: B goes along an ellipse about A whose nearest point is 2 away, and turns about an axis
/// of its own by the same angle.
void add_orbit(std::vector<Pose>& poses, std::uint64_t seed, const Angle& half_step) {
  shapes::Random random(seed);
  Vec3 cosine, sine;
  double eccentricity = 3;
  while (eccentricity > 2.5) {
    Angle doubled{0, 0};
    for (const int k : {0, 1, 2}) {
      const Angle phase = any_angle(random), twice = phase + phase;
      cosine[k] = phase.cosine, sine[k] = phase.sine;
      doubled = {doubled.cosine + twice.cosine, doubled.sine + twice.sine};
    }
    eccentricity = std::sqrt(doubled.cosine * doubled.cosine + doubled.sine * doubled.sine);
  }
  const double scale = 2 * std::sqrt(2 / (3 - eccentricity));
  const Vec3 axis = random.on_sphere();
  Angle half = kNoStep;
  for (std::uint32_t i = 0; i < kQueries; ++i) {
    half = half + half_step;
    const Angle whole = half + half;
    poses.push_back(
        {shapes::from_quaternion(half.cosine, axis * half.sine), scale * (cosine * whole.cosine - sine * whole.sine)});
  }
}

std::vector<Pose> orbits(const Angle& half_step) {
  std::vector<Pose> poses;
  for (std::uint64_t k = 0; k < kOrbits; ++k) add_orbit(poses, 100 + k, half_step);
  return poses;
}

std::vector<Pose> random_poses() {
  shapes::Random random(100);
  std::vector<Pose> poses;
  for (std::uint32_t i = 0; i < kOrbits * kQueries; ++i) {
    const Mat3 rotation = random.rotation();
    poses.push_back({rotation, 2 * random.on_sphere()});
  }
  return poses;
}

}  // namespace

Cells::Cells() {
  for (const Family& family : kFamilies) {
    for (const std::uint64_t seed : {1, 2}) models_.push_back(ellipsoid(family.semi_axes, seed));
  }
}

std::vector<Cell> Cells::all() const {
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < std::size(kFamilies); ++k) {
    const auto add = [&](const char* motion, std::vector<Pose> poses) {
      cells.push_back({std::string(kFamilies[k].name) + "/" + motion, models_[2 * k], models_[2 * k + 1], std::move(poses)});
    };
    add("same", orbits(kNoStep));
    add("1.04", orbits(kHalfOf1_04));
    add("10.4", orbits(kHalfOf10_4));
    add("random", random_poses());
  }
  return cells;
}

}  // namespace swiftlet::yardstick
