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
  explicit Hull(const Candidates& candidates) {
    std::array<int, kMostCandidates> order;
    const auto end = order.begin() + candidates.count();
    std::iota(order.begin(), end, 0);
    for (int i = 0; i < candidates.count(); ++i) place_[std::size_t(i)] = candidates[i].place();
    std::sort(order.begin(), end, [&](int i, int j) {
      const Place &p = place(i), &q = place(j);
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : i < j;
    });
    add_chain(order.begin(), end);
    add_chain(std::reverse_iterator(end), order.rend());
    size_ = std::max(size_, 1);
  }

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(i)]; }
  /// The way from the first corner to another.
  Place spoke(int i) const { return place((*this)[i]) - place((*this)[0]); }

  /// Makes `first` the first corner and returns true, or, if it is inside, the corner farthest from it and returns false. A
  /// corner within the bound of it is in its place.
  bool begin_with(int first, double bound) {
    const auto away = [&](int spot) {
      const Place way = place(spot) - place(first);
      return dot(way, way);
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
  const Place& place(int spot) const { return place_[std::size_t(spot)]; }
  /// Twice the area of three candidates, positive where they turn left.
  double twice_area(int i, int j, int k) const { return cross(place(j) - place(i), place(k) - place(i)); }

  /// Adds the lower or the upper chain but for its last corner [Andrew 1979].
  template <class Iterator>
  void add_chain(Iterator spot, Iterator end) {
    for (const int start = size_; spot != end; ++spot) {
      while (size_ > start + 1 && !(twice_area((*this)[size_ - 2], (*this)[size_ - 1], *spot) > 0)) --size_;
      corner_[std::size_t(size_++)] = *spot;
    }
    --size_;
  }

  std::array<Place, kMostCandidates> place_;  ///< of the candidates
  int size_ = 0;
  std::array<int, kMostCandidates + 1> corner_;
};

}  // namespace

LargestPolygon largest_polygon(const Candidates& candidates, int first, int most, double bound) {
  Hull hull(candidates);
  const int corners = std::min(hull.begin_with(first, bound) ? most : most - 1, hull.size());
  std::array<Place, kMostCandidates> spoke;
  for (int i = 0; i < hull.size(); ++i) spoke[std::size_t(i)] = hull.spoke(i);
  std::array<double, kMostCandidates> best{};  // twice the area of the best fan that ends at a corner
  std::array<std::array<std::uint8_t, kMostCandidates>, kMostManifoldPoints> before{};
  for (int corner = 2; corner < corners; ++corner) {
    for (int last = hull.size() - 1; last >= corner; --last) {
      double largest = -1;
      int from = 0;
      for (int i = corner - 1; i < last; ++i) {  // no branch, which would often be mispredicted
        const double area = best[std::size_t(i)] + cross(spoke[std::size_t(i)], spoke[std::size_t(last)]);
        from = area > largest ? i : from;
        largest = max(largest, area);
      }
      before[std::size_t(corner)][std::size_t(last)] = std::uint8_t(from);
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
