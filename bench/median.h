// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// The middle of what several rounds of a benchmark took.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace swiftlet::bench {

/// Of an even number the mean of the middle two; NaN of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace swiftlet::bench
