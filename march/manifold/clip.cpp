// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/clip.h"

#include <cmath>

#include "body/half_edge.h"

namespace swiftlet {

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
  a.shift = seen(-middle), b.shift = seen(pair.b_in_a.t - middle);
  b.x = moved.into(a.x), b.y = moved.into(a.y), b.n = moved.into(n);
}

Vec any_side(const PairView& pair, const ContactFace& a, const ContactFace& b) {
  const auto along = [](const auto& body, std::uint32_t h) {
    return body.point(body.view.half_edges[h].head) - body.point(origin(body.view, h));
  };
  if (a.side() != kNone) return along(body_a(pair), a.side());
  return b.side() != kNone ? along(body_b(pair), b.side()) : Vec{0, 0, 0};
}

}  // namespace swiftlet
