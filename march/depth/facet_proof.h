// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves the depth where the nearest facet of the Minkowski difference is already known, by one supporting plane and a ring of
// points of the difference. Knows one level pair.
#pragma once

#include <swiftlet/model.h>

#include "depth/depth_goal.h"
#include "pair/pair_view.h"

namespace swiftlet {

/// Returns true if the start's three or four vertex pairs are proved to make a facet of the Minkowski difference that holds the
/// point of its surface nearest to the origin. Where they do, the ring of points mostly proves it. `depth` is filled if so;
/// otherwise only its `steps` are, and its `upper` if nothing but the ring failed (else that is infinite). `a` and `b` are the
/// levels of the pair's views.
bool prove_facet(const PairView& pair, const Level& a, const Level& b, const DepthStart& start, const DepthGoal& goal,
                 std::uint32_t& plane_tests, Depth& depth);

}  // namespace swiftlet
