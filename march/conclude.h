// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The end of a march on one level pair: certify what the walk found, and go on where that fails. Knows nothing of levels.
#pragma once

#include <swiftlet/march.h>

#include "scene.h"
#include "walk.h"

namespace swiftlet {

/// How far certified progress goes where features alone do not prove enough.
enum class Until : std::uint8_t {
  Narrow,  ///< as the rule says; the points may lie inside the bodies, whose distance they bound
  Exact,   ///< within law 2, or beyond the rule's threshold: the points are on the surfaces
};

MarchResult conclude(const Scene& scene, const Walk& walk, const MarchRule& rule, Until until = Until::Narrow);

}  // namespace swiftlet
