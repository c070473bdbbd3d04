// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The intersection of two convex polygons whose corners are found by their index. A border of it is sought between two of its
// corners, p and q:
//
//           x      The edges beside p and q meet in x when prolonged: all of the border between them lies in the triangle
//         . /|     p x q. As long as that is large, the middle corner of the polygon that has more corners there is tried. It
//       .  / |     is a corner of the intersection, or the other polygon's edge beside it is an edge of the intersection,
//     q   r  |     whose ends are found by halving too. Then the same is done below and above what was found. Of n and m
//       .  \ |     corners an edge takes log n + log m steps, and a few corners of any polygon hold nearly all of its area.
//         .  p
//
// The deepest corner is sought the same way: of two edges, along the lower of which the separation falls upwards, while it
// rises along the upper one, it is between them.
#include <algorithm>
#include <array>
#include <cmath>

#include "body/half_edge.h"
#include "manifold/clip.h"
#include "manifold/line.h"

namespace swiftlet {
namespace {

/// The corners of a face that is no rim, counter-clockwise.
struct FewCorners {
  static constexpr std::uint32_t kMost = 16;
  Vertex corner[kMost];
  std::uint32_t vertex[kMost];  ///< which these are
};

/// A contact face as a projection shows it. Its corners have numbers around the face, from 0 on.
class Outline {
 public:
  /// `few` is filled if the face is no rim, and has to outlive the outline.
  Outline(const SeenBody& body, const ContactFace& face, FewCorners& few)
      : body_(body),
        face_(face),
        is_from_above_(dot(cross(body.x, body.y), face.normal()) >= 0),
        first_(face.is_rim() ? origin(body.view, face.side()) : kNone),
        corners_(face.is_rim() ? &body.view.vertices[first_] : few.corner),
        names_(few.vertex),
        count_(face.is_rim() ? face.corner_count() : note_corners(few)),
        lowest_(count_ > 0 ? extreme(0, 1) : 0),
        highest_(count_ > 0 ? extreme(on(lowest_, count_ / 2), -1) : 0) {}

  /// Whether the face is seen from the front or the back, and its border, if it is no rim, turns inwards at all of few corners.
  bool is_clear() const { return count_ > 2 && lowest_ != highest_ && std::fabs(dot(body_.n, face_.normal())) > kLeastFacing; }
  const SeenBody& body() const { return body_; }
  const ContactFace& face() const { return face_; }
  std::uint32_t count() const { return count_; }
  const Vertex& operator[](std::uint32_t i) const { return corners_[i]; }
  /// Which vertex a corner is.
  std::uint32_t vertex(std::uint32_t i) const { return first_ != kNone ? first_ + i : names_[i]; }
  /// The number of a corner, or kNone of another vertex.
  std::uint32_t number(std::uint32_t vertex) const {
    const std::uint32_t i =
        first_ != kNone ? vertex - first_ : std::uint32_t(std::find(names_, names_ + count_, vertex) - names_);
    return i < count_ ? i : kNone;
  }
  bool is_from_above() const { return is_from_above_; }
  std::uint32_t lowest() const { return lowest_; }
  std::uint32_t highest() const { return highest_; }
  /// How many corners on from one to another.
  std::uint32_t steps(std::uint32_t from, std::uint32_t to) const { return to >= from ? to - from : to + count_ - from; }

