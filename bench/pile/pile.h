// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Hulls that fall into a pen or roll across a floor, twice in one program: with swiftlet's hull pairs and with Bullet's own
// narrowphase, step beside step. Knows Bullet's dynamics and models; nothing of how pairs are answered.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <swiftlet/model.h>

namespace swiftlet::pile {

enum class Motion : std::uint8_t { Pile, Roll };

/// Ellipsoids of about 1 m; the even numbers of vertices are taken in turn.
struct Scene {
  std::string name;
  Motion motion = Motion::Pile;
  std::vector<std::uint32_t> vertices;
  int bodies = 0;
};

/// The table's scenes: piles of one size from 20 to 2 000 vertices, one of all sizes, and a roll.
std::vector<Scene> scenes();

/// What one world did. Lengths in metres, of bodies of about 1 m with a margin of 0.04 each.
struct Measures {
  double step_us = 0;            ///< mean processor time of a step
  double narrowphase_us = 0;     ///< of that in the pairs
  double pairs = 0;              ///< mean pairs per step whose boxes overlap
  double contacts = 0;           ///< mean contact points per step
  double penetration = 0;        ///< mean overlap of the margins, of the pairs that have any
  double worst_penetration = 0;  ///< greatest overlap, margins included
  int overlaps = 0;              ///< pairs whose hulls themselves overlapped when looked at
  double jitter = 0;             ///< m/s: the median body's root mean square speed in the last quarter
  double energy_gained = 0;      ///< the sum of all increases of the energy over the energy at the start
  double height = 0;             ///< mean height at the end: the same heap or another
  std::uint64_t hash = 0;        ///< of the final positions
};

/// [0] with swiftlet, [1] Bullet alone. What the pairs' gaps are is judged by cold exact queries, every tenth step.
std::array<Measures, 2> run(const Scene& scene, int steps, std::uint64_t seed);

}  // namespace swiftlet::pile
