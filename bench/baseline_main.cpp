// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints what the baseline must reach: V-Clip's states per query beside the published ones, and time, error and answer hash of
// V-Clip, of our plain walk and of swiftlet. Knows scenes and these three; the whole benchmark is another program.
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <swiftlet/query.h>

#include "plain.h"
#include "scenes.h"
#include "vclip.h"

namespace swiftlet::bench {
using namespace yardstick;
namespace {

/// Mean states per query of V-Clip 1.0 on other orbits of the same definition, 2 000 triangles, a body against itself.
struct Published {
  shapes::Family family;
  double closest;
  std::array<double, 6> states;
};
constexpr std::array kSpeeds{0.5, 2.0, 10.0, 40.0, 80.0, 160.0};
constexpr Published kPublished[] = {
    {shapes::Family::Fat, 2, {2.0, 4.6, 18.2, 58.7, 95.5, 129}},
    {shapes::Family::Plate, 2, {1.9, 4.3, 16.9, 55.4, 91.7, 125}},
    {shapes::Family::Long, 2, {1.8, 4.0, 14.8, 51.1, 88.7, 119}},
    {shapes::Family::Fat, 3, {1.8, 3.7, 14.5, 50.0, 84.4, 120}},
};
/// Nanoseconds per query of V-Clip 1.0, 2 000 triangles, R = 2 r, at 1 and 10 degrees, whole: poses repeat; fat, plate, long.
constexpr double kPublishedTime[3][2] = {{138, 538}, {166, 611}, {118, 395}};

double mean_states(const VclipBody& body, double closest, double step) {
  std::uint64_t states = 0, queries = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const shapes::Orbit motion(100 + k, closest, step);
    VclipSeed seed;
    for (std::uint64_t i = 1; i <= 500; ++i, ++queries) states += vclip(body, body, motion.pose(i), seed).steps + 1;
  }
  return double(states) / double(queries);
}

void print_states(const Shelf& shelf) {
  std::puts("States per query of V-Clip, 20 orbits x 500 queries, 2000 triangles: here / published (ratio)");
  for (const Published& row : kPublished) {
    const VclipBody body(shelf.ellipsoid(row.family, 2000, 1).model.level(0).view);
    std::printf("%-5s R=%gr", shapes::name(row.family), row.closest);
    for (std::size_t k = 0; k < kSpeeds.size(); ++k) {
      const double states = mean_states(body, row.closest, kSpeeds[k]);
      std::printf("  %g: %.1f/%g (%.2f)", kSpeeds[k], states, row.states[k], states / row.states[k]);
    }
    std::puts("");
  }
}

/// What one method answered over a scene, and how fast.
struct Row {
  double ns = HUGE_VAL;
  std::vector<double> distances;
  std::uint64_t steps = 0, plane_tests = 0, failures = 0;
};

/// Least time per query, found part by part, as other programs share the machine: a part is 500 queries.
template <class Ask>
void measure(const Scene& scene, int repeats, Row& row, Ask ask) {
  constexpr std::size_t kPart = 500;
  const std::size_t count = scene.queries.size();
  std::vector<double> least((count + kPart - 1) / kPart, HUGE_VAL);
  row.distances.resize(count);
  for (int repeat = -1; repeat < repeats; ++repeat) {  // the first pass warms up
    row.steps = row.plane_tests = row.failures = 0;
    for (std::size_t part = 0; part < least.size(); ++part) {
      const std::size_t end = std::min(count, (part + 1) * kPart);
      const auto begin = std::chrono::steady_clock::now();
      for (std::size_t i = part * kPart; i < end; ++i) row.distances[i] = ask(scene.queries[i].b_in_a);
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
      if (repeat >= 0) least[part] = std::min(least[part], time.count());
    }
  }
  double total = 0;
  for (const double time : least) total += time;
  row.ns = total / double(count);
}

std::uint64_t answer_hash(const std::vector<double>& distances) {
  std::uint64_t h = 0;
  for (const double d : distances) h = (h ^ std::bit_cast<std::uint64_t>(d)) * 0x9e3779b97f4a7c15u + (h >> 29);
  return h;
}

void print_row(const char* name, const Row& row, const std::vector<Answer>& truth) {
  double error = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double d = row.distances[i];
    error = std::max(error, std::isnan(d) ? HUGE_VAL : std::max(truth[i].lower - d, d - truth[i].upper));
  }
  const double n = double(truth.size());
  std::printf("  %-10s %8.1f ns  %7.2f steps  %8.1f plane tests  error %.1e  failures %llu  hash %016llx\n", name, row.ns,
              double(row.steps) / n, double(row.plane_tests) / n, error, static_cast<unsigned long long>(row.failures),
              static_cast<unsigned long long>(answer_hash(row.distances)));
}

void print_scene(const Scene& scene, int repeats) {
  const Model &a = scene.models[0], &b = scene.models[1];
  std::vector<Answer> truth;
  for (const Query& query : scene.queries) truth.push_back(distance(a, b, query.b_in_a));

  Row clip, walk, ours;
  {
    const VclipBody body_a(a.level(0).view), body_b(b.level(0).view);
    VclipSeed seed;
    measure(scene, repeats, clip, [&](const Pose& pose) {
      const VclipResult r = vclip(body_a, body_b, pose, seed);
      clip.steps += r.steps, clip.plane_tests += r.plane_tests, clip.failures += r.end == VclipEnd::Capped;
      return r.distance;
    });
  }
  PlainSeed plain_seed;
  measure(scene, repeats, walk, [&](const Pose& pose) {
    const PlainResult r = plain(a.level(0).view, b.level(0).view, pose, plain_seed);
    walk.steps += r.steps, walk.plane_tests += r.plane_tests, walk.failures += r.stalled;
    return r.distance;
  });
  PairSeed seed;
  measure(scene, repeats, ours, [&](const Pose& pose) {
    const Answer r = distance(a, b, pose, seed);
    ours.steps += r.steps, ours.plane_tests += r.plane_tests, ours.failures += r.status != Status::Converged;
    return r.upper;
  });
  std::printf("%s\n", scene.name.c_str());
  print_row("vclip", clip, truth);
  print_row("plain", walk, truth);
  print_row("swiftlet", ours, truth);
}

void print_times(const Shelf& shelf, int repeats) {
  for (const shapes::Family family : shapes::kFamilies) {
    const double* published = kPublishedTime[std::size_t(family)];
    std::printf("\nV-Clip 1.0, %s: %g ns at 1 degree, %g ns at 10\n", shapes::name(family), published[0], published[1]);
    for (const double step : {1.0, 10.0, 1.04, 10.4, 45.4}) print_scene(orbit(shelf, family, 2000, 2, step), repeats);
    print_scene(random_poses(shelf, family, 2000), repeats);
  }
}

}  // namespace
}  // namespace swiftlet::bench

int main(int argc, char** argv) {
  using namespace swiftlet::bench;
  const std::string cache = argc > 1 ? argv[1] : "build/bench-cache";
  const int repeats = argc > 2 ? std::max(1, std::atoi(argv[2])) : 20;
  const Shelf shelf(cache);
  print_states(shelf);
  print_times(shelf, repeats);
}
