// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hand-written solids, models from arrays and meshes, and blocks with their hashes made right again. Sees no CGAL.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "body/block.h"

namespace swiftlet::bodies {

/// std::ranges::equal, which not every C++20 library has.
bool same_elements(const auto& a, const auto& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

/// One level's arrays, owned.
struct Polyhedron {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> corners, sizes;

  LevelArrays level() const {
    LevelArrays arrays;
    arrays.vertices = points;
    arrays.face_vertices = corners;
    arrays.face_sizes = sizes;
    return arrays;
  }
  void add(std::initializer_list<std::uint32_t> face) {
    corners.insert(corners.end(), face);
    sizes.push_back(std::uint32_t(face.size()));
  }
};

///     7----6
///    /|   /|      The box [-x, x] x [-y, y] x [-z, z] as six quads.
///   4----5 |
///   | 3--|-2      z up, x to the right.
///   |/   |/
///   0----1
inline Polyhedron box(double x, double y, double z) {
  Polyhedron b{{{-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z}, {-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}, {}, {}};
  b.add({0, 3, 2, 1}), b.add({4, 5, 6, 7}), b.add({0, 1, 5, 4}), b.add({1, 2, 6, 5}), b.add({2, 3, 7, 6}), b.add({3, 0, 4, 7});
  return b;
}
inline Polyhedron cube() { return box(1, 1, 1); }

inline Polyhedron octahedron() {
  Polyhedron b{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}, {}};
  b.add({0, 2, 4}), b.add({2, 1, 4}), b.add({1, 3, 4}), b.add({3, 0, 4}), b.add({2, 0, 5}), b.add({1, 2, 5}), b.add({3, 1, 5}),
      b.add({0, 3, 5});
  return b;
}
/// Four corners of a cube of side 2 s.
inline Polyhedron tetrahedron(double s = 1) {
  Polyhedron b{{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {}, {}};
  b.add({0, 1, 2}), b.add({0, 2, 3}), b.add({0, 3, 1}), b.add({1, 3, 2});
  return b;
}
/// A flat polygon with its two sides.
inline Polyhedron two_sided(std::vector<Vec3> loop) {
  Polyhedron b{std::move(loop), {}, {}};
  const auto n = std::uint32_t(b.points.size());
  b.corners.resize(2 * n);
  std::iota(b.corners.begin(), b.corners.begin() + n, 0u);
  std::reverse_copy(b.corners.begin(), b.corners.begin() + n, b.corners.begin() + n);
  b.sizes = {n, n};
  return b;
}
/// The octahedron, each of its triangles cut into four so many times, with all points on the unit sphere: 8, 32, 128, 512
/// faces. Sums, products, quotients and square roots only, so the same everywhere.
inline Polyhedron ball(int rounds) {
  Polyhedron body = octahedron();
  for (; rounds > 0; --rounds) {
    Polyhedron finer;
    finer.points = body.points;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] =
          middle.try_emplace(std::pair(std::min(i, j), std::max(i, j)), std::uint32_t(finer.points.size()));
      const Vec3 sum = body.points[i] + body.points[j];
      if (is_new) finer.points.push_back(sum / std::sqrt(sum.x() * sum.x() + sum.y() * sum.y() + sum.z() * sum.z()));
      return at->second;
    };
    for (std::size_t f = 0; f < body.corners.size(); f += 3) {
      const std::uint32_t i = body.corners[f], j = body.corners[f + 1], k = body.corners[f + 2], ij = between(i, j),
                          jk = between(j, k), ki = between(k, i);
      finer.add({i, ij, ki}), finer.add({ij, j, jk}), finer.add({ki, jk, k}), finer.add({ij, jk, ki});
    }
    body = finer;
  }
  return body;
}
inline Polyhedron segment(const Vec3& p, const Vec3& q) { return {{p, q}, {}, {}}; }
inline Polyhedron point(const Vec3& p) { return {{p}, {}, {}}; }

/// Every face as a fan from its first vertex.
inline Polyhedron triangulated(const Polyhedron& body) {
  Polyhedron result{body.points, {}, {}};
  std::size_t at = 0;
  for (const std::uint32_t size : body.sizes) {
    for (std::size_t i = 1; i + 1 < size; ++i) result.add({body.corners[at], body.corners[at + i], body.corners[at + i + 1]});
    at += size;
  }
  return result;
}
/// Every coordinate mapped and rounded.
inline Polyhedron moved(const Polyhedron& body, const Mat3& rotation, const Vec3& shift = Vec3::Zero()) {
  Polyhedron result = body;
  for (Vec3& p : result.points) p = rotation * p + shift;
  return result;
}
/// As a file of 32-bit floats would have it. Through memory: GCC 12 folds vectorised casts there and back into nothing.
inline Polyhedron float_rounded(const Polyhedron& body) {
  Polyhedron result = body;
  for (Vec3& p : result.points) {
    for (double& x : p) {
      const volatile float rounded = float(x);
      x = double(rounded);
    }
  }
  return result;
}
/// The rotation of a unit quaternion, rounded; the four numbers need not be normalised.
inline Mat3 rotation(double w, double x, double y, double z) {
  const double s = 2 / (w * w + x * x + y * y + z * z);
  Mat3 r;
  r << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),   //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  return r;
}

