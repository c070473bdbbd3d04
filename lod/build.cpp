// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The way from points to a model: hull, levels, bake, and the account of it. Decides nothing that a stage decides.
#include <swiftlet/build.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "bake.h"
#include "body/table.h"
#include "hierarchy.h"
#include "hull.h"
#include "hull_model.h"
#include "numeric/chunks.h"
#include "numeric/decimal.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"
#include "trace.h"

namespace swiftlet {
namespace {

using namespace lod;

constexpr double kHullDone = 0.15;  ///< of a build

std::optional<Error> problem(const BuildOptions& options) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadValue, message}; };
  if (options.rate && !(*options.rate > 0 && *options.rate < 1)) return bad("rate must lie between 0 and 1, without either");
  if (options.cutoff < 4) return bad("cutoff must be at least 4");
  if (options.max_levels < 1 || options.max_levels > 32) return bad("max_levels must be from 1 to 32");
  if (!(options.max_deviation >= 0) || !std::isfinite(options.max_deviation))
    return bad("max_deviation must be finite and not negative");
  if (!(options.detail.deviation >= 0)) return bad("detail.deviation must not be negative");
  if (options.method > Method::Peel || options.enclosing > Enclosing::Scale)
    return bad("method or enclosing is none that there is");
  if (std::string fault = spec_fault(options.table); !fault.empty()) return Error{ErrorCode::BadValue, std::move(fault)};
  return std::nullopt;
}

Error past_limit(std::size_t vertex, double x, double limit) {
  const char* const where = std::abs(x) < limit ? ", below" : ", beyond";
  return {ErrorCode::BadValue, "vertex " + std::to_string(vertex) + " has the coordinate " + decimal(x, 6) + where +
                                   " the limit of " + decimal(limit, 6)};
}

std::optional<Error> problem(const Mesh& mesh) {
  if (mesh.points.empty()) return Error{ErrorCode::Empty, "the mesh has no points"};
  if (mesh.points.size() > (1u << 30)) return Error{ErrorCode::TooLarge, "the mesh has more than 2^30 points"};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.points[v].allFinite()) return Error{ErrorCode::BadValue, "vertex " + std::to_string(v) + " is not finite"};
    for (const double x : mesh.points[v]) {
      if (std::abs(x) > kMostCoordinate) return past_limit(v, x, kMostCoordinate);
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (corner >= mesh.points.size())
        return Error{ErrorCode::BadValue, "triangle " + std::to_string(t) + " names vertex " + std::to_string(corner) + " of " +
                                              std::to_string(mesh.points.size())};
  return std::nullopt;
}

