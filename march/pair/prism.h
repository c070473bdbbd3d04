// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The prism over a face: the space above its plane and between the planes at right angles to it through its sides. Knows one
// body and works in that body's own frame.
#pragma once

#include <cstdint>

#include "body/half_edge.h"
#include "pair/pair_view.h"

namespace swiftlet {

template <class Body>
class Prism {
 public:
  Prism(Body body, std::uint32_t f)
      : body_(body),
        is_triangle_(f >= body.view.planes.size()),
        first_(body.view.face_first[f]),
        corner_(body.own(origin(body.view, first_))) {
    if (!is_triangle_) {
      normal_ = {body.view.planes[f].x, body.view.planes[f].y, body.view.planes[f].z};
      return;
    }
    second_ = next_in_facet(body.view, first_);
    u_ = body.own(body.view.half_edges[first_].head) - corner_;
    v_ = body.own(body.view.half_edges[second_].head) - corner_;
    normal_ = cross(u_, v_);
  }

  /// The face's outward normal, of any length.
  const Vec& normal() const { return normal_; }
  /// The height of `p` above the face's plane, times the length of `normal()`.
  double height(const Vec& p) const { return dot(normal_, p - corner_); }

  /// Calls visit(half_edge, u, beyond, slope) for each side of the face and returns the number of sides. `u` is the side's
  /// vector, in either direction. `beyond` is how far `p` is outside the prism's plane through the side, and `slope` how much
  /// farther outside `p` + `e` is; both are times the lengths of `u` and `normal()`.
  template <class Visit>
  std::uint32_t each_side(const Vec& p, const Vec& e, Visit visit) const {
    return is_triangle_ ? each_of_three(p, e, visit) : each_of_many(p, e, visit);
  }

 private:
  template <class Visit>
  std::uint32_t each_of_many(const Vec& p, const Vec& e, Visit visit) const {
    std::uint32_t h = first_, count = 0;
    Vec tail = corner_;
    do {
      const Vec head = body_.own(body_.view.half_edges[h].head), u = head - tail, out = cross(u, normal_);
      visit(h, u, dot(p - tail, out), dot(e, out));
      tail = head;
      h = next_in_face(body_.view, h);
      ++count;
    } while (h != first_);
    return count;
  }

  /// Computes `beyond` for two sides; the third follows, because the sum over the three sides is the same for all points.
  template <class Visit>
  std::uint32_t each_of_three(const Vec& p, const Vec& e, Visit visit) const {
    const Vec across_p = cross(normal_, p - corner_), across_e = cross(normal_, e);
    const double beyond_u = dot(u_, across_p), beyond_v = -dot(v_, across_p);
    const double slope_u = dot(u_, across_e), slope_v = -dot(v_, across_e);
    visit(first_, u_, beyond_u, slope_u);
    visit(second_, v_ - u_, -(beyond_u + beyond_v + dot(normal_, normal_)), -(slope_u + slope_v));
    visit(next_in_facet(body_.view, second_), v_, beyond_v, slope_v);
    return 3;
  }

  const Body body_;
  const bool is_triangle_;
  const std::uint32_t first_;
  std::uint32_t second_ = kNone;  ///< a triangle's second half-edge
  const Vec corner_;
  Vec u_{0, 0, 0}, v_{0, 0, 0};  ///< for a triangle: from `corner_` to the second and to the third corner
  Vec normal_;
};

}  // namespace swiftlet
