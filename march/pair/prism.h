// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The prism over a face: the space above its plane and between the planes at right angles to it through its sides. Points and
// directions are in the common frame. Knows one body.
#pragma once

#include <array>
#include <cstdint>

#include "body/half_edge.h"
#include "pair/pair_view4.h"

namespace swiftlet {
namespace {

/// The sides of a triangle are known by vectors of the common frame. Those of a larger face are compared in the body's own
/// frame, so that no corner but the first is carried out of it.
template <class Body>
class Prism {
 public:
  Prism(const Body& body, std::uint32_t f) : Prism(body, body.view.face_first[f], f >= body.view.planes.size()) {
    if (is_triangle_) return;
    own_normal_ = vec4(body.view.planes[f]);
    normal_ = body.image(own_normal_) * sense_;
  }
  /// The prism over the triangle that half-edge `h` begins: a triangular face, or a facet within a larger one.
  static Prism over_facet(const Body& body, std::uint32_t h) { return Prism(body, h, true); }

  bool is_triangle() const { return is_triangle_; }
  const Vec4& corner() const { return corner_; }                         ///< the origin of the face's first half-edge
  std::uint32_t first() const { return first_; }                         ///< that half-edge
  std::uint32_t second() const { return next_in_facet(view_, first_); }  ///< a triangle's next one
  /// A triangle's three corners.
  std::array<std::uint32_t, 3> corners() const {
    const HalfEdge* h = view_.half_edges.data();
    return {origin(view_, first_), h[first_].head, h[before_].head};
  }
  /// From `corner()` to a triangle's second and third corner.
  const Vec4& u() const { return u_; }
  const Vec4& v() const { return v_; }
  /// The face's outward normal, of any length.
  const Vec4& normal() const { return normal_; }
  /// The height of `p` above the face's plane, times the length of `normal()`.
  double height(const Vec4& p) const { return dot(normal_, p - corner_); }

  /// How far something is beyond a triangle's sides u and v, times the lengths of side and normal.
  struct Beyond {
    double u, v;
  };
  /// `r` leads from `corner()` to a point. Of a triangle only: beyond the third side a point is -(u + v + |normal|^2).
  Beyond beyond(const Vec4& r) const {
    Vec4 c = cross(normal_, r);
    return {dot(u_, c) * sense_, -dot(v_, c) * sense_};
  }

  /// Four sides of the face, or fewer, of which the last is repeated. `uu` are the squared lengths of the sides. `beyond` is
  /// how far a point is outside the prism's planes through the sides, and `slope` how much farther outside another one is; both
  /// are times the lengths of the side and of `normal()`.
  struct Sides {
    Vec4 uu, beyond, slope;
  };
  /// Calls visit(sides, half_edge) for all sides of the face and returns their number: half_edge(i) is the side in lane i.
  /// `beyond` is of p, `slope` of p + e.
  template <class Visit>
  std::uint32_t each_side(const Body& body, const Vec4& p, const Vec4& e, Visit visit) const {
    if (!is_triangle_) return each_of_many(body.local(p), body.into(e), visit);
    Beyond at = beyond(p - corner_), by = beyond(e);
    Vec4 third = v_ - u_;
    const double at_third = -(at.u + at.v + dot(normal_, normal_)), by_third = -(by.u + by.v);
    visit(Sides{dots(u_, u_, third, third, v_, v_, v_, v_), vec4(Vec2{at.u, at_third}, Vec2{at.v, at.v}),
                vec4(Vec2{by.u, by_third}, Vec2{by.v, by.v})},
          [&view = view_, first = first_, before = before_](int i) {
            return std::array{first, next_in_facet(view, first), view.half_edges[before].twin}[i < 2 ? i : 2];
          });
    return 3;
  }

  /// The same of one side of a face of many.
  struct Side {
    double uu, beyond, slope;
    /// How far the point is beyond the side, squared; below 0 where it is inside.
    double beyond2() const { return beyond / uu * std::fabs(beyond); }
  };
  /// Calls visit(side, half_edge) for the sides from `from` on to the one that `p` + `e` is the farthest beyond, as long as
  /// each next one brings it farther, and returns that one: the nearest side, if `from` is not far.
  template <class Visit>
  std::uint32_t nearest_side(const Body& body, std::uint32_t from, const Vec4& p, const Vec4& e, Visit visit) const {
    Vec own_p = vec(body.local(p)), own_e = vec(body.into(e)), own_normal = vec(own_normal_);
    const auto look = [&](std::uint32_t h) {
      Vec tail = vec(view_.vertices[origin(view_, h)]), u = vec(view_.vertices[view_.half_edges[h].head]) - tail,
          out = cross(u, own_normal);
      Side side{dot(u, u), dot(own_p - tail, out), dot(own_e, out)};
      visit(side, h);
      return Side{side.uu, side.beyond + side.slope, 0}.beyond2();
    };
    double most = look(from);
    const auto follow = [&](auto next) {
      for (std::uint32_t h = next(view_, from);; h = next(view_, from)) {
        const double beyond2 = look(h);
        if (!(beyond2 > most)) return;
        most = beyond2, from = h;
      }
    };
    follow(next_in_face), follow(previous_in_face);
    return from;
  }

