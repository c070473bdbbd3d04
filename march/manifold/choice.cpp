// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/choice.h"

#include <cmath>

#include "manifold/largest_polygon.h"
#include "manifold/set.h"

namespace swiftlet {
namespace {

static_assert(kMostCandidates < 32);  // a Set holds them

/// The convex hull of candidates' places, counter-clockwise; a place outside by no more than the bound does not change it.
class Loop {
 public:
  Loop(const Candidates& candidates, double bound) : candidates_(&candidates), bound_(bound) {}

  int size() const { return size_; }
  int operator[](int i) const { return int(corners_ >> 8 * i & 0xff); }
  int next(int i) const { return i + 1 == size_ ? 0 : i + 1; }

  /// The corner after which `spot` comes: the one before it if it is a corner itself, else the start of the side that makes the
  /// smallest triangle with it.
  int before(int spot, bool& is_corner) const {
    int found = 0;
    double least = kInfinity;
    for (int side = 0; side < size_; ++side) {
      if ((is_corner = (*this)[side] == spot)) return previous(side);
      if (const double taken = std::fabs(area(side, spot)); taken < least) least = taken, found = side;
    }
    return found;
  }

  /// How far a place lies from the only corner, or the area that it adds to more of them; 0 where it hardly stands out.
  double gain(int spot) const {
    if (size_ == 1) {
      const double length = apart((*this)[0], spot);
      return length > bound_ ? length : 0;
    }
    double area = 0;
    for (int side = 0; side < size_; ++side) area += beyond(side, spot);
    return area;
  }

  double twice_area() const {
    double sum = 0;
    for (int side = 1; side + 1 < size_; ++side) sum -= area(side, (*this)[0]);
    return sum;
  }

  /// Makes corners of candidates that go around clockwise, as those of a clipped area do. Returns false if they do not, or if
  /// one may lie within the bound of the line through two others; else `add` would make the same corners. The smallest triangle
  /// of a convex polygon's corners is one of three neighbours, and none of its sides is longer than the border.
  bool go_round(Set those) {
    const PlanePoint start = place(lowest(those));
    PlanePoint at = start, first{0, 0}, before{0, 0};
    double least = kInfinity, length = 0;
    int peaks = 0;
    const auto turn = [&](const PlanePoint& way) {
      least = min(least, cross(way, before)), length += std::fabs(way.x) + std::fabs(way.y);
      peaks += before.y > 0 && way.y <= 0;
      before = way;
    };
    put(size_++, lowest(those));
    each(those & (those - 1), [&](int i) {
      const PlanePoint next = place(i), way = next - at;
      if (size_ == 1)
        first = before = way;
      else
        turn(way);
      at = next, corners_ = corners_ << 8 | std::uint64_t(i), ++size_;
    });
    turn(start - at), turn(first);
    return least > bound_ * length && peaks == 1;
  }

  /// The corners between the sides that see the place give way to it.
  void add(int spot) {
    if (size_ < 2) {
      if (size_ == 0 || apart((*this)[0], spot) > bound_) put(size_++, spot);
      return;
    }
    unsigned seen = 0;
    for (int side = 0; side < size_; ++side) seen |= unsigned(beyond(side, spot) > 0) << side;
    const auto sees = [seen](int side) { return seen >> side & 1; };
    int first = 0;
    while (first < size_ && !(sees(first) && !sees(previous(first)))) ++first;
    if (first == size_) return stretch(spot);
    int after = next(first);
    while (after != first && sees(after)) after = next(after);
    if (after > 0) corners_ = corners_ >> 8 * after | corners_ << 8 * (size_ - after);
    size_ = first - after + 1 + (first < after ? size_ : 0);
    put(size_++, spot);
  }

 private:
  /// Makes a candidate the last corner.
  void put(int i, int spot) { corners_ = (corners_ & ((std::uint64_t(1) << 8 * i) - 1)) | std::uint64_t(spot) << 8 * i; }

  /// A corner that ends a line, or a sliver, gives way to a place beyond it that no side sees, if that is farther than twice
  /// the bound: at a right angle or a blunt one no such place is.
  void stretch(int spot) {
    for (int i = 0; i < size_; ++i) {
      const PlanePoint way = place(spot) - corner(i);
      const auto is_past = [&](int other) { return dot(way, corner(i) - corner(other)) > 0; };
      if (is_past(next(i)) && is_past(previous(i)) && dot(way, way) > 4 * bound_ * bound_) return put(i, spot);
    }
  }

  int previous(int i) const { return i == 0 ? size_ - 1 : i - 1; }
  PlanePoint place(int spot) const { return (*candidates_)[spot].place(); }
  PlanePoint corner(int i) const { return place((*this)[i]); }

  double apart(int spot, int other) const {
    const PlanePoint way = place(other) - place(spot);
    return std::sqrt(dot(way, way));
  }

