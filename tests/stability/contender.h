// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Who is asked: a name and how to ask it. Swiftlet always; others where the benchmark's methods are built.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trial.h"

namespace swiftlet::stability {

struct Contender {
  std::string name, settings;
  bool gives_distance = true;  ///< else verdicts, and depths as far as the next says
  bool gives_depth = true;
  std::function<Findings(const Case&, const Problems&)> ask;
};

/// The baselines and the peers behind the benchmark's Method, each asked for distance, intersection and depth as far as it
/// answers them, cold and again, as given and swapped. Wrong is what is off by more than `tolerance` times size; verdicts count
/// where the bodies are farther than that from touching.
std::vector<Contender> other_contenders(double tolerance);

}  // namespace swiftlet::stability
