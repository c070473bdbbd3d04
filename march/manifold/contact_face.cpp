// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/contact_face.h"

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

template <class Visit>
void each_face_at(const ConvexView& view, FeatureId feature, Visit visit) {
  switch (feature.kind()) {
    case FeatureKind::None: break;
    case FeatureKind::Face: visit(feature.index()); break;
    case FeatureKind::Edge: visit(view.half_edges[feature.index()].face), visit(right_face(view, feature.index())); break;
    case FeatureKind::Vertex: {
      const Vertex& ring = view.vertices[feature.index()];
      for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) visit(view.half_edges[h].face);
    }
  }
}

bool looks_along(const ConvexView& view, const Vec& n, std::uint32_t face) {
  return dot(normal_of(view, face), n) >= 1 - kSameFacing;
}

/// What of a feature touches a plane with the normal n: its highest corner, or the side between two that are level within
/// `bound`; of a face that looks along n or has more of them, the face. A feature that holds the nearest point may do so at its
/// border alone, as a side face does under the edge of a top face.
FeatureId highest_of(const ConvexView& view, const Vec& n, FeatureId feature, double bound) {
  const auto height = [&](std::uint32_t h) { return dot(n, point(view, origin(view, h))); };
  const auto between = [&](std::uint32_t h, std::uint32_t next) {
    const double first = height(h), second = height(next);
    if (std::fabs(first - second) <= bound) return FeatureId(FeatureKind::Edge, h);
    return FeatureId(FeatureKind::Vertex, origin(view, first > second ? h : next));
  };
  if (feature.kind() == FeatureKind::Edge) return between(feature.index(), view.half_edges[feature.index()].twin);
  if (feature.kind() != FeatureKind::Face || looks_along(view, n, feature.index())) return feature;
  std::uint32_t top = view.face_first[feature.index()];
  for (std::uint32_t h = next_in_face(view, top), first = top; h != first; h = next_in_face(view, h))
    if (height(h) > height(top)) top = h;
  const FeatureId on = between(top, next_in_face(view, top)), back = between(previous_in_face(view, top), top);
  if (on.kind() == FeatureKind::Edge && back.kind() == FeatureKind::Edge) return feature;
  return on.kind() == FeatureKind::Edge ? on : back;
}

/// The face that faces along n best. Among equals it is the face of the manifold before, else the largest, because its plane is
/// the most accurate.
std::uint32_t best_facing(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before) {
  std::uint32_t chosen = kNone;
  double most = -2;
  const auto size = [&](std::uint32_t face) {
    return FeatureId(FeatureKind::Face, face) == before ? kInfinity : norm(area_of(view, face));
  };
  each_face_at(view, feature, [&](std::uint32_t face) {
    if (face == kNone || face == chosen) return;
    const Vec normal = normal_of(view, face);
    const double cosine = dot(normal, normal) > 0 ? dot(normal, n) : -1;
    if (cosine < most - kSameFacing || (cosine <= most + kSameFacing && size(face) <= size(chosen))) return;
    chosen = face, most = cosine;
  });
  return chosen;
}

}  // namespace

ContactFace::ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness,
                         double bound)
    : view_(view), flatness_(kWalkingFaceUlps * kFloatUlp * view.extent) {
  top_ = best_facing(view, n, highest_of(view, n, feature, bound), before);
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
/// beside that, it is found by going outwards from corner to corner. At a corner only those merged faces count that sides join
/// to the one come from: others may touch it there, which belong to another piece.
std::uint32_t ContactFace::border() const {
  const std::uint32_t first = view_.face_first[top_];
  const auto is_inner = [&](std::uint32_t h) { return holds(right_face(view_, h)); };
  if (!is_inner(first)) return first;
  const Vec out = point(view_, view_.half_edges[first].head) - point(view_, origin(view_, first));
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
      if (of_head > most && !is_diagonal(view_, left))  // nothing but diagonals may leave a corner inside of a face
        most = of_head, next = is_last ? view_.half_edges[left].twin : next_in_face(view_, left);
      if (is_last || counter_clockwise(ring, left) == right) break;
    }
    if (next == kNone) return is_border ? right : kNone;
    h = next;
  }
}

}  // namespace swiftlet
