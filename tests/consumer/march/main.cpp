// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A program of its own: two cubes from plain arrays, without the builder.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <swiftlet/query.h>

int main() {
  std::vector<swiftlet::Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const std::vector<std::uint32_t> quads{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  const std::vector<std::uint32_t> sizes(6, 4);

  swiftlet::LevelArrays arrays;
  arrays.vertices = corners;
  arrays.face_vertices = quads;
  arrays.face_sizes = sizes;
  const auto cube = swiftlet::Model::from_level(arrays);
  if (!cube) return std::puts(cube.error().message.c_str()), 1;

  swiftlet::Pose b_in_a;
  b_in_a.translation = {5, 6, 0};  // edges face each other, 3 and 4 apart
  const auto answer = swiftlet::distance(cube.value(), cube.value(), b_in_a);
  std::printf("distance in [%.17g, %.17g]\n", answer.lower, answer.upper);
  return answer.lower <= 5 && 5 <= answer.upper &&
                 answer.upper - answer.lower <= swiftlet::tolerance(cube.value(), cube.value(), b_in_a)
             ? 0
             : 1;
}
