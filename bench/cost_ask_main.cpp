// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks every query of a written scene once, for callgrind: see cost.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

int main(int argc, char** argv) {
  using namespace swiftlet;
  if (argc != 3 && argc != 4)
    return std::fputs("swiftlet_cost_ask PREFIX distance|intersects|cold|signed_distance [ERROR]\n", stderr), 2;
  const std::string prefix = argv[1], question = argv[2];
  const Result<Model> model_a = load(prefix + "-a.swl"), model_b = load(prefix + "-b.swl");
  if (!model_a || !model_b) return std::fprintf(stderr, "%s\n", (model_a ? model_b : model_a).error().message.c_str()), 1;
  std::vector<Pose> poses;
  std::FILE* file = std::fopen((prefix + ".poses").c_str(), "rb");
  if (!file) return std::fprintf(stderr, "cannot read %s.poses\n", prefix.c_str()), 1;
  for (Pose p; std::fread(&p, sizeof p, 1, file) == 1;) poses.push_back(p);
  std::fclose(file);
  Options options;
  if (argc == 4) options.absolute = std::atof(argv[3]) * model_a.value().radius();
  const Body a = model_a.value(), b = model_b.value();
  PairSeed seed;
  double steps = 0, tests = 0;
  for (const Pose& pose : poses) {
    if (question == "cold") seed = {};
    const auto count = [&](const auto& answer) { steps += answer.steps, tests += answer.plane_tests; };
    if (question == "signed_distance")
      count(signed_distance(a, b, pose, seed, options));
    else
      count(question == "intersects" ? intersects(a, b, pose, seed) : distance(a, b, pose, seed, options));
  }
  const double n = double(poses.size());
  std::printf("queries %.0f steps %.2f tests %.1f\n", n, steps / n, tests / n);
}
