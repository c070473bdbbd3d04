// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A polygon is a fan of triangles around its first corner. Of all fans that end at one corner of the hull, the best one of so
// many triangles adds a triangle to a best one of one triangle less.
#include "manifold/largest_polygon.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "numeric/vec4.h"

namespace swiftlet {
namespace {

/// The convex hull of the candidates' places, counter-clockwise. It begins with candidate `first` or, if that lies inside of
/// it, farther than the bound from its corners, with the corner farthest from that.
class Hull {
 public:
  using Row = std::array<double, kMostCandidates + 1>;

  Hull(const Candidates& candidates, int first, double bound) : candidates_(candidates), has_first_(goes_round_from(first)) {
    if (has_first_) return;
    const int count = candidates.count();
    std::array<Index, kMostCandidates> order;
    for (int i = 0; i < count; ++i) {
      int at = i;
      for (; at > 0 && is_before(i, order[std::size_t(at - 1)]); --at) order[std::size_t(at)] = order[std::size_t(at - 1)];
      order[std::size_t(at)] = Index(i);
    }
    add_chain(order.begin(), order.begin() + count);
    add_chain(std::reverse_iterator(order.begin() + count), order.rend());
    size_ = std::max(size_, 1);
    begin_with(first, bound);
    measure();
  }

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(i)]; }
  bool has_first() const { return has_first_; }
  /// The ways from the first corner to all.
  const Row& x() const { return x_; }
  const Row& y() const { return y_; }
  double twice_area() const { return twice_area_; }

  /// Makes `first`, which lies inside, the first corner, between those of the side that makes the smallest triangle with it.
  void begin_beside(int first) {
    int side = 0;
    double least = kInfinity;
    for (int i = 0; i < size_; ++i) {
      const double area = std::fabs(twice_area((*this)[i], (*this)[i + 1 < size_ ? i + 1 : 0], first));
      if (area < least) least = area, side = i;
    }
    begin_at(side + 1);
    std::copy_backward(corner_.begin(), corner_.begin() + size_, corner_.begin() + size_ + 1);
    corner_[0] = Index(first), ++size_;
    measure();
  }

 private:
  using Index = std::uint8_t;

  void add(int spot) { corner_[std::size_t(size_++)] = Index(spot); }
  PlanePoint place(int spot) const { return candidates_[spot].place(); }
  /// Takes all candidates for the hull, back from the first one. Returns false if they do not go around it clockwise, as the
  /// corners of a clipped area do: back they all turn left, and the way rises once.
  bool goes_round_from(int first) {
    const int count = candidates_.count();
    const PlanePoint start = place(first);
    PlanePoint at = start, before = start - place(first + 1 < count ? first + 1 : 0), spoke{0, 0};
    int peaks = 0;
    for (int spot = first; size_ < count;) {
      x_[std::size_t(size_)] = spoke.x, y_[std::size_t(size_)] = spoke.y;
      add(spot);
      spot = spot > 0 ? spot - 1 : count - 1;
      const PlanePoint next = place(spot), way = next - at, to = next - start;
      if (!(cross(before, way) > 0)) return size_ = 0, false;
      peaks += before.y > 0 && way.y <= 0;
      twice_area_ += cross(spoke, to);
      at = next, before = way, spoke = to;
    }
    if (peaks != 1) size_ = 0;
    return peaks == 1;
  }
  void measure() {
    twice_area_ = 0;
    PlanePoint before{0, 0};
    for (int i = 0; i < size_; ++i) {
      const PlanePoint spoke = place((*this)[i]) - place((*this)[0]);
      x_[std::size_t(i)] = spoke.x, y_[std::size_t(i)] = spoke.y;
      twice_area_ += cross(before, spoke), before = spoke;
    }
  }
  /// A corner within the bound of `first` is in its place.
  void begin_with(int first, double bound) {
    const PlanePoint centre = place(first);
    const auto away = [&](int i) {
      const PlanePoint way = place((*this)[i]) - centre;
      return dot(way, way);
    };
    int nearest = 0, farthest = 0;
    double least = away(0), most = least;
    for (int i = 1; i < size_; ++i) {
      const double length2 = away(i);
      if (length2 < least) least = length2, nearest = i;
      if (length2 > most) most = length2, farthest = i;
    }
    has_first_ = least <= bound * bound;
    begin_at(has_first_ ? nearest : farthest);
    if (has_first_) corner_[0] = Index(first);
  }
  /// Of std::rotate in place g++ 12 warns that it may write beyond the array.
  void begin_at(int corner) {
    const auto old = corner_;
    for (int i = 0, from = corner; i < size_; ++i, ++from) {
      if (from >= size_) from = 0;
      corner_[std::size_t(i)] = old[std::size_t(from)];
    }
  }
  /// The order of x, then y; of equal places the first candidate is before.
  bool is_before(int i, int j) const {
    const PlanePoint p = place(i), q = place(j);
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
  int size_ = 0;
  double twice_area_ = 0;
  std::array<Index, kMostCandidates + 1> corner_;
  Row x_, y_;
  bool has_first_;
};

/// Returns the largest polygon of at most `most` corners of the hull, 2 or more, the first one of these.
[[gnu::noinline]] LargestPolygon best_fan(const Hull& hull, int most) {
  const std::size_t size = std::size_t(hull.size()), triangles = std::min(std::size_t(most), size) - 2;
  const Hull::Row &x = hull.x(), &y = hull.y();
  std::array<Hull::Row, kMostManifoldPoints - 1> best;  // by triangles: twice the area of the best fan, by its last corner
  std::fill_n(best[0].begin(), size, 0.0);
  const auto grown = [&](std::size_t t, std::size_t i, std::size_t last) {
    return best[t - 1][i] + (x[i] * y[last] - y[i] * x[last]);
  };
  for (std::size_t t = 1; t <= triangles; ++t) {
    for (std::size_t last = t + 1; last < size; ++last) {
      const Vec2 x_last{x[last], x[last]}, y_last{y[last], y[last]};
      Vec2 pair = {-kInfinity, -kInfinity};  // the lane of `last` itself, if there is one, holds a fan of one triangle less
      for (std::size_t i = t; i < last; i += 2)
        pair = max(pair, load2(&best[t - 1][i]) + (load2(&x[i]) * y_last - load2(&y[i]) * x_last));
      best[t][last] = max(pair[0], pair[1]);
    }
  }
  const auto& all = best[triangles];
  std::size_t last = std::size_t(std::max_element(all.begin() + (triangles + 1), all.begin() + size) - all.begin());
  LargestPolygon polygon;
  polygon.twice_area = all[last];
  for (std::size_t t = triangles; t > 0; --t) {
    polygon.corner[std::size_t(polygon.count++)] = hull[int(last)];
    std::size_t i = t;
    while (i < last && grown(t, i, last) != best[t][last]) ++i;
    last = i;
  }
  polygon.corner[std::size_t(polygon.count++)] = hull[int(last)];
  polygon.corner[std::size_t(polygon.count++)] = hull[0];
  return polygon;
}

}  // namespace

LargestPolygon largest_polygon(const Candidates& candidates, int first, int most, double bound, double enough) {
  Hull hull(candidates, first, bound);
  if (!(hull.twice_area() > enough)) return {};
  LargestPolygon best = best_fan(hull, hull.has_first() ? most : most - 1);
  if (hull.has_first()) return best;
  hull.begin_beside(first);
  const LargestPolygon with = best_fan(hull, most);
  return with.twice_area > best.twice_area ? with : best;
}

}  // namespace swiftlet
