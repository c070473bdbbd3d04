// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Closed meshes as solids, against rational rays (solid_truth.h).
#include <swiftlet/mesh_batch.h>
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include <inside.h>

#include "painted_stack.h"
#include "solid_truth.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The truth -------------------------------------------------------------------------------------------------------------

struct Case {
  Soup a, b;
  Pose pose;
  bool solid_a = true, solid_b = true;
};

/// What is true of two bodies.
struct Truth {
  double distance;   ///< of the surfaces, in long doubles
  bool touching;     ///< the surfaces share a point: exact
  bool contained;    ///< they do not, and a vertex of one is inside the other: exact
  double depth = 0;  ///< at least, where `contained`
};

Truth truth(const Case& c) {
  const auto of_a = triangles<long double>(c.a), of_b = triangles<long double>(c.b, c.pose);
  const auto exact_a = triangles<Number>(c.a), exact_b = triangles<Number>(c.b, c.pose);
  long double size = 0;
  for (const auto* all : {&of_a, &of_b})
    for (const auto& t : *all)
      for (const auto& p : t) size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  long double least = HUGE_VALL;
  Truth result{0, false, false};
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    for (std::size_t k = 0; k < of_b.size(); ++k) {
      const long double squared = nearest(of_a[i], of_b[k]).squared;
      least = std::min(least, squared);
      if (std::sqrt(squared) < 1e-14L * size && !result.touching)
        result.touching = sign(nearest(exact_a[i], exact_b[k]).squared) == 0;
    }
  }
  result.distance = double(std::sqrt(least));
  if (result.touching) return result;
  const auto look = [&](const auto& solid, const auto& guest) {
    for (const auto& t : guest) {
      if (!inside(solid, t[0])) continue;
      result.contained = true;
      result.depth = std::max(result.depth, std::sqrt(CGAL::to_double(squared_distance(solid, t[0]))));
    }
  };
  if (c.solid_a) look(exact_a, exact_b);
  if (c.solid_b) look(exact_b, exact_a);
  return result;
}

// ---- Bodies ----------------------------------------------------------------------------------------------------------------

double pick(Random& random, std::initializer_list<double> from) { return from.begin()[random.bits() % from.size()]; }
Soup turned_inside_out(Soup soup) {
  for (Corners& c : soup.triangles) std::swap(c[1], c[2]);
  return soup;
}
/// Closed, of one component.
Soup shell(Random& r) {
  Soup soup;
  switch (r.bits() % 6) {
    case 0: soup = ball(1); break;
    case 1: soup = torus(4 + std::uint32_t(r.bits() % 4), 3 + std::uint32_t(r.bits() % 2), r.uniform(0.2, 0.6)); break;
    case 2: soup = tetrahedron(); break;
    case 3: soup = box({-1, -1, -1}, {1, 1, 1}); break;
    case 4: soup = box(-Vec3(r.uniform(0.2, 1), r.uniform(0.2, 1), r.uniform(0.2, 1)), Vec3(r.uniform(0.2, 1), 1, 0.5)); break;
    default: {
      soup = ball(1);  // dented and bumped, equal points alike
      const Vec3 wave = 5 * r.in_ball();
      for (Vec3& p : soup.points) p *= 0.7 + 0.3 * std::sin(wave.dot(p));
    }
  }
  return r.bits() % 3 ? soup : turned_inside_out(std::move(soup));
}
/// Closed: a shell, one with a cavity, or one with a cavity that holds another.
Soup closed(Random& r) {
  Soup soup = shell(r);
  const Soup whole = soup;
  for (std::uint64_t k = r.bits() % 4, i = 1; i < k; ++i) soup.add(scaled(whole, 1 - 0.3 * double(i)));
  return soup;
}

