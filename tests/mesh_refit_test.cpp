// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose points have moved, against the same points made into a mesh anew and brute force over all pairs of triangles.
#include <swiftlet/mesh_query.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "mesh_blocks.h"
#include "soups.h"

namespace swiftlet {
namespace {

using namespace soups;
using shapes::Random;

MeshModel refitted(const MeshModel& mesh, const std::vector<Vec3>& points) {
  Result<MeshModel> result = refit(mesh, points);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}
/// Equal points move alike.
Soup bent(Soup soup, Random& random, double by) {
  const Vec3 wave = 4 * random.in_ball(), way = by * random.in_ball();
  for (Vec3& p : soup.points) p += std::sin(wave.dot(p) + 1) * way;
  return soup;
}

TEST(Refit, OfPointsThatStayChangesNoByte) {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    Soup soup = i < 50 ? any(random) : scattered(random, 2000, 0.1);
    if (i % 7 == 3) soup = scaled(std::move(soup), 1e40);
    if (i % 7 == 5) soup = moved(std::move(soup), Mat3::Identity(), {1e6, 0, -1e7});
    const MeshModel mesh = soup.mesh();
    for (Vec3& p : soup.points)
      for (double& x : p) x = x == 0 ? -0.0 : x;
    const MeshModel same = refitted(mesh, soup.points);
    ASSERT_TRUE(std::equal(mesh.bytes().begin(), mesh.bytes().end(), same.bytes().begin(), same.bytes().end())) << i;
  }
}

TEST(Refit, OfMovedPointsIsProvedAndTrue) {
  Random random(2);
  int apart = 0, met = 0, units = 0;
  for (int i = 0; i < 120; ++i) {
    const Soup before = i % 10 ? any(random) : ball(3), other = any(random);
    Soup after = bent(before, random, i % 3 ? 0.3 : 2);
    if (i % 5 == 4)  // torn to pieces: all points elsewhere
      for (Vec3& p : after.points) p = p.cwiseProduct(Vec3(-1, 2, 3)) + 0.3 * random.in_ball();
    if (i % 6 == 5) after = scaled(std::move(after), std::ldexp(1, int(random.bits() % 60) - 30));
    if (i % 12 == 7)
      for (Vec3& p : after.points) p.z() = 0.25;  // all flat
    const MeshModel mesh = before.mesh(), moved_mesh = refitted(mesh, after.points), b = other.mesh();
    // Points of one place were one vertex: the first of them counts.
    Soup joined = after;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        joined.triangles[mesh.source_triangle()[t]][k] = mesh.source_vertex()[mesh.triangle(t)[k]];
    const Check verified = verify(moved_mesh);
    ASSERT_TRUE(verified) << i << ": " << verified.message;
    units += moved_mesh.extent() > 4 * mesh.extent() || moved_mesh.extent() < mesh.extent() / 4;
    ASSERT_EQ(moved_mesh.triangle_count(), mesh.triangle_count());
    ASSERT_TRUE(std::equal(mesh.source_triangle().begin(), mesh.source_triangle().end(), moved_mesh.source_triangle().begin()));
    ASSERT_TRUE(std::equal(mesh.source_vertex().begin(), mesh.source_vertex().end(), moved_mesh.source_vertex().begin()));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      ASSERT_EQ(mesh.triangle(t), moved_mesh.triangle(t));
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(moved_mesh.vertex(mesh.triangle(t)[k]), joined.corner(mesh.source_triangle()[t], k) + Vec3(0, 0, 0));
    }
    const MeshModel anew = joined.mesh();
    ASSERT_EQ(moved_mesh.topology().flat_triangles, anew.topology().flat_triangles);
    if (anew.vertex_count() == mesh.vertex_count()) {
      ASSERT_EQ(moved_mesh.topology(), anew.topology());
    }
    ASSERT_EQ(moved_mesh.box_min(), anew.box_min());
    ASSERT_EQ(moved_mesh.box_max(), anew.box_max());
    for (const double reach : {1.0, 2.5}) {
      const double size = std::max(moved_mesh.extent(), b.extent());
      const Pose pose = any_pose(random, reach * size);
      const double truth = brute_force(joined, other, pose), bound = tolerance(moved_mesh, b, pose);
      const Answer answer = distance(moved_mesh, b, pose), of_anew = distance(anew, b, pose);
      ASSERT_EQ(answer.status, Status::Converged);
      ASSERT_LE(answer.lower, truth + bound / 64) << i;
      ASSERT_GE(answer.upper, truth - bound / 64) << i;
      ASSERT_LE(answer.upper - answer.lower, bound);
      if (truth > bound) {
        ASSERT_EQ(answer.verdict, of_anew.verdict) << i;
      }
      ++(truth > 0 ? apart : met);
    }
    ASSERT_EQ(load_mesh(moved_mesh.bytes()).value().hash(), moved_mesh.hash());
    // And back: all of it but for the axes of some nodes.
    const MeshModel back = refitted(moved_mesh, before.points);
    ASSERT_TRUE(verify(back)) << i;
    ASSERT_EQ(back.topology(), mesh.topology());
    ASSERT_EQ(back.extent(), mesh.extent());
  }
  EXPECT_GE(apart, 80);
  EXPECT_GE(met, 25);
  EXPECT_GE(units, 10);
}