/// What a test takes for granted; throws so that the test that was wrong says so.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}
inline Model model(const Polyhedron& body, const ModelOptions& options = {}) {
  return must(Model::from_level(body.level(), options));
}

/// A triangle mesh (anything with points and triangles) as it is.
template <class Mesh>
Polyhedron body_of(const Mesh& mesh) {
  Polyhedron b{mesh.points, {}, {}};
  for (const auto& t : mesh.triangles) b.add({t[0], t[1], t[2]});
  return b;
}

inline std::vector<Vec3> points_of(const ConvexView& view) {
  std::vector<Vec3> points;
  for (const Vertex& v : view.vertices) points.emplace_back(v.x, v.y, v.z);
  return points;
}
/// What a question of yes or no, or one for the nearest features, reads of the options of a distance.
inline Effort effort(const Options& options) { return {options.budget, options.tuning}; }
inline ClosestOptions closest(const Options& options) { return {options.beyond, options.budget.steps, options.tuning}; }

/// How narrow law 2 wants an exact answer.
inline double law_two(const ConvexView& a, const ConvexView& b, const Pose& pose) {
  const double orthonormality = (pose.rotation.transpose() * pose.rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
  return (64 * 0x1p-53 + 2 * orthonormality) * (std::max(a.extent, b.extent) + pose.translation.norm()) * (1 + 1e-9);
}

/// Octahedron in cube in tetrahedron: level 1 deviates by 2 / sqrt(3), level 2 by 8 / sqrt(3).
inline Model nested(int levels = 3, const ModelOptions& options = {}) {
  const Polyhedron all[] = {octahedron(), cube(), tetrahedron(3)};
  std::vector<LevelArrays> arrays;
  for (int i = 0; i < levels; ++i) arrays.push_back(all[i].level());
  return must(Model::from_levels(arrays, options));
}

// ---- Blocks ----------------------------------------------------------------------------------------------------------------

using Bytes = std::vector<std::byte>;

inline Bytes bytes_of(const Model& m) { return {m.bytes().begin(), m.bytes().end()}; }

template <class T>
T read(const Bytes& block, std::size_t at) {
  T value;
  std::memcpy(&value, block.data() + at, sizeof value);
  return value;
}
template <class T>
void write(Bytes& block, std::size_t at, const T& value) {
  std::memcpy(block.data() + at, &value, sizeof value);
}
inline std::size_t level_header_at(std::size_t level) { return sizeof(BlockHeader) + level * sizeof(LevelHeader); }

/// Makes every hash fit what it covers, as far as the sections lie inside the block.
inline void rehash(Bytes& block) {
  auto header = read<BlockHeader>(block, 0);
  const auto fix = [&](Section& s) {
    if (s.offset <= block.size() && s.bytes <= block.size() - s.offset)
      s.hash = hash_of(std::span(block).subspan(s.offset, s.bytes));
  };
  fix(header.maps);
  fix(header.table);
  fix(header.source);
  header.header_hash = 0;
  const std::size_t levels = std::min<std::size_t>(header.level_count, (block.size() - sizeof header) / sizeof(LevelHeader));
  for (std::size_t i = 0; i < levels; ++i) {
    auto level = read<LevelHeader>(block, level_header_at(i));
    if (i >= header.finest_level) fix(level.section);
    write(block, level_header_at(i), level);
  }
  write(block, 0, header);
  header.header_hash = hash_of(std::span(block).first(level_header_at(levels)));
  write(block, 0, header);
}

}  // namespace swiftlet::bodies
