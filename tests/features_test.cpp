// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The features that a march names: of bodies that overlap they share a point, of others they hold the witness points. Decided
// in rational arithmetic.
#include <swiftlet/march.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "bodies.h"
#include "body/half_edge.h"
#include "oracle.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using bodies::law_two;
using bodies::model;
using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_3;

/// A vertex, an edge or a triangle of a facet.
using Cell = std::vector<std::uint32_t>;

/// What a feature is made of: a face of its exact facets, each as a fan.
std::vector<Cell> cells(const ConvexView& view, FeatureId feature) {
  const std::uint32_t i = feature.index();
  if (feature.kind() == FeatureKind::Vertex) return {{i}};
  if (feature.kind() == FeatureKind::Edge) return {{origin(view, i), view.half_edges[i].head}};
  if (feature.kind() == FeatureKind::None) return {};
  std::vector<Cell> fans;
  std::vector<bool> seen(view.half_edges.size());
  for (std::uint32_t first = 0; first < view.half_edges.size(); ++first) {
    if (view.half_edges[first].face != i || seen[first]) continue;
    seen[first] = true;
    for (std::uint32_t h = next_in_facet(view, first); h != first; h = next_in_facet(view, h)) {
      seen[h] = true;
      if (view.half_edges[h].head != origin(view, first))
        fans.push_back({origin(view, first), origin(view, h), view.half_edges[h].head});
    }
  }
  return fans;
}

std::vector<Point> exactly(const ConvexView& view, const Cell& cell, const Pose& in_a) {
  std::vector<Point> points;
  for (const std::uint32_t v : cell) {
    const CGAL::Gmpq p[] = {view.vertices[v].x, view.vertices[v].y, view.vertices[v].z};
    CGAL::Gmpq q[3];
    for (int i = 0; i < 3; ++i) {
      q[i] = in_a.translation[i];
      for (int j = 0; j < 3; ++j) q[i] += CGAL::Gmpq(in_a.rotation(i, j)) * p[j];
    }
    points.emplace_back(q[0], q[1], q[2]);
  }
  return points;
}

bool share_point(const std::vector<Point>& p, const std::vector<Point>& q) {
  using Segment = Kernel::Segment_3;
  using Triangle = Kernel::Triangle_3;
  if (p.size() > q.size()) return share_point(q, p);
  if (p.size() == 1 && q.size() == 1) return p[0] == q[0];
  if (p.size() == 1 && q.size() == 2) return Segment(q[0], q[1]).has_on(p[0]);
  if (p.size() == 1) return Triangle(q[0], q[1], q[2]).has_on(p[0]);
  if (q.size() == 2) return CGAL::do_intersect(Segment(p[0], p[1]), Segment(q[0], q[1]));
  if (p.size() == 2) return CGAL::do_intersect(Segment(p[0], p[1]), Triangle(q[0], q[1], q[2]));
  return CGAL::do_intersect(Triangle(p[0], p[1], p[2]), Triangle(q[0], q[1], q[2]));
}

bool share_point(const ConvexView& a, FeatureId of_a, const ConvexView& b, FeatureId of_b, const Pose& b_in_a) {
  for (const Cell& i : cells(a, of_a)) {
    for (const Cell& j : cells(b, of_b)) {
      if (share_point(exactly(a, i, {}), exactly(b, j, b_in_a))) return true;
    }
  }
  return false;
}

/// A cell where it is, and a box around it.
struct Piece {
  std::vector<Point> points;
  CGAL::Bbox_3 box;
};

