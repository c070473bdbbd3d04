// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangle meshes as bodies of queries: immutable, shared, one block of memory that is also the file. Knows nothing of poses or
// queries (mesh_query.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <swiftlet/body.h>
#include <swiftlet/pose.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// What a mesh is made of, counted after equal points became one vertex. Whatever the numbers, queries answer about all the
/// triangles as they are.
struct MeshTopology {
  std::uint32_t components = 0;          ///< sets of triangles joined by common edges
  std::uint32_t open_edges = 0;          ///< edges of a single triangle
  std::uint32_t non_manifold_edges = 0;  ///< edges of more than two triangles
  std::uint32_t flipped_edges = 0;       ///< edges that their two triangles run along in the same direction
  std::uint32_t flat_triangles = 0;      ///< triangles whose corners lie on one line, decided exactly: segments and points
  std::uint32_t duplicates = 0;          ///< triangles with the corners of an earlier one, in any order
  double volume = 0;  ///< enclosed, in cubic units, negative for a surface that is inside out; 0 unless `closed()`

  /// True if the triangles bound a volume: each edge has two triangles, which run along it in opposite directions.
  bool closed() const { return open_edges + non_manifold_edges + flipped_edges == 0; }
  bool operator==(const MeshTopology&) const = default;  ///< compares all members
};

/// Options of MeshModel::from_triangles.
struct MeshOptions {
  /// Gets the fraction done in [0, 1], never decreasing; returning false cancels. Empty: no calls.
  std::function<bool(double fraction)> progress;
};

/// The largest number of triangles of a mesh.
inline constexpr std::uint32_t kMostTriangles = 1u << 27;

/// A set of triangles and a tree of boxes over them, in one block of memory that is also the file's content. Copies share the
/// block, which never changes; any number of threads may query it.
///
/// The surface alone is the body, unless MeshBody::solid asks about the volume: of two closed meshes, one inside the other,
/// the distance is that of their surfaces. Triangles may be open, inside out, duplicate, crossing or flat.
///
/// Vertices and triangles are kept in the order of the tree. Indices of this order name them in a `FeatureId`: a vertex by its
/// own, a face by its triangle's, edge k of triangle t, from corner k to the next one, by 3 t + k.
class MeshModel {
 public:
  /// Makes a mesh of `triangles` over `points`. Each coordinate is 0 or from 1e-45 to 1e45 in magnitude, in the caller's unit,
  /// else the error names the point. Points that no triangle has are dropped. The same input gives the same bytes. Cost: about
  /// 2 microseconds and, of surfaces whose triangles share their corners, 90 bytes a triangle. Errors: Empty, BadValue,
  /// TooLarge, Cancelled.
  static Result<MeshModel> from_triangles(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles,
                                          const MeshOptions& options = {});

  std::size_t vertex_count() const;                                ///< vertices kept, at least 1; 0 of a mesh that was cut
  std::size_t triangle_count() const;                              ///< as many as were given, at least 1; 0 likewise
  Vec3 vertex(std::size_t index) const;                            ///< a vertex in the body's frame
  std::array<std::uint32_t, 3> triangle(std::size_t index) const;  ///< the vertices of a triangle, in the user's order
  std::span<const std::uint32_t> source_vertex() const;    ///< per vertex, the user's point there that a triangle names first
  std::span<const std::uint32_t> source_triangle() const;  ///< per triangle, the user's triangle
  const MeshTopology& topology() const;                    ///< what the mesh is made of

  Vec3 box_min() const;            ///< body frame: smallest coordinates
  Vec3 box_max() const;            ///< body frame: largest coordinates
  double extent() const;           ///< largest absolute coordinate
  std::size_t node_count() const;  ///< nodes of the tree, each with up to eight children
  std::size_t hull_count() const;  ///< nodes that have a convex hull (build_mesh.h)
  bool is_whole() const;           ///< true unless the mesh was cut
  int level_count() const;         ///< levels of nodes that the mesh has, at least 1; fewer than `depth` if it was cut
  int depth() const;               ///< levels of nodes of the whole tree
  /// How far a point of the mesh cut after so many levels, from 1 to depth() - 1, may be from the surface; of a whole
  /// mesh 0. In the body's unit.
  double deviation(int levels) const;
  double deviation() const { return is_whole() ? 0 : deviation(level_count()); }  ///< that of this mesh
  /// Returns the mesh without the triangles and without the lower levels of nodes that `detail` allows to leave out: what is
  /// left is boxes around the surface, none farther from it than `deviation`. Any distance is then answered with an error of at
  /// most the sum of both meshes' deviations, status LevelLimit, and no feature; as a solid it is InvalidBody. Beside another
  /// solid `lower` is 0 unless the trees' roots show a plane between both: nothing tells which parts are inside. A mesh of one
  /// level is returned as it is.
  MeshModel cut(const Detail& detail) const;
  std::span<const std::byte> bytes() const;  ///< the block, which is what `save` writes
  std::uint64_t hash() const;                ///< hash over all of `bytes()`, which it reads; equal blocks have equal hashes

