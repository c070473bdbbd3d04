// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/choice.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

#include "manifold/largest_polygon.h"

namespace swiftlet {
namespace {

/// The convex hull of candidates' places, counter-clockwise; a place outside by no more than the bound does not change it.
class Loop {
 public:
  Loop(const Candidates& candidates, double bound) : candidates_(&candidates), bound_(bound) {}

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(i)]; }

  /// The corner after which `spot` comes: the one before it if it is a corner itself, else the start of the side that makes the
  /// smallest triangle with it.
  int before(int spot, bool& is_corner) const {
    int found = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int side = 0; side < size_; ++side) {
      if ((is_corner = corner_[std::size_t(side)] == spot)) return previous(side);
      if (const double taken = std::fabs(area(side, spot)); taken < least) least = taken, found = side;
    }
    return found;
  }

  /// How far a place lies from the only corner, or the area that it adds to more of them; 0 where it hardly stands out.
  double gain(int spot) const {
    if (size_ == 1) {
      const double length = apart(corner_[0], spot);
      return length > bound_ ? length : 0;
    }
    double area = 0;
    for (int side = 0; side < size_; ++side) area += beyond(side, spot);
    return area;
  }

  double twice_area() const {
    double sum = 0;
    for (int side = 1; side + 1 < size_; ++side) sum -= area(side, corner_[0]);
    return sum;
  }

  /// The corners between the sides that see the place give way to it.
  void add(int spot) {
    if (size_ < 2) {
      if (size_ == 0 || apart(corner_[0], spot) > bound_) corner_[std::size_t(size_++)] = spot;
      return;
    }
    int first = 0;
    while (first < size_ && !(beyond(first, spot) > 0 && beyond(previous(first), spot) == 0)) ++first;
    if (first == size_) return size_ == 2 ? stretch(spot) : void();
    int after = first;
    while (after = next(after), after != first && beyond(after, spot) > 0) {
    }
    const std::array<int, kMostManifoldPoints> whole = corner_;
    int count = 0;
    for (int i = after; i != first; i = next(i)) corner_[std::size_t(count++)] = whole[std::size_t(i)];
    corner_[std::size_t(count++)] = whole[std::size_t(first)];
    corner_[std::size_t(count++)] = spot;
    size_ = count;
  }

 private:
  /// Of three candidates on one line, keeps the two that are farthest apart: the first two may lie nearly in one place.
  void stretch(int spot) {
    const double from_first = apart(corner_[0], spot), from_second = apart(corner_[1], spot);
    if (max(from_first, from_second) <= apart(corner_[0], corner_[1])) return;
    corner_[from_first >= from_second] = spot;
  }

  int next(int i) const { return i + 1 == size_ ? 0 : i + 1; }
  int previous(int i) const { return i == 0 ? size_ - 1 : i - 1; }
  const Vec& place(int spot) const { return (*candidates_)[spot].on_a; }
  const Vec& corner(int i) const { return place(corner_[std::size_t(i)]); }

  double apart(int spot, int other) const {
    const double dx = place(other).x - place(spot).x, dy = place(other).y - place(spot).y;
    return std::sqrt(dx * dx + dy * dy);
  }

  /// Twice the area of the triangle of a side and a place, positive if the place lies beyond the side.
  double area(int side, int spot) const {
    const Vec &p = corner(side), &q = corner(next(side)), &c = place(spot);
    return (c.x - p.x) * (q.y - p.y) - (c.y - p.y) * (q.x - p.x);
  }
  /// The same if the place stands out beyond the side, else 0.
  double beyond(int side, int spot) const {
    const Vec &p = corner(side), &q = corner(next(side));
    const double dx = q.x - p.x, dy = q.y - p.y, size = area(side, spot);
    return size > 0 && size * size > bound_ * bound_ * (dx * dx + dy * dy) ? size : 0;
  }

  const Candidates* candidates_;
  double bound_;
  int size_ = 0;
  std::array<int, kMostManifoldPoints> corner_;
};

/// Which of the candidates a manifold gets.
class Choice {
 public:
  Choice(const Candidates& candidates, int most, double bound, double slack)
      : candidates_(candidates), most_(most), bound_(bound), slack_(slack), loop_(candidates, bound) {
    for (int i = 0; i < candidates.count(); ++i) known_[std::size_t(i)] = candidates.is_known(candidates[i]);
  }

