// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Models from hand-written arrays: what is accepted, what is refused and in which words, and what the views then hold.
#include <swiftlet/check.h>
#include <swiftlet/model.h>
#include <swiftlet/model_file.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "body/half_edge.h"
#include "body/support_map.h"
#include "numeric/exact.h"

namespace swiftlet {
namespace {

using namespace bodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 at(const Vertex& v) { return {v.x, v.y, v.z}; }
Vec3 at(const ConvexView& view, std::uint32_t v) { return at(view.vertices[v]); }

/// A seeded unit quaternion's rotation.
class Turns {
 public:
  explicit Turns(std::uint64_t seed) : engine_(seed) {}
  Mat3 operator()() { return rotation(normal_(engine_), normal_(engine_), normal_(engine_), normal_(engine_)); }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

Polyhedron meshed_cube(std::uint32_t cells) {
  // Grid points of the surface by their coordinates' number, quads as two triangles each.
  Polyhedron b;
  const std::uint32_t n = cells + 1;
  std::vector<std::uint32_t> id(n * n * n, kNone);
  const auto point = [&](std::array<std::uint32_t, 3> c) {
    std::uint32_t& known = id[(c[0] * n + c[1]) * n + c[2]];
    if (known == kNone) {
      known = std::uint32_t(b.points.size());
      b.points.emplace_back(2.0 * c[0] / cells - 1, 2.0 * c[1] / cells - 1, 2.0 * c[2] / cells - 1);
    }
    return known;
  };
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t axis = side / 2, u = (axis + 1 + side % 2) % 3, v = (axis + 2 - side % 2) % 3;
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (std::uint32_t j = 0; j < cells; ++j) {
        std::array<std::uint32_t, 4> q{};
        for (std::uint32_t k = 0; k < 4; ++k) {
          std::array<std::uint32_t, 3> c{};
          c[axis] = side % 2 ? 0 : cells;
          c[u] = i + (k == 1 || k == 2);
          c[v] = j + (k >= 2);
          q[k] = point(c);
        }
        b.add({q[0], q[1], q[2]});
        b.add({q[0], q[2], q[3]});
      }
    }
  }
  return b;
}

/// Whether an edge of the body from `tail` to `head` has a face on its left.
bool is_side(const ConvexView& v, std::uint32_t face, std::uint32_t tail, std::uint32_t head) {
  for (const HalfEdge& h : v.half_edges) {
    const HalfEdge& back = v.half_edges[h.twin];
    if (h.face == face && h.head == head && back.head == tail) return back.face != face;
  }
  return false;
}

/// The invariants of every view, whatever the body.
void expect_sound(const Model& model) {
  for (int i = 0; i < model.level_count(); ++i) {
    const ConvexView& v = model.level(i).view;
    double extent = 0;
    for (const Vertex& p : v.vertices) extent = std::max(extent, at(p).cwiseAbs().maxCoeff());
    EXPECT_EQ(v.extent, extent);
    if (model.dimension() < 2) continue;
    // Euler, with and without diagonals.
    std::size_t diagonals = 0;
    for (std::uint32_t h = 0; h < v.half_edges.size(); ++h) diagonals += is_diagonal(v, h);
    EXPECT_EQ(v.vertices.size() + v.face_first.size(), (v.half_edges.size() - diagonals) / 2 + 2);
    EXPECT_EQ(model.level(i).edge_count, (v.half_edges.size() - diagonals) / 2);
    EXPECT_EQ(model.level(i).triangle_count, 2 * v.vertices.size() - 4);
    std::vector<std::size_t> sides(v.face_first.size(), 0);
    for (std::uint32_t h = 0; h < v.half_edges.size(); ++h) {
      const auto& [head, twin, face] = v.half_edges[h];
      EXPECT_EQ(v.half_edges[twin].twin, h);
      if (is_diagonal(v, h)) continue;
      ++sides[face];
      EXPECT_EQ(v.half_edges[next_in_face(v, h)].face, face);
      EXPECT_EQ(origin(v, next_in_face(v, h)), head);
    }
    for (std::uint32_t f = 0; f < sides.size(); ++f) {
      std::vector<std::uint32_t> loop;
      for (const std::uint32_t vertex : FaceLoop(v, f)) loop.push_back(vertex);
      EXPECT_EQ(loop.size(), sides[f]);
      for (std::size_t k = 0; k < loop.size(); ++k) EXPECT_TRUE(is_side(v, f, loop[k], loop[(k + 1) % loop.size()])) << f;
      EXPECT_EQ(v.half_edges[v.face_first[f]].face, f);
      EXPECT_GE(sides[f], 3u);
      EXPECT_TRUE(sides[f] == 3 || f < v.planes.size());
    }
    // Rings: the left face of a half-edge lies between it and the next one, seen from outside.
    for (std::uint32_t p = 0; p < v.vertices.size(); ++p) {
      const Vertex& ring = v.vertices[p];
      for (std::uint32_t k = 0; k < ring.ring_count; ++k) {
        const std::uint32_t h = ring.ring_begin + k, next = ring.ring_begin + (k + 1) % ring.ring_count;
        EXPECT_EQ(origin(v, h), p);
        EXPECT_EQ(v.half_edges[h].face, right_face(v, next));
        if (model.dimension() != 3) continue;
        const Vertex &here = v.vertices[v.half_edges[h].head], &there = v.vertices[v.half_edges[next].head];
        for (const Vertex& other : v.vertices) EXPECT_LE(exact::orientation(ring, here, there, other), 0);
      }
    }
    for (std::size_t f = 0; f < v.planes.size(); ++f) {
      const Vec3 n(v.planes[f].x, v.planes[f].y, v.planes[f].z);
      EXPECT_NEAR(n.norm(), 1, 1e-15);
      const Vec3 o = at(v, origin(v, v.face_first[f]));
      for (const Vertex& p : v.vertices) EXPECT_LE(n.dot(at(p) - o), model.dimension() == 3 ? v.planes[f].thickness : 1e-15);
    }
  }
  if (const Check c = verify(model); !c) ADD_FAILURE() << c.message;
}

void expect_counts(const Model& m, std::size_t vertices, std::size_t edges, std::size_t faces) {
  EXPECT_EQ(m.level(0).view.vertices.size(), vertices);
  EXPECT_EQ(m.level(0).edge_count, edges);
  EXPECT_EQ(m.level(0).view.face_first.size(), faces);
}

std::string refusal(const Polyhedron& body, ErrorCode code, bool repair = false) {
  const Result<Model> m = Model::from_level(body.level(), {repair, {}});
  if (m) {
    ADD_FAILURE() << "accepted";
    return "";
  }
  EXPECT_EQ(m.error().code, code) << m.error().message;
  return m.error().message;
}
void expect_says(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

// ---- Solids ----------------------------------------------------------------------------------------------------------------

TEST(Model, CubeOfQuadsHasItsSixFaces) {
  const Model m = model(cube());
  expect_sound(m);
  expect_counts(m, 8, 12, 6);
  EXPECT_EQ(m.level(0).view.half_edges.size(), 24u);
  EXPECT_EQ(m.level(0).view.planes.size(), 6u);
  EXPECT_EQ(m.dimension(), 3);
  EXPECT_EQ(m.volume(), 8);
  EXPECT_EQ(m.centre(), Vec3(0, 0, 0));
  EXPECT_EQ(m.box_min(), Vec3(-1, -1, -1));
  EXPECT_EQ(m.box_max(), Vec3(1, 1, 1));
  EXPECT_GE(m.radius(), std::sqrt(3.0));
  EXPECT_LE(m.radius(), std::sqrt(3.0) * (1 + 1e-14));
}

TEST(Model, CoplanarTrianglesAreOneFaceWithoutDiagonals) {
  const Model quads = model(cube()), triangles = model(triangulated(cube()));
  expect_sound(triangles);
  expect_counts(triangles, 8, 12, 6);
  EXPECT_EQ(triangles.level(0).view.half_edges.size(), 24u);
  EXPECT_TRUE(same_elements(quads.level(0).view.half_edges, triangles.level(0).view.half_edges));
}

TEST(Model, MeshedCubeIsTheCube) {
  for (const std::uint32_t cells : {1u, 2u, 3u, 7u}) {
    const Polyhedron mesh = meshed_cube(cells);
    const Model m = model(mesh);
    expect_sound(m);
    expect_counts(m, 8, 12, 6);
    EXPECT_NEAR(m.volume(), 8, 1e-12);
    // Every vertex comes from a corner, every face holds its own triangles.
    for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(mesh.points[m.source().vertex[v]], at(m.level(0).view, v));
    for (std::uint32_t f = 0; f < 6; ++f) {
      const std::uint32_t begin = m.source().face_begin[f], end = m.source().face_begin[f + 1];
      ASSERT_EQ(end - begin, 2 * cells * cells);
      const FacePlane& n = m.level(0).view.planes[f];
      for (std::uint32_t k = begin; k < end; ++k) {
        for (int c = 0; c < 3; ++c) {
          const Vec3& p = mesh.points[mesh.corners[3 * m.source().face[k] + std::size_t(c)]];
          EXPECT_EQ(n.x * p.x() + n.y * p.y() + n.z * p.z(), 1);
        }
      }
    }
  }
}

TEST(Model, PlatonicSolidsCount) {
  const Model o = model(octahedron()), t = model(tetrahedron());
  expect_sound(o);
  expect_sound(t);
  expect_counts(o, 6, 12, 8);
  expect_counts(t, 4, 6, 4);
  EXPECT_DOUBLE_EQ(o.volume(), 4.0 / 3);
  EXPECT_DOUBLE_EQ(t.volume(), 8.0 / 3);
  EXPECT_TRUE(o.level(0).view.planes.empty());  // triangles carry none
}

TEST(Model, RotatedCubesOfQuadsNeedNoRepair) {
  Turns turn(1);
  int bent = 0;
  for (int i = 0; i < 300; ++i) {
    const Model m = model(moved(cube(), turn()));
    if (i < 30) expect_sound(m);
    expect_counts(m, 8, 12, 6);
    EXPECT_NEAR(m.volume(), 8, 1e-14);
    bent += m.level(0).view.half_edges.size() > 24;  // a diagonal stays where the rounded quad folds
  }
  EXPECT_GE(bent, 200);
}

TEST(Model, RotatedCubesOfTrianglesAreRepaired) {
  Turns turn(2);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const Polyhedron b = moved(triangulated(cube()), turn());
    const Result<Model> strict = Model::from_level(b.level());
    refused += !strict;
    if (!strict) {
      EXPECT_EQ(strict.error().code, ErrorCode::NotConvex);
      expect_says(strict.error().message, "reflex edge (");
    }
    const Model m = model(b, {true, {}});
    if (i < 30) expect_sound(m);
    expect_counts(m, 8, 12, 6);
  }
  EXPECT_GE(refused, 200);
}

TEST(Model, FloatRoundedCubesWalkOnSixFaces) {
  Turns turn(3);
  int with_diagonals = 0;
  for (int i = 0; i < 300; ++i) {
    const Model m = model(float_rounded(moved(cube(), turn(), Vec3(0.3, 0, 0))));
    if (i < 30) expect_sound(m);
    expect_counts(m, 8, 12, 6);
    with_diagonals += m.level(0).view.half_edges.size() == 36;
    for (const FacePlane& p : m.level(0).view.planes) EXPECT_LE(p.thickness, 4 * 0x1p-23 * m.extent() + 1e-14);
  }
  EXPECT_GE(with_diagonals, 200);
}

TEST(Model, CentroidIsOfTheSurfaceNotOfTheVertices) {
  const Model m = model(moved(meshed_cube(3), Mat3::Identity(), Vec3(4, 5, 6)));
  EXPECT_TRUE(m.centre().isApprox(Vec3(4, 5, 6), 1e-15));
  // A square pyramid: base 4, sides 4 sqrt(5)/2 ... of height 2: the sides' centroid is a third up.
  Polyhedron pyramid{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 2}}, {}, {}};
  pyramid.add({0, 3, 2, 1}), pyramid.add({0, 1, 4}), pyramid.add({1, 2, 4}), pyramid.add({2, 3, 4}), pyramid.add({3, 0, 4});
  const double sides = 4 * std::sqrt(5.0);
  EXPECT_NEAR(model(pyramid).centre().z(), sides * (2.0 / 3) / (sides + 4), 1e-15);
}