Case anywhere(Random& r, int) { return {closed(r), scaled(closed(r), pick(r, {1, 0.1, 0.1, 0.05})), any_pose(r, 1)}; }
/// On a lattice: rays along axes meet vertices and edges.
Case on_axes(Random& r, int) {
  Case c{closed(r), scaled(closed(r), pick(r, {0.5, 0.25, 0.125})), {lattice_rotation(r), Vec3::Zero()}};
  for (double& x : c.pose.translation) x = double(int(r.bits() % 9) - 4) / 8;
  return c;
}
/// A vertex under or above vertices, edges and faces of the other, by one coordinate.
Case below_vertices(Random& r, int) {
  Case c{closed(r), scaled(tetrahedron(), 0x1p-6), {}};
  const Corners& t = c.a.triangles[r.bits() % c.a.triangles.size()];
  const Vec3 &p = c.a.points[t[0]], &q = c.a.points[t[1]];
  Vec3 at = r.bits() % 2 ? p : Vec3((p + q) / 2);
  at[int(r.bits() % 3)] = r.uniform(-1, 1);
  c.pose.translation = at - c.b.points[0];
  return c;
}
/// One just inside or outside the other: all of it is near the other's surface.
Case tight(Random& r, int) {
  Case c{shell(r), {}, {}};
  c.b = c.a;
  const double gap = std::pow(2, -double(20 + r.bits() % 34));
  c.b = scaled(c.b, r.bits() % 2 ? 1 - gap : 1 - 2 * gap);
  if (r.bits() % 2) c.pose.rotation = lattice_rotation(r);
  return c;
}
/// Inside, and touching from inside.
Case touching(Random& r, int i) {
  Case c{box({-1, -1, -1}, {1, 1, 1}), box({-1, -0.5, -0.5}, {0, 0.5, 0.5}), {}};
  if (i % 4 == 1) c.b = c.a;
  if (i % 4 == 2) c.b = box({-1, -1, -0.5}, {1, 1, 0.5});
  if (i % 4 == 3) c.b = box({1, -0.5, -0.5}, {2, 0.5, 0.5});
  if (r.bits() % 2) c.pose.rotation = lattice_rotation(r);
  if (r.bits() % 2) std::swap(c.a, c.b), c.pose = inverse(c.pose);
  return c;
}
Case far_away(Random& r, int i) {
  Case c = anywhere(r, i);
  const Vec3 of_a = 1e6 * r.on_sphere(), of_b = 1e6 * r.on_sphere();
  c.a = moved(c.a, Mat3::Identity(), of_a), c.b = moved(c.b, Mat3::Identity(), of_b);
  c.pose.translation += of_a - c.pose.rotation * of_b;
  return c;
}
Case powers(Random& r, int i) {
  Case c = i % 2 ? on_axes(r, i) : anywhere(r, i);
  const double s = std::ldexp(1, i % 4 < 2 ? 130 : -120);
  c.a = scaled(c.a, s), c.b = scaled(c.b, s), c.pose.translation *= s;
  for (Soup* soup : {&c.a, &c.b})  // what is too small for a mesh is 0
    for (Vec3& p : soup->points)
      for (double& x : p) x = std::fabs(x) < 1e-45 ? 0 : x;
  return c;
}
Case bent(Random& r, int i) {
  Case c = i % 2 ? anywhere(r, i) : tight(r, i);
  for (int k = 0; k < 3; ++k) c.pose.rotation.col(k) += 2e-7 * r.in_ball();
  return c;
}
Case huge_and_tiny(Random& r, int) {
  Case c{scaled(closed(r), 1e8), closed(r), {r.rotation(), Vec3(1.2e8 * r.in_ball())}};
  if (r.bits() % 2) std::swap(c.a, c.b), c.pose = inverse(c.pose);
  return c;
}
/// Crumbs, of which one may be inside.
Case debris(Random& r, int) {
  Case c{closed(r), {}, any_pose(r, 0.5)};
  for (int i = 0; i < 12; ++i) c.b.add(moved(scaled(tetrahedron(), 0.02), r.rotation(), (i ? 3 : 0.5) * r.on_sphere()));
  return c;
}

