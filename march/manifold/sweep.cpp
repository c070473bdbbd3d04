// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The intersection of two polygons by a sweep line [Shamos & Hoey 1976], which moves from below to above and stops at each
// corner. A face lies between a left and a right border. At each height the left border of the intersection is that of the face
// whose left border is farther to the right, and its right border that of the face whose right border is farther to the left;
// `leader_` names the face. The half-edges are read where they lie; only four sides are known at a time.
//
//           b2            The sweep begins at b0, the higher of the lowest corners, which lies in A: both of B's borders lead.
//          /  \           At a3 nothing changes, since A's left border is outside of B's. The line reaches a2, the top of A,
//        b3    b1         on the side a3 a2 of A's left border, which lies beyond B's right border: the intersection has
//   a3-----x--y-----a2    ended, and A's left border has crossed B's left one in x and B's right one in y.
//    |      \/       |
//    |      b0       |
//   a0--------------a1
//
// A border passes on the lead only where the other face's border is farther inside by more than a bound, so that sides that lie
// on one another up to rounding do not cross. The order of the corners from below is exact for their rounded coordinates.
//
// Compiled for the registers that every processor of the target has, and for AVX2: see width.h.
#include <algorithm>
#include <cmath>
#include <optional>

#include "body/half_edge.h"
#include "manifold/clip.h"
#include "manifold/line.h"

namespace swiftlet {
namespace {

/// A corner as its border sees it: x grows outwards, so that both borders are alike.
struct Corner {
  PlanePoint at;
  std::uint64_t names;  ///< in one word, so that they are stored and loaded together: the vertex, and, above, the half-edge
  std::uint32_t vertex() const { return std::uint32_t(names); }
  /// Of the border, and ends there; of a rim either half-edge of that edge.
  std::uint32_t half_edge() const { return std::uint32_t(names >> 32); }
};

/// A side of a border, from its lower to its upper end, or a chord that cuts off corners which turn inwards. What lies to its
/// right is outside.
struct Side : Line {
  std::uint64_t from_names, to_names;  ///< of both corners
  bool is_chord;
};

/// One of the two borders of a contact face as a projection shows it, from its lowest corner to its highest.
class SeenBorder {
 public:
  /// Begins at the origin of `half_edge`, a side of the face, or at the only vertex of a body without sides.
  /// `is_left`: that, and all half-edges of the border, have the face on their left.
  SeenBorder(const SeenBody& body, const ContactFace& face, Border border, std::uint32_t half_edge, bool is_left, double bound)
      : body_(body),
        face_(face),
        half_edges_(body.view.half_edges.data()),
        vertices_(body.view.vertices.data()),
        outwards_(border == Border::Left ? -1 : 1),
        bound_(bound),
        flatness_(face.flatness()),
        is_left_(is_left),
        x_{body.x.x * outwards_, body.y.x},
        y_{body.x.y * outwards_, body.y.y},
        z_{body.x.z * outwards_, body.y.z},
        shift_{body.shift.x * outwards_, body.shift.y} {
    const bool is_point = half_edge == kNone;
    begin_at(is_point ? corner(0, kNone) : end_of(twin(half_edge)));
    if (!is_point) see(end_of(half_edge));
  }

  const SeenBody& body() const { return body_; }
  const Side& side() const { return side_; }
  double flatness() const { return flatness_; }
  Corner start() const { return {side_.from, side_.from_names}; }
  Corner end() const { return {side_.to, side_.to_names}; }
  /// The way to the corner after the side; has no meaning where both borders have met.
  const Way& ahead() const { return ahead_; }
  /// A place of the projection as the border sees it, and back.
  PlanePoint seen(const PlanePoint& place) const { return {place.x * outwards_, place.y}; }
  /// The coordinate along the normal of a vertex, and of a place on the side.
  double z(std::uint32_t vertex) const { return body_.z(vertex); }
  /// How the coordinate along the normal changes with x and y in the face's plane.
  PlanePoint slope() const {
    const Vec& m = face_.normal();
    return PlanePoint{dot(body_.x, m), dot(body_.y, m)} * (-1 / dot(body_.n, m));
  }
  double z_at(double t) const {
    const Vec2 z = body_.z(start().vertex(), end().vertex());
    return z[0] + (z[1] - z[0]) * t;
  }

