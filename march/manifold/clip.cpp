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
#include "manifold/clip.h"

#include <cmath>
#include <utility>

#include "body/half_edge.h"

namespace swiftlet {
namespace {

constexpr Border kBorders[] = {Border::Left, Border::Right};
Border opposite(Border border) { return border == Border::Left ? Border::Right : Border::Left; }

/// Returns true if `p` lies below `q`, or at the same height to the left of it.
bool is_below(const Place& p, const Place& q) { return p.y < q.y || (p.y == q.y && p.x < q.x); }

struct Corner {
  Place at;
  std::uint32_t vertex;
};

/// A side of a border, or a chord that cuts off corners which turn inwards.
struct Side {
  Corner from, to;  ///< the lower and the upper end
  Place way;        ///< from one to the other
  double length2;
  std::uint32_t half_edge;  ///< the half-edge that ends at `to`; of a chord the last one that it cuts off
  bool is_chord;

  Place at(double t) const { return from.at + way * t; }
  /// The parameter, 0 at `from` and 1 at `to`, of the point at height `y`.
  double rise(double y) const { return way.y > 0 ? min(max((y - from.at.y) / way.y, 0), 1) : 0; }
  /// The parameter of the point nearest to `place`.
  double along(const Place& place) const {
    const double t = dot(place - from.at, way);
    return length2 > 0 && t > 0 ? min(t / length2, 1) : 0;
  }
};

/// On which side of a border's side a place lies whose height is between those of its ends.
enum class Where { Left, On, Right };
Where where(const Place& place, const Side& side, double bound) {
  const Place p = place - side.from.at;
  const double area = cross(side.way, p);
  if (area * area > bound * bound * side.length2) return area > 0 ? Where::Left : Where::Right;
  // The line is within the bound; the side itself may not be, if it is nearly horizontal.
  const double dx = side.way.x;
  if (p.x < min(dx, 0) - bound) return side.length2 - dx * dx > dx * dx ? Where::On : Where::Left;
  if (p.x > max(dx, 0) + bound) return side.length2 - dx * dx > dx * dx ? Where::On : Where::Right;
  return Where::On;
}

/// A contact face as a projection shows it, from its lowest corner to its highest.
class SeenFace {
 public:
  SeenFace(const SeenBody& body, const ContactFace& face, double bound)
      : body_(body), face_(face), bound_(bound), is_ccw_(dot(cross(body.x, body.y), face.normal()) >= 0) {
    const bool is_point = face.side() == kNone;
    const std::uint32_t below = is_point ? kNone : lowest_side();
    const Corner lowest = is_point ? Corner{body.at(0), 0} : start_of(below);
    for (Chain& chain : chain_) chain.side = {lowest, lowest, {0, 0}, 0, below, false};
    for (const Border border : kBorders) {
      Chain& chain = chain_[std::size_t(border)];
      if (is_point) continue;
      chain.half_edge = is_left(border) ? below : face_.onward(twin(below), false);
      chain.next = end_of(chain.half_edge);
      advance(border);
    }
  }

  /// Where both borders begin, as long as neither has gone on from its first side.
  const Corner& lowest() const { return chain_[0].side.from; }
  const Side& operator[](Border border) const { return chain_[std::size_t(border)].side; }
  /// The borders end where they meet.
  bool is_at_top(Border border) const { return (*this)[border].to.vertex == (*this)[opposite(border)].to.vertex; }
  /// The corner after the side of a border that is not at the top.
  const Corner& next(Border border) const { return chain_[std::size_t(border)].next; }

  /// Moves a border on to the next side of its convex hull; must not be called at the top.
  void advance(Border border) {
    Chain& chain = chain_[std::size_t(border)];
    Side& side = chain.side;
    const std::uint32_t top = (*this)[opposite(border)].to.vertex;
    side.from = side.to, side.is_chord = false;
    lead(side, chain.next, chain.half_edge);
    do {
      if (side.to.vertex == top) return;
      chain.half_edge = face_.onward(side.half_edge, is_left(border));
      chain.next = end_of(chain.half_edge);
    } while (!turns_in(side, border, chain.next) && extend(side, border, chain.half_edge, top));
  }

  /// The coordinate along the normal at a place: interpolated between the borders, or that of the nearer border outside.
  double depth_at(const Place& place) const {
    const Side &left = chain_[0].side, &right = chain_[1].side;
    const double t_left = left.rise(place.y), t_right = right.rise(place.y), x_left = left.at(t_left).x,
                 x_right = right.at(t_right).x;
    if (x_left < place.x && place.x < x_right) {
      const double z = z_at(left, t_left);
      return z + (z_at(right, t_right) - z) * ((place.x - x_left) / (x_right - x_left));
    }
    const Side& side = place.x <= x_left ? left : right;
    return z_at(side, side.along(place));
  }
  double z_at(const Side& side, double t) const {
    const double z = body_.z(side.from.vertex);
    return z + (body_.z(side.to.vertex) - z) * t;
  }
  double z(std::uint32_t vertex) const { return body_.z(vertex); }