  /// Where a point is beside a rim (ConvexView::rims): lines from corner 0 to the other corners cut the face into triangles,
  /// one for each side.
  struct OnRim {
    std::uint32_t side = kNone;  ///< that of the triangle that holds the point, or one that the point is not inside of
    bool inside = false, well_inside = false;  ///< inside the face, and by more than the margin
    std::uint32_t tests = 0;
  };
  /// Finds the triangle by halving. A point in it is in the face, whatever the other sides are.
  OnRim on_rim(const Body& body, const Vec4& p, double margin) const {
    const std::uint32_t root = origin(view_, first_), last = origin(view_, previous_in_face(view_, first_)) - root;
    const Vertex* corners = &view_.vertices[root];
    const Vec own_p = vec(body.local(p)), n = vec(own_normal_), corner_0 = vec(corners[0]), along = cross(own_p - corner_0, n);
    OnRim at;
    // How far to the left of the line from corner 0 to another the point is, and of a side, for both times its length.
    struct Left {
      double of, length2;
      bool by(double least) const { return of > 0 && of * of > least * least * length2; }
      Left reversed() const { return {-of, length2}; }
    };
    const auto left_of_line = [&](std::uint32_t k) {
      const Vec way = vec(corners[k]) - corner_0;
      ++at.tests;
      return Left{dot(way, along), dot(way, way)};
    };
    const auto left_of_side = [&](std::uint32_t k) {
      const Vec tail = vec(corners[k]), way = vec(corners[k == last ? 0 : k + 1]) - tail;
      ++at.tests;
      return Left{dot(own_p - tail, cross(n, way)), dot(way, way)};
    };
    std::uint32_t from = 1, to = last;
    while (to - from > 1) {
      const std::uint32_t middle = (from + to) / 2;
      (left_of_line(middle).of > 0 ? from : to) = middle;
    }
    const Left of_first = left_of_side(0), of_last = left_of_side(last), of_side = left_of_side(from);
    at.side = corners[!(of_first.of > 0) ? 0 : !(of_last.of > 0) ? last : from].ring_begin;
    at.inside = of_first.of > 0 && of_last.of > 0 && of_side.of > 0;
    at.well_inside = at.inside && of_first.by(margin) && of_last.by(margin) && of_side.by(margin);
    // Where the point is nearer to a line than the margin, the side beyond the line counts too.
    for (std::uint32_t k = from; at.well_inside && k > 1 && !left_of_line(k).by(margin); --k)
      at.well_inside = left_of_side(k - 1).by(margin);
    for (std::uint32_t k = from + 1; at.well_inside && k < last && !left_of_line(k).reversed().by(margin); ++k)
      at.well_inside = left_of_side(k).by(margin);
    return at;
  }

 private:
  /// `p` and `e` are in the body's own frame.
  template <class Visit>
  std::uint32_t each_of_many(const Vec4& p, const Vec4& e, Visit visit) const {
    const ConvexView& view = view_;
    V3<Vec4> own_normal = repeated(own_normal_), from = repeated(p), way = repeated(e);
    std::array<std::uint32_t, 4> sides;
    std::array<const Vertex*, 4> tail, head;
    const Vertex* corner = &view.vertices[origin(view, first_)];
    std::uint32_t h = first_, count = 0;
    do {
      for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0 && h == first_) {
          sides[i] = sides[i - 1], tail[i] = tail[i - 1], head[i] = head[i - 1];
          continue;
        }
        sides[i] = h, tail[i] = corner, head[i] = corner = &view.vertices[view.half_edges[h].head];
        h = next_in_face(view, h);
        ++count;
      }
      V3<Vec4> tails = transposed(*tail[0], *tail[1], *tail[2], *tail[3]),
               u = transposed(*head[0], *head[1], *head[2], *head[3]) - tails, out = cross(u, own_normal);
      visit(Sides{dot(u, u), dot(from - tails, out), dot(way, out)}, [&](int i) { return sides[std::size_t(i)]; });
    } while (h != first_);
    return count;
  }

  Prism(const Body& body, std::uint32_t h, bool is_triangle)
      : view_(body.view), is_triangle_(is_triangle), first_(h), sense_(body.sense()) {
    const ConvexView& view = body.view;
    const std::uint32_t root = origin(view, h);
    corner_ = body.point(root);
    if (!is_triangle) return;
    const Vertex& record = view.vertices[root];
    before_ = counter_clockwise(record, h);
    Vec4 q = vec4(record);
    u_ = body.way(body.own(view.half_edges[h].head) - q);
    v_ = body.way(body.own(view.half_edges[before_].head) - q);
    normal_ = cross(u_, v_) * sense_;
  }

  const ConvexView& view_;
  bool is_triangle_;
  std::uint32_t first_;
  std::uint32_t before_ = kNone;  ///< the twin of a triangle's third half-edge
  double sense_;
  Vec4 corner_, u_{}, v_{}, normal_, own_normal_{};
};

}  // namespace
}  // namespace swiftlet
