// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The program of the README; consumer/run compares both, and what it prints.
#include <swiftlet/build.h>
#include <swiftlet/query.h>
#include <cstdio>

int main() {
  const swiftlet::Vec3 corners[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const auto body = swiftlet::build(corners);  // or build(read_mesh("link.stl")), or load("link.swl")
  if (!body) return std::puts(body.error().message.c_str()), 1;

  swiftlet::Pose b_in_a;  // maps B's frame into A's
  b_in_a.translation = {2, 2, 2};
  swiftlet::PairSeed seed;  // one per pair, kept from query to query
  const auto& model = body.value().model;
  const swiftlet::Answer answer = swiftlet::distance(model, model, b_in_a, seed);
  std::printf("distance %.12f, proved to %.0e\n", answer.lower, answer.upper - answer.lower);
  std::printf("normal (%.6f, %.6f, %.6f)\n", answer.normal[0], answer.normal[1], answer.normal[2]);
}