// ---- Convexity -------------------------------------------------------------------------------------------------------------

/// The cube with vertex 6 lowered by `drop`: the top folds along 5-7.
Polyhedron dented(double drop) {
  Polyhedron b = cube();
  b.points[6].z() -= drop;
  return b;
}

TEST(Model, ReflexEdgeIsNamedWithItsHeight) {
  const std::string message = refusal(triangulated(dented(0.25)), ErrorCode::NotConvex);  // fanned along 4-6
  expect_says(message, "reflex edge (");
  EXPECT_TRUE(message.find("(4, 6)") != std::string::npos || message.find("(6, 4)") != std::string::npos) << message;
  // Vertex 7 (or 5) above the plane through 4, 6 and 5 (or 7): a drop of h tilts it to x h/2 = z - 1 at distance 2.
  const Vec3 n = Vec3(2, 0, 0).cross(Vec3(2, 2, -0.25)), up = Vec3(0, 2, 0);
  char height[32];
  std::snprintf(height, sizeof height, "%.3g", n.dot(up) / n.norm());
  expect_says(message, height);
}

TEST(Model, RepairFlipsTheDiagonalToTheConvexOne) {
  const Model m = model(triangulated(dented(0.25)), {true, {}});
  expect_sound(m);
  expect_counts(m, 8, 13, 7);
  EXPECT_NEAR(m.volume(), 8 - 0.25 * 2 / 3, 1e-14);  // less a tetrahedron of base 2 and height 0.25
}

