// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The baselines' arithmetic on three numbers, and ways around a ConvexView. Frozen: see README.md. Functions are static, so
// that every unit compiles its own copy under its own floating-point flags.
#pragma once

#include <cmath>
#include <cstdint>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>

namespace swiftlet::yardstick {

struct Vec {
  double x, y, z;
};
static inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
static inline Vec operator*(const Vec& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
static inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }

/// Of two numbers that are no NaN. std::fmax is a call.
static inline double larger(double x, double y) { return x < y ? y : x; }
static inline double smaller(double x, double y) { return y < x ? y : x; }

static inline Vec vec(const Vertex& v) { return {v.x, v.y, v.z}; }
static inline Vec vec(const Vec3& v) { return {v[0], v[1], v[2]}; }
static inline Vec3 eigen(const Vec& v) { return Vec3(v.x, v.y, v.z); }

/// A pose unpacked: rows of the rotation, translation.
struct Motion {
  Vec row_x, row_y, row_z, t;
};
static inline Motion motion(const Pose& pose) {
  const Mat3& r = pose.rotation;
  return {{r(0, 0), r(0, 1), r(0, 2)}, {r(1, 0), r(1, 1), r(1, 2)}, {r(2, 0), r(2, 1), r(2, 2)}, vec(pose.translation)};
}
static inline Vec turn(const Motion& m, const Vec& p) { return {dot(m.row_x, p), dot(m.row_y, p), dot(m.row_z, p)}; }
static inline Vec apply(const Motion& m, const Vec& p) { return turn(m, p) + m.t; }
/// The transposed rotation.
static inline Vec turn_back(const Motion& m, const Vec& n) { return m.row_x * n.x + m.row_y * n.y + m.row_z * n.z; }

// ---- Ways around a view ----------------------------------------------------------------------------------------------------

static inline std::uint32_t origin(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[v.half_edges[half_edge].twin].head;
}
static inline std::uint32_t right_face(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[v.half_edges[half_edge].twin].face;
}
static inline bool is_diagonal(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[half_edge].face == right_face(v, half_edge) && v.half_edges[half_edge].face != kNone;
}

// Around a ring by arithmetic: of branches some would be guessed wrong in every ring.

/// The half-edge before `half_edge`, clockwise, in the ring of `vertex`, its origin.
static inline std::uint32_t clockwise(const Vertex& vertex, std::uint32_t half_edge) {
  return half_edge - 1 + (half_edge == vertex.ring_begin) * vertex.ring_count;
}
/// The one after it, counter-clockwise.
static inline std::uint32_t counter_clockwise(const Vertex& vertex, std::uint32_t half_edge) {
  return half_edge + 1 - (half_edge + 1 == vertex.ring_begin + vertex.ring_count) * vertex.ring_count;
}
/// The half-edge after `half_edge` around the exact facet on its left.
static inline std::uint32_t next_in_facet(const ConvexView& v, std::uint32_t half_edge) {
  return clockwise(v.vertices[v.half_edges[half_edge].head], v.half_edges[half_edge].twin);
}
/// The half-edge after `half_edge` around the face on its left: as in the facet, past diagonals.
static inline std::uint32_t next_in_face(const ConvexView& v, std::uint32_t half_edge) {
  std::uint32_t h = next_in_facet(v, half_edge);
  while (is_diagonal(v, h)) h = clockwise(v.vertices[origin(v, h)], h);
  return h;
}

}  // namespace swiftlet::yardstick
