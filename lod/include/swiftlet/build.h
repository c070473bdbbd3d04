// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The builder: mesh in, Model out. Linking this library brings CGAL's GPL; the models it writes are the user's.
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

#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// Points and the triangles over them (polygons are fanned). Only the points shape a convex model; the triangles name its
/// faces.
struct Mesh {
  std::vector<Vec3> points;                             ///< in the frame and unit that the model will have
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of points; any winding; may be empty
};

/// Reads OBJ, OFF, STL (ascii or binary), PLY, and SWIFT's TRI and POLY, by file extension. A point cloud is legal.
/// Text is UTF-8, with or without its mark, and its lines end in LF, CR LF or CR. Nothing is passed over that may hold a point:
/// a missing column, a word that OBJ or PLY does not have, and what follows the last element are errors.
/// Errors: no points, a non-finite point (named), no regular file, anything the format's reader refuses (with the line where it
/// is known).
Result<Mesh> read_mesh(const std::filesystem::path& path);

/// How a coarse level is made from the one below.
enum class Method : std::uint8_t {
  Collapse,  ///< Garland & Heckbert's quadric error edge collapse [Ehmann & Lin 2000, sec. 4.5]
  Peel,      ///< Dobkin & Kirkpatrick's independent sets [sec. 4.4]
};

/// How a coarse level is made to hold level 0.
enum class Enclosing : std::uint8_t {
  Tight,  ///< each vertex moves to where its faces just clear level 0
  Scale,  ///< the paper's: scaling about the centre of mass, and for Peel a relaxation along the rays
};

/// Called with the fraction done in [0, 1], never decreasing, and what is being done; returning false cancels the build. Every
/// 0.25 % or so of the levels. CGAL's hull cannot be interrupted; the last stage, Model::from_levels, is not: at 1 000 000
/// triangles some seconds each.
using Progress = std::function<bool(double fraction, std::string_view stage)>;

/// What the hierarchy is like. Out of range: BadValue.
struct BuildOptions {
  Method method = Method::Collapse;        ///< how a level is simplified
  Enclosing enclosing = Enclosing::Tight;  ///< how it is made to hold level 0
  /// Triangles of a level over those one level finer, in (0, 1); Peel removes what it can. None: 0.25 where support maps reach,
  /// and what costs queries least elsewhere; a level then has no more triangles than an error of 10, 1 or 0.1 % of the radius
  /// asks for, where that is worth it.
  std::optional<double> rate;
  std::uint32_t cutoff = 60;  ///< no level has fewer triangles than this, nor a solid fewer than 4
  int max_levels = 32;        ///< level 0 included, 1 to 32
  double max_deviation = 0;   ///< the hierarchy ends before a level deviates more, in the mesh's unit; 0: no limit
  /// What the model keeps of the levels built; a prefix in `bytes` is that of the whole model. With Collapse no level finer
  /// than its deviation asks for is built at all, and the finest has as few triangles as that allows.
  Detail detail;
  bool require_convex = false;  ///< refuse a mesh with dents
  bool require_solid = false;   ///< refuse flat, collinear and single-point input
  TableSpec table;              ///< the start table
  Progress progress;            ///< none by default
};

/// A level in numbers.
struct LevelReport {
  std::size_t vertices = 0, faces = 0, triangles = 0, bytes = 0;  ///< triangles: 2 V - 4 for a solid
  double deviation = 0, volume_ratio = 1;  ///< the mesh's unit, as Level::deviation; volume over level 0's, 1 where that is 0
};

/// What became of a mesh.
struct BuildReport {
  std::size_t points_read = 0, triangles_read = 0;  ///< of the mesh as given
  std::size_t duplicates_dropped = 0;               ///< points equal to an earlier one
  std::size_t interior_dropped = 0;  ///< points that are no vertex of the hull: inside it, in a face or on an edge
  std::size_t hull_triangles = 0, faces_grouped = 0;  ///< triangles before grouping; faces of more than three vertices
  double volume_ratio = 1;                            ///< mesh over hull; 1 for convex input, and where the mesh does not close
  double deepest_dent = 0;                            ///< distance from the hull to the farthest mesh vertex inside it
  std::vector<LevelReport> levels;                    ///< level 0 first; also those that BuildOptions::detail drops
  std::string end;                                    ///< why the hierarchy ended where it did
};

/// What `build` returns.
struct Built {
  Model model;         ///< ready to query, or to save
  BuildReport report;  ///< how it came about
};

/// Deterministic: same input and options, same bytes. Cost: about 20 microseconds per triangle.
/// Errors: Empty, BadValue (names the option, vertex or triangle), TooLarge, NotConvex and NotSolid where the options refuse,
/// Cancelled.
Result<Built> build(const Mesh& mesh, const BuildOptions& options = {});
/// The same for bare points.
Result<Built> build(std::span<const Vec3> points, const BuildOptions& options = {});

}  // namespace swiftlet
