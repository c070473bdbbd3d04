// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Small triangle meshes, and the distance of two triangles over any field of numbers: by rationals it is the truth, by long
// doubles a good guess. Shares no code with bvh or march, and knows nothing of trees.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <random.h>
#include <swiftlet/mesh.h>
#include <swiftlet/pose.h>

namespace swiftlet::soups {

using Corners = std::array<std::uint32_t, 3>;

/// Points and triangles over them, as a user has them.
struct Soup {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;

  void add(const Vec3& p, const Vec3& q, const Vec3& r) {
    const auto first = std::uint32_t(points.size());
    points.insert(points.end(), {p, q, r});
    triangles.push_back({first, first + 1, first + 2});
  }
  void add(const Soup& other) {
    const auto first = std::uint32_t(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const auto& [p, q, r] : other.triangles) triangles.push_back({p + first, q + first, r + first});
  }
  Vec3 corner(std::size_t triangle, std::size_t k) const { return points[triangles[triangle][k]]; }
  MeshModel mesh() const {
    Result<MeshModel> made = MeshModel::from_triangles(points, triangles);
    if (!made) throw std::runtime_error(made.error().message);
    return std::move(made).value();
  }
};

inline Soup moved(Soup soup, const Mat3& rotation, const Vec3& shift = Vec3::Zero()) {
  for (Vec3& p : soup.points) p = rotation * p + shift;
  return soup;
}
inline Soup scaled(Soup soup, double factor) {
  for (Vec3& p : soup.points) p *= factor;
  return soup;
}

/// Six faces of two triangles each, seen from outside counter-clockwise.
inline Soup box(const Vec3& least, const Vec3& most) {
  Soup soup;
  for (int i = 0; i < 8; ++i)
    soup.points.emplace_back((i & 1 ? most : least).x(), (i & 2 ? most : least).y(), (i & 4 ? most : least).z());
  soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}
inline Soup tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}
/// An octahedron whose triangles are cut into four `times` times; points lie on the unit sphere.
inline Soup ball(int times) {
  Soup soup{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < times; ++i) {
    Soup finer{soup.points, {}};
    for (const auto& [p, q, r] : soup.triangles) {
      const auto n = std::uint32_t(finer.points.size());
      const auto middle = [&](std::uint32_t v, std::uint32_t w) { return (soup.points[v] + soup.points[w]).normalized(); };
      finer.points.insert(finer.points.end(), {middle(p, q), middle(q, r), middle(r, p)});
      finer.triangles.insert(finer.triangles.end(), {{p, n, n + 2}, {n, q, n + 1}, {n + 2, n + 1, r}, {n, n + 1, n + 2}});
    }
    soup = std::move(finer);
  }
  return soup;
}
/// A ring of `around` tubes of `across` quads, of radius 1 and `thickness`; closed.
inline Soup torus(std::uint32_t around, std::uint32_t across, double thickness = 0.4) {
  Soup soup;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * k / across,
                   r = 1 + thickness * std::cos(v);
      soup.points.emplace_back(r * std::cos(u), r * std::sin(u), thickness * std::sin(v));
      const auto at = [&](std::uint32_t x, std::uint32_t y) { return x % around * across + y % across; };
      soup.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      soup.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return soup;
}
/// The graph of `height` over [-1, 1]^2, of so many quads a side; open.
template <class Height>
Soup patch(std::uint32_t side, const Height& height) {
  Soup soup;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t k = 0; k <= side; ++k) {
      const double x = 2.0 * i / side - 1, y = 2.0 * k / side - 1;
      soup.points.emplace_back(x, y, height(x, y));
      if (i == side || k == side) continue;
      const std::uint32_t at = i * (side + 1) + k, right = at + side + 1;
      soup.triangles.push_back({at, right, right + 1});
      soup.triangles.push_back({at, right + 1, at + 1});
    }
  }
  return soup;
}
/// So many triangles within the unit ball, each of about this size; not joined.
inline Soup scattered(shapes::Random& random, int count, double size) {
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random.in_ball();
    soup.add(at + size * random.in_ball(), at + size * random.in_ball(), at + size * random.in_ball());
  }
  return soup;
}
/// So many triangles over few points: joined in any way, edges of many triangles.
inline Soup tangled(shapes::Random& random, std::uint32_t points, int count) {
  Soup soup;
  for (std::uint32_t i = 0; i < points; ++i) soup.points.push_back(random.in_ball());
  while (int(soup.triangles.size()) < count) {
    const auto any = [&] { return std::uint32_t(random.bits() % points); };
    const Corners c{any(), any(), any()};
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) soup.triangles.push_back(c);
  }
  return soup;
}
/// A mesh of 2 to 64 triangles of any of these kinds.
inline Soup any(shapes::Random& random) {
  const auto least = [&] { return Vec3(-random.uniform(0.2, 1), -random.uniform(0.2, 1), -random.uniform(0.2, 1)); };
  switch (random.bits() % 8) {
    case 0: return ball(1);
    case 1: return torus(4 + std::uint32_t(random.bits() % 4), 3 + std::uint32_t(random.bits() % 2), random.uniform(0.1, 0.6));
    case 2: return tetrahedron();
    case 3: return box(least(), -least());
    case 4: return scattered(random, 2 + int(random.bits() % 30), random.uniform(0.1, 0.6));
    case 5: return tangled(random, 6 + std::uint32_t(random.bits() % 8), 4 + int(random.bits() % 30));
    case 6: {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      return patch(2 + std::uint32_t(random.bits() % 4),
                   [=](double u, double v) { return 0.3 * (x * u * u + y * v * v + u * v); });
    }
    default: {
      Soup soup = ball(1);  // dented and bumped
      for (Vec3& p : soup.points) p *= random.uniform(0.4, 1);
      return soup;
    }
  }
}