  /// Names the edge of a side that is no chord.
  FeatureId edge(Border border) const { return named(body_.view, {FeatureKind::Edge, (*this)[border].half_edge}); }
  /// Names the edge at a place of a side; of a chord, the edge that it cuts off there.
  FeatureId edge_at(Border border, const Place& place) const {
    const Side& side = (*this)[border];
    std::uint32_t back = twin(side.half_edge);
    while (side.is_chord) {
      const Corner from = end_of(back);
      if (from.vertex == side.from.vertex || dot(place - from.at, side.way) >= 0) break;
      back = face_.onward(back, !is_left(border));
    }
    return named(body_.view, {FeatureKind::Edge, back});
  }

 private:
  struct Chain {
    Side side;                ///< at the height of the sweep line
    Corner next;              ///< the corner after it
    std::uint32_t half_edge;  ///< the half-edge that ends there
  };

  std::uint32_t twin(std::uint32_t half_edge) const { return body_.view.half_edges[half_edge].twin; }
  Corner end_of(std::uint32_t half_edge) const {
    const std::uint32_t vertex = body_.view.half_edges[half_edge].head;
    return {body_.at(vertex), vertex};
  }
  Corner start_of(std::uint32_t half_edge) const { return end_of(twin(half_edge)); }
  /// Returns true if half-edges that point upwards along the border have the face on their left.
  bool is_left(Border border) const { return is_ccw_ == (border == Border::Right); }

  /// The half-edge of the border that leaves its lowest corner: where the border rises on both sides, by more than the border of
  /// merged facets may turn inwards.
  std::uint32_t lowest_side() const {
    const std::uint32_t first = face_.side();
    std::uint32_t side = first;
    Place lowest = start_of(first).at;
    const double more = 2 * face_.flatness();
    for (std::uint32_t h = first;;) {
      const Place place = end_of(h).at;
      h = face_.onward(h, true);
      if (place.y > lowest.y + more || h == first) break;
      if (is_below(place, lowest)) lowest = place, side = h;
    }
    const std::uint32_t last = face_.onward(twin(first), false);
    for (std::uint32_t h = last;;) {
      const Place place = end_of(h).at;
      if (place.y > lowest.y + more) break;
      if (is_below(place, lowest)) lowest = place, side = twin(h);
      h = face_.onward(h, false);
      if (h == last) break;
    }
    return side;
  }

  static void lead(Side& side, const Corner& to, std::uint32_t half_edge) {
    side.to = to, side.half_edge = half_edge;
    side.way = to.at - side.from.at;
    side.length2 = dot(side.way, side.way);
  }
  bool falls(const Side& side) const { return side.way.y < -bound_; }
  /// Twice the area of a side and a corner, positive where that lies beyond the side.
  static double beyond(const Side& side, Border border, const Corner& corner) {
    const double area = cross(side.way, corner.at - side.from.at);
    return border == Border::Left ? area : -area;
  }
  bool turns_in(const Side& side, Border border, const Corner& next) const {
    const double out = beyond(side, border, next);
    return out < 0 && out * out > face_.flatness() * face_.flatness() * side.length2 && !falls(side);
  }
  /// A border of merged facets may turn inwards by up to the face's flatness: corners are looked at until one lies farther inside
  /// of the side than that. If one lies beyond, the side becomes a chord to it, and true is returned. A border that is jagged by
  /// more is followed to the next corner that is no lower. `h` ends at the corner after the side.
  bool extend(Side& side, Border border, std::uint32_t h, std::uint32_t top) const {
    for (;; h = face_.onward(h, is_left(border))) {
      const Corner corner = end_of(h);
      const double out = beyond(side, border, corner);
      if (falls(side) || (out > 0 && out * out > 0.25 * bound_ * bound_ * side.length2)) {
        lead(side, corner, h);
        return side.is_chord = true;
      }
      if (turns_in(side, border, corner) || corner.vertex == top) return false;
    }
  }

  const SeenBody& body_;
  const ContactFace& face_;
  const double bound_;
  const bool is_ccw_;  ///< the border's sense in the projection, where B is seen from inside unless the pose mirrors it
  Chain chain_[2];     ///< the left and the right border
};

class Sweep {
 public:
  Sweep(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound, Candidates& corners)
      : face_{SeenFace(projection.a, a, bound), SeenFace(projection.b, b, bound)},
        name_{a.name(), b.name()},
        bound_(bound),
        slope_(slope(projection.b, b) - slope(projection.a, a)),
        corners_(corners) {}

