// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies and motions from fixed seeds, for demo, tests and bench alike. Knows meshes and poses; nothing of models or queries.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/pose.h>

#include "random.h"

namespace swiftlet::shapes {

/// The convex hull of the points, triangulated. At least four points, not all in one plane.
Mesh hull(std::span<const Vec3> points);

/// The bodies of [Ehmann & Lin 2000, sec. 5.3], by their semi-axes.
enum class Family { Fat, Plate, Long };
inline constexpr std::array kFamilies{Family::Fat, Family::Plate, Family::Long};
const char* name(Family family);
Vec3 semi_axes(Family family);  ///< (1, 1, 1), (1, 1, .1), (1, .1, .1)

/// Points of `on_sphere` times the semi-axes, so many that the hull has `triangles` triangles (even, at least 4); the surface's
/// centroid moved to the origin, the bounding radius scaled to 1.
Mesh ellipsoid(const Vec3& semi_axes, std::uint32_t triangles, std::uint64_t seed);

/// Two different bodies of one family.
struct Pair {
  Mesh a, b;
};
Pair pair(Family family, std::uint32_t triangles);

Mesh box(const Vec3& size);                                      ///< centred, 12 triangles
Mesh cube();                                                     ///< box of side 2
Mesh meshed_cube(std::uint32_t cells);                           ///< cube with cells * cells squares of two triangles per face
Mesh prism(std::uint32_t sides, double radius, double height);   ///< regular, along z, centred
Mesh tetrahedron();                                              ///< four corners of the cube
Mesh octahedron();                                               ///< unit axes
Mesh icosahedron();                                              ///< bounding radius 1
Mesh dodecahedron();                                             ///< in the cube; its pentagons are flat only up to rounding
Mesh needle();                                                   ///< 10 sides, length 2, radius 1e-3
Mesh sliver();                                                   ///< tetrahedron of side about 1 and height 1e-7
Mesh random_polytope(std::uint32_t points, std::uint64_t seed);  ///< hull of so many points in the unit ball
Mesh polygon(std::uint32_t sides);                               ///< flat, two-sided, in z = 0, radius 1
Mesh segment(double length);                                     ///< two points on x, no triangles
Mesh point();                                                    ///< the origin

/// The rotation about a unit axis by an angle in radians. Uses libm, whose last bit differs between machines.
Mat3 rotation(const Vec3& axis, double angle);
/// The mesh with every point mapped and rounded to double. No longer exactly convex, flat or regular.
Mesh moved(const Mesh& mesh, const Pose& pose);
/// The mesh as a file of 32-bit floats would have it.
Mesh float_rounded(const Mesh& mesh);

/// B's motion around A in the paper's experiments: along an ellipse about the origin whose nearest point is `closest` away,
/// turning about an axis of its own by the same angle. Ellipses with |sum_j exp(2 i phi_j)| > 2.5 are drawn again: they
/// degenerate to a segment through the origin. Uses libm, whose last bit differs between machines.
class Orbit {
 public:
  /// `step` in degrees per query. Steps that divide 360 repeat few poses: add an offset like 0.377, or use many orbits.
  Orbit(std::uint64_t seed, double closest, double step);
  Pose pose(std::uint64_t query) const;  ///< of B in A

 private:
  double step_;         // radians
  Vec3 cosine_, sine_;  // position is cosine_ cos(theta) - sine_ sin(theta)
  Vec3 axis_;
};

}  // namespace swiftlet::shapes
