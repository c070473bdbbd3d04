// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a level says of its body beyond its faces, against rationals over all vertices: how high the body rises above the planes
// of its polygons, how far apart two of its points are, and which ball and ellipsoids bound it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <swiftlet/body.h>
#include <swiftlet/build.h>
#include <swiftlet/check.h>
#include <swiftlet/model.h>
#include <swiftlet/query.h>

#include "bodies.h"
#include "body/half_edge.h"
#include "body/shape.h"
#include "oracle.h"
#include "random.h"
#include "shapes.h"

namespace swiftlet {
namespace {

using Number = CGAL::Exact_rational;

constexpr double kU = 0x1p-53;

using Point = std::array<Number, 3>;

template <class Record>
Point rational(const Record& r) {
  return {Number(r.x), Number(r.y), Number(r.z)};
}

std::vector<Point> rational_points(const ConvexView& view) {
  std::vector<Point> points;
  for (const Vertex& v : view.vertices) points.push_back(rational(v));
  return points;
}

/// The height of the highest vertex above a face's plane, exactly, at least 0.
Number highest(const ConvexView& view, const std::vector<Point>& points, std::uint32_t face) {
  const Point n = rational(view.planes[face]);
  const auto along = [&n](const Point& p) -> Number { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2]; };
  const Number first = along(points[origin(view, view.face_first[face])]);
  Number most = first;
  for (const Point& p : points) most = std::max(most, along(p));
  return most - first;
}

/// What was found on the way: planes, and those above which a vertex rises; the largest such height, in u times the extent.
struct Tally {
  std::size_t planes = 0, exceeded = 0;
  double most = 0;
};

/// Expects of every plane the least double that no vertex's height exceeds, and a thickness within which its face lies.
void expect_least(const ConvexView& view, Tally& tally) {
  const std::vector<Point> points = rational_points(view);
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    const std::uint32_t f = view.half_edges[h].face;
    if (f >= view.planes.size()) continue;
    const Point n = rational(view.planes[f]), &p = points[origin(view, h)], &on = points[origin(view, view.face_first[f])];
    Number height = 0, length2 = 0;
    for (std::size_t i = 0; i < 3; ++i) height += n[i] * (p[i] - on[i]), length2 += n[i] * n[i];
    const Number thickness = view.planes[f].thickness;
    ASSERT_LE(height * height, thickness * thickness * length2) << "face " << f << " is thicker";
  }
  for (std::uint32_t f = 0; f < view.planes.size(); ++f) {
    const double over = view.planes[f].over;
    const Number most = highest(view, points, f);
    ASSERT_GE(over, 0);
    ASSERT_LE(most, Number(over)) << "face " << f << ": a vertex is higher than " << over;
    if (over > 0) {
      ASSERT_LT(Number(std::nextafter(over, 0.)), most) << "face " << f << ": " << over << " is not tight";
    }
    ++tally.planes;
    tally.exceeded += over > 0;
    tally.most = std::max(tally.most, over / (kU * view.extent));
  }
}

void expect_least(const Model& model, Tally& tally) {
  for (int level = 0; level < model.level_count(); ++level) {
    expect_least(model.level(level).view, tally);
    if (testing::Test::HasFatalFailure()) FAIL() << "level " << level;
  }
}

/// A mesh, turned and shifted in several ways.
std::vector<Mesh> turned(const Mesh& mesh, std::uint64_t seed) {
  shapes::Random random(seed);
  std::vector<Mesh> result{mesh};
  for (const double shift : {0., 0.3, 100.})
    result.push_back(shapes::moved(mesh, {random.rotation(), shift * random.on_sphere()}));
  return result;
}

/// The hull of two boxes at right angles, with a prism through both.
Mesh bracket() {
  Mesh mesh;
  const auto add = [&](const Mesh& part, const Vec3& at) {
    for (const Vec3& p : part.points) mesh.points.push_back(p + at);
  };
  add(shapes::box({4, 1, 0.25}), {0, 0, 0});
  add(shapes::box({0.25, 1, 3}), {-2, 0, 1.5});
  add(shapes::prism(24, 0.6, 0.5), {1.75, 0, 0});
  return mesh;
}

/// Each coordinate moved by up to `ulps` ulps.
Mesh nudged(Mesh mesh, int ulps, std::uint64_t seed) {
  shapes::Random random(seed);
  for (Vec3& p : mesh.points) {
    for (double& x : p) {
      for (int k = int(random.uniform(0, ulps + 1)); k > 0; --k)
        x = std::nextafter(
            x, random.uniform() < 0.5 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity());
    }
  }
  return mesh;
}

