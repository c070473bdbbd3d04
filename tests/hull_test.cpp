// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The builder's hull: rank, strictly extreme vertices, exact convexity, sizes from 1e-18 to 1e18, and what is told of the mesh.
#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <span>

#include <swiftlet/check.h>
#include <swiftlet/query.h>

#include "hull.h"
#include "numeric/exact.h"
#include "shapes.h"
#include "trace.h"

namespace swiftlet::lod {
namespace {

CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 exact(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Euler, every edge convex or flat, and no point beyond any face, all by exact predicates.
void expect_hull_of(const std::vector<Vec3>& points, const Hull& hull) {
  ASSERT_EQ(hull.dimension, 3);
  const Polytope body = solid(points, hull);
  EXPECT_EQ(body.triangles.size(), 2 * body.points.size() - 4);
  const HalfEdges edges = half_edges(body);
  for (std::uint32_t h = 0; h < edges.twin.size(); ++h) {
    ASSERT_EQ(edges.twin[edges.twin[h]], h);
    ASSERT_EQ(origin(body, edges.twin[h]), origin(body, HalfEdges::next(h)));
  }
  for (const auto& [a, b, c] : body.triangles)
    for (const Vec3& p : points)
      ASSERT_NE(CGAL::orientation(exact(body.points[a]), exact(body.points[b]), exact(body.points[c]), exact(p)),
                CGAL::POSITIVE);
}

TEST(Hull, DropsPointsInsideFacesAndEdges) {
  const Mesh mesh = shapes::meshed_cube(6);
  const Hull result = hull(mesh.points);
  EXPECT_EQ(result.vertices.size(), 8u);
  EXPECT_EQ(result.triangles.size(), 12u);
  EXPECT_EQ(result.vertices.size() + result.interior + result.duplicates, mesh.points.size());
  expect_hull_of(mesh.points, result);
}

/// Quickhull cuts large flat facets one way or the other; with that the whole hierarchy once changed from call to call.
TEST(Hull, CutsFlatFacetsTheSameWayEveryTime) {
  const Mesh mesh = shapes::prism(200, 1, 2);
  const std::uint64_t first = build(mesh).value().model.hash();
  for (int i = 0; i < 3; ++i) {
    (void)build(shapes::random_polytope(50, std::uint64_t(i)));
    EXPECT_EQ(build(mesh).value().model.hash(), first);
  }
}

TEST(Hull, IsExactOnRotatedAndFloatRoundedCad) {
  const Pose turn{shapes::rotation(Vec3(1, 2, 3).normalized(), 0.7), Vec3(1e4, -3, 2)};
  for (const Mesh& mesh :
       {shapes::meshed_cube(5), shapes::prism(40, 1, 2), shapes::dodecahedron(), shapes::needle(), shapes::sliver()}) {
    const Mesh turned = shapes::moved(mesh, turn), rounded = shapes::float_rounded(turned);
    expect_hull_of(turned.points, hull(turned.points));
    expect_hull_of(rounded.points, hull(rounded.points));
  }
}

TEST(Hull, NamesTheFirstOfEqualPoints) {
  std::vector<Vec3> points = shapes::tetrahedron().points;
  points.insert(points.end(), points.begin(), points.begin() + 4);
  const Hull result = hull(points);
  EXPECT_EQ(result.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(result.duplicates, 4u);
}

TEST(Hull, KnowsTheRankOfFlatPoints) {
  EXPECT_EQ(hull(std::vector<Vec3>{Vec3(3, 3, 3), Vec3(3, 3, 3)}).dimension, 0);
  std::vector<Vec3> line, plane;
  for (int i = 0; i < 5; ++i) line.emplace_back(i, 2 * i, -i);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) plane.emplace_back(i, j, i + 2 * j);
  const Hull segment = hull(line);
  EXPECT_EQ(segment.dimension, 1);
  EXPECT_EQ(segment.vertices, (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(segment.interior, 3u);
  const Hull square = hull(plane);
  EXPECT_EQ(square.dimension, 2);
  EXPECT_EQ(std::set(square.vertices.begin(), square.vertices.end()), (std::set<std::uint32_t>{0, 3, 12, 15}));
  plane[5].z() += 1e-15;
  EXPECT_EQ(hull(plane).dimension, 3);
}

TEST(Hull, OfAMillionPointsHalfDuplicatesOrInside) {
  shapes::Random random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 250000; ++i) points.push_back(random.in_ball());
  for (int i = 0; i < 250000; ++i) points.push_back(1.5 * random.in_ball().cwiseQuotient(Vec3(1, 2, 3)));
  for (int i = 0; i < 500000; ++i) points.push_back(points[std::size_t(i)]);
  const Hull result = hull(points);
  EXPECT_EQ(result.dimension, 3);
  EXPECT_EQ(result.duplicates, 500000u);
  EXPECT_EQ(result.triangles.size(), 2 * result.vertices.size() - 4);
}

/// Nearly all points lie in planes and lines of others.
TEST(Hull, HoldsPointsOfSmallLattices) {
  shapes::Random random(5);
  int solid_ones = 0;
  for (int round = 0; round < 3000; ++round) {
    const int side = 2 + round % 3;
    std::vector<Vec3> points;
    for (int i = 0; i < 4 + round % 37; ++i) {
      Vec3 p;
      for (double& x : p) x = std::floor(random.uniform() * side);
      points.push_back(p);
    }
    const Hull result = hull(points);
    if (result.dimension < 3) continue;
    ++solid_ones;
    ASSERT_NO_FATAL_FAILURE(expect_hull_of(points, result)) << round;
  }
  EXPECT_GT(solid_ones, 2000);
}

TEST(Hull, IsTheSameInAnyOrderOfPoints) {
  Mesh mesh = shapes::random_polytope(200, 3);
  const Polytope body = solid(mesh.points, hull(mesh.points));
  std::reverse(mesh.points.begin(), mesh.points.end());
  const Polytope again = solid(mesh.points, hull(mesh.points));
  EXPECT_TRUE(std::equal(body.points.begin(), body.points.end(), again.points.rbegin(), again.points.rend()));
}

TEST(Trace, EveryTriangleOfAMeshedCubeLiesOnAFace) {
  const Pose turn{shapes::rotation(Vec3(1, 2, 3).normalized(), 0.7), Vec3::Zero()};
  const Mesh plain = shapes::meshed_cube(5);
  for (const Mesh& mesh : {plain, shapes::moved(plain, turn), shapes::float_rounded(shapes::moved(plain, turn))}) {
    const Hull shape = hull(mesh.points);
    const Polytope body = solid(mesh.points, shape);
    const Progress unasked;
    Watch watch(unasked);
    const std::vector<std::uint32_t> face_of = triangles_on(mesh, shape, body, watch);
    ASSERT_EQ(face_of.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < face_of.size(); ++t) {
      ASSERT_LT(face_of[t], body.triangles.size()) << t;
      const auto& [a, b, c] = mesh.triangles[t];
      const auto& [i, j, k] = body.triangles[face_of[t]];
      const Vec3 own = area_normal(mesh.points[a], mesh.points[b], mesh.points[c]).normalized();
      EXPECT_GT(own.dot(area_normal(body.points[i], body.points[j], body.points[k])), 0) << t;
    }
  }
}

TEST(Trace, MeasuresADent) {
  // A cube of side 2 whose top is pushed in to depth 1/2 at its middle.
  Mesh mesh = shapes::cube();
  const auto top = [&](std::uint32_t v) { return mesh.points[v].z() > 0; };
  const auto on_top = [&](const auto& t) { return top(t[0]) && top(t[1]) && top(t[2]); };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), on_top), mesh.triangles.end());
  std::vector<std::uint32_t> rim;
  for (std::uint32_t v = 0; v < 8; ++v)
    if (top(v)) rim.push_back(v);
  std::sort(rim.begin(), rim.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::atan2(mesh.points[i].y(), mesh.points[i].x()) < std::atan2(mesh.points[j].y(), mesh.points[j].x());
  });
  mesh.points.emplace_back(0, 0, 0.5);
  for (std::uint32_t k = 0; k < 4; ++k) mesh.triangles.push_back({rim[k], rim[(k + 1) % 4], 8});
  const auto built = build(mesh);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_DOUBLE_EQ(built.value().report.deepest_dent, 0.5);
  EXPECT_NEAR(built.value().report.volume_ratio, (8 - 2.0 / 3) / 8, 1e-15);
  BuildOptions strict;
  strict.require_convex = true;
  const auto refused = build(mesh, strict);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::NotConvex);
}