  void run() {
    if (!begin()) return;
    for (;;) {
      const auto [f, border] = lowest_event();
      if (!meet(f, border)) return;
      if (face_[f].is_at_top(border)) return end(f, border);
      face_[f].advance(border);
    }
  }

 private:
  struct Event {
    int face;
    Border border;
  };

  const Side& side(int f, Border border) const { return face_[f][border]; }
  int& leader(Border border) { return leader_[std::size_t(border)]; }

  /// How the height of a face's plane along the normal changes with x and y.
  static Place slope(const SeenBody& seen, const ContactFace& face) {
    const Vec& m = face.normal();
    return Place{dot(seen.x, m), dot(seen.y, m)} * (-1 / dot(seen.n, m));
  }

  /// Starts at the higher of the two lowest corners. Returns false if the other face ends below it.
  bool begin() {
    const int f = is_below(face_[0].lowest().at, face_[1].lowest().at) ? 1 : 0, other = 1 - f;
    const Corner& lowest = face_[f].lowest();
    for (const Border border : kBorders) {
      while (!is_below(lowest.at, side(other, border).to.at)) {
        if (face_[other].is_at_top(border)) return false;
        face_[other].advance(border);
      }
    }
    if (where(lowest.at, side(other, Border::Left), bound_) == Where::Left) {
      west_ = f;
    } else if (where(lowest.at, side(other, Border::Right), bound_) == Where::Right) {
      west_ = other;
    } else {
      leader(Border::Left) = leader(Border::Right) = f;
      add_corner(Border::Left, f, lowest);
    }
    return true;
  }

  Event lowest_event() const {
    Event lowest{0, Border::Left};
    for (const Event e : {Event{0, Border::Right}, Event{1, Border::Left}, Event{1, Border::Right}}) {
      if (is_below(side(e.face, e.border).to.at, side(lowest.face, lowest.border).to.at)) lowest = e;
    }
    return lowest;
  }

  /// Handles the upper end of a side of face `f`. Returns false if the intersection ends at or below it.
  bool meet(int f, Border border) {
    const Corner& corner = side(f, border).to;
    const int other = 1 - f;
    if (west_ != kNobody && !overlap_begins(f, corner)) return true;

    const Border across = opposite(border);
    if (where(corner.at, side(other, across), bound_) == outside(across)) {
      if (leader(border) != f) add_crossing(border, {f, border}, {other, border});
      if (leader(across) != other) add_crossing(across, {f, across}, {other, across});
      add_crossing(border, {f, border}, {other, across});
      return false;
    }
    const Where now = where(corner.at, side(other, border), bound_);
    const int next = leader(border) == f && now == outside(border)      ? other
                     : leader(border) == other && now == outside(across) ? f
                                                                         : leader(border);
    if (next != leader(border)) turn_off(border, next);
    if (next == f) pass(border, f);
    return true;
  }

  /// Returns true if face `west_` no longer lies to the left of the other one at the height of `corner`.
  bool overlap_begins(int f, const Corner& corner) {
    const int east = 1 - west_;
    const Where now =
        f == west_ ? where(corner.at, side(east, Border::Left), bound_) : where(corner.at, side(west_, Border::Right), bound_);
    if (now == (f == west_ ? Where::Left : Where::Right)) return false;
    add_crossing(Border::Left, {west_, Border::Right}, {east, Border::Left});
    leader(Border::Left) = east, leader(Border::Right) = west_;
    west_ = kNobody;
    return true;
  }

  /// Handles the top of face `f`, which `border` has reached; the other border reaches it too.
  void end(int f, Border border) {
    const Corner top = side(f, border).to;
    if (!meet(f, opposite(border)) || west_ != kNobody) return;
    for (const Border b : kBorders) {
      if (where(top.at, side(1 - f, b), bound_) == outside(b)) return;
    }
    add_corner(border, f, top);
  }

  /// False if the manifold before surely names no point of this side.
  bool may_know(int f, Border border) const {
    return side(f, border).is_chord || corners_.may_know(f, face_[f].edge(border).index());
  }

  static Where outside(Border border) { return border == Border::Left ? Where::Left : Where::Right; }

  /// Passes the upper end of a side of face `f`, which leads the border. Of many corners only few are worth their names and
  /// depths.
  void pass(Border border, int f) {
    const Side& s = side(f, border);
    if (face_[f].is_at_top(border)) return add_corner(border, f, s.to);
    const Place& next = face_[f].next(border).at;
    const bool wanted = corners_.wants(border, s.to.at, next, dot(next - s.to.at, slope_));
    if (wanted || corners_.may_know(f, s.to.vertex)) add_corner(border, f, s.to, wanted);
  }