Model built(const Mesh& mesh) {
  BuildOptions options;
  options.cutoff = 4;
  return bodies::must(build(std::span<const Vec3>(mesh.points), options)).model;
}

std::vector<Mesh> parts() {
  std::vector<Mesh> result{shapes::cube(), shapes::meshed_cube(4), shapes::dodecahedron(), shapes::needle(), bracket()};
  for (const Vec3& size : {Vec3(1, 2, 3), Vec3(1, 1, 1e-3), Vec3(1, 1e-3, 1e-3), Vec3(1e-6, 1, 1e3)})
    result.push_back(shapes::box(size));
  for (const std::uint32_t sides : {5u, 6u, 7u, 12u, 31u, 64u, 200u}) {
    result.push_back(shapes::prism(sides, 1, 2));
    result.push_back(shapes::prism(sides, 1, 0.01));
  }
  return result;
}

TEST(FacePlanes, NoVertexIsHigherThanTheyState) {
  Tally tally;
  std::uint64_t seed = 1;
  for (const Mesh& part : parts()) {
    for (const Mesh& mesh : turned(part, seed++)) {
      ASSERT_NO_FATAL_FAILURE(expect_least(built(mesh), tally)) << seed;
    }
  }
  EXPECT_GE(tally.planes, 2000u);
  EXPECT_GE(tally.exceeded, 1000u);
  EXPECT_LE(tally.most, 4) << "flat up to rounding, so that doubles rise above them by little more";
  std::printf("%zu planes, %zu exceeded, by at most %.2f u of the extent\n", tally.planes, tally.exceeded, tally.most);
}

TEST(FacePlanes, NoVertexIsHigherThanThoseOfSinglePrecisionState) {
  Tally tally;
  std::uint64_t seed = 100;
  for (const Mesh& part : parts()) {
    for (const Mesh& mesh : turned(part, seed++)) {
      ASSERT_NO_FATAL_FAILURE(expect_least(built(shapes::float_rounded(mesh)), tally)) << seed;
    }
  }
  EXPECT_GE(tally.planes, 2000u);
  EXPECT_GE(tally.exceeded, 1000u);
  EXPECT_LE(tally.most, 16 * 0x1p-23 / kU);
  std::printf("%zu planes, %zu exceeded, by at most %.3g u of the extent\n", tally.planes, tally.exceeded, tally.most);
}

TEST(FacePlanes, NoVertexIsHigherThanThoseOffTheirPlaneState) {
  Tally tally;
  std::uint64_t seed = 200;
  for (const Mesh& part : parts()) {
    for (const int ulps : {1, 2, 4, 8}) {
      ++seed;
      ASSERT_NO_FATAL_FAILURE(expect_least(built(nudged(turned(part, seed)[2], ulps, seed)), tally)) << seed;
    }
  }
  EXPECT_GE(tally.planes, 1000u);
  EXPECT_GE(tally.exceeded, 500u);
  std::printf("%zu planes, %zu exceeded, by at most %.2f u of the extent\n", tally.planes, tally.exceeded, tally.most);
}

TEST(FacePlanes, ThoseOfModelsFromArraysAndFlatBodiesHold) {
  using namespace bodies;
  Tally tally;
  shapes::Random random(7);
  for (int i = 0; i < 50; ++i) {
    const Polyhedron body = moved(box(1, 0.5, 2), random.rotation(), 3 * random.in_ball());
    ASSERT_NO_FATAL_FAILURE(expect_least(model(body), tally));
    ASSERT_NO_FATAL_FAILURE(expect_least(model(float_rounded(body)), tally));
  }
  ASSERT_NO_FATAL_FAILURE(expect_least(nested(), tally));
  for (const double scale : {0x1p-140, 0x1p+140}) {
    Polyhedron body = moved(box(1, 0.5, 2), random.rotation());
    for (Vec3& p : body.points) p *= scale;
    ASSERT_NO_FATAL_FAILURE(expect_least(model(body), tally));
  }
  const Polyhedron sheet = two_sided({{0, 0, 0}, {1, 0.25, 0.5}, {2, 2, 1.5}, {0.5, 1, 0.5}});  // all 2 z = x + y / 2
  EXPECT_THROW(model(moved(sheet, random.rotation())), std::runtime_error) << "rounding bends it";
  ASSERT_NO_FATAL_FAILURE(expect_least(model(two_sided({{0, 0, 0}, {3, 0, 1}, {3, 5, 1}, {0, 5, 0}})), tally));
  EXPECT_GE(tally.planes, 600u);
}

