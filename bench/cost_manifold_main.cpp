// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks one method for the manifolds of two equal prisms, once each for callgrind, or in rounds, of which the fastest is timed:
// see cost.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <swiftlet/depth.h>
#include <swiftlet/model_file.h>

#include "manifold_cell.h"

int main(int argc, char** argv) {
  using namespace swiftlet;
  using namespace swiftlet::bench;
  if (argc < 3 || argc > 5)
    return std::fputs("swiftlet_cost_manifold MODEL SIDES|SERIES [ROUNDS [POSES]]: writes a model, or asks about it\n", stderr),
           2;
  const std::string file = argv[1], series = argv[2];
  if (const int sides = std::atoi(argv[2]); sides >= 3) return save(prism(std::uint32_t(sides)), file) ? 0 : 1;
  const Result<Model> model = load(file);
  if (!model) return std::fprintf(stderr, "%s\n", model.error().message.c_str()), 1;
  const ManifoldCell cell = stacked(model.value(), 1e-6, argc == 5 ? std::uint32_t(std::atoi(argv[4])) : 64);
  const SceneBody body{&cell.a, cell.a.level(0).view, 0};
  std::vector<Answer> answers;
  PairSeed seed;
  for (const Pose& pose : cell.poses) answers.push_back(signed_distance(cell.a, cell.b, pose, seed));
  std::vector<Contacts> contacts(cell.poses.size());
  for (const ManifoldMethod& method : manifold_methods()) {
    for (const bool cold : {false, true}) {
      if (series != method.name + (cold ? " cold" : "")) continue;
      const auto session = method.open(body, body, cold);
      double least = std::numeric_limits<double>::infinity();
      for (int rest = argc > 3 ? std::atoi(argv[3]) : 1; rest > 0; --rest) {
        const auto begin = std::chrono::steady_clock::now();
        session->ask(cell.poses, answers, contacts);
        least = std::min(least, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count());
      }
      return std::printf("queries %zu ns %.0f\n", cell.poses.size(), least / double(cell.poses.size())), 0;
    }
  }
  return std::fprintf(stderr, "no series %s\n", series.c_str()), 2;
}
