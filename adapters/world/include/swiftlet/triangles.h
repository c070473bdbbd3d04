// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A model against a surface of triangles, as engines' meshes and heightfields hand them out one by one. Inner edges are welded,
// and no triangle pushes a model through to its other side. Knows no engine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <swiftlet/world.h>

namespace swiftlet {

/// A place of contact with one triangle, in the world's frame.
struct TrianglePoint {
  Vec3 normal;                     ///< unit, from the model to the surface
  Vec3 point_a;                    ///< on the model
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

/// A model and the triangles near it. It lives as long as the pair does: from step to step it remembers each triangle's seed,
/// and the side on which the model is.
class TrianglePair {
 public:
  void clear();  ///< forgets the triangles, not what is remembered of them
  /// Adds a triangle, its corners in the surface's frame. Names are unique within a step and stay from step to step.
  void add(std::uint64_t name, const Vec3& p, const Vec3& q, const Vec3& r);

  /// All points of contact of the model `a` with the triangles that were added, no farther apart than `beyond`; the triangles
  /// have a radius. Those that touch the model's neighbourhood must all be there, because they are each other's neighbours.
  /// `moved`: how far the model's centre moved, relative to the surface, since the step before: a triangle that is new counts
  /// as met from the side on which the model was. The answer lives until the next call.
  std::span<const TrianglePoint> contacts(const Placed& a, const Pose& surface, double radius, const Vec3& moved,
                                          double beyond);

 private:
  struct Memory {
    std::uint64_t name;
    PairSeed seed;
    Side side;  ///< on which the model is
  };
  struct Triangle {
    std::array<Vec3, 3> corners;
    Vec3 least, most;  ///< corners of its box
    Vec3 front;        ///< unit normal, or 0 where the corners lie on one line
    Memory memory;

    bool has_plane() const { return front != Vec3::Zero(); }
    Side side_of(const Vec3& p) const { return front.dot(p - corners[0]) < 0 ? Side::Back : Side::Front; }
    Vec3 up() const { return memory.side == Side::Front ? front : Vec3(-front); }  ///< towards the model
    bool covers(const Vec3& p, double slack) const;
    double distance_from(const Vec3& p) const;
  };
  struct View;
  class Meeting;

  void recall(const Vec3& before);
  bool is_supported(const View& view, const Vec3& p, const Vec3& direction) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> by_x_;  ///< their numbers, in the order of their boxes' least x
  double widest_ = 0;                ///< the greatest width of a box along x
  std::vector<Memory> memories_;     ///< of the step before, by name
  std::vector<TrianglePoint> points_;
};

/// The few of many points that stand for them.
struct Spread {
  std::array<std::uint32_t, 4> index{};  ///< [0, count): the deepest first
  std::uint32_t count = 0;               ///< at most four
};
/// Of points whose normals are alike, chooses the deepest, and those that span the largest area with it.
Spread spread(std::span<const TrianglePoint> points);

}  // namespace swiftlet