  /// Twice the area of the triangle of a side and a place, positive if the place lies beyond the side.
  double area(int side, int spot) const { return cross(place(spot) - corner(side), corner(next(side)) - corner(side)); }
  /// The same if the place stands out beyond the side, else 0.
  double beyond(int side, int spot) const {
    const PlanePoint way = corner(next(side)) - corner(side);
    const double size = cross(place(spot) - corner(side), way);
    return size > 0 && size * size > bound_ * bound_ * dot(way, way) ? size : 0;
  }

  const Candidates* candidates_;
  double bound_;
  int size_ = 0;
  std::uint64_t corners_ = 0;  ///< in one register: a byte each
};
static_assert(kMostManifoldPoints <= 8);

/// Which of the candidates a manifold gets.
class Choice {
 public:
  Choice(const Candidates& candidates, int most, double bound, double slack)
      : candidates_(candidates), most_(most), bound_(bound), slack_(slack), loop_(candidates, bound) {
    for (int i = 0; i < candidates.count(); ++i) {
      if (candidates.knows(candidates[i].names)) known_ |= bit(i), ++known_count_;
    }
  }

  Chosen of(const Manifold& previous) {
    Chosen chosen;
    if (candidates_.count() == 0 || most_ == 0) return chosen;
    first_ = deepest(previous);
    const bool has_choice = candidates_.count() > most_;
    if (known_ != 0 && known_count_ + !is_known(first_) <= most_)
      take(known_);
    else
      loop_.add(first_), chosen_ = bit(first_), grow(known_);
    const bool is_new = size_ == 1, has_polygons = has_choice && most_ > 2;
    if (!(is_new && has_polygons)) grow(all());
    if (has_polygons) give_way(is_new ? 1 : 1 + kKeptWorth);
    bool is_corner = false;
    int corner = loop_.before(first_, is_corner);
    if (is_corner) corner = loop_.next(corner);
    chosen.add(first_);
    for (int rest = loop_.size() - is_corner; rest > 0; --rest) chosen.add(loop_[corner = loop_.next(corner)]);
    return chosen;
  }

 private:
  static constexpr int kNobody = -1;

  Set all() const { return below(candidates_.count()); }
  bool is_known(int i) const { return known_ & bit(i); }

  /// The first point of the manifold before if it is nearly the deepest, else the deepest of its points that are, else the
  /// first candidate within a quarter of the bound of the least separation. The rest of the bound is left for the rounding of
  /// the witness.
  int deepest(const Manifold& previous) const {
    int found = kNobody;
    for (int i = 0; i < candidates_.count(); ++i) {
      const double separation = candidates_[i].separation;
      if (!(separation <= candidates_.least() + (is_known(i) ? slack_ : bound_ / 4))) continue;
      if (is_known(i) && Names(previous.points[0]) == candidates_[i].names) return i;
      if (found == kNobody || (is_known(i) && !(is_known(found) && candidates_[found].separation <= separation))) found = i;
    }
    return found;
  }

  /// Chooses `first_` and, of `those`, all that stand out.
  void take(Set those) {
    those |= bit(first_);
    Loop round(candidates_, bound_);
    if (round.go_round(those)) {
      loop_ = round, chosen_ = those, size_ = loop_.size();
      return;
    }
    for (Set before = those;; before = chosen_) {
      loop_ = around(before);
      chosen_ = bit(first_), size_ = 1;
      for (int i = 0; i < loop_.size(); ++i) size_ += !(chosen_ & bit(loop_[i])), chosen_ |= bit(loop_[i]);
      if (chosen_ == before) return;
    }
  }

  /// Chooses the largest polygon instead if that has more than `worth` times the area.
  void give_way(double worth) {
    const double enough = worth * loop_.twice_area();
    const LargestPolygon polygon = largest_polygon(candidates_, first_, most_, bound_, enough);
    if (polygon.twice_area > enough) {
      const Set before = chosen_;
      Set corners = 0;
      for (const int corner : polygon) corners |= bit(corner);
      take(corners);
      if (!(loop_.twice_area() > enough)) take(before);
    }
    grow(all());
  }

  /// The hull of some candidates. `first_` is added first, so that others in its place do not replace it.
  Loop around(Set those) const {
    Loop loop(candidates_, bound_);
    loop.add(first_);
    each(those & ~bit(first_), [&](int i) { loop.add(i); });
    return loop;
  }

  /// Adds what adds most to the area until nothing does.
  void grow(Set those) {
    for (int rest = candidates_.count(); size_ < most_ && rest > 0; --rest) {
      int found = kNobody;
      double most = 0;
      each(those & ~chosen_, [&](int i) {
        if (const double gain = loop_.gain(i); gain > most) most = gain, found = i;
      });
      if (found == kNobody) return;
      take(chosen_ | bit(found));
    }
  }

  const Candidates& candidates_;
  const int most_;
  const double bound_, slack_;
  int size_ = 1, first_ = 0, known_count_ = 0;
  Set known_ = 0, chosen_ = 0;  ///< of the manifold before, of this one
  Loop loop_;                   ///< around the chosen ones
};

}  // namespace

Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound, double slack) {
  return Choice(candidates, int(most), bound, max(slack, bound / 4)).of(previous);
}

}  // namespace swiftlet
