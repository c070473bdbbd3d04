// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "deviation.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/chunks.h"

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;
constexpr std::size_t kPointsPerTask = 1024;

Kernel::Point_3 cgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Faces faces_of(const Polytope& body) {
  Faces faces;
  faces.reserve(body.triangles.size());
  for (const auto& [a, b, c] : body.triangles)
    faces.emplace_back(cgal(body.points[a]), cgal(body.points[b]), cgal(body.points[c]));
  return faces;
}

}  // namespace

struct Deviation::Tree {
  Faces faces;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>>> boxes;
};

Deviation::Deviation(const Polytope& body) : tree_(std::make_unique<Tree>()) {
  tree_->faces = faces_of(body);
  tree_->boxes.insert(tree_->faces.cbegin(), tree_->faces.cend());
  tree_->boxes.do_not_accelerate_distance_queries();  // the face nearest to the point before is a better start
  tree_->boxes.build();
}

Deviation::~Deviation() = default;

double Deviation::operator()(std::span<const Vec3> points, const Executor& executor) const {
  std::vector<double> most2((points.size() + kPointsPerTask - 1) / kPointsPerTask);
  over_chunks(executor, points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    auto nearest = tree_->boxes.any_reference_point_and_id();
    for (const Vec3& p : points.subspan(begin, end - begin)) {
      nearest = tree_->boxes.closest_point_and_primitive(cgal(p), nearest);
      double& most = most2[begin / kPointsPerTask];
      most = std::max(most, CGAL::squared_distance(cgal(p), nearest.first));
    }
  });
  return std::sqrt(*std::max_element(most2.begin(), most2.end()));
}

}  // namespace swiftlet::lod
