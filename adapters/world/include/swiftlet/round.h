// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Cylinders and cones as models: prisms and pyramids around them are levels 1 and up, each with its deviation from the round
// body. There is no level 0, as no polytope is round: every interval holds the truth of the round body, and a query that wants
// more than the finest level knows says LevelLimit. Of an overlap it knows how deep it is at most.
#pragma once

#include <swiftlet/model.h>
#include <swiftlet/result.h>

namespace swiftlet {

/// A cylinder along z with its centre at the origin. No point of its finest level lies farther outside than `deviation`; the
/// numbers of sides are powers of two, from 8 on, each four times the one before. Lengths are in the caller's unit. Errors:
/// BadValue if a length is not above 0 and finite, or more than 2 048 sides were needed: 1.2e-6 of the radius.
Result<Model> cylinder(double radius, double half_height, double deviation);

/// A cone along z, its tip up and half its height above the origin; as for cylinders.
Result<Model> cone(double radius, double half_height, double deviation);

}  // namespace swiftlet