 private:
  friend class MeshReader;
  struct Content;
  explicit MeshModel(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// Returns the mesh with its points moved: `points` are the user's, in the order in which `from_triangles` got them, each
/// coordinate as there. Triangles, ids and the tree's nodes stay; boxes are put around the triangles where they are now, along
/// new axes where the surface has turned; hulls are dropped (rebuild_hulls in build_mesh.h). Queries are as true as of a mesh
/// made anew, and slower as far as triangles that were neighbours no longer are. Of points that were equal the first one is
/// read: they must move alike. Points that come to be equal are not joined: `topology` counts flat triangles and the volume
/// anew, not what edges say. With no point moved, and without hulls, the bytes are the same, unless triangles are flat up to
/// rounding: their areas, which weigh the axes, are then rounding errors. Cost: about a quarter of `from_triangles`. Errors:
/// BadValue for a coordinate, too few points, or a mesh that was cut.
Result<MeshModel> refit(const MeshModel& mesh, std::span<const Vec3> points);

/// A body of mesh queries: a mesh, which is its surface, the solid that a closed mesh bounds, or any convex `Body`. It is a
/// view: what it is made of must outlive every query about it and not move. Within its radius all points belong to the body.
class MeshBody {
 public:
  /// A mesh and all points within `radius` of it.
  MeshBody(const MeshModel& mesh, double radius = 0) : mesh_(&mesh), radius_(radius) {}
  MeshBody(const MeshModel&&, double radius = 0) = delete;  ///< a temporary mesh would not outlive the expression
  /// A closed mesh, the volume that it encloses and all points within `radius` of these. Enclosed is a point from which a ray
  /// crosses the surface an odd number of times, whichever way triangles face: components within others are cavities. Queries
  /// answer InvalidBody unless `topology().closed()` and `is_whole()`.
  static MeshBody solid(const MeshModel& mesh, double radius = 0) {
    MeshBody body(mesh, radius);
    body.is_solid_ = true;
    return body;
  }
  static MeshBody solid(const MeshModel&&, double radius = 0) = delete;  ///< a temporary mesh would not outlive the expression
  /// A convex body with its radius.
  MeshBody(const Body& convex) : convex_(convex), radius_(convex.radius()) {}

  const MeshModel* mesh() const { return mesh_; }  ///< null for a convex body
  const Body& convex() const { return convex_; }   ///< of a mesh a body that queries refuse
  double radius() const { return radius_; }        ///< in the body's unit
  bool is_solid() const { return is_solid_; }      ///< true of a mesh whose volume belongs to it

 private:
  const MeshModel* mesh_ = nullptr;
  Body convex_;
  double radius_;
  bool is_solid_ = false;
};

/// The version of the file format that `save` writes for meshes. Files of any other version are refused.
inline constexpr std::uint32_t kMeshFileVersion = 2;

/// Writes PATH.XXXX.part, then renames it: a failure leaves the old file, of calls at once one wins whole, and what a killed
/// process leaves by such a name may be deleted. Returns the bytes written. Errors: CannotWrite, with the cause.
Result<std::size_t> save(const MeshModel& mesh, const std::filesystem::path& path);

/// Reads a mesh from its file. Checks sizes, hashes and the ranges of indices, and that no number is infinite or NaN; that
/// boxes hold their triangles is not checked, see `verify` in mesh_query.h. Cost: one pass over the file. Errors: CannotRead,
/// BadFormat, BadVersion, TooLarge. Of a mesh that `detail` cuts only what is kept is read: it comes first in the file.
Result<MeshModel> load_mesh(const std::filesystem::path& path, const Detail& detail = {});

/// Loads a mesh from the bytes of a file, which are copied.
Result<MeshModel> load_mesh(std::span<const std::byte> bytes);

/// Loads a mesh without a copy: its memory is the mapped file, whose pages processes share. The file's content must not change
/// while the mesh or a copy of it lives. Errors: as `load_mesh`.
Result<MeshModel> map_mesh(const std::filesystem::path& path);

/// The result of `salvage_mesh`.
struct SalvagedMesh {
  MeshModel mesh;    ///< holds the levels of nodes that are complete in the file
  std::string note;  ///< one sentence that says what is missing; empty for a whole file
};

/// Reads the complete levels of nodes of a file that was cut short, as `MeshModel::cut` leaves them. Errors: as `load_mesh`,
/// but BadFormat for a short file only if not even the root is complete, or of a mesh of one level: it has none to leave out.
Result<SalvagedMesh> salvage_mesh(const std::filesystem::path& path);

/// True if a file begins as a mesh's does.
bool is_mesh_file(const std::filesystem::path& path);

}  // namespace swiftlet
