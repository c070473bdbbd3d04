// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes in contact: with another mesh, with a half-space, and the way out of a solid. Knows shapes, and none of Bullet's
// manifolds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <swiftlet/bullet.h>
#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>
#include <swiftlet/mesh_visit.h>
#include <swiftlet/triangles.h>

#include "point_groups.h"

namespace swiftlet::bullet {

/// A box that is turned against a mesh.
struct SearchBox {
  Vec3 least, most;  ///< its corners, in its own frame
  Pose in_mesh;      ///< of its frame
};

/// Whether a box along a mesh's axes may meet a search box: by the axes of both.
class MayMeet {
 public:
  explicit MayMeet(const SearchBox& box);
  bool operator()(const Vec3& box_min, const Vec3& box_max) const;

 private:
  SearchBox box_;
  Mat3 width_;         ///< how wide a box is along other axes: absolute entries of the rotation
  Vec3 least_, most_;  ///< of the box around the search box, along the mesh's axes
};

/// Calls `add(triangle, p, q, r)` for each triangle of the mesh that may meet the box.
template <class Add>
void for_triangles(const MeshModel& mesh, const SearchBox& box, const Add& add) {
  struct Visitor final : MeshVisitor {
    Visitor(const MeshModel& of, const SearchBox& in, const Add& to) : mesh(of), may_meet(in), add(to) {}
    bool enters(const Vec3& box_min, const Vec3& box_max) override { return may_meet(box_min, box_max); }
    bool visit(std::uint32_t t) override {
      const auto [p, q, r] = mesh.triangle(t);
      add(t, mesh.vertex(p), mesh.vertex(q), mesh.vertex(r));
      return true;
    }
    const MeshModel& mesh;
    const MayMeet may_meet;
    const Add& add;
  } visitor(mesh, box, add);
  visit_triangles(mesh, visitor);
}

/// A mesh where Bullet holds it, or a convex body.
struct PlacedMeshShape {
  PlacedMeshShape(const MeshShape& of, const Pose& at) : shape(&of), in_world(at) {}
  explicit PlacedMeshShape(const Placed& of) : convex(of.body), in_world(of.in_world) {}

  const MeshShape* shape = nullptr;  ///< null of a convex body
  Body convex;
  Pose in_world;

  const MeshModel& mesh() const { return shape->mesh(); }
  bool is_solid() const { return !shape || shape->is_solid(); }
  double radius() const { return shape ? double(shape->getMargin()) : convex.radius(); }
  /// The surface and the margin around it.
  MeshBody surface() const { return shape ? MeshBody(mesh(), radius()) : MeshBody(convex); }
  /// The body without its margin: what it encloses too, if it is a solid.
  MeshBody core() const;
};

/// Remembers of a convex body and a solid that the body was inside when they met, until it is out.
class Enclosed {
 public:
  bool may_hold() const { return state_ != State::Outside; }
  /// While the body's centre is inside: the shortest way out that is known, at the centre. `moved`: as TrianglePair has it.
  std::optional<TrianglePoint> way_out(const PlacedMeshShape& mesh, const Placed& body, const Vec3& centre, const Vec3& moved);

 private:
  enum class State : std::uint8_t { Unknown, Inside, Outside } state_ = State::Unknown;
};

/// Two meshes, or a mesh and a convex body that is no smaller. It lives as long as the pair does: from step to step it
/// remembers where they were, and which vertices are beyond a surface that encloses nothing.
class MeshPair {
 public:
  /// All points of contact, no farther apart than `beyond`, of `a` with `b`. `moved`: how far `a` moved, relative to `b`, in
  /// the step before; read when both meet. The answer lives until the next call.
  std::span<const TrianglePoint> contacts(const PlacedMeshShape& a, const PlacedMeshShape& b, const Vec3& moved, double beyond);
  /// The nearest or deepest one.
  std::optional<TrianglePoint> nearest(const PlacedMeshShape& a, const PlacedMeshShape& b, double beyond);
  /// Forgets which vertices are beyond a surface, where one of both meshes is another now. Normals are remembered by places.
  void forget_vertices() { through_ = {}; }
  /// By the `triangle` of a point.
  std::span<const PointIds> ids() const { return ids_; }

 private:
  struct Step;
  class Corners;
  /// A vertex, and one of its triangles.
  struct Candidate {
    std::uint32_t vertex, triangle;
  };
  /// What `Corners` gathers.
  struct Near {
    SurfacePatch own, other;
    std::vector<std::uint32_t> others;  ///< the triangles of `other`
    std::vector<Candidate> candidates;
    std::vector<std::uint32_t> through;
  };

  void add(const Step& step, const Vec3& normal, const Vec3& point_a, const Vec3& point_b, double separation, PointIds ids);
  bool add_way_out(const Step& step);
  void add_region(const Step& step, const MeshContact& region, std::size_t of_vertices);

  std::vector<MeshContact> regions_;
  std::vector<TrianglePoint> points_;
  std::vector<PointIds> ids_;
  std::array<std::vector<std::uint32_t>, 2> through_;  ///< vertices of A, of B, that are beyond the other's surface; sorted
  std::optional<Pose> b_in_a_before_;
  bool nested_ = false;  ///< since they met one was inside the other as a whole
  struct Known {
    Vec3 place, normal;  ///< of a region of the step before, in A's frame
  };
  std::vector<Known> known_, found_;
  Near near_;
  MeshSeed seed_;
};

/// The vertices of a mesh that are no farther above a half-space than `beyond`, as points of contact of `a` with it.
void contacts(const PlacedMeshShape& a, const HalfSpace& b, double beyond, std::vector<TrianglePoint>& points,
              std::vector<PointIds>& ids);

}  // namespace swiftlet::bullet
