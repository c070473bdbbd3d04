// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Attacks on the rounding margins of a walk's last state and of the ellipsoids that tell verdicts: operands searched for by
// hill climbing until the kernel's own expressions err as much as they can, judged by exact arithmetic that shares nothing with
// march; and small bodies whose neighbours lie at the very margins, judged whole.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "random.h"

namespace swiftlet::margins {

/// Numbers in threes: the rows of R, t, then vectors p0 to p3, whose meaning is the kind's.
using Scene = std::array<double, 24>;

/// One margin, in units of u times what it is relative to; those of turns in units of the pose's error, or of the tilt, and
/// `slender line` in law 2's bounds.
struct Kind {
  const char* name;
  double margin;  ///< as the kernel uses it
  double needed;  ///< what the derivation in tolerance.h counts before it rounds up
  bool bites;     ///< an error above half of `needed` is known; where not, see the comment at the kind
  bool posed;     ///< the pose is searched too
  int vectors;
  void (*arrange)(shapes::Random&, Scene&);  ///< makes a random scene one of this kind
  double (*error)(const Scene&);  ///< the error in the margin's unit, from exact numbers rounded last; -1: not of this kind
};
std::span<const Kind> kinds();

struct Attack {
  std::uint64_t count = 0;  ///< scenes of the kind that were judged
  double largest = 0;
  Scene worst{};
};
/// Judges `count` scenes.
Attack attack(const Kind& kind, std::uint64_t count);

/// Whole walks that end in one kind of state beside a neighbour, or a side of a polygon, at the very margin.
struct State {
  const char* name;
  int corners_a, corners_b;  ///< of the features: 1 a vertex, 2 an edge, 3 a triangle, 4 a polygon
};
std::span<const State> states();

struct Walks {
  std::uint64_t count = 0;     ///< walks that ended in the state
  std::uint64_t accepted = 0;  ///< whose own tests proved bounds
  std::uint64_t near = 0;      ///< whose neighbour is within two margins of the border of being accepted
  std::uint64_t near_accepted = 0;
  std::uint64_t wrong = 0;  ///< with bounds that exact arithmetic refutes
  std::string worst;        ///< operands of the first wrong one
};
/// Poses so many bodies. `loose` uses the walk with its margins for neighbours set to 0.
Walks attack(const State& state, std::uint64_t count, bool loose = false);

}  // namespace swiftlet::margins