/// What is small is refused of the hull's vertices alone.
std::optional<Error> problem(const Mesh& users, const Hull& shape) {
  for (const std::uint32_t v : shape.vertices)
    for (const double x : users.points[v])
      if (!is_legal_coordinate(x)) return past_limit(v, x, kLeastCoordinate);
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

/// Writes which triangles lie on which of so many faces; `face_of` gives the face of each, or none that there is.
void list_sources(const std::vector<std::uint32_t>& face_of, std::size_t faces, Finest& finest) {
  std::vector<std::uint32_t>& begin = finest.face_source_begin;
  begin.assign(faces + 2, 0);
  for (const std::uint32_t face : face_of)
    if (face < faces) ++begin[face + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  finest.face_sources.resize(begin.back());
  for (std::uint32_t t = 0; t < face_of.size(); ++t)
    if (face_of[t] < faces) finest.face_sources[begin[face_of[t] + 1]++] = t;
  begin.pop_back();
}

/// A flat body has two sides; a triangle is on the one whose normal it shares. The sign of a sliver's is exact.
std::vector<std::uint32_t> sides_of(const Mesh& mesh, const Hull& shape) {
  const auto normal = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return eigen(exact::plane(vec(mesh.points[a]), vec(mesh.points[b]), vec(mesh.points[c])).normal);
  };
  const Vec3 front = normal(shape.vertices[0], shape.vertices[1], shape.vertices[2]);
  std::vector<std::uint32_t> side;
  for (const auto& [a, b, c] : mesh.triangles) side.push_back(front.dot(normal(a, b, c)) < 0);
  return side;
}

/// `mesh` is the user's, scaled: what is small beside the largest coordinate may have been lost on the way. `face_of` gives the
/// triangle of `body` that each of a solid's lies on.
Finest finest_level(const Mesh& users, const Mesh& mesh, const Hull& shape, const Polytope& body,
                    const std::vector<std::uint32_t>& face_of) {
  Finest finest;
  finest.sources = shape.vertices;
  for (std::uint32_t v : shape.vertices) finest.vertices.push_back(users.points[v]);
  if (shape.dimension == 2) {
    const auto corners = std::uint32_t(shape.vertices.size());
    for (std::uint32_t k = 0; k < corners; ++k) finest.loops.push_back(k);
    for (std::uint32_t k = corners; k-- > 0;) finest.loops.push_back(k);
    finest.sizes = {corners, corners};
    list_sources(sides_of(mesh, shape), 2, finest);
  }
  if (shape.dimension < 3) return finest;
  finest.loops.reserve(3 * body.triangles.size());
  for (const Triangle& triangle : body.triangles) finest.loops.insert(finest.loops.end(), triangle.begin(), triangle.end());
  list_sources(face_of, body.triangles.size(), finest);
  return finest;
}

/// What makes the mesh not convex. Dents between vertices of the hull have no depth, but they lack volume.
std::optional<Error> dents(const Mesh& mesh, const Polytope& body, const BuildReport& report, double scale) {
  const double rounding = rounding_of(mesh.points);
  if (report.deepest_dent * scale > rounding)
    return Error{ErrorCode::NotConvex,
                 "the mesh has dents: the vertex deepest inside the hull is " + decimal(report.deepest_dent, 6) + " deep"};
  if (report.volume_ratio < 1 - rounding * area(body) / precise_volume(body))
    return Error{ErrorCode::NotConvex,
                 "the mesh has dents: its volume is " + decimal(report.volume_ratio, 15) + " of the hull's"};
  return std::nullopt;
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

/// A mesh over a power of two, and its hull.
struct Start {
  Start(const Mesh& users, const Executor& executor)
      : scale(unit_scale(users.points)), mesh(scaled(users, scale)), shape(hull(mesh.points, executor)) {}

  double scale;
  Mesh mesh;
  Hull shape;
};

Result<Built> build_watched(const Mesh& users, const BuildOptions& options, Watch& watch) {
  const auto size = double(users.points.size() + users.triangles.size());
  watch.begin("hull", kHullDone, 2 * size);  // the hull, and what becomes of each point and triangle in it
  const Start start(users, options.executor);
  const auto& [scale, mesh, shape] = start;
  if (const auto error = problem(users, shape)) return *error;
  watch.work(size);
  const Polytope body = solid(mesh.points, shape);
  BuildReport report;
  report.points_read = mesh.points.size(), report.triangles_read = mesh.triangles.size();
  report.duplicates_dropped = shape.duplicates, report.interior_dropped = shape.interior;
  report.hull_triangles = body.triangles.size();
  Hierarchy levels{{}, "the body is not solid and has one level"};
  std::vector<std::uint32_t> face_of;
  if (shape.dimension == 3) {
    run_tasks(options.executor, 3, [&](std::size_t task) {
      if (task == 0) face_of = triangles_on(mesh, shape, body, watch);
      if (task == 1) {
        const std::optional<double> ratio = volume_ratio(mesh, body);
        report.closed = ratio.has_value(), report.volume_ratio = ratio.value_or(1);
      }
      if (task == 2) {
        PlaneTree planes(body);
        report.deepest_dent = deepest_dent(mesh, shape, body, planes, watch) / scale;
      }
    });
    watch.work(0);
    if (options.require_convex)
      if (const auto error = dents(mesh, body, report, scale)) return *error;
    BuildOptions in_scale = options;
    // A coarsest level as coarse as the detail allows would be dropped again where `max_deviation` is less.
    if (options.max_deviation > 0) in_scale.detail.deviation = std::min(options.detail.deviation, options.max_deviation);
    in_scale.detail.deviation *= scale;
    levels = hierarchy(body, in_scale, watch);
  } else if (options.require_solid) {
    return Error{ErrorCode::NotSolid, "all points lie in one plane"};
  }
  watch.begin("bake", 1, 1);

  report.end = levels.end;
  Result<Model> model = bake(finest_level(users, mesh, shape, body, face_of), levels.levels, scale, options, report.end);
  if (!model) return model.error();
  describe(model.value(), report);
  watch.end();
  return Built{model.value().cut(options.detail), std::move(report)};
}

}  // namespace

Result<Model> lod::hull_model(const Mesh& users, const BuildOptions& options) {
  const Start start(users, options.executor);
  const Polytope body = solid(start.mesh.points, start.shape);
  std::vector<std::uint32_t> face_of;
  const Progress unasked;
  Watch watch(unasked);
  if (start.shape.dimension == 3) face_of = triangles_on(start.mesh, start.shape, body, watch);
  std::string end;
  return bake(finest_level(users, start.mesh, start.shape, body, face_of), {}, start.scale, options, end);
}

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