 private:
  /// Notes the corners of a face that is no rim. Returns 0 if there are many, or one may not turn inwards.
  std::uint32_t note_corners(FewCorners& few) const {
    if (face_.side() == kNone || !face_.has_plane()) return 0;
    const HalfEdge* half_edges = body_.view.half_edges.data();
    const double sense = is_from_above_ ? 1 : -1;
    std::uint32_t count = 0, h = face_.side();
    PlanePoint at = body_.at(origin(body_.view, h)), before = body_.at(half_edges[h].head) - at;
    at = at + before;
    do {
      const std::uint32_t next = face_.onward<true>(h);
      const PlanePoint there = body_.at(half_edges[next].head), way = there - at;
      const double most = max(std::fabs(way.x) + std::fabs(way.y), std::fabs(before.x) + std::fabs(before.y));
      if (count == FewCorners::kMost || !(sense * cross(before, way) > face_.flatness() * most)) return 0;
      few.corner[count] = body_.view.vertices[half_edges[h].head], few.vertex[count++] = half_edges[h].head;
      h = next, at = there, before = way;
    } while (h != face_.side());
    return count;
  }
  double height(std::uint32_t i) const { return dot(body_.y, vec(corners_[i])); }
  /// The lowest corner, sought from `start` on; with a `sign` of -1 the highest one.
  std::uint32_t extreme(std::uint32_t start, double sign) const {
    const double flat = 2 * face_.flatness(), from = sign * height(start);
    // The border surely falls at every side from `start` to there.
    std::uint32_t low = start;
    for (const bool onwards : {true, false}) {
      const auto there = [&](std::uint32_t steps) { return on(start, onwards ? steps : count_ - steps); };
      const auto falls = [&](std::uint32_t steps) {
        const double y = sign * height(there(steps));
        return y < from && sign * height(there(steps - 1)) - y > flat;
      };
      std::uint32_t steps = 0, end = 1;
      for (; end < count_ && falls(end); end *= 2) steps = end;
      for (end = std::min(end, count_); end - steps > 1;) {
        const std::uint32_t middle = steps + (end - steps) / 2;
        (falls(middle) ? steps : end) = middle;
      }
      low = there(steps);
      if (steps > 0) break;
    }
    // Around the lowest corner sides may be level: it is sought until the border has risen.
    std::uint32_t found = low;
    double least = sign * height(low);
    for (const std::uint32_t step : {1u, count_ - 1}) {
      for (std::uint32_t i = on(low, step); i != low; i = on(i, step)) {
        const double y = sign * height(i);
        if (y > least + flat) break;
        if (y < least) least = y, found = i;
      }
    }
    return found;
  }
  /// The corner so many on from one.
  std::uint32_t on(std::uint32_t i, std::uint32_t steps) const {
    i += steps;
    return i < count_ ? i : i - count_;
  }

  const SeenBody& body_;
  const ContactFace& face_;
  const bool is_from_above_;
  const std::uint32_t first_;  ///< of a rim: vertex 0
  const Vertex* const corners_;
  const std::uint32_t* const names_;  ///< of a face that is no rim
  const std::uint32_t count_, lowest_, highest_;
};

/// One of the two borders of a face. Corner 0 is the lowest, corner `size()` the highest, and side k begins at corner k.
class Chain {
 public:
  Chain(const Outline& outline, Border border)
      : outline_(outline),
        goes_on_((border == Border::Right) == outline.is_from_above()),
        size_(goes_on_ ? outline.steps(outline.lowest(), outline.highest())
                       : outline.steps(outline.highest(), outline.lowest())),
        start_(outline.lowest() + (goes_on_ ? 0 : outline.count())),
        count_(outline.count()),
        corners_(&outline[0]) {
    const SeenBody& body = outline.body();
    const double outwards = border == Border::Left ? -1 : 1;
    x_ = body.x * outwards;
    shift_ = {body.shift.x * outwards, body.shift.y};
  }