  /// Moves on to the next side of the face's convex hull, up to vertex `top`.
  [[gnu::always_inline]] void advance(std::uint32_t top) {
    side_.from = side_.to, side_.from_names = side_.to_names, side_.is_chord = false;
    side_.to = next_.at, side_.to_names = next_.names, side_.way = ahead_;
    if (side_.to_names == convex_to_) convex_to_ = kNowhere;
    if (end().vertex() == top) return;
    see(after(end()));
    if (!rises_in(ahead_)) [[unlikely]]
      straighten(top);
  }

  /// Moves on to the side that ends above a place of the projection. Returns false if vertex `top`, the border's end, is below
  /// it.
  [[gnu::noinline]] bool rise_above(const PlanePoint& place, std::uint32_t top) {
    if (face_.is_rim()) leap_below(place.y - 2 * flatness_, top);
    for (; !is_below(place, seen(end().at)); advance(top)) {
      if (end().vertex() == top) return false;
    }
    return true;
  }

  /// Names the edge at a place of the side; of a chord, the edge that it cuts off there.
  FeatureId edge_at(const PlanePoint& place) const {
    std::uint32_t back = back_from(end());
    while (side_.is_chord) {
      const Corner from = end_of(back);
      if (from.vertex() == start().vertex() || dot(place - from.at, side_.way) >= 0) break;
      back = onward(back, !is_left_);
    }
    return {FeatureKind::Edge, std::min(back, twin(back))};
  }

 private:
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

  std::uint32_t twin(std::uint32_t half_edge) const { return half_edges_[half_edge].twin; }
  Corner corner(std::uint64_t names) const {
    const Vertex& v = vertices_[std::uint32_t(names)];
    return {place(x_ * v.x + y_ * v.y + z_ * v.z + shift_), names};
  }
  Corner corner(std::uint32_t vertex, std::uint32_t half_edge) const { return corner(vertex | std::uint64_t(half_edge) << 32); }
  Corner end_of(std::uint32_t half_edge) const { return corner(half_edges_[half_edge].head, half_edge); }
  std::uint32_t onward(std::uint32_t h, bool is_left) const { return is_left ? face_.onward<true>(h) : face_.onward<false>(h); }
  /// The corner after this one, of which a rim reads the vertex alone.
  Corner after(const Corner& corner) const {
    if (!face_.is_rim()) return end_of(onward(corner.half_edge(), is_left_));
    const std::uint32_t here = corner.vertex(), next = on(here, 1);
    return this->corner(next, vertices_[is_left_ ? here : next].ring_begin);
  }
  /// The half-edge along the border from a corner to the one before.
  std::uint32_t back_from(const Corner& corner) const {
    const std::uint32_t h = corner.half_edge();
    return half_edges_[h].head == corner.vertex() ? twin(h) : h;
  }
  /// Of a rim: the corner so many after vertex `v`.
  std::uint32_t on(std::uint32_t v, std::uint32_t count) const {
    return face_.corner(v, is_left_ ? count : face_.corner_count() - count);
  }

  /// Stands at a corner, as if a side without length ended there.
  void begin_at(const Corner& corner) { side_ = {{corner.at, corner.at, {{0, 0}, 0}}, corner.names, corner.names, false}; }
  /// Knows the corner after the side.
  void see(const Corner& corner) {
    next_ = corner;
    ahead_ = way(side_.to, next_.at);
  }

  /// Of a rim: moves on to a side that ends no higher than `y` and rises, so that all before it do, mostly the last such side.
  /// Beyond the highest corner, which may come before `top`, sides fall or rise by the flatness at most.
  void leap_below(double y, std::uint32_t top) {
    const std::uint32_t here = end().vertex();
    const auto place_on = [&](std::uint32_t count) { return corner(on(here, count), kNone).at; };
    std::uint32_t low = 0, high = is_left_ ? face_.count(here, top) : face_.count(top, here);
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      const double height = place_on(middle).y;
      (height <= y && height - place_on(middle - 1).y > 2 * flatness_ ? low : high) = middle;
    }
    if (low < 2) return;
    begin_at(after(corner(on(here, low - 2), kNone)));
    see(after(end()));
    advance(top);
  }