struct Family {
  const char* name;
  Case (*make)(Random&, int);
  double contained, apart, met;  ///< the least shares of its pairs
};
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }
const Family kFamilies[] = {
    {"anywhere", anywhere, 0.1, 0.1, 0}, {"on axes", on_axes, 0.1, 0.02, 0}, {"below vertices", below_vertices, 0.05, 0.1, 0},
    {"tight", tight, 0.1, 0, 0},         {"touching", touching, 0, 0, 0.9},  {"far away", far_away, 0.1, 0.1, 0},
    {"powers", powers, 0.1, 0.02, 0},    {"bent", bent, 0.1, 0.02, 0},       {"huge and tiny", huge_and_tiny, 0.05, 0.05, 0},
    {"debris", debris, 0.1, 0.05, 0}};

class Solids : public testing::TestWithParam<Family> {};

/// What is wrong with an answer, "" if nothing.
std::string fault(const Case& c, const Truth& t, const Answer& answer, double law_two) {
  std::ostringstream out;
  out.precision(17);
  const auto wrong = [&](const char* what) {
    out << what << ": [" << answer.lower << ", " << answer.upper << "], verdict " << int(answer.verdict) << ", status "
        << int(answer.status) << "; surfaces are " << t.distance << " apart, contained " << t.contained << ", touching "
        << t.touching;
    return out.str();
  };
  const double slack = law_two / 64;
  if (t.contained && answer.lower > 0) return wrong("apart, but one is inside");
  if (t.contained && t.depth > 2 * law_two && answer.verdict != Verdict::Overlapping && answer.verdict != Verdict::Undecided)
    return wrong("one is inside");
  if (!t.contained && !t.touching && answer.verdict == Verdict::Overlapping) return wrong("they overlap nowhere");
  if (!t.contained && !(answer.upper >= t.distance - slack)) return wrong("upper is below the truth");
  if (answer.lower > t.distance + slack) return wrong("lower is above the truth");
  if (t.touching && answer.verdict == Verdict::Disjoint) return wrong("Disjoint, but they share a point");
  if (answer.verdict == Verdict::Overlapping) {
    if (answer.lower != 0 || answer.upper != 0) return wrong("an overlap with a distance");
    const Point<Number> p = point<Number>(answer.point_a);
    for (const bool of_a : {true, false}) {
      const auto all = of_a ? triangles<Number>(c.a) : triangles<Number>(c.b, c.pose);
      const bool on = CGAL::to_double(squared_distance(all, p)) <= law_two * law_two;
      if (!on && !((of_a ? c.solid_a : c.solid_b) && inside(all, p))) return wrong("the point is not in both");
    }
  }
  return "";
}

