// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include <swiftlet/check.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>

#include "bodies.h"
#include "fuzz.h"

namespace swiftlet::fuzz {
namespace {

/// Steps and plane tests that no pair of so many features comes near: law 7's bound is larger still.
constexpr std::uint64_t kMostWorkPerFeature = 3000;

std::uint64_t features(const Model& model) {
  std::uint64_t count = 0;
  for (int i = 0; i < model.level_count(); ++i) {
    const ConvexView& view = model.level(i).view;
    count += view.vertices.size() + view.half_edges.size() + view.face_first.size();
  }
  return count;
}

std::string harmless(const Answer& answer, std::uint64_t most_work) {
  if (!(answer.lower >= 0 && answer.lower <= answer.upper)) return "no interval";
  if (answer.steps + std::uint64_t{answer.plane_tests} > most_work)
    return std::to_string(answer.steps) + " steps and " + std::to_string(answer.plane_tests) + " plane tests";
  return {};
}

std::string exercise(const Model& a, const Model& b) {
  const std::uint64_t most_work = kMostWorkPerFeature * (features(a) + features(b));
  const Pose poses[] = {{}, {bodies::rotation(1, 2, 3, 4), Vec3(2.5, 1, 0.25)}, {Mat3::Identity(), Vec3(2, 0, 0)}};
  std::string fault;
  const auto note = [&](const Answer& answer) {
    if (fault.empty()) fault = harmless(answer, most_work);
  };
  for (const Pose& pose : poses) {
    PairSeed seed;
    note(distance(a, b, pose, seed));
    for (const auto start : {StartPolicy::Paper, StartPolicy::Finest, StartPolicy::Coarsest, StartPolicy::Table}) {
      const Tuning tuning{.start = start, .refinement = Refinement(int(start) % 3)};
      note(intersects(a, b, pose, seed, {.tuning = tuning}));
      note(within(a, b, pose, 0.5, seed, {.tuning = tuning}).answer);
      const ClosestFeatures found = closest_features(a, b, pose, seed, {.tuning = tuning});
      note(found.answer);
      for (const std::span<const std::uint32_t> ids : {found.source_a.triangles, found.source_b.triangles})
        if (std::find(ids.begin(), ids.end(), kNone) != ids.end()) break;  // read every one
      (void)check(a, b, pose, found.answer);
    }
  }
  return fault;
}

}  // namespace

std::string model(Input input) {
  bodies::Bytes block(input.size());
  if (!input.empty()) std::memcpy(block.data(), input.data(), input.size());
  (void)load(block);  // as it is
  if (block.size() >= sizeof(BlockHeader)) {
    bodies::write(block, offsetof(BlockHeader, total_bytes), std::uint64_t(block.size()));
    if (bodies::read<std::uint32_t>(block, offsetof(BlockHeader, level_count)) * sizeof(LevelHeader) <=
        block.size() - sizeof(BlockHeader))
      bodies::rehash(block);
  }
  const Result<Model> loaded = load(block);
  if (!loaded) return loaded.error().message.empty() ? "refused without a reason" : "";
  const Model &hostile = loaded.value(), honest = bodies::nested(2);
  for (const Vec3& d : {Vec3(1, 2, 3), Vec3(0, 0, -1), Vec3(0, 0, 0)}) hostile.support(d);
  (void)hostile.with_table({lut::Resolution::Degrees22, 2});
  (void)verify(hostile);
  const Model cut = hostile.cut({std::numeric_limits<double>::infinity()});
  for (const auto& [a, b] : {std::pair{&hostile, &honest}, {&honest, &hostile}, {&hostile, &hostile}, {&cut, &hostile}})
    if (const std::string fault = exercise(*a, *b); !fault.empty()) return fault;
  return {};
}

}  // namespace swiftlet::fuzz
