// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/contact_face.h"

#include <utility>

#include "body/half_edge.h"
#include "numeric/exact.h"
#include "numeric/tolerance.h"

namespace swiftlet {
namespace {

Vec point(const ConvexView& view, std::uint32_t vertex) { return vec(view.vertices[vertex]); }

/// Twice the area of the face, along its normal. For a sliver this is more accurate than the cross product at any one corner.
Vec area_of(const ConvexView& view, std::uint32_t face) {
  const std::uint32_t first = view.face_first[face];
  const Vec p = point(view, origin(view, first));
  Vec sum{0, 0, 0};
  for (std::uint32_t h = next_in_face(view, first); view.half_edges[h].head != origin(view, first); h = next_in_face(view, h)) {
    sum = sum + cross(point(view, origin(view, h)) - p, point(view, view.half_edges[h].head) - p);
  }
  return sum;
}

/// The unit normal of a face without a plane of its own, which is a triangle; 0 of one that has none. Of a sliver doubles know
/// nothing.
[[gnu::noinline]] Vec normal_of_triangle(const ConvexView& view, std::uint32_t face) {
  const std::uint32_t h = view.face_first[face];
  const Vec p = point(view, origin(view, h)), q = point(view, view.half_edges[h].head),
            r = point(view, view.half_edges[next_in_face(view, h)].head), u = q - p, v = r - p, area = cross(u, v);
  const bool is_sliver = !(dot(area, area) > kSliverArea * dot(u, u) * dot(v, v));
  return is_sliver ? exact::plane(p, q, r).normal : normalised(area);
}
/// The unit normal of a face; 0 of a triangle that has none.
Vec normal_of(const ConvexView& view, std::uint32_t face) {
  return face < view.planes.size() ? vec(view.planes[face]) : normal_of_triangle(view, face);
}

bool looks_along(const ConvexView& view, const Vec& n, std::uint32_t face) {
  return dot(normal_of(view, face), n) >= 1 - kSameFacing;
}

template <class Visit>
void each_face_around(const ConvexView& view, std::uint32_t vertex, Visit visit) {
  const Vertex& ring = view.vertices[vertex];
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) visit(view.half_edges[h].face);
}

/// The feature of a body's faces that touches a plane with the normal n where this one does: of an edge that is not level
/// within `bound`, the higher corner; of a corner or a diagonal inside of a face, the face.
FeatureId highest_of(const ConvexView& view, const Vec& n, FeatureId feature, double bound) {
  if (feature.kind() == FeatureKind::Edge) {
    const std::uint32_t h = feature.index(), tail = origin(view, h), head = view.half_edges[h].head;
    const double rise = dot(n, point(view, head) - point(view, tail));
    if (std::fabs(rise) <= bound) return is_diagonal(view, h) ? FeatureId(FeatureKind::Face, right_face(view, h)) : feature;
    feature = {FeatureKind::Vertex, rise > 0 ? head : tail};
  }
  if (feature.kind() != FeatureKind::Vertex || view.half_edges.empty()) return feature;
  const std::uint32_t face = view.half_edges[view.vertices[feature.index()].ring_begin].face;
  bool is_inside = face != kNone;
  each_face_around(view, feature.index(), [&](std::uint32_t beside) { is_inside &= beside == face; });
  return is_inside ? FeatureId(FeatureKind::Face, face) : feature;
}

/// Visits the faces beyond those sides of a face that are highest along n within `bound`. Returns the corner that is highest,
/// and whether there is such a side.
template <class Visit>
std::pair<std::uint32_t, bool> each_beyond_top(const ConvexView& view, const Vec& n, std::uint32_t face, double bound,
                                               Visit visit) {
  const std::uint32_t first = view.face_first[face];
  const auto height = [&](std::uint32_t v) { return dot(n, point(view, v)); };
  std::uint32_t top = origin(view, first);
  for (std::uint32_t h = next_in_face(view, first); h != first; h = next_in_face(view, h))
    if (height(origin(view, h)) > height(top)) top = origin(view, h);
  const double least = height(top) - bound;
  bool is_side = false;
  std::uint32_t h = first;
  do {
    if (height(origin(view, h)) >= least && height(view.half_edges[h].head) >= least)
      visit(right_face(view, h)), is_side = true;
    h = next_in_face(view, h);
  } while (h != first);
  return {top, is_side};
}

/// Visits the faces that may touch a plane with the normal n where a feature does. A face that holds the nearest point but does
/// not look along n touches the plane at its border, as a side face does under the edge of a top face: with the faces beyond
/// its sides that are level within `bound`, or those around its highest corner.
template <class Visit>
void each_touching(const ConvexView& view, const Vec& n, FeatureId feature, double bound, Visit visit) {
  feature = highest_of(view, n, feature, bound);
  const std::uint32_t i = feature.index();
  switch (feature.kind()) {
    case FeatureKind::None: return;
    case FeatureKind::Vertex: return each_face_around(view, i, visit);
    case FeatureKind::Edge: return visit(view.half_edges[i].face), visit(right_face(view, i));
    case FeatureKind::Face: visit(i);
  }
  if (looks_along(view, n, i)) return;
  const auto [top, is_side] = each_beyond_top(view, n, i, bound, visit);
  if (!is_side) each_face_around(view, top, visit);
}

/// The face that faces along n best. Among equals it is the face of the manifold before, else the largest, because its plane is
/// the most accurate.
std::uint32_t best_facing(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double bound) {
  std::uint32_t chosen = kNone;
  double most = -2;
  const auto size = [&](std::uint32_t face) {
    return FeatureId(FeatureKind::Face, face) == before ? kInfinity : norm(area_of(view, face));
  };
  const auto visit = [&](std::uint32_t face) {
    if (face == kNone || face == chosen) return;
    const Vec normal = normal_of(view, face);
    const double cosine = dot(normal, normal) > 0 ? dot(normal, n) : -1;
    if (cosine < most - kSameFacing || (cosine <= most + kSameFacing && size(face) <= size(chosen))) return;
    chosen = face, most = cosine;
  };
  each_touching(view, n, feature, bound, visit);
  // Where slivers touch, the face that looks along n may lie beyond some.
  for (double last = -3; chosen != kNone && most > last + kSameFacing && most < 1 - kSameFacing;) {
    last = most;
    each_beyond_top(view, n, chosen, bound, visit);
  }
  return chosen;
}

}  // namespace