TEST_P(Solids, AgreeWithRationalRays) {
  const Family& family = GetParam();
  int contained = 0, apart = 0, met = 0, failed = 0;
  std::map<Verdict, int> verdicts;
  std::uint64_t seed = 0;
  for (const char* letter = family.name; *letter; ++letter) seed = (seed + std::uint64_t(*letter)) * 0x100000001b3u;
  const int count = 40;
  for (int i = 0; i < count && failed < 5; ++i) {
    Random random(seed + std::uint64_t(i));
    Case c = family.make(random, i);
    c.solid_a = random.bits() % 4 != 0, c.solid_b = random.bits() % 4 != 0;
    const MeshModel mesh_a = c.a.mesh(), mesh_b = c.b.mesh();
    const MeshBody a = c.solid_a ? MeshBody::solid(mesh_a) : MeshBody(mesh_a),
                   b = c.solid_b ? MeshBody::solid(mesh_b) : MeshBody(mesh_b);
    const Truth t = truth(c);
    const double law_two = tolerance(a, b, c.pose);
    ++(t.contained ? contained : t.touching ? met : apart);
    const auto expect = [&](const char* what, const Answer& answer, bool exact) {
      const std::string f = fault(c, t, answer, law_two);
      if (!f.empty()) ADD_FAILURE() << family.name << ' ' << i << ", " << what << ": " << f, ++failed;
      if (!exact) return;
      EXPECT_EQ(answer.status, Status::Converged) << family.name << ' ' << i << ", " << what;
      EXPECT_LE(answer.upper - answer.lower, law_two);
      EXPECT_NE(answer.verdict, Verdict::Undecided) << family.name << ' ' << i << ", " << what;
      if (t.contained && t.depth > 2 * law_two) {
        EXPECT_EQ(answer.verdict, Verdict::Overlapping) << family.name << ' ' << i << ", " << what;
      }
      if (!t.contained && t.distance > law_two) {
        EXPECT_EQ(answer.verdict, Verdict::Disjoint) << family.name << ' ' << i << ", " << what;
      }
      const Check checked = check(a, b, c.pose, answer);
      EXPECT_TRUE(checked) << family.name << ' ' << i << ", " << what << ": " << checked.message;
    };
    MeshSeed warm;
    const Answer answer = distance(a, b, c.pose, warm);
    ++verdicts[answer.verdict];
    expect("distance", answer, true);
    expect("distance, warm", distance(a, b, c.pose, warm), true);
    expect("closest features", closest_features(a, b, c.pose).answer, true);
    const Answer yes_or_no = intersects(a, b, c.pose);
    expect("intersects", yes_or_no, false);
    EXPECT_EQ(yes_or_no.verdict == Verdict::Disjoint, answer.verdict == Verdict::Disjoint) << family.name << ' ' << i;
    expect("distance to 10 %", distance(a, b, c.pose, {.relative = 0.1}), false);
    expect("distance beyond 0", distance(a, b, c.pose, {.beyond = 0}), false);
    expect("distance of few steps", distance(a, b, c.pose, {.budget = {.steps = 3}}), false);
    const double d = t.contained || t.touching ? 0 : t.distance;
    for (const double threshold : {0.0, 0.5 * d, 2 * d + 1e-3}) {
      const Within w = within(a, b, c.pose, threshold);
      if (std::fabs(threshold - d) <= law_two) continue;
      EXPECT_EQ(w.decision, d <= threshold ? Decision::Yes : Decision::No) << family.name << ' ' << i << ", " << threshold;
    }
    // What the surfaces answer is the answer about the solids wherever neither is inside the other.
    if (!t.contained && t.distance > law_two) {
      const Answer plain = distance(mesh_a, mesh_b, c.pose);
      EXPECT_EQ(plain.lower, answer.lower);
      EXPECT_EQ(plain.upper, answer.upper);
    }
    const double radius = random.uniform(0, 0.5);
    const MeshBody round = c.solid_a ? MeshBody::solid(mesh_a, radius) : MeshBody(mesh_a, radius);
    const Answer with_radius = distance(round, b, c.pose);
    EXPECT_LE(with_radius.lower, std::max(0.0, d - radius) + 2 * tolerance(round, b, c.pose));
    EXPECT_GE(with_radius.upper, std::max(0.0, d - radius) - 2 * tolerance(round, b, c.pose));
    if (t.contained && t.depth > 2 * law_two) {
      EXPECT_EQ(with_radius.verdict, Verdict::Overlapping);
    }
  }
  std::printf("%s: %d contained, %d meet, %d apart; %d undecided, %d disjoint, %d touching, %d overlapping\n", family.name,
              contained, met, apart, verdicts[Verdict::Undecided], verdicts[Verdict::Disjoint], verdicts[Verdict::Touching],
              verdicts[Verdict::Overlapping]);
  EXPECT_GE(contained, family.contained * count);
  EXPECT_GE(apart, family.apart * count);
  EXPECT_GE(met, family.met * count);
}

INSTANTIATE_TEST_SUITE_P(Exact, Solids, testing::ValuesIn(kFamilies), [](const auto& family) {
  std::string name = family.param.name;
  std::erase_if(name, [](char x) { return !std::isalnum(static_cast<unsigned char>(x)); });
  return name;
});

// ---- Points ----------------------------------------------------------------------------------------------------------------