  std::uint32_t size() const { return size_; }
  std::uint32_t vertex(std::uint32_t k) const { return outline_.vertex(number(k)); }
  /// Which corner a vertex is, or kNone.
  std::uint32_t corner(std::uint32_t vertex) const {
    const std::uint32_t i = outline_.number(vertex);
    if (i == kNone) return kNone;
    const std::uint32_t k = goes_on_ ? outline_.steps(outline_.lowest(), i) : outline_.steps(i, outline_.lowest());
    return k <= size_ ? k : kNone;
  }
  double y(std::uint32_t k) const { return dot(outline_.body().y, vec(corners_[number(k)])) + shift_.y; }
  PlanePoint at(std::uint32_t k) const {
    const Vec p = vec(corners_[number(k)]);
    return {dot(x_, p) + shift_.x, dot(outline_.body().y, p) + shift_.y};
  }
  Line side(std::uint32_t k) const {
    const PlanePoint from = at(k), to = at(k + 1);
    return {from, to, way(from, to)};
  }
  /// The edge that is a side.
  FeatureId edge(std::uint32_t k) const {
    const ConvexView& view = outline_.body().view;
    const std::uint32_t head = vertex(goes_on_ ? k + 1 : k);
    std::uint32_t h = corners_[number(goes_on_ ? k : k + 1)].ring_begin;
    while (view.half_edges[h].head != head) ++h;
    return named(view, {FeatureKind::Edge, h});
  }
  double z_on(std::uint32_t k, double t) const {
    const Vec2 z = outline_.body().z(vertex(k), vertex(k + 1));
    return z[0] + (z[1] - z[0]) * t;
  }
  /// Of the sides from `low` to `high`, the one at a height.
  std::uint32_t side_at(double height, std::uint32_t low, std::uint32_t high) const {
    for (++high; high - low > 1;) {
      const std::uint32_t middle = low + (high - low) / 2;
      (y(middle) <= height ? low : high) = middle;
    }
    return low;
  }
  /// The same, found sooner near `guess`.
  std::uint32_t side_at(double height, std::uint32_t low, std::uint32_t high, std::uint32_t guess) const {
    if (y(guess) <= height) {
      low = guess;
      for (std::uint32_t step = 1; high - low > step; step *= 2) {
        if (y(low + step) > height) return side_at(height, low, low + step - 1);
        low += step;
      }
    } else {
      high = guess - (guess > low);
      for (std::uint32_t step = 1; high - low > step; step *= 2) {
        if (y(high - step) <= height) return side_at(height, high - step, high);
        high -= step;
      }
    }
    return side_at(height, low, high);
  }
  /// The same of all sides, where the guess is the share `part` of them.
  std::uint32_t side_at(double height, double part) const {
    return side_at(height, 0, size_ - 1, std::min(std::uint32_t(part * size_), size_ - 1));
  }

 private:
  /// Of corner `k`, around the face.
  std::uint32_t number(std::uint32_t k) const {
    const std::uint32_t i = goes_on_ ? start_ + k : start_ - k;
    return i < count_ ? i : i - count_;
  }

  const Outline& outline_;
  const bool goes_on_;  ///< upwards, corners follow in the order of their numbers
  const std::uint32_t size_, start_, count_;
  const Vertex* const corners_;  ///< of the face
  Vec x_;                        ///< the axis in the body's frame
  PlanePoint shift_;             ///< where its origin is seen
};

/// The place of a line at a height.
PlanePoint at_height(const Line& line, double y) {
  const double rise = line.way.y, t = rise > 0 ? max(0, min((y - line.from.y) / rise, 1)) : 0;
  return {line.from.x + line.way.x * t, y};
}

/// Face 0 or 1; where the borders of both cross; an end of the intersection, which is added apart.
using Owner = std::uint8_t;
constexpr Owner kCrossing = 2, kTip = 3;

/// A corner of the intersection on one of its borders, and the edge there.
struct Knot {
  PlanePoint at;
  PlanePoint way;         ///< the edge's, upwards
  Owner leader;           ///< the face that has the edge
  Owner face;             ///< of which this is a corner, or a crossing or tip
  std::uint32_t corner;   ///< of the face's border
  std::uint32_t side[2];  ///< of each face's border, that at this height: the leader's is the edge, both cross at a crossing
};
bool is_same(const Knot& p, const Knot& q) {
  if (p.face != q.face) return false;
  return p.face == kCrossing ? p.side[0] == q.side[0] && p.side[1] == q.side[1] : p.corner == q.corner;
}

/// An edge of the intersection.
struct Edge {
  Knot low, high;
};

/// Corners of one border, at most one for each point of a manifold.
class Known {
 public:
  struct Corner {
    int face;
    std::uint32_t k;
    bool operator==(const Corner&) const = default;
  };
  void add(const Corner& corner) { corners_[count_++] = corner; }
  const Corner* begin() const { return corners_.data(); }
  const Corner* end() const { return corners_.data() + count_; }

 private:
  std::size_t count_ = 0;
  std::array<Corner, kMostManifoldPoints> corners_;
};

class Halving {
 public:
  Halving(const Outline& a, const Outline& b, double bound, Candidates& corners)
      : outline_{&a, &b},
        chain_{{{a, Border::Left}, {b, Border::Left}}, {{a, Border::Right}, {b, Border::Right}}},
        name_{a.face().name(), b.face().name()},
        bound_(bound),
        slope_(slope(1) - slope(0)),
        middle_(height_of_middle(1) - height_of_middle(0)),
        corners_(corners) {}

