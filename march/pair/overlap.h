// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Proves overlap from the features at which a walk ended inside the other body, by GJK on their vertices and one vertex far
// behind each. Knows one level pair.
#pragma once

#include <swiftlet/march.h>

#include "pair/pair_view.h"

namespace swiftlet {

/// The normal of the face among the two features of `met`: common frame, from A to B, of any length; 0 if neither is a face.
Vec normal_between(const PairView& pair, const MarchStart& met);

/// True if four pairs of vertices of the features of `met`, `behind_a` and `behind_b` pass `proves_deep_overlap`; `proof` then
/// names them. `behind_a` and `behind_b` are vertices far on the other side of each body. Cost: at most `kMapGjkSteps`
/// iterations on at most 8 vertices of each body.
bool meet(const PairView& pair, const MarchStart& met, std::uint32_t behind_a, std::uint32_t behind_b, OverlapProof& proof);

/// A point of both bodies: a proof's vertices of A, combined with the weights that make the origin from its pairs' differences.
struct Common {
  Vec point;
  double off;  ///< distance from the same combination of B's vertices
};
template <class Real>
Common common_point(const PairView& pair, const OverlapProof& proof);

/// A point within law 2's bound of both bodies, computed in doubles if these suffice, else in 106 bits; NaN if neither does.
Vec surely_common_point(const PairView& pair, const OverlapProof& proof);

}  // namespace swiftlet
