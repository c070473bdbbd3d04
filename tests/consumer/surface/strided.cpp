// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "strided.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

#include <Eigen/Geometry>

#include "shapes.h"

namespace surface {
namespace {

using swiftlet::Answer;
using swiftlet::Body;
using swiftlet::kPosesPerChunk;
using swiftlet::Pose;

template <std::size_t kCount>
std::array<double, kCount> read(const std::byte* row) {
  std::array<double, kCount> values;
  std::memcpy(values.data(), row, sizeof values);
  return values;
}

Pose pose_of(const std::array<double, 3>& position, const std::array<double, 4>& q) {
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(), swiftlet::Vec3(position.data())};
}

}  // namespace

void distances(const Body& a, const Body& b, std::size_t count, Input position, Input quaternion, Output lower, Output normal,
               const swiftlet::Options& options, const swiftlet::Executor& executor) {
  const auto answer_chunk = [&](std::size_t chunk) {
    const std::size_t begin = chunk * kPosesPerChunk, size = std::min(count - begin, kPosesPerChunk);
    std::vector<Pose> poses(size);
    std::vector<Answer> answers(size);
    for (std::size_t i = 0; i < size; ++i) poses[i] = pose_of(read<3>(position[begin + i]), read<4>(quaternion[begin + i]));
    swiftlet::distance(a, b, poses, answers, options);
    for (std::size_t i = 0; i < size; ++i) {
      std::memcpy(lower[begin + i], &answers[i].lower, sizeof(double));
      std::memcpy(normal[begin + i], answers[i].normal.data(), 3 * sizeof(double));
    }
  };
  executor((count + kPosesPerChunk - 1) / kPosesPerChunk, answer_chunk);
}

int strided_batches() {
  // Rows as a simulation might log them, 65 bytes each: a byte, the quaternion, the position, a byte.
  constexpr std::size_t kCount = 5000, kRow = 1 + 7 * sizeof(double) + 8;
  const Body a = Body::box({-1, -1, -1}, {1, 1, 1}), b = Body::segment({0, 0, -1}, {0, 0, 1}, 0.5);
  hull_tree::Random random(1);
  std::vector<std::byte> log(kCount * kRow);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Eigen::Quaterniond q(random.rotation());
    const swiftlet::Vec3 p = random.direction() * random.uniform(1, 4);
    const double numbers[] = {q.w(), q.x(), q.y(), q.z(), p[0], p[1], p[2]};
    std::memcpy(&log[i * kRow + 1], numbers, sizeof numbers);
    poses.push_back(pose_of({p[0], p[1], p[2]}, {q.w(), q.x(), q.y(), q.z()}));
  }
  std::vector<Answer> answers(kCount);
  swiftlet::distance(a, b, poses, answers);

  const Input quaternion{&log[1], kRow}, position{&log[1 + 4 * sizeof(double)], kRow};
  int wrong = 0;
  for (const unsigned threads : {1u, 3u}) {
    std::vector<double> lower(kCount), normal(3 * kCount);  // the last pose's first
    const Output lowers{reinterpret_cast<std::byte*>(&lower.back()), -std::ptrdiff_t(sizeof(double))},
        normals{reinterpret_cast<std::byte*>(&normal[3 * kCount - 3]), -std::ptrdiff_t(3 * sizeof(double))};
    distances(a, b, kCount, position, quaternion, lowers, normals, {}, swiftlet::on_threads(threads));
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::size_t at = kCount - 1 - i;
      wrong += std::memcmp(&lower[at], &answers[i].lower, sizeof(double)) != 0 ||
               std::memcmp(&normal[3 * at], answers[i].normal.data(), 3 * sizeof(double)) != 0;
    }
  }
  const Answer worst = *std::ranges::max_element(answers, {}, [](const Answer& x) { return x.upper - x.lower; });
  for (std::size_t i = 0; i < kCount; ++i) wrong += !(answers[i].upper - answers[i].lower <= tolerance(a, b, poses[i]));
  std::printf("strided: %zu poses, widest interval %.0e\n", kCount, worst.upper - worst.lower);
  return wrong;
}

}  // namespace surface