  bool falls() const { return side_.way.y < -bound_; }
  /// Whether a way from the end of the side leads inwards, by more than the flatness: mostly the short test of a side that
  /// rises says so.
  bool rises_in(const PlanePoint& way) const { return cross(side_.way, way) > flatness_ * side_.way.most && side_.way.y > 0; }
  bool turns_in(const PlanePoint& way) const {
    const double out = cross(way, side_.way);
    return rises_in(way) || (out < 0 && out * out > flatness_ * flatness_ * side_.length2() && !falls());
  }
  /// Replaces the side by a chord as long as corners ahead lie beyond it.
  [[gnu::noinline]] void straighten(std::uint32_t top) {
    while (!turns_in(ahead_) && extend(top) && end().vertex() != top) see(after(end()));
  }
  /// A border of merged facets may turn inwards by up to the face's flatness: corners are looked at until one lies farther
  /// inside of the side than that. If one lies beyond, the side becomes a chord to it, and true is returned. A border that is
  /// jagged by more is followed to the next corner that is no lower.
  bool extend(std::uint32_t top) {
    if (is_convex(top)) return false;
    for (Corner corner = next_;; corner = after(corner)) {
      const double out = side_.beyond(corner.at);
      if (falls() || (out > 0 && out * out > 0.25 * bound_ * bound_ * side_.length2())) {
        side_.to = corner.at, side_.to_names = corner.names, side_.way = way(side_.from, corner.at);
        convex_to_ = kNowhere;
        return side_.is_chord = true;
      }
      if (turns_in(corner.at - side_.to) || corner.vertex() == top) return false;
    }
  }

  /// Whether none of the corners that `extend` would look at can lie beyond the side: whether the border surely turns inwards
  /// at all of them, in all by less than half a turn. What was found for the side before is true of this one, so that each
  /// corner is looked at once.
  bool is_convex(std::uint32_t top) {
    if (falls()) return false;
    const auto turns = [](const Way& way, const Way& before) {
      return cross(way, before) < -kCornerError * way.most * before.most;
    };
    if (convex_to_ == kNowhere && turns(ahead_, side_.way)) convex_to_ = next_.names;
    if (convex_to_ == kNowhere) return false;
    Corner corner = this->corner(convex_to_);
    for (Way on = way(end_of(back_from(corner)).at, corner.at); !turns_in(corner.at - side_.to) && corner.vertex() != top;) {
      const Corner next = after(corner);
      const Way before = on;
      on = way(corner.at, next.at);
      if (!turns(on, before) || !turns(on, side_.way)) return false;
      convex_to_ = next.names, corner = next;
    }
    return true;
  }

