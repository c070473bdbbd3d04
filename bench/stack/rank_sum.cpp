// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rank_sum.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swiftlet::stack {

double p_smaller(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> all = first;
  all.insert(all.end(), second.begin(), second.end());
  std::sort(all.begin(), all.end());
  const double n1 = double(first.size()), n2 = double(second.size()), n = n1 + n2;
  double wins = 0, ties = 0;  // of `first` over `second`; sum of t^3 - t over groups of equals
  for (const double a : first)
    for (const double b : second) wins += a > b ? 1 : a == b ? 0.5 : 0;
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::upper_bound(begin, all.end(), *begin);
    const double t = double(end - begin);
    ties += t * t * t - t;
    begin = end;
  }
  const double variance = n1 * n2 / 12 * (n + 1 - ties / (n * (n - 1)));
  if (!(variance > 0)) return 1;
  return 0.5 * std::erfc(-(wins + 0.5 - n1 * n2 / 2) / std::sqrt(2 * variance));
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });
  std::vector<double> adjusted(p.size());
  double before = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    before = std::max(before, std::min(1., p[order[i]] * double(p.size() - i)));
    adjusted[order[i]] = before;
  }
  return adjusted;
}

}  // namespace swiftlet::stack