TEST(FacePlanes, NormalsHaveNoTinyCoordinates) {
  // A plate of side 2e45 and height 1e-70 whose top leans by 1e-131: legal bodies have no smaller slopes.
  using namespace bodies;
  Polyhedron b = box(1e45, 1e45, 1);
  for (std::size_t v = 0; v < 8; ++v) b.points[v].z() = v < 4 ? 0 : 1e-70;
  b.points[5].z() = b.points[6].z() = std::nextafter(1e-70, 1);
  const Model m = model(b);
  Tally tally;
  ASSERT_NO_FATAL_FAILURE(expect_least(m, tally));
  for (const FacePlane& n : m.level(0).view.planes)
    for (const double x : {n.x, n.y, n.z}) EXPECT_TRUE(x == 0 || std::fabs(x) >= 0x1p-500) << x;
}

/// Expects a bound on all distances that is at most sqrt(3) times the largest, as the diagonal of a bounding box is.
void expect_reach(const ConvexView& view) {
  const std::vector<Point> points = rational_points(view);
  Number most2(0);
  for (const Point& p : points) {
    for (const Point& q : points) {
      Number sum(0);
      for (std::size_t i = 0; i < 3; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
      most2 = std::max(most2, sum);
    }
  }
  const Number reach2 = Number(view.reach) * Number(view.reach);
  EXPECT_GE(reach2, most2);
  EXPECT_LE(reach2, Number(3 * (1 + 64 * kU)) * most2);
}

TEST(Reach, BoundsAllDistances) {
  std::uint64_t seed = 300;
  std::vector<Mesh> bodies = parts();
  for (const Mesh& mesh : {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), shapes::sliver(),
                           shapes::random_polytope(40, 1), shapes::polygon(9), shapes::segment(3), shapes::point()})
    bodies.push_back(mesh);
  for (const Mesh& part : bodies) {
    if (part.points.size() > 130) continue;
    for (const Mesh& mesh : turned(part, seed++)) {
      const Model model = built(mesh);
      for (int level = 0; level < model.level_count(); ++level) expect_reach(model.level(level).view);
    }
  }
  EXPECT_EQ(ConvexView{}.reach, 0) << "a view made by hand knows none";
}

/// Expects of a level that a ball around the centre is inside, and that none larger by more than rounding is. Returns its
/// radius.
double expect_inner_radius(const ConvexView& view) {
  const Point centre{Number(view.centre.x()), Number(view.centre.y()), Number(view.centre.z())};
  const std::vector<Point> points = rational_points(view);
  const Number r(view.inner_radius), more = r + Number(64 * kU * view.extent);
  bool tight = view.face_first.empty();
  for (std::uint32_t h = 0; h < view.half_edges.size() && !view.face_first.empty(); ++h) {
    const Point &a = points[origin(view, h)], &b = points[view.half_edges[h].head],
                &c = points[view.half_edges[next_in_facet(view, h)].head];
    Point u, v, w;
    for (std::size_t i = 0; i < 3; ++i) u[i] = b[i] - a[i], v[i] = c[i] - a[i], w[i] = a[i] - centre[i];
    const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Number depth = n[0] * w[0] + n[1] * w[1] + n[2] * w[2], nn = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (r > 0) {
      EXPECT_GE(depth, 0);
      EXPECT_GE(depth * depth, r * r * nn);
    }
    tight = tight || depth <= 0 || depth * depth <= more * more * nn;
  }
  EXPECT_TRUE(tight) << "a ball larger than " << view.inner_radius << " is inside";
  return view.inner_radius;
}

TEST(InnerRadius, IsThatOfTheLargestBallAroundTheCentre) {
  std::uint64_t seed = 400;
  int balls = 0;
  std::vector<Mesh> bodies = parts();
  for (const Mesh& mesh : {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), shapes::sliver(),
                           shapes::random_polytope(40, 1), shapes::polygon(9), shapes::segment(3), shapes::point()})
    bodies.push_back(mesh);
  for (const Mesh& part : bodies) {
    for (const Mesh& mesh : turned(part, seed++)) {
      const Model model = built(mesh);
      balls += expect_inner_radius(model.level(0).view) > 0;
    }
  }
  EXPECT_GT(balls, 50);
  for (const Body& box : {Body::box({-1, -2, -3}, {2, 1, 5}), Body::box({0.1, 0.2, 0.3}, {0.4, 0.7, 0.9})})
    EXPECT_GT(expect_inner_radius((*ShapeOf(box)).level(0).view), 0);
  EXPECT_EQ((*ShapeOf(Body::box({0, 0, 0}, {1, 1, 0}))).level(0).view.inner_radius, 0);
}

