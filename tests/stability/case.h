// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// A hard pair, and what is known of it: the format of tests/data/cases.json. Knows points, poses and JSON; nothing of models,
// queries or oracles.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <swiftlet/pose.h>

namespace swiftlet::stability {

/// The signed distance of the closed hulls: positive apart, 0 touching, negative the least translation that parts them.
struct Expected {
  int sign = 0;         ///< exact
  double distance = 0;  ///< rounded from the exact one
};

struct Case {
  std::string name;                   ///< unique in its file
  std::vector<std::string> category;  ///< the first is the family that tables group by; never empty
  std::string source, license, symptom;
  std::vector<Vec3> a, b;       ///< points whose hulls are meant, each read as an exact dyadic rational
  Pose a_in_world, b_in_world;  ///< as given, orthonormal or not
  std::optional<Expected> expected;

  const std::string& family() const { return category.front(); }
  /// As a query takes it: rounded, but exact where `a_in_world` is the identity.
  Pose b_in_a() const { return relative(a_in_world, b_in_world); }
  /// Largest entry of |R^T R - I| of both rotations.
  double orthonormality_error() const;
};

/// All cases of a file, in its order. Throws std::runtime_error naming file, case and key.
std::vector<Case> read_cases(const std::filesystem::path& path);

/// The same format, numbers as strings of hex floats, so that no reader rounds. A whole file appears or none.
void write_cases(const std::filesystem::path& path, std::span<const Case> cases);

}  // namespace swiftlet::stability
