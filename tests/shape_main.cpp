// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints one of the generated bodies as OFF, for the demo. Knows shapes.h and soups.h.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "shapes.h"
#include "soups.h"

namespace {

template <class M>
int print(const M& mesh) {
  std::printf("OFF\n%zu %zu 0\n", mesh.points.size(), mesh.triangles.size());
  for (const auto& p : mesh.points) std::printf("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles) std::printf("3 %u %u %u\n", t[0], t[1], t[2]);
  return 0;
}

/// Two cones on one base: two vertices have as many edges as it has sides.
swiftlet::Mesh double_cone(std::uint32_t sides) {
  swiftlet::Mesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.) * i / sides;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    const std::uint32_t next = i + 1 < sides ? i + 1 : 0;
    mesh.triangles.push_back({i, next, sides});
    mesh.triangles.push_back({next, i, sides + 1});
  }
  mesh.points.emplace_back(0, 0, 1);
  mesh.points.emplace_back(0, 0, -1);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace swiftlet;
  if (argc == 4 && std::strcmp(argv[1], "torus") == 0) {
    const int around = std::atoi(argv[2]), across = std::atoi(argv[3]);
    if (around >= 3 && across >= 3) return print(soups::torus(std::uint32_t(around), std::uint32_t(across)));
  }
  if (argc == 3 && std::strcmp(argv[1], "prism") == 0) {
    const int sides = std::atoi(argv[2]);
    if (sides >= 3) return print(shapes::prism(std::uint32_t(sides), 1, 2));
  }
  if (argc == 3 && std::strcmp(argv[1], "cone") == 0) {
    const int sides = std::atoi(argv[2]);
    if (sides >= 3) return print(double_cone(std::uint32_t(sides)));
  }
  const int triangles = argc > 2 ? std::atoi(argv[2]) : 2000, seed = argc > 3 ? std::atoi(argv[3]) : 1;
  for (const shapes::Family family : shapes::kFamilies) {
    if (argc < 2 || std::strcmp(argv[1], shapes::name(family)) != 0 || triangles < 4 || triangles % 2 != 0) continue;
    return print(shapes::ellipsoid(shapes::semi_axes(family), std::uint32_t(triangles), std::uint64_t(seed)));
  }
  std::fputs(
      "usage: swiftlet_shape fat|plate|long [even number of triangles = 2000] [seed = 1]\n"
      "       swiftlet_shape torus QUADS_AROUND QUADS_ACROSS\n"
      "       swiftlet_shape prism SIDES\n"
      "       swiftlet_shape cone SIDES\n",
      stderr);
  return 2;
}
