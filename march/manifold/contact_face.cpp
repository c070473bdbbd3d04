// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "manifold/contact_face.h"

#include <limits>

#include "body/half_edge.h"

namespace swiftlet {
namespace {

/// The loop's area times two, along its normal; own frame. Of slivers more true than any one corner's cross product.
template <class Body>
Vec area_of(const Body& body, std::uint32_t face) {
  const ConvexView& view = body.view;
  const std::uint32_t first = view.face_first[face];
  const Vec p = body.own(origin(view, first));
  Vec sum{0, 0, 0};
  for (std::uint32_t h = next_in_face(view, first); view.half_edges[h].head != origin(view, first); h = next_in_face(view, h)) {
    sum = sum + cross(body.own(origin(view, h)) - p, body.own(view.half_edges[h].head) - p);
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

/// Of faces that face along n equally well the one there was before, else the largest: it has the truest plane.
template <class Body>
Facing best_facing(const Body& body, const Vec& n, FeatureId feature, FeatureId before) {
  Facing chosen;
  double most = 0;
  each_face_at(body.view, feature, [&](std::uint32_t face) {
    if (face == kNone || face == chosen.face) return;
    const Vec area = area_of(body, face);
    const double length = norm(area), cosine = length > 0 ? dot(area, n) / length : -1,
                 size = FeatureId(FeatureKind::Face, face) == before ? std::numeric_limits<double>::infinity() : length;
    if (cosine < chosen.cosine - kSameFacing || (cosine <= chosen.cosine + kSameFacing && size <= most)) return;
    chosen = {face, area, cosine};
    most = size;
  });
  return chosen;
}

/// A face and those beside it that lie within some height of its plane: one piece without holes, for a face amidst them has all
/// its corners there too.
template <class Body>
class Plateau {
 public:
  Plateau(const Body& body, const Facing& top, double height) : body_(body), top_(top.face), normal_(normalised(top.area)) {
    level_ = dot(normal_, body_.own(origin(body_.view, body_.view.face_first[top_]))) - height;
    border_ = border();
    if (border_ != kNone) return;
    level_ = std::numeric_limits<double>::infinity();  // rounding hid the border: the face alone has one
    border_ = border();
  }

  /// Calls visit(half_edge) along the border, what is flat on the left.
  template <class Visit>
  void each_side(Visit visit) const {
    const ConvexView& view = body_.view;
    std::uint32_t h = border_;
    do {
      visit(h);
      h = next_in_facet(view, h);
      while (holds(right_face(view, h))) h = clockwise(view.vertices[origin(view, h)], h);
    } while (h != border_);
  }

 private:
  bool holds(std::uint32_t face) const {
    if (face == top_) return true;
    const ConvexView& view = body_.view;
    const std::uint32_t first = view.face_first[face];
    std::uint32_t h = first;
    do {
      if (!(dot(normal_, body_.own(view.half_edges[h].head)) >= level_)) return false;
      h = next_in_face(view, h);
    } while (h != first);
    const Vec area = area_of(body_, face);
    return dot(normal_, area) > 0.5 * norm(area);  // not a side of a thin body, nor its other face
  }

  /// A side of the face, mostly; else from corner to corner outwards, until one has something else beside it.
  std::uint32_t border() const {
    const ConvexView& view = body_.view;
    const std::uint32_t first = view.face_first[top_];
    if (!holds(right_face(view, first))) return first;
    const Vec out = body_.own(view.half_edges[first].head) - body_.own(origin(view, first));
    const auto height = [&](std::uint32_t v) { return dot(out, body_.own(v)); };
    const auto flat = [&](std::uint32_t h) { return holds(view.half_edges[h].face) || holds(right_face(view, h)); };
    std::uint32_t corner = kNone, next = view.half_edges[first].head;
    while (next != corner) {
      corner = next;
      const Vertex& ring = view.vertices[corner];
      for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
        if (height(view.half_edges[h].head) > height(next) && flat(h)) next = view.half_edges[h].head;
      }
    }
    const Vertex& ring = view.vertices[corner];
    for (std::uint32_t h = ring.ring_begin; h < ring.ring_begin + ring.ring_count; ++h) {
      if (holds(view.half_edges[h].face) && !holds(right_face(view, h))) return h;
    }
    return kNone;
  }

  const Body& body_;
  std::uint32_t top_, border_;
  Vec normal_;
  double level_;
};

double twice_area(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) {
  return std::fabs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

/// Leaves out the corner that takes the least area with it.
void thin(ContactFace& outline) {
  double least = std::numeric_limits<double>::infinity();
  int flattest = 0;
  for (int before = outline.count - 1, i = 0; i < outline.count; before = i++) {
    const double area = twice_area(outline[before], outline[i], outline[outline.after(i)]);
    if (area < least) least = area, flattest = i;
  }
  --outline.count;
  for (int i = flattest; i < outline.count; ++i) outline.corners[std::size_t(i)] = outline[i + 1];
}

template <class Body>
void contact_face_of(const Body& body, const Projection& projection, const Vec& n, FeatureId feature, FeatureId before,
                     double flatness, ContactFace& outline) {
  const ConvexView& view = body.view;
  const auto add = [&](std::uint32_t vertex, std::uint32_t half_edge) {
    if (outline.count == kMostCorners) thin(outline);
    const Vec p = body.point(vertex), seen = p - projection.middle;
    outline.corners[std::size_t(outline.count++)] = {p, dot(projection.u, seen), dot(projection.v, seen), vertex, half_edge};
  };
  const Facing top = best_facing(body, n, feature, before);
  outline.count = 0;
  outline.face = top.face;
  outline.facing = top.face == kNone ? 0 : top.cosine;
  if (top.face == kNone) {
    for (std::uint32_t v = 0; v < view.vertices.size(); ++v) {
      add(v, view.vertices[v].ring_count ? view.vertices[v].ring_begin : kNone);
    }
  } else {
    Plateau(body, top, flatness * view.extent).each_side([&](std::uint32_t h) { add(origin(view, h), h); });
  }
}

}  // namespace

/// The basis of [Duff et al. 2017]: exact but for rounding, whatever n.
Projection::Projection(const Vec& normal, const Vec& about) : n(normal), middle(about) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  v = {b, sign + n.y * n.y * a, -n.y};
}

void contact_face_a(const PairView& pair, const Projection& projection, FeatureId feature, FeatureId before, double flatness,
                    ContactFace& outline) {
  contact_face_of(body_a(pair), projection, projection.n, feature, before, flatness, outline);
}
void contact_face_b(const PairView& pair, const Projection& projection, FeatureId feature, FeatureId before, double flatness,
                    ContactFace& outline) {
  const Moved body = body_b(pair);
  contact_face_of(body, projection, body.into(-projection.n), feature, before, flatness, outline);
}

}  // namespace swiftlet
