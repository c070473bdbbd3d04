// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A mesh as a concave shape of Bullet's. The moments of a solid are sums over tetrahedra between its triangles and one point
// [Tonon 2004].
#include <swiftlet/bullet.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionShapes/btTriangleCallback.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "mesh_pair.h"
#include "shapes.h"

namespace swiftlet::bullet {
namespace {

struct Moments {
  Vec3 centre;
  Mat3 spread;
};

Moments moments_of_box(const MeshModel& mesh) {
  const Vec3 side = mesh.box_max() - mesh.box_min();
  return {(mesh.box_min() + mesh.box_max()) / 2, Mat3((side.cwiseProduct(side) / 12).asDiagonal())};
}

Moments moments_of_solid(const MeshModel& mesh) {
  const Vec3 from = (mesh.box_min() + mesh.box_max()) / 2;
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto [i, j, k] = mesh.triangle(t);
    const Vec3 p = mesh.vertex(i) - from, q = mesh.vertex(j) - from, r = mesh.vertex(k) - from, sum = p + q + r;
    const double six = p.dot(q.cross(r));
    volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 * (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
  }
  const Vec3 centre = first / volume;
  return {from + centre, Mat3(second / volume - centre * centre.transpose())};
}

bool bounds_a_volume(const MeshTopology& topology) { return topology.closed() && topology.volume > 0; }

const MeshModel& whole(const MeshModel& mesh) {
  if (!mesh.is_whole()) throw std::invalid_argument("the mesh was cut: it has no triangles");
  return mesh;
}

}  // namespace

MeshShape::MeshShape(const MeshModel& mesh) : mesh_(whole(mesh)), is_solid_(bounds_a_volume(mesh.topology())) {
  m_shapeType = kMeshType;
  m_collisionMargin = CONVEX_DISTANCE_MARGIN;
  const Moments moments = is_solid_ ? moments_of_solid(mesh_) : moments_of_box(mesh_);
  centre_ = moments.centre, spread_ = moments.spread;
}

bool MeshShape::is_scaled() const { return scaling_ != btVector3(1, 1, 1); }

void MeshShape::processAllTriangles(btTriangleCallback* callback, const btVector3& least, const btVector3& most) const {
  const Vec3 scale = vector_of(scaling_);
  Vec3 box_min, box_max;  // unscaled; along an axis that is scaled to nothing all of it
  for (int i = 0; i < 3; ++i) {
    const double one = double(least[i]) / scale[i], other = double(most[i]) / scale[i];
    box_min[i] = scale[i] == 0 ? mesh_.box_min()[i] : std::min(one, other);
    box_max[i] = scale[i] == 0 ? mesh_.box_max()[i] : std::max(one, other);
  }
  for_triangles(mesh_, {box_min, box_max, Pose{}}, [&](std::uint32_t t, const Vec3& p, const Vec3& q, const Vec3& r) {
    btVector3 corners[3] = {vector_of(p) * scaling_, vector_of(q) * scaling_, vector_of(r) * scaling_};
    callback->processTriangle(corners, 0, int(mesh_.source_triangle()[t]));
  });
}

void MeshShape::getAabb(const btTransform& in_world, btVector3& least, btVector3& most) const {
  const btVector3 one = vector_of(mesh_.box_min()) * scaling_, other = vector_of(mesh_.box_max()) * scaling_;
  const btVector3 half = (other - one).absolute() / 2 + btVector3(getMargin(), getMargin(), getMargin());
  const btVector3 middle = in_world((one + other) / 2),
                  reach = half.dot3(in_world.getBasis()[0].absolute(), in_world.getBasis()[1].absolute(),
                                    in_world.getBasis()[2].absolute());
  least = middle - reach, most = middle + reach;
}

void MeshShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const Vec3 square = vector_of(scaling_ * scaling_).cwiseProduct(spread_.diagonal());
  inertia = vector_of(double(mass) * (Vec3::Constant(square.sum()) - square));
}

btTransform MeshShape::principal_axes(btScalar mass, btVector3& inertia) const {
  const Vec3 scale = vector_of(scaling_);
  const Mat3 spread = scale.asDiagonal() * spread_ * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  const Vec3 along = solver.eigenvalues();
  inertia = vector_of(double(mass) * (Vec3::Constant(along.sum()) - along));
  btMatrix3x3 basis;
  for (int row = 0; row < 3; ++row)
    basis[row] = btVector3(btScalar(axes(row, 0)), btScalar(axes(row, 1)), btScalar(axes(row, 2)));
  return btTransform(basis, vector_of(Vec3(scale.cwiseProduct(centre_))));
}

Result<MeshModel> mesh_of(const btStridingMeshInterface& triangles) {
  struct Corners final : btInternalTriangleIndexCallback {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    void internalProcessTriangleIndex(btVector3* corners, int, int) override {
      const auto first = std::uint32_t(points.size());
      for (int k = 0; k < 3; ++k) points.push_back(vector_of(corners[k]));
      triangles.push_back({first, first + 1, first + 2});
    }
  } corners;
  const btVector3 far(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  triangles.InternalProcessAllTriangles(&corners, -far, far);
  return MeshModel::from_triangles(corners.points, corners.triangles);
}

}  // namespace swiftlet::bullet