TEST(Enclosure, OfAPointIsTheParityOfARationalRay) {
  int of[2] = {0, 0};
  for (int i = 0; i < 160; ++i) {
    Random random(std::uint64_t(900 + i));
    Soup soup = closed(random);
    if (i % 5 == 4) soup = moved(std::move(soup), random.rotation(), 1e6 * random.on_sphere());
    const MeshModel mesh = soup.mesh();
    const bool is_b = i % 2 != 0, lattice = i % 3 == 0;
    const Vec3 middle = (mesh.box_min() + mesh.box_max()) / 2;
    Pose pose{lattice ? lattice_rotation(random) : random.rotation(), Vec3::Zero()};
    if (!lattice) pose.translation = random.in_ball();
    if (i % 7 == 6) pose.rotation.col(0) += 3e-7 * random.in_ball();
    const Enclosure volume(MeshReader::content(mesh), pose, is_b);
    // Where the mesh is in the other's frame: exactly if it is B, and else by the pose's inverse.
    const Pose there = is_b ? pose : inverse(pose);
    const auto exact = triangles<Number>(soup, is_b ? pose : Pose{});
    for (int k = 0; k < 10; ++k) {
      Vec3 p = middle;
      if (lattice) {
        const Vec3 v = soup.points[random.bits() % soup.points.size()];  // in line with a vertex
        p = v;
        p[int(random.bits() % 3)] = middle[int(random.bits() % 3)] + double(int(random.bits() % 9) - 4) / 8;
      } else {
        p += random.in_ball();
      }
      const Vec3 q = there.rotation * p + there.translation;
      const Point<Number> at = is_b ? point<Number>(q) : apply<Number>(pose, q);
      if (sign(squared_distance(exact, at)) == 0) continue;
      const bool truth = inside(exact, at);
      ASSERT_EQ(volume.holds({q.x(), q.y(), q.z()}), truth) << i << ' ' << k;
      ASSERT_EQ(volume.holds_without_tree({q.x(), q.y(), q.z()}), truth) << i << ' ' << k;
      ++of[truth];
    }
  }
  EXPECT_GE(of[0], 200);
  EXPECT_GE(of[1], 200);
}

// ---- Queries ---------------------------------------------------------------------------------------------------------------

const Soup& large() {
  static const Soup soup = box({-1, -1, -1}, {1, 1, 1});
  return soup;
}

TEST(Solid, ThatIsNoVolumeIsRefused) {
  Soup open = large();
  open.triangles.pop_back();
  Soup flipped = large();
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  const MeshModel closed_mesh = large().mesh();
  for (const Soup& soup : {open, flipped}) {
    const MeshModel mesh = soup.mesh();
    const MeshBody body = MeshBody::solid(mesh);
    EXPECT_TRUE(body.is_solid());
    for (const Answer& answer : {distance(body, closed_mesh, {}), intersects(closed_mesh, body, {}),
                                 within(body, closed_mesh, {}, 1).answer, closest_features(body, closed_mesh, {}).answer}) {
      EXPECT_EQ(answer.status, Status::InvalidBody);
      EXPECT_EQ(answer.upper, kInfinity);
    }
    EXPECT_TRUE(std::isnan(tolerance(body, closed_mesh, {})));
    EXPECT_TRUE(check(body, closed_mesh, {}, distance(body, closed_mesh, {})));
    EXPECT_NE(distance(mesh, closed_mesh, {}).status, Status::InvalidBody) << "a surface is a body";
  }
}

TEST(Solid, HoldsConvexBodies) {
  const MeshModel mesh = large().mesh(), ring = torus(24, 12).mesh();
  const Body bodies[] = {Body::point({0.1, 0.2, 0.3}), Body::segment({0, 0, 0}, {0.1, 0, 0.2}),
                         Body::triangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}), Body::box({0, 0, 0}, {0.1, 0.1, 0.1}),
                         Body::point({0, 0, 0}, 0.25)};
  for (const Body& body : bodies) {
    for (const bool swapped : {false, true}) {
      const auto ask = [&](const MeshModel& of, bool solid) {
        const MeshBody x = solid ? MeshBody::solid(of) : MeshBody(of);
        const Answer answer = swapped ? distance(body, x, {}) : distance(x, body, {});
        EXPECT_TRUE(swapped ? check(body, x, {}, answer) : check(x, body, {}, answer));
        return answer;
      };
      EXPECT_EQ(ask(mesh, true).verdict, Verdict::Overlapping);
      EXPECT_EQ(ask(mesh, true).upper, 0);
      EXPECT_EQ(ask(mesh, false).verdict, Verdict::Disjoint);
      EXPECT_EQ(ask(ring, true).verdict, Verdict::Disjoint) << "in the hole of a ring";
    }
  }
}

