// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The contact face of a body: where its border runs. Knows one body in its own frame.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>

#include "body/half_edge.h"
#include "numeric/vec.h"

namespace swiftlet {

/// The face that faces best along a direction of those where a feature is highest along it, merged with the faces beside it
/// that lie within some height of its plane. They are one piece without holes, because a face enclosed by them has all its
/// corners there too. The edge of a body without faces is its border.
class ContactFace {
 public:
  /// `n`: unit, own frame, outwards. `before`, a face of the body, is preferred as long as none faces better. `flatness`: the
  /// height over the body's extent. Corners count as level within `bound`.
  ContactFace(const ConvexView& view, const Vec& n, FeatureId feature, FeatureId before, double flatness, double bound);

  /// The face; of a body without faces its edge, or its vertex.
  FeatureId name() const;
  /// False of a body without faces.
  bool has_plane() const { return top_ != kNone; }
  /// Of the face, unit, own frame; 0 of a body without faces.
  const Vec& normal() const { return normal_; }
  /// The height within which its corners lie in one plane, a length: the border may turn inwards by about as much.
  double flatness() const { return flatness_; }
  /// A half-edge of the border, which leaves the face on its left; kNone of a point.
  std::uint32_t side() const { return side_; }
  /// Whether the border's corners are those of a rim (ConvexView::rims), so that each is found by its index alone.
  bool is_rim() const { return corner_count_ != 0; }
  /// Of a rim: how many corners it has, and the corner `count` corners on from corner `v`, counter-clockwise.
  std::uint32_t corner_count() const { return corner_count_; }
  std::uint32_t corner(std::uint32_t v, std::uint32_t count) const {
    const std::uint32_t i = v - first_corner_ + count;
    return first_corner_ + (i < corner_count_ ? i : i - corner_count_);
  }
  /// Of a rim: how many corners on, counter-clockwise, `to` is from `from`.
  std::uint32_t count(std::uint32_t from, std::uint32_t to) const { return to >= from ? to - from : to + corner_count_ - from; }
  /// The half-edge that goes on along the border where `h` ends, and leaves the face on the same side as `h`.
  template <bool is_left>
  [[gnu::always_inline]] std::uint32_t onward(std::uint32_t h) const {
    const HalfEdge& last = half_edges_[h];
    const Vertex& ring = vertices_[last.head];
    const std::uint32_t first = ring.ring_begin, end = first + ring.ring_count;
    const auto beside = [&](std::uint32_t i) { return is_left ? (i == first ? end : i) - 1 : i + 1 == end ? first : i + 1; };
    for (std::uint32_t next = beside(last.twin);;) {
      const std::uint32_t after = beside(next);
      if (!holds(half_edges_[is_left ? after : next].face, after)) return next;
      next = after;
    }
  }

 private:
  bool holds(std::uint32_t face) const;
  /// The same; `h` ends at a corner of the face, which mostly decides.
  [[gnu::always_inline]] bool holds(std::uint32_t face, std::uint32_t h) const {
    if (face == top_) return face != kNone;
    return dot(normal_, vec(vertices_[half_edges_[h].head])) >= least_height_ && holds(face);
  }
  std::uint32_t border() const;

  const ConvexView& view_;
  const HalfEdge* const half_edges_ = view_.half_edges.data();
  const Vertex* const vertices_ = view_.vertices.data();
  std::uint32_t top_ = kNone, side_ = kNone, first_corner_ = 0, corner_count_ = 0;
  double flatness_ = 0, least_height_ = 0;  ///< the least height along the normal
  Vec normal_{0, 0, 0};
  // What `holds` said last of a face with a plane, which corner after corner of the border may ask about.
  mutable std::uint32_t asked_ = kNone;
  mutable bool held_ = false;
};

}  // namespace swiftlet
