// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Is a method right? Its outcomes against proved intervals, and a hash that equal answers share. Knows outcomes, intervals and
// swiftlet's check; nothing of methods or clocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "method.h"

namespace swiftlet::bench {

/// What is proved of one query. Neither flag is set where the sign of the distance is beyond double precision: no answer is
/// wrong.
struct Certified {
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  bool disjoint = false, overlapping = false;
};

/// The truth of a scene, once for all methods: cold exact queries, each answer recomputed by swiftlet::check. A query that
/// fails it keeps [0, inf] and is counted.
struct Truth {
  std::vector<Certified> queries;
  std::size_t unproved = 0;
  std::string first_failure;
  double widest = 0;  ///< the largest upper - lower
  double overlapping_share = 0;
};
Truth certify(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs, std::span<const Query> queries);

/// The same of depths, as distances of bodies that are apart. Checking takes half a second: every hundredth answer is.
Truth certify_depths(std::span<const SceneBody> bodies, std::span<const BodyPair> pairs, std::span<const Query> queries);

/// A method against the truth. A query is counted once: failed, or of the wrong verdict, or in the errors.
struct Comparison {
  std::size_t count = 0;
  std::size_t failures = 0;         ///< said so itself, or a distance that is negative, infinite or no number
  std::size_t false_overlaps = 0;   ///< "overlapping" where the bodies are proved disjoint
  std::size_t missed_overlaps = 0;  ///< a distance where they are proved to overlap
  double widest_false_overlap = 0;  ///< the largest proved distance of the first kind: grazing, or grossly wrong?
  double largest_missed = 0;        ///< the largest distance answered for the second kind; 0 for booleans
  double max_error = 0;             ///< the farthest a distance lies outside its proved interval
  double mean_error = 0;
  std::size_t worst = 0;        ///< the query of max_error
  std::uint64_t hash = 0;       ///< of the answers
  std::uint64_t true_hash = 0;  ///< what the proved answers hash to: equal when every distance is right to 0.5e-9 radius

  std::size_t wrong() const { return false_overlaps + missed_overlaps; }
  /// No failure, no wrong verdict, and no distance farther off than claimed.
  bool right(double claimed_error) const { return failures == 0 && wrong() == 0 && max_error <= claimed_error; }
};

/// `radius`: the scene's length, the larger bounding radius; it scales the hash's rounding only.
///
/// The hash is FNV-1a, 64 bits, over two words per query: the verdict (0 disjoint, 1 overlapping, 2 failed, 3 undecidable), and
/// the distance in units of 1e-9 radius. The latter is rounded as round(truth) + round(distance - truth), truth being the
/// middle of the proved interval: rounding the distance itself would split answers that differ by 1e-16 across a half, and
/// among 20 000 queries some always do. So methods right to 0.5e-9 radius hash alike, and any that is off by more does not.
Comparison compare(std::span<const Outcome> outcomes, std::span<const Certified> truth, double radius);

/// The same where only `overlapping` was asked for: no distance is read, and every error is 0.
Comparison compare_verdicts(std::span<const Outcome> outcomes, std::span<const Certified> truth);

/// "wrong 3 of 20000 (2 false overlaps up to 1.2e-09, ...), ..." for one line of a report; errors in units of `radius`.
std::string text(const Comparison& comparison, double radius);

}  // namespace swiftlet::bench