TEST(Solid, WithACavityIsApartFromWhatIsInIt) {
  Soup hollow = large();
  hollow.add(scaled(large(), 0.5));  // its triangles face outwards, too
  const MeshModel walls = hollow.mesh(), small = scaled(large(), 0.125).mesh();
  const Answer in_cavity = distance(MeshBody::solid(walls), MeshBody::solid(small), {});
  EXPECT_EQ(in_cavity.verdict, Verdict::Disjoint);
  EXPECT_NEAR(in_cavity.value(), 0.375, 1e-14);
  const Answer in_wall = distance(MeshBody::solid(walls), MeshBody::solid(small), shift(0.75, 0, 0));
  EXPECT_EQ(in_wall.verdict, Verdict::Overlapping);
  EXPECT_EQ(in_wall.point_a, in_wall.point_b);
  EXPECT_NEAR((in_wall.point_a - Vec3(0.75, 0, 0)).cwiseAbs().maxCoeff(), 0.125, 1e-15);
  EXPECT_EQ(in_wall.feature_a, FeatureId());
  EXPECT_EQ(in_wall.feature_b.kind(), FeatureKind::Vertex);
}

/// All that two equal boxes moved along a lattice have inside each other may be far from their vertices and middles.
TEST(Solid, ThatIsFlushAllAroundOverlaps) {
  const Soup cube = box({-2, -2, -2}, {2, 2, 2});
  const MeshModel mesh = cube.mesh();
  const Body convex = Body::box({-2, -2, -2}, {2, 2, 2});
  const MeshBody solid = MeshBody::solid(mesh);
  Random random(8);
  for (int i = 0; i < 7 * 7 * 7; ++i) {
    const Pose pose{i % 2 ? lattice_rotation(random) : Mat3::Identity(), Vec3(i % 7 - 3, i / 7 % 7 - 3, i / 49 - 3)};
    EXPECT_EQ(intersects(solid, solid, pose).verdict, Verdict::Overlapping) << pose.translation.transpose();
    EXPECT_EQ(intersects(solid, convex, pose).verdict, Verdict::Overlapping) << pose.translation.transpose();
    EXPECT_EQ(intersects(convex, solid, pose).verdict, Verdict::Overlapping) << pose.translation.transpose();
    const Answer answer = distance(solid, convex, pose);
    EXPECT_EQ(answer.verdict, Verdict::Overlapping);
    EXPECT_TRUE(check(solid, convex, pose, answer));
  }
}

/// Surfaces that touch without crossing say nothing about volumes.
TEST(Solid, ThatTouchesFromInsideOverlaps) {
  const MeshModel outer = large().mesh();
  const auto verdict = [&](const Soup& soup, const Pose& pose) {
    const MeshModel inner = soup.mesh();
    const Verdict there = intersects(MeshBody::solid(outer), MeshBody::solid(inner), pose).verdict;
    EXPECT_EQ(intersects(MeshBody::solid(inner), MeshBody::solid(outer), inverse(pose)).verdict, there);
    EXPECT_EQ(distance(MeshBody::solid(outer), MeshBody::solid(inner), pose).verdict, there);
    return there;
  };
  EXPECT_EQ(verdict(large(), {}), Verdict::Overlapping) << "the same solid";
  EXPECT_EQ(verdict(scaled(large(), 0.5), shift(0.5, 0, 0)), Verdict::Overlapping) << "on the wall inside";
  EXPECT_EQ(verdict(scaled(large(), 0.5), shift(0.5, 0.5, 0.5)), Verdict::Overlapping) << "in the corner inside";
  EXPECT_EQ(verdict(box({-1, -1, -0.5}, {1, 1, 0.5}), {}), Verdict::Overlapping) << "a slice, all vertices on edges";
  EXPECT_EQ(verdict(large(), shift(1, 0, 0)), Verdict::Overlapping) << "moved along a side";
  EXPECT_EQ(verdict(large(), shift(2, 0, 0)), Verdict::Touching) << "side by side";
  EXPECT_EQ(verdict(large(), shift(2, 2, 0)), Verdict::Touching) << "edge to edge";
  EXPECT_EQ(verdict(scaled(large(), 0.5), shift(1.5, 0, 0)), Verdict::Touching) << "on the wall outside";
}

