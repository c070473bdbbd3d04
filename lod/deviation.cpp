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

namespace swiftlet::lod {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Faces = std::vector<Kernel::Triangle_3>;

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
}

Deviation::~Deviation() = default;

double Deviation::operator()(std::span<const Vec3> points) const {
  double most2 = 0;
  for (const Vec3& p : points) most2 = std::max(most2, tree_->boxes.squared_distance(cgal(p)));
  return std::sqrt(most2);
}

}  // namespace swiftlet::lod
