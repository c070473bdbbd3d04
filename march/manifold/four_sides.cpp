// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The intersection of two convex polygons of three or four sides, as those of boxes and triangles are: every corner of the one
// is held against all sides of the other, which are lanes of one register.
//
//   a1-------a2         Corners go around clockwise, inside to the right of every side. b1 is outside of no side of A, so that
//   |  b1----|--b2      it is a corner of the intersection. The sides a2 a3 and b1 b2 cross, since the ends of each lie on
//   |  |     |  |       either side of the other. Where A leaves B through a side, B's corners after that side follow.
//   a0-|-----a3 |
//      b0-------b3
//
// A corner that lies on a side, up to the bound, counts as within it: it is a corner of the intersection, and no end of a side
// that crosses. Corners come in the order in which they lie around the intersection, but for such that rounding has moved.
#include <algorithm>
#include <cstdint>

#include "body/half_edge.h"
#include "manifold/clip.h"
#include "manifold/line.h"
#include "manifold/set.h"

namespace swiftlet {
namespace {

/// A contact face of three or four sides as a projection shows it. Side i goes from corner i to the next one.
class Polygon {
 public:
  static constexpr int kMostSides = 4;

  /// Has no sides if there are more, or a corner may not turn inwards by more than the flatness.
  Polygon(const SeenBody& body, const ContactFace& face, double bound)
      : body_(body), name_(face.name()), bound2_(bound * bound) {
    if (!face.has_plane() || face.is_rim()) return;
    const bool is_from_above = dot(cross(body.x, body.y), face.normal()) >= 0;
    const bool is_small = is_from_above ? go_round<false>(face, twin(face.side())) : go_round<true>(face, face.side());
    if (!is_small || !measure(bound, face.flatness())) count_ = 0;
  }

  int count() const { return count_; }
  Set every() const { return below(count_); }
  int next(int i) const { return i + 1 < count_ ? i + 1 : 0; }
  FeatureId name() const { return name_; }
  FeatureId vertex(int i) const { return {FeatureKind::Vertex, vertex_[i]}; }
  FeatureId edge(int i) const { return {FeatureKind::Edge, std::min(half_edge_[i], twin(half_edge_[i]))}; }
  const PlanePoint& at(int i) const { return at_[i]; }
  Line side(int i) const { return {at(i), at(i + 1), way(at(i), at(i + 1))}; }
  /// The coordinate along the normal, of a corner and of a place on a side.
  double z(int i) const { return z_[i]; }
  double z_on(int i, double t) const { return z_[i] + (z_[i + 1] - z_[i]) * t; }

  /// Of which sides a place is inside, and outside, by more than the bound. A place within the bound of every side's line, but
  /// of no side, lies beyond a corner, and is outside of the sides that it is beyond.
  struct Found {
    Set in, out;
  };
  [[gnu::always_inline]] Found find(const PlanePoint& place) const {
    const Vec4 area = (all(place.x) - x_) * way_y_ - (all(place.y) - y_) * way_x_;
    Found found{greater(area, limit_), greater(-limit_, area)};
    const Set beyond = greater(all(0), area);
    if (found.out == 0 && beyond != 0 && !is_beside(beyond, place)) found.out = beyond;
    return found;
  }

  /// The coordinate along the normal at a place of the face.
  double z_at(const PlanePoint& place) const {
    const Set begins_below = at_most(y_, all(place.y)) & every();
    const Set ends_below = begins_below >> 1 | (begins_below & 1) << (count_ - 1);
    int left, right;  // sides, the left one of which rises through this height and the right one falls
    if (begins_below != 0 && begins_below != every()) [[likely]] {
      left = lowest(begins_below & ~ends_below), right = lowest(ends_below & ~begins_below);
    } else {
      const bool is_above = begins_below != 0;
      const auto is_lower = [](const PlanePoint& p, const PlanePoint& q) { return p.y < q.y; };
      const auto tip = is_above ? std::max_element(at_, at_ + count_, is_lower) : std::min_element(at_, at_ + count_, is_lower);
      const int after = int(tip - at_), before = (after == 0 ? count_ : after) - 1;
      left = is_above ? before : after, right = is_above ? after : before;
    }
    const auto mirrored = [&](int i) { return swiftlet::place(xy(at(i)) * Vec2{-1, 1}); };
    const auto line = [](const PlanePoint& from, const PlanePoint& to) { return Line{from, to, way(from, to)}; };
    return depth_between(line(mirrored(left), mirrored(left + 1)), line(at(right + 1), at(right)), Vec2{z(left), z(right + 1)},
                         Vec2{z(left + 1), z(right)}, place);
  }