  /// Returns false, and has added nothing, if no height is found at which the faces surely have something in common.
  bool run() {
    const Width width = find_width();
    if (!(width.x > 0)) return false;
    const Tip bottom = tip<false>(width.y), top = tip<true>(width.y);
    for (const Border border : kBorders) {
      const Knot &low = bottom.knot[std::size_t(border)], &high = top.knot[std::size_t(border)];
      if (low.side[0] > high.side[0] || low.side[1] > high.side[1]) return false;  // borders level up to rounding
    }
    // The part of the separation's range that is not above the farthest one: of a round area a part t holds about t^1.5.
    const double height = top.at.y - bottom.at.y, range = std::fabs(slope_.x) * 2 * width.x + std::fabs(slope_.y) * height,
                 allowed = corners_.farthest() - middle_, part = allowed < range ? max(allowed / range, kLeastPart) : 1;
    const double area = width.x * height;
    for (double share = kLeastChord * part * std::sqrt(part);; share *= kFinerChord) {
      corners_.begin(bottom.at, share * area);
      is_whole_ = true, known_[0] = known_[1] = {};
      for (const Names& names : corners_.previous()) recall(names);
      add(bottom, Border::Left);
      go_up(Border::Left, bottom.knot[0], top.knot[0]);
      go_up(Border::Right, bottom.knot[1], top.knot[1]);
      add(top, Border::Right);
      // Of few corners none is left out.
      if (is_whole_ || corners_.found() >= kFewCorners || share * area < bound_ * (width.x + height)) break;
    }
    return true;
  }

 private:
  const Chain& chain(Border border, int f) const { return chain_[std::size_t(border)][f]; }
  static PlanePoint seen(Border border, const PlanePoint& place) {
    return {border == Border::Left ? -place.x : place.x, place.y};
  }
  /// A side of one border as the other sees it.
  static Line mirrored(const Line& side) {
    return {seen(Border::Left, side.from), seen(Border::Left, side.to), {seen(Border::Left, side.way), side.way.most}};
  }

  /// How the coordinate along the normal changes with x and y in the plane of face `f`.
  PlanePoint slope(int f) const {
    const SeenBody& body = outline_[f]->body();
    const Vec& m = outline_[f]->face().normal();
    return PlanePoint{dot(body.x, m), dot(body.y, m)} * (-1 / dot(body.n, m));
  }
  /// That coordinate of the plane at 0.
  double height_of_middle(int f) const {
    const SeenBody& body = outline_[f]->body();
    const std::uint32_t v = outline_[f]->vertex(0);
    return body.z(v) - dot(slope(f), body.at(v));
  }
  double rise(Border border, const PlanePoint& way) const { return dot(slope_, seen(border, way)); }
  double separation(Border border, const PlanePoint& place) const { return middle_ + rise(border, place); }
  bool is_within(Border border, const PlanePoint& place) const { return separation(border, place) <= corners_.farthest(); }

  /// Finds a height at which the intersection is wider than rounding makes it, halfway up if it is, and that width.
  struct Width {
    double y, x = 0;
  };
  Width find_width() const {
    const auto lowest = [&](int f) { return chain(Border::Left, f).y(0); };
    const auto highest = [&](int f) { return chain(Border::Left, f).y(chain(Border::Left, f).size()); };
    double low = max(lowest(0), lowest(1)), high = min(highest(0), highest(1));
    for (int rest = kWidthSteps; rest > 0; --rest) {
      const double y = low + (high - low) / 2;
      if (!(low < y && y < high)) break;
      double x = 0, slope = 0;
      for (const Border border : kBorders) {
        const auto side = [&](int f) { return chain(border, f).side(chain(border, f).side_at(y, 0.5)); };
        const Line a = side(0), b = side(1);
        const double x_a = at_height(a, y).x, x_b = at_height(b, y).x;
        const Line& leader = x_b < x_a ? b : a;
        x += min(x_a, x_b), slope += leader.way.x / leader.way.y;
      }
      if (x > kSurelyCommon * bound_) return {y, x};
      (slope > 0 ? low : high) = y;
    }
    return {0};
  }

