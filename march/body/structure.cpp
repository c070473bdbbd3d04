// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Checks of the indices and the numbers of a level. Trusts no array.
#include "body/structure.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "body/half_edge.h"
#include "numeric/tolerance.h"
#include "numeric/vec.h"

namespace swiftlet {
namespace {

/// True if all coordinates are legal. A climb over others might not end.
bool in_range(std::initializer_list<double> coordinates) {
  return std::all_of(coordinates.begin(), coordinates.end(), is_legal_coordinate);
}

bool is_entry(double x) { return x == 0 || std::fabs(x) >= kLeastNormalEntry; }
bool is_length(double x) { return x >= 0 && std::isfinite(x); }

bool all_below(const auto& values, std::size_t limit) {
  return std::all_of(values.begin(), values.end(), [limit](std::uint32_t v) { return v < limit; });
}

}  // namespace

std::string topology_fault(const ConvexView& v) {
  const std::size_t half_edges = v.half_edges.size(), faces = v.face_first.size();
  const bool is_point = v.vertices.size() == 1 && half_edges == 0, is_segment = v.vertices.size() == 2 && half_edges == 2;
  if (faces == 0 && !is_point && !is_segment) return "no faces";
  std::uint64_t next_ring = 0;
  for (std::size_t i = 0; i < v.vertices.size(); ++i) {
    const Vertex& r = v.vertices[i];
    if (!in_range({r.x, r.y, r.z})) return "vertex " + std::to_string(i) + " is out of range";
    if (max_abs(vec(r)) > v.extent) return "the extent is too small";
    if (r.ring_begin != next_ring || (r.ring_count == 0 && half_edges != 0)) return "ring of vertex " + std::to_string(i);
    next_ring += r.ring_count;
  }
  if (next_ring != half_edges) return "rings do not cover the half-edges";
  if (!all_below(v.face_first, half_edges)) return "index out of range";
  for (const HalfEdge& h : v.half_edges) {
    if (h.head >= v.vertices.size() || h.twin >= half_edges) return "index out of range";
  }
  for (std::size_t i = 0; i < v.vertices.size(); ++i) {
    const Vertex& r = v.vertices[i];
    for (std::uint32_t k = r.ring_begin; k < r.ring_begin + r.ring_count; ++k) {
      const HalfEdge &h = v.half_edges[k], &twin = v.half_edges[h.twin];
      if (h.twin == k || twin.twin != k || twin.head != i || h.head == i) return "twin of half-edge " + std::to_string(k);
      if (h.face >= faces && !(h.face == kNone && faces == 0)) return "face of half-edge " + std::to_string(k);
    }
  }
  std::size_t sides = 0;
  for (std::uint32_t f = 0; f < faces; ++f) {
    std::size_t length = 0;
    std::uint32_t h = v.face_first[f];
    do {
      if (v.half_edges[h].face != f || is_diagonal(v, h) || ++length > half_edges) return "loop of face " + std::to_string(f);
      // This step is next_in_face, but a ring that holds nothing but diagonals ends it.
      const std::uint32_t first = next_in_facet(v, h);
      const Vertex& ring = v.vertices[origin(v, first)];
      std::uint32_t tries = 0;
      for (h = first; is_diagonal(v, h) && tries < ring.ring_count; ++tries) h = clockwise(ring, h);
    } while (h != v.face_first[f]);
    if (length < 3 || (length > 3 && f >= v.planes.size())) return "size of face " + std::to_string(f);
    sides += length;
  }
  std::size_t borders = 0;
  for (std::uint32_t h = 0; h < half_edges; ++h) borders += faces != 0 && !is_diagonal(v, h);
  return sides == borders ? "" : "half-edges outside every loop";
}

std::string plane_fault(const ConvexView& v) {
  for (std::size_t i = 0; i < v.planes.size(); ++i) {
    const FacePlane& p = v.planes[i];
    const double length2 = p.x * p.x + p.y * p.y + p.z * p.z;
    const bool is_normal = std::fabs(length2 - 1) < kUnitNormalError && is_entry(p.x) && is_entry(p.y) && is_entry(p.z);
    if (!is_normal || !is_length(p.thickness) || !is_length(p.over)) return "plane " + std::to_string(i);
  }
  return "";
}

std::string rim_fault(const ConvexView& v) {
  for (std::uint32_t f = 0; f < v.rims; ++f) {
    const std::uint32_t first = v.face_first[f];
    const Vec n = vec(v.planes[f]);
    const double least = dot(n, vec(v.vertices[origin(v, first)])) - kRimDrop * v.extent;
    std::uint32_t h = first, corner = origin(v, first);
    do {
      const std::uint32_t beyond = origin(v, previous_in_face(v, v.half_edges[h].twin));
      if (origin(v, h) != corner || v.vertices[corner++].ring_begin != h || !(dot(n, vec(v.vertices[beyond])) < least))
        return "rim " + std::to_string(f);
      h = next_in_face(v, h);
    } while (h != first);
  }
  return "";
}

std::string link_fault(const Level& level, std::size_t finer_vertices, std::size_t finer_faces, std::size_t coarser_vertices) {
  if (!all_below(level.child_vertex, finer_vertices)) return "child of a vertex";
  for (const FeatureId h : level.child_face) {
    const bool vertex = h.kind() == FeatureKind::Vertex && h.index() < finer_vertices;
    const bool face = h.kind() == FeatureKind::Face && h.index() < finer_faces;
    if (!vertex && !face) return "child of a face";
  }
  return all_below(level.parent_face, coarser_vertices) ? "" : "parent of a face";
}

}  // namespace swiftlet