TEST(Model, APolygonsOwnDiagonalsFlipFreely) {
  const Model m = model(dented(0.25));
  expect_sound(m);
  expect_counts(m, 8, 13, 7);
  EXPECT_NEAR(m.volume(), 8 - 0.25 * 2 / 3, 1e-14);
}

TEST(Model, FoldsBeyondRoundingAreTwoFaces) {
  expect_counts(model(dented(0x1p-30)), 8, 13, 7);  // far above an ulp of double, within one of float
  expect_counts(model(dented(0x1p-50)), 8, 12, 6);
  expect_counts(model(float_rounded(dented(0x1p-23))), 8, 12, 6);
  expect_counts(model(float_rounded(dented(0x1p-20))), 8, 13, 7);
}

TEST(Model, RepairDoesNotMakeDentsConvex) {
  // A pyramid into the top face: no flip helps.
  Polyhedron b = cube();
  b.points.emplace_back(0, 0, 0.5);
  b.corners.erase(b.corners.begin() + 4, b.corners.begin() + 8);
  b.sizes.pop_back();
  b.add({4, 5, 8}), b.add({5, 6, 8}), b.add({6, 7, 8}), b.add({7, 4, 8});
  for (const bool repair : {false, true}) refusal(b, ErrorCode::NotConvex, repair);
  b.points[8].z() = 1.5;  // out of it: a roof
  EXPECT_EQ(model(b).level(0).view.vertices.size(), 9u);
}

TEST(Model, SurfaceMustCloseOnce) {
  Polyhedron open = cube();
  open.sizes.pop_back();
  open.corners.resize(20);
  expect_says(refusal(open, ErrorCode::NotConvex), "belongs to 1 faces, not 2");

  Polyhedron twice = octahedron();
  twice.add({0, 2, 4});
  expect_says(refusal(twice, ErrorCode::NotConvex), "faces, not 2");

  Polyhedron apart = cube();
  const Polyhedron other = moved(cube(), Mat3::Identity(), Vec3(5, 0, 0));
  apart.points.insert(apart.points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t v : other.corners) apart.corners.push_back(v + 8);
  apart.sizes.insert(apart.sizes.end(), other.sizes.begin(), other.sizes.end());
  expect_says(refusal(apart, ErrorCode::NotConvex), "do not close to one sphere");

  // Two tetrahedra that share a vertex.
  Polyhedron pinched = tetrahedron();
  for (const Vec3& p : {Vec3(5, 1, 1), Vec3(5, 3, 1), Vec3(5, 1, 3)}) pinched.points.push_back(p);
  pinched.add({0, 4, 5}), pinched.add({0, 5, 6}), pinched.add({0, 6, 4}), pinched.add({4, 6, 5});
  expect_says(refusal(pinched, ErrorCode::NotConvex), "form 2 fans");
}

TEST(Model, WindingIsCounterClockwiseFromOutside) {
  Polyhedron inside_out = cube();
  std::reverse(inside_out.corners.begin(), inside_out.corners.end());
  refusal(inside_out, ErrorCode::NotConvex);
  refusal(inside_out, ErrorCode::NotConvex, true);
  Polyhedron one = cube();
  std::reverse(one.corners.begin(), one.corners.begin() + 4);
  expect_says(refusal(one, ErrorCode::NotConvex), "wound against each other");
}

TEST(Model, SurfaceWoundTwiceIsRefused) {
  // A bipyramid over the pentagram: nowhere reflex, Euler holds, and yet twice around.
  for (const int step : {1, 2}) {
    Polyhedron b{{{0, 0, 1}, {0, 0, -1}}, {}, {}};
    for (int i = 0; i < 5; ++i) {
      const double angle = 2 * std::numbers::pi * step * i / 5;
      b.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    for (std::uint32_t i = 0; i < 5; ++i) {
      const std::uint32_t p = 2 + i, q = 2 + (i + 1) % 5;
      b.add({p, q, 0}), b.add({q, p, 1});
    }
    if (step == 1)
      expect_counts(model(b), 7, 15, 10);
    else
      expect_says(refusal(b, ErrorCode::NotConvex), "winds about itself 2 times");
  }
}

TEST(Model, DegenerateFacesAreRefused) {
  Polyhedron repeated = cube();
  repeated.add({0, 0, 1});
  expect_says(refusal(repeated, ErrorCode::NotConvex), "face 6 is degenerate");
  Polyhedron collinear = octahedron();
  collinear.points.emplace_back(0.5, 0.5, 0);
  collinear.add({0, 6, 2});
  expect_says(refusal(collinear, ErrorCode::NotConvex), "face 8 is degenerate");
  Polyhedron flat = triangulated(cube());  // a box without height
  for (Vec3& p : flat.points) p.z() = 0;
  refusal(flat, ErrorCode::NotConvex);
}

TEST(Model, ASolidHasVolume) {
  // Four points of a square as a tetrahedron: closed, nowhere reflex, no vertex above a face, and every facet in one plane.
  Polyhedron flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}, {}};
  flat.add({0, 2, 1}), flat.add({0, 1, 3}), flat.add({1, 2, 3}), flat.add({0, 3, 2});
  expect_says(refusal(flat, ErrorCode::NotSolid), "all vertices lie in one plane");
  for (Vec3& p : flat.points) p = rotation(1, 2, 3, 4) * (p + Vec3(0.1, 0.2, 0.3));  // rounded, it has a volume or a dent
  const Result<Model> rounded = Model::from_level(flat.level());
  EXPECT_TRUE(!rounded || verify(rounded.value()));
  // The sides of a pentagon, each cut otherwise.
  Polyhedron sheets{{{0, 0, 1}, {4, 0, 1}, {5, 3, 1}, {2, 6, 1}, {-1, 3, 1}}, {}, {}};
  sheets.add({0, 1, 2}), sheets.add({0, 2, 3}), sheets.add({0, 3, 4});
  sheets.add({1, 0, 4}), sheets.add({1, 4, 3}), sheets.add({1, 3, 2});
  expect_says(refusal(sheets, ErrorCode::NotSolid), "all vertices lie in one plane");
  sheets.points[2].z() = std::nextafter(1.0, 2);  // the least volume there is
  const Result<Model> least = Model::from_level(sheets.level());
  EXPECT_TRUE(!least || verify(least.value()));
}

TEST(Model, ASurfaceWoundTwiceIsRefusedWhereRoundingHidesItsMiddle) {
  // Twice around a pyramid an ulp high: no double lies inside, and no vertex above a face.
  constexpr double kCorners[4][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const std::uint32_t turns : {1u, 2u}) {
    Polyhedron b{{{1, 1, std::nextafter(1.0, 2)}, {1, 1, 1}}, {}, {}};
    const std::uint32_t n = 4 * turns;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = 2 + i, q = 2 + (i + 1) % n;
      b.points.emplace_back(kCorners[i % 4][0], kCorners[i % 4][1], 1);
      b.add({p, q, 0}), b.add({q, p, 1});
    }
    if (turns == 1)
      EXPECT_TRUE(verify(model(b)));
    else
      expect_says(refusal(b, ErrorCode::NotConvex), "coincide");
  }
}

