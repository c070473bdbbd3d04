// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The program of README.md.
#include <swiftlet/build.h>
#include <swiftlet/model_file.h>
#include <swiftlet/query.h>
#include <cstdio>

int main() {
  const swiftlet::Vec3 corners[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const auto built = swiftlet::build(corners);
  // or: const auto built = swiftlet::build(swiftlet::read_mesh("link.stl").value());
  if (!built) return std::puts(built.error().message.c_str()), 1;
  const swiftlet::Model& model = built.value().model;
  // or: const swiftlet::Model model = swiftlet::load("link.swl").value();

  swiftlet::Pose b_in_a;  // maps B's frame into A's
  b_in_a.translation = {2, 2, 2};
  const swiftlet::Answer answer = swiftlet::distance(model, model, b_in_a);
  std::printf("distance %.12f, proved to %.0e\n", answer.lower, answer.upper - answer.lower);
  std::printf("normal (%.6f, %.6f, %.6f)\n", answer.normal[0], answer.normal[1], answer.normal[2]);
}
