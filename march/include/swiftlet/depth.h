// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// How near or how deep? One number from far apart to deep inside. All points and directions are in A's frame.
#pragma once

#include <swiftlet/query.h>

namespace swiftlet {

/// The signed distance between `a` and `b`, where `b_in_a` maps B's frame into A's: the distance where they are apart; where
/// they overlap, minus the depth, which is the length of the least translation that separates them (their interiors: they still
/// touch then). Exact by default, or to the options' errors. A body without thickness has no depth along it: 0 where both share
/// a plane. The options' `beyond`, `start`, `refinement` and `plane_rule` say how the part of it goes that looks for a
/// distance. Cost: apart that of `distance`; overlapping that of a walk to the local least and of some ten points that confirm
/// it where the overlap is shallow, a climb for each point of a polytope where it is deep, 5 to 30, all vertices of the
/// Minkowski difference at worst, where many facets are about as deep. Nothing is allocated; 16 kB of stack where no polytope
/// grows, 32 kB where one does. Errors are statuses, and the interval is always true. Source: [van den Bergen 2001]; the proof
/// is our own (march/README.md).
Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, PairSeed& seed, const Options& options = {});
/// Likewise, cold.
Answer signed_distance(const Body& a, const Body& b, const Pose& b_in_a, const Options& options = {});

/// Is the signed distance at most `threshold`? Below 0: do they overlap by -threshold or more? Ends at the first level pair,
/// and with the first plane or polytope, that decides. Cost as above.
Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, PairSeed& seed,
                     const Effort& effort = {});
/// Likewise, cold.
Within signed_within(const Body& a, const Body& b, const Pose& b_in_a, double threshold, const Effort& effort = {});

}  // namespace swiftlet