TEST(Model, UnreferencedVerticesAreNamed) {
  Polyhedron b = cube();
  b.points.emplace_back(0, 0, 0);
  expect_says(refusal(b, ErrorCode::BadValue), "vertex 8 belongs to no face");
}

TEST(Model, ArraysMustFit) {
  EXPECT_EQ(refusal({}, ErrorCode::Empty), "no vertices");
  Polyhedron out_of_range = octahedron();
  out_of_range.corners[4] = 6;
  expect_says(refusal(out_of_range, ErrorCode::BadValue), "face 1 names vertex 6 of 6");
  Polyhedron two_corners = octahedron();
  two_corners.sizes[2] = 2;
  expect_says(refusal(two_corners, ErrorCode::BadValue), "face 2 has 2 vertices");
  Polyhedron long_list = octahedron();
  long_list.corners.push_back(0);
  refusal(long_list, ErrorCode::BadValue);
  Polyhedron short_list = octahedron();
  short_list.corners.pop_back();
  refusal(short_list, ErrorCode::BadValue);
  Polyhedron huge = octahedron();
  huge.sizes[7] = 0xffffffff;
  refusal(huge, ErrorCode::BadValue);
  const Polyhedron o = octahedron();
  LevelArrays ragged = o.level();
  ragged.face_sizes = {};
  EXPECT_TRUE(Model::from_level(ragged));
  ragged.face_vertices = ragged.face_vertices.first(23);
  EXPECT_FALSE(Model::from_level(ragged));
}

TEST(Model, CoordinatesOutOfRangeAreNamed) {
  for (const double x : {std::nan(""), kInfinity, -kInfinity, 1e46, -1e300, 1e-71, 5e-324}) {
    Polyhedron b = cube();
    b.points[5].y() = x;
    expect_says(refusal(b, ErrorCode::BadValue), "vertex 5");
  }
  for (const double scale : {1e-18, 1e18, 0x1p-140, 0x1p140}) {
    Polyhedron b = octahedron();
    for (Vec3& p : b.points) p *= scale;
    expect_sound(model(b));
  }
  Polyhedron tiny = octahedron();
  for (Vec3& p : tiny.points) p *= 1e-50;
  expect_says(refusal(tiny, ErrorCode::BadValue), "the body's extent is 1e-50, below the limit of 1e-45");
}

// ---- Flatter bodies --------------------------------------------------------------------------------------------------------

