// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The decomposition of a mesh as a step of another build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <swiftlet/decompose.h>

#include "watch.h"

namespace swiftlet::lod {

/// What a decomposition must not exceed.
struct PatchLimits {
  std::size_t patches = SIZE_MAX;
  std::size_t convex_edges = SIZE_MAX;  ///< edges between two planes at which the surface is convex
};

/// As swiftlet::decompose, of a whole mesh; nothing as soon as a limit is passed. Tells `watch` of two units of work for each
/// triangle, as far as it comes.
std::optional<Decomposition> decompose(const MeshModel& mesh, Growth growth, const PatchLimits& limits, Watch& watch);

}  // namespace swiftlet::lod
