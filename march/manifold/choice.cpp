// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/choice.h"

#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

/// The convex hull of candidates' places, counter-clockwise; a place outside by no more than the bound does not change it.
class Loop {
 public:
  Loop(const Candidates& candidates, double bound) : candidates_(candidates), bound_(bound) {}

  int size() const { return size_; }
  int operator[](int i) const { return corner_[std::size_t(i)]; }

  /// A place that is a corner, or where it takes least from the area beside its nearest side: the corner after which it comes.
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
  /// Of three on one line the two that are farthest apart stay: the first two may lie nearly in one place.
  void stretch(int spot) {
    const double from_first = apart(corner_[0], spot), from_second = apart(corner_[1], spot);
    if (max(from_first, from_second) <= apart(corner_[0], corner_[1])) return;
    corner_[from_first >= from_second] = spot;
  }

  int next(int i) const { return i + 1 == size_ ? 0 : i + 1; }
  int previous(int i) const { return i == 0 ? size_ - 1 : i - 1; }
  const Vec& place(int spot) const { return candidates_[spot].on_a; }
  const Vec& corner(int i) const { return place(corner_[std::size_t(i)]); }

  double apart(int spot, int other) const {
    const double dx = place(other).x - place(spot).x, dy = place(other).y - place(spot).y;
    return std::sqrt(dx * dx + dy * dy);
  }

  /// Twice that between a side and a place, positive beyond it.
  double area(int side, int spot) const {
    const Vec &p = corner(side), &q = corner(next(side)), &c = place(spot);
    return (c.x - p.x) * (q.y - p.y) - (c.y - p.y) * (q.x - p.x);
  }
  /// The same of a place that stands out, else 0.
  double beyond(int side, int spot) const {
    const Vec &p = corner(side), &q = corner(next(side));
    const double dx = q.x - p.x, dy = q.y - p.y, size = area(side, spot);
    return size > 0 && size * size > bound_ * bound_ * (dx * dx + dy * dy) ? size : 0;
  }

  const Candidates& candidates_;
  double bound_;
  int size_ = 0;
  std::array<int, kMostManifoldPoints> corner_;
};

/// Which of the candidates a manifold gets.
class Choice {
 public:
  Choice(const Candidates& candidates, double bound) : candidates_(candidates), bound_(bound) {
    for (int i = 0; i < candidates.count(); ++i) known_[std::size_t(i)] = candidates.is_known(candidates[i]);
  }

  Chosen of(std::uint32_t most, const Manifold& previous) {
    Chosen chosen;
    if (candidates_.count() == 0 || most == 0) return chosen;
    first_ = deepest(previous);
    chosen_[std::size_t(first_)] = true;
    while (size_ < int(most) && grow(Among::Known)) {
    }
    for (int rest = kExchanges; rest > 0; --rest) {
      while (size_ < int(most) && grow(Among::All)) {
      }
      if (!exchange()) break;
    }
    const Loop loop = around();
    bool is_corner = false;
    const int before = loop.before(first_, is_corner);
    chosen.add(first_);
    for (int i = 1 + is_corner; i <= loop.size(); ++i) chosen.add(loop[(before + i) % loop.size()]);
    return chosen;
  }

 private:
  enum class Among { Known, All };
  static constexpr int kNobody = -1;

  bool is_chosen(int i) const { return chosen_[std::size_t(i)]; }
  bool is_known(int i) const { return known_[std::size_t(i)]; }

  /// The first of the manifold before, else one of it, else any: with what the witness may be deeper still within the bound.
  int deepest(const Manifold& previous) const {
    const double enough = candidates_.least() + bound_ / 4;
    int found = kNobody;
    for (int i = 0; i < candidates_.count(); ++i) {
      if (candidates_[i].separation > enough) continue;
      if (is_known(i) && is_same(previous.points[0], candidates_[i])) return i;
      if (found == kNobody || (is_known(i) && !is_known(found))) found = i;
    }
    return found;
  }

  /// Of all that are chosen, but for one.
  Loop around(int without = kNobody) const {
    Loop loop(candidates_, bound_);
    for (int i = 0; i < candidates_.count(); ++i) {
      if (is_chosen(i) && i != without) loop.add(i);
    }
    return loop;
  }

  /// The one that adds more than `least` and most to a loop.
  int best(const Loop& loop, double least, Among those) const {
    int found = kNobody;
    for (int i = 0; i < candidates_.count(); ++i) {
      if (is_chosen(i) || (those == Among::Known && !is_known(i))) continue;
      if (const double gain = loop.gain(i); gain > least) least = gain, found = i;
    }
    return found;
  }

  bool grow(Among those) {
    const int found = best(around(), 0, those);
    if (found == kNobody) return false;
    chosen_[std::size_t(found)] = true;
    ++size_;
    return true;
  }

  /// Leaves out one that adds nothing, or takes another for it; false where all stay.
  bool exchange() {
    for (int i = 0; i < candidates_.count(); ++i) {
      if (!is_chosen(i) || i == first_) continue;
      const Loop others = around(i);
      const double gain = others.gain(i);
      const int found = best(others, (1 + kKeptWorth) * gain, Among::All);
      if (found == kNobody && gain > 0) continue;
      chosen_[std::size_t(i)] = false;
      if (found == kNobody)
        --size_;
      else
        chosen_[std::size_t(found)] = true;
      return true;
    }
    return false;
  }

  const Candidates& candidates_;
  double bound_;
  int size_ = 1, first_ = 0;
  std::array<bool, kMostCandidates> known_{}, chosen_{};  ///< of the manifold before, of this one
};

}  // namespace

Chosen choose(const Candidates& candidates, std::uint32_t most, const Manifold& previous, double bound) {
  return Choice(candidates, bound).of(most, previous);
}

}  // namespace swiftlet
