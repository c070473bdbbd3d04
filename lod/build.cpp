// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way from points to a model: hull, levels, bake, and the account of it. Decides nothing that a stage decides.
#include <swiftlet/build.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "bake.h"
#include "hierarchy.h"
#include "hull.h"
#include "trace.h"

namespace swiftlet {
namespace {

using namespace lod;

constexpr double kHullDone = 0.15;        ///< of a build
constexpr double kMostCoordinate = 1e45;  ///< LevelArrays::vertices; beyond, squares of what is built on the way overflow

std::optional<Error> problem(const BuildOptions& options) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadValue, message}; };
  if (options.rate && !(*options.rate > 0 && *options.rate < 1)) return bad("rate must lie between 0 and 1, without either");
  if (options.max_levels < 1 || options.max_levels > 32) return bad("max_levels must be from 1 to 32");
  if (!(options.max_deviation >= 0) || !std::isfinite(options.max_deviation))
    return bad("max_deviation must be finite and not negative");
  if (options.method > Method::Peel || options.enclosing > Enclosing::Scale)
    return bad("method or enclosing is none that there is");
  if (!std::isfinite(options.table.radius_factor) || options.table.radius_factor < 1)
    return bad("table.radius_factor must be at least 1");
  return std::nullopt;
}

std::optional<Error> problem(const Mesh& mesh) {
  if (mesh.points.empty()) return Error{ErrorCode::Empty, "the mesh has no points"};
  if (mesh.points.size() > (1u << 30)) return Error{ErrorCode::TooLarge, "the mesh has more than 2^30 points"};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.points[v].allFinite()) return Error{ErrorCode::BadValue, "vertex " + std::to_string(v) + " is not finite"};
    for (const double x : mesh.points[v]) {
      if (std::abs(x) > kMostCoordinate) {
        std::ostringstream text;
        text << "vertex " << v << " has the coordinate " << x;
        return Error{ErrorCode::BadValue, text.str()};
      }
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (corner >= mesh.points.size())
        return Error{ErrorCode::BadValue, "triangle " + std::to_string(t) + " names vertex " + std::to_string(corner) + " of " +
                                              std::to_string(mesh.points.size())};
  return std::nullopt;
}

/// The power of two that brings the largest coordinate into [1/2, 1), so that no size under- or overflows on the way.
double unit_scale(const std::vector<Vec3>& points) {
  double size = 0;
  for (const Vec3& p : points) size = std::max(size, p.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

Mesh scaled(Mesh mesh, double scale) {
  for (Vec3& p : mesh.points) p *= scale;
  return mesh;
}

/// A flat body has two sides; a triangle is on the one whose normal it shares.
void add_two_sides(const Mesh& mesh, const Hull& shape, Finest& finest) {
  std::vector<std::uint32_t> loop(shape.vertices.size());
  for (std::uint32_t k = 0; k < loop.size(); ++k) loop[k] = k;
  finest.faces = {loop, {loop.rbegin(), loop.rend()}};
  finest.face_sources.resize(2);
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 2; k < loop.size(); ++k)
    normal += area_normal(mesh.points[shape.vertices[0]], mesh.points[shape.vertices[k - 1]], mesh.points[shape.vertices[k]]);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    finest.face_sources[normal.dot(area_normal(mesh.points[a], mesh.points[b], mesh.points[c])) < 0].push_back(t);
  }
}

/// `mesh` is the user's, scaled: what is small beside the largest coordinate may have been lost on the way.
Finest finest_level(const Mesh& users, const Mesh& mesh, const Hull& shape, const Polytope& body) {
  Finest finest;
  finest.sources = shape.vertices;
  for (std::uint32_t v : shape.vertices) finest.vertices.push_back(users.points[v]);
  if (shape.dimension == 2) add_two_sides(mesh, shape, finest);
  if (shape.dimension < 3) return finest;
  for (const Triangle& triangle : body.triangles) finest.faces.emplace_back(triangle.begin(), triangle.end());
  finest.face_sources = triangles_on(mesh, shape, body);
  return finest;
}

bool has_dents(const Mesh& mesh, const Polytope& body, const BuildReport& report, double scale) {
  const double rounding = rounding_of(mesh.points);
  return report.deepest_dent * scale > rounding || report.volume_ratio < 1 - rounding * area(body) / volume(body);
}

void describe(const Model& model, BuildReport& report) {
  for (int k = 0; k < model.level_count(); ++k) {
    const Level& level = model.level(k);
    report.levels.push_back({level.view.vertices.size(), level.view.face_first.size(), level.triangle_count, level.bytes,
                             level.deviation, model.volume() > 0 ? level.volume / model.volume() : 1});
  }
  const Level& finest = model.level(0);
  report.faces_grouped = finest.view.planes.size();
}

Result<Built> build_watched(const Mesh& users, const BuildOptions& options, Watch& watch) {
  watch.begin("hull", kHullDone, 3);
  const double scale = unit_scale(users.points);
  const Mesh mesh = scaled(users, scale);
  const Hull shape = hull(mesh.points);
  watch.work();
  const Polytope body = solid(mesh.points, shape);
  BuildReport report;
  report.points_read = mesh.points.size(), report.triangles_read = mesh.triangles.size();
  report.duplicates_dropped = shape.duplicates, report.interior_dropped = shape.interior;
  report.hull_triangles = body.triangles.size();
  Hierarchy levels{{}, "the body is not solid and has one level"};
  if (shape.dimension == 3) {
    report.volume_ratio = volume_ratio(mesh, body);
    watch.work();
    report.deepest_dent = deepest_dent(mesh, shape, body) / scale;
    if (options.require_convex && has_dents(mesh, body, report, scale))
      return Error{ErrorCode::NotConvex, "the mesh has dents, the deepest " + std::to_string(report.deepest_dent)};
    BuildOptions in_scale = options;
    in_scale.detail.deviation *= scale;
    levels = hierarchy(body, in_scale, watch);
  } else if (options.require_solid) {
    return Error{ErrorCode::NotSolid, "all points lie in one plane"};
  }
  watch.begin("bake", 1, 1);

  report.end = levels.end;
  Result<Model> model = bake(finest_level(users, mesh, shape, body), levels.levels, scale, options, report.end);
  if (!model) return model.error();
  describe(model.value(), report);
  watch.end();
  return Built{model.value().cut(options.detail), std::move(report)};
}

}  // namespace

Result<Built> build(const Mesh& users, const BuildOptions& options) try {
  if (const auto error = problem(options)) return *error;
  if (const auto error = problem(users)) return *error;
  Watch watch(options.progress);
  return build_watched(users, options, watch);
} catch (const Cancelled&) {
  return Error{ErrorCode::Cancelled, "the progress callback cancelled the build"};
}

Result<Built> build(std::span<const Vec3> points, const BuildOptions& options) {
  return build(Mesh{{points.begin(), points.end()}, {}}, options);
}

}  // namespace swiftlet