/// A round hull and another one of `radius` around its middle, all of whose points are about as far from all faces.
Mesh round_in_round(double radius) {
  Mesh mesh = shapes::ellipsoid(Vec3(1, 1, 1), 6000, 1);
  const Mesh outer = mesh;
  for (const Vec3& p : outer.points) mesh.points.push_back(radius * p);
  for (const auto& [a, b, c] : outer.triangles) {
    const auto shift = std::uint32_t(outer.points.size());
    mesh.triangles.push_back({a + shift, b + shift, c + shift});
  }
  return mesh;
}

TEST(Trace, DentsInTheMiddleOfARoundHullLookAtFewPlanes) {
  const Progress unasked;
  for (const double radius : {0.3, 0.1, 0.01, 1e-3, 1e-6, 1e-12}) {
    const Mesh mesh = round_in_round(radius);
    const Hull shape = hull(mesh.points);
    const Polytope body = solid(mesh.points, shape);
    PlaneTree planes(body);
    Watch watch(unasked);
    const double deepest = deepest_dent(mesh, shape, body, planes, watch);
    double expected = 0;
    PlaneTree all(body);
    for (const Vec3& p : std::span(mesh.points).last(mesh.points.size() / 2)) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : body.triangles) {
        const exact::Plane plane = exact::plane(vec(body.points[a]), vec(body.points[b]), vec(body.points[c]));
        least = std::min(least, eigen(plane.normal).dot(body.points[a] - p));
      }
      ASSERT_EQ(all.depth(p, -1), least) << radius;
      expected = std::max(expected, least);
    }
    EXPECT_EQ(deepest, expected) << radius;
    const double each = double(planes.looked_at()) / double(mesh.points.size() / 2);
    std::printf("radius %g: %.1f planes and boxes per vertex, of %zu planes\n", radius, each, body.triangles.size());
    EXPECT_LE(each, 200) << radius;
  }
}

