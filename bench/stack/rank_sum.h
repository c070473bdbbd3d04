// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether one sample is smaller than another, and by how many such questions chance could answer yes.
#pragma once

#include <vector>

namespace swiftlet::stack {

/// The one-sided p of the rank sum test [Mann & Whitney 1947] that `first` is not smaller than `second`, by the normal
/// approximation with ties and continuity corrected. 1 where all values are equal.
double p_smaller(const std::vector<double>& first, const std::vector<double>& second);

/// The values of p, each adjusted for that so many were asked [Holm 1979].
std::vector<double> holm(const std::vector<double>& p);

}  // namespace swiftlet::stack