TEST(Model, FlatPolygonsHaveTwoSides) {
  const Model square = model(two_sided({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}})),
              triangle = model(two_sided({{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
  expect_sound(square);
  expect_sound(triangle);
  expect_counts(square, 4, 4, 2);
  expect_counts(triangle, 3, 3, 2);
  EXPECT_EQ(square.dimension(), 2);
  EXPECT_EQ(square.volume(), 0);
  EXPECT_TRUE(square.centre().isApprox(Vec3(1, 1, 0), 1e-15));
  for (const Vertex& v : square.level(0).view.vertices) EXPECT_EQ(v.ring_count, 2u);
  expect_says(refusal(two_sided({{0, 0, 0}, {2, 0, 0}, {2, 2, 1e-300}, {0, 2, 0}}), ErrorCode::BadValue), "vertex 2");
  expect_says(refusal(two_sided({{0, 0, 0}, {2, 0, 0}, {2, 2, 1e-60}, {0, 2, 0}}), ErrorCode::NotConvex), "not flat");
  expect_says(refusal(two_sided({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}), ErrorCode::NotConvex),
              "not strictly convex");
  expect_says(refusal(two_sided({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}), ErrorCode::NotConvex), "not strictly convex");
  refusal(two_sided({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), ErrorCode::NotConvex);
}

TEST(Model, SegmentsAndPointsHaveNoFaces) {
  const Model s = model(segment({0, 0, 0}, {3, 4, 0})), p = model(point({1, 2, 3}));
  expect_sound(s);
  expect_sound(p);
  EXPECT_EQ(s.dimension(), 1);
  EXPECT_EQ(p.dimension(), 0);
  expect_counts(s, 2, 1, 0);
  expect_counts(p, 1, 0, 0);
  EXPECT_EQ(s.centre(), Vec3(1.5, 2, 0));
  EXPECT_NEAR(s.radius(), 2.5, 1e-14);
  EXPECT_EQ(p.radius(), 0);
  EXPECT_EQ(s.level(0).view.half_edges[0].face, kNone);
  refusal(segment({1, 1, 1}, {1, 1, 1}), ErrorCode::BadValue);
  refusal({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {}}, ErrorCode::BadValue);
}

// ---- Levels ----------------------------------------------------------------------------------------------------------------

Result<Model> levels(std::initializer_list<Polyhedron> bodies) {
  std::vector<Polyhedron> owned(bodies);
  std::vector<LevelArrays> arrays;
  for (const Polyhedron& b : owned) arrays.push_back(b.level());
  return Model::from_levels(arrays);
}

TEST(Model, DeviationsAreTheLargestDistances) {
  const Model m = nested();
  expect_sound(m);
  ASSERT_EQ(m.level_count(), 3);
  EXPECT_EQ(m.level(0).deviation, 0);
  const double truth[] = {0, 2 / std::sqrt(3.0), 8 / std::sqrt(3.0)};
  for (int i = 1; i < 3; ++i) {
    EXPECT_GE(m.level(i).deviation, truth[i]);
    EXPECT_LE(m.level(i).deviation, truth[i] * 1.01);
  }
  EXPECT_EQ(m.extent(), 3);
  EXPECT_EQ(m.level(1).volume, 8);
}

TEST(Model, LinksNameFeaturesOfTheNeighbourLevel) {
  const Model m = nested();
  for (int i = 0; i < 3; ++i) {
    const Level& level = m.level(i);
    const std::size_t faces = level.view.face_first.size();
    ASSERT_EQ(level.child_vertex.size(), i == 0 ? 0 : level.view.vertices.size());
    ASSERT_EQ(level.child_face.size(), i == 0 ? 0 : faces);
    ASSERT_EQ(level.parent_face.size(), i == 2 ? 0 : faces);
    if (i > 0) {  // the nearest vertex, by brute force
      const ConvexView& finer = m.level(i - 1).view;
      for (std::uint32_t v = 0; v < level.view.vertices.size(); ++v) {
        double nearest = kInfinity;
        for (const Vertex& w : finer.vertices) nearest = std::min(nearest, (at(w) - at(level.view, v)).norm());
        ASSERT_LT(level.child_vertex[v], finer.vertices.size());
        EXPECT_EQ((at(finer, level.child_vertex[v]) - at(level.view, v)).norm(), nearest);
      }
      for (const FeatureId h : level.child_face) {
        const bool face = h.kind() == FeatureKind::Face;
        EXPECT_TRUE(face || h.kind() == FeatureKind::Vertex);
        EXPECT_LT(h.index(), face ? finer.face_first.size() : finer.vertices.size());
      }
    }
    if (i < 2) {  // an extremal vertex along the face's normal, by brute force
      const ConvexView& coarser = m.level(i + 1).view;
      for (std::uint32_t f = 0; f < faces; ++f) {
        const std::uint32_t h = level.view.face_first[f];
        const auto head = [&](std::uint32_t of) { return at(level.view, level.view.half_edges[of].head); };
        const Vec3 p = at(level.view, origin(level.view, h)), q = head(h);
        const Vec3 n = (q - p).cross(head(next_in_face(level.view, h)) - q);
        ASSERT_LT(level.parent_face[f], coarser.vertices.size());
        for (const Vertex& w : coarser.vertices) EXPECT_LE(n.dot(at(w)), n.dot(at(coarser, level.parent_face[f])));
      }
    }
  }
}

TEST(Model, ALevelThatMissesLevelZeroByAnUlpIsRefused) {
  const double inside = std::nextafter(1, 0);
  EXPECT_TRUE(levels({octahedron(), box(1, 1, 1)}));
  const Result<Model> m = levels({octahedron(), box(1, inside, 1)});
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, ErrorCode::NotEnclosing);
  expect_says(m.error().message, "level 1: vertex ");
  EXPECT_TRUE(m.error().message.find("vertex 2 ") != std::string::npos ||
              m.error().message.find("vertex 3 ") != std::string::npos);
  // Each level against level 0, not against the one before: the last need not hold the middle one.
  EXPECT_TRUE(levels({octahedron(), box(2, 2, 2), box(1, 1, 1)}));
  EXPECT_EQ(levels({octahedron(), cube(), box(1, 1, inside)}).error().code, ErrorCode::NotEnclosing);
}

TEST(Model, ALevelGivenTwiceIsItsOwnChild) {
  const Model m = must(levels({cube(), cube()}));
  expect_sound(m);
  EXPECT_LE(m.level(1).deviation, 1e-14);
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(m.level(1).child_vertex[v], v);
  for (std::uint32_t f = 0; f < 6; ++f) EXPECT_EQ(m.level(1).child_face[f], FeatureId(FeatureKind::Face, f));
}

TEST(Model, ChildrenCanBeGiven) {
  const Polyhedron fine = octahedron(), coarse = cube();
  std::vector<std::uint32_t> child(8, 4), child_of_face(6, 5);
  LevelArrays arrays[] = {fine.level(), coarse.level()};
  arrays[1].child_vertex = child;
  arrays[1].child_of_face = child_of_face;
  const Model m = must(Model::from_levels(arrays));
  const auto source = [&](std::uint32_t v) { return m.source().vertex[v]; };
  for (const std::uint32_t c : m.level(1).child_vertex) EXPECT_EQ(source(c), 4u);
  for (const FeatureId c : m.level(1).child_face) EXPECT_EQ(source(c.index()), 5u);
  child_of_face[2] = 6;
  const Result<Model> none = Model::from_levels(arrays);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::BadValue);
  EXPECT_EQ(none.error().message, "level 1: face 2 has the child 6, no vertex of the finer level");
  child_of_face[2] = 5;
  child[3] = 6;
  const Result<Model> bad = Model::from_levels(arrays);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::BadValue);
  for (const std::size_t wrong : {7, 9}) {
    child.assign(wrong, 4), arrays[1].child_vertex = child;
    EXPECT_EQ(Model::from_levels(arrays).error().message,
              "level 1: child_vertex has " + std::to_string(wrong) + " entries for 8 vertices");
  }
  arrays[1].child_vertex = {};
  for (const std::size_t wrong : {5, 7}) {
    child_of_face.assign(wrong, 5), arrays[1].child_of_face = child_of_face;
    EXPECT_EQ(Model::from_levels(arrays).error().message,
              "level 1: child_of_face has " + std::to_string(wrong) + " entries for 6 faces");
  }
}

TEST(Model, OnlySolidsHaveCoarserLevels) {
  const Polyhedron square = two_sided({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_EQ(levels({square, box(2, 2, 2)}).error().code, ErrorCode::NotSolid);
  EXPECT_EQ(levels({octahedron(), square}).error().code, ErrorCode::NotSolid);
  EXPECT_EQ(Model::from_levels({}).error().code, ErrorCode::Empty);
  const Polyhedron b = cube();
  EXPECT_EQ(Model::from_levels(std::vector<LevelArrays>(33, b.level())).error().code, ErrorCode::TooLarge);
  EXPECT_EQ(must(Model::from_levels(std::vector<LevelArrays>(32, b.level()))).level_count(), 32);
}

// ---- Sources, tables, supports, scale --------------------------------------------------------------------------------------

TEST(Model, SourceIdsAreTheUsers) {
  const Polyhedron b = triangulated(cube());
  std::vector<std::uint32_t> vertex(8), begin{0}, faces;
  for (std::uint32_t v = 0; v < 8; ++v) vertex[v] = 100 + v;
  for (std::uint32_t f = 0; f < 12; ++f) {  // triangle f stands for f % 3 of the user's
    for (std::uint32_t k = 0; k < f % 3; ++k) faces.push_back(1000 + 10 * f + k);
    begin.push_back(std::uint32_t(faces.size()));
  }
  LevelArrays arrays = b.level();
  arrays.vertex_source = vertex;
  arrays.face_source_begin = begin;
  arrays.face_source = faces;
  const Model m = must(Model::from_level(arrays));
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(b.points[m.source().vertex[v] - 100], at(m.level(0).view, v));
  std::multiset<std::uint32_t> all(m.source().face.begin(), m.source().face.end());
  EXPECT_EQ(all, std::multiset<std::uint32_t>(faces.begin(), faces.end()));
  for (std::uint32_t f = 0; f < 6; ++f) {
    const FacePlane& n = m.level(0).view.planes[f];
    for (std::uint32_t k = m.source().face_begin[f]; k < m.source().face_begin[f + 1]; ++k) {
      const std::uint32_t given = (m.source().face[k] - 1000) / 10;
      const Vec3& p = b.points[b.corners[3 * given]];
      EXPECT_EQ(n.x * p.x() + n.y * p.y() + n.z * p.z(), 1);
    }
  }
  begin.back() += 1;
  EXPECT_EQ(Model::from_level(arrays).error().code, ErrorCode::BadValue);
  begin.back() -= 1;
  std::swap(begin[4], begin[6]);
  EXPECT_EQ(Model::from_level(arrays).error().code, ErrorCode::BadValue);
  std::swap(begin[4], begin[6]);
  begin[0] = begin[1] = begin[2];  // the first id would be of no face
  EXPECT_EQ(Model::from_level(arrays).error().code, ErrorCode::BadValue);
  begin[0] = begin[1] = 0;
  vertex.pop_back();
  arrays.vertex_source = vertex;
  EXPECT_EQ(Model::from_level(arrays).error().code, ErrorCode::BadValue);
}

TEST(Model, TableHoldsTheNearestVertexPerSample) {
  const Polyhedron b = moved(octahedron(), rotation(1, 2, 3, 4), Vec3(7, 8, 9));
  for (const lut::Resolution r :
       {lut::Resolution::None, lut::Resolution::Degrees22, lut::Resolution::Degrees11, lut::Resolution::Degrees5}) {
    for (const double factor : {1.0, 2.0, 50.0}) {
      const Model m = model(b, {false, {r, factor}});
      EXPECT_EQ(m.table_spec().resolution, r);
      EXPECT_EQ(m.table_spec().radius_factor, factor);
      ASSERT_EQ(m.table().size(), lut::sample_count(r));
      for (std::uint32_t i = 0; i < m.table().size(); ++i) {
        const auto d = lut::sample(r, i);
        const Vec3 sample = m.centre() + factor * m.radius() * Vec3(d[0], d[1], d[2]);
        double nearest = kInfinity;
        for (const Vertex& v : m.level(0).view.vertices) nearest = std::min(nearest, (at(v) - sample).norm());
        EXPECT_NEAR((at(m.level(0).view, m.table()[i]) - sample).norm(), nearest, 1e-13 * factor);
      }
      // The same levels with another table are the model built with it, bit for bit.
      EXPECT_EQ(model(b).with_table({r, factor}).value().hash(), m.hash());
      EXPECT_EQ(bytes_of(model(b).with_table({r, factor}).value()), bytes_of(m));
      const TableSpec without_maps{r, factor, 0};
      EXPECT_EQ(m.with_table(without_maps).value().hash(), model(b, {false, without_maps}).hash());
    }
  }
  for (const double factor : {0.99, -1.0, 1e7, kInfinity, std::nan("")}) {
    EXPECT_EQ(Model::from_level(b.level(), {false, {lut::Resolution::Degrees22, factor}}).error().code, ErrorCode::BadValue);
  }
}

/// The heights of all vertices in long doubles, beside what the map of each level promises.
TEST(Model, SupportMapsBoundEveryDirection) {
  std::mt19937_64 engine(6);
  std::normal_distribution<double> draw;
  using Real = long double;
  const auto height = [](const Vec3& d, const Vertex& v) { return Real(d.x()) * v.x + Real(d.y()) * v.y + Real(d.z()) * v.z; };
  int exact = 0, loose = 0;
  for (const Model& m : {nested(), model(moved(octahedron(), rotation(1, 2, 3, 4))), model(segment({0, 0, 0}, {1, 0, 0})),
                         model(point({1, 1, 1})), model(cube(), {false, {lut::Resolution::None, 2, 64}})}) {
    ASSERT_EQ(m.map_level(), 0);
    for (int k = 0; k < m.level_count(); ++k) {
      const Level& level = m.level(k);
      ASSERT_EQ(level.support_map.size(), 2 * level.map_side * level.map_side);
      for (int i = 0; i < 2000; ++i) {
        const Vec3 d = Vec3(draw(engine), draw(engine), i % 5 ? draw(engine) : 0).normalized();
        const MapSupport s = look_up(level, vec(d));
        Real most = -kInfinity;
        for (const Vertex& v : level.view.vertices) most = std::max(most, height(d, v));
        const Real excess = most - height(d, level.view.vertices[s.vertex]);
        ASSERT_LE(excess, s.excess + kMapError * level.view.extent);
        ASSERT_LE(s.excess, 8 * level.view.extent);
        ++(excess > 0 ? loose : exact);
      }
    }
  }
  EXPECT_GE(exact, 1000);
  EXPECT_GE(loose, 50);
}

TEST(Model, AVertexInsideTheFinerLevelHasTheNearestAsItsChild) {
  const Polyhedron all[] = {moved(octahedron(), 0.1 * Mat3::Identity()), cube(), box(0.5, 0.25, 0.75)};
  const LevelArrays levels[] = {all[0].level(), all[1].level(), all[2].level()};
  const Model m = must(Model::from_levels(levels));
  for (std::size_t v = 0; v < 8; ++v) {
    const Vertex &vertex = m.level(2).view.vertices[v], &child = m.level(1).view.vertices[m.level(2).child_vertex[v]];
    EXPECT_TRUE(vertex.x * child.x > 0 && vertex.y * child.y > 0 && vertex.z * child.z > 0) << v;
  }
}

TEST(Model, VerifyFindsAMapThatPromisesTooMuch) {
  const Model good = model(moved(octahedron(), rotation(1, 2, 3, 4)));
  ASSERT_TRUE(verify(good));
  bodies::Bytes block = bodies::bytes_of(good);
  const std::size_t at = bodies::read<BlockHeader>(block, 0).maps.offset + 4 * 277;
  bodies::write(block, at, (bodies::read<std::uint32_t>(block, at) + 1) % 6);  // another vertex, and no doubt about it
  bodies::rehash(block);
  AlignedBytes copy(block.size());
  std::copy(block.begin(), block.end(), copy.data());
  const Check outcome = verify(must(BlockReader::read(std::move(copy))));
  EXPECT_FALSE(outcome);
  EXPECT_NE(outcome.message.find("cell 277"), std::string::npos) << outcome.message;
}

TEST(Model, ATableOutOfItsRangesIsRefused) {
  const Model m = nested();
  for (const TableSpec& spec : {TableSpec{lut::Resolution::None, 2, 65}, TableSpec{lut::Resolution::None, 2, ~0u},
                                TableSpec{lut::Resolution::Degrees22, 0.5}, TableSpec{lut::Resolution::None, std::nan("")},
                                TableSpec{lut::Resolution::Degrees22, 1e7}, TableSpec{lut::Resolution(4), 2}}) {
    ModelOptions options;
    options.table = spec;
    const Result<Model> given = m.with_table(spec), made = Model::from_level(cube().level(), options);
    ASSERT_TRUE(!given && !made);
    EXPECT_EQ(given.error().code, ErrorCode::BadValue);
    EXPECT_EQ(given.error().message, made.error().message);
  }
}

TEST(Model, MapsCanBeLeftOut) {
  const Polyhedron b = cube();
  EXPECT_EQ(model(b, {false, {lut::Resolution::None, 2, 0}}).map_level(), 1);
  EXPECT_TRUE(verify(model(b, {false, {lut::Resolution::None, 2, 0}})));
}

TEST(Model, SupportIsExtreme) {
  std::mt19937_64 engine(5);
  std::uniform_int_distribution<int> draw(-2, 2);
  for (const Polyhedron& b : {cube(), octahedron(), tetrahedron(), segment({0, 0, 0}, {1, 0, 0}), point({1, 1, 1})}) {
    for (const lut::Resolution r : {lut::Resolution::None, lut::Resolution::Degrees5}) {
      const Model m = model(b, {false, {r, 2}});
      for (int i = 0; i < 200; ++i) {
        const Vec3 d = Vec3(draw(engine), draw(engine), draw(engine)) * std::ldexp(1, draw(engine) * 100);
        const std::uint32_t s = m.support(d);
        for (const Vertex& v : m.level(0).view.vertices) ASSERT_LE(d.dot(at(v)), d.dot(at(m.level(0).view, s)));
      }
    }
  }
}

TEST(Model, SupportTakesAnyDirection) {
  const Model m = model(moved(cube(), rotation(1, 2, 3, 4)));
  constexpr double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 d(0.3, -0.5, 0.1);
  for (const double length : {1e-300, 1e-280, 1e300, most}) EXPECT_EQ(m.support(d * length), m.support(d)) << length;
  for (const Vec3& any : {Vec3(least, least, 0), Vec3(most, -most, most), Vec3(nan, 0, 1), Vec3(kInfinity, 0, 0), Vec3(0, 0, 0),
                          Vec3(1, least, -least)}) {
    EXPECT_LT(m.support(any), 8u);
  }
  // The far smaller coordinate still decides between the corners of a face.
  const Model c = model(cube());
  EXPECT_EQ(at(c.level(0).view, c.support({1, 1e-200, -1e-300})), Vec3(1, 1, -1));
}

TEST(Model, ScalingByAPowerOfTwoScalesBitForBit) {
  const Polyhedron o = octahedron(), c = cube();
  for (const int k : {-120, -7, 1, 100}) {
    const double s = std::ldexp(1, k);
    Polyhedron fine = moved(o, rotation(1, 2, 3, 4)), coarse = moved(c, 1.001 * rotation(1, 2, 3, 4));
    const LevelArrays plain[] = {fine.level(), coarse.level()};
    const Model m = must(Model::from_levels(plain));
    for (Polyhedron* b : {&fine, &coarse})
      for (Vec3& p : b->points) p *= s;
    const LevelArrays scaled[] = {fine.level(), coarse.level()};
    const Model n = must(Model::from_levels(scaled));
    EXPECT_EQ(n.centre(), s * m.centre());
    EXPECT_EQ(n.radius(), s * m.radius());
    EXPECT_EQ(n.level(1).deviation, s * m.level(1).deviation);
    EXPECT_EQ(n.volume(), s * s * s * m.volume());
    EXPECT_TRUE(same_elements(m.table(), n.table()));
    for (int i = 0; i < 2; ++i) {
      const Level &a = m.level(i), &b = n.level(i);
      EXPECT_TRUE(same_elements(a.view.half_edges, b.view.half_edges));
      EXPECT_TRUE(same_elements(a.child_vertex, b.child_vertex));
      EXPECT_TRUE(same_elements(a.child_face, b.child_face));
      EXPECT_TRUE(same_elements(a.parent_face, b.parent_face));
      for (std::uint32_t v = 0; v < a.view.vertices.size(); ++v) EXPECT_EQ(s * at(a.view, v), at(b.view, v));
      EXPECT_EQ(s * a.view.reach, b.view.reach);
      for (std::size_t f = 0; f < a.view.planes.size(); ++f) {
        EXPECT_EQ(s * a.view.planes[f].thickness, b.view.planes[f].thickness);
        EXPECT_EQ(s * a.view.planes[f].over, b.view.planes[f].over);
      }
    }
  }
}

TEST(Model, SameInputSameBytes) { EXPECT_EQ(bytes_of(nested()), bytes_of(nested())); }

// ---- verify ----------------------------------------------------------------------------------------------------------------

/// A block changed by hand, its hashes made right.
Model tampered(const Model& m, const std::function<void(Bytes&)>& change) {
  Bytes block = bytes_of(m);
  change(block);
  rehash(block);
  return must(load(block));
}

TEST(Model, PolygonsThatGoAroundTwiceAreRefused) {
  const auto loop = [](int n, int step) {
    std::vector<Vec3> corners;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i * step / n;
      corners.push_back({std::cos(angle), std::sin(angle), 0});
    }
    return two_sided(corners);
  };
  EXPECT_EQ(model(loop(7, 1)).dimension(), 2);
  for (const int step : {2, 3}) refusal(loop(7, step), ErrorCode::NotConvex);
  const std::vector<Vec3> dented{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}};
  refusal(two_sided(dented), ErrorCode::NotConvex);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(model(loop(100000, 1)).dimension(), 2);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));  // minutes where every pair is looked at
}