TEST(Trace, DentsTellOfProgressAndAreCancelled) {
  const Mesh mesh = round_in_round(0.01);
  BuildOptions options;
  options.max_levels = 1;
  int calls = 0, wanted = 1000;
  options.progress = [&](double, std::string_view stage) {
    calls += stage == "hull";
    return calls < wanted;
  };
  ASSERT_TRUE(build(mesh, options));
  EXPECT_GE(calls, 20);
  wanted = calls - 3, calls = 0;  // the last ones are of dents
  const auto built = build(mesh, options);
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().code, ErrorCode::Cancelled);
  EXPECT_EQ(calls, wanted);
}

TEST(Trace, RefusedDentsAreToldByDepthOrVolume) {
  BuildOptions strict;
  strict.require_convex = true;
  const auto told = [&](const Mesh& mesh) {
    const auto refused = build(mesh, strict);
    return refused ? "nothing" : refused.error().message;
  };
  Mesh cube = shapes::cube();  // of side 2
  const auto side = cube.triangles.front();
  const Vec3 middle = (cube.points[side[0]] + cube.points[side[1]] + cube.points[side[2]]) / 3;
  const Vec3 normal = (cube.points[side[1]] - cube.points[side[0]]).cross(cube.points[side[2]] - cube.points[side[0]]);
  cube.points.push_back(middle - 1e-9 * normal.normalized());
  cube.triangles.erase(cube.triangles.begin());
  for (std::size_t k = 0; k < 3; ++k) cube.triangles.push_back({side[k], side[(k + 1) % 3], 8});
  EXPECT_EQ(told(cube), "the mesh has dents: the vertex deepest inside the hull is 1e-09 deep");
  // An octahedron without one of its eighths, whose vertices are all extreme.
  const Mesh dented{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {2, 3, 0}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  EXPECT_EQ(told(dented), "the mesh has dents: its volume is 0.75 of the hull's");
}

TEST(Trace, RoundingIsNoDent) {
  const Pose turn{shapes::rotation(Vec3(1, 2, 3).normalized(), 0.7), Vec3::Zero()};
  BuildOptions strict;
  strict.require_convex = true;
  for (const Mesh& mesh : {shapes::meshed_cube(5), shapes::prism(50, 1, 1), shapes::dodecahedron()}) {
    EXPECT_TRUE(build(shapes::moved(mesh, turn), strict));
    EXPECT_TRUE(build(shapes::float_rounded(shapes::moved(mesh, turn)), strict));
  }
}

TEST(Trace, FacesOfAnyLegalThinnessHaveANormal) {
  const Vec3 along = Vec3(1.1, 0.3, 0), up(0, 1, 0);
  for (const double half : {1e-20, 1e-30, 1e-33, 1e-40, 1e-60}) {
    const auto built = build(std::vector<Vec3>{along, -along, half * up, -0.7 * half * up});
    ASSERT_TRUE(built) << half << ": " << built.error().message;
    const ConvexView& view = built.value().model.level(0).view;
    ASSERT_EQ(view.planes.size(), 2u) << half;
    EXPECT_EQ(std::abs(view.planes[0].z), 1) << half;
    EXPECT_EQ(view.planes[1].z, -view.planes[0].z) << half;
    EXPECT_TRUE(verify(built.value().model)) << half;
  }
}

/// A plate of size 1 x 1 x t, each of whose sides is a grid of 4 x 4 squares.
Mesh meshed_plate(double t, const Pose& turn) {
  Mesh plate = shapes::meshed_cube(4);
  for (Vec3& p : plate.points) p = turn.rotation * Vec3(p.x() / 2, p.y() / 2, p.z() / 2 * t);
  return plate;
}

TEST(Trace, ThinPlatesHaveNoDentsAndAllTheirTriangles) {
  BuildOptions strict;
  strict.require_convex = true;
  strict.max_levels = 1;
  shapes::Random random(3);
  std::size_t lost = 0, triangles = 0;
  for (const double t : {0.1, 1e-2, 1e-3, 1e-6, 1e-9}) {
    for (int k = 0; k < 20; ++k) {
      const Mesh plate = meshed_plate(t, {random.rotation(), Vec3::Zero()});
      const auto built = build(plate, strict);
      ASSERT_TRUE(built) << t << ": " << built.error().message;
      EXPECT_LE(built.value().report.deepest_dent, rounding_of(plate.points)) << t;
      triangles += plate.triangles.size(), lost += plate.triangles.size() - built.value().model.source().face.size();
    }
  }
  EXPECT_LE(lost, triangles / 100);
}

TEST(Trace, TetrahedraHaveNoDentsHoweverFlat) {
  BuildOptions strict;
  strict.require_convex = true;
  shapes::Random random(5);
  int solids = 0;
  for (int k = 0; k < 1000; ++k) {
    Mesh flat;
    for (int i = 0; i < 4; ++i) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      flat.points.push_back({x, y, 0.3 * x + 0.7 * y});
    }
    flat.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
    const auto built = build(flat, strict);
    if (!built && built.error().message.find("dents") == std::string::npos) continue;
    ASSERT_TRUE(built) << k << ": " << built.error().message;
    if (built.value().model.dimension() != 3 || built.value().model.level(0).view.vertices.size() != 4) continue;
    ++solids;
    EXPECT_NEAR(built.value().report.volume_ratio, 1, 1e-12) << k;
  }
  EXPECT_GE(solids, 500);
}