  const SeenBody& body_;
  const ContactFace& face_;
  const HalfEdge* const half_edges_;
  const Vertex* const vertices_;
  const double outwards_, bound_, flatness_;
  const bool is_left_;                  ///< half-edges that point upwards have the face on their left
  std::uint64_t convex_to_ = kNowhere;  ///< names the corner ahead up to which the border surely is convex, if known
  const Vec2 x_, y_, z_, shift_;        ///< where the projection has the body's axes and its origin
  Side side_;                           ///< at the height of the sweep line
  Corner next_;                         ///< the corner after it
  Way ahead_;                           ///< the way there
};

/// The vertices, modulo 64, of a vertex or an edge that the body has, else none.
std::uint64_t vertex_bits(const ConvexView& view, FeatureId feature) {
  if (!names_feature(view, feature) || feature.kind() == FeatureKind::Face) return 0;
  const auto bit = [](std::uint32_t vertex) { return std::uint64_t(1) << vertex % 64; };
  if (feature.kind() == FeatureKind::Vertex) return bit(feature.index());
  return bit(view.half_edges[feature.index()].head) | bit(origin(view, feature.index()));
}

/// Of a rim: the corner to which its border surely falls from this one at every side on the way, mostly one beside the lowest.
std::uint32_t corner_below(const SeenBody& body, const ContactFace& face, std::uint32_t corner) {
  const std::uint32_t count = face.corner_count();
  const double height = body.at(corner).y;
  for (const bool onwards : {true, false}) {
    const auto there = [&](std::uint32_t on) { return face.corner(corner, onwards ? on : count - on); };
    const auto falls = [&](std::uint32_t on) {
      const double y = body.at(there(on)).y;
      return y < height && body.at(there(on - 1)).y - y > 2 * face.flatness();
    };
    if (!falls(1)) continue;
    std::uint32_t low = 1;
    for (std::uint32_t high = count; high - low > 1;) {
      const std::uint32_t middle = low + (high - low) / 2;
      (falls(middle) ? low : high) = middle;
    }
    return there(low);
  }
  return corner;
}

/// The half-edges of a face that leave its lowest corner, with the face on their left or right. kNone of a point.
struct LowestSides {
  std::uint32_t left = kNone, right = kNone;
};
/// Looks at corners on both sides until the border has risen by `more`.
LowestSides lowest_sides(const SeenBody& body, const ContactFace& face, double more) {
  std::uint32_t first = face.side();
  if (first == kNone) return {};
  if (face.is_rim()) first = body.view.vertices[corner_below(body, face, origin(body.view, first))].ring_begin;
  const auto end_of = [&](std::uint32_t h) { return body.at(body.view.half_edges[h].head); };
  const auto twin = [&](std::uint32_t h) { return body.view.half_edges[h].twin; };
  const std::uint32_t last = face.onward<false>(twin(first));
  LowestSides sides{first, last};
  PlanePoint lowest = end_of(twin(first));
  const auto is_lower = [&](const PlanePoint& p) { return p.y < lowest.y || (p.y == lowest.y && p.x < lowest.x); };
  for (std::uint32_t h = first;;) {
    const PlanePoint place = end_of(h);
    if (place.y > lowest.y + more) break;
    const std::uint32_t next = face.onward<true>(h);
    if (next == first) break;
    if (is_lower(place)) lowest = place, sides = {next, twin(h)};
    h = next;
  }
  for (std::uint32_t h = last;;) {
    const PlanePoint place = end_of(h);
    if (place.y > lowest.y + more) break;
    const std::uint32_t next = face.onward<false>(h);
    if (is_lower(place)) lowest = place, sides = {twin(h), next};
    if (next == last) break;
    h = next;
  }
  return sides;
}

class Sweep {
 public:
  /// Of each face the borders rise by `more` times its flatness around the corner that counts as the lowest.
  Sweep(const Projection& projection, const ContactFace& a, const ContactFace& b, double more, double bound,
        Candidates& corners)
      : Sweep(projection, a, b, lowest_sides(projection.a, a, more * a.flatness()),
              lowest_sides(projection.b, b, more * b.flatness()), bound, corners) {}

  /// Whether both faces open upwards where the borders begin, as they do at a corner.
  bool begins_at_corners() const { return opens(0) && opens(1); }

  void run() {
    if (!begin()) return;
    for (Ending left = ends_first<Border::Left>(), right = ends_first<Border::Right>();;) {
      if (right.y < left.y || (right.y == left.y && ends_below(at(Border::Right, right.face), at(Border::Left, left.face)))) {
        if (!(right.face == 0 ? step<Border::Right, 0>() : step<Border::Right, 1>())) return;
        right = ends_first<Border::Right>();
      } else {
        if (!(left.face == 0 ? step<Border::Left, 0>() : step<Border::Left, 1>())) return;
        left = ends_first<Border::Left>();
      }
    }
  }

 private:
  Sweep(const Projection& projection, const ContactFace& a, const ContactFace& b, LowestSides from_a, LowestSides from_b,
        double bound, Candidates& corners)
      : Sweep(projection, a, b, from_a, from_b, is_seen_from_above(projection.a, a), is_seen_from_above(projection.b, b), bound,
              corners) {}
  Sweep(const Projection& projection, const ContactFace& a, const ContactFace& b, LowestSides from_a, LowestSides from_b,
        bool above_a, bool above_b, double bound, Candidates& corners)
      : border_{{projection.a, a, Border::Left, above_a ? from_a.right : from_a.left, !above_a, bound},
                {projection.b, b, Border::Left, above_b ? from_b.right : from_b.left, !above_b, bound},
                {projection.a, a, Border::Right, above_a ? from_a.left : from_a.right, above_a, bound},
                {projection.b, b, Border::Right, above_b ? from_b.left : from_b.right, above_b, bound}},
        name_{a.name(), b.name()},
        bound_(bound),
        corners_(corners) {
    for (const Names& names : corners.previous()) {
      known_bits_[0] |= vertex_bits(projection.a.view, names.a());
      known_bits_[1] |= vertex_bits(projection.b.view, names.b());
    }
    if (from_a.left != kNone) advance(Border::Left, 0), advance(Border::Right, 0);
    if (from_b.left != kNone) advance(Border::Left, 1), advance(Border::Right, 1);
  }

