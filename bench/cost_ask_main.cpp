// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks every query of a written scene once, for callgrind: see cost. Says also, in a run of its own, how many distances were
// not proved by their walk's own tests, and why; or what a distance takes in time, to hold two builds side by side.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <swiftlet/depth.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

namespace {

using namespace swiftlet;

/// Prints the share of the distances of bodies apart that the careful path proved, and why. Each query is asked as it is when
/// counted, and before that with a trace, which is more work and may leave another seed.
void print_doubts(const Body& a, const Body& b, const std::vector<Pose>& poses, Options options) {
  constexpr std::array kNames{"none", "no minimum", "neighbour", "width", "lean", "threshold"};
  std::array<int, kNames.size()> counts{};
  int all = 0;
  PairSeed seed;
  for (const Pose& pose : poses) {
    PairSeed same = seed;
    std::array<LevelRecord, 1> last;
    options.tuning.trace = last;
    if (distance(a, b, pose, same, options).verdict != Verdict::Overlapping) ++all, ++counts.at(std::size_t(last[0].doubt));
    options.tuning.trace = {};
    distance(a, b, pose, seed, options);
  }
  const auto share = [&](int count) { return all ? 100. * count / all : 0; };
  std::printf("%.1f%%", share(all - counts[std::size_t(Doubt::None)]));
  for (std::size_t i = 1; i < counts.size(); ++i)
    if (counts[i] > 0) std::printf(", %s %.1f", kNames[i], share(counts[i]));
  std::printf("\n");
}

/// Prints what a distance takes, in ns: the fastest and the median round over all poses, and the mean distance.
void print_time(const Model& a, const Model& b, const std::vector<Pose>& poses, const Options& options) {
  constexpr int kRounds = 60;
  using Clock = std::chrono::steady_clock;
  std::vector<double> ns;
  PairSeed seed;
  double sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Clock::time_point begin = Clock::now();
    for (const Pose& pose : poses)
      sum += options.absolute > 0 ? distance(a, b, pose, seed, options).upper : distance(a, b, pose, seed).upper;
    ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / double(poses.size()));
  }
  std::sort(ns.begin(), ns.end());
  std::printf("fastest %.1f ns, median %.1f ns, mean distance %.17g\n", ns.front(), ns[kRounds / 2],
              sum / (kRounds * double(poses.size())));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4)
    return std::fputs("swiftlet_cost_ask PREFIX distance|intersects|cold|signed_distance|doubts|time [ERROR]\n", stderr), 2;
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
  const Model &a = model_a.value(), &b = model_b.value();
  if (question == "doubts") return print_doubts(a, b, poses, options), 0;
  if (question == "time") return print_time(a, b, poses, options), 0;
  const Body body_a = a, body_b = b;
  PairSeed seed;
  double steps = 0, tests = 0;
  for (const Pose& pose : poses) {
    if (question == "cold") seed = {};
    const auto count = [&](const auto& answer) { steps += answer.steps, tests += answer.plane_tests; };
    if (question == "signed_distance")
      count(signed_distance(body_a, body_b, pose, seed, options));
    else if (question == "intersects")
      count(intersects(a, b, pose, seed));
    else
      count(argc == 4 ? distance(body_a, body_b, pose, seed, options) : distance(a, b, pose, seed));
  }
  const double n = double(poses.size());
  std::printf("queries %.0f steps %.2f tests %.1f\n", n, steps / n, tests / n);
}
