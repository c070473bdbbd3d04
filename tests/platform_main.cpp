// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What ./run platforms asks on each: for every width of registers a line with the width in doubles, the number of answers, of
// those fields that are not as recorded, their hash, and the nanoseconds of a warm distance. Ends with 1 if any field differs.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "answers.h"
#include "bodies.h"
#include "numeric/width.h"

namespace {

using namespace swiftlet;

/// The hash of all answers, from those that stand in the records of each kind, and how many answers there are.
answers::Fingerprint all(const std::vector<answers::Record>& records) {
  answers::Fingerprint print;
  for (const answers::Record& record : records) {
    if (!record.name.starts_with("all/")) continue;
    for (const auto& [field, value] : record.fields) {
      if (field == "hash") print.add(std::stoull(value, nullptr, 16));
      if (field == "count") print.answers += std::stoull(value);
    }
  }
  return print;
}

/// Of two fat bodies that turn slowly beside each other; the median of some rounds.
double nanoseconds_of_a_warm_distance(const Model& a, const Model& b) {
  using Clock = std::chrono::steady_clock;
  constexpr int kRounds = 15, kPoses = 2000;
  std::vector<Pose> poses(kPoses);
  for (int i = 0; i < kPoses; ++i) {
    const double turned = 0.01 * std::abs(i % 120 - 60);  // there and back, by about a degree a pose
    poses[std::size_t(i)] = {bodies::rotation(1, 0.5 * turned, 0.25 * turned, turned), {2.5, 0.25, 0.125}};
  }
  std::vector<double> rounds;
  double sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    PairSeed seed;
    const auto begin = Clock::now();
    for (const Pose& b_in_a : poses) sum += distance(a, b, b_in_a, seed).lower;
    rounds.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / kPoses);
  }
  std::sort(rounds.begin(), rounds.end());
  return sum > 0 ? rounds[kRounds / 2] : 0;
}

}  // namespace

int main() {
  const std::vector<Model> models = answers::models(SWIFTLET_TEST_DIR "/data/models");
  std::ifstream file(SWIFTLET_TEST_DIR "/data/answers.txt");
  const std::vector<answers::Record> recorded = answers::read(file);
  bool same = true;
  for (const Width width : {Width::Two, Width::Four}) {
    if (!set_width(width)) continue;
    const std::vector<answers::Record> today = answers::records(models, answers::kRecordedRounds);
    const answers::Changes changes = answers::compare(recorded, today);
    for (const auto* lines : {&changes.hashes, &changes.values})
      for (const std::string& line : *lines) std::fprintf(stderr, "%s\n", line.c_str());
    const std::size_t different = changes.hashes.size() + changes.values.size() + changes.gone.size() + changes.added.size();
    const answers::Fingerprint print = all(today);
    std::printf("%d %llu %zu %016llx %.0f\n", width == Width::Two ? 2 : 4, static_cast<unsigned long long>(print.answers),
                different, static_cast<unsigned long long>(print.hash), nanoseconds_of_a_warm_distance(models[0], models[1]));
    same = same && changes.empty();
  }
  return same ? 0 : 1;
}
