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
bool is_below(const Vec& p, const Vec& q) { return p.y < q.y || (p.y == q.y && p.x < q.x); }

struct Corner {
  Vec at;
  std::uint32_t vertex;
};

/// A side of a border, or a chord that cuts off corners which turn inwards.
struct Side {
  Corner from, to;          ///< the lower and the upper end
  std::uint32_t half_edge;  ///< the half-edge at `to`; of a chord the last one that it cuts off
  bool is_chord = false;

  Vec at(double t) const { return from.at + (to.at - from.at) * t; }
  /// The parameter, 0 at `from` and 1 at `to`, of the point at height `y`.
  double rise(double y) const {
    const double height = to.at.y - from.at.y;
    return height > 0 ? min(max((y - from.at.y) / height, 0), 1) : 0;
  }
  /// The parameter of the point nearest to `place`.
  double along(const Vec& place) const {
    const double dx = to.at.x - from.at.x, dy = to.at.y - from.at.y, length2 = dx * dx + dy * dy,
                 t = (place.x - from.at.x) * dx + (place.y - from.at.y) * dy;
    return length2 > 0 && t > 0 ? min(t / length2, 1) : 0;
  }
};

/// On which side of a border's side a place lies whose height is between those of its ends.
enum class Where { Left, On, Right };
Where where(const Vec& place, const Side& side, double bound) {
  const double dx = side.to.at.x - side.from.at.x, dy = side.to.at.y - side.from.at.y, px = place.x - side.from.at.x,
               py = place.y - side.from.at.y, area = dx * py - dy * px, length2 = dx * dx + dy * dy;
  if (area * area > bound * bound * length2) return area > 0 ? Where::Left : Where::Right;
  // The line is within the bound; the side itself may not be, if it is nearly horizontal.
  if (px < min(dx, 0) - bound) return length2 - dx * dx > dx * dx ? Where::On : Where::Left;
  if (px > max(dx, 0) + bound) return length2 - dx * dx > dx * dx ? Where::On : Where::Right;
  return Where::On;
}

/// A contact face as a projection shows it, from its lowest corner to its highest.
class SeenFace {
 public:
  SeenFace(const SeenBody& body, const ContactFace& face, double bound) : body_(body), face_(face) {
    const Corner first = face.side() == kNone ? Corner{body(0), 0} : corner_before(face.side());
    Corner lowest = first, highest = first, last = first;
    std::uint32_t half_edge = face.side();
    double area = 0;
    for (std::uint32_t h = half_edge; h != kNone && (h = face.next(h)) != face.side();) {
      const Corner c = corner_before(h);
      if (is_below(c.at, lowest.at)) lowest = c, half_edge = h;
      if (is_below(highest.at, c.at)) highest = c;
      area += (last.at.x - first.at.x) * (c.at.y - first.at.y) - (last.at.y - first.at.y) * (c.at.x - first.at.x);
      last = c;
    }
    is_ccw_ = area >= 0;
    top_ = highest.vertex;
    for (const Border border : kBorders) {
      Side& side = side_[std::size_t(border)];
      side = {lowest, lowest, half_edge, false};
      if (is_at_top(border)) continue;
      if (is_ahead(border)) side.half_edge = face.previous(half_edge);
      advance(border, bound);
    }
  }

  /// Where both borders begin, as long as neither has gone on from its first side.
  const Corner& lowest() const { return side_[0].from; }
  const Side& operator[](Border border) const { return side_[std::size_t(border)]; }
  bool is_at_top(Border border) const { return (*this)[border].to.vertex == top_; }

  /// Moves a border on to the next side of its convex hull; must not be called at the top. A border of merged facets may turn
  /// inwards by up to the face's flatness: corners are looked at until one lies farther inside of the side than that. A border
  /// that is jagged by more is followed to the next corner that is no lower.
  void advance(Border border, double bound) {
    Side& side = side_[std::size_t(border)];
    const bool ahead = is_ahead(border);
    side.from = side.to;
    std::uint32_t h = side.half_edge;
    for (bool is_first = true;; is_first = false) {
      h = ahead ? face_.next(h) : face_.previous(h);
      const Corner c = corner_before(ahead ? body_.view.half_edges[h].twin : h);
      const double dx = side.to.at.x - side.from.at.x, dy = side.to.at.y - side.from.at.y,
                   area = dx * (c.at.y - side.from.at.y) - dy * (c.at.x - side.from.at.x),
                   length = std::sqrt(dx * dx + dy * dy), out = border == Border::Left ? area : -area;
      const bool falls = side.to.at.y < side.from.at.y - bound;
      if (is_first || falls || out > 0.5 * bound * length) {
        side.to = c, side.half_edge = h, side.is_chord = !is_first;
      } else if (out < -face_.flatness() * length) {
        return;
      }
      if (c.vertex == top_) return;
    }
  }

  /// The coordinate along the normal at a place: interpolated between the borders, or that of the nearer border outside.
  double depth_at(const Vec& place) const {
    const Side &left = side_[0], &right = side_[1];
    const Vec l = left.at(left.rise(place.y)), r = right.at(right.rise(place.y));
    if (l.x < place.x && place.x < r.x) return l.z + (r.z - l.z) * ((place.x - l.x) / (r.x - l.x));
    const Side& side = place.x <= l.x ? left : right;
    return side.at(side.along(place)).z;
  }

