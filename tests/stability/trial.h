// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// One case, asked in every way there is, and what came of it. Knows cases, the judge, the builder and the queries; nothing of
// files or tables.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "case.h"
#include "judge.h"

namespace swiftlet::stability {

/// As it stands, and B first.
using Problems = std::array<Problem, 2>;
Problems problems_of(const Case& c);

/// What a method made of one case. Flags: of at least one of its answers. Plain bytes, so that another process can send it.
struct Findings {
  bool applicable = true;  ///< the method takes bodies like these
  bool wrong_verdict = false, wrong_distance = false, wrong_depth = false;
  bool no_number = false;       ///< NaN, an exception or a crash
  bool not_terminated = false;  ///< within the wall-clock limit
  bool not_converged = false;   ///< it says itself that it has no answer
  bool undecided = false, touching = false;
  std::uint32_t answers = 0, most_steps = 0;
  double worst_error = 0;        ///< over size, of the distances of all answers with the right verdict
  double worst_depth_error = 0;  ///< likewise, of depths
  double depth = std::numeric_limits<double>::quiet_NaN();  ///< the first answer to that question
  char first_fault[320] = {0};                              ///< in words

  bool failed() const { return wrong_verdict || wrong_distance || wrong_depth || no_number || not_terminated || not_converged; }
  void add(Fault fault, std::string_view message);
  void note(std::string_view message);  ///< the first fault's words stay
};
static_assert(std::is_trivially_copyable_v<Findings>);

/// Asks swiftlet: distance, contact, intersects, and within thresholds around the truth; of models with as many levels as the
/// builder makes, by either method; as given and swapped; cold and with the seed of the query before; under every combination
/// of StartPolicy, Refinement and PlaneRule. Judged one by one, and all verdicts of one problem must be the same (law 3).
Findings ask_swiftlet(const Case& c, const Problems& problems);

}  // namespace swiftlet::stability