  /// Where the intersection begins or ends: at a corner of face `face`, or where the borders `of` of both faces cross.
  struct Tip {
    PlanePoint at;
    int face;
    Border of[2];
    std::uint32_t side[2];  ///< that cross
    Knot knot[2];           ///< on each border
  };
  template <bool up>
  Tip tip(double inside) const {
    const auto end = [&](int f) {
      const Chain& right = chain(Border::Right, f);
      return right.at(up ? right.size() : 0);
    };
    const int f = is_below(end(0), end(1)) == up ? 0 : 1, g = 1 - f;
    const PlanePoint at = end(f);
    const std::uint32_t beside[2] = {chain(Border::Left, g).side_at(at.y, up), chain(Border::Right, g).side_at(at.y, up)};
    for (const Border border : kBorders) {
      const Line side = chain(border, g).side(beside[std::size_t(border)]);
      if (where(seen(border, at), side, bound_) == Where::Outside) return crossing_tip<up>(f, opposite(border), inside, at.y);
    }
    Tip tip{at, f, {}, {}, {}};
    for (const Border border : kBorders) {
      const Chain& own = chain(border, f);
      const std::uint32_t k = up ? own.size() - 1 : 0;
      Knot& knot = tip.knot[std::size_t(border)];
      knot = {seen(border, at), own.side(k).way, Owner(f), Owner(f), k + up, {}};
      knot.side[f] = k, knot.side[g] = beside[std::size_t(border)];
    }
    return tip;
  }
  /// The same where the border `of_f` of face `f` crosses the other border of the other face, between two heights.
  template <bool up>
  Tip crossing_tip(int f, Border of_f, double inside, double outside) const {
    const int g = 1 - f;
    const Border of_g = opposite(of_f);
    const Chain &p = chain(of_f, f), &q = chain(of_g, g);
    // Of each border, the last corner that is known to lie inside of the other or below, and the first one that is not.
    struct Range {
      std::uint32_t in, out;
      std::uint32_t size() const { return up ? out - in : in - out; }
      std::uint32_t middle() const { return up ? in + size() / 2 : in - size() / 2; }
    };
    const auto range = [&](const Chain& chain) {  // where a border is level up to rounding, sides may come in another order
      const std::uint32_t in = chain.side_at(inside, 0.5), out = chain.side_at(outside, up);
      return Range{in + !up, up ? std::max(in, out) + 1 : std::min(in, out)};
    };
    Range of_p = range(p), of_q = range(q);
    while (of_p.size() > 1 || of_q.size() > 1) {
      const bool halves_p = of_p.size() > of_q.size();
      const Chain &halved = halves_p ? p : q, &other = halves_p ? q : p;
      Range &here = halves_p ? of_p : of_q, &there = halves_p ? of_q : of_p;
      const std::uint32_t k = here.middle();
      const PlanePoint at = halved.at(k);
      const std::uint32_t j = other.side_at(at.y, std::min(there.in, there.out), std::max(there.in, there.out) - 1);
      const bool is_inside = at.x + at_height(other.side(j), at.y).x > 0;
      (is_inside ? here.in : here.out) = k;
      (is_inside ? there.in : there.out) = j + (is_inside != up);
    }
    const std::uint32_t k = std::min(of_p.in, of_p.out), j = std::min(of_q.in, of_q.out);
    const Line side_p = p.side(k), side_q = q.side(j);
    const PlanePoint spot = crossing(side_p, mirrored(side_q), bound_ * bound_).on_a, at = seen(of_f, spot);
    Tip tip{at, kCrossing, {}, {}, {}};
    tip.of[f] = of_f, tip.of[g] = of_g, tip.side[f] = k, tip.side[g] = j;
    Knot &on_p = tip.knot[std::size_t(of_f)], &on_q = tip.knot[std::size_t(of_g)];
    on_p = {spot, side_p.way, Owner(f), kTip, up, {}}, on_q = {seen(of_g, at), side_q.way, Owner(g), kTip, up, {}};
    on_p.side[f] = k, on_p.side[g] = chain(of_f, g).side_at(at.y, up);
    on_q.side[g] = j, on_q.side[f] = chain(of_g, f).side_at(at.y, up);
    return tip;
  }

