// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Makes a coarse solid hold a fine one. Knows nothing of how the coarse one came about.
#pragma once

#include <cstdint>
#include <vector>

#include <swiftlet/result.h>

#include "polytope.h"
#include "watch.h"

namespace swiftlet::lod {

/// Decides exactly whether no vertex of the climber's body is beyond a face of `level`.
bool holds(const Polytope& level, const Climber& body);

struct Proved {
  Polytope level;
  std::vector<std::uint32_t> vertices;  ///< which of the points they are
};
/// The hull of the points, grown about `centre` by as few ulps as make it hold the body: proved, what all else here is not.
/// NotEnclosing where the points do not surround the centre, or not nearly hold the body.
Result<Proved> prove(std::vector<Vec3> points, const Climber& body, const Vec3& centre);

/// Scaled about `centre`, up or down, until every face clears the body and one touches it [Ehmann & Lin 2000, sec. 4.3, step
/// 4].
Result<Polytope> scale_to_hold(Polytope level, const Climber& body, const Vec3& centre);

/// A level that holds the body, its vertices moved along their rays towards the centre as far as convexity and the body allow
/// [sec. 4.4.2]. Keeps the triangles. The paper lists, per face, the removed vertices on its rays; a climb finds the one that
/// binds without lists, and looks at all of level 0.
Polytope relax(Polytope level, const Climber& body, const Vec3& centre, Watch& watch);

/// Ours: a level that deviates less and still holds the body. Vertices are balanced against the body until the highest stand
/// alike, and then each in turn moves to where the volume is least while its faces clear the body. `metric` maps these
/// coordinates to those in which deviations count.
Polytope tighten(Polytope level, const Climber& body, const Mat3& metric, Watch& watch);

/// What either tells the watch of a level of so many triangles, about microseconds.
double move_work(double triangles);

}  // namespace swiftlet::lod
