// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>

#include <swiftlet/check.h>

#include "bodies.h"

namespace swiftlet::fuzz {
namespace {

std::string described(const char* what, const Answer& answer, double truth) {
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(), "%s: [%a, %a], truth %a, verdict %d, status %d, %u steps", what, answer.lower,
                answer.upper, truth, int(answer.verdict), int(answer.status), answer.steps);
  return text.data();
}

}  // namespace

Pose take_pose(Bytes& bytes) {
  Pose pose;
  const auto kind = bytes.take<std::uint8_t>();
  if (kind % 4 == 0) {
    for (int i = 0; i < 9; ++i) pose.rotation(i / 3, i % 3) = bytes.take<double>();
    for (double& x : pose.translation) x = bytes.take<double>();
    return pose;
  }
  if (kind % 4 == 1) {  // a sixteenth apart: faces, edges and vertices meet
    for (double& x : pose.translation) x = bytes.take<std::int8_t>() / 16.0;
    return pose;
  }
  std::array<double, 4> q;
  for (double& x : q) x = bytes.take<std::int16_t>();
  if (q != std::array<double, 4>{}) pose.rotation = bodies::rotation(q[0], q[1], q[2], q[3]);
  for (double& x : pose.translation) x = kind % 4 == 2 ? bytes.take<std::int16_t>() * 0x1p-12 : bytes.take<double>();
  return pose;
}

PairSeed take_seed(Bytes& bytes) {
  PairSeed seed;
  const auto take = [&](auto&... fields) { ((fields = bytes.take<std::remove_reference_t<decltype(fields)>>()), ...); };
  take(seed.a, seed.b, seed.line_in_a, seed.line_in_b, seed.normal, seed.level_a, seed.level_b, seed.met);
  return seed;
}

ManifoldOptions take_manifold_options(Bytes& bytes) {
  ManifoldOptions options;
  options.margin = bytes.take<double>();
  options.flatness = bytes.take<double>();
  options.most_points = bytes.take<std::uint32_t>();
  return options;
}

Manifold take_manifold(Bytes& bytes) {
  const auto feature = [&] { return FeatureId(FeatureKind(bytes.take<std::uint8_t>() % 4), bytes.take<std::uint8_t>()); };
  Manifold manifold;
  manifold.count = bytes.take<std::uint32_t>();
  manifold.face_a = feature(), manifold.face_b = feature();
  for (ManifoldPoint& p : manifold.points) p.feature_a = feature(), p.feature_b = feature();
  return manifold;
}

bool is_legal(const Pose& pose) {
  const Body point = Body::point(Vec3::Zero());
  return !std::isnan(tolerance(point, point, pose));
}

Judge::Judge(const Model& a, const Model& b, const Pose& b_in_a, const OverlapProof& proof)
    : a_(a),
      b_(b),
      b_in_a_(b_in_a),
      proof_(proof),
      points_a_(bodies::points_of(a.level(0).view)),
      points_b_(bodies::points_of(b.level(0).view)),
      truth_(oracle::distance(points_a_, points_b_, b_in_a)),
      law_two_(tolerance(a, b, b_in_a)) {}

std::string Judge::fault(const Answer& answer, bool exact) const {
  const auto wrong = [&](const char* what) { return described(what, answer, truth_.distance); };
  const bool holds =
      answer.is_signed && truth_.overlapping ? answer.lower <= 0 : oracle::holds(truth_, answer.lower, answer.upper);
  if (!holds) return wrong("the interval does not hold the truth");
  if (answer.is_signed && truth_.overlapping && std::isfinite(answer.lower) && !answer.normal.hasNaN() &&
      !oracle::is_apart_along(points_a_, points_b_, b_in_a_, answer.normal, answer.lower))
    return wrong("the normal does not prove lower");
  if (const Check checked = check(a_, b_, b_in_a_, answer, exact ? Question::Exact : Question::Any, &proof_); !checked)
    return wrong(checked.message.c_str());
  if (answer.status == Status::NotConverged || answer.status == Status::InvalidPose) return wrong("not converged");
  if (answer.verdict == Verdict::Overlapping && !truth_.overlapping) return wrong("no overlap");
  if (answer.verdict == Verdict::Disjoint && truth_.overlapping) return wrong("not disjoint");
  if (answer.verdict == Verdict::Touching && truth_.distance > law_two_) return wrong("not touching");
  if (!exact) return {};
  if (answer.status != Status::Converged || answer.verdict == Verdict::Undecided) return wrong("undecided");
  if (answer.upper - answer.lower > law_two_) return wrong("wider than law 2 allows");
  return {};
}

std::string Judge::fault(const Within& within, double threshold) const {
  if (within.decision == Decision::Undecided) {
    if (within.answer.status == Status::Converged && !(std::fabs(threshold - truth_.distance) <= law_two_))
      return described("undecided", within.answer, truth_.distance);
  } else if ((within.decision == Decision::Yes) != oracle::holds(truth_, 0, threshold)) {
    return described("within, wrong", within.answer, truth_.distance);
  }
  return fault(within.answer, false);
}

std::string Judge::fault(const Manifold& manifold, const Answer& answer, const ManifoldOptions& options) const {
  if (manifold.count > std::min(options.most_points, kMostManifoldPoints)) return "too many points";
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& p = manifold.points[i];
    if (!(p.point_a + p.point_b).allFinite() || !(p.separation <= options.margin + law_two_)) return "no point of a manifold";
    if (!((p.point_b - p.point_a - p.separation * manifold.normal).norm() <= 2 * law_two_)) return "not one above the other";
    const auto off = [&](const Vec3& point, const Model& body, const Pose& pose) {
      return !oracle::is_within({&point, 1}, bodies::points_of(body.level(0).view), pose, law_two_);
    };
    if (off(p.point_a, a_, Pose{}) || off(p.point_b, b_, b_in_a_)) return "a point outside its body";
    least = std::min(least, p.separation);
  }
  if (manifold.count == 0 && options.most_points > 0 && answer.upper <= options.margin) return "no manifold";
  if (manifold.count > 0 && !(least >= answer.lower - law_two_ && least <= answer.upper + law_two_)) return "not the deepest";
  return {};
}

}  // namespace swiftlet::fuzz