TEST(Model, OfEdgesWithoutFacesIsRefused) {
  const auto append = [](std::vector<std::byte>& to, const auto& from) {
    const auto bytes = std::as_bytes(std::span(from));
    to.insert(to.end(), bytes.begin(), bytes.end());
  };
  const auto message = [](const BlockParts& parts) {
    const AlignedBytes block = compose(parts);
    const Result<Model> loaded = load(block.view());
    return loaded ? std::string() : loaded.error().message;
  };
  const Model octahedron = nested(1, {false, {lut::Resolution::None, 2, 0}});
  const ConvexView& view = octahedron.level(0).view;
  BlockParts net = BlockReader::parts(octahedron, 0);
  std::vector<HalfEdge> edges(view.half_edges.begin(), view.half_edges.end());
  for (HalfEdge& h : edges) h.face = kNone;
  net.levels[0].clear(), net.source.clear();
  append(net.levels[0], view.vertices), append(net.levels[0], edges);
  net.level_headers[0].face_count = net.level_headers[0].plane_count = net.level_headers[0].rims = 0;
  net.header.source_face_count = 0;
  append(net.source, std::vector<std::uint32_t>(view.vertices.size() + 1, 0));
  expect_says(message(net), "no faces");

  const Model line = model(segment({0, 0, 0}, {1, 0, 0}), {false, {lut::Resolution::None, 2, 0}});
  BlockParts twice = BlockReader::parts(line, 0);
  EXPECT_EQ(message(twice), "");
  twice.level_headers.push_back(twice.level_headers[0]), twice.levels.push_back(twice.levels[0]);
  append(twice.levels[1], std::vector<std::uint32_t>(2, 0));
  expect_says(message(twice), "a level without faces has no others");
}

