// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A program of its own: models from points, one of which is inside.
#include <cstdio>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/query.h>

int main() {
  std::vector<swiftlet::Vec3> points{{0, 0, 0}};
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const auto cube = swiftlet::build(points);
  if (!cube) {
    std::printf("%s\n", cube.error().message.c_str());
    return 1;
  }

  swiftlet::Pose b_in_a;
  b_in_a.translation = {0, 0, 2.5};
  swiftlet::PairSeed seed;
  const auto answer = swiftlet::distance(cube.value().model, cube.value().model, b_in_a, seed);
  std::printf("distance in [%.17g, %.17g]\n", answer.lower, answer.upper);
  return answer.lower <= 0.5 && 0.5 <= answer.upper && answer.upper - answer.lower < 1e-12 ? 0 : 1;
}
