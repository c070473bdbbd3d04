// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The end of a march on one level pair: certify what the walk found, and go on where that fails. Knows nothing of levels.
#pragma once

#include <swiftlet/march.h>

#include "scene.h"
#include "walk.h"

namespace swiftlet {

MarchResult conclude(const Scene& scene, const Walk& walk, const MarchRule& rule);

}  // namespace swiftlet