 private:
  std::uint32_t twin(std::uint32_t half_edge) const { return body_.view.half_edges[half_edge].twin; }

  /// True if a place is within the bound of one of these sides.
  bool is_beside(Set sides, const PlanePoint& place) const {
    bool found = false;
    each(sides, [&](int i) {
      const Line at = side(i);
      found |= are_near(at.at(at.along(place)), place, bound2_);
    });
    return found;
  }
  /// Notes the corners along the border from half-edge `first` on. Returns false if there are many.
  template <bool is_left>
  bool go_round(const ContactFace& face, std::uint32_t first) {
    std::uint32_t h = first, vertex = origin(body_.view, first);
    do {
      if (count_ == kMostSides) return false;
      vertex_[count_] = vertex, half_edge_[count_++] = h;
      vertex = body_.view.half_edges[h].head, h = face.onward<is_left>(h);
    } while (h != first);
    std::fill(vertex_ + count_, vertex_ + kMostSides, vertex_[0]);
    return count_ > 2;
  }
  /// Projects the corners. The fourth corner of a triangle is the first one, and its fourth side a point, of which no place is
  /// inside or outside. Returns true if the border surely turns inwards at every corner, by more than the flatness.
  bool measure(double bound, double flatness) {
    const Vertex* v = body_.view.vertices.data();
    const V3<Vec4> p = transposed(v[vertex_[0]], v[vertex_[1]], v[vertex_[2]], v[vertex_[3]]);
    const auto along = [&](const Vec& axis, double shift) { return p.x * axis.x + p.y * axis.y + p.z * axis.z + all(shift); };
    x_ = along(body_.x, body_.shift.x), y_ = along(body_.y, body_.shift.y);
    const auto after = [](const Vec4& lanes) { return swiftlet::next(lanes); };
    way_x_ = after(x_) - x_, way_y_ = after(y_) - y_;
    limit_ = sqrt(way_x_ * way_x_ + way_y_ * way_y_) * bound;
    // Both numbers of a place are stored by one store: a load of both would wait for two.
    const Vec4 z = along(body_.n, body_.shift.z), evens = even(x_, y_), odds = odd(x_, y_);
    at_[0] = place(low(evens)), at_[1] = place(low(odds)), at_[2] = place(high(evens)), at_[3] = place(high(odds));
    at_[4] = at_[0];
    for (const int i : {0, 1, 2, 3}) z_[i] = z[i];
    z_[4] = z_[0];
    const Vec4 sizes = abs(way_x_) + abs(way_y_), turns = after(way_x_) * way_y_ - after(way_y_) * way_x_;
    const Set ends = count_ == 4 ? 0xf : 0x3;  // a triangle turns by one area everywhere, and two corners have all its sides
    return (greater(turns, max(sizes, after(sizes)) * flatness) & ends) == ends;
  }

  const SeenBody& body_;
  const FeatureId name_;
  const double bound2_;
  int count_ = 0;
  std::uint32_t vertex_[kMostSides], half_edge_[kMostSides];
  Vec4 x_, y_, way_x_, way_y_;     ///< of corners and of sides
  Vec4 limit_;                     ///< the length of a side times the bound
  PlanePoint at_[kMostSides + 1];  ///< after the last corner comes the first again
  double z_[kMostSides + 1];
};

/// Adds the corners of the intersection of two polygons.
class Overlay {
 public:
  Overlay(const Polygon& a, const Polygon& b, double bound, Candidates& corners)
      : a_(a), b_(b), bound2_(bound * bound), corners_(corners) {
    for (int i = 0; i < a.count(); ++i) of_a_[i] = b.find(a.at(i)), in_b_ |= Set(of_a_[i].out == 0) << i;
    for (int j = 0; j < b.count(); ++j) of_b_[j] = a.find(b.at(j)), rest_ |= Set(of_b_[j].out == 0) << j;
  }

