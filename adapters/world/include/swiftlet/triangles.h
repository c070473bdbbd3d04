// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A convex body against a surface of triangles, as engines' meshes and heightfields hand them out one by one. Inner edges are
// welded, and no triangle pushes a body through to its other side. Knows no engine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <swiftlet/world.h>

namespace swiftlet {

/// Over a body's radius or extent: what is nearer counts as one place. Some units in the last place of single precision, in
/// which engines keep meshes.
inline constexpr double kOnePlace = 0x1p-20;

/// A place of contact with one triangle, in the world's frame.
struct TrianglePoint {
  Vec3 normal;                     ///< unit, from the body to the surface
  Vec3 point_a;                    ///< on the body
  Vec3 point_b;                    ///< on the surface: `point_a` + `separation` * normal
  double separation = 0;           ///< along the normal, below 0 where they overlap
  std::uint32_t triangle = 0;      ///< its number in the order of `add`
  bool is_deepest_of_its = false;  ///< of the points that its triangle has
};

/// A side of a triangle.
enum class Side : std::uint8_t {
  Front,  ///< from which its corners turn counter-clockwise
  Back,   ///< the other one
};

/// A triangle of a surface, in the surface's frame.
struct SurfaceTriangle {
  SurfaceTriangle(const Vec3& p, const Vec3& q, const Vec3& r);  ///< of three corners
  bool has_plane() const { return front != Vec3::Zero(); }       ///< false where the corners lie on one line
  /// The side of its plane on which a point is.
  Side side_of(const Vec3& p) const { return front.dot(p - corners[0]) < 0 ? Side::Back : Side::Front; }
  bool covers(const Vec3& p, double slack) const;  ///< whether p lies above or below it, or beside it by no more than `slack`
  Vec3 nearest_to(const Vec3& p) const;            ///< its nearest point, in doubles

  std::array<Vec3, 3> corners;  ///< in the order in which they were given
  Vec3 least, most;             ///< corners of its box
  Vec3 front;                   ///< unit normal, or 0 where the corners lie on one line
};

/// Some triangles of a surface, and the rule for its edges: a direction of contact is right where no triangle that holds the
/// point rises above the plane across it.
class SurfacePatch {
 public:
  void clear();                                                              ///< forgets all triangles
  void add(const Vec3& p, const Vec3& q, const Vec3& r);                     ///< a triangle by its corners
  std::span<const SurfaceTriangle> triangles() const { return triangles_; }  ///< in the order of `add`
  /// Whether no triangle that holds `p`, to `slack`, has a corner above the plane through p across `direction`, which is unit
  /// and leads away from the surface. All triangles that hold p must have been added.
  bool is_supported(const Vec3& p, const Vec3& direction, double slack);

  /// A point of the surface.
  struct Place {
    std::uint32_t triangle;  ///< in the order of `add`
    Vec3 point;              ///< in the surface's frame
  };
  /// The nearest point to `p`, in doubles; none where no triangle is within `reach`.
  std::optional<Place> nearest_to(const Vec3& p, double reach);

 private:
  void sort();
  /// Calls `visit` for the number of each triangle whose box along x is no farther from `x` than `reach()`, which may shrink.
  template <class Reach, class Visit>
  void for_near(double x, const Reach& reach, const Visit& visit);

  std::vector<SurfaceTriangle> triangles_;
  std::vector<std::uint32_t> by_x_;  ///< their numbers, in the order of their boxes' least x
  double widest_ = 0;                ///< the greatest width of a box along x
};

/// A convex body and the triangles near it. It lives as long as the pair does: from step to step it remembers each triangle's
/// seed, and the side on which the body is.
class TrianglePair {
 public:
  void clear();  ///< forgets the triangles, not what is remembered of them
  /// Adds a triangle, its corners in the surface's frame. Names are unique within a step and stay from step to step.
  void add(std::uint64_t name, const Vec3& p, const Vec3& q, const Vec3& r);

  /// All points of contact of the body `a` with the triangles that were added, no farther apart than `beyond`; the triangles
  /// have a radius. Those that touch the body's neighbourhood must all be there, because they are each other's neighbours.
  /// `moved`: how far the body's centre moved, relative to the surface, since the step before: a triangle that is new counts
  /// as met from the side on which the body was. Those of a solid are met from the front. The answer lives until the next call.
  std::span<const TrianglePoint> contacts(const Placed& a, const Pose& surface, double radius, const Vec3& moved, double beyond,
                                          bool is_solid = false);

 private:
  struct Memory {
    std::uint64_t name;
    PairSeed seed;
    Side side = Side::Front;  ///< on which the body is
    bool is_met = false;      ///< the side is known; else the body has been far away
    bool is_over = false;     ///< the body was over the triangle's inside there: no edge is between
  };
  struct View;
  class Meeting;

  void recall();

  SurfacePatch surface_;
  std::vector<Memory> now_;       ///< of each triangle
  std::vector<Memory> memories_;  ///< of the step before, by name
  std::vector<TrianglePoint> points_;
};

/// The few of many points that stand for them.
struct Spread {
  std::array<std::uint32_t, 4> index{};  ///< [0, count): the deepest first
  std::uint32_t count = 0;               ///< at most four
};
/// Of points whose normals are alike, chooses the deepest, and those that span the largest area with it, or the ends of the
/// line on which all lie. Points that are farther apart than `touching` bear nothing yet: they come after all others.
Spread spread(std::span<const TrianglePoint> points, double touching);

}  // namespace swiftlet
