// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The end of a march on one level pair: certify what the walk found, and go on where that fails. Knows nothing of levels.
#pragma once

#include <swiftlet/march.h>

#include "pair/pair_view.h"
#include "pair/walk.h"

namespace swiftlet {

/// How far certified GJK goes where the features alone do not prove enough.
enum class Until {
  Narrow,  ///< as the rule says; the points may then lie inside the bodies, whose distance they bound
  Exact,   ///< within law 2, or beyond the rule's threshold: the points are on the surfaces
};

/// `zero`: a distance whose two sides are different verdicts, as 0 is in any case.
template <Until until = Until::Narrow>
MarchResult conclude(const PairView& pair, const Walk& walk, const MarchRule& rule, double zero = 0);

}  // namespace swiftlet