std::vector<Piece> surface(const ConvexView& view, const Pose& in_a) {
  std::vector<FeatureId> parts;
  for (std::uint32_t f = 0; f < view.face_first.size(); ++f) parts.emplace_back(FeatureKind::Face, f);
  for (std::uint32_t h = 0; parts.empty() && h < view.half_edges.size(); ++h) parts.emplace_back(FeatureKind::Edge, h);
  if (parts.empty()) parts.emplace_back(FeatureKind::Vertex, 0);
  std::vector<Piece> pieces;
  for (const FeatureId part : parts) {
    for (const Cell& cell : cells(view, part)) {
      Piece piece{exactly(view, cell, in_a), {}};
      for (const Point& p : piece.points) piece.box += p.bbox();
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

bool surfaces_share_point(const ConvexView& a, const ConvexView& b, const Pose& b_in_a) {
  const std::vector<Piece> surface_a = surface(a, {}), surface_b = surface(b, b_in_a);
  for (const Piece& i : surface_a) {
    for (const Piece& j : surface_b) {
      if (CGAL::do_overlap(i.box, j.box) && share_point(i.points, j.points)) return true;
    }
  }
  return false;
}

/// Whether a point of the common frame lies on a feature but for law 2's bound. A face flat only up to rounding is as thick as
/// its vertices make it.
bool holds(const ConvexView& view, FeatureId feature, const Pose& in_a, const Vec3& p_a, double bound) {
  const Vec3 p[] = {p_a};
  std::vector<Vec3> corners;
  for (const Cell& cell : cells(view, feature)) {
    for (const std::uint32_t v : cell) corners.emplace_back(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z);
  }
  return oracle::is_within(p, corners, in_a, bound);
}

struct Count {
  int overlapping = 0, nested = 0, touching = 0, disjoint = 0;
};

/// One march, cold or from anywhere.
void expect_features(const ConvexView& a, const ConvexView& b, const Pose& pose, Count& count, const MarchStart& start = {},
                     const MarchRule& rule = {}) {
  const MarchResult r = march(a, b, pose, start, rule);
  const double bound = law_two(a, b, pose);
  if (r.status != MarchStatus::Overlapping) {
    if (r.status == MarchStatus::Budget) return;
    ASSERT_TRUE(r.status == MarchStatus::Disjoint || r.status == MarchStatus::Touching || r.status == MarchStatus::Near);
    ++(r.status == MarchStatus::Disjoint ? count.disjoint : count.touching);
    EXPECT_TRUE(holds(a, r.a, {}, r.point_a, bound)) << "A's point is not on its feature, " << int(r.status);
    EXPECT_TRUE(holds(b, r.b, pose, r.point_b, bound)) << "B's point is not on its feature, " << int(r.status);
    return;
  }
  if (r.a != FeatureId{} && r.b != FeatureId{}) {
    ++count.overlapping;
    EXPECT_TRUE(share_point(a, r.a, b, r.b, pose)) << "kinds " << int(r.a.kind()) << ' ' << int(r.b.kind());
    EXPECT_TRUE(holds(a, r.a, {}, r.point_a, bound)) << "A's point is not on its feature " << int(r.a.kind());
    EXPECT_TRUE(holds(b, r.b, pose, r.point_b, bound)) << "B's point is not on its feature " << int(r.b.kind());
    return;
  }
  ++count.nested;
  EXPECT_NE(r.a.kind(), r.b.kind());
  EXPECT_TRUE(r.a.kind() == FeatureKind::Vertex || r.b.kind() == FeatureKind::Vertex);
  EXPECT_FALSE(surfaces_share_point(a, b, pose)) << "not nested";
}

std::vector<Model> kinds() {
  std::vector<Model> all;
  all.push_back(model(bodies::point({0.1, 0.2, 0.3})));
  all.push_back(model(bodies::segment({-1, 0, 0}, {1, 0.5, 0})));
  all.push_back(model(bodies::two_sided({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})));
  all.push_back(model(bodies::two_sided(shapes::polygon(5).points)));
  all.push_back(model(bodies::cube()));
  all.push_back(model(bodies::tetrahedron()));
  all.push_back(model(bodies::body_of(shapes::prism(5, 1, 0.6)), {true, {}}));
  all.push_back(model(bodies::body_of(shapes::random_polytope(30, 4))));
  all.push_back(model(bodies::body_of(shapes::ellipsoid({1, 0.5, 0.2}, 100, 2))));
  all.push_back(model(bodies::float_rounded(bodies::moved(bodies::cube(), bodies::rotation(1, 2, 3, 4)))));
  return all;
}

TEST(Features, OfRandomPairsAreWhereTheMarchSaysThatTheyMeet) {
  const std::vector<Model> all = kinds();
  shapes::Random random(41);
  Count count;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      SCOPED_TRACE(std::to_string(i) + ' ' + std::to_string(j));
      for (int k = 0; k < 30; ++k) {
        const double scale = k % 3 == 0 ? 0.3 : 1.5;
        expect_features(all[i].level(0).view, all[j].level(0).view, {random.rotation(), scale * random.in_ball()}, count);
        if (testing::Test::HasFailure()) FAIL() << k;
      }
    }
  }
  EXPECT_GE(count.overlapping, 1000);
  EXPECT_GE(count.disjoint, 500);
}

TEST(Features, HoldTheWitnessesOfALooseMarchToo) {
  const std::vector<Model> all = kinds();
  shapes::Random random(47);
  Count count;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      SCOPED_TRACE(std::to_string(i) + ' ' + std::to_string(j));
      for (int k = 0; k < 40; ++k) {
        MarchRule rule;
        rule.relative = k % 2 ? 0.3 : 0;
        rule.absolute = k % 2 ? 0 : 0.2;
        rule.step_budget = std::uint32_t(k % 5);
        expect_features(all[i].level(0).view, all[j].level(0).view, {random.rotation(), 2 * random.in_ball()}, count, {}, rule);
        if (testing::Test::HasFailure()) FAIL() << k;
      }
    }
  }
  EXPECT_GE(count.disjoint, 500);
}

