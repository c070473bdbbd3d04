// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every error bound of the tests that part triangles from wedges in doubles, with the quantity that it is relative to and its
// derivation. u stands for `kU`, as in numeric/tolerance.h. Directions are taken as they were rounded: any that parts will do.
#pragma once

#include "numeric/tolerance.h"

namespace swiftlet::lod {

/// The difference of two points' heights along a direction, relative to the sum of the direction's magnitudes times the largest
/// coordinate: a dot product carries 3 u, there are two, and the sum with the slack carries 2 u more. That is 8 u; rounded up.
inline constexpr double kHeightsError = 16 * kU;
/// A height over a point, relative to the sum of its three products' magnitudes: the difference of both points carries 1 u, the
/// product 1 u, the sums 2 u. That is 4 u; rounded up, also for what the bound itself loses.
inline constexpr double kHeightOverError = 8 * kU;
/// How far a plane of a wedge is tilted out of it about a corner, over the length of its unit normal, so that it meets the
/// wedge nowhere else: far above `kHeightOverError`, and far below the angles at which triangles stand off. No bound: each
/// tilted plane is tested.
inline constexpr double kTilt = 0x1p-24;

}  // namespace swiftlet::lod