  /// What is found of a border between two knots by the middle corner there of the face that has more: that, or, if it is
  /// outside, the other face's edge beside it. Where no face has a corner, it is the one where the edges of both knots cross.
  Edge between(Border border, const Knot& low, const Knot& high) const {
    const std::uint32_t count[2] = {high.side[0] - low.side[0], high.side[1] - low.side[1]};
    const int f = count[0] < count[1], g = 1 - f;
    const Chain &own = chain(border, f), &other = chain(border, g);
    Edge found{low, high};
    if (count[f] == 0) {
      found.low.face = found.high.face = kCrossing;
      found.low.at = found.high.at = crossing(own.side(low.side[f]), other.side(low.side[g]), bound_ * bound_).on_a;
      return found;
    }
    const std::uint32_t k = low.side[f] + (count[f] + 1) / 2;
    const PlanePoint place = own.at(k);
    const std::uint32_t j = other.side_at(place.y, low.side[g], high.side[g], low.side[g] + (count[g] + 1) / 2);
    const Line beside = other.side(j);
    if (where(place, beside, bound_) == Where::Outside)
      return {end<false>(border, g, beside, j, k - 1, low), end<true>(border, g, beside, j, k, high)};
    for (Knot* knot : {&found.low, &found.high}) {
      knot->at = place, knot->leader = knot->face = Owner(f), knot->corner = k;
      knot->side[f] = knot == &found.low ? k - 1 : k, knot->side[g] = j;
    }
    found.low.way = place - own.at(k - 1), found.high.way = own.at(k + 1) - place;
    return found;
  }
  /// The end of the edge on side `k` of face `f`, which is `line`: the border of the other face comes in somewhere from its
  /// side `beside` on, or not before `limit`.
  template <bool up>
  Knot end(Border border, int f, const Line& line, std::uint32_t k, std::uint32_t beside, const Knot& limit) const {
    const int g = 1 - f;
    Knot knot = limit;
    knot.way = line.way, knot.leader = Owner(f);
    if (limit.leader == f && limit.side[f] == k) return knot;
    const Chain& other = chain(border, g);
    const PlanePoint place = up ? line.to : line.from;
    std::uint32_t low = up ? beside : limit.side[g], high = up ? limit.side[g] : beside;
    knot.side[f] = k;
    if (up ? place.y <= limit.at.y : place.y >= limit.at.y) {
      const std::uint32_t at_place = other.side_at(place.y, low, high, beside);
      if (where(place, other.side(at_place), bound_) != Where::Outside) {
        knot.at = place, knot.face = Owner(f), knot.corner = k + up, knot.side[g] = at_place;
        return knot;
      }
      (up ? high : low) = at_place;
    }
    for (++high; high - low > 1;) {
      const std::uint32_t middle = low + (high - low) / 2;
      ((line.beyond(other.at(middle)) < 0) == up ? high : low) = middle;
    }
    knot.side[g] = low, knot.face = kCrossing;
    knot.at = crossing(line, other.side(low), bound_ * bound_).on_a;
    return knot;
  }

  /// Finds corners from one knot to another, of which every chord cuts off little, and the deepest one.
  void go_up(Border border, Knot low, const Knot& top) {
    std::array<Edge, std::size_t(kMostEdges)> ahead;
    std::size_t count = 0;
    const Knot bottom = low;
    Knot next = top, last = low;
    bool was_within = is_within(border, bottom.at);
    const auto pass = [&](const Knot& knot) {
      if (is_same(last, knot)) return;
      const bool within = is_within(border, last.at), ends_within = within && !(was_within && is_within(border, knot.at));
      if (!is_same(last, bottom)) offer(border, last, knot.at - last.at, ends_within);
      last = knot, was_within = within;
    };
    for (int rest = kMostSplits;; --rest) {
      if (rest > 0 && count < ahead.size() && holds_more(border, low, next)) {
        ahead[count++] = between(border, low, next);
        next = ahead[count - 1].low;
        continue;
      }
      for (const Known::Corner& corner : known_[std::size_t(border)]) keep(border, low, next, corner);
      if (count == 0) break;
      const Edge& edge = ahead[--count];
      pass(edge.low), pass(edge.high);
      low = edge.high, next = count > 0 ? ahead[count - 1].low : top;
    }
    pass(top);
  }
  /// Whether the border between two knots may hold much, or the deepest corner, or the last one within the farthest separation.
  bool holds_more(Border border, const Knot& low, const Knot& high) {
    if (is_same(low, high) || (low.leader == high.leader && low.side[low.leader] == high.side[low.leader])) return false;
    const PlanePoint chord = high.at - low.at;
    const double out_low = cross(low.way, chord), out_high = cross(chord, high.way), turn = cross(low.way, high.way),
                 out = turn > 0 ? out_high / turn : kInfinity;  // along the lower edge, to where both meet
    if (!(out_low > 0 && out_high > 0)) return false;
    const double at_low = separation(border, low.at), at_high = separation(border, high.at),
                 at_apex = at_low + rise(border, low.way) * out, least = min(min(at_low, at_high), at_apex),
                 most = max(max(at_low, at_high), at_apex);
    if (least > corners_.farthest()) return false;
    if (most > corners_.farthest() || out_low * out > kSplitArea * corners_.enough() ||
        (rise(border, high.way) >= 0 && at_apex < at_low - bound_ / 2))
      return true;
    return is_whole_ = false;
  }