ContactFace::ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness,
                         double bound)
    : view_(view), flatness_(kWalkingFaceUlps * kFloatUlp * view.extent) {
  top_ = best_facing(view, n, feature, before, bound);
  if (top_ == kNone) {
    side_ = view.half_edges.empty() ? kNone : 0;
    return;
  }
  const double height = flatness * view.extent;
  flatness_ = max(flatness_, height);
  normal_ = normal_of(view, top_);
  least_height_ = dot(normal_, point(view, origin(view, view.face_first[top_]))) - height;
  if (top_ < view.rims) {  // no face is merged with it
    side_ = view.face_first[top_];
    first_corner_ = origin(view, side_);
    corner_count_ = origin(view, previous_in_face(view, side_)) + 1 - first_corner_;
    return;
  }
  side_ = border();
  if (side_ != kNone) return;
  least_height_ = kInfinity, asked_ = kNone;  // rounding hid the border: the face alone has one
  side_ = border();
}

FeatureId ContactFace::name() const {
  if (top_ != kNone) return {FeatureKind::Face, top_};
  if (side_ != kNone) return named(view_, {FeatureKind::Edge, side_});
  return {FeatureKind::Vertex, 0};
}

bool ContactFace::holds(std::uint32_t face) const {
  if (face == top_ || face == kNone) return face != kNone;
  if (!(dot(normal_, normal_of(view_, face)) > 0.5)) return false;  // a side of a thin body, or its other face
  if (face == asked_) return held_;
  const std::uint32_t first = view_.face_first[face];
  std::uint32_t h = first;
  bool is_held = true;
  do {
    is_held = dot(normal_, point(view_, view_.half_edges[h].head)) >= least_height_;
    h = next_in_face(view_, h);
  } while (is_held && h != first);
  if (face < view_.planes.size()) asked_ = face, held_ = is_held;
  return is_held;
}

/// A half-edge of the contact face's border. Mostly it is a side of the face; where another facet of the same plane lies
/// beside that, it is found by going outwards from corner to corner, along a direction at right angles to few sides: corners
/// inside of the face may be as far out as a side up to rounding, and so the farthest. The way follows diagonals too, as faces
/// merged with others may turn inwards. At a corner only those merged faces count that sides join to the one come from: others
/// may touch it there, which belong to another piece.
std::uint32_t ContactFace::border() const {
  const std::uint32_t first = view_.face_first[top_];
  const auto is_inner = [&](std::uint32_t h) { return holds(right_face(view_, h)); };
  if (!is_inner(first)) return first;
  const Vec way = point(view_, view_.half_edges[first].head) - point(view_, origin(view_, first)),
            out = way * kSweepCos + cross(normal_, way) * kSweepSin;
  const auto height = [&](std::uint32_t v) { return dot(out, point(view_, v)); };
  for (std::uint32_t h = first;;) {  // leaves the corner, with a merged face on its left
    const std::uint32_t corner = origin(view_, h);
    const Vertex& ring = view_.vertices[corner];
    std::uint32_t right = h;
    while (is_inner(right) && clockwise(ring, right) != h) right = clockwise(ring, right);
    const bool is_border = !is_inner(right);
    std::uint32_t next = kNone;
    double most = height(corner);
    for (std::uint32_t left = right;; left = counter_clockwise(ring, left)) {
      const bool is_last = !holds(view_.half_edges[left].face);
      const double of_head = height(view_.half_edges[left].head);
      if (of_head > most) most = of_head, next = is_last ? view_.half_edges[left].twin : next_in_facet(view_, left);
      if (is_last || counter_clockwise(ring, left) == right) break;
    }
    if (next == kNone) return is_border ? right : kNone;
    h = next;
  }
}

}  // namespace swiftlet
