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

ContactFace::ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness)
    : view_(view), flatness_(kWalkingFaceUlps * kFloatUlp * view.extent) {
  top_ = best_facing(view, n, feature, before);
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
  least_height_ = kInfinity;  // rounding hid the border: the face alone has one
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
  const std::uint32_t first = view_.face_first[face];
  std::uint32_t h = first;
  do {
    if (!(dot(normal_, point(view_, view_.half_edges[h].head)) >= least_height_)) return false;
    h = next_in_face(view_, h);
  } while (h != first);
  return true;
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
