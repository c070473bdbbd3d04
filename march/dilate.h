// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are all within a radius of their hulls: what is asked of them becomes a question of the hulls, and the hulls'
// answer becomes theirs. The only place that knows radii, but for `check`. Knows nothing of the way between.
#pragma once

#include <swiftlet/depth.h>

#include "descend.h"

namespace swiftlet {

/// Answers `target` of the hulls of `a` and `b` dilated by the options' radii: from the seed, or on from `so_far`.
Answer ask(const Model& a, const Model& b, const Pose& b_in_a, PairSeed& seed, const QueryOptions& options,
           const Target& target, const Answer* so_far = nullptr);

/// The options for a question of the signed distance of the hulls, which is the bodies' and both radii more. An error relative
/// to it is none relative to theirs: exact instead.
QueryOptions of_hulls(const QueryOptions& options);
/// An answer to such a question as the bodies'.
void dilate(SignedAnswer& answer, const Model& a, const Model& b, const Pose& b_in_a, const QueryOptions& options);

}  // namespace swiftlet