/// The middle cell of a map of odd side is around a pole, where a body may be higher above a vertex than at the cell's corners.
TEST(Verify, LooksAtThePoleInsideACell) {
  Polyhedron gem{
      {{1, 0, 0}, {0.8, 0.8, 0}, {0, 1, 0}, {-0.8, 0.8, 0}, {-1, 0, 0}, {-0.8, -0.8, 0}, {0, -1, 0}, {0.8, -0.8, 0}}, {}, {}};
  gem.points.emplace_back(0, 0, 1), gem.points.emplace_back(0, 0, -1);
  for (std::uint32_t k = 0; k < 8; ++k) gem.add({k, (k + 1) % 8, 8}), gem.add({(k + 1) % 8, k, 9});
  const Model m = model(gem, {false, {lut::Resolution::None, 2, 64}});
  const std::uint32_t side = m.level(0).map_side;
  ASSERT_EQ(side % 2, 1u);
  for (std::uint32_t v = 0; v < 10; ++v) {
    const auto forged = [&](std::uint32_t excess) {
      return tampered(m, [&](Bytes& block) {
        auto header = read<BlockHeader>(block, 0);
        auto level = read<LevelHeader>(block, level_header_at(0));
        // So that an entry has an excess between what is needed at the corners and at the pole.
        for (float& x : level.map_frame) x *= 1.025f;
        header.scale_inside *= 0.9;
        write(block, 0, header), write(block, level_header_at(0), level);
        write(block, std::size_t(header.maps.offset) + 4 * (side * side / 2), excess << 24 | v);
      });
    };
    std::uint32_t excess = 0;
    while (excess < 255 && !verify(forged(excess))) ++excess;
    const Model verified = forged(excess);
    ASSERT_TRUE(verify(verified)) << v;
    const Level& level = verified.level(0);
    const Vec pole = from_map(level.map_frame, {0, 0, 1});
    double most = -kInfinity;
    for (const Vertex& top : level.view.vertices) most = std::max(most, dot(pole, vec(top)));
    EXPECT_LE(most - dot(pole, vec(level.view.vertices[v])), look_up(level, pole).excess) << v;
  }
}

