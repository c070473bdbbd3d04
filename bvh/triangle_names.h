// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a view by index: their corners, and what features of them are called. A convex body is one triangle, whose
// features have names of their own.
#pragma once

#include "search.h"
#include "triangle_pair.h"

namespace swiftlet {
namespace {  // compiled once for each width of registers: see numeric/width.h

static inline void corners(const MeshView& of, std::uint32_t triangle, Vec (&corner)[3]) {
  const std::uint32_t* const v = of.triangles[triangle].data();
  for (int k = 0; k < 3; ++k) corner[k] = of.vertices[v[k]];
}
/// A triangle, or the convex body, as the atomic kernel takes it.
static inline Body body_of(const MeshView& of, std::uint32_t triangle) {
  if (!of.triangles) return of.convex->body;
  Vec corner[3];
  corners(of, triangle, corner);
  return Body::triangle(eigen(corner[0]), eigen(corner[1]), eigen(corner[2]));
}

static inline FeatureId side(std::uint32_t triangle, int index) { return {FeatureKind::Edge, 3 * triangle + unsigned(index)}; }
static inline void name(const MeshView& of, std::uint32_t triangle, const PartId& place, FeatureId& feature) {
  feature = place.part == Part::Corner ? FeatureId(FeatureKind::Vertex, of.triangles[triangle].data()[place.index])
            : place.part == Part::Side ? side(triangle, place.index)
                                       : FeatureId(FeatureKind::Face, triangle);
}
/// `source` names corners of the triangle; of a convex body `own` is the name.
static inline void name(const MeshView& of, std::uint32_t triangle, const SourceFeature& source, FeatureId own,
                        FeatureId& feature) {
  if (!of.triangles) {
    feature = own;
    return;
  }
  const std::uint32_t* const corner = source.vertices.data();
  feature = FeatureId(FeatureKind::Face, triangle);
  if (source.kind == FeatureKind::Vertex && corner[0] < 3)
    feature = FeatureId(FeatureKind::Vertex, of.triangles[triangle].data()[corner[0]]);
  if (source.kind == FeatureKind::Edge && corner[0] < 3 && corner[1] < 3)
    feature = side(triangle, (corner[0] + 1) % 3 == corner[1] ? int(corner[0]) : int(corner[1]));
}
/// A whole triangle; of a convex body no name.
static inline FeatureId whole(const MeshView& of, std::uint32_t triangle) {
  return of.triangles ? FeatureId(FeatureKind::Face, triangle) : FeatureId();
}

}  // namespace
}  // namespace swiftlet
