// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A polygon is a fan of triangles around its first corner. Of all fans that end at one corner of the hull, the best one of so
// many triangles adds a triangle to a best one of one triangle less.
#include "manifold/largest_polygon.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace swiftlet {
namespace {

/// The convex hull of the candidates' places, counter-clockwise.
class Hull {
 public:
  explicit Hull(const Candidates& candidates) : candidates_(candidates) {
    std::array<int, kMostCandidates> order;
    const auto end = order.begin() + candidates.count();
    std::iota(order.begin(), end, 0);
    std::sort(order.begin(), end, [&](int i, int j) {
      const Vec &p = place(i), &q = place(j);
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : i < j;
    });
    add_chain(order.begin(), end);
    add_chain(std::reverse_iterator(end), order.rend());
    size_ = std::max(size_, 1);
  }

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(i)]; }
  /// Twice the area of three candidates, positive where they turn left.
  double twice_area(int i, int j, int k) const {
    const Vec &p = place(i), &q = place(j), &r = place(k);
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }

  /// Makes `first` the first corner and returns true, or, if it is inside, the corner farthest from it and returns false. A
  /// corner within the bound of it is in its place.
  bool begin_with(int first, double bound) {
    const auto away = [&](int spot) {
      const double x = place(spot).x - place(first).x, y = place(spot).y - place(first).y;
      return x * x + y * y;
    };
    const auto end = corner_.begin() + size_;
    auto begin = std::min_element(corner_.begin(), end, [&](int i, int j) { return away(i) < away(j); });
    const bool is_corner = away(*begin) <= bound * bound;
    if (!is_corner) begin = std::max_element(corner_.begin(), end, [&](int i, int j) { return away(i) < away(j); });
    std::rotate(corner_.begin(), begin, end);
    if (is_corner) corner_[0] = first;
    return is_corner;
  }

 private:
  const Vec& place(int spot) const { return candidates_[spot].on_a; }

  /// Adds the lower or the upper chain but for its last corner [Andrew 1979].
  template <class Iterator>
  void add_chain(Iterator spot, Iterator end) {
    for (const int start = size_; spot != end; ++spot) {
      while (size_ > start + 1 && !(twice_area((*this)[size_ - 2], (*this)[size_ - 1], *spot) > 0)) --size_;
      corner_[std::size_t(size_++)] = *spot;
    }
    --size_;
  }

  const Candidates& candidates_;
  int size_ = 0;
  std::array<int, kMostCandidates + 1> corner_;
};

}  // namespace

LargestPolygon largest_polygon(const Candidates& candidates, int first, int most, double bound) {
  Hull hull(candidates);
  const int corners = std::min(hull.begin_with(first, bound) ? most : most - 1, hull.size());
  std::array<double, kMostCandidates> best{};  // twice the area of the best fan that ends at a corner
  std::array<std::array<std::uint8_t, kMostCandidates>, kMostManifoldPoints> before{};
  for (int corner = 2; corner < corners; ++corner) {
    for (int last = hull.size() - 1; last >= corner; --last) {
      double largest = -1;
      for (int i = corner - 1; i < last; ++i) {
        const double area = best[std::size_t(i)] + hull.twice_area(hull[0], hull[i], hull[last]);
        if (area > largest) largest = area, before[std::size_t(corner)][std::size_t(last)] = std::uint8_t(i);
      }
      best[std::size_t(last)] = largest;
    }
  }
  int last = int(std::max_element(best.begin() + (corners - 1), best.begin() + hull.size()) - best.begin());
  LargestPolygon polygon;
  polygon.twice_area = best[std::size_t(last)];
  for (int corner = corners - 1; corner >= 0; last = before[std::size_t(corner--)][std::size_t(last)])
    polygon.corner[std::size_t(polygon.count++)] = hull[last];
  return polygon;
}

}  // namespace swiftlet
