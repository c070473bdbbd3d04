// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Few of the corners that two contact faces have in common: the deepest, and those that keep most of the area.
#include <swiftlet/manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "body/half_edge.h"
#include "manifold/clip.h"
#include "manifold/contact_face.h"
#include "pair/intersection.h"
#include "pair/pair_view.h"
#include "query/radii.h"

namespace swiftlet {
namespace {

/// The convex loop around places, counter-clockwise; one that hardly stands out changes nothing.
class Loop {
 public:
  Loop(const Candidate* candidates, double bound) : candidates_(candidates), bound_(bound) {}

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
  const Candidate& at(int corner) const { return candidates_[corner_[std::size_t(corner)]]; }

  double apart(int p, int q) const {
    const double dx = candidates_[q].x - candidates_[p].x, dy = candidates_[q].y - candidates_[p].y;
    return std::sqrt(dx * dx + dy * dy);
  }

  /// Twice that between a side and a place, positive beyond it.
  double area(int side, int spot) const {
    const Candidate &p = at(side), &q = at(next(side)), &c = candidates_[spot];
    return (c.x - p.x) * (q.y - p.y) - (c.y - p.y) * (q.x - p.x);
  }
  /// The same of a place that stands out, else 0.
  double beyond(int side, int spot) const {
    const Candidate &p = at(side), &q = at(next(side));
    const double dx = q.x - p.x, dy = q.y - p.y, size = area(side, spot);
    return size > 0 && size * size > bound_ * bound_ * (dx * dx + dy * dy) ? size : 0;
  }

  const Candidate* candidates_;
  double bound_;
  int size_ = 0;
  std::array<int, kMostManifoldPoints> corner_;
};

/// The corners of a common area and the witness.
class Candidates {
 public:
  Candidates(const PairView& pair, const Projection& projection, const ContactFace& a, const ContactFace& b,
             const Candidate& witness, double bound)
      : bound_(bound) {
    count_ = clip(pair, projection, a, b, bound, std::span(all_).first<kMostCandidates>());
    if (count_ == 0 || witness.separation < least() - bound / 2) all_[std::size_t(count_++)] = witness;
  }

  /// Fills the manifold's points: one of least separation, then whichever adds most to the area, those of the manifold before
  /// first; then each but the first gives way to one that adds distinctly more. What is chosen depends on nothing but the first
  /// and which are there, and stays what it is when asked again: all that changes them lets their area grow.
  void choose(std::uint32_t most, double margin, const Manifold& previous, Manifold& manifold) {
    drop_beyond(margin + bound_);
    if (count_ == 0 || most == 0) return;
    recognise(previous);
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
    show(first_, manifold);
    for (int i = 1 + is_corner; i <= loop.size(); ++i) show(loop[(before + i) % loop.size()], manifold);
  }

 private:
  enum class Among { Known, All };
  static constexpr int kNobody = -1;

  const Candidate& at(int i) const { return all_[std::size_t(i)]; }
  bool is_chosen(int i) const { return chosen_[std::size_t(i)]; }

  double least() const {
    double least = all_[0].separation;
    for (int i = 1; i < count_; ++i) least = min(least, at(i).separation);
    return least;
  }

  void drop_beyond(double separation) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (at(i).separation <= separation) all_[std::size_t(kept++)] = at(i);
    }
    count_ = kept;
  }

  static bool is_same(const ManifoldPoint& p, const Candidate& c) {
    return p.feature_a == c.feature_a && p.feature_b == c.feature_b;
  }

  void recognise(const Manifold& previous) {
    for (int i = 0; i < count_; ++i) {
      known_[std::size_t(i)] = chosen_[std::size_t(i)] = false;
      for (std::uint32_t k = 0; k < std::min(previous.count, kMostManifoldPoints); ++k)
        known_[std::size_t(i)] = known_[std::size_t(i)] || is_same(previous.points[k], at(i));
    }
  }

  /// The first of the manifold before, else one of it, else any: with what the witness may be deeper still within the bound.
  int deepest(const Manifold& previous) const {
    const double enough = least() + bound_ / 4;
    int found = kNobody;
    for (int i = 0; i < count_; ++i) {
      if (at(i).separation > enough) continue;
      if (known_[std::size_t(i)] && is_same(previous.points[0], at(i))) return i;
      if (found == kNobody || (known_[std::size_t(i)] && !known_[std::size_t(found)])) found = i;
    }
    return found;
  }

