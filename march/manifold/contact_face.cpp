// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/contact_face.h"

#include <limits>

#include <swiftlet/manifold.h>

#include "body/half_edge.h"

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

/// A face, and its area_of.
struct Facing {
  std::uint32_t face = kNone;
  Vec area{0, 0, 0};
  double cosine = -2;
};

/// The face that faces along n best. Among equals it is the face of the manifold before, else the largest, because its plane is
/// the most accurate.
Facing best_facing(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before) {
  Facing chosen;
  double most = 0;
  each_face_at(view, feature, [&](std::uint32_t face) {
    if (face == kNone || face == chosen.face) return;
    const Vec area = area_of(view, face);
    const double length = norm(area), cosine = length > 0 ? dot(area, n) / length : -1,
                 size = FeatureId(FeatureKind::Face, face) == before ? std::numeric_limits<double>::infinity() : length;
    if (cosine < chosen.cosine - kSameFacing || (cosine <= chosen.cosine + kSameFacing && size <= most)) return;
    chosen = {face, area, cosine};
    most = size;
  });
  return chosen;
}

}  // namespace

ContactFace::ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness)
    : view_(view), flatness_(kWalkingFaceUlps * kFloatUlp * view.extent) {
  const Facing top = best_facing(view, n, feature, before);
  if (top.face == kNone) {
    side_ = view.half_edges.empty() ? kNone : 0;
    return;
  }
  const double height = max(0, min(flatness, kMostFlatness)) * view.extent;
  flatness_ = max(flatness_, height);
  top_ = top.face;
  normal_ = normalised(top.area);
  least_height_ = dot(normal_, point(view, origin(view, view.face_first[top_]))) - height;
  side_ = border();
  if (side_ != kNone) return;
  least_height_ = std::numeric_limits<double>::infinity();  // rounding hid the border: the face alone has one
  side_ = border();
}

FeatureId ContactFace::name() const {
  if (top_ != kNone) return {FeatureKind::Face, top_};
  if (side_ != kNone) return named(view_, {FeatureKind::Edge, side_});
  return {FeatureKind::Vertex, 0};
}

std::uint32_t ContactFace::next(std::uint32_t side) const {
  std::uint32_t h = next_in_facet(view_, side);
  while (is_left_of(view_.half_edges[h].twin)) h = clockwise(view_.vertices[origin(view_, h)], h);
  return h;
}

std::uint32_t ContactFace::previous(std::uint32_t side) const {
  const Vertex& ring = view_.vertices[origin(view_, side)];
  std::uint32_t h = counter_clockwise(ring, side);
  while (is_left_of(h)) h = counter_clockwise(ring, h);
  return view_.half_edges[h].twin;
}

/// Tests a corner across the face first: mostly it decides. It is a corner of the face's loop, as `holds` tests these alone.
bool ContactFace::is_left_of(std::uint32_t half_edge) const {
  const std::uint32_t face = view_.half_edges[half_edge].face;
  if (face == top_ || face == kNone) return face != kNone;
  if (is_diagonal(view_, half_edge)) return holds(face);
  const Vec across = point(view_, view_.half_edges[next_in_face(view_, half_edge)].head);
  return dot(normal_, across) >= least_height_ && holds(face);
}

bool ContactFace::holds(std::uint32_t face) const {
  if (face == top_ || face == kNone) return face != kNone;
  const std::uint32_t first = view_.face_first[face];
  std::uint32_t h = first;
  do {
    if (!(dot(normal_, point(view_, view_.half_edges[h].head)) >= least_height_)) return false;
    h = next_in_face(view_, h);
  } while (h != first);
  const Vec area = area_of(view_, face);
  return dot(normal_, area) > 0.5 * norm(area);  // not a side of a thin body, nor its other face
}

/// A half-edge of the contact face's border. Mostly it is a side of the face; where another facet of the same plane lies
/// beside that, it is found by going outwards from corner to corner.
std::uint32_t ContactFace::border() const {
  const std::uint32_t first = view_.face_first[top_];
  if (!holds(right_face(view_, first))) return first;
  const Vec out = point(view_, view_.half_edges[first].head) - point(view_, origin(view_, first));
  const auto height = [&](std::uint32_t v) { return dot(out, point(view_, v)); };
  const auto flat = [&](std::uint32_t h) { return holds(view_.half_edges[h].face) || holds(right_face(view_, h)); };
  std::uint32_t corner = kNone, next = view_.half_edges[first].head;
  while (next != corner) {
    corner = next;
    const Vertex& ring = view_.vertices[corner];
    for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
      if (height(view_.half_edges[h].head) > height(next) && flat(h)) next = view_.half_edges[h].head;
    }
  }
  const Vertex& ring = view_.vertices[corner];
  for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
    if (holds(view_.half_edges[h].face) && !holds(right_face(view_, h))) return h;
  }
  return kNone;
}

}  // namespace swiftlet