/// Boxes along the old axes of plates that have turned would be thick: these took four times the work.
TEST(Refit, KeepsBoxesThin) {
  Soup soup = torus(80, 40);
  const MeshModel before = soup.mesh();
  for (Vec3& p : soup.points) p += 0.2 * Vec3(std::sin(3 * p.y()), 0, std::cos(2 * p.x()));
  const MeshModel after = refitted(before, soup.points), anew = soup.mesh();
  Random random(3);
  std::uint64_t work[2] = {0, 0};
  for (int i = 0; i < 100; ++i) {
    const Pose pose = any_pose(random, 3);
    for (const bool fresh : {false, true}) {
      const MeshModel& mesh = fresh ? anew : after;
      const Answer answer = distance(mesh, mesh, pose);
      work[fresh] += answer.steps + answer.plane_tests;
    }
  }
  std::printf("work %lu after refit, %lu anew\n", static_cast<unsigned long>(work[0]), static_cast<unsigned long>(work[1]));
  EXPECT_LE(double(work[0]), 1.5 * double(work[1]));
}

TEST(Refit, RefusesWhatIsNoCoordinateAndNamesIt) {
  const Soup soup = box({0, 0, 0}, {1, 1, 1});
  const MeshModel mesh = soup.mesh();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e-60, 1e46}) {
    std::vector<Vec3> points = soup.points;
    points[3].y() = bad;
    const Result<MeshModel> result = refit(mesh, points);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::BadValue);
    EXPECT_NE(result.error().message.find("point 3"), std::string::npos) << result.error().message;
  }
  const Result<MeshModel> few = refit(mesh, std::span(soup.points).first(5));
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::BadValue);
  EXPECT_NE(few.error().message.find("5 points"), std::string::npos) << few.error().message;
  std::vector<Vec3> more = soup.points;
  more.emplace_back(1e-60, 0, 0);  // of no triangle
  EXPECT_TRUE(refit(mesh, more));
}

/// A file may name any vertices of the user's, as long as it names each of its triangles once.
TEST(Refit, OfAFileThatLiesIsHarmless) {
  const Soup soup = ball(2);
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    soups::Block block = bytes_of(soup.mesh());
    const MeshHeader header = header_of(block);
    const auto entry = [&](const Section& s) { return block.data() + s.offset + random.bits() % (s.bytes / 4) * 4; };
    if (i % 2) {
      std::byte *const one = entry(header.source_triangle), *const other = entry(header.source_triangle);
      if (one != other) std::swap_ranges(one, one + 4, other);
    } else {
      const auto wrong = std::uint32_t(i % 3 ? random.bits() % 100 : random.bits());
      std::memcpy(entry(header.source_vertex), &wrong, 4);
    }
    rehash(block);
    const Result<MeshModel> liar = load_mesh(block);
    ASSERT_TRUE(liar) << i << ": " << liar.error().message;
    const Result<MeshModel> result = refit(liar.value(), soup.points);
    EXPECT_TRUE(!result || verify(result.value()));
  }
}

}  // namespace
}  // namespace swiftlet