TEST(Features, OfNestedBodiesAreAVertexAndNone) {
  const Model outer = model(bodies::body_of(shapes::random_polytope(60, 3)));
  const Model inner = model(bodies::moved(bodies::body_of(shapes::random_polytope(30, 4)), 0.1 * Mat3::Identity()));
  const ConvexView &a = outer.level(0).view, &b = inner.level(0).view;
  shapes::Random random(42);
  Count count;
  for (int k = 0; k < 100; ++k) {
    const Vec3 at = random.in_ball();
    expect_features(a, b, {Mat3::Identity(), at}, count);
    expect_features(b, a, {Mat3::Identity(), -at}, count);
    const MarchResult r = march(a, b, {Mat3::Identity(), 0.3 * at});
    ASSERT_EQ(r.b.kind(), FeatureKind::Vertex);
    ASSERT_EQ(r.a, FeatureId{});
  }
  EXPECT_GE(count.nested, 20);
  EXPECT_GE(count.overlapping, 20);
}

TEST(Features, OfBodiesOnALatticeAreExact) {
  std::vector<Model> all;
  all.push_back(model(bodies::box(1, 2, 1)));
  all.push_back(model(bodies::cube()));
  all.push_back(model(bodies::octahedron()));
  all.push_back(model(bodies::triangulated(bodies::box(2, 1, 3))));
  all.push_back(model(bodies::tetrahedron()));
  all.push_back(model(bodies::two_sided({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})));
  const Mat3 turn = (Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), roll = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  shapes::Random random(43);
  Count count;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      SCOPED_TRACE(std::to_string(i) + ' ' + std::to_string(j));
      for (int k = 0; k < 100; ++k) {
        Pose pose{k % 3 == 0 ? Mat3(Mat3::Identity()) : k % 3 == 1 ? turn : roll, {}};
        for (double& x : pose.translation) x = (double(random.bits() % 17) - 8) / (k % 2 ? 2 : 4);
        if (k == 0) pose.translation.setZero();
        expect_features(all[i].level(0).view, all[j].level(0).view, pose, count);
        if (testing::Test::HasFailure()) FAIL() << k;
      }
    }
  }
  EXPECT_GE(count.overlapping, 500);
  EXPECT_GE(count.touching, 200);
  EXPECT_GE(count.disjoint, 200);
}

