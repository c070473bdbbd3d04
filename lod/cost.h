// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// What the choice of levels costs the queries, and the choice that costs least. Knows numbers, no geometry.
//
//     cold  = legal_pose + sample * samples(error)                 where a mapped level answers, or else
//             walked(V)                                            at the finest mapped level
//             + refine(V' / V)                                     to the level below it,
//             + refine(V'' / V') + between ...                     and on to the finest that the error needs
//     warm  = proof + transition * steps_per_edge * turn sqrt(V)   on the level that answers
//
// in instructions of one query, as callgrind counts them: lod/README.md has the counts that the constants come from, and
// bench/levels compares anew. A coarse level that a query need not visit costs it nothing; what it costs are bytes.
#pragma once

#include <span>
#include <vector>

namespace swiftlet::lod {

/// A level of a body of radius 1, as the model sees it.
struct LevelSize {
  double vertices, deviation;
};

/// How often scenes ask for what: an error of a distance, both bodies together, over the radius; 0: exact.
struct Asked {
  double error, weight;
};
inline constexpr Asked kAsked[] = {{0, 0.4}, {0.001, 0.2}, {0.01, 0.2}, {0.1, 0.2}};

/// The constants. Instructions but where said.
struct QueryCost {
  double mapped_vertices = 4096;   ///< levels of more were not mapped by the kernel that this is fitted to
  double legal_pose = 880;         ///< what any query takes before and after
  double sample = 460;             ///< one direction along the maps of both bodies
  double first_slack = 0.2;        ///< of error that deviations leave, for which one sample is enough;
  double samples_per_decade = 3;   ///< each tenth of it takes so many more
  double least_seen = 0.05;        ///< the least error that samples alone answer: a smaller one, though its level has a map, is
                                   ///< walked for on the next finer level
  double walk = 4820;              ///< from a sample to a proved exact distance on the same level, all told,
  double walk_per_edge = 17;       ///< and for each of the sqrt(V) edges around the body
  double refine_per_edge = 950;    ///< from a level to the next finer one, for each of the sqrt(V' / V) edges that one of its
                                   ///< edges becomes
  double between = 3000;           ///< walk and certificate on a level that is neither the first nor the last
  double proof = 2410;             ///< a warm query whose features stay
  double transition = 520;         ///< of features, a step
  double steps_per_edge = 2.4;     ///< that a turn passes
  double turn = 0.05;              ///< of one body from query to query, radians
  double bytes_per_vertex = 132;   ///< of a coarse level, with its links
  double instructions_per_kb = 4;  ///< what a kilobyte of a prefix counts for: its share of caches, memory and loading
};

/// Levels finest first.
double cold_instructions(const QueryCost& cost, std::span<const LevelSize> levels, double error);
double warm_instructions(const QueryCost& cost, std::span<const LevelSize> levels, double error);
double prefix_bytes(const QueryCost& cost, std::span<const LevelSize> levels, double error);
/// Of a query out of all that are asked: cold and warm by halves, and the prefix.
double expected_cost(const QueryCost& cost, std::span<const LevelSize> levels);

/// How many vertices the levels between one of so many and the finest mapped one should have, finest first, the mapped one
/// included: as many levels as make an exact query cheapest, evenly spaced. None where the first is mapped.
std::vector<double> steps_to_map(const QueryCost& cost, double vertices);

}  // namespace swiftlet::lod
