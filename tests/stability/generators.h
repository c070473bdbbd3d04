// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Families of hard pairs, generated from a seed; each says how often it should hit what it was made for, so that none can
// silently test nothing. Knows shapes, the builder and fetched meshes; nothing of threads or clocks.
#pragma once

#include <cstdint>
#include <span>

#include "examiner.h"

namespace swiftlet::stability {

struct Family {
  const char* name;
  const char* traps;   ///< of the literature that it is for, by the numbers of our list of traps; may be empty
  const char* hit;     ///< what counts as one
  double least, most;  ///< the range that the hit rate lies in
  int batches;         ///< so many, from index 0, are a fair sample: what the tests run
  void (*batch)(Examiner& examiner, std::uint64_t index);
  std::uint64_t judge_every = 1;  ///< of the pairs in the tests; the others are compared: Pair::ask
};

/// In a fixed order.
std::span<const Family> families();

/// The examiner of batch `index` of a family after it has run. Of the pairs that a family asks, the first and every
/// `judge_every`-th after it are judged, the others compared (Pair::ask); the pairs are the same. Depends on nothing but its
/// arguments and, for "deep overlaps", on whether models/fetch has run.
Examiner run_batch(const Family& family, std::uint64_t seed, std::uint64_t index, std::uint64_t judge_every = 1);

/// A stored pair, asked from a cold start and from two hundred pairs of features.
Examiner ask_case(const Case& stored, std::uint64_t seed);

}  // namespace swiftlet::stability
