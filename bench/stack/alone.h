// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One prism on a floor, in motions whose outcome mechanics knows. Of the kinds of shapes that stack.h compares.
#pragma once

#include <cstdint>

#include "stack.h"

namespace swiftlet::stack {

/// What a prism of radius 0.5 and height 0.5 did. Metres, seconds, radians.
struct Alone {
  double moved = 0;    ///< slide: its speed after 2 s; spin: how far it came; rock: how far it slid on the floor
  double ideal = 0;    ///< what `moved` is by Coulomb's law of friction
  double hop = 0;      ///< the most that its centre rose above its place over the floor
  double wobble = 0;   ///< slide: the fastest that it turned; else the most that its axis leaned against the floor's normal
  double stopped = 0;  ///< spin: when it stood still, 10 where it did not
};

Alone slide(std::uint32_t sides, Shapes shapes, double slope);  ///< down a floor of this slope, from rest, for 2 s
Alone spin(std::uint32_t sides, Shapes shapes);                 ///< begins to turn at 10 per second about its axis, for 10 s
Alone rock(std::uint32_t sides,
           Shapes shapes);  ///< 3 m from the axis of a floor that rocks by up to 0.3, at 0.09 per second, for 20 s

}  // namespace swiftlet::stack
