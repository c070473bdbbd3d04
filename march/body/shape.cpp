// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Makes the one level of a primitive: half-edges from constant tables, vertices and planes from the body.
#include "body/shape.h"

#include <algorithm>
#include <tuple>

#include "numeric/exact.h"

namespace swiftlet {
namespace {

/// The half-edges of a polytope whose faces all have `Sides` sides. In the ring of a vertex, a half-edge h is followed by the
/// twin of the half-edge that precedes h around its face.
template <std::size_t Vertices, std::size_t Faces, std::size_t Sides>
struct Topology {
  std::array<std::uint32_t, Vertices + 1> ring{};
  std::array<HalfEdge, Faces * Sides> half_edges{};
  std::array<std::uint32_t, Faces> face_first{};

  /// `faces` lists the vertices of each face, counter-clockwise seen from outside.
  constexpr explicit Topology(const std::uint32_t (&faces)[Faces][Sides]) {
    std::uint32_t before[Vertices][Vertices] = {}, left[Vertices][Vertices] = {};
    for (std::uint32_t f = 0; f < Faces; ++f) {
      for (std::size_t i = 0; i < Sides; ++i) {
        const std::uint32_t v = faces[f][i], w = faces[f][(i + 1) % Sides];
        left[v][w] = f;
        before[v][w] = faces[f][(i + Sides - 1) % Sides];
      }
    }
    std::uint32_t number[Vertices][Vertices] = {}, h = 0;
    for (std::uint32_t v = 0; v < Vertices; ++v) {
      ring[v] = h;
      std::uint32_t w = 0;
      for (std::size_t k = 0; k < Faces * Sides; ++k) {
        if (faces[k / Sides][k % Sides] == v) w = faces[k / Sides][(k + 1) % Sides];
      }
      const std::uint32_t first = w;
      do {
        number[v][w] = h;
        half_edges[h++] = {w, 0, left[v][w]};
        w = before[v][w];
      } while (w != first);
    }
    ring[Vertices] = h;
    for (std::uint32_t f = 0; f < Faces; ++f) {
      face_first[f] = number[faces[f][0]][faces[f][1]];
      for (std::size_t i = 0; i < Sides; ++i) {
        const std::uint32_t v = faces[f][i], w = faces[f][(i + 1) % Sides];
        half_edges[number[v][w]].twin = number[w][v];
      }
    }
  }
};

constexpr Topology<3, 2, 3> kTriangle({{0, 1, 2}, {0, 2, 1}});
constexpr Topology<4, 2, 4> kQuad({{0, 1, 2, 3}, {0, 3, 2, 1}});
// Corners are numbered by bits: x 1, y 2, z 4.
constexpr Topology<8, 6, 4> kBox({{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
// The face planes of a box, and those of a flat box by the axis along which it is flat.
constexpr FacePlane kPlanes[] = {{-1, 0, 0, 0, 0}, {1, 0, 0, 0, 0},  {0, -1, 0, 0, 0},
                                 {0, 1, 0, 0, 0},  {0, 0, -1, 0, 0}, {0, 0, 1, 0, 0}};
constexpr FacePlane kQuadPlanes[3][2] = {
    {{1, 0, 0, 0, 0}, {-1, 0, 0, 0, 0}}, {{0, 1, 0, 0, 0}, {0, -1, 0, 0, 0}}, {{0, 0, 1, 0, 0}, {0, 0, -1, 0, 0}}};
constexpr HalfEdge kSegment[] = {{1, 1, kNone}, {0, 0, kNone}};

template <class AnyTopology>
void connect(const AnyTopology& of, Primitive& primitive) {
  for (std::size_t v = 0; v + 1 < of.ring.size(); ++v)
    primitive.vertices[v].ring_begin = of.ring[v], primitive.vertices[v].ring_count = of.ring[v + 1] - of.ring[v];
  primitive.level.view.half_edges = of.half_edges;
  primitive.level.view.face_first = of.face_first;
}

/// Makes a segment or, if both ends are equal, a point. Returns the number of vertices.
int segment(const Vertex& p, const Vertex& q, Primitive& primitive) {
  primitive.vertices[0] = p;
  if (p.x == q.x && p.y == q.y && p.z == q.z) return 1;
  primitive.vertices[0].ring_count = 1;
  primitive.vertices[1] = {q.x, q.y, q.z, 1, 1};
  primitive.level.view.half_edges = kSegment;
  return 2;
}

int triangle(const std::array<Vertex, 3>& corner, Primitive& primitive) {
  if (exact::collinear(&corner[0].x, &corner[1].x, &corner[2].x)) {
    const auto [first, last] = std::minmax_element(corner.begin(), corner.end(), [](const Vertex& v, const Vertex& w) {
      return std::tie(v.x, v.y, v.z) < std::tie(w.x, w.y, w.z);
    });
    return segment(*first, *last, primitive);
  }
  std::copy(corner.begin(), corner.end(), primitive.vertices.begin());
  connect(kTriangle, primitive);
  return 3;
}

int box(const std::array<Vertex, 8>& corner, Primitive& primitive) {
  const Vec size = vec(corner[7]) - vec(corner[0]);
  const bool thin[] = {size.x == 0, size.y == 0, size.z == 0};
  if (thin[0] + thin[1] + thin[2] > 1) return segment(corner[0], corner[7], primitive);
  for (int axis = 0; axis < 3; ++axis) {
    if (!thin[axis]) continue;
    const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    primitive.vertices = {corner[0], corner[u], corner[u | v], corner[v]};
    connect(kQuad, primitive);
    primitive.level.view.planes = kQuadPlanes[axis];
    return 4;
  }
  primitive.vertices = corner;
  connect(kBox, primitive);
  primitive.level.view.planes = kPlanes;
  return 8;
}

/// The points that define a primitive, in the user's order; of a box all eight corners.
struct Named {
  int count = 0;
  std::array<Vertex, 8> points;
  bool is_legal = true;
  double extent = 0;  ///< largest absolute coordinate
};
Named named(const Body& body) {
  Named n;
  const bool is_box = body.kind() == BodyKind::Box;
  n.count = body.kind() == BodyKind::Point ? 1 : body.kind() == BodyKind::Segment ? 2 : is_box ? 8 : 3;
  if (is_box) {
    const Vec least = vec(body.corner(0)), most = vec(body.corner(1));
    for (unsigned i = 0; i < 8; ++i)
      n.points[i] = {i & 1 ? most.x : least.x, i & 2 ? most.y : least.y, i & 4 ? most.z : least.z, 0, 0};
    n.is_legal = least.x <= most.x && least.y <= most.y && least.z <= most.z;
  } else {
    for (int i = 0; i < n.count; ++i) {
      const Vec p = vec(body.corner(i));
      n.points[std::size_t(i)] = {p.x, p.y, p.z, 0, 0};
    }
  }
  for (int i = 0; i < n.count; ++i) {
    const Vertex& v = n.points[std::size_t(i)];
    n.is_legal = n.is_legal && is_legal_coordinate(v.x) && is_legal_coordinate(v.y) && is_legal_coordinate(v.z);
    n.extent = max(n.extent, max_abs(vec(v)));
  }
  return n;
}

}  // namespace

Body without_radius(const Body& body) {
  switch (body.kind()) {
    case BodyKind::Model: return Body(*body.model());
    case BodyKind::Point: return Body::point(body.corner(0));
    case BodyKind::Segment: return Body::segment(body.corner(0), body.corner(1));
    case BodyKind::Triangle: return Body::triangle(body.corner(0), body.corner(1), body.corner(2));
    case BodyKind::Box: return Body::box(body.corner(0), body.corner(1));
  }
  return body;
}

Box box_of(std::span<const Vertex> vertices) {
  Box box{vec(vertices[0]), vec(vertices[0])};
  for (const Vertex& v : vertices) {
    box.least = {min(box.least.x, v.x), min(box.least.y, v.y), min(box.least.z, v.z)};
    box.most = {max(box.most.x, v.x), max(box.most.y, v.y), max(box.most.z, v.z)};
  }
  return box;
}

Primitive::Primitive(const Body& body) {
  const Named given = named(body);
  ConvexView& view = level.view;
  view.extent = given.extent;
  is_legal = given.is_legal && (view.extent == 0 || view.extent >= kLeastExtent);
  if (!is_legal) return;

  const std::array<Vertex, 8>& p = given.points;
  const int count = given.count == 8   ? box(p, *this)
                    : given.count == 3 ? triangle({p[0], p[1], p[2]}, *this)
                                       : segment(p[0], p[std::size_t(given.count - 1)], *this);
  view.vertices = std::span(vertices).first(std::size_t(count));
  const auto [least, most] = box_of(view.vertices);
  const auto corner = [&](std::size_t k) { return vec(vertices[k]); };
  const Vec centre = count == 1   ? least
                     : count == 3 ? corner(0) * (1.0 / 3) + corner(1) * (1.0 / 3) + corner(2) * (1.0 / 3)
                                  : least * 0.5 + most * 0.5;  // a point of the body
  view.centre = eigen(centre);
  radius = 0;
  for (const Vertex& v : view.vertices) radius = max(radius, norm(vec(v) - centre) * (1 + 8 * kU));
  view.reach = 2 * radius;
  if (given.count == 8) {
    const Vec below = centre - least, above = most - centre;  // exact sides of a box, each rounded once
    view.inner_radius = min(min(min(below.x, below.y), below.z), min(min(above.x, above.y), above.z)) * (1 - 4 * kU);
  }
}

Vec Shape::size() const {
  if (model_) return vec(model_->box_max()) - vec(model_->box_min());
  const Box box = box_of(levels_->view.vertices);
  return box.most - box.least;
}

std::uint32_t source_vertex(const Body& body, const Shape& shape, std::uint32_t vertex) {
  if (shape.model()) {
    const std::span<const std::uint32_t> ids = shape.model()->source().vertex;
    return ids.empty() ? vertex : ids[vertex];
  }
  const Named given = named(body);
  const Vec v = vec(shape.level(0).view.vertices[vertex]);
  const auto differs = [&](const Vertex& w) { return w.x != v.x || w.y != v.y || w.z != v.z; };
  std::uint32_t name = 0;
  while (differs(given.points[name])) ++name;
  return name;
}

}  // namespace swiftlet
