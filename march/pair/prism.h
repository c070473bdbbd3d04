// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The prism over a face: the space above its plane and between the planes at right angles to it through its sides. Points and
// directions are in the common frame. Knows one body.
#pragma once

#include <cstdint>

#include "body/half_edge.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// The sides of a triangle are known by vectors of the common frame. Those of a larger face are compared in the body's own
/// frame, so that no corner but the first is carried out of it.
template <class Body>
class Prism {
 public:
  Prism(Body body, std::uint32_t f)
      : body_(body),
        is_triangle_(f >= body.view.planes.size()),
        first_(body.view.face_first[f]),
        sense_(body.sense()),
        corner_(body.point(origin(body.view, first_))) {
    if (!is_triangle_) {
      const FacePlane& plane = body.view.planes[f];
      own_normal_ = vec(plane);
      normal_ = body.image(own_normal_) * sense_;
      return;
    }
    span();
  }
  /// The prism over the triangle that half-edge `h` begins: a triangular face, or a facet within a larger one.
  static Prism over_facet(Body body, std::uint32_t h) { return Prism(body, h, Facet{}); }

  const Body& body() const { return body_; }
  bool is_triangle() const { return is_triangle_; }
  const Vec& corner() const { return corner_; }     ///< the origin of the face's first half-edge
  std::uint32_t first() const { return first_; }    ///< that half-edge
  std::uint32_t second() const { return second_; }  ///< a triangle's next one
  /// From `corner()` to a triangle's second and third corner.
  const Vec& u() const { return u_; }
  const Vec& v() const { return v_; }
  /// The face's outward normal, of any length.
  const Vec& normal() const { return normal_; }
  /// The height of `p` above the face's plane, times the length of `normal()`.
  double height(const Vec& p) const { return dot(normal_, p - corner_); }

  /// How far something is beyond a triangle's sides u and v, times the lengths of side and normal.
  struct Beyond {
    double u, v;
  };
  /// `r` leads from `corner()` to a point. Of a triangle only: beyond the third side a point is -(u + v + |normal|^2).
  Beyond beyond(const Vec& r) const {
    const Vec c = cross(normal_, r);
    return {dot(u_, c) * sense_, -dot(v_, c) * sense_};
  }

  /// Calls visit(half_edge, uu, beyond, slope) for each side of the face and returns the number of sides. `uu` is the squared
  /// length of the side. `beyond` is how far `p` is outside the prism's plane through the side, and `slope` how much farther
  /// outside `p` + `e` is; both are times the lengths of the side and of `normal()`.
  template <class Visit>
  std::uint32_t each_side(const Vec& p, const Vec& e, Visit visit) const {
    if (!is_triangle_) return each_of_many(body_.local(p), body_.into(e), visit);
    const Beyond at = beyond(p - corner_), by = beyond(e);
    const Vec third = v_ - u_;
    visit(first_, dot(u_, u_), at.u, by.u);
    visit(second_, dot(third, third), -(at.u + at.v + dot(normal_, normal_)), -(by.u + by.v));
    visit(next_in_facet(body_.view, second_), dot(v_, v_), at.v, by.v);
    return 3;
  }

  /// The same for a point that does not move: calls visit(half_edge, uu, beyond).
  template <class Visit>
  std::uint32_t each_side(const Vec& p, Visit visit) const {
    if (!is_triangle_)
      return each_of_many(body_.local(p), {0, 0, 0},
                          [&](std::uint32_t h, double uu, double out, double) { visit(h, uu, out); });
    const Beyond at = beyond(p - corner_);
    const Vec third = v_ - u_;
    visit(first_, dot(u_, u_), at.u);
    visit(second_, dot(third, third), -(at.u + at.v + dot(normal_, normal_)));
    visit(next_in_facet(body_.view, second_), dot(v_, v_), at.v);
    return 3;
  }

 private:
  /// `p` and `e` are in the body's own frame.
  template <class Visit>
  std::uint32_t each_of_many(const Vec& p, const Vec& e, Visit visit) const {
    std::uint32_t h = first_, count = 0;
    Vec tail = body_.own(origin(body_.view, first_));
    do {
      const Vec head = body_.own(body_.view.half_edges[h].head), u = head - tail, out = cross(u, own_normal_);
      visit(h, dot(u, u), dot(p - tail, out), dot(e, out));
      tail = head;
      h = next_in_face(body_.view, h);
      ++count;
    } while (h != first_);
    return count;
  }

  struct Facet {};
  Prism(Body body, std::uint32_t h, Facet)
      : body_(body), is_triangle_(true), first_(h), sense_(body.sense()), corner_(body.point(origin(body.view, h))) {
    span();
  }
  void span() {
    const std::uint32_t root = origin(body_.view, first_);
    second_ = next_in_facet(body_.view, first_);
    u_ = body_.way(root, body_.view.half_edges[first_].head);
    v_ = body_.way(root, body_.view.half_edges[second_].head);
    normal_ = cross(u_, v_) * sense_;
  }

  const Body body_;
  const bool is_triangle_;
  const std::uint32_t first_;
  std::uint32_t second_ = kNone;  ///< a triangle's second half-edge
  const double sense_;
  const Vec corner_;
  Vec u_{0, 0, 0}, v_{0, 0, 0}, normal_, own_normal_{0, 0, 0};
};

}  // namespace swiftlet
