// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The prism over a face: the space above its plane and between the planes at right angles to it through its sides. Points and
// directions are in the common frame. Knows one body.
#pragma once

#include <array>
#include <cstdint>

#include "body/half_edge.h"
#include "pair/pair_view4.h"
#include "pair/polygon.h"

namespace swiftlet {
namespace {

/// The sides of a triangle are known by vectors of the common frame, those of a larger face in the body's own.
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

  /// Calls visit(sides, half_edge) for the sides of a triangle: half_edge(i) is the side in lane i. `beyond` is of p, `slope`
  /// of p + e.
  template <class Visit>
  void each_side(const Vec4& p, const Vec4& e, Visit visit) const {
    Beyond at = beyond(p - corner_), by = beyond(e);
    Vec4 third = v_ - u_;
    const double at_third = -(at.u + at.v + dot(normal_, normal_)), by_third = -(by.u + by.v);
    visit(Sides{dots(u_, u_, third, third, v_, v_, v_, v_), vec4(Vec2{at.u, at_third}, Vec2{at.v, at.v}),
                vec4(Vec2{by.u, by_third}, Vec2{by.v, by.v})},
          [&view = view_, first = first_, before = before_](int i) {
            return std::array{first, next_in_facet(view, first), view.half_edges[before].twin}[i < 2 ? i : 2];
          });
  }
  /// Of a larger face, its sides.
  Polygon polygon(bool is_rim) const { return {view_, first_, own_normal_, is_rim}; }

 private:
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