  /// Of all that are chosen, but for one.
  Loop around(int without = kNobody) const {
    Loop loop(all_.data(), bound_);
    for (int i = 0; i < count_; ++i) {
      if (is_chosen(i) && i != without) loop.add(i);
    }
    return loop;
  }

  /// The one that adds more than `least` and most to a loop.
  int best(const Loop& loop, double least, Among those) const {
    int found = kNobody;
    for (int i = 0; i < count_; ++i) {
      if (is_chosen(i) || (those == Among::Known && !known_[std::size_t(i)])) continue;
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
    for (int i = 0; i < count_; ++i) {
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

  void show(int i, Manifold& manifold) const {
    const Candidate& c = at(i);
    manifold.points[manifold.count++] = {eigen(c.point_a), eigen(c.point_b), c.separation, c.feature_a, c.feature_b};
  }

  double bound_;
  int count_ = 0, size_ = 1, first_ = 0;
  std::array<bool, kMostCandidates + 1> known_, chosen_;  ///< of the manifold before, of this one
  std::array<Candidate, kMostCandidates + 1> all_;
};

/// What a manifold grows from, in A's frame; the points are on the hulls.
struct Anchor {
  Vec normal, point_a, point_b;
  FeatureId feature_a, feature_b;
};

/// The manifold of two hulls, within a margin of theirs.
Manifold grown(const PairView& pair, const Anchor& w, double margin, double bound, const ManifoldOptions& options,
               const Manifold& previous) {
  Manifold manifold;
  const Projection projection(w.normal, w.point_a);
  std::uint32_t tests = 0;
  const FeatureId at_a = feature_at_a(pair, w.feature_a, w.point_a, tests),
                  at_b = feature_at_b(pair, w.feature_b, w.point_b, tests);
  ContactFace a, b;
  contact_face_a(pair, projection, at_a, previous.face_a, options.flatness, a);
  contact_face_b(pair, projection, at_b, previous.face_b, options.flatness, b);
  manifold.normal = eigen(w.normal);
  if (a.face != kNone) manifold.face_a = {FeatureKind::Face, a.face};
  if (b.face != kNone) manifold.face_b = {FeatureKind::Face, b.face};

  const Candidate witness = candidate(projection, w.point_a, w.point_b, named(pair.a, at_a), named(pair.b, at_b));
  Candidates candidates(pair, projection, a, b, witness, bound);
  candidates.choose(std::min(options.most_points, kMostManifoldPoints), margin, previous, manifold);
  return manifold;
}

bool exists(const Shape& body, int level, FeatureId feature) {
  return level >= body.finest_level() && level < body.level_count() && names_feature(body.level(level).view, feature);
}

}  // namespace

Manifold manifold(const Body& a, const Body& b, const Pose& b_in_a, const Answer& answer, const ManifoldOptions& options,
                  const Manifold& previous) {
  const Setting at(a, b, b_in_a);
  const Shape &body_a = at.a, &body_b = at.b;
  if (at.fault() != Status::Converged || Radii(answer) != at.radii || answer.normal.hasNaN() || answer.point_a.hasNaN() ||
      !exists(body_a, answer.level_a, answer.feature_a) || !exists(body_b, answer.level_b, answer.feature_b))
    return {};
  const Vec n = vec(answer.normal);
  const PairView hulls =
      pair_view(body_a.level(answer.level_a).view, body_b.level(answer.level_b).view, at.motion, at.quality.error);
  const double radii = at.radii.sum();
  Manifold manifold = grown(
      hulls,
      {n, vec(answer.point_a) - n * at.radii.a(), vec(answer.point_b) + n * at.radii.b(), answer.feature_a, answer.feature_b},
      options.margin + radii, hulls.law_two + kLawTwo * radii, options, previous);
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& p = manifold.points[i];
    p.point_a = eigen(vec(p.point_a) + n * at.radii.a());
    p.point_b = eigen(vec(p.point_b) - n * at.radii.b());
    p.separation -= radii;
  }
  return manifold;
}

}  // namespace swiftlet