  Chosen of(const Manifold& previous) {
    Chosen chosen;
    if (candidates_.count() == 0 || most_ == 0) return chosen;
    first_ = deepest(previous);
    chosen_[std::size_t(first_)] = true;
    loop_.add(first_);
    if (int(known_.count()) + !is_known(first_) <= most_)
      take(known_);
    else
      grow(Among::Known);
    const bool is_new = size_ == 1, has_choice = most_ > 2 && candidates_.count() > most_;
    if (!(is_new && has_choice)) grow(Among::All);
    if (has_choice) give_way(largest_polygon(candidates_, first_, most_, bound_), is_new ? 1 : 1 + kKeptWorth);
    bool is_corner = false;
    const int before = loop_.before(first_, is_corner);
    chosen.add(first_);
    for (int i = 1 + is_corner; i <= loop_.size(); ++i) chosen.add(loop_[(before + i) % loop_.size()]);
    return chosen;
  }

 private:
  enum class Among { Known, All };
  using Set = std::bitset<kMostCandidates>;
  static constexpr int kNobody = -1;

  bool is_chosen(int i) const { return chosen_[std::size_t(i)]; }
  bool is_known(int i) const { return known_[std::size_t(i)]; }

  /// The first point of the manifold before if it is nearly the deepest, else the deepest of its points that are, else the
  /// first candidate within a quarter of the bound of the least separation. The rest of the bound is left for the rounding of
  /// the witness.
  int deepest(const Manifold& previous) const {
    int found = kNobody;
    for (int i = 0; i < candidates_.count(); ++i) {
      const double separation = candidates_[i].separation;
      if (!(separation <= candidates_.least() + (is_known(i) ? slack_ : bound_ / 4))) continue;
      if (is_known(i) && is_same(previous.points[0], candidates_[i])) return i;
      if (found == kNobody || (is_known(i) && !(is_known(found) && candidates_[found].separation <= separation))) found = i;
    }
    return found;
  }

  /// Chooses `first_` and, of `those`, all that stand out.
  void take(const Set& those) {
    chosen_ = those;
    chosen_[std::size_t(first_)] = true;
    Set before;
    do {
      before = chosen_;
      loop_ = around();
      chosen_.reset();
      for (int i = 0; i < loop_.size(); ++i) chosen_[std::size_t(loop_[i])] = true;
      chosen_[std::size_t(first_)] = true;
    } while (chosen_ != before);
    size_ = int(chosen_.count());
  }

  /// Chooses a polygon instead if that has more than `worth` times the area.
  void give_way(const LargestPolygon& polygon, double worth) {
    const double enough = worth * loop_.twice_area();
    if (polygon.twice_area > enough) {
      const Set before = chosen_;
      Set corners;
      for (const int corner : polygon) corners[std::size_t(corner)] = true;
      take(corners);
      if (!(loop_.twice_area() > enough)) take(before);
    }
    grow(Among::All);
  }

  /// The hull of all chosen candidates. `first_` is added first, so that others in its place do not replace it.
  Loop around() const {
    Loop loop(candidates_, bound_);
    loop.add(first_);
    for (int i = 0; i < candidates_.count(); ++i) {
      if (is_chosen(i) && i != first_) loop.add(i);
    }
    return loop;
  }

  /// Adds what adds most to the area until nothing does.
  void grow(Among those) {
    for (int rest = candidates_.count(); size_ < most_ && rest > 0; --rest) {
      int found = kNobody;
      double most = 0;
      for (int i = 0; i < candidates_.count(); ++i) {
        if (is_chosen(i) || (those == Among::Known && !is_known(i))) continue;
        if (const double gain = loop_.gain(i); gain > most) most = gain, found = i;
      }
      if (found == kNobody) return;
      chosen_[std::size_t(found)] = true;
      take(chosen_);
    }
  }

  const Candidates& candidates_;
  const int most_;
  const double bound_, slack_;
  int size_ = 1, first_ = 0;
  Set known_, chosen_;  ///< of the manifold before, of this one
  Loop loop_;           ///< around the chosen ones
};

}  // namespace

Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound, double slack) {
  return Choice(candidates, int(most), bound, max(slack, bound / 4)).of(previous);
}

}  // namespace swiftlet
