// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Exact signs of polynomials in stored doubles: filters decide most, expansions the rest. Knows points and poses, nothing of
// bodies. After [Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates].
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "numeric/wide.h"

namespace swiftlet::exact {

/// The sign of (b - a) x (c - a) . (d - a): positive when d lies on the side from which a, b, c appear counter-clockwise
/// (outside, for a face). Exact for coordinates that are 0 or between kLeastCoordinate and kMostCoordinate in magnitude.
int orientation(const double a[3], const double b[3], const double c[3], const double d[3]);
/// The orientation of records that begin with x, y and z.
template <class Point>
requires requires(const Point& p) { p.x; }
int orientation(const Point& a, const Point& b, const Point& c, const Point& d) { return orientation(&a.x, &b.x, &c.x, &d.x); }

/// The corners of the face opposite each corner of a positively oriented tetrahedron, counter-clockwise from outside.
inline constexpr std::uint8_t kTetrahedronFace[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// True if a, b and c lie on one line.
bool collinear(const double a[3], const double b[3], const double c[3]);

/// The plane through three points, seen counter-clockwise from where its normal points.
struct Plane {
  Vec normal;     ///< unit, right to 3 u however thin the triangle; 0 if the points lie on one line
  double height;  ///< above the origin; off by at most kPlaneHeightError * height + kPlaneHeightFloor * the largest coordinate
};
Plane plane(const Vec& a, const Vec& b, const Vec& c);
/// The plane through `p` along two vectors, seen counter-clockwise from the first to the second. The error of its height is as
/// above, of the largest coordinate of `p`.
Plane plane(const Vec& p, const Wide& u, const Wide& v);

/// The sign of n . (w - v).
int compare_along(const double n[3], const double w[3], const double v[3]);

/// n . (w - v), rounded up; exact if it is a double. Each n[i] is 0 or at least kLeastNormalEntry in magnitude.
double height_along(const double n[3], const double w[3], const double v[3]);

/// The sign of (b - a) x (c - a) . (w - v): compares w and v along the exact normal of the triangle a, b, c.
int compare_along_normal(const double a[3], const double b[3], const double c[3], const double w[3], const double v[3]);

/// The sign of n . R (w - v), where R is `motion`'s rotation as stored.
int compare_along_turned(const double n[3], const Motion& motion, const double w[3], const double v[3]);

/// The sign of the determinant of the three differences a[k] - (R b[k] + t). If `b` is three points of a plane and `a` thrice
/// one point, it tells on which side of the moved plane that point lies. If `a` is p, p, p' and `b` is q, q', q, it tells on
/// which side the line through p and p' passes the moved line through q and q'.
int triple_product(const std::array<const double*, 3>& a, const std::array<const double*, 3>& b, const Motion& motion);

// The next functions order vertices along normals of facets and edges of two bodies, unfiltered: callers try rounded normals
// first. They are exact while no product of three coordinates and two entries of R has a bit below 2^-1074.

/// The sign of (b - a) x (c - a) . R (w - v).
int compare_turned_along_normal(const double a[3], const double b[3], const double c[3], const Motion& motion,
                                const double w[3], const double v[3]);

/// The sign of R (b - a) x R (c - a) . (w - v).
int compare_along_turned_normal(const Motion& motion, const double a[3], const double b[3], const double c[3],
                                const double w[3], const double v[3]);

/// R (b - a) x R (c - a), each coordinate rounded from the exact one to 100 bits of itself.
Wide turned_normal(const Motion& motion, const double a[3], const double b[3], const double c[3]);

/// (b - a) x R (w - v), each coordinate rounded from the exact one to 100 bits of itself.
Wide edge_normal(const double a[3], const double b[3], const Motion& motion, const double w[3], const double v[3]);

/// True if the origin lies in the closed convex hull of the four points a[k] - (R b[k] + t). False if these are coplanar.
bool tetrahedron_holds_origin(const std::array<std::array<double, 3>, 4>& a, const std::array<std::array<double, 3>, 4>& b,
                              const Motion& motion);

}  // namespace swiftlet::exact
