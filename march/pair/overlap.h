// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Overlap proved from where a walk met the other body: the vertices of the two features and one behind each. Knows one level
// pair.
#pragma once

#include <swiftlet/march.h>

#include "pair/pair_view.h"

namespace swiftlet {

/// An outward normal of the face among two features, from A to B, of any length; 0 where none is a face.
Vec across(const PairView& pair, const MarchStart& met);

/// Whether some of these vertices' differences hold the origin, by clearly more than law 2's bound, which `proof` then names.
/// `behind_a` and `behind_b` are vertices far to the other side. Cost: a few iterations on at most four vertices of each body.
bool meet(const PairView& pair, const MarchStart& met, std::uint32_t behind_a, std::uint32_t behind_b, OverlapProof& proof);

/// The point that a proof shows to be common: of A, as the combination of A's vertices whose differences make the origin.
struct Common {
  Vec point;
  double off;  ///< from the same combination of B's vertices
};
template <class Real>
Common common_point(const PairView& pair, const OverlapProof& proof);

/// Within law 2's bound of both bodies: in doubles where these tell, else in 106 bits; NaN where not even they do.
Vec surely_common_point(const PairView& pair, const OverlapProof& proof);

}  // namespace swiftlet
