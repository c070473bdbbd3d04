// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes against rational arithmetic over all pairs of their triangles, in families that are each made for one difficulty; and
// large ones against CGAL's trees. SWIFTLET_MESH_PAIRS=100000 asks about so many pairs instead of some 2 000.
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "mesh_families.h"
#include "painted_stack.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using mesh_families::approximate, mesh_families::at_least, mesh_families::at_most, mesh_families::Case;
using mesh_families::families, mesh_families::Family, mesh_families::Truth, mesh_families::truth;
using shapes::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of SWIFTLET_MESH_PAIRS, or else of so many that the default run is short.
int pairs_of_each_family() {
  const char* const wanted = std::getenv("SWIFTLET_MESH_PAIRS");
  return wanted ? std::max(1, std::atoi(wanted) / int(families().size())) : 90;
}

}  // namespace

namespace mesh_families {
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }  // not its bytes, which are addresses
}  // namespace mesh_families

namespace {

class Families : public testing::TestWithParam<Family> {};

TEST_P(Families, AgreeWithRationals) {
  const Family& family = GetParam();
  const int count = pairs_of_each_family();
  int touching = 0, apart = 0, verdicts[4] = {0, 0, 0, 0}, failed = 0, told = 0, regions = 0;
  double widest = 0;
  long decided = 0;
  std::uint64_t seed = 0;
  for (const char* letter = family.name; *letter; ++letter) seed = (seed + std::uint64_t(*letter)) * 0x100000001b3u;
  for (int i = 0; i < count; ++i) {
    Random random(seed + std::uint64_t(i));
    const Case c = family.make(random, i);
    const mesh_families::Examined seen = examine(c, random);
    const std::string& fault = seen.fault;
    decided += seen.truth.decided;
    ++(seen.truth.squared == 0 ? touching : apart);
    ++verdicts[int(seen.answer.verdict)];
    widest = std::max(widest, seen.width);
    told += seen.told, regions += seen.regions;
    if (fault.empty()) continue;
    ADD_FAILURE() << family.name << ' ' << i << ": " << fault;
    if (const char* const folder = std::getenv("SWIFTLET_MESH_FOUND")) {
      std::string name = std::string(family.name) + "_" + std::to_string(i) + ".txt";
      std::replace(name.begin(), name.end(), ' ', '_');
      std::ofstream(std::filesystem::path(folder) / name) << fault << '\n' << text(c);
    }
    if (++failed >= 10) break;
  }
  std::printf(
      "%s: %d touching, %d apart; %d undecided, %d disjoint, %d touching, %d overlapping; widest %.2f of law 2; %.1f exact "
      "pairs; %d regions, told apart for sure in %d\n",
      family.name, touching, apart, verdicts[0], verdicts[1], verdicts[2], verdicts[3], widest, double(decided) / count,
      regions, told);
  EXPECT_GE(told, count * 3 / 4);
  if (failed == 0) {
    EXPECT_GE(touching, family.touching * count);
    EXPECT_GE(apart, family.apart * count);
  }
}

INSTANTIATE_TEST_SUITE_P(Exact, Families, testing::ValuesIn(families().begin(), families().end()), [](const auto& family) {
  std::string name = family.param.name;
  std::erase_if(name, [](char x) { return !std::isalnum(static_cast<unsigned char>(x)); });
  return name;
});

/// The foot of a corner on a needle was taken from a normal that is wrong in doubles: it lay off the needle, and `upper` was
/// 0.0099763 and 0.34946.
TEST(Regress, FeetOnNeedlesWereNearerThanTheNeedles) {
  Case c[2];
  c[0].a.add({-0x1.6fff496a0f702p-1, -0x1.d4428ddfb0298p-2, -0x1.a449b081218cep-3},
             {-0x1.084f21bbd158bp+0, 0x1.f4cb5dc4fb799p-2, -0x1.c35cfaa781ed7p-4},
             {-0x1.9c401a7c6174bp-1, 0x1.bb55763407f06p-3, -0x1.f8f62bc2db67cp-3});
  c[0].b.add({-0x1.f546a240e9cd8p-3, -0x1.6ea27b4962568p-2, 0x1.6f927bdfda98p-6},
             {-0x1.203f588face85p+0, -0x1.2018541fc7c46p-1, -0x1.9d6704a3f54d3p-2},
             {-0x1.1bf1de20b8158p+0, -0x1.1e18bb0a3eebap-1, -0x1.951453a3c31cbp-2});
  c[1].a.add({0x1.1c9e4aae3fbd4p-3, -0x1.34ce396e04684p-3, -0x1.c4f54f69c4a6p-6},
             {-0x1.1170382d8a20ap-3, -0x1.dac7d6624b39bp-2, 0x1.01acb1899ab84p+0},
             {-0x1.9a2a29df1d29fp-2, -0x1.beb5f60b666bbp-2, 0x1.3ef98403ebe6bp+0});
  c[1].b.add({0x1.29d7a1a5f0348p-2, 0x1.daac13aed6414p-2, -0x1.920918daef5p-3},
             {0x1.c2cd4a880162ep-3, -0x1.fb87cd6e0b5aap-2, -0x1.e162bf9b61f27p-2},
             {0x1.1b23fdf39c571p-2, 0x1.13566dcb0c457p-2, -0x1.01eade7fe4179p-2});
  for (const Case& one : c) {
    const MeshModel a = one.a.mesh(), b = one.b.mesh();
    const Truth exactly = truth(one.a, one.b, one.pose);
    const double d = approximate(exactly);
    for (const Answer& answer : {distance(a, b, {}), intersects(a, b, {}), distance(a, b, {}, {.beyond = 0.99 * d}),
                                 within(a, b, {}, 0.5 * d).answer, within(a, b, {}, 0.99 * d).answer}) {
      EXPECT_TRUE(at_least(exactly, answer.lower)) << answer.lower << " against " << d;
      EXPECT_TRUE(at_most(exactly, answer.upper)) << answer.upper << " against " << d;
    }
  }
}

/// A corner over a splinter: rounding moved its foot along the splinter by 249 times law 2's bound, and the normal, that of the
/// face, did not lead there.
TEST(Regress, FeetOnSplintersLeanedAgainstTheNormal) {
  Case c;
  c.a.add({0x1.72dc8689cb168p-2, -0x1.1dfbaf9648945p+0, -0x1.7714607f5fb9p-5},
          {0x1.a68aebf2450ecp+0, -0x1.403ad88a75a73p-1, -0x1.1df84e152aa61p-2},
          {0x1.20b498738ab71p-1, -0x1.ad9c5c7059567p+0, -0x1.a688bca2a01e9p+0});
  c.b.add({-0x1.0d495340e12aep-1, 0x1.94ac93123cf9cp-2, -0x1.532dd6052682p-2},
          {-0x1.825dc582d536p-6, 0x1.cc1f09ed8ede8p-2, -0x1.31b630d9e8838p+0},
          {-0x1.d94f8fd339dd9p-2, 0x1.9bb5783fbc8dp-2, -0x1.c34b03a31624dp-2});
  c.pose.rotation << -0x1.1af7f43c44bc4p-1, -0x1.53aa5e316b548p-1, 0x1.0243818b5375fp-1, 0x1.5cfa8c3013d4ep-1,
      -0x1.79d06bcd068p-7, 0x1.7698de154ed84p-1, -0x1.eb111ab8a1773p-2, 0x1.7f0fdf7b7b41ep-1, 0x1.d58e7c894dc26p-2;
  c.pose.translation = {0x1.b1d26998819b6p-1, -0x1.82c612b609a94p-2, -0x1.53a652aa4c938p-3};
  Random random(1);
  EXPECT_EQ(examine(c, random).fault, "");
}

// ---- Large meshes ----------------------------------------------------------------------------------------------------------

constexpr double kMostSeconds = 2;  // of the processor

class LargeMeshes : public testing::Test {
 protected:
  /// Asks, and prints how long it took.
  template <class Question>
  auto timed(const char* what, const Question& question) {
    const std::clock_t start = std::clock();
    const auto answer = question();
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%s: %.3f s\n", what, seconds);
    EXPECT_LT(seconds, kMostSeconds) << what;
    return answer;
  }
};

TEST_F(LargeMeshes, ParallelSurfacesAreAsFarApartAsTheyWereMoved) {
  for (const double bump : {0.0, 0.3}) {
    const auto height = [=](double x, double y) { return bump * x * y; };
    const MeshModel mesh = patch(142, height).mesh();
    ASSERT_GE(mesh.triangle_count(), 40000u);
    const Pose up = shift(0, 0, 0.01);
    const Answer answer = timed(bump == 0 ? "parallel planes" : "parallel surfaces", [&] { return distance(mesh, mesh, up); });
    EXPECT_EQ(answer.status, Status::Converged);
    EXPECT_LE(answer.upper - answer.lower, tolerance(mesh, mesh, up));
    EXPECT_LE(answer.lower, 0.01);
    EXPECT_GE(answer.upper, bump == 0 ? 0.01 : 0);
    // Where it is steepest the surface is nearest to its copy.
    const double steepest = std::hypot(1, bump * std::hypot(1, 1));
    EXPECT_NEAR(answer.value(), 0.01 / steepest, bump == 0 ? 1e-14 : 1e-4);
    EXPECT_EQ(timed("at most 0.0099", [&] { return within(mesh, mesh, up, bump == 0 ? 0.0099 : 0.009); }).decision,
              Decision::No);
  }
}

TEST_F(LargeMeshes, CoplanarOnesThatTouchEnd) {
  const MeshModel mesh = patch(142, [](double, double) { return 0.0; }).mesh();
  Pose turned = shift(0.3, 0.2, 0);
  turned.rotation << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  for (const Pose& pose : {Pose{}, shift(0x1p-10, 0, 0), turned}) {
    const Answer answer = timed("coplanar, distance", [&] { return distance(mesh, mesh, pose); });
    EXPECT_EQ(answer.status, Status::Converged);
    EXPECT_EQ(answer.lower, 0);
    EXPECT_LE(answer.upper, tolerance(mesh, mesh, pose));
    EXPECT_EQ(answer.verdict, Verdict::Touching);
    EXPECT_EQ(timed("coplanar, intersects", [&] { return intersects(mesh, mesh, pose); }).verdict, Verdict::Touching);
    EXPECT_NE(timed("coplanar, within", [&] { return within(mesh, mesh, pose, 1e-3); }).decision, Decision::No);
  }
}

/// Every triangle touches those around it, in no common plane.
TEST_F(LargeMeshes, OnTheirOwnCopyEnd) {
  for (const int times : {3, 5}) {
    const MeshModel mesh = ball(times).mesh();
    const Answer answer =
        timed((std::to_string(mesh.triangle_count()) + " on their copy").c_str(), [&] { return distance(mesh, mesh, {}); });
    EXPECT_EQ(answer.lower, 0);
    EXPECT_EQ(answer.verdict, Verdict::Touching);
  }
}

/// The bunny, or where it is absent a torus of as many triangles.
Soup large_soup() {
  std::ifstream file(SWIFTLET_MESHES "/bunny.off");
  std::string magic;
  std::size_t points = 0, count = 0, edges = 0;
  if (!(file >> magic >> points >> count >> edges) || magic != "OFF") return torus(275, 137);
  Soup soup;
  soup.points.resize(points), soup.triangles.resize(count);
  for (Vec3& p : soup.points) file >> p.x() >> p.y() >> p.z();
  for (Corners& c : soup.triangles) file >> edges >> c[0] >> c[1] >> c[2];
  if (!file) throw std::runtime_error("bunny.off ends early");
  Vec3 least = soup.points[0], most = least;
  for (const Vec3& p : soup.points) least = least.cwiseMin(p), most = most.cwiseMax(p);
  return scaled(moved(std::move(soup), Mat3::Identity(), -(least + most) / 2), 2 / (most - least).maxCoeff());
}

TEST_F(LargeMeshes, AgreeWithTreesOfCgalAndWithPlainDoubles) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;
  const Soup soup = large_soup();
  const auto placed = [&](const Pose& pose) {
    Triangles all;
    for (const Corners& c : soup.triangles) {
      std::array<Kernel::Point_3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 q = pose.rotation * soup.points[c[k]] + pose.translation;
        p[k] = {q.x(), q.y(), q.z()};
      }
      all.emplace_back(p[0], p[1], p[2]);
    }
    return all;
  };
  const Triangles of_a = placed({});
  Tree tree(of_a.begin(), of_a.end());
  const MeshModel mesh = timed("made", [&] { return soup.mesh(); });
  const auto plain_a = triangles<double>(soup);
  Random random(70);
  int meet = 0, apart = 0;
  for (int i = 0; i < 10; ++i) {
    // Near, where either verdict comes up, and so far apart that spheres around the two are disjoint.
    const Pose pose{random.rotation(), (i < 6 ? random.uniform(0.5, 2.2) : 4) * random.on_sphere()};
    const Triangles of_b = placed(pose);
    const bool crossing = std::any_of(of_b.begin(), of_b.end(), [&](const auto& t) { return tree.do_intersect(t); });
    MeshSeed seed;
    const Answer answer = timed("distance", [&] { return distance(mesh, mesh, pose, seed); });
    ASSERT_EQ(answer.status, Status::Converged);
    EXPECT_EQ(answer.verdict, crossing ? Verdict::Overlapping : Verdict::Disjoint);
    EXPECT_EQ(timed("intersects", [&] { return intersects(mesh, mesh, pose); }).verdict, answer.verdict);
    ++(crossing ? meet : apart);
    if (crossing) continue;
    const auto far_from = [](Tree& from, const Vec3& p) {
      return std::sqrt(from.squared_distance(Kernel::Point_3(p.x(), p.y(), p.z())));
    };
    Tree tree_b(of_b.begin(), of_b.end());
    EXPECT_LE(far_from(tree, answer.point_a), 1e-13);
    EXPECT_LE(far_from(tree_b, answer.point_b), 1e-13);
    // The triangles of B around its nearest point, and some anywhere, against all of A.
    const auto plain_b = triangles<double>(soup, pose);
    std::vector<std::size_t> order(plain_b.size());
    for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
    const auto off = [&](std::size_t t) {
      return (Vec3(plain_b[t][0].x, plain_b[t][0].y, plain_b[t][0].z) - answer.point_b).norm();
    };
    std::partial_sort(order.begin(), order.begin() + 10, order.end(),
                      [&](std::size_t x, std::size_t y) { return off(x) < off(y); });
    double least = kInfinity;
    for (std::size_t k = 0; k < 15; ++k) {
      const auto& t = plain_b[k < 10 ? order[k] : random.bits() % order.size()];
      for (const auto& s : plain_a) least = std::min(least, nearest(s, t).squared);
    }
    EXPECT_LE(answer.lower, std::sqrt(least) + 1e-13);
    EXPECT_GE(answer.upper, std::sqrt(least) - 1e-13);
    for (int k = 0; k < 2000; ++k) {
      const Vec3& q = soup.points[random.bits() % soup.points.size()];
      ASSERT_LE(answer.lower, far_from(tree, pose.rotation * q + pose.translation) + 1e-13);
    }
  }
  EXPECT_GE(meet, 2);
  EXPECT_GE(apart, 4);
}

TEST(MeshStack, OfAQueryIsWhatItsCostLineSays) {
  Random random(5);
  PaintedStack stack;
  std::size_t most = 0;
  for (int i = -1; i < 200; ++i) {
    const MeshModel a = any(random).mesh(), b = any(random).mesh();
    const Pose pose = any_pose(random, i % 2 ? 1 : 6);
    MeshSeed seed;
    Answer answer;
    const std::size_t used =
        std::max({stack.use([&] { answer = distance(a, b, pose, seed); }), stack.use([&] { intersects(a, b, pose, seed); }),
                  stack.use([&] { within(a, b, pose, 0.5, seed); }), stack.use([&] { closest_features(a, b, pose); })});
    if (i < 0) continue;  // what is called for the first time is looked up by the loader, on this stack
    most = std::max(most, used);
  }
  std::printf("bytes of stack: %zu\n", most);
  EXPECT_GE(most, 10000u) << "nothing was measured";
  if (!kIsMeasured) GTEST_SKIP() << "not optimised, or with a sanitizer's own variables";
  EXPECT_LE(most, 34'000u);
}

}  // namespace
}  // namespace swiftlet
