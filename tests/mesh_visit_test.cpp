// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Questions of the caller's own to a mesh's tree, beside a look at every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <swiftlet/mesh_visit.h>

#include "soups.h"

namespace swiftlet {
namespace {

using soups::Soup;
using Enters = std::function<bool(const Vec3&, const Vec3&)>;

struct Asked final : MeshVisitor {
  Enters is_wanted;
  std::size_t most, boxes = 0;
  std::vector<std::uint32_t> seen;

  explicit Asked(Enters wanted, std::size_t at_most = ~std::size_t{0}) : is_wanted(std::move(wanted)), most(at_most) {}
  bool enters(const Vec3& box_min, const Vec3& box_max) override { return ++boxes, is_wanted(box_min, box_max); }
  bool visit(std::uint32_t triangle) override { return seen.push_back(triangle), seen.size() < most; }
};

std::vector<std::uint32_t> by_all(const MeshModel& mesh, const Enters& is_wanted) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto [i, j, k] = mesh.triangle(t);
    const Vec3 p = mesh.vertex(i), q = mesh.vertex(j), r = mesh.vertex(k);
    if (is_wanted(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r))) found.push_back(t);
  }
  return found;
}

Enters in_box(const Vec3& least, const Vec3& most) {
  return [=](const Vec3& box_min, const Vec3& box_max) {
    return (box_min.array() <= most.array()).all() && (least.array() <= box_max.array()).all();
  };
}
Enters below(const Vec3& up, double height) {
  return [=](const Vec3& box_min, const Vec3& box_max) {
    return up.cwiseMax(0).dot(box_min) + up.cwiseMin(0).dot(box_max) <= height;
  };
}
/// The slabs of a ray without end [Williams et al. 2005].
Enters on_ray(const Vec3& from, const Vec3& direction) {
  return [=](const Vec3& box_min, const Vec3& box_max) {
    const Vec3 one = (box_min - from).cwiseQuotient(direction), other = (box_max - from).cwiseQuotient(direction);
    return std::max(one.cwiseMin(other).maxCoeff(), 0.) <= one.cwiseMax(other).minCoeff();
  };
}

TEST(VisitTriangles, FindsThoseThatALookAtEveryOneFinds) {
  shapes::Random random(17);
  long found = 0;
  for (int i = 0; i < 400; ++i) {
    const double scale = std::ldexp(random.uniform(1, 2), int(random.bits() % 40) - 20);
    const MeshModel mesh = soups::scaled(i % 4 ? soups::any(random) : soups::torus(40, 20), scale).mesh();
    const Vec3 p = scale * random.in_ball(), q = scale * random.in_ball(), n = random.in_ball();
    // What touches is in: exactly at a vertex.
    const Vec3 corner = mesh.vertex(random.bits() % mesh.vertex_count());
    for (const Enters& is_wanted : {in_box(p.cwiseMin(q), p.cwiseMax(q)), in_box(corner, corner), below(n, n.dot(p)),
                                    on_ray(p, n), in_box(-Vec3::Constant(10 * scale), Vec3::Constant(10 * scale))}) {
      Asked asked(is_wanted);
      visit_triangles(mesh, asked);
      std::sort(asked.seen.begin(), asked.seen.end());
      EXPECT_EQ(asked.seen, by_all(mesh, is_wanted)) << i;
      found += long(asked.seen.size());
    }
  }
  EXPECT_GT(found, 100'000);
}

TEST(VisitTriangles, LeavesOutWhatIsElsewhere) {
  const MeshModel mesh = soups::torus(128, 64).mesh();
  Asked asked(in_box({1.35, -0.1, -0.1}, {1.45, 0.1, 0.1}));
  visit_triangles(mesh, asked);
  EXPECT_GT(asked.seen.size(), 10u);
  EXPECT_LT(asked.boxes, mesh.triangle_count() / 20);
}

TEST(VisitTriangles, EndsWhenItIsTold) {
  const MeshModel mesh = soups::torus(40, 20).mesh();
  Asked asked(in_box(-Vec3::Ones() * 2, Vec3::Ones() * 2), 5);
  visit_triangles(mesh, asked);
  EXPECT_EQ(asked.seen.size(), 5u);
}

TEST(VisitTriangles, FindsNoneInAMeshThatWasCut) {
  const MeshModel cut = soups::torus(40, 20).mesh().cut({.deviation = 10});
  ASSERT_FALSE(cut.is_whole());
  Asked asked(in_box(-Vec3::Ones() * 2, Vec3::Ones() * 2));
  visit_triangles(cut, asked);
  EXPECT_TRUE(asked.seen.empty());
}

}  // namespace
}  // namespace swiftlet