TEST(Features, OfBodiesNearContactHoldTheWitnesses) {
  const std::vector<Model> all = kinds();
  shapes::Random random(44);
  Count count;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const ConvexView &a = all[i].level(0).view, &b = all[j].level(0).view;
      SCOPED_TRACE(std::to_string(i) + ' ' + std::to_string(j));
      for (int k = 0; k < 4; ++k) {
        Pose pose{k % 2 ? Mat3(Mat3::Identity()) : random.rotation(), 5 * random.on_sphere()};
        const MarchResult apart = march(a, b, pose);
        const Vec3 contact = pose.translation - (apart.point_b - apart.point_a);
        for (const double gap : {1e-3, 1e-9, 1e-13, 2e-15, 1e-16, 0.0, -2e-15, -1e-14, -1e-13, -1e-11, -1e-9, -1e-6, -1e-3}) {
          pose.translation = contact + gap * apart.normal;
          expect_features(a, b, pose, count);
          expect_features(a, b, pose, count, {apart.a, apart.b});
          if (testing::Test::HasFailure()) FAIL() << k << ", gap " << gap;
        }
      }
    }
  }
  EXPECT_GE(count.overlapping, 1000);
  EXPECT_GE(count.touching, 1000);
  EXPECT_GE(count.disjoint, 1000);
}

TEST(Features, OfManyFacetsOverlapToo) {
  const Model fat = model(bodies::body_of(shapes::ellipsoid({1, 1, 1}, 1000, 1))),
              plate = model(bodies::body_of(shapes::ellipsoid({1, 1, 0.02}, 1000, 1))),
              needle = model(bodies::body_of(shapes::ellipsoid({2, 0.02, 0.02}, 1000, 1)));
  shapes::Random random(45);
  Count count;
  for (const Model* a : {&fat, &plate, &needle}) {
    for (const Model* b : {&fat, &plate, &needle}) {
      for (int k = 0; k < 60; ++k) {
        const Pose pose{random.rotation(), random.uniform(0, 1) * random.on_sphere()};
        const ConvexView &va = a->level(0).view, &vb = b->level(0).view;
        const MarchResult r = march(va, vb, pose);
        if (r.a == FeatureId{} || r.b == FeatureId{}) continue;  // small inside large: dear to refute
        expect_features(va, vb, pose, count);
        if (testing::Test::HasFailure()) FAIL() << k;
      }
    }
  }
  EXPECT_GE(count.overlapping, 150);
}

TEST(Features, OfABodyInOneThatIsAnyTimesLarger) {
  // From a ratio of 1e16 on doubles of the common frame do not tell the smaller body's vertices apart.
  const bodies::Polyhedron large = bodies::body_of(shapes::random_polytope(20, 3));
  const Model inner = model(bodies::body_of(shapes::random_polytope(12, 4)));
  const ConvexView& b = inner.level(0).view;
  shapes::Random random(48);
  Count count;
  for (int decade = 0; decade <= 30; ++decade) {
    const double ratio = std::pow(10, decade);
    const Model outer = model(bodies::moved(large, ratio * Mat3::Identity()));
    const ConvexView& a = outer.level(0).view;
    for (int k = 0; k < 8; ++k) {
      const Vec3 of_a(a.vertices[0].x, a.vertices[0].y, a.vertices[0].z), near = random.in_ball();
      const Vec3 at[] = {0.1 * near, ratio * 0.5 * near, 0.9 * of_a + near, 0.2 * of_a};
      const Pose pose{random.rotation(), at[k % 4]};
      expect_features(a, b, pose, count);
      expect_features(b, a, inverse(pose), count);
      if (testing::Test::HasFailure()) FAIL() << decade << ' ' << k;
    }
  }
  EXPECT_GE(count.nested, 200);
}