// ---- The distance of two triangles -----------------------------------------------------------------------------------------

template <class T>
struct Point {
  T x, y, z;
  friend Point operator+(const Point& p, const Point& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
  friend Point operator-(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  friend Point operator*(const Point& p, const T& s) { return {p.x * s, p.y * s, p.z * s}; }
};
template <class T>
T dot(const Point<T>& p, const Point<T>& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
template <class T>
Point<T> cross(const Point<T>& p, const Point<T>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
template <class T>
using Triangle = std::array<Point<T>, 3>;

template <class T>
Point<T> point(const Vec3& p) {
  return {T(p.x()), T(p.y()), T(p.z())};
}
/// The pose applied to a point: exactly, if T is exact.
template <class T>
Point<T> apply(const Pose& pose, const Vec3& p) {
  const Point<T> q = point<T>(p);
  const auto row = [&](int i) {
    return T(T(pose.rotation(i, 0)) * q.x + T(pose.rotation(i, 1)) * q.y + T(pose.rotation(i, 2)) * q.z +
             T(pose.translation[i]));
  };
  return {row(0), row(1), row(2)};
}
template <class T>
std::vector<Triangle<T>> triangles(const Soup& soup, const Pose& pose = {}) {
  std::vector<Point<T>> points;
  for (const Vec3& p : soup.points) points.push_back(apply<T>(pose, p));
  std::vector<Triangle<T>> all;
  for (const auto& [p, q, r] : soup.triangles) all.push_back({points[p], points[q], points[r]});
  return all;
}

/// A squared distance and the way from one point to the other.
template <class T>
struct Nearest {
  T squared;
  Point<T> way;
};

/// All that can hold nearest points, tried one after the other: a corner and a side, a corner above a face, two sides, and a
/// side that passes through a face. Triangles may be flat.
template <class T>
Nearest<T> nearest(const Triangle<T>& a, const Triangle<T>& b) {
  Nearest<T> best{T(-1), {}};
  const auto take = [&](const Point<T>& way) {
    const T squared = dot(way, way);
    if (best.squared < 0 || squared < best.squared) best = {squared, way};
  };
  const T zero(0);
  for (const bool swapped : {false, true}) {
    const Triangle<T>&of = swapped ? b : a, &to = swapped ? a : b;
    const Point<T> normal = cross(to[1] - to[0], to[2] - to[0]);
    const T square = dot(normal, normal);
    std::array<T, 3> height;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point<T>& p = of[i];
      height[i] = dot(normal, p - to[0]);
      bool above = square > zero;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point<T>& q = to[k];
        const Point<T> along = to[(k + 1) % 3] - q;
        const T at = dot(p - q, along), length = dot(along, along);
        const Point<T> way = at <= zero ? q - p : at >= length ? to[(k + 1) % 3] - p : q + along * T(at / length) - p;
        take(swapped ? way * T(-1) : way);
        above = above && dot(cross(normal, along), p - q) >= zero;
      }
      if (above) {
        const Point<T> way = normal * T(-height[i] / square);
        take(swapped ? way * T(-1) : way);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      if (!((height[i] < zero && height[next] > zero) || (height[i] > zero && height[next] < zero))) continue;
      const Point<T> along = of[next] - of[i];
      int left = 0, right = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const T side = dot(along, cross(to[k] - of[i], to[(k + 1) % 3] - of[i]));
        left += side >= zero, right += side <= zero;
      }
      if (left == 3 || right == 3) take({zero, zero, zero});
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point<T> d = a[(i + 1) % 3] - a[i], e = b[(k + 1) % 3] - b[k], r = b[k] - a[i];
      const T dd = dot(d, d), de = dot(d, e), ee = dot(e, e), dr = dot(d, r), er = dot(e, r), det = dd * ee - de * de;
      const T s = dr * ee - de * er, t = de * dr - dd * er;
      if (det > zero && s >= zero && s <= det && t >= zero && t <= det) take(r + e * T(t / det) - d * T(s / det));
    }
  }
  return best;
}

/// Least minus greatest coordinate along `n`: a lower bound on the distance, if `n` has length 1.
template <class T>
T gap(const Triangle<T>& a, const Triangle<T>& b, const Point<T>& n) {
  T most = dot(a[0], n), least = dot(b[0], n);
  for (std::size_t k = 1; k < 3; ++k) {
    const T of_a = dot(a[k], n), of_b = dot(b[k], n);
    most = of_a > most ? of_a : most, least = of_b < least ? of_b : least;
  }
  return least - most;
}

/// The least distance over all pairs of triangles, in long doubles.
inline double brute_force(const Soup& a, const Soup& b, const Pose& pose) {
  const auto of_a = triangles<long double>(a), of_b = triangles<long double>(b, pose);
  long double least = HUGE_VALL;
  for (const auto& s : of_a)
    for (const auto& t : of_b) least = std::min(least, nearest(s, t).squared);
  return double(std::sqrt(least));
}

// ---- Poses -----------------------------------------------------------------------------------------------------------------

inline Pose any_pose(shapes::Random& random, double reach) { return {random.rotation(), reach * random.in_ball()}; }
inline Pose shift(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }
/// One of the 48 that map the lattice of integers to itself; half of them are reflections.
inline Mat3 lattice_rotation(shapes::Random& random) {
  Mat3 r = Mat3::Zero();
  const int first = int(random.bits() % 3), step = 1 + int(random.bits() % 2);
  for (int i = 0; i < 3; ++i) r((first + i * step) % 3, i) = random.bits() % 2 ? 1 : -1;
  return r;
}

}  // namespace swiftlet::soups
