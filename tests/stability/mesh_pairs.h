// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The soak's family of meshes.
#pragma once

#include <cstdint>

#include "examiner.h"

namespace swiftlet::stability {

/// A pair of each of mesh_families::families(), without hulls and with them, judged by rational arithmetic.
void mesh_pairs(Examiner& examiner, std::uint64_t index);

}  // namespace swiftlet::stability