  /// Whether the borders of face `f` begin in two directions, at sides that are no chords.
  bool opens(int f) const {
    const SeenBorder &left = at(Border::Left, f), &right = at(Border::Right, f);
    const Way &l = left.side().way, &r = right.side().way;
    return !left.side().is_chord && !right.side().is_chord && r.x * l.y + l.x * r.y >= left.flatness() * max(l.most, r.most);
  }
  /// Whether half-edges around the face run counter-clockwise in the projection.
  static bool is_seen_from_above(const SeenBody& body, const ContactFace& face) {
    return dot(cross(body.x, body.y), face.normal()) >= 0;
  }

  SeenBorder& at(Border border, int f) { return border_[2 * std::size_t(border) + std::size_t(f)]; }
  const SeenBorder& at(Border border, int f) const { return border_[2 * std::size_t(border) + std::size_t(f)]; }
  int& leader(Border border) { return leader_[std::size_t(border)]; }

  /// Both borders of a face end where they meet.
  bool is_at_top(int f) const { return at(Border::Left, f).end().vertex() == at(Border::Right, f).end().vertex(); }
  [[gnu::always_inline]] void advance(Border border, int f) { at(border, f).advance(at(opposite(border), f).end().vertex()); }

  /// Returns true if the side of `p` ends below that of `q`, or at the same height to the left of it.
  static bool ends_below(const SeenBorder& p, const SeenBorder& q) {
    const double y_p = p.end().at.y, y_q = q.end().at.y;
    if (y_p == y_q) [[unlikely]]
      return p.seen(p.end().at).x < q.seen(q.end().at).x;
    return y_p < y_q;
  }
  /// The face whose side ends first on a border, and at which height.
  struct Ending {
    int face;
    double y;
  };
  template <Border border>
  Ending ends_first() const {
    const int face = ends_below(at(border, 1), at(border, 0));
    return {face, min(at(border, 0).end().at.y, at(border, 1).end().at.y)};
  }

  Where where(const PlanePoint& place, Border border, int f) const {
    const SeenBorder& b = at(border, f);
    return swiftlet::where(b.seen(place), b.side(), bound_);
  }

  /// Starts at the higher of the two lowest corners, or at A's if they are one up to the bound, so that of faces which lie on
  /// one another A's always leads. Returns false if the other face ends below it.
  bool begin() {
    const PlanePoint of_a = at(Border::Right, 0).start().at, of_b = at(Border::Right, 1).start().at;
    return is_below(of_a, of_b) && !are_near(of_a, of_b, bound_ * bound_) ? begin<1>() : begin<0>();
  }

  /// The same at the lowest corner of face `f`.
  template <int f>
  bool begin() {
    constexpr int other = 1 - f;
    const Corner lowest = at(Border::Right, f).start();
    if (!rises_above<Border::Left, other>(lowest.at) || !rises_above<Border::Right, other>(lowest.at)) return false;
    if (where(lowest.at, Border::Left, other) == Where::Outside) {
      west_ = f;
    } else if (where(lowest.at, Border::Right, other) == Where::Outside) {
      west_ = other;
    } else {
      leader(Border::Left) = leader(Border::Right) = f;
      add_corner<f>(Border::Left, lowest.at, lowest.vertex());
    }
    return true;
  }

  /// Moves a border on to the side that ends above a place. Returns false if its end is below that.
  template <Border border, int f>
  bool rises_above(const PlanePoint& place) {
    return at(border, f).rise_above(place, at(opposite(border), f).end().vertex());
  }

  /// Handles the upper end of a side and moves on. Returns false at the end of the intersection.
  template <Border border, int f>
  bool step() {
    if (!meet<border, f>()) return false;
    if (is_at_top(f)) return end<border, f>(), false;
    if (leader(border) == f) pass<border, f>();
    advance(border, f);
    return true;
  }

