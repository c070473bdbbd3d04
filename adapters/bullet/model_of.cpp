// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bullet computes a hull of points rounded to a grid of 1/10216 of their extent. Put back in their places, its corners may lie
// below one another, which `Model::from_level` finds, or other points above its faces, which is looked for here.
#include <swiftlet/bullet.h>

#include <string>
#include <vector>

#include <LinearMath/btConvexHullComputer.h>

#include <swiftlet/query.h>

namespace swiftlet::bullet {
namespace {

/// How far outside of the model a point may lie, over the extent: some ulps of single precision.
constexpr double kOutside = 0x1p-20;

Vec3 point_of(const btVector3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

Result<Model> model_of(const btVector3* points, int count) {
  btConvexHullComputer hull;
  if (count > 0) hull.compute(&points[0].getX(), int(sizeof(btVector3)), count, 0, 0);
  std::vector<Vec3> vertices;
  for (int i = 0; i < hull.vertices.size(); ++i) vertices.push_back(point_of(points[hull.original_vertex_index[i]]));
  std::vector<std::uint32_t> triangles;
  for (int i = 0; i < hull.faces.size(); ++i) {
    const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[i]];
    const auto* edge = first->getNextEdgeOfFace();
    for (; edge->getTargetVertex() != first->getSourceVertex(); edge = edge->getNextEdgeOfFace()) {
      for (const int v : {first->getSourceVertex(), edge->getSourceVertex(), edge->getTargetVertex()})
        triangles.push_back(std::uint32_t(v));
    }
  }
  if (triangles.empty()) return Error{ErrorCode::NotSolid, "the points lie in one plane"};
  LevelArrays arrays;
  arrays.vertices = vertices;
  arrays.face_vertices = triangles;
  ModelOptions options;
  options.repair = true;
  Result<Model> model = Model::from_level(arrays, options);
  if (!model) return model;
  std::vector<bool> is_corner(std::size_t(count), false);
  for (int i = 0; i < hull.vertices.size(); ++i) is_corner[std::size_t(hull.original_vertex_index[i])] = true;
  for (int i = 0; i < count; ++i) {
    if (is_corner[std::size_t(i)]) continue;
    const Within near = within(model.value(), Body::point(point_of(points[i])), {}, kOutside * model.value().extent());
    if (near.decision == Decision::No)
      return Error{ErrorCode::NotEnclosing, "point " + std::to_string(i) + " lies outside of Bullet's hull of the points"};
  }
  return model;
}

Result<Model> model_of(const btConvexHullShape& shape) {
  std::vector<btVector3> points;
  for (int i = 0; i < shape.getNumPoints(); ++i) points.push_back(shape.getScaledPoint(i));
  return model_of(points.data(), int(points.size()));
}

}  // namespace swiftlet::bullet