TEST(Solid, AnswersInBatchesFromAnySeedSwappedAndScaledAlike) {
  Random random(3);
  int inside_count = 0;
  for (int i = 0; i < 60; ++i) {
    Case c = i % 2 ? anywhere(random, i) : on_axes(random, i);
    for (Soup* soup : {&c.a, &c.b})  // coordinates that a power of 2^-60 leaves legal
      for (Vec3& p : soup->points) p = (p * 0x1p20).array().round() * 0x1p-20;
    const MeshModel mesh_a = c.a.mesh(), mesh_b = c.b.mesh();
    if (!mesh_a.topology().closed() || !mesh_b.topology().closed()) continue;
    const MeshBody a = MeshBody::solid(mesh_a), b = MeshBody::solid(mesh_b);
    const Answer answer = distance(a, b, c.pose);
    inside_count += answer.verdict == Verdict::Overlapping && answer.feature_a.kind() != answer.feature_b.kind();
    MeshSeed garbage{std::uint32_t(random.bits() % 40), std::uint32_t(random.bits() % 40), {1, 2, 3}, {}};
    EXPECT_EQ(distance(a, b, c.pose, garbage).verdict, answer.verdict);
    EXPECT_EQ(distance(b, a, inverse(c.pose)).verdict == Verdict::Disjoint, answer.verdict == Verdict::Disjoint);
    const Pose poses[] = {c.pose, c.pose};
    Answer batch[2];
    distance(a, b, poses, batch);
    EXPECT_EQ(std::memcmp(&batch[0], &answer, sizeof answer), 0);
    const double s = 0x1p-60;
    const MeshModel scaled_a = scaled(c.a, s).mesh(), scaled_b = scaled(c.b, s).mesh();
    Answer of_scaled =
        distance(MeshBody::solid(scaled_a), MeshBody::solid(scaled_b), {c.pose.rotation, s * c.pose.translation});
    of_scaled.lower /= s, of_scaled.upper /= s, of_scaled.point_a /= s, of_scaled.point_b /= s;
    EXPECT_EQ(std::memcmp(&of_scaled, &answer, sizeof answer), 0) << i;
  }
  EXPECT_GE(inside_count, 5);
}

TEST(SolidStack, OfAQueryIsWhatItsCostLineSays) {
  Random random(5);
  PaintedStack stack;
  std::size_t most = 0;
  for (int i = -1; i < 100; ++i) {
    const Case c = i % 2 ? touching(random, i + 1) : tight(random, i);
    const MeshModel mesh_a = c.a.mesh(), mesh_b = c.b.mesh();
    const MeshBody a = MeshBody::solid(mesh_a), b = MeshBody::solid(mesh_b);
    const Body half = Body::box({-1, -0.5, -0.5}, {0, 0.5, 0.5});
    const std::size_t used = std::max({stack.use([&] { distance(a, b, c.pose); }), stack.use([&] { intersects(a, b, c.pose); }),
                                       stack.use([&] { distance(a, half, c.pose); })});
    if (i >= 0) most = std::max(most, used);  // what is called for the first time is looked up by the loader, on this stack
  }
  std::printf("bytes of stack: %zu\n", most);
  EXPECT_GE(most, 10000u) << "nothing was measured";
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(most, 34'000u);
}

}  // namespace
}  // namespace swiftlet
