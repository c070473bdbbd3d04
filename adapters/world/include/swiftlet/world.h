// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two bodies in one common frame, as engines hold them: world poses in their own precision, hulls with a rounding. Knows no
// engine.
#pragma once

#include <cstdint>

#include <swiftlet/model.h>
#include <swiftlet/pose.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// A body where an engine holds it.
struct Placed {
  const Model* model = nullptr;  ///< not owned
  Pose in_world;      ///< its rotation orthonormal to 5e-4; what single precision took from it is given back before the query
  double radius = 0;  ///< the body is all that lies within so much of the hull
};

/// What a pair of bodies is found to be.
enum class Found : std::uint8_t {
  Nearest,  ///< the hulls are apart, or touch in a known direction
  Beyond,   ///< the bodies are farther apart than asked
  Overlap,  ///< the hulls overlap, proved; no depth yet. Normal, which may be 0, and points are where the search ended
  Nothing,  ///< a pose is no rigid motion
};

/// Points and normal in the world's frame.
struct Nearest {
  Found found = Found::Nothing;  ///< Nothing: all else is void
  double distance = 0;           ///< of the bodies: `lower`, never above the truth; where their roundings overlap minus the
                                 ///< depth, within law 2's bound
  Vec3 normal = Vec3::Zero();    ///< unit, from A to B
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< on the bodies' surfaces
};

/// `beyond`: a distance of the bodies; those farther apart answer Beyond, early.
Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed);

/// Of the bodies, exactly; Undecided: a pose is no rigid motion.
Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed);

}  // namespace swiftlet