  /// Passes the lead on a border to face `f` where its side crosses the one that led.
  void turn_off(Border border, int f) {
    leader(border) = f;
    const Side &from = side(1 - f, border), &to = side(f, border);
    const bool wanted = corners_.wants(border, from.from.at, from.to.at, to.to.at, dot(to.way, slope_));
    if (wanted || (may_know(f, border) && may_know(1 - f, border)))
      add_crossing(border, {0, border}, {1, border}, wanted);
  }

  /// Adds a corner of face `f` that lies within the other face.
  void add_corner(Border border, int f, const Corner& corner, bool wanted = true) {
    const double depth = face_[1 - f].depth_at(corner.at), z = face_[f].z(corner.vertex), z_a = f == 0 ? z : depth,
                 z_b = f == 0 ? depth : z;
    const FeatureId vertex{FeatureKind::Vertex, corner.vertex};
    corners_.add(border, {{corner.at.x, corner.at.y, z_a}, z_b - z_a, f == 0 ? vertex : name_[0], f == 0 ? name_[1] : vertex},
                 wanted);
  }

  /// Adds the point where two sides cross, one of each face, or a corner of either within the bound of it.
  void add_crossing(Border border, Event p, Event q, bool wanted = true) {
    if (p.face == 1) std::swap(p, q);
    const Side &a = side(0, p.border), &b = side(1, q.border);
    const auto height = [&](const Place& place) { return cross(b.way, place - b.from.at); };
    const double h = height(a.from.at), h_to = height(a.to.at);
    // If the sides are nearly parallel, the first point on a is uncertain; the last one is the nearest to that on b.
    const double t_b = b.along(a.at(h != h_to ? min(max(h / (h - h_to), 0), 1) : 0)), t_a = a.along(b.at(t_b));
    const Place on_b = b.at(t_b), on_a = a.at(t_a);
    const auto apart = [&](const Place& place) { return std::sqrt(dot(place - on_a, place - on_a)); };
    for (const Corner* c : {&a.from, &a.to}) {
      if (apart(c->at) <= bound_) return add_corner(border, 0, *c, wanted);
    }
    for (const Corner* c : {&b.from, &b.to}) {
      if (apart(c->at) <= bound_) return add_corner(border, 1, *c, wanted);
    }
    if (apart(on_b) > bound_) return;
    const double z_a = face_[0].z_at(a, t_a);
    corners_.add(border,
                 {{on_a.x, on_a.y, z_a},
                  face_[1].z_at(b, t_b) - z_a,
                  face_[0].edge_at(p.border, on_a),
                  face_[1].edge_at(q.border, on_b)},
                 wanted);
  }

  static constexpr int kNobody = -1;

  SeenFace face_[2];
  const FeatureId name_[2];
  const double bound_;
  const Place slope_;  ///< how the separation changes with x and y
  Candidates& corners_;
  int west_ = kNobody;  ///< before the intersection begins: the face to the left of the other one
  int leader_[2] = {};  ///< per border, the face whose border bounds the intersection
};

}  // namespace

/// The axes are the basis of [Duff et al. 2017], which is right to rounding for every n, turned about n.
Projection::Projection(const PairView& pair, const Vec& n, const Vec& about, const Vec& side)
    : a{pair.a, {}, {}, n, {}}, b{pair.b, {}, {}, {}, {}}, middle(about) {
  const double sign = std::copysign(1.0, n.z), f = -1 / (sign + n.z), g = n.x * n.y * f;
  const Vec u{1 + sign * n.x * n.x * f, sign * g, -sign * n.x}, v{g, sign + n.y * n.y * f, -n.y};
  const double du = dot(u, side), dv = dot(v, side), length = std::sqrt(du * du + dv * dv);
  const double c = length > 0 ? (kSweepCos * du + kSweepSin * dv) / length : 1,
               s = length > 0 ? (kSweepCos * dv - kSweepSin * du) / length : 0;
  a.x = u * c + v * s;
  a.y = v * c - u * s;
  const auto seen = [&](const Vec& p) { return Vec{dot(a.x, p), dot(a.y, p), dot(n, p)}; };
  const Moved moved = body_b(pair);
  a.shift = seen(-middle), b.shift = seen(moved.common({0, 0, 0}) - middle);
  b.x = moved.into(a.x), b.y = moved.into(a.y), b.n = moved.into(n);
}

Vec any_side(const PairView& pair, const ContactFace& a, const ContactFace& b) {
  const auto along = [](const auto& body, std::uint32_t h) {
    return body.point(body.view.half_edges[h].head) - body.point(origin(body.view, h));
  };
  if (a.side() != kNone) return along(body_a(pair), a.side());
  return b.side() != kNone ? along(body_b(pair), b.side()) : Vec{0, 0, 0};
}

void clip(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound, Candidates& corners) {
  Sweep(projection, a, b, bound, corners).run();
  corners.close();
}

}  // namespace swiftlet