/// Expects that the ellipsoids of a level lie around it and inside it, and that neither could be nearer by a millionth, the one
/// inside by that and what rounds a plane. Returns whether they are known.
bool expect_ellipsoids(const Level& level) {
  if (!(level.scale_around < kInfinity)) {
    EXPECT_EQ(level.scale_inside, 0);
    return false;
  }
  const ConvexView& view = level.view;
  std::array<Number, 6> m;
  for (std::size_t k = 0; k < 6; ++k) m[k] = Number(level.map_frame[k]);
  const Point centre{Number(view.centre.x()), Number(view.centre.y()), Number(view.centre.z())};
  const std::vector<Point> points = rational_points(view);
  const auto from_centre = [&](const Point& p) -> Point { return {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]}; };
  const auto square = [](const Number& x, const Number& y, const Number& z) -> Number { return x * x + y * y + z * z; };
  const Number around(level.scale_around), inside(level.scale_inside), millionth(0x1p-20);
  Number farthest2(0);
  bool tight = inside == 0;
  for (const Point& p : points) {
    const Point x = from_centre(p);
    const Number a = x[0] / m[0], b = (x[1] - m[1] * a) / m[3], c = (x[2] - m[2] * a - m[4] * b) / m[5];
    farthest2 = std::max(farthest2, square(a, b, c));
  }
  EXPECT_LE(farthest2, around * around);
  EXPECT_GE(farthest2, around * around * (1 - millionth));
  for (std::uint32_t h = 0; h < view.half_edges.size() && !view.face_first.empty(); ++h) {
    const Point &a = points[origin(view, h)], &b = points[view.half_edges[h].head],
                &c = points[view.half_edges[next_in_facet(view, h)].head];
    Point u, v;
    for (std::size_t i = 0; i < 3; ++i) u[i] = b[i] - a[i], v[i] = c[i] - a[i];
    const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}, w = from_centre(a);
    const Number depth = n[0] * w[0] + n[1] * w[1] + n[2] * w[2],
                 wide2 = square(m[0] * n[0] + m[1] * n[1] + m[2] * n[2], m[3] * n[1] + m[4] * n[2], m[5] * n[2]);
    if (inside == 0) continue;
    EXPECT_GE(depth, 0);
    EXPECT_GE(depth * depth, inside * inside * wide2);
    const double rounding = 64 * kU * view.extent * std::sqrt(CGAL::to_double(square(n[0], n[1], n[2])));
    tight =
        tight || CGAL::to_double(depth) - rounding <= level.scale_inside * (1 + 0x1p-20) * std::sqrt(CGAL::to_double(wide2));
  }
  EXPECT_TRUE(tight) << "an ellipsoid of a scale above " << level.scale_inside << " is inside";
  return true;
}

TEST(Ellipsoids, LieAroundTheBodyAndInsideIt) {
  std::uint64_t seed = 900;
  int known = 0, unknown = 0, inside = 0;
  std::vector<Mesh> bodies = parts();
  for (const Mesh& mesh : {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), shapes::sliver(),
                           shapes::random_polytope(40, 1), shapes::pair(shapes::Family::Plate, 200).a,
                           shapes::pair(shapes::Family::Long, 200).b, shapes::polygon(9), shapes::segment(3), shapes::point()})
    bodies.push_back(mesh);
  for (const Mesh& part : bodies) {
    for (const Mesh& mesh : turned(part, seed++)) {
      const Model model = built(mesh);
      (expect_ellipsoids(model.level(0)) ? known : unknown) += 1;
      inside += model.level(0).scale_inside > 0;
      if (model.level_count() > 1) {
        EXPECT_EQ(model.level(1).scale_inside, 0);
      }
    }
  }
  EXPECT_GT(known, 50);
  EXPECT_GT(inside, 50);
  EXPECT_GT(unknown, 0) << "slivers have none";
}

