// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Levels as the runtime wants them. Knows nothing of how they came about.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/build.h>

#include "hierarchy.h"
#include "hull.h"

namespace swiftlet::lod {

/// Level 0 of any rank, in the user's coordinates.
struct Finest {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> sources;       ///< the user's vertex of each
  std::vector<std::uint32_t> loops, sizes;  ///< of the faces: two of a flat body, none below; sizes: if not 3
  std::vector<std::uint32_t> face_source_begin, face_sources;  ///< per face, the user's triangles on it
};

/// Joins the levels, whose coordinates are `scale` times the user's, into a model, up to the first that the model refuses or
/// that deviates more than allowed; `end` then says so.
Result<Model> bake(const Finest& finest, const std::vector<CoarseLevel>& coarse, double scale, const BuildOptions& options,
                   std::string& end);

}  // namespace swiftlet::lod
