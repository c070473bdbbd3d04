// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A polygon is a fan of triangles around its first corner. Of all fans that end at one corner of the hull, the best one of so
// many triangles adds a triangle to a best one of one triangle less.
#include "manifold/largest_polygon.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "numeric/vec4.h"

namespace swiftlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The convex hull of the candidates' places, counter-clockwise.
class Hull {
 public:
  explicit Hull(const Candidates& candidates) : candidates_(candidates) {
    const int count = candidates.count();
    if (is_clockwise()) {
      while (size_ < count) add(count - 1 - size_);
      return;
    }
    std::array<Index, kMostCandidates> order;
    for (int i = 0; i < count; ++i) {
      int at = i;
      for (; at > 0 && is_before(i, order[std::size_t(at - 1)]); --at) order[std::size_t(at)] = order[std::size_t(at - 1)];
      order[std::size_t(at)] = Index(i);
    }
    add_chain(order.begin(), order.begin() + count);
    add_chain(std::reverse_iterator(order.begin() + count), order.rend());
    size_ = std::max(size_, 1);
  }

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(begin_ + i < size_ ? begin_ + i : begin_ + i - size_)]; }
  /// The way from the first corner to another.
  Place spoke(int i) const { return place((*this)[i]) - place((*this)[0]); }
  double twice_area() const {
    double sum = 0;
    Place before{0, 0};
    for (int i = 1; i < size_; ++i) {
      const Place next = spoke(i);
      sum += cross(before, next), before = next;
    }
    return sum;
  }

  /// Makes `first` the first corner and returns true, or, if it is inside, the corner farthest from it and returns false. A
  /// corner within the bound of it is in its place.
  bool begin_with(int first, double bound) {
    for (begin_ = 0; begin_ < size_; ++begin_) {
      if (corner_[std::size_t(begin_)] == first) return true;
    }
    begin_ = 0;
    const Place centre = place(first);
    const auto away = [&](int i) {
      const Place way = place((*this)[i]) - centre;
      return dot(way, way);
    };
    int nearest = 0, farthest = 0;
    double least = away(0), most = least;
    for (int i = 1; i < size_; ++i) {
      const double length2 = away(i);
      if (length2 < least) least = length2, nearest = i;
      if (length2 > most) most = length2, farthest = i;
    }
    const bool is_corner = least <= bound * bound;
    begin_ = is_corner ? nearest : farthest;
    if (is_corner) corner_[std::size_t(begin_)] = Index(first);
    return is_corner;
  }
  /// Makes `first`, which is no corner, the first one, between those of the side that makes the smallest triangle with it.
  void begin_beside(int first) {
    int side = 0;
    double least = kInfinity;
    for (int i = 0; i < size_; ++i) {
      const double area = std::fabs(twice_area((*this)[i], (*this)[i + 1 == size_ ? 0 : i + 1], first));
      if (area < least) least = area, side = i;
    }
    const auto middle = corner_.begin() + begin_, at = corner_.begin() + side + 1;
    std::rotate(corner_.begin(), middle, corner_.begin() + size_);
    std::copy_backward(at, corner_.begin() + size_, corner_.begin() + size_ + 1);
    *at = Index(first), begin_ = side + 1, ++size_;
  }

 private:
  using Index = std::uint8_t;

  void add(int spot) { corner_[std::size_t(size_++)] = Index(spot); }
  Place place(int spot) const { return candidates_[spot].place(); }
  /// Whether the candidates go once around their hull, as the corners of a clipped area do: all turn right, and the way rises
  /// once.
  bool is_clockwise() const {
    const int count = candidates_.count();
    Place before = place(0) - place(count - 1);
    bool turns = true;
    int peaks = 0;
    for (int i = 0; i < count && turns; ++i) {
      const Place way = place(i + 1 < count ? i + 1 : 0) - place(i);
      turns = cross(before, way) < 0;
      peaks += before.y > 0 && way.y <= 0;
      before = way;
    }
    return turns && peaks == 1;
  }
  /// The order of x, then y; of equal places the first candidate is before.
  bool is_before(int i, int j) const {
    const Place p = place(i), q = place(j);
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  }
  /// Twice the area of three candidates, positive where they turn left.
  double twice_area(int i, int j, int k) const { return cross(place(j) - place(i), place(k) - place(i)); }

  /// Adds the lower or the upper chain but for its last corner [Andrew 1979].
  template <class Iterator>
  void add_chain(Iterator spot, Iterator end) {
    for (const int start = size_; spot != end; ++spot) {
      while (size_ > start + 1 && !(twice_area((*this)[size_ - 2], (*this)[size_ - 1], *spot) > 0)) --size_;
      add(*spot);
    }
    --size_;
  }

  const Candidates& candidates_;
  int size_ = 0, begin_ = 0;
  std::array<Index, kMostCandidates + 1> corner_;
};

/// Returns the largest polygon of at most `most` corners of the hull, the first one of these.
LargestPolygon best_fan(const Hull& hull, int most) {
  LargestPolygon polygon;
  const std::size_t size = std::size_t(hull.size()), corners = std::min(std::size_t(most), size);
  using Row = std::array<double, kMostCandidates>;
  Row x, y;                                   // of the spokes
  std::array<Row, kMostManifoldPoints> best;  // by corners after the first: twice the best fan's area, by its last corner
  for (std::size_t i = 0; i < size; ++i) {
    const Place spoke = hull.spoke(int(i));
    x[i] = spoke.x, y[i] = spoke.y, best[1][i] = 0;
  }
  const auto grown = [&](std::size_t corner, std::size_t i, std::size_t last) {
    return best[corner - 1][i] + (x[i] * y[last] - y[i] * x[last]);
  };
  for (std::size_t corner = 2; corner < corners; ++corner) {
    for (std::size_t last = corner; last < size; ++last) {
      const Vec2 x_last{x[last], x[last]}, y_last{y[last], y[last]};
      Vec2 pair = {-kInfinity, -kInfinity};  // the lane of `last` itself, if there is one, holds a fan of one triangle less
      for (std::size_t i = corner - 1; i < last; i += 2)
        pair = max(pair, load2(&best[corner - 1][i]) + (load2(&x[i]) * y_last - load2(&y[i]) * x_last));
      best[corner][last] = max(pair[0], pair[1]);
    }
  }
  const auto& all = best[corners - 1];
  std::size_t last = std::size_t(std::max_element(all.begin() + (corners - 1), all.begin() + size) - all.begin());
  polygon.twice_area = all[last];
  for (std::size_t corner = corners - 1; corner > 0; --corner) {
    polygon.corner[std::size_t(polygon.count++)] = hull[int(last)];
    std::size_t i = corner - 1;
    while (corner > 1 && i < last && grown(corner, i, last) != best[corner][last]) ++i;
    last = i;
  }
  polygon.corner[std::size_t(polygon.count++)] = hull[0];
  return polygon;
}

}  // namespace

LargestPolygon largest_polygon(const Candidates& candidates, int first, int most, double bound, double enough) {
  Hull hull(candidates);
  if (!(hull.twice_area() > enough)) return {};
  if (hull.begin_with(first, bound)) return best_fan(hull, most);
  const LargestPolygon without = best_fan(hull, most - 1);
  hull.begin_beside(first);
  const LargestPolygon with = best_fan(hull, most);
  return with.twice_area > without.twice_area ? with : without;
}

}  // namespace swiftlet
