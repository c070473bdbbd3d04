// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Two bodies in one common frame, as engines hold them: world poses in their own precision, hulls with a rounding. Knows no
// engine.
#pragma once

#include <array>
#include <cstdint>

#include <swiftlet/body.h>
#include <swiftlet/manifold.h>
#include <swiftlet/pose.h>
#include <swiftlet/query.h>

namespace swiftlet {

/// The model itself. Throws std::invalid_argument where it lacks level 0 (Detail): an engine would be handed a larger hull.
const Model& whole(const Model& model);

/// Whether a rotation is orthonormal to 5e-4 in each entry of R^T R.
bool is_rigid(const Pose& pose);

/// One Newton step of the polar decomposition: |R^T R - I| = e becomes 3/4 e^2, 5e-4 becomes 2e-7. Two such rotations stay
/// within the 1e-6 that a query asks for. Rotations of single precision are off by up to 1e-6 each. One that is not rigid
/// becomes NaN, which every query refuses: of twice a rotation the step would make a reflection.
Pose orthonormal(const Pose& pose);

/// `p`, a point of the pose's own frame, in the frame that it maps to.
Vec3 transform(const Pose& pose, const Vec3& p);

/// A body where an engine holds it.
struct Placed {
  Body body;      ///< what it is, with its radius
  Pose in_world;  ///< its rotation orthonormal to 5e-4; what single precision took from it is given back before the query
};

/// All points p of the world with `normal` . p <= `offset`.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< unit, outwards
  double offset = 0;            ///< of the plane from the origin, along the normal
};

/// `tolerance` of the pair as the queries below see it; NaN where a pose is no rigid motion.
double tolerance(const Placed& a, const Placed& b);
double tolerance(const Placed& a, const HalfSpace& b);  ///< of a body that is a model

/// What a pair of bodies is found to be.
enum class Found : std::uint8_t {
  Nearest,  ///< how far apart or how deep in one another, and along which direction
  Beyond,   ///< the bodies are farther apart than asked
  Nothing,  ///< a pose is no rigid motion, or no direction leads out, as of two points in one place
  AtRest,   ///< as Nearest, and the bodies hardly moved against each other since their manifold was made: see `Rest`
};

/// Points and normal in the world's frame.
struct Nearest {
  Found found = Found::Nothing;          ///< Nothing: all else is void
  Verdict verdict = Verdict::Undecided;  ///< of the bodies
  double distance = 0;                   ///< of the bodies, below 0 where they overlap; `lower`, never above the truth
  Vec3 normal = Vec3::Zero();            ///< unit, from A to B
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< on the bodies' surfaces, where they overlap the deepest
};

/// `beyond`: a distance of the bodies; those farther apart answer Beyond, early.
Nearest nearest(const Placed& a, const Placed& b, double beyond, PairSeed& seed);

/// The same of a body that is a model, and of a half-space. Cost: one support.
Nearest nearest(const Placed& a, const HalfSpace& b, double beyond);

/// Fills `manifold` with at most `most_points` points of contact in the world's frame, none farther apart than `beyond`: of
/// Nearest at least one, else none. It brings the pair's manifold of the step before, or none.
Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Manifold& manifold);

/// Where two bodies were when their manifold was made, at its points.
struct Rest {
  double within = 0;        ///< how far a point may have moved against the other body since then; below 0: never at rest
  std::uint32_t count = 0;  ///< of points
  std::array<Vec3, kMostManifoldPoints> in_a, in_b;  ///< the same places, in either body's frame
};
/// The same for a pair that is asked in every step: where the bodies are at rest, its manifold keeps its points, which have
/// moved with the bodies since, and gets the normal of this step and, as its first separation, the least one, at the price of a
/// distance alone.
Found contacts(const Placed& a, const Placed& b, double beyond, std::uint32_t most_points, PairSeed& seed, Manifold& manifold,
               Rest& rest);

/// The same of a body that is a model, and of a half-space: the corners of the model's contact face. Cost: one support, and the
/// face's sides.
Found contacts(const Placed& a, const HalfSpace& b, double beyond, std::uint32_t most_points, Manifold& manifold);

/// Of the bodies, exactly; Undecided: a pose is no rigid motion, or models lack the levels that tell.
Verdict meeting(const Placed& a, const Placed& b, PairSeed& seed);

}  // namespace swiftlet