  /// Handles the upper end of a side of face `f`. Returns false if the intersection ends at or below it.
  template <Border border, int f>
  bool meet() {
    if (leader(border) == kNobody && !overlap_begins(border, f)) return true;
    constexpr int other = 1 - f;
    constexpr Border across = opposite(border);
    const PlanePoint& place = at(border, f).side().to;
    const bool leads = leader(border) == f, passes = passes_lead(place, at(border, other).side(), leads);
    // A corner beyond the other face's border across is inside of the one here: it leads from here on.
    if (leads != passes && is_across(place, at(across, other).side())) {
      if (leader(border) != f) add_crossing<border, border>(border);
      if (leader(across) != other) add_crossing<across, across>(across);
      add_crossing<f == 0 ? border : across, f == 0 ? across : border>(border);
      return false;
    }
    if (passes) turn_off<border>(leads ? other : f);
    return true;
  }

  /// Returns true where a border's corner lies outside of the other face's side and led, or inside and did not.
  bool passes_lead(const PlanePoint& place, const Side& side, bool leads) const {
    const double area = side.beyond(place);
    if ((leads ? -area : area) > bound_ * side.way.most) [[likely]]
      return false;
    return swiftlet::where(place, side, bound_) == (leads ? Where::Outside : Where::Inside);
  }

  /// Returns true if a place of one border lies outside of a side of the other, which sees it mirrored.
  bool is_across(const PlanePoint& place, const Side& side) const {
    return place.x + min(side.from.x, side.to.x) <= bound_ &&
           swiftlet::where({-place.x, place.y}, side, bound_) == Where::Outside;
  }

  /// Returns true if face `west_` no longer lies to the left of the other one at the height of this corner.
  bool overlap_begins(Border border, int f) {
    const SeenBorder& own = at(border, f);
    if (where(own.seen(own.end().at), f == west_ ? Border::Left : Border::Right, 1 - f) == Where::Outside) return false;
    if (west_ == 0)
      add_crossing<Border::Right, Border::Left>(Border::Left);
    else
      add_crossing<Border::Left, Border::Right>(Border::Left);
    leader(Border::Left) = 1 - west_, leader(Border::Right) = west_;
    return true;
  }

  /// Handles the top of face `f`, which `border` has reached; the other border reaches it too.
  template <Border border, int f>
  void end() {
    const SeenBorder& own = at(border, f);
    const PlanePoint top = own.seen(own.end().at);
    if (!meet<opposite(border), f>() || leader(border) == kNobody) return;
    for (const Border b : kBorders) {
      if (where(top, b, 1 - f) == Where::Outside) return;
    }
    add_corner<f>(border, top, own.end().vertex());
  }

  /// Passes the upper end of a side of face `f`, which leads the border. Of many corners only few are worth their names and
  /// depths.
  template <Border border, int f>
  void pass() {
    const SeenBorder& own = at(border, f);
    const std::uint32_t vertex = own.end().vertex();
    const bool wanted = corners_.wants(border, own.side().to, own.ahead(), [&] { return rise(own, own.ahead()); });
    if (wanted || may_know(f, vertex)) add_corner<f>(border, own.seen(own.side().to), vertex, wanted);
  }

  /// Passes the lead on a border to face `f` where its side crosses the one that led.
  template <Border border>
  void turn_off(int f) {
    leader(border) = f;
    const SeenBorder &from = at(border, 1 - f), &to = at(border, f);
    const bool wanted =
        corners_.wants(border, from.side().from, from.side().to, to.side().to, [&] { return rise(to, to.side().way); });
    if (wanted || (may_know(f, to) && may_know(1 - f, from))) add_crossing<border, border>(border, wanted);
  }

  /// How much the separation rises along a way that a border sees.
  [[gnu::noinline]] double rise(const SeenBorder& border, const PlanePoint& way) {
    if (!slope_) slope_ = at(Border::Left, 1).slope() - at(Border::Left, 0).slope();
    return dot(*slope_, border.seen(way));
  }
  /// False if the manifold before surely names neither this vertex of a body nor an edge that ends there.
  bool may_know(int f, std::uint32_t vertex) const { return known_bits_[f] >> (vertex % 64) & 1; }
  /// False if it surely names no point of this side.
  bool may_know(int f, const SeenBorder& border) const {
    return border.side().is_chord || (may_know(f, border.start().vertex()) && may_know(f, border.end().vertex()));
  }

