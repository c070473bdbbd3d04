// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include <swiftlet/build.h>
#include <swiftlet/check.h>

#include "judge.h"

namespace swiftlet::fuzz {
namespace {

/// A grid, a grid shaken by the bits of float, or doubles of any size: the first byte says which, the second how many.
std::vector<Vec3> take_points(Bytes& bytes) {
  const auto kind = bytes.take<std::uint8_t>();
  std::vector<Vec3> points(1 + bytes.take<std::uint8_t>() % 16);
  for (Vec3& p : points) {
    for (double& x : p) {
      if (kind % 4 == 3) {
        x = bytes.take<double>();
        continue;
      }
      x = bytes.take<std::int8_t>() / 16.0;
      if (kind % 4 == 1) x += bytes.take<std::int8_t>() * 0x1p-52;
      if (kind % 4 == 2) x = std::ldexp(x, kind / 4 - 32);
    }
  }
  return points;
}

}  // namespace

std::string hulls(Input input) {
  Bytes bytes(input);
  const Pose pose = take_pose(bytes);
  const auto seed_bytes = take_seed(bytes);
  const std::vector<Vec3> points_a = take_points(bytes), points_b = take_points(bytes);
  const Result<Built> built_a = build(points_a), built_b = build(points_b);
  if (!built_a || !built_b || !is_legal(pose)) return {};
  const Model &a = built_a.value().model, &b = built_b.value().model;
  for (const Model* model : {&a, &b})
    if (const Check checked = verify(*model); !checked) return "verify: " + checked.message;
  OverlapProof proof;
  const Tuning tuning{.proof = &proof};
  const Judge judge(a, b, pose, proof);
  const auto input_truth = oracle::distance(points_a, points_b, pose);
  if (!oracle::holds(input_truth, judge.truth().bounds.lower, judge.truth().bounds.upper)) return "the hull lost a point";
  for (const PairSeed& start : {PairSeed{}, seed_bytes}) {
    PairSeed seed = start;
    for (int i = 0; i < 2; ++i)  // cold or garbage, then warm
      if (const auto fault = judge.fault(distance(a, b, pose, seed, {.tuning = tuning}), true); !fault.empty()) return fault;
    const Answer verdict = intersects(a, b, pose, seed, {.tuning = tuning});
    if (const auto fault = judge.fault(verdict, false); !fault.empty()) return "intersects: " + fault;
    if (verdict.verdict == Verdict::Undecided) return "intersects: undecided";
    for (const double threshold : {judge.truth().distance, judge.truth().distance * 0.5, judge.truth().distance * 2})
      if (const auto fault = judge.fault(within(a, b, pose, threshold, seed, {.tuning = tuning}), threshold); !fault.empty())
        return fault;
  }
  return {};
}

}  // namespace swiftlet::fuzz
