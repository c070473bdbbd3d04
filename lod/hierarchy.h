// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The coarse levels of one solid, finest first, and why they end. Knows nothing of files or models.
#pragma once

#include <string>
#include <vector>

#include <swiftlet/build.h>

#include "polytope.h"
#include "watch.h"

namespace swiftlet::lod {

/// A solid that holds level 0, exactly. Links name vertices one level finer; empty where the nearest will do.
struct CoarseLevel {
  Polytope body;
  std::vector<std::uint32_t> vertex_child;
  std::vector<std::uint32_t> triangle_child;
};

struct Hierarchy {
  std::vector<CoarseLevel> levels;  ///< without level 0
  std::string end;                  ///< one sentence
};

inline constexpr double kLevelsDone = 0.8;  ///< of a build

/// Of `options.detail` the deviation is read.
Hierarchy hierarchy(const Polytope& level0, const BuildOptions& options, Watch& watch);

}  // namespace swiftlet::lod
