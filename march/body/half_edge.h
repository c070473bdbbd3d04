// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Steps from half-edge to half-edge of a ConvexView. Knows the data structure, nothing of coordinates.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/model.h>

namespace swiftlet {

static inline std::uint32_t origin(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[v.half_edges[half_edge].twin].head;
}
static inline std::uint32_t right_face(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[v.half_edges[half_edge].twin].face;
}
static inline bool is_diagonal(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[half_edge].face == right_face(v, half_edge) && v.half_edges[half_edge].face != kNone;
}

/// The canonical id of a feature: an edge is named by the half-edge of lesser index.
static inline FeatureId named(const ConvexView& v, FeatureId feature) {
  if (feature.kind() != FeatureKind::Edge || feature.index() < v.half_edges[feature.index()].twin) return feature;
  return {FeatureKind::Edge, v.half_edges[feature.index()].twin};
}

// Steps around a ring choose a number to add, for which g++ has a conditional move. A choice of two indices becomes a branch,
// and some of these would be mispredicted in every ring.

/// The half-edge before `half_edge`, clockwise, in the ring of `vertex`. `vertex` is the origin of `half_edge`.
static inline std::uint32_t clockwise(const Vertex& vertex, std::uint32_t half_edge) {
  return half_edge - 1 + (half_edge == vertex.ring_begin ? vertex.ring_count : 0);
}

/// The half-edge after `half_edge`, counter-clockwise, in the ring of `vertex`. `vertex` is the origin of `half_edge`.
static inline std::uint32_t counter_clockwise(const Vertex& vertex, std::uint32_t half_edge) {
  return half_edge + 1 - (half_edge + 1 == vertex.ring_begin + vertex.ring_count ? vertex.ring_count : 0);
}

/// The half-edge that follows `half_edge` around the exact facet on its left.
static inline std::uint32_t next_in_facet(const ConvexView& v, std::uint32_t half_edge) {
  return clockwise(v.vertices[v.half_edges[half_edge].head], v.half_edges[half_edge].twin);
}

/// The half-edge that `half_edge` follows around the exact facet on its left.
static inline std::uint32_t previous_in_facet(const ConvexView& v, std::uint32_t half_edge) {
  return v.half_edges[counter_clockwise(v.vertices[origin(v, half_edge)], half_edge)].twin;
}

/// Whether no half-edge around the exact facet on its left has a lower index. Looks both ways, so that asking it of all n of
/// them takes n log n steps [Hirschberg & Sinclair 1980].
static inline bool is_first_in_facet(const ConvexView& v, std::uint32_t half_edge) {
  std::uint32_t next = half_edge, previous = half_edge;
  do {
    next = next_in_facet(v, next), previous = previous_in_facet(v, previous);
    if (next < half_edge || previous < half_edge) return false;
  } while (next != half_edge);
  return true;
}

/// The half-edge that follows `half_edge` around the face on its left. A face may be made of several facets; the diagonals
/// between them are skipped.
static inline std::uint32_t next_in_face(const ConvexView& v, std::uint32_t half_edge) {
  std::uint32_t h = next_in_facet(v, half_edge);
  while (is_diagonal(v, h)) h = clockwise(v.vertices[origin(v, h)], h);
  return h;
}

/// The other face of a flat body, which looks the other way; kNone of a solid.
static inline std::uint32_t other_side(const ConvexView& v, std::uint32_t face) {
  return v.face_first.size() == 2 ? 1 - face : kNone;
}

/// The half-edge that `half_edge` follows around the face on its left.
static inline std::uint32_t previous_in_face(const ConvexView& v, std::uint32_t half_edge) {
  const Vertex& ring = v.vertices[origin(v, half_edge)];
  std::uint32_t h = counter_clockwise(ring, half_edge);
  while (is_diagonal(v, h)) h = counter_clockwise(ring, h);
  return v.half_edges[h].twin;
}

/// True if `h`, which may hold any bits, names a feature of `view`.
static inline bool names_feature(const ConvexView& view, FeatureId h) {
  std::size_t count = 0;
  if (h.kind() == FeatureKind::Vertex) count = view.vertices.size();
  if (h.kind() == FeatureKind::Edge) count = view.half_edges.size();
  if (h.kind() == FeatureKind::Face) count = view.face_first.size();
  return h.index() < count;
}

/// `Level::feature_count` of a level with this view.
static inline std::array<std::uint32_t, 4> feature_count(const ConvexView& view) {
  return {0, std::uint32_t(view.vertices.size()), std::uint32_t(view.half_edges.size()), std::uint32_t(view.face_first.size())};
}
/// True if `h`, which may hold any bits, names a feature of `level`. By one look: kinds change from query to query, and
/// processors would guess branches wrong.
static inline bool names_feature(const Level& level, FeatureId h) {
  return h.index() < level.feature_count[std::size_t(h.kind())];
}

}  // namespace swiftlet