TEST(Features, OfABodyInOneThatIsAnyTimesLargerCostWorkLinearInThem) {
  const std::size_t n = 1000;
  const auto size = [](const ConvexView& v) { return v.vertices.size() + v.half_edges.size() + v.face_first.size(); };
  std::uint64_t most = 0;
  for (const Mesh& shape : {shapes::ellipsoid({1, 1, 1}, n, 1), shapes::ellipsoid({1, 1, 0.02}, n, 2),
                            shapes::ellipsoid({2, 0.02, 0.02}, n, 3), shapes::prism(n / 2, 1, 1)}) {
    const bodies::Polyhedron body = bodies::body_of(shape);
    const Model inner = model(bodies::moved(body, 0.01 * Mat3::Identity()), {true, {}});
    const ConvexView& b = inner.level(0).view;
    shapes::Random random(49);
    int nested = 0;
    for (int decade = 0; decade <= 30; ++decade) {
      const Model outer = model(bodies::moved(body, std::pow(10, decade) * Mat3::Identity()), {true, {}});
      const ConvexView& a = outer.level(0).view;
      for (int k = 0; k < 6; ++k) {
        const Pose pose{random.rotation(), (k < 3 ? 1e-3 : 0.3 * std::pow(10, decade)) * random.in_ball()};
        for (const MarchResult& r : {march(a, b, pose), march(b, a, inverse(pose))}) {
          ASSERT_LE(r.plane_tests, 8 * (size(a) + size(b))) << decade << ' ' << k;
          most = std::max<std::uint64_t>(most, 100 * r.plane_tests / (size(a) + size(b)));
          nested += r.status == MarchStatus::Overlapping && (r.a == FeatureId{} || r.b == FeatureId{});
        }
      }
    }
    EXPECT_GE(nested, 100);
  }
  std::printf("at most %.2f plane tests per feature\n", double(most) / 100);
}

TEST(Features, HoldAVertexInsideAFlatFace) {
  // The corner of a walking face that its loop does not pass: an ulp below, or above, its plane.
  bodies::Polyhedron box{
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, {}, {}};
  box.add({0, 3, 2, 1}), box.add({4, 5, 6, 7}), box.add({0, 1, 5, 4}), box.add({1, 2, 6, 5}), box.add({2, 3, 7, 6}),
      box.add({3, 0, 4, 7});
  bodies::Polyhedron a = bodies::triangulated(box), b = a;
  a.points.push_back({0.5, 0.25, 1 + 0x1p-52});
  b.points.push_back({-0.25, 0.5, -0x1p-53});
  const auto raise = [](bodies::Polyhedron& body, double z) {  // the two triangles of a quad become four around the ninth point
    std::vector<std::uint32_t> kept;
    for (std::size_t t = 0; t < body.corners.size(); t += 3) {
      bool in_face = true;
      for (std::size_t k = 0; k < 3; ++k) in_face = in_face && body.points[body.corners[t + k]].z() == z;
      if (!in_face) kept.insert(kept.end(), &body.corners[t], &body.corners[t] + 3);
    }
    const std::uint32_t top[] = {4, 5, 6, 7}, bottom[] = {0, 3, 2, 1}, *loop = z > 0 ? top : bottom;
    for (std::size_t k = 0; k < 4; ++k) kept.insert(kept.end(), {loop[k], loop[(k + 1) % 4], 8});
    body.corners = kept;
    body.sizes.assign(kept.size() / 3, 3);
  };
  raise(a, 1), raise(b, 0);
  const Model model_a = model(a), model_b = model(b);
  Count count;
  expect_features(model_a.level(0).view, model_b.level(0).view, {Mat3::Identity(), {-1.4375, -1.5, 1.5}}, count);
  shapes::Random random(46);
  for (int k = 0; k < 500; ++k) {
    Pose pose{Mat3::Identity(), {2 * random.uniform(-1, 1), 2 * random.uniform(-1, 1), k % 2 ? 1.5 : 1 + 0x1p-51}};
    for (std::size_t i = 0; i < 2; ++i) pose.translation[int(i)] = std::round(16 * pose.translation[int(i)]) / 16;
    expect_features(model_a.level(0).view, model_b.level(0).view, pose, count);
    if (testing::Test::HasFailure()) FAIL() << k;
  }
  EXPECT_GE(count.disjoint, 200);
}

}  // namespace
}  // namespace swiftlet