  /// Adds a corner of face `f` that lies within the other face.
  template <int f>
  [[gnu::noinline]] void add_corner(Border border, const PlanePoint& place, std::uint32_t v, bool wanted = true) {
    const FeatureId vertex{FeatureKind::Vertex, v};
    const Names names(f == 0 ? vertex : name_[0], f == 0 ? name_[1] : vertex);
    if (!corners_.takes(names, wanted)) return;
    const double depth = depth_at<1 - f>(place), z = at(Border::Left, f).z(v), z_a = f == 0 ? z : depth,
                 z_b = f == 0 ? depth : z;
    corners_.add(border, {{place.x, place.y, z_a}, z_b - z_a, names}, wanted);
  }

  /// The coordinate along the normal at a place of a face.
  template <int f>
  double depth_at(const PlanePoint& place) const {
    const SeenBorder &left = at(Border::Left, f), &right = at(Border::Right, f);
    return depth_between(left.side(), right.side(), left.body().z(left.start().vertex(), right.start().vertex()),
                         left.body().z(left.end().vertex(), right.end().vertex()), place);
  }

  /// Adds the point where two sides cross, of these borders of A and B, or a corner of either within the bound of it.
  template <Border on_a, Border on_b>
  [[gnu::noinline]] void add_crossing(Border border, bool wanted = true) {
    const SeenBorder &of_a = at(on_a, 0), &of_b = at(on_b, 1);
    // All is seen as A's border sees it.
    const auto by_other = [](const PlanePoint& place) { return PlanePoint{on_a == on_b ? place.x : -place.x, place.y}; };
    const Line &a = of_a.side(), b{by_other(of_b.side().from), by_other(of_b.side().to), {by_other(of_b.side().way), 0}};
    const double bound2 = bound_ * bound_;
    const Crossing at = crossing(a, b, bound2);
    if (are_near(a.from, at.on_a, bound2)) return add_corner<0>(border, of_a.seen(a.from), of_a.start().vertex(), wanted);
    if (are_near(a.to, at.on_a, bound2)) return add_corner<0>(border, of_a.seen(a.to), of_a.end().vertex(), wanted);
    if (are_near(b.from, at.on_a, bound2)) return add_corner<1>(border, of_a.seen(b.from), of_b.start().vertex(), wanted);
    if (are_near(b.to, at.on_a, bound2)) return add_corner<1>(border, of_a.seen(b.to), of_b.end().vertex(), wanted);
    // A corner within the bound of a side may be farther than that from where the sides cross.
    if (!at.meet) return;
    const Names names(of_a.edge_at(at.on_a), of_b.edge_at(by_other(at.on_b)));
    if (!corners_.takes(names, wanted)) return;
    const double z_a = of_a.z_at(at.t_a), z_b = of_b.z_at(at.t_b);
    corners_.add(border, {{of_a.seen(at.on_a).x, at.on_a.y, z_a}, z_b - z_a, names}, wanted);
  }

  static constexpr int kNobody = -1;

  SeenBorder border_[4];
  const FeatureId name_[2];
  const double bound_;
  std::optional<PlanePoint> slope_;  ///< how the separation changes with x and y, once that is asked for
  Candidates& corners_;
  /// Per body, the vertices that the manifold before names, alone or by an edge, modulo 64.
  std::uint64_t known_bits_[2] = {};
  /// Per border, the face whose border bounds the intersection; `kNobody` before that begins.
  int leader_[2] = {kNobody, kNobody};
  int west_ = 0;  ///< before it begins: the face to the left of the other one
};

}  // namespace

/// The border of merged facets may turn inwards by the flatness: where it has risen by twice as much, it mostly goes on rising.
/// But corners that lie in a row up to rounding may follow one another to and fro: where both borders begin in one direction,
/// or at a chord, a lower corner may be hidden, and all corners are looked at.
void SWIFTLET_OF_WIDTH(clip)(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound,
                             Candidates& corners) {
  for (const double more : {2.0, kInfinity}) {
    Sweep sweep(projection, a, b, more, bound, corners);
    if (std::isinf(more) || sweep.begins_at_corners()) return sweep.run();
  }
}

}  // namespace swiftlet
