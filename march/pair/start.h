// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What a walk on one level pair starts from. Knows no levels.
#pragma once

#include <cstdint>

#include <swiftlet/march.h>

#include "pair/pair_view.h"

namespace swiftlet {

/// The start as features of the pair's views: what is no feature of its view, or a face against a face, becomes vertices.
/// `plane_tests` grows by the climbs along the line of centres.
MarchStart settled(const PairView& pair, const MarchStart& start, std::uint32_t& plane_tests);

}  // namespace swiftlet