  /// Keeps a corner that the manifold before names, if it is one and lies between two knots, beside all others: what else is
  /// found does not depend on it.
  void keep(Border border, const Knot& low, const Knot& high, const Known::Corner& corner) {
    const int f = corner.face, g = 1 - f;
    if (!(low.side[f] < corner.k && corner.k <= high.side[f])) return;
    const PlanePoint place = chain(border, f).at(corner.k);
    const std::uint32_t j = chain(border, g).side_at(place.y, low.side[g], high.side[g], low.side[g]);
    if (where(place, chain(border, g).side(j), bound_) == Where::Outside) return;
    add_corner(border, f, chain(border, f).vertex(corner.k), seen(border, place), false, beside(border, g, j, place.y));
  }
  /// Adds a corner that chords would miss, whose next one is `way` ahead, or that the manifold before names, or if it has to.
  void offer(Border border, const Knot& knot, const PlanePoint& way, bool has_to) {
    const bool wanted = corners_.wants(border, knot.at, way, [&] { return rise(border, way); }) || has_to;
    is_whole_ &= wanted;
    const Known& known = known_[std::size_t(border)];
    if (!wanted && std::find(known.begin(), known.end(), Known::Corner{knot.face, knot.corner}) == known.end()) return;
    if (knot.face == kCrossing) return add_crossing(border, {border, border}, knot.side, wanted);
    const int g = 1 - knot.face;
    add_corner(border, knot.face, chain(border, knot.face).vertex(knot.corner), seen(border, knot.at), wanted,
               beside(border, g, knot.side[g], knot.at.y));
  }
  /// Sides of both borders of a face, by Border.
  struct Beside {
    std::uint32_t side[2];
  };
  /// Those at a height, of which one is known.
  Beside beside(Border border, int f, std::uint32_t known, double y) const {
    Beside beside;
    beside.side[std::size_t(border)] = known;
    beside.side[std::size_t(opposite(border))] = chain(opposite(border), f).side_at(y, part(border, f, known));
    return beside;
  }
  Beside beside(int f, double y) const {
    return {{chain(Border::Left, f).side_at(y, 0.5), chain(Border::Right, f).side_at(y, 0.5)}};
  }
  /// Of a border's sides, those below this one: a guess where other borders are as high.
  double part(Border border, int f, std::uint32_t side) const { return double(side) / chain(border, f).size(); }

  void add(const Tip& tip, Border border) {
    if (tip.face == kCrossing)
      add_crossing(border, tip.of, tip.side, true);
    else
      add_corner(border, tip.face, chain(Border::Left, tip.face).vertex(tip.knot[0].corner), tip.at, true,
                 {{tip.knot[0].side[1 - tip.face], tip.knot[1].side[1 - tip.face]}});
  }

