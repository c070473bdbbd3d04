// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The builder [Ehmann & Lin 2000, sec. 4]: makes a Model from a mesh or points. A program that links it comes under CGAL's GPL;
// the models it writes are the user's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <swiftlet/executor.h>
#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// Points and the triangles over them; `read_mesh` makes triangles of polygons, concave ones too. The model is the convex hull
/// of the points; the triangles only give its faces their source ids.
struct Mesh {
  std::vector<Vec3> points;                             ///< in the frame and unit of the model
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `points`; any winding; may be empty
};

/// Reads a mesh file: OBJ, OFF, STL (ascii or binary), PLY, or SWIFT's TRI and POLY, by extension. A point cloud is legal.
/// Text is UTF-8, with or without a byte order mark; lines end in LF, CR LF or CR. Nothing that may hold a point is skipped:
/// a missing column, a word that OBJ or PLY does not have, a vertex or face that a backslash joins to a line of another word,
/// and anything after the last element are errors. Errors: no points, a non-finite point (named), not a regular file, anything
/// that the format's reader refuses (with the line, if known).
Result<Mesh> read_mesh(const std::filesystem::path& path);

/// How a coarse level is simplified from the next finer one.
enum class Method : std::uint8_t {
  Collapse,  ///< Garland & Heckbert's quadric error edge collapse [Ehmann & Lin 2000, sec. 4.5]
  Peel,      ///< removal of Dobkin & Kirkpatrick's independent sets [sec. 4.4]
};

/// How a coarse level is made to enclose level 0.
enum class Enclosing : std::uint8_t {
  Tight,  ///< each vertex is moved to where its faces just clear level 0
  Scale,  ///< the paper's way: scaling about the centre of mass, and for Peel a relaxation along rays from it
};

/// The callback that reports progress: it gets the fraction done in [0, 1], never decreasing, and the stage; returning false
/// cancels the build. It is called on the thread that called `build`, and so only where that has work itself: while levels are
/// built about every 0.25 %, or 0.2 s. CGAL's hull and the last stage, which is Model::from_levels, are not interrupted: at
/// 1 000 000 triangles each takes some seconds.
using Progress = std::function<bool(double fraction, std::string_view stage)>;

/// Options of a build. A value out of its range gives the error BadValue.
struct BuildOptions {
  Method method = Method::Collapse;        ///< how a level is simplified
  Enclosing enclosing = Enclosing::Tight;  ///< how it is made to enclose level 0
  /// Number of triangles of a level divided by that of the next finer level, in (0, 1); Peel removes as many as it can. Empty:
  /// 0.25 while the next level has at most 4 096 vertices, and above what costs queries least; a level then has no more
  /// triangles than an error of 10, 1 or 0.1 % of the radius needs, if that saves enough of them.
  std::optional<double> rate;
  std::uint32_t cutoff = 60;  ///< least number of triangles that a level is simplified to, at least 4; enclosing may drop some
  int max_levels = 32;        ///< 1 to 32, level 0 included
  double max_deviation = 0;   ///< the hierarchy ends before a level that deviates more, in the mesh's unit; 0: no limit
  /// Which of the levels built the model keeps; `detail.bytes` counts bytes of the whole model's block. With Collapse, levels
  /// finer than `detail.deviation` needs are not built, and the finest coarse level has as few triangles as that deviation
  /// allows.
  Detail detail;
  bool require_convex = false;  ///< refuse a mesh with dents
  bool require_solid = false;   ///< refuse flat, collinear and single-point input
  TableSpec table;              ///< the start table and support maps
  Progress progress;            ///< empty: no calls
  Executor executor{};          ///< runs what can be cut into tasks; empty: the calling thread does. The same bytes on any
};

/// The numbers of one level.
struct LevelReport {
  std::size_t vertices = 0, faces = 0, triangles = 0, bytes = 0;  ///< triangles: 2 V - 4 for a solid; bytes: Level::bytes
  double deviation = 0, volume_ratio = 1;  ///< Level::deviation, the mesh's unit; volume over level 0's, or 1 if that is 0
};

/// What a build read, dropped and made.
struct BuildReport {
  std::size_t points_read = 0, triangles_read = 0;  ///< counts of the mesh as given
  std::size_t duplicates_dropped = 0;               ///< number of points equal to an earlier one
  std::size_t interior_dropped = 0;  ///< number of points that are no vertex of the hull: inside it, in a face or on an edge
  std::size_t hull_triangles = 0, faces_grouped = 0;  ///< triangles of the hull; its faces of more than three vertices
  bool closed = false;      ///< the hull is solid, and each edge of the mesh's triangles has its opposite: it has a volume
  double volume_ratio = 1;  ///< the mesh's volume over the hull's, 1 for convex input; 1, not measured, where not `closed`
  /// Distance from the hull's surface to the vertex deepest inside, of those that triangles name; edges and triangles may be
  /// deeper. The mesh's unit.
  double deepest_dent = 0;
  std::vector<LevelReport> levels;  ///< level 0 first; also those that BuildOptions::detail drops
  std::string end;                  ///< why the hierarchy ended where it did
};

/// The result of `build`.
struct Built {
  Model model;         ///< ready to query or save
  BuildReport report;  ///< how the model was built
};

/// Builds a model from a mesh. Deterministic: the same input and options give the same bytes, whatever the executor and its
/// threads. Cost: on one thread about 15 microseconds per triangle, some 60 on bodies of a few thousand.
/// CGAL's quickhull takes time that grows with the square of a face's corners: 7 s for a prism of 4 000 sides
/// (`build/bin/swiftlet_shape prism 4000`).
/// Errors: Empty, BadValue (names the option, vertex or triangle), TooLarge, NotConvex and NotSolid where the options refuse,
/// Cancelled.
Result<Built> build(const Mesh& mesh, const BuildOptions& options = {});
/// Builds a model from points alone.
Result<Built> build(std::span<const Vec3> points, const BuildOptions& options = {});

}  // namespace swiftlet
