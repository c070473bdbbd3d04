// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints one of the generated bodies as OFF, for the demo. Knows shapes.h.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "shapes.h"

int main(int argc, char** argv) {
  using namespace swiftlet;
  const int triangles = argc > 2 ? std::atoi(argv[2]) : 2000, seed = argc > 3 ? std::atoi(argv[3]) : 1;
  for (const shapes::Family family : shapes::kFamilies) {
    if (argc < 2 || std::strcmp(argv[1], shapes::name(family)) != 0 || triangles < 4 || triangles % 2 != 0) continue;
    const Mesh mesh = shapes::ellipsoid(shapes::semi_axes(family), std::uint32_t(triangles), std::uint64_t(seed));
    std::printf("OFF\n%zu %zu 0\n", mesh.points.size(), mesh.triangles.size());
    for (const Vec3& p : mesh.points) std::printf("%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    for (const auto& t : mesh.triangles) std::printf("3 %u %u %u\n", t[0], t[1], t[2]);
    return 0;
  }
  std::fputs("usage: swiftlet_shape fat|plate|long [even number of triangles = 2000] [seed = 1]\n", stderr);
  return 2;
}