/// Slivers of a flat body are on the side whose normal they share exactly.
TEST(Trace, OfAFlatBodyEverySliverIsOnItsSide) {
  shapes::Random random(8);
  using Rational = CGAL::Exact_rational;
  int slivers = 0;
  for (int round = 0; round < 200; ++round) {
    Mesh mesh;
    for (int i = 0; i < 12; ++i) {
      const double t = random.uniform(0, 1);
      mesh.points.push_back(i < 4 ? Vec3(random.uniform(0, 1), random.uniform(0, 1), 0)
                                  : Vec3(t, t * (1 + 1e-15 * random.uniform(-1, 1)), 0));
    }
    for (std::uint32_t k = 4; k + 2 < 12; ++k)
      mesh.triangles.push_back({k, k + 1, k + 2}), mesh.triangles.push_back({k + 1, k, k + 2});
    const auto built = build(mesh);
    ASSERT_TRUE(built) << built.error().message;
    const Model& flat = built.value().model;
    ASSERT_EQ(flat.dimension(), 2);
    const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
      return CGAL::sign((Rational(b.x()) - a.x()) * (Rational(c.y()) - a.y()) -
                        (Rational(b.y()) - a.y()) * (Rational(c.x()) - a.x()));
    };
    const SourceMap source = flat.source();
    for (std::uint32_t f = 0; f < 2; ++f) {
      std::vector<Vec3> loop;
      for (const std::uint32_t v : FaceLoop(flat.level(0).view, f)) {
        const Vertex& p = flat.level(0).view.vertices[v];
        loop.emplace_back(p.x, p.y, p.z);
      }
      const auto front = turn(loop[0], loop[1], loop[2]);
      for (std::uint32_t k = source.face_begin[f]; k < source.face_begin[f + 1]; ++k) {
        const auto& [a, b, c] = mesh.triangles[source.face[k]];
        const auto side = turn(mesh.points[a], mesh.points[b], mesh.points[c]);
        EXPECT_NE(side, -front) << round;
        slivers += side != CGAL::ZERO;
      }
    }
  }
  EXPECT_GE(slivers, 2000);
}