  /// Notes a corner of one face that the manifold before names, to be tried, or keeps the crossing that it names.
  void recall(const Names& names) {
    const FeatureId of[2] = {names.a(), names.b()};
    for (const int f : {0, 1}) {
      if (of[f].kind() != FeatureKind::Vertex || of[1 - f] != name_[1 - f]) continue;
      for (const Border border : kBorders) {
        const std::uint32_t k = chain(border, f).corner(of[f].index());
        if (k != kNone) known_[std::size_t(border)].add({f, k});
      }
    }
    if (of[0].kind() != FeatureKind::Edge || of[1].kind() != FeatureKind::Edge) return;
    for (const Border border : kBorders) {
      const std::uint32_t side[2] = {side_of(border, 0, of[0]), side_of(border, 1, of[1])};
      if (side[0] == kNone || side[1] == kNone) continue;
      const Line a = chain(border, 0).side(side[0]), b = chain(border, 1).side(side[1]);
      if (a.beyond(b.from) * a.beyond(b.to) < 0 && b.beyond(a.from) * b.beyond(a.to) < 0)
        add_crossing(border, {border, border}, side, false);
    }
  }
  /// The side of a border that an edge is, or kNone.
  std::uint32_t side_of(Border border, int f, FeatureId edge) const {
    const ConvexView& view = outline_[f]->body().view;
    if (!names_feature(view, edge)) return kNone;
    const std::uint32_t k = chain(border, f).corner(origin(view, edge.index())),
                        j = chain(border, f).corner(view.half_edges[edge.index()].head);
    if (k == kNone || j == kNone) return kNone;
    return k + 1 == j ? k : j + 1 == k ? j : kNone;
  }
  /// As Sweep does.
  void add_corner(Border border, int f, std::uint32_t v, const PlanePoint& place, bool wanted, const Beside& there) {
    const int g = 1 - f;
    const FeatureId vertex{FeatureKind::Vertex, v};
    const Names names(f == 0 ? vertex : name_[0], f == 0 ? name_[1] : vertex);
    if (!corners_.takes(names, wanted)) return;
    const Chain &left = chain(Border::Left, g), &right = chain(Border::Right, g);
    const std::uint32_t l = there.side[0], r = there.side[1];
    const SeenBody& body = outline_[g]->body();
    const double depth = depth_between(left.side(l), right.side(r), body.z(left.vertex(l), right.vertex(r)),
                                       body.z(left.vertex(l + 1), right.vertex(r + 1)), place),
                 z = outline_[f]->body().z(v), z_a = f == 0 ? z : depth, z_b = f == 0 ? depth : z;
    corners_.add(border, {{place.x, place.y, z_a}, z_b - z_a, names}, wanted);
  }
  void add_crossing(Border border, const Border (&of)[2], const std::uint32_t (&side)[2], bool wanted) {
    const Chain &of_a = chain(of[0], 0), &of_b = chain(of[1], 1);
    const Line a = of_a.side(side[0]), side_b = of_b.side(side[1]), b = of[0] == of[1] ? side_b : mirrored(side_b);
    const double bound2 = bound_ * bound_;
    const Crossing at = crossing(a, b, bound2);
    const auto add_end = [&](int f, const PlanePoint& place, std::uint32_t v) {
      add_corner(border, f, v, seen(of[0], place), wanted, beside(1 - f, place.y));
    };
    if (are_near(a.from, at.on_a, bound2)) return add_end(0, a.from, of_a.vertex(side[0]));
    if (are_near(a.to, at.on_a, bound2)) return add_end(0, a.to, of_a.vertex(side[0] + 1));
    if (are_near(b.from, at.on_a, bound2)) return add_end(1, b.from, of_b.vertex(side[1]));
    if (are_near(b.to, at.on_a, bound2)) return add_end(1, b.to, of_b.vertex(side[1] + 1));
    if (!at.meet) return;
    const Names names(of_a.edge(side[0]), of_b.edge(side[1]));
    if (!corners_.takes(names, wanted)) return;
    const double z_a = of_a.z_on(side[0], at.t_a), z_b = of_b.z_on(side[1], at.t_b);
    const PlanePoint place = seen(of[0], at.on_a);
    corners_.add(border, {{place.x, place.y, z_a}, z_b - z_a, names}, wanted);
  }

  const Outline* const outline_[2];
  const Chain chain_[2][2];  ///< of each border, those of both faces
  const FeatureId name_[2];
  const double bound_;
  const PlanePoint slope_;  ///< how the separation changes with x and y
  const double middle_;     ///< what it is at 0
  Candidates& corners_;
  bool is_whole_ = true;  ///< no corner is left out
  Known known_[2];        ///< of each border, what the manifold before names
};

}  // namespace

bool clip_by_halving(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                     Candidates& corners) {
  FewCorners few;  // one of the faces is a rim
  const Outline outline_a(projection.a, a, few), outline_b(projection.b, b, few);
  return outline_a.is_clear() && outline_b.is_clear() && Halving(outline_a, outline_b, bound, corners).run();
}

}  // namespace swiftlet