  /// Goes around A. Each of its sides enters B at most once, then leaves it at most once.
  void run() {
    for (int i = 0; i < a_.count(); ++i) {
      const Found &from = of_a_[i], &to = of_a_[a_.next(i)];
      if (from.out == 0) add_corner<0>(a_, b_, i);
      each(from.out & to.in, [&](int j) {
        if (is_parted_by(i, j, b_.next(j))) add_crossing(i, j);
      });
      bool leaves = false;
      each(from.in & to.out, [&](int j) {
        if (is_parted_by(i, b_.next(j), j)) add_crossing(i, j), follow_b(b_.next(j)), leaves = true;
      });
      // Where side i begins on a side of B and leaves it, nothing crosses, and B's corners after that side follow too.
      if (!leaves) each(to.out & ~(from.in | from.out), [&](int j) { follow_b(b_.next(j)); });
    }
    for (int j = 0; rest_ != 0; j = b_.next(j)) follow_b(j);
  }

 private:
  using Found = Polygon::Found;

  /// Whether of two corners of B one is surely inside of side `i` of A, the other outside.
  bool is_parted_by(int i, int inside, int outside) const { return has(of_b_[inside].in & of_b_[outside].out, i); }

  /// Adds the corners of B from `j` on that lie in A and have not come yet.
  void follow_b(int j) {
    for (; has(rest_, j); j = b_.next(j)) {
      rest_ &= ~bit(j);
      const bool is_on_side = of_b_[j].in != a_.every();
      if (!(is_on_side && is_corner_of_a(b_.at(j)))) add_corner<1>(b_, a_, j);
    }
  }
  bool is_corner_of_a(const PlanePoint& place) const {
    bool found = false;
    each(in_b_, [&](int i) { found |= are_near(a_.at(i), place, bound2_); });
    return found;
  }

  /// Adds a corner of body `f` that lies in the other face.
  template <int f>
  void add_corner(const Polygon& own, const Polygon& other, int i) {
    const FeatureId vertex = own.vertex(i);
    const PlanePoint& place = own.at(i);
    const double z = own.z(i), there = other.z_at(place), z_a = f == 0 ? z : there, z_b = f == 0 ? there : z;
    add(place, z_a, z_b, f == 0 ? Names(vertex, other.name()) : Names(other.name(), vertex));
  }
  void add_crossing(int i, int j) {
    const Crossing at = crossing(a_.side(i), b_.side(j), bound2_);
    if (at.meet) add(at.on_a, a_.z_on(i, at.t_a), b_.z_on(j, at.t_b), Names(a_.edge(i), b_.edge(j)));
  }
  void add(const PlanePoint& place, double z_a, double z_b, const Names& names) {
    corners_.add(Border::Left, {{place.x, place.y, z_a}, z_b - z_a, names}, true);
  }

  const Polygon &a_, &b_;
  const double bound2_;
  Candidates& corners_;
  Set in_b_ = 0, rest_ = 0;  ///< the corners of A that lie in B; those of B that lie in A and have not come
  Found of_a_[Polygon::kMostSides], of_b_[Polygon::kMostSides];  ///< where each corner lies, by sides of the other face
};
static_assert(4 * Polygon::kMostSides <= kMostCorners);  // none is left out

}  // namespace

bool clip_four_sides(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                     Candidates& corners) {
  const Polygon of_a(projection.a, a, bound);
  if (of_a.count() == 0) return false;
  const Polygon of_b(projection.b, b, bound);
  if (of_b.count() == 0) return false;
  Overlay(of_a, of_b, bound, corners).run();
  return true;
}

}  // namespace swiftlet
