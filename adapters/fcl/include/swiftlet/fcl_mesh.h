// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes in FCL 0.7: a BVHModel that holds a mesh, and what its pairs are asked. Knows no solver and none of FCL's tables:
// fcl.h brings both.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>

#include <swiftlet/mesh.h>
#include <swiftlet/mesh_query.h>

namespace swiftlet::fcl {

/// What holds a mesh, whatever FCL's boxes around it are.
class MeshHolder {
 public:
  const MeshModel& mesh() const { return mesh_; }  ///< in double precision, as given

 protected:
  /// Shares the mesh's block. Throws std::invalid_argument where the mesh was cut: it has no triangles.
  explicit MeshHolder(const MeshModel& mesh);
  ~MeshHolder() = default;

 private:
  MeshModel mesh_;
};

/// The triangles of a mesh, each at its place in the user's order.
std::vector<std::array<std::uint32_t, 3>> triangles_in_users_order(const MeshModel& mesh);

/// An fcl::BVHModel of a mesh's triangles; to every other solver it is just that. `BV` is any of FCL's boxes. Triangles keep
/// the user's numbers, so that FCL's b1 and b2 name them. Its vertices must not be replaced or updated.
template <class BV>
class Mesh final : public ::fcl::BVHModel<BV>, public MeshHolder {
 public:
  /// Shares the mesh's block, and builds FCL's tree. Throws std::invalid_argument where the mesh was cut: it has no triangles.
  explicit Mesh(const MeshModel& mesh) : MeshHolder(mesh) {
    using Scalar = typename BV::S;
    std::vector<::fcl::Vector3<Scalar>> points;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) points.push_back(mesh.vertex(i).template cast<Scalar>());
    std::vector<::fcl::Triangle> triangles;
    for (const auto& [p, q, r] : triangles_in_users_order(mesh)) triangles.emplace_back(p, q, r);
    this->beginModel(int(triangles.size()), int(points.size()));
    this->addSubModel(points, triangles);
    this->endModel();
  }
};

/// A mesh of an fcl::BVHModel, once and for all: `Mesh<BV>(mesh_of(theirs).value())`. Errors: as MeshModel::from_triangles;
/// Empty of a cloud of points.
template <class BV>
Result<MeshModel> mesh_of(const ::fcl::BVHModel<BV>& theirs) {
  std::vector<Vec3> points;
  for (int i = 0; i < theirs.num_vertices; ++i) points.push_back(theirs.vertices[i].template cast<double>());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i < theirs.num_tris; ++i) {
    const ::fcl::Triangle& t = theirs.tri_indices[i];
    triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
  }
  return MeshModel::from_triangles(points, triangles);
}

/// A body of a mesh query where it is in the world.
struct PlacedMesh {
  MeshBody body;  ///< a mesh or a convex body, with its radius
  Pose in_world;  ///< as of Placed
};

/// What is known of a pair with a mesh. Points are in the world's frame.
struct MeshMeeting {
  Status status = Status::NotAsked;                     ///< InvalidPose, InvalidBody, InvalidRadius: the kernel does not answer
  Verdict verdict = Verdict::Undecided;                 ///< of the bodies
  double distance = 0;                                  ///< the certified lower bound
  int triangle_a = -1, triangle_b = -1;                 ///< the user's triangles where they are nearest; -1 of a convex body
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< where they are nearest, or of a crossing
  /// Whether the kernel answers.
  bool is_known() const {
    return status != Status::InvalidPose && status != Status::InvalidBody && status != Status::InvalidRadius;
  }
};

/// A contact of a pair with a mesh, in the world's frame.
struct MeshTouch {
  int triangle_a = -1, triangle_b = -1;  ///< the user's triangles that are the nearest of its region; -1 of a convex body
  Vec3 normal = Vec3::Zero();            ///< unit, from 1 to 2; 0 where no direction leads out
  Vec3 point = Vec3::Zero();             ///< between the surfaces
  double depth =
      0;  ///< how far the triangles of the region reach into one another there, above 0: `tolerance` where they touch
};

/// The contacts of two bodies, one of them a mesh, that share a point: up to four of each region of the surfaces, the deepest
/// first.
std::vector<MeshTouch> touches_of(const PlacedMesh& a, const PlacedMesh& b);

/// Whether two bodies, one of them a mesh, share a point. `distance` means nothing.
MeshMeeting meeting_of(const PlacedMesh& a, const PlacedMesh& b, MeshSeed& seed);
/// How far apart they are, within the errors of `options`; Status::Beyond where they are farther apart than `options.beyond`.
MeshMeeting distance_of(const PlacedMesh& a, const PlacedMesh& b, const Options& options, MeshSeed& seed);

}  // namespace swiftlet::fcl
