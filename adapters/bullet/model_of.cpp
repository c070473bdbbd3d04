// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of points, grown point by point in doubles [Preparata & Shamos 1985, sec. 3.4.3]. What rounding leaves of it
// `Model::from_level` repairs or refuses: that a model is convex is proved.
#include <swiftlet/bullet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace swiftlet::bullet {
namespace {

/// A point that is no higher than this above a face, over the extent, adds nothing: some hundred times the rounding of a
/// height.
constexpr double kNothing = 0x1p-44;

using Index = std::uint32_t;
using Edge = std::array<Index, 2>;  ///< from and to

struct Face {
  std::array<Index, 3> corners;  ///< counter-clockwise seen from outside
  Vec3 normal;                   ///< unit
  double height;
};

class GrowingHull {
 public:
  explicit GrowingHull(const std::vector<Vec3>& points) : points_(points) {
    for (const Vec3& p : points) extent_ = std::max(extent_, p.cwiseAbs().maxCoeff());
  }

  /// Nothing, or why there is no hull.
  std::optional<Error> grow() {
    if (!begin()) return Error{ErrorCode::NotSolid, "the points lie in one plane"};
    std::vector<Index> order(points_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::minstd_rand random;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (const Index p : order) {
      if (!add(p)) return Error{ErrorCode::NotConvex, "rounding hides which faces are below point " + std::to_string(p)};
    }
    return std::nullopt;
  }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  /// The point for which `far` is largest.
  template <class Far>
  Index farthest(Far far) const {
    Index most = 0;
    for (Index i = 1; i < points_.size(); ++i) {
      if (far(points_[i]) > far(points_[most])) most = i;
    }
    return most;
  }

  bool begin() {
    if (points_.empty()) return false;
    const Index a = farthest([](const Vec3& p) { return p[0]; });
    const Index b = farthest([&](const Vec3& p) { return (p - points_[a]).norm(); });
    const Vec3 line = (points_[b] - points_[a]).stableNormalized();
    const Index c = farthest([&](const Vec3& p) { return line.cross(p - points_[a]).norm(); });
    const Vec3 up = line.cross(points_[c] - points_[a]).stableNormalized();
    const Index d = farthest([&](const Vec3& p) { return std::abs(up.dot(p - points_[a])); });
    const double height = up.dot(points_[d] - points_[a]);
    if (!(std::abs(height) > kNothing * extent_)) return false;
    const std::array<Index, 3> base = height < 0 ? std::array{a, b, c} : std::array{b, a, c};
    add_face(base);
    for (std::size_t i = 0; i < 3; ++i) add_face({base[(i + 1) % 3], base[i], d});
    return true;
  }

  void add_face(const std::array<Index, 3>& corners) {
    const Vec3 &p = points_[corners[0]], &q = points_[corners[1]], &r = points_[corners[2]];
    const Vec3 normal = (q - p).cross(r - p).stableNormalized();
    faces_.push_back({corners, normal, normal.dot(p)});
  }

  /// The faces that the point is above give way to a cone over their border, unless it is in the place of a corner. False where
  /// rounding left them more than one border.
  bool add(Index point) {
    const Vec3& p = points_[point];
    const double nothing = kNothing * extent_;
    const auto seen =
        std::partition(faces_.begin(), faces_.end(), [&](const Face& f) { return !(f.normal.dot(p) - f.height > nothing); });
    std::vector<Edge> edges, border;
    for (auto f = seen; f != faces_.end(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        if ((points_[f->corners[i]] - p).norm() <= nothing) return true;
        edges.push_back({f->corners[i], f->corners[(i + 1) % 3]});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges) {
      if (!std::binary_search(edges.begin(), edges.end(), Edge{to, from})) border.push_back({from, to});
    }
    if (!is_one_loop(border)) return false;
    faces_.erase(seen, faces_.end());
    for (const auto& [from, to] : border) add_face({from, to, point});
    return true;
  }

  /// Of edges in the order of their origins.
  static bool is_one_loop(const std::vector<Edge>& border) {
    if (border.empty()) return true;
    Index at = border[0][0];
    for (std::size_t steps = 1;; ++steps) {
      const auto next = std::lower_bound(border.begin(), border.end(), Edge{at, 0});
      if (next == border.end() || (*next)[0] != at) return false;
      at = (*next)[1];
      if (at == border[0][0]) return steps == border.size();
      if (steps == border.size()) return false;
    }
  }

  const std::vector<Vec3>& points_;
  double extent_ = 0;
  std::vector<Face> faces_;
};

}  // namespace

Result<Model> model_of(const btVector3* points, int count) {
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) all.emplace_back(points[i].x(), points[i].y(), points[i].z());
  GrowingHull hull(all);
  if (const auto fault = hull.grow()) return *fault;

  constexpr Index kUnused = ~Index{0};
  std::vector<Index> number(all.size(), kUnused), triangles;
  std::vector<Vec3> vertices;
  for (const Face& f : hull.faces()) {
    for (const Index corner : f.corners) {
      if (number[corner] == kUnused) number[corner] = Index(vertices.size()), vertices.push_back(all[corner]);
      triangles.push_back(number[corner]);
    }
  }
  LevelArrays arrays;
  arrays.vertices = vertices;
  arrays.face_vertices = triangles;
  ModelOptions options;
  options.repair = true;
  return Model::from_level(arrays, options);
}

Result<Model> model_of(const btConvexHullShape& shape) {
  std::vector<btVector3> points;
  for (int i = 0; i < shape.getNumPoints(); ++i) points.push_back(shape.getScaledPoint(i));
  return model_of(points.data(), int(points.size()));
}

}  // namespace swiftlet::bullet
