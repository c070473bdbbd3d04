// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of points: a facet that points lie above gives way to a cone from the farthest of these [Barber, Dobkin &
// Huhdanpaa 1996, Quickhull]. Exact signs tell what is above, so that nearly coplanar points are no special case.
#include <swiftlet/bullet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "numeric/decimal.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"

namespace swiftlet::bullet {
namespace {

using Index = std::uint32_t;

constexpr Index kNobody = ~Index{0};
constexpr std::size_t after(std::size_t k) { return k == 2 ? 0 : k + 1; }

struct Facet {
  std::array<Index, 3> corners;  ///< counter-clockwise seen from outside
  std::array<Index, 3> beside;   ///< entry k: the facet across the edge from corner k to the next one
  std::vector<Index> above;      ///< each point that is not in the hull is above one of the facets: those of this one
  bool is_gone = false;
};

class GrowingHull {
 public:
  explicit GrowingHull(const std::vector<Vec3>& points) : points_(points), border_(points.size()) {}

  /// False where the points lie in one plane.
  bool grow() {
    if (!begin()) return false;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!facets_[f].above.empty()) add(farthest_above(facets_[f]), Index(f));
    }
    return true;
  }
  /// The triangles; coplanar ones are not merged.
  template <class Visit>
  void each_facet(Visit visit) const {
    for (const Facet& f : facets_) {
      if (!f.is_gone) visit(f.corners);
    }
  }

 private:
  const double* at(Index p) const { return points_[p].data(); }
  int side_of(const std::array<Index, 3>& plane, Index p) const {
    return exact::orientation(at(plane[0]), at(plane[1]), at(plane[2]), at(p));
  }
  bool sees(Index p, const Facet& f) const { return side_of(f.corners, p) > 0; }

  template <class Is>
  Index first_that(Is is) const {
    Index p = 0;
    while (p < points_.size() && !is(p)) ++p;
    return p;
  }

  bool begin() {
    const auto count = Index(points_.size());
    const Index b = first_that([&](Index p) { return points_[p] != points_[0]; });
    if (b == count) return false;
    const Index c = first_that([&](Index p) { return !exact::collinear(at(0), at(b), at(p)); });
    if (c == count) return false;
    std::array<Index, 3> base{0, b, c};
    const Index d = first_that([&](Index p) { return side_of(base, p) != 0; });
    if (d == count) return false;
    if (side_of(base, d) > 0) std::swap(base[1], base[2]);
    facets_.push_back({base, {1, 2, 3}, {}});
    for (Index k = 0; k < 3; ++k) facets_.push_back({{base[after(k)], base[k], d}, {0, 1 + (k + 2) % 3, 1 + (k + 1) % 3}, {}});
    std::vector<Index> all(count);
    for (Index p = 0; p < count; ++p) all[p] = p;
    hand_out(all, 0);
    return true;
  }

  Index farthest_above(const Facet& f) const {
    const Vec3& p = points_[f.corners[0]];
    const Vec3 normal = (points_[f.corners[1]] - p).cross(points_[f.corners[2]] - p).stableNormalized();
    const auto height = [&](Index q) { return normal.dot(points_[q] - p); };
    return *std::max_element(f.above.begin(), f.above.end(), [&](Index q, Index r) { return height(q) < height(r); });
  }

  /// Gives each point that is above a facet, of those from `first` on, to one of these.
  void hand_out(const std::vector<Index>& points, std::size_t first) {
    for (const Index p : points) {
      const auto seen =
          std::find_if(facets_.begin() + std::ptrdiff_t(first), facets_.end(), [&](const Facet& f) { return sees(p, f); });
      if (seen != facets_.end()) seen->above.push_back(p);
    }
  }

  /// The facets that the point is strictly above are connected and have one border, which passes no corner twice. A point that
  /// was above one of them and is still outside is above one of the new ones.
  void add(Index point, Index facet) {
    std::vector<Index> seen{facet};
    facets_[facet].is_gone = true;
    Index from = kNobody;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Facet& f = facets_[seen[i]];
        Facet& other = facets_[f.beside[k]];
        if (other.is_gone) continue;
        if (sees(point, other)) {
          other.is_gone = true;
          seen.push_back(f.beside[k]);
        } else {
          from = f.corners[k];
          border_[from] = {f.corners[after(k)], f.beside[k]};
        }
      }
    }
    std::vector<Index> homeless;
    for (const Index s : seen) {
      homeless.insert(homeless.end(), facets_[s].above.begin(), facets_[s].above.end());
      facets_[s].above = {};
    }

    const auto first = Index(facets_.size());
    const Index start = from;
    do {
      const auto [to, outer] = border_[from];
      const auto here = Index(facets_.size());
      Facet& other = facets_[outer];
      for (std::size_t k = 0; k < 3; ++k) {
        if (other.corners[k] == to && other.corners[after(k)] == from) other.beside[k] = here;
      }
      facets_.push_back({{from, to, point}, {outer, here + 1, here - 1}, {}});
      from = to;
    } while (from != start);
    facets_.back().beside[1] = first;
    facets_[first].beside[2] = Index(facets_.size() - 1);
    hand_out(homeless, first);
  }

  struct Edge {
    Index to, outer;  ///< the corner where it ends, and the facet across it
  };
  const std::vector<Vec3>& points_;
  std::vector<Facet> facets_;
  std::vector<Edge> border_;  ///< by the corner where an edge begins
};

}  // namespace

Result<Model> model_of(const btVector3* points, int count) {
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) all.emplace_back(points[i].x(), points[i].y(), points[i].z());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const double x : all[i]) {
      if (!is_legal_coordinate(x))
        return Error{ErrorCode::BadValue, "point " + std::to_string(i) + " has the coordinate " + decimal(x, 6) +
                                              "; legal are 0 and " + decimal(kLeastCoordinate, 6) + " to " +
                                              decimal(kMostCoordinate, 6) + " in magnitude"};
    }
  }
  GrowingHull hull(all);
  if (!hull.grow()) return Error{ErrorCode::NotSolid, "the points lie in one plane"};

  std::vector<Index> number(all.size(), kNobody), triangles;
  std::vector<Vec3> vertices;
  hull.each_facet([&](const std::array<Index, 3>& corners) {
    for (const Index corner : corners) {
      if (number[corner] == kNobody) number[corner] = Index(vertices.size()), vertices.push_back(all[corner]);
      triangles.push_back(number[corner]);
    }
  });
  LevelArrays arrays;
  arrays.vertices = vertices;
  arrays.face_vertices = triangles;
  return Model::from_level(arrays);
}

Result<Model> model_of(const btConvexHullShape& shape) {
  std::vector<btVector3> points;
  for (int i = 0; i < shape.getNumPoints(); ++i) points.push_back(shape.getScaledPoint(i));
  return model_of(points.data(), int(points.size()));
}

}  // namespace swiftlet::bullet