TEST(Verify, FindsWhatTheHashesCannot) {
  const Model m = nested();
  const auto vertex_at = [](const Bytes& block, std::size_t level, std::size_t v) {
    return std::size_t(read<LevelHeader>(block, level_header_at(level)).section.offset) + v * sizeof(Vertex);
  };
  EXPECT_TRUE(verify(tampered(m, [](Bytes&) {})));

  const Model dent = tampered(m, [&](Bytes& block) {  // a corner of level 0 moves inwards past its neighbours
    const std::size_t v = vertex_at(block, 0, 0);
    for (int i = 0; i < 3; ++i) write(block, v + 8 * i, -0.2 * read<double>(block, v + 8 * i));
  });
  EXPECT_FALSE(verify(dent));

  const Model shrunk = tampered(m, [&](Bytes& block) {  // a whole level that no longer encloses, by an ulp
    for (std::size_t v = 0; v < 8; ++v)
      write(block, vertex_at(block, 1, v), std::nextafter(1.0, 0) * read<double>(block, vertex_at(block, 1, v)));
  });
  expect_says(verify(shrunk).message, "level 1 does not enclose");

  const Model flat = tampered(m, [&](Bytes& block) {  // a level without volume: it killed the verifier
    for (std::size_t v = 0; v < 6; ++v) write(block, vertex_at(block, 0, v) + 16, 0.0);
  });
  EXPECT_FALSE(verify(flat));
  const Polyhedron pyramid{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, {3, 3, 3, 3}};
  const Model sheet = tampered(model(pyramid), [&](Bytes& block) {
    for (std::size_t v = 0; v < 4; ++v) write(block, vertex_at(block, 0, v) + 16, 0.0);
  });
  expect_says(verify(sheet).message, "all vertices lie in one plane");

  const Model boast = tampered(m, [&](Bytes& block) {
    auto header = read<LevelHeader>(block, level_header_at(2));
    header.deviation *= 0.99;
    write(block, level_header_at(2), header);
  });
  expect_says(verify(boast).message, "deviation");

  const Model narrow = tampered(m, [&](Bytes& block) {
    const std::size_t at = level_header_at(1) + offsetof(LevelHeader, reach);
    write(block, at, std::nextafter(read<double>(block, at), 0));
  });
  expect_says(verify(narrow).message, "level 1: its reach");

  const Model turned = model(moved(cube(), rotation(1, 2, 3, 4)));
  const auto& planes = turned.level(0).view.planes;
  int low = 0;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    if (planes[f].over == 0) continue;
    const Model forged = tampered(turned, [&](Bytes& block) {
      write(block, vertex_at(block, 0, 8) + f * sizeof(FacePlane) + offsetof(FacePlane, over),
            std::nextafter(planes[f].over, 0));
    });
    expect_says(verify(forged).message, "higher above the plane of face " + std::to_string(f));
    ++low;
  }
  EXPECT_GE(low, 1);

  const Model thin = tampered(turned, [&](Bytes& block) {  // turned about its first corner, over which nothing rises
    const FacePlane& plane = planes[0];
    const Vec3 n = Vec3(plane.x, plane.y, plane.z), lean = (n + 1e-3 * n.unitOrthogonal()).normalized();
    write(block, vertex_at(block, 0, 8), FacePlane{lean[0], lean[1], lean[2], 0, 1});
  });
  expect_says(verify(thin).message, "face 0 is thicker");

  const auto with = [&](std::size_t at, double value) {
    return verify(tampered(m, [&](Bytes& block) { write(block, at, value); })).message;
  };
  expect_says(with(offsetof(BlockHeader, radius), std::nextafter(m.radius(), 0)), "around");
  const Model aside = tampered(m, [&](Bytes& block) {
    write(block, offsetof(BlockHeader, centre), 7.0), write(block, offsetof(BlockHeader, radius), 20.0);
    write(block, offsetof(BlockHeader, inner_radius), 0.0), write(block, offsetof(BlockHeader, scale_inside), 0.0);
    write(block, offsetof(BlockHeader, scale_around), std::numeric_limits<double>::infinity());
  });
  expect_says(verify(aside).message, "the centre is outside");
  expect_says(verify(tampered(m, [](Bytes& block) { write(block, offsetof(BlockHeader, dimension), 2u); })).message,
              "level 0 has dimension 3, not 2");
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string level = "level " + std::to_string(i);
    const Level& of = m.level(int(i));
    const auto of_level = [&](std::size_t at, auto value) {
      return verify(tampered(m, [&](Bytes& block) { write(block, level_header_at(i) + at, value); })).message;
    };
    expect_says(of_level(offsetof(LevelHeader, edge_count), std::uint64_t{5}), level + " has " + std::to_string(of.edge_count));
    expect_says(of_level(offsetof(LevelHeader, triangle_count), std::uint64_t{5}),
                level + " has " + std::to_string(of.triangle_count) + " triangles, not 5");
    for (const double wrong : {1e30, (1 + 1e-14) * of.view.extent})
      expect_says(of_level(offsetof(LevelHeader, extent), wrong), level + ": its extent is");
    for (const double wrong : {1e30, -1.0, 1.0001 * of.edge_length, 0.9999 * of.edge_length})
      expect_says(of_level(offsetof(LevelHeader, edge_length), wrong), level + ": its edges are");
    for (const double wrong : {1e9, -of.volume, 1.0001 * of.volume, 0.9999 * of.volume})
      expect_says(of_level(offsetof(LevelHeader, volume), wrong), level + ": its volume is");
  }
  for (int axis = 0; axis < 3; ++axis) {
    expect_says(with(offsetof(BlockHeader, box_min) + 8 * axis, std::nextafter(m.box_min()[axis], 2)), "box");
    expect_says(with(offsetof(BlockHeader, box_max) + 8 * axis, std::nextafter(m.box_max()[axis], -2)), "box");
  }
}

}  // namespace
}  // namespace swiftlet