/// From either side a flat body's face is the one that looks there, and its triangles are those of that side.
TEST(Trace, OfAFlatBodyTheSideThatFacesIsNamed) {
  const Mesh square{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}},
      triangle{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  const Model box = build(shapes::box({0.2, 0.1, 0.3})).value().model;
  shapes::Random random(6);
  for (const Mesh* mesh : {&square, &triangle}) {
    const Model flat = build(*mesh).value().model;
    const auto is_up = [&](std::uint32_t source) { return source < mesh->triangles.size() / 2; };
    int faces = 0;
    for (int k = 0; k < 400; ++k) {
      const bool is_above = k % 2;
      const double x = random.uniform(-0.5, 0.5);
      const Pose pose{random.rotation(), {x, x - random.uniform(0, 0.4), is_above ? 1. : -1.}};
      for (const Body& body : {Body::point({0, 0, 0}), Body(box)}) {
        PairSeed seed;
        for (int round = 0; round < 2; ++round) {
          const ClosestFeatures nearest = closest_features(flat, body, pose, seed);
          const auto named = nearest.source_a.triangles;
          faces += !named.empty();
          EXPECT_TRUE(named.empty() || is_up(named[0]) == is_above) << k;
        }
        const auto swapped = closest_features(body, flat, inverse(pose)).source_b.triangles;
        EXPECT_TRUE(swapped.empty() || is_up(swapped[0]) == is_above) << k;
      }
    }
    EXPECT_GE(faces, 1000);
  }
}

TEST(Trace, ADetailCoarserThanTheCoarsestLevelLeavesThatLevel) {
  BuildOptions options;
  options.max_deviation = 0.05, options.detail.deviation = 0.2;
  const auto built = build(shapes::ellipsoid({1, 1, 1}, 1000, 1), options);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_LT(built.value().model.level(built.value().model.finest_level()).triangle_count, 900u);
  options.detail.deviation = -1;
  EXPECT_EQ(build(shapes::cube(), options).error().code, ErrorCode::BadValue);
}

TEST(Trace, WhatIsBelowALimitIsToldWithTheLimit) {
  for (const std::uint32_t cutoff : {0u, 3u}) {
    BuildOptions options;
    options.cutoff = cutoff;
    const auto refused = build(shapes::cube(), options);
    ASSERT_FALSE(refused) << cutoff;
    EXPECT_EQ(refused.error().code, ErrorCode::BadValue);
    EXPECT_EQ(refused.error().message, "cutoff must be at least 4");
  }
  Mesh tiny = shapes::cube();
  for (Vec3& p : tiny.points) p *= 1e-50;
  EXPECT_EQ(build(tiny).error().message, "the body's extent is 1e-50, below the limit of 1e-45");
}

}  // namespace
}  // namespace swiftlet::lod