  /// Names the edge at a place of a side; of a chord, the edge that it cuts off there.
  FeatureId edge_at(Border border, const Vec& place) const {
    const Side& side = (*this)[border];
    const Vec along = side.to.at - side.from.at;
    std::uint32_t h = side.half_edge;
    while (side.is_chord) {
      const Corner from = corner_before(is_ahead(border) ? h : body_.view.half_edges[h].twin);
      const Vec beyond = place - from.at;
      if (from.vertex == side.from.vertex || beyond.x * along.x + beyond.y * along.y >= 0) break;
      h = is_ahead(border) ? face_.previous(h) : face_.next(h);
    }
    return named(body_.view, {FeatureKind::Edge, h});
  }

 private:
  /// Returns true if half-edges of the border point upwards.
  bool is_ahead(Border border) const { return is_ccw_ == (border == Border::Right); }
  Corner corner_before(std::uint32_t half_edge) const {
    const std::uint32_t vertex = origin(body_.view, half_edge);
    return {body_(vertex), vertex};
  }

  const SeenBody& body_;
  const ContactFace& face_;
  bool is_ccw_;        ///< the border's sense in the projection, where B is seen from inside unless the pose mirrors it
  std::uint32_t top_;  ///< the highest vertex
  Side side_[2];       ///< of each border the side at the height of the sweep line
};

class Sweep {
 public:
  Sweep(const Projection& projection, const ContactFace& a, const ContactFace& b, double bound, Candidates& corners)
      : face_{SeenFace(projection.a, a, bound), SeenFace(projection.b, b, bound)},
        name_{a.name(), b.name()},
        bound_(bound),
        corners_(corners) {}

  void run() {
    if (!begin()) return;
    for (;;) {
      const auto [f, border] = lowest_event();
      if (!meet(f, border)) return;
      if (face_[f].is_at_top(border)) return end(f, border);
      face_[f].advance(border, bound_);
    }
  }

 private:
  struct Event {
    int face;
    Border border;
  };

  const Side& side(int f, Border border) const { return face_[f][border]; }
  int& leader(Border border) { return leader_[std::size_t(border)]; }

  /// Starts at the higher of the two lowest corners. Returns false if the other face ends below it.
  bool begin() {
    const int f = is_below(face_[0].lowest().at, face_[1].lowest().at) ? 1 : 0, other = 1 - f;
    const Corner& lowest = face_[f].lowest();
    for (const Border border : kBorders) {
      while (!is_below(lowest.at, side(other, border).to.at)) {
        if (face_[other].is_at_top(border)) return false;
        face_[other].advance(border, bound_);
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
    if (leader(border) == f && now == outside(border)) {
      add_crossing(border, {f, border}, {other, border});
      leader(border) = other;
    } else if (leader(border) == other && now == outside(across)) {
      add_crossing(border, {f, border}, {other, border});
      leader(border) = f;
    }
    if (leader(border) == f) add_corner(border, f, corner);
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

  static Where outside(Border border) { return border == Border::Left ? Where::Left : Where::Right; }

  /// Adds a corner of face `f` that lies within the other face.
  void add_corner(Border border, int f, const Corner& corner) {
    const double depth = face_[1 - f].depth_at(corner.at), z_a = f == 0 ? corner.at.z : depth,
                 z_b = f == 0 ? depth : corner.at.z;
    const FeatureId vertex{FeatureKind::Vertex, corner.vertex};
    corners_.add(border, {{corner.at.x, corner.at.y, z_a}, z_b - z_a, f == 0 ? vertex : name_[0], f == 0 ? name_[1] : vertex});
  }

  /// Adds the point where two sides cross, one of each face, or a corner of either within the bound of it.
  void add_crossing(Border border, Event p, Event q) {
    if (p.face == 1) std::swap(p, q);
    const Side &a = side(0, p.border), &b = side(1, q.border);
    const double x = b.to.at.x - b.from.at.x, y = b.to.at.y - b.from.at.y;
    const auto height = [&](const Vec& place) { return x * (place.y - b.from.at.y) - y * (place.x - b.from.at.x); };
    const double h = height(a.from.at), h_to = height(a.to.at);
    // If the sides are nearly parallel, the first point on a is uncertain; the last one is the nearest to that on b.
    const Vec on_b = b.at(b.along(a.at(h != h_to ? min(max(h / (h - h_to), 0), 1) : 0))), on_a = a.at(a.along(on_b));
    const auto apart = [&](const Vec& place) {
      const double dx = place.x - on_a.x, dy = place.y - on_a.y;
      return std::sqrt(dx * dx + dy * dy);
    };
    for (const Corner* c : {&a.from, &a.to}) {
      if (apart(c->at) <= bound_) return add_corner(border, 0, *c);
    }
    for (const Corner* c : {&b.from, &b.to}) {
      if (apart(c->at) <= bound_) return add_corner(border, 1, *c);
    }
    if (apart(on_b) > bound_) return;
    corners_.add(border, {on_a, on_b.z - on_a.z, face_[0].edge_at(p.border, on_a), face_[1].edge_at(q.border, on_b)});
  }

  static constexpr int kNobody = -1;

  SeenFace face_[2];
  const FeatureId name_[2];
  const double bound_;
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
  const double c = length > 0 ? (kSweepCos * dv + kSweepSin * du) / length : 1,
               s = length > 0 ? (kSweepSin * dv - kSweepCos * du) / length : 0;
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