/// A body that touches one of its ellipsoids in a point, in its own frame: the way there, or along the normal there, from its
/// centre, and how far it reaches along that way.
struct Reaching {
  Vec3 way;
  double reach;
};
Eigen::Matrix3d map_matrix(const Level& level) {
  const auto& m = level.map_frame;
  Eigen::Matrix3d of;
  of << m[0], m[1], m[2], 0, m[3], m[4], 0, 0, m[5];
  return of;
}
/// The normal of the ellipsoid around the body at its farthest vertex.
Reaching around(const Level& level) {
  const Eigen::Matrix3d m = map_matrix(level);
  Vec3 farthest = Vec3::Zero();
  for (const Vertex& v : level.view.vertices) {
    const Vec3 y = m.transpose().inverse() * (Vec3(v.x, v.y, v.z) - level.view.centre);
    if (y.norm() > farthest.norm()) farthest = y;
  }
  const Vec3 way = (m.inverse() * farthest).normalized();
  return {way, level.scale_around * (m * way).norm()};
}
/// The way to where the ellipsoid inside the body touches a facet.
Reaching inside(const Level& level) {
  const Eigen::Matrix3d m = map_matrix(level);
  const ConvexView& view = level.view;
  const auto point = [&](std::uint32_t v) { return Vec3(view.vertices[v].x, view.vertices[v].y, view.vertices[v].z); };
  double nearest = kInfinity;
  Vec3 normal = Vec3::UnitX();
  for (std::uint32_t h = 0; h < view.half_edges.size(); ++h) {
    const Vec3 a = point(origin(view, h)), b = point(view.half_edges[h].head),
               c = point(view.half_edges[next_in_facet(view, h)].head), n = (b - a).cross(c - a);
    const double scale = n.dot(a - view.centre) / (m * n).norm();
    if (scale < nearest) nearest = scale, normal = n;
  }
  const Vec3 way = (m.transpose() * (m * normal)).normalized();
  return {way, level.scale_inside / (m.transpose().inverse() * way).norm()};
}

/// Two bodies whose ellipsoids touch on the line of centres where they touch the bodies themselves, or miss that by little.
TEST(Ellipsoids, AnswerRightWhereTheyTouch) {
  shapes::Random random(77);
  std::vector<Model> models;
  for (const shapes::Family family : {shapes::Family::Fat, shapes::Family::Plate, shapes::Family::Long})
    models.push_back(built(shapes::pair(family, 200).a));
  for (const Mesh& mesh : {shapes::cube(), shapes::random_polytope(40, 3), shapes::tetrahedron()})
    for (const Mesh& one : turned(mesh, 5)) models.push_back(built(one));
  int apart = 0, meeting = 0;
  for (int i = 0; i < 4000; ++i) {
    const Model &a = models[random.bits() % models.size()], &b = models[random.bits() % models.size()];
    const bool meets = i % 2;
    const Level &of_a = a.level(0), &of_b = b.level(0);
    if (meets && !(of_a.scale_inside > 0 && of_b.scale_inside > 0)) continue;
    const Reaching from_a = meets ? inside(of_a) : around(of_a), from_b = meets ? inside(of_b) : around(of_b);
    Pose pose;
    pose.rotation = (Eigen::AngleAxisd(random.uniform(0, 6), from_a.way) *
                     Eigen::Quaterniond::FromTwoVectors(from_b.way, Vec3(-from_a.way)))
                        .toRotationMatrix();
    if (random.bits() & 1) pose.rotation = pose.rotation.cast<float>().cast<double>();
    const double off = random.uniform(-1, 1) * std::exp2(-random.uniform(4, 52)),
                 length = (from_a.reach + from_b.reach) * (1 + off);
    pose.translation = of_a.view.centre + length * from_a.way - pose.rotation * of_b.view.centre;
    const Answer answer = intersects(a, b, pose);
    const oracle::Truth truth = oracle::distance(bodies::points_of(of_a.view), bodies::points_of(of_b.view), pose);
    if (answer.verdict == Verdict::Disjoint) {
      EXPECT_TRUE(oracle::holds(truth, answer.lower, kInfinity));
    }
    EXPECT_NE(answer.verdict, truth.overlapping ? Verdict::Disjoint : Verdict::Overlapping);
    EXPECT_TRUE(bool(check(a, b, pose, answer)));
    const bool told = answer.feature_a.kind() == FeatureKind::None;  // no feature is named
    apart += told && answer.verdict == Verdict::Disjoint, meeting += told && answer.verdict == Verdict::Overlapping;
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(meeting, 300);
}

TEST(Reach, PrimitivesKnowIt) {
  shapes::Random random(9);
  const auto point = [&] { return Vec3(random.in_ball() + Vec3(1, 2, 3)); };
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = point(), q = point(), r = point();
    for (const Body& body :
         {Body::point(p), Body::segment(p, q), Body::triangle(p, q, r), Body::box(p.cwiseMin(q), p.cwiseMax(q)),
          Body::box(p.cwiseMin(q), p.cwiseMax(Vec3(q.x(), p.y(), q.z())))}) {
      const ShapeOf shape(body);
      const ConvexView& view = (*shape).level(0).view;
      expect_reach(view);
      for (std::uint32_t f = 0; f < view.planes.size(); ++f)
        EXPECT_LE(highest(view, rational_points(view), f), Number(view.planes[f].over));
    }
  }
}

}  // namespace
}  // namespace swiftlet
