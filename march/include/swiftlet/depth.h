// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Signed distance and penetration depth [van den Bergen 2001]: one number from far apart to deep overlap. All points and
// directions are in A's frame.
#pragma once

#include <swiftlet/query.h>

namespace swiftlet {

/// Returns the signed distance between `a` and `b`, where `b_in_a` maps B's frame into A's. Apart, it is the distance; where
/// the bodies overlap, it is minus the depth: the length of the shortest translation that separates their interiors, after
/// which they still touch. It is exact by default, or within the errors of `options`. The depth is 0 where one plane holds both
/// bodies. The options' `beyond`, `start`, `refinement` and `plane_rule` affect only the search for a distance. Cost: apart,
/// that of `distance`. In a shallow overlap, a walk to a locally least depth and one to three support points that prove it to
/// be the least of all. In a deep overlap, one support climb for each point of an expanding polytope, mostly 5 to 30; if many
/// facets of the Minkowski difference are almost equally deep, as many as march/README.md says under law 7. Allocates nothing;
/// uses 10 kB of stack, or 26 kB where a polytope is expanded. Errors are statuses, and the interval is always true. Source:
/// [van den Bergen 2001]; proof: march/README.md.
Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options = {});
/// Returns the signed distance, from a cold start.
Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options = {});

/// Decides whether the signed distance is at most `threshold`; a negative threshold asks whether the depth is at least
/// -threshold. Ends at the first level pair, plane or polytope that decides. Cost: that of `signed_distance`.
Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                     const Effort& effort = {});
/// Decides from a cold start whether the signed distance is at most `threshold`.
Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

}  // namespace swiftlet
