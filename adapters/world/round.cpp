// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Of all levels deviations are measured from level 0. Here that is a polytope with its corners on the round body, which is cut
// away at last: what lies within a deviation of it lies within that of the round body, which is larger. With 16 times the sides
// of the finest prism it takes 1/256 of the prism's deviation, so that the measured ones are by no more above the truth.
#include <swiftlet/round.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "numeric/decimal.h"

namespace swiftlet {
namespace {

constexpr std::size_t kFewestSides = 8, kMostSides = 2048, kRefinement = 4, kSidesWithin = 16;
/// Corners are moved out by so much of their radius, for the rounding of their coordinates.
constexpr double kRounding = 0x1p-45;

struct Direction {
  double x, y;
};

/// Unit directions at equal angles, by halving: square roots are the same on all platforms, sines are not.
std::vector<Direction> directions(std::size_t count) {
  std::vector<Direction> all{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  while (all.size() < count) {
    std::vector<Direction> finer;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Direction &p = all[i], &q = all[(i + 1) % all.size()];
      const double x = p.x + q.x, y = p.y + q.y, length = std::sqrt(x * x + y * y);
      finer.push_back(p);
      finer.push_back({x / length, y / length});
    }
    all = std::move(finer);
  }
  return all;
}

/// By how much a regular polygon around a unit circle sticks out.
double overshoot(const std::vector<Direction>& corners) {
  const double x = corners[0].x + corners[1].x, y = corners[0].y + corners[1].y;
  return 2 / std::sqrt(x * x + y * y) - 1;
}

enum class Kind { Cylinder, Cone };

/// A prism or pyramid: the corners of its base, then those of its top or its tip.
struct Arrays {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> face_vertices, face_sizes;

  Arrays(Kind kind, const std::vector<Direction>& corners, double radius, double half_height) {
    const auto sides = std::uint32_t(corners.size());
    const auto add_ring = [&](double z) {
      for (const Direction& d : corners) vertices.emplace_back(radius * d.x, radius * d.y, z);
    };
    add_ring(-half_height);
    if (kind == Kind::Cylinder)
      add_ring(half_height);
    else
      vertices.emplace_back(0, 0, half_height);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t next = (i + 1) % sides;
      if (kind == Kind::Cylinder)
        add_face(std::array{i, next, next + sides, i + sides});
      else
        add_face(std::array{i, next, sides});
    }
    std::vector<std::uint32_t> ring(sides);
    for (std::uint32_t i = 0; i < sides; ++i) ring[i] = sides - 1 - i;
    add_face(ring);
    if (kind == Kind::Cone) return;
    for (std::uint32_t i = 0; i < sides; ++i) ring[i] = sides + i;
    add_face(ring);
  }

  LevelArrays level() const {
    LevelArrays arrays;
    arrays.vertices = vertices;
    arrays.face_vertices = face_vertices;
    arrays.face_sizes = face_sizes;
    return arrays;
  }

 private:
  void add_face(const auto& corners) {
    face_vertices.insert(face_vertices.end(), corners.begin(), corners.end());
    face_sizes.push_back(std::uint32_t(corners.size()));
  }
};

Result<Model> round(Kind kind, double radius, double half_height, double deviation) {
  for (const double length : {radius, half_height, deviation}) {
    if (!(length > 0 && std::isfinite(length)))
      return Error{ErrorCode::BadValue,
                   "a length of a round body is " + decimal(length, 6) + "; it must be positive and finite"};
  }
  std::size_t sides = kFewestSides;
  while (radius * overshoot(directions(sides)) * (1 + 0x1p-7) > deviation) {
    if ((sides *= 2) > kMostSides)
      return Error{ErrorCode::BadValue, "a deviation of " + decimal(deviation / radius, 6) + " radii takes too many sides"};
  }
  std::vector<Arrays> kept{{kind, directions(kSidesWithin * sides), radius, half_height}};
  for (std::size_t n = sides; n >= kFewestSides; n /= kRefinement) {
    const std::vector<Direction> corners = directions(n);
    kept.emplace_back(kind, corners, radius * (1 + overshoot(corners)) * (1 + kRounding), half_height);
  }
  std::vector<LevelArrays> levels;
  for (const Arrays& arrays : kept) levels.push_back(arrays.level());
  const Result<Model> model = Model::from_levels(levels);
  if (!model) return model.error();
  Detail detail;
  detail.deviation = model.value().level(1).deviation * (1 + 0x1p-30);
  return model.value().cut(detail);
}

}  // namespace

Result<Model> cylinder(double radius, double half_height, double deviation) {
  return round(Kind::Cylinder, radius, half_height, deviation);
}

Result<Model> cone(double radius, double half_height, double deviation) {
  return round(Kind::Cone, radius, half_height, deviation);
}

}  // namespace swiftlet
