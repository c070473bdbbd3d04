// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A program of its own: two brackets that hook into each other, whose hulls overlap, and a ball in the corner of one. Ends with
// 1 where an answer is not what can be read off the drawing.
//
//     ____________
//    |________    |
//    ___      | B |
//   |   |  o  |   |
//   |   |     |___|
//   |   |________
//   | A          |
//   |____________|
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>

#include <swiftlet/mesh_contacts.h>
#include <swiftlet/mesh_query.h>

namespace {

using swiftlet::MeshModel;
using Triangle = std::array<std::uint32_t, 3>;

/// An L of thickness 1 and height 1, 3 long both ways.
swiftlet::Result<MeshModel> bracket() {
  const double outline[6][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<swiftlet::Vec3> points;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) points.emplace_back(x, y, z);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    triangles.push_back({i, j, j + 6});
    triangles.push_back({i, j + 6, i + 6});
  }
  for (std::uint32_t i = 1; i < 5; ++i) {
    triangles.push_back({0, i + 1, i});
    triangles.push_back({6, i + 6, i + 7});
  }
  return MeshModel::from_triangles(points, triangles);
}

bool is_exact(const char* what, const swiftlet::MeshBody& a, const swiftlet::MeshBody& b, const swiftlet::Pose& b_in_a,
              double truth) {
  const auto answer = swiftlet::distance(a, b, b_in_a);
  std::printf("%s: [%.17g, %.17g]\n", what, answer.lower, answer.upper);
  return answer.lower <= truth && truth <= answer.upper && answer.upper - answer.lower <= swiftlet::tolerance(a, b, b_in_a);
}

}  // namespace

int main() {
  const auto made = bracket();
  if (!made) return std::puts(made.error().message.c_str()), 1;
  const MeshModel& a = made.value();
  std::printf("%s, of volume %.17g\n", a.topology().closed() ? "a solid" : "a surface", a.topology().volume);

  swiftlet::Pose b_in_a;  // half a turn about z
  b_in_a.rotation.diagonal() << -1, -1, 1;
  b_in_a.translation = {3.25, 4.5, 0};
  swiftlet::MeshSeed seed;
  bool right = a.topology().closed() && std::fabs(a.topology().volume - 5) < 1e-14;
  right &= is_exact("two brackets", a, a, b_in_a, 0.5);
  right &= swiftlet::within(a, a, b_in_a, 0.51, seed).decision == swiftlet::Decision::Yes;
  right &= swiftlet::within(a, a, b_in_a, 0.49, seed).decision == swiftlet::Decision::No;
  right &= swiftlet::intersects(a, a, b_in_a).verdict == swiftlet::Verdict::Disjoint;

  const swiftlet::Body ball = swiftlet::Body::point({1.5, 2, 0.5}, 0.25);
  right &= is_exact("one and a ball", a, ball, swiftlet::Pose{}, 0.25);
  swiftlet::MeshContact contact;
  right &= swiftlet::contacts(a, ball, {}, 0.3, {&contact, 1}).count == 1 && std::fabs(contact.upper - 0.25) < 1e-14;
  right &= swiftlet::manifold(a, ball, {}, contact, {.margin = 0.3}).count == 1;
  right &= is_exact("a thicker one", {a, 0.125}, ball, swiftlet::Pose{}, 0.125);

  const std::filesystem::path file = "bracket.mesh";
  right &= bool(swiftlet::save(a, file));
  const auto mapped = swiftlet::map_mesh(file);
  if (!mapped) return std::puts(mapped.error().message.c_str()), 1;
  right &= mapped.value().hash() == a.hash() && swiftlet::verify(mapped.value()).ok;
  const auto answer = swiftlet::distance(mapped.value(), a, b_in_a);
  right &= swiftlet::check(mapped.value(), a, b_in_a, answer).ok;
  return right ? 0 : 1;
}
